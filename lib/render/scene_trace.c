/* Boxes of objects are culled by an aabb tree; a mesh is then met in its own coordinates, where t is the same, as the
 * direction is carried over with its length. Invariant: all that could be hit at a t up to the best one is asked; the
 * nearest wins, at equal t the first object, so that the order of the walk does not matter. */
#include "lib/render/scene_trace.h"

#include <meshtool/elementary.h>

#include <math.h>

/* Median splits keep the tree so shallow; and what waits is one brother a level. */
#define STACK_SIZE 128

/* Surfaces that a shadow ray passes at most; beyond, no light is left. */
#define CROSSING_LIMIT 256

/* Rounding of the distances to a box, as parts of themselves. */
#define BOX_ROUNDING 0x1p-48

/* A ray in the frame of the tree. */
typedef struct box_ray {
    double origin[3], inverse[3];
} box_ray;

static box_ray box_ray_of(const mt_aabb_tree *tree, const mt_scene_ray *ray)
{
    box_ray r;
    const double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double c[3] = {tree->center.x, tree->center.y, tree->center.z};
    for (int axis = 0; axis < 3; axis++) {
        r.origin[axis] = o[axis] * tree->scale - c[axis];
        r.inverse[axis] = 1.0 / (d[axis] * tree->scale);
    }
    return r;
}

/* Whether the ray is inside the box somewhere between `from` and `to`; *near receives where it enters. Comparisons with
 * the NaN of 0 times infinity leave the bounds as they are. */
static bool meets_box(const box_ray *ray, const float lower[3], const float upper[3], double from, double to,
                      double *near)
{
    for (int axis = 0; axis < 3; axis++) {
        double a = ((double)lower[axis] - ray->origin[axis]) * ray->inverse[axis];
        double b = ((double)upper[axis] - ray->origin[axis]) * ray->inverse[axis];
        double first = a < b ? a : b, last = a < b ? b : a;
        first -= fabs(first) * BOX_ROUNDING;
        last += fabs(last) * BOX_ROUNDING;
        from = first > from ? first : from;
        to = last < to ? last : to;
    }
    *near = from;
    return from <= to;
}

/* The item's part, or NULL with the tracer blocked when it is not built yet. */
static const mt_scene_part *built_part(mt_scene_tracer *tracer, mt_index item)
{
    mt_scene_part *part = mt_scene_part_of(tracer->plan, item);
    if (!part->is_built) {
        __atomic_store_n(&part->is_wanted, 1, __ATOMIC_RELAXED);
        tracer->is_blocked = true;
        return NULL;
    }
    return part;
}

static mt_ray local_ray(const mt_scene_plan *plan, mt_index item, const mt_scene_ray *ray)
{
    mt_ray local = {ray->origin, ray->direction, ray->t_minimum, ray->t_maximum, MT_NONE};
    if (item < plan->scene->object_count) {
        mt_transform inverse = mt_scene_inverse(plan, item);
        local.origin = mt_transform_point(&inverse, ray->origin);
        local.direction = mt_transform_direction(&inverse, ray->direction);
        local.skip = ray->skip_object == item ? ray->skip_triangle : MT_NONE;
    } else if (ray->skip_object != MT_NONE && plan->scene->objects[ray->skip_object].kind == MT_OBJECT_TRIANGLE) {
        local.skip = ray->skip_triangle;
    }
    return local;
}

static bool hit_sphere(const mt_scene_plan *plan, mt_index object, const mt_scene_ray *ray, double *t)
{
    const mt_sphere *sphere = &plan->scene->objects[object].shape.sphere;
    mt_ray plain = {ray->origin, ray->direction, ray->t_minimum, ray->t_maximum, MT_NONE};
    return ray->skip_object == object ? mt_sphere_hit_again(sphere, &plain, t) : mt_sphere_hit(sphere, &plain, t);
}

static bool is_sphere(const mt_scene_plan *plan, mt_index item)
{
    return item < plan->scene->object_count && plan->scene->objects[item].kind == MT_OBJECT_SPHERE;
}

static mt_scene_hit hit_item(mt_scene_tracer *tracer, mt_index item, const mt_scene_ray *ray)
{
    const mt_scene_plan *plan = tracer->plan;
    mt_scene_hit hit = mt_scene_no_hit();
    if (is_sphere(plan, item)) {
        hit.object = hit_sphere(plan, item, ray, &hit.t) ? item : MT_NONE;
        hit.t = hit.object == MT_NONE ? (double)INFINITY : hit.t;
        return hit;
    }
    const mt_scene_part *part = built_part(tracer, item);
    if (!part) {
        return hit;
    }
    const mt_ray local = local_ray(plan, item, ray);
    mt_ray_hit found = mt_scene_part_nearest(part, &local);
    if (found.triangle != MT_NONE) {
        bool is_loose = item >= plan->scene->object_count;
        hit = (mt_scene_hit){found.t,
                             is_loose ? plan->loose_objects[found.triangle] : item,
                             found.triangle,
                             {found.weights[0], found.weights[1], found.weights[2]}};
    }
    return hit;
}

static bool item_hides(mt_scene_tracer *tracer, mt_index item, const mt_scene_ray *ray)
{
    double t;
    if (is_sphere(tracer->plan, item)) {
        return hit_sphere(tracer->plan, item, ray, &t);
    }
    const mt_scene_part *part = built_part(tracer, item);
    const mt_ray local = local_ray(tracer->plan, item, ray);
    return part && mt_scene_part_any(part, &local);
}

/* A walk through the tree of items: mt_walk_next gives the leaves that may hold a hit up to t, near ones first. */
typedef struct walk {
    const mt_aabb_tree *tree;
    box_ray ray;
    double from;
    struct {
        double near;
        mt_index node;
    } stack[STACK_SIZE];
    int depth;
} walk;

static void walk_begin(walk *w, const mt_aabb_tree *tree, const mt_scene_ray *ray)
{
    double near;
    w->tree = tree;
    w->ray = box_ray_of(tree, ray);
    w->from = ray->t_minimum;
    w->depth = 0;
    if (tree->node_count > 0 &&
        meets_box(&w->ray, tree->nodes[0].lower, tree->nodes[0].upper, w->from, ray->t_maximum, &near)) {
        w->stack[0].near = near;
        w->stack[0].node = 0;
        w->depth = 1;
    }
}

static void walk_push(walk *w, mt_index first, double to)
{
    double near[2];
    bool meets[2];
    for (mt_index i = 0; i < 2; i++) {
        const mt_aabb_node *child = &w->tree->nodes[first + i];
        meets[i] = meets_box(&w->ray, child->lower, child->upper, w->from, to, &near[i]);
    }
    mt_index farther = near[1] >= near[0] ? 1 : 0;
    for (int i = 0; i < 2; i++) {
        mt_index which = i == 0 ? farther : 1 - farther;
        if (meets[which] && w->depth < STACK_SIZE) {
            w->stack[w->depth].near = near[which];
            w->stack[w->depth++].node = first + which;
        }
    }
}

/* The next leaf, or NULL. */
static const mt_aabb_node *walk_next(walk *w, double to)
{
    while (w->depth > 0) {
        w->depth--;
        const mt_aabb_node *node = &w->tree->nodes[w->stack[w->depth].node];
        if (!(w->stack[w->depth].near <= to)) {
            continue;
        }
        if (node->count > 0) {
            return node;
        }
        walk_push(w, node->first, to);
    }
    return NULL;
}

static bool meets_item(const walk *w, const mt_aabb_primitive *item, double to)
{
    double near;
    return meets_box(&w->ray, item->lower, item->upper, w->from, to, &near);
}

void mt_scene_nearest_plane(const mt_scene_plan *plan, const mt_scene_ray *ray, mt_scene_hit *best)
{
    for (mt_index i = 0; i < plan->plane_count; i++) {
        const mt_plane *plane = &plan->planes[i].plane;
        mt_scene_hit hit = mt_scene_no_hit();
        hit.object = plan->planes[i].object;
        double toward = mt_vec3_dot(plane->normal, ray->direction);
        hit.t = mt_vec3_dot(plane->normal, mt_vec3_subtract(plane->point, ray->origin)) / toward;
        bool is_hit = toward != 0 && hit.t >= ray->t_minimum && hit.t <= ray->t_maximum && isfinite(hit.t);
        if (is_hit && hit.object != ray->skip_object && mt_scene_is_nearer(&hit, best)) {
            *best = hit;
        }
    }
}

static mt_scene_hit nearest(mt_scene_tracer *tracer, const mt_scene_ray *ray, bool with_meshes)
{
    mt_scene_hit best = mt_scene_no_hit();
    mt_scene_nearest_plane(tracer->plan, ray, &best);
    if (!tracer->plan->items) {
        return best;
    }
    walk w;
    mt_scene_ray shorter = *ray;
    shorter.t_maximum = best.t < ray->t_maximum ? best.t : ray->t_maximum;
    walk_begin(&w, tracer->plan->items, &shorter);
    for (const mt_aabb_node *leaf; (leaf = walk_next(&w, shorter.t_maximum));) {
        for (mt_index i = 0; i < leaf->count; i++) {
            const mt_aabb_primitive *item = &tracer->plan->items->primitives[leaf->first + i];
            bool is_asked = with_meshes || is_sphere(tracer->plan, item->number);
            if (is_asked && meets_item(&w, item, shorter.t_maximum)) {
                mt_scene_hit hit = hit_item(tracer, item->number, &shorter);
                best = mt_scene_is_nearer(&hit, &best) ? hit : best;
                shorter.t_maximum = best.t < shorter.t_maximum ? best.t : shorter.t_maximum;
            }
        }
    }
    return best;
}

mt_scene_hit mt_scene_nearest(mt_scene_tracer *tracer, const mt_scene_ray *ray)
{
    return nearest(tracer, ray, true);
}

mt_scene_hit mt_scene_nearest_formula(const mt_scene_plan *plan, const mt_scene_ray *ray)
{
    mt_scene_tracer tracer = {.plan = plan};
    return nearest(&tracer, ray, false);
}

static bool is_hidden(mt_scene_tracer *tracer, const mt_scene_ray *ray)
{
    mt_scene_hit hit = mt_scene_no_hit();
    mt_scene_nearest_plane(tracer->plan, ray, &hit);
    if (hit.object != MT_NONE) {
        return true;
    }
    walk w;
    w.depth = 0;
    if (tracer->plan->items) {
        walk_begin(&w, tracer->plan->items, ray);
    }
    for (const mt_aabb_node *leaf; (leaf = walk_next(&w, ray->t_maximum));) {
        for (mt_index i = 0; i < leaf->count; i++) {
            const mt_aabb_primitive *item = &tracer->plan->items->primitives[leaf->first + i];
            if (meets_item(&w, item, ray->t_maximum) && item_hides(tracer, item->number, ray)) {
                return true;
            }
        }
    }
    return false;
}

static double left_of(double color, double share)
{
    return color > 0 ? mt_pow(color, share) : 0.0;
}

mt_vec3 mt_scene_attenuation(const mt_scene_plan *plan, mt_index object, double way)
{
    const mt_material *material = &plan->scene->materials[plan->scene->objects[object].material];
    mt_vec3 c = material->attenuation_color;
    if (!(material->attenuation_distance > 0) || !(way > 0)) {
        return mt_vec3_make(1, 1, 1);
    }
    double share = way / material->attenuation_distance;
    return mt_vec3_make(left_of(c.x, share), left_of(c.y, share), left_of(c.z, share));
}

static mt_vec3 times(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_make(a.x * b.x, a.y * b.y, a.z * b.z);
}

/* Whether the ray comes from the front of what it hit. */
static bool hits_front(const mt_scene_plan *plan, const mt_scene_ray *ray, const mt_scene_hit *hit)
{
    const mt_scene_object *object = &plan->scene->objects[hit->object];
    if (object->kind == MT_OBJECT_PLANE) {
        return mt_vec3_dot(object->shape.plane.normal, ray->direction) < 0;
    }
    if (object->kind == MT_OBJECT_SPHERE) {
        mt_vec3 p = mt_vec3_add(ray->origin, mt_vec3_scale(ray->direction, hit->t));
        return mt_vec3_dot(mt_sphere_normal(&object->shape.sphere, p), ray->direction) < 0;
    }
    mt_vec3 direction = ray->direction;
    if (object->kind == MT_OBJECT_MESH) {
        mt_transform inverse = mt_scene_inverse(plan, hit->object);
        direction = mt_transform_direction(&inverse, direction);
    }
    const mt_scene_part *part = mt_scene_part_of(plan, hit->object);
    mt_part_point point = mt_scene_part_point(part, hit->triangle, hit->weights, direction);
    return mt_vec3_dot(point.face_normal, direction) < 0;
}

/* The ways inside glass along a shadow ray, one entry an object: a way in counts from where it begins, a way out to
 * where it ends. */
typedef struct ways {
    mt_index count;
    mt_index objects[2 * MT_MEDIA_ROOM];
    double lengths[2 * MT_MEDIA_ROOM];
    int inside[2 * MT_MEDIA_ROOM];
} ways;

static void add_way(ways *w, mt_index object, double at, int change)
{
    mt_index i = 0;
    while (i < w->count && w->objects[i] != object) {
        i++;
    }
    if (i == 2 * MT_MEDIA_ROOM) {
        return;
    }
    if (i == w->count) {
        w->objects[w->count++] = object;
        w->lengths[i] = 0;
        w->inside[i] = 0;
    }
    w->lengths[i] -= change * at;
    w->inside[i] += change;
}

static mt_vec3 attenuate(const mt_scene_plan *plan, ways *w, double end, double unit)
{
    mt_vec3 left = mt_vec3_make(1, 1, 1);
    for (mt_index i = 0; i < w->count; i++) {
        double length = w->lengths[i] + (w->inside[i] > 0 && isfinite(end) ? w->inside[i] * end : 0.0);
        left = times(left, mt_scene_attenuation(plan, w->objects[i], length * unit));
    }
    return left;
}

mt_vec3 mt_scene_light_through(mt_scene_tracer *tracer, mt_scene_ray ray, const mt_media *media)
{
    const mt_scene_plan *plan = tracer->plan;
    const mt_vec3 none = mt_vec3_make(0, 0, 0);
    tracer->shadow_rays++;
    if (!plan->has_glass) {
        return is_hidden(tracer, &ray) ? none : mt_vec3_make(1, 1, 1);
    }
    double passed = 1;
    ways inside = {.count = 0};
    for (mt_index i = 0; i < media->count; i++) {
        add_way(&inside, media->objects[i], 0, 1);
    }
    for (int crossing = 0; crossing < CROSSING_LIMIT; crossing++) {
        mt_scene_hit hit = mt_scene_nearest(tracer, &ray);
        if (hit.object == MT_NONE) {
            mt_vec3 left = attenuate(plan, &inside, ray.t_maximum, mt_vec3_length(ray.direction));
            return mt_vec3_scale(left, passed);
        }
        const mt_material *material = &plan->scene->materials[plan->scene->objects[hit.object].material];
        passed *= material->transparency;
        if (!(passed > 0)) {
            return none;
        }
        add_way(&inside, hit.object, hit.t, hits_front(plan, &ray, &hit) ? 1 : -1);
        ray.t_minimum = nextafter(hit.t, (double)INFINITY);
    }
    return none;
}
