/* Draco's quantising divides by the extent of the values: where it is so small that the quotient is no float, or so
 * large that it is none itself, numbers of symbols became negative and Draco wrote to address 0. Found by the fuzzer.
 * Such values are stored as they are. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/mesh_format.h>

static void check_extent(double size)
{
    const double positions[] = {0, 0, 0, size, 0, 0, 0, size, 0, -size, 0, 0};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 0, 2, 3};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 4, positions, 2, faces), *again;
    mt_mesh_write_options options = {.format = "drc", .draco = {.sequential = true}};
    void *bytes;
    size_t byte_count;
    assert_int_equal(mt_mesh_write_memory(context, mesh, &options, &bytes, &byte_count), MT_OK);
    assert_int_equal(mt_mesh_read_memory(context, "again.drc", bytes, byte_count, NULL, &again, NULL), MT_OK);
    assert_int_equal(again->vertex_count, 4);
    for (mt_index i = 0; i < 4; i++) {
        mt_vec3 p = mt_mesh_position(again, i);
        assert_true(p.x == (double)(float)positions[3 * i]);
        assert_true(p.y == (double)(float)positions[3 * i + 1]);
        assert_true(p.z == 0.0);
    }
    mt_free(context, bytes);
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_extents_that_no_float_divides(void **state)
{
    (void)state;
    check_extent(1e-40);
    check_extent(1e-44);
    check_extent(3e38);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_extents_that_no_float_divides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
