/* A static tree over the blockers in Z-order: leaves of eight, boxes that shrink as blockers vanish. Every test that
 * discards a box or a point is exact, so the tree finds what looking at all blockers would.
 *
 * Build O(n log n), removal O(log n). A query visits the boxes that meet the ear: O(log n) in practice, O(sqrt n) for
 * ears that are long and thin. */
#include "lib/mesh/blockers.h"

#include <meshtool/predicates.h>

#include <string.h>

#define LEAF_SIZE 8
#define STACK_SIZE 64 /* depth-first over a binary tree of at most 2^32 leaves */

static mt_index leaf_count_for(mt_index slot_count)
{
    mt_index leaves = 1;
    while ((uint64_t)leaves * LEAF_SIZE < slot_count) {
        leaves *= 2;
    }
    return leaves;
}

size_t mt_blocker_box_count(mt_index count)
{
    return 2 * (size_t)leaf_count_for(count);
}

/* ---- order ---- */

static uint64_t spread_bits(uint64_t x)
{
    x = (x | x << 16) & 0x0000ffff0000ffffu;
    x = (x | x << 8) & 0x00ff00ff00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0fu;
    x = (x | x << 2) & 0x3333333333333333u;
    return (x | x << 1) & 0x5555555555555555u;
}

static uint64_t cell_of(double x, double minimum, double extent)
{
    double share = extent > 0 ? (x * 0.5 - minimum) / extent : 0;
    return (uint64_t)(share * 0xfffffffep0);
}

/* Interleaved cell numbers; the halves keep the extent of huge polygons finite. */
static void compute_keys(mt_point2 *points, mt_index count, uint64_t *keys)
{
    double minimum[2] = {points[0][0], points[0][1]}, maximum[2] = {points[0][0], points[0][1]};
    for (mt_index i = 1; i < count; i++) {
        for (int axis = 0; axis < 2; axis++) {
            minimum[axis] = fmin(minimum[axis], points[i][axis]);
            maximum[axis] = fmax(maximum[axis], points[i][axis]);
        }
    }
    double low_x = minimum[0] * 0.5, low_y = minimum[1] * 0.5;
    double width = maximum[0] * 0.5 - low_x, height = maximum[1] * 0.5 - low_y;
    for (mt_index i = 0; i < count; i++) {
        keys[i] = spread_bits(cell_of(points[i][0], low_x, width)) | spread_bits(cell_of(points[i][1], low_y, height))
                                                                         << 1;
    }
}

typedef struct sort_order {
    mt_point2 *points;
    const uint64_t *keys;
} sort_order;

/* By cell, then by place, so that equal places are neighbours. */
static bool comes_before(const sort_order *order, mt_index a, mt_index b)
{
    if (order->keys[a] != order->keys[b]) {
        return order->keys[a] < order->keys[b];
    }
    const double *p = order->points[a], *q = order->points[b];
    return p[0] < q[0] || (p[0] == q[0] && p[1] < q[1]);
}

static void merge_runs(const sort_order *order, const mt_index *from, mt_index *to, size_t begin, size_t middle,
                       size_t end)
{
    size_t left = begin, right = middle;
    for (size_t at = begin; at < end; at++) {
        bool take_right = left == middle || (right < end && comes_before(order, from[right], from[left]));
        to[at] = take_right ? from[right++] : from[left++];
    }
}

/* Stable merge sort, bottom up; the sorted corners end in `corners`. */
static void sort_corners(const sort_order *order, mt_index count, mt_index *corners, mt_index *scratch)
{
    mt_index *from = corners, *to = scratch;
    for (size_t run = 1; run < count; run *= 2) {
        for (size_t begin = 0; begin < count; begin += 2 * run) {
            size_t middle = begin + run < count ? begin + run : count;
            size_t end = begin + 2 * run < count ? begin + 2 * run : count;
            merge_runs(order, from, to, begin, middle, end);
        }
        mt_index *swap = from;
        from = to;
        to = swap;
    }
    if (from != corners) {
        memcpy(corners, from, count * sizeof *corners);
    }
}

/* ---- boxes ---- */

static mt_box2 empty_box(void)
{
    mt_box2 box = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
    return box;
}

static void grow_box(mt_box2 *box, const double low[2], const double high[2])
{
    for (int axis = 0; axis < 2; axis++) {
        box->minimum[axis] = low[axis] < box->minimum[axis] ? low[axis] : box->minimum[axis];
        box->maximum[axis] = high[axis] > box->maximum[axis] ? high[axis] : box->maximum[axis];
    }
}

static mt_box2 leaf_box(const mt_blockers *blockers, mt_index leaf)
{
    mt_box2 box = empty_box();
    size_t begin = (size_t)leaf * LEAF_SIZE, end = begin + LEAF_SIZE;
    for (size_t slot = begin; slot < end && slot < blockers->slot_count; slot++) {
        mt_index corner = blockers->slots[slot];
        if (corner != MT_NONE) {
            grow_box(&box, blockers->points[corner], blockers->points[corner]);
        }
    }
    return box;
}

static mt_box2 joined_box(const mt_blockers *blockers, mt_index node)
{
    mt_box2 box = blockers->boxes[2 * (size_t)node];
    const mt_box2 *other = &blockers->boxes[2 * (size_t)node + 1];
    grow_box(&box, other->minimum, other->maximum);
    return box;
}

static void keep_blockers(mt_blockers *blockers, mt_index count, const int8_t *turns)
{
    mt_index *slots = blockers->slots;
    mt_index kept = 0;
    bool twin_before = false;
    for (mt_index i = 0; i < count; i++) {
        mt_index corner = slots[i];
        bool twin_after = i + 1 < count && mt_point2_equal(blockers->points[corner], blockers->points[slots[i + 1]]);
        if (turns[corner] <= 0 || twin_before || twin_after) {
            blockers->slot_of[corner] = kept;
            slots[kept++] = corner;
        }
        blockers->has_twin[corner] = twin_before || twin_after;
        twin_before = twin_after;
    }
    blockers->count = kept;
    blockers->slot_count = kept;
}

void mt_blockers_build(mt_blockers *blockers, mt_point2 *points, mt_index count, const int8_t *turns,
                       const mt_blocker_memory *memory)
{
    blockers->points = points;
    blockers->slots = memory->slots;
    blockers->slot_of = memory->slot_of;
    blockers->boxes = memory->boxes;
    blockers->has_twin = memory->has_twin;
    for (mt_index i = 0; i < count; i++) {
        memory->slots[i] = i;
        memory->slot_of[i] = MT_NONE;
    }
    compute_keys(points, count, memory->keys);
    sort_order order = {points, memory->keys};
    sort_corners(&order, count, memory->slots, memory->scratch);
    keep_blockers(blockers, count, turns);
    blockers->leaf_count = leaf_count_for(blockers->slot_count);
    for (mt_index leaf = 0; leaf < blockers->leaf_count; leaf++) {
        blockers->boxes[(size_t)blockers->leaf_count + leaf] = leaf_box(blockers, leaf);
    }
    for (mt_index node = blockers->leaf_count - 1; node > 0; node--) {
        blockers->boxes[node] = joined_box(blockers, node);
    }
}

void mt_blockers_remove(mt_blockers *blockers, mt_index corner)
{
    mt_index slot = blockers->slot_of[corner];
    if (slot == MT_NONE) {
        return;
    }
    blockers->slot_of[corner] = MT_NONE;
    blockers->slots[slot] = MT_NONE;
    blockers->count--;
    size_t node = (size_t)blockers->leaf_count + slot / LEAF_SIZE;
    blockers->boxes[node] = leaf_box(blockers, slot / LEAF_SIZE);
    for (node /= 2; node > 0; node /= 2) {
        blockers->boxes[node] = joined_box(blockers, (mt_index)node);
    }
}

/* ---- queries ---- */

typedef struct ear_triangle {
    const double *a, *tip, *b; /* counter-clockwise */
    mt_index tip_corner;
    mt_box2 box;
    bool strict;
} ear_triangle;

/* Whether the whole box lies right of the line from p to q. */
static bool box_is_right_of(const mt_box2 *box, const double *p, const double *q)
{
    double leftmost[2] = {q[1] < p[1] ? box->maximum[0] : box->minimum[0],
                          q[0] > p[0] ? box->maximum[1] : box->minimum[1]};
    return mt_orient2d(p, q, leftmost) < 0;
}

static bool box_misses(const mt_box2 *box, const ear_triangle *ear)
{
    return box->minimum[0] > ear->box.maximum[0] || box->minimum[1] > ear->box.maximum[1] ||
           box->maximum[0] < ear->box.minimum[0] || box->maximum[1] < ear->box.minimum[1] ||
           box_is_right_of(box, ear->b, ear->a) || box_is_right_of(box, ear->a, ear->tip) ||
           box_is_right_of(box, ear->tip, ear->b);
}

/* Whether a point lies left of both sides of the tip: the polygon there runs into the ear. */
static bool is_in_sector(const ear_triangle *ear, const double *p)
{
    return mt_orient2d(ear->a, ear->tip, p) > 0 && mt_orient2d(ear->tip, ear->b, p) > 0;
}

/* Whether a twin of the tip runs back along both sides of the ear. Then the ear may be the inside, between two slits,
 * or all that is left may be slits: the flat corners at their ends have to go first. */
static bool fills_sector(const ear_triangle *ear, const double *before, const double *after)
{
    return mt_orient2d(ear->tip, ear->b, before) == 0 && mt_orient2d(ear->a, ear->tip, after) == 0;
}

static bool is_left_of(const double *p, const double *q, const double *x)
{
    return mt_orient2d(p, q, x) > 0;
}

/* A corner on the tip or on a side of the ear is in the way only where the polygon runs from it into the ear;
 * one inside, or on the cut, always is. One at the place of an end of the cut never is by itself: a side
 * that leaves it into the ear ends at a corner that is. */
static bool corner_forbids(const mt_blockers *blockers, const ear_triangle *ear, mt_index corner)
{
    const double *p = blockers->points[corner];
    if (corner == ear->tip_corner || mt_point2_equal(p, ear->a) || mt_point2_equal(p, ear->b)) {
        return false;
    }
    const double *before = blockers->points[blockers->previous[corner]];
    const double *after = blockers->points[blockers->next[corner]];
    if (mt_point2_equal(p, ear->tip)) {
        return is_in_sector(ear, before) || is_in_sector(ear, after) ||
               (ear->strict && fills_sector(ear, before, after));
    }
    int first = mt_orient2d(ear->a, ear->tip, p), second = mt_orient2d(ear->tip, ear->b, p);
    int cut = mt_orient2d(ear->b, ear->a, p);
    if (first < 0 || second < 0 || cut < 0) {
        return false;
    }
    if (first == 0) {
        return is_left_of(ear->a, ear->tip, before) || is_left_of(ear->a, ear->tip, after);
    }
    if (second == 0) {
        return is_left_of(ear->tip, ear->b, before) || is_left_of(ear->tip, ear->b, after);
    }
    return cut > 0 || ear->strict;
}

static bool leaf_forbids(const mt_blockers *blockers, const ear_triangle *ear, mt_index leaf)
{
    size_t begin = (size_t)leaf * LEAF_SIZE, end = begin + LEAF_SIZE;
    for (size_t slot = begin; slot < end && slot < blockers->slot_count; slot++) {
        mt_index corner = blockers->slots[slot];
        if (corner != MT_NONE && corner_forbids(blockers, ear, corner)) {
            return true;
        }
    }
    return false;
}

bool mt_blockers_forbid(const mt_blockers *blockers, mt_index tip, bool strict)
{
    if (blockers->count == 0) {
        return false;
    }
    const double *a = blockers->points[blockers->previous[tip]], *b = blockers->points[blockers->next[tip]];
    ear_triangle ear = {a, blockers->points[tip], b, tip, empty_box(), strict};
    grow_box(&ear.box, ear.a, ear.a);
    grow_box(&ear.box, ear.tip, ear.tip);
    grow_box(&ear.box, ear.b, ear.b);
    mt_index stack[STACK_SIZE];
    int depth = 0;
    stack[depth++] = 1;
    while (depth > 0) {
        mt_index node = stack[--depth];
        if (box_misses(&blockers->boxes[node], &ear)) {
            continue;
        }
        if (node >= blockers->leaf_count) {
            if (leaf_forbids(blockers, &ear, node - blockers->leaf_count)) {
                return true;
            }
            continue;
        }
        stack[depth++] = 2 * node + 1;
        stack[depth++] = 2 * node;
    }
    return false;
}
