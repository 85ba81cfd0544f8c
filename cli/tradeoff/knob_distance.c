/* How exact the largest distance between two meshes is to be, and how dense the samples are that its mean is taken
 * over. Measured between the mesh and a coarse copy of it, whose vertices were brought together on a grid, as a
 * careless simplification does; judged by bounds in 113 bits. */
#include "tradeoff/distance_oracle.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/deviation.h>
#include <meshtool/triangulate.h>
#include <meshtool/weld.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

/* Cells of the grid on the diagonal. */
#define GRID 24

/* Triangles of a mesh from which the oracle measures; larger ones are measured to alone. */
#define ORACLE_TRIANGLES 6000U

/* Those of a coarse copy that it can bound in seconds. */
#define COARSE_TRIANGLES 20000U

/* Of the oracle's bounds, and of all that doubles lose: in diagonals, and as a share of the coordinates. */
#define ORACLE_TOLERANCE 1e-9
#define ROUNDING 1e-12
#define COORDINATE_ROUNDING (16 * DBL_EPSILON)

static const char *const levels[] = {"samples, 1/10", "1e-2, 1/10", "1e-3, 1/10",  "1e-4, 1/10", "1e-5, 1/10",
                                     "1e-6, 1/10",    "1e-4, 1/50", "1e-4, 1/100", NULL};

/* Tolerance and spacing, in diagonals of the mesh's box; all of it is a tolerance that the samples themselves keep. */
static const struct {
    double tolerance, spacing;
} how[] = {{1, 1e-1}, {1e-2, 1e-1}, {1e-3, 1e-1}, {1e-4, 1e-1}, {1e-5, 1e-1}, {1e-6, 1e-1}, {1e-4, 2e-2}, {1e-4, 1e-2}};

typedef struct distance_state {
    const mt_mesh *mesh;
    mt_mesh *coarse;
    double diagonal, reach; /* reach: the largest coordinate */
    bool judges_both;       /* directions; else that from the coarse copy alone */
    distance_oracle from_coarse, to_coarse;
    mt_deviation found;
} distance_state;

static mt_vec3 snap(mt_vec3 p, double cell)
{
    return mt_vec3_make(round(p.x / cell) * cell, round(p.y / cell) * cell, round(p.z / cell) * cell);
}

static bool is_same(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The corners of a triangle on the grid; false when it has collapsed or is not finite. */
static bool snap_triangle(const distance_state *s, const mt_triangulation *triangulation, mt_index triangle,
                          mt_vec3 corners[3])
{
    bool is_finite = true;
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, side);
        corners[side] = snap(mt_mesh_position(s->mesh, s->mesh->corner_vertices[corner]), s->diagonal / GRID);
        is_finite = is_finite && mt_vec3_is_finite(corners[side]);
    }
    return is_finite && !is_same(corners[0], corners[1]) && !is_same(corners[1], corners[2]) &&
           !is_same(corners[2], corners[0]);
}

/* Each triangle with vertices of its own, which are welded then. */
static mt_status make_coarse(mt_context *context, distance_state *s, const mt_triangulation *triangulation)
{
    mt_vec3 corners[3];
    mt_index count = 0;
    for (mt_index triangle = 0; triangle < triangulation->triangle_count; triangle++) {
        count += snap_triangle(s, triangulation, triangle, corners);
    }
    const mt_mesh_layout layout = {
        .vertex_count = 3 * (uint64_t)count, .face_count = count, .face_size = 3, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, &s->coarse);
    if (status != MT_OK) {
        return status;
    }
    mt_index vertex = 0;
    for (mt_index triangle = 0; triangle < triangulation->triangle_count; triangle++) {
        if (snap_triangle(s, triangulation, triangle, corners)) {
            for (int side = 0; side < 3; side++, vertex++) {
                mt_mesh_set_position(s->coarse, vertex, corners[side]);
                s->coarse->corner_vertices[vertex] = vertex;
            }
        }
    }
    return mt_mesh_weld(context, s->coarse, NULL);
}

static mt_status ask_oracle(mt_context *context, distance_state *s)
{
    double tolerance = ORACLE_TOLERANCE * s->diagonal;
    mt_status status = distance_oracle_measure(context, s->coarse, s->mesh, tolerance, &s->from_coarse);
    if (status == MT_OK && s->judges_both) {
        status = distance_oracle_measure(context, s->mesh, s->coarse, tolerance, &s->to_coarse);
    }
    return status;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0 || !(subject->diagonal > 0 && isfinite(subject->diagonal))) {
        *why = "the mesh has no faces, or no extent";
        return MT_OK;
    }
    distance_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    s->diagonal = subject->diagonal;
    s->reach = subject->reach;
    mt_triangulation triangulation = {0};
    mt_status status = mt_triangulation_init(context, s->mesh, &triangulation);
    if (status == MT_OK) {
        s->judges_both = triangulation.triangle_count <= ORACLE_TRIANGLES;
        status = make_coarse(context, s, &triangulation);
    }
    mt_triangulation_release(context, &triangulation);
    if (status == MT_OK && s->coarse->face_count == 0) {
        *why = "no face of the mesh is large enough to be left in a coarse copy of it";
        return MT_OK;
    }
    if (status == MT_OK && s->coarse->face_count > COARSE_TRIANGLES) {
        *why = "a coarse copy of the mesh has too many faces to be bounded in 113 bits";
        return MT_OK;
    }
    return status == MT_OK ? ask_oracle(context, s) : status;
}

static void release(void *state, mt_context *context)
{
    distance_state *s = state;
    mt_mesh_destroy(context, s->coarse);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    distance_state *s = state;
    const mt_deviation_options options = {.tolerance = how[level].tolerance * s->diagonal,
                                          .spacing = how[level].spacing * s->diagonal};
    return mt_measure_deviation(context, s->mesh, s->coarse, &options, &s->found);
}

static void discard(void *state, mt_context *context)
{
    distance_state *s = state;
    mt_deviation_release(context, &s->found);
}

/* What is off in one direction, in diagonals: of the largest distance not a number where the oracle ended before it
 * knew, of the mean no less than what the oracle knows. */
typedef struct error_of_side {
    double maximum, mean;
    bool is_broken; /* the true maximum is not where it was said to be */
} error_of_side;

static error_of_side compare(const distance_state *s, const mt_deviation_side *found, const distance_oracle *right)
{
    double rounding = ROUNDING * s->diagonal + COORDINATE_ROUNDING * s->reach;
    bool is_known = right->upper - right->lower <= 2 * ORACLE_TOLERANCE * s->diagonal + rounding;
    double mean = fabs(found->mean - right->mean);
    error_of_side error = {is_known ? fmax(0, right->lower - found->max) / s->diagonal : (double)NAN,
                           (mean > right->mean_error ? mean : right->mean_error) / s->diagonal, false};
    /* Written so that what is no number is wrong. */
    error.is_broken =
        !(found->max <= right->upper + rounding && found->max + found->max_error >= right->lower - rounding) ||
        isnan(found->mean) != isnan(right->mean);
    return error;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    (void)level;
    const distance_state *s = state;
    error_of_side error = compare(s, &s->found.b_to_a, &s->from_coarse);
    double claim = s->found.b_to_a.max_error;
    if (s->judges_both) {
        error_of_side other = compare(s, &s->found.a_to_b, &s->to_coarse);
        bool is_known = !isnan(error.maximum) && !isnan(other.maximum);
        error = (error_of_side){is_known ? fmax(error.maximum, other.maximum) : (double)NAN,
                                fmax(error.mean, other.mean), error.is_broken || other.is_broken};
        claim = fmax(claim, s->found.a_to_b.max_error);
    }
    tradeoff_add_error(row, "largest_off", error.maximum);
    tradeoff_add_error(row, "mean_off", error.mean);
    tradeoff_add_size(row, "claimed", claim / s->diagonal);
    tradeoff_add_size(row, "largest", fmax(s->found.a_to_b.max, s->found.b_to_a.max) / s->diagonal);
    tradeoff_add_size(row, "samples", (double)s->found.a_to_b.sample_count + s->found.b_to_a.sample_count);
    row->is_defect = error.is_broken;
    if (error.is_broken) {
        snprintf(row->says, sizeof row->says, "the largest distance is not within the error that was stated: a defect");
    } else if (isnan(error.maximum)) {
        snprintf(
            row->says, sizeof row->says,
            "the largest distance is %.1g of the diagonal too small at most by its own account, which 113 bits do not "
            "contradict; the mean is %.1g off",
            claim / s->diagonal, error.mean);
    } else {
        snprintf(row->says, sizeof row->says,
                 "the largest distance is %.1g of the diagonal too small, %.1g at most by its own account; the mean is "
                 "%.1g off",
                 error.maximum, claim / s->diagonal, error.mean);
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_distance = {
    .name = "distance",
    .question = "How exactly is the distance of two meshes known?",
    .oracle = "bounds in 113-bit arithmetic, from a coarse copy of the mesh and back",
    .axis = "largest_off",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
