/* The connectivity that a level of subdivision is made from, in the layout of Dupuy and Vanhoey (2021): the
 * children of corner c are the corners 4c .. 4c+3 of face c of the next level, which are the old vertex, the edge
 * point of its side, the face point and the edge point of the side before it.
 *
 * A topology serves the vertices of a mesh, and as well the values of an indexed corner attribute (UVs), whose
 * "vertices" are the values and for which a seam is a boundary. All rules are applied to either alike. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_TOPOLOGY_H
#define LIB_ALGORITHMS_SUBDIVIDE_TOPOLOGY_H

#include <meshtool/subdivide.h>

#define MT_SUBDIVIDE_INLINE static inline __attribute__((always_inline))

/* Faces of a parallel block: enough to hide its cost; what they touch stays in a cache of 512 KB. */
#define MT_SUBDIVIDE_GRAIN 4096

/* Below so many faces one thread does all: on a busy machine it costs milliseconds until another has run. */
#define MT_SUBDIVIDE_ALONE 32768

typedef struct mt_subdivide_topology {
    mt_index vertex_count, face_count, corner_count, edge_count;
    mt_subdivide_scheme scheme;
    unsigned level;
    unsigned face_size; /* sides of every face: 3, 4; 0: of any number */
    const mt_index *corner_vertices;
    const mt_index *twins;        /* per corner the opposite one, itself at a boundary */
    const mt_index *face_offsets; /* face_count + 1; NULL when face_size is not 0 */
    const mt_index *corner_faces; /* NULL when face_size is not 0 */
    const mt_index *edge_ranks;   /* edges whose first corner comes before: per face, per corner if face_size is 0 */

    /* One corner of each of the first vertices, at a boundary the one whose side leaves along it; MT_NONE: it has no
     * face. Those are at level 0 all vertices, later the vertices and, unless quads', the face points of level 0: all
     * that may be irregular. As the corner 4c continues c at its vertex, entries of level 1 serve later levels when
     * shifted. NULL for values that only linear rules touch. */
    const mt_index *vertex_corners;
    mt_index vertex_corner_count;
    unsigned vertex_corner_shift;

    void *owned[6]; /* those of the arrays that the topology frees */
} mt_subdivide_topology;

/* Level 0, of the vertices. Borrows the arrays of the mesh and of the pairs, which must outlive it; every edge must
 * be a boundary or regular, and no face may name a vertex twice. */
mt_status mt_subdivide_topology_of_mesh(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                        mt_subdivide_topology *topology);

/* Level 0, of an indexed corner attribute: the edges across which both ends have the same values stay whole. Corners
 * without a value get number 0 and no twin. Borrows from `base`, which must outlive it. */
mt_status mt_subdivide_topology_of_values(mt_context *context, const mt_subdivide_topology *base,
                                          const mt_attribute *attribute, mt_subdivide_topology *topology);

/* Finds vertex_corners of all vertices, of a level that can be walked. */
mt_status mt_subdivide_find_vertex_corners(mt_context *context, mt_subdivide_topology *topology);

/* Edges of the mesh that a corner attribute splits in two; `missing_is_one`: corners without a value have the same one.
 * O(corners). */
mt_index mt_subdivide_seam_count(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_attribute *attribute,
                                 bool missing_is_one);

/* One loop over the faces or vertices of a level: what it makes, and of which connectivity. */
typedef struct mt_subdivide_loop {
    mt_parallel_body body; /* its user is the loop */
    uint64_t count;
    const mt_subdivide_topology *topology;

    /* Values (subdivide_values.c) */
    const void *source;
    void *target;
    size_t stride; /* numbers from one value to the next */
    size_t offset; /* of the first component that the loop makes */
    size_t size;   /* bytes of a value */
    bool linear;
    bool still_boundary; /* smooth, but values on boundaries stay */

    /* Patches (subdivide_patch.c) */
    const void *patches;
    const uint8_t *skipped;

    /* Connectivity of the next level (subdivide_topology.c); but the first NULL on the last level */
    mt_index *child_vertices, *child_twins, *child_ranks;
    mt_index *child_vertex_corners; /* made at level 1 alone */
} mt_subdivide_loop;
typedef struct mt_subdivide_pass mt_subdivide_pass; /* subdivide_pass.h */

/* Allocates the next level and adds the loops that fill it, at most two, to the pass. corner_vertices receives its
 * corners (4 for each of the parent's; the caller's). With `last` nothing else is made: no further level can follow.
 * Takes vertex_corners over from a parent past level 0, which can still be read. */
mt_status mt_subdivide_topology_plan(mt_context *context, mt_subdivide_topology *parent, mt_index *corner_vertices,
                                     bool last, mt_subdivide_topology *child, mt_subdivide_pass *pass);

void mt_subdivide_topology_release(mt_context *context, mt_subdivide_topology *topology);

/* Vertices of the next level: the old ones, face points (Loop's scheme has none), edge points. */
static inline mt_index mt_subdivide_face_point_count(const mt_subdivide_topology *topology)
{
    return topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP ? 0 : topology->face_count;
}

static inline mt_index mt_subdivide_first_edge_point(const mt_subdivide_topology *topology)
{
    return topology->vertex_count + mt_subdivide_face_point_count(topology);
}

static inline uint64_t mt_subdivide_child_vertex_count(const mt_subdivide_topology *topology)
{
    return (uint64_t)topology->vertex_count + mt_subdivide_face_point_count(topology) + topology->edge_count;
}

/* Corners of the next level around a corner of it, in its face. */
static inline mt_index mt_subdivide_child_next(const mt_subdivide_topology *topology, mt_index child)
{
    if (topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP) {
        return child % 3 == 2 ? child - 2 : child + 1;
    }
    return (child & ~3u) | ((child + 1) & 3u);
}

static inline mt_index mt_subdivide_child_previous(const mt_subdivide_topology *topology, mt_index child)
{
    return mt_subdivide_child_next(
        topology, topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP ? mt_subdivide_child_next(topology, child) : child ^ 2u);
}

/* In all below `sides` is a constant of the caller, 3 or 4 or 0 for face_offsets, so that each loop is compiled for
 * triangles, quads and polygons. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_face(const mt_subdivide_topology *topology, mt_index corner, unsigned sides)
{
    return sides ? corner / sides : topology->corner_faces[corner];
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_face_begin(const mt_subdivide_topology *topology, mt_index face,
                                                     unsigned sides)
{
    return sides ? face * sides : topology->face_offsets[face];
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_next(const mt_subdivide_topology *topology, mt_index corner, unsigned sides)
{
    if (sides == 4) {
        return (corner & ~3u) | ((corner + 1) & 3u);
    }
    mt_index face = mt_subdivide_face(topology, corner, sides);
    mt_index end = mt_subdivide_face_begin(topology, face + 1, sides);
    return corner + 1 < end ? corner + 1 : mt_subdivide_face_begin(topology, face, sides);
}

MT_SUBDIVIDE_INLINE mt_index mt_subdivide_previous(const mt_subdivide_topology *topology, mt_index corner,
                                                   unsigned sides)
{
    if (sides == 4) {
        return (corner & ~3u) | ((corner + 3) & 3u);
    }
    mt_index face = mt_subdivide_face(topology, corner, sides);
    mt_index begin = mt_subdivide_face_begin(topology, face, sides);
    return corner > begin ? corner - 1 : mt_subdivide_face_begin(topology, face + 1, sides) - 1;
}

/* Whether the edge of this side is numbered here. */
MT_SUBDIVIDE_INLINE bool mt_subdivide_is_first(const mt_subdivide_topology *topology, mt_index corner)
{
    return topology->twins[corner] >= corner;
}

/* The number of the first edge that begins in a face or later. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_face_rank(const mt_subdivide_topology *topology, mt_index face,
                                                    unsigned sides)
{
    return topology->edge_ranks[sides ? face : topology->face_offsets[face]];
}

/* The number of the edge of a side. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_edge(const mt_subdivide_topology *topology, mt_index corner, unsigned sides)
{
    mt_index twin = topology->twins[corner];
    mt_index first = twin < corner ? twin : corner;
    if (!sides) {
        return topology->edge_ranks[first];
    }
    mt_index face = first / sides, begin = face * sides;
    mt_index rank = topology->edge_ranks[face];
    for (mt_index i = 0; i + 1 < sides; i++) {
        rank += (mt_index)((begin + i < first) & (topology->twins[begin + i] >= begin + i));
    }
    return rank;
}

/* The corner at which a walk around one of the first vertex_corner_count vertices begins, or MT_NONE. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_vertex_corner(const mt_subdivide_topology *topology, mt_index vertex)
{
    mt_index corner = topology->vertex_corners[vertex];
    return corner == MT_NONE ? MT_NONE : corner << topology->vertex_corner_shift;
}

/* The next corner around the same vertex, counter-clockwise. At a boundary vertex the walk
 * begins at mt_subdivide_vertex_corner and must end before this is asked of the last one. */
MT_SUBDIVIDE_INLINE mt_index mt_subdivide_turn(const mt_subdivide_topology *topology, mt_index corner, unsigned sides)
{
    return topology->twins[mt_subdivide_previous(topology, corner, sides)];
}

#endif
