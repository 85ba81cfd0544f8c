#include "lib/render/scene_measure.h"

#include <string.h>

/* What the scene does without, and why. */
static void tell_skipped(mt_context *context, const mt_scene_plan *plan)
{
    if (!plan->has_shadows) {
        mt_part_skip(context, "shadow rays", plan->scene->light_count > 0 ? "no light casts shadows" : "no lights");
    }
    if (!plan->has_followers) {
        mt_part_skip(context, "stack of rays", "no mirror and no glass: no ray follows another");
    } else if (!plan->has_glass) {
        mt_part_skip(context, "refracted rays", "no glass");
    }
    if (plan->item_count == 0) {
        mt_part_skip(context, "surface tree", "no meshes");
    }
}

static void tell_unseen(mt_context *context, const mt_scene_plan *plan)
{
    for (mt_index i = 0; i < plan->part_count; i++) {
        if (!plan->parts[i].is_built) {
            mt_part_skip(context, "surface tree", "no ray came near this mesh");
        }
    }
}

static uint64_t count_triangles(const mt_scene *scene)
{
    uint64_t count = 0;
    for (mt_index i = 0; i < scene->object_count; i++) {
        const mt_scene_object *object = &scene->objects[i];
        if (object->kind == MT_OBJECT_TRIANGLE) {
            count++;
        } else if (object->kind == MT_OBJECT_MESH) {
            const mt_mesh *mesh = scene->meshes[object->mesh].mesh;
            count += mesh->corner_count - 2 * (uint64_t)mesh->face_count;
        }
    }
    return count;
}

/* One run: how it was drawn, and what came of it. */
typedef struct rendering {
    mt_scene_plan plan;
    mt_scene_world world;
    bool has_world;
    mt_image *image;
    mt_scene_report report;
} rendering;

static mt_status make_world(mt_context *context, rendering *r)
{
    const char *reason = NULL;
    mt_visibility_method method = r->plan.options.method;
    r->has_world = mt_scene_world_fits(&r->plan, &reason);
    if (method == MT_METHOD_RASTER && !r->has_world) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the scene cannot be drawn by rasterising: %s", reason);
    }
    if (!r->has_world) {
        return MT_OK;
    }
    if (method != MT_METHOD_RAY) {
        mt_part_skip(context, "surface tree", reason);
    }
    return mt_scene_world_init(context, &r->plan, &r->world);
}

static mt_status draw(mt_context *context, rendering *r)
{
    tell_skipped(context, &r->plan);
    mt_status status = make_world(context, r);
    uint32_t channels = r->plan.scene->background.kind == MT_SCENE_TRANSPARENT ? 4 : 3;
    if (status == MT_OK) {
        status = mt_image_create_unfilled(context, r->plan.camera.width, r->plan.camera.height, channels, &r->image);
    }
    if (status == MT_OK) {
        r->image->space = MT_COLOR_LINEAR;
        status = mt_scene_draw(context, &r->plan, r->has_world ? &r->world : NULL, r->image, &r->report);
    }
    if (status == MT_OK && !r->has_world) {
        tell_unseen(context, &r->plan);
    }
    return status;
}

mt_status mt_scene_render(mt_context *context, const mt_scene *scene, const mt_scene_options *options, mt_image **out,
                          mt_scene_report *report)
{
    static const mt_scene_options defaults = {.method = MT_METHOD_AUTO};
    rendering r;
    memset(&r, 0, sizeof r);
    *out = NULL;
    options = options ? options : &defaults;
    mt_status status = mt_scene_check(context, scene, options);
    if (status == MT_OK) {
        status = mt_scene_plan_init(context, scene, options, &r.plan);
    }
    if (status != MT_OK) {
        return status;
    }
    status = draw(context, &r);
    if (status == MT_OK && options->measure_skipped) {
        status = mt_scene_measure_skipped(context, &r.plan, r.has_world, r.image);
    }
    r.report.triangles = count_triangles(scene);
    mt_scene_world_release(context, &r.world);
    mt_scene_plan_release(context, &r.plan);
    if (status != MT_OK) {
        mt_image_destroy(context, r.image);
        return status;
    }
    if (report) {
        *report = r.report;
    }
    *out = r.image;
    return MT_OK;
}
