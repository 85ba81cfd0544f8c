/* The meshes that a scene names. */
#include "formats/scene/scene_file.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <string.h>

/* The path of a file beside the scene's. */
static char *path_beside(const scene_reading *reading, const char *file)
{
    const char *slash = strrchr(reading->name, '/');
    size_t folder = slash ? (size_t)(slash - reading->name) + 1 : 0, length = strlen(file);
    char *path = (char *)mt_allocate(reading->context, folder + length + 1);
    if (path) {
        memcpy(path, reading->name, folder);
        memcpy(path + folder, file, length + 1);
    }
    return path;
}

static mt_status read_file(const scene_reading *reading, const mt_json_node *node, const char *file, mt_mesh **out)
{
    mt_json_node member = mt_json_member(node, "file");
    if (file[0] == '/') {
        return mt_json_fail(reading->context, &member, MT_ERROR_SYNTAX,
                            "\"%.80s\" is an absolute path; expected one relative to the scene's folder", file);
    }
    if (strcmp(file, "-") == 0) {
        return mt_json_fail(reading->context, &member, MT_ERROR_SYNTAX,
                            "\"-\" would be standard input; expected the path of a file (\"./-\" is one of that name)");
    }
    char *path = path_beside(reading, file);
    mt_status status =
        path ? mt_mesh_read_file(reading->context, path, NULL, out, NULL) : mt_context_error(reading->context)->status;
    mt_free(reading->context, path);
    return status;
}

/* The range is known here, where the place in the file is. */
static mt_status generate(const scene_reading *reading, const mt_json_node *node, const scene_mesh *record,
                          mt_mesh **out)
{
    size_t count = 0;
    const mt_primitive *kinds = mt_primitives(&count);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(kinds[i].name, record->generate) != 0) {
            continue;
        }
        mt_json_node member = mt_json_member(node, "resolution");
        if (member.value && kinds[i].resolution == 0) {
            return mt_json_fail(reading->context, &member, MT_ERROR_SYNTAX, "\"%s\" has no resolution", kinds[i].name);
        }
        if (member.value && (record->resolution < kinds[i].minimum || record->resolution > kinds[i].maximum)) {
            return mt_json_fail(reading->context, &member, MT_ERROR_SYNTAX,
                                "expected a whole number from %u to %u for \"%s\", got %u", kinds[i].minimum,
                                kinds[i].maximum, kinds[i].name, record->resolution);
        }
        const mt_generate_options options = {.resolution = record->resolution};
        return mt_generate(reading->context, record->generate, &options, out);
    }
    mt_json_node member = mt_json_member(node, "generate");
    return mt_json_fail_expected(reading->context, &member, "a kind that the command generate knows");
}

static mt_status read_mesh(const scene_reading *reading, const mt_json_node *node)
{
    mt_scene_file *file = reading->file;
    scene_mesh record = {.colors = true};
    mt_mesh *mesh = NULL;
    mt_status status = scene_read_fields(reading->context, node, scene_mesh_fields, &record);
    if (status == MT_OK && !record.file == !record.generate) {
        status = mt_json_fail(reading->context, node, MT_ERROR_SYNTAX,
                              "expected either the key \"file\" or the key \"generate\"");
    }
    if (status == MT_OK) {
        status = record.file ? read_file(reading, node, record.file, &mesh) : generate(reading, node, &record, &mesh);
    }
    if (status == MT_OK) {
        file->owned[file->owned_count++] = mesh;
        file->meshes[file->scene.mesh_count++] = (mt_scene_mesh){.mesh = mesh,
                                                                 .shading = (mt_shading)record.shading,
                                                                 .crease_degrees = record.crease,
                                                                 .uses_material_color = !record.colors};
    }
    return status;
}

mt_status scene_read_meshes(const scene_reading *reading)
{
    const mt_json_node *meshes = &reading->meshes;
    mt_scene_file *file = reading->file;
    if (meshes->value && !json_is_object(meshes->value)) {
        return mt_json_fail_expected(reading->context, meshes, "an object of meshes by name");
    }
    size_t count = json_object_size(meshes->value);
    file->meshes = (mt_scene_mesh *)mt_allocate_array(reading->context, count, sizeof *file->meshes);
    file->owned = (mt_mesh **)mt_allocate_array(reading->context, count, sizeof *file->owned);
    mt_status status = file->meshes && file->owned ? MT_OK : mt_context_error(reading->context)->status;
    void *at = json_object_iter(meshes->value);
    for (; status == MT_OK && at; at = json_object_iter_next(meshes->value, at)) {
        mt_json_node mesh = mt_json_member(meshes, json_object_iter_key(at));
        status = read_mesh(reading, &mesh);
    }
    return status;
}
