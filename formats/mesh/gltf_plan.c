/* The plan of a glTF file: faces gathered by part and material, in their order within each; chunks of vertices. */
#include "formats/mesh/gltf_write.h"

#include <string.h>

mt_gltf_chunk *mt_gltf_add_chunk(mt_gltf_plan *plan)
{
    if (plan->chunk_count == plan->chunk_capacity) {
        size_t capacity = 2 * plan->chunk_capacity + 4;
        mt_gltf_chunk *chunks = mt_reallocate(plan->context, plan->chunks, capacity * sizeof *chunks);
        if (!chunks) {
            return NULL;
        }
        plan->chunks = chunks;
        plan->chunk_capacity = capacity;
    }
    mt_gltf_chunk *chunk = &plan->chunks[plan->chunk_count++];
    *chunk = (mt_gltf_chunk){.part = MT_NONE, .primitive_begin = plan->primitive_count};
    return chunk;
}

mt_gltf_primitive *mt_gltf_add_primitive(mt_gltf_plan *plan)
{
    if (plan->primitive_count == plan->primitive_capacity) {
        size_t capacity = 2 * plan->primitive_capacity + 8;
        mt_gltf_primitive *primitives = mt_reallocate(plan->context, plan->primitives, capacity * sizeof *primitives);
        if (!primitives) {
            return NULL;
        }
        plan->primitives = primitives;
        plan->primitive_capacity = capacity;
    }
    mt_gltf_primitive *primitive = &plan->primitives[plan->primitive_count++];
    *primitive = (mt_gltf_primitive){.mode = MT_GLTF_TRIANGLES, .material = MT_NONE};
    plan->chunks[plan->chunk_count - 1].primitive_count++;
    return primitive;
}

static mt_index face_of(const mt_gltf_plan *plan, mt_index triangle)
{
    return mt_triangulation_face(&plan->triangulation, triangle);
}

static mt_index label_of(const mt_labels *labels, mt_index face)
{
    return labels ? labels->face_labels[face] : MT_NONE;
}

/* Sorts triangles by a label, those of one label in their order, those without one last. */
static mt_status sort_by(mt_gltf_plan *plan, const mt_labels *labels, mt_index *order)
{
    mt_index count = plan->triangulation.triangle_count, names = labels ? labels->name_count : 0;
    if (!labels) {
        return MT_OK;
    }
    mt_index *begins = mt_allocate_array_zeroed(plan->context, (uint64_t)names + 2, sizeof *begins);
    mt_index *sorted = mt_allocate_array(plan->context, count, sizeof *sorted);
    for (mt_index i = 0; begins && i < count; i++) {
        mt_index label = label_of(labels, face_of(plan, i));
        begins[(label == MT_NONE ? names : label) + 1]++;
    }
    for (mt_index i = 0; begins && i < names; i++) {
        begins[i + 1] += begins[i];
    }
    for (mt_index i = 0; begins && sorted && i < count; i++) {
        mt_index label = label_of(labels, face_of(plan, order[i]));
        sorted[begins[label == MT_NONE ? names : label]++] = order[i];
    }
    if (begins && sorted) {
        memcpy(order, sorted, count * sizeof *order);
    }
    mt_status status = begins && sorted ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    mt_free(plan->context, begins);
    mt_free(plan->context, sorted);
    return status;
}

/* The triangles in the order in which they are written; NULL when there are no labels. */
static mt_status order_triangles(mt_gltf_plan *plan, mt_index **out)
{
    mt_index count = plan->triangulation.triangle_count;
    *out = NULL;
    if (!plan->parts && !plan->materials) {
        return MT_OK;
    }
    mt_index *order = mt_allocate_array(plan->context, count, sizeof *order);
    *out = order;
    if (!order) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < count; i++) {
        order[i] = i;
    }
    mt_status status = sort_by(plan, plan->materials, order);
    if (status == MT_OK) {
        status = sort_by(plan, plan->parts, order);
    }
    for (mt_index i = 0; i < count && status == MT_OK; i++) {
        plan->reordered = plan->reordered || order[i] != i;
    }
    return status;
}

static mt_status open_chunk(mt_gltf_plan *plan, mt_index part, mt_index material)
{
    mt_gltf_chunk *chunk = mt_gltf_add_chunk(plan);
    mt_gltf_primitive *primitive = chunk ? mt_gltf_add_primitive(plan) : NULL;
    if (!primitive) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    chunk->part = part;
    primitive->material = material;
    primitive->begin = plan->index_count;
    return MT_OK;
}

/* A triangle of another part or material than the one before it. */
static mt_status begin_run(mt_gltf_plan *plan, mt_index part, mt_index material, bool apart)
{
    bool same_part = plan->chunk_count > 0 && plan->chunks[plan->chunk_count - 1].part == part;
    if (!same_part || apart) {
        return open_chunk(plan, part, material);
    }
    mt_gltf_primitive *primitive = mt_gltf_add_primitive(plan);
    if (!primitive) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    primitive->material = material;
    primitive->begin = plan->index_count;
    return MT_OK;
}

static mt_status add_triangles(mt_gltf_plan *plan, bool apart)
{
    mt_index *order, last_part = MT_NONE, last_material = MT_NONE;
    mt_index count = plan->triangulation.triangle_count;
    const mt_index *corner_vertices =
        plan->split.corner_vertices ? plan->split.corner_vertices : plan->mesh->corner_vertices;
    mt_status status = order_triangles(plan, &order);
    for (mt_index i = 0; i < count && status == MT_OK; i++) {
        mt_index triangle = order ? order[i] : i, face = face_of(plan, triangle);
        mt_index part = label_of(plan->parts, face), material = label_of(plan->materials, face);
        if (i == 0 || part != last_part || material != last_material) {
            status = begin_run(plan, part, material, apart);
        }
        last_part = part;
        last_material = material;
        for (mt_index side = 0; side < 3 && plan->own_indices; side++) {
            mt_index corner = mt_triangulation_corner(&plan->triangulation, triangle, side);
            plan->own_indices[plan->index_count + side] = corner_vertices[corner];
        }
        plan->index_count += 3;
        if (status == MT_OK) {
            plan->primitives[plan->primitive_count - 1].count += 3;
        }
    }
    mt_free(plan->context, order);
    return status;
}

/* Wires of two vertices that follow each other are one primitive; a longer one is a primitive of its own. */
static mt_status add_wires(mt_gltf_plan *plan)
{
    const mt_mesh *mesh = plan->mesh;
    bool runs = false;
    for (mt_index i = 0; i < mesh->wire_count; i++) {
        mt_index begin = mesh->wire_offsets[i], count = mesh->wire_offsets[i + 1] - begin;
        if (!(runs && count == 2)) {
            mt_gltf_primitive *primitive = mt_gltf_add_primitive(plan);
            if (!primitive) {
                return MT_ERROR_OUT_OF_MEMORY;
            }
            primitive->mode = count == 2 ? MT_GLTF_LINES : MT_GLTF_LINE_STRIP;
            primitive->begin = plan->index_count;
        }
        runs = count == 2;
        memcpy(plan->own_indices + plan->index_count, mesh->wire_vertices + begin, count * sizeof(mt_index));
        plan->primitives[plan->primitive_count - 1].count += count;
        plan->index_count += count;
    }
    return MT_OK;
}

static mt_status add_points(mt_gltf_plan *plan)
{
    const mt_mesh *mesh = plan->mesh;
    bool alone = mesh->point_count == 0 && plan->primitive_count == 0 && mesh->vertex_count > 0;
    if (mesh->point_count == 0 && !alone) {
        return MT_OK;
    }
    mt_gltf_primitive *primitive = mt_gltf_add_primitive(plan);
    if (!primitive) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    primitive->mode = MT_GLTF_POINTS;
    primitive->begin = plan->index_count;
    primitive->count = mesh->point_count;
    if (mesh->point_count > 0) {
        memcpy(plan->own_indices + plan->index_count, mesh->point_vertices, mesh->point_count * sizeof(mt_index));
    }
    plan->index_count += mesh->point_count;
    return MT_OK;
}

static mt_status add_elements(mt_gltf_plan *plan, bool apart)
{
    const mt_mesh *mesh = plan->mesh;
    bool any = mesh->wire_count > 0 || mesh->point_count > 0 || (plan->chunk_count == 0 && mesh->vertex_count > 0);
    if (!any) {
        return MT_OK;
    }
    if ((plan->chunk_count != 1 || apart) && !mt_gltf_add_chunk(plan)) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_status status = add_wires(plan);
    return status == MT_OK ? add_points(plan) : status;
}

/* Gives every chunk vertices of its own, numbered as its indices first name them. */
static void number_chunk(mt_gltf_plan *plan, mt_gltf_chunk *chunk, mt_index *local, mt_index *owner, mt_index *vertices)
{
    mt_index self = (mt_index)(chunk - plan->chunks);
    chunk->vertices = vertices;
    for (size_t p = 0; p < chunk->primitive_count; p++) {
        const mt_gltf_primitive *primitive = &plan->primitives[chunk->primitive_begin + p];
        for (uint64_t i = primitive->begin; i < primitive->begin + primitive->count; i++) {
            mt_index vertex = plan->own_indices[i];
            if (owner[vertex] != self) {
                owner[vertex] = self;
                local[vertex] = chunk->vertex_count;
                vertices[chunk->vertex_count++] = vertex;
            }
            plan->own_indices[i] = local[vertex];
        }
    }
}

/* Vertices in no element go with the first chunk. */
static void add_isolated(mt_gltf_plan *plan, const uint8_t *used, mt_gltf_chunk *chunk, mt_index *vertices)
{
    for (mt_index vertex = 0; vertex < plan->split.vertex_count; vertex++) {
        if (!used[vertex]) {
            vertices[chunk->vertex_count++] = vertex;
        }
    }
}

static mt_status number_chunks(mt_gltf_plan *plan)
{
    mt_index count = plan->split.vertex_count;
    if (plan->chunk_count < 2) {
        for (size_t i = 0; i < plan->chunk_count; i++) {
            plan->chunks[i].vertex_count = count;
        }
        return MT_OK;
    }
    mt_index *local = mt_allocate_array(plan->context, count, sizeof *local);
    mt_index *owner = mt_allocate_array(plan->context, count, sizeof *owner);
    uint8_t *used = mt_allocate_zeroed(plan->context, count);
    plan->own_vertices = mt_allocate_array(plan->context, plan->index_count + count, sizeof *plan->own_vertices);
    bool had = local && owner && used && plan->own_vertices;
    if (had) {
        memset(owner, 0xFF, count * sizeof *owner);
        for (uint64_t i = 0; i < plan->index_count; i++) {
            used[plan->own_indices[i]] = 1;
        }
    }
    mt_index *vertices = plan->own_vertices;
    for (size_t i = 0; i < plan->chunk_count && had; i++) {
        number_chunk(plan, &plan->chunks[i], local, owner, vertices);
        if (i == 0) {
            add_isolated(plan, used, &plan->chunks[0], vertices);
        }
        vertices += plan->chunks[i].vertex_count;
    }
    mt_free(plan->context, local);
    mt_free(plan->context, owner);
    mt_free(plan->context, used);
    return had ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

/* Indices are the mesh's own corners when nothing is split, gathered or added. */
static mt_status make_room(mt_gltf_plan *plan)
{
    const mt_mesh *mesh = plan->mesh;
    uint64_t wires = mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0;
    uint64_t count = 3 * (uint64_t)plan->triangulation.triangle_count + wires + mesh->point_count;
    plan->indices = mesh->corner_vertices;
    if (!plan->triangulation.corners && !plan->split.corner_vertices && !plan->parts && !plan->materials &&
        wires == 0 && mesh->point_count == 0) {
        return MT_OK;
    }
    plan->own_indices = mt_allocate_array(plan->context, count, sizeof *plan->own_indices);
    plan->indices = plan->own_indices;
    return plan->own_indices ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

mt_status mt_gltf_plan_make(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                            mt_gltf_plan *out)
{
    bool apart = options && options->draco.compress;
    *out = (mt_gltf_plan){.context = context,
                          .mesh = mesh,
                          .parts = mt_gltf_part_labels(mesh),
                          .materials = mt_mesh_find_labels(mesh, MT_LABEL_MATERIAL)};
    out->column_count = mt_gltf_list_columns(mesh, out->columns);
    mt_status status = options ? mt_gltf_quantise(out, options) : MT_OK;
    if (status == MT_OK) {
        status = mt_gltf_split_make(context, mesh, out->columns, out->column_count, &out->split);
    }
    if (status == MT_OK) {
        status = mt_triangulation_init(context, mesh, &out->triangulation);
    }
    if (status == MT_OK) {
        status = make_room(out);
    }
    if (status == MT_OK) {
        status = add_triangles(out, apart);
    }
    if (status == MT_OK) {
        status = add_elements(out, apart);
    }
    if (status == MT_OK) {
        status = number_chunks(out);
    }
    if (status != MT_OK) {
        mt_gltf_plan_release(out);
    }
    return status;
}

void mt_gltf_plan_release(mt_gltf_plan *plan)
{
    for (size_t i = 0; i < plan->chunk_count; i++) {
        mt_free(plan->context, plan->chunks[i].packed.bytes);
    }
    mt_free(plan->context, plan->chunks);
    mt_free(plan->context, plan->primitives);
    mt_free(plan->context, plan->own_indices);
    mt_free(plan->context, plan->own_vertices);
    mt_triangulation_release(plan->context, &plan->triangulation);
    mt_gltf_split_release(plan->context, &plan->split);
    *plan = (mt_gltf_plan){0};
}
