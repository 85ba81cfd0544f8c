/* The two ways in which faces are kept: all of one size, or with offsets. */
#include <meshtool/mesh.h>

void mt_mesh_compact_faces(mt_context *context, mt_mesh *mesh)
{
    if (!mesh->face_offsets || mesh->face_count == 0) {
        return;
    }
    mt_index size = mesh->face_offsets[1];
    for (mt_index face = 1; face < mesh->face_count; face++) {
        if (mesh->face_offsets[face + 1] - mesh->face_offsets[face] != size) {
            return;
        }
    }
    mt_free(context, mesh->face_offsets);
    mesh->face_offsets = NULL;
    mesh->face_size = size;
}

mt_status mt_mesh_expand_faces(mt_context *context, mt_mesh *mesh)
{
    if (mesh->face_offsets) {
        return MT_OK;
    }
    mt_index *offsets = mt_allocate_array(context, (uint64_t)mesh->face_count + 1, sizeof *offsets);
    if (!offsets) {
        return mt_context_error(context)->status;
    }
    for (mt_index face = 0; face <= mesh->face_count; face++) {
        offsets[face] = face * mesh->face_size;
    }
    mesh->face_offsets = offsets;
    mesh->face_size = 0;
    return MT_OK;
}
