/* What rays search, and how well it is built. All structures find the same hits; they differ in what they take to
 * build, to keep and to search, so that the number of rays decides which of them pays. */
#include "tradeoff/random.h"
#include "tradeoff/ray_oracle.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/ray_structure.h>

#include <math.h>
#include <stdio.h>

#define RAY_COUNT 50000
/* Triangles that brute force, and the oracle, are asked about in all. */
#define ORACLE_WORK 20000000U
#define ORACLE_RAYS 2000U
/* By how much of the diagonal vertices may lie off when they are rounded to float. */
#define MARGIN 0x1p-20
/* Of what is timed apart from the level's own time. */
#define REPEATS 4
#define SHORT_SECONDS 0.2

static const char *const levels[] = {"aabb fast", "aabb", "obb", "grid", "bsp", NULL};
static const struct {
    mt_ray_structure_kind kind;
    mt_build_quality quality;
} made[] = {{MT_RAY_STRUCTURE_AABB, MT_BUILD_FAST},
            {MT_RAY_STRUCTURE_AABB, MT_BUILD_BALANCED},
            {MT_RAY_STRUCTURE_OBB, MT_BUILD_BALANCED},
            {MT_RAY_STRUCTURE_GRID, MT_BUILD_BALANCED},
            {MT_RAY_STRUCTURE_BSP, MT_BUILD_BALANCED}};

typedef struct structure_state {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    mt_ray *rays;
    mt_ray_hit *hits, *brute; /* the second: without a structure, of the first so many rays */
    double *limits;           /* of the same rays, by the oracle */
    size_t oracle_count;
    double margin;
    double brute_seconds; /* a ray, without a structure */
    const mt_ray_structure *searched;
    mt_ray_structure *structure;
    double build_seconds, trace_seconds;
} structure_state;

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

/* Brute force has the structures' own test of a triangle: what they find must be the same to the last bit, and sooner.
 */
static mt_status ask_brute_force(structure_state *s, mt_context *context)
{
    mt_ray_structure *none = NULL;
    mt_status status =
        mt_ray_structure_create(context, s->mesh, &s->triangulation, MT_RAY_STRUCTURE_NONE, MT_BUILD_BALANCED, &none);
    size_t count = ORACLE_WORK / (s->triangulation.triangle_count + 1) + 1;
    s->oracle_count = count < ORACLE_RAYS ? count : ORACLE_RAYS;
    if (status == MT_OK) {
        double begin = tradeoff_now();
        s->searched = none;
        mt_parallel_for(context, s->oracle_count, 16, trace, s);
        s->brute_seconds = (tradeoff_now() - begin) / (double)s->oracle_count;
        for (size_t i = 0; i < s->oracle_count; i++) {
            s->brute[i] = s->hits[i];
        }
    }
    mt_ray_structure_destroy(context, none);
    return status;
}

static void ask_oracle(void *user, uint64_t begin, uint64_t end)
{
    const structure_state *s = user;
    for (uint64_t i = begin; i < end; i++) {
        s->limits[i] = ray_oracle_limit(s->mesh, &s->triangulation, &s->rays[i], s->margin);
    }
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
    s->brute = mt_allocate_array(context, ORACLE_RAYS, sizeof *s->brute);
    s->limits = mt_allocate_array(context, ORACLE_RAYS, sizeof *s->limits);
    if (!s->rays || !s->hits || !s->brute || !s->limits) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->margin = MARGIN * subject->diagonal;
    aim(s, subject->diagonal);
    status = ask_brute_force(s, context);
    if (status == MT_OK) {
        mt_parallel_for(context, s->oracle_count, 16, ask_oracle, s);
    }
    return status;
}

static void release(void *state, mt_context *context)
{
    structure_state *s = state;
    mt_free(context, s->rays);
    mt_free(context, s->hits);
    mt_free(context, s->brute);
    mt_free(context, s->limits);
    mt_triangulation_release(context, &s->triangulation);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    structure_state *s = state;
    double begin = tradeoff_now();
    mt_status status = mt_ray_structure_create(context, s->mesh, &s->triangulation, made[level].kind,
                                               made[level].quality, &s->structure);
    if (status != MT_OK) {
        return status;
    }
    s->build_seconds = tradeoff_now() - begin;
    s->searched = s->structure;
    mt_parallel_for(context, RAY_COUNT, 512, trace, s);
    s->trace_seconds = tradeoff_now() - begin - s->build_seconds;
    return MT_OK;
}

static void discard(void *state, mt_context *context)
{
    structure_state *s = state;
    mt_ray_structure_destroy(context, s->structure);
    s->structure = NULL;
}

/* The best of a few runs, where they are short: a first one alone finds caches cold. */
static mt_status repeat(structure_state *s, size_t level, mt_context *context)
{
    mt_status status = MT_OK;
    double build = s->build_seconds, search = s->trace_seconds;
    for (int i = 0; status == MT_OK && i < REPEATS && build + search < SHORT_SECONDS; i++) {
        discard(s, context);
        status = run(s, level, context);
        build = fmin(build, s->build_seconds), search = fmin(search, s->trace_seconds);
    }
    s->build_seconds = build, s->trace_seconds = search;
    return status;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    structure_state *s = state;
    mt_status status = repeat(s, level, context);
    if (status != MT_OK) {
        return status;
    }
    size_t differing = 0, wrong = 0;
    for (size_t i = 0; i < s->oracle_count; i++) {
        const mt_ray_hit *hit = &s->hits[i];
        differing += hit->triangle != s->brute[i].triangle || hit->t != s->brute[i].t;
        wrong += !ray_oracle_accepts(s->mesh, &s->triangulation, &s->rays[i], hit, s->limits[i], s->margin);
    }
    double a_ray = s->trace_seconds / RAY_COUNT, gain = s->brute_seconds - a_ray;
    double pays = gain > 0 ? ceil(s->build_seconds / gain) : (double)INFINITY;
    tradeoff_add_error(row, "wrong_rays", (double)wrong);
    tradeoff_add_error(row, "differing_rays", (double)differing);
    tradeoff_add_size(row, "build_ms", 1e3 * s->build_seconds);
    tradeoff_add_size(row, "rays_per_second", 1 / a_ray);
    tradeoff_add_size(row, "bytes", (double)mt_ray_structure_size(s->structure));
    tradeoff_add_size(row, "pays_from_rays", pays);
    row->is_defect = differing + wrong > 0;
    if (row->is_defect) {
        snprintf(row->says, sizeof row->says,
                 "%zu rays hit something else than by brute force, %zu than in 113 bits: a defect", differing, wrong);
    } else {
        snprintf(row->says, sizeof row->says, "nothing; it pays from %.0f rays on", pays);
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_structure = {
    .name = "structure",
    .question = "What do rays search, and how well is it built?",
    .oracle = "every triangle asked in 113-bit arithmetic; every triangle asked in turn",
    .axis = "wrong_rays",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
