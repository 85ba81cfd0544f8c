/* Vertex normals by area: one pass over the faces adds each area vector at the face's vertices, then each sum is
 * brought to length 1. Several threads own a range of vertices each and add in it what the faces bring, in ascending
 * order: so sums do not depend on who runs them. Blocks of faces know between which vertices they lie: most lie outside
 * a range, and are passed over, or inside, where no vertex needs to be asked for.
 *
 * Cost: linear; three doubles a vertex beside the result, none when that is in doubles. Faces in a random order cost
 * cache misses, so that positions and sums are asked for some faces ahead; then every block lies in every range, and
 * one thread does all. */
#include "lib/algorithms/normals.h"
#include "lib/algorithms/normals_face.h"

#include <string.h>

#define RANGES_MAXIMUM 64
#define FACE_BLOCK 2048

/* Faces that memory is given to fetch what they need. */
#define LOOK_AHEAD 16

/* A block whose vertices are spread farther than so many numbers misses caches: what it needs is asked for ahead. */
#define WIDE_BLOCK 32768

/* The lowest and the highest vertex of a block of faces. */
typedef struct face_block {
    mt_index low, high;
} face_block;

typedef struct area_job {
    mt_normals_job *job;
    double *sums; /* 3 a vertex */
    face_block *blocks;
    mt_index range_count;
    bool out_of_range[RANGES_MAXIMUM]; /* per range: an area that cannot be summed as it is */
} area_job;

MT_INLINE void add_at(double *sums, mt_index vertex, mt_vec3 n)
{
    double *sum = sums + 3 * (size_t)vertex;
    sum[0] += n.x, sum[1] += n.y, sum[2] += n.z;
}

/* The area vector of a face that plain doubles do not serve. False: it is out of range. */
static bool find_area_vector(const mt_mesh *mesh, mt_index face, mt_vec3 *area_vector)
{
    mt_scaled_vector scaled = mt_face_area_vector(mesh, face);
    *area_vector = mt_shift_vector(scaled.vector, scaled.exponent);
    return mt_vector_is_zero(scaled.vector) || mt_is_plain(*area_vector);
}

/* Faces of a block, and the range of vertices that they are added to. */
typedef struct block_task {
    const mt_mesh *mesh;
    double *sums;
    mt_index face, face_end;
    mt_index begin, count;
} block_task;

MT_INLINE void fetch_face(const block_task *task, const mt_index *vertices, mt_index sides, bool is_double)
{
    size_t size = is_double ? 3 * sizeof(double) : 3 * sizeof(float);
    for (mt_index i = 0; i < sides; i++) {
        __builtin_prefetch((const char *)task->mesh->positions + vertices[i] * size);
        __builtin_prefetch(task->sums + 3 * (size_t)vertices[i], 1);
    }
}

MT_INLINE bool touches(const block_task *task, const mt_index *vertices, mt_index sides)
{
    for (mt_index i = 0; i < sides; i++) {
        if (vertices[i] - task->begin < task->count) {
            return true;
        }
    }
    return false;
}

/* The slow way writes to a vector of its own, so that the other one can stay in registers. */
MT_INLINE mt_vec3 area_vector_of(const mt_mesh *mesh, mt_index face, const mt_index *vertices, mt_index sides,
                                 bool is_double, bool *fits)
{
    mt_vec3 n;
    if (!mt_plain_area_vector(mesh->positions, is_double, vertices, sides, &n)) {
        mt_vec3 found;
        *fits = find_area_vector(mesh, face, &found) && *fits;
        n = found;
    }
    return n;
}

/* `inside`: all vertices of the block lie in the range; `near`: near each other. size: sides of every face, or 0. */
MT_INLINE bool add_faces(const block_task *task, mt_index size, bool is_double, bool inside, bool near)
{
    const mt_mesh *mesh = task->mesh;
    double *sums = task->sums;
    mt_index ahead = mesh->face_count > LOOK_AHEAD ? mesh->face_count - LOOK_AHEAD : 0;
    bool fits = true;
    for (mt_index face = task->face; face < task->face_end; face++) {
        const mt_index *vertices = mesh->corner_vertices + (size ? size * face : mt_mesh_face_begin(mesh, face));
        mt_index sides = size ? size : mt_mesh_face_sides(mesh, face);
        if (!near && size && face < ahead) {
            fetch_face(task, vertices + (size_t)size * LOOK_AHEAD, size, is_double);
        }
        if (!inside && !touches(task, vertices, sides)) {
            continue;
        }
        mt_vec3 n = area_vector_of(mesh, face, vertices, sides, is_double, &fits);
        for (mt_index i = 0; i < sides; i++) {
            if (inside || vertices[i] - task->begin < task->count) {
                add_at(sums, vertices[i], n);
            }
        }
    }
    return fits;
}

static bool add_triangles_f64(const block_task *task, bool inside, bool near)
{
    return !inside ? add_faces(task, 3, true, false, false)
           : near  ? add_faces(task, 3, true, true, true)
                   : add_faces(task, 3, true, true, false);
}

static bool add_triangles_f32(const block_task *task, bool inside, bool near)
{
    return !inside ? add_faces(task, 3, false, false, false)
           : near  ? add_faces(task, 3, false, true, true)
                   : add_faces(task, 3, false, true, false);
}

static bool add_block(const block_task *task, bool inside, bool near)
{
    const mt_mesh *mesh = task->mesh;
    bool is_double = mesh->position_type == MT_F64;
    if (mesh->face_offsets || mesh->face_size != 3) {
        return add_faces(task, 0, is_double, inside, near);
    }
    return is_double ? add_triangles_f64(task, inside, near) : add_triangles_f32(task, inside, near);
}

static mt_index block_end(const mt_mesh *mesh, mt_index begin)
{
    return mesh->face_count - begin < FACE_BLOCK ? mesh->face_count : begin + FACE_BLOCK;
}

static void add_range(void *user, uint64_t number, uint64_t end)
{
    (void)end;
    area_job *area = user;
    const mt_mesh *mesh = area->job->mesh;
    uint64_t begin = (uint64_t)mesh->vertex_count * number / area->range_count;
    uint64_t count = (uint64_t)mesh->vertex_count * (number + 1) / area->range_count - begin;
    memset(area->sums + 3 * begin, 0, 3 * count * sizeof(double));
    block_task task = {mesh, area->sums, 0, 0, (mt_index)begin, (mt_index)count};
    bool fits = true;
    for (const face_block *block = area->blocks; task.face < mesh->face_count; block++, task.face = task.face_end) {
        task.face_end = block_end(mesh, task.face);
        bool apart = block->high < begin || block->low >= begin + count;
        bool inside = block->low >= begin && block->high < begin + count;
        bool near = block->high - block->low < WIDE_BLOCK;
        fits = (apart || add_block(&task, inside, near)) && fits;
    }
    area->out_of_range[number] = !fits;
}

static MT_CLONES void find_lowest_and_highest(const mt_index *vertices, mt_index count, face_block *block)
{
    mt_index low = MT_NONE, high = 0;
    for (mt_index i = 0; i < count; i++) {
        low = vertices[i] < low ? vertices[i] : low;
        high = vertices[i] > high ? vertices[i] : high;
    }
    block->low = low;
    block->high = high;
}

static void find_block(void *user, uint64_t begin, uint64_t end)
{
    const area_job *area = user;
    const mt_mesh *mesh = area->job->mesh;
    mt_index corner = mt_mesh_face_begin(mesh, (mt_index)begin);
    mt_index corner_count = mt_mesh_face_end(mesh, (mt_index)end - 1) - corner;
    find_lowest_and_highest(mesh->corner_vertices + corner, corner_count, &area->blocks[begin / FACE_BLOCK]);
}

/* A range for each thread, unless that many would do the same work several times. */
static mt_index choose_range_count(const area_job *area, uint64_t block_count)
{
    unsigned threads = mt_context_thread_count(area->job->context);
    mt_index ranges = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM;
    uint64_t range_size = area->job->mesh->vertex_count / ranges, spread = 0;
    for (uint64_t i = 0; i < block_count; i++) {
        spread += area->blocks[i].high - area->blocks[i].low > range_size / 2;
    }
    return spread > block_count / 2 ? 1 : ranges;
}

/* Vertices whose lengths are found together, so that roots and quotients are taken several at once. */
#define UNIT_GROUP 256

/* Stores 1 / length of each sum, of no use where that is not plain. */
static MT_CLONES void find_scales(const double *sums, mt_index count, double *scales)
{
    for (mt_index i = 0; i < count; i++) {
        mt_vec3 sum = mt_vec3_make(sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]);
        scales[i] = mt_symmetric_dot(sum, sum);
    }
    for (mt_index i = 0; i < count; i++) {
        scales[i] = 1 / sqrt(scales[i]);
    }
}

static void make_units(void *user, uint64_t begin, uint64_t end)
{
    const area_job *area = user;
    mt_attribute *values = area->job->values;
    mt_index undefined = 0;
    double scales[UNIT_GROUP];
    for (uint64_t first = begin; first < end; first += UNIT_GROUP) {
        mt_index count = end - first < UNIT_GROUP ? (mt_index)(end - first) : UNIT_GROUP;
        const double *sums = area->sums + 3 * first;
        find_scales(sums, count, scales);
        for (mt_index i = 0; i < count; i++) {
            mt_vec3 sum = mt_vec3_make(sums[3 * i], sums[3 * i + 1], sums[3 * i + 2]);
            mt_vec3 n = mt_is_plain(sum) ? mt_vec3_scale(sum, scales[i]) : mt_unit_vector(sum);
            mt_store_normal(values->values, values->type, first + i, n);
            undefined += mt_vector_is_zero(n);
        }
    }
    mt_count_undefined(area->job, undefined);
}

static void sum_and_make_units(area_job *area, bool *done)
{
    mt_context *context = area->job->context;
    const mt_mesh *mesh = area->job->mesh;
    mt_parallel_for(context, mesh->face_count, FACE_BLOCK, find_block, area);
    area->range_count = choose_range_count(area, ((uint64_t)mesh->face_count + FACE_BLOCK - 1) / FACE_BLOCK);
    mt_parallel_for(context, area->range_count, 1, add_range, area);
    *done = true;
    for (mt_index i = 0; i < area->range_count; i++) {
        *done = *done && !area->out_of_range[i];
    }
    if (*done) {
        mt_parallel_for(context, mesh->vertex_count, MT_NORMALS_GRAIN, make_units, area);
    }
}

mt_status mt_normals_by_area(mt_normals_job *job, bool *done)
{
    area_job area = {.job = job};
    bool in_place = job->values->type == MT_F64;
    area.blocks = mt_allocate_array(job->context, job->mesh->face_count / FACE_BLOCK + 1, sizeof *area.blocks);
    area.sums =
        in_place ? job->values->values : mt_allocate_array(job->context, job->mesh->vertex_count, 3 * sizeof(double));
    mt_status status = area.blocks && area.sums ? MT_OK : mt_context_error(job->context)->status;
    if (status == MT_OK) {
        sum_and_make_units(&area, done);
    }
    mt_free(job->context, area.blocks);
    mt_free(job->context, in_place ? NULL : area.sums);
    return status;
}
