/* Catmull-Clark subdivision of any polygon mesh with boundary.
 * Sources: Catmull and Clark, "Recursively generated B-spline surfaces on arbitrary topological meshes",
 * Computer-Aided Design 10 (1978); Dupuy and Vanhoey, "A Halfedge Refinement Rule for Parallel Catmull-Clark
 * Subdivision", Computer Graphics Forum 40 (2021), for the layout: the children of corner c are 4c .. 4c+3. */
#ifndef MESHTOOL_SUBDIVIDE_H
#define MESHTOOL_SUBDIVIDE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All zeros means the defaults. */
typedef struct mt_subdivide_options {
    unsigned level_count; /* 0: 1 level; at most 31 */
    bool no_levels;       /* really 0 levels: a copy */
} mt_subdivide_options;

/* Sizes of a level, in closed form from the mesh. */
typedef struct mt_subdivide_counts {
    uint64_t vertex_count, face_count, corner_count, edge_count;
    uint64_t bytes; /* of the finished level: positions, faces and attributes */
} mt_subdivide_counts;

/* The counts of level `level` (0: the mesh itself) in 64 bits; MT_ERROR_TOO_LARGE where those overflow.
 * edge_count is the number of edges of the mesh. */
mt_status mt_subdivide_count(mt_context *context, const mt_mesh *mesh, mt_index edge_count, unsigned level,
                             mt_subdivide_counts *out);

/* Refines. New vertices: the old ones in their order (isolated ones stay where they are), then face points by
 * face, then edge points by the first corner of the edge. New faces: in the order of the old corners, each
 * starting at the old vertex. Positions and colours by the vertex rule, UVs and corner normals linearly.
 * Boundary edges follow the cubic B-spline rule. MT_ERROR_NOT_MANIFOLD or MT_ERROR_NOT_ORIENTED names the first
 * offender; MT_ERROR_TOO_LARGE before anything is allocated. The same bytes for any number of threads. */
mt_status mt_subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
