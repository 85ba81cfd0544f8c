/* What the parts of the manifold check share while it runs. */
#ifndef MT_ALGORITHMS_MANIFOLD_CHECK_H
#define MT_ALGORITHMS_MANIFOLD_CHECK_H

#include <meshtool/components.h>
#include <meshtool/edge_pairs.h>
#include <meshtool/manifold.h>
#include <meshtool/self_intersection.h>
#include <meshtool/vertex_fans.h>

/* Blocks of loops; sums are formed block by block, so they never depend on the threads. */
#define MANIFOLD_GRAIN 8192

/* Bits of face_flags. The first is set as mt_find_degenerate_faces does. */
enum { FACE_DEGENERATE = 1, FACE_ZERO_AREA = 2, FACE_MAY_REPEAT = 4, FACE_DUPLICATE = 8 };

/* Boundary edges at a vertex where the boundary touches itself; more are counted as these. */
#define PINCH_ENDS 3

/* A face and the earlier one that it repeats. */
typedef struct duplicate_face {
    mt_index face, earlier;
} duplicate_face;

typedef struct manifold_check {
    mt_context *context;
    const mt_mesh *mesh;
    mt_arithmetic arithmetic;
    mt_manifold_report *report;
    mt_edge_pairs *pairs;
    mt_vertex_fans *fans;
    uint8_t *face_flags;
    uint8_t *vertex_is_non_finite; /* NULL when all are finite */
    mt_vec3 minimum, maximum;      /* of the finite vertices that faces name; zero when there are none */
    uint8_t *
        boundary_ends; /* per vertex how many boundary edges end there, PINCH_ENDS at most; NULL: nowhere more than 2 */
    mt_index *inside_out_faces; /* the first faces of the components that are; NULL when there are none */
    duplicate_face *duplicates; /* in the order of the faces; NULL when there are none */
    mt_self_intersections intersections;
} manifold_check;

/* Each fills its part of the report; they run in this order. */
mt_status mt_manifold_find_duplicates(manifold_check *check);
mt_status mt_manifold_count_loops(manifold_check *check);
mt_status mt_manifold_scan_vertices(manifold_check *check); /* non-finite ones, bounds */
mt_status mt_manifold_measure(manifold_check *check);       /* zero-area faces, area, volume */
mt_status mt_manifold_find_pinches(manifold_check *check);
mt_status mt_manifold_find_inside_out(manifold_check *check);
mt_status mt_manifold_look_as_welded(manifold_check *check);
mt_status mt_manifold_list_defects(manifold_check *check, uint64_t defects_per_kind);

#endif
