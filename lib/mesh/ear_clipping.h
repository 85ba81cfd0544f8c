/* Ear clipping of one polygon in the plane, exact and in about n log n. */
#ifndef MT_MESH_EAR_CLIPPING_H
#define MT_MESH_EAR_CLIPPING_H

#include "lib/mesh/polygon.h"

/* Bytes of scratch memory for a polygon of `count` corners. */
uint64_t mt_ear_clipping_size(mt_index count);

/* Triangulates a counter-clockwise polygon of finite points, count >= 3, into count - 2 triangles of corner numbers,
 * 3 * (count - 2) of them. `scratch` is aligned to 16 bytes. */
void mt_ear_clip(mt_point2 *points, mt_index count, void *scratch, mt_index *triangles);

#endif
