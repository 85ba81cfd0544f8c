#include <meshtool/surgery.h>

const char *mt_surgery_verdict_words(mt_surgery_verdict verdict)
{
    static const char *const words[MT_SURGERY_VERDICT_COUNT] = {
        [MT_SURGERY_ALLOWED] = "it is allowed",
        [MT_SURGERY_NO_ELEMENT] = "there is no such element",
        [MT_SURGERY_BOUNDARY_EDGE] = "the edge lies on the boundary",
        [MT_SURGERY_INTERIOR_VERTEX] = "a vertex inside the surface must be cut along two edges",
        [MT_SURGERY_NOT_TRIANGLES] = "a face is not a triangle",
        [MT_SURGERY_NOT_A_FACE] = "a face needs three vertices or more, all different",
        [MT_SURGERY_EDGE_EXISTS] = "an edge would be there twice",
        [MT_SURGERY_PINCH] = "the surface would be pinched in a vertex",
        [MT_SURGERY_LONE_FACE] = "the face beside the edge hangs on it alone",
        [MT_SURGERY_DUPLICATE_FACE] = "two faces of the same vertices would remain",
        [MT_SURGERY_COMMON_NEIGHBOR] = "the ends share a neighbor that is not opposite the edge",
        [MT_SURGERY_COMMON_FACE] = "a face beyond the edge names both ends",
    };
    return words[verdict];
}

void mt_surgery_map_release(mt_context *context, mt_surgery_map *map)
{
    mt_free(context, map->vertices);
    mt_free(context, map->edges);
    mt_free(context, map->faces);
    *map = (mt_surgery_map){0};
}
