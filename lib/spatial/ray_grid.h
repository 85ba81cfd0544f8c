/* The uniform grid's own record. */
#ifndef MT_SPATIAL_RAY_GRID_H
#define MT_SPATIAL_RAY_GRID_H

#include "lib/spatial/packed_triangles.h"

typedef struct mt_ray_grid {
    mt_packed_triangles triangles;
    double lower[3], cell_size[3], cells_per_unit[3];
    mt_index cell_counts[3];
    uint64_t cell_count;
    uint32_t *offsets;    /* per cell where its entries begin; one more at the end */
    mt_index *entries;    /* places of triangles, rising within a cell */
    uint64_t entry_count; /* offsets[cell_count] */
} mt_ray_grid;

/* Where a cell begins along an axis. */
static inline double mt_ray_grid_plane(const mt_ray_grid *grid, int axis, int64_t cell)
{
    return grid->lower[axis] + (double)cell * grid->cell_size[axis];
}

/* The cell of a coordinate, or the nearest. */
static inline mt_index mt_ray_grid_cell(const mt_ray_grid *grid, int axis, double x)
{
    double cell = (x - grid->lower[axis]) * grid->cells_per_unit[axis];
    mt_index last = grid->cell_counts[axis] - 1;
    return cell > 0 ? cell < (double)last ? (mt_index)cell : last : 0;
}

static inline uint64_t mt_ray_grid_index(const mt_ray_grid *grid, mt_index x, mt_index y, mt_index z)
{
    return ((uint64_t)z * grid->cell_counts[1] + y) * grid->cell_counts[0] + x;
}

bool mt_ray_grid_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit);

#endif
