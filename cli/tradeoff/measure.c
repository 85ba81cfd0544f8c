/* Timing by interleaved runs: every level once, then every level again, so that a machine that slows down slows all of
 * them. The first run of a level is judged and not timed. */
#include "tradeoff/tradeoff.h"

#include "progress.h"

#include <meshtool/elementary.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define RUN_MAXIMUM 15

double tradeoff_now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int compare_doubles(const void *left, const void *right)
{
    double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare_doubles);
    return count % 2 ? values[count / 2] : 0.5 * (values[count / 2 - 1] + values[count / 2]);
}

double tradeoff_reference(void)
{
    enum { LENGTH = 1 << 20, RUNS = 9 };
    double times[RUNS];
    volatile double sink = 0;
    for (size_t run = 0; run < RUNS; run++) {
        double begin = tradeoff_now(), sum = 1;
        for (int i = 1; i <= LENGTH; i++) {
            sum = sum * 0x1.fffffep-1 + (double)i;
        }
        sink = sink + sum;
        times[run] = tradeoff_now() - begin;
    }
    return median(times, RUNS);
}

void tradeoff_add_error(tradeoff_row *row, const char *name, double value)
{
    if (row->figure_count < TRADEOFF_FIGURE_MAXIMUM) {
        row->figures[row->figure_count++] = (tradeoff_figure){name, value, true};
    }
}

void tradeoff_add_size(tradeoff_row *row, const char *name, double value)
{
    if (row->figure_count < TRADEOFF_FIGURE_MAXIMUM) {
        row->figures[row->figure_count++] = (tradeoff_figure){name, value, false};
    }
}

double tradeoff_figure_of(const tradeoff_row *row, const char *name)
{
    for (size_t i = 0; i < row->figure_count; i++) {
        if (strcmp(row->figures[i].name, name) == 0) {
            return row->figures[i].value;
        }
    }
    return (double)NAN;
}

typedef struct session {
    const tradeoff_subject *subject;
    const tradeoff_knob *knob;
    void *state;
    tradeoff_table *table;
    tradeoff_row *rows;
    size_t levels[TRADEOFF_KNOB_LEVEL_MAXIMUM]; /* those that are not left out, a row each */
    size_t level_count;
    double begin, seconds; /* when the knob's time began, and how long it is; 0: as long as it takes */
    double deadline;       /* of the run at hand */
    bool is_late;
    char task[64];            /* as the bar names the run at hand */
    double done, done_by_run; /* shares: before the run at hand, and by it */
    double times[TRADEOFF_KNOB_LEVEL_MAXIMUM][RUN_MAXIMUM];
} session;

/* A first run is stopped when it is late; every run, when the command is. */
static bool may_go_on(void *user, const char *task, double fraction)
{
    (void)task;
    session *s = user;
    s->is_late = tradeoff_now() > s->deadline;
    return !s->is_late && mt_progress(s->subject->job->context, s->task, s->done + s->done_by_run * fraction) == MT_OK;
}

/* A context of its own for every run, so that its peak is the run's. */
static mt_context *run_context(session *s)
{
    mt_context *outer = s->subject->job->context;
    uint64_t limit = s->subject->job->common->max_memory, held = mt_context_bytes(outer);
    mt_context_options options = {
        .thread_count = mt_context_thread_count(outer), .progress = may_go_on, .progress_user = s};
    options.memory_limit = limit > held ? limit - held : limit ? 1 : 0;
    mt_context *context = mt_context_create(&options);
    if (!context) {
        mt_fail(outer, MT_ERROR_OUT_OF_MEMORY, "out of memory for a run of %s", s->knob->name);
    }
    return context;
}

static mt_status take_over(const session *s, const mt_context *context, size_t level)
{
    const mt_error *error = mt_context_error(context);
    return mt_fail(s->subject->job->context, error->status, "%s, %s: %s", s->knob->name, s->knob->levels[level],
                   error->message);
}

/* Names the run number `at` of `count`, and asks whether to go on. */
static mt_status announce(session *s, const char *what, size_t level, size_t at, size_t count)
{
    snprintf(s->task, sizeof s->task, "%s %s, %s", what, s->knob->name, s->knob->levels[level]);
    s->done = (double)at / (double)count;
    s->done_by_run = 1 / (double)count;
    return mt_progress(s->subject->job->context, s->task, s->done);
}

/* How long a first run may take: what is left of twice the knob's time is shared by the levels that are left,
 * and each has half of the knob's time at least, should the oracle have used it up. */
static double patience_of(const session *s, size_t level)
{
    size_t count = level;
    while (s->knob->levels[count]) {
        count++;
    }
    double left = 2 * s->seconds - (tradeoff_now() - s->begin);
    return fmax(left / (double)(count - level), 0.5 * s->seconds);
}

/* One run of a level; `row` is filled when it is judged. */
static mt_status run_once(session *s, size_t level, tradeoff_row *row, double *seconds)
{
    mt_context *context = run_context(s);
    if (!context) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    double begin = tradeoff_now();
    s->is_late = false;
    s->deadline = row && s->seconds > 0 ? begin + patience_of(s, level) : INFINITY;
    mt_status status = s->knob->run(s->state, level, context);
    *seconds = tradeoff_now() - begin;
    s->deadline = INFINITY;
    if (status == MT_OK && row) {
        row->peak_bytes = mt_context_peak_bytes(context);
        status = s->knob->judge(s->state, level, context, row);
    }
    if (s->knob->discard) {
        s->knob->discard(s->state, context);
    }
    bool stopped = status == MT_ERROR_CANCELLED && s->is_late;
    status = status == MT_OK || stopped ? status : take_over(s, context, level);
    mt_context_destroy(context);
    return status;
}

static mt_status judge_level(session *s, size_t level, double *round)
{
    const char *why = s->knob->refuse ? s->knob->refuse(s->state, level) : NULL;
    mt_status status = MT_OK;
    if (!why) {
        tradeoff_row *row = &s->rows[s->level_count];
        *row = (tradeoff_row){.knob = s->knob, .level = s->knob->levels[level], .spread = (double)NAN};
        status = run_once(s, level, row, &row->seconds);
        if (status == MT_OK) {
            *round += row->seconds;
            s->levels[s->level_count++] = level;
        } else if (status == MT_ERROR_CANCELLED && s->is_late) {
            why = "one run takes more than this knob's share of the time; a larger --budget has it";
            status = MT_OK;
        }
    }
    if (why) {
        s->table->skips[s->table->skip_count++] = (tradeoff_skip){s->knob, s->knob->levels[level], why};
    }
    return status;
}

static mt_status judge_levels(session *s, double *round)
{
    size_t count = 0;
    while (count < TRADEOFF_KNOB_LEVEL_MAXIMUM && s->knob->levels[count]) {
        count++;
    }
    mt_status status = MT_OK;
    for (size_t level = 0; status == MT_OK && level < count; level++) {
        status = announce(s, "judging", level, level, count);
        if (status == MT_OK) {
            status = judge_level(s, level, round);
        }
    }
    return status;
}

static mt_status time_levels(session *s, size_t runs)
{
    mt_status status = MT_OK;
    for (size_t run = 0; status == MT_OK && run < runs; run++) {
        for (size_t level = 0; status == MT_OK && level < s->level_count; level++) {
            status = announce(s, "timing", s->levels[level], run * s->level_count + level, runs * s->level_count);
            if (status == MT_OK) {
                status = run_once(s, s->levels[level], NULL, &s->times[level][run]);
            }
        }
    }
    for (size_t level = 0; status == MT_OK && level < s->level_count; level++) {
        tradeoff_row *row = &s->rows[level];
        row->seconds = median(s->times[level], runs);
        if (runs > 1 && row->seconds > 0) {
            row->spread = 0.5 * (s->times[level][runs - 1] - s->times[level][0]) / row->seconds;
        }
    }
    return status;
}

static bool is_better(const tradeoff_row *a, const tradeoff_row *b)
{
    double x = tradeoff_figure_of(a, a->knob->axis), y = tradeoff_figure_of(b, b->knob->axis);
    return a->seconds <= b->seconds && x <= y && (a->seconds < b->seconds || x < y);
}

static double logarithm(double x)
{
    return mt_log(x > 1e-18 ? x : 1e-18);
}

/* The knee is the inner level of the front that lies farthest below the chord between its ends, in logarithms. */
static void find_front(session *s)
{
    tradeoff_row *fast = NULL, *exact = NULL, *knee = NULL;
    for (size_t i = 0; i < s->level_count; i++) {
        tradeoff_row *row = &s->rows[i];
        row->is_front = !isnan(tradeoff_figure_of(row, s->knob->axis));
        for (size_t j = 0; j < s->level_count; j++) {
            row->is_front = row->is_front && !is_better(&s->rows[j], row);
        }
        if (row->is_front) {
            fast = !fast || row->seconds < fast->seconds ? row : fast;
            exact = !exact || row->seconds > exact->seconds ? row : exact;
        }
    }
    double farthest = 0;
    for (size_t i = 0; fast != exact && i < s->level_count; i++) {
        tradeoff_row *row = &s->rows[i];
        double width = logarithm(exact->seconds) - logarithm(fast->seconds);
        double low = logarithm(tradeoff_figure_of(exact, s->knob->axis));
        double height = logarithm(tradeoff_figure_of(fast, s->knob->axis)) - low;
        double x = (logarithm(row->seconds) - logarithm(fast->seconds)) / width;
        double y = (logarithm(tradeoff_figure_of(row, s->knob->axis)) - low) / height;
        if (row->is_front && 1 - x - y > farthest) {
            farthest = 1 - x - y;
            knee = row;
        }
    }
    if (knee) {
        knee->is_knee = true;
    }
}

static mt_status measure_levels(session *s)
{
    double round = 0;
    mt_status status = judge_levels(s, &round);
    double left = fmax(s->seconds - (tradeoff_now() - s->begin), 0);
    size_t runs = round > 0 && left / round < RUN_MAXIMUM ? (size_t)(left / round) : RUN_MAXIMUM;
    runs = s->seconds > 0 && runs > 1 ? runs - (runs % 2 == 0) : 0;
    if (status == MT_OK && runs > 0) {
        status = time_levels(s, runs);
    }
    if (status == MT_OK) {
        find_front(s);
    }
    return status;
}

mt_status tradeoff_measure(const tradeoff_subject *subject, const tradeoff_knob *knob, double seconds,
                           tradeoff_table *table)
{
    session *s = calloc(1, sizeof *s);
    if (!s) {
        return mt_fail(subject->job->context, MT_ERROR_OUT_OF_MEMORY, "out of memory for the times of %s", knob->name);
    }
    *s = (session){.subject = subject,
                   .knob = knob,
                   .table = table,
                   .rows = table->rows + table->row_count,
                   .begin = tradeoff_now(),
                   .seconds = seconds};
    const char *why = NULL;
    mt_status status = knob->prepare(subject, &s->state, &why);
    if (status == MT_OK && why) {
        table->skips[table->skip_count++] = (tradeoff_skip){knob, NULL, why};
    } else if (status == MT_OK) {
        status = measure_levels(s);
        table->row_count += s->level_count;
    }
    if (s->state) {
        knob->release(s->state, subject->job->context);
    }
    free(s);
    return status;
}
