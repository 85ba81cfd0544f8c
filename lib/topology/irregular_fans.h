/* Fans of vertices that no walk can go around. */
#ifndef MT_TOPOLOGY_IRREGULAR_FANS_H
#define MT_TOPOLOGY_IRREGULAR_FANS_H

#include <meshtool/vertex_fans.h>

/* States of a vertex before its fans are known, beside those of mt_fan_class. */
enum { FANS_OPEN = MT_FANS_SEVERAL + 1, FANS_IRREGULAR };

typedef struct vertex_corners {
    mt_index first; /* a corner that names the vertex */
    mt_index count; /* how many do */
} vertex_corners;

/* Replaces every FANS_IRREGULAR by what it is. corners[].first is overwritten. O(vertices + corners). */
mt_status mt_irregular_fans_join(mt_context *context, const mt_mesh *mesh, vertex_corners *corners, uint8_t *fans);

#endif
