/* Smooth where smooth, creased where creased. */
#include "tests/support/picture.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include "lib/render/corner_normals.h"

#include <math.h>
#include <stdlib.h>

typedef struct shaded {
    mt_context *context;
    mt_model model;
    mt_corner_normals normals;
} shaded;

static void shade(shaded *s, mt_context *context, const mt_mesh *mesh, double crease)
{
    s->context = context;
    assert_int_equal(mt_model_init(context, mesh, &s->model), MT_OK);
    assert_int_equal(mt_corner_normals_init(context, &s->model, &s->normals), MT_OK);
    assert_int_equal(mt_corner_normals_build(context, &s->model, crease, &s->normals), MT_OK);
}

static void shade_end(shaded *s)
{
    mt_corner_normals_release(s->context, &s->normals);
    mt_model_release(s->context, &s->model);
}

static mt_vec3 unit(mt_vec3 v)
{
    return mt_vec3_scale(v, 1.0 / mt_vec3_length(v));
}

/* The definition: the area-weighted mean over the faces at the same place within the angle, side ignored. */
static mt_vec3 by_definition(const shaded *s, mt_index face, mt_index corner, double crease)
{
    const mt_mesh *mesh = s->model.mesh;
    mt_vec3 place = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
    mt_vec3 own = mt_face_normal(&s->normals, face), sum = mt_vec3_make(0, 0, 0);
    double minimum = cos(crease * acos(-1.0) / 180.0) - 1e-6;
    for (mt_index f = 0; f < mesh->face_count; f++) {
        for (mt_index c = mt_mesh_face_begin(mesh, f); c < mt_mesh_face_end(mesh, f); c++) {
            mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]), n = mt_face_normal(&s->normals, f);
            bool here = p.x == place.x && p.y == place.y && p.z == place.z;
            double dot = mt_vec3_dot(own, n), lengths = mt_vec3_length(own) * mt_vec3_length(n);
            if (here && fabs(dot) >= minimum * lengths) {
                sum = mt_vec3_add(sum, dot < 0 ? mt_vec3_scale(n, -1) : n);
            }
        }
    }
    return unit(sum);
}

static void assert_definition(const mt_mesh *mesh, mt_context *context, double crease)
{
    shaded s;
    shade(&s, context, mesh, crease);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            mt_vec3 n = mt_corner_normal(&s.normals, face, corner), m = by_definition(&s, face, corner, crease);
            assert_true(fabs(fabs(mt_vec3_dot(n, m)) - 1) < 1e-6);
        }
    }
    shade_end(&s);
}

/* A sheet of random heights: corners of every kind. */
static mt_mesh *crumpled(mt_context *context, test_random *random, double height, bool turned)
{
    enum { SIDE = 9 };
    double positions[3 * SIDE * SIDE];
    mt_index faces[4 * 2 * (SIDE - 1) * (SIDE - 1)], *face = faces;
    for (mt_index i = 0; i < SIDE * SIDE; i++) {
        positions[3 * i] = i % SIDE;
        positions[3 * i + 1] = height * test_random_unit(random);
        positions[3 * i + 2] = (double)(i / SIDE);
    }
    for (mt_index i = 0; i < SIDE * SIDE; i++) {
        if (i % SIDE == SIDE - 1 || i / SIDE == SIDE - 1) {
            continue;
        }
        mt_index flip = turned ? (mt_index)test_random_below(random, 2) : 0;
        *face++ = 3, *face++ = i, *face++ = flip ? i + 1 : i + SIDE, *face++ = flip ? i + SIDE : i + 1;
        *face++ = 3, *face++ = i + 1, *face++ = i + SIDE, *face++ = i + SIDE + 1;
    }
    return test_mesh(context, SIDE * SIDE, positions, 2 * (SIDE - 1) * (SIDE - 1), faces);
}

static void corners_follow_the_definition(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {2};
    for (int round = 0; round < 12; round++) {
        mt_mesh *mesh = crumpled(context, &random, 0.3 * (round % 6), round >= 6);
        assert_definition(mesh, context, 10.0 + 10.0 * (round % 4));
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Every face with vertices of its own: seams everywhere, and nothing of it shows. */
static void seams_are_closed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 16, 8, 3.0);
    double positions[3 * 3 * 2 * 16 * 7];
    mt_index faces[4 * 2 * 16 * 7];
    for (mt_index corner = 0; corner < ball->corner_count; corner++) {
        mt_vec3 p = mt_mesh_position(ball, ball->corner_vertices[corner]);
        positions[3 * corner] = p.x == 0 ? -p.x : p.x; /* -0 is the same place */
        positions[3 * corner + 1] = p.y, positions[3 * corner + 2] = p.z;
        faces[4 * (corner / 3)] = 3;
        faces[4 * (corner / 3) + 1 + corner % 3] = corner;
    }
    mt_mesh *soup = test_mesh(context, ball->corner_count, positions, ball->face_count, faces);
    shaded whole, cut;
    shade(&whole, context, ball, 60);
    shade(&cut, context, soup, 60);
    for (mt_index corner = 0; corner < ball->corner_count; corner++) {
        mt_vec3 a = mt_corner_normal(&whole.normals, corner / 3, corner);
        mt_vec3 b = mt_corner_normal(&cut.normals, corner / 3, corner);
        assert_true(mt_vec3_length(mt_vec3_subtract(a, b)) < 1e-6);
    }
    shade_end(&whole);
    shade_end(&cut);
    assert_definition(soup, context, 25);
    mt_mesh_destroy(context, soup);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

/* A prism of n sides meets at 360/n degrees: more than the angle is an edge, exactly the angle is not. */
static void the_angle_itself_is_smooth(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (mt_index n = 3; n <= 40; n++) {
        double positions[3 * 80];
        mt_index faces[5 * 40];
        for (mt_index i = 0; i < 2 * n; i++) {
            double turn = 2 * acos(-1.0) * (i % n) / n;
            positions[3 * i] = cos(turn), positions[3 * i + 1] = i / n, positions[3 * i + 2] = sin(turn);
        }
        for (mt_index i = 0; i < n; i++) {
            mt_index j = (i + 1) % n;
            faces[5 * i] = 4;
            faces[5 * i + 1] = i, faces[5 * i + 2] = n + i, faces[5 * i + 3] = n + j, faces[5 * i + 4] = j;
        }
        mt_mesh *mesh = test_mesh(context, 2 * n, positions, n, faces);
        for (int below = 0; below < 2; below++) {
            shaded s;
            shade(&s, context, mesh, 360.0 / n - (below ? 0.01 : 0.0));
            mt_vec3 own = unit(mt_face_normal(&s.normals, 0)), at = mt_corner_normal(&s.normals, 0, 0);
            double cosine = fabs(mt_vec3_dot(own, at)), expected = below ? 1.0 : cos(acos(-1.0) / n);
            assert_true(n == 3 || n == 4 || fabs(cosine - expected) < 1e-6);
            shade_end(&s);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void a_cube_keeps_its_edges(void **state)
{
    (void)state;
    static const double positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
    static const mt_index faces[] = {4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                     4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7};
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 8, positions, 6, faces);
    shaded s;
    shade(&s, context, mesh, 42);
    for (mt_index corner = 0; corner < 24; corner++) {
        mt_vec3 own = unit(mt_face_normal(&s.normals, corner / 4)),
                at = mt_corner_normal(&s.normals, corner / 4, corner);
        assert_true(mt_vec3_length(mt_vec3_subtract(own, at)) < 1e-7);
    }
    shade_end(&s);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A cone of very many faces: linear time, and a finite answer at the tip. */
static void a_vertex_of_very_many_faces_is_cheap(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 300000, true);
    mt_mesh_set_position(mesh, 0, mt_vec3_make(0, 0, 10));
    shaded s;
    shade(&s, context, mesh, 42);
    for (mt_index face = 0; face < mesh->face_count; face += 997) {
        for (mt_index side = 0; side < 3; side++) {
            mt_vec3 n = mt_corner_normal(&s.normals, face, 3 * face + side);
            double length = mt_vec3_length(n);
            assert_true(fabs(length - 1) < 1e-6 || length == 0);
        }
    }
    shade_end(&s);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void normals_of_the_mesh_are_used_when_finite(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_ball(context, 8, 4, 1.0);
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = MT_F32,
                                  .component_count = 3,
                                  .value_count = mesh->vertex_count};
    mt_attribute *given = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &given), MT_OK);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        for (uint32_t axis = 0; axis < 3; axis++) {
            mt_attribute_set(given, v, axis, axis == 1 ? 5.0 : 0.0);
        }
    }
    shaded s;
    shade(&s, context, mesh, 42);
    assert_true(mt_corner_normal(&s.normals, 3, 10).y == 1);
    shade_end(&s);
    mt_attribute_set(given, 2, 1, (double)NAN);
    shade(&s, context, mesh, 42);
    assert_null(s.normals.given);
    shade_end(&s);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void facing_tells_sheets_from_balls(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 64, 32, 1.0);
    shaded s;
    shade(&s, context, ball, 42);
    assert_true(fabs(mt_corner_normals_facing(&s.normals, mt_vec3_make(0, 0, 1)) - 0.5) < 0.01);
    shade_end(&s);
    test_random random = {1};
    mt_mesh *sheet = crumpled(context, &random, 0, false);
    shade(&s, context, sheet, 42);
    assert_true(mt_corner_normals_facing(&s.normals, mt_vec3_make(0, 1, 0)) == 1);
    assert_true(mt_corner_normals_facing(&s.normals, mt_vec3_make(1, 0, 0)) == 0);
    shade_end(&s);
    mt_mesh_destroy(context, sheet);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(corners_follow_the_definition),
        cmocka_unit_test(seams_are_closed),
        cmocka_unit_test(the_angle_itself_is_smooth),
        cmocka_unit_test(a_cube_keeps_its_edges),
        cmocka_unit_test(a_vertex_of_very_many_faces_is_cheap),
        cmocka_unit_test(normals_of_the_mesh_are_used_when_finite),
        cmocka_unit_test(facing_tells_sheets_from_balls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
