/* A mesh of a scene, made ready for rays when one comes near. */
#ifndef MESHTOOL_RENDER_SCENE_PART_H
#define MESHTOOL_RENDER_SCENE_PART_H

#include "lib/render/corner_normals.h"
#include "lib/render/surface.h"

#include <meshtool/scene.h>

typedef struct mt_scene_part {
    mt_scene_mesh source;
    mt_bounds bounds; /* of its finite vertices, and as far around as a hit may be off */
    bool has_kind;    /* of structure, asked for */
    mt_ray_structure_kind kind;
    mt_ray_profile profile;
    unsigned char is_wanted; /* atomic: a ray entered its box and found it not built */
    bool is_built;
    mt_model model;
    mt_corner_normals normals;
    mt_surface surface;
    bool has_colors;
    mt_ray_space space;
    mt_ray_structure *structure;
} mt_scene_part;

/* Finds the bounds alone. */
void mt_scene_part_init(const mt_scene_mesh *source, const mt_scene_options *options, mt_scene_part *part);
/* What shading needs: triangles, normals, colours. */
mt_status mt_scene_part_build(mt_context *context, mt_scene_part *part);
/* What rays search among so many triangles: the kind asked for, or what suits their number. */
mt_ray_structure_kind mt_scene_structure_kind(bool has_kind, mt_ray_structure_kind kind, mt_index triangle_count);
/* What rays search beside. */
mt_status mt_scene_part_build_tree(mt_context *context, mt_scene_part *part);
void mt_scene_part_release(mt_context *context, mt_scene_part *part);

/* The ray in the mesh's coordinates. Only of a part that is built for rays. */
mt_ray_hit mt_scene_part_nearest(const mt_scene_part *part, const mt_ray *ray);
bool mt_scene_part_any(const mt_scene_part *part, const mt_ray *ray);

/* A point of a triangle of a part, and the direction of the ray that met it, in the mesh's coordinates. */
typedef struct mt_part_point {
    mt_vec3 position;
    mt_vec3 lifted;      /* on the surface that the normals make believe, on the side that the ray came from */
    mt_vec3 face_normal; /* of the front, of any length */
    mt_vec3 normal;      /* shading; on the front's side */
    mt_vec3 color;
    bool has_color;
} mt_part_point;
mt_part_point mt_scene_part_point(const mt_scene_part *part, mt_index triangle, const double weights[3],
                                  mt_vec3 direction);

#endif
