/* The maximum of a one-sided distance, to a tolerance, by branch and bound over pieces of triangles.
 *
 * Above: what deviation_bound.c says of a piece. Below: the largest distance of a sample. The pieces of the largest
 * bounds are quartered, a fixed number at a time so that threads change nothing, until none is above the maximum by
 * more than the tolerance.
 *
 * Known weakness: surfaces at a constant distance above finely curved ones keep all pieces near until those are small;
 * past WORK_LIMIT the search stops, and says by the error what it left. */
#include "lib/algorithms/deviation_bound.h"

#include <string.h>

#define BATCH_SIZE 128
#define GRAIN 8

/* Pieces quartered at most: so many, and so many for each triangle. */
#define WORK_LIMIT 1000000
#define WORK_PER_TRIANGLE 4

typedef struct entry {
    double upper;
    mt_index number; /* of a triangle, or of a piece in the pool */
    bool is_piece;
} entry;

typedef struct quarters {
    mt_deviation_piece parts[4];
    double uppers[4];
    double max;
    mt_vec3 at;
} quarters;

typedef struct search {
    mt_deviation_job *job;
    double *uppers; /* per triangle */
    entry *heap;
    uint64_t heap_size, heap_capacity;
    mt_deviation_piece *pool;
    mt_index *free_pieces;
    mt_index pool_size, pool_capacity, free_count;
    double pruned; /* the largest bound that was let go */
    mt_deviation_piece *batch;
    quarters *results;
    mt_index batch_count;
} search;

static mt_deviation_piece piece_of_triangle(const search *s, mt_index triangle)
{
    const mt_deviation_surface *from = s->job->from;
    mt_deviation_piece p = {.shape = mt_deviation_triangle_of(from, triangle), .middle = s->job->centers[triangle]};
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&from->triangulation, triangle, side);
        p.corners[side] = s->job->vertices[from->mesh->corner_vertices[corner]];
    }
    return p;
}

static double limit_of(const search *s)
{
    return s->job->out->max + s->job->tolerance;
}

static double bound_triangle(const search *s, mt_index triangle)
{
    mt_deviation_piece p = piece_of_triangle(s, triangle);
    if (p.corners[0].element == MT_NONE || p.corners[1].element == MT_NONE || p.corners[2].element == MT_NONE) {
        return 0;
    }
    double bound = mt_deviation_bound(s->job->to, &p, limit_of(s));
    s->job->centers[triangle] = p.middle;
    return bound;
}

static void bound_triangles(void *user, uint64_t begin, uint64_t end)
{
    search *s = user;
    for (uint64_t i = begin; i < end; i++) {
        s->uppers[i] = bound_triangle(s, (mt_index)i);
    }
}

static void set_part(const search *s, const mt_deviation_piece *from, int which, const mt_vec3 halves[3],
                     const mt_deviation_near near[3], mt_deviation_piece *part)
{
    for (int i = 0; i < 3; i++) {
        /* part 3 is the middle one, whose corners are the halves; part k keeps corner k */
        bool is_corner = i == which;
        int half = which == 3 ? i : 3 - which - i; /* between corner `which` and corner i lies the half opposite to the
                                                      third */
        part->shape.corners[i] = is_corner ? from->shape.corners[i] : halves[half];
        part->corners[i] = is_corner ? from->corners[i] : near[half];
    }
    part->middle =
        which == 3 ? from->middle
                   : mt_deviation_nearest(s->job->to, mt_deviation_middle(&part->shape), part->corners[which].element);
}

static void quarter(const search *s, const mt_deviation_piece *p, quarters *out)
{
    mt_vec3 halves[3];
    mt_deviation_near near[3];
    out->max = -1;
    for (int i = 0; i < 3; i++) {
        /* the half opposite to corner i */
        int j = (i + 1) % 3, k = (i + 2) % 3;
        halves[i] = mt_vec3_add(mt_vec3_scale(p->shape.corners[j], 0.5), mt_vec3_scale(p->shape.corners[k], 0.5));
        near[i] = mt_deviation_nearest(s->job->to, halves[i], p->corners[j].element);
        if (near[i].distance > out->max) {
            out->max = near[i].distance;
            out->at = halves[i];
        }
    }
    for (int which = 0; which < 4; which++) {
        mt_deviation_piece *part = &out->parts[which];
        set_part(s, p, which, halves, near, part);
        if (part->middle.distance > out->max) {
            out->max = part->middle.distance;
            out->at = mt_deviation_middle(&part->shape);
        }
        out->uppers[which] = mt_deviation_bound(s->job->to, part, limit_of(s));
    }
}

static void quarter_batch(void *user, uint64_t begin, uint64_t end)
{
    search *s = user;
    for (uint64_t i = begin; i < end; i++) {
        quarter(s, &s->batch[i], &s->results[i]);
    }
}

/* Equal bounds come out triangles first, then by number: nothing is left to chance. */
static bool comes_first(const entry *a, const entry *b)
{
    if (a->upper != b->upper) {
        return a->upper > b->upper;
    }
    return a->is_piece != b->is_piece ? b->is_piece : a->number < b->number;
}

static bool push(search *s, entry item)
{
    if (s->heap_size == s->heap_capacity) {
        uint64_t capacity = 2 * s->heap_capacity + 1024;
        entry *larger = mt_reallocate(s->job->context, s->heap, capacity * sizeof *larger);
        if (!larger) {
            return false;
        }
        s->heap = larger;
        s->heap_capacity = capacity;
    }
    uint64_t at = s->heap_size++;
    for (; at && comes_first(&item, &s->heap[(at - 1) / 2]); at = (at - 1) / 2) {
        s->heap[at] = s->heap[(at - 1) / 2];
    }
    s->heap[at] = item;
    return true;
}

static entry pop(search *s)
{
    entry first = s->heap[0], last = s->heap[--s->heap_size];
    uint64_t at = 0;
    for (;;) {
        uint64_t child = 2 * at + 1;
        if (child + 1 < s->heap_size && comes_first(&s->heap[child + 1], &s->heap[child])) {
            child++;
        }
        if (child >= s->heap_size || !comes_first(&s->heap[child], &last)) {
            break;
        }
        s->heap[at] = s->heap[child];
        at = child;
    }
    s->heap[at] = last;
    return first;
}

/* Keeps what may still hold the maximum. */
static bool keep_piece(search *s, const mt_deviation_piece *p, double upper)
{
    if (upper <= limit_of(s)) {
        s->pruned = fmax(s->pruned, upper);
        return true;
    }
    if (!s->free_count && s->pool_size == s->pool_capacity) {
        uint64_t capacity = 2 * (uint64_t)s->pool_capacity + 4096;
        mt_deviation_piece *larger = mt_reallocate(s->job->context, s->pool, capacity * sizeof *larger);
        if (!larger) {
            return false;
        }
        s->pool = larger;
        mt_index *numbers = mt_reallocate(s->job->context, s->free_pieces, capacity * sizeof *numbers);
        if (!numbers) {
            return false;
        }
        s->free_pieces = numbers;
        s->pool_capacity = (mt_index)capacity;
    }
    mt_index number = s->free_count ? s->free_pieces[--s->free_count] : s->pool_size++;
    s->pool[number] = *p;
    return push(s, (entry){upper, number, true});
}

static void take_batch(search *s)
{
    s->batch_count = 0;
    while (s->heap_size && s->batch_count < BATCH_SIZE && s->heap[0].upper > limit_of(s)) {
        entry item = pop(s);
        mt_deviation_piece *to = &s->batch[s->batch_count++];
        if (item.is_piece) {
            *to = s->pool[item.number];
            s->free_pieces[s->free_count++] = item.number;
        } else {
            *to = piece_of_triangle(s, item.number);
        }
    }
}

static bool keep_results(search *s)
{
    mt_deviation_side *out = s->job->out;
    for (mt_index i = 0; i < s->batch_count; i++) {
        if (s->results[i].max > out->max) {
            out->max = s->results[i].max;
            out->from = s->results[i].at;
        }
    }
    for (mt_index i = 0; i < s->batch_count; i++) {
        for (int part = 0; part < 4; part++) {
            if (!keep_piece(s, &s->results[i].parts[part], s->results[i].uppers[part])) {
                return false;
            }
        }
    }
    return true;
}

static void note_middle(search *s, mt_index triangle)
{
    mt_deviation_side *out = s->job->out;
    if (s->job->centers[triangle].distance > out->max) {
        mt_deviation_triangle shape = mt_deviation_triangle_of(s->job->from, triangle);
        out->max = s->job->centers[triangle].distance;
        out->from = mt_deviation_middle(&shape);
    }
}

static mt_status collect_triangles(search *s)
{
    mt_index count = s->job->from->triangulation.triangle_count;
    mt_parallel_for(s->job->context, count, 1024, bound_triangles, s);
    for (mt_index i = 0; i < count; i++) {
        note_middle(s, i);
    }
    for (mt_index i = 0; i < count; i++) {
        if (s->uppers[i] <= limit_of(s)) {
            s->pruned = fmax(s->pruned, s->uppers[i]);
        } else if (!push(s, (entry){s->uppers[i], i, false})) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
    }
    return MT_OK;
}

static mt_status bound_maximum(search *s)
{
    mt_status status = collect_triangles(s);
    uint64_t work = 0;
    uint64_t limit = WORK_LIMIT + WORK_PER_TRIANGLE * (uint64_t)s->job->from->triangulation.triangle_count;
    while (status == MT_OK && s->heap_size && s->heap[0].upper > limit_of(s) && work < limit) {
        take_batch(s);
        mt_parallel_for(s->job->context, s->batch_count, GRAIN, quarter_batch, s);
        work += s->batch_count;
        status = keep_results(s) ? mt_progress(s->job->context, "bounding the distance", (double)work / (double)limit)
                                 : MT_ERROR_OUT_OF_MEMORY;
    }
    double upper = s->heap_size ? fmax(s->pruned, s->heap[0].upper) : s->pruned;
    s->job->out->max_error = fmax(0, upper - s->job->out->max);
    return status;
}

mt_status mt_deviation_refine(mt_deviation_job *job)
{
    search s = {.job = job};
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    s.uppers = mt_allocate_array(job->context, job->from->triangulation.triangle_count, sizeof *s.uppers);
    s.batch = mt_allocate_array(job->context, BATCH_SIZE, sizeof *s.batch);
    s.results = mt_allocate_array(job->context, BATCH_SIZE, sizeof *s.results);
    if (s.uppers && s.batch && s.results) {
        status = bound_maximum(&s);
    }
    mt_free(job->context, s.uppers);
    mt_free(job->context, s.batch);
    mt_free(job->context, s.results);
    mt_free(job->context, s.heap);
    mt_free(job->context, s.pool);
    mt_free(job->context, s.free_pieces);
    return status;
}
