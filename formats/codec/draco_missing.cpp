// What stands in for Draco where meshtool is built without it.
#ifndef MESHTOOL_DRACO

#include "formats/codec/draco.h"

#include <cstdio>

struct mt_draco_mesh {
    int nothing;
};

extern "C" mt_draco_result mt_draco_encode(const mt_draco_source *, mt_draco_hold, mt_draco_allocate, void *,
                                           mt_draco_bytes *, char *message)
{
    std::snprintf(message, MT_DRACO_MESSAGE, "meshtool was built without Draco (MESHTOOL_DRACO=OFF)");
    return MT_DRACO_MISSING;
}

extern "C" mt_draco_result mt_draco_decode(const void *, size_t, mt_draco_hold, void *, mt_draco_mesh **out, size_t *,
                                           char *message)
{
    *out = nullptr;
    std::snprintf(message, MT_DRACO_MESSAGE, "meshtool was built without Draco (MESHTOOL_DRACO=OFF)");
    return MT_DRACO_MISSING;
}

extern "C" void mt_draco_destroy(mt_draco_mesh *)
{
}

extern "C" mt_index mt_draco_vertex_count(const mt_draco_mesh *)
{
    return 0;
}

extern "C" mt_index mt_draco_triangle_count(const mt_draco_mesh *)
{
    return 0;
}

extern "C" size_t mt_draco_attribute_count(const mt_draco_mesh *)
{
    return 0;
}

extern "C" bool mt_draco_attribute_at(const mt_draco_mesh *, size_t, mt_draco_attribute *)
{
    return false;
}

extern "C" bool mt_draco_copy_values(const mt_draco_mesh *, size_t, void *)
{
    return false;
}

extern "C" bool mt_draco_copy_triangles(const mt_draco_mesh *, mt_index *)
{
    return false;
}

#endif
