/* Making the hierarchy of oriented boxes: each range of triangles gets the box along its principal axes and is cut in
 * two along one of them, until a leaf's few are left; O(n log n). Small ranges are tasks of their own, made in parallel
 * and joined in order: the hierarchy depends on the triangles alone. */
#include "lib/spatial/growing.h"
#include "lib/spatial/part_batches.h"
#include "lib/spatial/ray_obb.h"

#define TASK_SIZE 4096
#define PROGRESS "building oriented boxes"

/* Of the time: the top's. */
#define TOP_SHARE 0.4

typedef struct waiting {
    mt_ray_obb_range range;
    uint32_t node;
    unsigned depth;
} waiting;

/* A part of the hierarchy that is made in one go. */
typedef struct part {
    waiting root; /* its node in the top */
    mt_growing nodes;
    bool is_complete;
} part;

typedef struct build_job {
    mt_context *context;
    mt_packed_triangles *triangles;
    part top;
    mt_growing parts;
    mt_status status; /* MT_ERROR_CANCELLED: asked to stop */
} build_job;

static mt_index size_of(mt_ray_obb_range range)
{
    return range.end - range.begin;
}

static bool make_task(build_job *job, const waiting *item)
{
    if (!mt_growing_reserve(job->context, &job->parts, 1, sizeof(part))) {
        return false;
    }
    ((part *)job->parts.items)[job->parts.count++] = (part){.root = *item};
    return true;
}

/* Fills a node in. Returns how many children were added behind `halves`: none or two; or -1: no memory. */
static int make_node(const build_job *job, part *p, const waiting *item, waiting halves[2])
{
    if (!mt_growing_reserve(job->context, &p->nodes, 2, sizeof(mt_ray_obb_node))) {
        return -1;
    }
    mt_ray_obb_node *node = (mt_ray_obb_node *)p->nodes.items + item->node;
    node->box = mt_ray_obb_fit(job->triangles, item->range);
    if (size_of(item->range) <= MT_RAY_OBB_LEAF_SIZE) {
        node->first = item->range.begin;
        node->count = size_of(item->range);
        return 0;
    }
    bool halve = item->depth >= MT_RAY_OBB_HALVING_DEPTH;
    mt_index middle = mt_ray_obb_split(job->triangles, item->range, &node->box, halve);
    node->first = (uint32_t)p->nodes.count;
    node->count = 0;
    halves[0] = (waiting){{item->range.begin, middle}, node->first, item->depth + 1};
    halves[1] = (waiting){{middle, item->range.end}, node->first + 1, item->depth + 1};
    p->nodes.count += 2;
    return 2;
}

/* Asked before a range of the top; the last ranges come first. */
static bool may_go_on(build_job *job, const waiting *item)
{
    mt_index count = job->triangles->count;
    double done = (double)(count - item->range.end) / (double)count;
    job->status = mt_progress(job->context, PROGRESS, TOP_SHARE * done);
    return job->status == MT_OK;
}

/* Makes a part from its root on. Ranges of at most task_size triangles are left to tasks. */
static bool make_part(build_job *job, part *p, mt_index task_size)
{
    waiting stack[MT_RAY_OBB_DEPTH + 2];
    int depth = 1;
    if (!mt_growing_reserve(job->context, &p->nodes, 1, sizeof(mt_ray_obb_node))) {
        return false;
    }
    p->nodes.count = 1;
    stack[0] = (waiting){p->root.range, 0, p->root.depth};
    while (depth) {
        waiting item = stack[--depth];
        if (size_of(item.range) <= task_size) {
            if (!make_task(job, &item)) {
                return false;
            }
            continue;
        }
        if (task_size && !may_go_on(job, &item)) {
            return false;
        }
        int added = make_node(job, p, &item, stack + depth);
        if (added < 0) {
            return false;
        }
        depth += added;
    }
    return true;
}

static void make_parts(void *user, uint64_t begin, uint64_t end)
{
    build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        part *p = (part *)job->parts.items + task;
        p->is_complete = make_part(job, p, 0);
    }
}

/* A part's root takes its place in the top, the rest of its nodes follow behind. */
static void join_part(mt_ray_obb *obb, const part *p)
{
    const mt_ray_obb_node *nodes = p->nodes.items;
    uint32_t shift = (uint32_t)obb->node_count - 1;
    for (uint64_t i = 0; i < p->nodes.count; i++) {
        mt_ray_obb_node *to = &obb->nodes[i ? i + shift : p->root.node];
        *to = nodes[i];
        to->first += to->count ? 0 : shift;
    }
    obb->node_count += p->nodes.count - 1;
}

/* A binary tree of fewer than 2^28 leaves: its nodes have 32-bit numbers. */
static mt_status join_parts(build_job *job, mt_ray_obb *obb)
{
    const part *parts = job->parts.items;
    uint64_t node_count = job->top.nodes.count;
    for (uint64_t i = 0; i < job->parts.count; i++) {
        node_count += parts[i].nodes.count - 1;
    }
    obb->nodes = mt_allocate_array(job->context, node_count, sizeof *obb->nodes);
    if (!obb->nodes) {
        return mt_context_error(job->context)->status;
    }
    obb->node_count = 1; /* the top's own root is counted */
    join_part(obb, &job->top);
    for (uint64_t i = 0; i < job->parts.count; i++) {
        join_part(obb, &parts[i]);
    }
    return MT_OK;
}

static void release_job(build_job *job)
{
    for (uint64_t i = 0; i < job->parts.count; i++) {
        mt_free(job->context, ((part *)job->parts.items)[i].nodes.items);
    }
    mt_free(job->context, job->parts.items);
    mt_free(job->context, job->top.nodes.items);
}

mt_status mt_ray_obb_build(mt_context *context, mt_ray_obb *obb)
{
    build_job job = {.context = context, .triangles = &obb->triangles};
    if (!obb->triangles.count) {
        return MT_OK;
    }
    job.top.root.range = (mt_ray_obb_range){0, obb->triangles.count};
    bool is_made = make_part(&job, &job.top, TASK_SIZE);
    if (is_made) {
        job.status = mt_make_in_batches(context, PROGRESS, TOP_SHARE, job.parts.count, make_parts, &job);
    }
    for (uint64_t i = 0; i < job.parts.count; i++) {
        is_made &= ((part *)job.parts.items)[i].is_complete;
    }
    if (job.status == MT_OK) {
        job.status =
            is_made ? join_parts(&job, obb) : mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "out of memory while " PROGRESS);
    }
    release_job(&job);
    return job.status;
}
