/* Glass against Snell's and Fresnel's laws, written down independently: a slab shifts what is behind it, beyond the
 * critical angle nothing leaves, the way inside attenuates, and shadows are as light as the header says. */
#include "tests/support/picture.h"
#include "tests/support/scene.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>

#include <math.h>

enum { SIZE = 64 };

static mt_material *glass(test_scene *s, double refractive_index, mt_index *number)
{
    mt_material *m = test_scene_material(s, number);
    m->color = mt_vec3_make(0, 0, 0);
    m->transparency = 1;
    m->refractive_index = refractive_index;
    return m;
}

/* Share of light that a surface between refractive indices lets through, at a cosine. */
static double passes(double from, double to, double cosine)
{
    double sine = from / to * sqrt(1 - cosine * cosine), beyond = sqrt(1 - sine * sine);
    double rs = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    double rp = (from * beyond - to * cosine) / (from * beyond + to * cosine);
    return 1 - 0.5 * (rs * rs + rp * rp);
}

/* A cube of glass, from z = -1 to 1 and wide, in front of a checked plane at z = -2: each ray is shifted aside by
 * d tan(angle) - d tan(refracted) towards the middle. Rays that come back off the second surface are cut off. */
static void a_slab_shifts_what_is_behind(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = NULL;
    assert_int_equal(mt_generate(context, "cube", NULL, &cube), MT_OK);
    mt_bounds bounds = mt_mesh_bounds(cube);
    double half = bounds.maximum.x;
    test_scene s;
    test_scene_init(&s, SIZE);
    s.scene.ambient = mt_vec3_make(1, 1, 1);
    s.scene.cutoff = 0.5; /* reflected light is left out */
    mt_index number;
    glass(&s, 1.5, &number);
    mt_transform place = mt_transform_scaling(1 / half);
    place.linear[0][0] = place.linear[1][1] = 100 / half;
    test_scene_mesh(&s, number, cube, place);
    s.materials[0].checker_size = 0.37;
    s.materials[0].checker_color = mt_vec3_make(0, 0, 0);
    test_scene_plane(&s, 0, mt_vec3_make(0.1, 0.2, -2), mt_vec3_make(0, 0, 1));
    mt_scene_report report;
    mt_image *image = test_scene_draw(context, &s, NULL, &report);
    int wrong = 0, white = 0, checked = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_ray ray = test_scene_ray(SIZE, x, y);
            double aside = sqrt(ray.direction.x * ray.direction.x + ray.direction.y * ray.direction.y);
            double sine = aside / sqrt(1 + aside * aside), inside = asin(sine / 1.5);
            double reach = 4 * aside + 2 * tan(inside) + 1 * aside; /* to z = 1, through, and to z = -2 */
            double px = ray.direction.x / aside * reach, py = ray.direction.y / aside * reach;
            double u = (px - 0.1) / 0.37, v = (py - 0.2) / 0.37;
            if (fabs(u - round(u)) < 1e-6 || fabs(v - round(v)) < 1e-6) {
                continue;
            }
            bool dark = ((long)floor(u) + (long)floor(v)) % 2 != 0;
            double pass = passes(1, 1.5, cos(asin(sine))) * passes(1.5, 1, cos(inside));
            checked++;
            wrong += fabs((double)mt_image_pixel(image, x, y)[0] - (dark ? 0 : pass)) > 1e-5;
            white += !dark;
        }
    }
    print_message("slab: %d wrong of %d\n", wrong, checked);
    assert_true(white > SIZE * SIZE / 3 && checked > SIZE * SIZE - 300);
    assert_int_equal(wrong, 0);
    assert_int_equal(report.refracted_rays, 2 * SIZE * SIZE);
    mt_image_destroy(context, image);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* From under water, a plane, the sky is seen within the critical angle, with Fresnel's share; outside it all light is
 * reflected. The eye has to be in the water: a large ball of glass around it stands for the water. */
static void beyond_the_critical_angle_nothing_leaves(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_scene s;
    test_scene_init(&s, 256);
    const double n = 1.5;
    s.scene.camera.fov_degrees = 100;
    s.scene.background.color = mt_vec3_make(1, 1, 1);
    s.scene.depth_limit = 1; /* the refracted ray, and the reflected one, which meets black and is left out */
    s.scene.cutoff = -1;
    mt_index number;
    glass(&s, n, &number);
    /* The front is up: seen from below it is left. */
    test_scene_plane(&s, number, mt_vec3_make(0, 0, 0), mt_vec3_make(0, 0, -1));
    /* Black, under the eye. */
    s.materials[0].color = mt_vec3_make(0, 0, 0);
    test_scene_plane(&s, 0, mt_vec3_make(0, 0, 6), mt_vec3_make(0, 0, -1));
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    double critical = asin(1 / n), tangent = tan(50 * acos(-1.0) / 180), worst = 0;
    int total = 0, seen = 0;
    for (uint32_t x = 0; x < 256; x++) {
        for (uint32_t y = 0; y < 256; y++) {
            double a = (2 * (x + 0.5) / 256 - 1) * tangent, b = (1 - 2 * (y + 0.5) / 256) * tangent;
            double angle = atan(sqrt(a * a + b * b)), got = (double)mt_image_pixel(image, x, y)[0];
            if (angle > critical) {
                assert_true(got == 0);
                total++;
            } else {
                worst = fmax(worst, fabs(got - passes(n, 1, cos(angle))));
                seen++;
            }
        }
    }
    print_message("critical angle: %d reflected, %d seen, off by %g\n", total, seen, worst);
    assert_true(total > 10000 && seen > 10000 && worst < 1e-6);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static double middle_of(mt_context *context, const test_scene *s, int channel)
{
    mt_image *image = test_scene_draw(context, s, NULL, NULL);
    double value = (double)image->pixels[channel];
    mt_image_destroy(context, image);
    return value;
}

/* Straight through the middle of balls: what is left is Fresnel's share at each surface and the attenuation of the way;
 * within glass within glass the last entered counts. */
static void light_is_attenuated_on_its_way(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (int nested = 0; nested < 2; nested++) {
        test_scene s;
        test_scene_init(&s, 1);
        s.scene.background.color = mt_vec3_make(1, 1, 1);
        s.scene.cutoff = 0.2;
        mt_index outer, inner;
        mt_material *m = glass(&s, 1.25, &outer);
        m->attenuation_color = mt_vec3_make(0.5, 0.9, 1);
        m->attenuation_distance = 2;
        test_scene_sphere(&s, outer, mt_vec3_make(0, 0, 0), 1.5);
        double expected = passes(1, 1.25, 1) * passes(1.25, 1, 1) * pow(0.5, 3.0 / 2);
        if (nested) {
            m = glass(&s, 1.75, &inner);
            m->attenuation_color = mt_vec3_make(0.25, 1, 1);
            m->attenuation_distance = 4;
            test_scene_sphere(&s, inner, mt_vec3_make(0, 0, 0), 0.5);
            expected = passes(1, 1.25, 1) * passes(1.25, 1, 1) * pow(0.5, 2.0 / 2);
            expected *= passes(1.25, 1.75, 1) * passes(1.75, 1.25, 1) * pow(0.25, 1.0 / 4);
        }
        double got = middle_of(context, &s, 0);
        if (!(fabs(got - expected) < 1e-6)) {
            fail_msg("nested %d: %g instead of %g", nested, got, expected);
        }
    }
    test_context_end(context);
}

/* Under a ball of glass the light of the lamp arrives less the transparency of two surfaces and the attenuation of the
 * straight way; a mesh of glass does the same, and so do both with the lamp inside or the floor inside. */
static void glass_casts_light_shadows(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = NULL;
    assert_int_equal(mt_generate(context, "cube", NULL, &cube), MT_OK);
    double half = mt_mesh_bounds(cube).maximum.x;
    for (int kind = 0; kind < 4; kind++) {
        test_scene s;
        mt_index number;
        test_scene_init(&s, 1);
        s.scene.camera.eye = mt_vec3_make(3, 0.5, 0);
        s.scene.camera.target = mt_vec3_make(0, -2, 0);
        mt_material *m = glass(&s, 1.5, &number);
        m->transparency = 0.75;
        m->attenuation_color = mt_vec3_make(0.5, 1, 1);
        m->attenuation_distance = 1;
        bool lamp_inside = kind == 2;
        test_scene_light(&s, MT_LIGHT_POINT, mt_vec3_make(0, lamp_inside ? 0.25 : 4, 0), true);
        test_scene_plane(&s, 0, mt_vec3_make(0, -2, 0), mt_vec3_make(0, 1, 0));
        double way = lamp_inside ? 0.75 : 1, surfaces = lamp_inside ? 0.75 : 0.75 * 0.75;
        if (kind == 1) {
            mt_transform place = mt_transform_scaling(0.5 / half);
            test_scene_mesh(&s, number, cube, place);
        } else {
            test_scene_sphere(&s, number, mt_vec3_make(0, 0, 0), 0.5);
        }
        double expected = surfaces * pow(0.5, way);
        if (kind == 3) { /* what is opaque hides whatever glass there is */
            test_scene_sphere(&s, 0, mt_vec3_make(0, 2, 0), 0.25);
            expected = 0;
        }
        double got = middle_of(context, &s, 0);
        if (!(fabs(got - expected) < 1e-6)) {
            fail_msg("kind %d: %g instead of %g", kind, got, expected);
        }
    }
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* A white furnace: in surroundings of light 1, clear glass is not seen, when all rays are followed: what is not
 * reflected goes through, at each surface. A ball reflects no light totally that entered it. */
static void clear_glass_in_a_furnace_is_not_seen(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_scene s;
    mt_index number;
    test_scene_init(&s, 32);
    s.scene.background.color = mt_vec3_make(1, 1, 1);
    s.scene.cutoff = 1e-7;
    s.scene.depth_limit = 40;
    glass(&s, 1.5, &number);
    test_scene_sphere(&s, number, mt_vec3_make(0.1, 0.2, 0), 1.2);
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    double worst = 0;
    for (int i = 0; i < 32 * 32 * 3; i++) {
        worst = fmax(worst, fabs((double)image->pixels[i] - 1));
    }
    print_message("furnace: off by %g\n", worst);
    assert_true(worst < 1e-5);
    mt_image_destroy(context, image);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_slab_shifts_what_is_behind),
        cmocka_unit_test(beyond_the_critical_angle_nothing_leaves),
        cmocka_unit_test(light_is_attenuated_on_its_way),
        cmocka_unit_test(glass_casts_light_shadows),
        cmocka_unit_test(clear_glass_in_a_furnace_is_not_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
