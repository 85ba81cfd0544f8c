/* OBJ files of many blocks: relative references across them, the line of a mistake, long lines, and memory. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/text_reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A text of many blocks with every kind of reference in it; vertices and faces alternate, so that relative
 * references reach into blocks before. */
static char *long_text(size_t rings, size_t *size)
{
    char *text = malloc(rings * 400);
    char *at = text;
    test_random random = {5};
    for (size_t ring = 0; ring < rings; ring++) {
        at += sprintf(at, "%s %zu\n", ring % 3 ? "g" : "usemtl", ring % 7);
        for (int i = 0; i < 4; i++) {
            at += sprintf(at, "v %.17g %.6f %zu\nvt %.3f 0\n", test_random_unit(&random), test_random_unit(&random),
                          ring, test_random_unit(&random));
        }
        size_t last = 4 * ring + 4;
        at += sprintf(at, "f -1/-1 -2/-2 -3/-3 -4/-4\n");
        if (ring > 0) {
            at += sprintf(at, "f %zu -5 %zu\nf -8 \\\n -7 -1 %zu %zu\nl -1 -8\np -%zu\n", last, last - 1, last - 6,
                          last - 7, last);
        }
    }
    *size = (size_t)(at - text);
    return text;
}

static void test_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    size_t size, rings = 20000;
    char *text = long_text(rings, &size);
    uint64_t hashes[2];
    for (unsigned threads = 1; threads <= 2; threads++) {
        mt_context *context = test_context_with_threads(threads);
        mt_mesh *mesh = text_read_bytes(context, "a.obj", text, size);
        assert_int_equal(mesh->vertex_count, 4 * rings);
        assert_int_equal(mesh->face_count, 3 * rings - 2);
        for (size_t ring = 0; ring < rings; ring++) {
            mt_index face = ring ? (mt_index)(3 * ring - 2) : 0, corner = mt_mesh_face_begin(mesh, face);
            assert_int_equal(mesh->corner_vertices[corner], 4 * ring + 3);
            assert_int_equal(mesh->corner_vertices[corner + 3], 4 * ring);
            assert_true(mt_mesh_position(mesh, (mt_index)(4 * ring)).z == (double)ring);
            if (ring > 0) {
                assert_int_equal(mesh->corner_vertices[corner + 5], 4 * ring - 1);
                assert_int_equal(mesh->corner_vertices[corner + 7], 4 * ring - 4);
                assert_int_equal(mesh->corner_vertices[corner + 10], 4 * ring - 3);
            }
        }
        hashes[threads - 1] = test_mesh_hash(mesh);
        mt_mesh *again = text_through(context, mesh, "obj", MT_ENCODING_DEFAULT);
        assert_int_equal(test_mesh_hash(again), hashes[threads - 1]);
        mt_mesh_destroy(context, again);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_int_equal(hashes[0], hashes[1]);
    free(text);
}

/* The line of a wrong reference is found wherever it lies among the blocks. */
static void test_place_of_a_wrong_reference(void **state)
{
    (void)state;
    size_t size;
    char *text = long_text(8000, &size);
    test_random random = {6};
    for (int round = 0; round < 20; round++) {
        mt_context *context = test_context_with_threads(2);
        char *face = NULL;
        do {
            face = strstr(text + test_random_below(&random, size), "\nf -1/");
        } while (!face);
        size_t line = 2;
        for (const char *c = text; c < face; c++) {
            line += *c == '\n';
        }
        char expected[128];
        memcpy(face + 3, "99999", 5);
        snprintf(expected, sizeof expected, "a.obj:%zu:3: vertex 99999 does not exist: the file has 32000 vertices",
                 line);
        assert_string_equal(text_refuse(context, "a.obj", text, size, MT_ERROR_SYNTAX), expected);
        memcpy(face + 3, "-1/-1", 5);
        test_context_end(context);
    }
    free(text);
}

static void test_large_polygon_and_long_line(void **state)
{
    (void)state;
    size_t sides = 100000, size = 0;
    char *text = malloc(sides * 40);
    for (size_t i = 0; i < sides; i++) {
        size += (size_t)sprintf(text + size, "v %zu 0 0\n", i);
    }
    size += (size_t)sprintf(text + size, "f");
    for (size_t i = 0; i < sides; i++) {
        size += (size_t)sprintf(text + size, i % 10 ? " %zu" : " \\\n %zu", i + 1);
    }
    mt_context *context = test_context_with_threads(2);
    mt_mesh *mesh = text_read_bytes(context, "a.obj", text, size);
    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->face_size, sides);
    assert_int_equal(mesh->corner_vertices[sides - 1], sides - 1);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    free(text);
}

/* The peak stays under three meshes and the scratch of a block. */
static void test_memory(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(2);
    size_t side = 400, size = 0;
    char *text = malloc(side * side * 100);
    for (size_t i = 0; i < side * side; i++) {
        size += (size_t)sprintf(text + size, "v %zu.125 %zu.25 1\n", i % side, i / side);
    }
    for (size_t i = 0; i + side + 1 < side * side; i++) {
        size += (size_t)sprintf(text + size, "f %zu %zu %zu\nf %zu %zu %zu\n", i + 1, i + 2, i + side + 2, i + 1,
                                i + side + 2, i + side + 1);
    }
    mt_mesh *mesh = text_read_bytes(context, "a.obj", text, size);
    uint64_t held = mt_context_bytes(context);
    assert_true(mt_context_peak_bytes(context) < 3 * held);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_same_for_any_number_of_threads),
        cmocka_unit_test(test_place_of_a_wrong_reference),
        cmocka_unit_test(test_large_polygon_and_long_line),
        cmocka_unit_test(test_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
