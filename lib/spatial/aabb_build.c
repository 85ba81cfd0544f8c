/* Top-down building by the spatial middle.
 *
 * A range is cut at the middle of the longest side of its centroids' bounds; where that leaves one side empty (all
 * centroids equal, or a difference lost in rounding) it is cut in the middle of its order, so the depth is bounded:
 * a side halves at most 175 times before two floats of [-2, 2] are equal, which makes 525 for three axes, and 32 more
 * for the count. The top of the tree is cut serially until ranges are
 * small enough to be tasks; each task builds its subtree in its own nodes, and the subtrees are then copied behind one
 * another in the order of their ranges. Nothing depends on the number of threads.
 *
 * Cost: about log2(n) passes over 28 bytes a primitive. Known weakness: the surface-area heuristic makes better trees
 * for rays; for boxes against boxes of a surface the middle is as good and several times faster to find. */
#include "lib/spatial/aabb_build.h"

#include <string.h>

#define TASK_SIZE 8192      /* primitives of a subtree that one thread builds */
#define STACK_CAPACITY 1024 /* more than the depth bound above */

typedef struct build_range {
    mt_index begin, end;
    mt_index node; /* where its node goes */
} build_range;

typedef struct build_job {
    mt_context *context;
    boxed_primitive *primitives;
    mt_aabb_node *top_nodes;
    mt_index top_count, top_capacity;
    build_range *tasks; /* ranges whose node in the top tree awaits a subtree */
    mt_index task_count;
    mt_aabb_node **subtrees; /* per task */
    mt_index *subtree_counts;
} build_job;

static mt_box empty_box(void)
{
    mt_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    return box;
}

static void grow_box(mt_box *box, const mt_box *by)
{
    for (int axis = 0; axis < 3; axis++) {
        box->lower[axis] = by->lower[axis] < box->lower[axis] ? by->lower[axis] : box->lower[axis];
        box->upper[axis] = by->upper[axis] > box->upper[axis] ? by->upper[axis] : box->upper[axis];
    }
}

/* Twice the centroid: the sum needs no division, and orders the same. */
static float doubled_center(const mt_box *box, int axis)
{
    return box->lower[axis] + box->upper[axis];
}

/* The box of a range, and that of its doubled centroids. */
static mt_box bound_range(const boxed_primitive *primitives, build_range range, mt_box *centers)
{
    mt_box box = empty_box();
    *centers = empty_box();
    for (mt_index i = range.begin; i < range.end; i++) {
        const mt_box *one = &primitives[i].box;
        grow_box(&box, one);
        mt_box point;
        for (int axis = 0; axis < 3; axis++) {
            point.lower[axis] = point.upper[axis] = doubled_center(one, axis);
        }
        grow_box(centers, &point);
    }
    return box;
}

static mt_index partition(boxed_primitive *primitives, build_range range, int axis, float middle)
{
    mt_index low = range.begin, high = range.end;
    while (low < high) {
        if (doubled_center(&primitives[low].box, axis) < middle) {
            low++;
        } else {
            high--;
            boxed_primitive swapped = primitives[low];
            primitives[low] = primitives[high];
            primitives[high] = swapped;
        }
    }
    return low;
}

static mt_index cut_range(boxed_primitive *primitives, build_range range, const mt_box *centers)
{
    int axis = 0;
    float longest = -1;
    for (int i = 0; i < 3; i++) {
        float length = centers->upper[i] - centers->lower[i];
        if (length > longest) {
            longest = length;
            axis = i;
        }
    }
    float middle = 0.5f * centers->lower[axis] + 0.5f * centers->upper[axis];
    mt_index cut = partition(primitives, range, axis, middle);
    bool one_sided = cut == range.begin || cut == range.end;
    return one_sided ? range.begin + (range.end - range.begin) / 2 : cut;
}

/* Fills the range's node; an inner one gets its two children's places at *count and pushes their ranges. */
static bool make_node(boxed_primitive *primitives, build_range range, mt_aabb_node *nodes, mt_index *count,
                      build_range children[2])
{
    mt_box centers;
    mt_aabb_node *node = &nodes[range.node];
    node->box = bound_range(primitives, range, &centers);
    if (range.end - range.begin <= MT_AABB_LEAF_SIZE) {
        node->first = range.begin;
        node->count = range.end - range.begin;
        return false;
    }
    mt_index cut = cut_range(primitives, range, &centers);
    node->first = *count;
    node->count = 0;
    children[0] = (build_range){range.begin, cut, *count};
    children[1] = (build_range){cut, range.end, *count + 1};
    *count += 2;
    return true;
}

static mt_index build_subtree(boxed_primitive *primitives, build_range range, mt_aabb_node *nodes)
{
    build_range stack[STACK_CAPACITY];
    mt_index depth = 0, count = 1;
    range.node = 0;
    stack[depth++] = range;
    while (depth) {
        build_range children[2];
        if (make_node(primitives, stack[--depth], nodes, &count, children)) {
            stack[depth++] = children[1];
            stack[depth++] = children[0];
        }
    }
    return count;
}

static void build_subtrees(void *user, uint64_t begin, uint64_t end)
{
    build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        build_range range = job->tasks[task];
        uint64_t capacity = 2 * (uint64_t)(range.end - range.begin);
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
    build_range stack[STACK_CAPACITY];
    mt_index depth = 0;
    job->top_count = 1;
    stack[depth++] = (build_range){0, count, 0};
    while (depth) {
        build_range range = stack[--depth], children[2];
        bool is_task = range.end - range.begin <= TASK_SIZE || job->top_count + 2 > job->top_capacity;
        if (is_task) {
            job->tasks[job->task_count++] = range;
        } else if (make_node(job->primitives, range, job->top_nodes, &job->top_count, children)) {
            stack[depth++] = children[1];
            stack[depth++] = children[0];
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

mt_status mt_aabb_build(mt_context *context, boxed_primitive *primitives, mt_index count, mt_aabb_tree *tree)
{
    build_job job = {.context = context, .primitives = primitives};
    job.top_capacity = 8 * (count / TASK_SIZE) + 64;
    job.top_nodes = mt_allocate_array(context, job.top_capacity, sizeof *job.top_nodes);
    job.tasks = mt_allocate_array(context, job.top_capacity, sizeof *job.tasks);
    job.subtrees = mt_allocate_array_zeroed(context, job.top_capacity, sizeof *job.subtrees);
    job.subtree_counts = mt_allocate_array_zeroed(context, job.top_capacity, sizeof *job.subtree_counts);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.top_nodes && job.tasks && job.subtrees && job.subtree_counts) {
        build_top(&job, count);
        mt_parallel_for(context, job.task_count, 1, build_subtrees, &job);
        status = join(&job, tree);
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
