/* Exact welding in two levels of open addressing with linear probing. Meshes are coherent: most corners repeat a
 * point that came shortly before. So runs of corners are welded on their own first, in parallel, by a table that
 * stays in the cache; the few points that are left go in order through one table of them all, whose slots are
 * fetched ahead; then every corner takes the number that its run's point was given. Runs are listed and merged in the
 * order of their points, so places are numbered by first occurrence.
 * Cost: linear, about 10 ns a corner when coherent and 60 when shuffled. Known failure: points made on purpose to
 * collide under the fixed hash take quadratic time. */
#include "lib/mesh/point_key.h"

#include <meshtool/weld.h>

#include <string.h>

#define RUN_LENGTH 32768u /* corners; a run's table, two slots a corner, fits the second-level cache */
#define RUN_SLOTS (2 * RUN_LENGTH)
#define RUN_INDEX_BITS 16 /* holds 1 to RUN_LENGTH, 0 is an empty slot; the other bits of a slot are of the hash */
#define BATCH 32u         /* slots fetched ahead */
#define CORNERS_A_VERTEX                                                                                               \
    5u /* six in a closed mesh of triangles; guesses the first size of the table, which may grow                       \
        */

typedef struct slot {
    uint32_t hash;
    mt_index number; /* of the place, plus 1; 0: empty */
} slot;

typedef struct weld {
    const char *positions;
    char *distinct;
    mt_type type;
    size_t stride; /* bytes of a point */
    mt_index point_count;
    mt_index *numbers;
    mt_index *run_counts; /* per run its distinct points */
    mt_index *run_starts; /* per run the first of its distinct points in places */
    mt_index *places;     /* per distinct point of a run its place */
    slot *table;          /* of all places */
    uint64_t mask, room;  /* the table's size less 1, and the places that it may hold */
    mt_index place_count;
    mt_context *context;
} weld;

/* Welds one run into the front of its own part of `distinct`. `type` is a constant where this is called. */
static inline mt_index weld_run(const weld *w, mt_index begin, mt_index end, uint32_t *table, mt_type type)
{
    size_t stride = 3 * mt_type_size(type);
    char *distinct = w->distinct + (size_t)begin * stride;
    uint32_t count = 0;
    memset(table, 0, RUN_SLOTS * sizeof *table);
    for (mt_index point = begin; point < end; point++) {
        const char *position = w->positions + (size_t)point * stride;
        point_key key = load_key(position, type);
        uint64_t hash = hash_key(key);
        uint32_t tag = (uint32_t)hash >> RUN_INDEX_BITS << RUN_INDEX_BITS;
        uint32_t at = (uint32_t)(hash >> 48) % RUN_SLOTS;
        uint32_t index = 0;
        for (;; at = (at + 1) % RUN_SLOTS) {
            uint32_t found = table[at];
            index = found & ((1u << RUN_INDEX_BITS) - 1);
            if (!index) {
                memmove(distinct + count * stride, position, stride);
                index = ++count;
                table[at] = tag | index;
                break;
            }
            if ((found ^ index) == tag && same_key(load_key(distinct + (index - 1) * stride, type), key)) {
                break;
            }
        }
        w->numbers[point] = index - 1;
    }
    return count;
}

static void weld_run_body(void *user, uint64_t begin, uint64_t end)
{
    const weld *w = user;
    uint32_t *table = mt_try_allocate(w->context, RUN_SLOTS * sizeof *table);
    mt_index count = MT_NONE; /* memory was missing */
    if (table) {
        count = w->type == MT_F32 ? weld_run(w, (mt_index)begin, (mt_index)end, table, MT_F32)
                                  : weld_run(w, (mt_index)begin, (mt_index)end, table, MT_F64);
    }
    w->run_counts[begin / RUN_LENGTH] = count;
    mt_free(w->context, table);
}

static inline const char *place_position(const weld *w, mt_index place)
{
    return w->distinct + (size_t)place * w->stride;
}

static inline mt_index find_or_add(weld *w, const char *position, uint64_t hash)
{
    point_key key = load_key(position, w->type);
    for (uint64_t at = hash & w->mask;; at = (at + 1) & w->mask) {
        slot *s = &w->table[at];
        if (!s->number) {
            mt_index place = w->place_count++;
            *s = (slot){(uint32_t)(hash >> 32), place + 1};
            memmove(w->distinct + (size_t)place * w->stride, position, w->stride);
            return place;
        }
        if (s->hash == (uint32_t)(hash >> 32) && same_key(load_key(place_position(w, s->number - 1), w->type), key)) {
            return s->number - 1;
        }
    }
}

/* A table for `count` places with a third to spare, filled with those so far. */
static mt_status make_table(weld *w, uint64_t count)
{
    uint64_t size = 64;
    while (size < count + count / 3) {
        size *= 2;
    }
    mt_free(w->context, w->table);
    w->table = mt_allocate_array_zeroed(w->context, size, sizeof *w->table);
    w->mask = size - 1;
    w->room = size - size / 4;
    for (mt_index place = 0; w->table && place < w->place_count; place++) {
        uint64_t hash = hash_key(load_key(place_position(w, place), w->type)), at = hash & w->mask;
        while (w->table[at].number) {
            at = (at + 1) & w->mask;
        }
        w->table[at] = (slot){(uint32_t)(hash >> 32), place + 1};
    }
    return w->table ? MT_OK : mt_context_error(w->context)->status;
}

/* Up to BATCH points: their slots are fetched while they are hashed, then the positions in those slots, then all are
 * looked up. Places move towards the front of `distinct` and never past the point that is being read, because there are
 * no more of them than points so far. */
static void merge_batch(weld *w, const char *points, mt_index count, mt_index *places)
{
    uint64_t hashes[BATCH];
    for (mt_index i = 0; i < count; i++) {
        hashes[i] = hash_key(load_key(points + i * w->stride, w->type));
        __builtin_prefetch(&w->table[hashes[i] & w->mask], 1);
    }
    for (mt_index i = 0; i < count; i++) {
        const slot *s = &w->table[hashes[i] & w->mask];
        if (s->number && s->hash == (uint32_t)(hashes[i] >> 32)) {
            __builtin_prefetch(place_position(w, s->number - 1));
        }
    }
    for (mt_index i = 0; i < count; i++) {
        places[i] = find_or_add(w, points + i * w->stride, hashes[i]);
    }
}

static mt_status merge_run(weld *w, mt_index run)
{
    const char *points = w->distinct + (size_t)run * RUN_LENGTH * w->stride;
    mt_index *places = w->places + w->run_starts[run];
    mt_index count = w->run_counts[run];
    mt_status status = MT_OK;
    for (mt_index first = 0; status == MT_OK && first < count; first += BATCH) {
        mt_index size = count - first < BATCH ? count - first : BATCH;
        if (w->place_count + (uint64_t)size > w->room) {
            status = make_table(w, 2 * (uint64_t)w->place_count);
        }
        if (status == MT_OK) {
            merge_batch(w, points + (size_t)first * w->stride, size, places + first);
        }
    }
    return status;
}

static void number_run_body(void *user, uint64_t begin, uint64_t end)
{
    const weld *w = user;
    const mt_index *places = w->places + w->run_starts[begin / RUN_LENGTH];
    for (uint64_t point = begin; point < end; point++) {
        w->numbers[point] = places[w->numbers[point]];
    }
}

static mt_status merge_runs(weld *w, mt_index run_count)
{
    mt_index total = 0; /* no more than point_count */
    for (mt_index run = 0; run < run_count; run++) {
        if (w->run_counts[run] == MT_NONE) {
            return mt_fail(w->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while welding %u points",
                           (unsigned)w->point_count);
        }
        w->run_starts[run] = total;
        total += w->run_counts[run];
    }
    mt_index guess = w->point_count / CORNERS_A_VERTEX + BATCH;
    w->places = mt_allocate_array(w->context, total, sizeof *w->places);
    mt_status status = w->places ? make_table(w, guess < total ? guess : total) : mt_context_error(w->context)->status;
    for (mt_index run = 0; status == MT_OK && run < run_count; run++) {
        status = merge_run(w, run);
    }
    mt_free(w->context, w->table);
    return status;
}

mt_status mt_weld_exact(mt_context *context, const void *positions, mt_type type, mt_index point_count, void *distinct,
                        mt_index *numbers, mt_index *distinct_count)
{
    mt_index run_count = point_count / RUN_LENGTH + (point_count % RUN_LENGTH != 0);
    weld w = {.positions = positions,
              .distinct = distinct,
              .type = type,
              .stride = 3 * mt_type_size(type),
              .point_count = point_count,
              .numbers = numbers,
              .context = context};
    *distinct_count = 0;
    w.run_counts = mt_allocate_array(context, run_count, sizeof *w.run_counts);
    w.run_starts = mt_allocate_array(context, run_count, sizeof *w.run_starts);
    mt_status status = w.run_counts && w.run_starts ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        mt_parallel_for(context, point_count, RUN_LENGTH, weld_run_body, &w);
        status = merge_runs(&w, run_count);
    }
    if (status == MT_OK) {
        mt_parallel_for(context, point_count, RUN_LENGTH, number_run_body, &w);
        *distinct_count = w.place_count;
    }
    mt_free(context, w.places);
    mt_free(context, w.run_starts);
    mt_free(context, w.run_counts);
    return status;
}
