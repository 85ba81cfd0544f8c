/* With L levels face q of the result comes from corner q >> 2(L-1) of the mesh, with triangles from face q >> 2L. Cost:
 * O(result), only with holes. */
#include "lib/algorithms/subdivide_trim.h"

#include <meshtool/derive.h>

/* Lists the faces that stay, and returns their number. */
static mt_index list_kept(const mt_mesh *mesh, const uint8_t *holes, unsigned level_count, bool triangles,
                          mt_index *kept)
{
    unsigned shift = 2 * (level_count - 1);
    mt_index count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face) << shift, end = mt_mesh_face_end(mesh, face) << shift;
        begin = triangles ? face << (shift + 2) : begin;
        end = triangles ? (face + 1) << (shift + 2) : end;
        for (mt_index child = begin; !holes[face] && child < end; child++) {
            kept[count++] = child;
        }
    }
    return count;
}

static mt_status forget_marks(mt_context *context, mt_mesh *mesh)
{
    const mt_attribute *marks = mt_mesh_find_holes(mesh);
    unsigned boundary = 0;
    if (marks) {
        mt_mesh_remove_attribute(context, mesh, (mt_index)(marks - mesh->attributes));
    }
    bool asks = mt_subdivision_tag_get(mesh, MT_TAG_BOUNDARY, &boundary) && boundary == 0;
    return asks ? mt_subdivision_tag_set(context, mesh, MT_TAG_BOUNDARY, 2) : MT_OK;
}

mt_status mt_subdivide_trim(mt_context *context, const mt_mesh *mesh, const uint8_t *holes, unsigned level_count,
                            mt_mesh **result)
{
    mt_index *faces = mt_allocate_array(context, (*result)->face_count, sizeof *faces);
    mt_index *corners = mt_allocate_array(context, (*result)->corner_count, sizeof *corners);
    mt_mesh *trimmed = NULL;
    mt_status status = faces && corners ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        mt_index sides = (*result)->face_size, count = list_kept(mesh, holes, level_count, sides == 3, faces);
        for (uint64_t corner = 0; corner < (uint64_t)sides * count; corner++) {
            corners[corner] = sides * faces[corner / sides] + (mt_index)(corner % sides);
        }
        mt_derivation derivation = {.vertex_count = (*result)->vertex_count,
                                    .face_count = count,
                                    .face_size = sides,
                                    .face_sources = faces,
                                    .corner_count = (uint64_t)sides * count,
                                    .corner_sources = corners};
        status = mt_mesh_derive(context, *result, &derivation, &trimmed);
    }
    mt_free(context, faces);
    mt_free(context, corners);
    if (status == MT_OK) {
        status = forget_marks(context, trimmed);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, trimmed);
        return status;
    }
    mt_mesh_destroy(context, *result);
    *result = trimmed;
    return MT_OK;
}
