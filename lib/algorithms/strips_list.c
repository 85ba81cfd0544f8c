/* Strips come in the order of their lowest end. One that is done goes on with a run that begins at its last vertex, if
 * there is one whose first turn then needs no swap: two triangles without area and no restart. O(triangles + vertices).
 */
#include "lib/algorithms/strips_list.h"

#include "lib/algorithms/strips_emit.h"

#include <meshtool/checked.h>

#include <string.h>

/* Both ends of a run, in any order; one triangle is both. */
typedef struct strip_run {
    mt_index ends[2];
    bool is_fan, is_done;
} strip_run;

/* Of the ends at a vertex, those with each first turn are a list: 3 * run + end, of a run of one triangle + corner. */
typedef struct run_lister {
    const strip_graph *graph;
    const uint8_t *links;
    strip_run *runs;
    mt_index run_count;
    mt_index *heads; /* 3 a vertex; NULL when strips are not to go on so */
    mt_index *nexts; /* 3 a run */
    strip_emitter emitter;
} run_lister;

static mt_index find_other_end(const strip_graph *graph, const uint8_t *links, mt_index end)
{
    unsigned exit = strip_first_link(links[end]);
    while (exit < 3) {
        strip_side entered = strip_across(graph, end, exit);
        end = strip_triangle_of(entered);
        exit = strip_exit(links[end], strip_place_of(entered));
    }
    return end;
}

static mt_index count_ends(const strip_graph *graph, const uint8_t *links)
{
    mt_index count = 0;
    for (mt_index t = 0; t < graph->triangle_count; t++) {
        count += 2 - strip_link_count(links[t]);
    }
    return count;
}

/* An end is passed when its run was found from the other one. */
static void find_runs(run_lister *lister, const uint8_t *is_fan)
{
    for (mt_index t = 0; t < lister->graph->triangle_count; t++) {
        if (strip_link_count(lister->links[t]) < 2) {
            mt_index other = find_other_end(lister->graph, lister->links, t);
            if (t <= other) {
                lister->runs[lister->run_count++] = (strip_run){{t, other}, is_fan && is_fan[t], false};
            }
        }
    }
}

/* ---- Ends by vertex and turn ---- */

static mt_index end_triangle(const run_lister *lister, mt_index entry)
{
    const strip_run *run = &lister->runs[entry / 3];
    return run->ends[run->ends[0] == run->ends[1] ? 0 : entry % 3];
}

static unsigned end_corner(const run_lister *lister, mt_index entry)
{
    const strip_run *run = &lister->runs[entry / 3];
    bool single = run->ends[0] == run->ends[1];
    return single ? entry % 3 : mt_strip_end_corner(lister->links, run->ends[entry % 3]);
}

static void enter_end(run_lister *lister, mt_index entry)
{
    mt_index triangle = end_triangle(lister, entry);
    mt_index vertex = strip_vertex(lister->graph, triangle, end_corner(lister, entry));
    mt_index *head = &lister->heads[3 * (size_t)vertex + mt_strip_end_turn(lister->graph, lister->links, triangle)];
    lister->nexts[entry] = *head;
    *head = entry;
}

static bool is_degenerate(const strip_graph *graph, mt_index t)
{
    mt_index a = strip_vertex(graph, t, 0), b = strip_vertex(graph, t, 1), c = strip_vertex(graph, t, 2);
    return a == b || b == c || c == a;
}

static bool stays_alone(const run_lister *lister, const strip_run *run)
{
    return run->is_fan || (run->ends[0] == run->ends[1] && is_degenerate(lister->graph, run->ends[0]));
}

static void enter_ends(run_lister *lister)
{
    memset(lister->heads, 0xff, 3 * (size_t)lister->graph->vertex_count * sizeof(mt_index));
    for (mt_index i = lister->run_count; i-- > 0;) {
        const strip_run *run = &lister->runs[i];
        bool single = run->ends[0] == run->ends[1];
        mt_index end_count = stays_alone(lister, run) ? 0 : single ? 3 : 2;
        for (mt_index end = 0; end < end_count; end++) {
            enter_end(lister, 3 * i + end);
        }
    }
}

/* An end in this list whose run is not done, MT_NONE for none. */
static mt_index pop_end(const run_lister *lister, mt_index *head)
{
    while (*head != MT_NONE && lister->runs[*head / 3].is_done) {
        *head = lister->nexts[*head];
    }
    return *head;
}

/* An end at which the strip being written, the last run of which is given, can go on without a swap. */
static mt_index find_next_end(const run_lister *lister, const strip_run *last)
{
    const strip_emitter *emitter = &lister->emitter;
    if (!lister->heads || stays_alone(lister, last)) {
        return MT_NONE;
    }
    mt_index *heads = lister->heads + 3 * (size_t)emitter->strips->indices[emitter->index_count - 1];
    bool odd = (emitter->index_count - emitter->strip_begin) % 2;
    mt_index entry = pop_end(lister, heads + (odd ? 1 : 2));
    return entry != MT_NONE ? entry : pop_end(lister, heads);
}

/* ---- Writing ---- */

/* The end, 0 or 1, from which a strip of its own needs no swap at its beginning, if there is one. */
static mt_index choose_end(const run_lister *lister, const strip_run *run)
{
    bool first_swaps = mt_strip_end_turn(lister->graph, lister->links, run->ends[0]) == 1;
    return first_swaps && mt_strip_end_turn(lister->graph, lister->links, run->ends[1]) != 1 ? 1 : 0;
}

static void write_run(run_lister *lister, mt_index entry)
{
    lister->runs[entry / 3].is_done = true;
    mt_strip_emit_run(&lister->emitter, end_triangle(lister, entry), end_corner(lister, entry));
}

/* By four triangles without area: the last vertex and the next run's first are repeated. */
static void reach(run_lister *lister, mt_index entry)
{
    strip_emitter *emitter = &lister->emitter;
    mt_index vertex = strip_vertex(lister->graph, end_triangle(lister, entry), end_corner(lister, entry));
    mt_strip_emit_index(emitter, emitter->strips->indices[emitter->index_count - 1]);
    mt_strip_emit_index(emitter, vertex);
}

static mt_index choose_entry(const run_lister *lister, mt_index i)
{
    return 3 * i + choose_end(lister, &lister->runs[i]);
}

static void write_strips(run_lister *lister)
{
    strip_emitter *emitter = &lister->emitter;
    bool one_strip = emitter->strips->join == MT_STRIP_JOIN_DEGENERATE;
    for (mt_index i = 0; i < lister->run_count; i++) {
        if (lister->runs[i].is_done || lister->runs[i].is_fan) {
            continue;
        }
        mt_index entry = choose_entry(lister, i);
        if (one_strip && emitter->index_count) {
            reach(lister, entry);
        }
        while (entry != MT_NONE) {
            write_run(lister, entry);
            entry = find_next_end(lister, &lister->runs[entry / 3]);
        }
        if (!one_strip) {
            mt_strip_emit_end(emitter);
        }
    }
    if (one_strip && emitter->index_count) {
        mt_strip_emit_end(emitter);
    }
}

static void write_fans(run_lister *lister)
{
    strip_emitter *emitter = &lister->emitter;
    emitter->strips->fan_begin = emitter->strips->strip_count;
    for (mt_index i = 0; i < lister->run_count; i++) {
        const strip_run *run = &lister->runs[i];
        if (run->is_fan) {
            bool other = mt_strip_end_turn(lister->graph, lister->links, run->ends[0]) == 1;
            mt_strip_emit_fan(emitter, run->ends[other]);
            mt_strip_emit_end(emitter);
        }
    }
}

/* ---- Memory ---- */

/* A run of n triangles takes at most 2 n + 1 indices, and 2 join it to another. */
static mt_status allocate_strips(mt_context *context, run_lister *lister, mt_index run_count, mt_index face_count)
{
    mt_strips *strips = lister->emitter.strips;
    uint64_t room = 2 * (uint64_t)strips->triangle_count + 3 * (uint64_t)run_count;
    if (!mt_count_fits(room)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE,
                       "strips of %u triangles could take %llu indices, which are too many", strips->triangle_count,
                       (unsigned long long)room);
    }
    strips->offsets = mt_allocate_array(context, run_count + (uint64_t)1, sizeof(mt_index));
    strips->indices = mt_allocate_array(context, room, sizeof(mt_index));
    strips->faces = mt_allocate_array(context, strips->triangle_count, sizeof(mt_index));
    strips->face_runs = mt_allocate_array(context, face_count, sizeof(mt_index));
    lister->runs = mt_allocate_array(context, run_count, sizeof *lister->runs);
    bool done = strips->offsets && strips->indices && strips->faces && strips->face_runs && lister->runs;
    return done ? MT_OK : mt_context_error(context)->status;
}

static mt_status allocate_ends(mt_context *context, run_lister *lister, mt_index run_count)
{
    if (lister->emitter.strips->join == MT_STRIP_JOIN_NONE) {
        return MT_OK;
    }
    lister->heads = mt_allocate_array(context, lister->graph->vertex_count, 3 * sizeof(mt_index));
    lister->nexts = mt_allocate_array(context, run_count, 3 * sizeof(mt_index));
    return lister->heads && lister->nexts ? MT_OK : mt_context_error(context)->status;
}

static mt_status shrink(mt_context *context, mt_strips *strips)
{
    mt_index count = strips->offsets[strips->strip_count];
    mt_index *indices = mt_reallocate(context, strips->indices, count * sizeof(mt_index));
    mt_index *offsets = mt_reallocate(context, strips->offsets, (strips->strip_count + (uint64_t)1) * sizeof(mt_index));
    strips->indices = indices ? indices : strips->indices;
    strips->offsets = offsets ? offsets : strips->offsets;
    return indices && offsets ? MT_OK : mt_context_error(context)->status;
}

static void write_all(run_lister *lister, const uint8_t *is_fan)
{
    find_runs(lister, is_fan);
    if (lister->heads) {
        enter_ends(lister);
    }
    lister->emitter.strips->offsets[0] = 0;
    write_strips(lister);
    write_fans(lister);
}

mt_status mt_strip_list(mt_context *context, const strip_graph *graph, const uint8_t *links, const uint8_t *is_fan,
                        mt_strips *strips)
{
    run_lister lister = {.graph = graph, .links = links, .emitter = {.graph = graph, .links = links, .strips = strips}};
    mt_index run_count = count_ends(graph, links) / 2, face_count = graph->face_count;
    strips->triangle_count = graph->triangle_count;
    mt_status status = allocate_strips(context, &lister, run_count, face_count);
    if (status == MT_OK) {
        status = allocate_ends(context, &lister, run_count);
    }
    if (status == MT_OK) {
        write_all(&lister, is_fan);
        status = shrink(context, strips);
    }
    mt_free(context, lister.heads);
    mt_free(context, lister.nexts);
    mt_free(context, lister.runs);
    return status;
}
