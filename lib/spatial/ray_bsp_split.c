/* Where a cell of the BSP tree is cut, and how its triangles are dealt to the halves.
 *
 * The plane: the surface-area heuristic (MacDonald and Booth, "Heuristics for ray tracing using space subdivision", The
 * Visual Computer 6, 1990) over equal bins between the pieces' least and largest coordinate, with a bonus for cutting
 * off what is empty. Pieces that reach over the plane are chopped, so that each side knows how far its part reaches
 * (after Stich, Friedrich and Dietrich, "Spatial splits in bounding volume hierarchies", HPG 2009). */
#include "lib/spatial/ray_bsp.h"

#define BINS 32

/* What a step to a child costs, in tests of a triangle. */
#define STEP_COST 0.7

/* Of the cost that is left when one of the halves is empty. */
#define EMPTY_SHARE 0.8

/* Cells are not cut thinner than this: all triangles within it would be on both sides. */
#define THINNEST (4 * MT_RAY_NEARNESS)

/* Outwards, by more than doubles round where a side of a triangle crosses a plane. */
#define CROSSING_ERROR 0x1p-48

typedef struct axis_bins {
    double low, high; /* of the pieces, along the axis */
    mt_index begins[BINS], ends[BINS];
} axis_bins;

static int bin_of(const axis_bins *bins, double x)
{
    double bin = (x - bins->low) / (bins->high - bins->low) * BINS;
    return bin > 0 ? bin < BINS - 1 ? (int)bin : BINS - 1 : 0;
}

static void fill_bins(const mt_ray_bsp_cell *cell, const mt_surface_box *pieces, unsigned axis, axis_bins *bins)
{
    float low = INFINITY, high = -INFINITY;
    for (mt_index i = 0; i < cell->count; i++) {
        low = pieces[i].lower[axis] < low ? pieces[i].lower[axis] : low;
        high = pieces[i].upper[axis] > high ? pieces[i].upper[axis] : high;
    }
    *bins = (axis_bins){.low = (double)low, .high = (double)high};
    for (mt_index i = 0; i < cell->count && low < high; i++) {
        bins->begins[bin_of(bins, (double)pieces[i].lower[axis])]++;
        bins->ends[bin_of(bins, (double)pieces[i].upper[axis])]++;
    }
}

typedef struct choosing {
    const mt_ray_bsp_cell *cell;
    unsigned axis;
    double extents[3];
    double best_cost;
    mt_ray_bsp_plane best;
} choosing;

/* Keeps the plane if it is better, and if it cuts the cell at all. */
static void weigh(choosing *c, double at, mt_index below, mt_index above)
{
    double low = (double)c->cell->lower[c->axis], high = (double)c->cell->upper[c->axis];
    double x = c->extents[(c->axis + 1) % 3], y = c->extents[(c->axis + 2) % 3];
    float plane = (float)at;
    bool fits = (double)plane - low > THINNEST && high - (double)plane > THINNEST;
    if (!fits || (uint64_t)below + above - c->cell->count > c->cell->duplicates) {
        return;
    }
    double whole = x * y + (x + y) * (high - low);
    double area_below = x * y + (x + y) * (at - low), area_above = x * y + (x + y) * (high - at);
    double cost = STEP_COST * whole + area_below * below + area_above * above;
    cost *= below && above ? 1.0 : EMPTY_SHARE;
    if (cost < c->best_cost) {
        c->best_cost = cost;
        c->best = (mt_ray_bsp_plane){c->axis, plane};
    }
}

static void weigh_axis(choosing *c, const mt_surface_box *pieces)
{
    axis_bins bins;
    mt_index count = c->cell->count, below = 0, above = count;
    fill_bins(c->cell, pieces, c->axis, &bins);
    weigh(c, bins.low - 2 * MT_RAY_NEARNESS, 0, count);
    weigh(c, bins.high + 2 * MT_RAY_NEARNESS, count, 0);
    for (int bin = 1; bin < BINS && bins.low < bins.high; bin++) {
        below += bins.begins[bin - 1];
        above -= bins.ends[bin - 1];
        weigh(c, bins.low + (bins.high - bins.low) * bin / BINS, below, above);
    }
}

mt_ray_bsp_plane mt_ray_bsp_choose(const mt_ray_bsp_cell *cell, const mt_surface_box *pieces)
{
    choosing c = {.cell = cell, .best = {MT_RAY_BSP_LEAF, 0}};
    for (unsigned axis = 0; axis < 3; axis++) {
        c.extents[axis] = (double)cell->upper[axis] - (double)cell->lower[axis];
    }
    double area = c.extents[0] * c.extents[1] + c.extents[1] * c.extents[2] + c.extents[2] * c.extents[0];
    c.best_cost = area * cell->count;
    for (c.axis = 0; c.axis < 3; c.axis++) {
        weigh_axis(&c, pieces);
    }
    return c.best;
}

static void include(mt_surface_box *part, const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        float low = mt_round_down(point[axis] - CROSSING_ERROR), high = mt_round_up(point[axis] + CROSSING_ERROR);
        part->lower[axis] = low < part->lower[axis] ? low : part->lower[axis];
        part->upper[axis] = high > part->upper[axis] ? high : part->upper[axis];
    }
}

static void corner_of(const mt_packed_triangle *triangle, int corner, double out[3])
{
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = (double)triangle->rows[axis][corner];
    }
}

/* The box of what of the piece lies on one side of the plane, rounded outwards: sign 1: below, -1: above. False: there
 * is nothing. */
static bool chop(const mt_packed_triangle *triangle, mt_surface_box *piece, unsigned axis, double plane, double sign)
{
    mt_surface_box part = {.lower = {INFINITY, INFINITY, INFINITY}, .upper = {-INFINITY, -INFINITY, -INFINITY}};
    for (int corner = 0; corner < 3; corner++) {
        double a[3], b[3], crossing[3];
        corner_of(triangle, corner, a);
        corner_of(triangle, corner + 1, b);
        double from = sign * (a[axis] - plane), to = sign * (b[axis] - plane);
        if (from <= 0) {
            include(&part, a);
        }
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
            for (int i = 0; i < 3; i++) {
                crossing[i] = a[i] + (b[i] - a[i]) * (from / (from - to));
            }
            include(&part, crossing);
        }
    }
    bool is_there = true;
    for (int i = 0; i < 3; i++) {
        piece->lower[i] = part.lower[i] > piece->lower[i] ? part.lower[i] : piece->lower[i];
        piece->upper[i] = part.upper[i] < piece->upper[i] ? part.upper[i] : piece->upper[i];
        is_there &= piece->lower[i] <= piece->upper[i];
    }
    return is_there;
}

void mt_ray_bsp_deal(const mt_packed_triangles *triangles, const mt_ray_bsp_cell *cell, mt_ray_bsp_plane plane,
                     mt_surface_box *pieces, mt_surface_box *above, mt_ray_bsp_cell halves[2])
{
    double low = (double)plane.at - MT_RAY_NEARNESS, high = (double)plane.at + MT_RAY_NEARNESS;
    halves[0] = halves[1] = *cell;
    halves[0].upper[plane.axis] = halves[1].lower[plane.axis] = plane.at;
    halves[0].count = halves[1].count = 0;
    halves[0].depth = halves[1].depth = cell->depth + 1;
    for (mt_index i = 0; i < cell->count; i++) {
        mt_surface_box piece = pieces[i], other = piece;
        const mt_packed_triangle *triangle = &triangles->items[piece.number];
        bool reaches_below = (double)piece.lower[plane.axis] <= high;
        bool reaches_above = (double)piece.upper[plane.axis] >= low;
        bool is_chopped = reaches_below && reaches_above;
        if (reaches_below && (!is_chopped || chop(triangle, &piece, plane.axis, high, 1))) {
            pieces[halves[0].count++] = piece;
        }
        if (reaches_above && (!is_chopped || chop(triangle, &other, plane.axis, low, -1))) {
            above[halves[1].count++] = other;
        }
    }
}
