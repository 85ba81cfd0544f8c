/* Reading and writing OFF: the family of headers, colours, binary files, and the message of everything refused. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/text_reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VERTICES "0 0 0\n1 0 0\n0 1 0\n"

static void check_triangle(mt_context *context, const char *text)
{
    mt_mesh *mesh = text_read(context, "a.off", text);
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->face_size, 3);
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
        "OFF\n3 1 3\n" VERTICES "3 0 1 2\n",
        "OFF\n3 1\n" VERTICES "3 0 1 2",    /* no edges, no line end */
        "OFF 3 1 0\n" VERTICES "3 0 1 2\n", /* on one line */
        "OFF3 1 0\n" VERTICES "3 0 1 2\n",  /* glued */
        "3 1 0\n" VERTICES "3 0 1 2\n",     /* no header */
        "# c\n\nOFF # d\n#e\n\n3 1 0 # f\n# g\n0 0 0 # h\n\n 1 0 0\n\t0 1 0\n#i\n3 0 1 2 #j\n", /* comments */
        "OFF\r\n3 1 0\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2\r\n",
        "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r",
        "\xEF\xBB\xBFOFF\n3 1 0\n" VERTICES "3 0 1 2\n",
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        check_triangle(context, texts[i]);
    }
    test_context_end(context);
}

static void test_what_is_refused_says_why(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
        mt_status status;
    } cases[] = {
        {"", "a.off: is empty (0 bytes), expected a mesh", MT_ERROR_SYNTAX},
        {"OFF", "a.off: the file ends before the counts of vertices and faces were read", MT_ERROR_SYNTAX},
        {"OFF\n3\n", "a.off:2:2: the line ends where the counts of vertices and faces were expected", MT_ERROR_SYNTAX},
        {"OFF\n-3 1 0\n", "a.off:2:1: a count of -3, expected 0 or more", MT_ERROR_SYNTAX},
        {"OFF\n3 -1 0\n", "a.off:2:3: a count of -1, expected 0 or more", MT_ERROR_SYNTAX},
        {"OFF\n3 x 0\n", "a.off:2:3: expected the counts of vertices and faces, found \"x\"", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0 4\n", "a.off:2:7: expected the counts of vertices and faces, found \"4\"", MT_ERROR_SYNTAX},
        {"OFF\n5000000000 1 0\n", "a.off:2:1: a count of 5000000000, more than an index can name", MT_ERROR_SYNTAX},
        {"OFF\n4000000000 1 0\n0 0 0\n",
         "a.off: the file ends after 1 of 4000000001 vertices and faces, expected one a line", MT_ERROR_SYNTAX},
        {"OFF\n3 2 0\n" VERTICES "3 0 1 2\n",
         "a.off: the file ends after 4 of 5 vertices and faces, expected one a line", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1 3\n",
         "a.off:6:7: vertex 3 does not exist: the file has 3 vertices, counted from 0", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1 -1\n",
         "a.off:6:7: vertex -1 does not exist: the file has 3 vertices, counted from 0", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1\n", "a.off:6:6: the line ends where a vertex of the face was expected",
         MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1 x\n", "a.off:6:7: expected the number of a vertex, found \"x\"",
         MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "2 0 1\n", "a.off:6:1: a face of 2 corners, expected 3 or more", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "4000000000 0 1 2\n", "a.off:6:1: expected the sides of a face, found \"4000000000\"",
         MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1 2 300 0 0\n", "a.off:6:1: a color of 300, expected 0 to 255", MT_ERROR_SYNTAX},
        {"OFF\n3 1 0\n" VERTICES "3 0 1 2 1 1 1 1 1\n", "a.off:6:17: expected the end of the line, found \"1\"",
         MT_ERROR_SYNTAX},
        {"OFF\n1 0 0\n0 0\n", "a.off:3:4: the line ends where a number was expected", MT_ERROR_SYNTAX},
        {"OFF\n1 0 0\n0 0 1,5\n", "a.off:3:5: expected a number, found \"1,5\": a decimal comma is not read",
         MT_ERROR_SYNTAX},
        {"OFF\n1 0 0\n0 0 0 1\n", "a.off:3:7: expected the end of the line, found \"1\"", MT_ERROR_SYNTAX},
        {"NOFF\n1 0 0\n0 0 0 1\n", "a.off:3:1: a vertex with 4 numbers, expected 6", MT_ERROR_SYNTAX},
        {"COFF\n1 0 0\n0 0 0\n", "a.off:3:1: a vertex with 3 numbers, expected 4 or more", MT_ERROR_SYNTAX},
        {"4OFF\n1 0 0\n", "a.off:1:1: 4OFF (vertices of 4 numbers) is not read, only three dimensions",
         MT_ERROR_UNSUPPORTED},
        {"nOFF\n2\n1 0 0\n", "a.off:1:1: nOFF (vertices of any numbers) is not read, only three dimensions",
         MT_ERROR_UNSUPPORTED},
        {"4OFF BINARY\n", "a.off: 4OFF (vertices of other than three numbers) is not read", MT_ERROR_UNSUPPORTED},
        {"nonsense\n", "a.off:1:1: expected OFF or the counts of vertices and faces, found \"nonsense\"",
         MT_ERROR_SYNTAX},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *got = text_refuse(context, "a.off", cases[i].text, strlen(cases[i].text), cases[i].status);
        if (strcmp(got, cases[i].message) != 0) {
            fail_msg("\"%s\", expected \"%s\"", got, cases[i].message);
        }
    }
    static const char nul[] = "OFF\n1 0 0\n0 \0 0\n";
    assert_string_equal(text_refuse(context, "a.off", nul, sizeof nul - 1, MT_ERROR_SYNTAX),
                        "a.off:3:3: a NUL byte in text");
    test_context_end(context);
}

static void test_empty_mesh_and_lines_left_over(void **state)
{
    (void)state;
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_mesh *mesh = text_read(context, "a.off", "OFF\n0 0 0\n");
    assert_int_equal(mesh->vertex_count + mesh->face_count, 0);
    assert_int_equal(warnings.count, 0);
    mt_mesh_destroy(context, mesh);
    mesh = text_read(context, "a.off", "OFF\n3 1 0\n" VERTICES "3 0 1 2\nmore\n\nand more\n");
    assert_string_equal(warnings.text, "a.off: 2 lines after the last face are left out\n");
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void check_color(const mt_mesh *mesh, mt_domain domain, mt_type type, uint32_t components,
                        const double *expected)
{
    const mt_attribute *color = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, domain);
    assert_non_null(color);
    assert_int_equal(color->type, type);
    assert_int_equal(color->component_count, components);
    for (mt_index i = 0; i < color->value_count; i++) {
        for (uint32_t k = 0; k < components; k++) {
            assert_true(mt_attribute_get(color, i, k) == expected[i * components + k]);
        }
    }
}

static void test_colors(void **state)
{
    (void)state;
    static const struct {
        const char *tails[3]; /* of three faces */
        mt_type type;
        uint32_t components;
        double expected[12];
    } cases[] = {
        {{" 255 0 1", " 0 0 0", " 1 2 3"}, MT_U8, 3, {255, 0, 1, 0, 0, 0, 1, 2, 3}},
        {{" 255 0 1 9", " 0 0 0", " 7"}, MT_U8, 4, {255, 0, 1, 9, 0, 0, 0, 255, 7, 7, 7, 255}},
        {{" 0.5 0 1", " 1 0 0", " 255 255 0"}, MT_F64, 3, {0.5, 0, 1, 1, 0, 0, 1, 1, 0}},
        {{" 0.5", " 0.25", " 0"}, MT_F64, 1, {0.5, 0.25, 0}},
        {{" 0.5 0.5", " 0.25 1.0", " 0.1"}, MT_F64, 2, {0.5, 0.5, 0.25, 1, 0.1, 1}},
        {{" 200 0 0", "", " 0 0 0"}, MT_U8, 3, {200, 0, 0, 255, 255, 255, 0, 0, 0}},
        {{"", "", " 0.0 0.0 0.5"}, MT_F64, 3, {1, 1, 1, 1, 1, 1, 0, 0, 0.5}},
        {{" 1 0 0", " 0 1 0", " 0 0 0"}, MT_F64, 3, {1, 0, 0, 0, 1, 0, 0, 0, 0}},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[400];
        snprintf(text, sizeof text, "OFF\n3 3 0\n" VERTICES "3 0 1 2%s\n3 2 1 0%s # c\n3 1 0 2%s\n", cases[i].tails[0],
                 cases[i].tails[1], cases[i].tails[2]);
        mt_mesh *mesh = text_read(context, "a.off", text);
        check_color(mesh, MT_DOMAIN_FACE, cases[i].type, cases[i].components, cases[i].expected);
        mt_mesh *again = text_through(context, mesh, "off", MT_ENCODING_DEFAULT);
        if (cases[i].components >= 3) {
            check_color(again, MT_DOMAIN_FACE, cases[i].type, cases[i].components, cases[i].expected);
        }
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void test_dark_bytes_stay_dark(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = text_read(context, "a.off", "OFF\n3 1 0\n" VERTICES "3 0 1 2 9 9 9\n");
    mt_attribute *color = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE);
    memset(color->values, 1, 3);
    mt_mesh *again = text_through(context, mesh, "off", MT_ENCODING_DEFAULT);
    color = mt_mesh_find_attribute(again, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE);
    assert_true(mt_attribute_get(color, 0, 0) / mt_color_maximum(color->type) == 1.0 / 255.0);
    mt_mesh_destroy(context, again);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_vertices_with_everything(void **state)
{
    (void)state;
    static const char *const words[] = {"STCNOFF", "CNSTOFF", "NCSTOFF"};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "%s\n3 1 0\n0 0 0 0 0 1 255 0 0 0.5 1\n1 0 0 0 1 0 10 20 30 40 0 0\n0 1 0 1 0 0 7 0.1 1e-20\n4 0 1 2 1\n",
            words[i]);
        mt_mesh *mesh = text_read(context, "a.off", text);
        const mt_attribute *normal = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
        const mt_attribute *uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX);
        static const double normals[] = {0, 0, 1, 0, 1, 0, 1, 0, 0}, uvs[] = {0.5, 1, 0, 0, 0.1, 1e-20};
        static const double colors[] = {255, 0, 0, 255, 10, 20, 30, 40, 7, 7, 7, 255};
        assert_int_equal(mesh->face_size, 4);
        assert_memory_equal(normal->values, normals, sizeof normals);
        assert_memory_equal(uv->values, uvs, sizeof uvs);
        check_color(mesh, MT_DOMAIN_VERTEX, MT_U8, 4, colors);
        mt_mesh *again = text_through(context, mesh, "off", MT_ENCODING_DEFAULT);
        assert_int_equal(test_mesh_hash(again), test_mesh_hash(mesh));
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

typedef struct bytes {
    uint8_t data[1000];
    size_t size;
    bool little;
} bytes;

static void put_word(bytes *b, uint32_t word)
{
    for (unsigned i = 0; i < 4; i++) {
        b->data[b->size++] = (uint8_t)(word >> (b->little ? 8 * i : 24 - 8 * i));
    }
}

static void put_real(bytes *b, float number)
{
    uint32_t word;
    memcpy(&word, &number, sizeof word);
    put_word(b, word);
}

static bytes binary_file(bool little, uint32_t faces)
{
    bytes b = {.little = little};
    b.size = (size_t)sprintf((char *)b.data, "# a comment\nNOFF BINARY\r\n");
    put_word(&b, 4);
    put_word(&b, faces);
    put_word(&b, 0);
    for (int i = 0; i < 4; i++) {
        put_real(&b, (float)i), put_real(&b, 0.1f), put_real(&b, (float)(i * i));
        put_real(&b, 0.0f), put_real(&b, 0.0f), put_real(&b, 1.0f);
    }
    put_word(&b, 3), put_word(&b, 0), put_word(&b, 1), put_word(&b, 2), put_word(&b, 0);
    put_word(&b, 4), put_word(&b, 3), put_word(&b, 2), put_word(&b, 1), put_word(&b, 0);
    put_word(&b, 3), put_real(&b, 0.5f), put_real(&b, 0.25f), put_real(&b, 1.0f);
    return b;
}

static void test_binary(void **state)
{
    (void)state;
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    uint64_t hashes[2];
    for (int little = 0; little < 2; little++) {
        bytes b = binary_file(little, 2);
        mt_mesh *mesh = text_read_bytes(context, "a.off", b.data, b.size);
        static const mt_index offsets[] = {0, 3, 7}, corners[] = {0, 1, 2, 3, 2, 1, 0};
        static const double colors[] = {1, 1, 1, 0.5, 0.25, 1};
        assert_int_equal(mesh->position_type, MT_F32);
        assert_memory_equal(mesh->face_offsets, offsets, sizeof offsets);
        assert_memory_equal(mesh->corner_vertices, corners, sizeof corners);
        assert_true(((float *)mesh->positions)[4] == 0.1f);
        assert_non_null(mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX));
        check_color(mesh, MT_DOMAIN_FACE, MT_F64, 3, colors);
        hashes[little] = test_mesh_hash(mesh);
        mt_mesh_destroy(context, mesh);
    }
    assert_int_equal(hashes[0], hashes[1]);
    assert_non_null(strstr(warnings.text, "little endian"));
    for (size_t size = 30; size < binary_file(false, 2).size; size++) {
        bytes b = binary_file(false, 2);
        text_refuse(context, "a.off", b.data, size, MT_ERROR_SYNTAX);
    }
    bytes b = binary_file(false, 0x10000000);
    assert_non_null(strstr(text_refuse(context, "a.off", b.data, b.size, MT_ERROR_SYNTAX), "can hold"));
    test_context_end(context);
}

/* Many blocks, faces of three and four sides in turn, with colours from the middle on. */
static void test_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    size_t count = 60000, size = 0;
    char *text = malloc(count * 120);
    test_random random = {7};
    size += (size_t)sprintf(text, "OFF\n%zu %zu 0\n", count, count);
    for (size_t i = 0; i < count; i++) {
        size += (size_t)sprintf(text + size, "%zu %.17g %.3f\n%s", i, test_random_unit(&random),
                                test_random_unit(&random), i % 100 ? "" : "\n# c\n");
    }
    for (size_t i = 0; i < count; i++) {
        size += (size_t)sprintf(text + size, i % 2 ? "3 %zu %zu %zu" : "4 %zu %zu %zu %zu", i, (i + 1) % count,
                                (i + 2) % count, (i + 3) % count);
        size += (size_t)sprintf(text + size, i > count / 2 ? " %zu 0 200\n" : "\n", i % 256);
    }
    uint64_t hashes[2];
    for (unsigned threads = 1; threads <= 2; threads++) {
        mt_context *context = test_context_with_threads(threads);
        mt_mesh *mesh = text_read_bytes(context, "a.off", text, size);
        const mt_attribute *color = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE);
        assert_int_equal(mesh->face_count, count);
        for (mt_index i = 0; i < count; i++) {
            mt_index corner = mt_mesh_face_begin(mesh, i);
            assert_int_equal(mt_mesh_face_sides(mesh, i), i % 2 ? 3 : 4);
            assert_int_equal(mesh->corner_vertices[corner + 2], (i + 2) % count);
            assert_true(mt_mesh_position(mesh, i).x == (double)i);
            assert_true(mt_attribute_get(color, i, 0) == (i > count / 2 ? i % 256 : 255));
        }
        hashes[threads - 1] = test_mesh_hash(mesh);
        mt_mesh *again = text_through(context, mesh, "off", MT_ENCODING_DEFAULT);
        assert_int_equal(test_mesh_hash(again), hashes[threads - 1]);
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_int_equal(hashes[0], hashes[1]);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms_of_a_triangle),
        cmocka_unit_test(test_what_is_refused_says_why),
        cmocka_unit_test(test_empty_mesh_and_lines_left_over),
        cmocka_unit_test(test_colors),
        cmocka_unit_test(test_dark_bytes_stay_dark),
        cmocka_unit_test(test_vertices_with_everything),
        cmocka_unit_test(test_binary),
        cmocka_unit_test(test_the_same_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
