/* Where a few samples are too few. */
#ifndef MESHTOOL_RENDER_CHANGES_H
#define MESHTOOL_RENDER_CHANGES_H

#include "lib/render/picture.h"

/* Sets wanted[pixel of the tile] to 1 where the samples of the pixel, or its neighbours', show different things: other
 * faces whose normals or colours differ, lines, nothing. Returns how many pixels there are. */
uint64_t mt_find_changes(const mt_picture *picture, const mt_tile *tile, unsigned char *wanted);

#endif
