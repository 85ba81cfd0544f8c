/* Making the BSP tree: cells are cut from the root until cutting does not pay, the depth is used up, or the entries
 * are: each cell may make so many duplicates, and leaves what it did not use to its halves. Entries are thus O(n),
 * nodes too, and time O(n log n).
 *
 * The pieces of the cell in work lie at the end of a list, those of the cells that wait before them. Cells of few
 * triangles are tasks of their own, made in parallel and joined in order: the tree depends on the triangles alone. */
#include "lib/spatial/growing.h"
#include "lib/spatial/part_batches.h"
#include "lib/spatial/ray_bsp.h"

#define TASK_SIZE 4096
#define PROGRESS "building the BSP tree"

/* Of the time: the top's. */
#define TOP_SHARE 0.4

#define LEAF_SIZE 2

/* Of the triangles: entries beyond the first of each. */
#define DUPLICATES_PER_TRIANGLE 3

/* A cell that waits, and its node. */
typedef struct waiting {
    mt_ray_bsp_cell cell;
    uint32_t node;
} waiting;

/* A part of the tree that is made in one go. */
typedef struct part {
    mt_growing nodes, entries, pieces, above;
    uint32_t node; /* of its root in the top */
    mt_ray_bsp_cell cell;
    bool is_complete;
} part;

typedef struct build_job {
    mt_context *context;
    const mt_packed_triangles *triangles;
    unsigned depth;
    part top;
    mt_growing parts;
    double done;      /* share of the top; duplicates do not take it back */
    mt_status status; /* MT_ERROR_CANCELLED: asked to stop */
} build_job;

static mt_surface_box *pieces_of(const part *p, const mt_ray_bsp_cell *cell)
{
    return (mt_surface_box *)p->pieces.items + (p->pieces.count - cell->count);
}

static bool make_leaf(const build_job *job, part *p, const waiting *item)
{
    mt_index count = item->cell.count;
    if (!mt_growing_reserve(job->context, &p->entries, count, sizeof(mt_index))) {
        return false;
    }
    const mt_surface_box *pieces = pieces_of(p, &item->cell);
    mt_index *entries = (mt_index *)p->entries.items + p->entries.count;
    for (mt_index i = 0; i < count; i++) {
        entries[i] = pieces[i].number;
    }
    ((mt_ray_bsp_node *)p->nodes.items)[item->node] =
        (mt_ray_bsp_node){.first = (uint32_t)p->entries.count, .word = count << 2 | MT_RAY_BSP_LEAF};
    p->entries.count += count;
    p->pieces.count -= count;
    return true;
}

/* The bins' counts are not exact: what the plane really makes must fit. */
static bool is_affordable(const mt_ray_bsp_cell *cell, const mt_surface_box *pieces, mt_ray_bsp_plane plane)
{
    uint64_t both = 0;
    for (mt_index i = 0; i < cell->count; i++) {
        both += (double)pieces[i].lower[plane.axis] <= (double)plane.at + MT_RAY_NEARNESS &&
                (double)pieces[i].upper[plane.axis] >= (double)plane.at - MT_RAY_NEARNESS;
    }
    return both <= cell->duplicates;
}

static void share_duplicates(const mt_ray_bsp_cell *cell, mt_ray_bsp_cell halves[2])
{
    uint64_t made = (uint64_t)halves[0].count + halves[1].count;
    uint64_t left = made > cell->count ? cell->duplicates - (made - cell->count) : cell->duplicates;
    halves[0].duplicates = made ? left * halves[0].count / made : 0;
    halves[1].duplicates = left - halves[0].duplicates;
}

/* Deals the pieces of a cell, which stand last in the list: those below, then those above. */
static bool split(const build_job *job, part *p, const waiting *item, mt_ray_bsp_plane plane, waiting halves[2])
{
    mt_ray_bsp_cell cells[2];
    mt_index count = item->cell.count;
    if (!mt_growing_reserve(job->context, &p->above, count, sizeof(mt_surface_box)) ||
        !mt_growing_reserve(job->context, &p->nodes, 2, sizeof(mt_ray_bsp_node))) {
        return false;
    }
    mt_surface_box *above = p->above.items;
    mt_ray_bsp_deal(job->triangles, &item->cell, plane, pieces_of(p, &item->cell), above, cells);
    p->pieces.count = p->pieces.count - count + cells[0].count;
    if (!mt_growing_reserve(job->context, &p->pieces, cells[1].count, sizeof(mt_surface_box))) {
        return false;
    }
    memcpy((mt_surface_box *)p->pieces.items + p->pieces.count, above, cells[1].count * sizeof *above);
    p->pieces.count += cells[1].count;
    share_duplicates(&item->cell, cells);
    uint32_t child = (uint32_t)p->nodes.count;
    ((mt_ray_bsp_node *)p->nodes.items)[item->node] =
        (mt_ray_bsp_node){.plane = plane.at, .word = child << 2 | plane.axis};
    halves[0] = (waiting){cells[0], child};
    halves[1] = (waiting){cells[1], child + 1};
    p->nodes.count += 2;
    return true;
}

/* Moves the pieces of a cell out of the top into a task. */
static bool make_task(build_job *job, const waiting *item)
{
    part task = {.node = item->node, .cell = item->cell};
    if (!mt_growing_reserve(job->context, &job->parts, 1, sizeof task) ||
        !mt_growing_reserve(job->context, &task.pieces, item->cell.count, sizeof(mt_surface_box)) ||
        !mt_growing_reserve(job->context, &task.nodes, 1, sizeof(mt_ray_bsp_node))) {
        mt_free(job->context, task.pieces.items);
        return false;
    }
    memcpy(task.pieces.items, pieces_of(&job->top, &item->cell), item->cell.count * sizeof(mt_surface_box));
    task.pieces.count = item->cell.count;
    task.nodes.count = 1;
    job->top.pieces.count -= item->cell.count;
    ((part *)job->parts.items)[job->parts.count++] = task;
    return true;
}

/* Asked before a cell of the top. */
static bool may_go_on(build_job *job)
{
    job->done = fmax(job->done, 1 - (double)job->top.pieces.count / (double)job->triangles->count);
    job->status = mt_progress(job->context, PROGRESS, TOP_SHARE * job->done);
    return job->status == MT_OK;
}

/* Makes a part from its root on. Cells of at most task_size triangles are left to tasks, unless empty. */
static bool make_part(build_job *job, part *p, mt_index task_size)
{
    waiting stack[MT_RAY_BSP_DEPTH + 2];
    size_t depth = 1;
    stack[0] = (waiting){p->cell, 0};
    bool is_made = true;
    while (depth && is_made) {
        waiting item = stack[--depth];
        if (item.cell.count && item.cell.count <= task_size) {
            is_made = make_task(job, &item);
            continue;
        }
        if (task_size && !may_go_on(job)) {
            return false;
        }
        mt_ray_bsp_plane plane = {MT_RAY_BSP_LEAF, 0};
        if (item.cell.count > LEAF_SIZE && item.cell.depth < job->depth) {
            plane = mt_ray_bsp_choose(&item.cell, pieces_of(p, &item.cell));
        }
        if (plane.axis == MT_RAY_BSP_LEAF || !is_affordable(&item.cell, pieces_of(p, &item.cell), plane)) {
            is_made = make_leaf(job, p, &item);
        } else {
            is_made = split(job, p, &item, plane, stack + depth);
            depth += 2;
        }
    }
    return is_made;
}

static void release_work(mt_context *context, part *p)
{
    mt_free(context, p->pieces.items);
    mt_free(context, p->above.items);
    p->pieces = p->above = (mt_growing){.count = 0};
}

static void make_parts(void *user, uint64_t begin, uint64_t end)
{
    build_job *job = user;
    for (uint64_t task = begin; task < end; task++) {
        part *p = (part *)job->parts.items + task;
        p->is_complete = make_part(job, p, 0);
        release_work(job->context, p);
    }
}

static bool make_top(build_job *job)
{
    const mt_packed_triangles *triangles = job->triangles;
    part *top = &job->top;
    if (!mt_growing_reserve(job->context, &top->pieces, triangles->count, sizeof(mt_surface_box)) ||
        !mt_growing_reserve(job->context, &top->nodes, 1, sizeof(mt_ray_bsp_node))) {
        return false;
    }
    for (mt_index at = 0; at < triangles->count; at++) {
        mt_surface_box *piece = (mt_surface_box *)top->pieces.items + at;
        *piece = (mt_surface_box){.number = at};
        for (int axis = 0; axis < 3; axis++) {
            const float *row = triangles->items[at].rows[axis];
            piece->lower[axis] = fminf(fminf(row[0], row[1]), row[2]);
            piece->upper[axis] = fmaxf(fmaxf(row[0], row[1]), row[2]);
        }
    }
    top->pieces.count = top->cell.count = triangles->count;
    top->cell.duplicates = (uint64_t)triangles->count * DUPLICATES_PER_TRIANGLE;
    top->nodes.count = 1;
    for (int axis = 0; axis < 3; axis++) {
        top->cell.lower[axis] = mt_round_down((double)triangles->lower[axis] - MT_RAY_NEARNESS);
        top->cell.upper[axis] = mt_round_up((double)triangles->upper[axis] + MT_RAY_NEARNESS);
    }
    return make_part(job, top, TASK_SIZE);
}

/* A part's root takes its place in the top, the rest of its nodes follow behind. */
static void join_part(mt_ray_bsp *bsp, const part *p)
{
    const mt_ray_bsp_node *nodes = p->nodes.items;
    uint32_t shift = (uint32_t)bsp->node_count - 1, first = (uint32_t)bsp->entry_count;
    for (uint64_t i = 0; i < p->nodes.count; i++) {
        mt_ray_bsp_node node = nodes[i];
        if (mt_ray_bsp_axis(&node) == MT_RAY_BSP_LEAF) {
            node.first += first;
        } else {
            node.word += shift << 2;
        }
        bsp->nodes[i ? i + shift : p->node] = node;
    }
    if (p->entries.count) {
        memcpy(bsp->entries + first, p->entries.items, p->entries.count * sizeof *bsp->entries);
    }
    bsp->node_count += p->nodes.count - 1;
    bsp->entry_count += p->entries.count;
}

static mt_status join_parts(build_job *job, mt_ray_bsp *bsp)
{
    const part *parts = job->parts.items;
    uint64_t node_count = job->top.nodes.count, entry_count = job->top.entries.count;
    for (uint64_t i = 0; i < job->parts.count; i++) {
        node_count += parts[i].nodes.count - 1;
        entry_count += parts[i].entries.count;
    }
    if (node_count > UINT32_MAX >> 2 || entry_count > UINT32_MAX >> 2) {
        return mt_fail(job->context, MT_ERROR_TOO_LARGE, "the mesh needs a BSP tree of %llu nodes, it holds %u at most",
                       (unsigned long long)node_count, UINT32_MAX >> 2);
    }
    bsp->nodes = mt_allocate_array(job->context, node_count, sizeof *bsp->nodes);
    bsp->entries = mt_allocate_array(job->context, entry_count, sizeof *bsp->entries);
    if (!bsp->nodes || !bsp->entries) {
        return mt_context_error(job->context)->status;
    }
    bsp->node_count = 1; /* the top's own root is counted */
    job->top.node = 0;
    join_part(bsp, &job->top);
    for (uint64_t i = 0; i < job->parts.count; i++) {
        join_part(bsp, &parts[i]);
    }
    return MT_OK;
}

static void release_job(build_job *job)
{
    for (uint64_t i = 0; i <= job->parts.count; i++) {
        part *p = i ? (part *)job->parts.items + (i - 1) : &job->top;
        release_work(job->context, p);
        mt_free(job->context, p->nodes.items);
        mt_free(job->context, p->entries.items);
    }
    mt_free(job->context, job->parts.items);
}

mt_status mt_ray_bsp_build(mt_context *context, mt_ray_bsp *bsp)
{
    build_job job = {.context = context, .triangles = &bsp->triangles, .depth = 8};
    for (mt_index count = bsp->triangles.count; count > 1; count /= 2) {
        job.depth++;
    }
    job.depth += (job.depth - 8) * 3 / 10;
    bool is_made = make_top(&job);
    release_work(context, &job.top);
    if (is_made) {
        job.status = mt_make_in_batches(context, PROGRESS, TOP_SHARE, job.parts.count, make_parts, &job);
    }
    for (uint64_t i = 0; i < job.parts.count; i++) {
        is_made &= ((part *)job.parts.items)[i].is_complete;
    }
    if (job.status == MT_OK) {
        job.status =
            is_made ? join_parts(&job, bsp) : mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "out of memory while " PROGRESS);
    }
    release_job(&job);
    return job.status;
}
