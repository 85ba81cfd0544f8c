#include "lib/render/scene_draw.h"

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

mt_status mt_scene_render(mt_context *context, const mt_scene *scene, const mt_scene_options *options, mt_image **out,
                          mt_scene_report *report)
{
    static const mt_scene_options defaults = {.method = MT_METHOD_AUTO};
    mt_scene_plan plan;
    mt_scene_report found = {0};
    mt_image *image = NULL;
    *out = NULL;
    options = options ? options : &defaults;
    mt_status status = mt_scene_check(context, scene, options);
    if (status == MT_OK) {
        status = mt_scene_plan_init(context, scene, options, &plan);
    }
    if (status != MT_OK) {
        return status;
    }
    tell_skipped(context, &plan);
    uint32_t channels = scene->background.kind == MT_SCENE_TRANSPARENT ? 4 : 3;
    status = mt_image_create_unfilled(context, plan.camera.width, plan.camera.height, channels, &image);
    if (status == MT_OK) {
        image->space = MT_COLOR_LINEAR;
        status = mt_scene_draw(context, &plan, image, &found);
    }
    if (status == MT_OK) {
        tell_unseen(context, &plan);
        found.triangles = count_triangles(scene);
    }
    mt_scene_plan_release(context, &plan);
    if (status != MT_OK) {
        mt_image_destroy(context, image);
        return status;
    }
    if (report) {
        *report = found;
    }
    *out = image;
    return MT_OK;
}
