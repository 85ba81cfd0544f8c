/* What a scene requires is read off its lights and materials; nothing else is built. Meshes wait until a ray enters
 * their box. */
#include "lib/render/scene_plan.h"

#include <float.h>
#include <string.h>

/* With more objects than this the way back into each is found again for each ray that comes near: 96 bytes an object
 * are worth more than the 30 operations. */
#define MOST_INVERSES 1024

static float round_out(double x, bool up)
{
    float f = (float)x;
    if (up ? (double)f < x : (double)f > x) {
        f = nextafterf(f, up ? INFINITY : -INFINITY);
    }
    return f;
}

static bool is_followed(const mt_material *material)
{
    return material->transparency > 0 || mt_vec3_max_abs(material->mirror) > 0;
}

static void find_requirements(mt_scene_plan *plan)
{
    const mt_scene *scene = plan->scene;
    for (mt_index i = 0; i < scene->object_count; i++) {
        const mt_material *material = &scene->materials[scene->objects[i].material];
        plan->has_glass = plan->has_glass || material->transparency > 0;
        plan->has_followers = plan->has_followers || is_followed(material);
    }
    for (mt_index i = 0; i < scene->light_count; i++) {
        plan->has_shadows = plan->has_shadows || scene->lights[i].casts_shadows;
    }
}

/* All triangles that are objects, as one mesh. */
static mt_status gather_loose(mt_context *context, mt_scene_plan *plan, mt_index count)
{
    const mt_scene *scene = plan->scene;
    mt_mesh_layout layout = {
        .vertex_count = 3 * (uint64_t)count, .face_count = count, .face_size = 3, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, &plan->loose);
    plan->loose_objects = status == MT_OK ? (mt_index *)mt_allocate_array(context, count, sizeof(mt_index)) : NULL;
    if (!plan->loose_objects) {
        return mt_context_error(context)->status;
    }
    mt_index triangle = 0;
    for (mt_index i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].kind != MT_OBJECT_TRIANGLE) {
            continue;
        }
        for (mt_index side = 0; side < 3; side++) {
            mt_index corner = 3 * triangle + side;
            plan->loose->corner_vertices[corner] = corner;
            mt_mesh_set_position(plan->loose, corner, scene->objects[i].shape.triangle.corners[side]);
        }
        plan->loose_objects[triangle++] = i;
    }
    return MT_OK;
}

static mt_status make_parts(mt_context *context, mt_scene_plan *plan)
{
    const mt_scene *scene = plan->scene;
    uint64_t count = (uint64_t)scene->mesh_count + (plan->loose != NULL);
    plan->parts = (mt_scene_part *)mt_allocate_array_zeroed(context, count, sizeof *plan->parts);
    if (!plan->parts) {
        return mt_context_error(context)->status;
    }
    plan->part_count = (mt_index)count;
    const mt_scene_mesh loose = {.mesh = plan->loose, .shading = MT_SHADING_FLAT};
    for (mt_index i = 0; i < plan->part_count; i++) {
        const mt_scene_mesh *source = i < scene->mesh_count ? &scene->meshes[i] : &loose;
        mt_scene_part_init(source, &plan->options, &plan->parts[i]);
        if (plan->parts[i].bounds.finite_count == 0) {
            return mt_fail(context, MT_ERROR_INVALID_MESH, "the scene's mesh %u has no finite vertex", i);
        }
    }
    return MT_OK;
}

static void widen(double box[6], mt_vec3 p)
{
    const double at[3] = {p.x, p.y, p.z};
    for (int axis = 0; axis < 3; axis++) {
        box[axis] = at[axis] < box[axis] ? at[axis] : box[axis];
        box[3 + axis] = at[axis] > box[3 + axis] ? at[axis] : box[3 + axis];
    }
}

/* The box of an item: of the corners of its own box, carried into the scene. */
static void find_box(const mt_scene_plan *plan, mt_index item, double box[6])
{
    const mt_scene_object *object = item < plan->scene->object_count ? &plan->scene->objects[item] : NULL;
    bool is_sphere = object && object->kind == MT_OBJECT_SPHERE;
    mt_bounds bounds = is_sphere ? mt_sphere_bounds(&object->shape.sphere) : mt_scene_part_of(plan, item)->bounds;
    for (int axis = 0; axis < 3; axis++) {
        box[axis] = INFINITY;
        box[3 + axis] = -INFINITY;
    }
    for (int corner = 0; corner < 8 && bounds.minimum.x <= bounds.maximum.x; corner++) {
        mt_vec3 p = mt_vec3_make(corner & 1 ? bounds.maximum.x : bounds.minimum.x,
                                 corner & 2 ? bounds.maximum.y : bounds.minimum.y,
                                 corner & 4 ? bounds.maximum.z : bounds.minimum.z);
        widen(box, object && !is_sphere ? mt_transform_point(&object->shape.transform, p) : p);
    }
}

static bool has_box(const mt_scene_object *object)
{
    return object->kind == MT_OBJECT_SPHERE || object->kind == MT_OBJECT_MESH;
}

static bool is_item(const mt_scene_plan *plan, mt_index i)
{
    return i < plan->scene->object_count ? has_box(&plan->scene->objects[i]) : plan->loose != NULL;
}

/* Floats hold the boxes of any usual scene, rounded outwards, in half the bytes. */
static mt_type box_type(const mt_scene_plan *plan)
{
    double largest = 0, box[6];
    for (mt_index i = 0; i <= plan->scene->object_count; i++) {
        if (is_item(plan, i)) {
            find_box(plan, i, box);
            for (int k = 0; k < 6; k++) {
                largest = isfinite(box[k]) ? fmax(largest, fabs(box[k])) : largest;
            }
        }
    }
    return largest < (double)FLT_MAX ? MT_F32 : MT_F64;
}

static void store_box(mt_mesh *spans, mt_index number, const double box[6])
{
    for (int k = 0; k < 6; k++) {
        size_t at = 6 * (size_t)number + (size_t)k;
        if (spans->position_type == MT_F64) {
            ((double *)spans->positions)[at] = box[k];
        } else {
            ((float *)spans->positions)[at] = round_out(box[k], k >= 3);
        }
    }
    spans->corner_vertices[3 * number] = spans->corner_vertices[3 * number + 2] = 2 * number;
    spans->corner_vertices[3 * number + 1] = 2 * number + 1;
}

/* The tree of boxes is made by handing it a "triangle" for each item that spans its box. */
static mt_status make_items(mt_context *context, mt_scene_plan *plan)
{
    mt_mesh_layout layout = {.vertex_count = 2 * (uint64_t)plan->item_count,
                             .face_count = plan->item_count,
                             .face_size = 3,
                             .position_type = box_type(plan)};
    mt_mesh *spans = NULL;
    mt_status status = mt_mesh_create(context, &layout, &spans);
    mt_index count = 0;
    for (mt_index i = 0; status == MT_OK && i <= plan->scene->object_count; i++) {
        if (is_item(plan, i)) {
            double box[6];
            find_box(plan, i, box);
            store_box(spans, count++, box);
        }
    }
    const mt_triangulation triangles = {count, NULL, NULL};
    if (status == MT_OK) {
        status = mt_aabb_tree_create(context, spans, &triangles, NULL, &plan->items);
    }
    mt_mesh_destroy(context, spans);
    return status;
}

/* The tree numbers items from 0; from here on they are objects. */
static void name_items(mt_scene_plan *plan, const mt_index *objects)
{
    for (mt_index i = 0; i < plan->items->primitive_count; i++) {
        plan->items->primitives[i].number = objects[plan->items->primitives[i].number];
    }
}

static mt_status sort_items(mt_context *context, mt_scene_plan *plan)
{
    const mt_scene *scene = plan->scene;
    mt_index *objects = (mt_index *)mt_allocate_array(context, plan->item_count, sizeof *objects), count = 0;
    if (!objects) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i <= scene->object_count; i++) {
        if (is_item(plan, i)) {
            objects[count++] = i;
        }
    }
    mt_status status = make_items(context, plan);
    if (status == MT_OK) {
        name_items(plan, objects);
    }
    mt_free(context, objects);
    return status;
}

static mt_status make_planes(mt_context *context, mt_scene_plan *plan, mt_index count)
{
    plan->planes = (struct mt_scene_plane *)mt_allocate_array(context, count, sizeof *plan->planes);
    if (!plan->planes) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < plan->scene->object_count; i++) {
        if (plan->scene->objects[i].kind == MT_OBJECT_PLANE) {
            const mt_plane *plane = &plan->scene->objects[i].shape.plane;
            plan->planes[plan->plane_count].plane = (mt_plane){plane->point, mt_plane_normal(plane)};
            plan->planes[plan->plane_count++].object = i;
        }
    }
    return MT_OK;
}

static mt_status make_inverses(mt_context *context, mt_scene_plan *plan, mt_index mesh_objects)
{
    const mt_scene *scene = plan->scene;
    if (mesh_objects == 0) {
        return MT_OK;
    }
    if (scene->object_count > MOST_INVERSES) {
        mt_part_skip(context, "inverse transforms", "many objects: found again for each ray, to save their bytes");
        return MT_OK;
    }
    plan->inverses = (mt_transform *)mt_allocate_array_zeroed(context, scene->object_count, sizeof *plan->inverses);
    if (!plan->inverses) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].kind == MT_OBJECT_MESH) {
            mt_transform_inverse(&scene->objects[i].shape.transform, &plan->inverses[i]);
        }
    }
    return MT_OK;
}

static mt_status compile(mt_context *context, mt_scene_plan *plan)
{
    const mt_scene *scene = plan->scene;
    mt_index counts[4] = {0};
    for (mt_index i = 0; i < scene->object_count; i++) {
        counts[scene->objects[i].kind]++;
    }
    find_requirements(plan);
    plan->item_count = counts[MT_OBJECT_SPHERE] + counts[MT_OBJECT_MESH] + (counts[MT_OBJECT_TRIANGLE] > 0);
    mt_status status = make_planes(context, plan, counts[MT_OBJECT_PLANE]);
    if (status == MT_OK && counts[MT_OBJECT_TRIANGLE] > 0) {
        status = gather_loose(context, plan, counts[MT_OBJECT_TRIANGLE]);
    }
    if (status == MT_OK) {
        status = make_parts(context, plan);
    }
    if (status == MT_OK && plan->item_count > 0) {
        status = sort_items(context, plan);
    }
    return status == MT_OK ? make_inverses(context, plan, counts[MT_OBJECT_MESH]) : status;
}

mt_status mt_scene_plan_init(mt_context *context, const mt_scene *scene, const mt_scene_options *options,
                             mt_scene_plan *plan)
{
    memset(plan, 0, sizeof *plan);
    plan->scene = scene;
    plan->options = *options;
    plan->camera = mt_scene_camera_make(scene);
    plan->cutoff = scene->cutoff != 0 ? scene->cutoff : MT_SCENE_DEFAULT_CUTOFF;
    plan->depth_limit = scene->depth_limit ? scene->depth_limit : MT_SCENE_DEFAULT_DEPTH;
    bool adaptive = scene->samples == MT_SAMPLES_ADAPTIVE;
    plan->samples = adaptive ? 4 : scene->samples ? scene->samples : 16;
    plan->fine_samples = adaptive ? 64 : 0;
    int part = mt_part_begin(context, "objects", "boxes around them, and the tree over these");
    mt_status status = compile(context, plan);
    mt_part_end(context, part);
    if (status != MT_OK) {
        mt_scene_plan_release(context, plan);
    }
    return status;
}

void mt_scene_plan_release(mt_context *context, mt_scene_plan *plan)
{
    for (mt_index i = 0; i < plan->part_count; i++) {
        mt_scene_part_release(context, &plan->parts[i]);
    }
    mt_free(context, plan->parts);
    mt_aabb_tree_destroy(context, plan->items);
    mt_free(context, plan->inverses);
    mt_free(context, plan->planes);
    mt_free(context, plan->loose_objects);
    mt_mesh_destroy(context, plan->loose);
    memset(plan, 0, sizeof *plan);
}

mt_status mt_scene_plan_build_wanted(mt_context *context, mt_scene_plan *plan, bool *any)
{
    mt_status status = MT_OK;
    *any = false;
    for (mt_index i = 0; status == MT_OK && i < plan->part_count; i++) {
        mt_scene_part *part = &plan->parts[i];
        if (part->is_wanted && !part->is_built) {
            *any = true;
            status = mt_scene_part_build(context, part);
            if (status == MT_OK) {
                status = mt_scene_part_build_tree(context, part);
            }
        }
    }
    return status;
}
