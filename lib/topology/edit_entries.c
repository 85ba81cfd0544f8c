#include "lib/topology/edit_entries.h"

mt_status mt_surgery_expect(mt_context *context, mt_surgery_verdict verdict, double weight)
{
    if (verdict != MT_SURGERY_ALLOWED) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the operation is not allowed: %s",
                       mt_surgery_verdict_words(verdict));
    }
    if (!(weight >= 0 && weight <= 1)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the weight %g does not lie between 0 and 1", weight);
    }
    return MT_OK;
}

static void add_vertex(mt_edit_log *log, mt_edit_kind kind, mt_index target, mt_index a, mt_index b, double weight)
{
    mt_edit_log_add(log, &(mt_edit){.kind = kind,
                                    .target = target,
                                    .target_vertex = MT_NONE,
                                    .a = a,
                                    .a_vertex = MT_NONE,
                                    .b = b,
                                    .b_vertex = MT_NONE,
                                    .weight = weight});
}

static void mix_corner(mt_edit_log *log, mt_index face, mt_index vertex, mt_index from, mt_index a, mt_index b,
                       double weight)
{
    mt_edit_log_add(log, &(mt_edit){.kind = MT_EDIT_CORNER,
                                    .target = face,
                                    .target_vertex = vertex,
                                    .a = from,
                                    .a_vertex = a,
                                    .b = from,
                                    .b_vertex = b,
                                    .weight = weight});
}

static void copy_corner(mt_edit_log *log, mt_index face, mt_index vertex, mt_index from, mt_index from_vertex)
{
    mix_corner(log, face, vertex, from, from_vertex, from_vertex, 0);
}

static void add_edge(mt_edit_log *log, mt_edit_kind kind, mt_index u, mt_index v, mt_index p, mt_index q)
{
    mt_edit_log_add(
        log,
        &(mt_edit){
            .kind = kind, .target = u, .target_vertex = v, .a = p, .a_vertex = q, .b = MT_NONE, .b_vertex = MT_NONE});
}

void mt_edit_swap(mt_edit_log *log, mt_index left, mt_index right, const mt_index abcd[4])
{
    copy_corner(log, left, abcd[3], right, abcd[3]);
    copy_corner(log, right, abcd[2], left, abcd[2]);
    add_edge(log, MT_EDIT_NO_EDGE, abcd[0], abcd[1], MT_NONE, MT_NONE);
}

void mt_edit_split_edge(mt_edit_log *log, mt_index a, mt_index b, mt_index middle, double weight)
{
    add_vertex(log, MT_EDIT_VERTEX, middle, a, b, weight);
    add_edge(log, MT_EDIT_EDGE, a, middle, a, b);
    add_edge(log, MT_EDIT_EDGE, middle, b, a, b);
    add_edge(log, MT_EDIT_NO_EDGE, a, b, MT_NONE, MT_NONE);
}

void mt_edit_split_side(mt_edit_log *log, mt_index face, mt_index other, const mt_index abc[3], mt_index middle,
                        double weight)
{
    mix_corner(log, face, middle, face, abc[0], abc[1], weight);
    if (other != MT_NONE) {
        add_vertex(log, MT_EDIT_FACE, other, face, face, 0);
        mix_corner(log, other, middle, face, abc[0], abc[1], weight);
        copy_corner(log, other, abc[1], face, abc[1]);
        copy_corner(log, other, abc[2], face, abc[2]);
    }
}

void mt_edit_split_vertex(mt_edit_log *log, mt_index v, mt_index w)
{
    add_vertex(log, MT_EDIT_VERTEX, w, v, v, 0);
}

void mt_edit_move_edge(mt_edit_log *log, mt_index v, mt_index w, mt_index end)
{
    add_edge(log, MT_EDIT_EDGE, w, end, v, end);
    add_edge(log, MT_EDIT_NO_EDGE, v, end, MT_NONE, MT_NONE);
}

void mt_edit_move_corner(mt_edit_log *log, mt_index face, mt_index v, mt_index w)
{
    copy_corner(log, face, w, face, v);
}

void mt_edit_open_edge(mt_edit_log *log, mt_index triangle, mt_index parent, mt_index v, mt_index w, mt_index x)
{
    add_vertex(log, MT_EDIT_FACE, triangle, parent, parent, 0);
    copy_corner(log, triangle, v, parent, v);
    copy_corner(log, triangle, w, parent, v);
    copy_corner(log, triangle, x, parent, x);
    add_edge(log, MT_EDIT_EDGE, w, x, v, x);
}

void mt_edit_collapse_vertex(mt_edit_log *log, const mt_edit_collapse *collapse)
{
    add_vertex(log, MT_EDIT_VERTEX, collapse->kept, collapse->kept, collapse->gone, collapse->weight);
    add_vertex(log, MT_EDIT_MERGE, collapse->kept, collapse->gone, MT_NONE, 0);
}

void mt_edit_collapse_edge(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index neighbor)
{
    add_edge(log, MT_EDIT_EDGE, collapse->kept, neighbor, collapse->gone, neighbor);
}

void mt_edit_collapse_corner(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index face, mt_index end)
{
    mt_edit_log_add(log, &(mt_edit){.kind = MT_EDIT_WEDGE,
                                    .target = face,
                                    .target_vertex = collapse->kept,
                                    .a = collapse->left,
                                    .a_vertex = end,
                                    .b = collapse->right,
                                    .b_vertex = collapse->gone,
                                    .weight = collapse->weight});
}

void mt_edit_collapse_side(mt_edit_log *log, const mt_edit_collapse *collapse, mt_index face)
{
    mix_corner(log, face, collapse->kept, face, collapse->kept, collapse->gone, collapse->weight);
}
