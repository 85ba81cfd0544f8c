/* A binary PLY file whose first face has a list of 0 vertices made the reader add an offset to a null pointer, because
 * no room for corners had been asked for yet. Found by the fuzzer under the undefined-behaviour sanitizer, which this
 * test needs to fail; without it the file was refused as it must be. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/mesh_format.h>

#include <string.h>

static void test_first_face_is_empty(void **state)
{
    (void)state;
    static const char file[] = "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\n"
                               "property float y\nproperty float z\nelement face 1\n"
                               "property list uchar int vertex_indices\nend_header\n";
    mt_context *context = test_context();
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_read_memory(context, "a.ply", file, sizeof file, NULL, &mesh, NULL), MT_ERROR_SYNTAX);
    assert_null(mesh);
    assert_non_null(strstr(mt_context_error(context)->message, "fewer than 3"));
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_first_face_is_empty)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
