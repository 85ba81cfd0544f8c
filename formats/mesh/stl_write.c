/* Facets are formatted in parallel blocks and written in order. */
#include "formats/mesh/stl_facets.h"
#include "formats/mesh/values.h"
#include "formats/stream/lines.h"

#include <meshtool/triangulate.h>

#include <math.h>
#include <stdatomic.h>
#include <string.h>

#define BLOCK_FACETS 8192u
#define ASCII_FACET_ROOM 768 /* bytes: twelve numbers and the words around them */

typedef struct stl_writer {
    mt_context *context;
    const mt_mesh *mesh;
    unsigned digits;
    mt_triangulation triangulation;
    const mt_attribute *normals;    /* of the faces, or NULL: they follow from the corners */
    const mt_attribute *attributes; /* the attribute bytes, or NULL */
    const mt_labels *solids;
    atomic_uint_fast64_t overflowed; /* coordinates past the range of single precision */
} stl_writer;

typedef struct facet {
    mt_index face;
    mt_index vertices[3];
    mt_vec3 corners[3];
    float normal[3];
} facet;

/* Where the squared length of the product is outside of this, the sides are scaled by a power of two first, so that
 * nothing over- or underflows. 0 0 0 where there is no normal. */
#define SAFE_LEAST 1e-200
#define SAFE_MOST 1e200

static void compute_normal(facet *f)
{
    mt_vec3 u = mt_vec3_subtract(f->corners[1], f->corners[0]), v = mt_vec3_subtract(f->corners[2], f->corners[0]);
    mt_vec3 n = mt_vec3_cross(u, v);
    double square = mt_vec3_dot(n, n);
    if (square > SAFE_LEAST && square < SAFE_MOST) {
        n = mt_vec3_scale(n, 1.0 / sqrt(square));
    } else {
        double scale = mt_power_of_two_scale(fmax(mt_vec3_max_abs(u), mt_vec3_max_abs(v)));
        n = mt_vec3_normalize(mt_vec3_cross(mt_vec3_scale(u, scale), mt_vec3_scale(v, scale)));
    }
    f->normal[0] = (float)n.x + 0.0f; /* no minus zeros */
    f->normal[1] = (float)n.y + 0.0f;
    f->normal[2] = (float)n.z + 0.0f;
}

static void find_normal(const stl_writer *w, facet *f)
{
    mt_index value = w->normals ? mt_attribute_value_index(w->normals, f->face) : MT_NONE;
    if (value == MT_NONE) {
        compute_normal(f);
        return;
    }
    for (uint32_t i = 0; i < 3; i++) {
        f->normal[i] = (float)mt_attribute_get(w->normals, value, i);
    }
}

static facet find_facet(const stl_writer *w, mt_index triangle)
{
    facet f = {.face = mt_triangulation_face(&w->triangulation, triangle)};
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&w->triangulation, triangle, side);
        f.vertices[side] = w->mesh->corner_vertices[corner];
        f.corners[side] = mt_mesh_position(w->mesh, f.vertices[side]);
    }
    return f;
}

static inline void put_u32(char *to, uint32_t bits)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (char)(bits >> 8 * i & 0xff);
    }
}

static inline void put_float(char *to, float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    put_u32(to, bits);
}

/* A coordinate in single precision; counts it when it becomes infinite. */
static inline float narrow(double number, unsigned *overflowed)
{
    float single = (float)number;
    *overflowed += isinf(single) && !isinf(number);
    return single;
}

static void put_binary_facet(const stl_writer *w, mt_index triangle, char *to, unsigned *overflowed)
{
    facet f = find_facet(w, triangle);
    for (size_t i = 0; i < 3; i++) {
        const float p[] = {narrow(f.corners[i].x, overflowed), narrow(f.corners[i].y, overflowed),
                           narrow(f.corners[i].z, overflowed)};
        for (size_t j = 0; j < 3; j++) {
            put_float(to + 12 + 12 * i + 4 * j, p[j]);
        }
        /* The normal is that of the numbers written. */
        f.corners[i] = mt_vec3_make((double)p[0], (double)p[1], (double)p[2]);
    }
    find_normal(w, &f);
    for (size_t i = 0; i < 3; i++) {
        put_float(to + 4 * i, f.normal[i]);
    }
    uint16_t attribute = 0;
    mt_index value = w->attributes ? mt_attribute_value_index(w->attributes, f.face) : MT_NONE;
    if (value != MT_NONE) {
        attribute = ((const uint16_t *)w->attributes->values)[value];
    }
    to[48] = (char)(attribute & 0xff);
    to[49] = (char)(attribute >> 8);
}

static void put_binary_facets(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    stl_writer *w = user;
    unsigned overflowed = 0;
    char *at = mt_lines_reserve(lines, (size_t)(end - begin) * STL_FACET_SIZE);
    if (!at) {
        return;
    }
    for (uint64_t triangle = begin; triangle < end; triangle++) {
        put_binary_facet(w, (mt_index)triangle, at, &overflowed);
        at += STL_FACET_SIZE;
    }
    lines->size = (size_t)(at - lines->bytes);
    if (overflowed) {
        atomic_fetch_add_explicit(&w->overflowed, overflowed, memory_order_relaxed);
    }
}

static inline char *append(char *at, const char *text, size_t length)
{
    memcpy(at, text, length);
    return at + length;
}

#define APPEND(at, literal) append(at, literal, sizeof literal - 1)

static char *put_ascii_facet(const stl_writer *w, mt_index triangle, char *at)
{
    facet f = find_facet(w, triangle);
    find_normal(w, &f);
    at = APPEND(at, " facet normal");
    for (int i = 0; i < 3; i++) {
        *at++ = ' ';
        at = mt_put_float(at, f.normal[i]);
    }
    at = APPEND(at, "\n  outer loop\n");
    for (int i = 0; i < 3; i++) {
        at = APPEND(at, "   vertex");
        at = mt_put_position(at, w->mesh, f.vertices[i], w->digits);
        *at++ = '\n';
    }
    return APPEND(at, "  endloop\n endfacet\n");
}

/* "solid NAME" or "endsolid NAME"; a name lasts to the end of its line. */
static void put_name(mt_lines *lines, const char *word, const char *name)
{
    size_t word_length = strlen(word), length = strlen(name);
    char *at = mt_lines_reserve(lines, word_length + length + 2);
    if (!at) {
        return;
    }
    at = append(at, word, word_length);
    if (length) {
        *at++ = ' ';
    }
    for (size_t i = 0; i < length; i++) {
        *at++ = name[i] == '\n' || name[i] == '\r' ? ' ' : name[i];
    }
    *at++ = '\n';
    lines->size = (size_t)(at - lines->bytes);
}

static mt_index label_of(const stl_writer *w, uint64_t triangle)
{
    return w->solids ? w->solids->face_labels[mt_triangulation_face(&w->triangulation, (mt_index)triangle)] : MT_NONE;
}

static const char *name_of(const stl_writer *w, mt_index label)
{
    return label == MT_NONE ? "" : w->solids->names[label];
}

/* A solid for every run of facets of one label: the order of the facets stays. */
static void put_ascii_facets(void *user, mt_lines *lines, uint64_t begin, uint64_t end)
{
    const stl_writer *w = user;
    for (uint64_t triangle = begin; triangle < end; triangle++) {
        mt_index label = label_of(w, triangle), before = triangle ? label_of(w, triangle - 1) : label;
        if (label != before) {
            put_name(lines, "endsolid", name_of(w, before));
            put_name(lines, "solid", name_of(w, label));
        }
        char *at = mt_lines_reserve(lines, ASCII_FACET_ROOM);
        if (!at) {
            return;
        }
        lines->size = (size_t)(put_ascii_facet(w, (mt_index)triangle, at) - lines->bytes);
    }
}

static mt_status put_end(const stl_writer *w, mt_output *output, const char *word, uint64_t triangle)
{
    mt_lines lines = {.context = w->context};
    put_name(&lines, word, w->triangulation.triangle_count ? name_of(w, label_of(w, triangle)) : "");
    mt_status status = lines.failed ? mt_fail(w->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while writing")
                                    : mt_output_write(w->context, output, lines.bytes, lines.size);
    mt_free(w->context, lines.bytes);
    return status;
}

static mt_status put_ascii(stl_writer *w, mt_output *output)
{
    uint64_t count = w->triangulation.triangle_count;
    mt_status status = put_end(w, output, "solid", 0);
    if (status == MT_OK) {
        status = mt_lines_write(w->context, output, count, BLOCK_FACETS, put_ascii_facets, w);
    }
    return status == MT_OK ? put_end(w, output, "endsolid", count - 1) : status;
}

static mt_status put_binary(stl_writer *w, mt_output *output)
{
    char prefix[STL_PREFIX_SIZE] = "binary STL by meshtool"; /* must not begin with "solid" */
    put_u32(prefix + STL_HEADER_SIZE, w->triangulation.triangle_count);
    mt_status status = mt_output_write(w->context, output, prefix, sizeof prefix);
    if (status == MT_OK) {
        status =
            mt_lines_write(w->context, output, w->triangulation.triangle_count, BLOCK_FACETS, put_binary_facets, w);
    }
    uint64_t overflowed = atomic_load(&w->overflowed);
    if (status == MT_OK && overflowed) {
        mt_warn(w->context, "%llu coordinates are too large for single precision and became infinite",
                (unsigned long long)overflowed);
    }
    return status;
}

mt_status mt_stl_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output)
{
    stl_writer w = {.context = context,
                    .mesh = mesh,
                    .digits = options->digits,
                    .normals = mt_stl_normals(mesh),
                    .attributes = mt_stl_attributes(mesh),
                    .solids = mt_mesh_find_labels(mesh, MT_LABEL_SOLID)};
    mt_status status = mt_triangulation_init(context, mesh, &w.triangulation);
    if (status == MT_OK) {
        status = options->encoding == MT_ENCODING_ASCII ? put_ascii(&w, output) : put_binary(&w, output);
        mt_triangulation_release(context, &w.triangulation);
    }
    return status;
}
