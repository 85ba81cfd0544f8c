#include "lib/spatial/part_batches.h"

/* Enough for threads to share evenly, and made within a second by any of them. */
#define BATCH_SIZE 64

typedef struct batch {
    mt_parallel_body body;
    void *user;
    uint64_t first;
} batch;

static void make_batch(void *user, uint64_t begin, uint64_t end)
{
    const batch *b = user;
    b->body(b->user, b->first + begin, b->first + end);
}

mt_status mt_make_in_batches(mt_context *context, const char *task, double share, uint64_t part_count,
                             mt_parallel_body body, void *user)
{
    mt_status status = MT_OK;
    for (batch b = {body, user, 0}; status == MT_OK && b.first < part_count; b.first += BATCH_SIZE) {
        uint64_t left = part_count - b.first, count = left < BATCH_SIZE ? left : BATCH_SIZE;
        mt_parallel_for(context, count, 1, make_batch, &b);
        double done = (double)(b.first + count) / (double)part_count;
        status = mt_progress(context, task, share + (1 - share) * done);
    }
    return status;
}
