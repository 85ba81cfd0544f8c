/* Options and tags of subdivision: holes, boundaries, where creases come from, cuts; and what is foretold of them. */
#include "tests/support/cage.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options)
{
    mt_mesh *refined = NULL;
    mt_status status = mt_subdivide(context, mesh, options, &refined);
    if (status != MT_OK) {
        print_message("%s\n", mt_context_error(context)->message);
    }
    assert_int_equal(status, MT_OK);
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

/* The same surface around the hole, whose vertices stay; counts and bytes are foretold. */
static void test_holes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    mt_attribute *marks = NULL;
    mt_subdivide_options options = {.level_count = 2};
    mt_mesh *whole = subdivide(context, cube, &options);
    assert_int_equal(mt_mesh_add_holes(context, cube, &marks), MT_OK);
    ((uint8_t *)marks->values)[1] = 1;
    mt_mesh *refined = subdivide(context, cube, &options);
    assert_int_equal(refined->face_count, 80);
    assert_int_equal(refined->vertex_count, whole->vertex_count);
    assert_memory_equal(refined->positions, whole->positions, 24 * (size_t)whole->vertex_count);
    assert_memory_equal(refined->corner_vertices, whole->corner_vertices, 64 * sizeof(mt_index));
    assert_memory_equal(refined->corner_vertices + 64, whole->corner_vertices + 128, 256 * sizeof(mt_index));
    assert_null(mt_mesh_find_holes(refined));
    mt_edge_pairs *pairs = NULL, *refined_pairs = NULL;
    mt_subdivide_counts counts;
    assert_int_equal(mt_edge_pairs_create(context, cube, &pairs), MT_OK);
    assert_int_equal(mt_edge_pairs_create(context, refined, &refined_pairs), MT_OK);
    assert_int_equal(mt_subdivide_count(context, cube, pairs, &options, 2, &counts), MT_OK);
    assert_int_equal(counts.face_count, 80);
    assert_int_equal(counts.corner_count, 320);
    assert_int_equal(counts.edge_count, refined_pairs->edge_count);
    mt_edge_pairs_destroy(context, refined_pairs);
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, whole);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* Of a sheet of 4 x 4 quads the 12 at the rim become holes; one corner's boundary edges made sharp keep only faces all
 * of whose boundary vertices are: none more. Sharp edges all around keep all. */
static void test_boundary_none(void **state)
{
    (void)state;
    mt_context *context = test_context();
    double positions[75];
    mt_index faces[80];
    for (mt_index i = 0; i < 25; i++) {
        positions[3 * i] = i % 5;
        positions[3 * i + 1] = (double)(i / 5);
        positions[3 * i + 2] = 0;
    }
    for (mt_index i = 0; i < 16; i++) {
        mt_index a = i / 4 * 5 + i % 4;
        const mt_index face[5] = {4, a, a + 1, a + 6, a + 5};
        memcpy(faces + 5 * (size_t)i, face, sizeof face);
    }
    mt_mesh *sheet = test_mesh(context, 25, positions, 16, faces);
    mt_subdivide_options options = {.boundary = MT_SUBDIVIDE_BOUNDARY_NONE};
    mt_mesh *refined = subdivide(context, sheet, &options);
    assert_int_equal(refined->face_count, 16);
    mt_mesh_destroy(context, refined);
    mt_edge_value rim[16];
    for (mt_index i = 0; i < 4; i++) {
        rim[4 * i] = (mt_edge_value){i, i + 1, 10};
        rim[4 * i + 1] = (mt_edge_value){20 + i, 21 + i, 10};
        rim[4 * i + 2] = (mt_edge_value){5 * i, 5 * i + 5, 10};
        rim[4 * i + 3] = (mt_edge_value){5 * i + 4, 5 * i + 9, 10};
    }
    options.creases = rim;
    options.crease_count = 16;
    refined = subdivide(context, sheet, &options);
    assert_int_equal(refined->face_count, 64);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, sheet);
    test_context_end(context);
}

/* A cube of infinitely sharp edges stays a cube: by the list, by the angle; an option beats a tag. */
static void test_where_creases_come_from(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    mt_subdivide_options options = {.level_count = 3, .crease_angle = 1};
    mt_mesh *angled = subdivide(context, cube, &options);
    assert_true(mt_vec3_max_abs(mt_mesh_position(angled, 0)) == 1);
    options.crease_angle = 1.6; /* more than a right angle */
    mt_mesh *round = subdivide(context, cube, &options);
    assert_true(mt_vec3_max_abs(mt_mesh_position(round, 0)) < 0.6);
    static const mt_vertex_value sharp[] = {{0, 10}}, smooth[] = {{0, 0}};
    cube->sharp_vertices = mt_allocate(context, sizeof sharp);
    memcpy(cube->sharp_vertices, sharp, sizeof sharp);
    cube->sharp_vertex_count = 1;
    options = (mt_subdivide_options){.level_count = 3};
    mt_mesh *tagged = subdivide(context, cube, &options);
    assert_true(mt_vec3_max_abs(mt_mesh_position(tagged, 0)) == 1);
    options.sharp_vertices = smooth;
    options.sharp_vertex_count = 1;
    mt_mesh *beaten = subdivide(context, cube, &options);
    assert_memory_equal(beaten->positions, round->positions, 24 * (size_t)round->vertex_count);
    static const mt_edge_value outside[] = {{0, 8, 1}};
    options.creases = outside;
    options.crease_count = 1;
    mt_mesh *none = NULL;
    assert_int_equal(mt_subdivide(context, cube, &options, &none), MT_ERROR_ARGUMENT);
    assert_null(none);
    mt_context_clear_error(context);
    mt_mesh *meshes[] = {angled, round, tagged, beaten, cube};
    for (unsigned i = 0; i < 5; i++) {
        mt_mesh_destroy(context, meshes[i]);
    }
    test_context_end(context);
}

/* Tags of the mesh are as good as the options of the same meaning, and options beat them. */
static void test_tags_are_options(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {3};
    mt_mesh *cage = test_cage(context, &random, 5, 5, false);
    test_sharpen(context, &random, cage);
    test_add_uvs(context, &random, cage);
    mt_subdivide_options plain = {.level_count = 2};
    mt_subdivide_options asked = {.level_count = 2,
                                  .boundary = MT_SUBDIVIDE_BOUNDARY_CORNERS,
                                  .crease_method = MT_SUBDIVIDE_CREASES_CHAIKIN,
                                  .face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS2,
                                  .triangles = MT_SUBDIVIDE_TRIANGLES_SMOOTH};
    mt_subdivide_options defaults = {.level_count = 2,
                                     .boundary = MT_SUBDIVIDE_BOUNDARY_SMOOTH,
                                     .crease_method = MT_SUBDIVIDE_CREASES_NORMAL,
                                     .face_varying = MT_SUBDIVIDE_FACE_VARYING_ALL,
                                     .triangles = MT_SUBDIVIDE_TRIANGLES_NORMAL};
    mt_mesh *by_default = subdivide(context, cage, &plain), *by_options = subdivide(context, cage, &asked);
    static const unsigned values[MT_TAG_COUNT] = {
        [MT_TAG_BOUNDARY] = 1, [MT_TAG_FACE_VARYING] = 3, [MT_TAG_CREASE_METHOD] = 1, [MT_TAG_SMOOTH_TRIANGLES] = 1};
    for (unsigned tag = 0; tag < MT_TAG_COUNT; tag++) {
        assert_int_equal(mt_subdivision_tag_set(context, cage, (mt_subdivision_tag)tag, values[tag]), MT_OK);
    }
    mt_mesh *by_tags = subdivide(context, cage, &plain), *back = subdivide(context, cage, &defaults);
    size_t size = 24 * (size_t)by_tags->vertex_count;
    assert_memory_equal(by_tags->positions, by_options->positions, size);
    assert_memory_equal(back->positions, by_default->positions, size);
    assert_memory_not_equal(by_tags->positions, by_default->positions, size);
    const mt_attribute *uvs[] = {&by_tags->attributes[0], &by_options->attributes[0]};
    assert_int_equal(uvs[0]->value_count, uvs[1]->value_count);
    assert_memory_equal(uvs[0]->values, uvs[1]->values, 16 * (size_t)uvs[0]->value_count);
    mt_mesh *meshes[] = {by_default, by_options, by_tags, back, cage};
    for (unsigned i = 0; i < 5; i++) {
        mt_mesh_destroy(context, meshes[i]);
    }
    test_context_end(context);
}

static mt_mesh *laden_cage(mt_context *context)
{
    test_random random = {9};
    mt_mesh *cage = test_cage(context, &random, 5, 4, false);
    test_sharpen(context, &random, cage);
    test_add_uvs(context, &random, cage);
    mt_attribute *marks = NULL;
    assert_int_equal(mt_mesh_add_holes(context, cage, &marks), MT_OK);
    ((uint8_t *)marks->values)[2] = 1;
    return cage;
}

/* Bytes and values with smooth UVs, whose vertices get values of their own. */
static void test_counts_of_smooth_values(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {11};
    mt_mesh *cage = test_cage(context, &random, 6, 5, true);
    test_add_uvs(context, &random, cage);
    cage->attributes[0].indices[7] = MT_NONE;
    mt_subdivide_options options = {.level_count = 3, .face_varying = MT_SUBDIVIDE_FACE_VARYING_NONE};
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, cage, &pairs), MT_OK);
    mt_subdivide_counts counts;
    assert_int_equal(mt_subdivide_count(context, cage, pairs, &options, 3, &counts), MT_OK);
    uint64_t before = mt_context_bytes(context);
    mt_mesh *refined = subdivide(context, cage, &options);
    uint64_t held = mt_context_bytes(context) - before;
    assert_true(held >= counts.bytes && held < counts.bytes + 2048);
    mt_mesh_destroy(context, refined);
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, cage);
    test_context_end(context);
}

/* Three quads along an edge: one mesh before and after, whose shared vertices stay on a curve. */
static void test_shared_edges(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, -1, 1, 1, -1, 1, 0, -1, -1, 1, -1, -1};
    static const mt_index faces[] = {4, 0, 1, 3, 2, 4, 1, 0, 4, 5, 4, 0, 1, 7, 6};
    mt_mesh *book = test_mesh(context, 8, positions, 3, faces);
    mt_subdivide_options options = {.level_count = 3, .non_manifold = MT_SUBDIVIDE_NON_MANIFOLD_SHARP};
    mt_mesh *refined = subdivide(context, book, &options);
    assert_int_equal(refined->face_count, 3 * 64);
    assert_int_equal(refined->vertex_count, 3 * 9 * 9 - 2 * 9);
    assert_int_equal(refined->crease_count + refined->sharp_vertex_count, 0);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, refined, &pairs), MT_OK);
    assert_int_equal(pairs->non_manifold_count, 8);
    assert_int_equal(pairs->misoriented_count, 0);
    /* Old vertices, face points, edge points by the first corner of the edge. */
    options.level_count = 1;
    mt_mesh *once = subdivide(context, book, &options);
    assert_int_equal(once->vertex_count, 8 + 3 + 10);
    assert_int_equal(once->corner_vertices[1], 11);
    assert_int_equal(once->corner_vertices[17], 11);
    assert_int_equal(once->corner_vertices[33], 11);
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, once);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, book);
    test_context_end(context);
}

/* The n-th allocation fails, for each n: an error, nothing left behind, and the mesh untouched. */
static void test_failing_allocations(void **state)
{
    (void)state;
    for (unsigned cut = 0; cut < 2; cut++) {
        uint64_t count = UINT64_MAX;
        for (uint64_t failing = 0; failing <= count; failing++) {
            mt_context *plain = test_context_with_threads(1);
            mt_mesh *cage = laden_cage(plain);
            uint64_t hash = test_mesh_hash(cage);
            mt_context_options options = {.failing_allocation = failing, .thread_count = 1};
            mt_context *context = mt_context_create(&options);
            mt_subdivide_options how = {.level_count = 2,
                                        .boundary = MT_SUBDIVIDE_BOUNDARY_NONE,
                                        .face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1,
                                        .non_manifold = (mt_subdivide_non_manifold)cut,
                                        .crease_angle = 0.1};
            mt_mesh *refined = NULL;
            mt_status status = mt_subdivide(context, cage, &how, &refined);
            assert_int_equal(status, failing ? MT_ERROR_OUT_OF_MEMORY : MT_OK);
            assert_int_equal(refined != NULL, status == MT_OK);
            count = failing ? count : mt_context_allocation_count(context);
            mt_mesh_destroy(context, refined);
            test_context_end(context);
            assert_int_equal(test_mesh_hash(cage), hash);
            mt_mesh_destroy(plain, cage);
            test_context_end(plain);
        }
        assert_true(count > 50);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_boundary_none),
        cmocka_unit_test(test_where_creases_come_from),
        cmocka_unit_test(test_tags_are_options),
        cmocka_unit_test(test_counts_of_smooth_values),
        cmocka_unit_test(test_shared_edges),
        cmocka_unit_test(test_failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
