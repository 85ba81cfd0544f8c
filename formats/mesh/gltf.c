/* glTF 2.0 (Khronos, ISO/IEC 12113): the two records, one for text and one for binary, and reading from end to end.
 *
 * One mesh comes of the scene: every node that shows a mesh is a part, its vertices moved into place, in the order of a
 * walk from the roots. Primitives of one node that name the same accessors share vertices; nothing else is joined. */
#include "formats/mesh/gltf.h"

#include "formats/mesh/gltf_write.h"
#include "formats/mesh/records.h"

#include <string.h>

static int sniff_glb(const uint8_t *bytes, size_t size, uint64_t total)
{
    (void)total;
    return size >= 4 && memcmp(bytes, "glTF", 4) == 0 ? 100 : 0;
}

static bool contains(const uint8_t *bytes, size_t size, const char *word)
{
    return memmem(bytes, size, word, strlen(word)) != NULL;
}

static int sniff_gltf(const uint8_t *bytes, size_t size, uint64_t total)
{
    size_t at = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    (void)total;
    while (at < size && strchr(" \t\r\n", bytes[at]) && bytes[at]) {
        at++;
    }
    if (at == size || bytes[at] != '{') {
        return 0;
    }
    return contains(bytes, size, "\"asset\"") ? 90 : 20;
}

/* Whether a material is more than its name. */
static bool has_look(const mt_gltf_file *file)
{
    for (size_t i = 0; i < file->counts[MT_GLTF_MATERIALS]; i++) {
        mt_json_node material = mt_json_element(&file->lists[MT_GLTF_MATERIALS], i);
        const char *key;
        json_t *value;
        json_object_foreach(material.value, key, value)
        {
            if (strcmp(key, "name") != 0 && strcmp(key, "extras") != 0) {
                return true;
            }
        }
    }
    return false;
}

static void warn_of_nodes(const mt_gltf_file *file)
{
    const char *name = mt_input_name(file->input);
    if (file->has_both) {
        mt_warn(file->context, "%s: a node has a matrix beside a translation, rotation or scale; the matrix is taken",
                name);
    }
    if (file->unplaced > 0) {
        mt_warn(file->context, "%s: primitives without a POSITION, left out: %llu", name,
                (unsigned long long)file->unplaced);
    }
    if (json_array_size(json_object_get(file->root.value, "animations")) > 0) {
        mt_warn(file->context, "%s: animations are not kept; the mesh stands as its nodes do", name);
    }
}

/* What the file holds and the mesh does not. */
static void warn_of_the_rest(const mt_gltf_file *file)
{
    const char *name = mt_input_name(file->input);
    warn_of_nodes(file);
    if (has_look(file)) {
        mt_warn(file->context, "%s: of materials only the names are kept, not their colours and textures", name);
    }
    for (size_t i = 0; i < file->dropped_count; i++) {
        mt_warn(file->context, "%s: the attribute \"%.64s\" is not kept", name, file->dropped[i]);
    }
    if (file->has_targets) {
        mt_warn(file->context, "%s: morph targets are not kept", name);
    }
    if (file->has_skins) {
        mt_warn(file->context, "%s: skins are not applied; the mesh stands as it was bound", name);
    }
}

static void note_extensions(mt_gltf_file *file)
{
    mt_json_node used = mt_json_member(&file->root, "extensionsUsed");
    for (size_t i = 0; i < json_array_size(used.value); i++) {
        const char *name = json_string_value(json_array_get(used.value, i));
        if (name && strcmp(name, "EXT_mesh_gpu_instancing") == 0) {
            mt_warn(file->context, "%s: the extension \"%s\" is not read; its repetitions are missing",
                    mt_input_name(file->input), name);
        }
    }
}

/* A file without nodes is a library of meshes: each is shown once, where it is. */
static mt_status list_meshes(mt_gltf_file *file, mt_gltf_instance **out, size_t *count)
{
    *count = file->counts[MT_GLTF_MESHES];
    *out = mt_gltf_allocate(file, *count, sizeof **out);
    for (size_t i = 0; i < *count && *out; i++) {
        (*out)[i] = (mt_gltf_instance){SIZE_MAX, i, mt_transform_identity()};
    }
    return *out ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

/* Reads each mesh that is shown, once. */
static mt_status read_shapes(mt_gltf_file *file, const mt_gltf_instance *instances, size_t count, mt_gltf_shape ***out)
{
    size_t mesh_count = file->counts[MT_GLTF_MESHES];
    mt_gltf_shape **shapes = mt_gltf_allocate(file, count, sizeof *shapes);
    mt_gltf_shape **known = mt_gltf_allocate(file, mesh_count, sizeof *known);
    mt_status status = shapes && known ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (size_t i = 0; i < mesh_count && status == MT_OK; i++) {
        known[i] = NULL;
    }
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        size_t mesh = instances[i].mesh;
        if (!known[mesh]) {
            known[mesh] = mt_gltf_allocate(file, 1, sizeof **known);
            status = known[mesh] ? mt_gltf_shape_read(file, mesh, known[mesh]) : MT_ERROR_OUT_OF_MEMORY;
        }
        shapes[i] = known[mesh];
        mt_json_node node = mt_json_element(&file->lists[MT_GLTF_NODES], instances[i].node);
        file->has_skins = file->has_skins || json_object_get(node.value, "skin");
    }
    *out = shapes;
    return status;
}

static mt_status read_file(mt_gltf_file *file, mt_mesh **out)
{
    mt_gltf_instance *instances = NULL;
    mt_gltf_shape **shapes = NULL;
    size_t count = 0;
    mt_status status = file->counts[MT_GLTF_NODES] == 0 ? list_meshes(file, &instances, &count)
                                                        : mt_gltf_walk(file, &instances, &count);
    if (status == MT_OK) {
        note_extensions(file);
        status = read_shapes(file, instances, count, &shapes);
    }
    if (status == MT_OK) {
        status = mt_gltf_build(file, instances, shapes, count, out);
    }
    if (status == MT_OK) {
        warn_of_the_rest(file);
    }
    return status;
}

mt_status mt_gltf_read(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    mt_gltf_file file;
    (void)options;
    *out = NULL;
    mt_status status = mt_gltf_open(context, input, &file);
    if (status == MT_OK) {
        status = read_file(&file, out);
    }
    mt_gltf_close(&file);
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}

static bool holds_labels(const mt_mesh *mesh, const mt_labels *labels)
{
    return labels->kind == MT_LABEL_MATERIAL || labels == mt_gltf_part_labels(mesh);
}

#define ABILITIES                                                                                                      \
    (MT_HOLDS_INDICES | MT_HOLDS_WIRES | MT_HOLDS_POINTS | MT_HOLDS_VERTEX_NORMALS | MT_HOLDS_VERTEX_UVS |             \
     MT_HOLDS_VERTEX_COLORS | MT_HOLDS_ALPHA | MT_HOLDS_PARTS | MT_SPLITS_VERTICES | MT_NEEDS_FINITE |                 \
     MT_TAKES_DRACO | MT_TAKES_QUANTIZATION)

const mt_mesh_format mt_glb_format = {
    .name = "glb",
    .title = "binary glTF",
    .extensions = (const char *const[]){"glb", NULL},
    .abilities = ABILITIES,
    .has_binary = true,
    .sniff = sniff_glb,
    .holds_attribute = mt_gltf_holds_attribute,
    .holds_labels = holds_labels,
    .changes = mt_gltf_changes,
    .read = mt_gltf_read,
    .write = mt_glb_write,
};

const mt_mesh_format mt_gltf_format = {
    .name = "gltf",
    .title = "glTF",
    .extensions = (const char *const[]){"gltf", NULL},
    .abilities = ABILITIES,
    .has_ascii = true,
    .sniff = sniff_gltf,
    .holds_attribute = mt_gltf_holds_attribute,
    .holds_labels = holds_labels,
    .changes = mt_gltf_changes,
    .read = mt_gltf_read,
    .write = mt_gltf_write,
};
