#include "tradeoff/triangle_blocks.h"

#include <math.h>
#include <string.h>

#define ARITY 16
#define AXIS_BITS 10
#define DIGIT_BITS 15
#define DIGIT_COUNT (1 << DIGIT_BITS)

typedef struct key {
    uint32_t code;
    mt_index triangle;
} key;

static const triangle_box no_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(triangle_box *box, const triangle_box *by)
{
    for (int axis = 0; axis < 3; axis++) {
        box->low[axis] = by->low[axis] < box->low[axis] ? by->low[axis] : box->low[axis];
        box->high[axis] = by->high[axis] > box->high[axis] ? by->high[axis] : box->high[axis];
    }
}

triangle_box triangle_box_around(const mt_vec3 p[3])
{
    triangle_box box = {
        {fmin(p[0].x, fmin(p[1].x, p[2].x)), fmin(p[0].y, fmin(p[1].y, p[2].y)), fmin(p[0].z, fmin(p[1].z, p[2].z))},
        {fmax(p[0].x, fmax(p[1].x, p[2].x)), fmax(p[0].y, fmax(p[1].y, p[2].y)), fmax(p[0].z, fmax(p[1].z, p[2].z))}};
    return box;
}

bool triangle_box_may_meet(const triangle_box *box, const mt_ray *ray, double margin)
{
    double near = 0, far = INFINITY;
    const double origin[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double along[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    for (int axis = 0; axis < 3; axis++) {
        double a = (box->low[axis] - origin[axis] - margin) / along[axis];
        double b = (box->high[axis] - origin[axis] + margin) / along[axis];
        near = fmax(near, fmin(a, b));
        far = fmin(far, fmax(a, b));
    }
    return near <= far;
}

/* False when a vertex is not finite. */
static bool measure(const mt_mesh *mesh, const mt_triangulation *triangulation, mt_index triangle, triangle_box *box)
{
    mt_vec3 p[3];
    bool is_finite = true;
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, side);
        p[side] = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
        is_finite = is_finite && mt_vec3_is_finite(p[side]);
    }
    *box = triangle_box_around(p);
    return is_finite;
}

/* A bit of each axis in turn. */
static uint32_t code_of(const triangle_box *box, const triangle_box *all)
{
    uint32_t code = 0;
    for (int axis = 0; axis < 3; axis++) {
        double size = all->high[axis] - all->low[axis];
        double share = (0.5 * box->low[axis] + 0.5 * box->high[axis] - all->low[axis]) / size;
        uint32_t cell = share > 0 && share < 1 ? (uint32_t)(share * (1 << AXIS_BITS)) : 0;
        for (int bit = 0; bit < AXIS_BITS; bit++) {
            code |= (cell >> bit & 1) << (3 * bit + axis);
        }
    }
    return code;
}

/* By one digit, keeping the order of equal ones. */
static void sort_by_digit(const key *from, key *to, mt_index count, int shift, mt_index *places)
{
    memset(places, 0, (DIGIT_COUNT + 1) * sizeof *places);
    for (mt_index i = 0; i < count; i++) {
        places[(from[i].code >> shift & (DIGIT_COUNT - 1)) + 1]++;
    }
    for (int digit = 0; digit < DIGIT_COUNT; digit++) {
        places[digit + 1] += places[digit];
    }
    for (mt_index i = 0; i < count; i++) {
        to[places[from[i].code >> shift & (DIGIT_COUNT - 1)]++] = from[i];
    }
}

static mt_index list_triangles(const mt_mesh *mesh, const mt_triangulation *triangulation, key *keys)
{
    triangle_box all = no_box, box;
    mt_index count = 0;
    for (mt_index triangle = 0; triangle < triangulation->triangle_count; triangle++) {
        if (measure(mesh, triangulation, triangle, &box)) {
            widen(&all, &box);
            keys[count++].triangle = triangle;
        }
    }
    for (mt_index i = 0; i < count; i++) {
        measure(mesh, triangulation, keys[i].triangle, &box);
        keys[i].code = code_of(&box, &all);
    }
    return count;
}

static mt_status sort_triangles(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                triangle_blocks *out)
{
    mt_index total = triangulation->triangle_count;
    key *keys = mt_allocate_array(context, total, sizeof *keys),
        *sorted = mt_allocate_array(context, total, sizeof *keys);
    mt_index *places = mt_allocate_array(context, DIGIT_COUNT + 1, sizeof *places);
    out->order = mt_allocate_array(context, total, sizeof *out->order);
    bool has_room = keys && sorted && places && out->order;
    if (has_room) {
        out->count = list_triangles(mesh, triangulation, keys);
        sort_by_digit(keys, sorted, out->count, 0, places);
        sort_by_digit(sorted, keys, out->count, DIGIT_BITS, places);
        for (mt_index i = 0; i < out->count; i++) {
            out->order[i] = keys[i].triangle;
        }
    }
    mt_free(context, keys);
    mt_free(context, sorted);
    mt_free(context, places);
    return has_room ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status make_level(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                            triangle_blocks *out, mt_index below)
{
    int level = out->level_count++;
    out->sizes[level] = (below + ARITY - 1) / ARITY;
    triangle_box *boxes = out->levels[level] = mt_allocate_array(context, out->sizes[level], sizeof *boxes), box;
    if (!boxes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < below; i++) {
        if (i % ARITY == 0) {
            boxes[i / ARITY] = no_box;
        }
        if (level == 0) {
            measure(mesh, triangulation, out->order[i], &box);
        } else {
            box = out->levels[level - 1][i];
        }
        widen(&boxes[i / ARITY], &box);
    }
    return MT_OK;
}

mt_status triangle_blocks_make(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                               triangle_blocks *out)
{
    mt_status status = sort_triangles(context, mesh, triangulation, out);
    for (mt_index below = out->count; status == MT_OK && (below > 1 || out->level_count == 0);) {
        status = make_level(context, mesh, triangulation, out, below);
        below = out->sizes[out->level_count - 1];
    }
    return status;
}

void triangle_blocks_release(mt_context *context, triangle_blocks *blocks)
{
    mt_free(context, blocks->order);
    blocks->order = NULL;
    for (int level = 0; level < blocks->level_count; level++) {
        mt_free(context, blocks->levels[level]);
    }
    blocks->level_count = 0;
}

typedef struct place {
    int level; /* of a box; -1: a triangle */
    mt_index at;
} place;

void triangle_blocks_visit(triangle_blocks *blocks, const triangle_query *query, void *user)
{
    place waiting[TRIANGLE_BLOCKS_LEVELS * ARITY];
    size_t count = 0;
    uint64_t work = 1;
    if (blocks->count > 0) {
        waiting[count++] = (place){blocks->level_count - 1, 0};
    }
    while (count > 0) {
        place p = waiting[--count];
        work++;
        if (p.level < 0) {
            query->visit(user, blocks->order[p.at]);
        } else if (query->may_hold(user, &blocks->levels[p.level][p.at])) {
            mt_index below = p.level > 0 ? blocks->sizes[p.level - 1] : blocks->count;
            for (mt_index child = ARITY; child-- > 0;) {
                if (ARITY * p.at + child < below) {
                    waiting[count++] = (place){p.level - 1, ARITY * p.at + child};
                }
            }
        }
    }
    atomic_fetch_add_explicit(&blocks->work, work, memory_order_relaxed);
}

typedef struct batch {
    void (*ask)(void *user, uint64_t begin, uint64_t end);
    void *user;
    uint64_t begin;
} batch;

static void ask_batch(void *user, uint64_t begin, uint64_t end)
{
    const batch *b = user;
    b->ask(b->user, b->begin + begin, b->begin + end);
}

size_t triangle_blocks_ask(mt_context *context, triangle_blocks *blocks, size_t count, uint64_t work,
                           void (*ask)(void *user, uint64_t begin, uint64_t end), void *user)
{
    size_t step = work / ((size_t)blocks->count + 1) + 1, asked = 0;
    uint64_t before = atomic_load(&blocks->work);
    while (asked < count && (asked == 0 || atomic_load(&blocks->work) - before < work)) {
        size_t size = step < count - asked ? step : count - asked;
        batch b = {ask, user, asked};
        mt_parallel_for(context, size, 4, ask_batch, &b);
        asked += size;
    }
    return asked;
}
