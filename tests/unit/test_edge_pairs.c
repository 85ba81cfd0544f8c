/* Edge pairs against their definition, on thousands of broken soups, and on shapes that could make it slow. */
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/edge_pairs.h>

#include <stdlib.h>
#include <string.h>

static mt_index head_of(const mt_mesh *mesh, mt_index face, mt_index corner)
{
    mt_index next = corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
    return mesh->corner_vertices[next];
}

/* Per corner the ends of its side, straight from the faces. */
typedef struct side {
    mt_index from, to;
} side;

static side *list_sides(const mt_mesh *mesh)
{
    side *sides = malloc((mesh->corner_count + (size_t)1) * sizeof *sides);
    assert_non_null(sides);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            sides[c] = (side){mesh->corner_vertices[c], head_of(mesh, face, c)};
        }
    }
    return sides;
}

static bool same_edge(side a, side b)
{
    return (a.from == b.from && a.to == b.to) || (a.from == b.to && a.to == b.from);
}

/* Compares one corner with all others, as the header defines it. Returns its class. */
static mt_edge_class expect_corner(const mt_mesh *mesh, const mt_edge_pairs *pairs, const side *sides, mt_index c)
{
    if (sides[c].from == sides[c].to) {
        assert_int_equal(pairs->next_side[c], MT_NONE);
        assert_false(mt_edge_is_first(pairs, c));
        return MT_EDGE_NONE;
    }
    mt_index before = MT_NONE, first = MT_NONE, last = MT_NONE, other = MT_NONE, count = 0;
    for (mt_index d = 0; d < mesh->corner_count; d++) {
        if (same_edge(sides[c], sides[d])) {
            count++;
            first = first == MT_NONE ? d : first;
            last = d;
            before = d < c ? d : before;
            other = d != c ? d : other;
        }
    }
    assert_int_equal(pairs->next_side[c], before == MT_NONE ? last : before);
    assert_int_equal(mt_edge_is_first(pairs, c), first == c);
    if (count <= 2) {
        bool turned = count == 2 && sides[c].from == sides[other].from;
        assert_int_equal(mt_edge_twin(mesh, pairs, c), count == 2 && !turned ? other : MT_NONE);
        return count == 1 ? MT_EDGE_BOUNDARY : turned ? MT_EDGE_MISORIENTED : MT_EDGE_REGULAR;
    }
    assert_int_equal(mt_edge_twin(mesh, pairs, c), MT_NONE);
    return MT_EDGE_NON_MANIFOLD;
}

static void expect_definition(mt_context *context, const mt_mesh *mesh)
{
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    side *sides = list_sides(mesh);
    mt_index edges[5] = {0};
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_edge_class expected = expect_corner(mesh, pairs, sides, c);
        assert_int_equal(mt_edge_class_of(mesh, pairs, c), expected);
        edges[expected] += expected == MT_EDGE_NONE || mt_edge_is_first(pairs, c);
    }
    assert_int_equal(pairs->corner_count, mesh->corner_count);
    assert_int_equal(pairs->degenerate_side_count, edges[MT_EDGE_NONE]);
    assert_int_equal(pairs->boundary_count, edges[MT_EDGE_BOUNDARY]);
    assert_int_equal(pairs->regular_count, edges[MT_EDGE_REGULAR]);
    assert_int_equal(pairs->misoriented_count, edges[MT_EDGE_MISORIENTED]);
    assert_int_equal(pairs->non_manifold_count, edges[MT_EDGE_NON_MANIFOLD]);
    assert_int_equal(pairs->edge_count, edges[1] + edges[2] + edges[3] + edges[4]);
    free(sides);
    mt_edge_pairs_destroy(context, pairs);
}

/* One thread pairs by chains, many by ranges. */
static void expect_soups(unsigned threads)
{
    mt_context *context = test_context_with_threads(threads);
    test_random random = {20240501};
    for (int i = 0; i < 4000; i++) {
        mt_mesh *mesh = i % 2 ? test_soup(context, &random) : test_patch(context, &random);
        expect_definition(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void soups_follow_the_definition(void **state)
{
    (void)state;
    expect_soups(1);
    expect_soups(7);
}

static void an_empty_mesh_has_no_edges(void **state)
{
    (void)state;
    mt_context *context = test_context();
    double point[3] = {1, 2, 3};
    mt_mesh *mesh = test_mesh(context, 0, point, 0, NULL);
    expect_definition(context, mesh);
    mt_mesh_destroy(context, mesh);
    mesh = test_mesh(context, 1, point, 0, NULL);
    expect_definition(context, mesh);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A bucket past the size up to which sides are compared one by one, with edges of every class in it. */
static void long_buckets_follow_the_definition(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(7);
    test_random random = {11};
    for (mt_index size = 10; size < 200; size += 7) {
        mt_mesh *mesh = test_fan(context, size, size % 2);
        for (mt_index i = 0; i < size / 8; i++) {
            mt_index corner = (mt_index)test_random_below(&random, mesh->corner_count);
            mesh->corner_vertices[corner] = (mt_index)test_random_below(&random, mesh->vertex_count);
            mt_index *turned = mesh->corner_vertices + 3 * test_random_below(&random, mesh->face_count);
            mt_index first = turned[0];
            turned[0] = turned[1];
            turned[1] = first;
        }
        expect_definition(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void a_vertex_of_a_million_edges_is_fast(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 1000000, true);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    assert_int_equal(pairs->regular_count, 1000000);
    assert_int_equal(pairs->boundary_count, 1000000);
    assert_int_equal(pairs->edge_count, 2000000);
    mt_edge_pairs_destroy(context, pairs);
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mesh->corner_vertices[c] = c % 3;
    }
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    assert_int_equal(pairs->non_manifold_count, 3);
    assert_int_equal(pairs->edge_count, 3);
    assert_int_equal(pairs->next_side[3], 0);
    assert_int_equal(pairs->next_side[2], mesh->corner_count - 1);
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void pair_and_hash(unsigned threads, bool shuffled, uint64_t *hash, mt_edge_pairs *counts)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 501, 300, shuffled);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    *hash = test_hash(pairs->next_side, pairs->corner_count * sizeof *pairs->next_side);
    *counts = *pairs;
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        assert_int_equal(mt_edge_class_of(mesh, pairs, c), MT_EDGE_REGULAR);
        assert_int_equal(mt_edge_twin(mesh, pairs, mt_edge_twin(mesh, pairs, c)), c);
    }
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void threads_change_nothing(void **state)
{
    (void)state;
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        uint64_t one, many;
        mt_edge_pairs counts;
        pair_and_hash(1, shuffled, &one, &counts);
        assert_int_equal(counts.edge_count, 3 * 501 * 300);
        assert_int_equal(counts.regular_count, counts.edge_count);
        for (unsigned threads = 2; threads <= 7; threads += 5) {
            pair_and_hash(threads, shuffled, &many, &counts);
            assert_true(one == many);
        }
    }
}

static void expect_clean_failures(unsigned threads)
{
    bool done = false;
    for (uint64_t nth = 1; !done; nth++) {
        mt_context *maker = test_context();
        mt_mesh *mesh = test_torus(maker, 30, 20, true);
        mt_context_options options = {.failing_allocation = nth, .thread_count = threads};
        mt_context *context = mt_context_create(&options);
        mt_edge_pairs *pairs = NULL;
        mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
        done = status == MT_OK;
        if (!done) {
            assert_int_equal(status, MT_ERROR_OUT_OF_MEMORY);
            assert_int_equal(mt_context_error(context)->status, MT_ERROR_OUT_OF_MEMORY);
            assert_null(pairs);
        }
        mt_edge_pairs_destroy(context, pairs);
        test_context_end(context);
        mt_mesh_destroy(maker, mesh);
        test_context_end(maker);
        assert_true(nth < 100);
    }
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    expect_clean_failures(1);
    expect_clean_failures(7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soups_follow_the_definition),
        cmocka_unit_test(an_empty_mesh_has_no_edges),
        cmocka_unit_test(long_buckets_follow_the_definition),
        cmocka_unit_test(a_vertex_of_a_million_edges_is_fast),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
