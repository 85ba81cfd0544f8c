/* Levels of one ring, where no mask of the limit holds yet.
 *
 * The next ring of a vertex is made of the ring alone: its ends are edge points, its diagonals face points. All is
 * computed as differences from the center, which are doubled at each level when they have shrunk, so that their digits
 * do not wear off; the center moves by differences that are scaled back.
 * Sources: as subdivide_patch.c for the rules.
 * Known failure: at a dart of many faces one tangent converges as the ratio of two eigenvalues that grow alike, and is
 * taken as it stands after DART_LEVELS. */
#include "lib/algorithms/subdivide_limit_ring.h"

#include "lib/algorithms/subdivide_loop.h"

#include <string.h>

#define DART_LEVELS 960       /* so that the scale stays finite; errors are then below 1e-9 up to 30 faces */
#define DART_LEVELS_LEAST 128 /* after which the position stands still: differences shrink by 0.66 and more a level */
#define DART_STANDS 2e-15     /* so little, some roundings, the tangent turns by when it stands still */

static bool is_semi_sharp(float sharpness)
{
    return sharpness > 0 && sharpness < MT_SHARPNESS_INFINITE;
}

static bool is_changing(const mt_limit_sharp_ring *sharp)
{
    bool changing = is_semi_sharp(sharp->sharpness);
    for (mt_index i = 0; i < mt_limit_spoke_count(&sharp->ring); i++) {
        changing |= is_semi_sharp(sharp->spokes[i].sharpness);
    }
    return changing;
}

/* The rule of this level or of the next, and the ends that a crease follows. */
static mt_subdivide_vertex_rule rule_of(const mt_limit_sharp_ring *sharp, bool next, mt_index ends[2])
{
    mt_index count = 0;
    for (mt_index i = 0; i < mt_limit_spoke_count(&sharp->ring); i++) {
        if ((next ? sharp->spokes[i].near : sharp->spokes[i].sharpness) > 0) {
            ends[count < 2 ? count : 1] = i;
            count++;
        }
    }
    return mt_vertex_rule_of(next ? mt_sharpness_next(sharp->sharpness) : sharp->sharpness, count);
}

static double decay_weight(const mt_limit_sharp_ring *sharp)
{
    mt_sharpness_sum decay = {0, 0};
    mt_sharpness_decay_add(&decay, sharp->sharpness, mt_sharpness_next(sharp->sharpness), true);
    for (mt_index i = 0; i < mt_limit_spoke_count(&sharp->ring); i++) {
        mt_sharpness_decay_add(&decay, sharp->spokes[i].sharpness, sharp->spokes[i].near, sharp->chaikin);
    }
    return (double)mt_sharpness_decay_weight(&decay);
}

/* Of quads the diagonals become face points; of triangles they keep the old ends. */
static void make_face_points(mt_limit_ring *ring)
{
    if (ring->triangles) {
        memcpy(ring->diagonals, ring->ends, mt_limit_spoke_count(ring) * sizeof *ring->ends);
        return;
    }
    for (mt_index i = 0; i < ring->face_count; i++) {
        mt_vec3 sides = mt_vec3_add(ring->ends[i], ring->ends[mt_limit_next_spoke(ring, i)]);
        ring->diagonals[i] = mt_vec3_scale(mt_vec3_add(sides, ring->diagonals[i]), 0.25);
    }
}

/* What the center moves by; the diagonals are face points already. */
static mt_vec3 move_by(const mt_limit_ring *ring, mt_subdivide_vertex_rule rule, const mt_index ends[2])
{
    mt_vec3 sum = {0, 0, 0};
    double n = ring->face_count;
    if (rule == MT_VERTEX_CREASE) {
        return mt_vec3_scale(mt_vec3_add(ring->ends[ends[0]], ring->ends[ends[1]]), 0.125);
    }
    for (mt_index i = 0; rule != MT_VERTEX_CORNER && i < ring->face_count; i++) {
        mt_vec3 diagonal = ring->triangles ? mt_vec3_make(0, 0, 0) : ring->diagonals[i];
        sum = mt_vec3_add(sum, mt_vec3_add(ring->ends[i], diagonal));
    }
    return mt_vec3_scale(sum, ring->triangles ? mt_loop_weight(ring->face_count) : 1 / (n * n));
}

static mt_vec3 blended_move(const mt_limit_sharp_ring *sharp)
{
    mt_index ends[2] = {0, 0}, next_ends[2] = {0, 0};
    mt_subdivide_vertex_rule parent = rule_of(sharp, false, ends), child = rule_of(sharp, true, next_ends);
    mt_vec3 move = move_by(&sharp->ring, parent, ends);
    if (parent == child || parent < MT_VERTEX_CREASE) {
        return move;
    }
    double weight = decay_weight(sharp);
    mt_vec3 next = move_by(&sharp->ring, child, next_ends);
    return mt_vec3_add(next, mt_vec3_scale(mt_vec3_subtract(move, next), weight));
}

/* By the rule of smooth edges; the diagonals are made already. */
static mt_vec3 smooth_edge_point(const mt_limit_ring *ring, mt_index spoke)
{
    mt_index before = spoke ? spoke - 1 : ring->face_count - 1;
    if (ring->triangles) {
        mt_index after = mt_limit_next_spoke(ring, spoke);
        mt_vec3 beside = mt_vec3_add(ring->diagonals[before], ring->diagonals[after]);
        return mt_vec3_add(mt_vec3_scale(ring->ends[spoke], 0.375), mt_vec3_scale(beside, 0.125));
    }
    mt_vec3 faces = mt_vec3_add(ring->diagonals[before], ring->diagonals[spoke]);
    return mt_vec3_scale(mt_vec3_add(ring->ends[spoke], faces), 0.25);
}

static void make_edge_points(mt_limit_sharp_ring *sharp)
{
    mt_limit_ring *ring = &sharp->ring;
    for (mt_index i = 0; i < mt_limit_spoke_count(ring); i++) {
        const mt_limit_spoke *spoke = &sharp->spokes[i];
        mt_vec3 middle = mt_vec3_scale(ring->ends[i], 0.5);
        double weight = spoke->near > 0 && spoke->far > 0 ? 1 : (double)spoke->sharpness;
        if (weight == 1) {
            ring->ends[i] = middle;
            continue;
        }
        mt_vec3 smooth = smooth_edge_point(ring, i);
        ring->ends[i] = mt_vec3_add(smooth, mt_vec3_scale(mt_vec3_subtract(middle, smooth), weight));
    }
}

static void make_sharpness(mt_limit_sharp_ring *sharp)
{
    mt_sharpness_sum around = {0, 0};
    for (mt_index i = 0; i < mt_limit_spoke_count(&sharp->ring); i++) {
        mt_sharpness_sum_add(&around, sharp->spokes[i].near);
    }
    sharp->sharpness = mt_sharpness_next(sharp->sharpness);
    for (mt_index i = 0; i < mt_limit_spoke_count(&sharp->ring); i++) {
        mt_limit_spoke *spoke = &sharp->spokes[i];
        mt_sharpness_sum beyond = {0, 0};
        mt_sharpness_sum_add(&beyond, spoke->near);
        mt_sharpness_sum_add(&beyond, spoke->far);
        spoke->sharpness = spoke->near;
        spoke->near = mt_sharpness_next_at(spoke->sharpness, sharp->chaikin, &around);
        spoke->far = mt_sharpness_next_at(spoke->sharpness, sharp->chaikin, &beyond);
    }
}

/* Moves the center, and doubles what is left while it stays below `largest`. */
static void move_center(mt_limit_ring *ring, mt_vec3 move, double largest)
{
    ring->center = mt_vec3_add(ring->center, mt_vec3_scale(move, 1 / ring->scale));
    for (mt_index i = 0; i < mt_limit_spoke_count(ring); i++) {
        ring->ends[i] = mt_vec3_subtract(ring->ends[i], move);
    }
    double factor = mt_limit_ring_extent(ring) < 0.5 * largest && ring->scale < 0x1p1000 ? 2 : 1;
    for (mt_index i = 0; i < mt_limit_spoke_count(ring); i++) {
        ring->ends[i] = mt_vec3_scale(ring->ends[i], factor);
    }
    for (mt_index i = 0; i < ring->face_count; i++) {
        ring->diagonals[i] = mt_vec3_scale(mt_vec3_subtract(ring->diagonals[i], move), factor);
    }
    ring->scale *= factor;
}

static void refine(mt_limit_sharp_ring *sharp, double largest)
{
    make_face_points(&sharp->ring);
    mt_vec3 move = blended_move(sharp);
    make_edge_points(sharp);
    move_center(&sharp->ring, move, largest);
    make_sharpness(sharp);
}

static void make_equal(mt_vec3 *a, mt_vec3 *b)
{
    *a = *b = mt_vec3_scale(mt_vec3_add(*a, *b), 0.5);
}

/* Leaves the part of a closed ring that is even about a spoke; refining keeps it so, to the last bit. */
static void make_even(mt_limit_ring *ring, mt_index spoke)
{
    mt_index count = ring->face_count;
    for (uint64_t i = 0; i <= count / 2; i++) {
        make_equal(&ring->ends[(spoke + i) % count], &ring->ends[(spoke + count - i) % count]);
        make_equal(&ring->diagonals[(spoke + i) % count],
                   &ring->diagonals[(spoke + 2 * (uint64_t)count - i - 1) % count]);
    }
}

/* The sharp spoke bends no curve that crosses it: what is odd about it follows the smooth rule, and so the tangent
 * across it is the smooth one. The tangent along it is what remains of the even part, refined without the odd one,
 * which shrinks less and would drown it. */
static mt_vec3 settle_dart(mt_limit_sharp_ring *sharp, mt_index spoke, double largest)
{
    mt_vec3 along, across, moved_along, unused;
    mt_vec3 smooth = mt_limit_normal(&sharp->ring, MT_VERTEX_SMOOTH, (mt_limit_sector){0, sharp->ring.face_count});
    mt_limit_smooth_tangents(&sharp->ring, spoke, &along, &across);
    make_even(&sharp->ring, spoke);
    double moved = 1;
    for (unsigned level = 0; level < DART_LEVELS && (moved > DART_STANDS || level < DART_LEVELS_LEAST); level++) {
        refine(sharp, largest);
        mt_limit_smooth_tangents(&sharp->ring, spoke, &moved_along, &unused);
        moved_along = mt_vec3_normalize(moved_along);
        moved = mt_vec3_max_abs(mt_vec3_subtract(moved_along, along));
        along = moved_along;
    }
    mt_vec3 normal = mt_vec3_normalize(mt_vec3_cross(along, mt_vec3_normalize(across)));
    return mt_vec3_max_abs(normal) > 0 ? normal : smooth; /* without tangents: as at a smooth vertex */
}

mt_subdivide_vertex_rule mt_limit_refine(mt_limit_sharp_ring *sharp, mt_vec3 *normal)
{
    double largest = mt_limit_ring_extent(&sharp->ring);
    while (is_changing(sharp)) {
        refine(sharp, largest);
    }
    mt_index ends[2] = {0, 0};
    mt_subdivide_vertex_rule rule = rule_of(sharp, false, ends);
    if (rule == MT_VERTEX_DART) {
        *normal = settle_dart(sharp, ends[0], largest);
    }
    return rule;
}
