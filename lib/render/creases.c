/* The faces around creased vertices. Blocks of faces collect their corners at such vertices, in parallel; the pairs
 * are then sorted by vertex with their order kept, so that each list ascends. */
#include "lib/render/corner_normals.h"

#include <string.h>

#define FACE_BLOCK 32768

typedef struct pair {
    mt_index vertex, face;
} pair;

/* What a block of faces found. */
typedef struct found {
    pair *pairs;
    uint64_t count;
    bool failed;
} found;

typedef struct collect_task {
    mt_context *context;
    const mt_corner_normals *normals;
    found *blocks;
} collect_task;

/* Stores the corners of some faces at creased vertices; returns how many there are. */
static uint64_t visit(const mt_corner_normals *normals, uint64_t begin, uint64_t end, pair *pairs)
{
    const mt_mesh *mesh = normals->model->mesh;
    const unsigned char *flags = normals->model->flags;
    uint64_t count = 0;
    for (uint64_t f = begin; f < end; f++) {
        mt_index face = (mt_index)f, last = mt_mesh_face_end(mesh, face);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < last; corner++) {
            mt_index vertex = mt_joined_vertex(normals, mesh->corner_vertices[corner]);
            if (flags[vertex] & MT_VERTEX_CREASED) {
                pairs[count++] = (pair){vertex, face};
            }
        }
    }
    return count;
}

/* Room for every corner of the block is taken for a moment: going over the faces once more would cost more. */
static void collect(void *user, uint64_t begin, uint64_t end)
{
    const collect_task *task = (const collect_task *)user;
    const mt_mesh *mesh = task->normals->model->mesh;
    found *block = &task->blocks[begin / FACE_BLOCK];
    uint64_t corner_count = mt_mesh_face_end(mesh, (mt_index)(end - 1)) - mt_mesh_face_begin(mesh, (mt_index)begin);
    pair *pairs = (pair *)mt_try_allocate(task->context, corner_count * sizeof(pair));
    block->failed = !pairs;
    block->count = pairs ? visit(task->normals, begin, end, pairs) : 0;
    if (block->count > 0) {
        block->pairs = (pair *)mt_try_allocate(task->context, block->count * sizeof(pair));
        block->failed = !block->pairs;
    }
    if (block->pairs) {
        memcpy(block->pairs, pairs, (size_t)block->count * sizeof(pair));
    }
    mt_free(task->context, pairs);
}

/* Calls for every pair in the order of the faces, in three rounds. */
enum { CLEAR, COUNT, STORE, ROUND_COUNT };

static void sort_pairs(mt_corner_normals *normals, const found *blocks, size_t block_count)
{
    mt_index next = 0;
    for (int round = CLEAR; round < ROUND_COUNT; round++) {
        for (size_t b = 0; b < block_count; b++) {
            for (uint64_t i = 0; i < blocks[b].count; i++) {
                mt_vertex_shading *at = &normals->vertices[blocks[b].pairs[i].vertex];
                if (round == CLEAR) {
                    at->faces.first = MT_NONE;
                    at->faces.count = 0;
                } else if (round == COUNT) {
                    at->faces.count++;
                } else {
                    if (at->faces.first == MT_NONE) {
                        at->faces.first = next;
                        next += at->faces.count;
                        at->faces.count = 0;
                    }
                    normals->incident_faces[at->faces.first + at->faces.count++] = blocks[b].pairs[i].face;
                }
            }
        }
    }
}

static mt_status store(mt_context *context, mt_corner_normals *normals, const found *blocks, size_t block_count)
{
    uint64_t total = 0;
    for (size_t b = 0; b < block_count; b++) {
        if (blocks[b].failed) {
            return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory left for the faces around creases");
        }
        total += blocks[b].count;
    }
    normals->incident_faces = (mt_index *)mt_allocate_array(context, total, sizeof(mt_index));
    if (!normals->incident_faces) {
        return mt_context_error(context)->status;
    }
    sort_pairs(normals, blocks, block_count);
    return MT_OK;
}

mt_status mt_list_creased(mt_context *context, mt_corner_normals *normals)
{
    uint64_t face_count = normals->model->mesh->face_count;
    size_t block_count = (size_t)((face_count + FACE_BLOCK - 1) / FACE_BLOCK);
    found *blocks = (found *)mt_allocate_array_zeroed(context, block_count, sizeof *blocks);
    if (!blocks) {
        return mt_context_error(context)->status;
    }
    collect_task task = {context, normals, blocks};
    mt_parallel_for(context, face_count, FACE_BLOCK, collect, &task);
    mt_status status = store(context, normals, blocks, block_count);
    for (size_t b = 0; b < block_count; b++) {
        mt_free(context, blocks[b].pairs);
    }
    mt_free(context, blocks);
    return status;
}
