#include <meshtool/mesh.h>

#include <meshtool/checked.h>

#include <assert.h>
#include <string.h>

static mt_status check_counts(mt_context *context, const mt_mesh_layout *layout, uint64_t *corner_count)
{
    *corner_count = layout->corner_count;
    if (layout->face_size && !mt_checked_multiply(layout->face_count, layout->face_size, corner_count)) {
        *corner_count = UINT64_MAX;
    }
    const struct {
        const char *what;
        uint64_t count;
    } counts[] = {{"vertices", layout->vertex_count}, {"faces", layout->face_count}, {"corners", *corner_count}};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        if (!mt_count_fits(counts[i].count)) {
            return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu %s are more than the %u that a mesh can hold",
                           (unsigned long long)counts[i].count, counts[i].what, MT_INDEX_MAX);
        }
    }
    return MT_OK;
}

static bool allocate_elements(mt_context *context, mt_mesh *mesh)
{
    mesh->positions = mt_allocate_array(context, mesh->vertex_count, 3 * mt_type_size(mesh->position_type));
    mesh->corner_vertices = mt_allocate_array(context, mesh->corner_count, sizeof(mt_index));
    if (!mesh->face_size) {
        mesh->face_offsets = mt_allocate_array(context, (uint64_t)mesh->face_count + 1, sizeof(mt_index));
        if (mesh->face_offsets) {
            mesh->face_offsets[0] = 0;
        }
    }
    return mesh->positions && mesh->corner_vertices && (mesh->face_size || mesh->face_offsets);
}

mt_status mt_mesh_create(mt_context *context, const mt_mesh_layout *layout, mt_mesh **out)
{
    assert(layout->position_type == MT_F32 || layout->position_type == MT_F64);
    *out = NULL;
    uint64_t corner_count;
    mt_status status = check_counts(context, layout, &corner_count);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = mt_allocate_zeroed(context, sizeof *mesh);
    if (!mesh) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mesh->vertex_count = (mt_index)layout->vertex_count;
    mesh->face_count = (mt_index)layout->face_count;
    mesh->corner_count = (mt_index)corner_count;
    mesh->face_size = layout->face_size;
    mesh->position_type = layout->position_type;
    if (!allocate_elements(context, mesh)) {
        mt_mesh_destroy(context, mesh);
        return mt_context_error(context)->status;
    }
    *out = mesh;
    return MT_OK;
}

static void free_strings(mt_context *context, char **strings, mt_index count)
{
    for (mt_index i = 0; strings && i < count; i++) {
        mt_free(context, strings[i]);
    }
    mt_free(context, strings);
}

static void release_attribute(mt_context *context, mt_attribute *attribute)
{
    mt_free(context, attribute->name);
    mt_free(context, attribute->values);
    mt_free(context, attribute->indices);
}

static void release_labels(mt_context *context, mt_labels *labels)
{
    free_strings(context, labels->names, labels->name_count);
    mt_free(context, labels->face_labels);
}

void mt_mesh_destroy(mt_context *context, mt_mesh *mesh)
{
    if (!mesh) {
        return;
    }
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        release_attribute(context, &mesh->attributes[i]);
    }
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        release_labels(context, &mesh->label_sets[i]);
    }
    free_strings(context, mesh->material_libraries, mesh->material_library_count);
    void *blocks[] = {mesh->positions,     mesh->face_offsets,   mesh->corner_vertices, mesh->wire_offsets,
                      mesh->wire_vertices, mesh->point_vertices, mesh->attributes,      mesh->label_sets,
                      mesh->creases,       mesh->sharp_vertices};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        mt_free(context, blocks[i]);
    }
    mt_free(context, mesh);
}

mt_index mt_mesh_domain_count(const mt_mesh *mesh, mt_domain domain)
{
    const mt_index counts[] = {1, mesh->vertex_count, mesh->corner_count, mesh->face_count};
    return counts[domain];
}

mt_index mt_mesh_corner_face(const mt_mesh *mesh, mt_index corner)
{
    if (!mesh->face_offsets) {
        return corner / mesh->face_size;
    }
    mt_index low = 0, high = mesh->face_count; /* offsets[low] <= corner < offsets[high] */
    while (high - low > 1) {
        mt_index middle = low + (high - low) / 2;
        if (mesh->face_offsets[middle] <= corner) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

/* Grows an array of records by one zeroed record and returns it. */
static void *append_record(mt_context *context, void **records, mt_index *count, size_t size)
{
    void *grown = mt_reallocate(context, *records, ((uint64_t)*count + 1) * size);
    if (!grown) {
        return NULL;
    }
    *records = grown;
    void *record = (char *)grown + (size_t)*count * size;
    memset(record, 0, size);
    *count += 1;
    return record;
}

static mt_status fill_attribute(mt_context *context, mt_attribute *attribute, const mt_attribute_layout *layout,
                                mt_index domain_count)
{
    attribute->semantic = layout->semantic;
    attribute->domain = layout->domain;
    attribute->type = layout->type;
    attribute->component_count = layout->component_count;
    attribute->value_count = (mt_index)layout->value_count;
    attribute->name = mt_duplicate_string(context, layout->name ? layout->name : "");
    attribute->values =
        mt_allocate_array(context, layout->value_count, layout->component_count * mt_type_size(layout->type));
    if (layout->indexed) {
        attribute->indices = mt_allocate_array(context, domain_count, sizeof(mt_index));
    }
    bool complete = attribute->name && attribute->values && (!layout->indexed || attribute->indices);
    return complete ? MT_OK : mt_context_error(context)->status;
}

mt_status mt_mesh_add_attribute(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout,
                                mt_attribute **out)
{
    mt_index domain_count = mt_mesh_domain_count(mesh, layout->domain);
    assert(layout->component_count > 0 && layout->component_count <= 1024);
    assert(layout->indexed || layout->value_count == domain_count);
    *out = NULL;
    if (!mt_count_fits(layout->value_count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu attribute values are more than a mesh can hold",
                       (unsigned long long)layout->value_count);
    }
    mt_attribute *attribute =
        append_record(context, (void **)&mesh->attributes, &mesh->attribute_count, sizeof *attribute);
    if (!attribute) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_status status = fill_attribute(context, attribute, layout, domain_count);
    if (status != MT_OK) {
        mt_mesh_remove_attribute(context, mesh, mesh->attribute_count - 1);
        return status;
    }
    *out = attribute;
    return MT_OK;
}

void mt_mesh_remove_attribute(mt_context *context, mt_mesh *mesh, mt_index which)
{
    release_attribute(context, &mesh->attributes[which]);
    mesh->attribute_count--;
    memmove(&mesh->attributes[which], &mesh->attributes[which + 1],
            (mesh->attribute_count - which) * sizeof *mesh->attributes);
}

mt_attribute *mt_mesh_find_attribute(const mt_mesh *mesh, mt_semantic semantic, mt_domain domain)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (mesh->attributes[i].semantic == semantic && mesh->attributes[i].domain == domain) {
            return &mesh->attributes[i];
        }
    }
    return NULL;
}

mt_status mt_mesh_add_labels(mt_context *context, mt_mesh *mesh, mt_label_kind kind, mt_labels **out)
{
    *out = NULL;
    mt_index *face_labels = mt_allocate_array(context, mesh->face_count, sizeof *face_labels);
    if (!face_labels) {
        return mt_context_error(context)->status;
    }
    mt_labels *labels = append_record(context, (void **)&mesh->label_sets, &mesh->label_set_count, sizeof *labels);
    if (!labels) {
        mt_free(context, face_labels);
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(face_labels, 0xff, (size_t)mesh->face_count * sizeof *face_labels); /* MT_NONE */
    labels->kind = kind;
    labels->face_labels = face_labels;
    *out = labels;
    return MT_OK;
}

mt_labels *mt_mesh_find_labels(const mt_mesh *mesh, mt_label_kind kind)
{
    for (mt_index i = 0; i < mesh->label_set_count; i++) {
        if (mesh->label_sets[i].kind == kind) {
            return &mesh->label_sets[i];
        }
    }
    return NULL;
}

mt_status mt_labels_add_name(mt_context *context, mt_labels *labels, const char *name, mt_index *out)
{
    char *copy = mt_duplicate_string(context, name);
    if (!copy) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_index number = labels->name_count;
    bool full = (number & (number - 1)) == 0; /* room doubles at each power of two */
    if (full) {
        uint64_t room = number ? 2 * (uint64_t)number : 1;
        char **grown = mt_reallocate(context, labels->names, room * sizeof *grown);
        if (!grown) {
            mt_free(context, copy);
            return MT_ERROR_OUT_OF_MEMORY;
        }
        labels->names = grown;
    }
    labels->names[number] = copy;
    labels->name_count = number + 1;
    *out = number;
    return MT_OK;
}

const char *mt_label_kind_name(mt_label_kind kind)
{
    static const char *const names[] = {"group", "object", "material", "smoothing", "solid", "part"};
    return names[kind];
}
