/* OFF and ASCII PLY take every face to have the sides of the first, and begin again where one has not: what is read,
 * and where a mistake is found, must not show it. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/text_reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VERTICES 3000
#define FACES 50000 /* some 1.4 MB: three blocks of text */

typedef struct sides_case {
    unsigned first, common, odd; /* sides of face 0, of most, and of face odd_face */
    mt_index odd_face;
    bool colors;
} sides_case;

static const sides_case cases[] = {
    {3, 3, 3, 0, false},         {4, 4, 4, 0, true},          {3, 3, 4, FACES - 1, false}, {3, 3, 7, FACES - 1, true},
    {3, 3, 4, FACES / 2, false}, {5, 3, 3, FACES / 2, false}, {4, 4, 3, 1, true},
};

static unsigned sides_of(const sides_case *c, mt_index face)
{
    return face == 0 ? c->first : face == c->odd_face ? c->odd : c->common;
}

static mt_index vertex_of(mt_index face, unsigned side)
{
    return (mt_index)(((uint64_t)face * 7919 + side) % VERTICES);
}

/* The file's text; where wrong_face is a face, its first vertex does not exist, and *wrong_line is its line. */
static char *text_of(const sides_case *c, bool ply, mt_index wrong_face, size_t *size, size_t *wrong_line)
{
    char *text = malloc((size_t)FACES * 60 + (size_t)VERTICES * 60 + 400), *at = text;
    size_t line = !ply ? 2 : c->colors ? 12 : 9;
    if (ply) {
        at += sprintf(at,
                      "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double "
                      "z\nelement face %d\n%sproperty list uchar int vertex_indices\nend_header\n",
                      VERTICES, FACES,
                      c->colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    } else {
        at += sprintf(at, "OFF\n%d %d 0\n", VERTICES, FACES);
    }
    for (int i = 0; i < VERTICES; i++, line++) {
        at += sprintf(at, "%d.25 %d %d\n", i, -i, i % 10);
    }
    for (mt_index face = 0; face < FACES; face++) {
        line++;
        if (ply && c->colors) {
            at += sprintf(at, "%u 7 255 ", (unsigned)(face % 256));
        }
        at += sprintf(at, "%u", sides_of(c, face));
        for (unsigned side = 0; side < sides_of(c, face); side++) {
            at += sprintf(at, " %u", face == wrong_face && side == 0 ? VERTICES : (unsigned)vertex_of(face, side));
        }
        if (!ply && c->colors) {
            at += sprintf(at, " %u 7 255", (unsigned)(face % 256));
        }
        *at++ = '\n';
        *wrong_line = face == wrong_face ? line : *wrong_line;
    }
    *size = (size_t)(at - text);
    return text;
}

static void expect_mesh(const mt_mesh *mesh, const sides_case *c)
{
    const mt_attribute *colors = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE);
    assert_int_equal(mesh->vertex_count, VERTICES);
    assert_int_equal(mesh->face_count, FACES);
    assert_int_equal(colors != NULL, c->colors);
    assert_true(mt_mesh_position(mesh, VERTICES - 1).x == VERTICES - 1 + 0.25);
    for (mt_index face = 0; face < FACES; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        assert_int_equal(mt_mesh_face_sides(mesh, face), sides_of(c, face));
        for (unsigned side = 0; side < sides_of(c, face); side++) {
            assert_int_equal(mesh->corner_vertices[begin + side], vertex_of(face, side));
        }
        if (colors) {
            mt_index value = mt_attribute_value_index(colors, face);
            double scale = colors->type == MT_U8 ? 1.0 : 255.0; /* PLY keeps bytes, OFF shares */
            assert_true(mt_attribute_get(colors, value, 0) == (double)(face % 256) / scale);
            assert_true(mt_attribute_get(colors, value, 1) == 7.0 / scale);
        }
    }
}

static void test_every_case(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int ply = 0; ply <= 1; ply++) {
            size_t size, line = 0;
            char *text = text_of(&cases[i], ply, MT_NONE, &size, &line);
            for (unsigned threads = 1; threads <= 2; threads++) {
                mt_context *context = test_context_with_threads(threads);
                mt_mesh *mesh = text_read_bytes(context, ply ? "a.ply" : "a.off", text, size);
                expect_mesh(mesh, &cases[i]);
                mt_mesh_destroy(context, mesh);
                test_context_end(context);
            }
            free(text);
        }
    }
}

/* Before, at and after the face that differs. */
static void test_place_of_a_mistake(void **state)
{
    (void)state;
    const sides_case c = {3, 3, 4, FACES / 2, false};
    const mt_index wrong[] = {0, FACES / 2 - 1, FACES / 2, FACES / 2 + 1, FACES - 1};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        for (int ply = 0; ply <= 1; ply++) {
            size_t size, line = 0;
            char *text = text_of(&c, ply, wrong[i], &size, &line), expected[64];
            mt_context *context = test_context_with_threads(2);
            snprintf(expected, sizeof expected, "%s:%zu:", ply ? "a.ply" : "a.off", line);
            const char *message = text_refuse(context, ply ? "a.ply" : "a.off", text, size, MT_ERROR_SYNTAX);
            assert_memory_equal(message, expected, strlen(expected));
            assert_non_null(strstr(message, "3000"));
            test_context_end(context);
            free(text);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_case),
        cmocka_unit_test(test_place_of_a_mistake),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
