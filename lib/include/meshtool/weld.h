/* Welding: points at the same place become one. */
#ifndef MESHTOOL_WELD_H
#define MESHTOOL_WELD_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Finds the distinct points among `point_count` (xyz triples of type MT_F32 or MT_F64). Two points are the same
 * when their coordinates are bit-equal as stored, -0 taken for +0; so a NaN equals a NaN of the same bits, and a
 * corner that is not a number keeps its neighbours.
 *
 * numbers[point_count] receives the number of each point's place; places are numbered in the order of their first
 * point, whatever the number of threads. The first *distinct_count triples of `distinct` (room for point_count)
 * receive the places, with the bits of their first point; it may be `positions` itself.
 *
 * Linear in time; holds 4 bytes for each point that is the first of its place in its run of 32768, and a table of 11 to
 * 32 bytes for each place. MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_weld_exact(mt_context *context, const void *positions, mt_type type, mt_index point_count, void *distinct,
                        mt_index *numbers, mt_index *distinct_count);

/* Whether two of the points may be the same, as above. false is certain; true is wrong for about one set of points in
 * 2^64 / point_count^2, so it is a reason to weld and no more. Linear, a tenth of the time of welding; holds about 10
 * bytes a point. MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_points_may_coincide(mt_context *context, const void *positions, mt_type type, mt_index point_count,
                                 bool *possible);

/* Makes the vertices of a mesh that are at the same place, as above, one; they are numbered in the order of their
 * first. Nothing else changes: no face is dropped, though some may now name a vertex twice or be given twice. A vertex
 * attribute keeps the first's value where the values at each place are bit-equal, and else moves to the corners,
 * indexed, so that no face loses one. *removed (may be NULL) receives how many vertices went. On failure the mesh is
 * whole, but attributes may have moved. O(size) time. */
mt_status mt_mesh_weld(mt_context *context, mt_mesh *mesh, mt_index *removed);

/* The same within a distance: each point, in order, joins the first place at most `tolerance` (above 0) away, or
 * becomes a place. A point that is not finite is a place of its own. numbers[point_count] and *distinct_count as above;
 * a place has the position of its first point. Linear in time; 12 bytes a point meanwhile. */
mt_status mt_weld_within(mt_context *context, const void *positions, mt_type type, mt_index point_count,
                         double tolerance, mt_index *numbers, mt_index *distinct_count);

/* Joins vertices of a mesh by numbers such as these functions give: vertex v becomes numbers[v], which takes the
 * position of its first vertex; numbers ascend in the order of first vertices. Attributes as mt_mesh_weld. */
mt_status mt_mesh_join_vertices(mt_context *context, mt_mesh *mesh, const mt_index *numbers, mt_index distinct_count);

#ifdef __cplusplus
}
#endif
#endif
