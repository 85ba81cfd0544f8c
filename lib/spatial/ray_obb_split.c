/* Where a range of triangles is cut: the binned surface-area heuristic (Wald, "On fast Construction of SAH-based
 * Bounding Volume Hierarchies", RT 2007), along the axes of the range's own box, with the areas that its parts have
 * there. */
#include "lib/spatial/ray_obb.h"

#define BINS 16

typedef struct bin {
    double lower[3], upper[3];
    mt_index count;
} bin;

typedef struct cut {
    int axis, bin; /* triangles of this bin and above go to the second part; axis -1: there is none */
} cut;

typedef struct binning {
    const mt_oriented_box *frame;
    double origin[3], scale[3]; /* of thrice the centroid, along each axis */
} binning;

static bin no_bin(void)
{
    return (bin){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0};
}

static void join(bin *into, const bin *from)
{
    for (int axis = 0; axis < 3; axis++) {
        into->lower[axis] = from->lower[axis] < into->lower[axis] ? from->lower[axis] : into->lower[axis];
        into->upper[axis] = from->upper[axis] > into->upper[axis] ? from->upper[axis] : into->upper[axis];
    }
    into->count += from->count;
}

static double half_area(const bin *b)
{
    double x = b->upper[0] - b->lower[0], y = b->upper[1] - b->lower[1], z = b->upper[2] - b->lower[2];
    return x * y + y * z + z * x;
}

/* A triangle as a bin of one, and thrice its centroid. */
static bin measure(const mt_oriented_box *frame, const mt_packed_triangle *triangle, double center[3])
{
    bin b;
    for (int axis = 0; axis < 3; axis++) {
        double p = mt_oriented_box_along(frame, axis, triangle, 0), q = mt_oriented_box_along(frame, axis, triangle, 1),
               r = mt_oriented_box_along(frame, axis, triangle, 2);
        b.lower[axis] = p < q ? p < r ? p : r : q < r ? q : r;
        b.upper[axis] = p > q ? p > r ? p : r : q > r ? q : r;
        center[axis] = p + q + r;
    }
    b.count = 1;
    return b;
}

static int bin_of(const binning *map, int axis, double center)
{
    double number = (center - map->origin[axis]) * map->scale[axis];
    return number > 0 ? number < BINS - 1 ? (int)number : BINS - 1 : 0;
}

static binning choose_binning(const mt_packed_triangles *triangles, mt_ray_obb_range range,
                              const mt_oriented_box *frame)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, center[3];
    for (mt_index at = range.begin; at < range.end; at++) {
        measure(frame, &triangles->items[at], center);
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = center[axis] < low[axis] ? center[axis] : low[axis];
            high[axis] = center[axis] > high[axis] ? center[axis] : high[axis];
        }
    }
    binning map = {.frame = frame};
    for (int axis = 0; axis < 3; axis++) {
        map.origin[axis] = low[axis];
        map.scale[axis] = high[axis] > low[axis] ? BINS / (high[axis] - low[axis]) : 0;
    }
    return map;
}

/* Area times count of both sides of each plane of an axis; keeps the best so far. */
static void weigh_planes(const bin bins[BINS], int axis, cut *best, double *best_cost)
{
    double costs[BINS];
    bin side = no_bin();
    for (int i = BINS - 1; i > 0; i--) {
        join(&side, &bins[i]);
        costs[i] = side.count ? half_area(&side) * side.count : (double)INFINITY;
    }
    side = no_bin();
    for (int i = 1; i < BINS; i++) {
        join(&side, &bins[i - 1]);
        double cost = side.count ? half_area(&side) * side.count + costs[i] : (double)INFINITY;
        if (cost < *best_cost) {
            *best_cost = cost;
            *best = (cut){axis, i};
        }
    }
}

static cut choose_cut(const mt_packed_triangles *triangles, mt_ray_obb_range range, const binning *map)
{
    bin bins[3][BINS];
    double center[3], cost = INFINITY;
    cut best = {-1, 0};
    for (int i = 0; i < 3 * BINS; i++) {
        bins[i / BINS][i % BINS] = no_bin();
    }
    for (mt_index at = range.begin; at < range.end; at++) {
        bin one = measure(map->frame, &triangles->items[at], center);
        for (int axis = 0; axis < 3; axis++) {
            join(&bins[axis][bin_of(map, axis, center[axis])], &one);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        weigh_planes(bins[axis], axis, &best, &cost);
    }
    return best;
}

static bool is_second(const mt_packed_triangles *triangles, mt_index at, const binning *map, cut where)
{
    double center[3];
    measure(map->frame, &triangles->items[at], center);
    return bin_of(map, where.axis, center[where.axis]) >= where.bin;
}

static void exchange(mt_packed_triangles *triangles, mt_index a, mt_index b)
{
    mt_packed_triangle item = triangles->items[a];
    triangles->items[a] = triangles->items[b];
    triangles->items[b] = item;
    mt_index number = triangles->numbers[a];
    triangles->numbers[a] = triangles->numbers[b];
    triangles->numbers[b] = number;
}

mt_index mt_ray_obb_split(mt_packed_triangles *triangles, mt_ray_obb_range range, const mt_oriented_box *frame,
                          bool halve)
{
    binning map = choose_binning(triangles, range, frame);
    cut where = halve ? (cut){-1, 0} : choose_cut(triangles, range, &map);
    if (where.axis < 0) {
        return range.begin + (range.end - range.begin) / 2;
    }
    mt_index first = range.begin, last = range.end;
    while (first < last) {
        if (!is_second(triangles, first, &map, where)) {
            first++;
        } else if (is_second(triangles, last - 1, &map, where)) {
            last--;
        } else {
            exchange(triangles, first++, --last);
        }
    }
    return first;
}
