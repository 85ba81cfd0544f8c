/* The pairs of primitives of one tree whose boxes overlap: the tree against itself.
 *
 * A pair of nodes is either one node with itself, which becomes its children with themselves and with each other, or
 * two different ones, of which the larger is opened while their boxes overlap. The first pairs are opened breadth
 * first until there are enough to be tasks. No recursion: a pair of nodes opens into at most three, so the stack of a
 * task stays below twice the depth of both. */
#include "lib/spatial/aabb_build.h"
#include "lib/spatial/box.h"

#define BATCH_SIZE 1024
#define STACK_CAPACITY 4096 /* aabb_build.c bounds the depth by 557 */

typedef struct node_pair {
    mt_index a, b;
} node_pair;

typedef struct pair_search {
    const mt_aabb_tree *tree;
    const mt_index *keys; /* four a primitive, or NULL */
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

/* Each of a primitive's keys in all lanes. Those that are missing repeat another, so that they match nothing else.
 * False when all are missing. */
static bool spread_keys(const mt_index *keys, int4 spread[3])
{
    mt_index any = MT_NONE;
    for (int i = 0; i < 3; i++) {
        any = keys[i] == MT_NONE ? any : keys[i];
    }
    for (int i = 0; i < 3; i++) {
        int32_t key = (int32_t)(keys[i] == MT_NONE ? any : keys[i]);
        spread[i] = (int4){key, key, key, key};
    }
    return any != MT_NONE;
}

static bool holds_key(const mt_index *keys, const int4 spread[3])
{
    int4 own;
    memcpy(&own, keys, sizeof own);
    return (int4_lanes((own == spread[0]) | (own == spread[1]) | (own == spread[2])) & 7) != 0;
}

static void add_row(pair_batch *batch, mt_index place, mt_index begin, mt_index end)
{
    const mt_aabb_primitive *primitives = batch->search->tree->primitives;
    box own = box_load(&primitives[place]);
    for (mt_index j = begin; j < end; j++) {
        batch->pairs[batch->count] = (mt_primitive_pair){primitives[place].number, primitives[j].number};
        batch->count += box_overlaps(own, box_load(&primitives[j])); /* no branch: half of them do */
    }
}

static void add_keyed_row(pair_batch *batch, mt_index place, mt_index begin, mt_index end, const int4 spread[3])
{
    const mt_aabb_primitive *primitives = batch->search->tree->primitives;
    const mt_index *keys = batch->search->keys;
    box own = box_load(&primitives[place]);
    for (mt_index j = begin; j < end; j++) {
        batch->pairs[batch->count] = (mt_primitive_pair){primitives[place].number, primitives[j].number};
        bool overlaps = box_overlaps(own, box_load(&primitives[j]));
        bool is_left_out = holds_key(keys + 4 * (size_t)j, spread);
        batch->count += overlaps & !is_left_out;
    }
}

/* The pairs of the primitive at one place with those in [begin, end). */
static void add_pairs(pair_batch *batch, mt_index place, mt_index begin, mt_index end)
{
    int4 spread[3];
    if (batch->count + MT_AABB_LEAF_SIZE > BATCH_SIZE) {
        flush(batch);
    }
    if (batch->search->keys && spread_keys(batch->search->keys + 4 * (size_t)place, spread)) {
        add_keyed_row(batch, place, begin, end, spread);
    } else {
        add_row(batch, place, begin, end);
    }
}

static void add_leaf_pairs(pair_batch *batch, const mt_aabb_node *a, const mt_aabb_node *b)
{
    const mt_aabb_primitive *primitives = batch->search->tree->primitives;
    box other = box_load(b);
    for (mt_index i = a->first; i < a->first + a->count; i++) {
        if (box_overlaps(box_load(&primitives[i]), other)) {
            add_pairs(batch, i, a == b ? i + 1 : b->first, b->first + b->count);
        }
    }
}

static float half_area(const mt_aabb_node *node)
{
    box b = box_load(node);
    float4 side = b.upper - b.lower;
    return side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
}

static bool nodes_overlap(const mt_aabb_node *a, const mt_aabb_node *b)
{
    return box_overlaps(box_load(a), box_load(b));
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
        return nodes_overlap(&tree->nodes[a->first], &tree->nodes[a->first + 1]) ? 3 : 2;
    }
    bool open_a = b->count || (!a->count && half_area(a) >= half_area(b));
    const mt_aabb_node *larger = open_a ? a : b, *other = open_a ? b : a;
    mt_index other_number = open_a ? pair.b : pair.a;
    int count = 0;
    for (mt_index child = larger->first; child < larger->first + 2; child++) {
        if (nodes_overlap(&tree->nodes[child], other)) {
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

mt_status mt_aabb_tree_self_pairs(mt_context *context, const mt_aabb_tree *tree, const mt_index *keys,
                                  mt_pair_function function, void *user)
{
    if (!tree->node_count) {
        return MT_OK;
    }
    pair_search *search = mt_allocate(context, sizeof *search);
    if (!search) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    search->tree = tree;
    search->keys = keys;
    search->function = function;
    search->user = user;
    make_tasks(search);
    mt_parallel_for(context, search->task_count, 1, search_tasks, search);
    mt_free(context, search);
    return MT_OK;
}
