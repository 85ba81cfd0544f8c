#include "lib/mesh/derive_elements.h"

#include <string.h>

static mt_index target_of(const mt_derivation *derivation, mt_index vertex)
{
    return derivation->vertex_targets ? derivation->vertex_targets[vertex] : vertex;
}

static bool wire_stays(const mt_mesh *source, const mt_derivation *derivation, mt_index wire)
{
    for (mt_index i = source->wire_offsets[wire]; i < source->wire_offsets[wire + 1]; i++) {
        if (target_of(derivation, source->wire_vertices[i]) == MT_NONE) {
            return false;
        }
    }
    return true;
}

static void fill_wires(const mt_mesh *source, const mt_derivation *derivation, mt_mesh *mesh)
{
    mt_index count = 0, size = 0;
    mesh->wire_offsets[0] = 0;
    for (mt_index wire = 0; wire < source->wire_count; wire++) {
        if (!wire_stays(source, derivation, wire)) {
            continue;
        }
        for (mt_index i = source->wire_offsets[wire]; i < source->wire_offsets[wire + 1]; i++) {
            mesh->wire_vertices[size++] = target_of(derivation, source->wire_vertices[i]);
        }
        mesh->wire_offsets[++count] = size;
    }
    mesh->wire_count = count;
}

static mt_status derive_wires(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                              mt_mesh *mesh)
{
    if (!source->wire_count) {
        return MT_OK;
    }
    mt_index size = source->wire_offsets[source->wire_count];
    mesh->wire_offsets = mt_allocate_array(context, (uint64_t)source->wire_count + 1, sizeof(mt_index));
    mesh->wire_vertices = mt_allocate_array(context, size, sizeof(mt_index));
    if (!mesh->wire_offsets || !mesh->wire_vertices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    fill_wires(source, derivation, mesh);
    return MT_OK;
}

static mt_status derive_points(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                               mt_mesh *mesh)
{
    if (!source->point_count) {
        return MT_OK;
    }
    mesh->point_vertices = mt_allocate_array(context, source->point_count, sizeof(mt_index));
    if (!mesh->point_vertices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < source->point_count; i++) {
        mt_index vertex = target_of(derivation, source->point_vertices[i]);
        if (vertex != MT_NONE) {
            mesh->point_vertices[mesh->point_count++] = vertex;
        }
    }
    return MT_OK;
}

static mt_status derive_creases(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                                mt_mesh *mesh)
{
    if (!source->crease_count) {
        return MT_OK;
    }
    mesh->creases = mt_allocate_array(context, source->crease_count, sizeof *mesh->creases);
    if (!mesh->creases) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < source->crease_count; i++) {
        mt_edge_value crease = source->creases[i];
        crease.a = target_of(derivation, crease.a);
        crease.b = target_of(derivation, crease.b);
        if (crease.a != MT_NONE && crease.b != MT_NONE && crease.a != crease.b) {
            mesh->creases[mesh->crease_count++] = crease;
        }
    }
    return MT_OK;
}

static mt_status derive_sharp_vertices(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                                       mt_mesh *mesh)
{
    if (!source->sharp_vertex_count) {
        return MT_OK;
    }
    mesh->sharp_vertices = mt_allocate_array(context, source->sharp_vertex_count, sizeof *mesh->sharp_vertices);
    if (!mesh->sharp_vertices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < source->sharp_vertex_count; i++) {
        mt_vertex_value sharp = source->sharp_vertices[i];
        sharp.vertex = target_of(derivation, sharp.vertex);
        if (sharp.vertex != MT_NONE) {
            mesh->sharp_vertices[mesh->sharp_vertex_count++] = sharp;
        }
    }
    return MT_OK;
}

static mt_status copy_libraries(mt_context *context, const mt_mesh *source, mt_mesh *mesh)
{
    if (!source->material_library_count) {
        return MT_OK;
    }
    mesh->material_libraries =
        mt_allocate_array_zeroed(context, source->material_library_count, sizeof *mesh->material_libraries);
    if (!mesh->material_libraries) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < source->material_library_count; i++) {
        mesh->material_libraries[i] = mt_duplicate_string(context, source->material_libraries[i]);
        if (!mesh->material_libraries[i]) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        mesh->material_library_count = i + 1;
    }
    return MT_OK;
}

mt_status mt_derive_elements(mt_context *context, const mt_mesh *source, const mt_derivation *derivation, mt_mesh *mesh)
{
    mt_status (*const parts[])(mt_context *, const mt_mesh *, const mt_derivation *,
                               mt_mesh *) = {derive_wires, derive_points, derive_creases, derive_sharp_vertices};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        mt_status status = parts[i](context, source, derivation, mesh);
        if (status != MT_OK) {
            return status;
        }
    }
    return copy_libraries(context, source, mesh);
}

/* A face is turned when its second corner comes from before its first, as the source's corners run. */
static bool is_turned(const mt_mesh *source, const mt_derivation *derivation, const mt_mesh *mesh, mt_index face)
{
    mt_index old = derivation->face_sources ? derivation->face_sources[face] : face;
    mt_index begin = mt_mesh_face_begin(mesh, face);
    if (old == MT_NONE || mt_mesh_face_sides(mesh, face) != mt_mesh_face_sides(source, old)) {
        return false;
    }
    mt_index first = derivation->corner_sources[begin], second = derivation->corner_sources[begin + 1];
    mt_index before_first = first == mt_mesh_face_begin(source, old) ? mt_mesh_face_end(source, old) - 1 : first - 1;
    return second == before_first;
}

static void negate(mt_attribute *attribute, mt_index element)
{
    for (uint32_t i = 0; i < attribute->component_count; i++) {
        mt_attribute_set(attribute, element, i, -mt_attribute_get(attribute, element, i));
    }
}

/* Shared values could belong to unturned corners too, so an indexed attribute gets one value a corner first. */
static mt_status unshare(mt_context *context, const mt_mesh *mesh, mt_attribute *attribute)
{
    mt_index count = mt_mesh_domain_count(mesh, attribute->domain);
    size_t size = attribute->component_count * mt_type_size(attribute->type);
    char *values = mt_allocate_array_zeroed(context, count, size);
    if (!values) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index value = attribute->indices[i];
        if (value != MT_NONE) {
            memcpy(values + i * size, (const char *)attribute->values + value * size, size);
            attribute->indices[i] = i;
        }
    }
    mt_free(context, attribute->values);
    attribute->values = values;
    attribute->value_count = count;
    return MT_OK;
}

static void turn_face(mt_attribute *normals, const mt_mesh *mesh, mt_index face)
{
    if (normals->domain == MT_DOMAIN_FACE) {
        negate(normals, face);
        return;
    }
    for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
        if (!normals->indices || normals->indices[corner] != MT_NONE) {
            negate(normals, corner);
        }
    }
}

static mt_status turn_normals(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                              mt_mesh *mesh, mt_attribute *normals)
{
    bool is_shared = normals->indices != NULL;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (!is_turned(source, derivation, mesh, face)) {
            continue;
        }
        if (is_shared) {
            mt_status status = unshare(context, mesh, normals);
            if (status != MT_OK) {
                return status;
            }
            is_shared = false;
        }
        turn_face(normals, mesh, face);
    }
    return MT_OK;
}

mt_status mt_derive_turned_normals(mt_context *context, const mt_mesh *source, const mt_derivation *derivation,
                                   mt_mesh *mesh)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; derivation->corner_sources && status == MT_OK && i < mesh->attribute_count; i++) {
        mt_attribute *attribute = &mesh->attributes[i];
        bool lies_on_faces = attribute->domain == MT_DOMAIN_CORNER || attribute->domain == MT_DOMAIN_FACE;
        if (attribute->semantic == MT_SEMANTIC_NORMAL && lies_on_faces) {
            status = turn_normals(context, source, derivation, mesh, attribute);
        }
    }
    return status;
}
