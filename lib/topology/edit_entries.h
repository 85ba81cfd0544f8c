/* The entries that each operation writes into the log (edit_log.h), the same for all structures. Room must have been
 * reserved: the counts say how many entries a call adds. */
#ifndef MT_TOPOLOGY_EDIT_ENTRIES_H
#define MT_TOPOLOGY_EDIT_ENTRIES_H

#include <meshtool/edit_log.h>
#include <meshtool/surgery.h>

/* Fails unless the verdict is MT_SURGERY_ALLOWED and the weight, where one is given, lies in [0, 1]. */
mt_status mt_surgery_expect(mt_context *context, mt_surgery_verdict verdict, double weight);

/* left = (a b c) and right = (b a d) become (a d c) and (b c d). */
#define MT_EDIT_SWAP_COUNT 3
void mt_edit_swap(mt_edit_log *log, mt_index left, mt_index right, const mt_index abcd[4]);

/* Once for the edge from a to b, once for each face beside it; `other` takes the part of a triangle at b and is MT_NONE
 * for faces of more sides; c is the triangle's third vertex. */
#define MT_EDIT_SPLIT_EDGE_COUNT 4
#define MT_EDIT_SPLIT_SIDE_COUNT 5
void mt_edit_split_edge(mt_edit_log *log, mt_index a, mt_index b, mt_index middle, double weight);
void mt_edit_split_side(mt_edit_log *log, mt_index face, mt_index other, const mt_index abc[3], mt_index middle,
                        double weight);

/* Once for the vertex, once for each edge (with its other end) and face that passes from v to w, once for each of the
 * two that are cut: its new triangle, and that one's parent, the face on w's side of the edge or else the other one;
 * x is the edge's other end. */
#define MT_EDIT_SPLIT_VERTEX_COUNT 1
#define MT_EDIT_MOVE_EDGE_COUNT 2
#define MT_EDIT_MOVE_CORNER_COUNT 1
#define MT_EDIT_OPEN_EDGE_COUNT 5
void mt_edit_split_vertex(mt_edit_log *log, mt_index v, mt_index w);
void mt_edit_move_edge(mt_edit_log *log, mt_index v, mt_index w, mt_index end);
void mt_edit_move_corner(mt_edit_log *log, mt_index face, mt_index v, mt_index w);
void mt_edit_open_edge(mt_edit_log *log, mt_index triangle, mt_index parent, mt_index v, mt_index w, mt_index x);

/* `gone` is collapsed into `kept`, with faces `left` and `right` (MT_NONE: none) beside. */
typedef struct mt_edit_collapse {
    mt_index kept, gone, left, right;
    double weight;
} mt_edit_collapse;

/* In this order: once for the vertex; for each neighbour of `gone` but `kept`; for each face but left and right at
 * either end, with that end; for left, then right, where it is no triangle. */
#define MT_EDIT_COLLAPSE_VERTEX_COUNT 2
#define MT_EDIT_COLLAPSE_EDGE_COUNT 1
#define MT_EDIT_COLLAPSE_CORNER_COUNT 1
#define MT_EDIT_COLLAPSE_SIDE_COUNT 1
void mt_edit_collapse_vertex(mt_edit_log *log, const mt_edit_collapse *collapse);
void mt_edit_collapse_edge(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index neighbor);
void mt_edit_collapse_corner(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index face, mt_index end);
void mt_edit_collapse_side(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index face);

#endif
