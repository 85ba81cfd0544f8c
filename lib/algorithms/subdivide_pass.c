#include "lib/algorithms/subdivide_pass.h"

#include <assert.h>

mt_status mt_subdivide_pass_init(mt_context *context, mt_index face_count, size_t capacity, mt_subdivide_pass *pass)
{
    *pass = (mt_subdivide_pass){.face_count = face_count, .capacity = capacity};
    pass->loops = mt_allocate_array(context, capacity, sizeof *pass->loops);
    return pass->loops ? MT_OK : mt_context_error(context)->status;
}

void mt_subdivide_pass_release(mt_context *context, mt_subdivide_pass *pass)
{
    mt_free(context, pass->loops);
    pass->loops = NULL;
}

void mt_subdivide_pass_add(mt_subdivide_pass *pass, const mt_subdivide_loop *loop, mt_parallel_body body,
                           uint64_t count)
{
    assert(pass->loop_count < pass->capacity);
    mt_subdivide_loop *added = &pass->loops[pass->loop_count++];
    *added = *loop;
    added->body = body;
    added->count = count;
}

static uint64_t block_count(const mt_subdivide_pass *pass)
{
    return pass->face_count < MT_SUBDIVIDE_ALONE ? 1 : (uint64_t)pass->face_count / MT_SUBDIVIDE_GRAIN;
}

/* Block b of n runs, of each loop, its share from count b / n on. */
static void run_blocks(void *user, uint64_t begin, uint64_t end)
{
    mt_subdivide_pass *pass = user;
    uint64_t n = block_count(pass);
    for (uint64_t block = begin; block < end; block++) {
        for (size_t i = 0; i < pass->loop_count; i++) {
            mt_subdivide_loop *loop = &pass->loops[i];
            loop->body(loop, loop->count * block / n, loop->count * (block + 1) / n);
        }
    }
}

void mt_subdivide_pass_run(mt_context *context, mt_subdivide_pass *pass)
{
    if (pass->loop_count) {
        mt_parallel_for(context, block_count(pass), 1, run_blocks, pass);
    }
}
