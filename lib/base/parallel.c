/* The one file that knows the threading library. Blocks are fixed by `grain` alone and handed out as threads
 * become free, so what a block computes never depends on how many threads there are. */
#include "lib/base/context.h"

#include <sched.h>

#ifdef MESHTOOL_OPENMP
#include <omp.h>
#endif

unsigned mt_available_threads(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        int count = CPU_COUNT(&set);
        return count > 0 ? (unsigned)count : 1u;
    }
    return 1;
}

static void run_block(uint64_t block, uint64_t count, uint64_t grain, mt_parallel_body body, void *user)
{
    uint64_t begin = block * grain;
    uint64_t end = count - begin < grain ? count : begin + grain;
    body(user, begin, end);
}

void mt_parallel_for(mt_context *context, uint64_t count, uint64_t grain, mt_parallel_body body, void *user)
{
    if (count == 0) {
        return;
    }
    uint64_t block_count = (count - 1) / grain + 1;
    (void)context; /* unused where OpenMP is switched off */
#ifdef MESHTOOL_OPENMP
    if (block_count > 1 && context->thread_count > 1) {
        int threads = context->thread_count < block_count ? (int)context->thread_count : (int)block_count;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
        for (uint64_t block = 0; block < block_count; block++) {
            run_block(block, count, grain, body, user);
        }
        return;
    }
#endif
    for (uint64_t block = 0; block < block_count; block++) {
        run_block(block, count, grain, body, user);
    }
}
