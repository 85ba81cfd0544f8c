/* Pictures of a plane, a sphere and a torus against their closed forms: depth by the depth colouring's own input,
 * normals by the normal colouring, at the middle of each pixel. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/preview.h>

#include <math.h>
#include <string.h>

enum { SIZE = 96 };

/* Signed distance to a surface, in the mesh's coordinates. */
typedef double (*distance_function)(mt_vec3 p);

static double to_plane(mt_vec3 p)
{
    return fmax(fabs(p.y), fmax(fabs(p.x), fabs(p.z)) - 1.0);
}

static double to_sphere(mt_vec3 p)
{
    return mt_vec3_length(p) - 1.0;
}

/* As mt_generate makes it: radius 1 around the Y axis, tube 0.4. */
static double to_torus(mt_vec3 p)
{
    double ring = sqrt(p.x * p.x + p.z * p.z) - 1.0;
    return sqrt(ring * ring + p.y * p.y) - 0.4;
}

/* The first point of the ray on the surface, by sphere tracing; false: none. */
static bool trace(distance_function distance, mt_vec3 origin, mt_vec3 direction, mt_vec3 *hit)
{
    double t = 0;
    for (int i = 0; i < 4000 && t < 100; i++) {
        *hit = mt_vec3_add(origin, mt_vec3_scale(direction, t));
        double d = distance(*hit);
        if (d < 1e-9) {
            return true;
        }
        t += d;
    }
    return false;
}

static mt_vec3 normal_at(distance_function distance, mt_vec3 p)
{
    const double h = 1e-6;
    return mt_vec3_normalize(
        mt_vec3_make(distance(mt_vec3_make(p.x + h, p.y, p.z)) - distance(mt_vec3_make(p.x - h, p.y, p.z)),
                     distance(mt_vec3_make(p.x, p.y + h, p.z)) - distance(mt_vec3_make(p.x, p.y - h, p.z)),
                     distance(mt_vec3_make(p.x, p.y, p.z + h)) - distance(mt_vec3_make(p.x, p.y, p.z - h))));
}

/* A perspective camera at (3, 2, 4) that looks at the middle with 40 degrees, written down independently. */
static void own_ray(uint32_t x, uint32_t y, mt_vec3 *origin, mt_vec3 *direction)
{
    *origin = mt_vec3_make(3, 2, 4);
    mt_vec3 forward = mt_vec3_normalize(mt_vec3_make(-3, -2, -4));
    mt_vec3 right = mt_vec3_normalize(mt_vec3_cross(forward, mt_vec3_make(0, 1, 0)));
    mt_vec3 up = mt_vec3_cross(right, forward);
    double tangent = tan(20.0 * acos(-1.0) / 180.0);
    double a = (2 * (x + 0.5) / SIZE - 1) * tangent, b = (1 - 2 * (y + 0.5) / SIZE) * tangent;
    *direction = mt_vec3_normalize(mt_vec3_add(forward, mt_vec3_add(mt_vec3_scale(right, a), mt_vec3_scale(up, b))));
}

static mt_image *draw(mt_context *context, const mt_mesh *mesh, mt_coloring coloring)
{
    mt_preview_options options = {.width = SIZE,
                                  .height = SIZE,
                                  .samples = 1,
                                  .background = MT_BACKGROUND_TRANSPARENT,
                                  .coloring = coloring,
                                  .shading = MT_SHADING_SMOOTH,
                                  .has_eye = true,
                                  .has_target = true,
                                  .eye = {3, 2, 4},
                                  .fov_degrees = 40};
    mt_image *image = NULL;
    assert_int_equal(mt_preview(context, mesh, &options, &image), MT_OK);
    return image;
}

typedef struct score {
    int hits, misplaced;
    double worst_normal;
} score;

/* Compares coverage and normals; pixels at the rim, where the mesh is a polygon, may differ. */
static score compare(const mt_image *normals, distance_function distance)
{
    score s = {0};
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_vec3 origin, direction, p;
            own_ray(x, y, &origin, &direction);
            const float *pixel = mt_image_pixel(normals, x, y);
            bool expected = trace(distance, origin, direction, &p);
            s.hits += expected;
            s.misplaced += expected != (pixel[3] > 0.5F);
            if (expected && pixel[3] > 0.5F) {
                mt_vec3 n = normal_at(distance, p);
                const double exact[3] = {n.x, n.y, n.z};
                bool grazing = fabs(mt_vec3_dot(n, direction)) < 0.15;
                for (int i = 0; i < 3 && !grazing; i++) {
                    double got = 2.0 * mt_srgb_encode((double)pixel[i]) - 1.0;
                    s.worst_normal = fmax(s.worst_normal, fabs(got - exact[i]));
                }
            }
        }
    }
    return s;
}

static void surfaces_are_where_their_forms_say(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        mt_index resolution;
        distance_function distance;
        double normal_error;
    } rows[] = {{"grid", 4, to_plane, 0.003}, {"icosphere", 6, to_sphere, 0.02}, {"torus", 400, to_torus, 0.02}};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_mesh *mesh = NULL;
        mt_generate_options options = {.resolution = rows[i].resolution};
        assert_int_equal(mt_generate(context, rows[i].name, &options, &mesh), MT_OK);
        mt_image *normals = draw(context, mesh, MT_COLORING_NORMAL);
        score s = compare(normals, rows[i].distance);
        if (s.hits < 500 || s.misplaced > s.hits / 100 || s.worst_normal > rows[i].normal_error) {
            fail_msg("%s: %d hits, %d misplaced, normals off by %g", rows[i].name, s.hits, s.misplaced, s.worst_normal);
        }
        mt_image_destroy(context, normals);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Grey falls linearly with the distance along the view, from 0.78 at the nearest vertex to 0.10 at the farthest. */
static void depth_is_that_of_the_sphere(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, "icosphere", &(mt_generate_options){.resolution = 6}, &mesh), MT_OK);
    mt_image *depths = draw(context, mesh, MT_COLORING_DEPTH);
    mt_vec3 forward = mt_vec3_normalize(mt_vec3_make(-3, -2, -4));
    double middle = sqrt(29.0), worst = 0;
    for (uint32_t y = 0; y < SIZE; y++) {
        for (uint32_t x = 0; x < SIZE; x++) {
            mt_vec3 origin, direction, p;
            own_ray(x, y, &origin, &direction);
            const float *pixel = mt_image_pixel(depths, x, y);
            if (!trace(to_sphere, origin, direction, &p) || pixel[3] < 1.0F || mt_vec3_dot(p, direction) > -0.3) {
                continue;
            }
            double along = mt_vec3_dot(mt_vec3_subtract(p, origin), forward);
            double share = (0.78 - mt_srgb_encode((double)pixel[0])) / 0.68;
            worst = fmax(worst, fabs(share - (along - (middle - 1)) / 2));
        }
    }
    assert_true(worst < 0.004);
    mt_image_destroy(context, depths);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_are_where_their_forms_say),
        cmocka_unit_test(depth_is_that_of_the_sphere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
