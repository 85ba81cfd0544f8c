/* The limit masks.
 *
 * With n faces around a smooth vertex P, E and F the ends and diagonals, the limit is (n^2 P + 4 sum E + sum F) /
 * (n (n + 5)), and the tangents are the sums of a cos(2 pi i / n) E_i + (cos(2 pi i / n) + cos(2 pi (i + 1) / n)) F_i
 * and the same with sines, a = 1 + cos(2 pi / n) + cos(pi / n) sqrt(2 (9 + cos(2 pi / n))).
 *
 * Across a crease with k faces on this side, with the angle pi / k in the place of 2 pi / n, the sines weigh what lies
 * between, and the crease's own ends have the weight that makes of it a left eigenvector of the subdivision matrix.
 * The mask of Biermann et al., which OpenSubdiv takes, is none for 1, 3 and more faces: it belongs to their modified
 * rules. Triangles have the same masks without diagonals. Beyond 4 faces Catmull-Clark's own crease has no tangent
 * plane, but this and the tangent along it. Known failure: differences beyond the largest double are infinite, and the
 * normal is then (0, 0, 1). */
#include "lib/algorithms/subdivide_limit_ring.h"

#include "lib/algorithms/subdivide_loop.h"
#include "lib/algorithms/subdivide_sum.h"

#include <meshtool/elementary.h>

typedef struct vector_sum {
    mt_subdivide_sum x, y, z;
} vector_sum;

static void add(vector_sum *sum, mt_vec3 term)
{
    mt_subdivide_sum_add(&sum->x, term.x);
    mt_subdivide_sum_add(&sum->y, term.y);
    mt_subdivide_sum_add(&sum->z, term.z);
}

static mt_vec3 value(const vector_sum *sum)
{
    return mt_vec3_make(sum->x.high + sum->x.low, sum->y.high + sum->y.low, sum->z.high + sum->z.low);
}

static mt_vec3 sum_of_four(const mt_vec3 *terms)
{
    return mt_vec3_add(mt_vec3_add(terms[0], terms[2]), mt_vec3_add(terms[1], terms[3]));
}

/* With b the weight of a neighbour in the mask of a level, that in the limit's is 1 / (n + 3 / (8 b)). */
static mt_vec3 smooth_move_of_triangles(const mt_limit_ring *ring)
{
    vector_sum sum = {{0, 0}, {0, 0}, {0, 0}};
    for (mt_index i = 0; i < ring->face_count; i++) {
        add(&sum, ring->ends[i]);
    }
    return mt_vec3_scale(value(&sum), 1 / (ring->face_count + 0.375 / mt_loop_weight(ring->face_count)));
}

static mt_vec3 smooth_move(const mt_limit_ring *ring)
{
    double n = ring->face_count;
    if (ring->triangles) {
        return smooth_move_of_triangles(ring);
    }
    if (ring->face_count == 4) {
        mt_vec3 ends = mt_vec3_scale(sum_of_four(ring->ends), 4);
        return mt_vec3_scale(mt_vec3_add(ends, sum_of_four(ring->diagonals)), 1.0 / 36);
    }
    vector_sum sum = {{0, 0}, {0, 0}, {0, 0}};
    for (mt_index i = 0; i < ring->face_count; i++) {
        add(&sum, mt_vec3_scale(ring->ends[i], 4));
        add(&sum, ring->diagonals[i]);
    }
    return mt_vec3_scale(value(&sum), 1 / (n * (n + 5)));
}

mt_vec3 mt_limit_position(const mt_limit_ring *ring, mt_subdivide_vertex_rule rule, mt_index a, mt_index b)
{
    mt_vec3 move = {0, 0, 0};
    if (rule == MT_VERTEX_CREASE) {
        move = mt_vec3_scale(mt_vec3_add(ring->ends[a], ring->ends[b]), 1.0 / 6);
    } else if (rule != MT_VERTEX_CORNER) {
        move = smooth_move(ring);
    }
    return mt_vec3_add(ring->center, mt_vec3_scale(move, 1 / ring->scale));
}

static mt_index step(const mt_limit_ring *ring, mt_index spoke, mt_index count)
{
    return ring->closed ? (mt_index)(((uint64_t)spoke + count) % ring->face_count) : spoke + count;
}

double mt_limit_ring_extent(const mt_limit_ring *ring)
{
    double largest = 0;
    for (mt_index i = 0; i < mt_limit_spoke_count(ring); i++) {
        largest = fmax(largest, mt_vec3_max_abs(ring->ends[i]));
    }
    return largest;
}

/* The area vectors of a sector's faces: of the triangles at the center, or with `whole` of the quads. */
static mt_vec3 area_vector(const mt_limit_ring *ring, mt_limit_sector sector, bool whole)
{
    double scale = mt_power_of_two_scale(mt_limit_ring_extent(ring));
    vector_sum sum = {{0, 0}, {0, 0}, {0, 0}};
    for (mt_index i = 0; i < sector.face_count; i++) {
        mt_index face = step(ring, sector.first, i);
        mt_vec3 a = mt_vec3_scale(ring->ends[face], scale);
        mt_vec3 b = mt_vec3_scale(ring->ends[mt_limit_next_spoke(ring, face)], scale);
        mt_vec3 diagonal = ring->triangles ? b : mt_vec3_scale(ring->diagonals[face], scale);
        bool half = ring->triangles || !whole;
        add(&sum, half ? mt_vec3_cross(a, b) : mt_vec3_cross(mt_vec3_subtract(a, b), diagonal));
    }
    return value(&sum);
}

static void regular_tangents(const mt_limit_ring *ring, mt_index first, mt_vec3 *along, mt_vec3 *across)
{
    mt_vec3 e[4], f[4];
    for (mt_index i = 0; i < 4; i++) {
        e[i] = ring->ends[(first + i) & 3];
        f[i] = ring->diagonals[(first + i) & 3];
    }
    mt_vec3 even = mt_vec3_subtract(f[0], f[2]), odd = mt_vec3_subtract(f[1], f[3]);
    *along = mt_vec3_add(mt_vec3_scale(mt_vec3_subtract(e[0], e[2]), 4), mt_vec3_subtract(even, odd));
    *across = mt_vec3_add(mt_vec3_scale(mt_vec3_subtract(e[1], e[3]), 4), mt_vec3_add(even, odd));
}

static void add_weighted(const mt_limit_ring *ring, mt_index spoke, double end, double diagonal, vector_sum *sum)
{
    add(sum, mt_vec3_scale(ring->ends[spoke], end));
    if (!ring->triangles) {
        add(sum, mt_vec3_scale(ring->diagonals[spoke], diagonal));
    }
}

void mt_limit_smooth_tangents(const mt_limit_ring *ring, mt_index first, mt_vec3 *along, mt_vec3 *across)
{
    if (ring->face_count == 4 && !ring->triangles) {
        regular_tangents(ring, first, along, across);
        return;
    }
    if (ring->face_count == 2 &&
        !ring->triangles) { /* the formula's weights vanish, and these have the same eigenvalue */
        *along = mt_vec3_subtract(ring->ends[first], ring->ends[first ^ 1]);
        *across = mt_vec3_subtract(ring->diagonals[first], ring->diagonals[first ^ 1]);
        return;
    }
    double turn = 2 * MT_PI / ring->face_count;
    double cosine = mt_cos(turn);
    double weight = 1 + cosine + mt_cos(turn / 2) * sqrt(2 * (9 + cosine));
    vector_sum sums[2] = {{{0, 0}, {0, 0}, {0, 0}}, {{0, 0}, {0, 0}, {0, 0}}};
    double c = 1, s = 0;
    for (mt_index i = 0; i < ring->face_count; i++) {
        mt_index spoke = step(ring, first, i);
        double next_c = mt_cos(turn * (i + 1)), next_s = mt_sin(turn * (i + 1));
        add_weighted(ring, spoke, weight * c, c + next_c, &sums[0]);
        add_weighted(ring, spoke, weight * s, s + next_s, &sums[1]);
        c = next_c;
        s = next_s;
    }
    *along = value(&sums[0]);
    *across = value(&sums[1]);
}

/* A tangent this much shorter than the spokes is what roundings left of none. Larger, and normals of thin rings are
 * lost; smaller, and those of folded rings point anywhere. */
#define TANGENT_IS_NONE 1e-13

static mt_vec3 normal_of(const mt_limit_ring *ring, mt_vec3 along, mt_vec3 across)
{
    double least = TANGENT_IS_NONE * mt_limit_ring_extent(ring);
    if (!(mt_vec3_max_abs(along) > least && mt_vec3_max_abs(across) > least)) {
        return mt_vec3_make(0, 0, 0);
    }
    return mt_vec3_cross(mt_vec3_normalize(along), mt_vec3_normalize(across));
}

static mt_vec3 smooth_normal(const mt_limit_ring *ring)
{
    mt_vec3 along, across;
    mt_limit_smooth_tangents(ring, 0, &along, &across);
    return normal_of(ring, along, across);
}

/* The tangent into a crease's sector of at least two faces, up to a factor. */
static mt_vec3 tangent_across(const mt_limit_ring *ring, mt_limit_sector sector)
{
    double angle = MT_PI / sector.face_count;
    double cosine = mt_cos(angle), sine = mt_sin(angle);
    double weight = 1 + cosine + mt_cos(angle / 2) * sqrt(2 * (9 + cosine));
    double border = (sine * (weight + 4) - 2 * (1 + cosine) / sine * (weight + 2)) / weight;
    if (ring->triangles) {
        border = (sine - (1 + cosine) / sine) / (1 + 2 * cosine) * weight;
    }
    vector_sum sum = {{0, 0}, {0, 0}, {0, 0}};
    double s = 0, next_s = sine;
    mt_index spoke = sector.first;
    add(&sum, mt_vec3_scale(ring->ends[spoke], border));
    for (mt_index i = 0; i < sector.face_count; i++) {
        add_weighted(ring, spoke, weight * s, s + next_s, &sum);
        spoke = mt_limit_next_spoke(ring, spoke);
        s = next_s;
        next_s = i + 2 < sector.face_count ? mt_sin(angle * (i + 2)) : 0;
    }
    add(&sum, mt_vec3_scale(ring->ends[spoke], border));
    return value(&sum);
}

static mt_vec3 crease_normal(const mt_limit_ring *ring, mt_limit_sector sector)
{
    mt_vec3 a = ring->ends[sector.first], b = ring->ends[step(ring, sector.first, sector.face_count)];
    mt_vec3 across = sector.face_count == 1 ? mt_vec3_add(a, b) : tangent_across(ring, sector);
    return normal_of(ring, mt_vec3_subtract(a, b), across);
}

mt_vec3 mt_limit_normal(const mt_limit_ring *ring, mt_subdivide_vertex_rule rule, mt_limit_sector sector)
{
    mt_vec3 normal = rule == MT_VERTEX_CORNER   ? area_vector(ring, sector, false)
                     : rule == MT_VERTEX_CREASE ? crease_normal(ring, sector)
                                                : smooth_normal(ring);
    normal = mt_vec3_normalize(normal);
    if (!(mt_vec3_max_abs(normal) > 0)) {
        normal = mt_vec3_normalize(area_vector(ring, sector, true));
    }
    return mt_vec3_max_abs(normal) > 0 ? normal : mt_vec3_make(0, 0, 1);
}
