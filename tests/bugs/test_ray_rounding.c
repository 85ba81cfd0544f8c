/* Corners of triangles that are loaded for the watertight test must be floats. gcc 12 at -O2 and -O3 left some of them
 * doubles: from `exact ? x : (double)(float)x`, written once for each coordinate, it makes vectors of two, and in those
 * it forgets the rounding (-0.1314327780297834 stayed where -0.13143277 was asked for). Brute force and the tree, which
 * keeps floats, then disagreed about t in the ninth digit. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/generate.h>
#include <meshtool/ray.h>

static void loaded_corners_are_floats(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    mt_triangulation triangulation;
    assert_int_equal(mt_generate(context, "icosphere", &(mt_generate_options){.resolution = 2}, &mesh), MT_OK);
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    mt_ray_space space = mt_ray_space_of(mesh);
    for (mt_index triangle = 0; triangle < triangulation.triangle_count; triangle++) {
        mt_ray_triangle loaded;
        mt_ray_triangle_load(&space, mesh, &triangulation, triangle, MT_RAY_WATERTIGHT, &loaded);
        for (int i = 0; i < 9; i++) {
            volatile float rounded = (float)loaded.corners[i / 3][i % 3];
            assert_true((double)rounded == loaded.corners[i / 3][i % 3]);
        }
    }
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(loaded_corners_are_floats)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
