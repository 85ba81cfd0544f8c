/* Top-down building of wide nodes.
 *
 * A node begins with its range as one child; the child of largest area that is too large for a leaf is split
 * (surface_split.c) until there are eight, or all are leaves; what slots are left then split leaves further, which
 * costs no memory, as leaves are packed. The top of the tree is built by parallel passes until ranges are small enough
 * to be tasks; each task builds its subtree in its own nodes, which are then copied behind one another in the order of
 * the tasks. Nothing depends on the number of threads.
 *
 * Memory while building: 64 bytes an element for boxes and scratch, and the nodes of the tasks once more. The depth is
 * bounded: from level 48 on ranges are halved. Known weakness: splits by centroids alone; long thin triangles overlap
 * more than spatial splits would let them, at no less than half again the memory. */
#include "lib/spatial/part_batches.h"
#include "lib/spatial/surface_split.h"

#define TASK_SIZE 8192   /* elements of a subtree that one thread builds */
#define SMALLEST_SPLIT 3 /* leaves of fewer are not split to fill slots */
#define TOP_SHARE 0.3    /* of the time: the top's */

/* Elements for each node at least: a node that has a node among its children has eight, any other more elements than a
 * leaf; from both, n elements make 0.24 n nodes at most. */
#define ELEMENTS_PER_NODE 4

typedef struct waiting {
    mt_surface_range range;
    mt_index node;
    mt_index depth;
} waiting;

/* Nodes being made: of the top, or of one task. */
typedef struct growing {
    mt_surface_node *nodes;
    mt_index count;
} growing;

typedef struct build_job {
    mt_context *context;
    mt_surface_tree *tree;
    mt_split_work work;
    growing top;
    mt_index top_capacity;
    waiting *tasks; /* whose node in the top tree awaits a subtree */
    mt_index task_count;
    growing *subtrees; /* per task */
    mt_index *starts;  /* per task: where its nodes after the first go */
} build_job;

static mt_index size_of(const mt_surface_range *range)
{
    return range->end - range->begin;
}

/* The child to split next among those of more than `limit` elements: of largest area, or of most elements where ranges
 * are halved, so that an eighth is left to each; -1: none. */
static int choose_child(const mt_surface_range *children, int count, mt_index limit, bool halve)
{
    int chosen = -1;
    float largest = -1;
    for (int i = 0; i < count; i++) {
        float extent = halve ? (float)size_of(&children[i]) : mt_surface_half_area(&children[i].bounds);
        if (size_of(&children[i]) > limit && extent > largest) {
            largest = extent;
            chosen = i;
        }
    }
    return chosen;
}

/* Splits a range into up to eight; returns how many. */
static int open_range(const mt_split_work *work, const waiting *item, mt_surface_range children[MT_WIDTH])
{
    int count = 1;
    mt_index limit = MT_SURFACE_LEAF_SIZE;
    bool halve = item->depth >= MT_SURFACE_HALVING_DEPTH;
    children[0] = item->range;
    while (count < MT_WIDTH) {
        int chosen = choose_child(children, count, limit, halve);
        if (chosen < 0 && limit == SMALLEST_SPLIT - 1) {
            break;
        }
        if (chosen < 0) {
            limit = SMALLEST_SPLIT - 1;
            continue;
        }
        mt_surface_range parts[2];
        mt_surface_split(work, &children[chosen], halve, parts);
        children[chosen] = parts[0];
        children[count++] = parts[1];
    }
    return count;
}

static void clear_node(mt_surface_node *node)
{
    for (int slot = 0; slot < MT_WIDTH; slot++) {
        for (int axis = 0; axis < 3; axis++) {
            node->planes[2 * axis][slot] = INFINITY;
            node->planes[2 * axis + 1][slot] = -INFINITY;
        }
        node->children[slot] = MT_SURFACE_UNUSED;
    }
}

static void set_planes(mt_surface_node *node, int slot, const box *bounds)
{
    for (int axis = 0; axis < 3; axis++) {
        node->planes[2 * axis][slot] = bounds->lower[axis];
        node->planes[2 * axis + 1][slot] = bounds->upper[axis];
    }
}

static void write_leaf(const mt_surface_tree *tree, const mt_surface_box *boxes, const mt_surface_range *range)
{
    mt_index count = size_of(range);
    uint32_t *words = tree->words + (size_t)range->begin * MT_SURFACE_WORDS;
    for (mt_index i = 0; i < count; i++) {
        mt_index number = boxes[range->begin + i].number;
        mt_surface_element element = mt_surface_element_of(tree->mesh, tree->triangulation, &tree->numbering, number);
        for (mt_index side = 0; side < 3; side++) {
            mt_vec3 p = mt_ray_space_point(&tree->space, mt_mesh_position(tree->mesh, element.vertices[side]));
            const float corner[3] = {(float)p.x, (float)p.y, (float)p.z};
            for (mt_index axis = 0; axis < 3; axis++) {
                memcpy(words + (3 * side + axis) * count + i, &corner[axis], sizeof *words);
            }
        }
        words[9 * count + i] = number;
    }
}

/* Fills a node; its inner children take the next numbers and are returned in `opened`. */
static int make_node(const build_job *job, const mt_split_work *work, const waiting *item, growing *into,
                     waiting opened[MT_WIDTH])
{
    mt_surface_range children[MT_WIDTH];
    int count = open_range(work, item, children), inner_count = 0;
    mt_surface_node *node = &into->nodes[item->node];
    clear_node(node);
    for (int slot = 0; slot < count; slot++) {
        set_planes(node, slot, &children[slot].bounds);
        if (size_of(&children[slot]) <= MT_SURFACE_LEAF_SIZE) {
            write_leaf(job->tree, work->boxes, &children[slot]);
            node->children[slot] = mt_surface_leaf(children[slot].begin, size_of(&children[slot]));
        } else {
            node->children[slot] = into->count;
            opened[inner_count++] = (waiting){children[slot], into->count++, item->depth + 1};
        }
    }
    return inner_count;
}

static mt_index build_subtree(const build_job *job, const waiting *root, growing *into)
{
    waiting stack[MT_SURFACE_STACK];
    mt_split_work alone = job->work;
    alone.context = NULL;
    mt_index waiting_count = 1;
    stack[0] = *root;
    stack[0].node = 0;
    into->count = 1;
    while (waiting_count) {
        waiting item = stack[--waiting_count];
        waiting_count += (mt_index)make_node(job, &alone, &item, into, stack + waiting_count);
    }
    return into->count;
}

static void build_subtrees(void *user, uint64_t begin, uint64_t end)
{
    build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        growing *subtree = &job->subtrees[task];
        uint64_t capacity = size_of(&job->tasks[task].range) / ELEMENTS_PER_NODE + 1;
        subtree->nodes = mt_try_allocate(job->context, capacity * sizeof *subtree->nodes);
        if (subtree->nodes) {
            build_subtree(job, &job->tasks[task], subtree);
        }
    }
}

/* Builds from the root until every range is a task. */
static void build_top(build_job *job)
{
    waiting stack[MT_SURFACE_STACK];
    mt_index waiting_count = 1;
    stack[0] = (waiting){mt_surface_range_of(&job->work, 0, job->tree->count), 0, 0};
    job->top.count = 1;
    while (waiting_count) {
        waiting item = stack[--waiting_count];
        if (size_of(&item.range) <= TASK_SIZE || job->top.count + MT_WIDTH > job->top_capacity) {
            job->tasks[job->task_count++] = item;
        } else {
            waiting_count += (mt_index)make_node(job, &job->work, &item, &job->top, stack + waiting_count);
        }
    }
}

/* A subtree's root takes its place in the top, the rest follows behind. */
static void copy_subtrees(void *user, uint64_t begin, uint64_t end)
{
    const build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        const growing *from = &job->subtrees[task];
        mt_index shift = job->starts[task] - 1; /* node i > 0 of the subtree goes to i + shift */
        for (mt_index i = 0; i < from->count; i++) {
            mt_surface_node *to = &job->tree->nodes[i ? i + shift : job->tasks[task].node];
            *to = from->nodes[i];
            for (int slot = 0; slot < MT_WIDTH; slot++) {
                to->children[slot] += to->children[slot] & MT_SURFACE_LEAF ? 0 : shift;
            }
        }
        mt_free(job->context, from->nodes);
        job->subtrees[task].nodes = NULL;
    }
}

static mt_status join_subtrees(build_job *job)
{
    uint64_t count = job->top.count;
    for (mt_index task = 0; task < job->task_count; task++) {
        if (!job->subtrees[task].nodes) {
            return mt_fail(job->context, MT_ERROR_OUT_OF_MEMORY, "out of memory while building the tree of boxes");
        }
        job->starts[task] = (mt_index)count;
        count += job->subtrees[task].count - 1;
    }
    job->tree->nodes = mt_allocate_array(job->context, count, sizeof *job->tree->nodes);
    if (!job->tree->nodes) {
        return mt_context_error(job->context)->status;
    }
    job->tree->node_count = (mt_index)count;
    memcpy(job->tree->nodes, job->top.nodes, job->top.count * sizeof *job->top.nodes);
    mt_parallel_for(job->context, job->task_count, 1, copy_subtrees, job);
    return MT_OK;
}

static bool allocate_job(build_job *job)
{
    mt_index count = job->tree->count;
    job->top_capacity = 8 * (count / TASK_SIZE) + 64;
    job->top.nodes = mt_allocate_array(job->context, job->top_capacity, sizeof *job->top.nodes);
    job->tasks = mt_allocate_array(job->context, (uint64_t)job->top_capacity * MT_WIDTH, sizeof *job->tasks);
    job->subtrees =
        mt_allocate_array_zeroed(job->context, (uint64_t)job->top_capacity * MT_WIDTH, sizeof *job->subtrees);
    job->starts = mt_allocate_array(job->context, (uint64_t)job->top_capacity * MT_WIDTH, sizeof *job->starts);
    job->work.scratch = mt_allocate_array(job->context, count, sizeof *job->work.scratch);
    job->work.blocks = mt_allocate_array(job->context, MT_SPLIT_BLOCKS, sizeof *job->work.blocks);
    return job->top.nodes && job->tasks && job->subtrees && job->starts && job->work.scratch && job->work.blocks;
}

static void release_job(build_job *job)
{
    for (mt_index task = 0; task < job->task_count; task++) {
        mt_free(job->context, job->subtrees[task].nodes);
    }
    mt_free(job->context, job->work.blocks);
    mt_free(job->context, job->work.scratch);
    mt_free(job->context, job->starts);
    mt_free(job->context, job->subtrees);
    mt_free(job->context, job->tasks);
    mt_free(job->context, job->top.nodes);
}

mt_status mt_surface_build(mt_context *context, mt_surface_tree *tree, mt_surface_box *boxes)
{
    build_job job = {
        .context = context, .tree = tree, .work = {.context = context, .quality = tree->quality, .boxes = boxes}};
    uint64_t words = (uint64_t)tree->count * MT_SURFACE_WORDS + MT_WIDTH;
    tree->words = mt_allocate_array(context, words, sizeof *tree->words);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (tree->words && allocate_job(&job)) {
        memset(tree->words + (words - MT_WIDTH), 0, MT_WIDTH * sizeof *tree->words);
        build_top(&job);
        status =
            mt_make_in_batches(context, "building the tree of boxes", TOP_SHARE, job.task_count, build_subtrees, &job);
    }
    if (status == MT_OK) {
        status = join_subtrees(&job);
    }
    release_job(&job);
    return status;
}
