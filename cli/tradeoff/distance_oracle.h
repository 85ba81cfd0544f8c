/* How far a surface lies from another, in 113 bits: the largest distance between two bounds, and the mean. */
#ifndef MESHTOOL_CLI_TRADEOFF_DISTANCE_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_DISTANCE_ORACLE_H

#include <meshtool/mesh.h>

typedef struct distance_oracle {
    double lower, upper; /* of the largest distance from the first surface to the second */
    double mean;         /* over the area, by quadrature where it varies most ... */
    double mean_error;   /* ... and by how much the last refinement of each piece changed it */
} distance_oracle;

/* Both meshes have triangles. `tolerance`: how far apart the bounds should be; they are farther where that took too
 * much work. */
mt_status distance_oracle_measure(mt_context *context, const mt_mesh *from, const mt_mesh *to, double tolerance,
                                  distance_oracle *out);

#endif
