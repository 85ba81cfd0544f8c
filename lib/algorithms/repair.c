/* The steps in their order, from a table. */
#include "lib/algorithms/repair_state.h"

#include <string.h>

typedef struct step_record {
    const char *key;
    const char *option;
    mt_status (*run)(repair_state *state, mt_repair_result *result); /* NULL: weld, which takes a tolerance */
} step_record;

static const step_record steps[MT_REPAIR_STEP_COUNT] = {
    [MT_REPAIR_WELD] = {"weld", "weld", NULL},
    [MT_REPAIR_DROP_DEGENERATE] = {"drop_degenerate", "drop-degenerate", mt_repair_drop_degenerate},
    [MT_REPAIR_DROP_DUPLICATES] = {"drop_duplicates", "drop-duplicates", mt_repair_drop_duplicates},
    [MT_REPAIR_SPLIT] = {"split", "split", mt_repair_split},
    [MT_REPAIR_ORIENT] = {"orient", "orient", mt_repair_orient},
    [MT_REPAIR_FILL_HOLES] = {"fill_holes", "fill-holes", mt_repair_fill_holes},
    [MT_REPAIR_DROP_ISOLATED] = {"drop_isolated", "drop-isolated", mt_repair_drop_isolated},
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
            continue;
        }
        mt_status status = mt_progress(state->context, "repairing", (double)step / MT_REPAIR_STEP_COUNT);
        int part = mt_part_begin(state->context, steps[step].option, "asked for");
        if (status == MT_OK) {
            status = steps[step].run ? steps[step].run(state, result)
                                     : mt_repair_weld(state, options->weld_tolerance, result);
        }
        mt_part_end(state->context, part);
        if (status != MT_OK) {
            return status;
        }
    }
    return MT_OK;
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
    if (status == MT_OK) {
        status = run_steps(&state, options, report);
    }
    if (status == MT_OK) {
        mt_mesh_compact_faces(context, state.mesh);
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
