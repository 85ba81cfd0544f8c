/* A face seen in the plane: along the coordinate axis nearest to its area vector, so that the plane's coordinates are
 * two of the file's own, exactly, and counter-clockwise is the face's front. */
#ifndef MT_MESH_POLYGON_H
#define MT_MESH_POLYGON_H

#include <meshtool/mesh.h>

typedef double mt_point2[2];

/* Stores the face's corners in `points`, in their order. False, with nothing of use stored, when a coordinate is not
 * finite. */
bool mt_polygon_project(const mt_mesh *mesh, mt_index face, mt_point2 *points);

static inline bool mt_point2_equal(const mt_point2 a, const mt_point2 b)
{
    return a[0] == b[0] && a[1] == b[1];
}

#endif
