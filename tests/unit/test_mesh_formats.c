/* The table of formats: recognition by content and by name, options, and what is refused before anything is written. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/scratch.h"
#include "tests/support/text_reading.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <math.h>
#include <string.h>
#include <unistd.h>

#define OBJ "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
#define OFF "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

static void test_the_table(void **state)
{
    (void)state;
    static const char *const names[] = {"drc", "glb", "gltf", "obj", "off", "ply", "stl"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const mt_mesh_format *format = mt_mesh_format_by_extension(names[i]);
        assert_non_null(format);
        assert_string_equal(format->name, names[i]);
        assert_string_equal(format->extensions[0], names[i]);
    }
    assert_ptr_equal(mt_mesh_format_by_extension("ObJ"), mt_mesh_format_by_extension("obj"));
    assert_null(mt_mesh_format_by_extension("xyz"));
    assert_null(mt_mesh_format_by_extension(""));
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        assert_true((*format)->title[0] && (*format)->sniff && (*format)->read && (*format)->write);
        assert_true((*format)->has_ascii || (*format)->has_binary);
        for (const char *const *extension = (*format)->extensions; *extension; extension++) {
            assert_ptr_equal(mt_mesh_format_by_extension(*extension), *format);
        }
    }
}

static void check_read(const char *name, const char *text, const char *wanted, const char *format, const char *warning)
{
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_mesh_read_options options = {.format = wanted};
    const mt_mesh_format *found = NULL;
    mt_mesh *mesh;
    if (mt_mesh_read_memory(context, name, text, strlen(text), &options, &mesh, &found) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_string_equal(found->name, format);
    assert_int_equal(mesh->face_count, 1);
    assert_string_equal(warnings.text, warning);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_content_wins_over_the_name(void **state)
{
    (void)state;
    check_read("a.obj", OBJ, NULL, "obj", "");
    check_read("a.OBJ", OBJ, NULL, "obj", "");
    check_read("a.unknown", OBJ, NULL, "obj", "");
    check_read("standard input", OFF, NULL, "off", "");
    check_read("folder.stl/a", OFF, NULL, "off", "");
    check_read("a.ply", OBJ, NULL, "obj",
               "a.ply: the content is Wavefront OBJ although the name says PLY; read as Wavefront OBJ\n");
    check_read("a.obj", OFF, NULL, "off",
               "a.obj: the content is OFF although the name says Wavefront OBJ; read as OFF\n");
    /* Counts without the word OFF are too little to go by alone. */
    check_read("a.off", &OFF[4], NULL, "off", "");
    check_read("a.dat", OBJ, "OBJ", "obj", "");
}

static void check_refused(const char *name, const void *bytes, size_t size, const char *wanted, mt_status status,
                          const char *words)
{
    mt_context *context = test_context();
    mt_mesh_read_options options = {.format = wanted};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_read_memory(context, name, bytes, size, &options, &mesh, NULL), status);
    if (!strstr(mt_context_error(context)->message, words)) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_null(mesh);
    test_context_end(context);
}

static void test_what_is_no_mesh(void **state)
{
    (void)state;
    check_refused("a.txt", "", 0, NULL, MT_ERROR_SYNTAX, "is empty (0 bytes)");
    check_refused("a.txt", "hello\n", 6, NULL, MT_ERROR_SYNTAX, "neither the content nor the name");
    check_refused("a.obj.gz", "\x1f\x8b\x08\0\0\0\0\0", 8, NULL, MT_ERROR_SYNTAX, "gzip");
    check_refused("a.obj", "\xff\xfev\0 \0", 6, NULL, MT_ERROR_UNSUPPORTED, "UTF-16");
    check_refused("a.obj", OBJ, strlen(OBJ), "xyz", MT_ERROR_ARGUMENT, "no mesh format is called \"xyz\"");
    check_refused("a.ply", "hello\n", 6, NULL, MT_ERROR_SYNTAX, "a.ply:1");
}

static void test_precision(void **state)
{
    (void)state;
    static const char text[] = "v 0.1 1e300 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_mesh_read_options options = {.precision = MT_PRECISION_F32};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_read_memory(context, "a.obj", text, strlen(text), &options, &mesh, NULL), MT_OK);
    assert_int_equal(mesh->position_type, MT_F32);
    assert_true(((float *)mesh->positions)[0] == 0.1f && isinf(((float *)mesh->positions)[1]));
    assert_string_equal(warnings.text, "a.obj: 1 coordinates are too large for single precision and became infinite\n");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_what_is_refused_before_writing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", OBJ "v 0 0 1\nl 1 2\n");
    const char *path = test_scratch_path("a.xyz");
    mt_mesh_write_options options = {.strict_loss = true};
    assert_int_equal(mt_mesh_write_file(context, mesh, path, NULL, NULL), MT_ERROR_ARGUMENT);
    assert_non_null(
        strstr(mt_context_error(context)->message, "\"xyz\", expected one of: drc, glb, gltf, obj, off, ply, stl"));
    mt_context_clear_error(context);
    assert_int_equal(mt_mesh_write_file(context, mesh, test_scratch_path("plain"), NULL, NULL), MT_ERROR_ARGUMENT);
    assert_non_null(strstr(mt_context_error(context)->message, "no extension"));
    mt_context_clear_error(context);
    mt_loss loss;
    assert_int_equal(mt_mesh_write_file(context, mesh, test_scratch_path("a.stl"), &options, &loss), MT_ERROR_LOSS);
    assert_int_equal(loss.count, 2);
    assert_string_equal(loss.items[0], "1 isolated vertex");
    assert_string_equal(loss.items[1], "1 wire");
    mt_context_clear_error(context);
    options = (mt_mesh_write_options){.encoding = MT_ENCODING_BINARY};
    assert_int_equal(mt_mesh_write_file(context, mesh, test_scratch_path("a.obj"), &options, NULL), MT_ERROR_ARGUMENT);
    assert_string_equal(mt_context_error(context)->message, "Wavefront OBJ has no binary encoding");
    assert_int_equal(test_scratch_count(), 0);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_files_go_by_extension(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", OBJ);
    static const char *const names[] = {"a.obj", "a.OFF", "a.ply", "a.stl"}, *const formats[] = {"obj", "off", "ply",
                                                                                                 "stl"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        const char *path = test_scratch_path(names[i]);
        const mt_mesh_format *format;
        mt_mesh *again;
        assert_int_equal(mt_mesh_write_file(context, mesh, path, NULL, NULL), MT_OK);
        assert_int_equal(mt_mesh_read_file(context, path, NULL, &again, &format), MT_OK);
        assert_string_equal(format->name, formats[i]);
        assert_int_equal(again->face_count, 1);
        mt_mesh_destroy(context, again);
        unlink(path);
    }
    assert_string_equal(mt_mesh_format_for_output(context, "-", NULL)->name, "ply");
    assert_string_equal(mt_mesh_format_for_output(context, "/dev/null", NULL)->name, "ply");
    mt_mesh_write_options options = {.format = "off"};
    assert_string_equal(mt_mesh_format_for_output(context, "a.ply", &options)->name, "off");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Only one attribute of a meaning fits an OBJ file: the corners' goes before the vertices'. */
static void test_loss_of_further_attributes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.obj", OBJ);
    mt_attribute_layout layout = {
        .semantic = MT_SEMANTIC_UV, .domain = MT_DOMAIN_CORNER, .type = MT_F64, .component_count = 3, .value_count = 3};
    mt_attribute *attribute;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
        memset(attribute->values, 0, 9 * sizeof(double));
        layout.domain = MT_DOMAIN_VERTEX;
    }
    mt_loss loss;
    assert_int_equal(mt_mesh_format_loss(context, mesh, mt_mesh_format_by_extension("obj"), NULL, &loss), MT_OK);
    assert_int_equal(loss.count, 1);
    assert_string_equal(loss.items[0], "vertex UVs");
    assert_int_equal(mt_mesh_format_loss(context, mesh, mt_mesh_format_by_extension("off"), NULL, &loss), MT_OK);
    assert_int_equal(loss.count, 2);
    assert_string_equal(loss.items[0], "corner UVs");
    assert_string_equal(loss.items[1], "third component of vertex UVs");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Positions in text with fewer digits, in every format that has text; what has none is not changed. */
static void test_fewer_digits(void **state)
{
    (void)state;
    mt_context *context = mt_context_create(NULL);
    mt_mesh *mesh = NULL, *back = NULL;
    assert_int_equal(mt_generate(context, "icosphere", NULL, &mesh), MT_OK);
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        bool has_digits = !((*format)->abilities & MT_NEEDS_FINITE); /* glTF's numbers are base64 of floats */
        if (!(*format)->has_ascii || !has_digits || !(*format)->read || !(*format)->write) {
            continue;
        }
        mt_mesh_write_options options = {
            .format = (*format)->extensions[0], .encoding = MT_ENCODING_ASCII, .digits = 4};
        void *bytes = NULL;
        size_t size = 0;
        assert_int_equal(mt_mesh_write_memory(context, mesh, &options, &bytes, &size), MT_OK);
        assert_int_equal(mt_mesh_read_memory(context, (*format)->extensions[0], bytes, size, NULL, &back, NULL), MT_OK);
        assert_int_equal(back->vertex_count, mesh->vertex_count);
        double farthest = 0;
        for (mt_index i = 0; !back->welded && i < mesh->vertex_count; i++) {
            mt_vec3 moved = mt_vec3_subtract(mt_mesh_position(back, i), mt_mesh_position(mesh, i));
            farthest = fmax(farthest, mt_vec3_max_abs(moved));
        }
        assert_true(farthest < 0.51e-4);
        assert_true(back->welded || farthest > 1e-6);
        mt_mesh_destroy(context, back);
        mt_free(context, bytes);
    }
    mt_mesh_destroy(context, mesh);
    mt_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fewer_digits),
        cmocka_unit_test(test_the_table),
        cmocka_unit_test(test_content_wins_over_the_name),
        cmocka_unit_test(test_what_is_no_mesh),
        cmocka_unit_test(test_precision),
        cmocka_unit_test(test_what_is_refused_before_writing),
        cmocka_unit_test(test_files_go_by_extension),
        cmocka_unit_test(test_loss_of_further_attributes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
