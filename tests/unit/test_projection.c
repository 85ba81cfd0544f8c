/* Parallel cameras, rays, framing and named views against closed forms. */
#include "tests/support/fixture.h"
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include "lib/render/framing.h"
#include "lib/render/view.h"

#include <math.h>

static const mt_projection projections[] = {MT_PROJECTION_PERSPECTIVE, MT_PROJECTION_ORTHOGRAPHIC,
                                            MT_PROJECTION_CABINET};

static void parallel_points_fall_where_they_must(void **state)
{
    (void)state;
    mt_camera camera = {.projection = MT_PROJECTION_CAVALIER, .width = 200, .height = 100};
    camera.half_width = 4, camera.half_height = 2;
    mt_camera_frame(&camera, mt_vec3_make(0, 0, 1), mt_vec3_make(0, 1, 0));
    camera.eye = mt_vec3_make(0, 0, 1);
    static const double rows[][6] = {
        /* point, shear, place */
        {0, 0, 1, 0, 100, 50},    {4, 2, 1, 0, 200, 0},  {4, 2, -3, 0, 200, 0},   {0, 0, 1, 0.5, 100, 50},
        {0, 0, -1, 0.5, 125, 25}, {0, 0, 0, 1, 125, 25}, {-1, -1, 0, 1, 100, 50},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        camera.shear_x = camera.shear_y = rows[i][3];
        mt_screen_point s = mt_camera_project(&camera, mt_vec3_make(rows[i][0], rows[i][1], rows[i][2]));
        assert_true(fabs(s.x - rows[i][4]) < 1e-12 && fabs(s.y - rows[i][5]) < 1e-12);
        assert_true(fabs(mt_camera_distance(&camera, s.depth) - (1 - rows[i][2])) < 1e-12);
    }
}

static mt_vec3 random_vector(test_random *random)
{
    return mt_vec3_make(test_random_unit(random) - 0.5, test_random_unit(random) - 0.5, test_random_unit(random) - 0.5);
}

/* The ray through the place of a point meets the point, at its distance along the view. */
static void rays_undo_the_projection(void **state)
{
    (void)state;
    test_random random = {3};
    for (int i = 0; i < 3000; i++) {
        mt_camera camera = {.projection = projections[i % 3], .width = 640, .height = 480};
        camera.half_width = 0.1 + test_random_unit(&random), camera.half_height = 0.1 + test_random_unit(&random);
        camera.shear_x = camera.shear_y = i % 3 == 2 ? 0.35 : 0;
        camera.eye = random_vector(&random);
        mt_camera_frame(&camera, random_vector(&random), random_vector(&random));
        mt_vec3 p = mt_vec3_add(camera.eye, random_vector(&random));
        p = mt_vec3_add(p, mt_vec3_scale(camera.forward, 1.5));
        mt_screen_point s = mt_camera_project(&camera, p);
        mt_camera_ray ray = mt_camera_ray_at(&camera, s.x, s.y);
        double t = mt_vec3_dot(mt_vec3_subtract(p, camera.eye), camera.forward);
        mt_vec3 q = mt_vec3_add(ray.origin, mt_vec3_scale(ray.direction, t));
        assert_true(mt_vec3_length(mt_vec3_subtract(p, q)) < 1e-13);
        assert_true(fabs(mt_camera_distance(&camera, s.depth) - t) < 1e-13);
        assert_true(fabs(mt_camera_depth(&camera, t) - s.depth) < 1e-13);
        assert_true(fabs(mt_vec3_length(mt_camera_toward_eye(&camera, s.x, s.y)) - 1) < 1e-14);
    }
}

/* How far from the middle the drawn vertices reach, in halves of the picture; fails when one is not in front. */
static double reach_of(const mt_camera *camera, const mt_model *model)
{
    double reach = 0;
    for (mt_index vertex = 0; vertex < model->mesh->vertex_count; vertex++) {
        mt_screen_point s = mt_camera_project(camera, mt_model_position(model, vertex));
        assert_true(s.depth > 0);
        reach = fmax(reach, fmax(fabs(2 * s.x / camera->width - 1), fabs(2 * s.y / camera->height - 1)));
    }
    return reach;
}

static void every_framing_holds(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{100, 100}, {1000, 10}, {10, 1000}, {65535, 1}, {1, 1}};
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 20, 10, 3.0);
    mt_model model;
    assert_int_equal(mt_model_init(context, ball, &model), MT_OK);
    for (int i = 0; i < 15; i++) {
        const mt_framing framings[] = {{0},
                                       {.has_target = true, .target = {0.3, 0.1, 0}},
                                       {.has_target = true, .fov_degrees = 1e-3},
                                       {.fov_degrees = 150},
                                       {.has_eye = true, .has_target = true, .eye = {3, 2, 4}}};
        for (size_t k = 0; k < sizeof framings / sizeof *framings; k++) {
            mt_camera camera = {.projection = projections[i % 3], .width = sizes[i / 3][0], .height = sizes[i / 3][1]};
            camera.shear_x = camera.shear_y = i % 3 == 2 ? 0.35 : 0;
            mt_camera_frame(&camera, mt_vec3_make(3, 2, 4), mt_vec3_make(0, 1, 0));
            assert_int_equal(mt_camera_fit(context, &camera, &model, &framings[k]), MT_OK);
            double reach = reach_of(&camera, &model);
            assert_true(reach < 0.901 && (reach > 0.5 || framings[k].fov_degrees > 100));
            if (framings[k].has_target) {
                mt_screen_point middle = mt_camera_project(&camera, framings[k].target);
                assert_true(fabs(middle.x - 0.5 * camera.width) < 1e-6 * camera.width);
                assert_true(fabs(middle.y - 0.5 * camera.height) < 1e-6 * camera.height);
            }
        }
    }
    /* From inside: 75 degrees, or what was asked for. */
    for (int given = 0; given < 2; given++) {
        mt_camera camera = {.width = 100, .height = 100};
        mt_camera_frame(&camera, mt_vec3_make(0, 0, 1), mt_vec3_make(0, 1, 0));
        mt_framing framing = {.has_eye = true, .has_target = true, .fov_degrees = given ? 90 : 0};
        assert_int_equal(mt_camera_fit(context, &camera, &model, &framing), MT_OK);
        assert_true(fabs(camera.half_width - (given ? 1.0 : 0.76732698797896034)) < 1e-15);
    }
    mt_model_release(context, &model);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static void assert_vector(mt_vec3 v, double x, double y, double z)
{
    assert_true(mt_vec3_length(mt_vec3_subtract(v, mt_vec3_make(x, y, z))) < 1e-14);
}

static void named_views_look_from_their_sides(void **state)
{
    (void)state;
    static const double rows[][6] = {{0, 0, 1, 0, 1, 0}, {0, 0, -1, 0, 1, 0}, {-1, 0, 0, 0, 1, 0},
                                     {1, 0, 0, 0, 1, 0}, {0, 1, 0, 0, 0, -1}, {0, -1, 0, 0, 0, 1}};
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 8, 4, 1.0);
    mt_model model;
    mt_corner_normals normals;
    assert_int_equal(mt_model_init(context, ball, &model), MT_OK);
    assert_int_equal(mt_corner_normals_init(context, &model, &normals), MT_OK);
    for (int i = 0; i < 6; i++) {
        const double *r = rows[i];
        mt_view view = mt_view_make(&normals, (mt_view_name)(MT_VIEW_FRONT + i), mt_vec3_make(0, 7, 0));
        assert_vector(view.toward_eye, r[0], r[1], r[2]);
        assert_vector(view.up, r[3], r[4], r[5]);
        view = mt_view_make(&normals, (mt_view_name)(MT_VIEW_FRONT + i), mt_vec3_make(0, 0, 1));
        assert_vector(view.toward_eye, r[0], -r[2], r[1]); /* Z up: the front is -Y */
        assert_vector(view.up, r[3], -r[5], r[4]);
    }
    mt_view iso = mt_view_make(&normals, MT_VIEW_ISO, mt_vec3_make(0, 0, 0));
    assert_vector(iso.toward_eye, sqrt(1.0 / 3), sqrt(1.0 / 3), sqrt(1.0 / 3));
    assert_vector(mt_turned(mt_vec3_make(0, 0, 1), mt_vec3_make(0, 1, 0), 90), 1, 0, 0);
    mt_corner_normals_release(context, &normals);
    mt_model_release(context, &model);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallel_points_fall_where_they_must),
        cmocka_unit_test(rays_undo_the_projection),
        cmocka_unit_test(every_framing_holds),
        cmocka_unit_test(named_views_look_from_their_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
