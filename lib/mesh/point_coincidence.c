/* Whether points coincide: their hashes are dealt into buckets by the highest bits, and each bucket is gone through
 * with a table that fits the cache. Points are dealt in a few ranges at once, each with its own part of every bucket.
 * Parts have a fixed room: hashes of different points fill them evenly, so one that overflows has coinciding points in
 * it. Cost: linear, about 2 ns a point and thread; 10 bytes a point. */
#include "lib/mesh/point_key.h"

#include <meshtool/weld.h>

#include <math.h>

#define RANGE_COUNT 4
#define TABLE_BITS 14 /* fits the second-level cache; a quarter of it is used, or less */
#define TABLE_SIZE (1u << TABLE_BITS)

/* How far a part may be above its mean, in standard deviations: at 8 none of 2^40 parts is by chance. */
#define ROOM_DEVIATIONS 8

typedef struct coincidence {
    mt_context *context;
    const char *positions;
    mt_type type;
    mt_index point_count;
    unsigned bucket_bits;
    mt_index room;     /* of a part */
    uint64_t *hashes;  /* per bucket and range `room` of them */
    mt_index *counts;  /* per range and bucket */
    uint8_t *possible; /* per range, then per bucket: whether points there coincide, or memory was missing */
} coincidence;

static inline mt_index bucket_count_of(const coincidence *job)
{
    return (mt_index)1 << job->bucket_bits;
}

/* Deals the points of one range; false when a part overflows. `type` is a constant where this is called. */
static inline bool deal(const coincidence *job, mt_index range, mt_type type)
{
    mt_index *counts = job->counts + (size_t)range * bucket_count_of(job);
    memset(counts, 0, bucket_count_of(job) * sizeof *counts);
    uint64_t *hashes = job->hashes + (size_t)range * job->room;
    size_t bucket_stride = (size_t)RANGE_COUNT * job->room, stride = 3 * mt_type_size(type);
    uint64_t begin = (uint64_t)job->point_count * range / RANGE_COUNT;
    uint64_t end = (uint64_t)job->point_count * (range + 1) / RANGE_COUNT;
    for (uint64_t point = begin; point < end; point++) {
        uint64_t hash = hash_key(load_key(job->positions + point * stride, type));
        uint64_t bucket = hash >> 1 >> (63 - job->bucket_bits);
        mt_index at = counts[bucket]++;
        if (at == job->room) {
            return false;
        }
        hashes[bucket * bucket_stride + at] = hash;
    }
    return true;
}

static void deal_ranges(void *user, uint64_t begin, uint64_t end)
{
    const coincidence *job = user;
    for (uint64_t range = begin; range < end; range++) {
        bool dealt = job->type == MT_F32 ? deal(job, (mt_index)range, MT_F32) : deal(job, (mt_index)range, MT_F64);
        job->possible[range] = !dealt;
    }
}

/* Enters hashes in the table; true when one was there already. A slot holds the low half of a hash, 0 none: a hash
 * whose low half is 0 takes 1 instead. */
static bool enter(const coincidence *job, const uint64_t *hashes, mt_index count, uint32_t *table)
{
    for (mt_index i = 0; i < count; i++) {
        uint32_t tag = (uint32_t)hashes[i] ? (uint32_t)hashes[i] : 1;
        uint32_t at = (uint32_t)(hashes[i] << job->bucket_bits >> (64 - TABLE_BITS));
        for (; table[at]; at = (at + 1) % TABLE_SIZE) {
            if (table[at] == tag) {
                return true;
            }
        }
        table[at] = tag;
    }
    return false;
}

static bool bucket_repeats(const coincidence *job, mt_index bucket, uint32_t *table)
{
    bool repeats = false;
    memset(table, 0, TABLE_SIZE * sizeof *table);
    for (mt_index range = 0; range < RANGE_COUNT && !repeats; range++) {
        mt_index count = job->counts[(size_t)range * bucket_count_of(job) + bucket];
        repeats = enter(job, job->hashes + ((size_t)bucket * RANGE_COUNT + range) * job->room, count, table);
    }
    return repeats;
}

static void search_buckets(void *user, uint64_t begin, uint64_t end)
{
    const coincidence *job = user;
    uint32_t table[TABLE_SIZE];
    for (uint64_t bucket = begin; bucket < end; bucket++) {
        job->possible[bucket] = bucket_repeats(job, (mt_index)bucket, table);
    }
}

static bool any(const uint8_t *flags, mt_index count)
{
    return memchr(flags, 1, count) != NULL;
}

static mt_status search(coincidence *job, bool *possible)
{
    mt_index bucket_count = bucket_count_of(job);
    uint64_t part_count = (uint64_t)RANGE_COUNT * bucket_count;
    job->hashes = mt_allocate_array(job->context, part_count * job->room, sizeof *job->hashes);
    job->counts = mt_allocate_array(job->context, part_count, sizeof *job->counts);
    job->possible = mt_allocate(job->context, part_count);
    mt_status status = job->hashes && job->counts && job->possible ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        mt_parallel_for(job->context, RANGE_COUNT, 1, deal_ranges, job);
        *possible = any(job->possible, RANGE_COUNT);
        if (!*possible) {
            mt_parallel_for(job->context, bucket_count, 16, search_buckets, job);
            *possible = any(job->possible, bucket_count);
        }
    }
    mt_free(job->context, job->possible);
    mt_free(job->context, job->counts);
    mt_free(job->context, job->hashes);
    return status;
}

mt_status mt_points_may_coincide(mt_context *context, const void *positions, mt_type type, mt_index point_count,
                                 bool *possible)
{
    coincidence job = {.context = context, .positions = positions, .type = type, .point_count = point_count};
    *possible = false;
    if (point_count < 2) {
        return MT_OK;
    }
    while (point_count >> job.bucket_bits > TABLE_SIZE / 4) {
        job.bucket_bits++;
    }
    double mean = ldexp((double)point_count, -(int)job.bucket_bits) / RANGE_COUNT;
    job.room = (mt_index)(mean + ROOM_DEVIATIONS * sqrt(mean)) + 16;
    return search(&job, possible);
}
