/* The shared triangulation: the one way in which n-gons become triangles, everywhere. */
#ifndef MESHTOOL_TRIANGULATE_H
#define MESHTOOL_TRIANGULATE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Scratch memory for triangulating one face after the other; all zeros to begin with. */
typedef struct mt_triangulator {
    mt_index capacity;
    void *memory;
} mt_triangulator;

/* Frees the scratch memory; the triangulator may be used again. */
void mt_triangulator_release(mt_context *context, mt_triangulator *triangulator);

/* Triangulates one face into sides - 2 triangles, three local corner numbers (0 to sides - 1) each,
 * stored in `triangles` (room for 3 * (sides - 2)). The face's orientation is kept. All decisions are exact,
 * on the face seen along the coordinate axis nearest to its area vector:
 * - a quad takes the diagonal that turns no triangle over, and of two such the clearly shorter one, else 0-2;
 * - a larger polygon is covered exactly when it is simple or touches itself at most (concave ones, keyholes
 *   around holes); triangles of zero area appear only where repeated points or slits force them;
 * - one that no triangulation covers (self-crossing, zero area) still gets sides - 2 triangles, and one with a
 *   coordinate that is not finite is a fan. */
mt_status mt_triangulate_face(mt_context *context, mt_triangulator *triangulator, const mt_mesh *mesh, mt_index face,
                              mt_index *triangles);

/* Every face of the mesh triangulated, in the order of the faces. */
typedef struct mt_triangulation {
    mt_index triangle_count;
    mt_index *corners; /* 3 * triangle_count corner numbers of the mesh; NULL when all faces are
                          triangles: then triangle t has the corners 3t, 3t+1, 3t+2 */
    mt_index *faces;   /* triangle -> face; NULL when all faces are triangles */
} mt_triangulation;
mt_status mt_triangulation_init(mt_context *context, const mt_mesh *mesh, mt_triangulation *out);
void mt_triangulation_release(mt_context *context, mt_triangulation *triangulation);

static inline mt_index mt_triangulation_corner(const mt_triangulation *t, mt_index triangle, mt_index side)
{
    return t->corners ? t->corners[3 * (size_t)triangle + side] : 3 * triangle + side;
}

static inline mt_index mt_triangulation_face(const mt_triangulation *t, mt_index triangle)
{
    return t->faces ? t->faces[triangle] : triangle;
}

/* A mesh of the triangles alone; attributes and labels follow. */
mt_status mt_mesh_triangulate(mt_context *context, const mt_mesh *mesh, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
