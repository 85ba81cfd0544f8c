/* Pictures of scenes against closed forms that share no code with the ray tracer: where shapes are, Lambert's law and
 * the highlight, shadows of point lights, mirrors, and lights that add up. */
#include "tests/support/picture.h"
#include "tests/support/scene.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>

#include <math.h>
#include <string.h>

enum { SIZE = 64 };

static mt_vec3 pixel_of(const mt_image *image, uint32_t x, uint32_t y)
{
    const float *p = mt_image_pixel(image, x, y);
    return mt_vec3_make((double)p[0], (double)p[1], (double)p[2]);
}

/* The nearer root of the sphere of radius 1 around the origin; negative: none. */
static double unit_sphere_root(const mt_ray *ray)
{
    double a = mt_vec3_dot(ray->direction, ray->direction), b = mt_vec3_dot(ray->direction, ray->origin);
    double d = b * b - a * (mt_vec3_dot(ray->origin, ray->origin) - 1);
    return d < 0 ? -1 : (-b - sqrt(d)) / a;
}

static void a_lit_sphere_is_lambert_and_blinn(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_scene s;
    test_scene_init(&s, SIZE);
    s.scene.ambient = mt_vec3_make(0.125, 0.125, 0.125);
    s.materials[0].color = mt_vec3_make(0.5, 0.25, 1);
    s.materials[0].specular = mt_vec3_make(0.75, 0.5, 0.25);
    s.materials[0].exponent = 12.5;
    s.materials[0].diffuse = 0.875;
    mt_vec3 toward = {2, 3, 6}; /* length 7 */
    test_scene_light(&s, MT_LIGHT_DIRECTIONAL, toward, true)->color = mt_vec3_make(2, 2, 2);
    test_scene_sphere(&s, 0, mt_vec3_make(0, 0, 0), 1);
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    double worst = 0;
    int seen = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_ray ray = test_scene_ray(SIZE, x, y);
            double t = unit_sphere_root(&ray), expected[3] = {0, 0, 0};
            if (t > 0) {
                mt_vec3 n = mt_ray_at(&ray, t), l = mt_vec3_scale(toward, 1.0 / 7);
                mt_vec3 v = mt_vec3_scale(ray.direction, -1 / mt_vec3_length(ray.direction)), h = mt_vec3_add(l, v);
                double cosine = fmax(0, mt_vec3_dot(n, l));
                double along = fmax(0, mt_vec3_dot(n, h) / mt_vec3_length(h));
                double gloss = cosine > 0 ? 2 * pow(along, 12.5) : 0, dull = 0.125 + 0.875 * 2 * cosine;
                expected[0] = 0.5 * dull + 0.75 * gloss;
                expected[1] = 0.25 * dull + 0.5 * gloss;
                expected[2] = 1.0 * dull + 0.25 * gloss;
                seen++;
            }
            const float *got = mt_image_pixel(image, x, y);
            for (int i = 0; i < 3; i++) {
                worst = fmax(worst, fabs((double)got[i] - expected[i]));
            }
        }
    }
    assert_true(seen > 300 && worst < 1e-6);
    mt_image_destroy(context, image);
    test_context_end(context);
}

/* A ball over a floor: the shadow of a point light is the cone that the ball cuts out. */
static void a_point_light_s_shadow_has_the_cone_s_edge(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_scene s;
    test_scene_init(&s, SIZE);
    s.scene.camera.eye = mt_vec3_make(0, 5, 0.001);
    s.scene.camera.target = mt_vec3_make(0, -1, 0);
    mt_vec3 light = {0.5, 3, 0.25}, center = {0, 0.5, 0};
    const double radius = 0.4;
    test_scene_light(&s, MT_LIGHT_POINT, light, true);
    test_scene_plane(&s, 0, mt_vec3_make(0, -1, 0), mt_vec3_make(0, 1, 0));
    test_scene_sphere(&s, 0, center, radius);
    /* Beyond the light: its ray ends before. */
    test_scene_sphere(&s, 0, mt_vec3_make(0.6, 3.6, 0.3), 0.35);
    mt_scene_report report;
    mt_image *image = test_scene_draw(context, &s, NULL, &report);
    int shadowed = 0, wrong = 0, floor_pixels = 0;
    for (double x = -1.4; x <= 1.4; x += 0.02) {
        for (double z = -1.4; z <= 1.4; z += 0.02) {
            mt_vec3 p = {x, -1, z}, to_light = mt_vec3_subtract(light, p), to_center = mt_vec3_subtract(center, p);
            double length = mt_vec3_length(to_light);
            mt_vec3 unit = mt_vec3_scale(to_light, 1 / length);
            double aside = mt_vec3_length(mt_vec3_cross(unit, to_center));
            bool dark = aside < radius;
            /* The camera looks straight down: where the point falls in the picture. */
            double tangent = tan(20 * acos(-1.0) / 180), down = 6;
            double px = (x / (down * tangent) + 1) * SIZE / 2, py = (z / (down * tangent) + 1) * SIZE / 2;
            mt_vec3 seen = pixel_of(image, (uint32_t)px, (uint32_t)py);
            mt_vec3 eye = {0, 5, 0}, view = mt_vec3_subtract(p, eye), to_ball = mt_vec3_subtract(center, eye);
            double past = mt_vec3_length(mt_vec3_cross(mt_vec3_scale(view, 1 / mt_vec3_length(view)), to_ball));
            mt_vec3 to_upper = mt_vec3_subtract(mt_vec3_make(0.6, 3.6, 0.3), eye);
            double upper = mt_vec3_length(mt_vec3_cross(mt_vec3_scale(view, 1 / mt_vec3_length(view)), to_upper));
            if (past < radius + 0.1 || upper < 0.45 || fabs(aside - radius) < 0.08) {
                continue; /* behind a ball, or at the edge itself */
            }
            double cosine = 4 / length;
            floor_pixels++;
            shadowed += dark;
            wrong += fabs(seen.x - (dark ? 0 : cosine)) > 0.02;
        }
    }
    assert_true(shadowed > 200 && floor_pixels > 3000);
    assert_int_equal(wrong, 0);
    assert_true(report.shadow_rays > 0 && report.reflected_rays == 0);
    mt_image_destroy(context, image);
    test_context_end(context);
}

/* A mirror in the plane z = 0 shows, at each pixel, what stands mirrored behind it. */
static void a_mirror_s_picture_is_the_mirrored_scene(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *teapot = NULL;
    assert_int_equal(mt_generate(context, "teapot", NULL, &teapot), MT_OK);
    mt_image *images[2];
    for (int i = 0; i < 2; i++) {
        test_scene s;
        test_scene_init(&s, SIZE);
        s.scene.ambient = mt_vec3_make(0.2, 0.2, 0.2);
        double side = i == 0 ? 1 : -1;
        /* Behind the camera in the first scene, so that it is seen in the mirror alone. */
        mt_transform place = mt_transform_scaling(0.4);
        place.linear[2][2] *= side;
        place.translation = mt_vec3_make(0.2, 0, 6.5 * side);
        test_scene_mesh(&s, 0, teapot, place);
        test_scene_light(&s, MT_LIGHT_DIRECTIONAL, mt_vec3_make(1, 2, 1.5 * side), true);
        if (i == 0) {
            mt_index mirror;
            mt_material *m = test_scene_material(&s, &mirror);
            m->color = mt_vec3_make(0, 0, 0);
            m->mirror = mt_vec3_make(1, 1, 1);
            test_scene_plane(&s, mirror, mt_vec3_make(0, 0, 0), mt_vec3_make(0, 0, 1));
        }
        images[i] = test_scene_draw(context, &s, NULL, NULL);
    }
    double mean = 0, sum = 0;
    test_picture_difference(images[0], images[1], &mean);
    int differ = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_vec3 a = pixel_of(images[0], x, y), b = pixel_of(images[1], x, y);
            differ += fabs(a.x - b.x) > 1e-5;
            sum += b.x;
        }
    }
    print_message("mirror: %d differ, sum %g\n", differ, sum);
    assert_true(sum > 20 && differ <= 2); /* a ray that grazes an edge may fall on either side */
    for (int i = 0; i < 2; i++) {
        mt_image_destroy(context, images[i]);
    }
    mt_mesh_destroy(context, teapot);
    test_context_end(context);
}

static void fill_room(test_scene *s, const mt_mesh *mesh)
{
    mt_index glossy;
    test_scene_init(s, SIZE);
    mt_material *m = test_scene_material(s, &glossy);
    m->specular = mt_vec3_make(0.5, 0.5, 0.5);
    m->mirror = mt_vec3_make(0.25, 0.25, 0.25);
    test_scene_plane(s, glossy, mt_vec3_make(0, -1, 0), mt_vec3_make(0, 1, 0));
    test_scene_sphere(s, glossy, mt_vec3_make(-0.8, 0, 0), 0.7);
    mt_transform place = mt_transform_scaling(0.5);
    place.translation = mt_vec3_make(0.9, -0.5, 0);
    test_scene_mesh(s, glossy, mesh, place);
}

/* Light of all lamps and surroundings is the sum of the light of each. */
static void lights_add_up(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, "torus", NULL, &mesh), MT_OK);
    double sum[SIZE * SIZE * 3] = {0};
    mt_image *all = NULL;
    for (int alone = -1; alone < 4; alone++) {
        test_scene s;
        fill_room(&s, mesh);
        if (alone < 0 || alone == 3) {
            s.scene.ambient = mt_vec3_make(0.1, 0.15, 0.2);
            s.scene.background.color = mt_vec3_make(0.3, 0.2, 0.1);
        }
        for (int i = 0; i < 3; i++) {
            if (alone < 0 || alone == i) {
                mt_vec3 place = {2.0 * i - 2, 3, 1.0 + i};
                mt_scene_light *light =
                    test_scene_light(&s, i == 1 ? MT_LIGHT_DIRECTIONAL : MT_LIGHT_POINT, place, i != 2);
                light->color = mt_vec3_make(0.5 + i, 1, 1.5 - 0.5 * i);
                light->fade = i == 0 ? 3 : 0;
            }
        }
        mt_image *image = test_scene_draw(context, &s, NULL, NULL);
        for (int i = 0; alone >= 0 && i < SIZE * SIZE * 3; i++) {
            sum[i] += (double)image->pixels[i];
        }
        if (alone < 0) {
            all = image;
        } else {
            mt_image_destroy(context, image);
        }
    }
    double worst = 0;
    for (int i = 0; i < SIZE * SIZE * 3; i++) {
        worst = fmax(worst, fabs(sum[i] - (double)all->pixels[i]));
    }
    assert_true(worst < 2e-6); /* of floats around 4 */
    mt_image_destroy(context, all);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Between two mirrors that reflect k each, of ambient light 1, the eye sees 1 + k + k^2 ...: what a depth limit or a
 * cutoff leaves out is known. */
static void depth_and_cutoff_leave_out_what_they_say(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double k = 0.5;
    for (int i = 0; i < 8; i++) {
        test_scene s;
        test_scene_init(&s, 1);
        s.scene.ambient = mt_vec3_make(1, 1, 1);
        s.materials[0].mirror = mt_vec3_make(k, k, k);
        test_scene_plane(&s, 0, mt_vec3_make(0, 0, -1), mt_vec3_make(0, 0, 1));
        test_scene_plane(&s, 0, mt_vec3_make(0, 0, 7), mt_vec3_make(0, 0, -1));
        s.scene.depth_limit = i < 4 ? 1 + 3 * (unsigned)i : 64;
        s.scene.cutoff = i < 4 ? -1 : ldexp(1, -2 * i) * 1.5;
        mt_scene_report report;
        mt_image *image = test_scene_draw(context, &s, NULL, &report);
        double got = (double)image->pixels[0], whole = 1 / (1 - k);
        if (i < 4) {
            assert_true(fabs(got - whole * (1 - pow(k, s.scene.depth_limit + 1))) < 1e-6);
            assert_int_equal(report.reflected_rays, s.scene.depth_limit);
        } else {
            assert_true(whole - got > 0 && whole - got <= s.scene.cutoff / (1 - k));
            assert_int_equal(report.reflected_rays, 2 * i - 1);
        }
        mt_image_destroy(context, image);
    }
    test_context_end(context);
}

/* Instances, moved, turned, scaled, mirrored, are what transformed copies are, but for pixels at edges. */
static void instances_are_transformed_copies(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL, *copies[3];
    assert_int_equal(mt_generate(context, "icosphere", NULL, &mesh), MT_OK);
    mt_transform places[3] = {mt_transform_rotation(mt_vec3_make(1, 2, 3), 77), mt_transform_scaling(0.3),
                              mt_transform_scaling(0.5)};
    places[0].translation = mt_vec3_make(-1, 0.5, -1);
    places[1].linear[0][1] = 0.2; /* a shear */
    places[1].translation = mt_vec3_make(0.6, -0.8, 0);
    places[2].linear[2][2] = 1.5;
    places[2].translation = mt_vec3_make(0.9, 0.9, -0.5);
    mt_image *images[2];
    for (int i = 0; i < 2; i++) {
        test_scene s;
        test_scene_init(&s, SIZE);
        test_scene_light(&s, MT_LIGHT_POINT, mt_vec3_make(-3, 4, 5), true);
        for (int k = 0; k < 3; k++) {
            if (i == 1) {
                assert_int_equal(mt_mesh_copy(context, mesh, &copies[k]), MT_OK);
                assert_int_equal(mt_mesh_transform(context, copies[k], &places[k]), MT_OK);
            }
            test_scene_mesh(&s, 0, i == 0 ? mesh : copies[k], i == 0 ? places[k] : mt_transform_identity());
            s.meshes[s.objects[k].mesh].shading = MT_SHADING_FLAT;
        }
        images[i] = test_scene_draw(context, &s, NULL, NULL);
    }
    int differ = 0, seen = 0;
    for (int i = 0; i < SIZE * SIZE * 3; i++) {
        differ += fabs((double)images[0]->pixels[i] - (double)images[1]->pixels[i]) > 1e-5;
        seen += images[0]->pixels[i] > 0;
    }
    print_message("instances: %d of %d differ\n", differ, seen);
    assert_true(seen > 2000 && differ <= 6);
    for (int i = 0; i < 3; i++) {
        mt_mesh_destroy(context, copies[i]);
    }
    mt_image_destroy(context, images[0]);
    mt_image_destroy(context, images[1]);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void checkers_and_backgrounds(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_scene s;
    test_scene_init(&s, SIZE);
    s.scene.ambient = mt_vec3_make(1, 1, 1);
    s.materials[0].checker_size = 0.5;
    s.materials[0].checker_color = mt_vec3_make(0.25, 0.5, 0.75);
    test_scene_plane(&s, 0, mt_vec3_make(0, -1, 0), mt_vec3_make(0, 1, 0));
    s.scene.background.kind = MT_SCENE_GRADIENT;
    s.scene.background.color = mt_vec3_make(1, 0, 0);
    s.scene.background.top = mt_vec3_make(0, 0, 1);
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    int wrong = 0, dark = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_ray ray = test_scene_ray(SIZE, x, y);
            mt_vec3 got = pixel_of(image, x, y);
            if (ray.direction.y >= 0) {
                double share = 0.5 + 0.5 * ray.direction.y / mt_vec3_length(ray.direction);
                wrong += fabs(got.x - (1 - share)) > 1e-6 || fabs(got.z - share) > 1e-6;
                continue;
            }
            mt_vec3 p = mt_ray_at(&ray, -1 / ray.direction.y);
            bool other = ((long)floor(p.x / 0.5) + (long)floor(p.z / 0.5)) % 2 != 0;
            wrong += fabs(got.x - (other ? 0.25 : 1)) > 1e-6 && fabs(p.z) < 10;
            dark += other;
        }
    }
    assert_true(dark > 500);
    assert_true(wrong < 3);
    mt_image_destroy(context, image);
    s.scene.background.kind = MT_SCENE_TRANSPARENT;
    image = test_scene_draw(context, &s, NULL, NULL);
    assert_int_equal(image->channel_count, 4);
    assert_true(mt_image_pixel(image, 5, 5)[3] == 0.0F && mt_image_pixel(image, 5, SIZE - 5)[3] == 1.0F);
    mt_image_destroy(context, image);
    test_context_end(context);
}

/* All four projections, by a small sphere at known places: where its middle falls. */
static void projections_put_things_where_they_belong(void **state)
{
    (void)state;
    static const struct {
        mt_projection projection;
        double x, y; /* of the point (0.5, 0.25, -1), seen from (0, 0, 5), in parts of half the picture */
    } rows[] = {{MT_PROJECTION_PERSPECTIVE, 0.5 / 6 / 0.36397023426620234, 0.25 / 6 / 0.36397023426620234},
                {MT_PROJECTION_ORTHOGRAPHIC, 0.25, 0.125},
                {MT_PROJECTION_CABINET, (0.5 + 0.35355339059327378) / 2, (0.25 + 0.35355339059327378) / 2},
                {MT_PROJECTION_CAVALIER, (0.5 + 0.70710678118654752) / 2, (0.25 + 0.70710678118654752) / 2}};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        test_scene s;
        test_scene_init(&s, 200);
        s.scene.camera.projection = rows[i].projection;
        s.scene.camera.width = 4;
        s.scene.ambient = mt_vec3_make(1, 1, 1);
        test_scene_sphere(&s, 0, mt_vec3_make(0.5, 0.25, -1), 0.05);
        mt_image *image = test_scene_draw(context, &s, NULL, NULL);
        double sum_x = 0, sum_y = 0, count = 0;
        for (uint32_t y = 0; y < 200; y++) {
            for (uint32_t x = 0; x < 200; x++) {
                if (mt_image_pixel(image, x, y)[0] > 0.5F) {
                    sum_x += x + 0.5, sum_y += y + 0.5, count++;
                }
            }
        }
        assert_true(count > 5);
        assert_true(fabs(sum_x / count - 100 * (1 + rows[i].x)) < 0.6);
        assert_true(fabs(sum_y / count - 100 * (1 - rows[i].y)) < 0.6);
        mt_image_destroy(context, image);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lit_sphere_is_lambert_and_blinn),
        cmocka_unit_test(a_point_light_s_shadow_has_the_cone_s_edge),
        cmocka_unit_test(a_mirror_s_picture_is_the_mirrored_scene),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(depth_and_cutoff_leave_out_what_they_say),
        cmocka_unit_test(instances_are_transformed_copies),
        cmocka_unit_test(checkers_and_backgrounds),
        cmocka_unit_test(projections_put_things_where_they_belong),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
