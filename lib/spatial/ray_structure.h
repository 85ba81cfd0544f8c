/* One record a structure: ray_structure.c holds the table and everything that all share. */
#ifndef MT_SPATIAL_RAY_STRUCTURE_H
#define MT_SPATIAL_RAY_STRUCTURE_H

#include <meshtool/ray_structure.h>

/* What a structure is made of: the triangles of a mesh, in the space of its rays. */
typedef struct mt_ray_source {
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    mt_ray_space space;
    mt_build_quality quality;
} mt_ray_source;

/* `body` is the structure's own; destroy takes it half made too, never NULL. any: the first hit will do. */
typedef struct mt_ray_structure_record {
    const char *name;
    mt_status (*create)(mt_context *context, const mt_ray_source *source, void **body);
    void (*destroy)(mt_context *context, void *body);
    mt_status (*validate)(mt_context *context, const void *body);
    uint64_t (*size)(const void *body);
    bool (*find_hit)(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit);
} mt_ray_structure_record;

extern const mt_ray_structure_record mt_ray_structure_none, mt_ray_structure_obb, mt_ray_structure_grid,
    mt_ray_structure_bsp;

#endif
