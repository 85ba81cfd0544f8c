/* Which faces of a mesh meet where they should not, decided exactly. */
#ifndef MESHTOOL_SELF_INTERSECTION_H
#define MESHTOOL_SELF_INTERSECTION_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Two faces, a < b. */
typedef struct mt_face_pair {
    mt_index a, b;
} mt_face_pair;

/* How signs are found when two triangles are held against each other. */
typedef enum mt_arithmetic {
    MT_ARITHMETIC_ADAPTIVE, /* in doubles where their error bound allows, else exactly: always right */
    MT_ARITHMETIC_EXACT,    /* exactly throughout, without any shortcut in doubles: the same answers, to measure by */
    MT_ARITHMETIC_FLOATING /* in doubles as they come, as most programs do: pairs are missed and made up where triangles
                              nearly touch. To measure by; no result of meshtool stands on it */
} mt_arithmetic;

/* All zeros means the defaults. */
typedef struct mt_self_intersection_options {
    mt_arithmetic arithmetic;
    bool only_first; /* stop early: at least one pair is found where there are any, but not all */
} mt_self_intersection_options;

typedef struct mt_self_intersections {
    uint64_t pair_count;
    mt_face_pair *pairs; /* ascending by a, then b; each pair of faces once */
} mt_self_intersections;

/* Finds the pairs of faces that intersect, on the shared triangulation, with vertices shared by index: triangles that
 * share an edge intersect when they are coplanar and on the same side of it; that share one vertex, when the opposite
 * edge of one meets the other; that share none, at any contact; that share all three are duplicates and not
 * counted. A face never pairs with itself. Triangles of zero area, or with a vertex that is not finite, take no
 * part. Exact for all finite coordinates (predicates.h). O((n + candidates) log n); the same answer for any number of
 * threads. Release with mt_self_intersections_release. */
mt_status mt_find_self_intersections(mt_context *context, const mt_mesh *mesh,
                                     const mt_self_intersection_options *options, mt_self_intersections *out);
void mt_self_intersections_release(mt_context *context, mt_self_intersections *intersections);

#ifdef __cplusplus
}
#endif
#endif
