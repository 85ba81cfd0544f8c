/* Packing triangles, and deciding on one. */
#include "lib/spatial/packed_triangles.h"

#define BLOCK_SIZE 16384

typedef struct packing {
    const mt_ray_source *source;
    mt_packed_triangle *items;
    mt_index *numbers; /* MT_NONE: not finite */
} packing;

static bool pack(const mt_ray_source *source, mt_index number, mt_packed_triangle *item)
{
    mt_ray_triangle triangle;
    double sum = 0;
    mt_ray_triangle_load(&source->space, source->mesh, source->triangulation, number, MT_RAY_WATERTIGHT, &triangle);
    for (int corner = 0; corner < 4; corner++) {
        const double *from = triangle.corners[corner == 3 ? 0 : corner];
        for (int axis = 0; axis < 3; axis++) {
            item->rows[axis][corner] = (float)from[axis];
            sum += from[axis]; /* space keeps finite points within 2 */
        }
    }
    return isfinite(sum);
}

static void pack_block(void *user, uint64_t begin, uint64_t end)
{
    const packing *job = user;
    for (uint64_t i = begin; i < end; i++) {
        bool is_finite = pack(job->source, (mt_index)i, &job->items[i]);
        job->numbers[i] = is_finite ? (mt_index)i : MT_NONE;
    }
}

static void drop_left_out(mt_packed_triangles *triangles, mt_index count)
{
    for (mt_index i = 0; i < count; i++) {
        if (triangles->numbers[i] != MT_NONE) {
            triangles->items[triangles->count] = triangles->items[i];
            triangles->numbers[triangles->count++] = triangles->numbers[i];
        }
    }
}

mt_status mt_packed_triangles_init(mt_context *context, const mt_ray_source *source, mt_packed_triangles *triangles)
{
    mt_index count = source->triangulation->triangle_count;
    *triangles = (mt_packed_triangles){.source = *source};
    triangles->items = mt_allocate_array(context, count, sizeof *triangles->items);
    triangles->numbers = mt_allocate_array(context, count, sizeof *triangles->numbers);
    if (!triangles->items || !triangles->numbers) {
        mt_packed_triangles_release(context, triangles);
        return mt_context_error(context)->status;
    }
    packing job = {source, triangles->items, triangles->numbers};
    mt_parallel_for(context, count, BLOCK_SIZE, pack_block, &job);
    drop_left_out(triangles, count);
    return MT_OK;
}

void mt_packed_triangles_release(mt_context *context, mt_packed_triangles *triangles)
{
    mt_free(context, triangles->items);
    mt_free(context, triangles->numbers);
    *triangles = (mt_packed_triangles){.count = 0};
}

uint64_t mt_packed_triangles_size(const mt_packed_triangles *triangles)
{
    return triangles->source.triangulation->triangle_count *
           (uint64_t)(sizeof *triangles->items + sizeof *triangles->numbers);
}

/* Marks each number once, with what is not finite; false for a stranger, a double or another place. */
static bool mark_all(const mt_packed_triangles *triangles, uint8_t *seen)
{
    mt_index all = triangles->source.triangulation->triangle_count;
    mt_packed_triangle item;
    for (mt_index i = 0; i < triangles->count; i++) {
        mt_index number = triangles->numbers[i];
        if (number >= all || seen[number]++ || !pack(&triangles->source, number, &item) ||
            memcmp(&item, &triangles->items[i], sizeof item) != 0) {
            return false;
        }
    }
    for (mt_index number = 0; number < all; number++) {
        if (!seen[number] && pack(&triangles->source, number, &item)) {
            return false;
        }
    }
    return true;
}

mt_status mt_packed_triangles_validate(mt_context *context, const mt_packed_triangles *triangles)
{
    uint8_t *seen = mt_allocate_array_zeroed(context, triangles->source.triangulation->triangle_count, 1);
    if (!seen) {
        return mt_context_error(context)->status;
    }
    bool is_sound = mark_all(triangles, seen);
    mt_free(context, seen);
    return is_sound ? MT_OK : mt_fail(context, MT_ERROR_INTERNAL, "a structure for rays lacks some of its triangles");
}

/* Parameters in space not below and not above that of t. An infinite or unknown one stays so, and ends nothing. */
static double widened(const mt_ray_setup *setup, double t, double sign)
{
    double parameter = t * setup->parameter_factor - setup->begin;
    return parameter + sign * (fabs(parameter) + setup->begin) * 0x1p-50;
}

bool mt_ray_search_init(const mt_packed_triangles *triangles, const mt_ray *ray, mt_ray_profile profile, bool any,
                        mt_ray_search *search)
{
    search->triangles = triangles;
    search->any = any;
    search->best = mt_ray_no_hit();
    mt_ray_setup_init(&triangles->source.space, ray, profile, &search->setup);
    if (!search->setup.valid || !triangles->count) {
        return false;
    }
    search->begin = widened(&search->setup, search->setup.t_minimum, -1);
    search->limit = widened(&search->setup, search->setup.t_maximum, 1);
    return true;
}

bool mt_ray_search_decide(mt_ray_search *search, mt_index at)
{
    const mt_packed_triangles *triangles = search->triangles;
    const mt_ray_source *source = &triangles->source;
    mt_index number = triangles->numbers[at];
    mt_ray_triangle triangle;
    mt_ray_hit hit;
    if (search->setup.profile == MT_RAY_EXACT) {
        mt_ray_triangle_load(&source->space, source->mesh, source->triangulation, number, MT_RAY_EXACT, &triangle);
    } else {
        for (int corner = 0; corner < 3; corner++) {
            for (int axis = 0; axis < 3; axis++) {
                triangle.corners[corner][axis] = (double)triangles->items[at].rows[axis][corner];
            }
        }
    }
    if (!mt_ray_hit_triangle(&search->setup, &triangle, number, &hit) || !mt_ray_hit_is_nearer(&hit, &search->best)) {
        return false;
    }
    search->best = hit;
    search->limit = widened(&search->setup, hit.t, 1);
    return search->any;
}
