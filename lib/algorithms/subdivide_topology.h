/* The connectivity that a level of subdivision is made from, in the layout of Dupuy and Vanhoey (2021): the
 * children of corner c are the corners 4c .. 4c+3 of face c of the next level, which are the old vertex, the edge
 * point of its side, the face point and the edge point of the side before it.
 *
 * A topology serves the vertices of a mesh, and as well the values of an indexed corner attribute (UVs), whose
 * "vertices" are the values and for which a seam is a boundary. All rules are applied to either alike. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_TOPOLOGY_H
#define LIB_ALGORITHMS_SUBDIVIDE_TOPOLOGY_H

#include <meshtool/edge_pairs.h>

#define MT_SUBDIVIDE_INLINE static inline __attribute__((always_inline))

/* Faces of a parallel block: enough to hide its cost, few enough to spread small meshes. */
#define MT_SUBDIVIDE_GRAIN 4096

typedef struct mt_subdivide_topology {
    mt_index vertex_count, face_count, corner_count, edge_count;
    const mt_index *corner_vertices;
    const mt_index *twins;          /* per corner the opposite one, itself at a boundary */
    const mt_index *face_offsets;   /* face_count + 1; NULL: all faces are quads */
    const mt_index *corner_faces;   /* NULL: all faces are quads */
    const mt_index *edge_ranks;     /* edges whose first corner comes before: per corner, for quads per face */
    const mt_index *vertex_corners; /* one corner of a vertex, at a boundary the one whose side leaves along it,
                                       MT_NONE without faces; NULL for values that only linear rules touch */
    void *owned[6];                 /* those of the arrays that the topology frees */
} mt_subdivide_topology;

/* Level 0, of the vertices. Borrows the arrays of the mesh and of the pairs, which must outlive it; every edge must
 * be a boundary or regular, and no face may name a vertex twice. */
mt_status mt_subdivide_topology_of_mesh(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                        mt_subdivide_topology *topology);

/* Level 0, of an indexed corner attribute: the edges across which both ends have the same values stay whole. Corners
 * without a value get number 0 and no twin. Borrows from `base`, which must outlive it. */
mt_status mt_subdivide_topology_of_values(mt_context *context, const mt_subdivide_topology *base,
                                          const mt_attribute *attribute, mt_subdivide_topology *topology);

/* Edges of the mesh that a corner attribute splits in two. O(corners). */
mt_index mt_subdivide_seam_count(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_attribute *attribute);

/* The next level. corner_vertices receives its corners (16 a face of quads; the caller's). With `last` nothing else
 * is made: no further level can follow. */
mt_status mt_subdivide_topology_refine(mt_context *context, const mt_subdivide_topology *parent,
                                       mt_index *corner_vertices, bool last, mt_subdivide_topology *child);

void mt_subdivide_topology_release(mt_context *context, mt_subdivide_topology *topology);

/* Vertices of the next level: the old ones, face points, edge points. */
static inline uint64_t mt_subdivide_child_vertex_count(const mt_subdivide_topology *topology)
{
    return (uint64_t)topology->vertex_count + topology->face_count + topology->edge_count;
}

/* In all below `quads` is a constant of the caller, so that each loop is compiled for quads and for polygons. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_face(const mt_subdivide_topology *topology, mt_index corner, bool quads)
{
    return quads ? corner >> 2 : topology->corner_faces[corner];
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_face_begin(const mt_subdivide_topology *topology, mt_index face, bool quads)
{
    return quads ? face << 2 : topology->face_offsets[face];
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_next(const mt_subdivide_topology *topology, mt_index corner, bool quads)
{
    if (quads) {
        return (corner & ~3u) | ((corner + 1) & 3u);
    }
    mt_index face = topology->corner_faces[corner];
    return corner + 1 < topology->face_offsets[face + 1] ? corner + 1 : topology->face_offsets[face];
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_previous(const mt_subdivide_topology *topology, mt_index corner, bool quads)
{
    if (quads) {
        return (corner & ~3u) | ((corner + 3) & 3u);
    }
    mt_index face = topology->corner_faces[corner];
    return corner > topology->face_offsets[face] ? corner - 1 : topology->face_offsets[face + 1] - 1;
}

/* Whether the edge of this side is numbered here. */
MT_SUBDIVIDE_INLINE bool mt_subdivide_is_first(const mt_subdivide_topology *topology, mt_index corner)
{
    return topology->twins[corner] >= corner;
}

/* The number of the edge of a side. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_edge(const mt_subdivide_topology *topology, mt_index corner, bool quads)
{
    mt_index twin = topology->twins[corner];
    mt_index first = twin < corner ? twin : corner;
    if (!quads) {
        return topology->edge_ranks[first];
    }
    mt_index begin = first & ~3u, slot = first & 3u;
    const mt_index *twins = topology->twins + begin;
    return topology->edge_ranks[first >> 2] + (mt_index)((slot > 0) & (twins[0] >= begin)) +
           (mt_index)((slot > 1) & (twins[1] >= begin + 1)) + (mt_index)((slot > 2) & (twins[2] >= begin + 2));
}

/* The next corner around the same vertex, counter-clockwise. At a boundary vertex the walk begins at its
 * vertex_corners entry and must end before this is asked of the last one. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_turn(const mt_subdivide_topology *topology, mt_index corner, bool quads)
{
    return topology->twins[mt_subdivide_previous(topology, corner, quads)];
}

#endif
