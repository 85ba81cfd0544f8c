/* Components that are inside out: every edge regular, and a signed volume below zero. The wall of a cavity is one too,
 * rightly; that is for the user to know.
 *
 * Cost: O(corners) time, 5 bytes a face and 40 a component; next to nothing for one component of triangles whose volume
 * is known and clear. */
#include "lib/algorithms/component_volume.h"
#include "lib/algorithms/manifold_check.h"

#include <string.h>

/* Of area times extent: above it rounding cannot hide the sign of the report's volume. Larger only sends more meshes to
 * the full look. */
#define CLEAR_VOLUME 0x1p-30

static bool volume_is_clear(const manifold_check *check)
{
    const mt_manifold_report *report = check->report;
    const mt_mesh *mesh = check->mesh;
    double extent = mt_vec3_max_abs(mt_vec3_subtract(check->maximum, check->minimum));
    bool triangles = !mesh->face_offsets && mesh->face_size == 3;
    return check->arithmetic == MT_ARITHMETIC_ADAPTIVE && triangles && report->component_count == 1 &&
           report->has_volume && !check->vertex_is_non_finite && isfinite(report->area) &&
           fabs(report->volume) > CLEAR_VOLUME * report->area * extent;
}

static mt_status keep_faces(manifold_check *check, const mt_index *faces, mt_index count)
{
    check->report->defect_counts[MT_DEFECT_INSIDE_OUT_COMPONENT] = count;
    if (count == 0) {
        return MT_OK;
    }
    check->inside_out_faces = mt_allocate_array(check->context, count, sizeof *faces);
    if (!check->inside_out_faces) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memcpy(check->inside_out_faces, faces, count * sizeof *faces);
    return MT_OK;
}

/* Signs of open and badly turned components become 0. */
static void clear_open(const manifold_check *check, const mt_components *components, int8_t *signs)
{
    const mt_mesh *mesh = check->mesh;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            if (mt_edge_class_of(mesh, check->pairs, c) != MT_EDGE_REGULAR) {
                signs[components->face_component[face]] = 0;
            }
        }
    }
}

static mt_status find_in(manifold_check *check, const mt_components *components, int8_t *signs, mt_index *faces)
{
    mt_status status = mt_component_volume_signs(check->context, check->mesh, components, check->arithmetic, signs);
    if (status != MT_OK) {
        return status;
    }
    clear_open(check, components, signs);
    mt_index count = 0;
    for (mt_index face = 0; face < check->mesh->face_count; face++) {
        mt_index component = components->face_component[face];
        if (signs[component] < 0) {
            faces[count++] = face;
            signs[component] = 0;
        }
    }
    return keep_faces(check, faces, count);
}

static mt_status find(manifold_check *check)
{
    mt_context *context = check->context;
    mt_components *components = NULL;
    mt_status status = mt_components_create(context, check->mesh, check->pairs, true, &components);
    if (status != MT_OK) {
        return status;
    }
    int8_t *signs = mt_allocate(context, components->component_count);
    mt_index *faces = mt_allocate_array(context, components->component_count, sizeof *faces);
    status = signs && faces ? find_in(check, components, signs, faces) : MT_ERROR_OUT_OF_MEMORY;
    mt_free(context, faces);
    mt_free(context, signs);
    mt_components_destroy(context, components);
    return status;
}

mt_status mt_manifold_find_inside_out(manifold_check *check)
{
    int part = mt_part_begin(check->context, "inside-out components", "asked for");
    mt_status status = MT_OK;
    if (volume_is_clear(check)) {
        mt_index first = 0;
        status = keep_faces(check, &first, check->report->volume < 0);
    } else {
        status = find(check);
    }
    check->report->has_inside_out = status == MT_OK;
    mt_part_end(check->context, part);
    return status;
}
