/* STL: binary and ASCII told apart, welded, refused by name where they are wrong, and written so that they come back.
 */
#include "tests/support/fixture.h"
#include "tests/support/random_mesh.h"
#include "tests/support/reading.h"
#include "tests/support/unit.h"

#include <meshtool/triangulate.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FACET(a, b, c) "facet normal 0 0 0\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet\n"
#define FIRST FACET("0 0 0", "1 0 0", "0 1 0")
#define SECOND FACET("1 0 0", "1 1 0", "0 1 0")

/* A binary file: a header text, and facets in the plane z = 0 of a strip of squares. */
static size_t make_binary(uint8_t *bytes, const char *header, uint32_t count)
{
    memset(bytes, 0, 80);
    memcpy(bytes, header, strlen(header));
    memcpy(bytes + 80, &count, 4);
    for (uint32_t i = 0; i < count; i++) {
        float x = (float)(i / 2);
        const float even[] = {0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0};
        const float odd[] = {0, 0, 1, x + 1, 0, 0, x + 1, 1, 0, x, 1, 0};
        memcpy(bytes + 84 + 50 * (size_t)i, i % 2 ? odd : even, 48);
        memset(bytes + 84 + 50 * (size_t)i + 48, 0, 2);
    }
    return 84 + 50 * (size_t)count;
}

static void binary_is_read_and_welded(void **state)
{
    (void)state;
    static const char *const headers[] = {"made by hand", "solid made by someone careless", "", "SOLID\nfacet"};
    test_reading r;
    test_reading_begin(&r);
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        uint8_t bytes[84 + 50 * 6];
        size_t size = make_binary(bytes, headers[i], 6);
        mt_mesh *mesh = test_read(&r, "a.stl", bytes, size);
        test_warned(&r, NULL);
        assert_int_equal(mesh->face_count, 6);
        assert_int_equal(mesh->vertex_count, 8);
        assert_int_equal(mesh->position_type, MT_F32);
        assert_int_equal(mesh->attribute_count, 0);
        assert_true(mesh->welded);
        assert_int_equal(mesh->up, MT_UP_Z);
        const mt_index corners[] = {0, 1, 2, 1, 3, 2, 1, 4, 3, 4, 5, 3};
        assert_memory_equal(mesh->corner_vertices, corners, sizeof corners);
        mt_mesh_destroy(r.context, mesh);
        mesh = test_read(&r, "no extension", bytes, size); /* known by its content */
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

static void ascii_is_read_and_welded(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "solid\n" FIRST SECOND "endsolid\n",
        "\xef\xbb\xbfsolid\r\n" FIRST "\n\n" SECOND "endsolid",
        "  SOLID   \n\tFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 0 VERTEX 1 0 0 VERTEX 0 1 0 ENDLOOP ENDFACET\r"
        "Facet Normal +0 -0 1e0\v\nouter\nloop\nvertex\n1\n0\n-0\nvertex 1. 1 .0 vertex 0 1 0 endloop endfacet "
        "EndSolid",
    };
    test_reading r;
    test_reading_begin(&r);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        mt_mesh *mesh = test_read_text(&r, "a.stl", texts[i]);
        test_warned(&r, NULL);
        assert_int_equal(mesh->position_type, MT_F64);
        assert_int_equal(mesh->vertex_count, 4);
        const mt_index corners[] = {0, 1, 2, 1, 3, 2};
        assert_int_equal(mesh->face_count, 2);
        assert_memory_equal(mesh->corner_vertices, corners, sizeof corners);
        assert_int_equal(mesh->label_set_count, 0);
        assert_int_equal(mesh->attribute_count, 0);
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

static void solids_become_labels(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *mesh = test_read_text(&r, "a.stl",
                                   "solid first part \n" FIRST "endsolid first part\nsolid\nendsolid\n"
                                   "solid  second\n" SECOND SECOND "endsolid second\n");
    test_warned(&r, NULL);
    const mt_labels *labels = mt_mesh_find_labels(mesh, MT_LABEL_SOLID);
    assert_non_null(labels);
    assert_int_equal(labels->name_count, 3);
    assert_string_equal(labels->names[0], "first part");
    assert_string_equal(labels->names[1], "");
    assert_string_equal(labels->names[2], "second");
    const mt_index expected[] = {0, 2, 2};
    assert_memory_equal(labels->face_labels, expected, sizeof expected);
    mt_mesh *copy = test_round_trip(&r, mesh, "stl", MT_ENCODING_ASCII);
    const mt_labels *same = mt_mesh_find_labels(copy, MT_LABEL_SOLID);
    assert_string_equal(same->names[same->face_labels[0]], "first part");
    assert_string_equal(same->names[same->face_labels[2]], "second");
    mt_mesh_destroy(r.context, copy);
    mt_mesh_destroy(r.context, mesh);
    mesh = test_read_text(&r, "a.stl", "solid only\n" FIRST "endsolid only\nfree text\nmore of it\n");
    test_warned(&r, "2 lines outside of solids are ignored");
    assert_string_equal(mt_mesh_find_labels(mesh, MT_LABEL_SOLID)->names[0], "only");
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

static void no_facets(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    uint8_t bytes[84];
    mt_mesh *binary = test_read(&r, "a.stl", bytes, make_binary(bytes, "nothing", 0));
    mt_mesh *ascii = test_read_text(&r, "a.stl", "solid\nendsolid\n");
    assert_int_equal(binary->face_count + binary->vertex_count + ascii->face_count + ascii->vertex_count, 0);
    mt_mesh *copy = test_round_trip(&r, binary, "stl", MT_ENCODING_BINARY);
    test_assert_same_mesh(copy, binary);
    mt_mesh_destroy(r.context, copy);
    copy = test_round_trip(&r, ascii, "stl", MT_ENCODING_ASCII);
    test_assert_same_mesh(copy, ascii);
    mt_mesh_destroy(r.context, copy);
    mt_mesh_destroy(r.context, binary);
    mt_mesh_destroy(r.context, ascii);
    test_reading_end(&r);
}

static void refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
    } cases[] = {
        {"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 1 1 0\nendloop\n"
         "endfacet\nendsolid\n",
         "a.stl:7:1: expected \"endloop\", found \"vertex\""},
        {"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid\n",
         "a.stl:6:1: expected \"vertex\", found \"endloop\""},
        {"solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n",
         "a.stl:7:1: expected \"endloop\", found \"endfacet\""},
        {"solid\n" FIRST, "the file ends inside a solid, expected \"endsolid\""},
        {"solid\n" FIRST "facet normal 0 0 0\nouter loop\nvertex 0 0 0\n",
         "the facet ends too early, expected \"vertex\""},
        {"solid\n" FIRST "vertex 0 0 0\nendsolid\n", "a.stl:9:1: expected \"facet\" or \"endsolid\", found \"vertex\""},
        {"solid\n" FIRST "solid\n" SECOND "endsolid\n", "expected \"facet\" or \"endsolid\", found \"solid\""},
        {"solid\nendsolid\n" FIRST, "a.stl:3:1: expected \"solid\", found \"facet\""},
        {"solid\n" FACET("0 0", "1 0 0", "0 1 0") "endsolid\n", "a.stl:5:1"},
        {"solid\n" FACET("0 0 0", "1,5 0 0", "0 1 0") "endsolid\n", "a.stl:5:8"},
        {"solid\n" FACET("0 0 0", "1e999 0 0", "0 1 0") "endsolid\n", "a.stl:5:8: the number is too large"},
        {"solid\n" FACET("0 0 0", "1 0 0", "0 1 0x") "endsolid\n", "a.stl:6:12"},
        {"solid\nfacet normal a b c\n", "a.stl:2:14"},
    };
    test_reading r;
    test_reading_begin(&r);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        test_refuse_text(&r, "a.stl", cases[i].text, MT_ERROR_SYNTAX, cases[i].part);
    }
    uint8_t bytes[84 + 50 * 2 + 1];
    size_t size = make_binary(bytes, "truncated", 2);
    for (size_t cut = 0; cut < size; cut++) {
        test_refuse(&r, "a.stl", bytes, cut, MT_ERROR_SYNTAX,
                    cut == 0   ? "is empty"
                    : cut < 84 ? "expected 84 bytes of header"
                               : "declares 2 facets of 50 bytes");
    }
    memcpy(bytes + 80, "\0\0\0\x80", 4);
    test_refuse(&r, "a.stl", bytes, size, MT_ERROR_SYNTAX,
                "a.stl@80: the header declares 2147483648 facets of 50 bytes, but only 100 bytes follow");
    make_binary(bytes, "long", 2);
    mt_mesh *mesh = test_read(&r, "a.stl", bytes, size + 1);
    test_warned(&r, "1 bytes after the last facet are ignored");
    mt_mesh_destroy(r.context, mesh);
    static const char text[] = "solid\n" FIRST "endsolid\n";
    for (size_t cut = 0; cut < sizeof text - 2; cut++) {
        test_refuse(&r, "a.stl", text, cut, MT_ERROR_SYNTAX, "");
    }
    static const char zero[] = "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1\0 0\n";
    test_refuse(&r, "a.stl", zero, sizeof zero - 1, MT_ERROR_SYNTAX, "");
    test_reading_end(&r);
}

/* Numbers that are none are read and counted; corners of the same bits still meet. */
static void nan_facets(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *mesh = test_read_text(
        &r, "a.stl",
        "solid\nfacet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex nan 0 0\nvertex inf 1 0\nendloop\nendfacet\n"
        "facet normal -nan(ind) 0 0\nouter loop\nvertex nan 0 0\nvertex 1 1 1\nvertex inf 1 0\nendloop\nendfacet\n"
        "endsolid\n");
    test_warned(&r, "2 vertices have a coordinate that is not finite");
    assert_int_equal(mesh->vertex_count, 4);
    assert_int_equal(mesh->attribute_count, 0);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* Attribute bytes, and normals that contradict the corners, are kept and written again. */
static void extras_are_kept(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    uint8_t bytes[84 + 50 * 6];
    size_t size = make_binary(bytes, "extras", 6);
    bytes[84 + 50 * 3 + 48] = 0x34, bytes[84 + 50 * 3 + 49] = 0x12;
    mt_mesh *mesh = test_read(&r, "a.stl", bytes, size);
    test_warned(&r, NULL);
    assert_int_equal(mesh->attribute_count, 1);
    assert_string_equal(mesh->attributes[0].name, "attribute");
    assert_int_equal(mesh->attributes[0].type, MT_U16);
    const uint16_t values[] = {0, 0, 0, 0x1234, 0, 0};
    assert_memory_equal(mesh->attributes[0].values, values, sizeof values);
    mt_mesh *copy = test_round_trip(&r, mesh, "stl", MT_ENCODING_BINARY);
    test_assert_same_mesh(copy, mesh);
    mt_mesh_destroy(r.context, copy);
    mt_mesh_destroy(r.context, mesh);
    const float down = -1;
    memcpy(bytes + 84 + 50 * 2 + 8, &down, 4);
    mesh = test_read(&r, "a.stl", bytes, size);
    test_warned(&r, "1 facets have a normal that contradicts");
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_FACE);
    assert_non_null(normals);
    assert_true(((const float *)normals->values)[8] == -1.0f);
    assert_true(((const float *)normals->values)[11] == 1.0f);
    mt_mesh_write_options options = {.format = "stl"};
    void *written;
    size_t written_size;
    assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &written, &written_size), MT_OK);
    assert_int_equal(written_size, size);
    assert_memory_equal((uint8_t *)written + 80, bytes + 80, size - 80); /* all but the title */
    mt_free(r.context, written);
    mt_mesh_destroy(r.context, mesh);
    mesh = test_read_text(&r, "a.stl",
                          "solid\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                          "endfacet\n" SECOND "endsolid\n");
    test_warned(&r, "1 facets have a normal that contradicts");
    normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_FACE);
    assert_true(((const float *)normals->values)[2] == -1.0f);
    assert_true(((const float *)normals->values)[5] == 0.0f);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* What STL can hold of a mesh: its triangles, corner by corner. */
static void assert_same_triangles(test_reading *r, const mt_mesh *mesh, const mt_mesh *copy, bool single)
{
    mt_triangulation t;
    assert_int_equal(mt_triangulation_init(r->context, mesh, &t), MT_OK);
    assert_int_equal(t.triangle_count, copy->face_count);
    for (mt_index triangle = 0; triangle < t.triangle_count; triangle++) {
        for (mt_index side = 0; side < 3; side++) {
            mt_index corner = mt_triangulation_corner(&t, triangle, side);
            mt_vec3 a = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
            mt_vec3 b = mt_mesh_position(copy, copy->corner_vertices[3 * (size_t)triangle + side]);
            if (single || mesh->position_type == MT_F32) { /* text holds the shortest digits of a float */
                a = mt_vec3_make((double)(float)a.x, (double)(float)a.y, (double)(float)a.z);
                b = mt_vec3_make((double)(float)b.x, (double)(float)b.y, (double)(float)b.z);
            }
            assert_true(a.x == b.x && a.y == b.y && a.z == b.z);
        }
    }
    mt_triangulation_release(r->context, &t);
}

static void random_meshes_come_back(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    test_random random = {21};
    for (int round = 0; round < 100; round++) {
        mt_mesh *mesh = test_random_mesh(r.context, &random);
        while (mesh->attribute_count) {
            mt_mesh_remove_attribute(r.context, mesh, 0);
        }
        mt_mesh *binary = test_round_trip(&r, mesh, "stl", MT_ENCODING_BINARY);
        mt_mesh *ascii = test_round_trip(&r, mesh, "stl", MT_ENCODING_ASCII);
        assert_same_triangles(&r, mesh, binary, true);
        assert_same_triangles(&r, mesh, ascii, false);
        mt_mesh *again = test_round_trip(&r, ascii, "stl", MT_ENCODING_ASCII);
        test_assert_same_mesh(ascii, again);
        mt_mesh_destroy(r.context, again);
        again = test_round_trip(&r, binary, "stl", MT_ENCODING_BINARY);
        test_assert_same_mesh(binary, again);
        mt_mesh_destroy(r.context, again);
        mt_mesh_destroy(r.context, ascii);
        mt_mesh_destroy(r.context, binary);
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* Many blocks of text, so that facets and solids fall on their borders: the same for any number of threads. */
static void large_ascii(void **state)
{
    (void)state;
    enum { COUNT = 30000, ROOM = COUNT * 160 };
    char *text = malloc(ROOM);
    size_t length = 0;
    for (int i = 0; i < COUNT; i++) {
        if (i % 1000 == 0) {
            length += (size_t)sprintf(text + length, "%ssolid part%d\n", i ? "endsolid\njunk\n" : "", i / 1000);
        }
        length += (size_t)sprintf(text + length,
                                  "facet normal 0 0 1\n outer loop\n  vertex %d 0 0.5\n  vertex %d 0 0.5\n"
                                  "  vertex %d 1 0.25\n endloop\nendfacet\n",
                                  i, i + 1, i);
    }
    length += (size_t)sprintf(text + length, "endsolid\n");
    uint64_t hash = 0;
    for (unsigned threads = 1; threads <= 3; threads++) {
        test_reading r;
        test_reading_begin_with(&r, (mt_context_options){.thread_count = threads});
        mt_mesh *mesh = test_read(&r, "a.stl", text, length);
        test_warned(&r, "29 lines outside of solids are ignored");
        assert_int_equal(mesh->face_count, COUNT);
        assert_int_equal(mesh->vertex_count, 2 * COUNT + 1);
        const mt_labels *labels = mt_mesh_find_labels(mesh, MT_LABEL_SOLID);
        assert_int_equal(labels->name_count, COUNT / 1000);
        for (mt_index face = 0; face < COUNT; face++) {
            assert_int_equal(labels->face_labels[face], face / 1000);
            assert_true(mt_mesh_position(mesh, mesh->corner_vertices[3 * (size_t)face]).x == (double)face);
        }
        hash = hash ? hash : test_mesh_hash(mesh);
        assert_int_equal(hash, test_mesh_hash(mesh));
        mt_mesh_destroy(r.context, mesh);
        test_reading_end(&r);
    }
    free(text);
}

static void numbers_past_single_precision(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    const double positions[] = {0, 0, 0, 1e200, 0, 0, 0, 1e200, 0};
    const mt_index faces[] = {3, 0, 1, 2};
    mt_mesh *mesh = test_mesh(r.context, 3, positions, 1, faces);
    mt_mesh_write_options options = {.format = "stl"};
    void *data;
    size_t size;
    assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &data, &size), MT_OK);
    test_warned(&r, "2 coordinates are too large for single precision");
    mt_free(r.context, data);
    mt_mesh *copy = test_round_trip(&r, mesh, "stl", MT_ENCODING_ASCII);
    test_assert_same_mesh(mesh, copy);
    mt_mesh_destroy(r.context, copy);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* Normals are unit vectors whatever the size of the facet, and 0 0 0 where it has no area. */
static void normals_of_all_sizes(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    static const double sizes[] = {1e-160, 1e-100, 1e-30, 1, 1e30, 1e100, 1e150};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        double s = sizes[i];
        const double positions[] = {0, 0, 0, s, 0, 0, 0, s, 0, 2 * s, 0, 0};
        const mt_index faces[] = {3, 0, 1, 2, 3, 0, 1, 3};
        mt_mesh *mesh = test_mesh(r.context, 4, positions, 2, faces);
        mt_mesh_write_options options = {.format = "stl", .encoding = MT_ENCODING_ASCII};
        void *data;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &data, &size), MT_OK);
        char *text = calloc(size + 1, 1);
        memcpy(text, data, size);
        assert_non_null(strstr(text, "facet normal 0 0 1\n"));
        assert_non_null(strstr(text, "facet normal 0 0 0\n"));
        free(text);
        mt_free(r.context, data);
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* What each encoding cannot hold is listed, and nothing else. */
static void loss_is_said(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    const mt_mesh_format *stl = mt_mesh_format_by_extension("stl");
    mt_mesh *mesh = test_read_text(&r, "a.stl",
                                   "solid a\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0.1 0 0\n"
                                   "vertex 0 1 0\nendloop\nendfacet\nendsolid a\n");
    mt_attribute *attribute;
    mt_attribute_layout layout = {"attribute", MT_SEMANTIC_GENERIC, MT_DOMAIN_FACE, MT_U16, 1, 1, false};
    assert_int_equal(mt_mesh_add_attribute(r.context, mesh, &layout, &attribute), MT_OK);
    ((uint16_t *)attribute->values)[0] = 7;
    mt_loss loss;
    assert_int_equal(mt_mesh_format_loss(r.context, mesh, stl, NULL, &loss), MT_OK);
    assert_int_equal(loss.count, 2);
    assert_string_equal(loss.items[0], "1 coordinate rounded to single precision");
    assert_string_equal(loss.items[1], "solid names");
    assert_int_equal(
        mt_mesh_format_loss(r.context, mesh, stl, &(mt_mesh_write_options){.encoding = MT_ENCODING_ASCII}, &loss),
        MT_OK);
    assert_int_equal(loss.count, 1);
    assert_string_equal(loss.items[0], "face attribute \"attribute\"");
    mt_mesh_write_options options = {.format = "stl", .strict_loss = true};
    void *data;
    size_t size;
    assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &data, &size), MT_ERROR_LOSS);
    mt_context_clear_error(r.context);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

static void missing_memory(void **state)
{
    (void)state;
    uint8_t bytes[84 + 50 * 6];
    size_t size = make_binary(bytes, "extras", 6);
    bytes[84 + 48] = 1;
    static const char text[] = "solid a\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nendsolid\nsolid b\n" SECOND "endsolid\n";
    for (int ascii = 0; ascii < 2; ascii++) {
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        for (uint64_t failing = 1; status != MT_OK; failing++) {
            test_reading r;
            test_reading_begin_with(&r, (mt_context_options){.thread_count = 1, .failing_allocation = failing});
            mt_mesh *mesh = NULL;
            status = ascii ? mt_mesh_read_memory(r.context, "a.stl", text, sizeof text - 1, NULL, &mesh, NULL)
                           : mt_mesh_read_memory(r.context, "a.stl", bytes, size, NULL, &mesh, NULL);
            assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
            assert_int_equal(mt_context_error(r.context)->status, status);
            mt_mesh_destroy(r.context, mesh);
            test_reading_end(&r);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(binary_is_read_and_welded),
        cmocka_unit_test(ascii_is_read_and_welded),
        cmocka_unit_test(solids_become_labels),
        cmocka_unit_test(no_facets),
        cmocka_unit_test(refused),
        cmocka_unit_test(nan_facets),
        cmocka_unit_test(extras_are_kept),
        cmocka_unit_test(random_meshes_come_back),
        cmocka_unit_test(large_ascii),
        cmocka_unit_test(numbers_past_single_precision),
        cmocka_unit_test(normals_of_all_sizes),
        cmocka_unit_test(loss_is_said),
        cmocka_unit_test(missing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
