/* Two rings of quads, each with a patch of 2q x 2q quads taken out of its outer side, joined along the patches' rims by
 * a neck of quads. The second ring mirrors the first in x, its faces turned around, so all faces agree. */
#include "lib/mesh/generate.h"

#define TUBE 0.4     /* radius of the tubes; the rings' is 1 */
#define DISTANCE 1.5 /* of a ring's centre from the middle */

typedef struct ring_pair {
    mt_index columns, rows; /* of quads around a hole, and around a tube */
    mt_index reach;         /* the patch spans from -reach to reach of both */
    mt_index ring_vertices; /* of one ring, without its patch's inner ones */
    mt_index *numbers;      /* per place its vertex, MT_NONE inside the patch */
    mt_mesh *mesh;
} ring_pair;

/* Signed distance of a line from line 0, of `count` lines around. */
static int64_t offset_of(mt_index line, mt_index count)
{
    return line < count - line ? (int64_t)line : (int64_t)line - count;
}

static bool is_inside_patch(const ring_pair *pair, mt_index i, mt_index j)
{
    int64_t reach = pair->reach, di = offset_of(i, pair->columns), dj = offset_of(j, pair->rows);
    return di > -reach && di < reach && dj > -reach && dj < reach;
}

static bool is_patch_quad(const ring_pair *pair, mt_index i, mt_index j)
{
    int64_t reach = pair->reach, di = offset_of(i, pair->columns), dj = offset_of(j, pair->rows);
    return di >= -reach && di < reach && dj >= -reach && dj < reach;
}

static mt_index number_at(const ring_pair *pair, int64_t i, int64_t j)
{
    int64_t column = (i + pair->columns) % pair->columns, row = (j + pair->rows) % pair->rows;
    return pair->numbers[(size_t)column * pair->rows + (size_t)row];
}

static void number_vertices(ring_pair *pair)
{
    mt_index count = 0;
    for (mt_index i = 0; i < pair->columns; i++) {
        for (mt_index j = 0; j < pair->rows; j++) {
            pair->numbers[(size_t)i * pair->rows + j] = is_inside_patch(pair, i, j) ? MT_NONE : count++;
        }
    }
}

static void fill_positions(const ring_pair *pair)
{
    for (mt_index i = 0; i < pair->columns; i++) {
        mt_circle_point around = mt_circle(i, pair->columns);
        for (mt_index j = 0; j < pair->rows; j++) {
            mt_index vertex = number_at(pair, i, j);
            if (vertex == MT_NONE) {
                continue;
            }
            mt_circle_point tube = mt_circle(j, pair->rows);
            double radius = 1 + TUBE * tube.x, x = radius * around.x - DISTANCE;
            double y = TUBE * tube.y, z = -radius * around.y;
            mt_mesh_set_position(pair->mesh, vertex, mt_vec3_make(x, y, z));
            mt_mesh_set_position(pair->mesh, vertex + pair->ring_vertices, mt_vec3_make(-x, y, z));
        }
    }
}

/* The quads of both rings; returns where the next corner goes. */
static mt_index *fill_rings(const ring_pair *pair, mt_index *corner)
{
    for (mt_index i = 0; i < pair->columns; i++) {
        for (mt_index j = 0; j < pair->rows; j++) {
            if (is_patch_quad(pair, i, j)) {
                continue;
            }
            const mt_index quad[4] = {number_at(pair, i, j), number_at(pair, (int64_t)i + 1, j),
                                      number_at(pair, (int64_t)i + 1, (int64_t)j + 1),
                                      number_at(pair, i, (int64_t)j + 1)};
            for (int k = 0; k < 4; k++) {
                *corner++ = quad[k];
            }
            for (int k = 3; k >= 0; k--) {
                *corner++ = quad[k] + pair->ring_vertices;
            }
        }
    }
    return corner;
}

/* Vertex k of the patch's rim, counter-clockwise seen from outside. */
static mt_index rim_vertex(const ring_pair *pair, mt_index k)
{
    int64_t reach = pair->reach, side = 2 * reach, along = k % side - reach;
    switch (k / side % 4) {
    case 0:
        return number_at(pair, along, -reach);
    case 1:
        return number_at(pair, reach, along);
    case 2:
        return number_at(pair, -along, reach);
    default:
        return number_at(pair, -reach, -along);
    }
}

static void fill_neck(const ring_pair *pair, mt_index *corner)
{
    for (mt_index k = 0; k < 8 * pair->reach; k++) {
        mt_index a = rim_vertex(pair, k), b = rim_vertex(pair, k + 1);
        *corner++ = a;
        *corner++ = b;
        *corner++ = b + pair->ring_vertices;
        *corner++ = a + pair->ring_vertices;
    }
}

mt_status mt_generate_double_torus(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_index rows = resolution / 2, reach = rows / 6;
    uint64_t n = (uint64_t)resolution * rows, side = 2 * (uint64_t)reach;
    ring_pair pair = {.columns = resolution, .rows = rows, .reach = reach};
    mt_mesh_layout layout = {.vertex_count = 2 * (n - (side - 1) * (side - 1)),
                             .face_count = 2 * (n - side * side) + 4 * side,
                             .face_size = 4,
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    pair.mesh = *out;
    pair.ring_vertices = pair.mesh->vertex_count / 2;
    pair.numbers = mt_allocate_array(context, n, sizeof *pair.numbers);
    if (!pair.numbers) {
        return mt_context_error(context)->status;
    }
    number_vertices(&pair);
    fill_positions(&pair);
    fill_neck(&pair, fill_rings(&pair, pair.mesh->corner_vertices));
    mt_free(context, pair.numbers);
    return MT_OK;
}
