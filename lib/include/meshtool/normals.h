/* Normals per face, per vertex and per corner.
 *
 * Arithmetic is in double precision with scaling by powers of two, so that meshes of 1e-150 and 1e150, far from the
 * origin and of needles have the normals that their stored positions give. Sums run over corners in ascending order:
 * the bytes do not depend on the number of threads, and turning the mesh by quarter turns about an axis, or scaling it
 * by a power of two, turns or keeps them bit for bit.
 *
 * Where there is no direction the normal is the zero vector, never a NaN: for a face of no area or with a coordinate
 * that is not finite, for a vertex without faces, or whose faces all are such or cancel exactly. Such faces contribute
 * nothing to others. A face that names a vertex twice contributes there once a corner. */
#ifndef MESHTOOL_NORMALS_H
#define MESHTOOL_NORMALS_H

#include <meshtool/area_vector.h>
#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_normal_kind { MT_NORMALS_VERTEX, MT_NORMALS_FACE, MT_NORMALS_CORNER } mt_normal_kind;

/* How much a face counts at a vertex. */
typedef enum mt_normal_weight {
    MT_NORMAL_WEIGHT_AREA,   /* its area: of an n-gon, of its area vector */
    MT_NORMAL_WEIGHT_ANGLE,  /* its angle there, of n-gons up to 360 degrees: Thuerrner and Wuethrich, "Computing Vertex
                                Normals from Polygonal Facets", JGT 3 (1998) */
    MT_NORMAL_WEIGHT_MAX,    /* the cross product of its two sides there over both their squared lengths, which is exact
                                where the vertex and its neighbours lie on a sphere: Max, "Weights for Computing Vertex
                                Normals from Facet Normals", JGT 4 (1999) */
    MT_NORMAL_WEIGHT_UNIFORM /* 1 */
} mt_normal_weight;

/* All zeros: per vertex, by area, in the precision of the positions. */
typedef struct mt_normal_options {
    mt_normal_kind kind;
    mt_normal_weight weight; /* not of faces */
    mt_type type;            /* MT_F32 or MT_F64; 0: that of the positions */

    /* Of corners. Each corner sums, by the weight, those faces around its vertex whose unit normal's dot product with
     * its own face's is strictly greater than the cosine of the crease angle, and its own face always. Only faces of
     * its own fan count (joined across edges at the vertex): a bow-tie has a normal for each. A corner of a face
     * without a normal takes the whole fan. The dot product must exceed mt_cos(angle) by 2^-40, 2^-20 where positions
     * are f32, so that faces which meet at exactly the angle have a crease between them whatever the rounding. */
    double crease_angle; /* radians, up to pi; 0: MT_DEFAULT_CREASE_ANGLE; negative: every edge is a crease */
    bool reachable_only; /* of these faces only those that are reached around the vertex without crossing a crease,
                            where edges of three faces and more count as such too */
} mt_normal_options;

/* 41 degrees, which no regular polygon has between its sides. */
#define MT_DEFAULT_CREASE_ANGLE 0.71558499331767511

typedef struct mt_normal_report {
    mt_index value_count;     /* normals stored: for corners, those that differ at a vertex */
    mt_index element_count;   /* faces, vertices or corners */
    mt_index undefined_count; /* elements that have the zero vector */
} mt_normal_report;

/* Computes normals and puts them onto the mesh as an attribute: semantic normal, 3 components, on the faces, on the
 * vertices, or on the corners with an index, so that corners of a vertex that agree share one value. Normals of faces
 * replace those of faces; normals of vertices and of corners replace both, since each would contradict the other.
 * options and report may be NULL. On failure the mesh is as it was: MT_ERROR_ARGUMENT for an option out of its range,
 * MT_ERROR_OUT_OF_MEMORY, MT_ERROR_CANCELLED.
 *
 * Time: linear but for corners, which take the sum over creased vertices of n log n for n faces, nearly. */
mt_status mt_mesh_add_normals(mt_context *context, mt_mesh *mesh, const mt_normal_options *options,
                              mt_normal_report *report);

/* The area vector of one face of the mesh: its normal, as long as twice its area. */
mt_scaled_vector mt_face_area_vector(const mt_mesh *mesh, mt_index face);

#ifdef __cplusplus
}
#endif
#endif
