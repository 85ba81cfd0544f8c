/* Upper bounds of a piece's distance, the cheap ones first.
 *
 * The distance to one element is convex, so on a piece it is largest at a corner, and the distance to the surface is no
 * larger: the least of those bounds over the elements nearest to the piece's corners and its middle (Guthe, Borodin and
 * Klein, "Fast and accurate Hausdorff distance calculation between meshes", WSCG 2005; Kang, Kyung, Yoon and Kim, "Fast
 * and robust Hausdorff distance computation from triangle mesh to quad mesh in near-real time", CAGD 2018). Also no
 * point is farther than a sample plus the way to it.
 *
 * Where corners are nearest to different elements, no single element bounds the piece well. It is then cut where two of
 * them are about as far, and each part bounded by itself, with the same few elements and without a search. */
#include "lib/algorithms/deviation_bound.h"

/* Of the longest side: no point of a triangle is farther from all three corners. */
#define COVER 0.57735026918962585

/* The elements nearest to three corners and the middle. */
#define MOST_ELEMENTS 4

/* Cuts of a piece one after the other at most: 2^CUT_DEPTH parts. */
#define CUT_DEPTH 6

/* Of a side: no cut is nearer to its end. */
#define SMALLEST_PART 0.05

typedef struct bounding {
    const mt_deviation_surface *to;
    mt_index elements[MOST_ELEMENTS];
    int count;
    double enough;
} bounding;

/* A corner of a part, its distances to the elements (negative: not measured yet), and which of them is about nearest.
 */
typedef struct part_corner {
    mt_vec3 at;
    double distances[MOST_ELEMENTS];
    int nearest;
} part_corner;

/* The number of an element among those of the bounding, which it joins if it is new. */
static int number_of(bounding *b, mt_index element)
{
    int number = 0;
    while (number < b->count && b->elements[number] != element) {
        number++;
    }
    b->elements[number] = element;
    b->count += number == b->count;
    return number;
}

static part_corner corner_at(mt_vec3 at)
{
    return (part_corner){.at = at, .distances = {-1, -1, -1, -1}};
}

static double distance_to(const bounding *b, part_corner *corner, int number)
{
    if (corner->distances[number] < 0) {
        corner->distances[number] = mt_surface_element_distance(b->to->tree, b->elements[number], corner->at);
    }
    return corner->distances[number];
}

/* The least that a single element says; stops at what is enough. */
static double bound_by_one(const bounding *b, part_corner *const corners[3])
{
    double least = INFINITY;
    for (int number = 0; number < b->count && least > b->enough; number++) {
        double largest = 0;
        for (int i = 0; i < 3 && largest < least; i++) {
            double distance = distance_to(b, corners[i], number);
            largest = distance > largest ? distance : largest;
        }
        least = largest < least ? largest : least;
    }
    return least;
}

/* The longest side between corners that differ in what is nearest, by where it begins; -1: there is none. */
static int side_to_cut(part_corner *const corners[3])
{
    int chosen = -1;
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        const part_corner *from = corners[i], *to = corners[i == 2 ? 0 : i + 1];
        mt_vec3 side = mt_vec3_subtract(to->at, from->at);
        double length = mt_vec3_dot(side, side);
        if (from->nearest != to->nearest && length > longest) {
            longest = length;
            chosen = i;
        }
    }
    return chosen;
}

/* Where both ends' nearest elements would be as far if distances were linear. */
static part_corner cut_side(const bounding *b, part_corner *from, part_corner *to)
{
    double here = distance_to(b, from, to->nearest) - distance_to(b, from, from->nearest);
    double there = distance_to(b, to, from->nearest) - distance_to(b, to, to->nearest);
    double share = here + there > 0 ? here / (here + there) : 0.5;
    share = fmin(fmax(share, SMALLEST_PART), 1 - SMALLEST_PART);
    part_corner cut = corner_at(mt_vec3_add(mt_vec3_scale(from->at, 1 - share), mt_vec3_scale(to->at, share)));
    bool is_first = distance_to(b, &cut, from->nearest) < distance_to(b, &cut, to->nearest);
    cut.nearest = is_first ? from->nearest : to->nearest;
    for (int number = 0; number < b->count && cut.distances[cut.nearest] > b->enough; number++) {
        cut.nearest = distance_to(b, &cut, number) < cut.distances[cut.nearest] ? number : cut.nearest;
    }
    return cut;
}

/* What is above enough need not be known better. */
static double bound_by_parts(const bounding *b, part_corner *const corners[3], int depth)
{
    double bound = bound_by_one(b, corners);
    int side = bound > b->enough && depth ? side_to_cut(corners) : -1;
    if (side < 0) {
        return bound;
    }
    int next = side == 2 ? 0 : side + 1;
    part_corner cut = cut_side(b, corners[side], corners[next]);
    if (cut.distances[cut.nearest] > b->enough) { /* none of the elements is enough for this corner */
        return bound;
    }
    part_corner *part[3] = {corners[0], corners[1], corners[2]};
    part[next] = &cut;
    double first = bound_by_parts(b, part, depth - 1);
    if (first > b->enough) {
        return bound;
    }
    part[next] = corners[next];
    part[side] = &cut;
    double second = bound_by_parts(b, part, depth - 1);
    return fmin(bound, fmax(first, second));
}

static double bound_by_reach(const mt_deviation_piece *piece)
{
    double nearest = 0, longest = 0, reach = 0;
    mt_vec3 middle = mt_deviation_middle(&piece->shape);
    for (int i = 0; i < 3; i++) {
        mt_vec3 a = piece->shape.corners[i], c = piece->shape.corners[i == 2 ? 0 : i + 1];
        longest = fmax(longest, mt_vec3_length(mt_vec3_subtract(c, a)));
        reach = fmax(reach, mt_vec3_length(mt_vec3_subtract(a, middle)));
        nearest = fmax(nearest, piece->corners[i].distance);
    }
    double bound = nearest + COVER * longest;
    return piece->middle.element == MT_NONE ? bound : fmin(bound, piece->middle.distance + reach);
}

double mt_deviation_bound(const mt_deviation_surface *to, mt_deviation_piece *piece, double enough)
{
    double bound = bound_by_reach(piece);
    if (bound <= enough) {
        return bound;
    }
    bounding b = {.to = to, .enough = enough};
    part_corner corners[3];
    part_corner *const addresses[3] = {&corners[0], &corners[1], &corners[2]};
    for (int i = 0; i < 3; i++) {
        corners[i] = corner_at(piece->shape.corners[i]);
        corners[i].nearest = number_of(&b, piece->corners[i].element);
        corners[i].distances[corners[i].nearest] = piece->corners[i].distance;
    }
    if (piece->middle.element == MT_NONE) {
        bound = fmin(bound, bound_by_one(&b, addresses));
        if (bound <= enough) {
            return bound;
        }
        piece->middle = mt_deviation_nearest(to, mt_deviation_middle(&piece->shape), piece->corners[0].element);
        if (piece->middle.element == MT_NONE) { /* not finite: no place of the piece's */
            return 0;
        }
        if (piece->middle.distance > enough) {
            return bound;
        }
    }
    number_of(&b, piece->middle.element);
    return fmin(bound, bound_by_parts(&b, addresses, CUT_DEPTH));
}
