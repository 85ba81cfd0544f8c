/* The pairs of primitives of one tree whose boxes overlap: the tree against itself.
 *
 * A pair of nodes is either one node with itself, which becomes its children with themselves and with each other, or
 * two different ones, of which the larger is opened while their boxes overlap. The first pairs are opened breadth
 * first until there are enough to be tasks. No recursion: a pair of nodes opens into at most three, so the stack of a
 * task stays below twice the depth of both. */
#include <meshtool/aabb_tree.h>

#define BATCH_SIZE 1024
#define STACK_CAPACITY 4096 /* aabb_build.c bounds the depth by 557 */

typedef struct node_pair {
    mt_index a, b;
} node_pair;

typedef struct pair_search {
    const mt_aabb_tree *tree;
    mt_pair_function function;
    void *user;
    node_pair tasks[MT_PAIR_TASKS_MAXIMUM];
    mt_index task_count;
} pair_search;

typedef struct pair_batch {
    const pair_search *search;
    mt_index task;
    bool stopped;
    size_t count;
    mt_primitive_pair pairs[BATCH_SIZE];
} pair_batch;

static void flush(pair_batch *batch)
{
    if (batch->count && !batch->stopped) {
        batch->stopped = !batch->search->function(batch->search->user, batch->task, batch->pairs, batch->count);
    }
    batch->count = 0;
}

static void add_places(pair_batch *batch, mt_index i, mt_index j)
{
    const mt_aabb_tree *tree = batch->search->tree;
    if (mt_box_overlaps(&tree->boxes[i], &tree->boxes[j])) {
        batch->pairs[batch->count++] = (mt_primitive_pair){tree->primitives[i], tree->primitives[j]};
        if (batch->count == BATCH_SIZE) {
            flush(batch);
        }
    }
}

static void add_leaf_pairs(pair_batch *batch, const mt_aabb_node *a, const mt_aabb_node *b)
{
    for (mt_index i = a->first; i < a->first + a->count; i++) {
        for (mt_index j = a == b ? i + 1 : b->first; j < b->first + b->count; j++) {
            add_places(batch, i, j);
        }
    }
}

static float half_area(const mt_box *box)
{
    float x = box->upper[0] - box->lower[0], y = box->upper[1] - box->lower[1], z = box->upper[2] - box->lower[2];
    return x * y + y * z + z * x;
}

/* Opens a pair into at most three, those that can still hold overlapping primitives; returns how many. Not for two
 * leaves. */
static int open_pair(const mt_aabb_tree *tree, node_pair pair, node_pair opened[3])
{
    const mt_aabb_node *a = &tree->nodes[pair.a], *b = &tree->nodes[pair.b];
    if (pair.a == pair.b) {
        opened[0] = (node_pair){a->first, a->first};
        opened[1] = (node_pair){a->first + 1, a->first + 1};
        opened[2] = (node_pair){a->first, a->first + 1};
        return mt_box_overlaps(&tree->nodes[a->first].box, &tree->nodes[a->first + 1].box) ? 3 : 2;
    }
    bool open_a = b->count || (!a->count && half_area(&a->box) >= half_area(&b->box));
    const mt_aabb_node *larger = open_a ? a : b, *other = open_a ? b : a;
    mt_index other_number = open_a ? pair.b : pair.a;
    int count = 0;
    for (mt_index child = larger->first; child < larger->first + 2; child++) {
        if (mt_box_overlaps(&tree->nodes[child].box, &other->box)) {
            opened[count++] = (node_pair){child, other_number};
        }
    }
    return count;
}

static bool is_leaf_pair(const mt_aabb_tree *tree, node_pair pair)
{
    return tree->nodes[pair.a].count && tree->nodes[pair.b].count;
}

static void search_pair(const pair_search *search, mt_index task)
{
    const mt_aabb_tree *tree = search->tree;
    pair_batch batch = {.search = search, .task = task};
    node_pair stack[STACK_CAPACITY];
    size_t depth = 0;
    stack[depth++] = search->tasks[task];
    while (depth && !batch.stopped) {
        node_pair pair = stack[--depth];
        if (is_leaf_pair(tree, pair)) {
            add_leaf_pairs(&batch, &tree->nodes[pair.a], &tree->nodes[pair.b]);
        } else {
            depth += (size_t)open_pair(tree, pair, stack + depth);
        }
    }
    flush(&batch);
}

static void search_tasks(void *user, uint64_t begin, uint64_t end)
{
    for (uint64_t task = begin; task < end; task++) {
        search_pair(user, (mt_index)task);
    }
}

/* Opens the root's pair, oldest first, while there is room for what one opens into. */
static void make_tasks(pair_search *search)
{
    mt_index unopened = 0; /* tasks before this one are pairs of leaves */
    search->tasks[0] = (node_pair){0, 0};
    search->task_count = 1;
    while (unopened < search->task_count && search->task_count + 3 <= MT_PAIR_TASKS_MAXIMUM) {
        node_pair pair = search->tasks[unopened], opened[3];
        if (is_leaf_pair(search->tree, pair)) {
            unopened++;
            continue;
        }
        int count = open_pair(search->tree, pair, opened);
        search->task_count--;
        for (mt_index i = unopened; i < search->task_count; i++) {
            search->tasks[i] = search->tasks[i + 1];
        }
        for (int i = 0; i < count; i++) {
            search->tasks[search->task_count++] = opened[i];
        }
    }
}

mt_status mt_aabb_tree_self_pairs(mt_context *context, const mt_aabb_tree *tree, mt_pair_function function, void *user)
{
    if (!tree->node_count) {
        return MT_OK;
    }
    pair_search *search = mt_allocate(context, sizeof *search);
    if (!search) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    search->tree = tree;
    search->function = function;
    search->user = user;
    make_tasks(search);
    mt_parallel_for(context, search->task_count, 1, search_tasks, search);
    mt_free(context, search);
    return MT_OK;
}
