/* OFF, the object file format of Geomview: its record, how it is recognised, and whether it is binary. */
#include "formats/mesh/off_parts.h"
#include "formats/mesh/records.h"
#include "formats/stream/input.h"

/* The first line that says something in the first bytes of a file; NULL when none is complete. */
static const uint8_t *first_line(const uint8_t *at, const uint8_t *stop, const uint8_t **line_end)
{
    if (stop - at >= 3 && memcmp(at, "\xEF\xBB\xBF", 3) == 0) {
        at += 3;
    }
    while (at < stop) {
        while (at < stop && mt_is_space((char)*at)) {
            at++;
        }
        const uint8_t *end = at;
        while (end < stop && !mt_is_line_end((char)*end)) {
            end++;
        }
        if (at < stop && *at != '#') {
            *line_end = end;
            return at;
        }
        at = end;
    }
    return NULL;
}

/* How many words that are numbers the line begins with; 0 when others follow. */
static int count_numbers(const uint8_t *at, const uint8_t *end, bool whole)
{
    int count = 0;
    while (at < end && *at != '#') {
        const uint8_t *begin = at;
        while (at < end && (mt_is_digit((char)*at) || (!whole && (*at && strchr("+-.eE", *at))))) {
            at++;
        }
        if (at == begin || (at < end && !mt_is_blank((char)*at))) {
            return 0;
        }
        count++;
        while (at < end && mt_is_blank((char)*at)) {
            at++;
        }
    }
    return count;
}

static int sniff_off(const uint8_t *bytes, size_t size, uint64_t total)
{
    const uint8_t *stop = bytes + size, *end;
    const uint8_t *line = first_line(bytes, stop, &end);
    mt_off_header header = {0};
    char dimension;
    (void)total;
    if (!line) {
        return 0;
    }
    if (mt_off_header_word((const char *)line, (const char *)end, &header, &dimension) > 0) {
        return 90;
    }
    /* Without the word: two or three counts, and a vertex after them. */
    int counts = count_numbers(line, end, true);
    line = first_line(end, stop, &end);
    return (counts == 2 || counts == 3) && line && count_numbers(line, end, false) >= 3 ? 30 : 0;
}

/* Whether the header says BINARY. It then ends with its line; the bytes up to there are consumed. */
static mt_status read_binary_header(mt_context *context, mt_input *input, mt_off_header *header)
{
    const uint8_t *bytes, *end;
    size_t size, got;
    mt_status status = mt_input_peek(context, input, &bytes, &size);
    const uint8_t *line = status == MT_OK ? first_line(bytes, bytes + size, &end) : NULL;
    char dimension;
    if (!line || end == bytes + size) {
        return status;
    }
    size_t word = mt_off_header_word((const char *)line, (const char *)end, header, &dimension);
    const uint8_t *at = line + word;
    while (at < end && mt_is_blank((char)*at)) {
        at++;
    }
    header->binary = word > 0 && end - at >= 6 && memcmp(at, "BINARY", 6) == 0;
    if (!header->binary) {
        return MT_OK;
    }
    if (dimension) {
        mt_place place = {.file = mt_input_name(input)};
        return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place,
                          "%cOFF (vertices of other than three numbers) is not read", dimension);
    }
    end += *end == '\r' && end + 1 < bytes + size && end[1] == '\n' ? 2 : 1;
    uint8_t skipped[MT_INPUT_PEEK];
    return mt_input_read(context, input, skipped, (size_t)(end - bytes), &got);
}

static mt_status read_off(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    mt_off_header header = {0};
    (void)options;
    *out = NULL;
    mt_status status = read_binary_header(context, input, &header);
    if (status != MT_OK) {
        return status;
    }
    return header.binary ? mt_off_read_binary(context, input, &header, out) : mt_off_read_text(context, input, out);
}

mt_status mt_off_add_attributes(mt_context *context, mt_mesh *mesh, const mt_off_header *header, mt_type type)
{
    mt_attribute_layout normals = {.semantic = MT_SEMANTIC_NORMAL,
                                   .domain = MT_DOMAIN_VERTEX,
                                   .type = type,
                                   .component_count = 3,
                                   .value_count = mesh->vertex_count};
    mt_attribute_layout uvs = normals;
    uvs.semantic = MT_SEMANTIC_UV;
    uvs.component_count = 2;
    mt_attribute *attribute;
    mt_status status = header->normals ? mt_mesh_add_attribute(context, mesh, &normals, &attribute) : MT_OK;
    return status == MT_OK && header->uvs ? mt_mesh_add_attribute(context, mesh, &uvs, &attribute) : status;
}

/* One of each meaning: on vertices, and colours on faces too. */
static bool holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding)
{
    (void)encoding;
    bool held = attribute->domain == MT_DOMAIN_VERTEX ||
                (attribute->domain == MT_DOMAIN_FACE && attribute->semantic == MT_SEMANTIC_COLOR);
    return held && attribute->semantic != MT_SEMANTIC_GENERIC &&
           attribute == mt_mesh_find_attribute(mesh, attribute->semantic, attribute->domain);
}

const mt_mesh_format mt_off_format = {
    .name = "off",
    .title = "OFF",
    .extensions = (const char *const[]){"off", "coff", "noff", "cnoff", "stoff", NULL},
    .abilities = MT_HOLDS_POLYGONS | MT_HOLDS_INDICES | MT_HOLDS_VERTEX_NORMALS | MT_HOLDS_VERTEX_UVS |
                 MT_HOLDS_VERTEX_COLORS | MT_HOLDS_FACE_COLORS | MT_HOLDS_ALPHA | MT_HOLDS_F64,
    .has_ascii = true,
    .holds_attribute = holds_attribute,
    .sniff = sniff_off,
    .read = read_off,
    .write = mt_off_write,
};
