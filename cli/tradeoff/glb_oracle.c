#include "tradeoff/glb_oracle.h"

#include <jansson.h>

#include <stdint.h>

#define HEADER 12 /* of the file */
#define CHUNK 8   /* header of a chunk */
#define UNSIGNED_BYTE 5121
#define UNSIGNED_SHORT 5123

typedef struct integers {
    const uint8_t *at;
    size_t stride;
    bool are_short;
} integers;

static size_t number_at(const uint8_t *at)
{
    return at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

static size_t whole(const json_t *object, const char *key)
{
    return (size_t)json_integer_value(json_object_get(object, key));
}

/* Where the accessor's integers lie in the binary chunk; false when they do not fit it. */
static bool find_integers(const json_t *root, const uint8_t *binary, size_t size, size_t count, integers *out)
{
    const json_t *primitives = json_object_get(json_array_get(json_object_get(root, "meshes"), 0), "primitives");
    const json_t *attributes = json_object_get(json_array_get(primitives, 0), "attributes");
    const json_t *accessor = json_array_get(json_object_get(root, "accessors"), whole(attributes, "POSITION"));
    const json_t *view = json_array_get(json_object_get(root, "bufferViews"), whole(accessor, "bufferView"));
    size_t type = whole(accessor, "componentType"), begin = whole(view, "byteOffset") + whole(accessor, "byteOffset");
    out->are_short = type == UNSIGNED_SHORT;
    out->stride = whole(view, "byteStride");
    out->at = binary + begin;
    size_t item = out->are_short ? 6 : 3;
    return json_array_size(primitives) == 1 && (out->are_short || type == UNSIGNED_BYTE) && count > 0 &&
           whole(accessor, "count") == count && out->stride >= item && begin <= size &&
           (count - 1) * out->stride + item <= size - begin;
}

static double member(const json_t *node, const char *key, size_t axis, double otherwise)
{
    const json_t *array = json_object_get(node, key);
    return array ? json_number_value(json_array_get(array, axis)) : otherwise;
}

static void place(const integers *from, const json_t *node, size_t count, double *positions)
{
    for (size_t i = 0; i < 3 * count; i++) {
        const uint8_t *at = from->at + i / 3 * from->stride + i % 3 * (from->are_short ? 2 : 1);
        double step = from->are_short ? at[0] + 256.0 * at[1] : at[0];
        positions[i] = step * member(node, "scale", i % 3, 1) + member(node, "translation", i % 3, 0);
    }
}

bool glb_oracle_positions(const void *bytes, size_t size, size_t count, double *positions)
{
    const uint8_t *at = bytes;
    size_t text = size >= HEADER + CHUNK ? number_at(at + HEADER) : 0, binary = HEADER + 2 * CHUNK + text;
    if (text == 0 || text > size || binary > size) {
        return false;
    }
    json_t *root = json_loadb((const char *)at + HEADER + CHUNK, text, 0, NULL);
    const json_t *nodes = json_object_get(root, "nodes");
    integers from;
    bool found = json_array_size(nodes) == 1 && find_integers(root, at + binary, size - binary, count, &from);
    if (found) {
        place(&from, json_array_get(nodes, 0), count, positions);
    }
    json_decref(root);
    return found;
}
