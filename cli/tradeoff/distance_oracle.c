/* Triangles are quartered, round by round, until none can hold a distance that is larger than one that was found. A
 * piece is no farther than its middle and what is from there to its farthest corner; and no farther from one triangle
 * of the other surface than the farthest of its corners is, since the distance to what is convex is convex. For the
 * mean pieces are quartered as long as their quarters say otherwise than they. */
#include "tradeoff/distance_oracle.h"

#include "tradeoff/quad_triangle.h"

#include <math.h>
#include <string.h>

/* Pieces looked at, for the largest distance and for the mean, beside those that are one a triangle. */
#define PIECE_WORK 100000U
/* Boxes and triangles that either search may look at; a round that was begun is ended. */
#define SEARCH_WORK 60000000U
#define GUESSES 4000U
#define PATCH_WORK 10000U
#define ROUNDS 60

/* Of the tolerance, what a single piece may add to the mean. */
#define MEAN_SHARE 10.0

typedef struct piece {
    mt_vec3 corners[3];
    mt_index near; /* a triangle of the other surface that is not far */
    double upper;
} piece;

/* A piece whose distances are integrated. */
typedef struct patch {
    piece shape;
    quad area;
    double at_corners[3], at_middle;
} patch;

typedef struct surfaces {
    const mt_mesh *from, *to;
    mt_triangulation from_triangles, to_triangles;
    triangle_blocks blocks; /* of `to` */
    piece *pieces;
    double *lowers; /* a piece each */
    patch *patches, *quarters;
} surfaces;

typedef struct search {
    const surfaces *surfaces;
    mt_vec3 point;
    double distance;
    mt_index nearest;
} search;

static bool may_hold(const void *user, const triangle_box *box)
{
    const search *s = user;
    const double p[3] = {s->point.x, s->point.y, s->point.z};
    double outside = 0; /* along the axis where it is most: no square overflows */
    for (int axis = 0; axis < 3; axis++) {
        outside = fmax(outside, fmax(box->low[axis] - p[axis], p[axis] - box->high[axis]));
    }
    return outside * (1 - 0x1p-40) <= s->distance;
}

static void visit(void *user, mt_index triangle)
{
    search *s = user;
    mt_vec3 corners[3];
    quad_load_corners(s->surfaces->to, &s->surfaces->to_triangles, triangle, corners);
    if (quad_may_be_nearer(corners, s->point, s->distance)) {
        double distance = quad_distance_to_triangle(corners, s->point);
        if (distance < s->distance) {
            s->distance = distance, s->nearest = triangle;
        }
    }
}

static double distance_to(const surfaces *s, mt_index triangle, mt_vec3 point)
{
    mt_vec3 corners[3];
    quad_load_corners(s->to, &s->to_triangles, triangle, corners);
    return quad_distance_to_triangle(corners, point);
}

/* A first guess: of triangles along the whole curve the one whose first corner is nearest, so that a search of a large
 * mesh has a bound from the beginning. */
static mt_index guess_near(const surfaces *s, mt_vec3 point)
{
    mt_index near = s->blocks.order[0], step = s->blocks.count / GUESSES;
    double least = INFINITY;
    for (mt_index i = 0; step > 1 && i < s->blocks.count; i += step) {
        mt_index corner = mt_triangulation_corner(&s->to_triangles, s->blocks.order[i], 0);
        double distance =
            mt_vec3_length(mt_vec3_subtract(mt_mesh_position(s->to, s->to->corner_vertices[corner]), point));
        if (distance < least) {
            least = distance, near = s->blocks.order[i];
        }
    }
    return near;
}

/* *near begins as a guess. */
static double nearest_distance(surfaces *s, mt_vec3 point, mt_index *near)
{
    static const triangle_query query = {may_hold, visit};
    search one = {s, point, distance_to(s, *near, point), *near};
    triangle_blocks_visit(&s->blocks, &query, &one);
    *near = one.nearest;
    return one.distance;
}

static mt_vec3 middle_of(const mt_vec3 p[3])
{
    quad3 sum = quad3_add(quad3_add(quad3_from(p[0]), quad3_from(p[1])), quad3_from(p[2]));
    return quad3_round(quad3_make(sum.x / 3, sum.y / 3, sum.z / 3));
}

static double length_between(mt_vec3 a, mt_vec3 b)
{
    quad3 d = quad3_subtract(quad3_from(a), quad3_from(b));
    return (double)quad_sqrt(quad3_dot(d, d));
}

/* No point of the piece is farther from the triangle. */
static double farthest_corner(const surfaces *s, const piece *p, mt_index triangle)
{
    double farthest = 0;
    for (int i = 0; i < 3; i++) {
        farthest = fmax(farthest, distance_to(s, triangle, p->corners[i]));
    }
    return farthest;
}

/* Bounds of a piece, from its corners and its middle. */
static void bound_pieces(void *user, uint64_t begin, uint64_t end)
{
    surfaces *s = user;
    for (uint64_t at = begin; at < end; at++) {
        piece *p = &s->pieces[at];
        mt_vec3 middle = middle_of(p->corners);
        double radius = 0;
        for (int i = 0; i < 3; i++) {
            radius = fmax(radius, length_between(middle, p->corners[i]));
        }
        double distance = nearest_distance(s, middle, &p->near);
        s->lowers[at] = distance;
        p->upper = fmin(distance + radius, farthest_corner(s, p, p->near));
        for (int i = 0; i < 3; i++) {
            mt_index near = p->near;
            s->lowers[at] = fmax(s->lowers[at], nearest_distance(s, p->corners[i], &near));
            p->upper = near != p->near ? fmin(p->upper, farthest_corner(s, p, near)) : p->upper;
        }
    }
}

static void quarter(const piece *p, piece out[4])
{
    mt_vec3 halves[3];
    for (int i = 0; i < 3; i++) {
        quad3 sum = quad3_add(quad3_from(p->corners[i]), quad3_from(p->corners[(i + 1) % 3]));
        halves[i] = quad3_round(quad3_scale(sum, 0.5));
    }
    for (int i = 0; i < 3; i++) {
        out[i] = (piece){{p->corners[i], halves[i], halves[(i + 2) % 3]}, p->near, 0};
    }
    out[3] = (piece){{halves[0], halves[1], halves[2]}, p->near, 0};
}

static bool are_finite(const mt_vec3 p[3])
{
    return mt_vec3_is_finite(p[0]) && mt_vec3_is_finite(p[1]) && mt_vec3_is_finite(p[2]);
}

/* Of a triangle with a corner that is not finite the others alone are looked at, as pieces of one point: two at most.
 */
static mt_index begin_pieces(surfaces *s)
{
    mt_index count = 0;
    for (mt_index i = 0; i < s->from_triangles.triangle_count; i++) {
        mt_vec3 p[3];
        quad_load_corners(s->from, &s->from_triangles, i, p);
        if (are_finite(p)) {
            s->pieces[count++] = (piece){{p[0], p[1], p[2]}, guess_near(s, p[0]), 0};
            continue;
        }
        for (int side = 0; side < 3; side++) {
            if (mt_vec3_is_finite(p[side])) {
                s->pieces[count++] = (piece){{p[side], p[side], p[side]}, guess_near(s, p[side]), 0};
            }
        }
    }
    return count;
}

/* Quarters those pieces that may hold more than the lower bound; returns how many there are then. Raises the upper
 * bound to what the others may hold, or all where the quarters would be too many. */
static mt_status keep_pieces(mt_context *context, surfaces *s, mt_index *count, mt_index room, double tolerance,
                             distance_oracle *out)
{
    mt_index kept = 0, all = *count;
    for (mt_index i = 0; i < all; i++) {
        kept += s->pieces[i].upper > out->lower + tolerance;
    }
    bool ends = 4 * (uint64_t)kept > room;
    piece *parts = mt_allocate_array(context, ends ? 1 : 4 * (uint64_t)kept, sizeof *parts);
    *count = 0;
    if (!parts) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < all; i++) {
        if (ends || !(s->pieces[i].upper > out->lower + tolerance)) {
            out->upper = fmax(out->upper, s->pieces[i].upper);
        } else {
            quarter(&s->pieces[i], parts + *count);
            *count += 4;
        }
    }
    mt_free(context, s->pieces);
    s->pieces = parts;
    return MT_OK;
}

static mt_status find_largest(mt_context *context, surfaces *s, double tolerance, distance_oracle *out)
{
    uint64_t room_of_all = 2 * (uint64_t)s->from_triangles.triangle_count;
    s->pieces = mt_allocate_array(context, room_of_all, sizeof *s->pieces);
    s->lowers = mt_allocate_array(context, room_of_all > PIECE_WORK ? room_of_all : PIECE_WORK, sizeof *s->lowers);
    if (!s->pieces || !s->lowers) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_index count = begin_pieces(s);
    mt_status status = MT_OK;
    mt_index work = 0;
    for (int round = 0; status == MT_OK && count > 0; round++) {
        mt_parallel_for(context, count, 16, bound_pieces, s);
        for (mt_index i = 0; i < count; i++) {
            out->lower = fmax(out->lower, s->lowers[i]);
        }
        work += count;
        bool goes_on = round < ROUNDS && work < PIECE_WORK && s->blocks.work < SEARCH_WORK;
        mt_index room = goes_on ? PIECE_WORK - work : 0;
        status = keep_pieces(context, s, &count, room, tolerance, out);
        status = status == MT_OK ? mt_progress(context, "bounding the distance in 113 bits", 0.5) : status;
    }
    out->upper = fmax(out->upper, out->lower);
    return status;
}

static quad area_of(const mt_vec3 p[3])
{
    quad3 a = quad3_from(p[0]);
    quad3 normal = quad3_cross(quad3_subtract(quad3_from(p[1]), a), quad3_subtract(quad3_from(p[2]), a));
    return quad_sqrt(quad3_dot(normal, normal)) / 2;
}

/* The rule that is exact for quadratics, times the area. */
static quad integral_of(const patch *p)
{
    quad corners = (quad)p->at_corners[0] + p->at_corners[1] + p->at_corners[2];
    return p->area * ((quad)p->at_middle * 3 / 4 + corners / 12);
}

/* A quarter is of a piece's shape, and has its middle looked at unless it is that of the whole. */
static void make_quarter(surfaces *s, const patch *whole, const piece *shape, const double at_halves[3], int which,
                         patch *out)
{
    *out = (patch){.shape = *shape, .area = whole->area / 4, .at_middle = whole->at_middle};
    for (int i = 0; i < 3; i++) {
        out->at_corners[i] = at_halves[i];
    }
    if (which < 3) {
        out->at_corners[0] = whole->at_corners[which];
        out->at_corners[1] = at_halves[which];
        out->at_corners[2] = at_halves[(which + 2) % 3];
        out->at_middle = nearest_distance(s, middle_of(shape->corners), &out->shape.near);
    }
}

static void split_patches(void *user, uint64_t begin, uint64_t end)
{
    surfaces *s = user;
    for (uint64_t at = begin; at < end; at++) {
        const patch *whole = &s->patches[at];
        piece shapes[4];
        double at_halves[3];
        quarter(&whole->shape, shapes);
        for (int i = 0; i < 3; i++) {
            mt_index near = whole->shape.near;
            at_halves[i] = nearest_distance(s, shapes[3].corners[i], &near);
        }
        for (int which = 0; which < 4; which++) {
            make_quarter(s, whole, &shapes[which], at_halves, which, &s->quarters[4 * at + (unsigned)which]);
        }
    }
}

static void begin_patches(void *user, uint64_t begin, uint64_t end)
{
    surfaces *s = user;
    for (uint64_t at = begin; at < end; at++) {
        patch *p = &s->patches[at];
        *p = (patch){0};
        quad_load_corners(s->from, &s->from_triangles, (mt_index)at, p->shape.corners);
        p->shape.near = guess_near(s, p->shape.corners[0]);
        if (!are_finite(p->shape.corners)) {
            continue; /* left out */
        }
        p->area = area_of(p->shape.corners);
        p->at_middle = nearest_distance(s, middle_of(p->shape.corners), &p->shape.near);
        for (int i = 0; i < 3; i++) {
            mt_index near = p->shape.near;
            p->at_corners[i] = nearest_distance(s, p->shape.corners[i], &near);
        }
    }
}

/* What the quarters of patches that are good enough add up to, and by how much more than they; the quarters of the
 * others take their place. */
static mt_status keep_patches(mt_context *context, surfaces *s, mt_index *count, quad tolerance, bool ends,
                              quad sums[2])
{
    patch *kept = mt_allocate_array(context, 4 * (uint64_t)*count, sizeof *kept);
    mt_index kept_count = 0;
    if (!kept) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < *count; i++) {
        const patch *quarters = &s->quarters[4 * (uint64_t)i];
        quad sum = integral_of(&quarters[0]) + integral_of(&quarters[1]) + integral_of(&quarters[2]) +
                   integral_of(&quarters[3]);
        quad change = sum - integral_of(&s->patches[i]);
        if (ends || quad_absolute(change) <= tolerance) {
            sums[0] += sum, sums[1] += change;
        } else {
            memcpy(kept + kept_count, quarters, 4 * sizeof *kept);
            kept_count += 4;
        }
    }
    mt_free(context, s->patches);
    s->patches = kept;
    *count = kept_count;
    return MT_OK;
}

static mt_status find_mean(mt_context *context, surfaces *s, double tolerance, distance_oracle *out)
{
    mt_index count = s->from_triangles.triangle_count, work = 0;
    s->patches = mt_allocate_array(context, count, sizeof *s->patches);
    if (!s->patches) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, count, 16, begin_patches, s);
    quad area = 0, sums[2] = {0, 0};
    mt_index finite = 0;
    for (mt_index i = 0; i < count; i++) {
        if (are_finite(s->patches[i].shape.corners)) {
            area += s->patches[i].area;
            s->patches[finite++] = s->patches[i];
        }
    }
    count = finite;
    mt_status status = MT_OK;
    while (status == MT_OK && count > 0) {
        s->quarters = mt_allocate_array(context, 4 * (uint64_t)count, sizeof *s->quarters);
        if (!s->quarters) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        mt_parallel_for(context, count, 16, split_patches, s);
        work += count;
        bool ends = work > PATCH_WORK || s->blocks.work > 2 * (uint64_t)SEARCH_WORK;
        status = keep_patches(context, s, &count, tolerance * area, ends, sums);
        mt_free(context, s->quarters);
        s->quarters = NULL;
        status = status == MT_OK ? mt_progress(context, "integrating the distance in 113 bits", 0.5) : status;
    }
    out->mean = area > 0 ? (double)(sums[0] / area) : (double)NAN;
    out->mean_error = area > 0 ? (double)(quad_absolute(sums[1]) / area) : (double)NAN;
    return status;
}

mt_status distance_oracle_measure(mt_context *context, const mt_mesh *from, const mt_mesh *to, double tolerance,
                                  distance_oracle *out)
{
    surfaces s = {.from = from, .to = to};
    *out = (distance_oracle){0, 0, 0, 0};
    mt_status status = mt_triangulation_init(context, from, &s.from_triangles);
    if (status == MT_OK) {
        status = mt_triangulation_init(context, to, &s.to_triangles);
    }
    if (status == MT_OK) {
        status = triangle_blocks_make(context, to, &s.to_triangles, &s.blocks);
    }
    if (status == MT_OK) {
        status = find_largest(context, &s, tolerance, out);
    }
    if (status == MT_OK) {
        status = find_mean(context, &s, tolerance * MEAN_SHARE, out);
    }
    mt_free(context, s.pieces);
    mt_free(context, s.lowers);
    mt_free(context, s.patches);
    mt_free(context, s.quarters);
    triangle_blocks_release(context, &s.blocks);
    mt_triangulation_release(context, &s.from_triangles);
    mt_triangulation_release(context, &s.to_triangles);
    return status;
}
