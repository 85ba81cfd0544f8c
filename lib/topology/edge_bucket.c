/* Links the sides of one lower vertex. Up to SMALL_BUCKET of them, as nearly always, by comparing each with each; more,
 * by a stable radix sort on the other end, so that a vertex of a million edges costs linear time too. */
#include "lib/topology/edge_bucket.h"

/* Comparing all pairs wins below, sorting above; below 64, the bits of the mask. */
#define SMALL_BUCKET 32

#define DIGIT_BITS 8
#define DIGIT_COUNT (1u << DIGIT_BITS)

static void sort_corners(mt_index *corners, mt_index count)
{
    for (mt_index i = 1; i < count; i++) {
        mt_index corner = corners[i];
        mt_index at = i;
        for (; at > 0 && corners[at - 1] > corner; at--) {
            corners[at] = corners[at - 1];
        }
        corners[at] = corner;
    }
}

/* Links the sides in `members`, three or more, into a descending ring. */
static void link_ring(const edge_side *sides, uint64_t members, mt_index *next_side)
{
    mt_index corners[SMALL_BUCKET];
    mt_index count = 0;
    for (; members; members &= members - 1) {
        corners[count++] = sides[__builtin_ctzll(members)].corner;
    }
    sort_corners(corners, count);
    for (mt_index i = 0; i + 1 < count; i++) {
        next_side[corners[i + 1]] = corners[i];
    }
    next_side[corners[0]] = corners[count - 1];
}

static void link_small(const edge_side *sides, mt_index up_count, mt_index count, mt_index *next_side,
                       edge_tally *tally)
{
    uint64_t open = ((uint64_t)1 << count) - 1;
    for (; open; open &= open - 1) {
        mt_index i = (mt_index)__builtin_ctzll(open);
        uint64_t equal = 0;
        for (mt_index j = i + 1; j < count; j++) {
            equal |= (uint64_t)(sides[j].other == sides[i].other) << j;
        }
        mt_index corner = sides[i].corner;
        if (equal == 0) {
            next_side[corner] = corner;
            tally->boundary++;
        } else if ((equal & (equal - 1)) == 0) {
            mt_index j = (mt_index)__builtin_ctzll(equal);
            next_side[corner] = sides[j].corner;
            next_side[sides[j].corner] = corner;
            bool opposite = (i < up_count) != (j < up_count);
            tally->regular += opposite;
            tally->misoriented += !opposite;
        } else {
            link_ring(sides, equal | (uint64_t)1 << i, next_side);
            tally->non_manifold++;
        }
        open &= ~equal;
    }
}

/* Stable counting sort by one digit of the other end. */
static void sort_by_digit(const edge_side *from, edge_side *to, mt_index count, unsigned shift)
{
    mt_index starts[DIGIT_COUNT + 1] = {0};
    for (mt_index i = 0; i < count; i++) {
        starts[(from[i].other >> shift & (DIGIT_COUNT - 1)) + 1]++;
    }
    for (unsigned d = 0; d < DIGIT_COUNT; d++) {
        starts[d + 1] += starts[d];
    }
    for (mt_index i = 0; i < count; i++) {
        to[starts[from[i].other >> shift & (DIGIT_COUNT - 1)]++] = from[i];
    }
}

/* By the other end; equal ones stay in the order of their corners. */
static void sort_sides(edge_side *sides, mt_index count, edge_side *scratch)
{
    for (unsigned shift = 0; shift < 32; shift += 2 * DIGIT_BITS) {
        sort_by_digit(sides, scratch, count, shift);
        sort_by_digit(scratch, sides, count, shift + DIGIT_BITS);
    }
}

/* A run of sides with one other end, corners ascending. */
typedef struct side_run {
    const edge_side *at, *end;
} side_run;

static side_run leading_run(const edge_side *at, const edge_side *end, mt_index other)
{
    side_run run = {at, at};
    while (run.end < end && run.end->other == other) {
        run.end++;
    }
    return run;
}

/* Merges two ascending runs of one edge, not both empty, into its ring. */
static void link_runs(side_run up, side_run down, mt_index *next_side)
{
    mt_index first = MT_NONE;
    mt_index last = MT_NONE;
    while (up.at < up.end || down.at < down.end) {
        bool take_up = down.at == down.end || (up.at < up.end && up.at->corner < down.at->corner);
        mt_index corner = take_up ? up.at++->corner : down.at++->corner;
        if (first == MT_NONE) {
            first = corner;
        } else {
            next_side[corner] = last;
        }
        last = corner;
    }
    next_side[first] = last;
}

static void count_runs(side_run up, side_run down, edge_tally *tally)
{
    ptrdiff_t ups = up.end - up.at;
    ptrdiff_t downs = down.end - down.at;
    tally->boundary += ups + downs == 1;
    tally->regular += ups == 1 && downs == 1;
    tally->misoriented += ups + downs == 2 && ups != downs;
    tally->non_manifold += ups + downs > 2;
}

static void link_large(edge_side *sides, mt_index up_count, mt_index count, edge_side *scratch, mt_index *next_side,
                       edge_tally *tally)
{
    sort_sides(sides, up_count, scratch);
    sort_sides(sides + up_count, count - up_count, scratch);
    const edge_side *up = sides;
    const edge_side *up_end = sides + up_count;
    const edge_side *down = up_end;
    const edge_side *down_end = sides + count;
    while (up < up_end || down < down_end) {
        bool up_leads = down == down_end || (up < up_end && up->other < down->other);
        mt_index other = up_leads ? up->other : down->other;
        side_run ups = leading_run(up, up_end, other);
        side_run downs = leading_run(down, down_end, other);
        count_runs(ups, downs, tally);
        link_runs(ups, downs, next_side);
        up = ups.end;
        down = downs.end;
    }
}

void mt_edge_bucket_link(edge_side *sides, mt_index up_count, mt_index count, edge_side *scratch, mt_index *next_side,
                         edge_tally *tally)
{
    if (count <= SMALL_BUCKET) {
        link_small(sides, up_count, count, next_side, tally);
    } else {
        link_large(sides, up_count, count, scratch, next_side, tally);
    }
}
