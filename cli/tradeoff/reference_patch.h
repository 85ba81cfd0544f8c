/* A sample of a mesh's vertices, spread evenly over their numbers, and one level of Catmull-Clark around them in 113
 * bits: what judges storage on a mesh that is too large to be refined as a whole. On a small one the sample is all. */
#ifndef MESHTOOL_CLI_TRADEOFF_REFERENCE_PATCH_H
#define MESHTOOL_CLI_TRADEOFF_REFERENCE_PATCH_H

#include "tradeoff/reference_surface.h"

/* Vertices in a sample at most, and how many a mesh's sample leaves out between two of it, plus one. */
#define REFERENCE_SAMPLE 20000U
mt_index reference_sample_step(const mt_mesh *mesh);

typedef struct reference_patch {
    mt_index step; /* of the sample: vertices 0, step, 2 step, ... */
    mt_index corner_count;
    mt_index *corners;         /* of the mesh, ascending: those of all faces around the sample */
    reference_surface refined; /* its face i is around corner i of `corners` */
} reference_patch;

/* The mesh must be manifold and oriented. `out` begins with zeros; released in every case. */
mt_status reference_patch_make(mt_context *context, const mt_mesh *mesh, reference_patch *out);
void reference_patch_release(mt_context *context, reference_patch *patch);

/* How far at most a refined mesh's vertices around the sample are from where they should be; its faces stand in the
 * order of the mesh's corners. */
double reference_patch_error(const reference_patch *patch, const mt_mesh *mesh, const mt_mesh *refined);

#endif
