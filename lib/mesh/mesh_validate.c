#include <meshtool/mesh.h>

/* An ascending offset array from 0 to `total`, with at least `least` elements each. */
static mt_status check_offsets(mt_context *context, const char *what, const mt_index *offsets, mt_index count,
                               mt_index total, mt_index least)
{
    if (offsets[0] != 0 || offsets[count] != total) {
        return mt_fail(context, MT_ERROR_INTERNAL, "%s offsets run from %u to %u and not from 0 to %u", what,
                       offsets[0], offsets[count], total);
    }
    for (mt_index i = 0; i < count; i++) {
        if (offsets[i + 1] < offsets[i] || offsets[i + 1] - offsets[i] < least) {
            return mt_fail(context, MT_ERROR_INTERNAL, "%s %u has fewer than %u vertices", what, i, least);
        }
    }
    return MT_OK;
}

static mt_status check_indices(mt_context *context, const char *what, const mt_index *indices, mt_index count,
                               mt_index limit, bool none_allowed)
{
    for (mt_index i = 0; i < count; i++) {
        if (indices[i] >= limit && !(none_allowed && indices[i] == MT_NONE)) {
            return mt_fail(context, MT_ERROR_INTERNAL, "%s %u has the index %u, past the count %u", what, i, indices[i],
                           limit);
        }
    }
    return MT_OK;
}

static mt_status check_faces(mt_context *context, const mt_mesh *mesh)
{
    if (mesh->face_offsets) {
        mt_status status = check_offsets(context, "face", mesh->face_offsets, mesh->face_count, mesh->corner_count, 3);
        if (status != MT_OK) {
            return status;
        }
    } else if (mesh->face_size < 3 || (uint64_t)mesh->face_size * mesh->face_count != mesh->corner_count) {
        return mt_fail(context, MT_ERROR_INTERNAL, "%u faces of %u sides do not make %u corners", mesh->face_count,
                       mesh->face_size, mesh->corner_count);
    }
    return check_indices(context, "corner", mesh->corner_vertices, mesh->corner_count, mesh->vertex_count, false);
}

static mt_status check_wires_and_points(mt_context *context, const mt_mesh *mesh)
{
    if (mesh->wire_count) {
        mt_index size = mesh->wire_offsets[mesh->wire_count];
        mt_status status = check_offsets(context, "wire", mesh->wire_offsets, mesh->wire_count, size, 2);
        if (status == MT_OK) {
            status = check_indices(context, "wire vertex", mesh->wire_vertices, size, mesh->vertex_count, false);
        }
        if (status != MT_OK) {
            return status;
        }
    }
    return check_indices(context, "point", mesh->point_vertices, mesh->point_count, mesh->vertex_count, false);
}

static mt_status check_attributes(mt_context *context, const mt_mesh *mesh)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        const mt_attribute *attribute = &mesh->attributes[i];
        mt_index count = mt_mesh_domain_count(mesh, attribute->domain);
        if (!attribute->name || !attribute->values) {
            return mt_fail(context, MT_ERROR_INTERNAL, "attribute %u has no name or no values", i);
        }
        if (!attribute->indices && attribute->value_count != count) {
            return mt_fail(context, MT_ERROR_INTERNAL, "attribute %u has %u values for %u elements", i,
                           attribute->value_count, count);
        }
        if (attribute->indices &&
            check_indices(context, attribute->name, attribute->indices, count, attribute->value_count, true) != MT_OK) {
            return MT_ERROR_INTERNAL;
        }
    }
    return MT_OK;
}

static mt_status check_labels(mt_context *context, const mt_mesh *mesh)
{
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        const mt_labels *labels = &mesh->label_sets[i];
        if (check_indices(context, mt_label_kind_name(labels->kind), labels->face_labels, mesh->face_count,
                          labels->name_count, true) != MT_OK) {
            return MT_ERROR_INTERNAL;
        }
    }
    return MT_OK;
}

static mt_status check_sharpness(mt_context *context, const mt_mesh *mesh)
{
    for (mt_index i = 0; i < mesh->crease_count; i++) {
        const mt_edge_value *crease = &mesh->creases[i];
        if (crease->a >= mesh->vertex_count || crease->b >= mesh->vertex_count) {
            return mt_fail(context, MT_ERROR_INTERNAL, "crease %u names a vertex past the count", i);
        }
    }
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        if (mesh->sharp_vertices[i].vertex >= mesh->vertex_count) {
            return mt_fail(context, MT_ERROR_INTERNAL, "sharp vertex %u is past the count", i);
        }
    }
    return MT_OK;
}

mt_status mt_mesh_validate(mt_context *context, const mt_mesh *mesh)
{
    mt_status (*const checks[])(mt_context *, const mt_mesh *) = {check_faces, check_wires_and_points, check_attributes,
                                                                  check_labels, check_sharpness};
    for (size_t i = 0; i < sizeof checks / sizeof *checks; i++) {
        mt_status status = checks[i](context, mesh);
        if (status != MT_OK) {
            return status;
        }
    }
    return MT_OK;
}
