/* Triangles into samples: which are covered, and which triangle is nearest. */
#ifndef MESHTOOL_RENDER_RASTER_H
#define MESHTOOL_RENDER_RASTER_H

#include "lib/render/tile.h"

/* For mt_bins_init over the triangles; user is the mt_frame. */
mt_tile_range mt_triangle_range(const mt_frame *frame, mt_index triangle);
void mt_triangle_narrow(const mt_frame *frame, mt_index triangle, uint32_t tile_y, mt_tile_range *row);

/* Draws triangles, given in ascending order. A sample on an edge belongs to both sides; the nearest triangle
 * wins, at equal depth the lowest. */
void mt_draw_triangles(const mt_frame *frame, mt_tile *tile, const mt_index *triangles, size_t count);

#endif
