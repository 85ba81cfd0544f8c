#include "formats/mesh/ply_records.h"

#include "formats/mesh/ply_body.h"
#include "formats/mesh/ply_faces.h"
#include "formats/mesh/ply_rows.h"

#include <string.h>

#define WINDOW_SIZE ((uint64_t)256 << 10)

typedef struct record_reader {
    mt_context *context;
    const mt_input *input;
    ply_plan *plan;
    const ply_element *element;
    const ply_target *targets;
    bool swap;
    uint64_t record, record_offset;
    uint64_t offset, end; /* of the next byte, and of the input */
    uint8_t *window;      /* bytes of the input from window_offset on */
    uint64_t window_offset, window_size, window_room;
    ply_faces faces;
} record_reader;

static mt_status fail_here(const record_reader *r, const char *sentence)
{
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, r->record_offset), "%s %llu %s",
                      r->element->name, (unsigned long long)r->record, sentence);
}

static mt_status fail_short(const record_reader *r)
{
    return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, r->end),
                      "the file ends inside %s %llu of %llu", r->element->name, (unsigned long long)r->record,
                      (unsigned long long)r->element->count);
}

/* Moves the window so that it begins at the next byte and holds `size` bytes, which the input has. */
static mt_status move_window(record_reader *r, uint64_t size)
{
    if (size > r->window_room) {
        uint8_t *larger = mt_allocate(r->context, size + size / 2);
        if (!larger) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        mt_free(r->context, r->window);
        r->window = larger;
        r->window_room = size + size / 2;
    }
    r->window_offset = r->offset;
    uint64_t left = r->end - r->offset;
    r->window_size = left < r->window_room ? left : r->window_room;
    size_t got = mt_input_read_at(r->input, r->offset, r->window, (size_t)r->window_size);
    if (got != r->window_size) {
        r->window_size = 0;
        return mt_input_fail_read_at(r->context, r->input, r->offset);
    }
    return MT_OK;
}

/* The next `size` bytes, and moves past them. */
static inline mt_status take(record_reader *r, uint64_t size, const uint8_t **bytes)
{
    if (size > r->end - r->offset) {
        return fail_short(r);
    }
    if (r->offset + size > r->window_offset + r->window_size) {
        mt_status status = move_window(r, size);
        if (status != MT_OK) {
            return status;
        }
    }
    *bytes = r->window + (r->offset - r->window_offset);
    r->offset += size;
    return MT_OK;
}

static mt_status fail_memory(const record_reader *r)
{
    return mt_fail(r->context, MT_ERROR_OUT_OF_MEMORY, "%s: memory for the faces is missing", mt_input_name(r->input));
}

static mt_status add_vertices(record_reader *r, const ply_property *property, const uint8_t *bytes, uint64_t count)
{
    if (count == 0) {
        return MT_OK;
    }
    ply_faces *faces = &r->faces;
    mt_index limit = mt_ply_index_limit(r->plan, property->type);
    size_t size = mt_type_size(property->type);
    uint64_t expected = 4 * r->element->count, left = (r->end - r->offset) / size + count;
    if (!mt_ply_faces_reserve(r->context, faces, count, expected < left ? expected : left)) {
        return fail_memory(r);
    }
    mt_index *vertices = faces->vertices + faces->corner_count;
    bool plain = size == sizeof *vertices && !r->swap;
    for (uint64_t i = 0; i < count; i++) {
        if (plain) {
            memcpy(&vertices[i], bytes + i * size, sizeof *vertices);
        } else {
            mt_ply_store(mt_ply_load(bytes + i * size, property->type, r->swap), MT_U32, &vertices[i]);
        }
        if (vertices[i] >= limit) {
            return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, r->record_offset),
                              "%s %llu names vertex %lld, but the %lu vertices are numbered from 0", r->element->name,
                              (unsigned long long)r->record, (long long)mt_ply_shown_index(vertices[i], property->type),
                              (unsigned long)r->plan->mesh->vertex_count);
        }
    }
    faces->corner_count += count;
    return MT_OK;
}

static mt_status add_uvs(record_reader *r, const ply_property *property, const uint8_t *bytes, uint64_t count)
{
    ply_faces *faces = &r->faces;
    size_t size = mt_type_size(property->type);
    if (!mt_ply_faces_reserve_uvs(r->context, faces, count)) {
        return fail_memory(r);
    }
    for (uint64_t i = 0; i < count; i++) {
        mt_ply_store(mt_ply_load(bytes + i * size, property->type, r->swap), property->type,
                     faces->uv_values + (faces->uv_count + i) * size);
    }
    faces->uv_count += count;
    return MT_OK;
}

static mt_status read_list(record_reader *r, const ply_property *property, const ply_target *target)
{
    const uint8_t *bytes = NULL;
    mt_status status = take(r, mt_type_size(property->count_type), &bytes);
    if (status != MT_OK) {
        return status;
    }
    double length = mt_ply_load(bytes, property->count_type, r->swap);
    if (length < 0) {
        return fail_here(r, "has a list of negative length");
    }
    uint64_t count = (uint64_t)length, size = count * mt_type_size(property->type);
    if (size > r->end - r->offset) {
        return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, r->record_offset),
                          "%s %llu has a list of %llu numbers, but only %llu bytes are left", r->element->name,
                          (unsigned long long)r->record, (unsigned long long)count,
                          (unsigned long long)(r->end - r->offset));
    }
    if (target->use == PLY_SKIP) {
        r->offset += size;
        return MT_OK;
    }
    status = take(r, size, &bytes);
    if (status == MT_OK) {
        status = target->use == PLY_FACE_VERTICES ? add_vertices(r, property, bytes, count)
                                                  : add_uvs(r, property, bytes, count);
    }
    return status;
}

static mt_status read_scalar(record_reader *r, const ply_property *property, const ply_target *target)
{
    const uint8_t *bytes = NULL;
    mt_status status = take(r, mt_type_size(property->type), &bytes);
    if (status == MT_OK && target->use == PLY_SCALAR) {
        mt_ply_store(mt_ply_load(bytes, property->type, r->swap), target->type,
                     target->values + r->record * target->stride);
    }
    return status;
}

static mt_status read_record(record_reader *r, bool is_face)
{
    mt_status status = MT_OK;
    r->record_offset = r->offset;
    for (uint32_t i = 0; status == MT_OK && i < r->element->property_count; i++) {
        const ply_property *property = &r->element->properties[i];
        status = property->is_list ? read_list(r, property, &r->targets[i]) : read_scalar(r, property, &r->targets[i]);
    }
    if (status == MT_OK && is_face) {
        const char *wrong = mt_ply_faces_end_record(&r->faces);
        /* An offset past what a mesh can hold is found out at the end, before any use. */
        r->plan->mesh->face_offsets[r->record + 1] = (mt_index)r->faces.corner_count;
        status = wrong ? fail_here(r, wrong) : MT_OK;
    }
    return status;
}

static mt_status check_edges(const record_reader *r)
{
    const mt_mesh *mesh = r->plan->mesh;
    for (uint64_t i = 0; i < 2 * (uint64_t)mesh->wire_count; i++) {
        if (mesh->wire_vertices[i] >= mesh->vertex_count) {
            return mt_fail_at(r->context, MT_ERROR_SYNTAX, mt_input_place_offset(r->input, r->record_offset),
                              "edge %llu names a vertex out of range", (unsigned long long)(i / 2));
        }
    }
    return MT_OK;
}

static mt_status read_all(record_reader *r, uint32_t element)
{
    mt_mesh *mesh = r->plan->mesh;
    bool is_face = element == r->plan->faces;
    mt_status status = MT_OK;
    for (r->record = 0; status == MT_OK && r->record < r->element->count; r->record++) {
        status = read_record(r, is_face);
    }
    if (status == MT_OK && is_face) {
        status = mt_ply_faces_finish(r->context, &r->faces, 1, mesh);
    }
    if (status == MT_OK && is_face) {
        mt_mesh_compact_faces(r->context, mesh);
    }
    return status == MT_OK && element == r->plan->edges ? check_edges(r) : status;
}

mt_status mt_ply_read_records(mt_context *context, const mt_input *input, ply_plan *plan, uint32_t element, bool swap,
                              uint64_t *offset)
{
    record_reader r = {.context = context,
                       .input = input,
                       .plan = plan,
                       .element = &plan->header.elements[element],
                       .targets = plan->targets[element],
                       .swap = swap,
                       .offset = *offset,
                       .end = mt_input_size(input),
                       .faces = {.has_uvs = plan->has_corner_uvs, .uv_type = plan->corner_uv_type}};
    mt_status status = move_window(&r, r.end - r.offset < WINDOW_SIZE ? r.end - r.offset : WINDOW_SIZE);
    if (status == MT_OK) {
        status = read_all(&r, element);
    }
    *offset = r.offset;
    mt_ply_faces_release(context, &r.faces);
    mt_free(context, r.window);
    return status;
}
