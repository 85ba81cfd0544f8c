/* Reading and writing OBJ: every form that is read, and the message of everything that is not. */
#include "tests/support/unit.h"

#include <meshtool/subdivision_tags.h>

#include "tests/support/fixture.h"
#include "tests/support/text_reading.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void check_triangle(mt_context *context, const char *text)
{
    mt_mesh *mesh = text_read(context, "a.obj", text);
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->face_size, 3);
    assert_null(mesh->face_offsets);
    for (mt_index i = 0; i < 3; i++) {
        assert_int_equal(mesh->corner_vertices[i], i);
        mt_vec3 p = mt_mesh_position(mesh, i);
        assert_true(p.x == (i == 1) && p.y == (i == 2) && p.z == 0.0);
    }
    mt_mesh_destroy(context, mesh);
}

static void test_forms_of_a_triangle(void **state)
{
    (void)state;
    static const char *const texts[] = {
        TRIANGLE "f 1 2 3\n",
        TRIANGLE "f 1 2 3",                                                  /* no final line end */
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",                      /* CR LF */
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",                              /* lone CR */
        "\xEF\xBB\xBF" TRIANGLE "f 1 2 3\n",                                 /* a UTF-8 mark */
        "  v\t0 0\v0  \nv 1 \f 0 0\nv +0 1. 0e5 # done\n\n# f 9\n f 1 2 3 ", /* blanks, comments */
        "f 1 2 3\n" TRIANGLE,                                                /* forward references */
        TRIANGLE "f -3 -2 -1\n",                                             /* relative ones */
        "v 0 0 0\nv 1 0 0\nf 1 -1 3\nv 0 1 0\n",                             /* mixed with absolute ones */
        TRIANGLE "f 1 \\\n2 \\\r\n 3\n",                                     /* continuations */
        TRIANGLE "f 1\\\n 2 3\n",
        "v 0 0\\\n 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        TRIANGLE "f 1/ 2// 3\n", /* references left open */
        "# a comment that ends in a backslash \\\n" TRIANGLE "f 1 2 3\n",
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        check_triangle(context, texts[i]);
    }
    test_context_end(context);
}

static void check_refused(mt_context *context, const char *text, const char *message)
{
    const char *got = text_refuse(context, "a.obj", text, strlen(text), MT_ERROR_SYNTAX);
    if (strcmp(got, message) != 0) {
        fail_msg("\"%s\", expected \"%s\"", got, message);
    }
}

static void test_what_is_refused_says_why(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "a.obj: is empty (0 bytes), expected a mesh"},
        {TRIANGLE "f 1 2 0\n", "a.obj:4:7: vertex 0 does not exist: OBJ counts from 1"},
        {TRIANGLE "f 1 2 4\n", "a.obj:4:7: vertex 4 does not exist: the file has 3 vertices"},
        {"f 1 2 9\nf 1 2 3\n" TRIANGLE "f 1 2 8", "a.obj:1:7: vertex 9 does not exist: the file has 3 vertices"},
        {TRIANGLE "f 1 2 -4\n", "a.obj:4:7: vertex -4 lies before the first one of the file"},
        {TRIANGLE "f 1 2 -99999999999\n", "a.obj:4:7: the number of a vertex is too large: \"-99999999999\""},
        {TRIANGLE "f 1 2 99999999999\n", "a.obj:4:7: the number of a vertex is too large: \"99999999999\""},
        {TRIANGLE "f 1 2 4294967297\n", "a.obj:4:7: the number of a vertex is too large: \"4294967297\""},
        {TRIANGLE "f 1 2 99999999999999999999999999\n",
         "a.obj:4:7: the number of a vertex is too large: \"99999999999999999999999999\""},
        {TRIANGLE "f 1 2\n", "a.obj:4:1: a face of 2 corners, expected 3 or more"},
        {TRIANGLE "f\n", "a.obj:4:1: a face of 0 corners, expected 3 or more"},
        {TRIANGLE "f 1/2/3/4 1 2\n", "a.obj:4:3: expected a corner as 1, 1/2, 1/2/3 or 1//3, found \"1/2/3/4\""},
        {TRIANGLE "vt 0 0\nvn 0 0 1\nf 1/1/1/4 1 2\n",
         "a.obj:6:3: expected a corner as 1, 1/2, 1/2/3 or 1//3, found \"1/1/1/4\""},
        {TRIANGLE "f 1/a 2 3\n", "a.obj:4:5: expected the number of a texture vertex, found \"a\""},
        {TRIANGLE "f 1 2 x\n", "a.obj:4:7: expected the number of a vertex, found \"x\""},
        {TRIANGLE "f 1 2 3.5\n", "a.obj:4:7: expected a corner as 1, 1/2, 1/2/3 or 1//3, found \"3.5\""},
        {TRIANGLE "f 1 2 +3\n", "a.obj:4:7: expected the number of a vertex, found \"+3\""},
        {"v 0 0\n", "a.obj:1:6: the line ends where a number was expected"},
        {"v 0 0 0 0 0\n", "a.obj:1:1: a vertex with 5 numbers, expected 3, 4 (a weight) or 6 (a color)"},
        {"v 0 0 0 0 0 0 0\n", "a.obj:1:1: a vertex with 7 numbers, expected 3, 4 (a weight) or 6 (a color)"},
        {"v 0 0 0 0 0 0 0 0\n",
         "a.obj:1:17: a vertex with more than 6 numbers, expected 3, 4 (a weight) or 6 (a color)"},
        {"v 1,5 0 0\n", "a.obj:1:3: expected a number, found \"1,5\": a decimal comma is not read"},
        {"v 0 0 1e309\n", "a.obj:1:7: 1e309 is past the largest double"},
        {"v 0 0 0x10\n", "a.obj:1:7: expected a number, found \"0x10\""},
        {"v 0 0 1.5.2\n", "a.obj:1:7: expected a number, found \"1.5.2\""},
        {"vn 0 0\n", "a.obj:1:7: the line ends where a number was expected"},
        {"vn 0 0 1 1\n", "a.obj:1:10: expected the end of the line, found \"1\""},
        {"vt\n", "a.obj:1:3: the line ends where a number was expected"},
        {TRIANGLE "f 1 2 3 \\", "a.obj:4:9: the file ends after a backslash, expected the line to go on"},
        {TRIANGLE "f 1 2 3 \\\n", "a.obj:4:9: the file ends after a backslash, expected the line to go on"},
        {TRIANGLE "vt 0 0\nf 1/1 2/2 3/1\n",
         "a.obj:5:9: texture vertex 2 does not exist: the file has 1 texture vertices"},
        {TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//-2\n", "a.obj:5:16: normal -2 lies before the first one of the file"},
        {TRIANGLE "l 1\n", "a.obj:4:1: a wire of 1 vertices, expected 2 or more"},
        {TRIANGLE "l 1 4\n", "a.obj:4:5: vertex 4 does not exist: the file has 3 vertices"},
        {TRIANGLE "p\n", "a.obj:4:1: a point statement without a vertex, expected 1 or more"},
        {TRIANGLE "p 4\n", "a.obj:4:3: vertex 4 does not exist: the file has 3 vertices"},
        {TRIANGLE "t crease 2/1/0 0 3 2\n",
         "a.obj:4:18: vertex 3 of a tag does not exist: tags count from 0 and the file has 3 vertices"},
        {TRIANGLE "t crease 2/1 0 1 2\n", "a.obj:4:10: in a tag, expected three counts as 2/1/0, found \"2/1\""},
        {TRIANGLE "t corner 1/1/0 0\n", "a.obj:4:17: the line ends where a number was expected"},
        {TRIANGLE "t hole 1/0/0 0\n",
         "a.obj:4:14: face 0 of a tag does not exist: tags count from 0 and the file has 0 "
         "faces"},
        {TRIANGLE "t hole 0/1/0 0\n",
         "a.obj:4:1: in a tag, expected hole N/0/0 and the numbers of the faces, found \"t\""},
        {TRIANGLE "t interpolateboundary 1/0/0 3\n", "a.obj:4:29: in a tag, expected 0, 1 or 2, found \"3\""},
        {TRIANGLE "t creasemethod 0/0/1 loop\n", "a.obj:4:22: in a tag, expected normal or chaikin, found \"loop\""},
        {"hello world\n", "a.obj:1:1: no OBJ statement is in this file, which begins with \"hello\""},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_refused(context, cases[i].text, cases[i].message);
    }
    static const char nul[] = TRIANGLE "f 1 2 \0 3\n";
    assert_string_equal(text_refuse(context, "a.obj", nul, sizeof nul - 1, MT_ERROR_SYNTAX),
                        "a.obj:4:7: a NUL byte in text");
    static const char wide[] = "\xFF\xFEv\0 \0";
    assert_non_null(strstr(text_refuse(context, "a.obj", wide, sizeof wide - 1, MT_ERROR_UNSUPPORTED), "UTF-16"));
    test_context_end(context);
}

static void test_what_is_let_go_is_warned_of_once(void **state)
{
    (void)state;
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_mesh *mesh = text_read(context, "a.obj",
                              "mtllib ../up.mtl\nmtllib ../up.mtl\nv 0 0 0 2\nv 1 0 nan\nv 0 1 inf 1\nvp 1\nvp 2\n"
                              "cstype \\\n bezier\nt blob 1/0/0 3\nvt 0 0\nf 1 2 3\n");
    assert_string_equal(warnings.text,
                        "a.obj: no face uses the 1 texture vertices, which are left out\n"
                        "a.obj:1: the material library \"../up.mtl\" is kept by name and not opened\n"
                        "a.obj:6: the keyword \"vp\" is not known; its lines are left out\n"
                        "a.obj:8: the keyword \"cstype\" is not known; its lines are left out\n"
                        "a.obj:10: the tag \"blob\" is not known and left out\n"
                        "a.obj: 1 vertices have a weight (a fourth number that is not 1), which is left out\n"
                        "a.obj: 2 vertices have a coordinate that is not finite (nan or inf)\n");
    assert_int_equal(mesh->material_library_count, 1);
    assert_string_equal(mesh->material_libraries[0], "../up.mtl");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Holes and settings, the last of each, here and after a round trip. */
static void test_tags_of_subdivision(void **state)
{
    (void)state;
    static const unsigned expected[MT_TAG_COUNT] = {
        [MT_TAG_BOUNDARY] = 1, [MT_TAG_FACE_VARYING] = 4, [MT_TAG_CREASE_METHOD] = 1, [MT_TAG_SMOOTH_TRIANGLES] = 1};
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj",
                              TRIANGLE "f 1 2 3\nf 3 2 1\nf 1 3 2\nt hole 2/0/0 0 2\nt interpolateboundary 1/0/0 2\n"
                                       "t interpolateboundary 1/0/0 1\nt facevaryinginterpolateboundary 1/0/0 4\n"
                                       "t creasemethod 0/0/1 chaikin\nt smoothtriangles 0/0/1 smooth\n");
    mt_mesh *again = text_through(context, mesh, "obj", MT_ENCODING_ASCII);
    const mt_mesh *meshes[] = {mesh, again};
    for (unsigned i = 0; i < 2; i++) {
        const mt_attribute *holes = mt_mesh_find_holes(meshes[i]);
        assert_non_null(holes);
        assert_true(mt_face_is_hole(holes, 0) && !mt_face_is_hole(holes, 1) && mt_face_is_hole(holes, 2));
        for (unsigned tag = 0; tag < MT_TAG_COUNT; tag++) {
            unsigned value = 99;
            assert_true(mt_subdivision_tag_get(meshes[i], (mt_subdivision_tag)tag, &value));
            assert_int_equal(value, expected[tag]);
        }
    }
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_empty_files(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", "# nothing here\n");
    assert_int_equal(mesh->vertex_count, 0);
    assert_int_equal(mesh->face_count, 0);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static const char rich[] =
    "mtllib a.mtl\no body\ng front side\nusemtl red\ns 1\n"
    "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 1\nv 1 1 0 0.1 0.2 0.3\nv 0 1 0 1 1 1\nv 0.1 2 1e-300 0 0 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1 0.5\nvn 0 0 1\nvn 0 1 0\n"
    "f 1/1/1 2/2/1 3/3/2 4\nusemtl blue\ns off\nf 1//2 3//-1 5/-3\nusemtl red\nf 1 2 3\n"
    "l 1 2 3 -1\nl 4 5\np 1 -2\nt crease 3/1/0 0 1 2 2.5\nt crease 3/2/0 2 3 0 1 inf\nt corner 1/1/0 4 10\n";

static void check_labels(const mt_mesh *mesh, mt_label_kind kind, const char *first, const char *second,
                         const char *third)
{
    const char *expected[] = {first, second, third};
    const mt_labels *labels = mt_mesh_find_labels(mesh, kind);
    assert_non_null(labels);
    for (mt_index face = 0; face < 3; face++) {
        mt_index label = labels->face_labels[face];
        if (expected[face]) {
            assert_string_equal(labels->names[label], expected[face]);
        } else {
            assert_int_equal(label, MT_NONE);
        }
    }
}

static void check_rich(const mt_mesh *mesh)
{
    static const mt_index offsets[] = {0, 4, 7, 10}, corners[] = {0, 1, 2, 3, 0, 2, 4, 0, 1, 2};
    static const mt_index uvs[] = {0, 1, 2, MT_NONE, MT_NONE, MT_NONE, 0, MT_NONE, MT_NONE, MT_NONE};
    static const mt_index normals[] = {0, 0, 1, MT_NONE, 1, 1, MT_NONE, MT_NONE, MT_NONE, MT_NONE};
    assert_int_equal(mesh->face_count, 3);
    assert_memory_equal(mesh->face_offsets, offsets, sizeof offsets);
    assert_memory_equal(mesh->corner_vertices, corners, sizeof corners);
    const mt_attribute *uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    const mt_attribute *normal = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    const mt_attribute *color = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_VERTEX);
    assert_non_null(uv);
    assert_non_null(normal);
    assert_non_null(color);
    assert_memory_equal(uv->indices, uvs, sizeof uvs);
    assert_memory_equal(normal->indices, normals, sizeof normals);
    assert_int_equal(uv->component_count, 3);
    assert_true(mt_attribute_get(uv, 2, 2) == 0.5 && mt_attribute_get(uv, 1, 2) == 0.0);
    assert_true(mt_attribute_get(color, 2, 1) == 0.2 && color->type == MT_F64 && !color->indices);
    assert_int_equal(mesh->wire_count, 2);
    assert_int_equal(mesh->wire_offsets[1], 4);
    assert_int_equal(mesh->wire_vertices[3], 4);
    assert_int_equal(mesh->point_count, 2);
    assert_int_equal(mesh->point_vertices[1], 3);
    assert_int_equal(mesh->crease_count, 4);
    assert_true(mesh->creases[1].a == 1 && mesh->creases[1].b == 2 && mesh->creases[1].value == 2.5);
    assert_true(mesh->creases[3].a == 3 && mesh->creases[3].b == 0 && isinf(mesh->creases[3].value));
    assert_int_equal(mesh->sharp_vertex_count, 1);
    assert_true(mesh->sharp_vertices[0].vertex == 4 && mesh->sharp_vertices[0].value == 10.0);
    check_labels(mesh, MT_LABEL_OBJECT, "body", "body", "body");
    check_labels(mesh, MT_LABEL_GROUP, "front side", "front side", "front side");
    check_labels(mesh, MT_LABEL_MATERIAL, "red", "blue", "red");
    check_labels(mesh, MT_LABEL_SMOOTHING, "1", NULL, NULL);
    assert_int_equal(mt_mesh_find_labels(mesh, MT_LABEL_MATERIAL)->name_count, 2);
    assert_true(mt_mesh_position(mesh, 4).z == 1e-300);
}

static void test_everything_is_kept_and_round_trips(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", rich);
    check_rich(mesh);
    mt_loss loss;
    assert_int_equal(mt_mesh_format_loss(context, mesh, mt_mesh_format_by_extension("OBJ"), NULL, &loss), MT_OK);
    assert_int_equal(loss.count, 0);
    mt_mesh *again = text_through(context, mesh, "obj", MT_ENCODING_ASCII);
    check_rich(again);
    assert_int_equal(test_mesh_hash(again), test_mesh_hash(mesh));
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_normals_by_vertex_are_normals_of_vertices(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj",
                              TRIANGLE "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1/1 2/3/2 3/2/3\n");
    const mt_attribute *normal = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    assert_non_null(normal);
    assert_null(normal->indices);
    assert_non_null(mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER));
    mt_mesh *again = text_through(context, mesh, "obj", MT_ENCODING_DEFAULT);
    assert_int_equal(test_mesh_hash(again), test_mesh_hash(mesh));
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Names that would break a line or not be names at all. */
static void test_labels_of_other_formats(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", TRIANGLE "f 1 2 3\nf 3 2 1\n");
    mt_labels *labels;
    mt_index number;
    assert_int_equal(mt_mesh_add_labels(context, mesh, MT_LABEL_GROUP, &labels), MT_OK);
    assert_int_equal(mt_labels_add_name(context, labels, "two\nlines", &number), MT_OK);
    labels->face_labels[1] = number;
    mt_mesh *again = text_through(context, mesh, "obj", MT_ENCODING_DEFAULT);
    labels = mt_mesh_find_labels(again, MT_LABEL_GROUP);
    assert_int_equal(labels->face_labels[0], MT_NONE);
    assert_string_equal(labels->names[labels->face_labels[1]], "two_lines");
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms_of_a_triangle),
        cmocka_unit_test(test_what_is_refused_says_why),
        cmocka_unit_test(test_what_is_let_go_is_warned_of_once),
        cmocka_unit_test(test_tags_of_subdivision),
        cmocka_unit_test(test_empty_files),
        cmocka_unit_test(test_everything_is_kept_and_round_trips),
        cmocka_unit_test(test_normals_by_vertex_are_normals_of_vertices),
        cmocka_unit_test(test_labels_of_other_formats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
