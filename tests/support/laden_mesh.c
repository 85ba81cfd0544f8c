#include "tests/support/laden_mesh.h"

#include <string.h>

static mt_status make_frame(mt_context *context, mt_mesh **out)
{
    static const double positions[21] = {-1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1, 0, 1, 0, 0.1, 7, 1.0 / 3, -0.0, 8, 9};
    static const mt_index corners[16] = {0, 1, 2, 3, 1, 0, 4, 2, 1, 4, 3, 2, 4, 0, 3, 4};
    static const mt_index offsets[6] = {0, 4, 7, 10, 13, 16};
    mt_mesh_layout layout = {.vertex_count = 7, .face_count = 5, .corner_count = 16, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status == MT_OK) {
        memcpy((*out)->positions, positions, sizeof positions);
        memcpy((*out)->corner_vertices, corners, sizeof corners);
        memcpy((*out)->face_offsets, offsets, sizeof offsets);
    }
    return status;
}

static mt_status add_attribute(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout)
{
    mt_attribute *attribute;
    mt_status status = mt_mesh_add_attribute(context, mesh, layout, &attribute);
    if (status != MT_OK) {
        return status;
    }
    for (mt_index value = 0; value < attribute->value_count; value++) {
        for (uint32_t component = 0; component < attribute->component_count; component++) {
            mt_attribute_set(attribute, value, component, (value * 5 + component * 3) % 11 * 0.25);
        }
    }
    for (mt_index i = 0; attribute->indices && i < mt_mesh_domain_count(mesh, attribute->domain); i++) {
        attribute->indices[i] = i % 6 == 5 ? MT_NONE : i * 7 % attribute->value_count;
    }
    return MT_OK;
}

static mt_status add_attributes(mt_context *context, mt_mesh *mesh)
{
    static const mt_attribute_layout layouts[] = {
        {"", MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX, MT_F32, 3, 7, false},
        {"", MT_SEMANTIC_UV, MT_DOMAIN_CORNER, MT_F64, 2, 4, true},
        {"tint", MT_SEMANTIC_COLOR, MT_DOMAIN_FACE, MT_U8, 4, 5, false},
        {"quality", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_I16, 1, 7, false},
        {"bend", MT_SEMANTIC_GENERIC, MT_DOMAIN_CORNER, MT_F32, 1, 16, false},
        {"time", MT_SEMANTIC_GENERIC, MT_DOMAIN_MESH, MT_F64, 1, 1, false},
    };
    mt_status status = MT_OK;
    for (size_t i = 0; status == MT_OK && i < sizeof layouts / sizeof *layouts; i++) {
        status = add_attribute(context, mesh, &layouts[i]);
    }
    return status;
}

static mt_status add_labels(mt_context *context, mt_mesh *mesh, mt_label_kind kind, const char *const *names,
                            mt_index name_count)
{
    mt_labels *labels;
    mt_status status = mt_mesh_add_labels(context, mesh, kind, &labels);
    for (mt_index i = 0; status == MT_OK && i < name_count; i++) {
        mt_index number;
        status = mt_labels_add_name(context, labels, names[i], &number);
    }
    for (mt_index face = 1; status == MT_OK && face < mesh->face_count; face++) {
        labels->face_labels[face] = face % name_count; /* the first face keeps none */
    }
    return status;
}

static mt_status add_label_sets(mt_context *context, mt_mesh *mesh)
{
    static const char *const groups[] = {"base", "sides", ""}, *const materials[] = {"red"},
                             *const objects[] = {"a", "b"};
    mt_status status = add_labels(context, mesh, MT_LABEL_GROUP, groups, 3);
    if (status == MT_OK) {
        status = add_labels(context, mesh, MT_LABEL_MATERIAL, materials, 1);
    }
    return status == MT_OK ? add_labels(context, mesh, MT_LABEL_OBJECT, objects, 2) : status;
}

static void *copy_of(mt_context *context, const void *source, size_t size)
{
    void *copy = mt_allocate(context, size);
    if (copy) {
        memcpy(copy, source, size);
    }
    return copy;
}

static mt_status add_elements(mt_context *context, mt_mesh *mesh)
{
    static const mt_index wire_offsets[] = {0, 2, 5}, wire_vertices[] = {0, 5, 5, 6, 0}, points[] = {5, 6, 5};
    static const mt_edge_value creases[] = {{0, 1, 2.5}, {6, 5, 10}};
    static const mt_vertex_value sharp[] = {{4, 3}};
    mesh->wire_offsets = copy_of(context, wire_offsets, sizeof wire_offsets);
    mesh->wire_vertices = copy_of(context, wire_vertices, sizeof wire_vertices);
    mesh->point_vertices = copy_of(context, points, sizeof points);
    mesh->creases = copy_of(context, creases, sizeof creases);
    mesh->sharp_vertices = copy_of(context, sharp, sizeof sharp);
    mesh->material_libraries = mt_allocate_zeroed(context, sizeof *mesh->material_libraries);
    if (!mesh->wire_offsets || !mesh->wire_vertices || !mesh->point_vertices || !mesh->creases ||
        !mesh->sharp_vertices || !mesh->material_libraries) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mesh->wire_count = 2;
    mesh->point_count = 3;
    mesh->crease_count = 2;
    mesh->sharp_vertex_count = 1;
    mesh->material_library_count = 1;
    mesh->material_libraries[0] = mt_duplicate_string(context, "colors.mtl");
    mesh->up = MT_UP_Z;
    mesh->welded = true;
    return mesh->material_libraries[0] ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

mt_status test_laden_mesh(mt_context *context, mt_mesh **out)
{
    mt_status status = make_frame(context, out);
    if (status == MT_OK) {
        status = add_attributes(context, *out);
    }
    if (status == MT_OK) {
        status = add_label_sets(context, *out);
    }
    if (status == MT_OK) {
        status = add_elements(context, *out);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}
