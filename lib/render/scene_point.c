#include "lib/render/scene_point.h"

#include "lib/render/interpolate.h"

#include <math.h>

static void flip(mt_scene_point *point)
{
    point->face_normal = mt_vec3_scale(point->face_normal, -1.0);
    point->normal = mt_vec3_scale(point->normal, -1.0);
}

/* Two directions along the plane: x and z of a floor, x and y of a wall across z. */
static void plane_axes(mt_vec3 n, mt_vec3 *u, mt_vec3 *v)
{
    bool is_flat = fabs(n.y) >= fabs(n.x) && fabs(n.y) >= fabs(n.z);
    *u = mt_unit(is_flat ? mt_vec3_cross(n, mt_vec3_make(0, 0, 1)) : mt_vec3_cross(mt_vec3_make(0, 1, 0), n));
    *v = is_flat ? mt_vec3_cross(*u, n) : mt_vec3_cross(n, *u);
}

/* Squares around the plane's point; far away, where rounding leaves nothing of them, the first colour. */
static mt_vec3 checker_color(const mt_plane *plane, const mt_material *material, mt_vec3 position)
{
    mt_vec3 u, v, at = mt_vec3_subtract(position, plane->point);
    plane_axes(mt_plane_normal(plane), &u, &v);
    double across = floor(mt_vec3_dot(at, u) / material->checker_size);
    double along = floor(mt_vec3_dot(at, v) / material->checker_size);
    double sum = across + along, half = floor(0.5 * sum);
    return isfinite(sum) && sum - 2.0 * half != 0 ? material->checker_color : material->color;
}

static void point_on_mesh(const mt_scene_plan *plan, const mt_scene_ray *ray, const mt_scene_hit *hit,
                          mt_scene_point *point)
{
    const mt_scene_object *object = &plan->scene->objects[hit->object];
    const mt_scene_part *part = mt_scene_part_of(plan, hit->object);
    const mt_transform identity = mt_transform_identity();
    bool is_placed = object->kind == MT_OBJECT_MESH;
    const mt_transform *transform = is_placed ? &object->shape.transform : &identity;
    mt_transform inverse = is_placed ? mt_scene_inverse(plan, hit->object) : identity;
    mt_vec3 direction = mt_transform_direction(&inverse, ray->direction);
    mt_part_point found = mt_scene_part_point(part, hit->triangle, hit->weights, direction);
    point->position = mt_transform_point(transform, found.position);
    point->lifted = mt_transform_point(transform, found.lifted);
    point->normal = mt_unit(mt_transform_normal(&inverse, found.normal));
    point->face_normal = mt_unit(mt_transform_normal(&inverse, found.face_normal));
    if (found.has_color) {
        point->color = found.color;
    }
}

mt_scene_point mt_scene_point_make(const mt_scene_plan *plan, const mt_scene_ray *ray, const mt_scene_hit *hit)
{
    const mt_scene_object *object = &plan->scene->objects[hit->object];
    mt_scene_point point = {.object = hit->object, .triangle = hit->triangle};
    point.material = &plan->scene->materials[object->material];
    point.color = point.material->color;
    point.position = mt_vec3_add(ray->origin, mt_vec3_scale(ray->direction, hit->t));
    point.toward_eye = mt_vec3_scale(mt_unit(ray->direction), -1.0);
    if (object->kind == MT_OBJECT_PLANE) {
        point.face_normal = point.normal = mt_plane_normal(&object->shape.plane);
        if (point.material->checker_size > 0) {
            point.color = checker_color(&object->shape.plane, point.material, point.position);
        }
    } else if (object->kind == MT_OBJECT_SPHERE) {
        point.face_normal = point.normal = mt_sphere_normal(&object->shape.sphere, point.position);
    } else {
        point_on_mesh(plan, ray, hit, &point);
    }
    bool by_formula = object->kind == MT_OBJECT_PLANE || object->kind == MT_OBJECT_SPHERE;
    point.lifted = by_formula ? point.position : point.lifted;
    point.is_front = mt_vec3_dot(point.face_normal, point.toward_eye) >= 0;
    if (!point.is_front) {
        flip(&point);
    }
    return point;
}

/* On a mesh by some units in the last place of its own floats, towards the side that the ray takes. */
static mt_vec3 offset(const mt_scene_plan *plan, const mt_scene_point *point, mt_vec3 position, mt_vec3 direction)
{
    const mt_scene_object *object = &plan->scene->objects[point->object];
    const mt_ray_space *space = &mt_scene_part_of(plan, point->object)->space;
    mt_vec3 side = mt_facing(point->face_normal, direction);
    if (object->kind == MT_OBJECT_TRIANGLE) {
        return mt_ray_offset(space, position, side);
    }
    mt_transform inverse = mt_scene_inverse(plan, point->object);
    mt_vec3 local = mt_transform_point(&inverse, position);
    /* Back to the mesh's normal: what the transpose of the inverse did is undone by that of the transform. */
    mt_vec3 local_side = mt_transform_normal(&object->shape.transform, side);
    return mt_transform_point(&object->shape.transform, mt_ray_offset(space, local, local_side));
}

mt_scene_ray mt_scene_ray_from(const mt_scene_plan *plan, const mt_scene_point *point, mt_vec3 position,
                               mt_vec3 direction)
{
    mt_scene_ray ray = {position, direction, 0, INFINITY, point->object, point->triangle};
    if (point->triangle != MT_NONE) {
        ray.origin = offset(plan, point, position, direction);
    }
    return ray;
}
