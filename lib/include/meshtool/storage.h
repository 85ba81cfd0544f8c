/* What the ways to store positions and faces take: by formula, in the numbers that textbooks count and in bytes, and
 * measured, by building them. n_v, n_f, n_e and n_t are vertices, faces, edges and triangles, of which a face of n
 * sides is n - 2. Structures of triangles take the shared triangulation. */
#ifndef MESHTOOL_STORAGE_H
#define MESHTOOL_STORAGE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_storage_kind {
    MT_STORAGE_SEPARATE_TRIANGLES, /* three points each */
    MT_STORAGE_INDEXED_MESH,       /* points, and three indices a triangle */
    MT_STORAGE_INDEXED_POLYGONS,   /* points, an index a corner, and where faces begin unless all have as many sides */
    MT_STORAGE_TRIANGLE_STRIPS, /* points, and strips in one buffer of indices (meshtool/strips.h, fast); by formula as
                                   if one strip sufficed, which is the least */
    MT_STORAGE_TRIANGLE_FANS,   /* points, and fans in one buffer; by formula as if all were six triangles, the
                                   neighbourhood of a regular vertex: nine indices with the restart */
    MT_STORAGE_TRIANGLE_NEIGHBOR, /* the indexed triangles with the side across each side in one number, and a corner a
                                     vertex */
    MT_STORAGE_TRIANGLE_NEIGHBOR_PLAIN, /* the triangle across each side, without its side, and a triangle a vertex */
    MT_STORAGE_WINGED_EDGE,             /* points, eight indices an edge, one a vertex and one a face */
    MT_STORAGE_HALF_EDGE /* points, three indices a half-edge (its pair has a number next to its own), one a vertex and
                            one a face */
} mt_storage_kind;

#define MT_STORAGE_COUNT 9

typedef struct mt_storage {
    const char *key;      /* "half_edge" */
    const char *words;    /* "half-edges" */
    const char *formula;  /* "4 n_v + 6 n_e + n_f" */
    uint64_t coordinates; /* numbers of the mesh's precision */
    uint64_t indices;     /* numbers of 4 bytes */
} mt_storage;

/* For an edge count that is not known: half the corners, as in a closed mesh, where it is right; each boundary edge is
 * half an edge more. */
#define MT_STORAGE_CLOSED UINT64_MAX

/* What the mesh takes in a way, by formula. edge_count may be MT_STORAGE_CLOSED. */
mt_storage mt_storage_by_formula(const mt_mesh *mesh, mt_storage_kind kind, uint64_t edge_count);

static inline uint64_t mt_storage_units(const mt_storage *storage)
{
    return storage->coordinates + storage->indices;
}

static inline uint64_t mt_storage_bytes(const mt_mesh *mesh, const mt_storage *storage)
{
    return storage->coordinates * mt_type_size(mesh->position_type) + storage->indices * sizeof(mt_index);
}

/* Builds it, stores the bytes that the context holds for it (of strips and fans those of the buffer), and drops it.
 * Positions count; what a mesh carries beside
 * them and faces does not. A record of the structure's own (mt_halfedge_mesh ...) comes on top of the formula. The
 * builder's failure where the mesh is not manifold or oriented alike; MT_ERROR_OUT_OF_MEMORY, MT_ERROR_CANCELLED. */
mt_status mt_storage_measure(mt_context *context, const mt_mesh *mesh, mt_storage_kind kind, uint64_t *bytes);

/* A view of the mesh with positions and faces alone, borrowed from it; not to be destroyed. */
mt_mesh mt_storage_bare_mesh(const mt_mesh *mesh);

#ifdef __cplusplus
}
#endif
#endif
