/* Wires, points, sharpness, names and warnings of an OBJ file. */
#include "formats/mesh/name_table.h"
#include "formats/mesh/obj_merge.h"

#include <meshtool/checked.h>

#define WARNING_ROOM 32 /* things that are warned of by name; later ones go unsaid */

static uint64_t total_of(const mt_obj_reader *reader, mt_obj_series series)
{
    uint64_t total = 0;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        total += reader->blocks[i].counts[series];
    }
    return total;
}

/* All blocks' items of one array, one after the other; NULL with the error recorded when memory is missing. */
static void *join(mt_context *context, mt_obj_reader *reader, mt_obj_series series)
{
    size_t size = mt_obj_item_size(series), done = 0;
    char *items = mt_allocate_array(context, total_of(reader, series), size);
    for (uint64_t i = 0; items && i < reader->block_count; i++) {
        size_t part = reader->blocks[i].counts[series] * size;
        if (part > 0) {
            memcpy(items + done, reader->blocks[i].items[series], part);
        }
        done += part;
    }
    mt_obj_release_series(context, reader, series);
    return items;
}

/* As join, straight into the mesh, and nothing at all where there are no items. */
static mt_status join_into(mt_context *context, mt_obj_reader *reader, mt_obj_series series, void **items,
                           mt_index *count)
{
    uint64_t total = total_of(reader, series);
    if (total == 0) {
        return MT_OK;
    }
    if (!mt_count_fits(total)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu elements of one kind are more than an index can name",
                       (unsigned long long)total);
    }
    *items = join(context, reader, series);
    *count = *items ? (mt_index)total : 0;
    return *items ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status merge_wires(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    void *vertices = NULL, *sides = NULL;
    mt_index vertex_count = 0, wire_count = 0;
    mt_status status = join_into(context, reader, MT_OBJ_WIRE_VERTICES, &vertices, &vertex_count);
    mesh->wire_vertices = vertices;
    if (status == MT_OK) {
        status = join_into(context, reader, MT_OBJ_WIRE_SIDES, &sides, &wire_count);
    }
    if (status != MT_OK || wire_count == 0) {
        return status;
    }
    mesh->wire_offsets = mt_allocate_array(context, (uint64_t)wire_count + 1, sizeof(mt_index));
    if (mesh->wire_offsets) {
        mesh->wire_count = wire_count;
        mesh->wire_offsets[0] = 0;
        for (mt_index wire = 0; wire < wire_count; wire++) {
            mesh->wire_offsets[wire + 1] = mesh->wire_offsets[wire] + ((mt_index *)sides)[wire];
        }
    }
    mt_free(context, sides);
    return mesh->wire_offsets ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

mt_status mt_obj_merge_elements(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    void *points = NULL, *creases = NULL, *sharp = NULL;
    mt_status status = merge_wires(context, reader, mesh);
    if (status == MT_OK) {
        status = join_into(context, reader, MT_OBJ_POINTS, &points, &mesh->point_count);
    }
    if (status == MT_OK) {
        status = join_into(context, reader, MT_OBJ_CREASES, &creases, &mesh->crease_count);
    }
    if (status == MT_OK) {
        status = join_into(context, reader, MT_OBJ_SHARP_VERTICES, &sharp, &mesh->sharp_vertex_count);
    }
    mesh->point_vertices = points;
    mesh->creases = creases;
    mesh->sharp_vertices = sharp;
    return status;
}

static const char *event_name(const mt_obj_block *block, const mt_obj_event *event)
{
    return (const char *)block->items[MT_OBJ_NAMES] + event->name;
}

static bool has_label(const mt_obj_reader *reader, int kind)
{
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_event *events = reader->blocks[i].items[MT_OBJ_EVENTS];
        for (size_t k = 0; k < reader->blocks[i].counts[MT_OBJ_EVENTS]; k++) {
            if (events[k].kind == kind && event_name(&reader->blocks[i], &events[k])[0]) {
                return true;
            }
        }
    }
    return false;
}

static void fill(mt_index *labels, mt_index begin, mt_index end, mt_index label)
{
    for (mt_index face = begin; face < end; face++) {
        labels[face] = label;
    }
}

/* Walks through the file: each name holds from its place to the next one's. */
static mt_status merge_labels(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh, int kind)
{
    mt_labels *labels;
    mt_name_table table = {0};
    mt_status status = mt_mesh_add_labels(context, mesh, (mt_label_kind)kind, &labels);
    mt_index since = 0, label = MT_NONE;
    for (uint64_t i = 0; status == MT_OK && i < reader->block_count; i++) {
        const mt_obj_block *block = &reader->blocks[i];
        const mt_obj_event *events = block->items[MT_OBJ_EVENTS];
        for (size_t k = 0; status == MT_OK && k < block->counts[MT_OBJ_EVENTS]; k++) {
            if (events[k].kind != kind) {
                continue;
            }
            mt_index face = reader->first_faces[i] + events[k].face;
            const char *name = event_name(block, &events[k]);
            fill(labels->face_labels, since, face, label);
            since = face;
            label = MT_NONE;
            if (name[0]) {
                status = mt_name_table_find_or_add(context, &table, labels, name, &label);
            }
        }
    }
    if (status == MT_OK) {
        fill(labels->face_labels, since, mesh->face_count, label);
    }
    mt_name_table_release(context, &table);
    return status;
}

/* The libraries' names, each once, gathered as the names of a label set are. */
static mt_status merge_libraries(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_labels names = {0};
    mt_name_table table = {0};
    mt_status status = MT_OK;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_block *block = &reader->blocks[i];
        const mt_obj_event *events = block->items[MT_OBJ_EVENTS];
        for (size_t k = 0; status == MT_OK && k < block->counts[MT_OBJ_EVENTS]; k++) {
            if (events[k].kind == MT_OBJ_LIBRARY) {
                mt_index number;
                status = mt_name_table_find_or_add(context, &table, &names, event_name(block, &events[k]), &number);
            }
        }
    }
    mesh->material_libraries = names.names;
    mesh->material_library_count = names.name_count;
    mt_name_table_release(context, &table);
    return status;
}

mt_status mt_obj_merge_names(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh)
{
    mt_status status = merge_libraries(context, reader, mesh);
    for (int kind = MT_LABEL_GROUP; status == MT_OK && kind <= MT_LABEL_SMOOTHING; kind++) {
        if (has_label(reader, MT_OBJ_LABEL + kind)) {
            status = merge_labels(context, reader, mesh, kind);
        }
    }
    return status;
}

static void warn_of(mt_context *context, const mt_obj_reader *reader, const mt_obj_event *event, const char *name)
{
    mt_place place = mt_text_place(context, reader->text, event->offset);
    unsigned long long line = (unsigned long long)place.line;
    if (event->kind == MT_OBJ_LIBRARY) {
        mt_warn(context, "%s:%llu: the material library \"%s\" is kept by name and not opened", place.file, line, name);
    } else if (event->kind == MT_OBJ_UNKNOWN_KEYWORD) {
        mt_warn(context, "%s:%llu: the keyword \"%s\" is not known; its lines are left out", place.file, line, name);
    } else {
        mt_warn(context, "%s:%llu: the tag \"%s\" is not known and left out", place.file, line, name);
    }
}

typedef struct warning_list {
    size_t count;
    int kinds[WARNING_ROOM];
    const char *names[WARNING_ROOM];
} warning_list;

/* Whether the event is the first of its kind and name, which it then is no more. */
static bool is_news(warning_list *list, int kind, const char *name)
{
    for (size_t i = 0; i < list->count; i++) {
        if (list->kinds[i] == kind && strcmp(list->names[i], name) == 0) {
            return false;
        }
    }
    if (list->count == WARNING_ROOM) {
        return false;
    }
    list->kinds[list->count] = kind;
    list->names[list->count++] = name;
    return true;
}

void mt_obj_warn(mt_context *context, const mt_obj_reader *reader)
{
    warning_list list = {0};
    uint64_t weights = 0, wire_uvs = 0;
    for (uint64_t i = 0; i < reader->block_count; i++) {
        const mt_obj_block *block = &reader->blocks[i];
        const mt_obj_event *events = block->items[MT_OBJ_EVENTS];
        weights += block->weight_count;
        wire_uvs += block->wire_uv_count;
        for (size_t k = 0; k < block->counts[MT_OBJ_EVENTS]; k++) {
            const char *name = event_name(block, &events[k]);
            if (events[k].kind >= MT_OBJ_LIBRARY && is_news(&list, events[k].kind, name)) {
                warn_of(context, reader, &events[k], name);
            }
        }
    }
    if (wire_uvs > 0) {
        mt_warn(context, "%s: wires name %llu texture vertices, which are left out", mt_text_name(reader->text),
                (unsigned long long)wire_uvs);
    }
    if (weights > 0) {
        mt_warn(context, "%s: %llu vertices have a weight (a fourth number that is not 1), which is left out",
                mt_text_name(reader->text), (unsigned long long)weights);
    }
}
