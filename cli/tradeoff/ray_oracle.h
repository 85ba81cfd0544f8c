/* What a ray must hit, by asking every triangle in 113 bits. The renderer's own vertices may lie off the mesh's by a
 * margin: what that leaves open is not held against it. */
#ifndef MESHTOOL_CLI_TRADEOFF_RAY_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_RAY_ORACLE_H

#include <meshtool/ray.h>

/* The largest t that the nearest hit may have: where the ray meets the first triangle that it passes inside, by more
 * than the margin from every side, and as much farther as the triangle moved by the margin may lie. INFINITY: it may
 * miss. The direction has the length 1. */
double ray_oracle_limit(const mt_mesh *mesh, const mt_triangulation *triangulation, const mt_ray *ray, double margin);

/* Whether a hit is right: on its triangle to within twice the margin, and not beyond the limit. */
bool ray_oracle_accepts(const mt_mesh *mesh, const mt_triangulation *triangulation, const mt_ray *ray,
                        const mt_ray_hit *hit, double limit, double margin);

#endif
