/* Walks once around vertices, counts what it meets, and finds a vertex that is met twice on one ring. Where sides have
 * been joined two by two, each to one that runs the other way, the structure is sound exactly if every ring meets each
 * neighbour once and all rings together meet everything: a second fan at a vertex is missed by its ring, and an edge of
 * further faces, or of faces that run the same way, has become two edges between the same vertices.
 *
 * Several vertices are walked around at once, one a lane, since each step must wait for memory; so is their comparing.
 * Cost: O(steps), some 1.5 ns each where neighbours lie near each other in memory. */
#ifndef MT_TOPOLOGY_RING_CHECK_H
#define MT_TOPOLOGY_RING_CHECK_H

#include "lib/topology/inline.h"

#include <meshtool/context.h>

#include <stdatomic.h>
#include <string.h>

#define RING_LANES 8
#define RING_USUAL_ROWS 6    /* steps that lanes take together, enough for most rings of triangles */
#define RING_ROWS 8          /* steps that they take where one needs more; longer rings are walked alone */
#define RING_LENGTH_MAX 1024 /* longer ones are not decided: comparing each with each would cost too much */
#define RING_WALKERS 64
#define RING_GRAIN 16384

typedef struct ring_step {
    mt_index neighbor; /* a vertex next to the ring's own */
    mt_index next;     /* where the ring goes on, never MT_NONE */
} ring_step;

typedef ring_step (*ring_walk)(const void *structure, mt_index vertex, mt_index at);

/* What the step from there reads first. */
typedef const void *(*ring_place)(const void *structure, mt_index at);

typedef struct ring_check {
    const void *structure;
    const mt_index *vertex_begins; /* where each vertex's ring begins, MT_NONE: it has none */
    bool edges_are_known;          /* no neighbour can be met twice: rings are only counted */
    atomic_ullong met;             /* steps of all rings */
    atomic_bool unsound;           /* a neighbour was met twice, or a ring is too long */
} ring_check;

typedef struct ring_tally {
    uint64_t met;
    bool unsound;
} ring_tally;

typedef struct ring_walker {
    mt_index vertex, begin, at;
} ring_walker;

/* Whether all rings of the vertices are sound and together take this many steps. */
static inline bool ring_check_holds(mt_context *context, mt_parallel_body body, ring_check *check,
                                    mt_index vertex_count, uint64_t step_count)
{
    mt_parallel_for(context, vertex_count, RING_GRAIN, body, check);
    return !check->unsound && check->met == step_count;
}

MT_ALWAYS_INLINE void ring_check_alone(ring_walk walk, const void *structure, mt_index vertex, mt_index begin,
                                       ring_tally *tally)
{
    mt_index seen[RING_LENGTH_MAX];
    mt_index length = 0, at = begin, repeated = 0;
    do {
        ring_step step = walk(structure, vertex, at);
        for (mt_index i = 0; i < length; i++) {
            repeated |= seen[i] == step.neighbor;
        }
        seen[length++] = step.neighbor;
        at = step.next;
    } while (at != begin && length < RING_LENGTH_MAX);
    tally->unsound |= repeated || at != begin;
    tally->met += length;
}

/* One value of some lanes each, as many as any processor compares at once; comparing gives all bits set or none. */
#define RING_VECTOR_LANES 4
typedef mt_index ring_vector __attribute__((vector_size(RING_VECTOR_LANES * sizeof(mt_index))));

MT_ALWAYS_INLINE ring_vector ring_vector_load(const mt_index *lanes)
{
    ring_vector vector;
    memcpy(&vector, lanes, sizeof vector);
    return vector;
}

typedef struct ring_lanes {
    mt_index at[RING_ROWS + 1][RING_LANES]; /* the first row: where rings begin */
    mt_index seen[RING_ROWS][RING_LANES];
    mt_index vertices[RING_LANES];
} ring_lanes;

MT_ALWAYS_INLINE void ring_lanes_walk(ring_walk walk, const void *structure, ring_lanes *lanes, mt_index from,
                                      mt_index to)
{
    for (mt_index row = from; row < to; row++) {
        for (mt_index i = 0; i < RING_LANES; i++) {
            ring_step step = walk(structure, lanes->vertices[i], lanes->at[row][i]);
            lanes->seen[row][i] = step.neighbor;
            lanes->at[row + 1][i] = step.next;
        }
    }
}

/* What is found out about some rings at once. */
typedef struct ring_verdict {
    ring_vector open, repeated, lengths;
} ring_verdict;

/* Looks at so many rows of the lanes from `lane` on. */
MT_ALWAYS_INLINE void ring_lanes_judge(const ring_lanes *lanes, mt_index lane, mt_index rows, ring_verdict *verdict)
{
    ring_vector begins = ring_vector_load(&lanes->at[0][lane]);
    ring_vector inside = ~(ring_vector){0};
    for (mt_index row = 0; row < rows; row++) {
        ring_vector seen = ring_vector_load(&lanes->seen[row][lane]);
        for (mt_index earlier = 0; earlier < row; earlier++) {
            verdict->repeated |= (ring_vector)(seen == ring_vector_load(&lanes->seen[earlier][lane])) & inside;
        }
        verdict->lengths -= inside;
        inside &= (ring_vector)(ring_vector_load(&lanes->at[row + 1][lane]) != begins);
    }
    verdict->open |= inside;
}

/* False, with nothing told, when some ring is longer. */
MT_ALWAYS_INLINE bool ring_lanes_compare(const ring_lanes *lanes, mt_index rows, ring_tally *tally)
{
    ring_verdict verdict = {{0}, {0}, {0}};
    for (mt_index lane = 0; lane < RING_LANES; lane += RING_VECTOR_LANES) {
        ring_lanes_judge(lanes, lane, rows, &verdict);
    }
    mt_index open = 0, repeated = 0, length = 0;
    for (mt_index i = 0; i < RING_VECTOR_LANES; i++) {
        open |= verdict.open[i];
        repeated |= verdict.repeated[i];
        length += verdict.lengths[i];
    }
    if (open) {
        return false;
    }
    tally->unsound |= repeated != 0;
    tally->met += length;
    return true;
}

MT_ALWAYS_INLINE void ring_check_lanes(ring_walk walk, const void *structure, ring_lanes *lanes, ring_tally *tally)
{
    ring_lanes_walk(walk, structure, lanes, 0, RING_USUAL_ROWS);
    if (ring_lanes_compare(lanes, RING_USUAL_ROWS, tally)) {
        return;
    }
    ring_lanes_walk(walk, structure, lanes, RING_USUAL_ROWS, RING_ROWS);
    if (ring_lanes_compare(lanes, RING_ROWS, tally)) {
        return;
    }
    for (mt_index i = 0; i < RING_LANES; i++) {
        ring_check_alone(walk, structure, lanes->vertices[i], lanes->at[0][i], tally);
    }
}

MT_ALWAYS_INLINE void ring_compare_vertices(ring_walk walk, const ring_check *check, uint64_t begin, uint64_t end,
                                            ring_tally *tally)
{
    const void *structure = check->structure;
    const mt_index *begins = check->vertex_begins;
    ring_lanes lanes;
    mt_index count = 0;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_index at = begins[vertex];
        lanes.vertices[count] = (mt_index)vertex;
        lanes.at[0][count] = at;
        count += at != MT_NONE;
        if (count == RING_LANES) {
            ring_check_lanes(walk, structure, &lanes, tally);
            count = 0;
        }
    }
    for (mt_index i = 0; i < count; i++) {
        ring_check_alone(walk, structure, lanes.vertices[i], lanes.at[0][i], tally);
    }
}

/* Memory is asked for the place of a walker's next step as soon as that is known: else, where neighbours lie far apart,
 * each ring's end, which cannot be foreseen, would stop all that wait. */
MT_ALWAYS_INLINE void ring_count_vertices(ring_walk walk, ring_place place, const ring_check *check, uint64_t begin,
                                          uint64_t end, ring_tally *tally)
{
    ring_walker walkers[RING_WALKERS];
    mt_index active = 0;
    for (uint64_t vertex = begin; vertex < end || active > 0;) {
        while (active < RING_WALKERS && vertex < end) {
            mt_index at = check->vertex_begins[vertex];
            walkers[active] = (ring_walker){(mt_index)vertex++, at, at};
            if (at != MT_NONE) {
                __builtin_prefetch(place(check->structure, at));
                active++;
            }
        }
        for (mt_index i = 0; i < active;) {
            ring_walker *walker = &walkers[i];
            walker->at = walk(check->structure, walker->vertex, walker->at).next;
            tally->met++;
            if (walker->at == walker->begin) {
                *walker = walkers[--active];
            } else {
                __builtin_prefetch(place(check->structure, walker->at));
                i++;
            }
        }
    }
}

/* The body of a parallel loop over vertices, for one kind of walk. */
MT_ALWAYS_INLINE void ring_check_vertices(ring_walk walk, ring_place place, ring_check *check, uint64_t begin,
                                          uint64_t end)
{
    ring_tally tally = {0};
    if (check->edges_are_known) {
        ring_count_vertices(walk, place, check, begin, end, &tally);
    } else {
        ring_compare_vertices(walk, check, begin, end, &tally);
    }
    atomic_fetch_add(&check->met, tally.met);
    if (tally.unsound) {
        check->unsound = true;
    }
}

#endif
