/* What a scene cannot be, and where its camera stands. */
#include "lib/render/scene_plan.h"

#include <meshtool/elementary.h>

#include <string.h>

#define DEFAULT_SIZE 1024
#define DEFAULT_FOV 40.0

/* Receding lines of an oblique picture rise at 45 degrees (as in a preview). */
#define OBLIQUE_COMPONENT 0.70710678118654752

/* The first thing wrong with a part of a scene: what it is, and what it should be. */
typedef struct complaint {
    const char *what, *should;
} complaint;

static bool is_light(mt_vec3 color)
{
    return mt_vec3_is_finite(color) && color.x >= 0 && color.y >= 0 && color.z >= 0;
}

static bool is_share(double x)
{
    return x >= 0 && x <= 1;
}

static bool is_color(mt_vec3 color)
{
    return is_share(color.x) && is_share(color.y) && is_share(color.z);
}

static bool is_direction(mt_vec3 v)
{
    return mt_vec3_is_finite(v) && mt_vec3_max_abs(v) > 0;
}

static bool is_positive_or_zero(double x)
{
    return x >= 0 && isfinite(x);
}

static complaint check_material(const mt_material *m)
{
    const struct {
        bool holds;
        complaint complaint;
    } rules[] = {
        {is_color(m->color), {"color", "from 0 to 1"}},
        {is_share(m->ambient), {"ambient", "from 0 to 1"}},
        {is_share(m->diffuse), {"diffuse", "from 0 to 1"}},
        {is_color(m->specular), {"specular", "from 0 to 1"}},
        {m->exponent >= 1 && m->exponent <= 1e6, {"exponent", "from 1 to 1000000"}},
        {is_color(m->mirror), {"mirror", "from 0 to 1"}},
        {is_share(m->transparency), {"transparency", "from 0 to 1"}},
        {m->refractive_index >= 1 && m->refractive_index <= 10, {"refractive index", "from 1 to 10"}},
        {is_color(m->attenuation_color), {"attenuation color", "from 0 to 1"}},
        {is_positive_or_zero(m->attenuation_distance), {"attenuation distance", "finite and not negative"}},
        {is_color(m->checker_color), {"checker color", "from 0 to 1"}},
        {is_positive_or_zero(m->checker_size), {"checker size", "finite and not negative"}},
    };
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        if (!rules[i].holds) {
            return rules[i].complaint;
        }
    }
    return (complaint){NULL, NULL};
}

static complaint check_light(const mt_scene_light *light)
{
    bool is_point = light->kind == MT_LIGHT_POINT;
    if (!is_light(light->color)) {
        return (complaint){"color", "finite and not negative"};
    }
    if (!is_positive_or_zero(light->fade)) {
        return (complaint){"fade", "finite and not negative"};
    }
    if (is_point ? !mt_vec3_is_finite(light->place) : !is_direction(light->place)) {
        return is_point ? (complaint){"position", "finite"} : (complaint){"direction", "finite and not zero"};
    }
    return (complaint){NULL, NULL};
}

static complaint check_object(const mt_scene *scene, const mt_scene_object *object)
{
    mt_transform inverse;
    const mt_vec3 *c = object->shape.triangle.corners;
    if (object->material >= scene->material_count) {
        return (complaint){"material", "one of the scene's materials"};
    }
    switch (object->kind) {
    case MT_OBJECT_PLANE:
        if (!mt_vec3_is_finite(object->shape.plane.point) || !is_direction(object->shape.plane.normal)) {
            return (complaint){"plane", "a finite point and a normal that is not zero"};
        }
        break;
    case MT_OBJECT_SPHERE:
        if (!mt_vec3_is_finite(object->shape.sphere.center) || !(object->shape.sphere.radius > 0) ||
            !isfinite(object->shape.sphere.radius)) {
            return (complaint){"sphere", "a finite center and a radius greater than 0"};
        }
        break;
    case MT_OBJECT_TRIANGLE:
        if (!mt_vec3_is_finite(c[0]) || !mt_vec3_is_finite(c[1]) || !mt_vec3_is_finite(c[2])) {
            return (complaint){"triangle", "three finite corners"};
        }
        break;
    default:
        if (object->mesh >= scene->mesh_count) {
            return (complaint){"mesh", "one of the scene's meshes"};
        }
        if (!mt_transform_inverse(&object->shape.transform, &inverse)) {
            return (complaint){"transform", "one that can be undone; its matrix is singular or not finite"};
        }
    }
    return (complaint){NULL, NULL};
}

static complaint check_camera(const mt_scene_camera *camera)
{
    mt_vec3 view = mt_vec3_subtract(camera->target, camera->eye);
    if (!mt_vec3_is_finite(camera->eye) || !is_direction(view)) {
        return (complaint){"eye and target", "two different, finite points"};
    }
    if (!mt_vec3_is_finite(camera->up)) {
        return (complaint){"up", "finite"};
    }
    if (!(camera->fov_degrees >= 0 && camera->fov_degrees < 180)) {
        return (complaint){"field of view", "greater than 0 and less than 180 degrees"};
    }
    return is_positive_or_zero(camera->width) ? (complaint){NULL, NULL} : (complaint){"width", "finite and positive"};
}

static complaint check_whole(const mt_scene *scene)
{
    uint32_t largest = scene->width > scene->height ? scene->width : scene->height;
    bool is_square = scene->samples == 0 || scene->samples == MT_SAMPLES_ADAPTIVE;
    for (unsigned n = 1; n * n <= MT_MAXIMUM_SAMPLES; n++) {
        is_square = is_square || n * n == scene->samples;
    }
    if (largest > MT_PREVIEW_MAXIMUM_SIZE) {
        return (complaint){"size", "at most 65535 pixels on a side"};
    }
    if (!is_square) {
        return (complaint){"number of samples", "a square number from 1 to 64"};
    }
    if (scene->depth_limit > MT_SCENE_MAXIMUM_DEPTH) {
        return (complaint){"depth limit", "at most 64"};
    }
    if (!(scene->cutoff < 1)) {
        return (complaint){"cutoff", "less than 1"};
    }
    if (!is_light(scene->ambient) || !is_light(scene->background.color) || !is_light(scene->background.top)) {
        return (complaint){"ambient light or background", "finite and not negative"};
    }
    return (complaint){NULL, NULL};
}

static mt_status complain(mt_context *context, const char *part, mt_index number, complaint c)
{
    if (number == MT_NONE) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the scene's %s%s%s is not %s", part, *part ? "'s " : "", c.what,
                       c.should);
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "the scene's %s %u: its %s is not %s", part, number, c.what, c.should);
}

mt_status mt_scene_check(mt_context *context, const mt_scene *scene, const mt_scene_options *options)
{
    complaint c = check_whole(scene);
    (void)options;
    if (c.what) {
        return complain(context, "", MT_NONE, c);
    }
    c = check_camera(&scene->camera);
    if (c.what) {
        return complain(context, "camera", MT_NONE, c);
    }
    for (mt_index i = 0; i < scene->light_count; i++) {
        if ((c = check_light(&scene->lights[i])).what) {
            return complain(context, "light", i, c);
        }
    }
    for (mt_index i = 0; i < scene->material_count; i++) {
        if ((c = check_material(&scene->materials[i])).what) {
            return complain(context, "material", i, c);
        }
    }
    for (mt_index i = 0; i < scene->object_count; i++) {
        if ((c = check_object(scene, &scene->objects[i])).what) {
            return complain(context, "object", i, c);
        }
    }
    return MT_OK;
}

mt_camera mt_scene_camera_make(const mt_scene *scene)
{
    static const double obliquities[] = {[MT_PROJECTION_PERSPECTIVE] = 0,
                                         [MT_PROJECTION_ORTHOGRAPHIC] = 0,
                                         [MT_PROJECTION_CABINET] = 0.5,
                                         [MT_PROJECTION_CAVALIER] = 1};
    const mt_scene_camera *from = &scene->camera;
    mt_camera camera = {.projection = from->projection, .eye = from->eye};
    mt_vec3 back = mt_vec3_subtract(from->eye, from->target);
    mt_vec3 up = mt_vec3_max_abs(from->up) > 0 ? from->up : mt_vec3_make(0, 1, 0);
    camera.width = scene->width ? scene->width : DEFAULT_SIZE;
    camera.height = scene->height ? scene->height : DEFAULT_SIZE;
    mt_camera_frame(&camera, back, up);
    double width = camera.width, height = camera.height, shorter = width < height ? width : height;
    if (!mt_camera_is_parallel(&camera)) {
        double degrees = from->fov_degrees > 0 ? from->fov_degrees : DEFAULT_FOV;
        double tangent = mt_tan(0.5 * degrees * (MT_PI / 180.0));
        camera.half_width = tangent * (width / shorter);
        camera.half_height = tangent * (height / shorter);
        return camera;
    }
    double distance = mt_vec3_length(back);
    camera.half_width = 0.5 * (from->width > 0 ? from->width : distance);
    camera.half_height = camera.half_width * (height / width);
    /* Rays lean, and meet the plane through the target where they would without. */
    camera.shear_x = camera.shear_y = obliquities[from->projection] * OBLIQUE_COMPONENT;
    mt_vec3 lean = mt_vec3_add(camera.right, camera.up);
    camera.eye = mt_vec3_add(camera.eye, mt_vec3_scale(lean, camera.shear_x * distance));
    return camera;
}

mt_material mt_material_default(void)
{
    mt_material material = {.color = {0.8, 0.8, 0.8},
                            .ambient = 1,
                            .diffuse = 1,
                            .exponent = 32,
                            .refractive_index = 1.5,
                            .attenuation_color = {1, 1, 1}};
    return material;
}
