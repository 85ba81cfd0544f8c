/* UVs, normals and colours of an OBJ file. UVs and normals that every corner names by the number of its vertex are
 * attributes of the vertices; others are attributes of the corners, with their own numbers. */
#include "formats/mesh/obj_merge.h"

typedef struct attribute_job {
    mt_obj_reader *reader;
    const mt_mesh *mesh;
    mt_attribute *attribute;
    mt_obj_series values, references; /* of the blocks */
    mt_obj_element element;
    bool *differs; /* per block */
    bool *used;
} attribute_job;

static void compare_references(void *user, uint64_t begin, uint64_t end)
{
    attribute_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_obj_block *block = &job->reader->blocks[i];
        size_t corners = block->counts[MT_OBJ_CORNERS], count = block->counts[job->references];
        const mt_index *vertices = job->mesh->corner_vertices + job->reader->first_corners[i];
        job->used[i] = count > 0;
        job->differs[i] = count != corners ||
                          (count > 0 && memcmp(vertices, block->items[job->references], count * sizeof *vertices) != 0);
    }
}

static bool any(const bool *flags, uint64_t count)
{
    for (uint64_t i = 0; i < count; i++) {
        if (flags[i]) {
            return true;
        }
    }
    return false;
}

static void copy_references(attribute_job *job, uint64_t number)
{
    mt_obj_block *block = &job->reader->blocks[number];
    mt_index *indices = job->attribute->indices + job->reader->first_corners[number];
    size_t count = block->counts[job->references], corners = block->counts[MT_OBJ_CORNERS];
    if (count > 0) {
        memcpy(indices, block->items[job->references], count * sizeof *indices);
    }
    for (size_t corner = count; corner < corners; corner++) {
        indices[corner] = MT_NONE;
    }
}

static void copy_values(attribute_job *job, uint64_t number)
{
    mt_obj_block *block = &job->reader->blocks[number];
    uint32_t components = job->attribute->component_count;
    size_t count = block->counts[job->values];
    double *values = (double *)job->attribute->values + job->reader->bases[number].counts[job->element] * components;
    if (job->values == MT_OBJ_UVS && components == 3) {
        const double *uvs = block->items[MT_OBJ_UVS];
        const double *depths = block->counts[MT_OBJ_DEPTHS] > 0 ? block->items[MT_OBJ_DEPTHS] : NULL;
        for (size_t i = 0; i < count; i++) {
            values[3 * i] = uvs[2 * i];
            values[3 * i + 1] = uvs[2 * i + 1];
            values[3 * i + 2] = depths ? depths[i] : 0.0;
        }
    } else if (count > 0) {
        memcpy(values, block->items[job->values], count * components * sizeof *values);
    }
}

static void copy_attribute(void *user, uint64_t begin, uint64_t end)
{
    attribute_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        copy_values(job, i);
        if (job->attribute->indices) {
            copy_references(job, i);
        }
    }
}

/* UVs or normals, whose layout is given but for domain and number. */
static mt_status merge_referenced(mt_context *context, attribute_job *job, mt_mesh *mesh, mt_attribute_layout *layout,
                                  const char *what)
{
    uint64_t blocks = job->reader->block_count;
    layout->value_count = job->reader->limits.counts[job->element];
    if (layout->value_count == 0) {
        return MT_OK;
    }
    bool *flags = mt_allocate_zeroed(context, 2 * blocks);
    if (!flags) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    job->mesh = mesh;
    job->differs = flags;
    job->used = flags + blocks;
    mt_parallel_for(context, blocks, 1, compare_references, job);
    bool on_vertices = layout->value_count == mesh->vertex_count && !any(job->differs, blocks);
    bool used = on_vertices || any(job->used, blocks);
    mt_free(context, flags);
    if (!used) {
        mt_warn(context, "%s: no face uses the %llu %s, which are left out", mt_text_name(job->reader->text),
                (unsigned long long)layout->value_count, what);
        return MT_OK;
    }
    layout->domain = on_vertices ? MT_DOMAIN_VERTEX : MT_DOMAIN_CORNER;
    layout->indexed = !on_vertices;
    mt_status status = mt_mesh_add_attribute(context, mesh, layout, &job->attribute);
    if (status == MT_OK) {
        mt_parallel_for(context, blocks, 1, copy_attribute, job);
        mt_obj_release_series(context, job->reader, job->values);
        mt_obj_release_series(context, job->reader, job->references);
    }
    return status;
}

mt_status mt_obj_merge_uvs(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV, .type = MT_F64, .component_count = 2};
    attribute_job job = {.reader = reader, .values = MT_OBJ_UVS, .references = MT_OBJ_CORNER_UVS, .element = MT_OBJ_UV};
    for (uint64_t i = 0; i < reader->block_count; i++) {
        layout.component_count = reader->blocks[i].counts[MT_OBJ_DEPTHS] > 0 ? 3 : layout.component_count;
    }
    return merge_referenced(context, &job, mesh, &layout, "texture vertices");
}

mt_status mt_obj_merge_normals(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL, .type = MT_F64, .component_count = 3};
    attribute_job job = {
        .reader = reader, .values = MT_OBJ_NORMALS, .references = MT_OBJ_CORNER_NORMALS, .element = MT_OBJ_NORMAL};
    return merge_referenced(context, &job, mesh, &layout, "normals");
}

static void copy_colors(void *user, uint64_t begin, uint64_t end)
{
    attribute_job *job = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_obj_block *block = &job->reader->blocks[i];
        size_t vertices = block->counts[MT_OBJ_POSITIONS], count = block->counts[MT_OBJ_COLORS];
        double *values = (double *)job->attribute->values + 3 * job->reader->bases[i].counts[MT_OBJ_VERTEX];
        if (count > 0) {
            memcpy(values, block->items[MT_OBJ_COLORS], count * 3 * sizeof *values);
        }
        for (size_t k = 3 * count; k < 3 * vertices; k++) {
            values[k] = 1.0;
        }
    }
}

mt_status mt_obj_merge_colors(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_COLOR,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = MT_F64,
                                  .component_count = 3,
                                  .value_count = mesh->vertex_count};
    attribute_job job = {.reader = reader};
    uint64_t colored = 0;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        colored += reader->blocks[i].counts[MT_OBJ_COLORS] - reader->blocks[i].uncolored_count;
    }
    if (colored == 0) {
        return MT_OK;
    }
    if (colored < mesh->vertex_count) {
        mt_warn(context, "%s: %llu of %llu vertices have no color though others do; they become white",
                mt_text_name(reader->text), (unsigned long long)(mesh->vertex_count - colored),
                (unsigned long long)mesh->vertex_count);
    }
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &job.attribute);
    if (status == MT_OK) {
        mt_parallel_for(context, reader->block_count, 1, copy_colors, &job);
    }
    return status;
}
