/* A scene while it is read, and what it owns. */
#ifndef MESHTOOL_SCENE_FILE_H
#define MESHTOOL_SCENE_FILE_H

#include "formats/scene/scene_schema.h"

#include <meshtool/scene_format.h>

struct mt_scene_file {
    mt_scene scene;
    mt_scene_light *lights;
    mt_material *materials; /* the last is the one of objects that name none */
    mt_scene_mesh *meshes;
    mt_mesh **owned; /* one a mesh */
    mt_index owned_count;
    mt_scene_object *objects;
};

/* The members of an object by name, sorted, so that many objects may name many of them. */
typedef struct scene_name {
    const char *name;
    mt_index number; /* in the order of the file */
} scene_name;

typedef struct scene_names {
    scene_name *names;
    size_t count;
} scene_names;

mt_status scene_names_init(mt_context *context, const mt_json_node *object, scene_names *out);
void scene_names_release(mt_context *context, scene_names *names);

/* What the parts of reading share. */
typedef struct scene_reading {
    mt_context *context;
    const char *name; /* of the file; its folder is where meshes lie */
    mt_scene_file *file;
    mt_json_node materials, meshes; /* value NULL: none */
    scene_names material_names, mesh_names;
} scene_reading;

mt_status scene_read_meshes(const scene_reading *reading);
mt_status scene_read_objects(const scene_reading *reading, const mt_json_node *objects);

/* The number of what the member `key` of an object names. */
mt_status scene_find_name(const scene_reading *reading, const mt_json_node *object, const scene_names *among,
                          const char *key, const char *name, mt_index *out);

#endif
