/* A vertex's own faces are all that its new place, those of its edges and of its faces depend on; what is at the rim of
 * the patch comes out wrong and is not looked at. */
#include "tradeoff/reference_patch.h"

#include <math.h>
#include <string.h>

mt_index reference_sample_step(const mt_mesh *mesh)
{
    return mesh->vertex_count > 0 ? (mesh->vertex_count - 1) / REFERENCE_SAMPLE + 1 : 1;
}

static bool is_near_sample(const mt_mesh *mesh, mt_index face, mt_index step)
{
    bool is_near = false;
    for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
        is_near = is_near || mesh->corner_vertices[corner] % step == 0;
    }
    return is_near;
}

/* Marks the vertices of the faces around the sample, and counts these faces and their corners. */
static void count_elements(const mt_mesh *mesh, mt_index step, mt_index *numbers, reference_surface *cage)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (is_near_sample(mesh, face, step)) {
            cage->face_count++;
            for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
                numbers[mesh->corner_vertices[corner]] = 1;
                cage->corner_count++;
            }
        }
    }
}

/* Numbers the marked vertices in the mesh's order, so that sums over their neighbours have the mesh's order as well. */
static void place_vertices(const mt_mesh *mesh, mt_index *numbers, reference_surface *cage)
{
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        if (numbers[vertex] > 0) {
            cage->positions[cage->vertex_count] = quad3_from(mt_mesh_position(mesh, vertex));
            numbers[vertex] = cage->vertex_count++;
        }
    }
}

static void list_faces(const mt_mesh *mesh, const mt_index *numbers, reference_patch *out, reference_surface *cage)
{
    mt_index count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (is_near_sample(mesh, face, out->step)) {
            cage->offsets[count++] = out->corner_count;
            for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
                cage->corners[out->corner_count] = numbers[mesh->corner_vertices[corner]];
                out->corners[out->corner_count++] = corner;
            }
        }
    }
    cage->offsets[count] = out->corner_count;
}

static mt_status make_cage(mt_context *context, const mt_mesh *mesh, mt_index *numbers, reference_patch *out,
                           reference_surface *cage)
{
    count_elements(mesh, out->step, numbers, cage);
    cage->positions = mt_allocate_array(context, mesh->vertex_count, sizeof *cage->positions);
    cage->offsets = mt_allocate_array(context, (uint64_t)cage->face_count + 1, sizeof *cage->offsets);
    cage->corners = mt_allocate_array(context, cage->corner_count, sizeof *cage->corners);
    out->corners = mt_allocate_array(context, cage->corner_count, sizeof *out->corners);
    if (!cage->positions || !cage->offsets || !cage->corners || !out->corners) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    place_vertices(mesh, numbers, cage);
    list_faces(mesh, numbers, out, cage);
    return MT_OK;
}

mt_status reference_patch_make(mt_context *context, const mt_mesh *mesh, reference_patch *out)
{
    reference_surface cage = {0};
    out->step = reference_sample_step(mesh);
    mt_index *numbers = mt_allocate_array_zeroed(context, mesh->vertex_count, sizeof *numbers);
    mt_status status = numbers ? make_cage(context, mesh, numbers, out, &cage) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? reference_surface_refine(context, &cage, &out->refined) : status;
    reference_surface_release(context, &cage);
    mt_free(context, numbers);
    return status;
}

void reference_patch_release(mt_context *context, reference_patch *patch)
{
    mt_free(context, patch->corners);
    reference_surface_release(context, &patch->refined);
    memset(patch, 0, sizeof *patch);
}

double reference_patch_error(const reference_patch *patch, const mt_mesh *mesh, const mt_mesh *refined)
{
    double worst = 0;
    for (mt_index i = 0; i < patch->corner_count; i++) {
        mt_index corner = patch->corners[i], begin = mt_mesh_face_begin(refined, corner);
        for (mt_index side = 0; side < 4 && mesh->corner_vertices[corner] % patch->step == 0; side++) {
            mt_vec3 found = mt_mesh_position(refined, refined->corner_vertices[begin + side]);
            quad3 right = patch->refined.positions[patch->refined.corners[4 * (size_t)i + side]];
            quad3 d = quad3_subtract(quad3_from(found), right);
            double off = (double)quad_sqrt(quad3_dot(d, d));
            worst = off <= worst ? worst : isnan(off) ? (double)INFINITY : off;
        }
    }
    return worst;
}
