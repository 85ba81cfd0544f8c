/* Frames, projections of known points, and framing. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include "lib/render/framing.h"

#include <math.h>

static void assert_frame(const mt_camera *camera)
{
    mt_vec3 r = camera->right, u = camera->up, f = camera->forward;
    assert_true(fabs(mt_vec3_length(r) - 1) < 1e-14);
    assert_true(fabs(mt_vec3_length(u) - 1) < 1e-14);
    assert_true(fabs(mt_vec3_length(f) - 1) < 1e-14);
    assert_true(fabs(mt_vec3_dot(r, u)) < 1e-14);
    assert_true(fabs(mt_vec3_dot(r, f)) < 1e-14);
    assert_true(fabs(mt_vec3_dot(u, f)) < 1e-14);
    mt_vec3 back = mt_vec3_cross(r, u); /* right-handed: the third axis points at the viewer */
    assert_true(fabs(mt_vec3_dot(back, f) + 1) < 1e-14);
}

static void random_frames_are_orthonormal(void **state)
{
    (void)state;
    test_random random = {1};
    for (int i = 0; i < 1000; i++) {
        mt_vec3 v[2];
        for (int k = 0; k < 2; k++) {
            v[k] = mt_vec3_make(test_random_unit(&random) - 0.5, test_random_unit(&random) - 0.5,
                                test_random_unit(&random) - 0.5);
        }
        mt_camera camera = {.width = 1};
        mt_camera_frame(&camera, mt_vec3_scale(v[0], 1e100), mt_vec3_scale(v[1], 1e-100));
        assert_frame(&camera);
        assert_true(mt_vec3_dot(camera.up, v[1]) > 0);
        assert_true(mt_vec3_dot(camera.forward, v[0]) < 0);
    }
}

static void up_parallel_to_the_view_has_an_answer(void **state)
{
    (void)state;
    static const double ups[][3] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 0}, {1e-30, 1, 0}, {0, 5e-324, 0}};
    for (size_t i = 0; i < sizeof ups / sizeof *ups; i++) {
        mt_camera camera = {.width = 1};
        mt_camera_frame(&camera, mt_vec3_make(0, 1, 0), mt_vec3_make(ups[i][0], ups[i][1], ups[i][2]));
        assert_frame(&camera);
        assert_true(camera.forward.y == -1);
    }
}

static void known_points_fall_where_they_must(void **state)
{
    (void)state;
    mt_camera camera = {.width = 200, .height = 100, .half_width = 1.0, .half_height = 0.5};
    mt_camera_frame(&camera, mt_vec3_make(0, 0, 1), mt_vec3_make(0, 1, 0));
    camera.eye = mt_vec3_make(0, 0, 4);
    static const double rows[][6] = {
        {0, 0, 0, 100, 50, 0.25}, /* straight ahead */
        {4, 0, 0, 200, 50, 0.25}, /* the right side at distance 4 */
        {-2, 0, 2, 0, 50, 0.5},   /* the left side at distance 2 */
        {0, 1, 2, 100, 0, 0.5},   /* the top */
        {0, -1, 2, 100, 100, 0.5}, {1, 0.5, 2, 150, 25, 0.5},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_screen_point s = mt_camera_project(&camera, mt_vec3_make(rows[i][0], rows[i][1], rows[i][2]));
        assert_true(fabs(s.x - rows[i][3]) < 1e-12);
        assert_true(fabs(s.y - rows[i][4]) < 1e-12);
        assert_true(fabs(s.depth - rows[i][5]) < 1e-15);
    }
    assert_true(mt_camera_project(&camera, mt_vec3_make(0, 0, 5)).depth < 0);
    mt_vec3 toward = mt_camera_toward_eye(&camera, 200, 50);
    assert_true(fabs(toward.x + sqrt(0.5)) < 1e-15 && fabs(toward.z - sqrt(0.5)) < 1e-15);
}

/* Every drawn vertex lies inside, and one of the sides is reached up to the margin. */
static void the_mesh_fills_the_frame(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{100, 100}, {1000, 10}, {10, 1000}, {65535, 1}, {1, 1}};
    mt_context *context = test_context();
    test_random random = {6};
    for (int round = 0; round < 200; round++) {
        double positions[60];
        mt_index faces[20 * 4];
        for (int i = 0; i < 60; i++) {
            double flat = i % 3 == round % 4 ? 1e-3 : 1.0;
            positions[i] = 1000.0 + flat * test_random_unit(&random);
        }
        for (mt_index i = 0; i < 20; i++) {
            faces[4 * i] = 3;
            faces[4 * i + 1] = i, faces[4 * i + 2] = (i + 1) % 20, faces[4 * i + 3] = (i + 7) % 20;
        }
        mt_mesh *mesh = test_mesh(context, 20, positions, 20, faces);
        mt_model model;
        assert_int_equal(mt_model_init(context, mesh, &model), MT_OK);
        mt_camera camera = {.width = sizes[round % 5][0], .height = sizes[round % 5][1]};
        double shorter = fmin(camera.width, camera.height);
        camera.half_width = 0.25 * camera.width / shorter;
        camera.half_height = 0.25 * camera.height / shorter;
        mt_camera_frame(&camera, mt_vec3_make(0.3, 0.4, 0.8), mt_vec3_make(0, 1, 0));
        assert_int_equal(mt_camera_fit(context, &camera, &model, &(mt_framing){0}), MT_OK);
        double reach = 0;
        for (mt_index vertex = 0; vertex < 20; vertex++) {
            mt_screen_point s = mt_camera_project(&camera, mt_model_position(&model, vertex));
            assert_true(s.depth > 0);
            reach = fmax(reach, fabs(2 * s.x / camera.width - 1));
            reach = fmax(reach, fabs(2 * s.y / camera.height - 1));
        }
        assert_true(reach < 0.901 && reach > 0.5);
        mt_model_release(context, &model);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_frames_are_orthonormal),
        cmocka_unit_test(up_parallel_to_the_view_has_an_answer),
        cmocka_unit_test(known_points_fall_where_they_must),
        cmocka_unit_test(the_mesh_fills_the_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
