/* Top-down building by the spatial middle.
 *
 * A range is cut at the middle of the longest side of its centroids' bounds; where that leaves one side empty (all
 * centroids equal, or a difference lost in rounding) it is cut in the middle of its order. The top of the tree is cut
 * serially until ranges are small enough to be tasks; each task builds its subtree in its own nodes, and the subtrees
 * are then copied behind one another in the order of the tasks. Nothing depends on the number of threads.
 *
 * Cost: about log2(n) passes over 32 bytes a primitive. The depth is bounded: a side halves at most 175 times before
 * two floats of [-2, 2] are equal, 525 times for three axes, and 32 more for the count. Known weakness: the
 * surface-area heuristic makes better trees for rays; for boxes against boxes of a surface the middle is as good and
 * several times faster to find. */
#include "lib/spatial/aabb_build.h"
#include "lib/spatial/box.h"
#include "lib/spatial/part_batches.h"

#define TASK_SIZE 8192    /* primitives of a subtree that one thread builds */
#define STACK_CAPACITY 64 /* the logarithm of the largest count, and some */
#define TOP_SHARE 0.3     /* of the time: the top's */

typedef struct build_range {
    mt_index begin, end;
    mt_index node; /* where its node goes */
    box bounds;    /* of its primitives */
    box centers;   /* of their doubled centroids: the sum needs no division, and orders the same */
} build_range;

typedef struct build_job {
    mt_context *context;
    mt_aabb_primitive *primitives;
    mt_aabb_node *top_nodes;
    mt_index top_count, top_capacity;
    build_range *tasks; /* ranges whose node in the top tree awaits a subtree */
    mt_index task_count;
    mt_aabb_node **subtrees; /* per task */
    mt_index *subtree_counts;
} build_job;

static build_range bound_range(const mt_aabb_primitive *primitives, mt_index begin, mt_index end)
{
    box bounds = box_empty(), centers = box_empty();
    for (mt_index i = begin; i < end; i++) {
        box one = box_load(&primitives[i]);
        float4 center = one.lower + one.upper;
        bounds = box_join(bounds, one);
        centers.lower = float4_minimum(centers.lower, center);
        centers.upper = float4_maximum(centers.upper, center);
    }
    return (build_range){begin, end, 0, bounds, centers};
}

static bool is_below(const mt_aabb_primitive *primitive, int axis, float middle)
{
    return primitive->lower[axis] + primitive->upper[axis] < middle;
}

/* Moves those below the middle to the front; returns where the others begin. */
static mt_index partition(mt_aabb_primitive *primitives, const build_range *range, int axis, float middle)
{
    mt_index low = range->begin, high = range->end;
    for (;;) {
        while (low < high && is_below(&primitives[low], axis, middle)) {
            low++;
        }
        while (low < high && !is_below(&primitives[high - 1], axis, middle)) {
            high--;
        }
        if (low == high) {
            return low;
        }
        high--;
        mt_aabb_primitive swapped = primitives[low];
        primitives[low++] = primitives[high];
        primitives[high] = swapped;
    }
}

static void cut_range(mt_aabb_primitive *primitives, const build_range *range, build_range parts[2])
{
    float4 lengths = range->centers.upper - range->centers.lower;
    int axis = lengths[1] > lengths[0];
    axis = lengths[2] > lengths[axis] ? 2 : axis;
    float middle = 0.5f * range->centers.lower[axis] + 0.5f * range->centers.upper[axis];
    mt_index cut = partition(primitives, range, axis, middle);
    if (cut == range->begin || cut == range->end) {
        cut = range->begin + (range->end - range->begin) / 2;
    }
    parts[0] = bound_range(primitives, range->begin, cut);
    parts[1] = bound_range(primitives, cut, range->end);
}

/* Fills the range's node; an inner one gets its two children's places at *count, and their ranges in `parts`. */
static bool make_node(mt_aabb_primitive *primitives, const build_range *range, mt_aabb_node *nodes, mt_index *count,
                      build_range parts[2])
{
    mt_aabb_node *node = &nodes[range->node];
    memcpy(node, &range->bounds, sizeof *node);
    if (range->end - range->begin <= MT_AABB_LEAF_SIZE) {
        node->first = range->begin;
        node->count = range->end - range->begin;
        return false;
    }
    cut_range(primitives, range, parts);
    node->first = *count;
    node->count = 0;
    parts[0].node = *count;
    parts[1].node = *count + 1;
    *count += 2;
    return true;
}

/* Smaller parts are built first, so that no more than the logarithm of the count waits. */
static mt_index push_parts(build_range *stack, mt_index depth, const build_range parts[2])
{
    int larger = parts[1].end - parts[1].begin > parts[0].end - parts[0].begin;
    stack[depth] = parts[larger];
    stack[depth + 1] = parts[!larger];
    return depth + 2;
}

static mt_index build_subtree(mt_aabb_primitive *primitives, const build_range *root, mt_aabb_node *nodes)
{
    build_range stack[STACK_CAPACITY], parts[2];
    mt_index depth = 1, count = 1;
    stack[0] = *root;
    stack[0].node = 0;
    while (depth) {
        build_range range = stack[--depth];
        if (make_node(primitives, &range, nodes, &count, parts)) {
            depth = push_parts(stack, depth, parts);
        }
    }
    return count;
}

static void build_subtrees(void *user, uint64_t begin, uint64_t end)
{
    build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        const build_range *range = &job->tasks[task];
        uint64_t capacity = 2 * (uint64_t)(range->end - range->begin);
        mt_aabb_node *nodes = mt_try_allocate(job->context, capacity * sizeof *nodes);
        job->subtrees[task] = nodes;
        if (nodes) {
            job->subtree_counts[task] = build_subtree(job->primitives, range, nodes);
        }
    }
}

/* Cuts from the top until every range is a task. */
static void build_top(build_job *job, mt_index count)
{
    build_range stack[STACK_CAPACITY], parts[2];
    mt_index depth = 1;
    job->top_count = 1;
    stack[0] = bound_range(job->primitives, 0, count);
    while (depth) {
        build_range range = stack[--depth];
        bool is_task = range.end - range.begin <= TASK_SIZE || job->top_count + 2 > job->top_capacity;
        if (is_task) {
            job->tasks[job->task_count++] = range;
        } else if (make_node(job->primitives, &range, job->top_nodes, &job->top_count, parts)) {
            depth = push_parts(stack, depth, parts);
        }
    }
}

/* Copies the subtrees behind the top: a subtree's root takes its place in the top, the rest follows. */
static void join_subtrees(const build_job *job, mt_aabb_node *nodes)
{
    memcpy(nodes, job->top_nodes, job->top_count * sizeof *nodes);
    mt_index at = job->top_count;
    for (mt_index task = 0; task < job->task_count; task++) {
        const mt_aabb_node *from = job->subtrees[task];
        mt_index shift = at - 1; /* node i > 0 of the subtree goes to i + shift */
        for (mt_index i = 0; i < job->subtree_counts[task]; i++) {
            mt_aabb_node node = from[i];
            node.first += node.count ? 0 : shift;
            nodes[i ? i + shift : job->tasks[task].node] = node;
        }
        at += job->subtree_counts[task] - 1;
    }
}

static mt_status join(const build_job *job, mt_aabb_tree *tree)
{
    uint64_t count = job->top_count;
    for (mt_index task = 0; task < job->task_count; task++) {
        if (!job->subtrees[task]) {
            return mt_fail(job->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while building the tree of boxes");
        }
        count += job->subtree_counts[task] - 1;
    }
    tree->nodes = mt_allocate_array(job->context, count, sizeof *tree->nodes);
    if (!tree->nodes) {
        return mt_context_error(job->context)->status;
    }
    tree->node_count = (mt_index)count;
    join_subtrees(job, tree->nodes);
    return MT_OK;
}

mt_status mt_aabb_build(mt_context *context, mt_aabb_tree *tree)
{
    mt_index count = tree->primitive_count;
    build_job job = {.context = context, .primitives = tree->primitives};
    job.top_capacity = 8 * (count / TASK_SIZE) + 64;
    job.top_nodes = mt_allocate_array(context, job.top_capacity, sizeof *job.top_nodes);
    job.tasks = mt_allocate_array(context, job.top_capacity, sizeof *job.tasks);
    job.subtrees = mt_allocate_array_zeroed(context, job.top_capacity, sizeof *job.subtrees);
    job.subtree_counts = mt_allocate_array_zeroed(context, job.top_capacity, sizeof *job.subtree_counts);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.top_nodes && job.tasks && job.subtrees && job.subtree_counts) {
        build_top(&job, count);
        status =
            mt_make_in_batches(context, "building the tree of boxes", TOP_SHARE, job.task_count, build_subtrees, &job);
        status = status == MT_OK ? join(&job, tree) : status;
        for (mt_index task = 0; task < job.task_count; task++) {
            mt_free(context, job.subtrees[task]);
        }
    }
    mt_free(context, job.subtree_counts);
    mt_free(context, job.subtrees);
    mt_free(context, job.tasks);
    mt_free(context, job.top_nodes);
    return status;
}
