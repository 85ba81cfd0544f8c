/* What Loop's scheme carries besides positions, and what it refuses. */
#include "tests/support/cage.h"
#include "tests/support/laden_mesh.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>
#include <meshtool/triangulate.h>

#include <math.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options)
{
    mt_subdivide_options loop = *options;
    mt_mesh *refined = NULL;
    loop.scheme = MT_SUBDIVIDE_SCHEME_LOOP;
    if (mt_subdivide(context, mesh, &loop, &refined) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

static mt_mesh *laden_triangles(mt_context *context)
{
    mt_mesh *laden = NULL, *triangles = NULL;
    assert_int_equal(test_laden_mesh(context, &laden), MT_OK);
    assert_int_equal(mt_mesh_triangulate(context, laden, &triangles), MT_OK);
    mt_mesh_destroy(context, laden);
    return triangles;
}

static const mt_attribute *named(const mt_mesh *mesh, const char *name)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (strcmp(mesh->attributes[i].name, name) == 0) {
            return &mesh->attributes[i];
        }
    }
    fail_msg("no attribute \"%s\"", name);
    return NULL;
}

static double value_at(const mt_attribute *attribute, mt_index element, uint32_t component)
{
    return mt_attribute_get(attribute, mt_attribute_value_index(attribute, element), component);
}

static void expect_faces_inherit(const mt_mesh *mesh, const mt_mesh *refined, unsigned level)
{
    const mt_attribute *old = named(mesh, "tint"), *new = named(refined, "tint");
    for (mt_index face = 0; face < refined->face_count; face++) {
        for (uint32_t k = 0; k < 4; k++) {
            assert_true(value_at(new, face, k) == value_at(old, face >> (2 * level), k));
        }
        for (mt_index set = 0; set < mesh->label_set_count; set++) {
            assert_int_equal(refined->label_sets[set].face_labels[face],
                             mesh->label_sets[set].face_labels[face >> (2 * level)]);
        }
    }
}

/* Old vertices keep their integers, and edge points have those of the vertex of their first corner. */
static void expect_integers(mt_context *context, const mt_mesh *mesh, const mt_mesh *once)
{
    const mt_attribute *old = named(mesh, "quality"), *new = named(once, "quality");
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    mt_index point = mesh->vertex_count;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        assert_true(value_at(new, vertex, 0) == value_at(old, vertex, 0));
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        if (mt_edge_is_first(pairs, corner)) {
            assert_true(value_at(new, point++, 0) == value_at(old, mesh->corner_vertices[corner], 0));
        }
    }
    assert_int_equal(point, once->vertex_count);
    mt_edge_pairs_destroy(context, pairs);
}

/* Linear values: a child has the old corner's own, and the means along both of its sides. */
static void expect_linear_corners(const mt_mesh *mesh, const mt_mesh *once)
{
    const mt_attribute *old = named(mesh, "bend"), *new = named(once, "bend");
    assert_non_null(new->indices);
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index begin = corner - corner % 3, after = begin + (corner + 1) % 3;
        mt_index child = 4 * corner, side = child - child % 3 + (child + 1) % 3;
        double here = value_at(old, corner, 0), middle = (here + value_at(old, after, 0)) / 2;
        assert_true(value_at(new, child, 0) == here);
        assert_true(value_at(new, side, 0) == (double)(float)middle);
        assert_true(value_at(new, 12 * (begin / 3) + 9 + corner % 3, 0) == (double)(float)middle);
    }
}

static void expect_missing_values(const mt_mesh *mesh, const mt_mesh *once)
{
    const mt_attribute *old = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    const mt_attribute *new = mt_mesh_find_attribute(once, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    mt_index missing_count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        bool missing = false;
        for (mt_index k = 0; k < 3; k++) {
            missing = missing || old->indices[3 * face + k] == MT_NONE;
        }
        for (mt_index k = 0; k < 12; k++) {
            assert_int_equal(new->indices[12 * (size_t)face + k] == MT_NONE, missing);
        }
        missing_count += missing;
    }
    assert_in_range(missing_count, 1, mesh->face_count - 1);
}

/* Everything that a mesh can hold, over one and three levels. */
static void test_everything_is_carried(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden_triangles(context);
    mt_mesh *once = subdivide(context, mesh, &(mt_subdivide_options){.level_count = 1});
    mt_mesh *thrice = subdivide(context, mesh, &(mt_subdivide_options){.level_count = 3});
    expect_faces_inherit(mesh, once, 1);
    expect_faces_inherit(mesh, thrice, 3);
    expect_integers(context, mesh, once);
    expect_linear_corners(mesh, once);
    expect_missing_values(mesh, once);
    assert_true(value_at(named(thrice, "time"), 0, 0) == value_at(named(mesh, "time"), 0, 0));
    const mt_attribute *normals = mt_mesh_find_attribute(thrice, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    for (mt_index vertex = 0; vertex < thrice->vertex_count; vertex++) {
        mt_vec3 normal = {value_at(normals, vertex, 0), value_at(normals, vertex, 1), value_at(normals, vertex, 2)};
        assert_true(fabs(mt_vec3_length(normal) - 1) < 1e-6);
    }
    assert_int_equal(thrice->wire_count, mesh->wire_count);
    assert_memory_equal(thrice->wire_vertices, mesh->wire_vertices, 5 * sizeof(mt_index));
    assert_int_equal(thrice->point_count, mesh->point_count);
    assert_memory_equal(thrice->point_vertices, mesh->point_vertices, 3 * sizeof(mt_index));
    mt_mesh_destroy(context, thrice);
    mt_mesh_destroy(context, once);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A float attribute of any width on vertices gets the same numbers as positions, creases or not. */
static void test_vertex_rule(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {3};
    for (uint32_t width = 1; width <= 7; width++) {
        mt_mesh *cage = test_triangle_cage(context, &random, 5, 4, width % 2);
        test_sharpen(context, &random, cage);
        mt_attribute_layout layout = {.domain = MT_DOMAIN_VERTEX, .type = MT_F64, .component_count = width};
        layout.value_count = cage->vertex_count;
        mt_attribute *attribute = NULL;
        assert_int_equal(mt_mesh_add_attribute(context, cage, &layout, &attribute), MT_OK);
        for (mt_index i = 0; i < cage->vertex_count * width; i++) {
            ((double *)attribute->values)[i] = ((double *)cage->positions)[i / width * 3 + i % width % 3];
        }
        mt_mesh *refined = subdivide(context, cage, &(mt_subdivide_options){.level_count = 3});
        for (mt_index i = 0; i < refined->vertex_count * width; i++) {
            assert_true(((double *)refined->attributes[0].values)[i] ==
                        ((double *)refined->positions)[i / width * 3 + i % width % 3]);
        }
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, cage);
    }
    test_context_end(context);
}

/* Two triangles whose UVs meet in a seam, or not. */
static void expect_seam(bool seam, mt_index value_count)
{
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 2, 1, 3};
    static const float values[] = {0, 0, 1, 0, 0, 1, 1, 1, 5, 0, 0, 5};
    mt_mesh *mesh = test_mesh(context, 4, positions, 2, faces);
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = MT_F32,
                                  .component_count = 2,
                                  .value_count = seam ? 6 : 4,
                                  .indexed = true};
    mt_attribute *uv = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &uv), MT_OK);
    memcpy(uv->values, values, uv->value_count * 2 * sizeof(float));
    memcpy(uv->indices, mesh->corner_vertices, 6 * sizeof(mt_index));
    if (seam) {
        uv->indices[3] = 5;
        uv->indices[4] = 4;
    }
    mt_subdivide_options options = {.level_count = 2, .face_varying = MT_SUBDIVIDE_FACE_VARYING_ALL};
    mt_mesh *refined = subdivide(context, mesh, &options);
    assert_int_equal(refined->attributes[0].value_count, value_count);
    options = (mt_subdivide_options){.level_count = 1, .face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_ONLY};
    mt_mesh *smooth = subdivide(context, mesh, &options);
    /* Vertex 1 is a boundary of the first face, (1, 0) of its own there; without a seam it is on a smooth boundary. */
    assert_true(value_at(&smooth->attributes[0], 4, 0) == (seam ? 1 : 0.875));
    assert_true(value_at(&smooth->attributes[0], 4, 1) == (seam ? 0 : 0.125));
    mt_mesh_destroy(context, smooth);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_seams(void **state)
{
    (void)state;
    expect_seam(false, 25);    /* a square of 5 x 5 */
    expect_seam(true, 2 * 15); /* two triangles of 5 + 4 + 3 + 2 + 1 */
}

/* An octahedron, its equator 0-1-2-3 in the plane, and creases around it. */
static mt_mesh *octahedron(mt_context *context, double sharpness)
{
    static const double positions[] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    static const mt_index faces[] = {3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4,
                                     3, 1, 0, 5, 3, 2, 1, 5, 3, 3, 2, 5, 3, 0, 3, 5};
    mt_mesh *mesh = test_mesh(context, 6, positions, 8, faces);
    mesh->creases = mt_allocate_array(context, 4, sizeof *mesh->creases);
    assert_non_null(mesh->creases);
    mesh->crease_count = 4;
    for (mt_index i = 0; i < 4; i++) {
        mesh->creases[i] = (mt_edge_value){i, (i + 1) % 4, sharpness};
    }
    return mesh;
}

/* At the equator a smooth vertex of valence 4 has the weight (5/8 - 9/64)/4 = 31/256 and four neighbours that add up to
 * nothing: 1 - 4 * 31/256 = 33/64; the B-spline's is 3/4; half a level of sharpness is half-way. */
static void test_creases(void **state)
{
    (void)state;
    static const double sharpness[] = {0, 0.5, 1, 2.5, 10}, left[] = {0, 0, 0, 1.5, 10};
    static const double at[] = {33.0 / 64, (33.0 / 64 + 0.75) / 2, 0.75, 0.75, 0.75};
    mt_context *context = test_context();
    for (unsigned i = 0; i < 5; i++) {
        mt_mesh *mesh = octahedron(context, sharpness[i]);
        mt_mesh *refined = subdivide(context, mesh, &(mt_subdivide_options){.level_count = 1});
        mt_vec3 p = mt_mesh_position(refined, 0);
        assert_true(fabs(p.x - at[i]) < 1e-15 && fabs(p.y) < 1e-15 && fabs(p.z) < 1e-15);
        assert_int_equal(refined->crease_count, left[i] > 0 ? 8 : 0);
        for (mt_index k = 0; k < refined->crease_count; k++) {
            const mt_edge_value *crease = &refined->creases[k];
            assert_true(crease->value == left[i]);
            assert_true((crease->a < 4) != (crease->b < 4)); /* an old vertex and an edge point */
            assert_true(mt_mesh_position(refined, crease->a).z == 0 && mt_mesh_position(refined, crease->b).z == 0);
        }
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* The same surface around the hole, whose vertices stay; the counts are foretold. */
static void test_holes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = octahedron(context, 0);
    mt_subdivide_options options = {.level_count = 2, .scheme = MT_SUBDIVIDE_SCHEME_LOOP};
    mt_mesh *whole = subdivide(context, mesh, &options);
    mt_attribute *marks = NULL;
    assert_int_equal(mt_mesh_add_holes(context, mesh, &marks), MT_OK);
    ((uint8_t *)marks->values)[1] = 1;
    mt_mesh *refined = subdivide(context, mesh, &options);
    assert_int_equal(refined->face_count, 7 * 16);
    assert_int_equal(refined->vertex_count, whole->vertex_count);
    assert_memory_equal(refined->positions, whole->positions, 24 * (size_t)whole->vertex_count);
    assert_memory_equal(refined->corner_vertices, whole->corner_vertices, 48 * sizeof(mt_index));
    assert_memory_equal(refined->corner_vertices + 48, whole->corner_vertices + 96, 288 * sizeof(mt_index));
    assert_null(mt_mesh_find_holes(refined));
    mt_edge_pairs *pairs = NULL;
    mt_subdivide_counts counts;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    assert_int_equal(mt_subdivide_count(context, mesh, pairs, &options, 2, &counts), MT_OK);
    assert_true(counts.face_count == refined->face_count && counts.vertex_count == refined->vertex_count);
    mt_edge_pairs_destroy(context, pairs);
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, whole);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Three pages on one spine: its edge point is one vertex of all, in its middle; the pages' outlines are B-splines. */
static void test_non_manifold_edge(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[] = {0, 0, 0, 8, 0, 0, 4, 8, 0, 4, -8, 0, 4, 0, 8};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 1, 0, 3, 3, 0, 1, 4};
    mt_mesh *book = test_mesh(context, 5, positions, 3, faces), *none = NULL;
    mt_subdivide_options options = {.level_count = 1, .scheme = MT_SUBDIVIDE_SCHEME_LOOP};
    assert_int_equal(mt_subdivide(context, book, &options, &none), MT_ERROR_NOT_MANIFOLD);
    assert_non_null(strstr(mt_context_error(context)->message, "Loop subdivision needs a manifold mesh"));
    mt_context_clear_error(context);
    options.non_manifold = MT_SUBDIVIDE_NON_MANIFOLD_SHARP;
    for (unsigned limit = 0; limit < 2; limit++) {
        options.limit = limit;
        mt_mesh *refined = subdivide(context, book, &options);
        assert_int_equal(refined->vertex_count, 5 + 7);
        assert_int_equal(refined->face_count, 12);
        assert_int_equal(refined->corner_vertices[1], 5);
        assert_int_equal(refined->corner_vertices[13], 5);
        assert_int_equal(refined->corner_vertices[25], 5);
        mt_vec3 end = mt_mesh_position(refined, 0), middle = mt_mesh_position(refined, 5);
        mt_vec3 page = mt_mesh_position(refined, 2);
        assert_true(middle.x == 4 && middle.y == 0 && middle.z == 0);
        assert_true(end.x == 0 && end.y == 0 && end.z == 0);
        assert_true(page.x == 4 && fabs(page.y - (limit ? 16.0 / 3 : 6)) < 1e-14 && page.z == 0);
        mt_mesh_destroy(context, refined);
    }
    mt_mesh_destroy(context, book);
    test_context_end(context);
}

static void test_other_faces_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context), *refined = cube;
    mt_subdivide_options options = {.scheme = MT_SUBDIVIDE_SCHEME_LOOP};
    assert_int_equal(mt_subdivide(context, cube, &options, &refined), MT_ERROR_INVALID_MESH);
    assert_null(refined);
    assert_non_null(strstr(mt_context_error(context)->message, "face 0 has 4 sides"));
    assert_non_null(strstr(mt_context_error(context)->message, "convert --triangulate"));
    mt_context_clear_error(context);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_everything_is_carried),
        cmocka_unit_test(test_vertex_rule),
        cmocka_unit_test(test_seams),
        cmocka_unit_test(test_creases),
        cmocka_unit_test(test_holes),
        cmocka_unit_test(test_non_manifold_edge),
        cmocka_unit_test(test_other_faces_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
