/* The mesh as it would be after welding: its faces, named by the numbers of their vertices' places, looked at once
 * more. Where no two vertices coincide, which is decided first, that is the mesh itself and nothing more is done.
 *
 * Cost: that decision (point_coincidence.c); when vertices coincide also welding, and pairs and fans anew, with 28
 * bytes a vertex and 4 a corner beside those. */
#include "lib/algorithms/manifold_check.h"

#include <meshtool/degenerate_faces.h>
#include <meshtool/weld.h>

static mt_manifold_class classify(const mt_mesh *mesh, const mt_manifold_welded *welded, mt_index degenerate_count)
{
    if (welded->non_manifold_edge_count || welded->non_manifold_vertex_count || degenerate_count) {
        return MT_NON_MANIFOLD;
    }
    bool closed = mesh->face_count > 0 && welded->boundary_edge_count == 0;
    return closed ? MT_MANIFOLD : MT_MANIFOLD_WITH_BOUNDARY;
}

static void repeat_report(mt_manifold_report *report)
{
    report->as_welded = (mt_manifold_welded){
        .manifold_class = report->manifold_class,
        .vertex_count = report->vertex_count,
        .boundary_edge_count = report->defect_counts[MT_DEFECT_BOUNDARY_EDGE],
        .non_manifold_edge_count = report->defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE],
        .non_manifold_vertex_count = report->defect_counts[MT_DEFECT_NON_MANIFOLD_VERTEX],
    };
}

static mt_status look_with_pairs(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, uint8_t *flags,
                                 mt_manifold_welded *welded)
{
    mt_index degenerate_count = 0;
    mt_status status = mt_find_degenerate_faces(context, mesh, flags, &degenerate_count);
    mt_vertex_fans *fans = NULL;
    if (status == MT_OK) {
        status = mt_vertex_fans_create(context, mesh, pairs, degenerate_count ? flags : NULL, &fans);
    }
    if (status == MT_OK) {
        *welded = (mt_manifold_welded){
            .vertex_count = mesh->vertex_count,
            .boundary_edge_count = pairs->boundary_count,
            .non_manifold_edge_count = pairs->non_manifold_count,
            .non_manifold_vertex_count = fans->several_count,
        };
        welded->manifold_class = classify(mesh, welded, degenerate_count);
    }
    mt_vertex_fans_destroy(context, fans);
    return status;
}

static mt_status look(mt_context *context, const mt_mesh *mesh, mt_manifold_welded *welded)
{
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    if (status != MT_OK) {
        return status;
    }
    uint8_t *flags = mt_allocate(context, mesh->face_count);
    status = flags ? look_with_pairs(context, mesh, pairs, flags, welded) : MT_ERROR_OUT_OF_MEMORY;
    mt_free(context, flags);
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

typedef struct renumbering {
    const mt_index *corner_vertices, *numbers;
    mt_index *places; /* per corner */
} renumbering;

static void renumber_corners(void *user, uint64_t begin, uint64_t end)
{
    const renumbering *job = user;
    for (uint64_t c = begin; c < end; c++) {
        job->places[c] = job->numbers[job->corner_vertices[c]];
    }
}

/* The faces between places. The shell owns nothing and has no attributes. */
static mt_status look_at_places(const manifold_check *check, const mt_index *numbers, void *distinct,
                                mt_index distinct_count)
{
    const mt_mesh *mesh = check->mesh;
    mt_index *corners = mt_allocate_array(check->context, mesh->corner_count, sizeof *corners);
    if (!corners) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    renumbering job = {mesh->corner_vertices, numbers, corners};
    mt_parallel_for(check->context, mesh->corner_count, MANIFOLD_GRAIN, renumber_corners, &job);
    mt_mesh shell = {
        .vertex_count = distinct_count,
        .position_type = mesh->position_type,
        .positions = distinct,
        .face_count = mesh->face_count,
        .corner_count = mesh->corner_count,
        .face_size = mesh->face_size,
        .face_offsets = mesh->face_offsets,
        .corner_vertices = corners,
    };
    mt_status status = look(check->context, &shell, &check->report->as_welded);
    mt_free(check->context, corners);
    return status;
}

static mt_status weld_and_look(manifold_check *check)
{
    mt_context *context = check->context;
    const mt_mesh *mesh = check->mesh;
    void *distinct = mt_allocate_array(context, mesh->vertex_count, 3 * mt_type_size(mesh->position_type));
    mt_index *numbers = mt_allocate_array(context, mesh->vertex_count, sizeof *numbers);
    mt_index distinct_count = 0;
    mt_status status = distinct && numbers ? mt_weld_exact(context, mesh->positions, mesh->position_type,
                                                           mesh->vertex_count, distinct, numbers, &distinct_count)
                                           : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK && distinct_count == mesh->vertex_count) {
        repeat_report(check->report);
    } else if (status == MT_OK) {
        status = look_at_places(check, numbers, distinct, distinct_count);
    }
    mt_free(context, numbers);
    mt_free(context, distinct);
    return status;
}

mt_status mt_manifold_look_as_welded(manifold_check *check)
{
    const mt_mesh *mesh = check->mesh;
    int part = mt_part_begin(check->context, "as welded", "the verdict if coinciding vertices were one");
    bool possible = false;
    mt_status status =
        mt_points_may_coincide(check->context, mesh->positions, mesh->position_type, mesh->vertex_count, &possible);
    if (status == MT_OK && possible) {
        status = weld_and_look(check);
    } else if (status == MT_OK) {
        repeat_report(check->report);
    }
    check->report->has_as_welded = status == MT_OK;
    mt_part_end(check->context, part);
    return status;
}
