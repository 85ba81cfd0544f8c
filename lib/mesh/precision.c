/* Changing the stored precision of positions. */
#include <meshtool/mesh.h>

static mt_index narrow(const double *from, float *to, size_t count)
{
    mt_index overflowed = 0;
    for (size_t i = 0; i < count; i++) {
        to[i] = (float)from[i];
        overflowed += isinf(to[i]) && !isinf(from[i]);
    }
    return overflowed;
}

static void widen(const float *from, double *to, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        to[i] = (double)from[i];
    }
}

mt_status mt_mesh_set_position_type(mt_context *context, mt_mesh *mesh, mt_type type, mt_index *overflowed)
{
    if (overflowed) {
        *overflowed = 0;
    }
    if (mesh->position_type == type) {
        return MT_OK;
    }
    void *positions = mt_allocate_array(context, mesh->vertex_count, 3 * mt_type_size(type));
    if (!positions) {
        return mt_context_error(context)->status;
    }
    size_t count = 3 * (size_t)mesh->vertex_count;
    if (type == MT_F32) {
        mt_index lost = narrow(mesh->positions, positions, count);
        if (overflowed) {
            *overflowed = lost;
        }
    } else {
        widen(mesh->positions, positions, count);
    }
    mt_free(context, mesh->positions);
    mesh->positions = positions;
    mesh->position_type = type;
    return MT_OK;
}
