/* Making the uniform grid, and checking it.
 *
 * Resolution: cubes, of which CELLS_PER_TRIANGLE times the number of triangles fill the box of all (after Cleary and
 * Wyvill, "Analysis of an algorithm for fast ray tracing using uniform space subdivision", The Visual Computer 4,
 * 1988). An axis along which the box is thinner than such a cube has one cell, and the cubes are then chosen for the
 * others: a flat mesh gets a grid of squares, points on a line a row, equal points one cell. A triangle is entered
 * where its box and its plane meet a cell, both widened by MT_RAY_NEARNESS. Where that makes more than
 * ENTRIES_PER_TRIANGLE entries a triangle (triangles much larger than cells), half as many cells are tried, down to
 * one: so memory is O(n), and time O(n log n). Two passes: counting, then entering, in the order of the triangles. */
#include "lib/spatial/ray_grid.h"

#include <meshtool/elementary.h>

#define CELLS_PER_TRIANGLE 4.0
#define ENTRIES_PER_TRIANGLE 8

/* Cells that a triangle's box covers. */
typedef struct cell_range {
    mt_index first[3], last[3];
} cell_range;

/* The plane of a triangle, and how far from the middle of a cell it may pass to meet it. */
typedef struct cell_plane {
    double normal[3], offset, reach;
} cell_plane;

static cell_range range_of(const mt_ray_grid *grid, mt_index at)
{
    cell_range range;
    for (int axis = 0; axis < 3; axis++) {
        const float *row = grid->triangles.items[at].rows[axis];
        float low = fminf(fminf(row[0], row[1]), row[2]), high = fmaxf(fmaxf(row[0], row[1]), row[2]);
        range.first[axis] = mt_ray_grid_cell(grid, axis, (double)low - MT_RAY_NEARNESS);
        range.last[axis] = mt_ray_grid_cell(grid, axis, (double)high + MT_RAY_NEARNESS);
    }
    return range;
}

static uint64_t range_size(const cell_range *range)
{
    uint64_t size = 1;
    for (int axis = 0; axis < 3; axis++) {
        size *= (uint64_t)(range->last[axis] - range->first[axis]) + 1;
    }
    return size;
}

static cell_plane plane_of(const mt_ray_grid *grid, mt_index at)
{
    const mt_packed_triangle *item = &grid->triangles.items[at];
    double ab[3], ac[3];
    cell_plane plane = {.offset = 0, .reach = 0};
    for (int axis = 0; axis < 3; axis++) {
        ab[axis] = (double)item->rows[axis][1] - (double)item->rows[axis][0];
        ac[axis] = (double)item->rows[axis][2] - (double)item->rows[axis][0];
    }
    MT_RAY_CROSS(ab, ac, plane.normal);
    for (int axis = 0; axis < 3; axis++) {
        plane.offset += plane.normal[axis] * (double)item->rows[axis][0];
        plane.reach += fabs(plane.normal[axis]) * (grid->cell_size[axis] / 2 + MT_RAY_NEARNESS);
    }
    return plane;
}

static bool plane_meets(const mt_ray_grid *grid, const cell_plane *plane, const mt_index cell[3])
{
    double distance = -plane->offset;
    for (int axis = 0; axis < 3; axis++) {
        distance += plane->normal[axis] * (grid->lower[axis] + ((double)cell[axis] + 0.5) * grid->cell_size[axis]);
    }
    return fabs(distance) <= plane->reach;
}

/* Counts a triangle into offsets[cell + 1], or where there are entries, writes it and moves offsets[cell] on. */
static void enter_triangle(mt_ray_grid *grid, mt_index at)
{
    cell_range range = range_of(grid, at);
    cell_plane plane = plane_of(grid, at);
    bool is_single = range_size(&range) == 1;
    mt_index cell[3];
    for (cell[2] = range.first[2]; cell[2] <= range.last[2]; cell[2]++) {
        for (cell[1] = range.first[1]; cell[1] <= range.last[1]; cell[1]++) {
            for (cell[0] = range.first[0]; cell[0] <= range.last[0]; cell[0]++) {
                if (is_single || plane_meets(grid, &plane, cell)) {
                    uint32_t *offset = &grid->offsets[mt_ray_grid_index(grid, cell[0], cell[1], cell[2])];
                    if (grid->entries) {
                        grid->entries[(*offset)++] = at;
                    } else {
                        offset[1]++;
                    }
                }
            }
        }
    }
}

/* Cells along each axis, so that there are at most `wanted` in all. */
static void choose_counts(mt_ray_grid *grid, double wanted)
{
    double extents[3];
    int order[3] = {0, 1, 2};
    for (int axis = 0; axis < 3; axis++) {
        extents[axis] = (double)grid->triangles.upper[axis] - (double)grid->triangles.lower[axis];
        grid->cell_counts[axis] = 1;
    }
    for (int i = 1; i < 3; i++) { /* the longest first */
        for (int j = i; j > 0 && extents[order[j]] > extents[order[j - 1]]; j--) {
            int other = order[j];
            order[j] = order[j - 1];
            order[j - 1] = other;
        }
    }
    double a = extents[order[0]], b = extents[order[1]], c = extents[order[2]];
    double size = mt_cbrt(a * b * c / wanted);
    size = c >= size && size > 0 ? size : sqrt(a * b / wanted);
    size = b >= size && size > 0 ? size : a / wanted;
    for (int axis = 0; axis < 3 && size > 0; axis++) {
        double count = extents[axis] / size;
        grid->cell_counts[axis] = count > 1 ? (mt_index)count : 1;
    }
}

static void lay_out(mt_ray_grid *grid, double wanted)
{
    choose_counts(grid, wanted);
    grid->cell_count = 1;
    for (int axis = 0; axis < 3; axis++) {
        double low = (double)grid->triangles.lower[axis] - MT_RAY_NEARNESS;
        double high = (double)grid->triangles.upper[axis] + MT_RAY_NEARNESS;
        grid->lower[axis] = low;
        grid->cell_size[axis] = (high - low) / grid->cell_counts[axis];
        grid->cells_per_unit[axis] = 1 / grid->cell_size[axis];
        grid->cell_count *= grid->cell_counts[axis];
    }
}

/* Whether the boxes of all triangles cover few enough cells. */
static bool is_affordable(const mt_ray_grid *grid)
{
    uint64_t most = (uint64_t)grid->triangles.count * ENTRIES_PER_TRIANGLE, sum = 0;
    for (mt_index at = 0; at < grid->triangles.count && sum <= most; at++) {
        cell_range range = range_of(grid, at);
        sum += range_size(&range);
    }
    return sum <= most;
}

static void choose_resolution(mt_ray_grid *grid)
{
    double wanted = CELLS_PER_TRIANGLE * grid->triangles.count;
    lay_out(grid, wanted);
    while (grid->cell_count > 1 && !is_affordable(grid)) {
        wanted /= 2;
        lay_out(grid, wanted);
    }
}

static mt_status enter_all(mt_context *context, mt_ray_grid *grid)
{
    grid->offsets = mt_allocate_array_zeroed(context, grid->cell_count + 1, sizeof *grid->offsets);
    if (!grid->offsets) {
        return mt_context_error(context)->status;
    }
    for (mt_index at = 0; at < grid->triangles.count; at++) {
        enter_triangle(grid, at);
    }
    for (uint64_t cell = 0; cell < grid->cell_count; cell++) {
        grid->offsets[cell + 1] += grid->offsets[cell];
    }
    grid->entry_count = grid->offsets[grid->cell_count];
    if (mt_progress(context, "building the grid", 0.5) != MT_OK) {
        return MT_ERROR_CANCELLED;
    }
    grid->entries = mt_allocate_array(context, grid->entry_count, sizeof *grid->entries);
    if (!grid->entries) {
        return mt_context_error(context)->status;
    }
    for (mt_index at = 0; at < grid->triangles.count; at++) {
        enter_triangle(grid, at);
    }
    memmove(grid->offsets + 1, grid->offsets, grid->cell_count * sizeof *grid->offsets);
    grid->offsets[0] = 0;
    return MT_OK;
}

static mt_status create(mt_context *context, const mt_ray_source *source, void **body)
{
    mt_ray_grid *grid = mt_allocate_zeroed(context, sizeof *grid);
    *body = grid;
    if (!grid) {
        return mt_context_error(context)->status;
    }
    int part = mt_part_begin(context, "uniform grid", "which triangles are in the cells that a ray goes through");
    mt_status status = mt_packed_triangles_init(context, source, &grid->triangles);
    if (status == MT_OK) {
        choose_resolution(grid);
        status = enter_all(context, grid);
    }
    mt_part_end(context, part);
    return status;
}

static void destroy(mt_context *context, void *body)
{
    mt_ray_grid *grid = body;
    mt_packed_triangles_release(context, &grid->triangles);
    mt_free(context, grid->offsets);
    mt_free(context, grid->entries);
    mt_free(context, grid);
}

static uint64_t size(const void *body)
{
    const mt_ray_grid *grid = body;
    return sizeof *grid + mt_packed_triangles_size(&grid->triangles) + (grid->cell_count + 1) * sizeof *grid->offsets +
           grid->entry_count * sizeof *grid->entries;
}

/* Points of the triangle lie in cells that hold it. */
static bool is_entered(const mt_ray_grid *grid, mt_index at)
{
    double point[3];
    for (int sample = 0; sample < MT_PACKED_SAMPLES; sample++) {
        mt_packed_triangle_sample(&grid->triangles.items[at], sample, point);
        mt_index cell[3];
        for (int axis = 0; axis < 3; axis++) {
            cell[axis] = mt_ray_grid_cell(grid, axis, point[axis]);
        }
        uint64_t index = mt_ray_grid_index(grid, cell[0], cell[1], cell[2]);
        uint32_t begin = grid->offsets[index], end = grid->offsets[index + 1];
        if (!mt_places_hold(grid->entries + begin, end - begin, at)) {
            return false;
        }
    }
    return true;
}

static bool is_sound(const mt_ray_grid *grid)
{
    bool sound = grid->offsets[0] == 0 && grid->offsets[grid->cell_count] == grid->entry_count &&
                 grid->entry_count <= (uint64_t)grid->triangles.count * ENTRIES_PER_TRIANGLE;
    for (uint64_t cell = 0; cell < grid->cell_count && sound; cell++) {
        uint32_t begin = grid->offsets[cell], end = grid->offsets[cell + 1];
        sound = begin <= end && end <= grid->entry_count &&
                mt_places_are_rising(grid->entries + begin, end - begin, grid->triangles.count);
    }
    for (mt_index at = 0; at < grid->triangles.count && sound; at++) {
        sound = is_entered(grid, at);
    }
    return sound;
}

static mt_status validate(mt_context *context, const void *body)
{
    const mt_ray_grid *grid = body;
    mt_status status = mt_packed_triangles_validate(context, &grid->triangles);
    if (status == MT_OK && !is_sound(grid)) {
        status = mt_fail(context, MT_ERROR_INTERNAL, "the grid does not hold its triangles as it should");
    }
    return status;
}

const mt_ray_structure_record mt_ray_structure_grid = {"grid", create, destroy, validate, size, mt_ray_grid_find_hit};
