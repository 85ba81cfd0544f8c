/* Runs cut into fans, or into strips and fans, for the least number of indices: dynamic programming along each run. A
 * piece in progress is a strip or a fan of one, two, or more triangles; only from the third on do turns have a price. A
 * fan can only turn one way. O(triangles). */
#include "lib/algorithms/strips_graph.h"

#include <string.h>

/* In the order in which they are preferred at the same cost. */
enum { STRIP_OF_MORE, STRIP_OF_TWO, STRIP_OF_ONE, FAN_OF_MORE, FAN_OF_TWO, FAN_OF_ONE, STATE_COUNT };

/* What a piece costs beside its triangles: two vertices and a restart. */
#define PIECE_PRICE 3
#define IMPOSSIBLE INT64_C(1000000000000000)

typedef struct run_cutter {
    const strip_graph *graph;
    bool keep_strips;
    uint8_t *links, *is_fan;
    uint8_t *done;    /* triangles of runs that were cut */
    strip_side *path; /* the triangles of a run with the sides that they are entered across; the first's is 3 */
    uint8_t *trace;   /* bits 0 to 2: the cheapest state at the triangle before; 3 and 4: whether a strip, a fan of more
                         was one before */
} run_cutter;

static mt_index list_run(const run_cutter *cutter, mt_index first)
{
    mt_index count = 0;
    strip_side side = 4 * first + 3;
    for (;;) {
        cutter->path[count++] = side;
        cutter->done[strip_triangle_of(side)] = 1;
        unsigned exit = strip_exit(cutter->links[strip_triangle_of(side)], strip_place_of(side));
        if (exit == 3) {
            return count;
        }
        side = strip_across(cutter->graph, strip_triangle_of(side), exit);
    }
}

static unsigned turn_at(const run_cutter *cutter, mt_index i)
{
    return strip_turn(cutter->links[strip_triangle_of(cutter->path[i])], strip_place_of(cutter->path[i]));
}

static unsigned cheapest(const int64_t *costs)
{
    unsigned best = 0;
    for (unsigned state = 1; state < STATE_COUNT; state++) {
        best = costs[state] < costs[best] ? state : best;
    }
    return best;
}

/* Goes on to triangle i. The turn of the one before then counts, and its price if the one before that turned too. */
static uint8_t extend(const run_cutter *cutter, mt_index i, int64_t *costs)
{
    bool equal = i >= 3 && turn_at(cutter, i - 1) == turn_at(cutter, i - 2);
    unsigned before = cheapest(costs);
    int64_t begun = costs[before] + PIECE_PRICE;
    int64_t strip = costs[STRIP_OF_MORE] + equal, fan = equal ? costs[FAN_OF_MORE] : IMPOSSIBLE;
    bool strip_goes_on = strip <= costs[STRIP_OF_TWO], fan_goes_on = fan <= costs[FAN_OF_TWO];
    costs[STRIP_OF_MORE] = strip_goes_on ? strip : costs[STRIP_OF_TWO];
    costs[FAN_OF_MORE] = fan_goes_on ? fan : costs[FAN_OF_TWO];
    costs[STRIP_OF_TWO] = costs[STRIP_OF_ONE];
    costs[FAN_OF_TWO] = costs[FAN_OF_ONE];
    costs[STRIP_OF_ONE] = cutter->keep_strips ? begun : IMPOSSIBLE;
    costs[FAN_OF_ONE] = begun;
    return (uint8_t)(before | (unsigned)strip_goes_on << 3 | (unsigned)fan_goes_on << 4);
}

static void cut_before(const run_cutter *cutter, mt_index i)
{
    strip_side side = cutter->path[i], other = cutter->graph->across[side];
    cutter->links[strip_triangle_of(side)] &= (uint8_t) ~(1u << strip_place_of(side));
    cutter->links[strip_triangle_of(other)] &= (uint8_t) ~(1u << strip_place_of(other));
}

static void apply(const run_cutter *cutter, mt_index count, unsigned state)
{
    for (mt_index i = count; i-- > 0;) {
        cutter->is_fan[strip_triangle_of(cutter->path[i])] = state >= FAN_OF_MORE;
        if (state == STRIP_OF_ONE || state == FAN_OF_ONE) {
            if (i > 0) {
                cut_before(cutter, i);
            }
            state = cutter->trace[i] & 7u;
        } else if (!(state == STRIP_OF_MORE && cutter->trace[i] >> 3 & 1u) &&
                   !(state == FAN_OF_MORE && cutter->trace[i] >> 4 & 1u)) {
            state++;
        }
    }
}

static void cut_run(const run_cutter *cutter, mt_index first)
{
    mt_index count = list_run(cutter, first);
    int64_t costs[STATE_COUNT];
    for (unsigned state = 0; state < STATE_COUNT; state++) {
        costs[state] = IMPOSSIBLE;
    }
    costs[FAN_OF_ONE] = PIECE_PRICE;
    costs[STRIP_OF_ONE] = cutter->keep_strips ? PIECE_PRICE : IMPOSSIBLE;
    for (mt_index i = 1; i < count; i++) {
        cutter->trace[i] = extend(cutter, i, costs);
    }
    apply(cutter, count, cheapest(costs));
}

mt_status mt_strip_cut_fans(mt_context *context, const strip_graph *graph, bool keep_strips, uint8_t *links,
                            uint8_t *is_fan)
{
    run_cutter cutter = {.graph = graph, .keep_strips = keep_strips, .links = links, .is_fan = is_fan};
    cutter.path = mt_allocate_array(context, graph->triangle_count, sizeof(strip_side));
    cutter.trace = mt_allocate(context, graph->triangle_count);
    cutter.done = mt_allocate_zeroed(context, graph->triangle_count);
    bool allocated = cutter.path && cutter.trace && cutter.done;
    for (mt_index t = 0; allocated && t < graph->triangle_count; t++) {
        if (!cutter.done[t] && strip_link_count(links[t]) < 2) {
            cut_run(&cutter, t);
        }
    }
    mt_free(context, cutter.done);
    mt_free(context, cutter.trace);
    mt_free(context, cutter.path);
    return allocated ? MT_OK : mt_context_error(context)->status;
}
