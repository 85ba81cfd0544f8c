/* What rays search: one of several structures over a mesh's triangles, chosen when it is made, asked in one way.
 *
 * All find candidates, conservatively, and ask mt_ray_hit_triangle: whichever is chosen, a ray gets the same triangle,
 * the same bits of t and the same weights. Only MT_RAY_FAST is excepted: its t is off, and where it is off by more than
 * what separates two hits, structures may differ in which of the two they call the nearer one. */
#ifndef MESHTOOL_RAY_STRUCTURE_H
#define MESHTOOL_RAY_STRUCTURE_H

#include <meshtool/surface_tree.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_ray_structure_kind {
    MT_RAY_STRUCTURE_AABB = 0, /* a wide tree of axis-aligned boxes: mt_surface_tree */
    MT_RAY_STRUCTURE_NONE,     /* every ray is asked of every triangle */
    MT_RAY_STRUCTURE_OBB,      /* a tree of boxes turned along the principal axes of what is in them */
    MT_RAY_STRUCTURE_GRID,     /* equal cells, through which a ray goes from one to the next */
    MT_RAY_STRUCTURE_BSP,      /* space halved by planes across the axes */
    MT_RAY_STRUCTURE_COUNT
} mt_ray_structure_kind;

typedef struct mt_ray_structure mt_ray_structure;

/* "aabb", "none", "obb", "grid" or "bsp"; NULL for what is no kind. */
const char *mt_ray_structure_name(mt_ray_structure_kind kind);

/* Builds the structure over the triangles of a mesh; `quality` is heard by the tree of axis-aligned boxes alone. Mesh
 * and triangulation are borrowed and outlive it. The same for any number of threads. Triangles with a corner that is
 * not finite are left out: nothing hits them. A structure of nothing answers that there is nothing. MT_ERROR_TOO_LARGE
 * past 2^28 triangles, MT_ERROR_OUT_OF_MEMORY, and MT_ERROR_ARGUMENT for what is no kind. */
mt_status mt_ray_structure_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                  mt_ray_structure_kind kind, mt_build_quality quality, mt_ray_structure **out);
/* NULL is allowed. */
void mt_ray_structure_destroy(mt_context *context, mt_ray_structure *structure);

/* Checks every invariant, such as that no triangle is lost. MT_ERROR_INTERNAL, MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_ray_structure_validate(mt_context *context, const mt_ray_structure *structure);

mt_ray_structure_kind mt_ray_structure_kind_of(const mt_ray_structure *structure);
/* The space in which rays meet its triangles; for mt_ray_offset. */
const mt_ray_space *mt_ray_structure_space(const mt_ray_structure *structure);
/* Bytes held. */
uint64_t mt_ray_structure_size(const mt_ray_structure *structure);

/* The nearest hit, equal t the lowest triangle; false, and mt_ray_no_hit, when there is none. Thread-safe. */
bool mt_ray_structure_nearest_hit(const mt_ray_structure *structure, const mt_ray *ray, mt_ray_profile profile,
                                  mt_ray_hit *hit);
/* Whether anything is hit within the ray's range. Thread-safe. */
bool mt_ray_structure_any_hit(const mt_ray_structure *structure, const mt_ray *ray, mt_ray_profile profile);

#ifdef __cplusplus
}
#endif
#endif
