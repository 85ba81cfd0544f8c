/* The fast cover: runs grow both ways from the triangle that has the fewest neighbours left, as in Akeley's "tomesh"
 * (Silicon Graphics, 1990), so that few are left alone. Where a run could go on without a price it does; where it can
 * only turn to the dearer side it takes that while it costs less than a new run. O(triangles). */
#include "lib/algorithms/strips_graph.h"

#include <string.h>

#define TAKEN 4 /* in place of a count of free neighbours */

/* Triangles by their number of free neighbours, 0 to 2: each enters a stack when its number falls to it, and is out of
 * date when it has fallen further. Those of 3 are found in their order. */
typedef struct greedy_state {
    const strip_graph *graph;
    const strip_prices *prices;
    uint8_t *links;
    uint8_t *free_count;
    mt_index *stacks[3];
    mt_index stack_counts[3];
    mt_index first_of_three;
} greedy_state;

static bool is_free(const greedy_state *state, mt_index triangle, unsigned place)
{
    strip_side across = strip_across(state->graph, triangle, place);
    return across != MT_NONE && state->free_count[strip_triangle_of(across)] != TAKEN;
}

static void push(greedy_state *state, mt_index triangle)
{
    unsigned count = state->free_count[triangle];
    if (count < 3) {
        state->stacks[count][state->stack_counts[count]++] = triangle;
    }
}

static void take(greedy_state *state, mt_index triangle)
{
    state->free_count[triangle] = TAKEN;
    for (unsigned place = 0; place < 3; place++) {
        if (is_free(state, triangle, place)) {
            mt_index neighbor = strip_triangle_of(strip_across(state->graph, triangle, place));
            state->free_count[neighbor]--;
            push(state, neighbor);
        }
    }
}

/* MT_NONE when all are taken. */
static mt_index choose_start(greedy_state *state)
{
    for (unsigned count = 0; count < 3; count++) {
        while (state->stack_counts[count]) {
            mt_index triangle = state->stacks[count][--state->stack_counts[count]];
            if (state->free_count[triangle] == count) {
                return triangle;
            }
        }
    }
    while (state->first_of_three < state->graph->triangle_count) {
        mt_index triangle = state->first_of_three++;
        if (state->free_count[triangle] != TAKEN) {
            return triangle;
        }
    }
    return MT_NONE;
}

/* The free side whose neighbour has the fewest free ones, 3 for none. */
static unsigned neediest(const greedy_state *state, mt_index triangle)
{
    unsigned best = 3, best_count = TAKEN;
    for (unsigned place = 0; place < 3; place++) {
        if (is_free(state, triangle, place)) {
            unsigned count = state->free_count[strip_triangle_of(strip_across(state->graph, triangle, place))];
            best = count < best_count ? place : best;
            best_count = count < best_count ? count : best_count;
        }
    }
    return best;
}

/* Where a run that came across `entry` goes on, 3 for nowhere. `turn` is that of the triangle before (strip_turn on its
 * side of the link), 0 for none. */
static unsigned choose_exit(const greedy_state *state, mt_index triangle, unsigned entry, unsigned turn)
{
    const strip_prices *prices = state->prices;
    if (!turn) {
        return neediest(state, triangle);
    }
    bool same = prices->alternate <= prices->equal; /* turns that alternate look the same from both sides of a link */
    unsigned sides[3] = {3, strip_next(entry), strip_previous(entry)};
    unsigned cheap = sides[same ? turn : 3 - turn], dear = sides[same ? 3 - turn : turn];
    int dear_price = same ? prices->equal : prices->alternate;
    if (is_free(state, triangle, cheap)) {
        return cheap;
    }
    return dear_price < prices->run && is_free(state, triangle, dear) ? dear : 3;
}

static void grow(greedy_state *state, mt_index triangle, unsigned exit)
{
    while (exit < 3) {
        strip_side entered = strip_across(state->graph, triangle, exit);
        unsigned turn = strip_turn(state->links[triangle], exit), entry = strip_place_of(entered);
        state->links[triangle] |= (uint8_t)(1u << exit);
        triangle = strip_triangle_of(entered);
        state->links[triangle] |= (uint8_t)(1u << entry);
        take(state, triangle);
        exit = choose_exit(state, triangle, entry, turn);
    }
}

static void cover(greedy_state *state)
{
    for (mt_index start = choose_start(state); start != MT_NONE; start = choose_start(state)) {
        take(state, start);
        grow(state, start, neediest(state, start));
        unsigned first = strip_first_link(state->links[start]);
        if (first < 3) {
            strip_side other = strip_across(state->graph, start, first);
            unsigned turn = strip_turn(state->links[strip_triangle_of(other)], strip_place_of(other));
            grow(state, start, choose_exit(state, start, first, turn));
        }
    }
}

static void count_free(greedy_state *state)
{
    for (mt_index t = state->graph->triangle_count; t-- > 0;) {
        unsigned count = 0;
        for (unsigned place = 0; place < 3; place++) {
            count += strip_across(state->graph, t, place) != MT_NONE;
        }
        state->free_count[t] = (uint8_t)count;
        push(state, t);
    }
}

mt_status mt_strip_cover_greedily(mt_context *context, const strip_graph *graph, const strip_prices *prices,
                                  uint8_t *links)
{
    greedy_state state = {.graph = graph, .prices = prices, .links = links};
    state.free_count = mt_allocate(context, graph->triangle_count);
    mt_index *memory = mt_allocate_array(context, graph->triangle_count, 3 * sizeof(mt_index));
    bool done = state.free_count && memory;
    for (size_t i = 0; i < 3 && done; i++) {
        state.stacks[i] = memory + i * graph->triangle_count;
    }
    if (done) {
        count_free(&state);
        cover(&state);
    }
    mt_free(context, memory);
    mt_free(context, state.free_count);
    return done ? MT_OK : mt_context_error(context)->status;
}
