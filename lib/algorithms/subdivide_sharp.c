/* Sharpness from level to level.
 *
 * Source: DeRose, Kass and Truong (1998); the rules are in subdivide_rule.c. The halves of side c are the sides 4c and
 * the one before 4 next(c) in its face, and keep its direction: end 0 of the first is end 0 of c, end 1 of the second
 * is end 1. Cost: O(sharp edges and vertices) a level. */
#include "lib/algorithms/subdivide_sharp.h"

#include <string.h>

#define SHARP_GRAIN 1024

void mt_subdivide_sharp_release(mt_context *context, mt_subdivide_sharp *sharp)
{
    mt_free(context, sharp->edges);
    mt_free(context, sharp->vertices);
    mt_free(context, sharp->spokes);
    mt_free(context, sharp->missing);
    memset(sharp, 0, sizeof *sharp);
}

void mt_subdivide_patches_release(mt_context *context, mt_subdivide_patches *patches)
{
    mt_free(context, patches->vertices);
    mt_free(context, patches->edges);
    mt_free(context, patches->halves);
    memset(patches, 0, sizeof *patches);
}

static mt_index next_corner(const mt_subdivide_topology *topology, mt_index corner)
{
    return mt_subdivide_next(topology, corner, topology->face_size);
}

mt_index mt_subdivide_spoke_end(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, mt_index spoke)
{
    mt_index side = sharp->edges[spoke >> 1].side;
    return spoke & 1 ? side : next_corner(topology, side);
}

/* Of the spokes of a vertex, those that are sharp at this level, or (halves not NULL) at the next. */
static mt_subdivide_vertex_rule rule_at(const mt_subdivide_sharp *sharp, mt_index number, const float *halves,
                                        mt_index ends[2])
{
    const mt_sharp_vertex *vertex = &sharp->vertices[number];
    float sharpness = halves ? mt_sharpness_next(vertex->sharpness) : vertex->sharpness;
    mt_index count = vertex->boundary ? 2 : 0, found = 0;
    for (mt_index i = vertex->first_spoke; i < vertex[1].first_spoke; i++) {
        mt_index spoke = sharp->spokes[i];
        if (!halves || halves[spoke] > 0) {
            count++;
            if (found < 2) {
                ends[found++] = spoke;
            }
        }
    }
    return mt_vertex_rule_of(sharpness, count);
}

mt_subdivide_vertex_rule mt_subdivide_sharp_rule(const mt_subdivide_sharp *sharp, mt_index vertex, mt_index ends[2])
{
    return rule_at(sharp, vertex, NULL, ends);
}

typedef struct plan_job {
    const mt_subdivide_topology *topology;
    const mt_subdivide_sharp *sharp;
    mt_subdivide_patches *patches;
} plan_job;

static void split_spokes(const mt_subdivide_sharp *sharp, const mt_sharp_vertex *vertex, float *halves)
{
    mt_sharpness_sum around = {0, 0};
    for (mt_index i = vertex->first_spoke; i < vertex[1].first_spoke; i++) {
        mt_sharpness_sum_add(&around, sharp->edges[sharp->spokes[i] >> 1].sharpness);
    }
    for (mt_index i = vertex->first_spoke; i < vertex[1].first_spoke; i++) {
        mt_index spoke = sharp->spokes[i];
        halves[spoke] = mt_sharpness_next_at(sharp->edges[spoke >> 1].sharpness, sharp->chaikin, &around);
    }
}

static float decay_weight(const mt_subdivide_sharp *sharp, const mt_sharp_vertex *vertex, const float *halves)
{
    mt_sharpness_sum decay = {0, 0};
    mt_sharpness_decay_add(&decay, vertex->sharpness, mt_sharpness_next(vertex->sharpness), true);
    for (mt_index i = vertex->first_spoke; i < vertex[1].first_spoke; i++) {
        mt_index spoke = sharp->spokes[i];
        mt_sharpness_decay_add(&decay, sharp->edges[spoke >> 1].sharpness, halves[spoke], sharp->chaikin);
    }
    return mt_sharpness_decay_weight(&decay);
}

static void plan_vertex(const plan_job *job, mt_index number)
{
    const mt_subdivide_sharp *sharp = job->sharp;
    const mt_sharp_vertex *vertex = &sharp->vertices[number];
    const float *halves = job->patches->halves;
    mt_vertex_patch patch = {.corner = vertex->corner, .weight = -1};
    mt_index ends[2] = {0, 0}, child_ends[2] = {0, 0};
    split_spokes(sharp, vertex, job->patches->halves);
    patch.parent = rule_at(sharp, number, NULL, ends);
    patch.child = rule_at(sharp, number, halves, child_ends);
    bool follows_boundary = vertex->boundary && patch.parent == MT_VERTEX_CREASE;
    if (patch.parent >= MT_VERTEX_CREASE && !follows_boundary) {
        patch.weight = patch.child == patch.parent ? 1 : decay_weight(sharp, vertex, halves);
        patch.child = vertex->boundary && patch.child == MT_VERTEX_CREASE ? MT_VERTEX_SMOOTH : patch.child;
        bool inside = patch.parent == MT_VERTEX_CREASE || patch.child == MT_VERTEX_CREASE;
        const mt_index *spokes = patch.parent == MT_VERTEX_CREASE ? ends : child_ends;
        for (unsigned i = 0; inside && i < 2; i++) {
            patch.ends[i] = mt_subdivide_spoke_end(job->topology, sharp, spokes[i]);
        }
    }
    job->patches->vertices[number] = patch;
}

static void plan_vertices(void *user, uint64_t begin, uint64_t end)
{
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        plan_vertex(user, (mt_index)vertex);
    }
}

static void plan_edges(void *user, uint64_t begin, uint64_t end)
{
    const plan_job *job = user;
    for (uint64_t edge = begin; edge < end; edge++) {
        const mt_sharp_edge *sharp = &job->sharp->edges[edge];
        float *halves = job->patches->halves + 2 * edge;
        if (sharp->boundary) {
            halves[0] = halves[1] = mt_sharpness_next(sharp->sharpness);
        }
        float weight = halves[0] > 0 && halves[1] > 0 ? 1 : sharp->sharpness;
        job->patches->edges[edge] = (mt_edge_patch){sharp->side, sharp->boundary ? -1 : weight};
    }
}

mt_status mt_subdivide_sharp_plan(mt_context *context, const mt_subdivide_topology *topology,
                                  const mt_subdivide_sharp *sharp, mt_subdivide_patches *patches)
{
    plan_job job = {.topology = topology, .sharp = sharp, .patches = patches};
    patches->vertices = mt_allocate_array(context, sharp->vertex_count, sizeof *patches->vertices);
    patches->edges = mt_allocate_array(context, sharp->edge_count, sizeof *patches->edges);
    patches->halves = mt_allocate_array(context, 2 * (uint64_t)sharp->edge_count, sizeof *patches->halves);
    if (!patches->vertices || !patches->edges || !patches->halves) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, sharp->vertex_count, SHARP_GRAIN, plan_vertices, &job);
    mt_parallel_for(context, sharp->edge_count, SHARP_GRAIN, plan_edges, &job);
    return MT_OK;
}

/* Halves that stay sharp, numbered in their order; images receives per spoke number that of its half. */
static void refine_edges(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, const float *halves,
                         mt_subdivide_sharp *next, mt_index *images)
{
    for (mt_index edge = 0; edge < sharp->edge_count; edge++) {
        mt_index side = sharp->edges[edge].side;
        const mt_index sides[2] = {4 * side, mt_subdivide_child_previous(topology, 4 * next_corner(topology, side))};
        for (unsigned end = 0; end < 2; end++) {
            float sharpness = halves[2 * edge + end];
            images[2 * edge + end] = sharpness > 0 ? next->edge_count : MT_NONE;
            if (sharpness > 0) {
                mt_sharp_edge half = {sides[end], sharpness, sharp->edges[edge].boundary, sharp->edges[edge].implied};
                next->edges[next->edge_count++] = half;
            }
        }
    }
}

static bool add_vertex(mt_subdivide_sharp *next, mt_sharp_vertex vertex, mt_index *spoke_count)
{
    if (*spoke_count == vertex.first_spoke && !(vertex.sharpness > 0)) {
        return false;
    }
    next->vertices[next->vertex_count++] = vertex;
    return true;
}

static void refine_vertices(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                            const mt_index *half_images, mt_subdivide_sharp *next, mt_index *vertex_images)
{
    mt_index used = 0;
    for (mt_index number = 0; number < sharp->vertex_count; number++) {
        const mt_sharp_vertex *old = &sharp->vertices[number];
        mt_sharp_vertex vertex = {4 * old->corner, used, mt_sharpness_next(old->sharpness), old->boundary};
        for (mt_index i = old->first_spoke; i < old[1].first_spoke; i++) {
            mt_index image = half_images[sharp->spokes[i]];
            if (image != MT_NONE) {
                next->spokes[used++] = 2 * image + (sharp->spokes[i] & 1);
            }
        }
        vertex_images[number] = add_vertex(next, vertex, &used) ? next->vertex_count - 1 : MT_NONE;
    }
    for (mt_index edge = 0; edge < sharp->edge_count; edge++) {
        mt_index point = mt_subdivide_child_next(topology, 4 * sharp->edges[edge].side);
        mt_sharp_vertex vertex = {point, used, 0, false};
        for (unsigned end = 0; end < 2 && !sharp->edges[edge].boundary; end++) {
            mt_index image = half_images[2 * edge + end];
            if (image != MT_NONE) {
                next->spokes[used++] = 2 * image + (end ^ 1);
            }
        }
        add_vertex(next, vertex, &used);
    }
    next->vertices[next->vertex_count].first_spoke = used;
}

mt_status mt_subdivide_sharp_refine(mt_context *context, const mt_subdivide_topology *topology,
                                    const mt_subdivide_sharp *sharp, const mt_subdivide_patches *patches,
                                    mt_subdivide_sharp *next, mt_index **vertex_images)
{
    uint64_t edge_count = 2 * (uint64_t)sharp->edge_count;
    *next = (mt_subdivide_sharp){.chaikin = sharp->chaikin};
    next->edges = mt_allocate_array(context, edge_count, sizeof *next->edges);
    next->spokes = mt_allocate_array(context, 2 * edge_count, sizeof *next->spokes);
    next->vertices =
        mt_allocate_array(context, (uint64_t)sharp->vertex_count + sharp->edge_count + 1, sizeof *next->vertices);
    mt_index *half_images = mt_allocate_array(context, edge_count, sizeof *half_images);
    *vertex_images = mt_allocate_array(context, sharp->vertex_count, sizeof **vertex_images);
    bool complete = next->edges && next->spokes && next->vertices && half_images && *vertex_images;
    if (complete) {
        refine_edges(topology, sharp, patches->halves, next, half_images);
        refine_vertices(topology, sharp, half_images, next, *vertex_images);
    } else {
        mt_subdivide_sharp_release(context, next);
        mt_free(context, *vertex_images);
        *vertex_images = NULL;
    }
    mt_free(context, half_images);
    return complete ? MT_OK : mt_context_error(context)->status;
}
