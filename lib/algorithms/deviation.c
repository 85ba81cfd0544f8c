/* Both directions of a deviation, one after the other: samples (deviation_sample.c), then the maximum's bound
 * (deviation_refine.c). Linear in the faces times a search each; 32 bytes a vertex and a triangle beside the trees. */
#include <meshtool/deviation.h>

#include "lib/algorithms/deviation_side.h"

#define DEFAULT_TOLERANCE 1e-4
#define DEFAULT_SPACING 1e-2

/* Finer than this a tolerance is not kept: doubles of the meshes' own coordinates end near. */
#define FINEST_TOLERANCE 1e-12

static unsigned choose_elements(const mt_mesh *mesh)
{
    if (mesh->face_count) {
        return MT_SURFACE_TRIANGLES;
    }
    return mesh->wire_count ? MT_SURFACE_WIRES : mesh->point_count ? MT_SURFACE_POINTS : MT_SURFACE_VERTICES;
}

static mt_status init_surface(mt_context *context, const mt_mesh *mesh, const char *name, mt_deviation_surface *out)
{
    *out = (mt_deviation_surface){.mesh = mesh};
    const mt_surface_tree_options options = {.elements = choose_elements(mesh)};
    mt_status status = mt_triangulation_init(context, mesh, &out->triangulation);
    if (status == MT_OK) {
        status = mt_surface_tree_create(context, mesh, &out->triangulation, &options, &out->tree);
    }
    if (status == MT_OK && !mt_surface_tree_count(out->tree)) {
        status = mt_fail(context, MT_ERROR_INVALID_MESH,
                         "the %s mesh has nothing to measure to: no face, wire or point with finite coordinates", name);
    }
    if (status == MT_OK && mt_surface_tree_left_out(out->tree)) {
        mt_warn(context, "%u elements of the %s mesh have a vertex that is not finite; they are left out",
                mt_surface_tree_left_out(out->tree), name);
    }
    return status;
}

static void release_surface(mt_context *context, mt_deviation_surface *surface)
{
    mt_surface_tree_destroy(context, surface->tree);
    mt_triangulation_release(context, &surface->triangulation);
}

static double diagonal_of(const mt_mesh *a, const mt_mesh *b)
{
    mt_bounds first = mt_mesh_bounds(a), second = mt_mesh_bounds(b);
    const double low[3] = {fmin(first.minimum.x, second.minimum.x), fmin(first.minimum.y, second.minimum.y),
                           fmin(first.minimum.z, second.minimum.z)};
    const double high[3] = {fmax(first.maximum.x, second.maximum.x), fmax(first.maximum.y, second.maximum.y),
                            fmax(first.maximum.z, second.maximum.z)};
    /* halved and scaled, so that neither the difference nor its square overflows */
    mt_vec3 half =
        mt_vec3_make(high[0] * 0.5 - low[0] * 0.5, high[1] * 0.5 - low[1] * 0.5, high[2] * 0.5 - low[2] * 0.5);
    double scale = mt_power_of_two_scale(mt_vec3_max_abs(half));
    return mt_vec3_length(mt_vec3_scale(half, scale)) / scale * 2;
}

static mt_status keep_distances(mt_deviation_job *job)
{
    mt_index count = job->from->mesh->vertex_count;
    job->out->vertex_distances = mt_allocate_array(job->context, count, sizeof *job->out->vertex_distances);
    if (!job->out->vertex_distances) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < count; i++) {
        job->out->vertex_distances[i] = job->vertices[i].distance;
    }
    return MT_OK;
}

static mt_status measure_side(mt_deviation_job *job, bool keeps_distances)
{
    job->vertices = mt_allocate_array(job->context, job->from->mesh->vertex_count, sizeof *job->vertices);
    job->centers = mt_allocate_array(job->context, job->from->triangulation.triangle_count, sizeof *job->centers);
    mt_status status = job->vertices && job->centers ? mt_deviation_sample(job) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        status = mt_deviation_refine(job);
    }
    if (status == MT_OK && keeps_distances) {
        status = keep_distances(job);
    }
    if (status == MT_OK) {
        mt_closest closest;
        mt_surface_tree_closest(job->to->tree, job->out->from, NULL, &closest);
        job->out->to = closest.point;
    }
    mt_free(job->context, job->vertices);
    mt_free(job->context, job->centers);
    return status;
}

static mt_status measure(mt_context *context, const mt_deviation_surface *a, const mt_deviation_surface *b,
                         const mt_deviation_options *options, mt_deviation *out)
{
    out->diagonal = diagonal_of(a->mesh, b->mesh);
    double share = options->relative_tolerance > 0 ? options->relative_tolerance : DEFAULT_TOLERANCE;
    double tolerance = options->tolerance > 0 ? options->tolerance : share * out->diagonal;
    double spacing = options->spacing > 0 ? options->spacing : DEFAULT_SPACING * out->diagonal;
    mt_deviation_job job = {.context = context, .from = a, .to = b, .spacing = spacing, .out = &out->a_to_b};
    job.maximum_only = options->maximum_only;
    job.tolerance = fmax(tolerance, FINEST_TOLERANCE * out->diagonal);
    job.unit = mt_power_of_two_scale(out->diagonal);
    int part = mt_part_begin(context, "distances from the first mesh", NULL);
    mt_status status = measure_side(&job, options->keep_distances);
    mt_part_end(context, part);
    if (status == MT_OK) {
        part = mt_part_begin(context, "distances from the second mesh", NULL);
        job.from = b, job.to = a, job.out = &out->b_to_a;
        status = measure_side(&job, options->keep_distances);
        mt_part_end(context, part);
    }
    out->hausdorff = fmax(out->a_to_b.max, out->b_to_a.max);
    double highest = fmax(out->a_to_b.max + out->a_to_b.max_error, out->b_to_a.max + out->b_to_a.max_error);
    out->hausdorff_error = highest - out->hausdorff;
    return status;
}

mt_status mt_measure_deviation(mt_context *context, const mt_mesh *a, const mt_mesh *b,
                               const mt_deviation_options *options, mt_deviation *out)
{
    const mt_deviation_options defaults = {0};
    mt_deviation_surface first, second = {0};
    *out = (mt_deviation){0};
    mt_status status = init_surface(context, a, "first", &first);
    if (status == MT_OK) {
        status = init_surface(context, b, "second", &second);
    }
    if (status == MT_OK) {
        status = measure(context, &first, &second, options ? options : &defaults, out);
    }
    release_surface(context, &first);
    release_surface(context, &second);
    if (status != MT_OK) {
        mt_deviation_release(context, out);
    }
    return status;
}

void mt_deviation_release(mt_context *context, mt_deviation *deviation)
{
    mt_free(context, deviation->a_to_b.vertex_distances);
    mt_free(context, deviation->b_to_a.vertex_distances);
    *deviation = (mt_deviation){0};
}
