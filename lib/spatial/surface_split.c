/* The binned surface-area heuristic (Wald 2007): the boxes of a range fall into bins by their centroids, on each axis;
 * of the planes between bins the one is taken for which area times count, summed over both sides, is least. Ranges
 * whose centroids are all but equal are cut in the middle of their order.
 *
 * A large range is worked on in at most MT_SPLIT_BLOCKS parallel blocks that depend on its size alone; unions and
 * counts are exact, and the order is kept within each side, so that nothing depends on the number of threads. Three
 * passes over 32 bytes a box, about log2(n) times in all. */
#include "lib/spatial/surface_split.h"

#define BLOCK_SIZE 16384 /* boxes of a block at least; a range of fewer than four of them is not shared out */

/* Few boxes do not pay for many bins. */
#define SMALL_RANGE 64
#define SMALL_BINS 8

/* Centroids closer than this, of coordinates up to 2, are one; the reciprocal must be finite. */
#define SMALLEST_EXTENT 0x1p-100f

/* Keeps the largest centroid in the last bin. */
#define BELOW_ONE 0.99999f

typedef struct binning {
    float4 origin, scale;
    int bin_count;
} binning;

typedef struct plane {
    int axis, bin; /* boxes of this bin and above go right; axis -1: there is none */
} plane;

typedef struct block_job {
    const mt_split_work *work;
    const mt_surface_range *range;
    binning map;
    plane cut;
    mt_index block_size;
} block_job;

static float4 center_of(const box *b)
{
    const int4 three = {-1, -1, -1, 0}; /* the fourth lane holds a number */
    return (float4)((int4)(b->lower + b->upper) & three);
}

static binning choose_binning(const mt_surface_range *range)
{
    binning map = {.origin = range->centers.lower, .scale = {0, 0, 0, 0}};
    map.bin_count = range->end - range->begin < SMALL_RANGE ? SMALL_BINS : MT_SPLIT_BINS;
    float4 extent = range->centers.upper - range->centers.lower;
    for (int axis = 0; axis < 3; axis++) {
        bool is_wide = extent[axis] > SMALLEST_EXTENT;
        map.scale[axis] = is_wide ? (float)map.bin_count * BELOW_ONE / extent[axis] : 0;
    }
    return map;
}

/* Two bins across the axis along which the centroids lie farthest apart; no axis has a scale where they are one. */
static binning halve_longest(const mt_surface_range *range)
{
    binning map = {.origin = range->centers.lower, .scale = {0, 0, 0, 0}, .bin_count = 2};
    float4 extent = range->centers.upper - range->centers.lower;
    int axis = extent[0] >= extent[1] ? 0 : 1;
    axis = extent[2] > extent[axis] ? 2 : axis;
    map.scale[axis] = extent[axis] > SMALLEST_EXTENT ? 2 * BELOW_ONE / extent[axis] : 0;
    return map;
}

static plane middle_of(const binning *map)
{
    for (int axis = 0; axis < 3; axis++) {
        if (map->scale[axis] > 0) {
            return (plane){axis, 1};
        }
    }
    return (plane){-1, 0};
}

static void clear_bins(mt_split_bins *bins, int bin_count)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int bin = 0; bin < bin_count; bin++) {
            bins->bounds[axis][bin] = box_empty();
            bins->counts[axis][bin] = 0;
        }
    }
}

static void fill_bins(const mt_surface_box *boxes, mt_index begin, mt_index end, const binning *map,
                      mt_split_bins *bins)
{
    for (mt_index i = begin; i < end; i++) {
        box one = box_load(&boxes[i]);
        int4 bin = __builtin_convertvector((center_of(&one) - map->origin) * map->scale, int4);
        for (int axis = 0; axis < 3; axis++) {
            box *into = &bins->bounds[axis][bin[axis]];
            *into = box_join(*into, one);
            bins->counts[axis][bin[axis]]++;
        }
    }
}

static void fill_blocks(void *user, uint64_t begin, uint64_t end)
{
    const block_job *job = user;
    mt_split_block *block = &job->work->blocks[begin / job->block_size];
    clear_bins(&block->bins, job->map.bin_count);
    fill_bins(job->work->boxes, job->range->begin + (mt_index)begin, job->range->begin + (mt_index)end, &job->map,
              &block->bins);
}

static void join_bins(mt_split_bins *into, const mt_split_bins *from, int bin_count)
{
    for (int axis = 0; axis < 3; axis++) {
        for (int bin = 0; bin < bin_count; bin++) {
            into->bounds[axis][bin] = box_join(into->bounds[axis][bin], from->bounds[axis][bin]);
            into->counts[axis][bin] += from->counts[axis][bin];
        }
    }
}

/* Area times count of both sides of each plane of an axis; keeps the best so far. */
static void weigh_planes(const mt_split_bins *bins, int axis, int bin_count, plane *best, float *best_cost)
{
    float costs[MT_SPLIT_BINS];
    box side = box_empty();
    mt_index count = 0;
    for (int bin = bin_count - 1; bin > 0; bin--) {
        side = box_join(side, bins->bounds[axis][bin]);
        count += bins->counts[axis][bin];
        costs[bin] = count ? mt_surface_half_area(&side) * (float)count : INFINITY;
    }
    side = box_empty();
    count = 0;
    for (int bin = 1; bin < bin_count; bin++) {
        side = box_join(side, bins->bounds[axis][bin - 1]);
        count += bins->counts[axis][bin - 1];
        float cost = count ? mt_surface_half_area(&side) * (float)count + costs[bin] : INFINITY;
        if (cost < *best_cost) {
            *best_cost = cost;
            *best = (plane){axis, bin};
        }
    }
}

static plane choose_plane(const mt_split_bins *bins, int bin_count)
{
    plane best = {-1, 0};
    float cost = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        weigh_planes(bins, axis, bin_count, &best, &cost);
    }
    return best;
}

/* Writes each box of [begin, end) to the left or the right output, in order; returns the number that went left. The
 * bounds of each side are found where bins have not told them. */
static inline __attribute__((always_inline)) mt_index deal_boxes(const block_job *job, mt_index begin, mt_index end,
                                                                 mt_surface_box *left, mt_surface_box *right,
                                                                 mt_split_sides *sides, bool finds_bounds)
{
    const mt_surface_box *boxes = job->work->boxes;
    mt_index left_count = 0;
    int axis = job->cut.axis;
    mt_split_sides s = {{box_empty(), box_empty()}, {box_empty(), box_empty()}};
    for (mt_index i = begin; i < end; i++) {
        mt_surface_box record = boxes[i];
        box one = box_load(&record);
        float4 center = center_of(&one);
        bool is_right = (int)((center[axis] - job->map.origin[axis]) * job->map.scale[axis]) >= job->cut.bin;
        left[left_count] = record; /* to both, without a branch: which side is anyone's guess */
        right[i - begin - left_count] = record;
        left_count += !is_right;
        s.centers[is_right].lower = float4_minimum(s.centers[is_right].lower, center);
        s.centers[is_right].upper = float4_maximum(s.centers[is_right].upper, center);
        if (finds_bounds) {
            s.bounds[is_right] = box_join(s.bounds[is_right], one);
        }
    }
    *sides = s;
    return left_count;
}

static mt_index deal(const block_job *job, mt_index begin, mt_index end, mt_surface_box *left, mt_surface_box *right,
                     mt_split_sides *sides)
{
    return job->work->quality == MT_BUILD_FAST ? deal_boxes(job, begin, end, left, right, sides, true)
                                               : deal_boxes(job, begin, end, left, right, sides, false);
}

static void deal_blocks(void *user, uint64_t begin, uint64_t end)
{
    const block_job *job = user;
    mt_split_block *block = &job->work->blocks[begin / job->block_size];
    mt_index first = job->range->begin + (mt_index)begin, last = job->range->begin + (mt_index)end;
    mt_surface_box *boxes = job->work->boxes, *scratch = job->work->scratch;
    block->left_count = deal(job, first, last, boxes + first, scratch + first, &block->sides);
}

static void gather_blocks(void *user, uint64_t begin, uint64_t end)
{
    const block_job *job = user;
    const mt_split_block *block = &job->work->blocks[begin / job->block_size];
    mt_index first = job->range->begin + (mt_index)begin;
    uint64_t right_count = end - begin - block->left_count;
    mt_surface_box *boxes = job->work->boxes, *scratch = job->work->scratch;
    memcpy(boxes + block->right, scratch + first, right_count * sizeof *boxes);
}

static box bounds_of(const mt_split_bins *bins, plane cut, int bin_count, bool right)
{
    box bounds = box_empty();
    for (int bin = right ? cut.bin : 0; bin < (right ? bin_count : cut.bin); bin++) {
        bounds = box_join(bounds, bins->bounds[cut.axis][bin]);
    }
    return bounds;
}

static mt_surface_range bound_range(const mt_surface_box *boxes, mt_index begin, mt_index end)
{
    mt_surface_range range = {begin, end, box_empty(), box_empty()};
    for (mt_index i = begin; i < end; i++) {
        box one = box_load(&boxes[i]);
        float4 center = center_of(&one);
        range.bounds = box_join(range.bounds, one);
        range.centers.lower = float4_minimum(range.centers.lower, center);
        range.centers.upper = float4_maximum(range.centers.upper, center);
    }
    return range;
}

/* The left boxes of later blocks move down over what is already dealt: block by block, as they may overlap. */
static mt_index close_up_left(const block_job *job, mt_index count)
{
    mt_surface_box *boxes = job->work->boxes;
    mt_index left = job->range->begin;
    for (mt_index i = 0; (uint64_t)i * job->block_size < count; i++) {
        const mt_split_block *block = &job->work->blocks[i];
        memmove(boxes + left, boxes + job->range->begin + i * job->block_size, block->left_count * sizeof *boxes);
        left += block->left_count;
    }
    return left;
}

static void deal_in_blocks(block_job *job, mt_index count, mt_index *middle, mt_split_sides *sides)
{
    mt_parallel_for(job->work->context, count, job->block_size, deal_blocks, job);
    mt_index right = *middle = close_up_left(job, count);
    *sides = (mt_split_sides){{box_empty(), box_empty()}, {box_empty(), box_empty()}};
    for (mt_index i = 0; (uint64_t)i * job->block_size < count; i++) {
        mt_split_block *block = &job->work->blocks[i];
        mt_index size = count - i * job->block_size < job->block_size ? count - i * job->block_size : job->block_size;
        block->right = right;
        right += size - block->left_count;
        for (int side = 0; side < 2; side++) {
            sides->centers[side] = box_join(sides->centers[side], block->sides.centers[side]);
            sides->bounds[side] = box_join(sides->bounds[side], block->sides.bounds[side]);
        }
    }
    mt_parallel_for(job->work->context, count, job->block_size, gather_blocks, job);
}

static void deal_alone(const block_job *job, mt_index *middle, mt_split_sides *sides)
{
    const mt_surface_range *range = job->range;
    mt_surface_box *boxes = job->work->boxes, *scratch = job->work->scratch;
    mt_index left = deal(job, range->begin, range->end, boxes + range->begin, scratch + range->begin, sides);
    *middle = range->begin + left;
    memcpy(boxes + *middle, scratch + range->begin, (range->end - *middle) * sizeof *boxes);
}

static void halve_range(const mt_split_work *work, const mt_surface_range *range, mt_surface_range parts[2])
{
    mt_index middle = range->begin + (range->end - range->begin) / 2;
    parts[0] = bound_range(work->boxes, range->begin, middle);
    parts[1] = bound_range(work->boxes, middle, range->end);
}

mt_surface_range mt_surface_range_of(const mt_split_work *work, mt_index begin, mt_index end)
{
    return bound_range(work->boxes, begin, end);
}

/* The best of the planes between bins, of which each part's bounds come. */
static plane weigh_bins(const block_job *job, mt_index count, bool in_blocks, mt_split_bins *bins)
{
    const mt_split_work *work = job->work;
    clear_bins(bins, job->map.bin_count);
    if (in_blocks) {
        mt_parallel_for(work->context, count, job->block_size, fill_blocks, (void *)job);
        for (mt_index i = 0; (uint64_t)i * job->block_size < count; i++) {
            join_bins(bins, &work->blocks[i].bins, job->map.bin_count);
        }
    } else {
        fill_bins(work->boxes, job->range->begin, job->range->end, &job->map, bins);
    }
    return choose_plane(bins, job->map.bin_count);
}

void mt_surface_split(const mt_split_work *work, const mt_surface_range *range, bool halve, mt_surface_range parts[2])
{
    mt_index count = range->end - range->begin, middle;
    bool is_fast = work->quality == MT_BUILD_FAST, in_blocks = work->context && count / BLOCK_SIZE >= 4;
    block_job job = {.work = work, .range = range, .map = is_fast ? halve_longest(range) : choose_binning(range)};
    job.block_size = count / MT_SPLIT_BLOCKS + 1 > BLOCK_SIZE ? count / MT_SPLIT_BLOCKS + 1 : BLOCK_SIZE;
    mt_split_bins bins;
    if (!halve) {
        job.cut = is_fast ? middle_of(&job.map) : weigh_bins(&job, count, in_blocks, &bins);
    }
    if (halve || job.cut.axis < 0) {
        halve_range(work, range, parts);
        return;
    }
    mt_split_sides sides;
    in_blocks ? deal_in_blocks(&job, count, &middle, &sides) : deal_alone(&job, &middle, &sides);
    for (int side = 0; side < 2; side++) {
        parts[side].begin = side ? middle : range->begin;
        parts[side].end = side ? range->end : middle;
        parts[side].bounds = is_fast ? sides.bounds[side] : bounds_of(&bins, job.cut, job.map.bin_count, side == 1);
        parts[side].centers = sides.centers[side];
    }
}
