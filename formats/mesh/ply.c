/* PLY, the polygon file format of Greg Turk (Stanford, 1994): a text header that declares elements and their
 * properties, then their records as text or in binary of either byte order. */
#include "formats/mesh/ply_body.h"
#include "formats/mesh/ply_write.h"
#include "formats/mesh/records.h"

#include <string.h>

static int sniff_ply(const uint8_t *bytes, size_t size, uint64_t total)
{
    (void)total;
    size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    if (size < mark + 4 || memcmp(bytes + mark, "ply", 3) != 0) {
        return 0;
    }
    uint8_t next = bytes[mark + 3];
    return next == '\n' || next == '\r' ? 100 : next == ' ' || next == '\t' ? 60 : 0;
}

static mt_status read_body(mt_context *context, mt_input *input, ply_header *header, mt_mesh **out)
{
    ply_plan plan;
    mt_status status = mt_ply_plan_make(context, input, header, mt_input_size(input) - header->body_offset, &plan);
    if (status != MT_OK) {
        return status;
    }
    status = plan.header.encoding == PLY_ASCII ? mt_ply_read_ascii(context, input, &plan)
                                               : mt_ply_read_binary(context, input, &plan);
    if (status == MT_OK) {
        *out = plan.mesh;
        plan.mesh = NULL;
    }
    mt_ply_plan_release(context, &plan);
    return status;
}

static mt_status read_ply(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    (void)options; /* the precision is the caller's */
    ply_header header;
    *out = NULL;
    mt_status status = mt_ply_header_read(context, input, &header);
    if (status == MT_OK) {
        status = mt_input_collect(context, input);
    }
    if (status == MT_OK) {
        status = read_body(context, input, &header, out);
    }
    mt_ply_header_release(context, &header);
    return status;
}

/* Vertices and faces have properties of any name; corners have their first texture coordinates alone. */
static bool holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding)
{
    (void)encoding;
    if (attribute->domain == MT_DOMAIN_CORNER) {
        return attribute == mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    }
    return attribute->domain != MT_DOMAIN_MESH;
}

static const char *const extensions[] = {"ply", NULL};

const mt_mesh_format mt_ply_format = {
    .name = "ply",
    .title = "PLY",
    .extensions = extensions,
    .abilities = MT_HOLDS_POLYGONS | MT_HOLDS_INDICES | MT_HOLDS_WIRES | MT_HOLDS_VERTEX_NORMALS |
                 MT_HOLDS_FACE_NORMALS | MT_HOLDS_VERTEX_UVS | MT_HOLDS_CORNER_UVS | MT_HOLDS_VERTEX_COLORS |
                 MT_HOLDS_FACE_COLORS | MT_HOLDS_GENERIC | MT_HOLDS_F64 | MT_HOLDS_ALPHA | MT_HOLDS_UV_DEPTH,
    .has_ascii = true,
    .has_binary = true,
    .has_binary_big = true,
    .sniff = sniff_ply,
    .holds_attribute = holds_attribute,
    .read = read_ply,
    .write = mt_ply_write,
};
