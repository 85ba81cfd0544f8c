/* Self-intersection: the cases of the definition one by one, their invariance under scaling and threads. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/aabb_tree.h>
#include <meshtool/generate.h>
#include <meshtool/self_intersection.h>

#include <string.h>

static uint64_t count_pairs(mt_context *context, const mt_mesh *mesh)
{
    mt_self_intersections found;
    assert_int_equal(mt_find_self_intersections(context, mesh, NULL, &found), MT_OK);
    uint64_t count = found.pair_count;
    mt_self_intersections_release(context, &found);
    return count;
}

/* Two triangles on six places; `second` names the second's vertices. */
static uint64_t pairs_of_two(const double positions[18], mt_index a, mt_index b, mt_index c)
{
    mt_context *context = test_context();
    const mt_index faces[] = {3, 0, 1, 2, 3, a, b, c};
    mt_mesh *mesh = test_mesh(context, 6, positions, 2, faces);
    uint64_t count = count_pairs(context, mesh);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return count;
}

static void triangles_that_share_nothing_intersect_at_any_contact(void **state)
{
    (void)state;
    const double crossing[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 5, 5, 1};
    assert_int_equal(pairs_of_two(crossing, 3, 4, 5), 1);
    const double touching[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 1, 1, 1, 5, 5, 1};
    assert_int_equal(pairs_of_two(touching, 3, 4, 5), 1);
    const double corner_on_corner[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0, 0, -1, 0, 1, 0, -1, 1};
    assert_int_equal(pairs_of_two(corner_on_corner, 3, 4, 5), 1);
    const double apart[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1e-300, 1, 1, 1, 5, 5, 1};
    assert_int_equal(pairs_of_two(apart, 3, 4, 5), 0);
    const double inside[] = {0, 0, 0, 9, 0, 0, 0, 9, 0, 1, 1, 0, 2, 1, 0, 1, 2, 0};
    assert_int_equal(pairs_of_two(inside, 3, 4, 5), 1);
    const double beside[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 5, 5, 0, 6, 5, 0, 5, 6, 0};
    assert_int_equal(pairs_of_two(beside, 3, 4, 5), 0);
}

static void triangles_that_share_a_vertex_intersect_by_an_opposite_edge(void **state)
{
    (void)state;
    const double clean[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, -1, -1, 0, -1, -2, 1, 0, 0, 0};
    assert_int_equal(pairs_of_two(clean, 0, 3, 4), 0);
    const double through[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 0, 0, 0};
    assert_int_equal(pairs_of_two(through, 0, 3, 4), 1);
    const double overlapping[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, -1, 3, 0, 0, 0, 0};
    assert_int_equal(pairs_of_two(overlapping, 0, 3, 4), 1);
    const double along_an_edge[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 2, 0, 0, 2, -1, 1, 0, 0, 0};
    assert_int_equal(pairs_of_two(along_an_edge, 0, 3, 4), 1);
}

static void triangles_that_share_an_edge_intersect_when_folded_flat(void **state)
{
    (void)state;
    const double folded[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0};
    assert_int_equal(pairs_of_two(folded, 1, 0, 3), 1);
    const double unfolded[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, -1, 0, 0, 0, 0, 0, 0, 0};
    assert_int_equal(pairs_of_two(unfolded, 1, 0, 3), 0);
    const double sharp[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1e-200, 0, 0, 0, 0, 0, 0};
    assert_int_equal(pairs_of_two(sharp, 1, 0, 3), 0);
}

#define STAR_TRIANGLES_MAXIMUM 16

/* Rim vertices 1 to the count around vertex 0, each 45, 90 or 135 degrees after the one before, which close after one
 * turn or two; at any height, seen along any axis from either side. Returns how many. */
static mt_index random_star(test_random *random, double positions[3 * (STAR_TRIANGLES_MAXIMUM + 1)])
{
    static const int compass[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    uint64_t turns = 1 + test_random_below(random, 2), axis = test_random_below(random, 3);
    int flip = test_random_below(random, 2) ? 1 : -1;
    mt_index count = 0;
    memset(positions, 0, 3 * sizeof *positions);
    for (uint64_t at = 0; at < 8 * turns; at += 1 + test_random_below(random, 3)) {
        double *to = positions + 3 * (size_t)++count;
        int radius = 1 + (int)test_random_below(random, 3);
        to[(axis + 1) % 3] = radius * compass[at % 8][0];
        to[(axis + 2) % 3] = flip * radius * compass[at % 8][1];
        to[axis] = (double)test_random_below(random, 5) - 2;
    }
    return count;
}

/* Alone, two triangles make no closed star: their verdict comes from the exact test. */
static uint64_t pairs_by_twos(mt_context *context, mt_index count, const double *positions, const mt_index *faces)
{
    uint64_t pairs = 0;
    for (mt_index i = 0; i < count; i++) {
        for (mt_index j = 0; j < i; j++) {
            mt_index two[8];
            memcpy(two, faces + 4 * (size_t)i, 4 * sizeof *two);
            memcpy(two + 4, faces + 4 * (size_t)j, 4 * sizeof *two);
            mt_mesh *mesh = test_mesh(context, count + 1, positions, 2, two);
            pairs += count_pairs(context, mesh);
            mt_mesh_destroy(context, mesh);
        }
    }
    return pairs;
}

static void stars_that_wind_once_or_twice_intersect_where_their_pairs_do(void **state)
{
    (void)state;
    test_random random = {19};
    uint64_t clean = 0, crossed = 0;
    for (int round = 0; round < 500; round++) {
        mt_context *context = test_context_with_threads(1);
        double positions[3 * (STAR_TRIANGLES_MAXIMUM + 1)];
        mt_index faces[4 * STAR_TRIANGLES_MAXIMUM], count = random_star(&random, positions);
        for (mt_index i = 0; i < count; i++) {
            const mt_index face[] = {3, 0, 1 + i, 1 + (i + 1) % count};
            memcpy(faces + 4 * (size_t)i, face, sizeof face);
        }
        mt_mesh *mesh = test_mesh(context, count + 1, positions, count, faces);
        uint64_t expected = pairs_by_twos(context, count, positions, faces);
        assert_int_equal(count_pairs(context, mesh), expected);
        clean += expected == 0;
        crossed += expected > 0;
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(clean > 50 && crossed > 50);
}

static void duplicates_zero_areas_and_poisoned_triangles_take_no_part(void **state)
{
    (void)state;
    const double any[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 1, 1, 3};
    assert_int_equal(pairs_of_two(any, 2, 1, 0), 0);
    assert_int_equal(pairs_of_two(any, 3, 4, 5), 0);
    const double poisoned[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, NAN, 5, 1};
    assert_int_equal(pairs_of_two(poisoned, 3, 4, 5), 0);
}

static mt_mesh *random_soup(mt_context *context, test_random *random, mt_index vertices, mt_index triangles,
                            uint64_t grid)
{
    double positions[3 * 256];
    mt_index faces[4 * 256];
    for (mt_index i = 0; i < 3 * vertices; i++) {
        positions[i] = (double)test_random_below(random, grid);
    }
    for (mt_index face = 0; face < triangles; face++) {
        mt_index *to = faces + 4 * (size_t)face;
        to[0] = 3;
        for (int side = 1; side < 4; side++) {
            to[side] = (mt_index)test_random_below(random, vertices);
        }
    }
    return test_mesh(context, vertices, positions, triangles, faces);
}

static void pairs_do_not_depend_on_size_or_threads(void **state)
{
    (void)state;
    test_random random = {7};
    for (int round = 0; round < 50; round++) {
        mt_context *context = test_context_with_threads(1), *others = test_context_with_threads(7);
        mt_mesh *mesh = random_soup(context, &random, 60, 120, 12);
        mt_self_intersections plain, scaled;
        assert_int_equal(mt_find_self_intersections(context, mesh, NULL, &plain), MT_OK);
        const double scales[] = {0x1p-1000, 0x1p-500, 1, 0x1p900};
        double *numbers = mesh->positions;
        for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
            numbers[i] *= scales[round % 4];
        }
        assert_int_equal(mt_find_self_intersections(others, mesh, NULL, &scaled), MT_OK);
        assert_int_equal(plain.pair_count, scaled.pair_count);
        assert_memory_equal(plain.pairs, scaled.pairs, plain.pair_count * sizeof *plain.pairs);
        assert_true(plain.pair_count > 0);
        mt_self_intersections_release(others, &scaled);
        mt_self_intersections_release(context, &plain);
        mt_mesh_destroy(context, mesh);
        test_context_end(others);
        test_context_end(context);
    }
}

typedef struct pair_table {
    uint8_t seen[256][256];
} pair_table;

static bool mark_pairs(void *user, mt_index task, const mt_primitive_pair *pairs, size_t count)
{
    (void)task;
    pair_table *table = user;
    for (size_t i = 0; i < count; i++) {
        table->seen[pairs[i].a][pairs[i].b]++;
        table->seen[pairs[i].b][pairs[i].a]++;
    }
    return true;
}

static bool boxes_overlap(const mt_aabb_primitive *a, const mt_aabb_primitive *b)
{
    for (int axis = 0; axis < 3; axis++) {
        if (a->lower[axis] > b->upper[axis] || b->lower[axis] > a->upper[axis]) {
            return false;
        }
    }
    return true;
}

static bool keys_meet(const mt_index *a, const mt_index *b)
{
    bool meet = false;
    for (int i = 0; i < 9; i++) {
        meet |= a[i / 3] == b[i % 3] && a[i / 3] != MT_NONE;
    }
    return meet;
}

/* Half of all keys are missing; the fourth is noise. */
static void fill_keys(test_random *random, mt_index count, mt_index *keys)
{
    for (mt_index i = 0; i < 4 * count; i++) {
        keys[i] = test_random_below(random, 2) ? MT_NONE : (mt_index)test_random_below(random, 12);
    }
}

static void the_tree_gives_every_overlapping_pair_without_a_common_key_once(void **state)
{
    (void)state;
    test_random random = {3};
    static pair_table table;
    for (int round = 0; round < 50; round++) {
        mt_context *context = test_context_with_threads(1);
        mt_mesh *mesh = random_soup(context, &random, 200, 250, 1 + (uint64_t)(round * round) * 40);
        mt_triangulation triangulation;
        mt_aabb_tree *tree;
        assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
        assert_int_equal(mt_aabb_tree_create(context, mesh, &triangulation, NULL, &tree), MT_OK);
        assert_int_equal(mt_aabb_tree_validate(context, tree), MT_OK);
        assert_int_equal(tree->primitive_count, 250);
        memset(&table, 0, sizeof table);
        mt_index keys[4 * 250];
        fill_keys(&random, 250, keys);
        bool keyed = round % 2;
        assert_int_equal(mt_aabb_tree_self_pairs(context, tree, keyed ? keys : NULL, mark_pairs, &table), MT_OK);
        for (mt_index i = 0; i < 250; i++) {
            for (mt_index j = 0; j < 250; j++) {
                const mt_aabb_primitive *a = &tree->primitives[i], *b = &tree->primitives[j];
                bool left_out = keyed && keys_meet(keys + 4 * (size_t)i, keys + 4 * (size_t)j);
                bool expected = i != j && boxes_overlap(a, b) && !left_out;
                assert_int_equal(table.seen[a->number][b->number], expected);
            }
        }
        mt_aabb_tree_destroy(context, tree);
        mt_triangulation_release(context, &triangulation);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* 100,000 triangles in one place and a cluster 1e-30 wide: neither endless cuts nor a deep tree. */
static void identical_centroids_are_cut_all_the_same(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh_layout layout = {.vertex_count = 3, .face_count = 100000, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    mt_mesh_set_position(mesh, 0, mt_vec3_make(1, 0, 0));
    mt_mesh_set_position(mesh, 1, mt_vec3_make(1, 1e-30, 0));
    mt_mesh_set_position(mesh, 2, mt_vec3_make(1, 0, 1e-30));
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mesh->corner_vertices[corner] = corner % 3;
    }
    mt_triangulation triangulation;
    mt_aabb_tree *tree;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(mt_aabb_tree_create(context, mesh, &triangulation, NULL, &tree), MT_OK);
    assert_int_equal(mt_aabb_tree_validate(context, tree), MT_OK);
    mt_aabb_tree_destroy(context, tree);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void an_empty_mesh_has_none(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh_layout layout = {.face_size = 3, .position_type = MT_F32};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    assert_int_equal(count_pairs(context, mesh), 0);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void each_failing_allocation_is_clean(void **state)
{
    (void)state;
    mt_context *makers = test_context();
    test_random random = {11};
    mt_mesh *mesh = random_soup(makers, &random, 60, 120, 12);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        mt_self_intersections found;
        status = mt_find_self_intersections(context, mesh, NULL, &found);
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(status, mt_context_error(context)->status);
        mt_self_intersections_release(context, &found);
        test_context_end(context);
    }
    mt_mesh_destroy(makers, mesh);
    test_context_end(makers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_that_share_nothing_intersect_at_any_contact),
        cmocka_unit_test(triangles_that_share_a_vertex_intersect_by_an_opposite_edge),
        cmocka_unit_test(triangles_that_share_an_edge_intersect_when_folded_flat),
        cmocka_unit_test(stars_that_wind_once_or_twice_intersect_where_their_pairs_do),
        cmocka_unit_test(duplicates_zero_areas_and_poisoned_triangles_take_no_part),
        cmocka_unit_test(pairs_do_not_depend_on_size_or_threads),
        cmocka_unit_test(the_tree_gives_every_overlapping_pair_without_a_common_key_once),
        cmocka_unit_test(identical_centroids_are_cut_all_the_same),
        cmocka_unit_test(an_empty_mesh_has_none),
        cmocka_unit_test(each_failing_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
