#include <meshtool/edit_log.h>

#include <assert.h>
#include <math.h>

mt_status mt_edit_log_reserve(mt_context *context, mt_edit_log *log, uint64_t more)
{
    if (log->capacity - log->count >= more) {
        return MT_OK;
    }
    uint64_t capacity = 2 * log->capacity + more;
    if (capacity > UINT64_MAX / sizeof *log->edits) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "the log of edits is too long");
    }
    mt_edit *edits = mt_reallocate(context, log->edits, capacity * sizeof *edits);
    if (!edits) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    log->edits = edits;
    log->capacity = capacity;
    return MT_OK;
}

void mt_edit_log_release(mt_context *context, mt_edit_log *log)
{
    mt_free(context, log->edits);
    *log = (mt_edit_log){0};
}

void mt_edit_log_add(mt_edit_log *log, mt_domain domain, mt_index target, mt_index a, mt_index b, double weight)
{
    assert(log->count < log->capacity);
    log->edits[log->count++] = (mt_edit){domain, target, a, b, weight};
}

static void make_unit(uint32_t component_count, double *value)
{
    double sum = 0;
    for (uint32_t i = 0; i < component_count; i++) {
        sum += value[i] * value[i];
    }
    for (uint32_t i = 0; i < component_count && sum > 0; i++) {
        value[i] /= sqrt(sum);
    }
}

void mt_edit_log_replay(const mt_edit_log *log, mt_domain domain, mt_interpolation interpolation,
                        uint32_t component_count, double *values)
{
    for (uint64_t i = 0; i < log->count; i++) {
        mt_edit edit = log->edits[i];
        if (edit.domain != domain) {
            continue;
        }
        double weight = interpolation == MT_INTERPOLATE_NONE ? edit.weight > 0.5 : edit.weight;
        const double *a = values + (size_t)component_count * edit.a;
        const double *b = values + (size_t)component_count * edit.b;
        double *target = values + (size_t)component_count * edit.target;
        bool mixes = weight > 0 && weight < 1;
        for (uint32_t j = 0; j < component_count; j++) {
            target[j] = mixes ? (1 - weight) * a[j] + weight * b[j] : (weight > 0 ? b[j] : a[j]);
        }
        if (mixes && interpolation == MT_INTERPOLATE_UNIT) {
            make_unit(component_count, target);
        }
    }
}
