/* Reading binary OFF: 32-bit whole numbers and floats, big endian as the format says. Little endian is believed when
 * only that makes sense of the counts. Every size is checked against the bytes that are there before it is allocated.
 */
#include "formats/mesh/off_parts.h"

#include "formats/stream/input.h"

#include <meshtool/checked.h>

typedef struct binary_reader {
    mt_context *context;
    mt_input *input;
    const mt_off_header *header;
    bool little;
    uint64_t vertex_count, face_count;
    mt_mesh *mesh;
    mt_off_colors vertex_colors, face_colors;
    uint64_t corner_room;
} binary_reader;

static uint32_t decode(const binary_reader *reader, const uint8_t *bytes)
{
    uint32_t big = (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
    return reader->little ? __builtin_bswap32(big) : big;
}

static float decode_float(const binary_reader *reader, const uint8_t *bytes)
{
    uint32_t bits = decode(reader, bytes);
    float number;
    memcpy(&number, &bits, sizeof number);
    return number;
}

static uint64_t vertex_size(const mt_off_header *header)
{
    return 12u + 12u * header->normals + 16u * header->colors + 8u * header->uvs;
}

static mt_status fail_here(binary_reader *reader, uint64_t back, const char *sentence, long long number)
{
    return mt_fail_at(reader->context, MT_ERROR_SYNTAX,
                      mt_input_place_offset(reader->input, mt_input_offset(reader->input) - back), sentence, number);
}

/* Whether the bytes after the counts can hold what they say: faces take 20 bytes at least. */
static bool plausible(const binary_reader *reader, const uint8_t *bytes)
{
    uint64_t vertices = decode(reader, bytes), faces = decode(reader, bytes + 4);
    uint64_t left = mt_input_size(reader->input) - mt_input_offset(reader->input);
    return vertices <= INT32_MAX && faces <= INT32_MAX && vertices * vertex_size(reader->header) + 20 * faces <= left;
}

static mt_status read_counts(binary_reader *reader)
{
    uint8_t bytes[12];
    mt_status status = mt_input_read_exactly(reader->context, reader->input, bytes, sizeof bytes,
                                             "the counts of vertices, faces and edges");
    if (status != MT_OK) {
        return status;
    }
    if (!plausible(reader, bytes)) {
        reader->little = true;
        if (!plausible(reader, bytes)) {
            reader->little = false;
            return mt_fail_at(reader->context, MT_ERROR_SYNTAX,
                              mt_input_place_offset(reader->input, mt_input_offset(reader->input) - 12),
                              "%lu vertices and %lu faces, more than the %llu bytes that follow can hold",
                              (unsigned long)decode(reader, bytes), (unsigned long)decode(reader, bytes + 4),
                              (unsigned long long)(mt_input_size(reader->input) - mt_input_offset(reader->input)));
        }
        mt_warn(reader->context, "%s: the numbers are little endian, though binary OFF is big endian; read as such",
                mt_input_name(reader->input));
    }
    reader->vertex_count = decode(reader, bytes);
    reader->face_count = decode(reader, bytes + 4);
    return MT_OK;
}

static float *values_of(const mt_mesh *mesh, mt_semantic semantic)
{
    const mt_attribute *attribute = mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_VERTEX);
    return attribute ? attribute->values : NULL;
}

static mt_status read_vertices(binary_reader *reader)
{
    size_t size = (size_t)vertex_size(reader->header);
    float *normals = values_of(reader->mesh, MT_SEMANTIC_NORMAL), *uvs = values_of(reader->mesh, MT_SEMANTIC_UV);
    float *positions = reader->mesh->positions;
    uint8_t bytes[48];
    mt_status status = MT_OK;
    for (uint64_t vertex = 0; status == MT_OK && vertex < reader->vertex_count; vertex++) {
        const uint8_t *at = bytes;
        status = mt_input_read_exactly(reader->context, reader->input, bytes, size, "a vertex");
        if (status != MT_OK) {
            return status;
        }
        for (int i = 0; i < 3; i++, at += 4) {
            positions[3 * vertex + (uint64_t)i] = decode_float(reader, at);
        }
        for (int i = 0; i < 3 && normals; i++, at += 4) {
            normals[3 * vertex + (uint64_t)i] = decode_float(reader, at);
        }
        if (reader->header->colors) {
            double color[4];
            for (int i = 0; i < 4; i++, at += 4) {
                color[i] = (double)decode_float(reader, at);
            }
            if (!mt_off_add_color(reader->context, &reader->vertex_colors, vertex, color, 4, false)) {
                return mt_fail(reader->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while reading colors");
            }
        }
        for (int i = 0; i < 2 && uvs; i++, at += 4) {
            uvs[2 * vertex + (uint64_t)i] = decode_float(reader, at);
        }
    }
    return status;
}

/* Room for the corners of one more face. */
static mt_status reserve_corners(binary_reader *reader, uint64_t needed)
{
    if (needed <= reader->corner_room) {
        return MT_OK;
    }
    uint64_t room = 2 * needed;
    mt_index *grown = mt_reallocate(reader->context, reader->mesh->corner_vertices, room * sizeof *grown);
    if (!grown) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    reader->mesh->corner_vertices = grown;
    reader->corner_room = room;
    return MT_OK;
}

static mt_status read_corners(binary_reader *reader, uint64_t sides)
{
    mt_mesh *mesh = reader->mesh;
    uint8_t bytes[4];
    mt_status status = reserve_corners(reader, (uint64_t)mesh->corner_count + sides);
    for (uint64_t side = 0; status == MT_OK && side < sides; side++) {
        status = mt_input_read_exactly(reader->context, reader->input, bytes, 4, "a vertex of a face");
        uint32_t vertex = status == MT_OK ? decode(reader, bytes) : 0;
        if (status == MT_OK && vertex >= reader->vertex_count) {
            return fail_here(reader, 4, "vertex %lld of a face does not exist", (long long)(int32_t)vertex);
        }
        if (status == MT_OK) {
            mesh->corner_vertices[mesh->corner_count + side] = vertex;
        }
    }
    return status;
}

static mt_status read_face_color(binary_reader *reader, uint64_t face)
{
    uint8_t bytes[16];
    double color[4] = {0};
    mt_status status = mt_input_read_exactly(reader->context, reader->input, bytes, 4, "the components of a color");
    uint32_t count = status == MT_OK ? decode(reader, bytes) : 0;
    if (count > 4) {
        return fail_here(reader, 4, "a color of %lld components, expected 0 to 4", (long long)(int32_t)count);
    }
    if (status == MT_OK && count > 0) {
        status = mt_input_read_exactly(reader->context, reader->input, bytes, 4 * count, "a color");
    }
    for (uint32_t i = 0; status == MT_OK && i < count; i++) {
        color[i] = (double)decode_float(reader, bytes + 4 * (size_t)i);
    }
    bool keep = status == MT_OK && (count > 0 || reader->face_colors.count > 0);
    if (keep && !mt_off_add_color(reader->context, &reader->face_colors, face, color, count, false)) {
        status = mt_fail(reader->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while reading colors");
    }
    return status;
}

static mt_status read_faces(binary_reader *reader)
{
    mt_mesh *mesh = reader->mesh;
    mt_status status = MT_OK;
    for (uint64_t face = 0; status == MT_OK && face < reader->face_count; face++) {
        uint8_t bytes[4];
        status = mt_input_read_exactly(reader->context, reader->input, bytes, 4, "a face");
        if (status != MT_OK) {
            return status;
        }
        uint64_t sides = decode(reader, bytes), left = mt_input_size(reader->input) - mt_input_offset(reader->input);
        if (sides < 3 || 4 * sides > left) {
            return fail_here(reader, 4, "a face of %lld corners, expected 3 or more and the bytes for them",
                             (long long)(int32_t)sides);
        }
        if (!mt_count_fits((uint64_t)mesh->corner_count + sides)) {
            return mt_fail(reader->context, MT_ERROR_TOO_LARGE, "more corners of faces than an index can name");
        }
        status = read_corners(reader, sides);
        if (status == MT_OK) {
            mesh->corner_count += (mt_index)sides;
            mesh->face_offsets[face + 1] = mesh->corner_count;
            status = read_face_color(reader, face);
        }
    }
    return status;
}

static mt_status finish(binary_reader *reader)
{
    const char *name = mt_input_name(reader->input);
    mt_mesh *mesh = reader->mesh;
    uint64_t left = mt_input_size(reader->input) - mt_input_offset(reader->input);
    mt_index *corners =
        mt_reallocate(reader->context, mesh->corner_vertices, (uint64_t)mesh->corner_count * sizeof *corners);
    if (!corners) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mesh->corner_vertices = corners;
    mt_mesh_compact_faces(reader->context, mesh);
    if (left > 0) {
        mt_warn(reader->context, "%s: %llu bytes after the last face are left out", name, (unsigned long long)left);
    }
    mt_status status = mt_off_finish_colors(reader->context, &reader->vertex_colors, 1, name, mesh, MT_DOMAIN_VERTEX);
    return status == MT_OK ? mt_off_finish_colors(reader->context, &reader->face_colors, 1, name, mesh, MT_DOMAIN_FACE)
                           : status;
}

mt_status mt_off_read_binary(mt_context *context, mt_input *input, const mt_off_header *header, mt_mesh **out)
{
    binary_reader reader = {.context = context, .input = input, .header = header};
    mt_status status = mt_input_collect(context, input);
    if (status == MT_OK) {
        status = read_counts(&reader);
    }
    mt_mesh_layout layout = {
        .vertex_count = reader.vertex_count, .face_count = reader.face_count, .position_type = MT_F32};
    if (status == MT_OK) {
        status = mt_mesh_create(context, &layout, &reader.mesh);
    }
    if (status == MT_OK) {
        status = mt_off_add_attributes(context, reader.mesh, header, MT_F32);
    }
    if (status == MT_OK) {
        status = read_vertices(&reader);
    }
    if (status == MT_OK) {
        status = read_faces(&reader);
    }
    if (status == MT_OK) {
        status = finish(&reader);
    }
    mt_off_release_colors(context, &reader.vertex_colors);
    mt_off_release_colors(context, &reader.face_colors);
    if (status != MT_OK) {
        mt_mesh_destroy(context, reader.mesh);
        reader.mesh = NULL;
    }
    *out = reader.mesh;
    return status;
}
