/* What rays search. All structures find the same hits; they differ in what they take to build, to keep and to search,
 * so that the number of rays decides which of them pays. */
#include "tradeoff/random.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/ray_structure.h>

#include <math.h>
#include <stdio.h>
#include <time.h>

#define RAY_COUNT 50000
/* Triangles that brute force is asked about in all. */
#define ORACLE_WORK 20000000U
#define ORACLE_RAYS 2000U

static const char *const levels[] = {"aabb", "obb", "grid", "bsp", NULL};
static const mt_ray_structure_kind kinds[] = {MT_RAY_STRUCTURE_AABB, MT_RAY_STRUCTURE_OBB, MT_RAY_STRUCTURE_GRID,
                                              MT_RAY_STRUCTURE_BSP};

typedef struct structure_state {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    mt_ray *rays;
    mt_ray_hit *hits, *oracle;
    size_t oracle_count;
    double brute_seconds; /* a ray, without a structure */
    const mt_ray_structure *searched;
    mt_ray_structure *structure;
    double build_seconds, trace_seconds;
} structure_state;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static void aim(structure_state *s, double diagonal)
{
    mt_bounds bounds = mt_mesh_bounds(s->mesh);
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    tradeoff_random random = {3};
    for (size_t i = 0; i < RAY_COUNT; i++) {
        mt_vec3 at = bounds.minimum, direction = tradeoff_random_direction(&random);
        at.x += size.x * tradeoff_random_unit(&random);
        at.y += size.y * tradeoff_random_unit(&random);
        at.z += size.z * tradeoff_random_unit(&random);
        s->rays[i] = mt_ray_make(mt_vec3_subtract(at, mt_vec3_scale(direction, diagonal)), direction);
    }
}

static void trace(void *user, uint64_t begin, uint64_t end)
{
    const structure_state *s = user;
    for (uint64_t i = begin; i < end; i++) {
        if (!mt_ray_structure_nearest_hit(s->searched, &s->rays[i], MT_RAY_WATERTIGHT, &s->hits[i])) {
            s->hits[i] = mt_ray_no_hit();
        }
    }
}

/* Brute force is what every structure is held to, and what it is to be faster than. */
static mt_status ask_brute_force(structure_state *s, mt_context *context)
{
    mt_ray_structure *none = NULL;
    mt_status status = mt_ray_structure_create(context, s->mesh, &s->triangulation, MT_RAY_STRUCTURE_NONE, &none);
    size_t count = ORACLE_WORK / (s->triangulation.triangle_count + 1) + 1;
    s->oracle_count = count < ORACLE_RAYS ? count : ORACLE_RAYS;
    if (status == MT_OK) {
        double begin = now();
        s->searched = none;
        mt_parallel_for(context, s->oracle_count, 16, trace, s);
        s->brute_seconds = (now() - begin) / (double)s->oracle_count;
        for (size_t i = 0; i < s->oracle_count; i++) {
            s->oracle[i] = s->hits[i];
        }
    }
    mt_ray_structure_destroy(context, none);
    return status;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces for rays to meet";
        return MT_OK;
    }
    structure_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    mt_status status = mt_triangulation_init(context, subject->mesh, &s->triangulation);
    if (status != MT_OK) {
        return status;
    }
    s->rays = mt_allocate_array(context, RAY_COUNT, sizeof *s->rays);
    s->hits = mt_allocate_array(context, RAY_COUNT, sizeof *s->hits);
    s->oracle = mt_allocate_array(context, ORACLE_RAYS, sizeof *s->oracle);
    if (!s->rays || !s->hits || !s->oracle) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    aim(s, subject->diagonal);
    return ask_brute_force(s, context);
}

static void release(void *state, mt_context *context)
{
    structure_state *s = state;
    mt_free(context, s->rays);
    mt_free(context, s->hits);
    mt_free(context, s->oracle);
    mt_triangulation_release(context, &s->triangulation);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    structure_state *s = state;
    double begin = now();
    mt_status status = mt_ray_structure_create(context, s->mesh, &s->triangulation, kinds[level], &s->structure);
    if (status != MT_OK) {
        return status;
    }
    s->build_seconds = now() - begin;
    s->searched = s->structure;
    mt_parallel_for(context, RAY_COUNT, 512, trace, s);
    s->trace_seconds = now() - begin - s->build_seconds;
    return MT_OK;
}

static void discard(void *state, mt_context *context)
{
    structure_state *s = state;
    mt_ray_structure_destroy(context, s->structure);
    s->structure = NULL;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    (void)level;
    const structure_state *s = state;
    size_t differing = 0;
    for (size_t i = 0; i < s->oracle_count; i++) {
        differing += s->hits[i].triangle != s->oracle[i].triangle || s->hits[i].t != s->oracle[i].t;
    }
    double a_ray = s->trace_seconds / RAY_COUNT, gain = s->brute_seconds - a_ray;
    double pays = gain > 0 ? ceil(s->build_seconds / gain) : (double)INFINITY;
    tradeoff_add_error(row, "differing_rays", (double)differing);
    tradeoff_add_size(row, "build_ms", 1e3 * s->build_seconds);
    tradeoff_add_size(row, "rays_per_second", 1 / a_ray);
    tradeoff_add_size(row, "bytes", (double)mt_ray_structure_size(s->structure));
    tradeoff_add_size(row, "pays_from_rays", pays);
    row->is_defect = differing > 0;
    if (differing > 0) {
        snprintf(row->says, sizeof row->says, "%zu rays hit something else than by brute force: a defect", differing);
    } else {
        snprintf(row->says, sizeof row->says, "nothing; it pays from %.0f rays on", pays);
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_structure = {
    .name = "structure",
    .question = "What do rays search?",
    .oracle = "every triangle asked, ray by ray",
    .axis = "differing_rays",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
