/* PLY: what every kind of file is read as, what is refused and how, and that what is written comes back to the bit. */
#include "tests/support/fixture.h"
#include "tests/support/random_mesh.h"
#include "tests/support/reading.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TRIANGLE_HEADER                                                                                                \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                                         \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define TRIANGLE "ply\nformat ascii 1.0\n" TRIANGLE_HEADER "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

/* Bytes put together piece by piece, in either byte order. */
typedef struct bytes {
    uint8_t data[4096];
    size_t size;
    bool big;
} bytes;

static void put(bytes *b, const void *value, size_t size)
{
    assert_true(b->size + size <= sizeof b->data);
    for (size_t i = 0; i < size; i++) {
        b->data[b->size + i] = ((const uint8_t *)value)[b->big ? size - 1 - i : i];
    }
    b->size += size;
}

static void put_text(bytes *b, const char *text)
{
    bool big = b->big;
    b->big = false;
    put(b, text, strlen(text));
    b->big = big;
}

static void put_float(bytes *b, float value)
{
    put(b, &value, sizeof value);
}

static void put_int(bytes *b, int32_t value, size_t size)
{
    put(b, &value, size); /* the low bytes come first */
}

static void put_points(bytes *b, int count)
{
    static const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}};
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < 3; j++) {
            put_float(b, points[i][j]);
        }
    }
}

static void ascii_triangle(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *mesh = test_read_text(&r, "a.ply", TRIANGLE);
    test_warned(&r, NULL);
    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->face_size, 3);
    assert_int_equal(mesh->position_type, MT_F32);
    assert_true(mt_mesh_position(mesh, 1).x == 1.0);
    assert_int_equal(mesh->corner_vertices[2], 2);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* Line ends of three kinds, blanks of all kinds, blank lines, no final line end, a mark, other names of types. */
static void ascii_layout(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
        "element face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n0 0 0\r\n1 0 0\r\n0 1 0\r\n3 0 1 2",
        "ply\rformat ascii 1.0\relement vertex 3\rproperty float x\rproperty float y\rproperty float z\r"
        "element face 1\rproperty list uchar int vertex_indices\rend_header\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r",
        "\xef\xbb\xbfply\ncomment caf\xc3\xa9\nformat ascii 1.0\nobj_info made by hand\n\n" TRIANGLE_HEADER
        "\n  0\t0  0 \n\n1 0\v0\t\n0 1 0\n 3 0 1 2 \n\n\n",
        "ply \nformat ascii 1.0\nelement vertex 3\nproperty float32 x\nproperty float32 y\nproperty float32 z\n"
        "element face 1\nproperty list uint8 int32 vertex_index\nend_header\n+0 -0 0e5\n1. 0 .0\n0 1e0 0\n3 0 1 2\n",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
    };
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *expected = test_read_text(&r, "a.ply", TRIANGLE);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        mt_mesh *mesh = test_read_text(&r, "a.ply", texts[i]);
        test_warned(&r, NULL);
        if (i == 3) {
            assert_true(signbit(mt_mesh_position(mesh, 0).y));
            mt_mesh_set_position(mesh, 0, mt_vec3_make(0, 0, 0));
        }
        test_assert_same_mesh(mesh, expected);
        mt_mesh_destroy(r.context, mesh);
    }
    mt_mesh_destroy(r.context, expected);
    test_reading_end(&r);
}

/* Both byte orders, faces of several types of number, equal and different sizes, a CRLF header over a binary body,
 * faces before vertices. */
static void binary_layouts(void **state)
{
    (void)state;
    static const char *const types[] = {"uchar", "char", "ushort", "short", "uint", "int"};
    static const size_t sizes[] = {1, 1, 2, 2, 4, 4};
    test_reading r;
    test_reading_begin(&r);
    for (int i = 0; i < 6 * 6 * 2 * 2 * 2; i++) {
        int count_type = i % 6, type = i / 6 % 6;
        bool mixed = i / 72 % 2, faces_first = i / 144;
        bytes b = {.big = i / 36 % 2};
        char header[600], vertices[200], faces[200];
        snprintf(vertices, sizeof vertices,
                 "element vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n");
        snprintf(faces, sizeof faces, "element face 2\r\nproperty list %s %s vertex_indices\r\n", types[count_type],
                 types[type]);
        snprintf(header, sizeof header, "ply\r\nformat binary_%s_endian 1.0\r\n%s%send_header\r\n",
                 b.big ? "big" : "little", faces_first ? faces : vertices, faces_first ? vertices : faces);
        put_text(&b, header);
        if (!faces_first) {
            put_points(&b, 4);
        }
        const int32_t corners[2][4] = {{0, 1, 2, 3}, {0, 2, 3, 3}};
        for (int face = 0; face < 2; face++) {
            int sides = mixed && face == 0 ? 4 : 3;
            put_int(&b, sides, sizes[count_type]);
            for (int side = 0; side < sides; side++) {
                put_int(&b, corners[face][side], sizes[type]);
            }
        }
        if (faces_first) {
            put_points(&b, 4);
        }
        mt_mesh *mesh = test_read(&r, "a.ply", b.data, b.size);
        test_warned(&r, NULL);
        assert_int_equal(mesh->face_count, 2);
        assert_int_equal(mesh->face_size, mixed ? 0 : 3);
        mt_index second = mt_mesh_face_begin(mesh, 1);
        assert_int_equal(second, mixed ? 4 : 3);
        assert_int_equal(mesh->corner_vertices[second + 1], 2);
        assert_true(mt_mesh_position(mesh, 3).z == 0.5);
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* Properties with a meaning, properties known by name, lists and elements that are skipped, edges. */
static void meanings(void **state)
{
    (void)state;
    static const char text[] =
        "ply\nformat ascii 1.0\nelement camera 2\nproperty float view\nproperty list uchar float values\n"
        "element vertex 3\nproperty double x\nproperty float y\nproperty short z\nproperty uchar red\n"
        "property uchar green\nproperty uchar blue\nproperty uchar alpha\nproperty float nx\nproperty float ny\n"
        "property float nz\nproperty float u\nproperty float v\nproperty int id\nproperty float w_0\n"
        "property float w_1\nproperty float w_2\nproperty list uchar int bones\n"
        "element face 1\nproperty list uchar uint vertex_indices\nproperty list uchar float texcoord\n"
        "property ushort red\nproperty ushort green\nproperty ushort blue\nproperty char material\n"
        "element edge 2\nproperty int vertex1\nproperty int vertex2\nproperty float crease\nend_header\n"
        "1 2 3 4\n1 0\n"
        "0.1 0.1 -5 1 2 3 255 0 0 1 0.25 0.5 -7 1 2 3 2 8 9\n1 0 0 4 5 6 0 0 0 1 0 0 8 4 5 6 0\n"
        "0 1 0 7 8 9 1 0 0 1 1 1 9 7 8 9 1 5\n"
        "3 0 1 2 6 0 0 1 0 0.5 1 65535 0 1 -3\n0 2 1.5\n1 2 0\n";
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *mesh = test_read_text(&r, "a.ply", text);
    test_warned(&r, "element \"camera\" (2 records) is skipped");
    test_warned(&r, "property \"bones\" of element \"vertex\" is skipped");
    test_warned(&r, "property \"crease\" of element \"edge\" is skipped");
    assert_int_equal(mesh->position_type, MT_F64);
    assert_true(mt_mesh_position(mesh, 0).x == 0.1);
    assert_true(mt_mesh_position(mesh, 0).y == (double)0.1f);
    assert_true(mt_mesh_position(mesh, 0).z == -5.0);
    assert_int_equal(mesh->attribute_count, 8);
    const mt_attribute *color = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_VERTEX);
    assert_int_equal(color->type, MT_U8);
    assert_int_equal(color->component_count, 4);
    assert_int_equal(((uint8_t *)color->values)[7], 0);
    const mt_attribute *uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX);
    assert_true(((float *)uv->values)[1] == 0.5f);
    assert_non_null(mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX));
    const mt_attribute *corner = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    assert_true(((float *)corner->values)[5] == 1.0f);
    const mt_attribute *face = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE);
    assert_int_equal(face->type, MT_U16);
    assert_int_equal(face->component_count, 3);
    const mt_attribute *id = mt_mesh_find_attribute(mesh, MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX);
    assert_string_equal(id->name, "id");
    assert_int_equal(((int32_t *)id->values)[0], -7);
    assert_string_equal(id[1].name, "w");
    assert_int_equal(id[1].component_count, 3);
    const mt_attribute *material = mt_mesh_find_attribute(mesh, MT_SEMANTIC_GENERIC, MT_DOMAIN_FACE);
    assert_string_equal(material->name, "material");
    assert_int_equal(((int8_t *)material->values)[0], -3);
    assert_int_equal(mesh->wire_count, 2);
    assert_int_equal(mesh->wire_vertices[3], 2);
    for (int encoding = MT_ENCODING_ASCII; encoding <= MT_ENCODING_BINARY_BIG; encoding++) {
        mt_mesh *copy = test_round_trip(&r, mesh, "ply", (mt_encoding)encoding);
        test_assert_same_mesh(mesh, copy);
        mt_mesh_destroy(r.context, copy);
    }
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* Zero counts are a mesh; so is a cloud of points. */
static void nearly_empty(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    static const char *const texts[] = {
        "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n",
        "ply\nformat binary_little_endian 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
        "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        mt_mesh *mesh = test_read_text(&r, "a.ply", texts[i]);
        test_warned(&r, NULL);
        assert_int_equal(mesh->vertex_count + mesh->face_count, 0);
        mt_mesh *copy = test_round_trip(&r, mesh, "ply", MT_ENCODING_DEFAULT);
        test_assert_same_mesh(mesh, copy);
        mt_mesh_destroy(r.context, copy);
        mt_mesh_destroy(r.context, mesh);
    }
    mt_mesh *cloud = test_read_text(&r, "a.ply",
                                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                    "property float y\nproperty float z\nend_header\n1 2 3\n");
    assert_int_equal(cloud->vertex_count, 1);
    assert_int_equal(cloud->face_count, 0);
    mt_mesh_destroy(r.context, cloud);
    test_reading_end(&r);
}

#define VERTEX3 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
#define FACE1 "element face 1\nproperty list uchar int vertex_indices\n"
#define POINTS3 "0 0 0\n1 0 0\n0 1 0\n"
#define ASCII "ply\nformat ascii 1.0\n"

static void refused_headers(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
        mt_status status;
    } cases[] = {
        {"ply\nformat ascii 1.0\n" VERTEX3, "a.ply:7: the file ends inside the header", MT_ERROR_SYNTAX},
        {"ply\nformat ascii 1.0\nelement vertex -1\n", "a.ply:3: the count \"-1\" is not a whole number",
         MT_ERROR_SYNTAX},
        {"ply\nformat ascii 1.0\nelement vertex 1.5\n", "the count \"1.5\"", MT_ERROR_SYNTAX},
        {"ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n", "is too large", MT_ERROR_TOO_LARGE},
        {"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n0 0 0\n",
         "a.ply:3: element \"vertex\" declares 4000000000 records of at least 6 bytes", MT_ERROR_SYNTAX},
        {"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
         "property float z\nend_header\n012345678901",
         "records of at least 12 bytes, but only 12 bytes are left", MT_ERROR_SYNTAX},
        {ASCII VERTEX3 "element face 1\nproperty list float int vertex_indices\nend_header\n" POINTS3 "3 0 1 2\n",
         "a.ply:8: the length of a list is declared as float", MT_ERROR_SYNTAX},
        {ASCII VERTEX3 "element face 1\nproperty list uchar float vertex_indices\nend_header\n" POINTS3 "3 0 1 2\n",
         "lists its vertices as float or double", MT_ERROR_SYNTAX},
        {ASCII "element vertex 1\nproperty colour x\n", "a.ply:4: unknown type \"colour\"", MT_ERROR_SYNTAX},
        {ASCII "element vertex 1\nproperty float x\nproperty float x\n",
         "a.ply:5: property \"x\" of element \"vertex\" is declared twice", MT_ERROR_SYNTAX},
        {ASCII "element vertex 1\nelement vertex 1\n", "element \"vertex\" is declared twice", MT_ERROR_SYNTAX},
        {ASCII "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", "has no numbers x, y and z",
         MT_ERROR_SYNTAX},
        {ASCII "element face 1\nproperty list uchar int vertex_indices\nend_header\n3 0 1 2\n",
         "declares no element \"vertex\"", MT_ERROR_SYNTAX},
        {ASCII VERTEX3 "element face 1\nproperty int flags\nend_header\n" POINTS3 "1\n", "has no list vertex_indices",
         MT_ERROR_SYNTAX},
        {ASCII "property float x\n", "stands before the first element", MT_ERROR_SYNTAX},
        {ASCII "vertices 3\n", "a.ply:3: unknown header line \"vertices\"", MT_ERROR_SYNTAX},
        {"ply\nelement vertex 0\nend_header\n", "has no format line", MT_ERROR_SYNTAX},
        {"ply\nformat binary 1.0\n", "unknown encoding \"binary\"", MT_ERROR_SYNTAX},
        {"ply\nformat ascii 2.0\n", "version \"2.0\" is not read", MT_ERROR_UNSUPPORTED},
        {ASCII VERTEX3 "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" POINTS3 "3 0 1 2\n",
         "holds triangle strips", MT_ERROR_UNSUPPORTED},
    };
    test_reading r;
    test_reading_begin(&r);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        test_refuse_text(&r, "a.ply", cases[i].text, cases[i].status, cases[i].part);
    }
    test_refuse(&r, "a.ply", "", 0, MT_ERROR_SYNTAX, "is empty");
    test_refuse(&r, "a.ply", "ply\nformat\0 ascii 1.0\n", 22, MT_ERROR_SYNTAX,
                "a.ply:2: the header contains a zero byte");
    test_reading_end(&r);
}

static void refused_ascii_bodies(void **state)
{
    (void)state;
    static const struct {
        const char *text, *part;
    } cases[] = {
        {ASCII VERTEX3 FACE1 "end_header\n0 0 0\n1 0 0\n0 1 0\n",
         "a.ply:7: element \"face\" declares 1 records of at least 2 bytes, but only 0 bytes are left"},
        {ASCII VERTEX3 FACE1 "end_header\n0.0000 0.0000 0.0000\n1 0 0\n",
         "the file ends after 2 of the 3 records of element \"vertex\""},
        {ASCII VERTEX3 FACE1 "end_header\n0.0000 0 0\n1 0 0\n0 1 0\n",
         "the file ends after 0 of the 1 records of element \"face\""},
        {ASCII VERTEX3 FACE1 "end_header\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
         "a.ply:11:4: vertex 1 ends before its property \"z\""},
        {ASCII VERTEX3 FACE1 "end_header\n0 0 0\n1 0 0 9\n0 1 0\n3 0 1 2\n",
         "a.ply:11:7: vertex 1 goes on with \"9\", expected the end of the line"},
        {ASCII VERTEX3 FACE1 "end_header\n0 0 0\n1,5 0 0\n0 1 0\n3 0 1 2\n",
         "a.ply:11:1: property \"x\" of vertex 1 is \"1,5\", expected a number"},
        {ASCII VERTEX3 FACE1 "end_header\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n", "that double precision can hold"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "3 0 1 3\n",
         "a.ply:13:7: face 0 names vertex 3, but the 3 vertices are numbered from 0"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "3 0 1 -1\n", "is \"-1\", expected the number of a vertex"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "3 0 1 1.5\n", "is \"1.5\", expected the number of a vertex"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "3.0 0 1 2\n", "is \"3.0\", expected the length of a list"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "-3 0 1 2\n", "is \"-3\", expected the length of a list"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "4000000000 0 1 2\n", "expected a length that the line can hold"},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "4 0 1 2\n", "face 0 ends before its property \"vertex_indices\""},
        {ASCII VERTEX3 FACE1 "end_header\n" POINTS3 "2 0 1    \n", "a.ply:13:1: face 0 has fewer than 3 vertices"},
        {ASCII "element vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
               "end_header\n0 0 0 256\n",
         "is \"256\", expected a whole number from 0 to 255"},
        {ASCII VERTEX3 "element face 1\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n"
                       "end_header\n" POINTS3 "3 0 1 2 5 0 0 0 0 0\n",
         "face 0 has a list texcoord that is not two numbers"},
        {ASCII VERTEX3 "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n" POINTS3 "0 3\n",
         "edge 0 names vertex 3"},
    };
    test_reading r;
    test_reading_begin(&r);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        test_refuse_text(&r, "a.ply", cases[i].text, MT_ERROR_SYNTAX, cases[i].part);
    }
    static const char with_nul[] = ASCII VERTEX3 "end_header\n0 0 0\n1 0\0 0\n0 1 0\n";
    test_refuse(&r, "a.ply", with_nul, sizeof with_nul - 1, MT_ERROR_SYNTAX, "");
    test_reading_end(&r);
}

static void start_binary(bytes *b, const char *elements)
{
    *b = (bytes){.size = 0};
    put_text(b, "ply\nformat binary_little_endian 1.0\n");
    put_text(b, elements);
    put_text(b, "end_header\n");
}

static void refused_binary_bodies(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    bytes b;
    for (int32_t index = -1; index <= 3; index += 4) {
        start_binary(&b, VERTEX3 "element face 2\nproperty list uchar int vertex_indices\n");
        put_points(&b, 3);
        size_t body = b.size;
        put_int(&b, 3, 1), put_int(&b, 0, 4), put_int(&b, 1, 4), put_int(&b, 2, 4);
        put_int(&b, 3, 1), put_int(&b, 0, 4), put_int(&b, 1, 4), put_int(&b, index, 4);
        char part[200];
        snprintf(part, sizeof part, "a.ply@%zu: face 1 names vertex %d, but the 3 vertices", body + 13, (int)index);
        test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, part);
        b.data[body + 13] = 2; /* now the faces differ, and two bytes too many are left */
        test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "face 1 has fewer than 3 vertices");
        b.data[body + 13] = 4;
        test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "face 1 has a list of 4 numbers, but only 12 bytes");
    }
    start_binary(&b, VERTEX3 "element face 1\nproperty list int int vertex_indices\n");
    put_points(&b, 3);
    put_int(&b, -3, 4), put_int(&b, 0, 4), put_int(&b, 1, 4), put_int(&b, 2, 4);
    test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "face 0 has a list of negative length");
    start_binary(&b, VERTEX3 "element face 1\nproperty list uint int vertex_indices\n");
    put_points(&b, 3);
    put_int(&b, -1, 4), put_int(&b, 0, 4), put_int(&b, 1, 4), put_int(&b, 2, 4);
    test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "face 0 has a list of 4294967295 numbers");
    start_binary(&b, VERTEX3 "element edge 1\nproperty int vertex1\nproperty int vertex2\n");
    put_points(&b, 3);
    put_int(&b, 0, 4), put_int(&b, 7, 4);
    test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "edge 0 names vertex 7");
    start_binary(&b, "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                     "property list int double weights\n");
    put_points(&b, 1);
    put_int(&b, 0x7fffffff, 4);
    test_refuse(&r, "a.ply", b.data, b.size, MT_ERROR_SYNTAX, "vertex 0 has a list of 2147483647 numbers");
    test_reading_end(&r);
}

/* Every shorter file is refused; every longer one is read with a warning. */
static void truncated_and_longer(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    for (int kind = 0; kind < 3; kind++) {
        bytes b;
        start_binary(&b, VERTEX3 "property list uchar short bones\nelement extra 1\nproperty list int double values\n"
                                 "element face 2\nproperty list uchar int vertex_indices\nproperty uchar flag\n");
        for (int i = 0; i < 3; i++) {
            put_points(&b, 1), put_int(&b, 1, 1), put_int(&b, 7, 2);
        }
        put_int(&b, 1, 4), put_points(&b, 1), b.size -= 4;
        for (int i = 0; i < 2; i++) {
            int sides = kind == 1 && i == 1 ? 4 : 3;
            put_int(&b, sides, 1), put_int(&b, 0, 4), put_int(&b, 1, 4), put_int(&b, 2, 4);
            if (sides == 4) {
                put_int(&b, 0, 4);
            }
            put_int(&b, 200, 1);
        }
        if (kind == 2) {
            b.size = 0;
            put_text(&b, "ply\nformat ascii 1.0\n" VERTEX3 FACE1 "end_header\n" POINTS3 "3 0 1 2");
        }
        for (size_t size = 0; size < b.size; size++) {
            test_refuse(&r, "a.ply", b.data, size, MT_ERROR_SYNTAX, "");
        }
        mt_mesh *mesh = test_read(&r, "a.ply", b.data, b.size);
        test_warned(&r, kind == 2 ? NULL : "\"bones\"");
        mt_mesh_destroy(r.context, mesh);
        put_text(&b, kind == 2 ? "\nmore" : "more");
        mesh = test_read(&r, "a.ply", b.data, b.size);
        test_warned(&r, kind == 2 ? "1 lines after the last element are ignored"
                                  : "4 bytes after the last element are ignored");
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* Numbers in text are rounded once: 1 + 2^-24 + 2^-60 lies above the middle of two floats, and as a double on it. */
static void floats_are_rounded_once(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    mt_mesh *mesh = test_read_text(&r, "a.ply",
                                   ASCII "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                                         "end_header\n1.00000005960464477539 1.000000059604644775390625 "
                                         "1.0000000596046447753906251\n1e-46 7.1e-46 1e39\n");
    test_warned(&r, "1 numbers are too large for the float");
    const float *p = mesh->positions;
    assert_true(p[0] == 1.0f);
    assert_true(p[1] == 1.0f);
    assert_true(p[2] == 1.0f + 0x1p-23f);
    assert_true(p[3] == 0.0f);
    assert_true(p[4] == 0x1p-149f);
    assert_true(isinf(p[5]));
    mt_mesh_destroy(r.context, mesh);
    mesh = test_read_text(&r, "a.ply", ASCII VERTEX3 "end_header\nnan 0 0\ninf -inf 0\n0 0 0\n");
    test_warned(&r, "2 vertices have a coordinate that is not finite");
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

static void random_meshes_come_back(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    test_random random = {11};
    for (int round = 0; round < 150; round++) {
        mt_mesh *mesh = test_random_mesh(r.context, &random);
        for (int encoding = MT_ENCODING_ASCII; encoding <= MT_ENCODING_BINARY_BIG; encoding++) {
            mt_mesh *copy = test_round_trip(&r, mesh, "ply", (mt_encoding)encoding);
            test_assert_same_mesh(mesh, copy);
            mt_mesh_destroy(r.context, copy);
        }
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* Bytes changed at random in files of every kind: refused or read as a valid mesh, never more. */
static void flipped_bytes(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    test_random random = {5};
    for (int round = 0; round < 60; round++) {
        mt_mesh *mesh = test_random_mesh(r.context, &random);
        mt_mesh_write_options options = {.encoding = (mt_encoding)(1 + round % 3)};
        void *data;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &data, &size), MT_OK);
        for (int i = 0; i < 30; i++) {
            uint8_t *at = (uint8_t *)data + test_random_below(&random, size), old = *at;
            *at = (uint8_t)(test_random_below(&random, 2) ? test_random_next(&random) : old ^ 1);
            mt_mesh *read = NULL;
            if (mt_mesh_read_memory(r.context, "a.ply", data, size, NULL, &read, NULL) == MT_OK) {
                assert_int_equal(mt_mesh_validate(r.context, read), MT_OK);
            } else {
                assert_null(read);
                mt_context_clear_error(r.context);
            }
            mt_mesh_destroy(r.context, read);
            *at = old;
        }
        mt_free(r.context, data);
        mt_mesh_destroy(r.context, mesh);
    }
    test_reading_end(&r);
}

/* Values that PLY has no way to say are said to be changed. */
static void what_is_changed_is_said(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const mt_index faces[] = {3, 0, 1, 2};
    mt_mesh *mesh = test_mesh(r.context, 3, positions, 1, faces);
    mt_attribute *attribute;
    mt_attribute_layout name = {"a name", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_U8, 1, 3, false};
    assert_int_equal(mt_mesh_add_attribute(r.context, mesh, &name, &attribute), MT_OK);
    memset(attribute->values, 1, 3);
    mt_attribute_layout uvs = {"", MT_SEMANTIC_UV, MT_DOMAIN_CORNER, MT_F32, 2, 1, true};
    assert_int_equal(mt_mesh_add_attribute(r.context, mesh, &uvs, &attribute), MT_OK);
    memset(attribute->values, 0, 2 * sizeof(float));
    attribute->indices[0] = 0, attribute->indices[1] = MT_NONE, attribute->indices[2] = 0;
    void *data;
    size_t size;
    r.warnings[0] = 0;
    assert_int_equal(mt_mesh_write_memory(r.context, mesh, NULL, &data, &size), MT_OK);
    test_warned(&r, "the attribute \"a name\" is written to PLY as property \"a_name\"");
    test_warned(&r, "1 corners without texture coordinates");
    mt_free(r.context, data);
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

/* The n-th allocation fails, for every n: a clean error each time. */
static void missing_memory(void **state)
{
    (void)state;
    test_reading r;
    test_reading_begin(&r);
    test_random random = {3};
    mt_mesh *mesh = test_random_mesh(r.context, &random);
    for (int encoding = MT_ENCODING_ASCII; encoding <= MT_ENCODING_BINARY_BIG; encoding++) {
        mt_mesh_write_options options = {.encoding = (mt_encoding)encoding};
        void *data;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(r.context, mesh, &options, &data, &size), MT_OK);
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        for (uint64_t failing = 1; status != MT_OK; failing++) {
            test_reading poor;
            test_reading_begin_with(&poor, (mt_context_options){.thread_count = 1, .failing_allocation = failing});
            mt_mesh *read = NULL;
            status = mt_mesh_read_memory(poor.context, "a.ply", data, size, NULL, &read, NULL);
            assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
            assert_int_equal(mt_context_error(poor.context)->status, status);
            mt_mesh_destroy(poor.context, read);
            test_reading_end(&poor);
        }
        mt_free(r.context, data);
    }
    mt_mesh_destroy(r.context, mesh);
    test_reading_end(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_triangle),
        cmocka_unit_test(ascii_layout),
        cmocka_unit_test(binary_layouts),
        cmocka_unit_test(meanings),
        cmocka_unit_test(nearly_empty),
        cmocka_unit_test(refused_headers),
        cmocka_unit_test(refused_ascii_bodies),
        cmocka_unit_test(refused_binary_bodies),
        cmocka_unit_test(truncated_and_longer),
        cmocka_unit_test(floats_are_rounded_once),
        cmocka_unit_test(random_meshes_come_back),
        cmocka_unit_test(flipped_bytes),
        cmocka_unit_test(what_is_changed_is_said),
        cmocka_unit_test(missing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
