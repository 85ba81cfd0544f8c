/* Writing OFF as text. Colours stored in bytes are written as whole numbers; all others as fractions, with a point, so
 * that a reader can tell. */
#include "formats/mesh/off_parts.h"

#include "formats/mesh/values.h"
#include "formats/stream/lines.h"
#include "formats/stream/output.h"

#define LINE_GRAIN 8192 /* lines of a block */

typedef struct off_color {
    const mt_attribute *attribute; /* NULL: none */
    uint32_t component_count;      /* 3 or 4 */
    bool whole;
} off_color;

typedef struct off_writer {
    const mt_mesh *mesh;
    unsigned digits;
    const mt_attribute *normal, *uv;
    off_color vertex_color, face_color;
} off_writer;

/* Bytes are written as such unless all are 0 and 1, which would be taken for fractions. */
static off_color choose_color(const mt_mesh *mesh, mt_domain domain)
{
    off_color color = {.attribute = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, domain), .component_count = 3};
    if (!color.attribute) {
        return color;
    }
    color.component_count += color.attribute->component_count % 2 == 0;
    const uint8_t *bytes = color.attribute->values;
    uint64_t count = (uint64_t)color.attribute->value_count * color.attribute->component_count;
    for (uint64_t i = 0; color.attribute->type == MT_U8 && i < count && !color.whole; i++) {
        color.whole = bytes[i] > 1;
    }
    return color;
}

/* A number that is whole gets a point. */
static char *mark_fraction(char *begin, char *end)
{
    for (const char *at = begin; at < end; at++) {
        if (!mt_is_digit(*at) && *at != '-') {
            return end;
        }
    }
    *end++ = '.';
    *end++ = '0';
    return end;
}

static char *put_color(char *at, const off_color *color, mt_index element)
{
    char text[4 * (MT_NUMBER_ROOM + 3)];
    char *end = mt_put_color(text, color->attribute, element, color->component_count, !color->whole);
    for (const char *word = text; word < end;) {
        char *begin = at + 1;
        *at++ = *word++;
        while (word < end && *word != ' ') {
            *at++ = *word++;
        }
        at = color->whole ? at : mark_fraction(begin, at);
    }
    return at;
}

static char *put_values(char *at, const mt_attribute *attribute, mt_index vertex, uint32_t count)
{
    mt_index value = mt_attribute_value_index(attribute, vertex);
    for (uint32_t i = 0; i < count; i++) {
        *at++ = ' ';
        at = value == MT_NONE || i >= attribute->component_count ? mt_put_unsigned(at, 0)
                                                                 : mt_put_component(at, attribute, value, i);
    }
    return at;
}

static void put_vertices(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const off_writer *writer = user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        char *at = mt_lines_reserve(lines, 16 + 12 * (MT_NUMBER_ROOM + 3));
        if (!at) {
            return;
        }
        /* The first number has no space before it: the one that is put is overwritten by the next line's. */
        char *line = at;
        at = mt_put_position(at, writer->mesh, (mt_index)vertex, writer->digits);
        at = writer->normal ? put_values(at, writer->normal, (mt_index)vertex, 3) : at;
        at = writer->vertex_color.attribute ? put_color(at, &writer->vertex_color, (mt_index)vertex) : at;
        at = writer->uv ? put_values(at, writer->uv, (mt_index)vertex, 2) : at;
        *at++ = '\n';
        memmove(line, line + 1, (size_t)(at - line) - 1);
        lines->size = (size_t)(at - lines->bytes) - 1;
    }
}

static void put_faces(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const off_writer *writer = user;
    for (uint64_t face = begin; face < end; face++) {
        mt_index corner = mt_mesh_face_begin(writer->mesh, (mt_index)face);
        mt_index stop = mt_mesh_face_end(writer->mesh, (mt_index)face);
        size_t sides = stop - corner;
        char *at = mt_lines_reserve(lines, (sides + 2) * (MT_PUT_UNSIGNED_ROOM + 1) + 4 * (MT_NUMBER_ROOM + 3));
        if (!at) {
            return;
        }
        at = mt_put_unsigned(at, sides);
        for (; corner < stop; corner++) {
            *at++ = ' ';
            at = mt_put_unsigned(at, writer->mesh->corner_vertices[corner]);
        }
        if (writer->face_color.attribute) {
            at = put_color(at, &writer->face_color, (mt_index)face);
        }
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

mt_status mt_off_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output)
{
    off_writer writer = {.mesh = mesh,
                         .digits = options->digits,
                         .normal = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX),
                         .uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX),
                         .vertex_color = choose_color(mesh, MT_DOMAIN_VERTEX),
                         .face_color = choose_color(mesh, MT_DOMAIN_FACE)};
    mt_status status = mt_output_format(context, output, "%s%s%sOFF\n%lu %lu 0\n", writer.uv ? "ST" : "",
                                        writer.vertex_color.attribute ? "C" : "", writer.normal ? "N" : "",
                                        (unsigned long)mesh->vertex_count, (unsigned long)mesh->face_count);
    if (status == MT_OK) {
        status = mt_lines_write(context, output, mesh->vertex_count, LINE_GRAIN, put_vertices, &writer);
    }
    return status == MT_OK ? mt_lines_write(context, output, mesh->face_count, LINE_GRAIN, put_faces, &writer) : status;
}
