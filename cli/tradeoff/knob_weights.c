/* How much a face counts in the normal of its vertex. The mesh is refined once and its vertices are put onto the limit
 * surface; what their normals should be is told by the same surface refined further in 113 bits, where all weights
 * agree. */
#include "tradeoff/reference_surface.h"
#include "tradeoff/statistics.h"

#include <meshtool/manifold.h>
#include <meshtool/normals.h>

#include <math.h>
#include <stdio.h>

#define CORNER_LIMIT 20000U
#define REFERENCE_CORNERS 1500000U

static const char *const levels[] = {"uniform", "area", "angle", "max", NULL};
static const mt_normal_weight weights[] = {MT_NORMAL_WEIGHT_UNIFORM, MT_NORMAL_WEIGHT_AREA, MT_NORMAL_WEIGHT_ANGLE,
                                           MT_NORMAL_WEIGHT_MAX};

typedef struct weight_state {
    mt_mesh *mesh; /* level 1, on the limit surface */
    quad3 *normals;
    mt_mesh *with_normals;
} weight_state;

static mt_status find_obstacle(mt_context *context, const mt_mesh *mesh, const char **why)
{
    mt_manifold_report report;
    if (mesh->face_count == 0 || mesh->corner_count > CORNER_LIMIT) {
        *why = mesh->face_count == 0 ? "the mesh has no faces" : "the mesh is too fine for a finer one to judge it";
        return MT_OK;
    }
    mt_status status = mt_check_manifold(context, mesh, NULL, &report);
    if (status == MT_OK) {
        bool fits = report.manifold_class != MT_NON_MANIFOLD && report.oriented == MT_YES &&
                    report.defect_counts[MT_DEFECT_NON_FINITE_VERTEX] == 0;
        *why = fits ? NULL : "the surface that judges it needs a manifold, oriented mesh";
        mt_manifold_report_release(context, &report);
    }
    return status;
}

static void sum_normals(const reference_surface *surface, quad3 *normals, uint32_t count)
{
    for (uint32_t face = 0; face < surface->face_count; face++) {
        const uint32_t *v = surface->corners + surface->offsets[face];
        quad3 across = quad3_subtract(surface->positions[v[2]], surface->positions[v[0]]);
        quad3 area = quad3_cross(across, quad3_subtract(surface->positions[v[3]], surface->positions[v[1]]));
        for (int i = 0; i < 4; i++) {
            if (v[i] < count) {
                normals[v[i]] = quad3_add(normals[v[i]], area);
            }
        }
    }
}

/* Levels after the first keep its vertices at the front. */
static mt_status refine_further(mt_context *context, weight_state *s, const reference_surface *first)
{
    reference_surface surface = {0}, finer = {0};
    mt_status status = reference_surface_refine(context, first, &surface);
    while (status == MT_OK && 4 * (uint64_t)surface.corner_count <= REFERENCE_CORNERS) {
        status = reference_surface_refine(context, &surface, &finer);
        reference_surface_release(context, &surface);
        surface = finer;
    }
    status = status == MT_OK ? reference_surface_to_limit(context, &surface) : status;
    s->normals = status == MT_OK ? mt_allocate_array_zeroed(context, first->vertex_count, sizeof *s->normals) : NULL;
    if (s->normals) {
        sum_normals(&surface, s->normals, first->vertex_count);
        for (uint32_t vertex = 0; vertex < first->vertex_count; vertex++) {
            mt_mesh_set_position(s->mesh, vertex, quad3_round(surface.positions[vertex]));
        }
    }
    reference_surface_release(context, &surface);
    return status == MT_OK && !s->normals ? MT_ERROR_OUT_OF_MEMORY : status;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    mt_status status = find_obstacle(context, subject->mesh, why);
    if (status != MT_OK || *why) {
        return status;
    }
    weight_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    reference_surface cage = {0}, first = {0};
    status = reference_surface_make(context, subject->mesh, &cage);
    status = status == MT_OK ? reference_surface_refine(context, &cage, &first) : status;
    status = status == MT_OK ? reference_surface_mesh(context, &first, &s->mesh) : status;
    status = status == MT_OK ? refine_further(context, s, &first) : status;
    reference_surface_release(context, &cage);
    reference_surface_release(context, &first);
    return status;
}

static void release(void *state, mt_context *context)
{
    weight_state *s = state;
    mt_mesh_destroy(context, s->mesh);
    mt_free(context, s->normals);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    weight_state *s = state;
    mt_normal_options options = {.weight = weights[level]};
    mt_status status = mt_mesh_copy(context, s->mesh, &s->with_normals);
    return status == MT_OK ? mt_mesh_add_normals(context, s->with_normals, &options, NULL) : status;
}

static void discard(void *state, mt_context *context)
{
    weight_state *s = state;
    mt_mesh_destroy(context, s->with_normals);
    s->with_normals = NULL;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    static const char *const names[3] = {"degrees_p50", "degrees_p99", "degrees_max"};
    (void)level;
    const weight_state *s = state;
    const mt_mesh *mesh = s->with_normals;
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    double *errors = mt_allocate_array(context, mesh->vertex_count, sizeof *errors);
    if (!errors) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    size_t count = 0;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_index value = mt_attribute_value_index(normals, vertex);
        mt_vec3 n = mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                                 mt_attribute_get(normals, value, 2));
        double degrees = tradeoff_degrees_between(n, quad3_round(quad3_normalize(s->normals[vertex])));
        if (!isnan(degrees)) {
            errors[count++] = degrees;
        }
    }
    tradeoff_statistics statistics = tradeoff_statistics_of(errors, count);
    mt_free(context, errors);
    tradeoff_add_statistics(row, names, &statistics);
    snprintf(row->says, sizeof row->says, "normals %.2g degrees off at half of the vertices, %.2g at most",
             statistics.median, statistics.maximum);
    return MT_OK;
}

const tradeoff_knob tradeoff_weights = {
    .name = "normal-weight",
    .question = "How much does a face count in a normal?",
    .oracle = "the surface refined further in 113-bit arithmetic",
    .axis = "degrees_p50",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
