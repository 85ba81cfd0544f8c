/* A scene compiled: what of it is needed, ready to be asked. */
#ifndef MESHTOOL_RENDER_SCENE_PLAN_H
#define MESHTOOL_RENDER_SCENE_PLAN_H

#include "lib/render/frame.h"
#include "lib/render/scene_part.h"

#include <meshtool/aabb_tree.h>

typedef struct mt_scene_plan {
    const mt_scene *scene;
    mt_scene_options options;
    mt_camera camera;
    double cutoff;
    unsigned depth_limit;
    unsigned samples, fine_samples; /* fine: where the picture changes; 0: as everywhere */
    bool has_shadows;               /* a light casts some, and something can catch them */
    bool has_glass;
    bool has_followers; /* rays follow the first: mirrors or glass */
    mt_index plane_count;
    struct mt_scene_plane {
        mt_plane plane; /* its normal a unit vector */
        mt_index object;
    } * planes;
    /* What has bounds: numbers of objects, but for all loose triangles one that is the count of objects. */
    mt_index item_count;
    mt_aabb_tree *items;
    mt_transform *inverses; /* per object, for meshes; NULL: found again for each ray */
    mt_index part_count;    /* the scene's meshes, and one of the loose triangles where there are any */
    mt_scene_part *parts;
    mt_mesh *loose; /* all triangles that are objects, as one mesh; NULL: none */
    mt_index *loose_objects;
    uint64_t triangle_count; /* instances counted each */
} mt_scene_plan;

/* MT_ERROR_ARGUMENT for what is out of its range. */
mt_status mt_scene_check(mt_context *context, const mt_scene *scene, const mt_scene_options *options);

/* The camera of a checked scene. */
mt_camera mt_scene_camera_make(const mt_scene *scene);

/* Compiles a checked scene; parts are built later, when they are wanted. */
mt_status mt_scene_plan_init(mt_context *context, const mt_scene *scene, const mt_scene_options *options,
                             mt_scene_plan *plan);
void mt_scene_plan_release(mt_context *context, mt_scene_plan *plan);

/* Builds the parts that rays have asked for; *any: there were some. */
mt_status mt_scene_plan_build_wanted(mt_context *context, mt_scene_plan *plan, bool *any);

/* The part of an item or a mesh object. */
static inline mt_scene_part *mt_scene_part_of(const mt_scene_plan *plan, mt_index item)
{
    bool is_loose = item >= plan->scene->object_count || plan->scene->objects[item].kind == MT_OBJECT_TRIANGLE;
    return &plan->parts[is_loose ? plan->scene->mesh_count : plan->scene->objects[item].mesh];
}

/* From the scene into the coordinates of a mesh object, and whether these differ. */
static inline mt_transform mt_scene_inverse(const mt_scene_plan *plan, mt_index object)
{
    mt_transform inverse;
    if (plan->inverses) {
        return plan->inverses[object];
    }
    mt_transform_inverse(&plan->scene->objects[object].shape.transform, &inverse);
    return inverse;
}

static inline mt_vec3 mt_transform_direction(const mt_transform *t, mt_vec3 v)
{
    return mt_vec3_make(t->linear[0][0] * v.x + t->linear[0][1] * v.y + t->linear[0][2] * v.z,
                        t->linear[1][0] * v.x + t->linear[1][1] * v.y + t->linear[1][2] * v.z,
                        t->linear[2][0] * v.x + t->linear[2][1] * v.y + t->linear[2][2] * v.z);
}

/* A normal goes with the transpose of the way back. */
static inline mt_vec3 mt_transform_normal(const mt_transform *inverse, mt_vec3 n)
{
    return mt_vec3_make(inverse->linear[0][0] * n.x + inverse->linear[1][0] * n.y + inverse->linear[2][0] * n.z,
                        inverse->linear[0][1] * n.x + inverse->linear[1][1] * n.y + inverse->linear[2][1] * n.z,
                        inverse->linear[0][2] * n.x + inverse->linear[1][2] * n.y + inverse->linear[2][2] * n.z);
}

#endif
