/* Writing OBJ. Numbers are the shortest that read back the same: shortest for a float where floats are stored. */
#include "formats/mesh/obj.h"

#include "formats/mesh/values.h"
#include "formats/stream/lines.h"
#include "formats/stream/output.h"

#include <meshtool/subdivision_tags.h>

#include <string.h>

#define LINE_GRAIN 8192 /* lines of a block */
#define LABEL_KINDS (MT_LABEL_SMOOTHING + 1)

typedef struct obj_writer {
    const mt_mesh *mesh;
    unsigned digits;
    const mt_attribute *color, *uv, *normal, *holes;
    const mt_labels *labels[LABEL_KINDS];
} obj_writer;

static void put_vertices(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const obj_writer *writer = user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        char *at = mt_lines_reserve(lines, 16 + 6 * (MT_NUMBER_ROOM + 1));
        if (!at) {
            return;
        }
        *at++ = 'v';
        at = mt_put_position(at, writer->mesh, (mt_index)vertex, writer->digits);
        if (writer->color) {
            at = mt_put_color(at, writer->color, (mt_index)vertex, 3, true);
        }
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_values(mt_lines *lines, const mt_attribute *attribute, char keyword, uint32_t least, uint64_t begin,
                       uint64_t end)
{
    for (uint64_t value = begin; value < end; value++) {
        char *at = mt_lines_reserve(lines, 16 + 4 * (MT_NUMBER_ROOM + 1));
        if (!at) {
            return;
        }
        *at++ = 'v';
        *at++ = keyword;
        for (uint32_t i = 0; i < 3 && (i < attribute->component_count || i < least); i++) {
            *at++ = ' ';
            at = i < attribute->component_count ? mt_put_component(at, attribute, (mt_index)value, i)
                                                : mt_put_unsigned(at, 0);
        }
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_uvs(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    put_values(lines, ((const obj_writer *)user)->uv, 't', 2, begin, end);
}

static void put_normals(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    put_values(lines, ((const obj_writer *)user)->normal, 'n', 3, begin, end);
}

/* A name on its line, with bytes that would end it made harmless. */
static void put_name(mt_lines *lines, const char *keyword, const char *name)
{
    size_t size = strlen(name);
    char *at = mt_lines_reserve(lines, strlen(keyword) + size + 2);
    if (!at) {
        return;
    }
    at = stpcpy(at, keyword);
    *at++ = ' ';
    for (size_t i = 0; i < size; i++) {
        *at++ = (unsigned char)name[i] < ' ' ? '_' : name[i];
    }
    *at++ = '\n';
    lines->size = (size_t)(at - lines->bytes);
}

/* "" without a label: what has no name is written as what has none. */
static const char *name_of(const mt_labels *labels, mt_index label)
{
    return label == MT_NONE ? "" : labels->names[label];
}

/* The names that hold from this face on, where they are not those of the face before. */
static void put_labels(const obj_writer *writer, mt_lines *lines, mt_index face)
{
    static const char *const keywords[LABEL_KINDS] = {"g", "o", "usemtl", "s"};
    for (int kind = 0; kind < LABEL_KINDS; kind++) {
        const mt_labels *labels = writer->labels[kind];
        mt_index before = labels && face > 0 ? labels->face_labels[face - 1] : MT_NONE;
        mt_index now = labels ? labels->face_labels[face] : MT_NONE;
        const char *name = name_of(labels, now);
        if (now != before && (*name || *name_of(labels, before))) {
            bool smoothing_ends = kind == MT_LABEL_SMOOTHING && !*name;
            put_name(lines, keywords[kind], smoothing_ends ? "off" : name);
        }
    }
}

static mt_index value_of(const mt_attribute *attribute, mt_index corner, mt_index vertex)
{
    if (!attribute) {
        return MT_NONE;
    }
    return mt_attribute_value_index(attribute, attribute->domain == MT_DOMAIN_CORNER ? corner : vertex);
}

static char *put_corner(const obj_writer *writer, char *at, mt_index corner)
{
    mt_index vertex = writer->mesh->corner_vertices[corner];
    mt_index uv = value_of(writer->uv, corner, vertex), normal = value_of(writer->normal, corner, vertex);
    *at++ = ' ';
    at = mt_put_unsigned(at, (uint64_t)vertex + 1);
    if (uv != MT_NONE || normal != MT_NONE) {
        *at++ = '/';
    }
    if (uv != MT_NONE) {
        at = mt_put_unsigned(at, (uint64_t)uv + 1);
    }
    if (normal != MT_NONE) {
        *at++ = '/';
        at = mt_put_unsigned(at, (uint64_t)normal + 1);
    }
    return at;
}

static void put_faces(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const obj_writer *writer = user;
    bool labelled = writer->labels[0] || writer->labels[1] || writer->labels[2] || writer->labels[3];
    for (uint64_t face = begin; face < end; face++) {
        mt_index corner = mt_mesh_face_begin(writer->mesh, (mt_index)face);
        mt_index stop = mt_mesh_face_end(writer->mesh, (mt_index)face);
        if (labelled) {
            put_labels(writer, lines, (mt_index)face);
        }
        char *at = mt_lines_reserve(lines, 4 + (size_t)(stop - corner) * 3 * (MT_PUT_UNSIGNED_ROOM + 1));
        if (!at) {
            return;
        }
        *at++ = 'f';
        for (; corner < stop; corner++) {
            at = put_corner(writer, at, corner);
        }
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_wires(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t wire = begin; wire < end; wire++) {
        mt_index from = mesh->wire_offsets[wire], stop = mesh->wire_offsets[wire + 1];
        char *at = mt_lines_reserve(lines, 4 + (size_t)(stop - from) * (MT_PUT_UNSIGNED_ROOM + 1));
        if (!at) {
            return;
        }
        *at++ = 'l';
        for (; from < stop; from++) {
            *at++ = ' ';
            at = mt_put_unsigned(at, (uint64_t)mesh->wire_vertices[from] + 1);
        }
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_points(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t point = begin; point < end; point++) {
        char *at = mt_lines_reserve(lines, 4 + MT_PUT_UNSIGNED_ROOM);
        if (!at) {
            return;
        }
        *at++ = 'p';
        *at++ = ' ';
        at = mt_put_unsigned(at, (uint64_t)mesh->point_vertices[point] + 1);
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

/* Tags count vertices from 0. */
static void put_creases(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t i = begin; i < end; i++) {
        char *at = mt_lines_reserve(lines, 32 + 2 * MT_PUT_UNSIGNED_ROOM + MT_NUMBER_ROOM);
        if (!at) {
            return;
        }
        at = stpcpy(at, "t crease 2/1/0 ");
        at = mt_put_unsigned(at, mesh->creases[i].a);
        *at++ = ' ';
        at = mt_put_unsigned(at, mesh->creases[i].b);
        *at++ = ' ';
        at = mt_put_number(at, mesh->creases[i].value);
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_sharp_vertices(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t i = begin; i < end; i++) {
        char *at = mt_lines_reserve(lines, 32 + MT_PUT_UNSIGNED_ROOM + MT_NUMBER_ROOM);
        if (!at) {
            return;
        }
        at = stpcpy(at, "t corner 1/1/0 ");
        at = mt_put_unsigned(at, mesh->sharp_vertices[i].vertex);
        *at++ = ' ';
        at = mt_put_number(at, mesh->sharp_vertices[i].value);
        *at++ = '\n';
        lines->size = (size_t)(at - lines->bytes);
    }
}

static void put_holes(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_attribute *holes = ((const obj_writer *)user)->holes;
    for (uint64_t face = begin; face < end; face++) {
        char *at = mt_lines_reserve(lines, 32 + MT_PUT_UNSIGNED_ROOM);
        if (at && mt_face_is_hole(holes, (mt_index)face)) {
            at = mt_put_unsigned(stpcpy(at, "t hole 1/0/0 "), face);
            *at++ = '\n';
            lines->size = (size_t)(at - lines->bytes);
        }
    }
}

static void put_settings(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t i = begin; i < end; i++) {
        mt_subdivision_tag tag = (mt_subdivision_tag)i;
        unsigned value = 0;
        char *at = mt_lines_reserve(lines, 96);
        if (at && mt_subdivision_tag_get(mesh, tag, &value)) {
            const char *word = mt_subdivision_tag_word(tag, value);
            at = stpcpy(stpcpy(at, "t "), mt_subdivision_tag_name(tag));
            at = word ? stpcpy(stpcpy(at, " 0/0/1 "), word) : mt_put_unsigned(stpcpy(at, " 1/0/0 "), value);
            *at++ = '\n';
            lines->size = (size_t)(at - lines->bytes);
        }
    }
}

static void put_libraries(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const mt_mesh *mesh = ((const obj_writer *)user)->mesh;
    for (uint64_t i = begin; i < end; i++) {
        put_name(lines, "mtllib", mesh->material_libraries[i]);
    }
}

const mt_attribute *mt_obj_written_attribute(const mt_mesh *mesh, mt_semantic semantic)
{
    if (semantic == MT_SEMANTIC_COLOR) {
        return mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_VERTEX);
    }
    const mt_attribute *attribute = mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_CORNER);
    return attribute ? attribute : mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_VERTEX);
}

const mt_labels *mt_obj_written_labels(const mt_mesh *mesh, mt_label_kind kind)
{
    const mt_labels *labels = mt_mesh_find_labels(mesh, kind);
    if (!labels && kind == MT_LABEL_OBJECT) {
        labels = mt_mesh_find_labels(mesh, MT_LABEL_PART);
        labels = labels ? labels : mt_mesh_find_labels(mesh, MT_LABEL_SOLID);
    }
    return labels;
}

mt_status mt_obj_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output)
{
    obj_writer writer = {.mesh = mesh,
                         .digits = options->digits,
                         .color = mt_obj_written_attribute(mesh, MT_SEMANTIC_COLOR),
                         .holes = mt_mesh_find_holes(mesh),
                         .uv = mt_obj_written_attribute(mesh, MT_SEMANTIC_UV),
                         .normal = mt_obj_written_attribute(mesh, MT_SEMANTIC_NORMAL)};
    for (int kind = 0; kind < LABEL_KINDS; kind++) {
        writer.labels[kind] = mt_obj_written_labels(mesh, (mt_label_kind)kind);
    }
    const struct {
        uint64_t count;
        mt_lines_function put;
    } parts[] = {{mesh->material_library_count, put_libraries},
                 {mesh->vertex_count, put_vertices},
                 {writer.uv ? writer.uv->value_count : 0, put_uvs},
                 {writer.normal ? writer.normal->value_count : 0, put_normals},
                 {mesh->face_count, put_faces},
                 {mesh->wire_count, put_wires},
                 {mesh->point_count, put_points},
                 {mesh->crease_count, put_creases},
                 {mesh->sharp_vertex_count, put_sharp_vertices},
                 {writer.holes ? mesh->face_count : 0, put_holes},
                 {MT_TAG_COUNT, put_settings}};
    mt_status status = mt_output_text(context, output, "# Wavefront OBJ\n");
    for (size_t i = 0; status == MT_OK && i < sizeof parts / sizeof parts[0]; i++) {
        status = mt_lines_write(context, output, parts[i].count, LINE_GRAIN, parts[i].put, &writer);
    }
    return status;
}
