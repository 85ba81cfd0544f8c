/* A counting sort by tile. The primitives are cut into fixed blocks; each counts its own by tile, sums over tile and
 * block give every block its place in every tile's list, and each fills its own: parallel, and in ascending order
 * whoever runs what. */
#include "lib/render/bins.h"

#include <string.h>

/* A primitive whose range has more tiles is listed once for all of them, which bounds the memory. */
#define LARGE_TILE_COUNT 256

#define BLOCK_COUNT 64
#define BLOCK_SIZE 8192

typedef struct bin_task {
    const mt_binned *binned;
    mt_bins *bins;
    uint64_t grain;
    uint64_t block_count;
    size_t tile_count;
    mt_tile_range *ranges;  /* per primitive */
    size_t *places;         /* [block][tile]: counts, then places in bins->numbers */
    mt_index *large_counts; /* per block */
} bin_task;

static bool is_empty(mt_tile_range range)
{
    return range.first_x > range.last_x;
}

static bool is_large(mt_tile_range range)
{
    return (range.last_x - range.first_x + 1) * (range.last_y - range.first_y + 1) > LARGE_TILE_COUNT;
}

/* Adds a primitive of several tiles to each that it touches, or only counts. */
static void visit_tiles(const bin_task *task, mt_index number, mt_tile_range range, size_t *places, bool fill)
{
    const mt_binned *binned = task->binned;
    /* In a block of two by two tiles most are touched. */
    bool narrow = range.last_x - range.first_x > 1 && range.last_y > range.first_y;
    for (uint32_t y = range.first_y; y <= range.last_y; y++) {
        mt_tile_range row = range;
        if (narrow) {
            binned->narrow(binned->user, number, y, &row);
        }
        for (uint32_t x = row.first_x; x <= row.last_x; x++) {
            size_t *place = places + (size_t)y * task->bins->tiles_x + x;
            if (fill) {
                task->bins->numbers[*place] = number;
            }
            (*place)++;
        }
    }
}

static bool is_single(mt_tile_range range)
{
    return range.first_x == range.last_x && range.first_y == range.last_y;
}

static void count_block(void *user, uint64_t begin, uint64_t end)
{
    const bin_task *task = (const bin_task *)user;
    size_t *places = task->places + begin / task->grain * task->tile_count;
    memset(places, 0, task->tile_count * sizeof *places);
    mt_index large = 0;
    for (uint64_t i = begin; i < end; i++) {
        mt_tile_range range = task->binned->range(task->binned->user, (mt_index)i);
        task->ranges[i] = range;
        if (is_empty(range)) {
            continue;
        }
        if (is_single(range)) {
            places[(size_t)range.first_y * task->bins->tiles_x + range.first_x]++;
        } else if (is_large(range)) {
            large++;
        } else {
            visit_tiles(task, (mt_index)i, range, places, false);
        }
    }
    task->large_counts[begin / task->grain] = large;
}

static void fill_block(void *user, uint64_t begin, uint64_t end)
{
    const bin_task *task = (const bin_task *)user;
    size_t *places = task->places + begin / task->grain * task->tile_count;
    mt_index large = task->large_counts[begin / task->grain];
    for (uint64_t i = begin; i < end; i++) {
        mt_tile_range range = task->ranges[i];
        if (is_empty(range)) {
            continue;
        }
        if (is_single(range)) {
            task->bins->numbers[places[(size_t)range.first_y * task->bins->tiles_x + range.first_x]++] = (mt_index)i;
        } else if (is_large(range)) {
            task->bins->large[large++] = (mt_index)i;
        } else {
            visit_tiles(task, (mt_index)i, range, places, true);
        }
    }
}

/* Turns the counts of every block and tile into places. */
static void assign_places(bin_task *task)
{
    size_t sum = 0;
    for (size_t tile = 0; tile < task->tile_count; tile++) {
        task->bins->firsts[tile] = sum;
        for (uint64_t block = 0; block < task->block_count; block++) {
            size_t *place = task->places + block * task->tile_count + tile, here = *place;
            *place = sum;
            sum += here;
        }
    }
    task->bins->firsts[task->tile_count] = sum;
    mt_index large = 0;
    for (uint64_t block = 0; block < task->block_count; block++) {
        mt_index here = task->large_counts[block];
        task->large_counts[block] = large;
        large += here;
    }
    task->bins->large_count = large;
}

static mt_status allocate(mt_context *context, bin_task *task)
{
    task->ranges = (mt_tile_range *)mt_allocate_array(context, task->binned->count, sizeof *task->ranges);
    task->places = (size_t *)mt_allocate_array(context, task->block_count * task->tile_count, sizeof *task->places);
    task->large_counts = (mt_index *)mt_allocate_array(context, task->block_count, sizeof *task->large_counts);
    task->bins->firsts = (size_t *)mt_allocate_array(context, task->tile_count + 1, sizeof *task->bins->firsts);
    bool have = task->ranges && task->places && task->large_counts && task->bins->firsts;
    return have ? MT_OK : mt_context_error(context)->status;
}

static mt_status sort(mt_context *context, bin_task *task)
{
    mt_status status = allocate(context, task);
    if (status != MT_OK) {
        return status;
    }
    mt_bins *bins = task->bins;
    mt_parallel_for(context, task->binned->count, task->grain, count_block, task);
    assign_places(task);
    bins->numbers = (mt_index *)mt_allocate_array(context, bins->firsts[task->tile_count], sizeof *bins->numbers);
    bins->large = (mt_index *)mt_allocate_array(context, bins->large_count, sizeof *bins->large);
    if (!bins->numbers || !bins->large) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, task->binned->count, task->grain, fill_block, task);
    return MT_OK;
}

mt_status mt_bins_init(mt_context *context, const mt_binned *binned, uint32_t width, uint32_t height, mt_bins *bins)
{
    memset(bins, 0, sizeof *bins);
    bins->tiles_x = (width - 1) / MT_TILE_SIZE + 1;
    bins->tiles_y = (height - 1) / MT_TILE_SIZE + 1;
    bin_task task = {.binned = binned, .bins = bins};
    task.tile_count = (size_t)bins->tiles_x * bins->tiles_y;
    task.grain = ((uint64_t)binned->count + BLOCK_COUNT - 1) / BLOCK_COUNT;
    task.grain = task.grain > BLOCK_SIZE ? task.grain : BLOCK_SIZE;
    task.block_count = ((uint64_t)binned->count + task.grain - 1) / task.grain;
    mt_status status = sort(context, &task);
    mt_free(context, task.ranges);
    mt_free(context, task.places);
    mt_free(context, task.large_counts);
    if (status != MT_OK) {
        mt_bins_release(context, bins);
    }
    return status;
}

void mt_bins_release(mt_context *context, mt_bins *bins)
{
    mt_free(context, bins->firsts);
    mt_free(context, bins->numbers);
    mt_free(context, bins->large);
    memset(bins, 0, sizeof *bins);
}
