/* Elements without lists have records of one size. Elements with lists are taken to repeat the lengths of their first
 * record (triangles, nearly always), every record is verified, and where one differs the element is read again record
 * by record. Both read the file in blocks; nothing is allocated for lists that the bytes present do not hold. */
#include "formats/mesh/ply_body.h"
#include "formats/mesh/ply_records.h"
#include "formats/mesh/ply_rows.h"

#include <meshtool/checked.h>

#include <string.h>

typedef struct binary_reader {
    mt_context *context;
    mt_input *input;
    ply_plan *plan;
    uint32_t element;
    uint64_t offset; /* of the next record */
    ply_rows rows;
    uint64_t *list_lengths; /* per property, of the first record */
} binary_reader;

mt_index mt_ply_index_limit(const ply_plan *plan, mt_type type)
{
    mt_index count = plan->mesh->vertex_count;
    bool is_signed = type == MT_I8 || type == MT_I16 || type == MT_I32;
    return is_signed && count > (mt_index)INT32_MAX ? (mt_index)INT32_MAX + 1 : count;
}

static bool is_swapped(const ply_plan *plan)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    return plan->header.encoding == PLY_LITTLE;
#else
    return plan->header.encoding == PLY_BIG;
#endif
}

static const ply_element *current(const binary_reader *r)
{
    return &r->plan->header.elements[r->element];
}

static const ply_target *target_of(const binary_reader *r, uint32_t property)
{
    return &r->plan->targets[r->element][property];
}

/* The layout of the first record, and from it the size of all; false when its end is not within `size` bytes. */
static bool measure_first_record(binary_reader *r, const uint8_t *bytes, size_t size)
{
    const ply_element *e = current(r);
    ply_rows *rows = &r->rows;
    size_t at = 0;
    for (uint32_t i = 0; i < e->property_count; i++) {
        const ply_property *property = &e->properties[i];
        r->list_lengths[i] = 1;
        if (property->is_list) {
            size_t length_size = mt_type_size(property->count_type);
            if (size - at < length_size) {
                return false;
            }
            double length = mt_ply_load(bytes + at, property->count_type, rows->swap);
            if (length < 0 || length > PLY_ROW_MAX) {
                return false;
            }
            ply_length *kept = &rows->lengths[rows->length_count++];
            *kept = (ply_length){.offset = at, .size = length_size};
            memcpy(kept->bytes, bytes + at, length_size);
            at += length_size;
            r->list_lengths[i] = (uint64_t)length;
        }
        size_t item_size = mt_type_size(property->type) * (size_t)r->list_lengths[i];
        if (size - at < item_size) {
            return false;
        }
        at += item_size;
    }
    rows->size = at;
    return true;
}

/* One column for each number that goes somewhere. The targets of lists must be set. */
static mt_status make_columns(binary_reader *r, const ply_target *lists)
{
    const ply_element *e = current(r);
    ply_rows *rows = &r->rows;
    uint64_t room = 0;
    for (uint32_t i = 0; i < e->property_count; i++) {
        room += target_of(r, i)->use == PLY_SKIP ? 0 : r->list_lengths[i];
    }
    rows->columns = mt_allocate_array(r->context, room, sizeof *rows->columns);
    if (!rows->columns) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    size_t at = 0;
    for (uint32_t i = 0; i < e->property_count; i++) {
        const ply_property *property = &e->properties[i];
        const ply_target *target =
            target_of(r, i)->use >= PLY_FACE_VERTICES ? &lists[target_of(r, i)->use] : target_of(r, i);
        size_t size = mt_type_size(property->type), stored = mt_type_size(target->type);
        at += property->is_list ? mt_type_size(property->count_type) : 0;
        for (uint64_t j = 0; target->use != PLY_SKIP && j < r->list_lengths[i]; j++) {
            ply_column *column = &rows->columns[rows->column_count++];
            *column = (ply_column){at + j * size, property->type, *target};
            column->target.values += j * stored;
        }
        at += size * r->list_lengths[i];
    }
    return MT_OK;
}

static mt_status fail_index(const binary_reader *r, uint64_t record, uint64_t offset, mt_index index, mt_type type)
{
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, offset),
                      "%s %llu names vertex %lld, but the %lu vertices are numbered from 0", current(r)->name,
                      (unsigned long long)record, (long long)mt_ply_shown_index(index, type),
                      (unsigned long)r->plan->mesh->vertex_count);
}

static mt_status read_rows(binary_reader *r, bool *uniform, mt_type index_type)
{
    ply_rows *rows = &r->rows;
    uint64_t bad;
    mt_status status = mt_ply_rows_read(r->context, r->input, rows, uniform, &bad);
    if (status == MT_OK && *uniform && bad != UINT64_MAX) {
        const mt_index *indices = rows->indices + bad * rows->index_count;
        while (*indices < rows->index_limit) {
            indices++;
        }
        status = fail_index(r, bad, rows->offset + bad * rows->size, *indices, index_type);
    }
    return status;
}

static mt_status prepare_rows(binary_reader *r)
{
    const ply_element *e = current(r);
    r->rows = (ply_rows){.offset = r->offset, .count = e->count, .swap = is_swapped(r->plan)};
    r->rows.lengths = mt_allocate_array(r->context, e->property_count, sizeof *r->rows.lengths);
    r->list_lengths = mt_allocate_array(r->context, e->property_count, sizeof *r->list_lengths);
    return r->rows.lengths && r->list_lengths ? MT_OK : mt_context_error(r->context)->status;
}

static void release_rows(binary_reader *r)
{
    mt_free(r->context, r->rows.columns);
    mt_free(r->context, r->rows.lengths);
    mt_free(r->context, r->list_lengths);
    r->rows = (ply_rows){0};
    r->list_lengths = NULL;
}

/* Vertices and edges without lists; the counts were checked against the size of the input. */
static mt_status read_fixed(binary_reader *r)
{
    static const uint8_t none[PLY_ROW_MAX]; /* there are no lengths to read in it */
    ply_rows *rows = &r->rows;
    bool uniform;
    mt_type index_type = MT_U32;
    measure_first_record(r, none, sizeof none);
    mt_status status = make_columns(r, NULL);
    if (r->element == r->plan->edges) {
        index_type = current(r)->properties[mt_ply_find_property(current(r), "vertex1")].type;
        rows->indices = r->plan->mesh->wire_vertices;
        rows->index_count = 2;
        rows->index_limit = mt_ply_index_limit(r->plan, index_type);
    }
    if (status == MT_OK) {
        status = read_rows(r, &uniform, index_type);
    }
    r->offset += rows->size * rows->count;
    return status;
}

/* The face's lists: how many vertices and texture coordinates the first record has. */
static void find_lists(const binary_reader *r, uint64_t *sides, uint64_t *uvs, mt_type *index_type)
{
    const ply_element *e = current(r);
    *sides = *uvs = 0;
    *index_type = MT_U32;
    for (uint32_t i = 0; i < e->property_count; i++) {
        if (target_of(r, i)->use == PLY_FACE_VERTICES) {
            *sides = r->list_lengths[i];
            *index_type = e->properties[i].type;
        } else if (target_of(r, i)->use == PLY_FACE_UVS) {
            *uvs = r->list_lengths[i];
        }
    }
}

/* Room in the mesh for faces that all have so many sides, and where their lists go. */
static mt_status make_uniform_faces(binary_reader *r, uint64_t sides, uint64_t uvs, ply_target *lists)
{
    mt_mesh *mesh = r->plan->mesh;
    uint64_t corner_count = sides * r->rows.count; /* fits: each has a byte in the file */
    mt_free(r->context, mesh->corner_vertices);
    mesh->corner_vertices = mt_allocate_array(r->context, corner_count, sizeof(mt_index));
    if (!mesh->corner_vertices) {
        return mt_context_error(r->context)->status;
    }
    mesh->corner_count = (mt_index)corner_count;
    lists[PLY_FACE_VERTICES] =
        (ply_target){PLY_SCALAR, MT_U32, (char *)mesh->corner_vertices, sides * sizeof(mt_index)};
    if (!uvs) {
        lists[PLY_FACE_UVS] = (ply_target){.use = PLY_SKIP};
        return MT_OK;
    }
    mt_attribute *attribute;
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = r->plan->corner_uv_type,
                                  .component_count = (uint32_t)(uvs / sides),
                                  .value_count = corner_count};
    mt_status status = mt_mesh_add_attribute(r->context, mesh, &layout, &attribute);
    if (status == MT_OK) {
        lists[PLY_FACE_UVS] = (ply_target){PLY_SCALAR, layout.type, attribute->values, uvs * mt_type_size(layout.type)};
    }
    return status;
}

/* Undoes make_uniform_faces. */
static void drop_uniform_faces(binary_reader *r, uint64_t uvs)
{
    mt_mesh *mesh = r->plan->mesh;
    if (uvs) {
        mt_mesh_remove_attribute(r->context, mesh, mesh->attribute_count - 1);
    }
    mt_free(r->context, mesh->corner_vertices);
    mesh->corner_vertices = NULL;
    mesh->corner_count = 0;
}

/* Reads the faces as if all were like the first; *uniform is false when they are not. */
static mt_status read_uniform_faces(binary_reader *r, bool *uniform)
{
    ply_rows *rows = &r->rows;
    uint8_t bytes[PLY_ROW_MAX];
    uint64_t sides, uvs, size;
    mt_type index_type;
    *uniform = false;
    size_t got = mt_input_read_at(r->input, r->offset, bytes, sizeof bytes);
    if (got == SIZE_MAX) {
        return mt_input_fail_read_at(r->context, r->input, r->offset);
    }
    if (!measure_first_record(r, bytes, got)) {
        return MT_OK;
    }
    find_lists(r, &sides, &uvs, &index_type);
    uint64_t left = mt_input_size(r->input) - r->offset;
    bool regular = sides >= 3 && (uvs == 0 || uvs == 2 * sides || uvs == 3 * sides) &&
                   mt_checked_multiply(rows->count, rows->size, &size) && size <= left &&
                   mt_count_fits(sides * rows->count);
    if (!regular) {
        return MT_OK;
    }
    ply_target lists[PLY_FACE_UVS + 1];
    mt_status status = make_uniform_faces(r, sides, uvs, lists);
    if (status == MT_OK) {
        status = make_columns(r, lists);
    }
    if (status == MT_OK) {
        rows->indices = r->plan->mesh->corner_vertices;
        rows->index_count = (uint32_t)sides;
        rows->index_limit = mt_ply_index_limit(r->plan, index_type);
        status = read_rows(r, uniform, index_type);
    }
    if (status == MT_OK && *uniform) {
        r->plan->mesh->face_size = (mt_index)sides;
        mt_free(r->context, r->plan->mesh->face_offsets);
        r->plan->mesh->face_offsets = NULL;
        r->offset += size;
    } else if (status == MT_OK) {
        drop_uniform_faces(r, uvs);
    }
    return status;
}

static bool has_lists(const ply_element *element)
{
    for (uint32_t i = 0; i < element->property_count; i++) {
        if (element->properties[i].is_list) {
            return true;
        }
    }
    return false;
}

static mt_status read_element(binary_reader *r)
{
    const ply_element *e = current(r);
    bool done = false;
    if (e->count == 0) {
        return MT_OK;
    }
    if (!has_lists(e) && !mt_ply_plan_uses(r->plan, r->element)) {
        r->offset += e->count * mt_ply_smallest_record(e, PLY_LITTLE);
        return MT_OK;
    }
    mt_status status = prepare_rows(r);
    if (status == MT_OK && !has_lists(e)) {
        status = read_fixed(r);
        done = true;
    } else if (status == MT_OK && r->element == r->plan->faces) {
        status = read_uniform_faces(r, &done);
    }
    release_rows(r);
    if (status == MT_OK && !done) {
        status = mt_ply_read_records(r->context, r->input, r->plan, r->element, is_swapped(r->plan), &r->offset);
    }
    return status;
}

mt_status mt_ply_read_binary(mt_context *context, mt_input *input, ply_plan *plan)
{
    binary_reader r = {.context = context, .input = input, .plan = plan, .offset = plan->header.body_offset};
    mt_status status = MT_OK;
    for (r.element = 0; status == MT_OK && r.element < plan->header.element_count; r.element++) {
        status = read_element(&r);
        if (status == MT_OK && r.offset > mt_input_size(input)) {
            status = mt_fail_at(context, MT_ERROR_SYNTAX, mt_input_place_offset(input, mt_input_size(input)),
                                "the file ends inside element \"%.80s\"", current(&r)->name);
        }
    }
    if (status == MT_OK && r.offset < mt_input_size(input)) {
        mt_warn(context, "%s: %llu bytes after the last element are ignored", mt_input_name(input),
                (unsigned long long)(mt_input_size(input) - r.offset));
    }
    return status;
}
