/* Which test says where a ray meets a triangle. Rays go at vertices, at the middles of edges, and at random; where all
 * triangles around the place face the ray alike, the surface covers the place whatever rounding does to the ray, and
 * a ray that hits nothing there has slipped through. What was hit, and where, is judged by intersections of the same
 * rays with the mesh's own triangles in 113 bits. */
#include "tradeoff/quad_triangle.h"
#include "tradeoff/random.h"
#include "tradeoff/statistics.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/surface_tree.h>

#include <stdio.h>
#include <string.h>

#define AIMED_MAXIMUM 50000
#define RANDOM_COUNT 20000

/* Boxes and triangles that oracle rays look at in all, so that the oracle ends on any mesh. */
#define ORACLE_WORK 100000000U
#define ORACLE_RAYS 4000

/* A ray at a place counts when its triangles turn to it by more than this cosine. */
#define FACING 0.05

/* A hit farther from the nearest than this is another surface. */
#define WRONG_FACE 1e-5

static const char *const levels[] = {"fast", "watertight", "exact", NULL};
static const mt_ray_profile profiles[] = {MT_RAY_FAST, MT_RAY_WATERTIGHT, MT_RAY_EXACT};

typedef struct rays {
    mt_ray *rays;
    mt_ray_hit *hits;
    size_t count;
} rays;

enum { AT_VERTICES, AT_EDGES, AT_RANDOM, GROUP_COUNT };

typedef struct test_state {
    const tradeoff_subject *subject;
    mt_triangulation triangulation;
    mt_surface_tree *tree;
    rays groups[GROUP_COUNT];
    triangle_blocks blocks;   /* while the oracle is asked */
    size_t oracle_count;      /* of the random rays */
    double *oracle_distances; /* INFINITY: nothing is hit */
    mt_ray_profile profile;
} test_state;

static void corners_of(const test_state *s, mt_index triangle, mt_vec3 p[3])
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&s->triangulation, triangle, side);
        p[side] = mt_mesh_position(s->subject->mesh, s->subject->mesh->corner_vertices[corner]);
    }
}

static mt_vec3 normal_of(const mt_vec3 p[3])
{
    return mt_vec3_normalize(mt_vec3_cross(mt_vec3_subtract(p[1], p[0]), mt_vec3_subtract(p[2], p[0])));
}

static mt_status allocate_rays(mt_context *context, rays *group, size_t count)
{
    group->rays = mt_allocate_array(context, count, sizeof *group->rays);
    group->hits = mt_allocate_array(context, count, sizeof *group->hits);
    group->count = 0;
    return group->rays && group->hits ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static void aim(const test_state *s, rays *group, mt_vec3 at, mt_vec3 direction)
{
    mt_vec3 origin = mt_vec3_subtract(at, mt_vec3_scale(direction, 2 * s->subject->diagonal));
    group->rays[group->count++] = mt_ray_make(origin, mt_vec3_subtract(at, origin));
}

/* Directions that no triangle around a vertex turns away from: for each vertex the cosine that is smallest, signed by
 * the first triangle; 0 where they disagree. */
typedef struct facing {
    mt_vec3 direction;
    double least;
} facing;

static void look_at(facing *f, mt_vec3 normal)
{
    double cosine = mt_vec3_dot(normal, f->direction);
    bool is_first = f->least == 2, agrees = f->least * cosine > 0;
    if (is_first || (agrees && fabs(cosine) < fabs(f->least))) {
        f->least = cosine;
    } else if (!agrees) {
        f->least = 0;
    }
}

/* Vertices on the boundary, or where edges are not of two faces, cover nothing for sure. */
static mt_status mark_open(mt_context *context, const mt_mesh *mesh, unsigned char *is_open)
{
    mt_edge_pairs *pairs = NULL;
    mt_status status = mt_edge_pairs_create(context, mesh, &pairs);
    for (mt_index face = 0; status == MT_OK && face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index next = corner + 1 < end ? corner + 1 : begin;
            if (mt_edge_class_of(mesh, pairs, corner) != MT_EDGE_REGULAR) {
                is_open[mesh->corner_vertices[corner]] = is_open[mesh->corner_vertices[next]] = 1;
            }
        }
    }
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

static void look_around_vertices(const test_state *s, facing *facings)
{
    const mt_mesh *mesh = s->subject->mesh;
    for (mt_index triangle = 0; triangle < s->triangulation.triangle_count; triangle++) {
        mt_vec3 p[3];
        corners_of(s, triangle, p);
        mt_vec3 normal = normal_of(p);
        for (mt_index side = 0; side < 3; side++) {
            look_at(&facings[mesh->corner_vertices[mt_triangulation_corner(&s->triangulation, triangle, side)]],
                    normal);
        }
    }
}

static void aim_at_vertices(test_state *s, const facing *facings, const unsigned char *is_open)
{
    const mt_mesh *mesh = s->subject->mesh;
    mt_index step = mesh->vertex_count / AIMED_MAXIMUM + 1;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex += step) {
        const facing *f = &facings[vertex];
        if (!is_open[vertex] && f->least != 2 && fabs(f->least) > FACING) {
            aim(s, &s->groups[AT_VERTICES], mt_mesh_position(mesh, vertex), f->direction);
        }
    }
}

/* The middle of a side whose vertices are both well seen from its first one's direction. */
static void aim_at_edges(test_state *s, const facing *facings, const unsigned char *is_open)
{
    const mt_mesh *mesh = s->subject->mesh;
    mt_index step = mesh->face_count / AIMED_MAXIMUM + 1;
    for (mt_index face = 0; face < mesh->face_count; face += step) {
        mt_index corner = mt_mesh_face_begin(mesh, face);
        mt_index a = mesh->corner_vertices[corner], b = mesh->corner_vertices[corner + 1];
        const facing *f = &facings[a];
        if (!is_open[a] && f->least != 2 && fabs(f->least) > FACING) {
            mt_vec3 middle = mt_vec3_scale(mt_vec3_add(mt_mesh_position(mesh, a), mt_mesh_position(mesh, b)), 0.5);
            aim(s, &s->groups[AT_EDGES], middle, f->direction);
        }
    }
}

static mt_status aim_at_places(test_state *s, mt_context *context)
{
    const mt_mesh *mesh = s->subject->mesh;
    facing *facings = mt_allocate_array(context, mesh->vertex_count, sizeof *facings);
    unsigned char *is_open = mt_allocate_zeroed(context, mesh->vertex_count);
    mt_status status = facings && is_open ? mark_open(context, mesh, is_open) : MT_ERROR_OUT_OF_MEMORY;
    tradeoff_random random = {1};
    for (mt_index vertex = 0; status == MT_OK && vertex < mesh->vertex_count; vertex++) {
        facings[vertex] = (facing){tradeoff_random_direction(&random), 2};
    }
    if (status == MT_OK) {
        look_around_vertices(s, facings);
        aim_at_vertices(s, facings, is_open);
        aim_at_edges(s, facings, is_open);
    }
    mt_free(context, facings);
    mt_free(context, is_open);
    return status;
}

static void aim_at_random(test_state *s)
{
    mt_bounds bounds = mt_mesh_bounds(s->subject->mesh);
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    tradeoff_random random = {2};
    for (size_t i = 0; i < RANDOM_COUNT; i++) {
        mt_vec3 at = bounds.minimum;
        at.x += size.x * tradeoff_random_unit(&random);
        at.y += size.y * tradeoff_random_unit(&random);
        at.z += size.z * tradeoff_random_unit(&random);
        aim(s, &s->groups[AT_RANDOM], at, tradeoff_random_direction(&random));
    }
}

/* An oracle's ray, and how far it gets. */
typedef struct sight {
    const test_state *state;
    const mt_ray *ray;
    double margin, nearest;
} sight;

static bool may_be_met(const void *user, const triangle_box *box)
{
    const sight *seen = user;
    return triangle_box_may_meet(box, seen->ray, seen->margin);
}

static void meet(void *user, mt_index triangle)
{
    sight *seen = user;
    mt_vec3 p[3];
    corners_of(seen->state, triangle, p);
    seen->nearest = fmin(seen->nearest, quad_meet_triangle(p, seen->ray, seen->margin));
}

static void meet_all(void *user, uint64_t begin, uint64_t end)
{
    static const triangle_query query = {may_be_met, meet};
    test_state *s = user;
    for (uint64_t i = begin; i < end; i++) {
        sight seen = {s, &s->groups[AT_RANDOM].rays[i], 1e-9 * s->subject->diagonal, INFINITY};
        triangle_blocks_visit(&s->blocks, &query, &seen);
        s->oracle_distances[i] = seen.nearest;
    }
}

static mt_status ask_oracle(test_state *s, mt_context *context)
{
    s->oracle_distances = mt_allocate_array(context, ORACLE_RAYS, sizeof(double));
    mt_status status = s->oracle_distances
                           ? triangle_blocks_make(context, s->subject->mesh, &s->triangulation, &s->blocks)
                           : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        s->oracle_count = triangle_blocks_ask(context, &s->blocks, ORACLE_RAYS, ORACLE_WORK, meet_all, s);
    }
    triangle_blocks_release(context, &s->blocks);
    return status;
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces for rays to meet";
        return MT_OK;
    }
    test_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->subject = subject;
    mt_status status = mt_triangulation_init(context, subject->mesh, &s->triangulation);
    if (status == MT_OK) {
        status = mt_surface_tree_create(context, subject->mesh, &s->triangulation, NULL, &s->tree);
    }
    static const size_t rooms[GROUP_COUNT] = {AIMED_MAXIMUM, AIMED_MAXIMUM, RANDOM_COUNT};
    for (int i = 0; status == MT_OK && i < GROUP_COUNT; i++) {
        status = allocate_rays(context, &s->groups[i], rooms[i]);
    }
    if (status == MT_OK) {
        status = aim_at_places(s, context);
    }
    if (status != MT_OK) {
        return status;
    }
    aim_at_random(s);
    return ask_oracle(s, context);
}

static void release(void *state, mt_context *context)
{
    test_state *s = state;
    for (int i = 0; i < GROUP_COUNT; i++) {
        mt_free(context, s->groups[i].rays);
        mt_free(context, s->groups[i].hits);
    }
    mt_free(context, s->oracle_distances);
    mt_surface_tree_destroy(context, s->tree);
    mt_triangulation_release(context, &s->triangulation);
    mt_free(context, s);
}

typedef struct tracing {
    test_state *state;
    rays *group;
} tracing;

static void trace(void *user, uint64_t begin, uint64_t end)
{
    const tracing *t = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_ray_hit *hit = &t->group->hits[i];
        if (!mt_surface_tree_nearest_hit(t->state->tree, &t->group->rays[i], t->state->profile, hit)) {
            *hit = mt_ray_no_hit();
        }
    }
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    test_state *s = state;
    s->profile = profiles[level];
    for (int i = 0; i < GROUP_COUNT; i++) {
        tracing t = {s, &s->groups[i]};
        mt_parallel_for(context, t.group->count, 1024, trace, &t);
    }
    return MT_OK;
}

/* Rays at places that the surface covers and that hit nothing up to there, in a million. */
static double misses_per_million(const rays *group)
{
    size_t missed = 0;
    for (size_t i = 0; i < group->count; i++) {
        missed += !(group->hits[i].t <= 1 + 1e-4);
    }
    return group->count ? 1e6 * (double)missed / (double)group->count : (double)NAN;
}

/* Random rays whose nearest surface was not found, or was found where there is none; errors of t of the others. */
static size_t compare_with_oracle(const test_state *s, double *errors, size_t *error_count)
{
    size_t wrong = 0;
    for (size_t i = 0; i < s->oracle_count; i++) {
        double exact = s->oracle_distances[i], found = s->groups[AT_RANDOM].hits[i].t;
        if (isinf(exact) && isinf(found)) {
            continue;
        }
        double error = fabs(found - exact) / exact;
        if (!(error <= WRONG_FACE)) {
            wrong++;
        } else {
            errors[(*error_count)++] = error;
        }
    }
    return wrong;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    static const char *const names[3] = {"t_p50", "t_p99", "t_max"};
    const test_state *s = state;
    double *errors = mt_allocate_array(context, s->oracle_count, sizeof *errors);
    if (!errors) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    size_t count = 0, wrong = compare_with_oracle(s, errors, &count);
    tradeoff_statistics t = tradeoff_statistics_of(errors, count);
    mt_free(context, errors);
    double at_vertices = misses_per_million(&s->groups[AT_VERTICES]);
    double at_edges = misses_per_million(&s->groups[AT_EDGES]);
    tradeoff_add_error(row, "missed_at_vertices", at_vertices);
    tradeoff_add_error(row, "missed_at_edges", at_edges);
    tradeoff_add_error(row, "wrong_per_million", 1e6 * (double)wrong / (double)s->oracle_count);
    tradeoff_add_statistics(row, names, &t);
    if (at_vertices > 0 || at_edges > 0) {
        snprintf(row->says, sizeof row->says, "%.2g %% of rays at a vertex and %.2g %% at an edge slip through",
                 at_vertices / 1e4, at_edges / 1e4);
    } else {
        snprintf(row->says, sizeof row->says, "no ray slips through; distances are right to %.1g of themselves",
                 t.maximum);
    }
    row->is_defect = profiles[level] != MT_RAY_FAST && (at_vertices > 0 || at_edges > 0);
    return MT_OK;
}

const tradeoff_knob tradeoff_triangle_test = {
    .name = "triangle-test",
    .question = "Which test says where a ray meets a triangle?",
    .oracle = "intersections in 113-bit arithmetic; places that the surface covers",
    .axis = "missed_at_edges",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .judge = judge,
    .release = release,
};
