/* Ear clipping (Meisters, "Polygons have ears", 1975) after Held, "FIST: Fast Industrial-Strength Triangulation of
 * Polygons", Algorithmica 30 (2001), with exact predicates and a tree in place of his grid.
 *
 * Invariant: what is left is a polygon whose corners are a ring, and the triangles cut off so far and the rest cover
 * the input. In a polygon that touches itself at most (a simple one, a keyhole around holes) cutting an ear changes
 * only whether its two neighbours are ears, so each corner is tested once, and twice for each ear cut. Ears are taken
 * in the order in which they became candidates: from a convex polygon every second corner goes first, and triangles
 * stay fat.
 *
 * Straight corners are left until triangles of positive area have used them; repeated points go first, for no
 * triangulation can use them. When no ear is left (flat remains, a crossing) the rules are loosened step by step;
 * the budget keeps the cost of that within a constant number of passes.
 *
 * Cost: O(n log n) in practice; O(n) without corners that turn right. About 90 bytes a corner.
 * Known failure: a polygon that crosses itself gets triangles that overlap or turn over. */
#include "lib/mesh/ear_clipping.h"

#include "lib/mesh/blockers.h"

#include <meshtool/predicates.h>

#include <string.h>

/* Tests that may be spent on finding ears again after the rules were loosened: so many passes over the corners, fewer
 * for large polygons. Less: touching polygons get overlapping triangles; more: a crossing polygon takes longer. */
#define RETEST_PASSES 64
#define RETEST_PASSES_LARGE 4
#define RETEST_COUNT_LARGE ((uint64_t)1 << 18)

typedef enum corner_kind { KIND_REFLEX, KIND_FLAT, KIND_CONVEX, KIND_REPEATED } corner_kind;

/* Lists of corners: each corner is in at most one. Their heads stand behind the corners in the arrays. */
typedef enum list_name { LIST_CANDIDATES, LIST_FLAT, LIST_BLOCKED, LIST_COUNT } list_name;

typedef struct ear_clipper {
    mt_point2 *points;
    mt_index count;            /* of the input */
    mt_index left;             /* corners of what is left */
    mt_index *previous, *next; /* the ring */
    mt_index *before, *after;  /* the lists */
    int8_t *turns;             /* as they were at the beginning */
    mt_blockers blockers;
    mt_index *triangle; /* where the next one goes */
    uint64_t budget;    /* tests that may still be spent on loosened rules */
} ear_clipper;

/* ---- memory ---- */

/* Reserves `size` bytes; without a base only counts. */
static void *take(char *base, size_t *used, size_t size)
{
    void *block = base ? base + *used : NULL;
    *used += (size + 15) / 16 * 16;
    return block;
}

/* Lays the arrays out from `base`, which may be NULL; returns the bytes used. */
static size_t lay_out(ear_clipper *clipper, mt_blocker_memory *memory, mt_index count, char *base)
{
    size_t used = 0;
    size_t indices = count * sizeof(mt_index), listed = ((size_t)count + LIST_COUNT) * sizeof(mt_index);
    memory->boxes = take(base, &used, mt_blocker_box_count(count) * sizeof(mt_box2));
    memory->keys = take(base, &used, count * sizeof(uint64_t));
    memory->slots = take(base, &used, indices);
    memory->slot_of = take(base, &used, indices);
    memory->scratch = take(base, &used, indices);
    memory->has_twin = take(base, &used, count * sizeof(bool));
    clipper->previous = take(base, &used, indices);
    clipper->next = take(base, &used, indices);
    clipper->before = take(base, &used, listed);
    clipper->after = take(base, &used, listed);
    clipper->turns = take(base, &used, count);
    return used;
}

uint64_t mt_ear_clipping_size(mt_index count)
{
    ear_clipper clipper;
    mt_blocker_memory memory;
    return lay_out(&clipper, &memory, count, NULL);
}

/* ---- lists ---- */

static mt_index head_of(const ear_clipper *clipper, list_name list)
{
    return clipper->count + (mt_index)list;
}

static void unlink_corner(ear_clipper *clipper, mt_index corner)
{
    clipper->after[clipper->before[corner]] = clipper->after[corner];
    clipper->before[clipper->after[corner]] = clipper->before[corner];
    clipper->before[corner] = clipper->after[corner] = corner;
}

/* The corner is in no list, and `place` is not the corner. */
static void link_after(ear_clipper *clipper, mt_index corner, mt_index place)
{
    mt_index follower = clipper->after[place];
    clipper->before[corner] = place;
    clipper->after[corner] = follower;
    clipper->after[place] = corner;
    clipper->before[follower] = corner;
}

static void append(ear_clipper *clipper, mt_index corner, list_name list)
{
    unlink_corner(clipper, corner);
    link_after(clipper, corner, clipper->before[head_of(clipper, list)]);
}

static mt_index first_of(const ear_clipper *clipper, list_name list)
{
    mt_index first = clipper->after[head_of(clipper, list)];
    return first < clipper->count ? first : MT_NONE;
}

/* ---- corners ---- */

static int turn_at(const ear_clipper *clipper, mt_index corner)
{
    return mt_orient2d(clipper->points[clipper->previous[corner]], clipper->points[corner],
                       clipper->points[clipper->next[corner]]);
}

static bool is_repeated(const ear_clipper *clipper, mt_index corner)
{
    const double *point = clipper->points[corner];
    return mt_point2_equal(point, clipper->points[clipper->previous[corner]]) ||
           mt_point2_equal(point, clipper->points[clipper->next[corner]]);
}

static corner_kind kind_of(const ear_clipper *clipper, mt_index corner, int turn)
{
    if (turn != 0) {
        return turn > 0 ? KIND_CONVEX : KIND_REFLEX;
    }
    return is_repeated(clipper, corner) ? KIND_REPEATED : KIND_FLAT;
}

static void enlist(ear_clipper *clipper, mt_index corner, int turn)
{
    switch (kind_of(clipper, corner, turn)) {
    case KIND_CONVEX:
        append(clipper, corner, LIST_CANDIDATES);
        break;
    case KIND_REPEATED:
        unlink_corner(clipper, corner);
        link_after(clipper, corner, head_of(clipper, LIST_CANDIDATES));
        break;
    case KIND_FLAT:
        append(clipper, corner, LIST_FLAT);
        break;
    case KIND_REFLEX:
        unlink_corner(clipper, corner);
        break;
    }
}

/* A corner's neighbour was cut off: it may have become an ear, and may block others no more. */
static void reconsider(ear_clipper *clipper, mt_index corner)
{
    int turn = turn_at(clipper, corner);
    enlist(clipper, corner, turn);
    if (turn > 0 && clipper->blockers.count && !clipper->blockers.has_twin[corner]) {
        mt_blockers_remove(&clipper->blockers, corner);
    }
}

static void emit(ear_clipper *clipper, mt_index a, mt_index b, mt_index c)
{
    clipper->triangle[0] = a;
    clipper->triangle[1] = b;
    clipper->triangle[2] = c;
    clipper->triangle += 3;
}

static void cut_off(ear_clipper *clipper, mt_index corner)
{
    mt_index previous = clipper->previous[corner], next = clipper->next[corner];
    emit(clipper, previous, corner, next);
    clipper->next[previous] = next;
    clipper->previous[next] = previous;
    clipper->left--;
    unlink_corner(clipper, corner);
    if (clipper->blockers.count) {
        mt_blockers_remove(&clipper->blockers, corner);
    }
    reconsider(clipper, previous);
    reconsider(clipper, next);
}

/* ---- the search ---- */

/* Cuts off the first candidate that is an ear; those before it become blocked. */
static bool cut_candidate(ear_clipper *clipper)
{
    for (mt_index corner = first_of(clipper, LIST_CANDIDATES); corner != MT_NONE;
         corner = first_of(clipper, LIST_CANDIDATES)) {
        if (turn_at(clipper, corner) == 0 || !mt_blockers_forbid(&clipper->blockers, corner, true)) {
            cut_off(clipper, corner);
            return true;
        }
        append(clipper, corner, LIST_BLOCKED);
    }
    return false;
}

/* Cuts off the first blocked corner that is an ear now, strictly or in the looser sense. */
static bool cut_blocked(ear_clipper *clipper, bool strict)
{
    mt_index head = head_of(clipper, LIST_BLOCKED);
    for (mt_index corner = clipper->after[head]; corner != head && clipper->budget; corner = clipper->after[corner]) {
        clipper->budget--;
        if (!mt_blockers_forbid(&clipper->blockers, corner, strict)) {
            cut_off(clipper, corner);
            return true;
        }
    }
    return false;
}

static bool cut_first(ear_clipper *clipper, list_name list)
{
    mt_index corner = first_of(clipper, list);
    if (corner != MT_NONE) {
        cut_off(clipper, corner);
    }
    return corner != MT_NONE;
}

static void clip_all(ear_clipper *clipper)
{
    mt_index corner = 0;
    while (clipper->left > 3) {
        bool done = cut_candidate(clipper) || cut_blocked(clipper, true) || cut_first(clipper, LIST_FLAT) ||
                    cut_blocked(clipper, false) || cut_first(clipper, LIST_BLOCKED);
        if (!done) {
            /* Only corners that turn right are left: the rest is wound the other way. */
            mt_index next = clipper->next[corner];
            cut_off(clipper, corner);
            corner = next;
        }
        while (clipper->next[clipper->previous[corner]] != corner) {
            corner = clipper->next[corner];
        }
    }
    emit(clipper, clipper->previous[corner], corner, clipper->next[corner]);
}

static void begin(ear_clipper *clipper, const mt_blocker_memory *memory)
{
    bool all_left = true;
    for (mt_index i = 0; i < clipper->count; i++) {
        clipper->previous[i] = i ? i - 1 : clipper->count - 1;
        clipper->next[i] = i + 1 < clipper->count ? i + 1 : 0;
    }
    for (mt_index i = 0; i < clipper->count + LIST_COUNT; i++) {
        clipper->before[i] = clipper->after[i] = i;
    }
    for (mt_index i = 0; i < clipper->count; i++) {
        int turn = turn_at(clipper, i);
        clipper->turns[i] = (int8_t)turn;
        all_left = all_left && turn > 0;
        enlist(clipper, i, turn);
    }
    clipper->blockers.count = 0;
    clipper->blockers.previous = clipper->previous;
    clipper->blockers.next = clipper->next;
    if (!all_left) {
        mt_blockers_build(&clipper->blockers, clipper->points, clipper->count, clipper->turns, memory);
    }
}

static uint64_t retest_budget(mt_index count)
{
    uint64_t small = (uint64_t)count * RETEST_PASSES, large = (uint64_t)count * RETEST_PASSES_LARGE;
    large = large > RETEST_COUNT_LARGE ? large : RETEST_COUNT_LARGE;
    return small < large ? small : large;
}

void mt_ear_clip(mt_point2 *points, mt_index count, void *scratch, mt_index *triangles)
{
    ear_clipper clipper = {.points = points, .count = count, .left = count, .triangle = triangles};
    mt_blocker_memory memory;
    lay_out(&clipper, &memory, count, scratch);
    clipper.budget = retest_budget(count);
    begin(&clipper, &memory);
    clip_all(&clipper);
}
