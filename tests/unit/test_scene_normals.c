/* Normals between the corners of a mesh in a scene: a fine sphere of triangles shades as the sphere itself does where
 * its normals are smooth, and by faces where they are flat. */
#include "tests/support/scene.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>

#include <math.h>

enum { SIZE = 64 };

static const mt_vec3 toward = {0.6, 0.48, 0.64}; /* of length 1 */

/* Lambert's law on the unit sphere where a pixel's ray meets it well inside of its outline; negative: nowhere. */
static double sphere_cosine(uint32_t x, uint32_t y)
{
    mt_ray ray = test_scene_ray(SIZE, x, y);
    double a = mt_vec3_dot(ray.direction, ray.direction), b = mt_vec3_dot(ray.direction, ray.origin);
    double d = b * b - a * (mt_vec3_dot(ray.origin, ray.origin) - 1);
    if (d < 0.2 * a) {
        return -1;
    }
    mt_vec3 normal = mt_vec3_add(ray.origin, mt_vec3_scale(ray.direction, (-b - sqrt(d)) / a));
    return fmax(0, mt_vec3_dot(normal, toward));
}

/* The largest difference to it in the picture of a mesh. */
static double worst_difference(mt_context *context, const mt_mesh *mesh, mt_shading shading, int *seen)
{
    test_scene s;
    test_scene_init(&s, SIZE);
    s.materials[0].color = mt_vec3_make(1, 1, 1);
    test_scene_light(&s, MT_LIGHT_DIRECTIONAL, toward, false);
    test_scene_mesh(&s, 0, mesh, mt_transform_scaling(1));
    s.meshes[0].shading = shading;
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    double worst = 0;
    *seen = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            double cosine = sphere_cosine(x, y);
            if (cosine >= 0) {
                worst = fmax(worst, fabs((double)mt_image_pixel(image, x, y)[0] - cosine));
                ++*seen;
            }
        }
    }
    mt_image_destroy(context, image);
    return worst;
}

static void smooth_normals_are_the_sphere_s(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    const mt_generate_options options = {.resolution = 4};
    assert_int_equal(mt_generate(context, "icosphere", &options, &mesh), MT_OK);
    int seen = 0;
    double smooth = worst_difference(context, mesh, MT_SHADING_SMOOTH, &seen);
    double flat = worst_difference(context, mesh, MT_SHADING_FLAT, &seen);
    double crease = worst_difference(context, mesh, MT_SHADING_CREASE, &seen);
    print_message("smooth %g, flat %g, crease %g of %d pixels\n", smooth, flat, crease, seen);
    assert_true(seen > 300);
    assert_true(smooth < 0.01);
    assert_true(crease < 0.01); /* no edge of it is sharp */
    assert_true(flat > 3 * smooth);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(smooth_normals_are_the_sphere_s)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
