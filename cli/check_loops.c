/* The boundary of a manifold told as its loops: how many edges each has, and where it is. */
#include "check.h"
#include "quantity.h"

#include <string.h>

#define SHOWN_COUNT 3 /* the largest ones */

#define ROUNDING 1e-12 /* of a center, relative to the loop's largest coordinate: less is shown as 0 */

typedef struct boundary_loop {
    mt_index edge_count, vertex;
    mt_vec3 center;
    double largest; /* coordinate */
} boundary_loop;

/* The two boundary neighbours of every vertex; MT_NONE beside those that have none. Only where there is no
 * non-manifold vertex has each two. */
static mt_index *make_neighbors(mt_context *context, const cli_check *check)
{
    size_t size = 2 * (size_t)check->mesh->vertex_count;
    mt_index *neighbors = mt_allocate_array(context, size, sizeof *neighbors);
    if (!neighbors) {
        return NULL;
    }
    memset(neighbors, 0xff, size * sizeof *neighbors);
    for (size_t i = 0; i < check->report->defect_list_count; i++) {
        const mt_defect *defect = &check->report->defects[i];
        for (int end = 0; end < 2 && defect->kind == MT_DEFECT_BOUNDARY_EDGE; end++) {
            mt_index *pair = neighbors + 2 * (size_t)defect->vertices[end];
            pair[pair[0] != MT_NONE] = defect->vertices[1 - end];
        }
    }
    return neighbors;
}

/* Walks the loop through a vertex, and takes it out of `neighbors`. */
static boundary_loop take_loop(const mt_mesh *mesh, mt_index *neighbors, mt_index start)
{
    boundary_loop loop = {.vertex = start};
    mt_index vertex = start;
    while (vertex != MT_NONE && neighbors[2 * (size_t)vertex] != MT_NONE) {
        mt_index *pair = neighbors + 2 * (size_t)vertex;
        mt_index next = pair[0];
        if (pair[1] != MT_NONE && neighbors[2 * (size_t)next] == MT_NONE) {
            next = pair[1]; /* the first leads back to where the walk came from */
        }
        pair[0] = pair[1] = MT_NONE;
        loop.edge_count++;
        mt_vec3 position = mt_mesh_position(mesh, vertex);
        loop.largest = fmax(loop.largest, mt_vec3_max_abs(position));
        mt_vec3 offset = mt_vec3_subtract(position, loop.center);
        loop.center = mt_vec3_add(loop.center, mt_vec3_scale(offset, 1.0 / loop.edge_count));
        vertex = next;
    }
    return loop;
}

static cli_quantity center_text(const boundary_loop *loop)
{
    double least = ROUNDING * loop->largest;
    mt_vec3 c = loop->center;
    return cli_point(
        mt_vec3_make(fabs(c.x) < least ? 0 : c.x, fabs(c.y) < least ? 0 : c.y, fabs(c.z) < least ? 0 : c.z));
}

/* Keeps the largest, in descending order. */
static void keep(boundary_loop largest[SHOWN_COUNT], boundary_loop loop)
{
    for (int i = 0; i < SHOWN_COUNT; i++) {
        if (loop.edge_count > largest[i].edge_count) {
            boundary_loop smaller = largest[i];
            largest[i] = loop;
            loop = smaller;
        }
    }
}

void cli_check_print_loops(mt_context *context, const cli_check *check)
{
    mt_index *neighbors = make_neighbors(context, check);
    boundary_loop largest[SHOWN_COUNT] = {0};
    if (!neighbors) {
        mt_context_clear_error(context); /* the counts are told already; only the places stay untold */
        return;
    }
    for (mt_index vertex = 0; vertex < check->mesh->vertex_count; vertex++) {
        if (neighbors[2 * (size_t)vertex] != MT_NONE) {
            keep(largest, take_loop(check->mesh, neighbors, vertex));
        }
    }
    mt_free(context, neighbors);
    for (int i = 0; i < SHOWN_COUNT && largest[i].edge_count; i++) {
        printf("      a loop of %s around %s, through vertex %u\n", cli_counted(largest[i].edge_count, "edge").text,
               center_text(&largest[i]).text, largest[i].vertex);
    }
    if (check->report->boundary_loop_count > SHOWN_COUNT) {
        printf("      and %s smaller or as small\n",
               cli_count((int64_t)check->report->boundary_loop_count - SHOWN_COUNT).text);
    }
}
