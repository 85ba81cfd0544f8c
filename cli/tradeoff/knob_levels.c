/* How many levels of subdivision stand for the limit surface. The reference is refined further in 113 bits, then taken
 * to the limit by the published mask. */
#include "tradeoff/reference_surface.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/deviation.h>
#include <meshtool/manifold.h>
#include <meshtool/subdivide.h>

#include <math.h>
#include <stdio.h>

/* Faces of the reference, and of the finest level that is judged beside it. */
#define REFERENCE_FACES 100000U
#define LEVEL_FACES 40000U

/* Of the Hausdorff distance, in diagonals. */
#define TOLERANCE 2e-5

static const char *const levels[] = {"0", "1", "2", "3", "4", NULL};

typedef struct level_state {
    mt_mesh *cage, *reference, *refined;
    double diagonal;
} level_state;

/* The mesh must be what subdivision takes. */
static mt_status find_obstacle(mt_context *context, const mt_mesh *mesh, const char **why)
{
    mt_manifold_report report;
    mt_status status = mt_check_manifold(context, mesh, NULL, &report);
    if (status != MT_OK) {
        return status;
    }
    if (report.manifold_class == MT_NON_MANIFOLD || report.defect_counts[MT_DEFECT_MISORIENTED_EDGE] > 0) {
        *why = "subdivision needs a manifold, oriented mesh";
    } else if (report.defect_counts[MT_DEFECT_NON_FINITE_VERTEX] > 0) {
        *why = "some vertices are not finite";
    }
    mt_manifold_report_release(context, &report);
    return MT_OK;
}

static mt_status make_reference(mt_context *context, level_state *s)
{
    reference_surface surface, finer;
    mt_status status = reference_surface_make(context, s->cage, &surface);
    for (int level = 0; status == MT_OK && (level == 0 || 4 * surface.corner_count <= 4 * REFERENCE_FACES); level++) {
        status = reference_surface_refine(context, &surface, &finer);
        reference_surface_release(context, &surface);
        surface = finer;
    }
    if (status == MT_OK) {
        status = reference_surface_to_limit(context, &surface);
    }
    if (status == MT_OK) {
        status = reference_surface_mesh(context, &surface, &s->reference);
    }
    reference_surface_release(context, &surface);
    return status;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    mt_status status = MT_OK;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces to refine";
    } else if (subject->mesh->corner_count > LEVEL_FACES) {
        *why = "the mesh is so fine that its limit cannot be told from it by a finer one in reasonable time";
    } else {
        status = find_obstacle(context, subject->mesh, why);
    }
    if (status != MT_OK || *why) {
        return status;
    }
    level_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->diagonal = subject->diagonal;
    status = tradeoff_bare_mesh(context, subject->mesh, MT_F64, &s->cage);
    return status == MT_OK ? make_reference(context, s) : status;
}

static void release(void *state, mt_context *context)
{
    level_state *s = state;
    mt_mesh_destroy(context, s->cage);
    mt_mesh_destroy(context, s->reference);
    mt_free(context, s);
}

static const char *refuse(const void *state, size_t level)
{
    const level_state *s = state;
    uint64_t faces = s->cage->corner_count;
    for (size_t i = 1; i < level; i++) {
        faces *= 4;
    }
    return level == 0 || faces <= LEVEL_FACES ? NULL
                                              : "its faces are too many to be told from the limit by a finer mesh";
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    level_state *s = state;
    mt_subdivide_options options = {.level_count = (unsigned)level, .no_levels = level == 0};
    return mt_subdivide(context, s->cage, &options, &s->refined);
}

static void discard(void *state, mt_context *context)
{
    level_state *s = state;
    mt_mesh_destroy(context, s->refined);
    s->refined = NULL;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)level;
    const level_state *s = state;
    mt_deviation deviation;
    mt_deviation_options options = {.tolerance = TOLERANCE * s->diagonal};
    uint64_t bytes = (uint64_t)s->refined->vertex_count * 24 + (uint64_t)s->refined->corner_count * 4;
    tradeoff_add_size(row, "faces", s->refined->face_count);
    tradeoff_add_size(row, "bytes", (double)bytes);
    mt_status status = mt_measure_deviation(context, s->refined, s->reference, &options, &deviation);
    if (status != MT_OK) {
        return status;
    }
    tradeoff_add_error(row, "hausdorff", deviation.hausdorff / s->diagonal);
    tradeoff_add_error(row, "rms", deviation.a_to_b.rms / s->diagonal);
    tradeoff_add_error(row, "normal_degrees", deviation.a_to_b.normal_mean);
    snprintf(row->says, sizeof row->says, "at most %.2g %% of the diagonal from the limit, normals %.2g degrees off",
             100 * deviation.hausdorff / s->diagonal, deviation.a_to_b.normal_mean);
    mt_deviation_release(context, &deviation);
    return MT_OK;
}

const tradeoff_knob tradeoff_levels = {
    .name = "levels",
    .question = "How many levels of Catmull-Clark stand for the limit?",
    .oracle = "a finer mesh taken to the limit in 113-bit arithmetic",
    .axis = "hausdorff",
    .levels = levels,
    .prepare = prepare,
    .refuse = refuse,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
