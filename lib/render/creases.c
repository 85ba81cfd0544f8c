/* The faces around creased vertices. Blocks of faces collect their corners at such vertices, in parallel; the pairs
 * are then sorted by vertex with their order kept, so that each list ascends. */
#include "lib/render/corner_normals.h"

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

/* Goes over the corners of some faces at creased vertices; stores them when `pairs` is not NULL. */
static uint64_t visit(const mt_corner_normals *normals, uint64_t begin, uint64_t end, pair *pairs)
{
    const mt_mesh *mesh = normals->model->mesh;
    const unsigned char *flags = normals->model->flags;
    uint64_t count = 0;
    for (uint64_t f = begin; f < end; f++) {
        mt_index face = (mt_index)f, last = mt_mesh_face_end(mesh, face);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < last; corner++) {
            mt_index vertex = mt_joined_vertex(normals, mesh->corner_vertices[corner]);
            if (!(flags[vertex] & MT_VERTEX_CREASED)) {
                continue;
            }
            if (pairs) {
                pairs[count] = (pair){vertex, face};
            }
            count++;
        }
    }
    return count;
}

static void collect(void *user, uint64_t begin, uint64_t end)
{
    const collect_task *task = (const collect_task *)user;
    found *block = &task->blocks[begin / FACE_BLOCK];
    block->count = visit(task->normals, begin, end, NULL);
    if (block->count > 0) {
        block->pairs = (pair *)mt_try_allocate(task->context, block->count * sizeof(pair));
        block->failed = !block->pairs;
    }
    if (block->pairs) {
        visit(task->normals, begin, end, block->pairs);
    }
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
