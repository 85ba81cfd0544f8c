/* glTF with integers for floats (KHR_mesh_quantization): the bytes are taken apart here with nothing but JSON and the
 * tables of the specification, and held against the mesh; then our reader must find the same. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/reading.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <float.h>
#include <jansson.h>
#include <math.h>
#include <string.h>

/* What a GLB of one primitive holds. */
typedef struct glb {
    json_t *root;
    const unsigned char *data;
    size_t data_size;
} glb;

static uint32_t word_at(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static glb open_glb(const unsigned char *bytes, size_t size)
{
    glb file = {0};
    json_error_t error;
    assert_true(size > 20 && memcmp(bytes, "glTF", 4) == 0 && word_at(bytes + 8) == size);
    uint32_t text = word_at(bytes + 12);
    file.root = json_loadb((const char *)bytes + 20, text, 0, &error);
    if (!file.root) {
        fail_msg("%s: %.200s", error.text, bytes + 20 + (error.position > 100 ? error.position - 100 : 0));
    }
    file.data = bytes + 28 + text;
    file.data_size = word_at(bytes + 20 + text);
    assert_int_equal(28 + text + file.data_size, size);
    return file;
}

static json_t *item(json_t *parent, const char *list, size_t index)
{
    json_t *found = json_array_get(json_object_get(parent, list), index);
    assert_non_null(found);
    return found;
}

static size_t whole(json_t *object, const char *key)
{
    return (size_t)json_integer_value(json_object_get(object, key));
}

static double number(json_t *object, const char *key, size_t index)
{
    return json_number_value(json_array_get(json_object_get(object, key), index));
}

static bool names(json_t *root, const char *list, const char *name)
{
    const char *found = json_string_value(json_array_get(json_object_get(root, list), 0));
    return json_array_size(json_object_get(root, list)) == 1 && found && strcmp(found, name) == 0;
}

/* An accessor of the first primitive, by the name of its attribute. */
typedef struct values {
    json_t *accessor;
    const unsigned char *bytes;
    size_t count, components, stride;
    unsigned type;
} values;

static values find(const glb *file, const char *name)
{
    json_t *primitive = item(item(file->root, "meshes", 0), "primitives", 0);
    json_t *reference = json_object_get(json_object_get(primitive, "attributes"), name);
    values v = {0};
    if (!reference) {
        return v;
    }
    v.accessor = item(file->root, "accessors", (size_t)json_integer_value(reference));
    json_t *view = item(file->root, "bufferViews", whole(v.accessor, "bufferView"));
    const char *shape = json_string_value(json_object_get(v.accessor, "type"));
    v.type = (unsigned)whole(v.accessor, "componentType");
    v.count = whole(v.accessor, "count");
    v.components = (size_t)(shape[3] - '0');
    size_t size = v.type >= 5125 ? 4 : v.type >= 5122 ? 2 : 1, offset = whole(view, "byteOffset");
    v.stride = whole(view, "byteStride");
    v.stride = v.stride ? v.stride : size * v.components;
    /* Section 3.6.2.4: vertices are aligned to 4 bytes. */
    assert_int_equal(v.stride % 4, 0);
    assert_int_equal(offset % 4, 0);
    assert_true(v.stride >= size * v.components && v.count * v.stride <= whole(view, "byteLength"));
    assert_true(offset + whole(view, "byteLength") <= file->data_size);
    v.bytes = file->data + offset;
    return v;
}

/* The component as it is stored; normalised integers as the fraction that they stand for. */
static double component(const values *v, size_t index, size_t k)
{
    const unsigned char *at = v->bytes + index * v->stride;
    bool normalized = json_is_true(json_object_get(v->accessor, "normalized"));
    unsigned pair = at[2 * k] | (unsigned)at[2 * k + 1] << 8;
    switch (v->type) {
    case 5120:
        return normalized ? fmax((signed char)at[k] / 127.0, -1.0) : (signed char)at[k];
    case 5121:
        return normalized ? at[k] / 255.0 : at[k];
    case 5122:
        return normalized ? fmax((int16_t)pair / 32767.0, -1.0) : (int16_t)pair;
    case 5123:
        return normalized ? pair / 65535.0 : pair;
    default: {
        uint32_t word = word_at(at + 4 * k);
        float real;
        memcpy(&real, &word, sizeof real);
        return (double)real;
    }
    }
}

static double axis(mt_vec3 p, size_t k)
{
    return k == 0 ? p.x : k == 1 ? p.y : p.z;
}

/* Half a step, and what doubles round at the size of the numbers. */
static double bound_of(double step, double p, double extent)
{
    return step / 2 + 8 * DBL_EPSILON * (fabs(p) + extent);
}

static void check_positions(const glb *file, const mt_mesh *mesh, unsigned bits)
{
    values v = find(file, "POSITION");
    json_t *node = item(file->root, "nodes", 0);
    double least[3] = {0}, most[3] = {0}, extent = 0, limits[2][3];
    for (size_t k = 0; k < 3; k++) {
        for (mt_index i = 0; i < mesh->vertex_count; i++) {
            double p = axis(mt_mesh_position(mesh, i), k), c = component(&v, i, k);
            least[k] = i == 0 ? p : fmin(least[k], p);
            most[k] = i == 0 ? p : fmax(most[k], p);
            limits[0][k] = i == 0 ? c : fmin(limits[0][k], c);
            limits[1][k] = i == 0 ? c : fmax(limits[1][k], c);
        }
        extent = fmax(extent, most[k] - least[k]);
        assert_true(limits[0][k] == number(v.accessor, "min", k) && limits[1][k] == number(v.accessor, "max", k));
        assert_true(limits[0][k] == 0 && limits[1][k] <= (1u << bits) - 1);
    }
    double step = number(node, "scale", 0), expected = extent / ((1u << bits) - 1);
    assert_int_equal(v.count, mesh->vertex_count);
    assert_int_equal(v.type, bits <= 8 ? 5121 : 5123);
    assert_int_equal(v.stride, bits <= 8 ? 4 : 8);
    assert_false(json_is_true(json_object_get(v.accessor, "normalized")));
    assert_true(extent == 0 ? step == 1 : fabs(step - expected) <= 4 * DBL_EPSILON * expected);
    assert_true(extent == 0 || fmax(limits[1][0], fmax(limits[1][1], limits[1][2])) == (1u << bits) - 1);
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        double p = axis(mt_mesh_position(mesh, (mt_index)(i / 3)), i % 3);
        double q = number(node, "translation", i % 3) + number(node, "scale", i % 3) * component(&v, i / 3, i % 3);
        assert_true(fabs(p - q) <= bound_of(extent == 0 ? 0 : step, p, extent));
    }
}

static void check_normals(const glb *file, const mt_mesh *mesh, unsigned bits)
{
    const mt_attribute *from = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    values v = find(file, "NORMAL");
    assert_int_equal(v.type, bits <= 8 ? 5120 : 5122);
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        double n[3], length = 0, stored = 0;
        for (uint32_t k = 0; k < 3; k++) {
            n[k] = mt_attribute_get(from, i, k);
            length += n[k] * n[k];
            stored += component(&v, i, k) * component(&v, i, k);
        }
        for (uint32_t k = 0; k < 3; k++) {
            assert_true(fabs(n[k] / sqrt(length) - component(&v, i, k)) <= 0.5 / (bits <= 8 ? 127 : 32767) + 1e-9);
        }
        assert_true(fabs(sqrt(stored) - 1) <= 0.00674); /* what the validator allows */
    }
}

/* Texture coordinates and colours: as shares of 65535, or as they are. */
static void check_shares(const glb *file, const mt_mesh *mesh, mt_semantic semantic, bool quantised)
{
    const mt_attribute *from = mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_VERTEX);
    bool uv = semantic == MT_SEMANTIC_UV;
    values v = find(file, uv ? "TEXCOORD_0" : "COLOR_0");
    assert_int_equal(v.type, quantised ? 5123 : 5126);
    assert_int_equal(v.components, from->component_count);
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        for (uint32_t k = 0; k < from->component_count; k++) {
            double p = mt_attribute_get(from, i, k), q = component(&v, i, k);
            double rounding = quantised ? 0.5 / 65535 + 1e-9 : 1e-6 * fmax(1, fabs(p));
            assert_true(fabs(p - (uv && k == 1 ? 1 - q : q)) <= rounding);
        }
    }
}

static void add_values(mt_context *context, test_random *random, mt_mesh *mesh, mt_semantic semantic, uint32_t count,
                       double least, double most)
{
    mt_attribute *attribute;
    mt_attribute_layout layout = {.name = "",
                                  .semantic = semantic,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = MT_F32,
                                  .component_count = count,
                                  .value_count = mesh->vertex_count};
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    for (uint64_t i = 0; i < (uint64_t)mesh->vertex_count * count; i++) {
        mt_attribute_set(attribute, (mt_index)(i / count), (uint32_t)(i % count),
                         least + (most - least) * test_random_unit(random));
    }
}

/* Some triangles between random vertices of any size and place that floats have; some axes are flat. */
static mt_mesh *random_triangles(mt_context *context, test_random *random, bool inside)
{
    mt_mesh *mesh;
    mt_mesh_layout layout = {.vertex_count = 1 + test_random_below(random, 300),
                             .face_count = 1 + test_random_below(random, 200),
                             .face_size = 3,
                             .position_type = test_random_below(random, 2) ? MT_F64 : MT_F32};
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    double size = pow(10, 60 * test_random_unit(random) - 30), offset[3], spread[3];
    for (int k = 0; k < 3; k++) {
        offset[k] = test_random_below(random, 2) ? 0 : size * (test_random_unit(random) - 0.5) * 1e5;
        spread[k] = test_random_below(random, 4) ? size * test_random_unit(random) : 0;
    }
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        mt_mesh_set_position(mesh, i,
                             mt_vec3_make(offset[0] + spread[0] * test_random_unit(random),
                                          offset[1] + spread[1] * test_random_unit(random),
                                          offset[2] + spread[2] * test_random_unit(random)));
    }
    for (mt_index i = 0; i < mesh->corner_count; i++) {
        mesh->corner_vertices[i] = (mt_index)test_random_below(random, mesh->vertex_count);
    }
    add_values(context, random, mesh, MT_SEMANTIC_NORMAL, 3, -1, 1);
    add_values(context, random, mesh, MT_SEMANTIC_UV, 2, inside ? 0 : -3, inside ? 1 : 3);
    add_values(context, random, mesh, MT_SEMANTIC_COLOR, 3 + (uint32_t)test_random_below(random, 2), 0, 1);
    return mesh;
}

/* What our reader finds: the same triangles, every vertex within half a step. */
static void check_reading(test_reading *reading, const mt_mesh *mesh, const void *bytes, size_t size, unsigned bits)
{
    mt_mesh *again = test_read(reading, "again.glb", bytes, size);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    mt_vec3 sides = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    double extent = fmax(sides.x, fmax(sides.y, sides.z)), step = extent / ((1u << bits) - 1);
    assert_int_equal(again->vertex_count, mesh->vertex_count);
    assert_int_equal(again->face_count, mesh->face_count);
    assert_memory_equal(again->corner_vertices, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        double p = axis(mt_mesh_position(mesh, (mt_index)(i / 3)), i % 3);
        double q = axis(mt_mesh_position(again, (mt_index)(i / 3)), i % 3);
        assert_true(fabs(p - q) <= bound_of(step, p, extent));
    }
    const mt_attribute *normals = mt_mesh_find_attribute(again, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    const mt_attribute *source = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        double dot = 0, a = 0, b = 0;
        for (uint32_t k = 0; k < 3; k++) {
            double x = mt_attribute_get(source, i, k), y = mt_attribute_get(normals, i, k);
            dot += x * y;
            a += x * x;
            b += y * y;
        }
        assert_true(dot >= (bits <= 8 ? 0.99997 : 1 - 1e-6) * sqrt(a * b)); /* 0.45 degrees */
    }
    mt_mesh_destroy(reading->context, again);
}

static void test_bytes_of_random_meshes(void **state)
{
    (void)state;
    test_random random = {2026};
    test_reading reading;
    test_reading_begin(&reading);
    for (int round = 0; round < 320; round++) {
        bool inside = test_random_below(&random, 2);
        unsigned bits = 1 + (unsigned)round % 16;
        mt_mesh *mesh = random_triangles(reading.context, &random, inside);
        mt_mesh_write_options options = {.format = "glb", .quantize_bits = bits};
        void *bytes;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_OK);
        glb file = open_glb(bytes, size);
        assert_true(names(file.root, "extensionsUsed", "KHR_mesh_quantization"));
        assert_true(names(file.root, "extensionsRequired", "KHR_mesh_quantization"));
        check_positions(&file, mesh, bits);
        check_normals(&file, mesh, bits);
        check_shares(&file, mesh, MT_SEMANTIC_UV, inside);
        check_shares(&file, mesh, MT_SEMANTIC_COLOR, true);
        check_reading(&reading, mesh, bytes, size, bits);
        json_decref(file.root);
        mt_free(reading.context, bytes);
        mt_mesh_destroy(reading.context, mesh);
    }
    test_reading_end(&reading);
}

/* The text form has the same bytes in base64: both must be read as the same mesh. */
static void test_text_is_the_same(void **state)
{
    (void)state;
    test_random random = {7};
    test_reading reading;
    test_reading_begin(&reading);
    for (unsigned bits = 1; bits <= 16; bits += 5) {
        mt_mesh *mesh = random_triangles(reading.context, &random, true), *again[2];
        static const char *const formats[] = {"glb", "gltf"};
        for (int i = 0; i < 2; i++) {
            mt_mesh_write_options options = {.format = formats[i], .quantize_bits = bits};
            void *bytes;
            size_t size;
            assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_OK);
            again[i] = test_read(&reading, formats[i], bytes, size);
            mt_free(reading.context, bytes);
        }
        test_assert_same_mesh(again[0], again[1]);
        mt_mesh_destroy(reading.context, again[0]);
        mt_mesh_destroy(reading.context, again[1]);
        mt_mesh_destroy(reading.context, mesh);
    }
    test_reading_end(&reading);
}

/* Vertices that parts share, and those that seams split, stand at the same place again: the grid is one. */
static void test_parts_still_meet(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 0.9 0 0\nv 1.1 0.7 0.1\nv 0 1 0.3\nvt 0 0\nvt 0.25 0\nvt 1 1\nvn 0 0 1\n"
                               "vn 0 1 0\no left\nf 1/1/1 2/2/1 3/3/1\no right\nf 1/2/1 3/1/2 4/3/2\n";
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = test_read_text(&reading, "a.obj", text);
    mt_mesh_write_options options = {.format = "glb", .quantize_bits = 5};
    void *bytes;
    size_t size;
    assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_OK);
    mt_mesh *again = test_read(&reading, "again.glb", bytes, size);
    const mt_index *from = mesh->corner_vertices, *to = again->corner_vertices;
    assert_int_equal(again->vertex_count, 6);
    for (mt_index i = 0; i < 6; i++) {
        for (mt_index k = 0; k < 6; k++) {
            mt_vec3 p = mt_mesh_position(again, to[i]), q = mt_mesh_position(again, to[k]);
            assert_true((from[i] == from[k]) == (p.x == q.x && p.y == q.y && p.z == q.z));
        }
    }
    mt_free(reading.context, bytes);
    mt_mesh_destroy(reading.context, again);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

/* Sizes in which the step, or the whole, is a number that single precision does not hold are refused; no size is read
 * as another. */
static void test_sizes_at_the_ends_of_floats(void **state)
{
    (void)state;
    static const struct {
        double least, most;
        unsigned bits;
        mt_status status;
        const char *part;
    } cases[] = {
        {0, 0, 12, MT_OK, NULL},
        {-3e38, -3e38, 12, MT_OK, NULL},
        {1e-3, 3e38, 1, MT_OK, NULL},
        {-3e38, 3e38, 16, MT_ERROR_UNSUPPORTED, "within single precision"},
        {0, 1e-33, 16, MT_OK, NULL},
        {0, 1e-37, 16, MT_ERROR_UNSUPPORTED, "within single precision"},
        {0, 1e-37, 2, MT_OK, NULL},
        {0, 4e38, 8, MT_ERROR_UNSUPPORTED, "vertex 1"},
        {0, NAN, 8, MT_ERROR_UNSUPPORTED, "vertex 1"},
        {0, 1, 17, MT_ERROR_ARGUMENT, "1 to 16 bits, not of 17"},
    };
    static const mt_index faces[] = {3, 0, 1, 2};
    test_reading reading;
    test_reading_begin(&reading);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double positions[] = {cases[i].least, 0, 0, cases[i].most, 0, 0, cases[i].least, 0, 0};
        mt_mesh *mesh = test_mesh(reading.context, 3, positions, 1, faces);
        mt_mesh_write_options options = {.format = "glb", .quantize_bits = cases[i].bits};
        void *bytes;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), cases[i].status);
        if (cases[i].status == MT_OK) {
            mt_mesh *again = test_read(&reading, "again.glb", bytes, size);
            double difference = mt_mesh_position(again, 1).x - cases[i].most;
            assert_true(fabs(difference) <= 2 * DBL_EPSILON * fabs(cases[i].most));
            mt_mesh_destroy(reading.context, again);
        } else {
            assert_non_null(strstr(mt_context_error(reading.context)->message, cases[i].part));
            mt_context_clear_error(reading.context);
        }
        mt_free(reading.context, bytes);
        mt_mesh_destroy(reading.context, mesh);
    }
    test_reading_end(&reading);
}

static void test_what_is_said(void **state)
{
    (void)state;
    static const char *const said[] = {"positions (quantised to 12 bits)", "normals (quantised to 16 bits)",
                                       "UVs (quantised to 16 bits)", "float colors (quantised to 16 bits)"};
    test_random random = {3};
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = random_triangles(reading.context, &random, true);
    mt_mesh_write_options options = {.format = "glb", .quantize_bits = 12};
    mt_loss loss;
    assert_int_equal(mt_mesh_format_loss(reading.context, mesh, mt_mesh_format_by_extension("glb"), &options, &loss),
                     MT_OK);
    size_t found = 0;
    for (size_t i = 0; i < loss.count; i++) {
        assert_null(strstr(loss.items[i], "rounded")); /* quantised from doubles, not from floats */
        found += found < 4 && strcmp(loss.items[i], said[found]) == 0;
    }
    assert_int_equal(found, 4);
    void *bytes;
    size_t size;
    options.strict_loss = true;
    assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_ERROR_LOSS);
    mt_context_clear_error(reading.context);
    options = (mt_mesh_write_options){.format = "glb", .quantize_bits = 12, .draco = {.compress = true}};
    assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_ERROR_ARGUMENT);
    mt_context_clear_error(reading.context);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

/* Nothing to quantise: no extension is asked for. */
static void test_nothing(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    static const double positions[1];
    static const mt_index faces[1];
    mt_mesh *mesh = test_mesh(reading.context, 0, positions, 0, faces);
    mt_mesh_write_options options = {.format = "gltf", .quantize_bits = 16, .strict_loss = true};
    void *bytes;
    size_t size;
    assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_OK);
    assert_null(memmem(bytes, size, "extensions", 10));
    mt_free(reading.context, bytes);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes_of_random_meshes), cmocka_unit_test(test_text_is_the_same),
        cmocka_unit_test(test_parts_still_meet),       cmocka_unit_test(test_sizes_at_the_ends_of_floats),
        cmocka_unit_test(test_what_is_said),           cmocka_unit_test(test_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
