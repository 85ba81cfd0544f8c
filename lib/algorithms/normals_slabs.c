/* The first and the last block of each group: of blocks whose vertices are near each other, all groups between the
 * lowest and the highest count; of others every corner is asked. */
#include "lib/algorithms/normals_slabs.h"

#include <meshtool/clones.h>

#include <string.h>

/* Groups that a block may span before its corners are asked. */
#define NEAR_GROUPS 4

static MT_CLONES void find_lowest_and_highest(const mt_index *vertices, mt_index count, mt_face_block *block)
{
    mt_index low = MT_NONE, high = 0;
    for (mt_index i = 0; i < count; i++) {
        low = vertices[i] < low ? vertices[i] : low;
        high = vertices[i] > high ? vertices[i] : high;
    }
    block->low = low;
    block->high = high;
}

static void find_block(void *user, uint64_t begin, uint64_t end)
{
    const mt_slab_plan *plan = user;
    mt_index corner = mt_mesh_face_begin(plan->mesh, (mt_index)begin);
    mt_index corner_count = mt_mesh_face_end(plan->mesh, (mt_index)end - 1) - corner;
    find_lowest_and_highest(plan->mesh->corner_vertices + corner, corner_count, &plan->blocks[begin / MT_FACE_BLOCK]);
}

/* In place of the lists while they are not made: the first and the last block of each group. */
static void note_group(mt_slab_plan *plan, mt_index group, mt_index block)
{
    mt_index *first = &plan->next_opened[group];
    *first = *first == MT_NONE ? block : *first;
    plan->next_closed[group] = block;
}

static void note_groups(mt_slab_plan *plan, mt_index block)
{
    const mt_mesh *mesh = plan->mesh;
    mt_index low = plan->blocks[block].low >> MT_SLAB_SHIFT, high = plan->blocks[block].high >> MT_SLAB_SHIFT;
    if (high - low < NEAR_GROUPS) {
        for (mt_index group = low; group <= high; group++) {
            note_group(plan, group, block);
        }
        return;
    }
    mt_index face = block * MT_FACE_BLOCK;
    mt_index end = mt_mesh_face_end(mesh, mt_face_block_end(plan, face) - 1);
    for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < end; corner++) {
        note_group(plan, mesh->corner_vertices[corner] >> MT_SLAB_SHIFT, block);
    }
}

static void prepend(mt_index *list, mt_index *next, mt_index group)
{
    *next = *list;
    *list = group;
}

static void make_lists(mt_slab_plan *plan)
{
    for (mt_index group = 0; group < plan->group_count; group++) {
        mt_index first = plan->next_opened[group], last = plan->next_closed[group];
        bool is_open = first != MT_NONE;
        prepend(&plan->opened[is_open ? first : plan->block_count], &plan->next_opened[group], group);
        if (is_open) {
            prepend(&plan->closed[last], &plan->next_closed[group], group);
        }
    }
}

static mt_index *allocate_filled(mt_context *context, uint64_t count)
{
    mt_index *list = mt_allocate_array(context, count, sizeof *list);
    if (list) {
        memset(list, 0xff, count * sizeof *list); /* MT_NONE */
    }
    return list;
}

mt_status mt_slab_plan_init(mt_context *context, const mt_mesh *mesh, mt_slab_plan *plan)
{
    *plan = (mt_slab_plan){.mesh = mesh};
    plan->block_count = (mt_index)(((uint64_t)mesh->face_count + MT_FACE_BLOCK - 1) / MT_FACE_BLOCK);
    plan->group_count = (mt_index)(((uint64_t)mesh->vertex_count + MT_SLAB_SIZE - 1) >> MT_SLAB_SHIFT);
    plan->blocks = mt_allocate_array(context, plan->block_count, sizeof *plan->blocks);
    plan->opened = allocate_filled(context, (uint64_t)plan->block_count + 1);
    plan->closed = allocate_filled(context, (uint64_t)plan->block_count + 1);
    plan->next_opened = allocate_filled(context, plan->group_count);
    plan->next_closed = allocate_filled(context, plan->group_count);
    if (!(plan->blocks && plan->opened && plan->closed && plan->next_opened && plan->next_closed)) {
        mt_slab_plan_release(context, plan);
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, mesh->face_count, MT_FACE_BLOCK, find_block, plan);
    for (mt_index block = 0; block < plan->block_count; block++) {
        note_groups(plan, block);
    }
    make_lists(plan);
    return MT_OK;
}

void mt_slab_plan_release(mt_context *context, mt_slab_plan *plan)
{
    mt_free(context, plan->blocks);
    mt_free(context, plan->opened);
    mt_free(context, plan->closed);
    mt_free(context, plan->next_opened);
    mt_free(context, plan->next_closed);
    *plan = (mt_slab_plan){0};
}

static mt_index count_in_range(const mt_index *list, const mt_index *next, mt_index begin, mt_index end)
{
    mt_index count = 0;
    for (mt_index group = *list; group != MT_NONE; group = next[group]) {
        count += group >= begin && group < end;
    }
    return count;
}

mt_index mt_slab_plan_peak(const mt_slab_plan *plan, mt_index group_begin, mt_index group_end)
{
    mt_index held = 0, peak = 0;
    for (mt_index block = 0; block < plan->block_count; block++) {
        held += count_in_range(&plan->opened[block], plan->next_opened, group_begin, group_end);
        peak = held > peak ? held : peak;
        held -= count_in_range(&plan->closed[block], plan->next_closed, group_begin, group_end);
    }
    return peak;
}
