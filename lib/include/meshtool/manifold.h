/* The manifold check. It works on the mesh itself, so it sees defects that no connectivity structure
 * can hold. A non-manifold mesh is a result here, never an error. */
#ifndef MESHTOOL_MANIFOLD_H
#define MESHTOOL_MANIFOLD_H

#include <meshtool/self_intersection.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_manifold_class { MT_MANIFOLD, MT_MANIFOLD_WITH_BOUNDARY, MT_NON_MANIFOLD } mt_manifold_class;

/* Yes, no, or a question that has no answer here (null in JSON). */
typedef enum mt_answer { MT_NO, MT_YES, MT_UNDEFINED } mt_answer;

/* Kinds of defects, in the order in which one would mend them. */
typedef enum mt_defect_kind {
    MT_DEFECT_NON_FINITE_VERTEX,
    MT_DEFECT_DEGENERATE_FACE,
    MT_DEFECT_DUPLICATE_FACE,
    MT_DEFECT_NON_MANIFOLD_EDGE,
    MT_DEFECT_BOUNDARY_PINCH, /* a vertex at which three boundary edges or more end */
    MT_DEFECT_NON_MANIFOLD_VERTEX,
    MT_DEFECT_MISORIENTED_EDGE,
    MT_DEFECT_INSIDE_OUT_COMPONENT, /* closed, oriented, its signed volume below 0; listed by its first face */
    MT_DEFECT_ZERO_AREA_FACE,
    MT_DEFECT_SELF_INTERSECTION, /* a pair of faces */
    MT_DEFECT_ISOLATED_VERTEX,
    MT_DEFECT_BOUNDARY_EDGE, /* a hole is a defect only to who wants a closed mesh */
    MT_DEFECT_KIND_COUNT
} mt_defect_kind;

/* The kind's JSON key ("non_manifold_edges") and its words ("non-manifold edge"). */
const char *mt_defect_key(mt_defect_kind kind);
const char *mt_defect_words(mt_defect_kind kind);

typedef struct mt_defect {
    mt_defect_kind kind;
    mt_index vertex_count;
    const mt_index *vertices; /* owned by the report */
    mt_index face_count;
    const mt_index *faces;
} mt_defect;

/* All zeros means the defaults. */
typedef struct mt_manifold_options {
    uint64_t defects_per_kind; /* how many of each kind are listed; 0: 100; UINT64_MAX: all */
    bool self_intersections;   /* search for them; many times the cost of all the rest */
    bool inside_out;           /* look for components that are */
    bool as_welded;            /* look beside it at the mesh welded; the mesh itself stays as it is */
    mt_arithmetic arithmetic;  /* of zero-area faces, self-intersections and inside-out components; to measure by */
} mt_manifold_options;

/* A mesh after vertices at bit-equal positions (weld.h) became one. */
typedef struct mt_manifold_welded {
    mt_manifold_class manifold_class;
    mt_index vertex_count, boundary_edge_count, non_manifold_edge_count, non_manifold_vertex_count;
} mt_manifold_welded;

/* Each count is defined in the table of the command line's contract (README, check-manifold). */
typedef struct mt_manifold_report {
    mt_index vertex_count, face_count, corner_count;
    uint64_t triangle_count;
    mt_index edge_count;
    mt_index defect_counts[MT_DEFECT_KIND_COUNT];
    mt_index component_count;
    mt_index boundary_loop_count; /* MT_NONE: undefined */
    int64_t euler_characteristic;
    mt_manifold_class manifold_class;
    mt_answer oriented;
    mt_answer orientable;
    bool has_genus;
    int64_t genus; /* may be wrong only if has_genus is false */
    double area;   /* of the shared triangulation, finite vertices only */
    bool has_volume;
    double volume;               /* signed */
    bool has_self_intersections; /* whether they were searched for */
    bool has_inside_out;
    bool has_as_welded;
    mt_manifold_welded as_welded;
    size_t defect_list_count;
    mt_defect *defects; /* by kind, in the order of their elements */
    void *storage;      /* memory of the lists */
} mt_manifold_report;

/* Fills *report. O(size) time. Release it with mt_manifold_report_release. */
mt_status mt_check_manifold(mt_context *context, const mt_mesh *mesh, const mt_manifold_options *options,
                            mt_manifold_report *report);
void mt_manifold_report_release(mt_context *context, mt_manifold_report *report);

#ifdef __cplusplus
}
#endif
#endif
