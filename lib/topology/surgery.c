#include <meshtool/surgery.h>

const char *mt_surgery_verdict_words(mt_surgery_verdict verdict)
{
    static const char *const words[MT_SURGERY_VERDICT_COUNT] = {
        [MT_SURGERY_ALLOWED] = "it is allowed",
        [MT_SURGERY_NO_ELEMENT] = "there is no such element",
        [MT_SURGERY_BOUNDARY_EDGE] = "the edge lies on the boundary",
        [MT_SURGERY_NOT_TRIANGLES] = "a face beside the edge is not a triangle",
        [MT_SURGERY_EDGE_EXISTS] = "an edge would be there twice",
        [MT_SURGERY_PINCH] = "the surface would be pinched in a vertex",
        [MT_SURGERY_COMMON_NEIGHBOR] = "the ends share a neighbor that is not opposite the edge",
        [MT_SURGERY_COMMON_FACE] = "a face that is not beside the edge names both ends",
        [MT_SURGERY_LONE_FACE] = "the face beside the edge has no other neighbor",
        [MT_SURGERY_DUPLICATE_FACE] = "two faces would have the same vertices",
    };
    return words[verdict];
}
