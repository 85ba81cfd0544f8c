/* What a subdivision carries besides positions. */
#include "tests/support/cage.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, unsigned level_count)
{
    mt_subdivide_options options = {.level_count = level_count};
    mt_mesh *refined = NULL;
    assert_int_equal(mt_subdivide(context, mesh, &options, &refined), MT_OK);
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

static mt_attribute *add(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout)
{
    mt_attribute *attribute = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, layout, &attribute), MT_OK);
    return attribute;
}

static mt_attribute *add_random(mt_context *context, mt_mesh *mesh, test_random *random,
                                const mt_attribute_layout *layout)
{
    mt_attribute *attribute = add(context, mesh, layout);
    for (mt_index value = 0; value < attribute->value_count; value++) {
        for (uint32_t k = 0; k < attribute->component_count; k++) {
            mt_attribute_set(attribute, value, k, test_random_unit(random) * mt_color_maximum(layout->type));
        }
    }
    return attribute;
}

/* A vertex attribute of any width follows the rule of positions: same numbers in, same numbers out. */
static void test_vertex_rule(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {3};
    for (uint32_t width = 1; width <= 7; width++) {
        mt_mesh *cage = test_cage(context, &random, 5, 4, width % 2);
        mt_attribute_layout layout = {.domain = MT_DOMAIN_VERTEX, .type = MT_F64, .component_count = width};
        layout.value_count = cage->vertex_count;
        mt_attribute *attribute = add(context, cage, &layout);
        for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(cage, vertex);
            for (uint32_t k = 0; k < width; k++) {
                mt_attribute_set(attribute, vertex, k, (const double[]){p.x, p.y, p.z}[k % 3]);
            }
        }
        mt_mesh *refined = subdivide(context, cage, 3);
        for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(refined, vertex);
            for (uint32_t k = 0; k < width; k++) {
                double value = mt_attribute_get(&refined->attributes[0], vertex, k);
                assert_true(value == ((const double[]){p.x, p.y, p.z}[k % 3]));
            }
        }
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, cage);
    }
    test_context_end(context);
}

/* Bytes are computed as numbers over all levels and rounded once. */
static void test_integer_colors(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {4};
    mt_mesh *cage = test_cage(context, &random, 6, 5, true);
    mt_attribute_layout layout = {
        .semantic = MT_SEMANTIC_COLOR, .domain = MT_DOMAIN_VERTEX, .type = MT_U8, .component_count = 4};
    layout.value_count = cage->vertex_count;
    add_random(context, cage, &random, &layout);
    layout.type = MT_F64;
    mt_attribute *wide = add(context, cage, &layout);
    for (mt_index i = 0; i < 4 * cage->vertex_count; i++) {
        ((double *)wide->values)[i] = ((const uint8_t *)cage->attributes[0].values)[i];
    }
    mt_mesh *refined = subdivide(context, cage, 2);
    assert_int_equal(refined->attributes[0].type, MT_U8);
    for (mt_index i = 0; i < 4 * refined->vertex_count; i++) {
        double exact = ((const double *)refined->attributes[1].values)[i];
        assert_true(fabs(exact - ((const uint8_t *)refined->attributes[0].values)[i]) <= 0.5001);
    }
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, cage);
    test_context_end(context);
}

/* Two quads side by side, whose UVs meet in a seam or not. */
static mt_mesh *two_quads(mt_context *context, bool seam)
{
    static const double positions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    static const mt_index faces[] = {4, 0, 1, 4, 3, 4, 1, 2, 5, 4};
    mt_mesh *mesh = test_mesh(context, 6, positions, 2, faces);
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = MT_F32,
                                  .component_count = 2,
                                  .value_count = seam ? 8 : 6,
                                  .indexed = true};
    mt_attribute *uv = add(context, mesh, &layout);
    static const float values[] = {0, 0, 0.25f, 0, 1, 0, 0, 1, 0.25f, 1, 1, 1, 0.5f, 0, 0.5f, 1};
    memcpy(uv->values, values, uv->value_count * 2 * sizeof(float));
    memcpy(uv->indices, mesh->corner_vertices, 8 * sizeof(mt_index));
    if (seam) {
        uv->indices[4] = 6;
        uv->indices[7] = 7;
    }
    return mesh;
}

static void expect_uv(const mt_mesh *mesh, mt_index corner, double u, double v)
{
    mt_index value = mesh->attributes[0].indices[corner];
    assert_true(mt_attribute_get(&mesh->attributes[0], value, 0) == u);
    assert_true(mt_attribute_get(&mesh->attributes[0], value, 1) == v);
}

static void test_seams(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = two_quads(context, false);
    mt_mesh *refined = subdivide(context, mesh, 1);
    assert_int_equal(refined->attributes[0].value_count, 6 + 2 + 7);
    assert_memory_equal(refined->attributes[0].indices, refined->corner_vertices, 32 * sizeof(mt_index));
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    mesh = two_quads(context, true);
    refined = subdivide(context, mesh, 1);
    assert_int_equal(refined->attributes[0].value_count, 8 + 2 + 8);
    expect_uv(refined, 4, 0.25, 0);    /* the old vertex 1, of the first quad */
    expect_uv(refined, 5, 0.25, 0.5);  /* the seam's edge point in it */
    expect_uv(refined, 6, 0.125, 0.5); /* its face point */
    expect_uv(refined, 16, 0.5, 0);    /* the old vertex 1, of the second quad */
    expect_uv(refined, 17, 0.75, 0);   /* the edge point after it */
    expect_uv(refined, 19, 0.5, 0.5);  /* the seam's edge point in it */
    mt_mesh_destroy(context, refined);
    refined = subdivide(context, mesh, 3);
    assert_int_equal(refined->attributes[0].value_count, 2 * 9 * 9);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A cage with one attribute of each kind that floats can hold. */
static mt_mesh *furnished_cage(mt_context *context, test_random *random, bool closed)
{
    mt_mesh *cage = test_cage(context, random, 6, 5, closed);
    mt_attribute_layout layout = {
        .name = "per corner", .domain = MT_DOMAIN_CORNER, .type = MT_F32, .component_count = 3};
    layout.value_count = cage->corner_count;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "per face", .domain = MT_DOMAIN_FACE, .type = MT_U16, .component_count = 3};
    layout.value_count = cage->face_count;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "whole", .domain = MT_DOMAIN_MESH, .type = MT_I32, .component_count = 2};
    layout.value_count = 1;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "vertex", .domain = MT_DOMAIN_VERTEX, .type = MT_I16, .component_count = 1};
    layout.value_count = cage->vertex_count;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "corner", .domain = MT_DOMAIN_CORNER, .type = MT_U32, .component_count = 1};
    layout.value_count = cage->corner_count;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "n", .domain = MT_DOMAIN_VERTEX, .type = MT_F64, .component_count = 3};
    layout.semantic = MT_SEMANTIC_NORMAL;
    layout.value_count = cage->vertex_count;
    add_random(context, cage, random, &layout);
    layout = (mt_attribute_layout){.name = "few", .domain = MT_DOMAIN_CORNER, .type = MT_F64, .component_count = 2};
    layout.semantic = MT_SEMANTIC_UV;
    layout.indexed = true;
    layout.value_count = 7;
    mt_attribute *few = add_random(context, cage, random, &layout);
    for (mt_index corner = 0; corner < cage->corner_count; corner++) {
        few->indices[corner] = cage->corner_vertices[corner] % 8 < 7 ? cage->corner_vertices[corner] % 8 : MT_NONE;
    }
    mt_labels *labels = NULL;
    mt_index number;
    assert_int_equal(mt_mesh_add_labels(context, cage, MT_LABEL_MATERIAL, &labels), MT_OK);
    assert_int_equal(mt_labels_add_name(context, labels, "skin", &number), MT_OK);
    labels->face_labels[3] = number;
    return cage;
}

static void expect_inherited(const mt_mesh *cage, const mt_mesh *refined, unsigned level)
{
    for (mt_index face = 0; face < refined->face_count; face++) {
        mt_index corner = face >> (2 * (level - 1)), parent = mt_mesh_corner_face(cage, corner);
        assert_int_equal(refined->label_sets[0].face_labels[face], cage->label_sets[0].face_labels[parent]);
        for (uint32_t k = 0; k < 3; k++) {
            assert_true(mt_attribute_get(&refined->attributes[1], face, k) ==
                        mt_attribute_get(&cage->attributes[1], parent, k));
        }
    }
    for (mt_index corner = 0; corner < refined->corner_count; corner++) {
        assert_true(mt_attribute_get(&refined->attributes[4], corner, 0) ==
                    mt_attribute_get(&cage->attributes[4], corner >> (2 * level), 0));
        mt_index face = mt_mesh_corner_face(cage, corner >> (2 * level));
        bool complete = true;
        for (mt_index c = mt_mesh_face_begin(cage, face); c < mt_mesh_face_end(cage, face); c++) {
            complete = complete && cage->attributes[6].indices[c] != MT_NONE;
        }
        assert_int_equal(refined->attributes[6].indices[corner] != MT_NONE, complete);
    }
    assert_string_equal(refined->label_sets[0].names[0], "skin");
    assert_memory_equal(refined->attributes[2].values, cage->attributes[2].values, 2 * sizeof(int32_t));
}

static void expect_unit(const mt_attribute *normals)
{
    for (mt_index value = 0; value < normals->value_count; value++) {
        mt_vec3 n = {mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                     mt_attribute_get(normals, value, 2)};
        assert_true(fabs(mt_vec3_length(n) - 1) < 1e-15);
    }
}

static void count_warnings(void *user, const char *sentence)
{
    *(unsigned *)user += strstr(sentence, "normals were interpolated") != NULL;
}

static void test_everything_is_carried(void **state)
{
    (void)state;
    test_random random = {8};
    for (unsigned closed = 0; closed < 2; closed++) {
        uint64_t hashes[3];
        for (unsigned threads = 1; threads <= 3; threads++) {
            unsigned warnings = 0;
            mt_context_options options = {
                .thread_count = threads, .warning = count_warnings, .warning_user = &warnings};
            mt_context *context = mt_context_create(&options);
            random.state = closed;
            mt_mesh *cage = furnished_cage(context, &random, closed);
            for (unsigned level = 1; level <= 3; level++) {
                mt_mesh *refined = subdivide(context, cage, level);
                assert_int_equal(refined->attribute_count, cage->attribute_count);
                assert_string_equal(refined->attributes[0].name, "per corner");
                expect_inherited(cage, refined, level);
                expect_unit(&refined->attributes[5]);
                hashes[threads - 1] = test_mesh_hash(refined);
                mt_mesh_destroy(context, refined);
            }
            assert_int_equal(warnings, 3);
            mt_mesh_destroy(context, cage);
            test_context_end(context);
        }
        assert_int_equal(hashes[0], hashes[1]);
        assert_int_equal(hashes[0], hashes[2]);
    }
}

/* The bytes that are foretold are those that the result takes, but for names and the mesh's own record. */
static void test_counts_of_bytes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {9};
    mt_mesh *cage = furnished_cage(context, &random, true);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, cage, &pairs), MT_OK);
    for (unsigned level = 1; level <= 4; level++) {
        mt_subdivide_counts counts;
        assert_int_equal(mt_subdivide_count(context, cage, pairs, NULL, level, &counts), MT_OK);
        uint64_t before = mt_context_bytes(context);
        mt_mesh *refined = subdivide(context, cage, level);
        uint64_t held = mt_context_bytes(context) - before;
        assert_true(held >= counts.bytes && held < counts.bytes + 2048);
        mt_mesh_destroy(context, refined);
    }
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, cage);
    test_context_end(context);
}

static const mt_edge_value *find_crease(const mt_mesh *mesh, mt_index a, mt_index b)
{
    for (mt_index i = 0; i < mesh->crease_count; i++) {
        const mt_edge_value *crease = &mesh->creases[i];
        if ((crease->a == a && crease->b == b) || (crease->a == b && crease->b == a)) {
            return &mesh->creases[i];
        }
    }
    return NULL;
}

/* Of a cube: an edge of 2.5, an infinite one named backwards, one of 0.5, a pair that is no edge. */
static void test_sharpness_is_passed_on(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    static const mt_edge_value creases[] = {{0, 1, 2.5}, {3, 2, 10}, {4, 5, 0.5}, {0, 7, 3}};
    static const mt_vertex_value corners[] = {{0, 1.5}, {6, 0.75}, {7, 12}};
    cube->creases = mt_allocate(context, sizeof creases);
    cube->sharp_vertices = mt_allocate(context, sizeof corners);
    memcpy(cube->creases, creases, sizeof creases);
    memcpy(cube->sharp_vertices, corners, sizeof corners);
    cube->crease_count = 4;
    cube->sharp_vertex_count = 3;
    mt_mesh *once = subdivide(context, cube, 1), *twice = subdivide(context, cube, 2);
    assert_int_equal(once->crease_count, 5);
    mt_index middle = once->corner_vertices[3]; /* the edge point of 1-0, the last side of the first face */
    assert_true(find_crease(once, 0, middle)->value == 1.5);
    assert_true(find_crease(once, middle, 1)->value == 1.5);
    assert_true(find_crease(once, 0, 7)->value == 3);
    assert_int_equal(once->sharp_vertex_count, 2);
    assert_true(once->sharp_vertices[0].value == 0.5);
    assert_true(once->sharp_vertices[1].value == 12);
    assert_int_equal(twice->crease_count, 9);
    assert_int_equal(twice->sharp_vertex_count, 1);
    mt_mesh *again = subdivide(context, once, 1);
    assert_int_equal(test_mesh_hash(again), test_mesh_hash(twice));
    for (mt_index i = 0; i < 9; i++) {
        const mt_edge_value *crease = find_crease(again, twice->creases[i].a, twice->creases[i].b);
        assert_non_null(crease);
        assert_true(crease->value == twice->creases[i].value);
    }
    mt_mesh *meshes[] = {again, twice, once, cube};
    for (unsigned i = 0; i < 4; i++) {
        mt_mesh_destroy(context, meshes[i]);
    }
    test_context_end(context);
}

/* Wires and points keep their vertices' numbers. */
static void test_wires_and_points_stay(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    cube->wire_offsets = mt_allocate(context, 2 * sizeof(mt_index));
    cube->wire_vertices = mt_allocate(context, 3 * sizeof(mt_index));
    cube->point_vertices = mt_allocate(context, sizeof(mt_index));
    memcpy(cube->wire_offsets, (const mt_index[]){0, 3}, 2 * sizeof(mt_index));
    memcpy(cube->wire_vertices, (const mt_index[]){1, 5, 2}, 3 * sizeof(mt_index));
    cube->point_vertices[0] = 7;
    cube->wire_count = cube->point_count = 1;
    mt_mesh *refined = subdivide(context, cube, 2);
    assert_int_equal(refined->wire_count, 1);
    assert_memory_equal(refined->wire_vertices, cube->wire_vertices, 3 * sizeof(mt_index));
    assert_int_equal(refined->point_vertices[0], 7);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* The n-th allocation fails, for each n: an error, nothing left behind, and the mesh untouched. */
static void test_failing_allocations(void **state)
{
    (void)state;
    uint64_t count = UINT64_MAX;
    for (uint64_t failing = 0; failing <= count; failing++) {
        test_random random = {1};
        mt_context *plain = test_context_with_threads(1);
        mt_mesh *cage = furnished_cage(plain, &random, failing % 2);
        uint64_t hash = test_mesh_hash(cage);
        mt_context_options options = {.failing_allocation = failing, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        mt_subdivide_options levels = {.level_count = 2};
        mt_mesh *refined = NULL;
        mt_status status = mt_subdivide(context, cage, &levels, &refined);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_vertex_rule),
        cmocka_unit_test(test_integer_colors),
        cmocka_unit_test(test_seams),
        cmocka_unit_test(test_everything_is_carried),
        cmocka_unit_test(test_counts_of_bytes),
        cmocka_unit_test(test_sharpness_is_passed_on),
        cmocka_unit_test(test_wires_and_points_stay),
        cmocka_unit_test(test_failing_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
