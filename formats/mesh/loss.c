/* What a format cannot hold of a mesh, from its abilities alone. */
#include "formats/mesh/loss.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define ITEM_COUNT (sizeof((mt_loss *)0)->items / sizeof((mt_loss *)0)->items[0])

void mt_loss_add(mt_loss *loss, const char *format, ...)
{
    if (loss->count == ITEM_COUNT) {
        snprintf(loss->items[ITEM_COUNT - 1], sizeof loss->items[0], "more");
        return;
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(loss->items[loss->count++], sizeof loss->items[0], format, arguments);
    va_end(arguments);
}

void mt_loss_add_count(mt_loss *loss, uint64_t count, const char *one, const char *several)
{
    if (count > 0) {
        mt_loss_add(loss, "%llu %s", (unsigned long long)count, count == 1 ? one : several);
    }
}

mt_status mt_loss_refuse(mt_context *context, const mt_loss *loss, const char *title)
{
    char text[sizeof loss->items + 5 * ITEM_COUNT] = "";
    size_t length = 0;
    for (size_t i = 0; i < loss->count; i++) {
        const char *before = i == 0 ? "" : i + 1 < loss->count ? ", " : " and ";
        length += (size_t)snprintf(text + length, sizeof text - length, "%s%s", before, loss->items[i]);
    }
    return mt_fail(context, MT_ERROR_LOSS, "%s cannot hold %s, and no loss is allowed", title, text);
}

static uint64_t count_polygons(const mt_mesh *mesh)
{
    if (!mesh->face_offsets) {
        return mesh->face_size > 3 ? mesh->face_count : 0;
    }
    uint64_t count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        count += mt_mesh_face_sides(mesh, face) > 3;
    }
    return count;
}

static mt_status count_isolated(mt_context *context, const mt_mesh *mesh, uint64_t *count)
{
    uint8_t *used = mt_allocate_zeroed(context, mesh->vertex_count);
    *count = 0;
    if (!used) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        used[mesh->corner_vertices[corner]] = 1;
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        *count += !used[vertex];
    }
    mt_free(context, used);
    return MT_OK;
}

mt_status mt_loss_add_isolated(mt_context *context, const mt_mesh *mesh, mt_loss *loss)
{
    uint64_t isolated;
    mt_status status = count_isolated(context, mesh, &isolated);
    mt_loss_add_count(loss, isolated, "isolated vertex", "isolated vertices");
    return status;
}

static uint64_t count_rounded(const mt_mesh *mesh)
{
    if (mesh->position_type != MT_F64) {
        return 0;
    }
    const double *p = mesh->positions;
    uint64_t count = 0;
    for (uint64_t i = 0; i < 3 * (uint64_t)mesh->vertex_count; i++) {
        count += (double)(float)p[i] != p[i] && !isnan(p[i]);
    }
    return count;
}

static unsigned ability_of(const mt_attribute *attribute)
{
    static const unsigned abilities[][4] = {
        [MT_SEMANTIC_GENERIC] = {[MT_DOMAIN_VERTEX] = MT_HOLDS_GENERIC, [MT_DOMAIN_FACE] = MT_HOLDS_GENERIC},
        [MT_SEMANTIC_NORMAL] = {[MT_DOMAIN_VERTEX] = MT_HOLDS_VERTEX_NORMALS,
                                [MT_DOMAIN_CORNER] = MT_HOLDS_CORNER_NORMALS,
                                [MT_DOMAIN_FACE] = MT_HOLDS_FACE_NORMALS},
        [MT_SEMANTIC_UV] = {[MT_DOMAIN_VERTEX] = MT_HOLDS_VERTEX_UVS, [MT_DOMAIN_CORNER] = MT_HOLDS_CORNER_UVS},
        [MT_SEMANTIC_COLOR] = {[MT_DOMAIN_VERTEX] = MT_HOLDS_VERTEX_COLORS, [MT_DOMAIN_FACE] = MT_HOLDS_FACE_COLORS},
    };
    return abilities[attribute->semantic][attribute->domain];
}

static void add_attribute(mt_loss *loss, const mt_attribute *attribute, unsigned held, bool is_held)
{
    static const char *const domains[] = {"mesh", "vertex", "corner", "face"};
    static const char *const semantics[] = {"attribute", "normals", "UVs", "colors"};
    const char *domain = domains[attribute->domain];
    if (!is_held) {
        if (attribute->semantic == MT_SEMANTIC_GENERIC) {
            mt_loss_add(loss, "%s attribute \"%.32s\"", domain, attribute->name);
        } else {
            mt_loss_add(loss, "%s %s", domain, semantics[attribute->semantic]);
        }
        return;
    }
    bool color = attribute->semantic == MT_SEMANTIC_COLOR;
    if (color && attribute->component_count % 2 == 0 && !(held & MT_HOLDS_ALPHA)) {
        mt_loss_add(loss, "alpha of %s colors", domain);
    }
    if (attribute->semantic == MT_SEMANTIC_UV && attribute->component_count > 2 && !(held & MT_HOLDS_UV_DEPTH)) {
        mt_loss_add(loss, "third component of %s UVs", domain);
    }
}

static bool holds_labels(const mt_mesh *mesh, const mt_labels *labels, const mt_mesh_format *format, unsigned held)
{
    unsigned ability = labels->kind == MT_LABEL_SOLID  ? MT_HOLDS_SOLIDS
                       : labels->kind == MT_LABEL_PART ? MT_HOLDS_PARTS
                                                       : MT_HOLDS_GROUPS;
    return format->holds_labels ? format->holds_labels(mesh, labels) : (held & ability) != 0;
}

static void add_labels(mt_loss *loss, const mt_labels *labels, bool is_held)
{
    if (!is_held) {
        mt_loss_add(loss, "%s names", mt_label_kind_name(labels->kind));
    }
}

static bool holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, const mt_mesh_format *format,
                            mt_encoding encoding)
{
    return format->holds_attribute ? format->holds_attribute(mesh, attribute, encoding)
                                   : (format->abilities & ability_of(attribute)) != 0;
}

mt_status mt_mesh_format_loss(mt_context *context, const mt_mesh *mesh, const mt_mesh_format *format,
                              const mt_mesh_write_options *options, mt_loss *out)
{
    static const mt_mesh_write_options defaults;
    options = options ? options : &defaults;
    mt_encoding encoding = options->encoding;
    if (encoding == MT_ENCODING_DEFAULT) {
        encoding = format->has_binary ? MT_ENCODING_BINARY : MT_ENCODING_ASCII;
    }
    unsigned held = format->abilities & ~(encoding == MT_ENCODING_ASCII ? 0 : format->ascii_abilities);
    mt_status status = MT_OK;
    out->count = 0;
    if (!(held & MT_HOLDS_POLYGONS)) {
        mt_loss_add_count(out, count_polygons(mesh), "polygon (triangulated)", "polygons (triangulated)");
    }
    if (!(held & MT_HOLDS_INDICES)) {
        status = mt_loss_add_isolated(context, mesh, out);
    }
    if (!(held & MT_HOLDS_WIRES)) {
        mt_loss_add_count(out, mesh->wire_count, "wire", "wires");
    }
    if (!(held & MT_HOLDS_POINTS)) {
        mt_loss_add_count(out, mesh->point_count, "point", "points");
    }
    bool quantised = (held & MT_TAKES_QUANTIZATION) && options->quantize_bits > 0; /* from doubles */
    if (!(held & MT_HOLDS_F64) && !quantised) {
        mt_loss_add_count(out, count_rounded(mesh), "coordinate rounded to single precision",
                          "coordinates rounded to single precision");
    }
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        const mt_attribute *attribute = &mesh->attributes[i];
        add_attribute(out, attribute, held, holds_attribute(mesh, attribute, format, encoding));
    }
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        add_labels(out, &mesh->label_sets[i], holds_labels(mesh, &mesh->label_sets[i], format, held));
    }
    if (!(held & MT_HOLDS_CREASES)) {
        mt_loss_add_count(out, mesh->crease_count, "edge sharpness", "edge sharpnesses");
        mt_loss_add_count(out, mesh->sharp_vertex_count, "vertex sharpness", "vertex sharpnesses");
    }
    if (!(held & MT_HOLDS_LIBRARIES)) {
        mt_loss_add_count(out, mesh->material_library_count, "material library", "material libraries");
    }
    if (status == MT_OK && format->changes) {
        status = format->changes(context, mesh, options, out);
    }
    return status;
}
