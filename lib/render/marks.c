#include "lib/render/marks.h"

#include <meshtool/checked.h>
#include <meshtool/edge_pairs.h>

#include <string.h>

static const unsigned char orange[3] = {250, 140, 13}, red[3] = {219, 26, 41}, dark[3] = {30, 36, 46};

/* One mark in the color that `colors` holds at `color`, or in the usual one. */
static void append(mt_marks *marks, mt_stroke stroke, const unsigned char *colors, size_t color,
                   const unsigned char usual[3])
{
    memcpy(marks->colors + 3 * (size_t)marks->count, colors ? colors + 3 * color : usual, 3);
    marks->strokes[marks->count++] = stroke;
}

/* Each edge once, in the order of their lowest corners; edges with a vertex that is not finite are not seen. */
static void append_wires(const mt_model *model, const mt_edge_pairs *pairs, mt_marks *marks)
{
    const mt_mesh *mesh = model->mesh;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index first = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = first; corner < end; corner++) {
            mt_index a = mesh->corner_vertices[corner];
            mt_index b = mesh->corner_vertices[corner + 1 < end ? corner + 1 : first];
            if (mt_edge_is_first(pairs, corner)) {
                append(marks, (mt_stroke){a, b}, NULL, 0, dark);
            }
        }
    }
}

static void append_given(const mt_model *model, const mt_preview_options *options, mt_marks *marks)
{
    mt_index vertex_count = options->vertex_marks ? model->mesh->vertex_count : 0;
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        if (options->vertex_marks[vertex]) {
            append(marks, (mt_stroke){vertex, vertex}, options->vertex_mark_colors, vertex, orange);
        }
    }
    for (size_t i = 0; i < options->edge_mark_count; i++) {
        mt_stroke edge = {options->edge_marks[2 * i], options->edge_marks[2 * i + 1]};
        append(marks, edge, options->edge_mark_colors, i, red);
    }
}

static uint64_t count_given(const mt_model *model, const mt_preview_options *options)
{
    uint64_t count = options->edge_mark_count;
    for (mt_index vertex = 0; options->vertex_marks && vertex < model->mesh->vertex_count; vertex++) {
        count += options->vertex_marks[vertex] != 0;
    }
    return count;
}

static mt_status collect(mt_context *context, const mt_model *model, const mt_preview_options *options,
                         const mt_edge_pairs *pairs, mt_marks *marks)
{
    uint64_t count = count_given(model, options) + (pairs ? pairs->edge_count : 0);
    if (count > MT_INDEX_MAX / 2) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu marks are too many for one picture",
                       (unsigned long long)count);
    }
    marks->strokes = (mt_stroke *)mt_allocate_array(context, count, sizeof *marks->strokes);
    marks->colors = (unsigned char *)mt_allocate_array(context, count, 3);
    if (!marks->strokes || !marks->colors) {
        return mt_context_error(context)->status;
    }
    append_given(model, options, marks);
    marks->wire_first = marks->count;
    if (pairs) {
        append_wires(model, pairs, marks);
    }
    return MT_OK;
}

mt_status mt_marks_init(mt_context *context, const mt_model *model, const mt_preview_options *options, mt_marks *marks)
{
    memset(marks, 0, sizeof *marks);
    mt_edge_pairs *pairs = NULL;
    mt_status status = MT_OK;
    if (options->wireframe) {
        int part = mt_part_begin(context, "edges", "each drawn once for the wireframe");
        status = mt_edge_pairs_create(context, model->mesh, &pairs);
        mt_part_end(context, part);
    }
    if (status == MT_OK) {
        status = collect(context, model, options, pairs, marks);
    }
    mt_edge_pairs_destroy(context, pairs);
    return status;
}

void mt_marks_release(mt_context *context, mt_marks *marks)
{
    mt_free(context, marks->strokes);
    mt_free(context, marks->colors);
    memset(marks, 0, sizeof *marks);
}
