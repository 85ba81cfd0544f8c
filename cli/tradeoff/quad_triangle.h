/* Rays and distances to triangles in 113 bits, one triangle at a time. */
#ifndef MESHTOOL_CLI_TRADEOFF_QUAD_TRIANGLE_H
#define MESHTOOL_CLI_TRADEOFF_QUAD_TRIANGLE_H

#include "tradeoff/quad.h"
#include "tradeoff/triangle_blocks.h"

/* The ray's parameter where it meets the triangle, INFINITY: nowhere. Triangles whose box, widened by the margin, the
 * ray passes by in doubles are not looked at. */
double quad_meet_triangle(const mt_vec3 corners[3], const mt_ray *ray, double margin);

/* False: the triangle's box shows in doubles that it is farther from the point than the distance. */
bool quad_may_be_nearer(const mt_vec3 corners[3], mt_vec3 point, double distance);

double quad_distance_to_triangle(const mt_vec3 corners[3], mt_vec3 point);

/* The corners of a mesh's triangle. */
void quad_load_corners(const mt_mesh *mesh, const mt_triangulation *triangulation, mt_index triangle,
                       mt_vec3 corners[3]);

/* The area-weighted unit normals of vertices 0, step, 2 step, ..., n-gons by their area vectors; `normals`, of all
 * vertices, begin as zeros. */
void quad_vertex_normals(const mt_mesh *mesh, mt_index step, quad3 *normals);

#endif
