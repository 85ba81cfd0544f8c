/* Beginning an operation: its verdict, and the log's entries, before anything is changed. Cost: O(valences + sides). */
#include "lib/topology/edit_entries.h"
#include "lib/topology/surgery_view.h"

static mt_index third_vertex(const mt_surgery_view *view, mt_index side)
{
    return surgery_head(view, surgery_next(view, side));
}

static uint64_t count_valence(const mt_surgery_view *view, mt_index begin)
{
    uint64_t count = 0;
    mt_index side = begin;
    do {
        count++;
        side = surgery_clockwise(view, side);
    } while (side != begin);
    return count;
}

mt_status mt_surgery_enter_swap(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index edge)
{
    mt_status status = mt_surgery_expect(context, mt_surgery_judge_swap(view, edge), 0);
    status = status == MT_OK ? mt_edit_log_reserve(context, log, MT_EDIT_SWAP_COUNT) : status;
    if (status == MT_OK) {
        mt_index left = 2 * edge, right = left + 1;
        mt_edit_swap(log, surgery_face(view, left), surgery_face(view, right),
                     (const mt_index[]){surgery_tail(view, left), surgery_head(view, left), third_vertex(view, left),
                                        third_vertex(view, right)});
    }
    return status;
}

mt_status mt_surgery_enter_split_edge(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index side,
                                      double weight)
{
    mt_status status = mt_surgery_expect(context, mt_surgery_judge_split_edge(view, side), weight);
    uint64_t edits = MT_EDIT_SPLIT_EDGE_COUNT + 2 * MT_EDIT_SPLIT_SIDE_COUNT;
    status = status == MT_OK ? mt_edit_log_reserve(context, log, edits) : status;
    if (status != MT_OK) {
        return status;
    }
    mt_index middle = view->vertex_count, other = view->face_count;
    mt_index a = surgery_tail(view, side), b = surgery_head(view, side);
    mt_edit_split_edge(log, a, b, middle, weight);
    const mt_index sides[2] = {side, side ^ 1u};
    for (int i = 0; i < 2; i++) {
        mt_index face = surgery_face(view, sides[i]);
        if (face != MT_NONE) {
            bool cut = surgery_in_triangle(view, sides[i]);
            const mt_index abc[3] = {a, b, third_vertex(view, sides[i])};
            mt_edit_split_side(log, face, cut ? other : MT_NONE, abc, middle, weight);
            other += cut;
        }
    }
    return MT_OK;
}

mt_surgery_fan mt_surgery_find_fan(const mt_surgery_view *view, mt_index vertex, mt_index from, mt_index to)
{
    mt_index outer = view->vertex_side(view->structure, vertex);
    return (mt_surgery_fan){surgery_clockwise(view, to == MT_NONE ? outer : to),
                            from == MT_NONE ? surgery_clockwise(view, outer) : from};
}

static mt_index either(mt_index face, mt_index other)
{
    return face != MT_NONE ? face : other;
}

static void log_split_vertex(const mt_surgery_view *view, mt_edit_log *log, mt_index vertex, mt_index from, mt_index to)
{
    mt_index triangle = view->face_count, added = view->vertex_count;
    mt_edit_split_vertex(log, vertex, added);
    mt_surgery_fan fan = mt_surgery_find_fan(view, vertex, from, to);
    for (mt_index side = fan.begin; side != fan.end; side = surgery_clockwise(view, side)) {
        mt_edit_move_edge(log, vertex, added, surgery_tail(view, side));
        if (surgery_face(view, side) != MT_NONE) {
            mt_edit_move_corner(log, surgery_face(view, side), vertex, added);
        }
    }
    if (to != MT_NONE && surgery_face(view, to) != MT_NONE) {
        mt_edit_move_corner(log, surgery_face(view, to), vertex, added);
    }
    if (from != MT_NONE) {
        mt_index parent = either(surgery_face(view, from ^ 1u), surgery_face(view, from));
        mt_edit_open_edge(log, triangle++, parent, vertex, added, surgery_tail(view, from));
    }
    if (to != MT_NONE) {
        mt_index parent = either(surgery_face(view, to), surgery_face(view, to ^ 1u));
        mt_edit_open_edge(log, triangle, parent, vertex, added, surgery_tail(view, to));
    }
}

mt_status mt_surgery_enter_split_vertex(mt_context *context, const mt_surgery_view *view, mt_edit_log *log,
                                        mt_index vertex, mt_index from, mt_index to)
{
    mt_status status = mt_surgery_expect(context, mt_surgery_judge_split_vertex(view, vertex, from, to), 0);
    if (status == MT_OK) {
        uint64_t valence = count_valence(view, view->vertex_side(view->structure, vertex));
        uint64_t edits = MT_EDIT_SPLIT_VERTEX_COUNT + 2 * MT_EDIT_OPEN_EDGE_COUNT +
                         valence * (MT_EDIT_MOVE_EDGE_COUNT + MT_EDIT_MOVE_CORNER_COUNT);
        status = mt_edit_log_reserve(context, log, edits);
    }
    if (status == MT_OK) {
        log_split_vertex(view, log, vertex, from, to);
    }
    return status;
}

/* For the edges and faces at the vertex to which `begin` points. */
static void log_collapsed_ring(const mt_surgery_view *view, mt_edit_log *log, const mt_edit_collapse *collapse,
                               mt_index begin)
{
    mt_index side = begin, vertex = surgery_head(view, begin);
    do {
        mt_index neighbor = surgery_tail(view, side), face = surgery_face(view, side);
        if (vertex == collapse->gone && neighbor != collapse->kept) {
            mt_edit_collapse_edge(log, collapse, neighbor);
        }
        if (face != MT_NONE && face != collapse->left && face != collapse->right) {
            mt_edit_collapse_corner(log, collapse, face, vertex);
        }
        side = surgery_clockwise(view, side);
    } while (side != begin);
}

static void log_collapse(const mt_surgery_view *view, mt_edit_log *log, mt_index side, double weight)
{
    mt_edit_collapse collapse = {surgery_head(view, side), surgery_tail(view, side), surgery_face(view, side),
                                 surgery_face(view, side ^ 1u), weight};
    mt_edit_collapse_vertex(log, &collapse);
    log_collapsed_ring(view, log, &collapse, side ^ 1u);
    log_collapsed_ring(view, log, &collapse, side);
    if (collapse.left != MT_NONE && !surgery_in_triangle(view, side)) {
        mt_edit_collapse_side(log, &collapse, collapse.left);
    }
    if (collapse.right != MT_NONE && !surgery_in_triangle(view, side ^ 1u)) {
        mt_edit_collapse_side(log, &collapse, collapse.right);
    }
}

mt_status mt_surgery_enter_collapse(mt_context *context, const mt_surgery_view *view, mt_edit_log *log, mt_index side,
                                    double weight)
{
    mt_status status = mt_surgery_expect(context, mt_surgery_judge_collapse(view, side), weight);
    if (status == MT_OK) {
        uint64_t valences = count_valence(view, side) + count_valence(view, side ^ 1u);
        uint64_t edits = MT_EDIT_COLLAPSE_VERTEX_COUNT + 2 * MT_EDIT_COLLAPSE_SIDE_COUNT +
                         valences * (MT_EDIT_COLLAPSE_EDGE_COUNT + MT_EDIT_COLLAPSE_CORNER_COUNT);
        status = mt_edit_log_reserve(context, log, edits);
    }
    if (status == MT_OK) {
        log_collapse(view, log, side, weight);
    }
    return status;
}
