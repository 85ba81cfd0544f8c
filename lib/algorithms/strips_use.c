/* What is done with strips: the triangles that they draw, and what a vertex cache makes of them. */
#include <meshtool/strips.h>

#include <string.h>

static bool names_vertex_twice(mt_index a, mt_index b, mt_index c)
{
    return a == b || b == c || c == a;
}

static mt_index unfold(const mt_index *indices, mt_index count, bool is_fan, mt_index *triangles)
{
    mt_index found = 0;
    for (mt_index i = 2; i < count; i++) {
        bool odd = !is_fan && i % 2;
        mt_index a = indices[is_fan ? 0 : odd ? i - 1 : i - 2], b = indices[odd ? i - 2 : i - 1], c = indices[i];
        if (count == 3 || !names_vertex_twice(a, b, c)) {
            mt_index *triangle = triangles + 3 * (size_t)found++;
            triangle[0] = a;
            triangle[1] = b;
            triangle[2] = c;
        }
    }
    return found;
}

mt_status mt_strips_triangles(mt_context *context, const mt_strips *strips, mt_index **triangles, mt_index *count)
{
    *triangles = mt_allocate_array(context, strips->triangle_count, 3 * sizeof(mt_index));
    *count = 0;
    if (!*triangles) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < strips->strip_count; i++) {
        mt_index begin = strips->offsets[i], end = strips->offsets[i + 1];
        mt_index *at = *triangles + 3 * (size_t)*count;
        *count += unfold(strips->indices + begin, end - begin, i >= strips->fan_begin, at);
    }
    return MT_OK;
}

/* A vertex is in the cache when fewer misses than the cache holds came after its own. */
static uint64_t count_misses(const mt_strips *strips, mt_index cache_size, uint64_t *missed_at, uint64_t *used_count)
{
    uint64_t misses = 0;
    mt_index index_count = strips->offsets[strips->strip_count];
    *used_count = 0;
    for (mt_index i = 0; i < index_count; i++) {
        uint64_t *at = &missed_at[strips->indices[i]];
        if (*at == 0 || misses - *at >= cache_size) {
            *used_count += *at == 0;
            *at = ++misses;
        }
    }
    return misses;
}

mt_status mt_strips_cache_use(mt_context *context, const mt_strips *strips, mt_index cache_size, mt_cache_use *out)
{
    *out = (mt_cache_use){0};
    mt_index index_count = strips->offsets[strips->strip_count], vertex_count = 0;
    for (mt_index i = 0; i < index_count; i++) {
        vertex_count = strips->indices[i] >= vertex_count ? strips->indices[i] + 1 : vertex_count;
    }
    uint64_t *missed_at = mt_allocate_array_zeroed(context, vertex_count, sizeof *missed_at);
    if (!missed_at) {
        return mt_context_error(context)->status;
    }
    uint64_t used_count;
    out->miss_count = count_misses(strips, cache_size, missed_at, &used_count);
    mt_free(context, missed_at);
    if (strips->triangle_count) {
        out->acmr = (double)out->miss_count / strips->triangle_count;
    }
    if (used_count) {
        out->atvr = (double)out->miss_count / (double)used_count;
    }
    return MT_OK;
}
