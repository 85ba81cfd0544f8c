/* Whitted's tree of rays, walked depth first on a stack of bounded size: a ray that is taken off leaves at most two, of
 * which one is taken next, so that no more than one a level waits. The order of the sum is fixed. */
#include "lib/render/scene_path.h"

#include "lib/render/interpolate.h"
#include "lib/render/scene_light.h"

#include <math.h>

typedef struct mt_scene_pending {
    mt_scene_ray ray;
    mt_vec3 weight; /* what of its light arrives at the eye */
    unsigned depth; /* rays before it */
    mt_media media;
} pending;

uint64_t mt_scene_stack_size(unsigned depth_limit)
{
    return ((uint64_t)depth_limit + 2) * sizeof(pending);
}

static mt_vec3 times(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

static mt_vec3 reflect(mt_vec3 direction, mt_vec3 normal)
{
    return mt_vec3_subtract(direction, mt_vec3_scale(normal, 2.0 * mt_vec3_dot(direction, normal)));
}

/* A shading normal may send a ray into the surface that it should leave; then the flat one decides. */
static mt_vec3 reflected_direction(const mt_scene_point *point)
{
    mt_vec3 direction = mt_vec3_scale(point->toward_eye, -1.0), away = reflect(direction, point->normal);
    return mt_unit(mt_vec3_dot(away, point->face_normal) > 0 ? away : reflect(direction, point->face_normal));
}

/* What happens to light where one medium meets another: Snell's law, and Fresnel's for light that is not polarised. */
typedef struct passage {
    mt_vec3 direction; /* refracted, unit */
    double reflected;  /* share of the light; 1: total reflection, and there is no direction */
} passage;

static passage pass(mt_vec3 direction, mt_vec3 normal, double from, double to)
{
    passage p = {direction, 0};
    double ratio = from / to, cosine = -mt_vec3_dot(direction, normal);
    double sine_squared = ratio * ratio * (1.0 - cosine * cosine);
    if (from == to) {
        return p;
    }
    if (!(sine_squared < 1.0)) {
        p.reflected = 1;
        return p;
    }
    double beyond = sqrt(1.0 - sine_squared);
    p.direction = mt_unit(mt_vec3_add(mt_vec3_scale(direction, ratio), mt_vec3_scale(normal, ratio * cosine - beyond)));
    double across = (from * cosine - to * beyond) / (from * cosine + to * beyond);
    double along = (from * beyond - to * cosine) / (from * beyond + to * cosine);
    p.reflected = 0.5 * (across * across + along * along);
    return p;
}

static double index_of(const mt_scene_plan *plan, mt_index object)
{
    return plan->scene->materials[plan->scene->objects[object].material].refractive_index;
}

static double index_within(const mt_scene_plan *plan, const mt_media *media)
{
    return media->count > 0 ? index_of(plan, media->objects[media->count - 1]) : 1.0;
}

/* Deeper nesting than there is room for is forgotten; leaving what was never entered changes nothing. */
static void enter_or_leave(mt_media *media, mt_index object, bool enters)
{
    if (enters) {
        if (media->count < MT_MEDIA_ROOM) {
            media->objects[media->count++] = object;
        }
        return;
    }
    mt_index at = media->count;
    while (at > 0 && media->objects[at - 1] != object) {
        at--;
    }
    for (mt_index i = at; at > 0 && i < media->count; i++) {
        media->objects[i - 1] = media->objects[i];
    }
    media->count -= at > 0;
}

/* The way of light through the point, and in *beyond the media on its other side. */
static passage through(const mt_scene_plan *plan, const mt_scene_point *point, const mt_media *media, mt_media *beyond)
{
    mt_vec3 direction = mt_vec3_scale(point->toward_eye, -1.0);
    passage straight = {direction, 0};
    *beyond = *media;
    if (plan->scene->objects[point->object].kind == MT_OBJECT_TRIANGLE) {
        return straight;
    }
    enter_or_leave(beyond, point->object, point->is_front);
    bool was_entered = point->is_front || beyond->count < media->count;
    double from = was_entered ? index_within(plan, media) : index_of(plan, point->object);
    double to = index_within(plan, beyond);
    passage p = pass(direction, point->normal, from, to);
    bool goes_through = p.reflected < 1 && mt_vec3_dot(p.direction, point->face_normal) < 0;
    return goes_through || p.reflected >= 1 ? p : pass(direction, point->face_normal, from, to);
}

static bool is_worth(const mt_scene_plan *plan, mt_vec3 weight)
{
    double most = mt_vec3_max_abs(weight);
    return most > 0 && most >= plan->cutoff;
}

static void push(mt_scene_tracer *tracer, size_t *count, const pending *from, const mt_scene_point *point,
                 mt_vec3 direction, mt_vec3 weight, const mt_media *media)
{
    pending *next = &tracer->stack[(*count)++];
    next->ray = mt_scene_ray_from(tracer->plan, point, point->position, direction);
    next->weight = weight;
    next->depth = from->depth + 1;
    next->media = *media;
}

/* Leaves the rays that go on from a point on the stack. */
static void follow(mt_scene_tracer *tracer, size_t *count, const pending *from, const mt_scene_point *point)
{
    const mt_scene_plan *plan = tracer->plan;
    const mt_material *material = point->material;
    mt_vec3 mirrored = material->mirror;
    if (from->depth >= plan->depth_limit) {
        return;
    }
    if (material->transparency > 0) {
        mt_media beyond;
        passage p = through(plan, point, &from->media, &beyond);
        mt_vec3 weight = mt_vec3_scale(from->weight, material->transparency * (1.0 - p.reflected));
        double share = material->transparency * p.reflected;
        mirrored = mt_vec3_add(mirrored, mt_vec3_make(share, share, share));
        if (is_worth(plan, weight)) {
            tracer->refracted_rays++;
            push(tracer, count, from, point, p.direction, weight, &beyond);
        }
    }
    mt_vec3 weight = times(from->weight, mirrored);
    if (is_worth(plan, weight)) {
        tracer->reflected_rays++;
        push(tracer, count, from, point, reflected_direction(point), weight, &from->media);
    }
}

static mt_vec3 light_at(mt_scene_tracer *tracer, const pending *at, const mt_scene_hit *hit, size_t *waiting)
{
    const mt_scene_plan *plan = tracer->plan;
    pending here = *at;
    if (here.media.count > 0) {
        mt_index medium = here.media.objects[here.media.count - 1];
        here.weight = times(here.weight, mt_scene_attenuation(plan, medium, hit->t));
    }
    if (hit->object == MT_NONE) {
        return times(here.weight, mt_scene_background_light(plan, here.ray.direction));
    }
    mt_scene_point point = mt_scene_point_make(plan, &here.ray, hit);
    mt_vec3 light = times(here.weight, mt_scene_light_of(tracer, &point, &here.media));
    if (tracer->stack) {
        follow(tracer, waiting, &here, &point);
    }
    return light;
}

mt_scene_sample mt_scene_sample_of(mt_scene_tracer *tracer, const mt_scene_ray *ray, const mt_scene_hit *first)
{
    mt_scene_sample sample = {{0, 0, 0}, 1};
    if (first->object == MT_NONE && tracer->plan->scene->background.kind == MT_SCENE_TRANSPARENT) {
        sample.alpha = 0;
        return sample;
    }
    pending here = {*ray, {1, 1, 1}, 0, {0, {0}}};
    size_t waiting = 0;
    sample.light = light_at(tracer, &here, first, &waiting);
    while (waiting > 0 && !tracer->is_blocked) {
        here = tracer->stack[--waiting];
        mt_scene_hit hit = mt_scene_nearest(tracer, &here.ray);
        sample.light = mt_vec3_add(sample.light, light_at(tracer, &here, &hit, &waiting));
    }
    return sample;
}
