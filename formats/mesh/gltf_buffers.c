/* Buffers and the views into them: the BIN chunk, data URIs, files beside, and views compressed by meshopt. */
#include "formats/mesh/gltf.h"

#include <string.h>

#ifdef MESHTOOL_MESHOPT
#include <meshoptimizer.h>
#endif

/* A view compressed by meshopt's vertex codec holds 16 bytes in 1 at best, twice over; one that says more is wrong. */
#define MESHOPT_RATIO 64

static mt_status load_data(mt_gltf_file *file, const mt_json_node *node, const char *text, uint64_t length,
                           mt_gltf_span *out)
{
    size_t size = strlen(text);
    uint8_t *bytes = mt_gltf_allocate(file, size / 4 * 3 + 3, 1);
    if (!bytes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    size_t got = mt_base64_decode(text, size, bytes);
    if (got == SIZE_MAX) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "the data is not right base64");
    }
    if (got < length) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "the data has %zu bytes, byteLength says %llu", got,
                            (unsigned long long)length);
    }
    *out = (mt_gltf_span){bytes, length};
    return MT_OK;
}

/* The file's own folder and the path in it. */
static char *join_path(mt_gltf_file *file, const char *relative)
{
    const char *name = mt_input_name(file->input), *slash = strrchr(name, '/');
    size_t folder = slash ? (size_t)(slash - name) + 1 : 0, length = strlen(relative);
    char *path = mt_gltf_allocate(file, folder + length + 1, 1);
    if (path) {
        memcpy(path, name, folder);
        memcpy(path + folder, relative, length + 1);
    }
    return path;
}

static mt_status read_beside(mt_gltf_file *file, const mt_json_node *node, mt_input *input, uint64_t length,
                             mt_gltf_span *out)
{
    mt_status status = mt_input_collect(file->context, input);
    if (status != MT_OK) {
        return status;
    }
    if (mt_input_size(input) < length) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "the file %s has %llu bytes, byteLength says %llu",
                            mt_input_name(input), (unsigned long long)mt_input_size(input), (unsigned long long)length);
    }
    uint8_t *bytes = mt_gltf_allocate(file, length, 1);
    if (!bytes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    file->bytes_read += length;
    *out = (mt_gltf_span){bytes, length};
    return mt_input_read_exactly(file->context, input, bytes, (size_t)length, "the rest of the buffer");
}

/* Where a file beside is named, before what was wrong with it. */
static mt_status say_who_asked(mt_gltf_file *file, const mt_json_node *node, mt_status status)
{
    mt_error error = *mt_context_error(file->context);
    mt_context_clear_error(file->context);
    return mt_json_fail(file->context, node, status, "%s", error.message);
}

static mt_status load_beside(mt_gltf_file *file, const mt_json_node *node, const char *uri, uint64_t length,
                             mt_gltf_span *out)
{
    char *relative = mt_gltf_allocate(file, strlen(uri) + 1, 1);
    if (!relative) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    const char *wrong = mt_gltf_uri_path(uri, relative);
    if (wrong) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX,
                            "the URI \"%.64s\" %s; only files in the same folder or below it are read", uri, wrong);
    }
    if (!mt_input_has_folder(file->input)) {
        return mt_json_fail(file->context, node, MT_ERROR_UNSUPPORTED,
                            "the file \"%.64s\" cannot be found, as this one does not come from a folder", uri);
    }
    char *path = join_path(file, relative);
    mt_input *input;
    mt_status status = path ? mt_input_open(file->context, path, &input) : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        status = read_beside(file, node, input, length, out);
        mt_input_close(file->context, input);
        return status;
    }
    return status == MT_ERROR_OUT_OF_MEMORY ? status : say_who_asked(file, node, status);
}

static mt_status load_uri(mt_gltf_file *file, const mt_json_node *node, const char *uri, uint64_t length,
                          mt_gltf_span *out)
{
    mt_json_node place = mt_json_member(node, "uri");
    if (strncmp(uri, "data:", 5) != 0) {
        return load_beside(file, &place, uri, length, out);
    }
    const char *comma = strchr(uri, ',');
    if (!comma || comma - uri < 7 || memcmp(comma - 7, ";base64", 7) != 0) {
        return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX, "expected a data URI in base64");
    }
    return load_data(file, &place, comma + 1, length, out);
}

static mt_status load_binary(mt_gltf_file *file, const mt_json_node *node, uint64_t length, mt_gltf_span *out)
{
    if (node->index != 0 || !file->binary.bytes) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "has no uri, and the file has no BIN chunk for it");
    }
    if (file->binary.size < length) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "the BIN chunk has %llu bytes, byteLength says %llu",
                            (unsigned long long)file->binary.size, (unsigned long long)length);
    }
    *out = (mt_gltf_span){file->binary.bytes, length};
    return MT_OK;
}

mt_status mt_gltf_buffer(mt_gltf_file *file, size_t index, mt_gltf_span *out)
{
    if (file->buffers[index].bytes) {
        *out = file->buffers[index];
        return MT_OK;
    }
    mt_json_node node = mt_json_element(&file->lists[MT_GLTF_BUFFERS], index);
    uint64_t length = 0;
    const char *uri = NULL;
    mt_status status = mt_json_whole(file->context, &node, "byteLength", MT_JSON_REQUIRED, 1, UINT64_MAX, &length);
    if (status == MT_OK) {
        status = mt_json_string(file->context, &node, "uri", MT_JSON_OPTIONAL, &uri);
    }
    if (status == MT_OK) {
        status = uri ? load_uri(file, &node, uri, length, out) : load_binary(file, &node, length, out);
    }
    if (status == MT_OK) {
        file->buffers[index] = *out;
    }
    return status;
}

/* The part of a buffer that a view, or the extension of one, names. */
static mt_status take_part(mt_gltf_file *file, const mt_json_node *node, mt_gltf_span *out)
{
    mt_json_node buffer;
    size_t index = 0;
    uint64_t offset = 0, length = 0;
    mt_gltf_span whole = {0};
    mt_status status = mt_gltf_refer(file, node, "buffer", MT_JSON_REQUIRED, MT_GLTF_BUFFERS, &buffer, &index);
    if (status == MT_OK) {
        status = mt_json_whole(file->context, node, "byteOffset", MT_JSON_OPTIONAL, 0, UINT64_MAX, &offset);
    }
    if (status == MT_OK) {
        status = mt_json_whole(file->context, node, "byteLength", MT_JSON_REQUIRED, 1, UINT64_MAX, &length);
    }
    if (status == MT_OK) {
        status = mt_gltf_buffer(file, index, &whole);
    }
    if (status == MT_OK && (offset > whole.size || length > whole.size - offset)) {
        status =
            mt_json_fail(file->context, node, MT_ERROR_SYNTAX,
                         "%llu bytes from %llu on are not within the %llu bytes of buffers[%zu]",
                         (unsigned long long)length, (unsigned long long)offset, (unsigned long long)whole.size, index);
    }
    *out = status == MT_OK ? (mt_gltf_span){whole.bytes + offset, length} : (mt_gltf_span){0};
    return status;
}

#ifdef MESHTOOL_MESHOPT
typedef struct packed_view {
    mt_gltf_span from;
    uint64_t count, stride;
    const char *mode, *filter;
} packed_view;

static int unpack(const packed_view *view, uint8_t *to)
{
    size_t count = (size_t)view->count, stride = (size_t)view->stride, size = (size_t)view->from.size;
    if (strcmp(view->mode, "ATTRIBUTES") == 0) {
        return meshopt_decodeVertexBuffer(to, count, stride, view->from.bytes, size);
    }
    return strcmp(view->mode, "TRIANGLES") == 0
               ? meshopt_decodeIndexBuffer(to, count, stride, view->from.bytes, size)
               : meshopt_decodeIndexSequence(to, count, stride, view->from.bytes, size);
}

/* What the extension asks of its members, by mode and filter. */
static const char *wrong_with(const packed_view *view)
{
    bool attributes = strcmp(view->mode, "ATTRIBUTES") == 0, triangles = strcmp(view->mode, "TRIANGLES") == 0;
    if (!attributes && !triangles && strcmp(view->mode, "INDICES") != 0) {
        return "mode must be ATTRIBUTES, TRIANGLES or INDICES";
    }
    if (attributes ? view->stride % 4 != 0 || view->stride > 256 : view->stride != 2 && view->stride != 4) {
        return "byteStride does not fit the mode";
    }
    if (triangles && view->count % 3 != 0) {
        return "count must be a multiple of 3 for TRIANGLES";
    }
    bool none = strcmp(view->filter, "NONE") == 0, octahedral = strcmp(view->filter, "OCTAHEDRAL") == 0;
    bool quaternion = strcmp(view->filter, "QUATERNION") == 0;
    if (!none && !octahedral && !quaternion && strcmp(view->filter, "EXPONENTIAL") != 0) {
        return "filter must be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL";
    }
    if ((octahedral && view->stride != 4 && view->stride != 8) || (quaternion && view->stride != 8) ||
        (!none && !attributes)) {
        return "byteStride or mode does not fit the filter";
    }
    return view->count / MESHOPT_RATIO > view->from.size ||
                   view->count * view->stride > MESHOPT_RATIO * (view->from.size + 256)
               ? "count is more than the compressed bytes can hold"
               : NULL;
}

static void apply_filter(const packed_view *view, uint8_t *bytes)
{
    size_t count = (size_t)view->count, stride = (size_t)view->stride;
    if (view->filter[0] == 'O') {
        meshopt_decodeFilterOct(bytes, count, stride);
    } else if (view->filter[0] == 'Q') {
        meshopt_decodeFilterQuat(bytes, count, stride);
    } else if (view->filter[0] == 'E') {
        meshopt_decodeFilterExp(bytes, count, stride);
    }
}

static mt_status unpack_view(mt_gltf_file *file, const mt_json_node *node, mt_gltf_span *out)
{
    packed_view view = {.filter = "NONE", .mode = ""};
    mt_status status = take_part(file, node, &view.from);
    if (status == MT_OK) {
        status = mt_json_whole(file->context, node, "count", MT_JSON_REQUIRED, 1, MT_INDEX_MAX, &view.count);
    }
    if (status == MT_OK) {
        status = mt_json_whole(file->context, node, "byteStride", MT_JSON_REQUIRED, 1, 256, &view.stride);
    }
    if (status == MT_OK) {
        status = mt_json_string(file->context, node, "mode", MT_JSON_REQUIRED, &view.mode);
    }
    if (status == MT_OK) {
        status = mt_json_string(file->context, node, "filter", MT_JSON_OPTIONAL, &view.filter);
    }
    const char *wrong = status == MT_OK ? wrong_with(&view) : NULL;
    if (wrong) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "%s", wrong);
    }
    uint8_t *bytes = status == MT_OK ? mt_gltf_allocate(file, view.count, (size_t)view.stride) : NULL;
    if (!bytes) {
        return status == MT_OK ? MT_ERROR_OUT_OF_MEMORY : status;
    }
    if (unpack(&view, bytes) != 0) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX, "the compressed bytes are wrong or too few");
    }
    apply_filter(&view, bytes);
    *out = (mt_gltf_span){bytes, view.count * view.stride};
    return MT_OK;
}
#else
static mt_status unpack_view(mt_gltf_file *file, const mt_json_node *node, mt_gltf_span *out)
{
    *out = (mt_gltf_span){0};
    return mt_json_fail(file->context, node, MT_ERROR_UNSUPPORTED,
                        "this view is compressed by meshopt, and meshtool was built without it (MESHTOOL_MESHOPT=OFF)");
}
#endif

mt_status mt_gltf_view(mt_gltf_file *file, size_t index, mt_gltf_span *out, uint64_t *stride)
{
    mt_json_node node = mt_json_element(&file->lists[MT_GLTF_VIEWS], index), extensions, packed;
    *stride = 0;
    *out = (mt_gltf_span){0};
    mt_status status = mt_json_whole(file->context, &node, "byteStride", MT_JSON_OPTIONAL, 4, 252, stride);
    if (status != MT_OK) {
        return status;
    }
    if (*stride % 4 != 0) {
        return mt_json_fail(file->context, &node, MT_ERROR_SYNTAX, "byteStride is %llu, expected a multiple of 4",
                            (unsigned long long)*stride);
    }
    if (!mt_gltf_extension(&node, "EXT_meshopt_compression", &extensions, &packed)) {
        return take_part(file, &node, out);
    }
    if (!file->views[index].bytes) {
        status = unpack_view(file, &packed, &file->views[index]);
    }
    *out = file->views[index];
    return status;
}
