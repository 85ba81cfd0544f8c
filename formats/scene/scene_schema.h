/* The records that the objects of a scene file are read into, and their tables. */
#ifndef MESHTOOL_SCENE_SCHEMA_H
#define MESHTOOL_SCENE_SCHEMA_H

#include "formats/scene/scene_fields.h"

#include <meshtool/scene.h>

typedef struct scene_root {
    mt_json_node image, camera, background, lights, materials, meshes, objects;
    mt_vec3 ambient;
} scene_root;

typedef struct scene_image {
    uint32_t width, height, depth;
    mt_json_node samples;
    double cutoff;
} scene_image;

typedef struct scene_camera {
    int projection; /* in the order of mt_projection */
    mt_vec3 eye, target, up;
    double fov, width;
} scene_camera;

typedef struct scene_background {
    mt_vec3 color, top;
    bool transparent;
} scene_background;

typedef struct scene_light {
    int kind; /* in the order of mt_scene_light_kind */
    mt_vec3 direction, position, color;
    double intensity, fade;
    bool shadows;
} scene_light;

typedef struct scene_mesh {
    const char *file, *generate;
    uint32_t resolution;
    int shading; /* in the order of mt_shading */
    double crease;
    bool colors;
} scene_mesh;

typedef struct scene_object {
    int kind;
    const char *material, *mesh;
    mt_vec3 point, normal, center;
    double radius;
    mt_json_node corners, transform, transforms;
} scene_object;

typedef struct scene_transform {
    mt_json_node scale;
    mt_json_node rotation;
    mt_vec3 translate;
} scene_transform;

/* Kinds of objects, as "kind" names them. */
enum { SCENE_PLANE, SCENE_SPHERE, SCENE_TRIANGLE, SCENE_MESH, SCENE_INSTANCES, SCENE_OBJECT_KINDS };

extern const scene_field scene_root_fields[], scene_image_fields[], scene_camera_fields[], scene_background_fields[],
    scene_directional_fields[], scene_point_fields[], scene_material_fields[], scene_mesh_fields[],
    scene_transform_fields[];
extern const scene_field *const scene_object_fields[SCENE_OBJECT_KINDS];
extern const char *const scene_object_kinds[], *const scene_light_kinds[];

#endif
