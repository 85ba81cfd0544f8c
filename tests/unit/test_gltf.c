/* glTF and Draco: the scene's transforms, the modes of primitives, what is shared and what is not, what writing keeps,
 * and that quantisation stays within its step. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/reading.h"
#include "tests/support/scratch.h"

#include <meshtool/deviation.h>
#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Five positions: the corners of a square, and one above it; then the indices 0 to 4 as bytes, and 3 of nothing. */
#define DATA "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAECAwQAAAA="
#define TAIL                                                                                                           \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":5}],"            \
    "\"buffers\":[{\"byteLength\":68,\"uri\":\"data:;base64," DATA "\"}]}"
#define POSITIONS "{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}"
#define INDICES "{\"bufferView\":1,\"componentType\":5121,\"count\":5,\"type\":\"SCALAR\"}"

/* A file of one node, with its members and its primitives. */
static mt_mesh *read_scene(test_reading *reading, const char *node, const char *primitives)
{
    char text[4096];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0%s}],"
             "\"meshes\":[{\"primitives\":[%s]}],\"accessors\":[" POSITIONS "," INDICES "]," TAIL,
             node, primitives);
    return test_read_text(reading, "a.gltf", text);
}

static void check_vertices(const mt_index *found, size_t count, const mt_index *expected)
{
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(found[i], expected[i]);
    }
}

static void test_modes(void **state)
{
    (void)state;
    static const struct {
        unsigned mode;
        mt_index faces, wires, points;
        mt_index vertices[9];
    } cases[] = {
        {0, 0, 0, 5, {0, 1, 2, 3, 4}},
        {1, 0, 2, 0, {0, 1, 2, 3}},
        {2, 0, 1, 0, {0, 1, 2, 3, 4, 0}},
        {3, 0, 1, 0, {0, 1, 2, 3, 4}},
        {4, 1, 0, 0, {0, 1, 2}},
        {5, 3, 0, 0, {0, 1, 2, 1, 3, 2, 2, 3, 4}},
        {6, 3, 0, 0, {1, 2, 0, 2, 3, 0, 3, 4, 0}},
    };
    test_reading reading;
    test_reading_begin(&reading);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int indexed = 0; indexed < 2; indexed++) {
            char primitive[128];
            snprintf(primitive, sizeof primitive, "{\"attributes\":{\"POSITION\":0},\"mode\":%u%s}", cases[i].mode,
                     indexed ? ",\"indices\":1" : "");
            mt_mesh *mesh = read_scene(&reading, "", primitive);
            assert_int_equal(mesh->vertex_count, 5);
            assert_int_equal(mesh->face_count, cases[i].faces);
            assert_int_equal(mesh->wire_count, cases[i].wires);
            assert_int_equal(mesh->point_count, cases[i].points);
            check_vertices(mesh->corner_vertices, mesh->corner_count, cases[i].vertices);
            check_vertices(mesh->wire_vertices, mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0,
                           cases[i].vertices);
            check_vertices(mesh->point_vertices, mesh->point_count, cases[i].vertices);
            /* Five vertices make no whole number of lines or triangles. */
            test_warned(&reading, cases[i].mode == 1 || cases[i].mode == 4 ? "left out" : NULL);
            mt_mesh_destroy(reading.context, mesh);
        }
    }
    test_reading_end(&reading);
}

static void test_transforms(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    static const char triangle[] = "{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},\"indices\":1,\"mode\":6}";
    mt_mesh *mesh = read_scene(&reading, "", triangle);
    assert_int_equal(mesh->position_type, MT_F32);
    assert_int_equal(mesh->corner_vertices[1], 2);
    mt_mesh_destroy(reading.context, mesh);
    /* Turned by 90 degrees about z, mirrored and stretched along x, moved. */
    mesh = read_scene(&reading, ",\"translation\":[10,20,30],\"scale\":[-2,1,1],\"rotation\":[0,0,0.5,0.5]", triangle);
    assert_int_equal(mesh->position_type, MT_F64);
    mt_vec3 p = mt_mesh_position(mesh, 2); /* (1, 1, 0) */
    assert_true(fabs(p.x - 9.0) < 1e-12 && fabs(p.y - 18.0) < 1e-12 && fabs(p.z - 30.0) < 1e-12);
    assert_int_equal(mesh->corner_vertices[0], 1); /* mirrored: the triangle is turned round */
    assert_int_equal(mesh->corner_vertices[1], 0);
    assert_int_equal(mesh->corner_vertices[2], 2);
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    /* (1, 1, 0) by the inverse transpose: (-1/2, 1), turned: (-1, -1/2). */
    assert_true(fabs(mt_attribute_get(normals, 2, 0) + 1.0 / sqrt(1.25)) < 1e-6);
    assert_true(fabs(mt_attribute_get(normals, 2, 1) + 0.5 / sqrt(1.25)) < 1e-6);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

static void test_what_is_shared(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh =
        read_scene(&reading, ",\"name\":\"one\"",
                   "{\"attributes\":{\"POSITION\":0},\"mode\":6},{\"attributes\":{\"POSITION\":0},\"mode\":0},"
                   "{\"attributes\":{\"POSITION\":0,\"NORMAL\":0},\"mode\":6}");
    assert_int_equal(mesh->vertex_count, 10);
    assert_int_equal(mesh->face_count, 6);
    assert_int_equal(mesh->point_vertices[1], 1);
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    assert_int_equal(normals->value_count, 5);
    assert_int_equal(normals->indices[4], MT_NONE);
    assert_int_equal(normals->indices[5], 0);
    assert_string_equal(mt_mesh_find_labels(mesh, MT_LABEL_PART)->names[0], "one");
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

static char *deep_text(size_t depth, size_t *size)
{
    char *text = malloc(depth * 64 + 4096);
    *size = (size_t)sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[");
    for (size_t i = 0; i < depth; i++) {
        *size += (size_t)sprintf(text + *size, "{\"translation\":[1,0,0],\"children\":[%zu]},", i + 1);
    }
    *size += (size_t)sprintf(
        text + *size, "{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":6}]}],"
                      "\"accessors\":[" POSITIONS "]," TAIL);
    return text;
}

static void test_deep_scenes(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    size_t size;
    char *text = deep_text(100000, &size);
    mt_mesh *mesh = test_read(&reading, "deep.gltf", text, size);
    assert_true(mt_mesh_position(mesh, 0).x == 100000.0);
    mt_mesh_destroy(reading.context, mesh);
    free(text);
    test_reading_end(&reading);
}

/* A few bytes that would become billions of vertices. */
static void test_repetition_is_limited(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    enum { COUNT = 60000 };
    char *text = malloc(COUNT * 40 + 4096);
    size_t size = (size_t)sprintf(
        text, "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[");
    for (size_t i = 0; i < 2000; i++) {
        size +=
            (size_t)sprintf(text + size, "%s{\"attributes\":{\"POSITION\":0},\"indices\":1,\"mode\":6}", i ? "," : "");
    }
    size +=
        (size_t)sprintf(text + size, "]}],\"accessors\":[{\"componentType\":5126,\"count\":20000,\"type\":\"VEC3\"},"
                                     "{\"componentType\":5123,\"count\":100000,\"type\":\"SCALAR\"}]," TAIL);
    test_refuse(&reading, "bomb.gltf", text, size, MT_ERROR_TOO_LARGE, "again and again");
    free(text);
    test_reading_end(&reading);
}

static void test_files_beside(void **state)
{
    (void)state;
    static const unsigned char floats[36] = {[14] = 0x80, [15] = 0x3F, [28] = 0, [30] = 0x80, [31] = 0x3F};
    static const char text[] =
        "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"the%20data.bin\"}"
        "]}";
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh;
    const char *path = test_scratch_file("beside.gltf", text, sizeof text - 1);
    assert_int_equal(mt_mesh_read_file(reading.context, path, NULL, &mesh, NULL), MT_ERROR_IO);
    mt_context_clear_error(reading.context);
    test_scratch_file("the data.bin", floats, sizeof floats);
    assert_int_equal(mt_mesh_read_file(reading.context, path, NULL, &mesh, NULL), MT_OK);
    assert_int_equal(mesh->face_count, 1);
    assert_true(mt_mesh_position(mesh, 1).x == 1.0);
    mt_mesh_destroy(reading.context, mesh);
    test_scratch_file("the data.bin", floats, 35);
    assert_int_equal(mt_mesh_read_file(reading.context, path, NULL, &mesh, NULL), MT_ERROR_SYNTAX);
    mt_context_clear_error(reading.context);
    test_refuse_text(&reading, "beside.gltf", text, MT_ERROR_UNSUPPORTED, "does not come from a folder");
    test_reading_end(&reading);
}

/* One vertex is in no face: Draco's sequential method holds it only beside enough triangles. */
#define LONELY "v 2 2 2\n"
#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
#define RICH                                                                                                           \
    "vt 0 0\nvt 0.25 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\nvn 0 0 1\nvn 0 1 0\no left\nusemtl red\nf 1/1/1 2/2/1 3/3/1\n"     \
    "o right\nusemtl blue\nf 1/5/1 3/3/1 4/4/2\n"

static mt_mesh *through(test_reading *reading, const mt_mesh *mesh, const mt_mesh_write_options *options)
{
    void *bytes;
    size_t size;
    if (mt_mesh_write_memory(reading->context, mesh, options, &bytes, &size) != MT_OK) {
        fail_msg("%s", mt_context_error(reading->context)->message);
    }
    mt_mesh *again = test_read(reading, options->format, bytes, size);
    mt_free(reading->context, bytes);
    return again;
}

/* The corner values of the first mesh must be those of the second's vertices. */
static void check_corners(const mt_mesh *a, const mt_mesh *b, mt_semantic semantic, uint32_t count, double error)
{
    const mt_attribute *x = mt_mesh_find_attribute(a, semantic, MT_DOMAIN_CORNER);
    const mt_attribute *y = mt_mesh_find_attribute(b, semantic, MT_DOMAIN_VERTEX);
    for (mt_index corner = 0; corner < a->corner_count; corner++) {
        mt_index i = mt_attribute_value_index(x, corner), k = mt_attribute_value_index(y, b->corner_vertices[corner]);
        for (uint32_t c = 0; c < count; c++) {
            assert_true(fabs(mt_attribute_get(x, i, c) - mt_attribute_get(y, k, c)) <= error);
        }
    }
}

static void test_writing_keeps(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = test_read_text(&reading, "a.obj", SQUARE LONELY RICH);
    mt_mesh *plain = test_read_text(&reading, "a.obj", SQUARE RICH);
    static const char *const formats[] = {"glb", "gltf", "glb"};
    for (int i = 0; i < 3; i++) {
        mt_mesh_write_options options = {.format = formats[i],
                                         .draco = {.compress = i == 2, .lossless = true, .sequential = true}};
        mt_mesh *again = through(&reading, i == 2 ? plain : mesh, &options);
        /* Each part has its three vertices; the one in no face goes with the first. */
        assert_int_equal(again->vertex_count, i == 2 ? 6 : 7);
        assert_int_equal(again->face_count, 2);
        check_corners(mesh, again, MT_SEMANTIC_UV, 2, 0.0);
        check_corners(mesh, again, MT_SEMANTIC_NORMAL, 3, 0.0);
        const mt_labels *parts = mt_mesh_find_labels(again, MT_LABEL_PART);
        const mt_labels *materials = mt_mesh_find_labels(again, MT_LABEL_MATERIAL);
        assert_string_equal(parts->names[parts->face_labels[1]], "right");
        assert_string_equal(materials->names[materials->face_labels[0]], "red");
        assert_string_equal(materials->names[materials->face_labels[1]], "blue");
        mt_mesh_destroy(reading.context, again);
    }
    mt_loss loss;
    assert_int_equal(mt_mesh_format_loss(reading.context, mesh, mt_mesh_format_by_extension("glb"), NULL, &loss),
                     MT_OK);
    assert_int_equal(loss.count, 2);
    assert_string_equal(loss.items[0], "1 shared vertex (split at corners)");
    assert_string_equal(loss.items[1], "1 shared vertex (repeated by part)");
    mt_mesh_destroy(reading.context, plain);
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

/* Values on corners that are equal split nothing, however they are numbered; a fan of many values is no quadratic time.
 */
static void test_splitting(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    enum { SPOKES = 200000 };
    char *text = malloc(SPOKES * 90 + 64);
    for (int same = 0; same < 2; same++) {
        size_t size = (size_t)sprintf(text, "v 0 0 0\n");
        for (int i = 0; i <= SPOKES; i++) {
            size += (size_t)sprintf(text + size, "v 1 %d 0\nvt %d 0\n", i, same ? 1 : i);
        }
        for (int i = 1; i <= SPOKES; i++) {
            size += (size_t)sprintf(text + size, "f 1/%d %d/1 %d/1\n", i, i + 1, i + 2);
        }
        mt_mesh *mesh = test_read(&reading, "fan.obj", text, size);
        mt_mesh_write_options options = {.format = "glb"};
        mt_mesh *again = through(&reading, mesh, &options);
        assert_int_equal(again->vertex_count, mesh->vertex_count + (same ? 0 : SPOKES - 1));
        mt_mesh_destroy(reading.context, again);
        mt_mesh_destroy(reading.context, mesh);
    }
    free(text);
    test_reading_end(&reading);
}

static void test_what_cannot_be_written(void **state)
{
    (void)state;
    test_reading reading;
    test_reading_begin(&reading);
    mt_mesh *mesh = test_read_text(&reading, "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e39 0\nf 1 2 3\n");
    static const char *const formats[] = {"glb", "gltf", "drc"};
    for (int i = 0; i < 3; i++) {
        mt_mesh_write_options options = {.format = formats[i]};
        void *bytes;
        size_t size;
        assert_int_equal(mt_mesh_write_memory(reading.context, mesh, &options, &bytes, &size), MT_ERROR_UNSUPPORTED);
        assert_non_null(strstr(mt_context_error(reading.context)->message, "vertex 2"));
        mt_context_clear_error(reading.context);
    }
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

/* Quantised to b bits, a coordinate is off by half a step of the largest extent at most. */
static void test_quantisation_stays_within_its_step(void **state)
{
    (void)state;
    static const char *const formats[] = {"drc", "glb"};
    test_reading reading;
    test_reading_begin(&reading);
    mt_generate_options sphere = {.resolution = 3, .position_type = MT_F32};
    mt_mesh *mesh;
    assert_int_equal(mt_generate(reading.context, "icosphere", &sphere, &mesh), MT_OK);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    double extent = bounds.maximum.x - bounds.minimum.x;
    for (unsigned bits = 6; bits <= 20; bits += 7) {
        for (unsigned i = 0; i < 4; i++) {
            mt_mesh_write_options options = {
                .format = formats[i % 2],
                .draco = {
                    .compress = true, .position_bits = bits, .sequential = i >= 2, .has_speed = true, .speed = i}};
            mt_mesh *again = through(&reading, mesh, &options);
            double step = extent / (double)((1u << bits) - 1), limit = sqrt(3.0) / 2.0 * step * 1.001 + 1e-6;
            mt_deviation deviation;
            assert_int_equal(again->face_count, mesh->face_count);
            assert_int_equal(again->vertex_count, mesh->vertex_count);
            assert_int_equal(mt_measure_deviation(reading.context, mesh, again, NULL, &deviation), MT_OK);
            assert_true(deviation.hausdorff <= limit);
            assert_true(bits > 6 || deviation.hausdorff > limit / 100); /* it is quantised indeed */
            mt_deviation_release(reading.context, &deviation);
            mt_mesh_destroy(reading.context, again);
        }
    }
    mt_mesh_destroy(reading.context, mesh);
    test_reading_end(&reading);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_modes),
        cmocka_unit_test(test_transforms),
        cmocka_unit_test(test_what_is_shared),
        cmocka_unit_test(test_deep_scenes),
        cmocka_unit_test(test_repetition_is_limited),
        cmocka_unit_test(test_files_beside),
        cmocka_unit_test(test_writing_keeps),
        cmocka_unit_test(test_splitting),
        cmocka_unit_test(test_what_cannot_be_written),
        cmocka_unit_test(test_quantisation_stays_within_its_step),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
