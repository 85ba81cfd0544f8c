#include <meshtool/edit_log.h>

#include <assert.h>

mt_status mt_edit_log_reserve(mt_context *context, mt_edit_log *log, uint64_t more)
{
    if (log->is_off || log->capacity - log->count >= more) {
        return MT_OK;
    }
    uint64_t capacity = 2 * log->capacity + more;
    if (capacity > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "the log of edits is longer than an index can number");
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

void mt_edit_log_add(mt_edit_log *log, const mt_edit *edit)
{
    if (!log->is_off) {
        assert(log->count < log->capacity);
        log->edits[log->count++] = *edit;
    }
}
