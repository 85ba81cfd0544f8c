/* Surgery: local changes of a connectivity structure, the same on all three of them (halfedge_surgery.h,
 * winged_edge_surgery.h, triangle_neighbor_surgery.h). Told by its effect on the list of faces, below, every operation
 * gives the same vertex and face numbers and the same verdict on each; a face's list may begin at another of its
 * vertices.
 *
 * New vertices and faces take the next numbers; what is deleted leaves a gap until the structure is compacted. Vertices
 * that lose their last face stay, isolated. No operation makes two faces of the same vertices. An operation that is not
 * allowed is MT_ERROR_ARGUMENT and changes nothing, as one that runs out of memory.
 *
 * - Swap edge: faces L = (a b c) and R = (b a d) become L = (a d c) and R = (b c d). Verdicts, in order of precedence:
 *   NO_ELEMENT, BOUNDARY_EDGE, NOT_TRIANGLES (L or R), EDGE_EXISTS (c and d are joined or the same).
 * - Split edge from a to b: a new vertex m lies on it, `weight` of the way from a to b. A triangle beside it keeps the
 *   part at a, and a new face takes the part at b: left of a to b first, then right. Other faces gain a side.
 *   NO_ELEMENT; DUPLICATE_FACE (the edge lies between two triangles of the same vertices).
 * - Split vertex v, cut along the edges `from` and `to`: the edges strictly between them, counter-clockwise from `from`
 *   to `to` (crossing the outside, if it lies there), and the faces there pass from v to a new vertex w. The edge from
 * v to x = the other end of `from` opens to a new face (v x w), that to y = the other end of `to` to another, (v w y).
 *   At a vertex of the boundary one of the two may be missing: the outside then takes its place. NO_ELEMENT (also: both
 *   missing, an edge of another vertex), INTERIOR_VERTEX (one missing, v not on the boundary), DUPLICATE_FACE (twice
 * the same edge).
 * - Collapse edge from a to b: a is deleted, and its place in all faces taken by b, which moves `weight` of the way to
 *   a. Triangles beside the edge are deleted, other faces there lose a side. Allowed where the link condition holds,
 *   with the boundary closed by an imagined vertex (Dey, Edelsbrunner, Guha, Nekhayev: Topology preserving edge
 *   contraction, 1999). NO_ELEMENT; LONE_FACE (a triangle beside the edge has no other neighbour); DUPLICATE_FACE (for
 *   a triangle (a b c) beside the edge: F, across a c, and G, across b c, are two faces that will have n sides each,
 *   and n - 2 sides of F lie in G too, or n - 1 if one of the two is the other face beside the edge); PINCH (both ends,
 *   but not the edge, on the boundary); COMMON_NEIGHBOR (more or fewer neighbours of both ends than triangles beside
 *   the edge); COMMON_FACE (a face that is not beside the edge names both ends).
 * - Remove face: edges that lose their last face go with it. NO_ELEMENT; PINCH (two fans would remain at a vertex: it
 *   lies on the boundary, and both of the face's sides there have another face).
 * - Add face over existing vertices, isolated ones too. NOT_A_FACE (fewer than three); NO_ELEMENT (a vertex);
 *   NOT_A_FACE (one of them twice); NOT_TRIANGLES (the structure holds triangles alone); EDGE_EXISTS (a face runs along
 *   one of its sides in the same direction); PINCH (a vertex that has faces, but none along either side there);
 *   DUPLICATE_FACE (every side lies in the same other face, of as many sides). */
#ifndef MESHTOOL_SURGERY_H
#define MESHTOOL_SURGERY_H

#include <meshtool/context.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_surgery_verdict {
    MT_SURGERY_ALLOWED,
    MT_SURGERY_NO_ELEMENT,      /* a number out of range, of something deleted, or that does not belong there */
    MT_SURGERY_BOUNDARY_EDGE,   /* a swap needs faces on both sides */
    MT_SURGERY_INTERIOR_VERTEX, /* a vertex inside the surface must be cut along two edges */
    MT_SURGERY_NOT_TRIANGLES,   /* the operation, or the structure, needs triangles */
    MT_SURGERY_NOT_A_FACE,      /* a face has three vertices or more, all different */
    MT_SURGERY_EDGE_EXISTS,     /* an edge, or one side of it, would be there twice */
    MT_SURGERY_PINCH,           /* two boundaries, or two fans of faces, would meet in one vertex */
    MT_SURGERY_LONE_FACE,       /* the face beside the edge hangs on it alone; an edge without faces would remain */
    MT_SURGERY_DUPLICATE_FACE,  /* two faces of the same vertices would remain */
    MT_SURGERY_COMMON_NEIGHBOR, /* link condition: the ends share a neighbour that is not opposite the edge */
    MT_SURGERY_COMMON_FACE,     /* link condition: a face beyond the edge names both ends */
    MT_SURGERY_VERDICT_COUNT
} mt_surgery_verdict;

/* The verdict as a clause: "the edge lies on the boundary". */
const char *mt_surgery_verdict_words(mt_surgery_verdict verdict);

/* What compaction did: old to new numbers, MT_NONE for what is deleted. Edges keep their direction; NULL for a
 * structure that does not number them. */
typedef struct mt_surgery_map {
    mt_index vertex_count, edge_count, face_count; /* old ones, the deleted included */
    mt_index *vertices, *edges, *faces;
} mt_surgery_map;

void mt_surgery_map_release(mt_context *context, mt_surgery_map *map);

#ifdef __cplusplus
}
#endif
#endif
