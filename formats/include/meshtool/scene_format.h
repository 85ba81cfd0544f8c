/* Scene files: JSON, strictly read. */
#ifndef MESHTOOL_SCENE_FORMAT_H
#define MESHTOOL_SCENE_FORMAT_H

#include <meshtool/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A scene with everything that it names: meshes are read, and the scene borrows from the file. */
typedef struct mt_scene_file mt_scene_file;

/* Reads a scene; "-" is standard input, and its meshes are then looked for in the current folder. Meshes are named by
 * paths relative to the scene's folder, never by "-". MT_ERROR_SYNTAX with line, column and the path of what is wrong:
 * JSON that is not, keys that are unknown or given twice, values of another kind or out of range, names that nothing
 * has. Errors of mesh files are theirs. Ownership: the caller's, until mt_scene_file_destroy. */
mt_status mt_scene_read_file(mt_context *context, const char *path, mt_scene_file **out);

/* The same from memory: `name` stands in messages, and its folder is where meshes are looked for. */
mt_status mt_scene_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                               mt_scene_file **out);
void mt_scene_file_destroy(mt_context *context, mt_scene_file *file); /* NULL is allowed */

/* The scene; the caller may change its size and samples. Valid until the file is destroyed. */
mt_scene *mt_scene_file_scene(mt_scene_file *file);

/* One key of a scene file, for the help: the table that reading follows. */
typedef struct mt_scene_key {
    const char *section; /* what object it stands in: "camera", "a light", "a sphere" ...; "" for the root */
    const char *key;
    char expects[200]; /* what its value is: "three numbers" */
    const char *means; /* in a few words, the default in them */
    bool is_required;
} mt_scene_key;

/* Key number `index`, section by section; false past the last. */
bool mt_scene_key_at(size_t index, mt_scene_key *out);

#ifdef __cplusplus
}
#endif
#endif
