/* Reads the log once. A copy is no step: the new name takes the old one's slot. Corners have slots of their own only
 * where the log names them; others are found in the source. Cost: O(size + log) time, 16 bytes and more an entry. */
#include "lib/topology/edit_program.h"
#include "lib/topology/pair_table.h"

#include <string.h>

typedef struct reader {
    mt_context *context;
    const mt_mesh *source;
    const mt_edit_log *log;
    const mt_surgery_shape *shape;
    bool with_corners;
    mt_edit_reading *reading;
    mt_index *vertex_slots, *face_slots; /* by the numbers of the surgery */
    mt_pair_table corners;
} reader;

static mt_index corner_slot(const reader *at, mt_index face, mt_index vertex)
{
    const mt_index *found = mt_pair_table_find(&at->corners, face, vertex);
    if (found) {
        return *found;
    }
    if (face < at->source->face_count) {
        mt_index end = mt_mesh_face_end(at->source, face);
        for (mt_index c = mt_mesh_face_begin(at->source, face); c < end; c++) {
            if (at->source->corner_vertices[c] == vertex) {
                return c;
            }
        }
    }
    return MT_NONE;
}

static mt_index add_step(mt_edit_program *program, const mt_edit_step *step)
{
    program->steps[program->step_count] = *step;
    return program->element_count + program->step_count++;
}

static mt_index mix(mt_edit_program *program, mt_index a, mt_index b, double weight)
{
    if (a == b || weight <= 0) {
        return a;
    }
    if (weight >= 1) {
        return b;
    }
    return add_step(program, &(mt_edit_step){.kept = {a, MT_NONE}, .gone = {b, MT_NONE}, .weight = weight});
}

static mt_index read_wedge(reader *at, const mt_edit *edit)
{
    mt_index end = edit->a_vertex, own = corner_slot(at, edit->target, end);
    if (edit->weight <= 0 && end == edit->target_vertex) {
        return own; /* the vertex that stays does not move */
    }
    mt_edit_step step = {.is_wedge = true, .own = own, .weight = edit->weight};
    for (int i = 0; i < 2; i++) {
        mt_index face = i ? edit->b : edit->a;
        step.end[i] = corner_slot(at, face, end);
        step.kept[i] = corner_slot(at, face, edit->target_vertex);
        step.gone[i] = corner_slot(at, face, edit->b_vertex);
    }
    return add_step(&at->reading->corners, &step);
}

static void read_corner(reader *at, const mt_edit *edit)
{
    if (at->with_corners) {
        mt_index slot = edit->kind == MT_EDIT_WEDGE
                            ? read_wedge(at, edit)
                            : mix(&at->reading->corners, corner_slot(at, edit->a, edit->a_vertex),
                                  corner_slot(at, edit->b, edit->b_vertex), edit->weight);
        *mt_pair_table_add(&at->corners, edit->target, edit->target_vertex, slot) = slot;
    }
}

static void read_entries(reader *at)
{
    for (uint64_t i = 0; i < at->log->count; i++) {
        const mt_edit *edit = &at->log->edits[i];
        switch (edit->kind) {
        case MT_EDIT_VERTEX:
            at->vertex_slots[edit->target] =
                mix(&at->reading->vertices, at->vertex_slots[edit->a], at->vertex_slots[edit->b], edit->weight);
            break;
        case MT_EDIT_FACE:
            at->face_slots[edit->target] = at->face_slots[edit->a];
            break;
        case MT_EDIT_CORNER:
        case MT_EDIT_WEDGE:
            read_corner(at, edit);
            break;
        case MT_EDIT_MERGE:
        case MT_EDIT_EDGE:
        case MT_EDIT_NO_EDGE:
            break;
        }
    }
}

/* Room for what the entries can need at most. */
static mt_status make_room(reader *at)
{
    uint64_t vertex_steps = 0, corner_steps = 0;
    for (uint64_t i = 0; i < at->log->count; i++) {
        mt_edit_kind kind = at->log->edits[i].kind;
        vertex_steps += kind == MT_EDIT_VERTEX;
        corner_steps += at->with_corners && (kind == MT_EDIT_CORNER || kind == MT_EDIT_WEDGE);
    }
    mt_edit_reading *reading = at->reading;
    reading->vertices.element_count = at->source->vertex_count;
    reading->corners.element_count = at->source->corner_count;
    if (vertex_steps + at->source->vertex_count > MT_INDEX_MAX ||
        corner_steps + at->source->corner_count > MT_INDEX_MAX) {
        return mt_fail(at->context, MT_ERROR_TOO_LARGE, "surgery made more changes than an index can number");
    }
    reading->vertices.steps = mt_allocate_array(at->context, vertex_steps, sizeof *reading->vertices.steps);
    reading->corners.steps = mt_allocate_array(at->context, corner_steps, sizeof *reading->corners.steps);
    at->vertex_slots = mt_allocate_array(at->context, at->shape->vertex_count, sizeof *at->vertex_slots);
    at->face_slots = mt_allocate_array(at->context, at->shape->face_count, sizeof *at->face_slots);
    if (!reading->vertices.steps || !reading->corners.steps || !at->vertex_slots || !at->face_slots) {
        return mt_context_error(at->context)->status;
    }
    for (mt_index i = 0; i < at->shape->vertex_count; i++) {
        at->vertex_slots[i] = i < at->source->vertex_count ? i : MT_NONE;
    }
    for (mt_index i = 0; i < at->shape->face_count; i++) {
        at->face_slots[i] = i < at->source->face_count ? i : MT_NONE;
    }
    return mt_pair_table_init(at->context, &at->corners, corner_steps);
}

/* What a merged vertex went into may have been merged itself later: so the last merge is followed first. */
static void find_targets(const reader *at)
{
    mt_edit_reading *reading = at->reading;
    mt_index *numbers = reading->vertex_numbers;
    for (mt_index v = 0; v < at->shape->vertex_count; v++) {
        numbers[v] = at->shape->vertex_deleted[v] ? MT_NONE : reading->vertex_count++;
    }
    memcpy(reading->vertex_targets, numbers, at->shape->vertex_count * sizeof *numbers);
    for (uint64_t i = at->log->count; i-- > 0;) {
        const mt_edit *edit = &at->log->edits[i];
        if (edit->kind == MT_EDIT_MERGE) {
            reading->vertex_targets[edit->a] = reading->vertex_targets[edit->target];
        }
    }
}

static void gather_slots(const reader *at)
{
    mt_edit_reading *reading = at->reading;
    const mt_surgery_shape *shape = at->shape;
    for (mt_index v = 0; v < shape->vertex_count; v++) {
        if (reading->vertex_numbers[v] != MT_NONE) {
            reading->vertex_slots[reading->vertex_numbers[v]] = at->vertex_slots[v];
        }
    }
    for (mt_index face = 0; face < shape->face_count; face++) {
        if (shape->face_offsets[face] == shape->face_offsets[face + 1]) {
            continue;
        }
        reading->face_slots[reading->face_count++] = at->face_slots[face];
        for (mt_index c = shape->face_offsets[face]; c < shape->face_offsets[face + 1]; c++) {
            reading->corner_slots[c] = at->with_corners ? corner_slot(at, face, shape->corner_vertices[c]) : MT_NONE;
        }
    }
}

static mt_status number_elements(const reader *at)
{
    mt_edit_reading *reading = at->reading;
    const mt_surgery_shape *shape = at->shape;
    reading->corner_count = shape->face_offsets[shape->face_count];
    reading->vertex_numbers = mt_allocate_array(at->context, shape->vertex_count, sizeof(mt_index));
    reading->vertex_targets = mt_allocate_array(at->context, shape->vertex_count, sizeof(mt_index));
    reading->vertex_slots = mt_allocate_array(at->context, shape->vertex_count, sizeof(mt_index));
    reading->face_slots = mt_allocate_array(at->context, shape->face_count, sizeof(mt_index));
    reading->corner_slots = mt_allocate_array(at->context, reading->corner_count, sizeof(mt_index));
    if (!reading->vertex_numbers || !reading->vertex_targets || !reading->vertex_slots || !reading->face_slots ||
        !reading->corner_slots) {
        return mt_context_error(at->context)->status;
    }
    find_targets(at);
    gather_slots(at);
    return MT_OK;
}

mt_status mt_edit_read(mt_context *context, const mt_mesh *source, const mt_edit_log *log,
                       const mt_surgery_shape *shape, bool with_corners, mt_edit_reading *reading)
{
    *reading = (mt_edit_reading){0};
    reader at = {.context = context,
                 .source = source,
                 .log = log,
                 .shape = shape,
                 .with_corners = with_corners,
                 .reading = reading};
    mt_status status = make_room(&at);
    if (status == MT_OK) {
        read_entries(&at);
        status = number_elements(&at);
    }
    mt_free(context, at.vertex_slots);
    mt_free(context, at.face_slots);
    mt_pair_table_release(context, &at.corners);
    if (status != MT_OK) {
        mt_edit_reading_release(context, reading);
    }
    return status;
}

void mt_edit_reading_release(mt_context *context, mt_edit_reading *reading)
{
    void *blocks[] = {reading->vertex_numbers, reading->vertex_targets, reading->vertex_slots, reading->face_slots,
                      reading->corner_slots,   reading->vertices.steps, reading->corners.steps};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) {
        mt_free(context, blocks[i]);
    }
    *reading = (mt_edit_reading){0};
}
