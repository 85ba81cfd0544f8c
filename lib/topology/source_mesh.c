#include "lib/topology/source_mesh.h"

#include <string.h>

mt_status mt_source_mesh_create(mt_context *context, const mt_mesh *source, const mt_mesh_layout *layout, mt_mesh **out)
{
    *out = NULL;
    if (source->vertex_count != layout->vertex_count) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "positions of %u vertices cannot serve a structure of %u",
                       source->vertex_count, (mt_index)layout->vertex_count);
    }
    mt_mesh_layout own = *layout;
    own.position_type = source->position_type;
    mt_status status = mt_mesh_create(context, &own, out);
    if (status == MT_OK) {
        memcpy((*out)->positions, source->positions,
               3 * (size_t)source->vertex_count * mt_type_size(source->position_type));
        (*out)->up = source->up;
        (*out)->welded = source->welded;
    }
    return status;
}
