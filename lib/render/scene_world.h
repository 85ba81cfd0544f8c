/* All meshes of a scene in one, for pictures of primary rays alone: their triangles go to the pixels that they cover.
 * Samples then ask the one triangle that they see where their ray meets it, so that a ray that finds the same triangle
 * gives the same bits. */
#ifndef MESHTOOL_RENDER_SCENE_WORLD_H
#define MESHTOOL_RENDER_SCENE_WORLD_H

#include "lib/render/scene_trace.h"
#include "lib/render/tile.h"
#include "lib/render/trace.h"

typedef struct mt_scene_world {
    mt_scene_plan *plan;
    mt_mesh *mesh;    /* triangles in the scene's coordinates; NULL: the one mesh there is lies in them as it is */
    mt_index *items;  /* objects, in the order of their triangles; the count of objects for loose triangles */
    mt_index *firsts; /* the first triangle of each, and one more */
    mt_index item_count;
    mt_model own_model;
    const mt_model *model; /* the own one, or that of the one mesh */
    double shift;          /* of a parallel camera towards what it sees, in t of the model */
    mt_frame frame;
    mt_bins bins;         /* by raster */
    mt_occluder occluder; /* by rays */
} mt_scene_world;

/* Whether the scene is one for this: *reason says why, or why not. */
bool mt_scene_world_fits(const mt_scene_plan *plan, const char **reason);

/* Builds what the plan's method needs, and all parts. */
mt_status mt_scene_world_init(mt_context *context, mt_scene_plan *plan, mt_scene_world *world);
void mt_scene_world_release(mt_context *context, mt_scene_world *world);

/* Finds the triangle that each sample of a tile sees. */
void mt_scene_world_draw(const mt_scene_world *world, const mt_sampling *sampling, mt_tile *tile);

/* Where a ray through a sample meets the triangle of that number; MT_NONE: nothing. */
mt_scene_hit mt_scene_world_hit(const mt_scene_world *world, const mt_sampling *sampling, mt_index number, uint32_t x,
                                uint32_t y, unsigned sample);

#endif
