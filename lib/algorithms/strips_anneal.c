/* The thorough cover: simulated annealing (Kirkpatrick, Gelatt and Vecchi, "Optimization by Simulated Annealing",
 * Science 220, 1983) over all covers. A step links two neighbours and cuts what then is one link too many at either; an
 * end of a run so wanders across the mesh (one hop of the tunnels of Stewart 2001 and of Porcu and Scateni 2003) until
 * it meets another and the two vanish. Unlike tunnels, which only lower the number of runs, steps also weigh turns.
 *
 * Invariant: the links are a cover after every step. Time: a fixed number of steps, most of which look at a dozen
 * triangles; one that would be taken also walks the shorter of the two runs that it joins. Known failure: the search is
 * blind at large, so that doubling the steps still saves about half a percent. */
#include "lib/algorithms/strips_graph.h"

#include <meshtool/elementary.h>

#include <string.h>

/* Steps a triangle; small meshes get more, as they can afford it: with STEPS_SMALL / triangles more. Fewer: longer
 * strips stay unfound; more: time grows in proportion. */
#define STEPS 60.0
#define STEPS_SMALL 2e6
#define STEPS_MAXIMUM 4000.0

/* Indices that a step may cost at the beginning and at the end, in the sense of exp(-price / temperature). Hotter than
 * 0.8 forgets the greedy cover, and short searches end above it; colder at the end than 0.12 only repeats itself. */
#define TEMPERATURE_FIRST 0.6
#define TEMPERATURE_LAST 0.12

/* Sweeps over the mesh, each at one temperature and window after window, so that what a step looks at is in the cache.
 * Smaller windows: runs across their borders wait longer; larger ones: a mesh of a million triangles takes twice as
 * long. */
#define SWEEP_COUNT 64
#define WINDOW_SHIFT 15
#define WINDOW (1u << WINDOW_SHIFT)

/* Between two chances to stop: a step may walk along a run, and runs may have thousands of triangles. */
#define STEPS_A_REPORT 1024

#define PRICE_ROOM 32   /* no step costs as much */
#define END_SHARE 0.85  /* of steps that begin at the end of a run, where most gain is */
#define MOVED_MAXIMUM 4 /* triangles whose links a step changes */

typedef struct annealer {
    const strip_graph *graph;
    const strip_prices *prices;
    uint8_t *links;
    mt_index *ends; /* triangles with fewer than two links, those of each window from its first triangle's number on */
    mt_index *end_places;
    mt_index *end_counts;                       /* of each window */
    mt_index window, window_begin, window_size; /* where steps begin now */
    uint64_t random;
    uint64_t chances[PRICE_ROOM]; /* of taking a step that costs so much, of 2^32 */
} annealer;

/* Triangles with their links before and after. */
typedef struct strip_move {
    unsigned count;
    mt_index triangles[MOVED_MAXIMUM];
    uint8_t before[MOVED_MAXIMUM], after[MOVED_MAXIMUM];
    int run_change;
} strip_move;

/* SplitMix64. */
static uint64_t draw(annealer *state)
{
    uint64_t z = state->random += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* A whole number below limit from 32 random bits. */
static mt_index scale(uint32_t bits, mt_index limit)
{
    return (mt_index)((uint64_t)bits * limit >> 32);
}

/* ---- The list of ends ---- */

static void add_end(annealer *state, mt_index triangle)
{
    mt_index window = triangle >> WINDOW_SHIFT, place = (window << WINDOW_SHIFT) + state->end_counts[window]++;
    state->end_places[triangle] = place;
    state->ends[place] = triangle;
}

static void remove_end(annealer *state, mt_index triangle)
{
    mt_index window = triangle >> WINDOW_SHIFT, place = state->end_places[triangle];
    mt_index last = state->ends[(window << WINDOW_SHIFT) + --state->end_counts[window]];
    state->ends[place] = last;
    state->end_places[last] = place;
    state->end_places[triangle] = MT_NONE;
}

static void renew_end(annealer *state, mt_index triangle)
{
    bool is_end = strip_link_count(state->links[triangle]) < 2, was_end = state->end_places[triangle] != MT_NONE;
    if (is_end && !was_end) {
        add_end(state, triangle);
    } else if (!is_end && was_end) {
        remove_end(state, triangle);
    }
}

/* ---- A step ---- */

static unsigned move_index(strip_move *move, const annealer *state, mt_index triangle)
{
    for (unsigned i = 0; i < move->count; i++) {
        if (move->triangles[i] == triangle) {
            return i;
        }
    }
    unsigned i = move->count++;
    move->triangles[i] = triangle;
    move->before[i] = move->after[i] = state->links[triangle];
    return i;
}

static void change_link(strip_move *move, const annealer *state, strip_side side)
{
    strip_side other = state->graph->across[side];
    move->after[move_index(move, state, strip_triangle_of(side))] ^= (uint8_t)(1u << strip_place_of(side));
    move->after[move_index(move, state, strip_triangle_of(other))] ^= (uint8_t)(1u << strip_place_of(other));
}

/* If the triangle has two links beside `side`, cuts one of them. */
static void make_room(strip_move *move, const annealer *state, strip_side side, bool first)
{
    unsigned place = strip_place_of(side), links = move->after[move_index(move, state, strip_triangle_of(side))];
    if (strip_link_count(links) == 3) {
        unsigned cut = first ? strip_next(place) : strip_previous(place);
        change_link(move, state, (side & ~3u) | cut);
        move->run_change++;
    }
}

/* What the turns at the links of the moved triangles cost now. */
static int price_turns(const annealer *state, const strip_move *move)
{
    int price = 0;
    for (unsigned i = 0; i < move->count; i++) {
        mt_index triangle = move->triangles[i];
        unsigned links = state->links[triangle];
        while (links) {
            unsigned place = strip_first_link(links);
            links &= links - 1;
            strip_side other = strip_across(state->graph, triangle, place);
            unsigned turn = strip_turn(state->links[triangle], place);
            unsigned turn_across = strip_turn(state->links[strip_triangle_of(other)], strip_place_of(other));
            bool counted = false;
            for (unsigned j = 0; j < i; j++) {
                counted = counted || move->triangles[j] == strip_triangle_of(other);
            }
            price += counted ? 0 : strip_turn_price(state->prices, turn, turn_across);
        }
    }
    return price;
}

static void set_links(annealer *state, const strip_move *move, const uint8_t *links)
{
    for (unsigned i = 0; i < move->count; i++) {
        state->links[move->triangles[i]] = links[i];
    }
}

/* Goes one triangle on; returns false at the end of the run. */
static bool walk(const annealer *state, mt_index *triangle, unsigned *entry)
{
    unsigned exit = strip_exit(state->links[*triangle], *entry);
    if (exit == 3) {
        return false;
    }
    strip_side side = strip_across(state->graph, *triangle, exit);
    *triangle = strip_triangle_of(side);
    *entry = strip_place_of(side);
    return true;
}

/* Whether two ends are those of one run: walks from both until either walk ends. */
static bool are_ends_of_one_run(const annealer *state, mt_index a, mt_index b)
{
    mt_index from_a = a, from_b = b;
    unsigned entry_a = 3, entry_b = 3;
    for (;;) {
        if (!walk(state, &from_a, &entry_a)) {
            return from_a == b;
        }
        if (!walk(state, &from_b, &entry_b)) {
            return from_b == a;
        }
    }
}

/* Whether linking across `side` would close a ring, with the moved links in place. */
static bool closes_ring(annealer *state, strip_side side)
{
    strip_side other = state->graph->across[side];
    mt_index a = strip_triangle_of(side), b = strip_triangle_of(other);
    uint8_t bit_a = (uint8_t)(1u << strip_place_of(side)), bit_b = (uint8_t)(1u << strip_place_of(other));
    state->links[a] ^= bit_a;
    state->links[b] ^= bit_b;
    bool closes = are_ends_of_one_run(state, a, b);
    state->links[a] ^= bit_a;
    state->links[b] ^= bit_b;
    return closes;
}

static void attempt(annealer *state, const strip_move *move, strip_side linked, uint32_t luck)
{
    int price = move->run_change * state->prices->run - price_turns(state, move);
    set_links(state, move, move->after);
    price += price_turns(state, move);
    bool taken = price <= 0 || (price < PRICE_ROOM && luck < state->chances[price]);
    if (!taken || (linked != MT_NONE && closes_ring(state, linked))) {
        set_links(state, move, move->before);
        return;
    }
    for (unsigned i = 0; i < move->count; i++) {
        renew_end(state, move->triangles[i]);
    }
}

static void step(annealer *state)
{
    uint64_t first = draw(state), second = draw(state);
    mt_index end_count = state->end_counts[state->window];
    bool from_end = (uint32_t)first < (uint32_t)(END_SHARE * 4294967296.0) && end_count;
    mt_index chosen = state->window_begin + scale((uint32_t)(first >> 32), from_end ? end_count : state->window_size);
    mt_index triangle = from_end ? state->ends[chosen] : chosen;
    unsigned links = state->links[triangle], place = scale((uint32_t)(second & 0xffffu) << 16, 3);
    strip_side side = 4 * triangle + place, other = state->graph->across[side];
    strip_move move = {0};
    if (other == MT_NONE || (from_end && (links >> place & 1u))) {
        return;
    }
    change_link(&move, state, side);
    bool links_two = !(links >> place & 1u);
    move.run_change = links_two ? -1 : 1;
    if (links_two) {
        make_room(&move, state, side, second & 0x10000u);
        make_room(&move, state, other, second & 0x20000u);
    }
    attempt(state, &move, links_two ? side : MT_NONE, (uint32_t)(second >> 32));
}

/* ---- The schedule ---- */

static void set_temperature(annealer *state, double share)
{
    double temperature = TEMPERATURE_FIRST * mt_pow(TEMPERATURE_LAST / TEMPERATURE_FIRST, share);
    for (int price = 0; price < PRICE_ROOM; price++) {
        state->chances[price] = (uint64_t)(4294967296.0 * mt_exp(-price / temperature));
    }
}

/* Steps a triangle in one sweep. */
static double choose_steps(mt_index triangle_count)
{
    double steps = STEPS + STEPS_SMALL / ((double)triangle_count + 1.0);
    return (steps < STEPS_MAXIMUM ? steps : STEPS_MAXIMUM) / SWEEP_COUNT;
}

static mt_status anneal_window(mt_context *context, annealer *state, double steps, double share)
{
    mt_index left = state->graph->triangle_count - state->window_begin;
    state->window_size = left < WINDOW ? left : WINDOW;
    uint64_t count = (uint64_t)(steps * state->window_size) + 1;
    mt_status status = MT_OK;
    for (uint64_t done = 0; status == MT_OK && done < count;) {
        uint64_t end = count - done < STEPS_A_REPORT ? count : done + STEPS_A_REPORT;
        for (; done < end; done++) {
            step(state);
        }
        status = mt_progress(context, "strips", share);
    }
    return status;
}

static mt_status anneal(mt_context *context, annealer *state, mt_index window_count)
{
    double steps = choose_steps(state->graph->triangle_count);
    mt_status status = MT_OK;
    for (int sweep = 0; status == MT_OK && sweep < SWEEP_COUNT; sweep++) {
        set_temperature(state, (double)sweep / SWEEP_COUNT);
        for (mt_index window = 0; status == MT_OK && window < window_count; window++) {
            state->window = window;
            state->window_begin = window << WINDOW_SHIFT;
            status = anneal_window(context, state, steps, (sweep + (double)window / window_count) / SWEEP_COUNT);
        }
    }
    return status;
}

mt_status mt_strip_cover_anneal(mt_context *context, const strip_graph *graph, const strip_prices *prices,
                                uint8_t *links)
{
    annealer state = {.graph = graph, .prices = prices, .links = links};
    mt_index window_count = (graph->triangle_count + (WINDOW - 1)) >> WINDOW_SHIFT;
    state.ends = mt_allocate_array(context, graph->triangle_count, sizeof(mt_index));
    state.end_places = mt_allocate_array(context, graph->triangle_count, sizeof(mt_index));
    state.end_counts = mt_allocate_array_zeroed(context, window_count, sizeof(mt_index));
    bool allocated = state.ends && state.end_places && state.end_counts;
    mt_status status = allocated ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK && graph->triangle_count > 1) {
        memset(state.end_places, 0xff, graph->triangle_count * sizeof(mt_index));
        for (mt_index t = 0; t < graph->triangle_count; t++) {
            renew_end(&state, t);
        }
        status = anneal(context, &state, window_count);
    }
    mt_free(context, state.ends);
    mt_free(context, state.end_places);
    mt_free(context, state.end_counts);
    return status;
}
