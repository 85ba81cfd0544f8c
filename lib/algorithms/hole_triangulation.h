/* Triangles for a hole, given the vertices around it. */
#ifndef MT_ALGORITHMS_HOLE_TRIANGULATION_H
#define MT_ALGORITHMS_HOLE_TRIANGULATION_H

#include <meshtool/mesh.h>

/* Whether an edge between two vertices of the loop is forbidden, because some face has it already. */
typedef bool (*mt_edge_taken)(void *user, mt_index a, mt_index b);

/* Fills `triangles` (3 * (count - 2) local numbers, 0 to count - 1) with the triangulation of a closed loop of `count`
 * vertices, oriented as the loop runs. A planar loop that does not cross itself is triangulated as the polygon that it
 * is; another one by the triangulation of least area (dynamic programming, O(count^3)), up to HOLE_LEAST_AREA_MAXIMUM
 * vertices, and as a polygon seen along its area vector past that. *filled is false when every triangulation would need
 * a taken edge or a triangle without area. */
#define HOLE_LEAST_AREA_MAXIMUM 256
mt_status mt_triangulate_hole(mt_context *context, const mt_mesh *mesh, const mt_index *vertices, mt_index count,
                              mt_edge_taken taken, void *user, mt_index *triangles, bool *filled);

#endif
