#include "lib/algorithms/subdivide_count.h"

#include "lib/algorithms/subdivide_field.h"

#include <meshtool/checked.h>

#define SIZE_CLAMP ((uint64_t)1 << 62)

static uint64_t clamp(uint64_t count)
{
    return count < SIZE_CLAMP ? count : SIZE_CLAMP;
}

mt_subdivide_size mt_subdivide_size_at(mt_subdivide_size size, unsigned level)
{
    for (unsigned i = 0; i < level; i++) {
        uint64_t vertices = clamp(clamp(size.vertices + size.faces) + size.edges);
        uint64_t edges = clamp(clamp(2 * size.edges) + size.corners);
        size.faces = size.corners;
        size.corners = size.corners >= SIZE_CLAMP / 4 ? SIZE_CLAMP : 4 * size.corners;
        size.vertices = vertices;
        size.edges = edges;
    }
    return size;
}

mt_status mt_subdivide_check_size(mt_context *context, const mt_subdivide_size *size, unsigned level)
{
    if (mt_count_fits(size->vertices) && mt_count_fits(size->corners) && mt_count_fits(size->edges)) {
        return MT_OK;
    }
    return mt_fail(
        context, MT_ERROR_TOO_LARGE,
        "level %u would have %llu vertices and %llu faces with %llu corners, more than the %u of a kind that "
        "a mesh can hold: ask for fewer levels",
        level, (unsigned long long)size->vertices, (unsigned long long)size->faces, (unsigned long long)size->corners,
        MT_INDEX_MAX);
}

/* Values of an attribute at a level: those of a field grow like vertices. */
static uint64_t value_count(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_attribute *attribute,
                            unsigned level, const mt_subdivide_size *size)
{
    const uint64_t domain_counts[] = {1, size->vertices, size->corners, size->faces};
    if (level == 0 || mt_subdivide_carriage_of(attribute) != MT_SUBDIVIDE_CARRY_FIELD) {
        return attribute->indices || level == 0 ? attribute->value_count : domain_counts[attribute->domain];
    }
    if (attribute->domain == MT_DOMAIN_VERTEX) {
        return size->vertices;
    }
    mt_subdivide_size values = {.vertices = attribute->value_count,
                                .faces = mesh->face_count,
                                .corners = mesh->corner_count,
                                .edges = mesh->corner_count};
    if (attribute->indices) {
        values.edges = (uint64_t)pairs->edge_count + mt_subdivide_seam_count(mesh, pairs, attribute);
    }
    return mt_subdivide_size_at(values, level).vertices;
}

static bool has_indices(const mt_attribute *attribute, unsigned level)
{
    bool field = level && mt_subdivide_carriage_of(attribute) == MT_SUBDIVIDE_CARRY_FIELD;
    return field ? attribute->domain == MT_DOMAIN_CORNER : attribute->indices != NULL;
}

static uint64_t bytes_of(uint64_t count, uint64_t size)
{
    uint64_t bytes;
    return mt_checked_multiply(count, size, &bytes) ? clamp(bytes) : SIZE_CLAMP;
}

static uint64_t attribute_bytes(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_attribute *attribute,
                                unsigned level, const mt_subdivide_size *size)
{
    const uint64_t domain_counts[] = {1, size->vertices, size->corners, size->faces};
    uint64_t bytes = bytes_of(value_count(mesh, pairs, attribute, level, size),
                              attribute->component_count * mt_type_size(attribute->type));
    uint64_t indices = has_indices(attribute, level) ? domain_counts[attribute->domain] : 0;
    return clamp(bytes + bytes_of(indices, sizeof(mt_index)));
}

mt_status mt_subdivide_count(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, unsigned level,
                             mt_subdivide_counts *out)
{
    mt_subdivide_size size = {mesh->vertex_count, mesh->face_count, mesh->corner_count, pairs->edge_count};
    size = mt_subdivide_size_at(size, level);
    uint64_t bytes = clamp(bytes_of(size.vertices, 3 * mt_type_size(mesh->position_type)) +
                           bytes_of(size.corners, sizeof(mt_index)));
    if (level == 0 && mesh->face_offsets) {
        bytes += bytes_of(size.faces + 1, sizeof(mt_index));
    }
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        bytes = clamp(bytes + attribute_bytes(mesh, pairs, &mesh->attributes[i], level, &size));
    }
    bytes = clamp(bytes + bytes_of(bytes_of(size.faces, sizeof(mt_index)), mesh->label_set_count));
    *out = (mt_subdivide_counts){size.vertices, size.faces, size.corners, size.edges, bytes};
    return mt_subdivide_check_size(context, &size, level);
}
