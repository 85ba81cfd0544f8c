/* STL, the format of 3D Systems' stereolithography (1989): triangles without shared vertices, as text or in binary. */
#include "formats/mesh/records.h"
#include "formats/mesh/stl_facets.h"
#include "formats/stream/cursor.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#define SHOWN_FACETS 16u /* how many facets of a stream must look like facets */

static uint32_t load_u32(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

/* Whether text begins here whose first word is "solid". */
static bool begins_with_solid(const uint8_t *bytes, size_t size)
{
    size_t at = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (at < size && mt_is_space((char)bytes[at])) {
        at++;
    }
    return size - at >= 5 && strncasecmp((const char *)bytes + at, "solid", 5) == 0 &&
           (size - at == 5 || mt_is_space((char)bytes[at + 5]));
}

/* Bytes that no text has. */
static bool has_control_bytes(const uint8_t *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (bytes[i] < ' ' && !mt_is_space((char)bytes[i])) {
            return true;
        }
    }
    return false;
}

/* Many binary files begin with "solid" too: the size decides, and after it bytes that are no text where the facets
 * would be. A zero byte in ASCII is an error with a line, so what is long text otherwise stays ASCII. */
bool mt_stl_is_binary(const uint8_t *bytes, size_t size, uint64_t total)
{
    if (size >= STL_PREFIX_SIZE) {
        uint64_t count = load_u32(bytes + STL_HEADER_SIZE);
        if (total != UINT64_MAX && STL_PREFIX_SIZE + count * STL_FACET_SIZE == total) {
            return true;
        }
    }
    if (!begins_with_solid(bytes, size)) {
        return true;
    }
    size_t end = size < STL_PREFIX_SIZE + STL_FACET_SIZE ? size : STL_PREFIX_SIZE + STL_FACET_SIZE;
    return size >= STL_PREFIX_SIZE && has_control_bytes(bytes + STL_HEADER_SIZE, end - STL_HEADER_SIZE);
}

/* Whether the facets that are there begin with a normal of length 0 or 1. */
static bool look_like_facets(const uint8_t *bytes, size_t size)
{
    size_t count = size < STL_PREFIX_SIZE ? 0 : (size - STL_PREFIX_SIZE) / STL_FACET_SIZE;
    count = count < SHOWN_FACETS ? count : SHOWN_FACETS;
    for (size_t i = 0; i < count; i++) {
        double length = 0;
        for (size_t j = 0; j < 3; j++) {
            uint32_t bits = load_u32(bytes + STL_PREFIX_SIZE + i * STL_FACET_SIZE + 4 * j);
            float number;
            memcpy(&number, &bits, sizeof number);
            length += (double)number * (double)number;
        }
        if (!(length == 0 || fabs(length - 1) < 0.01)) {
            return false;
        }
    }
    return count > 0;
}

static int sniff_stl(const uint8_t *bytes, size_t size, uint64_t total)
{
    if (!mt_stl_is_binary(bytes, size, total)) {
        return 90;
    }
    if (size < STL_PREFIX_SIZE) {
        return 0;
    }
    uint64_t count = load_u32(bytes + STL_HEADER_SIZE), expected = STL_PREFIX_SIZE + count * STL_FACET_SIZE;
    if (expected == total) {
        return 95;
    }
    return look_like_facets(bytes, size) && (total == UINT64_MAX || expected < total) ? 60 : 0;
}

static mt_status read_stl(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    (void)options; /* the precision is the caller's */
    const uint8_t *bytes;
    size_t size;
    *out = NULL;
    mt_status status = mt_input_collect(context, input);
    if (status == MT_OK) {
        status = mt_input_peek(context, input, &bytes, &size);
    }
    if (status != MT_OK) {
        return status;
    }
    return mt_stl_is_binary(bytes, size, mt_input_size(input)) ? mt_stl_read_binary(context, input, out)
                                                               : mt_stl_read_ascii(context, input, out);
}

static bool holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding)
{
    return attribute == mt_stl_normals(mesh) || (attribute == mt_stl_attributes(mesh) && encoding != MT_ENCODING_ASCII);
}

static const char *const extensions[] = {"stl", NULL};

const mt_mesh_format mt_stl_format = {
    .name = "stl",
    .title = "STL",
    .extensions = extensions,
    .abilities = MT_HOLDS_FACE_NORMALS | MT_HOLDS_SOLIDS | MT_HOLDS_F64,
    .ascii_abilities = MT_HOLDS_SOLIDS | MT_HOLDS_F64,
    .has_ascii = true,
    .has_binary = true,
    .sniff = sniff_stl,
    .holds_attribute = holds_attribute,
    .read = read_stl,
    .write = mt_stl_write,
};
