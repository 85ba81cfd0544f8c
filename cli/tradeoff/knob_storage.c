/* In which precision positions are stored, for bounds, normals and refinement. All is judged beside what 113 bits make
 * of the positions as they were read, so that what storing takes of them counts. */
#include "tradeoff/quad_triangle.h"
#include "tradeoff/reference_patch.h"
#include "tradeoff/statistics.h"

#include <meshtool/manifold.h>
#include <meshtool/normals.h>
#include <meshtool/subdivide.h>

#include <math.h>
#include <stdio.h>

static const char *const levels[] = {"f32", "f64", NULL};
static const mt_type types[] = {MT_F32, MT_F64};

typedef struct storage_state {
    const mt_mesh *mesh;
    double diagonal;
    bool can_refine;
    mt_mesh *stored[2];
    mt_mesh *refined;
    mt_bounds bounds;
    quad3 *normals;
    reference_patch finer;
} storage_state;

static mt_status refine_reference(mt_context *context, storage_state *s)
{
    mt_manifold_report report;
    mt_status status = mt_check_manifold(context, s->mesh, NULL, &report);
    if (status != MT_OK) {
        return status;
    }
    s->can_refine = report.manifold_class != MT_NON_MANIFOLD && report.oriented == MT_YES;
    mt_manifold_report_release(context, &report);
    return s->can_refine ? reference_patch_make(context, s->mesh, &s->finer) : MT_OK;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0 || mt_mesh_bounds(subject->mesh).non_finite_count > 0) {
        *why = subject->mesh->face_count == 0 ? "the mesh has no faces" : "some vertices are not finite";
        return MT_OK;
    }
    storage_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    s->diagonal = subject->diagonal;
    s->normals = mt_allocate_array_zeroed(context, s->mesh->vertex_count, sizeof *s->normals);
    mt_status status = s->normals ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (int i = 0; status == MT_OK && i < 2; i++) {
        status = tradeoff_bare_mesh(context, s->mesh, types[i], &s->stored[i]);
    }
    if (status == MT_OK) {
        quad_vertex_normals(s->mesh, reference_sample_step(s->mesh), s->normals);
        status = refine_reference(context, s);
    }
    return status;
}

static void release(void *state, mt_context *context)
{
    storage_state *s = state;
    mt_mesh_destroy(context, s->stored[0]);
    mt_mesh_destroy(context, s->stored[1]);
    mt_free(context, s->normals);
    reference_patch_release(context, &s->finer);
    mt_free(context, s);
}

/* The normals come onto a copy, as the meshes are shared by all runs. */
static mt_status run(void *state, size_t level, mt_context *context)
{
    storage_state *s = state;
    s->bounds = mt_mesh_bounds(s->stored[level]);
    mt_status status = s->can_refine ? mt_subdivide(context, s->stored[level], NULL, &s->refined) : MT_OK;
    mt_mesh *with_normals = NULL;
    if (status == MT_OK) {
        status = mt_mesh_copy(context, s->stored[level], &with_normals);
    }
    if (status == MT_OK) {
        status = mt_mesh_add_normals(context, with_normals, NULL, NULL);
    }
    mt_mesh_destroy(context, with_normals);
    return status;
}

static void discard(void *state, mt_context *context)
{
    storage_state *s = state;
    mt_mesh_destroy(context, s->refined);
    s->refined = NULL;
}

static mt_status judge_normals(const storage_state *s, size_t level, mt_context *context, tradeoff_statistics *out)
{
    mt_mesh *mesh = NULL;
    double *errors = mt_allocate_array(context, s->mesh->vertex_count, sizeof *errors);
    mt_status status = errors ? mt_mesh_copy(context, s->stored[level], &mesh) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? mt_mesh_add_normals(context, mesh, NULL, NULL) : status;
    if (status == MT_OK) {
        const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
        size_t count = 0;
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex += reference_sample_step(s->mesh)) {
            mt_index value = mt_attribute_value_index(normals, vertex);
            mt_vec3 n = mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                                     mt_attribute_get(normals, value, 2));
            double degrees = tradeoff_degrees_between(n, quad3_round(s->normals[vertex]));
            /* Where there is a normal and none was found, all is wrong. */
            mt_vec3 right = quad3_round(s->normals[vertex]);
            bool has_normal = mt_vec3_is_finite(right) && mt_vec3_dot(right, right) > 0;
            if (!isnan(degrees) || has_normal) {
                errors[count++] = isnan(degrees) ? 180 : degrees;
            }
        }
        *out = tradeoff_statistics_of(errors, count);
    }
    mt_mesh_destroy(context, mesh);
    mt_free(context, errors);
    return status;
}

/* How far the bounds are from those of the mesh as it was read, each vertex asked by itself. */
static double bounds_error(const storage_state *s)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, worst = 0;
    for (mt_index vertex = 0; vertex < s->mesh->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(s->mesh, vertex);
        const double x[3] = {p.x, p.y, p.z};
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = fmin(low[axis], x[axis]);
            high[axis] = fmax(high[axis], x[axis]);
        }
    }
    const double minimum[3] = {s->bounds.minimum.x, s->bounds.minimum.y, s->bounds.minimum.z};
    const double maximum[3] = {s->bounds.maximum.x, s->bounds.maximum.y, s->bounds.maximum.z};
    for (int axis = 0; axis < 3; axis++) {
        double off = fmax(fabs(minimum[axis] - low[axis]), fabs(maximum[axis] - high[axis]));
        worst = off <= worst ? worst : isnan(minimum[axis] + maximum[axis]) ? (double)INFINITY : off;
    }
    return worst / s->diagonal;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    static const char *const names[3] = {"normal_p50", "normal_p99", "normal_max"};
    const storage_state *s = state;
    tradeoff_statistics normals;
    mt_status status = judge_normals(s, level, context, &normals);
    if (status != MT_OK) {
        return status;
    }
    double refined = s->refined ? reference_patch_error(&s->finer, s->mesh, s->refined) / s->diagonal : (double)NAN;
    mt_index step = reference_sample_step(s->mesh), judged = (s->mesh->vertex_count + step - 1) / step;
    tradeoff_add_statistics(row, names, &normals);
    tradeoff_add_error(row, "refined", refined);
    tradeoff_add_error(row, "bounds", bounds_error(s));
    tradeoff_add_size(row, "position_bytes", (double)s->mesh->vertex_count * 3 * (types[level] == MT_F32 ? 4 : 8));
    tradeoff_add_size(row, "judged_vertices", judged);
    int length =
        snprintf(row->says, sizeof row->says, "normals up to %.1g degrees off, refined vertices %.1g of the diagonal",
                 normals.maximum, refined);
    if (step > 1) {
        snprintf(row->says + length, sizeof row->says - (size_t)length, ", at %lu of %lu vertices that are judged",
                 (unsigned long)judged, (unsigned long)s->mesh->vertex_count);
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_storage = {
    .name = "storage",
    .question = "In which precision are positions stored?",
    .oracle = "normals and refinement in 113-bit arithmetic",
    .axis = "normal_max",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
