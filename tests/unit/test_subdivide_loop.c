/* Loop's masks and what follows from them for every mesh of triangles. What it carries besides positions is in
 * tests/unit/test_subdivide_loop_carriage.c, the comparison with other programs in tests/oracle. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, unsigned level_count)
{
    mt_subdivide_options options = {.level_count = level_count, .scheme = MT_SUBDIVIDE_SCHEME_LOOP};
    mt_mesh *refined = NULL;
    if (mt_subdivide(context, mesh, &options, &refined) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

static void expect_position(const mt_mesh *mesh, mt_index vertex, double x, double y, double z)
{
    mt_vec3 p = mt_mesh_position(mesh, vertex);
    double error = mt_vec3_max_abs(mt_vec3_subtract(p, mt_vec3_make(x, y, z)));
    if (!(error <= 1e-15)) {
        fail_msg("vertex %u is at %.17g %.17g %.17g and not at %.17g %.17g %.17g", vertex, p.x, p.y, p.z, x, y, z);
    }
}

static void expect_same_bits(const mt_mesh *a, mt_index i, const mt_mesh *b, mt_index j)
{
    mt_vec3 p = mt_mesh_position(a, i), q = mt_mesh_position(b, j);
    if (memcmp(&p, &q, sizeof p) != 0) {
        fail_msg("vertex %u at %.17g %.17g %.17g is not %u at %.17g %.17g %.17g", i, p.x, p.y, p.z, j, q.x, q.y, q.z);
    }
}

/* Valence 3 has the weight (5/8 - 1/16)/3 = 3/16; around the origin, where the four corners add up to 0, a corner goes
 * to (1 - 3 * 3/16 - 3/16) = 1/4 of itself, and an edge point to (3/8 - 1/8) of the sum of its ends. */
static void test_tetrahedron_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1};
    static const mt_index faces[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3};
    mt_mesh *mesh = test_mesh(context, 4, positions, 4, faces);
    mt_mesh *refined = subdivide(context, mesh, 1);
    assert_int_equal(refined->vertex_count, 4 + 6);
    assert_int_equal(refined->face_count, 16);
    assert_int_equal(refined->face_size, 3);
    for (mt_index i = 0; i < 4; i++) {
        const double *p = positions + 3 * (size_t)i;
        expect_position(refined, i, p[0] / 4, p[1] / 4, p[2] / 4);
    }
    expect_position(refined, 4, 0, 0.5, 0);  /* 0-2 */
    expect_position(refined, 5, -0.5, 0, 0); /* 2-1 */
    expect_position(refined, 6, 0, 0, 0.5);  /* 1-0 */
    expect_position(refined, 9, 0, 0, -0.5); /* 2-3, whose first corner is in the third face */
    static const mt_index first[] = {0, 4, 6, 4, 2, 5, 6, 5, 1, 4, 5, 6};
    assert_memory_equal(refined->corner_vertices, first, sizeof first);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A lone triangle: its outline is a cubic B-spline curve. */
static void test_triangle_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 8, 0, 0, 0, 8, 16, 9, 9, 9};
    static const mt_index faces[] = {3, 0, 1, 2};
    mt_mesh *mesh = test_mesh(context, 4, positions, 1, faces);
    mt_mesh *refined = subdivide(context, mesh, 1);
    assert_int_equal(refined->vertex_count, 7);
    assert_int_equal(refined->face_count, 4);
    expect_position(refined, 0, 1, 1, 2);
    expect_position(refined, 1, 6, 1, 2);
    expect_position(refined, 2, 1, 6, 12);
    expect_position(refined, 3, 9, 9, 9); /* in no face: stays */
    expect_position(refined, 4, 4, 0, 0);
    expect_position(refined, 5, 4, 4, 8);
    expect_position(refined, 6, 0, 4, 8);
    mt_mesh_destroy(context, refined);
    static const mt_index none[] = {0};
    mt_mesh *empty = test_mesh(context, 1, positions + 9, 0, none);
    refined = subdivide(context, empty, 3);
    assert_int_equal(refined->face_count, 0);
    expect_position(refined, 0, 9, 9, 9);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, empty);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* The weights by Loop's formula in long double, with the machine's cosine; 10/16 and 1/16 for six exactly. */
static void test_valence(void **state)
{
    (void)state;
    static const mt_index valences[] = {3, 4, 5, 6, 7, 50, 1000, 100000};
    mt_context *context = test_context();
    for (unsigned i = 0; i < sizeof valences / sizeof *valences; i++) {
        mt_index n = valences[i];
        mt_mesh *fan = test_fan(context, n, true);
        mt_vec3 hub = mt_mesh_position(fan, 0);
        long double sum = 0;
        for (mt_index corner = 0; corner < fan->corner_count; corner++) {
            sum += (long double)mt_mesh_position(fan, fan->corner_vertices[corner]).x;
        }
        sum = (sum - n * (long double)hub.x) / 2; /* each rim vertex lies in two faces */
        long double root = 0.375L + cosl(2 * acosl(-1) / n) / 4, weight = (0.625L - root * root) / n;
        long double expected = n == 6 ? (10 * (long double)hub.x + sum) / 16 : (1 - n * weight) * hub.x + weight * sum;
        mt_mesh *refined = subdivide(context, fan, 1);
        double error = fabs(mt_mesh_position(refined, 0).x - (double)expected);
        if (!(error <= (n == 6 ? 0 : 1e-15) * fmax(1, fabs(hub.x)) || error <= 4e-16)) {
            fail_msg("valence %u: off by %g", n, error);
        }
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, fan);
    }
    test_context_end(context);
}

/* The order that scripts rely on: old vertices, edge points by the first corner of the edge; of each face the triangles
 * at its corners, and the one in the middle. */
static void expect_order(mt_context *context, const mt_mesh *mesh, const mt_mesh *refined)
{
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    mt_index *point_of = malloc(mesh->corner_count * sizeof *point_of + 1);
    assert_non_null(point_of);
    mt_index used = mesh->vertex_count;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        point_of[corner] = mt_edge_is_first(pairs, corner) ? used++ : point_of[pairs->next_side[corner]];
    }
    assert_int_equal(refined->vertex_count, used);
    assert_int_equal(refined->face_count, 4 * mesh->face_count);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_index *children = refined->corner_vertices + 12 * (size_t)face;
        for (mt_index i = 0; i < 3; i++) {
            mt_index after = (i + 1) % 3, before = (i + 2) % 3;
            assert_int_equal(children[3 * i + i], mesh->corner_vertices[3 * face + i]);
            assert_int_equal(children[3 * i + after], point_of[3 * face + i]);
            assert_int_equal(children[3 * i + before], point_of[3 * face + before]);
            assert_int_equal(children[9 + i], point_of[3 * face + i]);
        }
    }
    free(point_of);
    mt_edge_pairs_destroy(context, pairs);
}

typedef void (*cage_check)(mt_context *context, test_random *random, mt_mesh *cage);

/* Runs a check on many cages, open and closed. */
static void on_cages(unsigned count, cage_check check)
{
    test_random random = {21};
    mt_context *context = test_context();
    for (unsigned i = 0; i < count; i++) {
        mt_index columns = 3 + (mt_index)test_random_below(&random, 5);
        mt_index rows = 3 + (mt_index)test_random_below(&random, 5);
        mt_mesh *cage = test_triangle_cage(context, &random, columns, rows, i % 2 == 0);
        check(context, &random, cage);
        mt_mesh_destroy(context, cage);
    }
    test_context_end(context);
}

static void check_order(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    mt_mesh *mesh = subdivide(context, cage, 1);
    expect_order(context, cage, mesh);
    for (unsigned level = 2; level <= 4; level++) {
        mt_mesh *at_once = subdivide(context, cage, level), *again = subdivide(context, mesh, 1);
        expect_order(context, mesh, at_once);
        assert_int_equal(test_mesh_hash(at_once), test_mesh_hash(again));
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mesh);
        mesh = at_once;
    }
    mt_mesh_destroy(context, mesh);
}

static void test_order_and_levels(void **state)
{
    (void)state;
    on_cages(20, check_order);
}

static void check_counts(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, cage, &pairs), MT_OK);
    int64_t euler = (int64_t)cage->vertex_count + cage->face_count - pairs->edge_count;
    uint64_t vertices = cage->vertex_count, edges = pairs->edge_count, faces = cage->face_count;
    for (unsigned level = 1; level <= 4; level++) {
        vertices += edges;
        edges = 2 * edges + 3 * faces;
        faces *= 4;
        mt_subdivide_options options = {.level_count = level, .scheme = MT_SUBDIVIDE_SCHEME_LOOP};
        mt_subdivide_counts counts;
        assert_int_equal(mt_subdivide_count(context, cage, pairs, &options, level, &counts), MT_OK);
        mt_mesh *refined = subdivide(context, cage, level);
        mt_edge_pairs *refined_pairs = NULL;
        assert_int_equal(mt_edge_pairs_create(context, refined, &refined_pairs), MT_OK);
        assert_true(counts.vertex_count == vertices && refined->vertex_count == vertices);
        assert_true(counts.face_count == faces && refined->face_count == faces);
        assert_true(counts.corner_count == 3 * faces && refined->corner_count == 3 * faces);
        assert_true(counts.edge_count == edges && refined_pairs->edge_count == edges);
        assert_int_equal((int64_t)refined->vertex_count + refined->face_count - refined_pairs->edge_count, euler);
        assert_int_equal(refined_pairs->boundary_count, (uint64_t)pairs->boundary_count << level);
        assert_int_equal(refined_pairs->non_manifold_count + refined_pairs->misoriented_count, 0);
        mt_edge_pairs_destroy(context, refined_pairs);
        mt_mesh_destroy(context, refined);
    }
    mt_edge_pairs_destroy(context, pairs);
}

static void test_counts_and_euler(void **state)
{
    (void)state;
    on_cages(12, check_counts);
}

/* Weights sum to one to the last bit: a cage in one point stays there. */
static void check_unity(mt_context *context, test_random *random, mt_mesh *cage)
{
    mt_vec3 point = {test_random_unit(random), -1e7 * test_random_unit(random), 1e-150 * test_random_unit(random)};
    for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
        mt_mesh_set_position(cage, vertex, point);
    }
    test_sharpen(context, random, cage);
    mt_mesh *refined = subdivide(context, cage, 3);
    for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
        expect_same_bits(refined, vertex, cage, 0);
    }
    mt_mesh_destroy(context, refined);
}

static void test_partition_of_unity(void **state)
{
    (void)state;
    on_cages(30, check_unity);
}

static mt_vec3 shear(mt_vec3 p)
{
    return mt_vec3_make(2 * p.x + 0.5 * p.y - p.z + 3, p.y - 0.25 * p.x - 7, 0.75 * p.z + p.x * 0.125 + 1);
}

static void check_affine(mt_context *context, test_random *random, mt_mesh *cage)
{
    test_sharpen(context, random, cage);
    mt_mesh *refined = subdivide(context, cage, 2);
    for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
        mt_mesh_set_position(cage, vertex, shear(mt_mesh_position(cage, vertex)));
    }
    mt_mesh *sheared = subdivide(context, cage, 2);
    for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
        mt_vec3 expected = shear(mt_mesh_position(refined, vertex));
        mt_vec3 error = mt_vec3_subtract(mt_mesh_position(sheared, vertex), expected);
        assert_true(mt_vec3_max_abs(error) < 1e-13);
    }
    mt_mesh_destroy(context, sheared);
    mt_mesh_destroy(context, refined);
}

static void test_affine_invariance(void **state)
{
    (void)state;
    on_cages(10, check_affine);
}

static void check_hull(mt_context *context, test_random *random, mt_mesh *cage)
{
    test_sharpen(context, random, cage);
    mt_mesh *refined = subdivide(context, cage, 3);
    test_expect_within_hull(random, cage, refined);
    mt_mesh_destroy(context, refined);
}

static void test_convex_hull(void **state)
{
    (void)state;
    on_cages(10, check_hull);
}

/* Renumbered, turned and reversed faces and mirrored positions: the same numbers to the last bit, mirrored. */
static void check_symmetry(mt_context *context, test_random *random, mt_mesh *cage)
{
    mt_index *images = malloc(cage->corner_count * sizeof *images);
    assert_non_null(images);
    for (int reverse = 0; reverse < 2; reverse++) {
        mt_mesh *copy = test_renumbered(context, random, cage, reverse, images);
        for (mt_index vertex = 0; reverse && vertex < copy->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(copy, vertex);
            mt_mesh_set_position(copy, vertex, mt_vec3_make(-p.x, p.y, p.z));
        }
        mt_mesh *refined = subdivide(context, cage, 1), *other = subdivide(context, copy, 1);
        for (mt_index vertex = 0; reverse && vertex < other->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(other, vertex);
            mt_mesh_set_position(other, vertex, mt_vec3_make(-p.x, p.y, p.z));
        }
        for (mt_index corner = 0; corner < cage->corner_count; corner++) {
            mt_index ours = 4 * corner, theirs = 4 * images[corner];
            for (mt_index k = 0; k < 3; k++) {
                mt_index a = ours - ours % 3 + (ours + k) % 3;
                mt_index b = theirs - theirs % 3 + (theirs + (reverse ? 3 - k : k)) % 3;
                expect_same_bits(refined, refined->corner_vertices[a], other, other->corner_vertices[b]);
            }
        }
        mt_mesh_destroy(context, other);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, copy);
    }
    free(images);
}

static void test_renumbering_and_mirrors(void **state)
{
    (void)state;
    on_cages(60, check_symmetry);
}

/* In single precision each level rounds once. */
static void check_precision(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    mt_mesh *narrow = NULL;
    assert_int_equal(mt_mesh_copy(context, cage, &narrow), MT_OK);
    assert_int_equal(mt_mesh_set_position_type(context, narrow, MT_F32, NULL), MT_OK);
    mt_mesh *wide = subdivide(context, cage, 3), *refined = subdivide(context, narrow, 3);
    assert_int_equal(refined->position_type, MT_F32);
    for (mt_index vertex = 0; vertex < wide->vertex_count; vertex++) {
        mt_vec3 error = mt_vec3_subtract(mt_mesh_position(wide, vertex), mt_mesh_position(refined, vertex));
        assert_true(mt_vec3_max_abs(error) < 2e-6);
    }
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, wide);
    mt_mesh_destroy(context, narrow);
}

static void test_both_precisions(void **state)
{
    (void)state;
    on_cages(10, check_precision);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tetrahedron_by_hand),
        cmocka_unit_test(test_triangle_by_hand),
        cmocka_unit_test(test_valence),
        cmocka_unit_test(test_order_and_levels),
        cmocka_unit_test(test_counts_and_euler),
        cmocka_unit_test(test_partition_of_unity),
        cmocka_unit_test(test_affine_invariance),
        cmocka_unit_test(test_convex_hull),
        cmocka_unit_test(test_renumbering_and_mirrors),
        cmocka_unit_test(test_both_precisions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
