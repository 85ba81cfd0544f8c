/* What lies on a mesh follows surgery, on every structure: small cases by hand. */
#include "tests/support/laden_mesh.h"
#include "tests/support/soup.h"
#include "tests/support/surgery_case.h"
#include "tests/support/unit.h"

#include <math.h>

static double at_corner(const mt_mesh *mesh, const char *name, mt_index face, mt_index vertex)
{
    const mt_attribute *attribute = test_surgery_find(mesh, name);
    mt_index value = mt_attribute_value_index(attribute, test_surgery_corner(mesh, face, vertex));
    return value == MT_NONE ? -1 : mt_attribute_get(attribute, value, 0);
}

/* Two triangles (0 1 2) and (1 0 3) with a seam of "u" along their edge, a label and a crease on it. */
static mt_mesh *two_triangles(mt_context *context)
{
    const double positions[12] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 4, -4, 0};
    const mt_index faces[] = {3, 0, 1, 2, 3, 1, 0, 3};
    mt_mesh *mesh = test_mesh(context, 4, positions, 2, faces);
    const mt_attribute_layout layouts[] = {
        {"u", MT_SEMANTIC_UV, MT_DOMAIN_CORNER, MT_F64, 2, 6, true},
        {"count", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_I32, 1, 4, false},
        {"shade", MT_SEMANTIC_COLOR, MT_DOMAIN_FACE, MT_U8, 1, 2, false},
        {"normal", MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX, MT_F32, 3, 4, false},
        {"time", MT_SEMANTIC_GENERIC, MT_DOMAIN_MESH, MT_F32, 1, 1, false},
    };
    for (size_t i = 0; i < sizeof layouts / sizeof *layouts; i++) {
        test_surgery_attribute(context, mesh, &layouts[i]);
    }
    mt_attribute *u = &mesh->attributes[0], *count = &mesh->attributes[1], *shade = &mesh->attributes[2];
    mt_attribute *normal = &mesh->attributes[3], *time = &mesh->attributes[4];
    mt_attribute_set(time, 0, 0, 7.5);
    for (mt_index i = 0; i < 6; i++) {
        u->indices[i] = i;
        mt_attribute_set(u, i, 0, 10 * i);
        mt_attribute_set(u, i, 1, 1);
    }
    for (mt_index i = 0; i < 4; i++) {
        mt_attribute_set(count, i, 0, 100 + i);
        for (uint32_t k = 0; k < 3; k++) {
            mt_attribute_set(normal, i, k, k == i % 3);
        }
    }
    mt_attribute_set(shade, 0, 0, 11);
    mt_attribute_set(shade, 1, 0, 22);
    mt_labels *labels = NULL;
    mt_index number;
    assert_int_equal(mt_mesh_add_labels(context, mesh, MT_LABEL_GROUP, &labels), MT_OK);
    assert_int_equal(mt_labels_add_name(context, labels, "left", &number), MT_OK);
    labels->face_labels[0] = 0;
    mesh->creases = mt_allocate(context, sizeof *mesh->creases);
    mesh->creases[0] = (mt_edge_value){1, 0, 2.5};
    mesh->crease_count = 1;
    return mesh;
}

static double crease_of(const mt_mesh *mesh, mt_index a, mt_index b)
{
    for (mt_index i = 0; i < mesh->crease_count; i++) {
        mt_edge_value crease = mesh->creases[i];
        if ((crease.a == a && crease.b == b) || (crease.a == b && crease.b == a)) {
            return crease.value;
        }
    }
    return -1;
}

static void a_split_edge_passes_everything_on(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t i = 0; i < test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i];
        mt_mesh *source = two_triangles(context);
        void *surgery = test_surgery_begin(context, surgeon, source);
        test_surgery_operate(context, surgeon, surgery,
                             (test_operation){.kind = TEST_SPLIT_EDGE, .a = 0, .b = 1, .weight = 0.25});
        mt_mesh *mesh = test_surgery_finish(context, surgeon, surgery, source);
        assert_int_equal(mesh->vertex_count, 5);
        assert_int_equal(mesh->face_count, 4);
        assert_true(mt_mesh_position(mesh, 4).x == 1);
        assert_true(at_corner(mesh, "u", 0, 4) == 2.5 && at_corner(mesh, "u", 2, 4) == 2.5);
        assert_true(at_corner(mesh, "u", 1, 4) == 37.5 && at_corner(mesh, "u", 3, 4) == 37.5);
        assert_true(at_corner(mesh, "u", 2, 1) == 10 && at_corner(mesh, "u", 2, 2) == 20);
        assert_true(at_corner(mesh, "u", 3, 1) == 30 && at_corner(mesh, "u", 3, 3) == 50);
        assert_true(mt_attribute_get(test_surgery_find(mesh, "count"), 4, 0) == 100);
        assert_true(mt_attribute_get(test_surgery_find(mesh, "shade"), 2, 0) == 11 &&
                    mt_attribute_get(test_surgery_find(mesh, "shade"), 3, 0) == 22);
        assert_true(mt_attribute_get(test_surgery_find(mesh, "time"), 0, 0) == 7.5);
        double x = mt_attribute_get(test_surgery_find(mesh, "normal"), 4, 0),
               y = mt_attribute_get(test_surgery_find(mesh, "normal"), 4, 1);
        assert_true(fabs(x - 0.9486833) < 1e-6 && fabs(y - 0.3162278) < 1e-6);
        const mt_labels *labels = mt_mesh_find_labels(mesh, MT_LABEL_GROUP);
        assert_true(labels->face_labels[0] == 0 && labels->face_labels[2] == 0);
        assert_true(labels->face_labels[1] == MT_NONE && labels->face_labels[3] == MT_NONE);
        assert_true(crease_of(mesh, 0, 4) == 2.5 && crease_of(mesh, 4, 1) == 2.5 && crease_of(mesh, 0, 1) == -1);
        /* the corner that two triangles share keeps one value */
        const mt_attribute *u = test_surgery_find(mesh, "u");
        assert_int_equal(u->indices[test_surgery_corner(mesh, 0, 4)], u->indices[test_surgery_corner(mesh, 2, 4)]);
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, source);
    }
    test_context_end(context);
}

static void a_swapped_edge_keeps_values_with_their_vertices(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t i = 0; i < test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i];
        mt_mesh *source = two_triangles(context);
        void *surgery = test_surgery_begin(context, surgeon, source);
        test_surgery_operate(context, surgeon, surgery, (test_operation){.kind = TEST_SWAP_EDGE, .a = 1, .b = 0});
        mt_mesh *mesh = test_surgery_finish(context, surgeon, surgery, source);
        assert_true(at_corner(mesh, "u", 0, 0) == 0 && at_corner(mesh, "u", 0, 2) == 20);
        assert_true(at_corner(mesh, "u", 0, 3) == 50 && at_corner(mesh, "u", 1, 3) == 50);
        assert_true(at_corner(mesh, "u", 1, 1) == 30 && at_corner(mesh, "u", 1, 2) == 20);
        assert_int_equal(mesh->crease_count, 0);
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, source);
    }
    test_context_end(context);
}

/* A fan around 0 whose rim is 1 to 6; wires, points and sharpness of the vertex that goes pass to the one that stays.
 */
static void a_collapsed_edge_merges_what_lies_on_its_ends(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t i = 0; i < test_surgeon_count; i++) {
        const test_surgeon *surgeon = &test_surgeons[i];
        mt_mesh *source = test_fan(context, 6, true);
        source->creases = mt_allocate(context, 3 * sizeof *source->creases);
        source->creases[0] = (mt_edge_value){1, 2, 1};
        source->creases[1] = (mt_edge_value){0, 2, 3};
        source->creases[2] = (mt_edge_value){0, 4, 5};
        source->crease_count = 3;
        source->sharp_vertices = mt_allocate(context, 2 * sizeof *source->sharp_vertices);
        source->sharp_vertices[0] = (mt_vertex_value){1, 1};
        source->sharp_vertices[1] = (mt_vertex_value){0, 4};
        source->sharp_vertex_count = 2;
        source->point_vertices = mt_allocate(context, sizeof(mt_index));
        source->point_vertices[0] = 0;
        source->point_count = 1;
        source->wire_offsets = mt_allocate(context, 2 * sizeof(mt_index));
        source->wire_vertices = mt_allocate(context, 3 * sizeof(mt_index));
        source->wire_offsets[0] = 0, source->wire_offsets[1] = 3;
        source->wire_vertices[0] = 2, source->wire_vertices[1] = 0, source->wire_vertices[2] = 5;
        source->wire_count = 1;
        mt_vec3 gone = mt_mesh_position(source, 0), kept = mt_mesh_position(source, 1);
        void *surgery = test_surgery_begin(context, surgeon, source);
        test_surgery_operate(context, surgeon, surgery,
                             (test_operation){.kind = TEST_COLLAPSE_EDGE, .a = 0, .b = 1, .weight = 0.5});
        mt_mesh *mesh = test_surgery_finish(context, surgeon, surgery, source);
        assert_int_equal(mesh->vertex_count, 6); /* all numbers are one lower */
        assert_true(mt_mesh_position(mesh, 0).x == (gone.x + kept.x) / 2);
        assert_true(crease_of(mesh, 0, 1) == 3 && crease_of(mesh, 0, 3) == 5);
        assert_int_equal(mesh->crease_count, 2);
        assert_int_equal(mesh->sharp_vertex_count, 1);
        assert_true(mesh->sharp_vertices[0].vertex == 0 && mesh->sharp_vertices[0].value == 4);
        assert_true(mesh->point_count == 1 && mesh->point_vertices[0] == 0);
        assert_int_equal(mesh->wire_count, 1);
        assert_true(mesh->wire_vertices[0] == 1 && mesh->wire_vertices[1] == 0 && mesh->wire_vertices[2] == 4);
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, source);
    }
    test_context_end(context);
}

/* The fan's center collapses along a seam: corners in one sheet take that sheet's mixture, those in the other its own.
 */
static void seams_stay_where_they_are(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *source = test_fan(context, 6, true);
    mt_attribute *sheet = test_surgery_attribute(
        context, source,
        &(mt_attribute_layout){"sheet", MT_SEMANTIC_GENERIC, MT_DOMAIN_CORNER, MT_F64, 1, source->corner_count, false});
    for (mt_index c = 0; c < source->corner_count; c++) {
        mt_attribute_set(sheet, c, 0, (c / 3 < 3 ? 0 : 1000) + source->corner_vertices[c]);
    }
    mt_index seam = source->corner_vertices[1]; /* between the last face and the first */
    for (size_t i = 0; i < test_surgeon_count; i++) {
        void *surgery = test_surgery_begin(context, &test_surgeons[i], source);
        test_operation collapse = {.kind = TEST_COLLAPSE_EDGE, .a = 0, .b = seam, .weight = 0.25};
        test_surgery_operate(context, &test_surgeons[i], surgery, collapse);
        mt_mesh *mesh = test_surgery_finish(context, &test_surgeons[i], surgery, source);
        assert_int_equal(mesh->face_count, 4);
        for (mt_index face = 0; face < 4; face++) {
            double expected = (face < 2 ? 0 : 1000) + 0.75 * seam;
            assert_true(at_corner(mesh, "sheet", face, seam - 1) == expected);
        }
        mt_mesh_destroy(context, mesh);
    }
    mt_mesh_destroy(context, source);
    test_context_end(context);
}

static void nothing_done_gives_the_source_back(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *source = NULL;
    assert_int_equal(test_laden_mesh(context, &source), MT_OK);
    for (size_t i = 0; i < test_surgeon_count; i++) {
        if (!test_surgeons[i].triangles_only) {
            void *surgery = test_surgery_begin(context, &test_surgeons[i], source);
            mt_mesh *mesh = test_surgery_finish(context, &test_surgeons[i], surgery, source);
            assert_true(test_mesh_hash(mesh) == test_mesh_hash(source));
            mt_mesh_destroy(context, mesh);
        }
    }
    mt_mesh_destroy(context, source);
    test_context_end(context);
}

static void another_source_is_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *source = test_fan(context, 6, true), *other = test_fan(context, 5, true), *mesh = NULL;
    for (size_t i = 0; i < test_surgeon_count; i++) {
        void *surgery = test_surgery_begin(context, &test_surgeons[i], source);
        assert_int_equal(test_surgeons[i].to_mesh(context, surgery, other, &mesh), MT_ERROR_ARGUMENT);
        assert_null(mesh);
        mt_context_clear_error(context);
        test_surgeons[i].destroy(context, surgery);
    }
    mt_mesh_destroy(context, source);
    mt_mesh_destroy(context, other);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_split_edge_passes_everything_on),
        cmocka_unit_test(a_swapped_edge_keeps_values_with_their_vertices),
        cmocka_unit_test(a_collapsed_edge_merges_what_lies_on_its_ends),
        cmocka_unit_test(seams_stay_where_they_are),
        cmocka_unit_test(nothing_done_gives_the_source_back),
        cmocka_unit_test(another_source_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
