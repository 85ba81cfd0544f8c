/* Catmull-Clark's masks and what follows from them for every mesh. The comparison with other programs is in
 * tests/oracle/test_subdivide.cpp. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, unsigned level_count)
{
    mt_subdivide_options options = {.level_count = level_count};
    mt_mesh *refined = NULL;
    mt_status status = mt_subdivide(context, mesh, &options, &refined);
    if (status != MT_OK) {
        print_message("%s\n", mt_context_error(context)->message);
    }
    assert_int_equal(status, MT_OK);
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

/* Computed by hand from the masks: (F + 2R)/3 at the corners, (a + b + f + g)/4 on the edges. */
static void test_cube_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    mt_mesh *refined = subdivide(context, cube, 1);
    assert_int_equal(refined->vertex_count, 26);
    assert_int_equal(refined->face_count, 24);
    assert_int_equal(refined->face_size, 4);
    for (mt_index i = 0; i < 8; i++) {
        mt_vec3 p = mt_mesh_position(cube, i);
        expect_position(refined, i, p.x * 5 / 9, p.y * 5 / 9, p.z * 5 / 9);
    }
    expect_position(refined, 8, 0, 0, -1);
    expect_position(refined, 13, 1, 0, 0);
    expect_position(refined, 14, -0.75, 0, -0.75); /* the side 0-2 of the first face */
    expect_position(refined, 15, 0, 0.75, -0.75);  /* 2-3 */
    /* The first corner's face: vertex 0, edge point of 0-2, face point, edge point of 1-0. */
    static const mt_index first[] = {0, 14, 8, 17};
    assert_memory_equal(refined->corner_vertices, first, sizeof first);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* A lone quad: its outline is a cubic B-spline curve, its middle the mean. */
static void test_quad_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 8, 0, 0, 8, 8, 0, 0, 8, 4};
    static const mt_index faces[] = {4, 0, 1, 2, 3};
    mt_mesh *quad = test_mesh(context, 4, positions, 1, faces);
    mt_mesh *refined = subdivide(context, quad, 1);
    assert_int_equal(refined->vertex_count, 9);
    expect_position(refined, 0, 1, 1, 0.5);
    expect_position(refined, 1, 7, 1, 0);
    expect_position(refined, 3, 1, 7, 3);
    expect_position(refined, 4, 4, 4, 1);
    expect_position(refined, 5, 4, 0, 0);
    expect_position(refined, 8, 0, 4, 2);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, quad);
    test_context_end(context);
}

static mt_index next_corner(const mt_mesh *mesh, mt_index face, mt_index corner)
{
    return corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
}

/* The order that scripts rely on: old vertices, face points, edge points by the first corner of the edge; the faces in
 * the order of the corners. Holds at each level, though later ones are made from closed forms. */
static void expect_order(mt_context *context, const mt_mesh *mesh, const mt_mesh *refined)
{
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    mt_index *edge_of = malloc(mesh->corner_count * sizeof *edge_of + 1);
    assert_non_null(edge_of);
    mt_index edge_count = 0;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        edge_of[corner] = mt_edge_is_first(pairs, corner) ? edge_count++ : edge_of[pairs->next_side[corner]];
    }
    assert_int_equal(refined->vertex_count, mesh->vertex_count + mesh->face_count + edge_count);
    mt_index edge_base = mesh->vertex_count + mesh->face_count;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            mt_index n = next_corner(mesh, face, c);
            assert_int_equal(refined->corner_vertices[4 * c], mesh->corner_vertices[c]);
            assert_int_equal(refined->corner_vertices[4 * c + 1], edge_base + edge_of[c]);
            assert_int_equal(refined->corner_vertices[4 * c + 2], mesh->vertex_count + face);
            assert_int_equal(refined->corner_vertices[4 * n + 3], edge_base + edge_of[c]);
        }
    }
    free(edge_of);
    mt_edge_pairs_destroy(context, pairs);
}

/* Runs a check on many cages, open and closed. */
typedef void (*cage_check)(mt_context *context, test_random *random, mt_mesh *cage);

static void on_cages(unsigned count, cage_check check)
{
    test_random random = {20};
    mt_context *context = test_context();
    for (unsigned i = 0; i < count; i++) {
        mt_index columns = 3 + (mt_index)test_random_below(&random, 5);
        mt_index rows = 3 + (mt_index)test_random_below(&random, 5);
        mt_mesh *cage = test_cage(context, &random, columns, rows, i % 2 == 0);
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
    for (unsigned level = 2; level <= 3; level++) {
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
    on_cages(30, check_order);
}

static void check_counts(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, cage, &pairs), MT_OK);
    int64_t euler = (int64_t)cage->vertex_count + cage->face_count - pairs->edge_count;
    for (unsigned level = 0; level <= 3; level++) {
        mt_subdivide_counts counts;
        assert_int_equal(mt_subdivide_count(context, cage, pairs, NULL, level, &counts), MT_OK);
        mt_subdivide_options options = {.level_count = level, .no_levels = level == 0};
        mt_mesh *refined = NULL;
        assert_int_equal(mt_subdivide(context, cage, &options, &refined), MT_OK);
        mt_edge_pairs *refined_pairs = NULL;
        assert_int_equal(mt_edge_pairs_create(context, refined, &refined_pairs), MT_OK);
        assert_int_equal(counts.vertex_count, refined->vertex_count);
        assert_int_equal(counts.face_count, refined->face_count);
        assert_int_equal(counts.corner_count, refined->corner_count);
        assert_int_equal(counts.edge_count, refined_pairs->edge_count);
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
    (void)random;
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
            mt_mesh_set_position(copy, vertex, mt_vec3_make(-p.y, p.x, p.z));
        }
        mt_mesh *refined = subdivide(context, cage, 1), *other = subdivide(context, copy, 1);
        for (mt_index vertex = 0; reverse && vertex < other->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(other, vertex);
            mt_mesh_set_position(other, vertex, mt_vec3_make(p.y, -p.x, p.z));
        }
        for (mt_index corner = 0; corner < cage->corner_count; corner++) {
            const mt_index *ours = refined->corner_vertices + 4 * (size_t)corner;
            const mt_index *theirs = other->corner_vertices + 4 * (size_t)images[corner];
            for (unsigned k = 0; k < 4; k++) {
                expect_same_bits(refined, ours[k], other, theirs[reverse ? (4 - k) % 4 : k]);
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

static void expect_same_on_threads(mt_index columns, mt_index rows, unsigned level_count)
{
    static const unsigned threads[] = {1, 2, 7};
    uint64_t hashes[3];
    for (unsigned i = 0; i < 3; i++) {
        test_random random = {5};
        mt_context *context = test_context_with_threads(threads[i]);
        mt_mesh *cage = test_cage(context, &random, columns, rows, false);
        mt_mesh *refined = subdivide(context, cage, level_count);
        hashes[i] = test_mesh_hash(refined);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
    assert_int_equal(hashes[0], hashes[1]);
    assert_int_equal(hashes[0], hashes[2]);
}

/* Large enough for several blocks of every loop: of polygons, and of refined quads. */
static void test_threads_do_not_matter(void **state)
{
    (void)state;
    expect_same_on_threads(300, 200, 1);
    expect_same_on_threads(60, 50, 4);
}

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

/* A hub of any valence: (F + 2R + (n-3)P)/n, here with the sums written out in long double. */
static void test_high_valence(void **state)
{
    (void)state;
    static const mt_index valences[] = {3, 4, 5, 50, 1000, 100000};
    mt_context *context = test_context();
    for (unsigned i = 0; i < sizeof valences / sizeof *valences; i++) {
        mt_index n = valences[i];
        mt_mesh *fan = test_fan(context, n, true);
        mt_vec3 hub = mt_mesh_position(fan, 0);
        long double face_sum = 0, ring_sum = 0;
        for (mt_index face = 0; face < n; face++) {
            const mt_index *v = fan->corner_vertices + 3 * (size_t)face;
            long double sum = 0;
            for (unsigned k = 0; k < 3; k++) {
                sum += (long double)mt_mesh_position(fan, v[k]).x;
            }
            face_sum += sum / 3;
            ring_sum += (sum - (long double)hub.x) / 2; /* each rim vertex lies in two faces */
        }
        long double mean = ring_sum / n;
        long double expected = (face_sum / n + ((long double)hub.x + mean) + (n - 3.0L) * (long double)hub.x) / n;
        mt_mesh *refined = subdivide(context, fan, 1);
        assert_true(fabs(mt_mesh_position(refined, 0).x - (double)expected) <= 1e-16 * n);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, fan);
    }
    test_context_end(context);
}

/* What has no face stays; what is next to nothing else is refined alone. */
static void test_pieces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9, 5, 0, 0, 6, 0, 0, 5, 1, 0};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 4, 5, 6, 3, 4, 6, 5};
    mt_mesh *mesh = test_mesh(context, 7, positions, 3, faces);
    mt_mesh *refined = subdivide(context, mesh, 1);
    assert_int_equal(refined->vertex_count, 7 + 3 + 6);
    expect_position(refined, 3, 9, 9, 9);
    expect_position(refined, 0, 0.125, 0.125, 0);
    /* The pillow of two triangles: valence 2, (F + 2R - P)/2. */
    expect_position(refined, 4, 5 + 5.0 / 12, 5.0 / 12, 0);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    static const mt_index none[] = {0};
    mesh = test_mesh(context, 1, positions + 9, 0, none);
    refined = subdivide(context, mesh, 3);
    assert_int_equal(refined->face_count, 0);
    expect_position(refined, 0, 9, 9, 9);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cube_by_hand),          cmocka_unit_test(test_quad_by_hand),
        cmocka_unit_test(test_order_and_levels),      cmocka_unit_test(test_counts_and_euler),
        cmocka_unit_test(test_partition_of_unity),    cmocka_unit_test(test_affine_invariance),
        cmocka_unit_test(test_convex_hull),           cmocka_unit_test(test_renumbering_and_mirrors),
        cmocka_unit_test(test_threads_do_not_matter), cmocka_unit_test(test_both_precisions),
        cmocka_unit_test(test_high_valence),          cmocka_unit_test(test_pieces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
