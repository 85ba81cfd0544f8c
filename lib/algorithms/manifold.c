/* The manifold check: each count as the command line's contract defines it, on the mesh itself, so that defects that no
 * connectivity structure can hold are seen. Sides are paired once; all that is asked of edges is read from the pairs.
 *
 * Cost: O(vertices + corners) time but for the inverse Ackermann function of union-find; about 16 bytes a corner and 16
 * a vertex while it runs. */
#include "lib/algorithms/manifold_check.h"

#include <meshtool/degenerate_faces.h>

#include <string.h>

#define LISTED_BY_DEFAULT 100 /* defects of each kind */

static uint64_t count_triangles(const mt_mesh *mesh)
{
    return (uint64_t)mesh->corner_count - 2 * (uint64_t)mesh->face_count;
}

static void report_edges(const manifold_check *check)
{
    mt_manifold_report *report = check->report;
    const mt_edge_pairs *pairs = check->pairs;
    report->edge_count = pairs->edge_count;
    report->defect_counts[MT_DEFECT_BOUNDARY_EDGE] = pairs->boundary_count;
    report->defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE] = pairs->non_manifold_count;
    report->defect_counts[MT_DEFECT_MISORIENTED_EDGE] = pairs->misoriented_count;
}

/* A triangle that names a vertex twice has a side a = b; without those, triangles need no look. */
static mt_status find_degenerate(manifold_check *check)
{
    const mt_mesh *mesh = check->mesh;
    check->face_flags = mt_allocate(check->context, mesh->face_count);
    if (!check->face_flags) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    if (!mesh->face_offsets && mesh->face_size == 3 && check->pairs->degenerate_side_count == 0) {
        memset(check->face_flags, 0, mesh->face_count);
        return MT_OK;
    }
    return mt_find_degenerate_faces(check->context, mesh, check->face_flags,
                                    &check->report->defect_counts[MT_DEFECT_DEGENERATE_FACE]);
}

static mt_status find_fans(manifold_check *check)
{
    mt_manifold_report *report = check->report;
    const uint8_t *degenerate = report->defect_counts[MT_DEFECT_DEGENERATE_FACE] ? check->face_flags : NULL;
    mt_status status = mt_vertex_fans_create(check->context, check->mesh, check->pairs, degenerate, &check->fans);
    if (status == MT_OK) {
        report->defect_counts[MT_DEFECT_NON_MANIFOLD_VERTEX] = check->fans->several_count;
        report->defect_counts[MT_DEFECT_ISOLATED_VERTEX] = check->fans->isolated_count;
    }
    return status;
}

static mt_manifold_class classify(const mt_manifold_report *report)
{
    if (report->defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE] || report->defect_counts[MT_DEFECT_NON_MANIFOLD_VERTEX] ||
        report->defect_counts[MT_DEFECT_DEGENERATE_FACE]) {
        return MT_NON_MANIFOLD;
    }
    bool closed = report->face_count > 0 && report->defect_counts[MT_DEFECT_BOUNDARY_EDGE] == 0;
    return closed ? MT_MANIFOLD : MT_MANIFOLD_WITH_BOUNDARY;
}

static mt_status find_components(manifold_check *check)
{
    mt_components *components = NULL;
    mt_status status = mt_components_create(check->context, check->mesh, check->pairs, false, &components);
    if (status == MT_OK) {
        bool undefined = check->pairs->non_manifold_count > 0;
        check->report->component_count = components->component_count;
        check->report->orientable = undefined ? MT_UNDEFINED : components->orientable ? MT_YES : MT_NO;
        check->report->oriented = undefined ? MT_UNDEFINED : check->pairs->misoriented_count ? MT_NO : MT_YES;
    }
    mt_components_destroy(check->context, components);
    return status;
}

/* What follows from the counts. */
static void conclude(manifold_check *check)
{
    mt_manifold_report *report = check->report;
    int64_t used = (int64_t)report->vertex_count - report->defect_counts[MT_DEFECT_ISOLATED_VERTEX];
    report->euler_characteristic = used - report->edge_count + report->face_count;
    report->manifold_class = classify(report);
}

static void find_genus(mt_manifold_report *report)
{
    report->has_genus = report->manifold_class != MT_NON_MANIFOLD && report->orientable == MT_YES;
    if (report->has_genus) {
        int64_t closed_characteristic = report->euler_characteristic + report->boundary_loop_count;
        report->genus = (int64_t)report->component_count - closed_characteristic / 2;
    }
}

static mt_status find_self_intersections(manifold_check *check)
{
    mt_manifold_report *report = check->report;
    const mt_self_intersection_options how = {.arithmetic = check->arithmetic};
    mt_status status = mt_find_self_intersections(check->context, check->mesh, &how, &check->intersections);
    if (status == MT_OK) {
        report->has_self_intersections = true;
        report->defect_counts[MT_DEFECT_SELF_INTERSECTION] = (mt_index)check->intersections.pair_count;
    }
    return status;
}

static mt_status run_check(manifold_check *check, const mt_manifold_options *options)
{
    mt_context *context = check->context;
    mt_status status = mt_edge_pairs_create(context, check->mesh, &check->pairs);
    if (status != MT_OK) {
        return status;
    }
    report_edges(check);
    typedef mt_status (*step)(manifold_check *);
    static const step connectivity[] = {find_degenerate, find_fans, find_components, mt_manifold_find_duplicates};
    for (size_t i = 0; i < sizeof connectivity / sizeof *connectivity && status == MT_OK; i++) {
        status = mt_progress(context, "checking", 0.3 + 0.1 * (double)i);
        status = status == MT_OK ? connectivity[i](check) : status;
    }
    if (status != MT_OK) {
        return status;
    }
    conclude(check);
    static const step geometry[] = {mt_manifold_count_loops, mt_manifold_find_pinches, mt_manifold_scan_vertices,
                                    mt_manifold_measure};
    for (size_t i = 0; i < sizeof geometry / sizeof *geometry && status == MT_OK; i++) {
        status = mt_progress(context, "checking", 0.7 + 0.05 * (double)i);
        status = status == MT_OK ? geometry[i](check) : status;
    }
    find_genus(check->report);
    mt_part_skip(check->context, "half-edges", "the verdict needs which sides share an edge, and no walks");
    if (!options->self_intersections) {
        mt_part_skip(check->context, "pairs of triangles", "self-intersections were not asked for");
    }
    if (status == MT_OK && options->self_intersections) {
        status = find_self_intersections(check);
    }
    if (status == MT_OK && options->inside_out) {
        status = mt_manifold_find_inside_out(check);
    }
    if (status == MT_OK && options->as_welded) {
        status = mt_manifold_look_as_welded(check);
    }
    uint64_t limit = options->defects_per_kind ? options->defects_per_kind : LISTED_BY_DEFAULT;
    return status == MT_OK ? mt_manifold_list_defects(check, limit) : status;
}

static void release_check(manifold_check *check)
{
    mt_edge_pairs_destroy(check->context, check->pairs);
    mt_vertex_fans_destroy(check->context, check->fans);
    mt_free(check->context, check->face_flags);
    mt_free(check->context, check->vertex_is_non_finite);
    mt_free(check->context, check->duplicates);
    mt_free(check->context, check->boundary_ends);
    mt_free(check->context, check->inside_out_faces);
    mt_self_intersections_release(check->context, &check->intersections);
}

mt_status mt_check_manifold(mt_context *context, const mt_mesh *mesh, const mt_manifold_options *options,
                            mt_manifold_report *report)
{
    *report = (mt_manifold_report){.vertex_count = mesh->vertex_count,
                                   .face_count = mesh->face_count,
                                   .corner_count = mesh->corner_count,
                                   .triangle_count = count_triangles(mesh),
                                   .boundary_loop_count = MT_NONE};
    int part = mt_part_begin(context, "manifold check", "every count of the report");
    static const mt_manifold_options defaults = {0};
    options = options ? options : &defaults;
    manifold_check check = {.context = context, .mesh = mesh, .arithmetic = options->arithmetic, .report = report};
    mt_status status = run_check(&check, options);
    release_check(&check);
    if (status != MT_OK) {
        mt_manifold_report_release(context, report);
    }
    mt_part_end(context, part);
    return status;
}

void mt_manifold_report_release(mt_context *context, mt_manifold_report *report)
{
    mt_free(context, report->defects);
    mt_free(context, report->storage);
    *report = (mt_manifold_report){0};
}
