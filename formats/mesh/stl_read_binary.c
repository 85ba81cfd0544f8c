/* Binary STL: 80 bytes of anything, a count, and facets of 50 bytes: a normal, three corners, two attribute bytes. All
 * facets are read in parallel blocks. Attribute bytes and normals are fetched by a second reading, only where they say
 * something. */
#include "formats/mesh/stl_facets.h"

#include <stdatomic.h>
#include <string.h>

#define BLOCK_FACETS 1280u /* 64,000 bytes, which stay in the cache */

typedef struct binary_reader {
    mt_context *context;
    const mt_input *input;
    mt_mesh *mesh;
    uint16_t *attributes; /* to fetch, or NULL */
    float *normals;       /* to fetch, or NULL */
    uint64_t facet_count;
    atomic_bool unreadable; /* some block could not be read */
    atomic_bool has_attributes;
    atomic_uint_fast64_t contradicting; /* normals; a sum of whole numbers does not depend on its order */
} binary_reader;

/* The numbers of a file are little-endian. */
static inline uint32_t load_u32(const uint8_t *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static inline float load_float(const uint8_t *at)
{
    uint32_t bits = load_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Reads the facets of a block into `bytes`; false when that failed. */
static bool read_block(binary_reader *r, uint64_t begin, uint64_t end, uint8_t *bytes)
{
    size_t size = (size_t)(end - begin) * STL_FACET_SIZE;
    if (mt_input_read_at(r->input, STL_PREFIX_SIZE + begin * STL_FACET_SIZE, bytes, size) == size) {
        return true;
    }
    atomic_store(&r->unreadable, true);
    return false;
}

static void read_corners(void *user, uint64_t begin, uint64_t end)
{
    binary_reader *r = user;
    uint8_t bytes[BLOCK_FACETS * STL_FACET_SIZE];
    if (!read_block(r, begin, end, bytes)) {
        return;
    }
    float *positions = (float *)r->mesh->positions + 9 * begin;
    unsigned attributes = 0, contradicting = 0;
    for (uint64_t i = 0; i < end - begin; i++) {
        const uint8_t *facet = bytes + i * STL_FACET_SIZE;
        double normal[3], corners[9];
        for (size_t j = 0; j < 3; j++) {
            normal[j] = (double)load_float(facet + 4 * j);
        }
        for (size_t j = 0; j < 9; j++) {
            positions[9 * i + j] = load_float(facet + 12 + 4 * j);
            corners[j] = (double)positions[9 * i + j];
        }
        attributes |= (unsigned)facet[48] | facet[49];
        contradicting += mt_stl_normal_contradicts(normal, corners);
    }
    if (attributes) {
        atomic_store_explicit(&r->has_attributes, true, memory_order_relaxed);
    }
    if (contradicting) {
        atomic_fetch_add_explicit(&r->contradicting, contradicting, memory_order_relaxed);
    }
}

static void read_extras(void *user, uint64_t begin, uint64_t end)
{
    binary_reader *r = user;
    uint8_t bytes[BLOCK_FACETS * STL_FACET_SIZE];
    if (!read_block(r, begin, end, bytes)) {
        return;
    }
    for (uint64_t i = begin; i < end; i++) {
        const uint8_t *facet = bytes + (i - begin) * STL_FACET_SIZE;
        for (size_t j = 0; r->normals && j < 3; j++) {
            r->normals[3 * i + j] = load_float(facet + 4 * j);
        }
        if (r->attributes) {
            r->attributes[i] = (uint16_t)(facet[48] | facet[49] << 8);
        }
    }
}

static mt_status run(binary_reader *r, mt_parallel_body body)
{
    mt_parallel_for(r->context, r->facet_count, BLOCK_FACETS, body, r);
    return atomic_load(&r->unreadable) ? mt_input_fail_read_at(r->context, r->input, STL_PREFIX_SIZE) : MT_OK;
}

/* The count of facets, which the bytes present must justify. */
static mt_status read_count(mt_context *context, mt_input *input, uint64_t *count)
{
    uint8_t prefix[STL_PREFIX_SIZE];
    mt_status status = mt_input_read_exactly(context, input, prefix, sizeof prefix,
                                             "84 bytes of header of a binary STL file (an ASCII one begins with "
                                             "\"solid\")");
    if (status != MT_OK) {
        return status;
    }
    *count = load_u32(prefix + STL_HEADER_SIZE);
    uint64_t left = mt_input_size(input) - STL_PREFIX_SIZE;
    if (*count * STL_FACET_SIZE > left) {
        return mt_fail_at(
            context, MT_ERROR_SYNTAX, mt_input_place_offset(input, STL_HEADER_SIZE),
            "the header declares %llu facets of 50 bytes, but only %llu bytes follow (binary STL; an ASCII "
            "file would begin with \"solid\")",
            (unsigned long long)*count, (unsigned long long)left);
    }
    if (*count * STL_FACET_SIZE < left) {
        mt_warn(context, "%s: %llu bytes after the last facet are ignored", mt_input_name(input),
                (unsigned long long)(left - *count * STL_FACET_SIZE));
    }
    return MT_OK;
}

static mt_status add_extras(binary_reader *r)
{
    mt_attribute *attribute;
    mt_status status = MT_OK;
    if (atomic_load(&r->contradicting)) {
        status = mt_stl_add_normals(r->context, r->input, r->mesh, atomic_load(&r->contradicting), &attribute);
        r->normals = status == MT_OK ? attribute->values : NULL;
    }
    if (status == MT_OK && atomic_load(&r->has_attributes)) {
        mt_attribute_layout layout = {.name = STL_ATTRIBUTE,
                                      .semantic = MT_SEMANTIC_GENERIC,
                                      .domain = MT_DOMAIN_FACE,
                                      .type = MT_U16,
                                      .component_count = 1,
                                      .value_count = r->facet_count};
        status = mt_mesh_add_attribute(r->context, r->mesh, &layout, &attribute);
        r->attributes = status == MT_OK ? attribute->values : NULL;
    }
    return status == MT_OK && (r->normals || r->attributes) ? run(r, read_extras) : status;
}

mt_status mt_stl_read_binary(mt_context *context, mt_input *input, mt_mesh **out)
{
    binary_reader r = {.context = context, .input = input};
    *out = NULL;
    mt_status status = read_count(context, input, &r.facet_count);
    if (status == MT_OK) {
        status = mt_stl_create(context, r.facet_count, MT_F32, &r.mesh);
    }
    if (status == MT_OK) {
        status = run(&r, read_corners);
    }
    if (status == MT_OK) {
        status = mt_stl_weld(context, r.mesh);
    }
    if (status == MT_OK) {
        status = add_extras(&r);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, r.mesh);
        return status;
    }
    *out = r.mesh;
    return MT_OK;
}
