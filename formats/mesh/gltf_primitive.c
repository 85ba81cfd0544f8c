/* Primitives (section 3.7.2.1): strips, fans and loops taken apart into triangles and polylines. */
#include "formats/mesh/gltf.h"

enum { POINTS, LINES, LINE_LOOP, LINE_STRIP, TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN };

/* The vertices of a primitive in their order, with those of the shape before them. */
typedef struct source {
    const mt_gltf_values *indices; /* count 0: vertices in order */
    uint64_t count;
    mt_index begin;
} source;

static mt_index vertex_at(const source *s, uint64_t i)
{
    return s->begin + (s->indices->count ? (mt_index)mt_gltf_get_index(s->indices, i) : (mt_index)i);
}

static mt_status check_indices(mt_gltf_file *file, const mt_json_node *primitive, const mt_gltf_values *indices,
                               uint64_t vertex_count)
{
    mt_json_node place = mt_json_member(primitive, "indices");
    uint32_t restart = indices->type == MT_U8 ? UINT8_MAX : indices->type == MT_U16 ? UINT16_MAX : UINT32_MAX;
    for (uint64_t i = 0; i < indices->count; i++) {
        uint32_t index = mt_gltf_get_index(indices, i);
        if (index == restart) {
            return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX,
                                "index number %llu is %u, the restart value, which glTF does not allow",
                                (unsigned long long)i, index);
        }
        if (index >= vertex_count) {
            return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX,
                                "index number %llu is %u, expected less than the %llu vertices", (unsigned long long)i,
                                index, (unsigned long long)vertex_count);
        }
    }
    return MT_OK;
}

static bool repeats(const mt_index *triangle)
{
    return triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0];
}

/* Triangle number i of a strip or fan, in the specification's order of corners. */
static void take_triangle(const source *s, unsigned mode, uint64_t i, mt_index *out)
{
    bool odd = i % 2 == 1;
    out[0] = vertex_at(s, mode == TRIANGLE_FAN ? i + 1 : i);
    out[1] = vertex_at(s, mode == TRIANGLE_FAN || odd ? i + 2 : i + 1);
    out[2] = vertex_at(s, mode == TRIANGLE_FAN ? 0 : odd ? i + 1 : i + 2);
}

/* Triangles of a strip that name a vertex twice only join its parts. */
static uint64_t take_joined(const source *s, unsigned mode, mt_index *out)
{
    uint64_t kept = 0;
    for (uint64_t i = 0; i + 2 < s->count; i++) {
        take_triangle(s, mode, i, out + 3 * kept);
        bool join = mode == TRIANGLE_STRIP && repeats(out + 3 * kept);
        kept += !join;
    }
    return 3 * kept;
}

/* How many vertices stay when elements have `size`; says when some are left over. */
static uint64_t whole_elements(mt_gltf_file *file, const mt_json_node *primitive, uint64_t count, unsigned size)
{
    if (count % size != 0) {
        char path[MT_JSON_PATH];
        mt_json_path(primitive, path);
        mt_warn(file->context, "%s: %s: %llu vertices at the end make no %s and are left out",
                mt_input_name(file->input), path, (unsigned long long)(count % size), size == 3 ? "triangle" : "line");
    }
    return count / size * size;
}

/* Room that the vertices of a primitive take once it is apart. */
static uint64_t room_of(unsigned mode, uint64_t count)
{
    if (mode == TRIANGLE_STRIP || mode == TRIANGLE_FAN) {
        return count < 3 ? 3 : 3 * (count - 2);
    }
    return mode == LINE_LOOP ? count + 1 : count;
}

static void take_apart(mt_gltf_file *file, const mt_json_node *primitive, const source *s, unsigned mode,
                       mt_gltf_elements *out)
{
    static const unsigned corner_counts[] = {[POINTS] = 1,    [LINES] = 2,          [LINE_LOOP] = 0,   [LINE_STRIP] = 0,
                                             [TRIANGLES] = 3, [TRIANGLE_STRIP] = 3, [TRIANGLE_FAN] = 3};
    out->corner_count = corner_counts[mode];
    if (mode == TRIANGLE_STRIP || mode == TRIANGLE_FAN) {
        out->count = take_joined(s, mode, out->vertices);
        return;
    }
    out->count = out->corner_count > 1 ? whole_elements(file, primitive, s->count, out->corner_count) : s->count;
    for (uint64_t i = 0; i < out->count; i++) {
        out->vertices[i] = vertex_at(s, i);
    }
    if (out->corner_count == 0 && s->count < 2) {
        out->count = 0;
    } else if (mode == LINE_LOOP) {
        out->vertices[out->count++] = vertex_at(s, 0);
    }
}

mt_status mt_gltf_take_apart(mt_gltf_file *file, const mt_json_node *primitive, unsigned mode,
                             const mt_gltf_values *indices, const mt_gltf_vertices *set, mt_gltf_elements *out)
{
    if (set->begin + set->positions.count > MT_INDEX_MAX) {
        return mt_json_fail(file->context, primitive, MT_ERROR_TOO_LARGE,
                            "the mesh has more vertices than can be held");
    }
    mt_status status = check_indices(file, primitive, indices, set->positions.count);
    if (status != MT_OK) {
        return status;
    }
    file->decoded += room_of(mode, indices->count ? indices->count : set->positions.count);
    status = mt_gltf_justify(file, file->decoded);
    if (status != MT_OK) {
        return status;
    }
    source s = {indices, indices->count ? indices->count : set->positions.count, (mt_index)set->begin};
    out->vertices = mt_gltf_allocate(file, room_of(mode, s.count), sizeof *out->vertices);
    if (!out->vertices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    take_apart(file, primitive, &s, mode, out);
    return MT_OK;
}
