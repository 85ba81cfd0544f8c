/* The bounds of large positions are written to glTF as whole numbers of many digits, which JSON allows; the reader
 * refused those of more than 64 bits, and with them files that meshtool itself had written. Found by the fuzzer. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/mesh_format.h>

static void test_large_positions_come_back(void **state)
{
    (void)state;
    static const double positions[] = {0, 0, 0, 0x1p100, 0, 0, 0, -0x1p100, 0};
    static const mt_index faces[] = {3, 0, 1, 2};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 3, positions, 1, faces), *again;
    const mt_mesh_write_options options = {.format = "gltf"};
    void *bytes;
    size_t byte_count;
    assert_int_equal(mt_mesh_write_memory(context, mesh, &options, &bytes, &byte_count), MT_OK);
    assert_int_equal(mt_mesh_read_memory(context, "again.gltf", bytes, byte_count, NULL, &again, NULL), MT_OK);
    assert_true(mt_mesh_position(again, 1).x == 0x1p100);
    assert_true(mt_mesh_position(again, 2).y == -0x1p100);
    mt_free(context, bytes);
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_large_positions_come_back)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
