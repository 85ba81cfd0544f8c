/* Pictures of scenes are the same bytes for any number of threads, compiler and structure, and after any failure; and
 * what a scene does not require is not built. */
#include "tests/support/picture.h"
#include "tests/support/scene.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One of everything: glass around a mirror, a mesh of glass, instances, loose triangles, lamps, a checked floor. */
static void fill_everything(test_scene *s, const mt_mesh *teapot, const mt_mesh *torus, uint32_t size)
{
    mt_index mirror, glass, floor, tinted;
    test_scene_init(s, size);
    s->scene.ambient = mt_vec3_make(0.1, 0.12, 0.15);
    s->scene.background = (mt_scene_background){MT_SCENE_GRADIENT, {0.3, 0.3, 0.3}, {0.2, 0.4, 0.8}};
    s->scene.camera.eye = mt_vec3_make(1, 2, 5);
    mt_material *m = test_scene_material(s, &mirror);
    m->mirror = mt_vec3_make(0.8, 0.8, 0.7);
    m->specular = mt_vec3_make(0.5, 0.5, 0.5);
    m->exponent = 33.3;
    m = test_scene_material(s, &glass);
    m->transparency = 0.9;
    m->attenuation_color = mt_vec3_make(0.9, 0.5, 0.5);
    m->attenuation_distance = 1;
    m = test_scene_material(s, &floor);
    m->checker_size = 0.5;
    m->checker_color = mt_vec3_make(0.2, 0.1, 0.1);
    m->mirror = mt_vec3_make(0.1, 0.1, 0.1);
    m = test_scene_material(s, &tinted);
    m->color = mt_vec3_make(0.9, 0.6, 0.2);
    test_scene_plane(s, floor, mt_vec3_make(0, -1, 0), mt_vec3_make(0, 1, 0));
    test_scene_sphere(s, mirror, mt_vec3_make(-1, 0, -0.5), 0.5);
    test_scene_sphere(s, glass, mt_vec3_make(-0.8, 0, 0.2), 0.9);
    mt_transform place = mt_transform_scaling(0.25);
    place.translation = mt_vec3_make(0.7, -1, 0);
    test_scene_mesh(s, tinted, teapot, place);
    place = mt_transform_rotation(mt_vec3_make(1, 1, 0), 40);
    place.translation = mt_vec3_make(1.2, 0.8, -1);
    test_scene_mesh(s, glass, torus, place);
    place.linear[1][1] *= 0.5;
    place.translation = mt_vec3_make(-1.2, 1.2, -2);
    test_scene_mesh(s, mirror, torus, place);
    for (int i = 0; i < 2; i++) {
        mt_scene_object *object = &s->objects[s->scene.object_count++];
        *object = (mt_scene_object){.kind = MT_OBJECT_TRIANGLE, .material = i ? tinted : mirror};
        object->shape.triangle = (mt_triangle){{{2, -1, -1 - i}, {2.5, 1, -1}, {1, -1, -2}}};
    }
    test_scene_light(s, MT_LIGHT_POINT, mt_vec3_make(-2, 4, 3), true)->fade = 5;
    test_scene_light(s, MT_LIGHT_DIRECTIONAL, mt_vec3_make(1, 1, 1), true)->color = mt_vec3_make(0.4, 0.4, 0.3);
}

typedef struct meshes {
    mt_mesh *teapot, *torus;
} meshes;

static meshes make_meshes(mt_context *context)
{
    meshes m;
    assert_int_equal(mt_generate(context, "teapot", &(mt_generate_options){.resolution = 6}, &m.teapot), MT_OK);
    assert_int_equal(mt_generate(context, "torus", &(mt_generate_options){.resolution = 24}, &m.torus), MT_OK);
    return m;
}

static void destroy_meshes(mt_context *context, meshes m)
{
    mt_mesh_destroy(context, m.teapot);
    mt_mesh_destroy(context, m.torus);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    static const unsigned threads[] = {1, 2, 7};
    uint64_t hashes[2][3];
    mt_scene_report reports[2][3];
    for (int adaptive = 0; adaptive < 2; adaptive++) {
        for (int i = 0; i < 3; i++) {
            mt_context *context = test_context_with_threads(threads[i]);
            meshes m = make_meshes(context);
            test_scene s;
            fill_everything(&s, m.teapot, m.torus, 80);
            s.scene.samples = adaptive ? MT_SAMPLES_ADAPTIVE : 4;
            mt_image *image = test_scene_draw(context, &s, NULL, &reports[adaptive][i]);
            hashes[adaptive][i] = test_image_hash(image);
            mt_image_destroy(context, image);
            destroy_meshes(context, m);
            test_context_end(context);
        }
        assert_true(hashes[adaptive][0] == hashes[adaptive][1] && hashes[adaptive][0] == hashes[adaptive][2]);
        assert_memory_equal(&reports[adaptive][0], &reports[adaptive][2], sizeof reports[0][0]);
    }
    assert_true(reports[0][0].refracted_rays > 1000 && reports[0][0].shadow_rays > 1000);
    assert_int_equal(reports[0][0].primary_rays, 80 * 80 * 4);
    assert_true(reports[1][0].primary_rays > 80 * 80 * 4);
}

/* The sum of this picture as every compiler and processor must give it. */
static void the_bytes_are_known(void **state)
{
    (void)state;
    const uint64_t expected = 0xb80563be6b1e1b03u;
    mt_context *context = test_context();
    meshes m = make_meshes(context);
    test_scene s;
    fill_everything(&s, m.teapot, m.torus, 64);
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    if (test_image_hash(image) != expected) {
        fail_msg("the picture's sum is 0x%016llxu", (unsigned long long)test_image_hash(image));
    }
    mt_image_destroy(context, image);
    destroy_meshes(context, m);
    test_context_end(context);
}

static void structures_do_not_matter(void **state)
{
    (void)state;
    mt_context *context = test_context();
    meshes m = make_meshes(context);
    test_scene s;
    fill_everything(&s, m.teapot, m.torus, 40);
    uint64_t expected = 0;
    for (int kind = -1; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
        const mt_scene_options options = {.has_structure = kind >= 0,
                                          .structure = (mt_ray_structure_kind)(kind < 0 ? 0 : kind)};
        mt_image *image = test_scene_draw(context, &s, &options, NULL);
        expected = kind < 0 ? test_image_hash(image) : expected;
        assert_true(test_image_hash(image) == expected);
        mt_image_destroy(context, image);
    }
    destroy_meshes(context, m);
    test_context_end(context);
}

static mt_status draw_in(mt_context *context, const meshes *m, uint32_t size)
{
    test_scene s;
    mt_image *image = NULL;
    fill_everything(&s, m->teapot, m->torus, size);
    s.scene.samples = MT_SAMPLES_ADAPTIVE;
    mt_status status = mt_scene_render(context, &s.scene, NULL, &image, NULL);
    assert_int_equal(image == NULL, status != MT_OK);
    mt_image_destroy(context, image);
    return status;
}

static void missing_memory_is_an_error(void **state)
{
    (void)state;
    mt_context *own = test_context();
    const meshes m = make_meshes(own);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    int failures = 0;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1 + (unsigned)(n % 2)};
        mt_context *context = mt_context_create(&options);
        status = draw_in(context, &m, 8);
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        failures += status != MT_OK;
        test_context_end(context);
        assert_true(n < 1000);
    }
    assert_true(failures > 30);
    destroy_meshes(own, m);
    test_context_end(own);
}

static bool stop_at(void *user, const char *task, double fraction)
{
    (void)task;
    (void)fraction;
    return --*(int *)user >= 0;
}

static void cancelling_leaves_nothing(void **state)
{
    (void)state;
    mt_context *own = test_context();
    const meshes m = make_meshes(own);
    mt_status status = MT_ERROR_CANCELLED;
    int rounds = 0;
    for (; status != MT_OK; rounds++) {
        int left = rounds;
        mt_context_options options = {.progress = stop_at, .progress_user = &left};
        mt_context *context = mt_context_create(&options);
        status = draw_in(context, &m, 40);
        assert_true(status == MT_OK || status == MT_ERROR_CANCELLED);
        test_context_end(context);
        assert_true(rounds < 200);
    }
    assert_true(rounds > 1);
    destroy_meshes(own, m);
    test_context_end(own);
}

/* The most that is held while `count` teapots are drawn, their objects included. */
static uint64_t peak_of(mt_index count)
{
    mt_context *context = test_context_with_threads(1);
    mt_mesh *teapot = NULL;
    assert_int_equal(mt_generate(context, "teapot", NULL, &teapot), MT_OK);
    test_scene s;
    test_scene_init(&s, 64);
    test_scene_light(&s, MT_LIGHT_DIRECTIONAL, mt_vec3_make(1, 2, 1), true);
    test_scene_mesh(&s, 0, teapot, mt_transform_scaling(count > 1 ? 0.005 : 0.3));
    mt_scene_object *objects = mt_allocate_array(context, count, sizeof *objects);
    assert_non_null(objects);
    for (mt_index i = 0; i < count; i++) {
        objects[i] = s.objects[0];
        objects[i].shape.transform.translation = mt_vec3_make(0.03 * (i % 100) - 1.5, 0.03 * (i / 100) - 1.5, 0);
        if (count == 1) {
            objects[i].shape.transform.translation = mt_vec3_make(0, 0, 0);
        }
    }
    s.scene.objects = objects;
    s.scene.object_count = count;
    mt_scene_report report;
    mt_image *image = test_scene_draw(context, &s, NULL, &report);
    double sum = 0;
    for (int i = 0; i < 64 * 64 * 3; i++) {
        sum += (double)image->pixels[i];
    }
    assert_true(sum > 0);
    mt_image_destroy(context, image);
    mt_free(context, objects);
    mt_mesh_destroy(context, teapot);
    uint64_t peak = mt_context_peak_bytes(context);
    test_context_end(context);
    return peak;
}

static void instances_cost_their_transform(void **state)
{
    (void)state;
    const mt_index count = 10000;
    double each = (double)(peak_of(count) - peak_of(1)) / (count - 1);
    print_message("an instance takes %.1f bytes\n", each);
    assert_true(each <= 200);
}

/* Primary rays alone: rasterised or by rays, coarse, fine and adaptive, in each projection, the picture is the same;
 * and but for a few pixels at edges, whose vertices are rounded elsewhere, so is that of a scene whose meshes are met
 * one by one (a mirror beside the picture makes it so). */
static void both_orders_draw_the_same(void **state)
{
    (void)state;
    mt_context *context = test_context();
    meshes m = make_meshes(context);
    for (int row = 0; row < 8; row++) {
        test_scene s;
        fill_everything(&s, m.teapot, m.torus, 96);
        for (mt_index i = 0; i < s.scene.material_count; i++) {
            s.materials[i].mirror = mt_vec3_make(0, 0, 0);
            s.materials[i].transparency = 0;
        }
        for (mt_index i = 0; i < s.scene.light_count; i++) {
            s.lights[i].casts_shadows = false;
        }
        if (row == 7) { /* the one mesh there is, as it is */
            s.objects[0] = s.objects[3];
            s.objects[0].shape.transform = mt_transform_identity();
            s.scene.object_count = 1;
        }
        s.scene.camera.projection = (mt_projection)(row % 4);
        s.scene.samples = row < 4 ? 4 : MT_SAMPLES_ADAPTIVE;
        mt_scene_report reports[3];
        mt_image *images[3];
        for (int k = 0; k < 3; k++) {
            const mt_scene_options options = {.method = k == 1 ? MT_METHOD_RAY : MT_METHOD_AUTO};
            if (k == 2) {
                mt_index mirror;
                test_scene_material(&s, &mirror)->mirror = mt_vec3_make(1, 1, 1);
                test_scene_sphere(&s, mirror, mt_vec3_make(0, 0, 1000), 1);
            }
            images[k] = test_scene_draw(context, &s, &options, &reports[k]);
        }
        assert_true(test_image_hash(images[0]) == test_image_hash(images[1]));
        int differ = 0;
        for (int i = 0; i < 96 * 96 * 3; i++) {
            differ += fabs((double)images[0]->pixels[i] - (double)images[2]->pixels[i]) > 1e-5;
        }
        print_message("row %d: %d values differ\n", row, differ);
        assert_true(differ <= 30);
        for (int k = 0; k < 3; k++) {
            mt_image_destroy(context, images[k]);
        }
    }
    destroy_meshes(context, m);
    test_context_end(context);
}

static bool has_part(const mt_context *context, const char *name, bool built)
{
    size_t count = 0;
    const mt_part *parts = mt_context_parts(context, &count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(parts[i].name, name) == 0 && parts[i].built == built) {
            return true;
        }
    }
    return false;
}

/* Draws a torus beside the picture, or in it, and one in front of a floor, with more and more that it requires. */
static void only_what_the_scene_requires_is_built(void **state)
{
    (void)state;
    for (int row = 0; row < 5; row++) {
        mt_context_options how = {.explain = true};
        mt_context *context = mt_context_create(&how);
        mt_mesh *torus = NULL;
        assert_int_equal(mt_generate(context, "torus", NULL, &torus), MT_OK);
        test_scene s;
        mt_index mirror;
        test_scene_init(&s, 32);
        test_scene_light(&s, MT_LIGHT_DIRECTIONAL, mt_vec3_make(1, 2, 3), row >= 1);
        mt_transform place = mt_transform_identity();
        place.translation.x = row == 3 ? 100 : 0;
        if (row < 4) {
            test_scene_mesh(&s, 0, torus, place);
        }
        test_scene_material(&s, &mirror)->mirror = mt_vec3_make(0.5, 0.5, 0.5);
        test_scene_plane(&s, row == 2 ? mirror : 0, mt_vec3_make(0, 0, -2), mt_vec3_make(0, 0, 1));
        mt_scene_report report;
        mt_image *image = test_scene_draw(context, &s, NULL, &report);
        assert_int_equal(has_part(context, "shadow rays", false), row < 1);
        assert_int_equal(report.shadow_rays > 0, row >= 1);
        assert_int_equal(has_part(context, "stack of rays", false), row != 2);
        assert_int_equal(has_part(context, "stack of rays", true), row == 2);
        assert_int_equal(report.reflected_rays > 0, row == 2);
        assert_int_equal(has_part(context, "surface tree", true), row == 1 || row == 2);
        assert_int_equal(has_part(context, "surface tree", false), row == 0 || row >= 3);
        mt_image_destroy(context, image);
        mt_mesh_destroy(context, torus);
        test_context_end(context);
    }
}

/* Primary rays alone search a tree too, but where they are to do without. */
static void rays_that_are_asked_for_have_a_tree(void **state)
{
    (void)state;
    for (int without = 0; without < 2; without++) {
        mt_context_options how = {.explain = true};
        mt_context *context = mt_context_create(&how);
        mt_mesh *torus = NULL;
        assert_int_equal(mt_generate(context, "torus", NULL, &torus), MT_OK);
        test_scene s;
        test_scene_init(&s, 32);
        test_scene_mesh(&s, 0, torus, mt_transform_identity());
        const mt_scene_options options = {
            .method = MT_METHOD_RAY, .has_structure = without, .structure = MT_RAY_STRUCTURE_NONE};
        mt_image_destroy(context, test_scene_draw(context, &s, &options, NULL));
        assert_int_equal(has_part(context, "surface tree", true), !without);
        mt_mesh_destroy(context, torus);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(the_bytes_are_known),
        cmocka_unit_test(structures_do_not_matter),
        cmocka_unit_test(missing_memory_is_an_error),
        cmocka_unit_test(cancelling_leaves_nothing),
        cmocka_unit_test(both_orders_draw_the_same),
        cmocka_unit_test(instances_cost_their_transform),
        cmocka_unit_test(only_what_the_scene_requires_is_built),
        cmocka_unit_test(rays_that_are_asked_for_have_a_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
