/* Opening: the two containers, the JSON in them, and whether its version and extensions are ones that are read. */
#include "formats/mesh/gltf.h"

#include <stdlib.h>
#include <string.h>

#define HEADER_SIZE 12
#define CHUNK_HEADER_SIZE 8
#define CHUNK_JSON 0x4E4F534Au
#define CHUNK_BIN 0x004E4942u

static uint32_t load_u32(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

void *mt_gltf_allocate(mt_gltf_file *file, uint64_t count, size_t size)
{
    if (file->block_count == file->block_capacity) {
        size_t capacity = 2 * file->block_capacity + 16;
        void **blocks = mt_reallocate(file->context, file->blocks, capacity * sizeof *blocks);
        if (!blocks) {
            return NULL;
        }
        file->blocks = blocks;
        file->block_capacity = capacity;
    }
    void *block = mt_allocate_array(file->context, count, size);
    if (block) {
        file->blocks[file->block_count++] = block;
    }
    return block;
}

void mt_gltf_close(mt_gltf_file *file)
{
    for (size_t i = 0; i < file->block_count; i++) {
        mt_free(file->context, file->blocks[i]);
    }
    mt_free(file->context, file->blocks);
    mt_json_release(file->context, &file->json);
    mt_free(file->context, file->content);
}

static mt_status read_content(mt_gltf_file *file)
{
    mt_status status = mt_input_collect(file->context, file->input);
    if (status != MT_OK) {
        return status;
    }
    file->bytes_read = mt_input_size(file->input);
    file->content = mt_allocate(file->context, file->bytes_read);
    return file->content ? mt_input_read_exactly(file->context, file->input, file->content, (size_t)file->bytes_read,
                                                 "the rest of the file")
                         : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status fail_container(mt_gltf_file *file, uint64_t offset, const char *sentence)
{
    return mt_fail_at(file->context, MT_ERROR_SYNTAX, mt_input_place_offset(file->input, offset), "%s", sentence);
}

/* Finds the chunk at `offset`; *next receives where the one after it would begin. */
static mt_status take_chunk(mt_gltf_file *file, uint64_t offset, uint32_t *type, mt_gltf_span *out, uint64_t *next)
{
    if (file->bytes_read - offset < CHUNK_HEADER_SIZE) {
        return fail_container(file, offset, "the file ends here, expected the length and type of a chunk");
    }
    uint32_t length = load_u32(file->content + offset);
    *type = load_u32(file->content + offset + 4);
    if (length > file->bytes_read - offset - CHUNK_HEADER_SIZE) {
        return mt_fail_at(file->context, MT_ERROR_SYNTAX, mt_input_place_offset(file->input, offset),
                          "this chunk says that it has %u bytes, but %llu are left", length,
                          (unsigned long long)(file->bytes_read - offset - CHUNK_HEADER_SIZE));
    }
    *out = (mt_gltf_span){file->content + offset + CHUNK_HEADER_SIZE, length};
    *next = offset + CHUNK_HEADER_SIZE + length;
    return MT_OK;
}

static mt_status check_header(mt_gltf_file *file)
{
    if (file->bytes_read < HEADER_SIZE) {
        return fail_container(file, file->bytes_read, "the file ends here, inside the 12 bytes of a GLB header");
    }
    uint32_t version = load_u32(file->content + 4), length = load_u32(file->content + 8);
    if (version != 2) {
        return mt_fail_at(file->context, MT_ERROR_UNSUPPORTED, mt_input_place_offset(file->input, 4),
                          "this is version %u of GLB, expected 2", version);
    }
    if (length > file->bytes_read) {
        return mt_fail_at(file->context, MT_ERROR_SYNTAX, mt_input_place_offset(file->input, 8),
                          "the header says that the file has %u bytes, but it has %llu", length,
                          (unsigned long long)file->bytes_read);
    }
    if (length < HEADER_SIZE + CHUNK_HEADER_SIZE) {
        return fail_container(file, 8, "the header says that the file ends before its first chunk");
    }
    if (length < file->bytes_read) {
        mt_warn(file->context, "%s: %llu bytes after the end of the GLB file are left alone",
                mt_input_name(file->input), (unsigned long long)(file->bytes_read - length));
        file->bytes_read = length;
    }
    return MT_OK;
}

/* The chunks of a GLB (section 4.4): JSON first, BIN second, others are left alone. */
static mt_status take_chunks(mt_gltf_file *file, mt_gltf_span *json)
{
    uint32_t type;
    uint64_t next = HEADER_SIZE;
    mt_status status = check_header(file);
    if (status == MT_OK) {
        status = take_chunk(file, HEADER_SIZE, &type, json, &next);
    }
    if (status == MT_OK && type != CHUNK_JSON) {
        status = fail_container(file, HEADER_SIZE + 4, "the first chunk of a GLB file must be JSON");
    }
    for (size_t number = 1; status == MT_OK && next < file->bytes_read; number++) {
        mt_gltf_span chunk;
        uint64_t begin = next;
        status = take_chunk(file, begin, &type, &chunk, &next);
        if (status == MT_OK && type == CHUNK_BIN && number == 1) {
            file->binary = chunk;
        } else if (status == MT_OK && type == CHUNK_JSON) {
            status = fail_container(file, begin + 4, "this is a second JSON chunk, expected one");
        }
    }
    return status;
}

/* Extensions that say nothing about shape: those of materials, textures, lights and notes. */
static bool concerns_looks_alone(const char *name)
{
    static const char *const names[] = {"KHR_texture_transform",  "KHR_texture_basisu", "EXT_texture_webp",
                                        "EXT_texture_avif",       "MSFT_texture_dds",   "KHR_lights_punctual",
                                        "EXT_lights_image_based", "KHR_xmp_json_ld",    "KHR_xmp"};
    bool known = strncmp(name, "KHR_materials_", 14) == 0;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        known = known || strcmp(name, names[i]) == 0;
    }
    return known;
}

static mt_status check_extension(mt_gltf_file *file, const mt_json_node *node)
{
    static const char *const read[] = {"KHR_mesh_quantization", "KHR_draco_mesh_compression",
                                       "EXT_meshopt_compression"};
    const char *name = NULL;
    mt_status status = mt_json_node_string(file->context, node, &name);
    bool known = status != MT_OK || concerns_looks_alone(name);
    for (size_t i = 0; i < sizeof read / sizeof read[0]; i++) {
        known = known || strcmp(name, read[i]) == 0;
    }
    return known ? status
                 : mt_json_fail(file->context, node, MT_ERROR_UNSUPPORTED,
                                "the file requires the extension \"%.64s\", which is not read", name);
}

static mt_status check_extensions(mt_gltf_file *file)
{
    mt_json_node list;
    size_t count;
    mt_status status = mt_json_array(file->context, &file->root, "extensionsRequired", MT_JSON_OPTIONAL, &list, &count);
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        mt_json_node element = mt_json_element(&list, i);
        status = check_extension(file, &element);
    }
    return status;
}

static mt_status check_version(mt_gltf_file *file)
{
    mt_json_node asset;
    const char *version = NULL, *minimum = NULL;
    mt_status status = mt_json_object(file->context, &file->root, "asset", MT_JSON_REQUIRED, &asset);
    if (status == MT_OK) {
        status = mt_json_string(file->context, &asset, "version", MT_JSON_REQUIRED, &version);
    }
    if (status == MT_OK) {
        status = mt_json_string(file->context, &asset, "minVersion", MT_JSON_OPTIONAL, &minimum);
    }
    const char *needed = minimum ? minimum : version;
    if (status == MT_OK && (strncmp(version, "2.", 2) != 0 || (minimum && strcmp(minimum, "2.0") != 0))) {
        return mt_json_fail(file->context, &asset, MT_ERROR_UNSUPPORTED,
                            "the file needs version \"%.20s\" of glTF, and 2.0 is read", needed);
    }
    return status;
}

static mt_status find_lists(mt_gltf_file *file)
{
    static const char *const names[] = {"buffers",   "bufferViews", "accessors", "meshes",
                                        "materials", "nodes",       "scenes"};
    mt_status status = MT_OK;
    for (size_t i = 0; i < MT_GLTF_LIST_COUNT && status == MT_OK; i++) {
        status =
            mt_json_array(file->context, &file->root, names[i], MT_JSON_OPTIONAL, &file->lists[i], &file->counts[i]);
    }
    return status;
}

static mt_status make_tables(mt_gltf_file *file)
{
    size_t buffers = file->counts[MT_GLTF_BUFFERS], views = file->counts[MT_GLTF_VIEWS];
    file->buffers = mt_gltf_allocate(file, buffers, sizeof *file->buffers);
    file->views = mt_gltf_allocate(file, views, sizeof *file->views);
    if (!file->buffers || !file->views) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(file->buffers, 0, buffers * sizeof *file->buffers);
    memset(file->views, 0, views * sizeof *file->views);
    return MT_OK;
}

mt_status mt_gltf_open(mt_context *context, mt_input *input, mt_gltf_file *out)
{
    *out = (mt_gltf_file){.context = context, .input = input};
    mt_status status = read_content(out);
    mt_gltf_span json = {out->content, out->bytes_read};
    if (status == MT_OK && out->bytes_read >= 4 && memcmp(out->content, "glTF", 4) == 0) {
        status = take_chunks(out, &json);
    }
    if (status == MT_OK) {
        status = mt_json_parse(context, mt_input_name(input), json.bytes, (size_t)json.size, &out->json);
    }
    if (status == MT_OK) {
        out->root = mt_json_root(mt_input_name(input), &out->json);
        status = check_version(out);
    }
    if (status == MT_OK) {
        status = check_extensions(out);
    }
    if (status == MT_OK) {
        status = find_lists(out);
    }
    return status == MT_OK ? make_tables(out) : status;
}

mt_status mt_gltf_refer(mt_gltf_file *file, const mt_json_node *parent, const char *key, mt_json_need need,
                        mt_gltf_list list, mt_json_node *out, size_t *index)
{
    uint64_t number = UINT64_MAX;
    mt_status status = mt_json_whole(file->context, parent, key, need, 0, UINT64_MAX, &number);
    *out = (mt_json_node){.parent = &file->lists[list]};
    if (status != MT_OK || number == UINT64_MAX) {
        return status;
    }
    if (number >= file->counts[list]) {
        mt_json_node node = mt_json_member(parent, key);
        return mt_json_fail(file->context, &node, MT_ERROR_SYNTAX, "there is no %s[%llu], the last is number %lld",
                            file->lists[list].key, (unsigned long long)number, (long long)file->counts[list] - 1);
    }
    *out = mt_json_element(&file->lists[list], (size_t)number);
    if (index) {
        *index = (size_t)number;
    }
    return MT_OK;
}

bool mt_gltf_extension(const mt_json_node *node, const char *name, mt_json_node *extensions, mt_json_node *out)
{
    *extensions = mt_json_member(node, "extensions");
    *out = mt_json_member(extensions, name);
    return json_is_object(out->value);
}
