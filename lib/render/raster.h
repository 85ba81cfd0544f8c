/* Triangles into samples: which are covered, and which triangle is nearest. */
#ifndef MESHTOOL_RENDER_RASTER_H
#define MESHTOOL_RENDER_RASTER_H

#include "lib/render/tile.h"

/* For mt_bins_init over the triangles; user is the mt_frame. */
mt_tile_range mt_triangle_range(const mt_frame *frame, mt_index triangle);
void mt_triangle_narrow(const mt_frame *frame, mt_index triangle, uint32_t tile_y, mt_tile_range *row);

/* Draws triangles. In every sample the nearest wins that the hit test finds there, at equal t the lowest, in whatever
 * order they come. */
void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count);

/* The same for a list that may be put into another order: those that turn their front to the eye are drawn first, as
 * they hide the others where a surface is closed, and what is hidden costs little. */
void mt_draw_front_first(const mt_frame *frame, mt_tile *tile, mt_index *triangles, size_t count);

/* Replaces the depths of a pixel by those of the triangles that its samples show, as lines and dots meet them: the same
 * whoever found the triangles. */
void mt_triangle_depths(const mt_frame *frame, mt_tile *tile, uint32_t x, uint32_t y);

#endif
