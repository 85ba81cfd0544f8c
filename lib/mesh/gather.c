#include "lib/mesh/gather.h"

#include <string.h>

#define GATHER_GRAIN 65536 /* elements in a block: some 100 microseconds of copying */

typedef struct gather {
    const char *source;
    char *target;
    const mt_index *map;
    size_t size;
    int missing;
} gather;

static void gather_indices(const gather *job, uint64_t begin, uint64_t end)
{
    const uint32_t *source = (const void *)job->source;
    uint32_t *target = (void *)job->target;
    uint32_t missing = job->missing ? UINT32_MAX : 0;
    for (uint64_t i = begin; i < end; i++) {
        target[i] = job->map[i] == MT_NONE ? missing : source[job->map[i]];
    }
}

static void gather_block(void *user, uint64_t begin, uint64_t end)
{
    const gather *job = user;
    if (!job->map) {
        memcpy(job->target + begin * job->size, job->source + begin * job->size, (end - begin) * job->size);
        return;
    }
    if (job->size == sizeof(mt_index)) {
        gather_indices(job, begin, end);
        return;
    }
    for (uint64_t i = begin; i < end; i++) {
        char *to = job->target + i * job->size;
        if (job->map[i] == MT_NONE) {
            memset(to, job->missing, job->size);
        } else {
            memcpy(to, job->source + job->map[i] * job->size, job->size);
        }
    }
}

void mt_gather(mt_context *context, const void *source, void *target, const mt_index *map, uint64_t count, size_t size,
               int missing)
{
    gather job = {source, target, map, size, missing};
    mt_parallel_for(context, count, GATHER_GRAIN, gather_block, &job);
}
