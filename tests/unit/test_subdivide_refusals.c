/* What subdivision refuses, by which message, and that it leaves nothing behind. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <stdlib.h>
#include <string.h>

static void expect_refusal(mt_index vertex_count, mt_index face_count, const mt_index *faces, mt_status status,
                           const char *beginning, const char *remedy)
{
    mt_context *context = test_context();
    double *positions = calloc(3 * (size_t)vertex_count, sizeof *positions);
    assert_non_null(positions);
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, face_count, faces);
    mt_mesh *refined = mesh;
    assert_int_equal(mt_subdivide(context, mesh, NULL, &refined), status);
    assert_null(refined);
    const char *message = mt_context_error(context)->message;
    if (strncmp(message, beginning, strlen(beginning)) != 0 || !strstr(message, remedy)) {
        fail_msg("\"%s\" does not begin with \"%s\" or name \"%s\"", message, beginning, remedy);
    }
    mt_mesh_destroy(context, mesh);
    free(positions);
    test_context_end(context);
}

static void test_non_manifold_edge(void **state)
{
    (void)state;
    static const mt_index book[] = {3, 5, 6, 7, 3, 0, 1, 2, 3, 1, 0, 3, 3, 0, 1, 4};
    expect_refusal(8, 4, book, MT_ERROR_NOT_MANIFOLD, "edge 0-1 is shared by 3 faces (1, 2, 3); ", "repair --split");
    static const mt_index doubled[] = {4, 0, 1, 2, 3, 3, 1, 0, 4, 4, 3, 2, 1, 0, 4, 2, 3, 0, 1};
    expect_refusal(5, 4, doubled, MT_ERROR_NOT_MANIFOLD, "edge 0-1 is shared by 4 faces (0, 1, 2, 3); ",
                   "repair --drop-duplicates");
    mt_index many[4 * 20];
    for (mt_index i = 0; i < 20; i++) {
        mt_index face[] = {3, 0, 1, 2 + i};
        memcpy(many + 4 * (size_t)i, face, sizeof face);
    }
    expect_refusal(22, 20, many, MT_ERROR_NOT_MANIFOLD, "edge 0-1 is shared by 20 faces (0, 1, 2, 3, 4, 5, ...); ",
                   "repair --split");
}

static void test_misoriented_edge(void **state)
{
    (void)state;
    static const mt_index turned[] = {3, 0, 1, 2, 4, 1, 2, 3, 4};
    expect_refusal(5, 2, turned, MT_ERROR_NOT_ORIENTED, "faces 0, 1 run along edge 1-2 in the same direction; ",
                   "`meshtool repair --orient` can turn faces");
    static const mt_index strip[] = {4, 0, 1, 4, 3, 4, 1, 2, 5, 4, 4, 2, 3, 0, 5};
    expect_refusal(6, 3, strip, MT_ERROR_NOT_ORIENTED, "faces ", "`meshtool repair --orient` cannot help");
}

static void test_degenerate_faces(void **state)
{
    (void)state;
    static const mt_index quad[] = {3, 0, 1, 2, 4, 3, 4, 3, 5};
    expect_refusal(6, 2, quad, MT_ERROR_NOT_MANIFOLD, "face 1 names vertex 3 more than once; ", "--drop-degenerate");
    static const mt_index slots[][4] = {{4, 4, 5, 6}, {5, 4, 4, 6}, {5, 6, 4, 4},
                                        {4, 5, 6, 4}, {4, 5, 4, 6}, {5, 4, 6, 4}};
    for (unsigned i = 0; i < 6; i++) {
        mt_index quads[] = {4, 0, 1, 2, 3, 4, slots[i][0], slots[i][1], slots[i][2], slots[i][3]};
        expect_refusal(7, 2, quads, MT_ERROR_NOT_MANIFOLD, "face 1 names vertex 4 more than once; ",
                       "--drop-degenerate");
    }
    static const mt_index side[] = {3, 0, 0, 1};
    expect_refusal(2, 1, side, MT_ERROR_NOT_MANIFOLD, "face 0 names vertex 0 more than once; ", "--drop-degenerate");
    static const mt_index large[] = {3, 0, 1, 2, 10, 3, 4, 5, 6, 7, 8, 9, 10, 11, 5, 4, 0, 12, 0, 13};
    expect_refusal(14, 3, large, MT_ERROR_NOT_MANIFOLD, "face 1 names vertex 5 more than once; ", "--drop-degenerate");
}

static void test_pinched_vertices(void **state)
{
    (void)state;
    static const mt_index bow_tie[] = {3, 3, 0, 1, 3, 0, 2, 4};
    expect_refusal(5, 2, bow_tie, MT_ERROR_NOT_MANIFOLD, "several fans of faces meet in vertex 0 alone", "--split");
    /* Two closed tetrahedra that share vertex 3. */
    static const mt_index cones[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3,
                                     3, 4, 6, 5, 3, 4, 5, 3, 3, 5, 6, 3, 3, 6, 4, 3};
    expect_refusal(7, 8, cones, MT_ERROR_NOT_MANIFOLD, "several fans of faces meet in vertex 3 alone", "--split");
    static const mt_index quads[] = {4, 3, 0, 1, 5, 4, 0, 2, 4, 6};
    expect_refusal(7, 2, quads, MT_ERROR_NOT_MANIFOLD, "several fans of faces meet in vertex 0 alone", "--split");
}

/* Whatever a soup holds: either it is refused, or it is refined to a mesh with the same Euler characteristic. */
static void test_soups(void **state)
{
    (void)state;
    test_random random = {77};
    unsigned refined_count = 0, refused_count = 0;
    for (unsigned i = 0; i < 4000; i++) {
        mt_context *context = test_context_with_threads(1);
        mt_mesh *mesh = i % 2 ? test_soup(context, &random) : test_patch(context, &random);
        mt_mesh *refined = NULL;
        mt_status status = mt_subdivide(context, mesh, NULL, &refined);
        if (status == MT_OK) {
            mt_edge_pairs *pairs = NULL;
            assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
            assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
            assert_int_equal(pairs->non_manifold_count + pairs->misoriented_count + pairs->degenerate_side_count, 0);
            assert_int_equal(refined->vertex_count, mesh->vertex_count + mesh->face_count + pairs->edge_count);
            mt_edge_pairs_destroy(context, pairs);
            assert_int_equal(refined->face_count, mesh->corner_count);
            refined_count++;
        } else {
            assert_true(status == MT_ERROR_NOT_MANIFOLD || status == MT_ERROR_NOT_ORIENTED);
            assert_null(refined);
            refused_count++;
        }
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(refined_count > 100);
    assert_true(refused_count > 100);
}

static void test_limits(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context), *refined = NULL;
    uint64_t before = mt_context_allocation_count(context);
    mt_subdivide_options options = {.level_count = 15};
    assert_int_equal(mt_subdivide(context, cube, &options, &refined), MT_ERROR_TOO_LARGE);
    assert_int_equal(mt_context_allocation_count(context), before);
    assert_non_null(strstr(mt_context_error(context)->message, "level 15 would have"));
    mt_context_clear_error(context);
    options.level_count = MT_SUBDIVIDE_LEVEL_LIMIT + 1;
    assert_int_equal(mt_subdivide(context, cube, &options, &refined), MT_ERROR_ARGUMENT);
    mt_context_clear_error(context);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, cube, &pairs), MT_OK);
    mt_subdivide_counts counts;
    assert_int_equal(mt_subdivide_count(context, cube, pairs, NULL, 13, &counts), MT_OK);
    assert_int_equal(counts.face_count, (uint64_t)6 << 26);
    assert_int_equal(counts.vertex_count, counts.face_count + 2);
    assert_int_equal(mt_subdivide_count(context, cube, pairs, NULL, 31, &counts), MT_ERROR_TOO_LARGE);
    assert_int_equal(counts.face_count, (uint64_t)1 << 62); /* 24 * 4^30 would be more: clamped */
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

static void test_memory_limit(void **state)
{
    (void)state;
    mt_context_options options = {.memory_limit = 1 << 20};
    mt_context *context = mt_context_create(&options);
    mt_mesh *cube = test_cube(context), *refined = NULL;
    mt_subdivide_options levels = {.level_count = 8};
    assert_int_equal(mt_subdivide(context, cube, &levels, &refined), MT_ERROR_OUT_OF_MEMORY);
    assert_null(refined);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

static bool stop_after(void *user, const char *task, double fraction)
{
    unsigned *calls = user;
    assert_string_equal(task, "subdividing");
    assert_true(fraction >= 0 && fraction <= 1);
    return (*calls)-- > 0;
}

static void test_cancelled(void **state)
{
    (void)state;
    for (unsigned allowed = 0;; allowed++) {
        unsigned calls = allowed;
        mt_context_options options = {.progress = stop_after, .progress_user = &calls};
        mt_context *context = mt_context_create(&options);
        mt_mesh *cube = test_cube(context), *refined = NULL;
        mt_subdivide_options levels = {.level_count = 3};
        mt_status status = mt_subdivide(context, cube, &levels, &refined);
        assert_true(status == MT_OK || status == MT_ERROR_CANCELLED);
        assert_int_equal(status == MT_OK, refined != NULL);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, cube);
        test_context_end(context);
        if (status == MT_OK) {
            assert_int_equal(allowed, 4); /* before each level, and at the end */
            return;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_non_manifold_edge),
        cmocka_unit_test(test_misoriented_edge),
        cmocka_unit_test(test_degenerate_faces),
        cmocka_unit_test(test_pinched_vertices),
        cmocka_unit_test(test_soups),
        cmocka_unit_test(test_limits),
        cmocka_unit_test(test_memory_limit),
        cmocka_unit_test(test_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
