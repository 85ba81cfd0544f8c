/* Lambert's cosine law and Blinn's half-vector highlight ("Models of light reflection for computer synthesized
 * pictures", 1977). Lights are superposed: the picture of a sum of lights is the sum of their pictures. */
#include "lib/render/scene_light.h"

#include "lib/render/interpolate.h"
#include <meshtool/elementary.h>

#include <math.h>

static mt_vec3 times(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static double positive(double x)
{
    return x > 0 ? x : 0.0;
}

/* A light as a point sees it. */
typedef struct arrival {
    mt_vec3 direction; /* unit, towards the light */
    mt_vec3 color;     /* less what its distance takes */
} arrival;

static arrival arrive(const mt_scene_light *light, mt_vec3 position)
{
    arrival a = {light->place, light->color};
    if (light->kind == MT_LIGHT_POINT) {
        a.direction = mt_vec3_subtract(light->place, position);
        if (light->fade > 0) {
            double ratio = mt_vec3_length(a.direction) / light->fade;
            a.color = mt_vec3_scale(a.color, 1.0 / (1.0 + ratio * ratio));
        }
    }
    a.direction = mt_unit(a.direction);
    return a;
}

/* The ray of a point light ends at it: what is behind does not darken it. */
static mt_vec3 light_through(mt_scene_tracer *tracer, const mt_scene_point *point, const mt_scene_light *light,
                             const mt_media *media)
{
    bool is_point = light->kind == MT_LIGHT_POINT;
    mt_vec3 direction = is_point ? mt_vec3_subtract(light->place, point->lifted) : mt_unit(light->place);
    mt_scene_ray ray = mt_scene_ray_from(tracer->plan, point, point->lifted, direction);
    if (is_point) {
        ray.direction = mt_vec3_subtract(light->place, ray.origin);
        ray.t_maximum = 1.0 - 0x1p-53;
    }
    return mt_scene_light_through(tracer, ray, media);
}

static double highlight_of(const mt_scene_point *point, mt_vec3 toward_light)
{
    mt_vec3 half = mt_unit(mt_vec3_add(toward_light, point->toward_eye));
    double cosine = positive(mt_vec3_dot(point->normal, half));
    return cosine > 0 ? mt_pow(cosine < 1 ? cosine : 1.0, point->material->exponent) : 0.0;
}

mt_vec3 mt_scene_light_of(mt_scene_tracer *tracer, const mt_scene_point *point, const mt_media *media)
{
    const mt_scene *scene = tracer->plan->scene;
    const mt_material *m = point->material;
    double opaque = 1.0 - m->transparency;
    bool is_glossy = mt_vec3_max_abs(m->specular) > 0, is_dull = opaque * m->diffuse > 0;
    mt_vec3 sum = times(point->color, mt_vec3_scale(scene->ambient, opaque * m->ambient));
    for (mt_index i = 0; (is_glossy || is_dull) && i < scene->light_count; i++) {
        const mt_scene_light *light = &scene->lights[i];
        arrival a = arrive(light, point->position);
        double cosine = mt_vec3_dot(point->normal, a.direction);
        if (!(cosine > 0)) {
            continue;
        }
        mt_vec3 arrives = a.color;
        if (light->casts_shadows) {
            arrives = times(arrives, light_through(tracer, point, light, media));
        }
        if (mt_vec3_max_abs(arrives) == 0) {
            continue;
        }
        sum = mt_vec3_add(sum, times(arrives, mt_vec3_scale(point->color, opaque * m->diffuse * cosine)));
        if (is_glossy) {
            sum = mt_vec3_add(sum, times(arrives, mt_vec3_scale(m->specular, highlight_of(point, a.direction))));
        }
    }
    return sum;
}

mt_vec3 mt_scene_background_light(const mt_scene_plan *plan, mt_vec3 direction)
{
    const mt_scene_background *background = &plan->scene->background;
    if (background->kind != MT_SCENE_GRADIENT) {
        return background->color;
    }
    mt_vec3 up = mt_unit(plan->scene->camera.up);
    up = mt_vec3_max_abs(up) > 0 ? up : mt_vec3_make(0, 1, 0);
    double share = 0.5 + 0.5 * mt_vec3_dot(mt_unit(direction), up);
    share = share > 0 ? (share < 1 ? share : 1.0) : 0.0;
    return mt_vec3_add(mt_vec3_scale(background->color, 1.0 - share), mt_vec3_scale(background->top, share));
}
