/* How surgery reads a structure, whichever it is: so that a verdict is reached, and the log written, by the same lines
 * for all.
 *
 * Sides are numbered as half-edges: the opposite of s is s ^ 1, and where the surface ends there is an outer side that
 * has no face. */
#ifndef MT_TOPOLOGY_SURGERY_VIEW_H
#define MT_TOPOLOGY_SURGERY_VIEW_H

#include <meshtool/edit_log.h>
#include <meshtool/mesh.h>
#include <meshtool/surgery.h>

typedef struct mt_surgery_view {
    const void *structure;
    mt_index vertex_count, face_count, side_count; /* the deleted included */
    bool triangles_only;
    mt_index (*next)(const void *structure, mt_index side);
    mt_index (*head)(const void *structure, mt_index side);          /* MT_NONE when the side is deleted or none */
    mt_index (*face)(const void *structure, mt_index side);          /* MT_NONE outside */
    mt_index (*vertex_side)(const void *structure, mt_index vertex); /* points to the vertex, from outside where there
                                                                        is an outside; MT_NONE when isolated */
    mt_index (*face_side)(const void *structure, mt_index face);     /* MT_NONE when deleted */
    const uint8_t *vertex_deleted;
    uint8_t *marks; /* a vertex each, 0 between calls */
} mt_surgery_view;

static inline mt_index surgery_next(const mt_surgery_view *view, mt_index side)
{
    return view->next(view->structure, side);
}

static inline mt_index surgery_head(const mt_surgery_view *view, mt_index side)
{
    return view->head(view->structure, side);
}

static inline mt_index surgery_tail(const mt_surgery_view *view, mt_index side)
{
    return view->head(view->structure, side ^ 1u);
}

static inline mt_index surgery_face(const mt_surgery_view *view, mt_index side)
{
    return view->face(view->structure, side);
}

/* The next side that points to the same vertex, clockwise. */
static inline mt_index surgery_clockwise(const mt_surgery_view *view, mt_index side)
{
    return view->next(view->structure, side) ^ 1u;
}

static inline bool surgery_has_side(const mt_surgery_view *view, mt_index side)
{
    return side < view->side_count && surgery_head(view, side) != MT_NONE;
}

static inline bool surgery_has_vertex(const mt_surgery_view *view, mt_index vertex)
{
    return vertex < view->vertex_count && !view->vertex_deleted[vertex];
}

static inline bool surgery_has_face(const mt_surgery_view *view, mt_index face)
{
    return face < view->face_count && view->face_side(view->structure, face) != MT_NONE;
}

/* Whether the side has a face, and that is a triangle. */
static inline bool surgery_in_triangle(const mt_surgery_view *view, mt_index side)
{
    return surgery_face(view, side) != MT_NONE &&
           surgery_next(view, surgery_next(view, surgery_next(view, side))) == side;
}

static inline bool surgery_vertex_is_boundary(const mt_surgery_view *view, mt_index vertex)
{
    mt_index side = view->vertex_side(view->structure, vertex);
    return side != MT_NONE && surgery_face(view, side) == MT_NONE;
}

/* The side from tail to head, MT_NONE when there is none or a vertex is deleted or out of range. O(valence of head). */
mt_index mt_surgery_find_side(const mt_surgery_view *view, mt_index tail, mt_index head);

/* The predicates, as surgery.h defines them. O(valences + sides around the place). */
mt_surgery_verdict mt_surgery_judge_swap(const mt_surgery_view *view, mt_index edge);
mt_surgery_verdict mt_surgery_judge_split_edge(const mt_surgery_view *view, mt_index side);
mt_surgery_verdict mt_surgery_judge_split_vertex(const mt_surgery_view *view, mt_index vertex, mt_index from,
                                                 mt_index to);
mt_surgery_verdict mt_surgery_judge_collapse(const mt_surgery_view *view, mt_index side);
mt_surgery_verdict mt_surgery_judge_remove_face(const mt_surgery_view *view, mt_index face);
mt_surgery_verdict mt_surgery_judge_add_face(const mt_surgery_view *view, mt_index count, const mt_index *vertices);

/* Begin an operation: judge it, make room in the log and write there what will be done. The numbers of new elements are
 * the next ones. Nothing may fail after this; so room for the elements must have been made before. On failure nothing
 * is written. A side that is out of range, and not MT_NONE, stands for one that is not there. Costs as the predicates.
 */
mt_status mt_surgery_enter_swap(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index edge);
mt_status mt_surgery_enter_split_edge(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index side,
                                      double weight);
mt_status mt_surgery_enter_split_vertex(mt_context *context, const mt_surgery_view *view, mt_edit_log *log,
                                        mt_index vertex, mt_index from, mt_index to);
mt_status mt_surgery_enter_collapse(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index side,
                                    double weight);

/* The part of the fan of a split vertex that passes to the new one: the sides from `begin` on, clockwise, before `end`,
 * and the sector clockwise of each and of `to`. Empty when begin is end. */
typedef struct mt_surgery_fan {
    mt_index begin, end;
} mt_surgery_fan;
mt_surgery_fan mt_surgery_find_fan(const mt_surgery_view *view, mt_index vertex, mt_index from, mt_index to);

/* Numbers what is left in its order, in a new map, and says how much that is; edges only where the structure numbers
 * them. On failure the map holds what is to be released. O(size). */
typedef struct mt_surgery_counts {
    mt_index vertex_count, edge_count, face_count;
} mt_surgery_counts;
mt_status mt_surgery_number(mt_context *context, const mt_surgery_view *view, bool numbers_edges, mt_surgery_map *map,
                            mt_surgery_counts *counts);

#endif
