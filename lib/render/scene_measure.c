#include "lib/render/scene_measure.h"

#include <string.h>

/* Trees of meshes that no ray came near, or that rasterising did without. */
static mt_status build_unseen(mt_context *context, mt_scene_plan *plan, bool had_world)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < plan->part_count; i++) {
        mt_scene_part *part = &plan->parts[i];
        if (part->is_built) {
            continue;
        }
        int token = mt_part_begin_skipped(context, "surface tree",
                                          had_world ? "what a tree would have taken"
                                                    : "what a mesh that no ray came near would have taken");
        status = had_world ? MT_OK : mt_scene_part_build(context, part);
        if (status == MT_OK) {
            status = mt_scene_part_build_tree(context, part);
        }
        mt_part_end(context, token);
    }
    return status;
}

static mt_status draw_scratch(mt_context *context, mt_scene_plan *plan, mt_image *scratch, const char *name,
                              const char *reason)
{
    mt_scene_report report;
    int token = mt_part_begin_skipped(context, name, reason);
    mt_status status = mt_scene_draw(context, plan, NULL, scratch, &report);
    mt_part_end(context, token);
    return status;
}

/* The whole drawing with all lights casting shadows. */
static mt_status draw_shadows(mt_context *context, mt_scene_plan *plan, mt_image *scratch)
{
    const mt_scene *scene = plan->scene;
    mt_scene with = *scene;
    mt_scene_light *lights = (mt_scene_light *)mt_allocate_array(context, scene->light_count, sizeof *lights);
    if (!lights) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < scene->light_count; i++) {
        lights[i] = scene->lights[i];
        lights[i].casts_shadows = true;
    }
    with.lights = lights;
    plan->scene = &with;
    mt_status status = draw_scratch(context, plan, scratch, "shadow rays", "the whole drawing, with shadows");
    plan->scene = scene;
    mt_free(context, lights);
    return status;
}

mt_status mt_scene_measure_skipped(mt_context *context, mt_scene_plan *plan, bool had_world, const mt_image *image)
{
    mt_image *scratch = NULL;
    mt_status status = build_unseen(context, plan, had_world);
    if (status == MT_OK) {
        status = mt_image_create_unfilled(context, image->width, image->height, image->channel_count, &scratch);
    }
    if (status == MT_OK && had_world && plan->options.method != MT_METHOD_RAY) {
        status = draw_scratch(context, plan, scratch, "a ray for each sample", "the whole drawing, in image order");
    }
    if (status == MT_OK && !plan->has_shadows && plan->scene->light_count > 0) {
        status = draw_shadows(context, plan, scratch);
    }
    if (status == MT_OK && !plan->has_followers) {
        plan->has_followers = true;
        status = draw_scratch(context, plan, scratch, "stack of rays", "the whole drawing, ready for rays that follow");
        plan->has_followers = false;
    }
    mt_image_destroy(context, scratch);
    return status;
}
