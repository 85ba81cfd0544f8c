/* The steps in their order, from a table. */
#include "lib/algorithms/repair_state.h"

#include <string.h>

#define ROUND_COUNT_MAXIMUM 100 /* two are usual: one that mends, one that finds nothing more */

typedef struct step_record {
    const char *key;
    const char *option;
    mt_status (*run)(repair_state *state, mt_repair_result *result);
    mt_status (*run_with)(repair_state *state, const mt_repair_options *options, mt_repair_result *result);
} step_record;

static const step_record steps[MT_REPAIR_STEP_COUNT] = {
    [MT_REPAIR_WELD] = {"weld", "weld", NULL, mt_repair_weld},
    [MT_REPAIR_DROP_DEGENERATE] = {"drop_degenerate", "drop-degenerate", mt_repair_drop_degenerate, NULL},
    [MT_REPAIR_DROP_DUPLICATES] = {"drop_duplicates", "drop-duplicates", mt_repair_drop_duplicates, NULL},
    [MT_REPAIR_SPLIT] = {"split", "split", mt_repair_split, NULL},
    [MT_REPAIR_ORIENT] = {"orient", "orient", mt_repair_orient, NULL},
    [MT_REPAIR_FILL_HOLES] = {"fill_holes", "fill-holes", NULL, mt_repair_fill_holes},
    [MT_REPAIR_DROP_ISOLATED] = {"drop_isolated", "drop-isolated", mt_repair_drop_isolated, NULL},
};

const char *mt_repair_step_key(mt_repair_step step)
{
    return steps[step].key;
}

const char *mt_repair_step_option(mt_repair_step step)
{
    return steps[step].option;
}

static mt_status run_steps(repair_state *state, const mt_repair_options *options, mt_repair_report *report)
{
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        mt_repair_result *result = &report->results[step];
        result->asked = options->steps[step];
        if (!result->asked) {
            mt_part_skip(state->context, steps[step].option, "not asked for");
            continue;
        }
        mt_status status = mt_progress(state->context, "repairing", (double)step / MT_REPAIR_STEP_COUNT);
        int part = mt_part_begin(state->context, steps[step].option, "asked for");
        if (status == MT_OK) {
            status = steps[step].run ? steps[step].run(state, result) : steps[step].run_with(state, options, result);
        }
        mt_part_end(state->context, part);
        if (status != MT_OK) {
            return status;
        }
    }
    return MT_OK;
}

static bool same_block(const void *a, const void *b, size_t size)
{
    return (a == NULL) == (b == NULL) && (!a || memcmp(a, b, size) == 0);
}

static bool same_mesh(const mt_mesh *a, const mt_mesh *b)
{
    return a->vertex_count == b->vertex_count && a->face_count == b->face_count && a->corner_count == b->corner_count &&
           a->face_size == b->face_size &&
           same_block(a->positions, b->positions, 3 * (size_t)a->vertex_count * mt_type_size(a->position_type)) &&
           same_block(a->face_offsets, b->face_offsets, ((size_t)a->face_count + 1) * sizeof(mt_index)) &&
           same_block(a->corner_vertices, b->corner_vertices, a->corner_count * sizeof(mt_index));
}

/* Adds what a round did to the account; what it left replaces what the round before left. */
static mt_status add_round(mt_context *context, const mt_repair_report *round, bool changed, mt_repair_report *total)
{
    mt_status status = MT_OK;
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        const mt_repair_result *from = &round->results[step];
        mt_repair_result *to = &total->results[step];
        to->asked = from->asked;
        to->left_count = from->left_count;
        to->count += changed ? from->count : 0;
        for (uint64_t i = 0; changed && status == MT_OK && i < from->face_count; i++) {
            status = mt_repair_note_face(context, to, from->faces[i]);
        }
        for (uint64_t i = 0; changed && status == MT_OK && i < from->vertex_count; i++) {
            status = mt_repair_note_vertex(context, to, from->vertices[i]);
        }
    }
    return status;
}

static int count_asked(const mt_repair_options *options)
{
    int count = 0;
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        count += options->steps[step];
    }
    return count;
}

/* One round, and whether another is due. A later step can give an earlier one new work: a component that filling closed
 * may have to be turned outwards, and edges that splitting left with one side may fit others. repair_stitch.c tells why
 * rounds end. */
static mt_status run_round(repair_state *state, const mt_repair_options *options, mt_repair_report *total, bool *again)
{
    mt_context *context = state->context;
    mt_repair_report round = {0};
    mt_mesh *before = NULL;
    bool has_several = count_asked(options) > 1;
    mt_status status = has_several ? mt_mesh_copy(context, state->mesh, &before) : MT_OK;
    if (status == MT_OK) {
        status = run_steps(state, options, &round);
    }
    if (status == MT_OK) {
        mt_mesh_compact_faces(context, state->mesh);
        bool changed = !before || !same_mesh(before, state->mesh);
        *again = has_several && changed;
        status = add_round(context, &round, changed, total);
    }
    mt_mesh_destroy(context, before);
    mt_repair_report_release(context, &round);
    return status;
}

mt_status mt_repair(mt_context *context, const mt_mesh *mesh, const mt_repair_options *options,
                    mt_repair_report *report, mt_mesh **out)
{
    *out = NULL;
    memset(report, 0, sizeof *report);
    if (!(options->weld_tolerance >= 0)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the welding tolerance %g is not a distance; it must be 0 or more",
                       options->weld_tolerance);
    }
    repair_state state;
    mt_status status = mt_repair_state_init(context, mesh, &state);
    bool again = true;
    if (status == MT_OK) {
        mt_mesh_compact_faces(context, state.mesh);
    }
    for (int round = 0; status == MT_OK && again && round < ROUND_COUNT_MAXIMUM; round++) {
        status = run_round(&state, options, report, &again);
    }
    if (status == MT_OK) {
        *out = state.mesh;
        state.mesh = NULL;
    } else {
        mt_repair_report_release(context, report);
    }
    mt_repair_state_release(&state);
    return status;
}

void mt_repair_report_release(mt_context *context, mt_repair_report *report)
{
    for (int step = 0; step < MT_REPAIR_STEP_COUNT; step++) {
        mt_free(context, report->results[step].faces);
        mt_free(context, report->results[step].vertices);
    }
    memset(report, 0, sizeof *report);
}
