/* Loop's scheme and the limit where memory is missing, over threads, far from the origin and at extreme scales. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <math.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options)
{
    mt_mesh *refined = NULL;
    if (mt_subdivide(context, mesh, options, &refined) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

static mt_mesh *furnished_cage(mt_context *context, mt_index columns, mt_index rows)
{
    test_random random = {9};
    mt_mesh *cage = test_triangle_cage(context, &random, columns, rows, false);
    mt_attribute *marks = NULL;
    test_sharpen(context, &random, cage);
    test_add_uvs(context, &random, cage);
    assert_int_equal(mt_mesh_add_holes(context, cage, &marks), MT_OK);
    ((uint8_t *)marks->values)[2] = 1;
    return cage;
}

static const mt_subdivide_options furnished_options = {.level_count = 2,
                                                       .scheme = MT_SUBDIVIDE_SCHEME_LOOP,
                                                       .boundary = MT_SUBDIVIDE_BOUNDARY_CORNERS,
                                                       .face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1,
                                                       .crease_angle = 0.1};

/* The n-th allocation fails, for each n: an error, nothing left behind, and the mesh untouched. */
static uint64_t sweep(mt_context *plain, const mt_mesh *cage, const mt_subdivide_options *how)
{
    uint64_t count = UINT64_MAX, hash = test_mesh_hash(cage);
    for (uint64_t failing = 0; failing <= count; failing++) {
        mt_context_options options = {.failing_allocation = failing, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        assert_non_null(context);
        mt_mesh *refined = NULL;
        mt_status status = mt_subdivide(context, cage, how, &refined);
        assert_int_equal(status, failing ? MT_ERROR_OUT_OF_MEMORY : MT_OK);
        assert_int_equal(refined != NULL, status == MT_OK);
        count = failing ? count : mt_context_allocation_count(context);
        mt_mesh_destroy(context, refined);
        test_context_end(context);
        assert_int_equal(test_mesh_hash(cage), hash);
    }
    assert_int_equal(mt_context_error(plain)->status, MT_OK);
    return count;
}

static void test_failing_allocations(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(1);
    mt_mesh *cage = furnished_cage(context, 5, 4);
    for (unsigned i = 0; i < 8; i++) {
        mt_subdivide_options how = furnished_options;
        how.scheme = i & 1 ? MT_SUBDIVIDE_SCHEME_LOOP : MT_SUBDIVIDE_SCHEME_CATMULL_CLARK;
        how.limit = i & 2;
        how.non_manifold = i & 4 ? MT_SUBDIVIDE_NON_MANIFOLD_SHARP : MT_SUBDIVIDE_NON_MANIFOLD_REFUSED;
        if (how.limit || how.scheme == MT_SUBDIVIDE_SCHEME_LOOP) {
            assert_true(sweep(context, cage, &how) > 50);
        }
    }
    mt_mesh_destroy(context, cage);
    test_context_end(context);
}

/* Large enough for several blocks of every loop, with and without anything sharp or carried. */
static void test_threads_do_not_matter(void **state)
{
    (void)state;
    static const unsigned threads[] = {1, 2, 7};
    uint64_t hashes[3][3];
    for (unsigned i = 0; i < 3; i++) {
        mt_context *context = test_context_with_threads(threads[i]);
        mt_mesh *cage = furnished_cage(context, 14, 12), *torus = test_torus(context, 90, 70, true);
        mt_subdivide_options options = furnished_options;
        options.level_count = 4;
        mt_mesh *refined = subdivide(context, cage, &options), *plain = subdivide(context, torus, &furnished_options);
        options.limit = true;
        mt_mesh *limit = subdivide(context, cage, &options);
        hashes[i][0] = test_mesh_hash(refined);
        hashes[i][1] = test_mesh_hash(plain);
        hashes[i][2] = test_mesh_hash(limit);
        mt_mesh_destroy(context, limit);
        mt_mesh_destroy(context, plain);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, torus);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
    assert_memory_equal(hashes[0], hashes[1], sizeof hashes[0]);
    assert_memory_equal(hashes[0], hashes[2], sizeof hashes[0]);
}

/* What is compared at extremes: both schemes, with creases and corners and without. */
#define EXTREME_COUNT 4

static mt_mesh *extreme_cage(mt_context *context, unsigned number, mt_subdivide_options *options)
{
    test_random random = {31 + number};
    bool loop = number & 1;
    mt_mesh *cage = loop ? test_triangle_cage(context, &random, 7, 6, false) : test_cage(context, &random, 7, 6, false);
    if (number & 2) {
        test_sharpen(context, &random, cage);
    }
    *options = (mt_subdivide_options){.level_count = 2, .limit = true};
    options->scheme = loop ? MT_SUBDIVIDE_SCHEME_LOOP : MT_SUBDIVIDE_SCHEME_CATMULL_CLARK;
    return cage;
}

static const mt_attribute *normals_of(const mt_mesh *mesh)
{
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    normals = normals ? normals : mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    assert_non_null(normals);
    return normals;
}

static mt_vec3 normal_of(const mt_attribute *normals, mt_index value)
{
    return mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                        mt_attribute_get(normals, value, 2));
}

static void place(mt_mesh *mesh, double scale, double offset)
{
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_vec3 p = mt_vec3_scale(mt_mesh_position(mesh, vertex), scale);
        mt_mesh_set_position(mesh, vertex, mt_vec3_add(p, mt_vec3_make(offset, -offset, offset)));
    }
}

/* The same bits times the power of two, and the very same normals: nothing under- or overflows on the way. */
static void expect_scaled(mt_type type, int exponent)
{
    for (unsigned i = 0; i < EXTREME_COUNT; i++) {
        mt_context *context = test_context();
        mt_subdivide_options options;
        mt_mesh *cage = extreme_cage(context, i, &options);
        assert_int_equal(mt_mesh_set_position_type(context, cage, type, NULL), MT_OK);
        mt_mesh *plain = subdivide(context, cage, &options);
        place(cage, ldexp(1, exponent), 0);
        mt_mesh *scaled = subdivide(context, cage, &options);
        const mt_attribute *normals = normals_of(plain), *others = normals_of(scaled);
        for (mt_index vertex = 0; vertex < plain->vertex_count; vertex++) {
            mt_vec3 p = mt_vec3_scale(mt_mesh_position(plain, vertex), ldexp(1, exponent));
            mt_vec3 q = mt_mesh_position(scaled, vertex);
            if (!(p.x == q.x && p.y == q.y && p.z == q.z)) {
                fail_msg("case %u, 2^%d: vertex %u is at %g %g %g and not at %g %g %g", i, exponent, vertex, q.x, q.y,
                         q.z, p.x, p.y, p.z);
            }
        }
        assert_int_equal(normals->value_count, others->value_count);
        for (mt_index value = 0; value < normals->value_count; value++) {
            double error = mt_vec3_max_abs(mt_vec3_subtract(normal_of(normals, value), normal_of(others, value)));
            if (!(error == 0)) {
                fail_msg("case %u, 2^%d: normal %u differs by %g", i, exponent, value, error);
            }
        }
        mt_mesh_destroy(context, scaled);
        mt_mesh_destroy(context, plain);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
}

/* About 1e-150, 1e150, and in single precision 1e-30, 1e30. */
static void test_scales(void **state)
{
    (void)state;
    expect_scaled(MT_F64, -498);
    expect_scaled(MT_F64, 498);
    expect_scaled(MT_F32, -100);
    expect_scaled(MT_F32, 100);
}

/* At 1e7 a double's step is 2^-29 and a float's is 1. Positions may be off by two steps a level and as much at both
 * ends; normals in double precision by the roundings of a ring of a quarter's length or so. */
static void expect_moved(mt_type type, double position_tolerance, double normal_tolerance)
{
    for (unsigned i = 0; i < EXTREME_COUNT; i++) {
        mt_context *context = test_context();
        mt_subdivide_options options;
        mt_mesh *cage = extreme_cage(context, i, &options);
        mt_mesh *plain = subdivide(context, cage, &options);
        place(cage, 1, 1e7);
        assert_int_equal(mt_mesh_set_position_type(context, cage, type, NULL), MT_OK);
        mt_mesh *moved = subdivide(context, cage, &options);
        const mt_attribute *normals = normals_of(plain), *others = normals_of(moved);
        mt_vec3 offset = mt_vec3_make(1e7, -1e7, 1e7);
        for (mt_index vertex = 0; vertex < plain->vertex_count; vertex++) {
            mt_vec3 p = mt_vec3_subtract(mt_mesh_position(moved, vertex), offset);
            double error = mt_vec3_max_abs(mt_vec3_subtract(p, mt_mesh_position(plain, vertex)));
            if (!(error <= position_tolerance)) {
                fail_msg("case %u: vertex %u is off by %g", i, vertex, error);
            }
        }
        for (mt_index value = 0; value < others->value_count; value++) {
            mt_vec3 normal = normal_of(others, value);
            assert_true(fabs(mt_vec3_length(normal) - 1) < (type == MT_F64 ? 1e-15 : 1e-6));
            double error = mt_vec3_max_abs(mt_vec3_subtract(normal, normal_of(normals, value)));
            if (!(error <= normal_tolerance)) {
                fail_msg("case %u: normal %u is off by %g", i, value, error);
            }
        }
        mt_mesh_destroy(context, moved);
        mt_mesh_destroy(context, plain);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
}

static void test_offset(void **state)
{
    (void)state;
    expect_moved(MT_F64, 8 * ldexp(1, -29), 1e-5);
    expect_moved(MT_F32, 4, 2); /* any direction: the cage itself has become whole numbers */
}

/* All in one point, or on one line, there is no normal: a unit one is given all the same. */
static void test_no_tangent_plane(void **state)
{
    (void)state;
    for (unsigned i = 0; i < 2 * EXTREME_COUNT; i++) {
        mt_context *context = test_context();
        mt_subdivide_options options;
        mt_mesh *cage = extreme_cage(context, i / 2, &options);
        for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
            double along = i % 2 ? mt_mesh_position(cage, vertex).x : 0;
            mt_mesh_set_position(cage, vertex, mt_vec3_make(along, 3, 0));
        }
        mt_mesh *limit = subdivide(context, cage, &options);
        const mt_attribute *normals = normals_of(limit);
        for (mt_index value = 0; value < normals->value_count; value++) {
            mt_vec3 n = normal_of(normals, value);
            if (!(fabs(mt_vec3_length(n) - 1) < 1e-15)) {
                fail_msg("case %u: normal %u is %g %g %g", i, value, n.x, n.y, n.z);
            }
        }
        for (mt_index vertex = 0; vertex < limit->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(limit, vertex);
            assert_true(p.y == 3 && p.z == 0 && (i % 2 || p.x == 0));
        }
        mt_mesh_destroy(context, limit);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_failing_allocations),
        cmocka_unit_test(test_threads_do_not_matter),
        cmocka_unit_test(test_scales),
        cmocka_unit_test(test_offset),
        cmocka_unit_test(test_no_tangent_plane),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
