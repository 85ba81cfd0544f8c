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

static void bound(mt_packed_triangles *triangles)
{
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (mt_index i = 0; i < triangles->count; i++) {
            for (int corner = 0; corner < 3; corner++) {
                float x = triangles->items[i].rows[axis][corner];
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
        }
        triangles->lower[axis] = low;
        triangles->upper[axis] = high;
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
    bound(triangles);
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

static bool is_same(const mt_packed_triangle *a, const mt_packed_triangle *b)
{
    for (int i = 0; i < 12; i++) {
        if (a->rows[i / 4][i % 4] != b->rows[i / 4][i % 4]) {
            return false;
        }
    }
    return true;
}

/* Marks each number once, with what is not finite; false for a stranger, a double or another place. */
static bool mark_all(const mt_packed_triangles *triangles, uint8_t *seen)
{
    mt_index all = triangles->source.triangulation->triangle_count;
    mt_packed_triangle item;
    for (mt_index i = 0; i < triangles->count; i++) {
        mt_index number = triangles->numbers[i];
        if (number >= all || seen[number]++ || !pack(&triangles->source, number, &item) ||
            !is_same(&item, &triangles->items[i])) {
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

bool mt_ray_search_enter(const mt_ray_search *search, double *enter, double *leave)
{
    const mt_ray_setup *setup = &search->setup;
    double nearness = fmax(MT_RAY_NEARNESS, 2 * (double)setup->slack);
    double enters = search->begin, leaves = search->limit;
    for (int i = 0; i < 3; i++) {
        double low = (double)search->triangles->lower[setup->axes[i]] - nearness;
        double high = (double)search->triangles->upper[setup->axes[i]] + nearness;
        double reciprocal = 1 / setup->direction[i];
        double to_low = (low - setup->origin[i]) * reciprocal, to_high = (high - setup->origin[i]) * reciprocal;
        double near = signbit(setup->direction[i]) ? to_high : to_low;
        double far = signbit(setup->direction[i]) ? to_low : to_high;
        enters = near > enters ? near : enters;
        leaves = far < leaves ? far : leaves;
    }
    *enter = enters;
    *leave = leaves;
    return enters <= leaves;
}

void mt_ray_search_try_all(mt_ray_search *search)
{
    for (mt_index at = 0; at < search->triangles->count && !mt_ray_search_try(search, at); at++) {
    }
}

bool mt_places_are_rising(const mt_index *places, uint64_t count, mt_index end)
{
    for (uint64_t i = 0; i < count; i++) {
        if (places[i] >= end || (i && places[i - 1] >= places[i])) {
            return false;
        }
    }
    return true;
}

bool mt_places_hold(const mt_index *places, uint64_t count, mt_index place)
{
    uint64_t begin = 0, end = count;
    while (begin < end) {
        uint64_t middle = begin + (end - begin) / 2;
        if (places[middle] < place) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin < count && places[begin] == place;
}

void mt_packed_triangle_sample(const mt_packed_triangle *triangle, int sample, double point[3])
{
    static const double weights[MT_PACKED_SAMPLES][3] = {{1, 0, 0},     {0, 1, 0},     {0, 0, 1},      {0.5, 0.5, 0},
                                                         {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.3, 0.3, 0.4}};
    for (int axis = 0; axis < 3; axis++) {
        point[axis] = 0;
        for (int corner = 0; corner < 3; corner++) {
            point[axis] += weights[sample][corner] * (double)triangle->rows[axis][corner];
        }
    }
}
