/* Sharpness follows its edge: to both halves of one that is split, to the merged one of a collapse, which keeps the
 * larger. Cost: O(creases + log) time, 48 bytes an edge that ever has a value. */
#include "lib/topology/surgery_creases.h"
#include "lib/topology/pair_table.h"

#include <math.h>

typedef struct crease_list {
    mt_index count;
    mt_edge_value *creases; /* value NAN: none any more */
    mt_pair_table places;
} crease_list;

static mt_index *find_place(const crease_list *list, mt_index a, mt_index b)
{
    return mt_pair_table_find(&list->places, a < b ? a : b, a < b ? b : a);
}

/* The edge gets the larger of its value and this one; fmax takes the other one for a NAN. */
static void raise(crease_list *list, mt_index a, mt_index b, double value)
{
    mt_index place = *mt_pair_table_add(&list->places, a < b ? a : b, a < b ? b : a, list->count);
    if (place == list->count) {
        list->creases[list->count++] = (mt_edge_value){a, b, value};
    } else {
        list->creases[place].value = fmax(list->creases[place].value, value);
    }
}

static void follow(crease_list *list, const mt_edit *edit)
{
    if (edit->kind == MT_EDIT_EDGE) {
        const mt_index *from = find_place(list, edit->a, edit->a_vertex);
        if (from && !isnan(list->creases[*from].value)) {
            raise(list, edit->target, edit->target_vertex, list->creases[*from].value);
        }
    } else if (edit->kind == MT_EDIT_NO_EDGE) {
        const mt_index *place = find_place(list, edit->target, edit->target_vertex);
        if (place) {
            list->creases[*place].value = NAN;
        }
    }
}

static mt_status keep_creases(mt_context *context, crease_list *list, const mt_edit_reading *reading, mt_mesh *mesh)
{
    mesh->creases = mt_allocate_array(context, list->count, sizeof *mesh->creases);
    if (!mesh->creases) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < list->count; i++) {
        mt_edge_value crease = list->creases[i];
        crease.a = reading->vertex_numbers[crease.a];
        crease.b = reading->vertex_numbers[crease.b];
        if (!isnan(crease.value) && crease.a != MT_NONE && crease.b != MT_NONE) {
            mesh->creases[mesh->crease_count++] = crease;
        }
    }
    return MT_OK;
}

static mt_status follow_edges(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                              const mt_edit_reading *reading, mt_mesh *mesh)
{
    uint64_t most = source->crease_count;
    for (uint64_t i = 0; i < log->count; i++) {
        most += log->edits[i].kind == MT_EDIT_EDGE;
    }
    if (most > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "surgery makes more creases than an index can number");
    }
    crease_list list = {0};
    mt_status status = mt_pair_table_init(context, &list.places, most);
    list.creases = status == MT_OK ? mt_allocate_array(context, most, sizeof *list.creases) : NULL;
    if (list.creases) {
        for (mt_index i = 0; i < source->crease_count; i++) {
            raise(&list, source->creases[i].a, source->creases[i].b, source->creases[i].value);
        }
        for (uint64_t i = 0; i < log->count; i++) {
            follow(&list, &log->edits[i]);
        }
    }
    status = list.creases ? keep_creases(context, &list, reading, mesh) : mt_context_error(context)->status;
    mt_pair_table_release(context, &list.places);
    mt_free(context, list.creases);
    return status;
}

/* The values of the vertices of the source that ended in the same one: the largest. */
static mt_status follow_vertices(mt_context *context, const mt_mesh *source, const mt_edit_reading *reading,
                                 mt_mesh *mesh)
{
    mt_index *places = mt_allocate_array(context, reading->vertex_count, sizeof *places);
    mesh->sharp_vertices = mt_allocate_array(context, source->sharp_vertex_count, sizeof *mesh->sharp_vertices);
    if (!places || !mesh->sharp_vertices) {
        mt_free(context, places);
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < reading->vertex_count; i++) {
        places[i] = MT_NONE;
    }
    for (mt_index i = 0; i < source->sharp_vertex_count; i++) {
        mt_vertex_value sharp = source->sharp_vertices[i];
        sharp.vertex = reading->vertex_targets[sharp.vertex];
        if (places[sharp.vertex] == MT_NONE) {
            places[sharp.vertex] = mesh->sharp_vertex_count++;
            mesh->sharp_vertices[places[sharp.vertex]] = sharp;
        } else {
            double *value = &mesh->sharp_vertices[places[sharp.vertex]].value;
            *value = fmax(*value, sharp.value);
        }
    }
    mt_free(context, places);
    return MT_OK;
}

mt_status mt_surgery_creases(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                             const mt_edit_reading *reading, mt_mesh *mesh)
{
    mt_status status = MT_OK;
    if (source->crease_count) {
        status = follow_edges(context, source, log, reading, mesh);
    }
    if (status == MT_OK && source->sharp_vertex_count) {
        status = follow_vertices(context, source, reading, mesh);
    }
    return status;
}
