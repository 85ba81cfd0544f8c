/* Vertex normals by area: one pass over the faces adds each area vector at the face's vertices, in slabs (see
 * normals_slabs.h), and when the last face of a group of vertices is added the sums are brought to length 1. Several
 * threads own a range of groups each and add in it what the faces bring, in ascending order: so sums do not depend on
 * who runs them. Blocks of faces know between which vertices they lie: most lie outside a range, and are passed over,
 * or inside, where no vertex needs to be asked for.
 *
 * Cost: linear; four doubles a vertex of the groups that are at work at once, which for faces in a random order are
 * all. Those also cost cache misses, so that positions and sums are asked for some faces ahead; then every block lies
 * in every range, and one thread does all. */
#include "lib/algorithms/normals.h"
#include "lib/algorithms/normals_face.h"
#include "lib/algorithms/normals_four.h"
#include "lib/algorithms/normals_slabs.h"

#define RANGES_MAXIMUM 64

/* Faces that memory is given to fetch what they need. */
#define LOOK_AHEAD 16

/* A block whose vertices are spread farther than so many numbers misses caches: what it needs is asked for ahead. */
#define WIDE_BLOCK 32768

/* Groups that one thread adds at, and what came of it. */
typedef struct area_range {
    mt_index group_begin, group_end;
    mt_index *free_slabs; /* those not in use: a stack */
    mt_index free_count;
    mt_index undefined_count;
    bool fits; /* no area that cannot be summed as it is */
} area_range;

typedef struct area_job {
    mt_normals_job *job;
    mt_slab_plan plan;
    double4 *sums;   /* (x, y, z, 0) of the vertices of each slab */
    mt_index *moves; /* of each group at work: from a vertex to its sum */
    mt_index *free_slabs;
    mt_index range_count;
    area_range ranges[RANGES_MAXIMUM];
} area_job;

/* Faces of a block, and the range of vertices that they are added to. */
typedef struct block_task {
    const mt_mesh *mesh;
    double4 *sums;
    const mt_index *moves;
    mt_index face, face_end;
    mt_index begin, count;
} block_task;

/* ---- Adding ---- */

MT_INLINE double4 *sum_at(const block_task *task, mt_index vertex)
{
    return task->sums + (mt_index)(vertex + task->moves[vertex >> MT_SLAB_SHIFT]);
}

MT_INLINE bool in_range(const block_task *task, mt_index vertex)
{
    return vertex - task->begin < task->count;
}

MT_INLINE void add_at(const block_task *task, const mt_index *vertices, mt_index sides, bool inside, const double4 *n)
{
    for (mt_index i = 0; i < sides; i++) {
        if (inside || in_range(task, vertices[i])) {
            *sum_at(task, vertices[i]) += *n;
        }
    }
}

/* False: it is out of range. */
static bool add_face(const block_task *task, mt_index face, bool inside)
{
    const mt_index *vertices = task->mesh->corner_vertices + mt_mesh_face_begin(task->mesh, face);
    mt_scaled_vector scaled = mt_any_area_vector(task->mesh, face);
    mt_vec3 n = mt_shift_vector(scaled.vector, scaled.exponent);
    const double4 vector = {n.x, n.y, n.z, 0};
    add_at(task, vertices, mt_mesh_face_sides(task->mesh, face), inside, &vector);
    return mt_vector_is_zero(scaled.vector) || mt_is_plain(n);
}

static bool add_faces(const block_task *task, mt_index face, mt_index face_end, bool inside)
{
    bool fits = true;
    for (; face < face_end; face++) {
        fits = add_face(task, face, inside) && fits;
    }
    return fits;
}

MT_INLINE void fetch_four(const block_task *task, const mt_index *vertices, bool is_double)
{
    size_t size = is_double ? 3 * sizeof(double) : 3 * sizeof(float);
    for (mt_index i = 0; i < 12; i++) {
        __builtin_prefetch((const char *)task->mesh->positions + vertices[i] * size);
        __builtin_prefetch(sum_at(task, vertices[i]), 1);
    }
}

/* `inside`: all vertices of the block lie in the range; `near`: near each other. */
MT_INLINE bool add_triangles(const block_task *task, bool is_double, bool inside, bool near)
{
    const mt_mesh *mesh = task->mesh;
    mt_index face = task->face, fetched_end = mesh->face_count > LOOK_AHEAD + 4 ? mesh->face_count - LOOK_AHEAD - 4 : 0;
    bool fits = true;
    for (; task->face_end - face >= 4; face += 4) {
        const mt_index *vertices = mesh->corner_vertices + 3 * (size_t)face;
        double4 n[4];
        if (!near && face < fetched_end) {
            fetch_four(task, vertices + (size_t)3 * LOOK_AHEAD, is_double);
        }
        if (!mt_four_area_vectors(mesh->positions, is_double, vertices, n)) {
            fits = add_faces(task, face, face + 4, inside) && fits;
            continue;
        }
        for (mt_index i = 0; i < 4; i++) {
            add_at(task, vertices + 3 * i, 3, inside, &n[i]);
        }
    }
    return add_faces(task, face, task->face_end, inside) && fits;
}

static MT_CLONES bool add_triangles_f64(const block_task *task, bool inside, bool near)
{
    return !inside ? add_triangles(task, true, false, true)
           : near  ? add_triangles(task, true, true, true)
                   : add_triangles(task, true, true, false);
}

static MT_CLONES bool add_triangles_f32(const block_task *task, bool inside, bool near)
{
    return !inside ? add_triangles(task, false, false, true)
           : near  ? add_triangles(task, false, true, true)
                   : add_triangles(task, false, true, false);
}

static bool add_block(const block_task *task, bool inside, bool near)
{
    const mt_mesh *mesh = task->mesh;
    if (mesh->face_offsets || mesh->face_size != 3) {
        return add_faces(task, task->face, task->face_end, inside);
    }
    return mesh->position_type == MT_F64 ? add_triangles_f64(task, inside, near)
                                         : add_triangles_f32(task, inside, near);
}

/* ---- Storing ---- */

static mt_index store_unit(mt_attribute *values, mt_index vertex, const double4 *sum)
{
    mt_vec3 n = mt_vec3_make((*sum)[0], (*sum)[1], (*sum)[2]);
    n = mt_is_plain(n) ? mt_plain_unit(n) : mt_unit_vector(n);
    mt_store_normal(values->values, values->type, vertex, n);
    return mt_vector_is_zero(n);
}

/* Returns how many have no direction. */
MT_INLINE mt_index store_units_as(bool is_double, mt_attribute *values, mt_index vertex, mt_index end,
                                  const double4 *sums)
{
    mt_index undefined = 0;
    while (vertex < end) {
        size_t at = 3 * (size_t)vertex * (is_double ? sizeof(double) : sizeof(float));
        mt_index count = end - vertex < 4 ? end - vertex : 4;
        if (count < 4 || !mt_store_four_units(sums, is_double, (char *)values->values + at)) {
            for (mt_index i = 0; i < count; i++) {
                undefined += store_unit(values, vertex + i, sums + i);
            }
        }
        vertex += count;
        sums += count;
    }
    return undefined;
}

static MT_CLONES mt_index store_units(mt_attribute *values, mt_index vertex, mt_index end, const double4 *sums)
{
    return values->type == MT_F64 ? store_units_as(true, values, vertex, end, sums)
                                  : store_units_as(false, values, vertex, end, sums);
}

/* ---- Groups ---- */

static bool has_group(const area_range *range, mt_index group)
{
    return group >= range->group_begin && group < range->group_end;
}

static mt_index group_end(const area_job *area, mt_index group)
{
    mt_index begin = group << MT_SLAB_SHIFT, vertex_count = area->job->mesh->vertex_count;
    return vertex_count - begin < MT_SLAB_SIZE ? vertex_count : begin + MT_SLAB_SIZE;
}

static void open_groups(area_job *area, area_range *range, mt_index block)
{
    for (mt_index group = area->plan.opened[block]; group != MT_NONE; group = area->plan.next_opened[group]) {
        if (has_group(range, group)) {
            mt_index slab = range->free_slabs[--range->free_count];
            area->moves[group] = (slab - group) << MT_SLAB_SHIFT;
            memset(area->sums + ((size_t)slab << MT_SLAB_SHIFT), 0, MT_SLAB_SIZE * sizeof *area->sums);
        }
    }
}

static void close_groups(area_job *area, area_range *range, mt_index block)
{
    for (mt_index group = area->plan.closed[block]; group != MT_NONE; group = area->plan.next_closed[group]) {
        if (has_group(range, group)) {
            mt_index begin = group << MT_SLAB_SHIFT, at = begin + area->moves[group];
            range->undefined_count += store_units(area->job->values, begin, group_end(area, group), area->sums + at);
            range->free_slabs[range->free_count++] = at >> MT_SLAB_SHIFT;
        }
    }
}

/* Vertices of no face. */
static void store_unopened(area_job *area, area_range *range)
{
    const double4 zero = {0};
    mt_index group = area->plan.opened[area->plan.block_count];
    for (; group != MT_NONE; group = area->plan.next_opened[group]) {
        if (has_group(range, group)) {
            for (mt_index vertex = group << MT_SLAB_SHIFT; vertex < group_end(area, group); vertex++) {
                range->undefined_count += store_unit(area->job->values, vertex, &zero);
            }
        }
    }
}

static void add_range(void *user, uint64_t number, uint64_t end)
{
    (void)end;
    area_job *area = user;
    area_range *range = &area->ranges[number];
    mt_index begin = range->group_begin << MT_SLAB_SHIFT;
    mt_index count = range->group_begin < range->group_end ? group_end(area, range->group_end - 1) - begin : 0;
    block_task task = {area->job->mesh, area->sums, area->moves, 0, 0, begin, count};
    for (mt_index number_of_block = 0; number_of_block < area->plan.block_count; number_of_block++) {
        const mt_face_block *block = &area->plan.blocks[number_of_block];
        task.face = number_of_block * MT_FACE_BLOCK;
        task.face_end = mt_face_block_end(&area->plan, task.face);
        bool apart = !count || block->high < begin || (block->low > begin && block->low - begin >= count);
        bool inside = block->low >= begin && block->high - begin < count;
        open_groups(area, range, number_of_block);
        range->fits = (apart || add_block(&task, inside, block->high - block->low < WIDE_BLOCK)) && range->fits;
        close_groups(area, range, number_of_block);
    }
    store_unopened(area, range);
}

/* ---- Ranges ---- */

/* A range for each thread, unless that many would do the same work several times. */
static mt_index choose_range_count(const area_job *area)
{
    unsigned threads = mt_context_thread_count(area->job->context);
    mt_index ranges = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM;
    mt_index range_size = area->job->mesh->vertex_count / ranges, spread = 0;
    for (mt_index i = 0; i < area->plan.block_count; i++) {
        spread += area->plan.blocks[i].high - area->plan.blocks[i].low > range_size / 2;
    }
    return spread > area->plan.block_count / 2 ? 1 : ranges;
}

static mt_status allocate_ranges(area_job *area)
{
    mt_context *context = area->job->context;
    uint64_t slab_count = 0, group_count = area->plan.group_count;
    area->range_count = choose_range_count(area);
    for (mt_index i = 0; i < area->range_count; i++) {
        area_range *range = &area->ranges[i];
        *range = (area_range){.group_begin = (mt_index)(group_count * i / area->range_count),
                              .group_end = (mt_index)(group_count * (i + 1) / area->range_count),
                              .fits = true};
        range->free_count = mt_slab_plan_peak(&area->plan, range->group_begin, range->group_end);
        slab_count += range->free_count;
    }
    area->sums = mt_allocate_array(context, slab_count << MT_SLAB_SHIFT, sizeof *area->sums);
    area->moves = mt_allocate_array_zeroed(context, group_count, sizeof *area->moves);
    area->free_slabs = mt_allocate_array(context, slab_count, sizeof *area->free_slabs);
    return area->sums && area->moves && area->free_slabs ? MT_OK : mt_context_error(context)->status;
}

static void deal_slabs(area_job *area)
{
    mt_index slab = 0;
    for (mt_index i = 0; i < area->range_count; i++) {
        area_range *range = &area->ranges[i];
        range->free_slabs = area->free_slabs + slab;
        for (mt_index k = range->free_count; k-- > 0;) {
            range->free_slabs[k] = slab++;
        }
    }
}

static bool add_ranges(area_job *area)
{
    deal_slabs(area);
    mt_parallel_for(area->job->context, area->range_count, 1, add_range, area);
    bool fits = true;
    mt_index undefined_count = 0;
    for (mt_index i = 0; i < area->range_count; i++) {
        fits = fits && area->ranges[i].fits;
        undefined_count += area->ranges[i].undefined_count;
    }
    mt_count_undefined(area->job, fits ? undefined_count : 0);
    return fits;
}

mt_status mt_normals_by_area(mt_normals_job *job, bool *done)
{
    area_job area = {.job = job};
    mt_status status = mt_slab_plan_init(job->context, job->mesh, &area.plan);
    if (status == MT_OK) {
        status = allocate_ranges(&area);
    }
    *done = status == MT_OK && add_ranges(&area);
    mt_free(job->context, area.sums);
    mt_free(job->context, area.moves);
    mt_free(job->context, area.free_slabs);
    mt_slab_plan_release(job->context, &area.plan);
    return status;
}
