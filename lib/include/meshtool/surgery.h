/* Why a change of a connectivity structure is not allowed; one list for all structures. */
#ifndef MESHTOOL_SURGERY_H
#define MESHTOOL_SURGERY_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_surgery_verdict {
    MT_SURGERY_ALLOWED,
    MT_SURGERY_NO_ELEMENT,      /* a number out of range, or of something deleted */
    MT_SURGERY_BOUNDARY_EDGE,   /* a flip needs faces on both sides */
    MT_SURGERY_NOT_TRIANGLES,   /* flip and collapse need triangles beside the edge */
    MT_SURGERY_EDGE_EXISTS,     /* the flipped edge, or a side of the new face, would be there twice */
    MT_SURGERY_PINCH,           /* two boundaries, or two fans of faces, would meet in one vertex */
    MT_SURGERY_COMMON_NEIGHBOR, /* link condition: the ends share a neighbour that is not opposite the edge */
    MT_SURGERY_COMMON_FACE,     /* a face beyond the edge names both ends */
    MT_SURGERY_LONE_FACE,       /* the face beside the edge hangs on it alone; an edge without faces would remain */
    MT_SURGERY_DUPLICATE_FACE,  /* two faces of the same vertices would remain */
    MT_SURGERY_VERDICT_COUNT
} mt_surgery_verdict;

/* The verdict as a clause: "the edge lies on the boundary". */
const char *mt_surgery_verdict_words(mt_surgery_verdict verdict);

#ifdef __cplusplus
}
#endif
#endif
