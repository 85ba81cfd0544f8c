/* Wavefront OBJ: its record, and how it is recognised. */
#include "formats/mesh/obj.h"

#include "formats/mesh/records.h"

#include <meshtool/subdivision_tags.h>

#include <string.h>

/* Each is compared with all before it, which would take too long for more. */
#define NAMES_COMPARED 4096U

static bool is_blank(uint8_t c)
{
    return c == ' ' || c == '\t';
}

static bool is_line_end(uint8_t c)
{
    return c == '\n' || c == '\r';
}

/* What the first word of a line says: 2 a statement that OBJ files are made of, 1 one that may be in them, 0 none, or
 * an empty line or comment, -1 something else. */
static int judge_line(const uint8_t *line, size_t size)
{
    static const char *const strong[] = {"v", "vt", "vn", "f", "mtllib", "usemtl"};
    static const char *const weak[] = {"g", "o", "s", "l", "p", "t"};
    size_t begin = 0;
    while (begin < size && is_blank(line[begin])) {
        begin++;
    }
    size_t end = begin;
    while (end < size && !is_blank(line[end])) {
        end++;
    }
    if (begin == end || line[begin] == '#') {
        return 0;
    }
    for (size_t i = 0; i < sizeof strong / sizeof strong[0]; i++) {
        if (strlen(strong[i]) == end - begin && memcmp(line + begin, strong[i], end - begin) == 0) {
            return end < size ? 2 : 1;
        }
    }
    for (size_t i = 0; i < sizeof weak / sizeof weak[0]; i++) {
        if (strlen(weak[i]) == end - begin && memcmp(line + begin, weak[i], end - begin) == 0) {
            return 1;
        }
    }
    return -1;
}

static int sniff_obj(const uint8_t *bytes, size_t size, uint64_t total)
{
    size_t strong = 0, weak = 0, strange = 0;
    size_t at = size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (memchr(bytes, 0, size)) {
        return 0;
    }
    while (at < size) {
        size_t end = at;
        while (end < size && !is_line_end(bytes[end])) {
            end++;
        }
        if (end < size || size == total) {
            int verdict = judge_line(bytes + at, end - at);
            strong += verdict == 2;
            weak += verdict == 1;
            strange += verdict < 0;
        }
        at = end + 1;
    }
    if (strong == 0) {
        return weak > strange ? 20 : 0;
    }
    return strange == 0 ? 80 : strong > strange ? 60 : 20;
}

static bool holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding)
{
    (void)encoding;
    if (attribute == mt_mesh_find_holes(mesh) || mt_attribute_is_subdivision_tag(attribute)) {
        return true;
    }
    return attribute->semantic != MT_SEMANTIC_GENERIC &&
           attribute == mt_obj_written_attribute(mesh, attribute->semantic);
}

/* Whether objects by these names are told apart: none goes unnamed, and no two have one name. */
static bool are_told_apart(const mt_labels *labels)
{
    for (mt_index i = 0; i < labels->name_count; i++) {
        if (!labels->names[i][0]) {
            return false;
        }
        for (mt_index j = 0; j < i && i < NAMES_COMPARED; j++) {
            if (strcmp(labels->names[i], labels->names[j]) == 0) {
                return false;
            }
        }
    }
    return true;
}

/* Parts and solids, which stand in for objects, may have any names. */
static bool holds_labels(const mt_mesh *mesh, const mt_labels *labels)
{
    return labels->kind <= MT_LABEL_SMOOTHING ||
           (labels == mt_obj_written_labels(mesh, MT_LABEL_OBJECT) && are_told_apart(labels));
}

const mt_mesh_format mt_obj_format = {
    .name = "obj",
    .title = "Wavefront OBJ",
    .extensions = (const char *const[]){"obj", NULL},
    .abilities = MT_HOLDS_POLYGONS | MT_HOLDS_INDICES | MT_HOLDS_WIRES | MT_HOLDS_POINTS | MT_HOLDS_VERTEX_NORMALS |
                 MT_HOLDS_CORNER_NORMALS | MT_HOLDS_VERTEX_UVS | MT_HOLDS_CORNER_UVS | MT_HOLDS_UV_DEPTH |
                 MT_HOLDS_VERTEX_COLORS | MT_HOLDS_GROUPS | MT_HOLDS_LIBRARIES | MT_HOLDS_CREASES | MT_HOLDS_F64,
    .has_ascii = true,
    .holds_attribute = holds_attribute,
    .holds_labels = holds_labels,
    .sniff = sniff_obj,
    .read = mt_obj_read,
    .write = mt_obj_write,
};
