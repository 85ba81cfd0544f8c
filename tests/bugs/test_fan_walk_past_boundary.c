/* The walk around a vertex went on after it had met a boundary side, if corners of the vertex were still to be met: at
 * the next vertex of the face, and on from there. Where it came to a side a = b, which has no other side, it read
 * before the start of an array, and check-manifold crashed. Needed are an open and a closed fan at one vertex (0
 * below), and near it a face with a repeated vertex. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/manifold.h>

static void test_walk_ends_at_the_boundary(void **state)
{
    (void)state;
    static const double positions[] = {0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0, 3, 0, 3, 3, 1, 3, 2, 2, 0};
    static const mt_index faces[] = {3, 0, 1, 2, 4, 0, 2, 6, 3, 3, 0, 3, 1, 3, 0, 4, 5, 3, 4, 4, 5, 3, 1, 2, 6};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, positions, 6, faces);
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.defect_counts[MT_DEFECT_NON_MANIFOLD_VERTEX], 1);
    assert_int_equal(report.defect_counts[MT_DEFECT_DEGENERATE_FACE], 1);
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_walk_ends_at_the_boundary)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
