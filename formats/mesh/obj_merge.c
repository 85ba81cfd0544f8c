/* Counting, settling references, and copying positions and faces. Every block owns a range of each result. */
#include "formats/mesh/obj_merge.h"

static const mt_obj_series element_series[MT_OBJ_ELEMENT_COUNT] = {MT_OBJ_POSITIONS, MT_OBJ_UVS, MT_OBJ_NORMALS};

mt_status mt_obj_count(mt_context *context, mt_obj_reader *reader)
{
    mt_obj_limits *limits = &reader->limits;
    *limits = (mt_obj_limits){{0}};
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_block *block = &reader->blocks[i];
        /* Past 32 bits these wrap around; the sums tell, and then nobody uses them. */
        reader->first_faces[i] = (mt_index)reader->face_count;
        reader->first_corners[i] = (mt_index)reader->corner_count;
        reader->face_count += block->face_count;
        reader->corner_count += block->counts[MT_OBJ_CORNERS];
        for (int element = 0; element < MT_OBJ_ELEMENT_COUNT; element++) {
            reader->bases[i].counts[element] = limits->counts[element];
            limits->counts[element] += block->counts[element_series[element]];
        }
    }
    uint64_t most = reader->corner_count;
    for (int element = 0; element < MT_OBJ_ELEMENT_COUNT; element++) {
        most = most < limits->counts[element] ? limits->counts[element] : most;
    }
    return most <= MT_INDEX_MAX
               ? MT_OK
               : mt_fail(context, MT_ERROR_TOO_LARGE, "%llu elements of one kind are more than an index can name",
                         (unsigned long long)most);
}

/* Adds the base to the listed references. */
static bool settle(mt_obj_block *block, mt_obj_series list, mt_obj_series series, uint64_t base)
{
    const mt_index *listed = block->items[list];
    mt_index *references = block->items[series];
    bool right = true;
    for (size_t i = 0; i < block->counts[list]; i++) {
        int64_t number = (int64_t)base + (int32_t)references[listed[i]];
        right = right && number >= 0 && number <= MT_INDEX_MAX;
        references[listed[i]] = (mt_index)number;
    }
    return right;
}

static bool all_below(const mt_obj_block *block, mt_obj_series series, uint64_t limit, bool none_allowed)
{
    const mt_index *references = block->items[series];
    mt_index highest = 0;
    for (size_t i = 0; i < block->counts[series]; i++) {
        mt_index reference = none_allowed && references[i] == MT_NONE ? 0 : references[i];
        highest = reference > highest ? reference : highest;
    }
    return block->counts[series] == 0 || highest < limit || (none_allowed && highest == 0);
}

static bool tags_below(const mt_obj_block *block, uint64_t limit)
{
    const mt_edge_value *creases = block->items[MT_OBJ_CREASES];
    const mt_vertex_value *sharp = block->items[MT_OBJ_SHARP_VERTICES];
    bool right = true;
    for (size_t i = 0; i < block->counts[MT_OBJ_CREASES]; i++) {
        right = right && creases[i].a < limit && creases[i].b < limit;
    }
    for (size_t i = 0; i < block->counts[MT_OBJ_SHARP_VERTICES]; i++) {
        right = right && sharp[i].vertex < limit;
    }
    return right;
}

static void resolve_block(void *user, uint64_t begin, uint64_t end)
{
    static const struct {
        mt_obj_series list, series;
        mt_obj_element element;
        bool none_allowed;
    } kinds[] = {{MT_OBJ_RELATIVE_CORNERS, MT_OBJ_CORNERS, MT_OBJ_VERTEX, false},
                 {MT_OBJ_RELATIVE_UVS, MT_OBJ_CORNER_UVS, MT_OBJ_UV, true},
                 {MT_OBJ_RELATIVE_NORMALS, MT_OBJ_CORNER_NORMALS, MT_OBJ_NORMAL, true},
                 {MT_OBJ_RELATIVE_WIRES, MT_OBJ_WIRE_VERTICES, MT_OBJ_VERTEX, false},
                 {MT_OBJ_RELATIVE_POINTS, MT_OBJ_POINTS, MT_OBJ_VERTEX, false}};
    mt_obj_reader *reader = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_obj_block *block = &reader->blocks[i];
        bool right = tags_below(block, reader->limits.counts[MT_OBJ_VERTEX]);
        for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++) {
            right &= settle(block, kinds[k].list, kinds[k].series, reader->bases[i].counts[kinds[k].element]);
            right &= all_below(block, kinds[k].series, reader->limits.counts[kinds[k].element], kinds[k].none_allowed);
        }
        reader->wrong[i] = !right;
    }
}

void mt_obj_resolve(mt_context *context, mt_obj_reader *reader)
{
    mt_parallel_for(context, reader->block_count, 1, resolve_block, reader);
}

void mt_obj_release_series(mt_context *context, mt_obj_reader *reader, mt_obj_series series)
{
    for (unsigned i = 0; i < reader->store_count; i++) {
        mt_obj_store_release_series(context, &reader->stores[i], series);
    }
}

/* Sides of every face when all have the same; 0 otherwise, and without faces. */
static mt_index common_face_size(const mt_obj_reader *reader)
{
    mt_index size = 0;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_block *block = &reader->blocks[i];
        if (block->face_count == 0) {
            continue;
        }
        if (block->counts[MT_OBJ_SIDES] > 0 || (size && size != block->face_size)) {
            return 0;
        }
        size = block->face_size;
    }
    return size;
}

typedef struct merge_job {
    mt_obj_reader *reader;
    mt_mesh *mesh;
} merge_job;

static void copy_positions(void *user, uint64_t begin, uint64_t end)
{
    merge_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_obj_block *block = &job->reader->blocks[i];
        size_t size = block->counts[MT_OBJ_POSITIONS] * mt_obj_item_size(MT_OBJ_POSITIONS);
        if (size > 0) {
            memcpy((double *)job->mesh->positions + 3 * job->reader->bases[i].counts[MT_OBJ_VERTEX],
                   block->items[MT_OBJ_POSITIONS], size);
        }
    }
}

static void write_offsets(const mt_obj_block *block, mt_index *offsets, mt_index first_corner)
{
    const mt_index *sides = block->counts[MT_OBJ_SIDES] > 0 ? block->items[MT_OBJ_SIDES] : NULL;
    mt_index corner = first_corner;
    for (mt_index face = 0; face < block->face_count; face++) {
        corner += sides ? sides[face] : block->face_size;
        offsets[face + 1] = corner;
    }
}

static void copy_faces(void *user, uint64_t begin, uint64_t end)
{
    merge_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_obj_block *block = &job->reader->blocks[i];
        size_t size = block->counts[MT_OBJ_CORNERS] * sizeof(mt_index);
        mt_index first_corner = job->reader->first_corners[i];
        if (size > 0) {
            memcpy(job->mesh->corner_vertices + first_corner, block->items[MT_OBJ_CORNERS], size);
        }
        if (job->mesh->face_offsets) {
            write_offsets(block, job->mesh->face_offsets + job->reader->first_faces[i], first_corner);
        }
    }
}

mt_status mt_obj_merge(mt_context *context, mt_obj_reader *reader, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = reader->limits.counts[MT_OBJ_VERTEX],
                             .face_count = reader->face_count,
                             .corner_count = reader->corner_count,
                             .face_size = reader->face_count ? common_face_size(reader) : 3,
                             .position_type = MT_F64};
    merge_job job = {.reader = reader};
    mt_status status = mt_mesh_create(context, &layout, &job.mesh);
    if (status == MT_OK) {
        mt_parallel_for(context, reader->block_count, 1, copy_positions, &job);
        mt_obj_release_series(context, reader, MT_OBJ_POSITIONS);
        mt_parallel_for(context, reader->block_count, 1, copy_faces, &job);
        mt_obj_release_series(context, reader, MT_OBJ_CORNERS);
        mt_obj_release_series(context, reader, MT_OBJ_SIDES);
        job.mesh->up = MT_UP_Y;
        status = mt_obj_merge_uvs(context, reader, job.mesh);
    }
    if (status == MT_OK) {
        status = mt_obj_merge_normals(context, reader, job.mesh);
    }
    if (status == MT_OK) {
        status = mt_obj_merge_colors(context, reader, job.mesh);
    }
    if (status == MT_OK) {
        status = mt_obj_merge_elements(context, reader, job.mesh);
    }
    if (status == MT_OK) {
        status = mt_obj_merge_names(context, reader, job.mesh);
    }
    if (status == MT_OK) {
        status = mt_obj_merge_tags(context, reader, job.mesh);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, job.mesh);
        job.mesh = NULL;
    }
    *out = job.mesh;
    return status;
}
