/* How far two meshes lie apart: the Hausdorff distance within a stated error, mean, root mean square, normals.
 *
 * A direction a -> b is about the points of a's surface and their distances to b's. Surfaces are the triangles of the
 * shared triangulation; a mesh without triangles stands for its wires, else its points, else its vertices: b's in full,
 * a's by its vertices. Elements with a vertex that is not finite are left out, with a warning. */
#ifndef MESHTOOL_DEVIATION_H
#define MESHTOOL_DEVIATION_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All zeros means the defaults. */
typedef struct mt_deviation_options {
    double tolerance;          /* of the maxima, in the meshes' units; 0: the next */
    double relative_tolerance; /* the same as a share of the diagonal; 0: 1e-4 */
    double spacing; /* of the samples for mean, rms and normals; 0: 1/100 of the diagonal. Triangles are sampled once at
                       least, whatever their size */
    bool maximum_only;   /* leave out mean, rms and normals, which are then NAN: fewer searches */
    bool keep_distances; /* fill vertex_distances */
} mt_deviation_options;

typedef struct mt_deviation_side {
    double max;         /* the largest distance that was found, at `from`; the true maximum is not below it ... */
    double max_error;   /* ... and above it by no more than this: the tolerance, unless the search was stopped */
    mt_vec3 from, to;   /* where it was found, and the nearest point there */
    double mean, rms;   /* over the area; over the vertices where there is no area */
    double normal_mean; /* angle between the normals of a sample's triangle and the nearest one, over the area, in */
    double normal_max;  /* degrees; NAN where either mesh has no triangles with an area */
    mt_index sample_count;
    double *vertex_distances; /* per vertex of the mesh, NAN where it is not finite; NULL unless asked for */
} mt_deviation_side;

typedef struct mt_deviation {
    mt_deviation_side a_to_b, b_to_a;
    double hausdorff, hausdorff_error; /* the larger maximum, and by how much the true one may be larger */
    double diagonal;                   /* of the box around both */
} mt_deviation;

/* MT_ERROR_INVALID_MESH when a mesh has nothing finite, MT_ERROR_OUT_OF_MEMORY. The same for any number of threads.
 * options may be NULL. */
mt_status mt_measure_deviation(mt_context *context, const mt_mesh *a, const mt_mesh *b,
                               const mt_deviation_options *options, mt_deviation *out);
void mt_deviation_release(mt_context *context, mt_deviation *deviation);

#ifdef __cplusplus
}
#endif
#endif
