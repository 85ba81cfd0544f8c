/* The triangulation of least area of a loop in space: Barequet and Sharir, "Filling gaps in the boundary of a
 * polyhedron", Computer Aided Geometric Design 12 (1995), section 3. cost(i, j) is the least area that closes the part
 * of the loop from i to j with the diagonal i-j; a taken diagonal and a triangle on one line cost infinity. Sums run in
 * one order, and the lowest middle wins a tie, so the answer is the same everywhere. */
#include "lib/algorithms/hole_triangulation.h"

#include <meshtool/predicates.h>
#include <meshtool/triangulate.h>

#include <string.h>

typedef struct hole {
    mt_context *context;
    const mt_mesh *mesh;
    const mt_index *vertices;
    mt_index count;
    mt_edge_taken taken;
    void *user;
    double scale;  /* a power of two, so that areas neither over- nor underflow */
    double *costs; /* count * count */
    mt_index *middles;
} hole;

static mt_vec3 point(const hole *job, mt_index i)
{
    return mt_vec3_scale(mt_mesh_position(job->mesh, job->vertices[i]), job->scale);
}

static void choose_scale(hole *job)
{
    double largest = 0;
    job->scale = 1;
    for (mt_index i = 0; i < job->count; i++) {
        largest = fmax(largest, mt_vec3_max_abs(point(job, i)));
    }
    job->scale = mt_power_of_two_scale(largest);
}

/* Three vertices of the loop that are not on one line; false when all are. */
static bool find_base(const hole *job, mt_vec3 base[3])
{
    base[0] = point(job, 0);
    base[1] = point(job, 1);
    for (mt_index i = 2; i < job->count; i++) {
        base[2] = point(job, i);
        if (!mt_collinear(base[0], base[1], base[2])) {
            return true;
        }
    }
    return false;
}

static bool is_planar(const hole *job, const mt_vec3 base[3])
{
    for (mt_index i = 0; i < job->count; i++) {
        if (mt_orient3d(base[0], base[1], base[2], point(job, i)) != 0) {
            return false;
        }
    }
    return true;
}

static double triangle_cost(const hole *job, mt_index i, mt_index k, mt_index j)
{
    mt_vec3 a = point(job, i), b = point(job, k), c = point(job, j);
    if (mt_collinear(a, b, c)) {
        return INFINITY;
    }
    return mt_vec3_length(mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a)));
}

static bool is_side(const hole *job, mt_index i, mt_index j)
{
    return j - i == 1 || (i == 0 && j == job->count - 1);
}

static void cost_diagonal(hole *job, mt_index i, mt_index j)
{
    size_t at = (size_t)i * job->count + j;
    job->costs[at] = INFINITY;
    job->middles[at] = i + 1;
    if (!is_side(job, i, j) && job->taken(job->user, job->vertices[i], job->vertices[j])) {
        return;
    }
    for (mt_index k = i + 1; k < j; k++) {
        double parts = job->costs[(size_t)i * job->count + k] + job->costs[(size_t)k * job->count + j];
        if (parts < job->costs[at]) {
            double cost = parts + triangle_cost(job, i, k, j);
            if (cost < job->costs[at]) {
                job->costs[at] = cost;
                job->middles[at] = k;
            }
        }
    }
}

/* Each part of the loop becomes one triangle and two smaller parts; `stack` has room for 2 * count numbers. */
static void collect(const hole *job, mt_index *stack, mt_index *triangles)
{
    size_t depth = 2, written = 0;
    stack[0] = 0;
    stack[1] = job->count - 1;
    while (depth) {
        mt_index j = stack[--depth], i = stack[--depth];
        if (j - i < 2) {
            continue;
        }
        mt_index k = job->middles[(size_t)i * job->count + j];
        triangles[written++] = i;
        triangles[written++] = k;
        triangles[written++] = j;
        stack[depth++] = i;
        stack[depth++] = k;
        stack[depth++] = k;
        stack[depth++] = j;
    }
}

static mt_status fill_least_area(hole *job, mt_index *triangles, bool *filled)
{
    mt_context *context = job->context;
    size_t cells = (size_t)job->count * job->count;
    job->costs = mt_allocate_array_zeroed(context, cells, sizeof *job->costs);
    job->middles = mt_allocate_array(context, cells, sizeof *job->middles);
    mt_index *stack = mt_allocate_array(context, 4 * (uint64_t)job->count, sizeof *stack);
    mt_status status = job->costs && job->middles && stack ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        for (mt_index length = 2; length < job->count; length++) {
            for (mt_index i = 0; i + length < job->count; i++) {
                cost_diagonal(job, i, i + length);
            }
        }
        *filled = job->costs[job->count - 1] < INFINITY;
        if (*filled) {
            collect(job, stack, triangles);
        }
    }
    mt_free(context, stack);
    mt_free(context, job->middles);
    mt_free(context, job->costs);
    return status;
}

/* Whether no triangle has a taken diagonal or lies on one line. */
static bool is_acceptable(const hole *job, const mt_index *triangles)
{
    for (size_t t = 0; t + 2 < job->count; t++) {
        const mt_index *corner = triangles + 3 * t;
        if (isinf(triangle_cost(job, corner[0], corner[1], corner[2]))) {
            return false;
        }
        for (int side = 0; side < 3; side++) {
            mt_index a = corner[side], b = corner[side == 2 ? 0 : side + 1];
            mt_index low = a < b ? a : b, high = a < b ? b : a;
            if (!is_side(job, low, high) && job->taken(job->user, job->vertices[a], job->vertices[b])) {
                return false;
            }
        }
    }
    return true;
}

static int turn_of(mt_vec3 a, mt_vec3 b, mt_vec3 c, int dropped_axis)
{
    double p[3][2];
    const mt_vec3 corners[3] = {a, b, c};
    for (int i = 0; i < 3; i++) {
        p[i][0] = dropped_axis == 0 ? corners[i].y : corners[i].x;
        p[i][1] = dropped_axis == 2 ? corners[i].y : corners[i].z;
    }
    return mt_orient2d(p[0], p[1], p[2]);
}

/* Whether all triangles of a planar loop turn the same way, so that none overlaps another and no triangulation has less
 * area. Those of a loop that crosses itself cannot. */
static bool is_without_folds(const hole *job, const mt_vec3 base[3], const mt_index *triangles)
{
    int axis = 0;
    while (axis < 2 && turn_of(base[0], base[1], base[2], axis) == 0) {
        axis++;
    }
    int first = 0;
    for (size_t t = 0; t + 2 < job->count; t++) {
        const mt_index *corner = triangles + 3 * t;
        int turn = turn_of(point(job, corner[0]), point(job, corner[1]), point(job, corner[2]), axis);
        first = t == 0 ? turn : first;
        if (turn == 0 || turn != first) {
            return false;
        }
    }
    return true;
}

static mt_status fill_polygon(const hole *job, mt_index *triangles, bool *filled)
{
    mt_index offsets[2] = {0, job->count};
    mt_mesh polygon = {.vertex_count = job->mesh->vertex_count,
                       .position_type = job->mesh->position_type,
                       .positions = job->mesh->positions,
                       .face_count = 1,
                       .corner_count = job->count,
                       .face_offsets = offsets,
                       .corner_vertices = (mt_index *)job->vertices};
    mt_triangulator triangulator = {0};
    mt_status status = mt_triangulate_face(job->context, &triangulator, &polygon, 0, triangles);
    mt_triangulator_release(job->context, &triangulator);
    *filled = status == MT_OK && is_acceptable(job, triangles);
    return status;
}

mt_status mt_triangulate_hole(mt_context *context, const mt_mesh *mesh, const mt_index *vertices, mt_index count,
                              mt_edge_taken taken, void *user, mt_index *triangles, bool *filled)
{
    hole job = {.context = context,
                .mesh = mesh,
                .vertices = vertices,
                .count = count,
                .taken = taken,
                .user = user,
                .scale = 1};
    mt_vec3 base[3];
    *filled = false;
    choose_scale(&job);
    if (!find_base(&job, base)) {
        return MT_OK;
    }
    if (count > HOLE_LEAST_AREA_MAXIMUM) {
        return fill_polygon(&job, triangles, filled);
    }
    if (is_planar(&job, base)) {
        mt_status status = fill_polygon(&job, triangles, filled);
        *filled = status == MT_OK && *filled && is_without_folds(&job, base, triangles);
        if (status != MT_OK || *filled) {
            return status;
        }
    }
    return fill_least_area(&job, triangles, filled);
}
