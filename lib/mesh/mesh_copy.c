#include <meshtool/mesh.h>

#include <string.h>

static void *copy_block(mt_context *context, const void *block, uint64_t count, size_t size, bool *complete)
{
    if (!block) {
        return NULL;
    }
    void *copy = mt_allocate_array(context, count, size);
    if (copy) {
        memcpy(copy, block, (size_t)(count * size));
    } else {
        *complete = false;
    }
    return copy;
}

static char **copy_strings(mt_context *context, char *const *strings, mt_index count, uint64_t room, bool *complete)
{
    if (!strings) {
        return NULL;
    }
    char **copy = mt_allocate_array_zeroed(context, room, sizeof *copy);
    if (!copy) {
        *complete = false;
        return NULL;
    }
    for (mt_index i = 0; i < count; i++) {
        copy[i] = mt_duplicate_string(context, strings[i]);
        *complete = *complete && copy[i];
    }
    return copy;
}

static void copy_attribute(mt_context *context, const mt_mesh *mesh, const mt_attribute *source, mt_attribute *copy,
                           bool *complete)
{
    size_t size = source->component_count * mt_type_size(source->type);
    *copy = *source;
    copy->name = copy_block(context, source->name, strlen(source->name) + 1, 1, complete);
    copy->values = copy_block(context, source->values, source->value_count, size, complete);
    copy->indices =
        copy_block(context, source->indices, mt_mesh_domain_count(mesh, source->domain), sizeof(mt_index), complete);
}

/* mt_labels_add_name doubles the room at each power of two, and counts on it in copies too. */
static uint64_t name_room(mt_index count)
{
    uint64_t room = 1;
    while (room < count) {
        room *= 2;
    }
    return room;
}

static void copy_labels(mt_context *context, const mt_mesh *mesh, const mt_labels *source, mt_labels *copy,
                        bool *complete)
{
    copy->kind = source->kind;
    copy->names = copy_strings(context, source->names, source->name_count, name_room(source->name_count), complete);
    copy->name_count = copy->names ? source->name_count : 0;
    copy->face_labels = copy_block(context, source->face_labels, mesh->face_count, sizeof(mt_index), complete);
}

static void copy_tables(mt_context *context, const mt_mesh *mesh, mt_mesh *copy, bool *complete)
{
    copy->attributes = mt_allocate_array_zeroed(context, mesh->attribute_count, sizeof *copy->attributes);
    copy->label_sets = mt_allocate_array_zeroed(context, mesh->label_set_count, sizeof *copy->label_sets);
    if (!copy->attributes || !copy->label_sets) {
        *complete = false;
        return;
    }
    for (; copy->attribute_count < mesh->attribute_count; copy->attribute_count++) {
        mt_index i = copy->attribute_count;
        copy_attribute(context, mesh, &mesh->attributes[i], &copy->attributes[i], complete);
    }
    for (; copy->label_set_count < mesh->label_set_count; copy->label_set_count++) {
        mt_index i = copy->label_set_count;
        copy_labels(context, mesh, &mesh->label_sets[i], &copy->label_sets[i], complete);
    }
}

static void copy_elements(mt_context *context, const mt_mesh *mesh, mt_mesh *copy, bool *complete)
{
    mt_index wire_size = mesh->wire_offsets ? mesh->wire_offsets[mesh->wire_count] : 0;
    copy->positions =
        copy_block(context, mesh->positions, mesh->vertex_count, 3 * mt_type_size(mesh->position_type), complete);
    copy->face_offsets =
        copy_block(context, mesh->face_offsets, (uint64_t)mesh->face_count + 1, sizeof(mt_index), complete);
    copy->corner_vertices = copy_block(context, mesh->corner_vertices, mesh->corner_count, sizeof(mt_index), complete);
    copy->wire_offsets =
        copy_block(context, mesh->wire_offsets, (uint64_t)mesh->wire_count + 1, sizeof(mt_index), complete);
    copy->wire_vertices = copy_block(context, mesh->wire_vertices, wire_size, sizeof(mt_index), complete);
    copy->point_vertices = copy_block(context, mesh->point_vertices, mesh->point_count, sizeof(mt_index), complete);
    copy->creases = copy_block(context, mesh->creases, mesh->crease_count, sizeof *mesh->creases, complete);
    copy->sharp_vertices =
        copy_block(context, mesh->sharp_vertices, mesh->sharp_vertex_count, sizeof *mesh->sharp_vertices, complete);
    copy->material_libraries = copy_strings(context, mesh->material_libraries, mesh->material_library_count,
                                            mesh->material_library_count, complete);
}

mt_status mt_mesh_copy(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_mesh *copy = mt_allocate(context, sizeof *copy);
    if (!copy) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    bool complete = true;
    *copy = *mesh;
    copy->attribute_count = 0;
    copy->label_set_count = 0;
    copy_elements(context, mesh, copy, &complete);
    copy_tables(context, mesh, copy, &complete);
    if (!complete) {
        mt_mesh_destroy(context, copy);
        return mt_context_error(context)->status;
    }
    *out = copy;
    return MT_OK;
}
