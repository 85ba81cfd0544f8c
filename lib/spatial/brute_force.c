/* No structure: every ray is asked of every triangle. What the others are held to, and the quickest for a few. */
#include "lib/spatial/packed_triangles.h"

static mt_status create(mt_context *context, const mt_ray_source *source, void **body)
{
    mt_packed_triangles *triangles = mt_allocate_zeroed(context, sizeof *triangles);
    *body = triangles;
    if (!triangles) {
        return mt_context_error(context)->status;
    }
    int part = mt_part_begin(context, "packed triangles", "every ray meets every triangle");
    mt_status status = mt_packed_triangles_init(context, source, triangles);
    mt_part_end(context, part);
    return status;
}

static void destroy(mt_context *context, void *body)
{
    mt_packed_triangles_release(context, body);
    mt_free(context, body);
}

static mt_status validate(mt_context *context, const void *body)
{
    return mt_packed_triangles_validate(context, body);
}

static uint64_t size(const void *body)
{
    return sizeof(mt_packed_triangles) + mt_packed_triangles_size(body);
}

static bool find_hit(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    mt_ray_search search;
    if (mt_ray_search_init(body, ray, profile, any, &search)) {
        mt_ray_search_try_all(&search);
    }
    *hit = search.best;
    return hit->triangle != MT_NONE;
}

const mt_ray_structure_record mt_ray_structure_none = {"none", create, destroy, validate, size, find_hit};
