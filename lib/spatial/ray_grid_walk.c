/* Rays through the uniform grid, from cell to cell: Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray
 * Tracing", Eurographics 1987; the planes' parameters are computed anew and not added up, so that they do not drift.
 *
 * A hit lies in the cell whose interval holds its parameter, give or take doubles, and its triangle is an entry of
 * every cell within MT_RAY_NEARNESS: so no cell beside the walk's own has to be visited, and the walk may end when its
 * cell ends behind the best hit. */
#include "lib/spatial/ray_grid.h"

/* Components that cross no cell: over the length of a ray amid the triangles they move by less than doubles round. */
#define STANDSTILL 0x1p-60

/* Triangles last asked, by the low bits of their places: those that reach over several cells come again and again. */
#define RECENT 16

typedef struct grid_walk {
    double origin[3], reciprocal[3]; /* x y z */
    int64_t cell[3], step[3], end[3], plane_ahead[3];
    double next[3]; /* parameters at which the walk leaves its cell on each axis */
} grid_walk;

static double next_of(const mt_ray_grid *grid, const grid_walk *walk, int axis)
{
    double plane = mt_ray_grid_plane(grid, axis, walk->cell[axis] + walk->plane_ahead[axis]);
    return (plane - walk->origin[axis]) * walk->reciprocal[axis];
}

static void start(const mt_ray_grid *grid, const mt_ray_setup *setup, double enter, grid_walk *walk)
{
    for (int i = 0; i < 3; i++) {
        int axis = setup->axes[i];
        double direction = setup->direction[i];
        bool is_moving = fabs(direction) > STANDSTILL;
        walk->origin[axis] = setup->origin[i];
        walk->reciprocal[axis] = is_moving ? 1 / direction : 0;
        walk->cell[axis] = mt_ray_grid_cell(grid, axis, setup->origin[i] + enter * direction);
        walk->step[axis] = direction < 0 ? -1 : 1;
        walk->plane_ahead[axis] = direction < 0 ? 0 : 1;
        walk->end[axis] = direction < 0 ? -1 : (int64_t)grid->cell_counts[axis];
        walk->next[axis] = is_moving ? next_of(grid, walk, axis) : (double)INFINITY;
    }
}

static int nearest_plane(const double next[3])
{
    int axis = next[1] < next[0];
    return next[2] < next[axis] ? 2 : axis;
}

/* Returns true when the search is over. */
static bool try_cell(const mt_ray_grid *grid, const grid_walk *walk, mt_index recent[RECENT], mt_ray_search *search)
{
    uint64_t index = mt_ray_grid_index(grid, (mt_index)walk->cell[0], (mt_index)walk->cell[1], (mt_index)walk->cell[2]);
    for (uint32_t i = grid->offsets[index]; i < grid->offsets[index + 1]; i++) {
        mt_index at = grid->entries[i];
        if (recent[at % RECENT] != at) {
            recent[at % RECENT] = at;
            if (mt_ray_search_try(search, at)) {
                return true;
            }
        }
    }
    return false;
}

static void walk_cells(const mt_ray_grid *grid, double enter, mt_ray_search *search)
{
    grid_walk walk;
    mt_index recent[RECENT];
    memset(recent, 0xff, sizeof recent);
    start(grid, &search->setup, enter, &walk);
    for (;;) {
        int axis = nearest_plane(walk.next);
        if (try_cell(grid, &walk, recent, search) || search->limit <= walk.next[axis]) {
            return;
        }
        walk.cell[axis] += walk.step[axis];
        if (walk.cell[axis] == walk.end[axis]) {
            return;
        }
        walk.next[axis] = next_of(grid, &walk, axis);
    }
}

bool mt_ray_grid_find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    const mt_ray_grid *grid = body;
    mt_ray_search search;
    double enter, leave;
    if (mt_ray_search_init(&grid->triangles, ray, profile, any, &search) &&
        mt_ray_search_enter(&search, &enter, &leave)) {
        if (mt_ray_search_is_near(&search)) {
            walk_cells(grid, enter, &search);
        } else {
            mt_ray_search_try_all(&search);
        }
    }
    *hit = search.best;
    return hit->triangle != MT_NONE;
}
