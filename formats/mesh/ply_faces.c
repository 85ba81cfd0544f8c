#include "formats/mesh/ply_faces.h"

#include <meshtool/checked.h>

#include <string.h>

/* A larger block with the used bytes copied; false leaves the old one. */
static bool grow(mt_context *context, void **block, uint64_t used, uint64_t size)
{
    void *larger = mt_try_allocate(context, size);
    if (!larger) {
        return false;
    }
    if (used) {
        memcpy(larger, *block, (size_t)used);
    }
    mt_free(context, *block);
    *block = larger;
    return true;
}

bool mt_ply_faces_reserve(mt_context *context, ply_faces *faces, uint64_t count, uint64_t expected)
{
    uint64_t used = faces->corner_count, needed = used + count;
    if (needed <= faces->corner_room) {
        return true;
    }
    uint64_t room = needed + needed / 2;
    room = room < expected ? expected : room;
    if (!grow(context, (void **)&faces->vertices, used * sizeof(mt_index), room * sizeof(mt_index))) {
        return false;
    }
    if (faces->has_uvs &&
        !grow(context, (void **)&faces->uv_indices, used * sizeof(mt_index), room * sizeof(mt_index))) {
        return false;
    }
    faces->corner_room = room;
    return true;
}

bool mt_ply_faces_reserve_uvs(mt_context *context, ply_faces *faces, uint64_t count)
{
    uint64_t size = mt_type_size(faces->uv_type), used = faces->uv_count, needed = used + count;
    if (needed <= faces->uv_room) {
        return true;
    }
    uint64_t room = needed + needed / 2;
    if (!grow(context, (void **)&faces->uv_values, used * size, room * size)) {
        return false;
    }
    faces->uv_room = room;
    return true;
}

static const char *end_uvs(ply_faces *faces, uint64_t sides)
{
    uint64_t count = faces->uv_count - faces->uv_begin;
    uint32_t components = count == 2 * sides ? 2 : count == 3 * sides ? 3 : 0;
    if (count && (!components || (faces->uv_components && components != faces->uv_components))) {
        return "has a list texcoord that is not two numbers for each of its vertices";
    }
    faces->uv_components = components ? components : faces->uv_components;
    faces->some_without_uvs |= count == 0;
    for (uint64_t i = 0; i < sides; i++) {
        faces->uv_indices[faces->record_begin + i] =
            components ? (mt_index)(faces->uv_begin / components + i) : MT_NONE;
    }
    faces->uv_begin = faces->uv_count;
    return NULL;
}

const char *mt_ply_faces_end_record(ply_faces *faces)
{
    uint64_t sides = faces->corner_count - faces->record_begin;
    const char *wrong = sides < 3 ? "has fewer than 3 vertices" : NULL;
    if (!wrong && faces->has_uvs) {
        wrong = end_uvs(faces, sides);
    }
    faces->record_begin = faces->corner_count;
    return wrong;
}

/* Copies the texture coordinates of one part behind those of the earlier ones. */
static void append_uvs(const ply_faces *part, mt_attribute *uvs, uint64_t corner, mt_index value)
{
    size_t size = uvs->component_count * mt_type_size(uvs->type);
    if (part->uv_count) {
        memcpy((char *)uvs->values + value * size, part->uv_values, part->uv_count * mt_type_size(uvs->type));
    }
    for (uint64_t i = 0; uvs->indices && i < part->corner_count; i++) {
        mt_index index = part->uv_indices[i];
        uvs->indices[corner + i] = index == MT_NONE ? MT_NONE : value + index;
    }
}

static mt_status finish_uvs(mt_context *context, const ply_faces *parts, size_t count, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV, .domain = MT_DOMAIN_CORNER, .type = parts[0].uv_type};
    uint64_t numbers = 0;
    for (size_t i = 0; i < count; i++) {
        uint32_t components = parts[i].uv_components;
        if (components && layout.component_count && components != layout.component_count) {
            return mt_fail(context, MT_ERROR_SYNTAX, "some lists texcoord have two numbers a vertex and some three");
        }
        layout.component_count = components ? components : layout.component_count;
        layout.indexed |= parts[i].some_without_uvs;
        numbers += parts[i].uv_count;
    }
    if (numbers == 0) {
        return MT_OK;
    }
    layout.value_count = numbers / layout.component_count;
    mt_attribute *uvs;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &uvs);
    uint64_t corner = 0, number = 0;
    for (size_t i = 0; status == MT_OK && i < count; i++) {
        append_uvs(&parts[i], uvs, corner, (mt_index)(number / layout.component_count));
        corner += parts[i].corner_count;
        number += parts[i].uv_count;
    }
    return status;
}

/* A single part with little room to spare is taken as it is. */
static bool is_tight(const ply_faces *part)
{
    return part->vertices && part->corner_room - part->corner_count <= part->corner_count / 8;
}

mt_status mt_ply_faces_finish(mt_context *context, ply_faces *parts, size_t count, mt_mesh *mesh)
{
    uint64_t total = 0;
    for (size_t i = 0; i < count; i++) {
        total += parts[i].corner_count;
    }
    if (!mt_count_fits(total)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu corners of faces are more than a mesh can hold",
                       (unsigned long long)total);
    }
    bool taken = count == 1 && is_tight(&parts[0]);
    mt_index *vertices = taken ? parts[0].vertices : mt_allocate_array(context, total, sizeof *vertices);
    if (!vertices) {
        return mt_context_error(context)->status;
    }
    uint64_t corner = 0;
    for (size_t i = 0; !taken && i < count; i++) {
        if (parts[i].corner_count) {
            memcpy(vertices + corner, parts[i].vertices, parts[i].corner_count * sizeof *vertices);
        }
        corner += parts[i].corner_count;
        mt_free(context, parts[i].vertices);
        parts[i].vertices = NULL;
    }
    parts[0].vertices = NULL;
    mt_free(context, mesh->corner_vertices);
    mesh->corner_vertices = vertices;
    mesh->corner_count = (mt_index)total;
    return finish_uvs(context, parts, count, mesh);
}

void mt_ply_faces_release(mt_context *context, ply_faces *faces)
{
    mt_free(context, faces->vertices);
    mt_free(context, faces->uv_values);
    mt_free(context, faces->uv_indices);
    *faces = (ply_faces){0};
}
