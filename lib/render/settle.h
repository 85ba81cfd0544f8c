/* A triangle's way into samples about which floats leave a doubt: the hit test is asked. */
#ifndef MESHTOOL_RENDER_SETTLE_H
#define MESHTOOL_RENDER_SETTLE_H

#include "lib/render/tile.h"
#include "lib/render/vectors.h"

/* Stores the triangle in those samples of a pixel in which the hit test says that it is nearest. groups: group_count
 * groups of lanes, not zero where the test is to be asked. */
void mt_settle_groups(const mt_frame *frame, mt_tile *tile, mt_index triangle, int32_t x, int32_t y,
                      const vector8i *groups, unsigned group_count);

#endif
