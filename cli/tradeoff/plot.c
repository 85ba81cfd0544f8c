/* Small multiples: a panel for each knob, time to the right and error upwards, both in decades. Levels that no other
 * beats in both are filled and joined; the knee is ringed. A level without error stands on the floor of its panel. */
#include "tradeoff/canvas.h"
#include "tradeoff/tradeoff.h"

#include "files.h"
#include "message.h"

#include <meshtool/elementary.h>
#include <meshtool/file.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define COLUMNS 2
#define PANEL_WIDTH 560.0
#define PANEL_HEIGHT 330.0
#define HEADER 76.0
#define LEFT 74.0
#define RIGHT 34.0
#define TOP 46.0
#define BOTTOM 52.0
#define LETTER 8.0 /* height of a capital */

static bool is_svg(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".svg") == 0;
}

cli_exit tradeoff_check_plot(const cli_job *job, const char *path)
{
    const mt_image_format *format = NULL;
    return is_svg(path) ? cli_check_output(job, path) : cli_check_image_output(job, path, &format);
}

/* Decades: floor and ceiling of what is shown. */
typedef struct scale {
    double low, high;
} scale;

static double decade(double x)
{
    return mt_log(x) / 2.30258509299404568402;
}

static void widen(scale *s, double value)
{
    if (value > 0 && isfinite(value)) {
        s->low = fmin(s->low, decade(value));
        s->high = fmax(s->high, decade(value));
    }
}

static scale close_scale(scale s, double least)
{
    if (s.low > s.high) {
        return (scale){-1, 0}; /* nothing but zeros */
    }
    double middle = 0.5 * (s.low + s.high), half = fmax(0.5 * (s.high - s.low), least) * 1.12;
    return (scale){middle - half, middle + half};
}

typedef struct panel {
    const canvas *on;
    const tradeoff_row *rows;
    size_t row_count;
    double left, top, right, bottom; /* of the field */
    double floor;                    /* where errors of 0 stand */
    scale time, error;
} panel;

static double place_x(const panel *p, double seconds)
{
    return p->left + (decade(seconds) - p->time.low) / (p->time.high - p->time.low) * (p->right - p->left);
}

static double place_y(const panel *p, double error)
{
    if (!(error > 0)) {
        return p->floor;
    }
    double share = (decade(error) - p->error.low) / (p->error.high - p->error.low);
    return p->bottom - 22 - share * (p->bottom - 22 - p->top);
}

static double error_of(const tradeoff_row *row)
{
    return tradeoff_figure_of(row, row->knob->axis);
}

static void name_of_axis(char text[64], const char *name)
{
    snprintf(text, 64, "%s", name);
    for (char *at = text; *at; at++) {
        *at = *at == '_' ? ' ' : *at;
    }
}

/* As many of each decade as there is room for. */
static void draw_time_ticks(const panel *p)
{
    static const double steps[] = {1, 2, 5, 1.5, 3, 7};
    double range = p->time.high - p->time.low;
    size_t step_count = range > 1.6 ? 1 : range > 0.7 ? 3 : 6;
    for (int exponent = (int)floor(p->time.low); exponent <= (int)ceil(p->time.high); exponent++) {
        for (size_t i = 0; i < step_count; i++) {
            double seconds = steps[i] * mt_pow(10, exponent), x = place_x(p, seconds);
            if (x >= p->left - 0.5 && x <= p->right + 0.5) {
                char text[32];
                snprintf(text, sizeof text, seconds < 0.9995 ? "%.3g ms" : "%.3g s",
                         seconds < 0.9995 ? 1e3 * seconds : seconds);
                canvas_line(p->on, x, p->top, x, p->bottom, 1, PLOT_FAINT);
                canvas_text(p->on, x, p->bottom + 13, LETTER - 1, PLOT_MIDDLE, PLOT_MUTED, text);
            }
        }
    }
}

static void draw_error_ticks(const panel *p)
{
    static const double steps[] = {1, 2, 5, 1.1, 1.2, 1.3, 1.4, 1.6, 1.8, 2.5, 3, 4, 6, 8};
    int step = (int)ceil((p->error.high - p->error.low) / 5);
    step = step > 1 ? step : 1;
    double range = p->error.high - p->error.low;
    size_t step_count = range > 1.6 ? 1 : range > 0.4 ? 3 : sizeof steps / sizeof *steps;
    for (int exponent = (int)floor(p->error.low); exponent <= (int)ceil(p->error.high); exponent++) {
        for (size_t i = 0; i < step_count; i++) {
            double error = steps[i] * mt_pow(10, exponent), y = place_y(p, error);
            if (exponent % step == 0 && y >= p->top - 0.5 && y <= p->bottom - 22 + 0.5) {
                char text[32];
                snprintf(text, sizeof text, "%g", error);
                canvas_line(p->on, p->left, y, p->right, y, 1, PLOT_FAINT);
                canvas_text(p->on, p->left - 7, y, LETTER - 1, PLOT_END, PLOT_MUTED, text);
            }
        }
    }
}

static void draw_frame(const panel *p)
{
    char axis[64];
    bool has_zero = false;
    for (size_t i = 0; i < p->row_count; i++) {
        has_zero = has_zero || error_of(&p->rows[i]) == 0;
    }
    draw_time_ticks(p);
    draw_error_ticks(p);
    if (has_zero) {
        canvas_text(p->on, p->left - 7, p->floor, LETTER - 1, PLOT_END, PLOT_MUTED, "0");
        canvas_line(p->on, p->left, p->floor, p->right, p->floor, 1, PLOT_FAINT);
    }
    canvas_line(p->on, p->left, p->top, p->left, p->bottom, 1.2, PLOT_MUTED);
    canvas_line(p->on, p->left, p->bottom, p->right, p->bottom, 1.2, PLOT_MUTED);
    name_of_axis(axis, p->rows->knob->axis);
    canvas_text(p->on, p->left - LEFT + 18, p->top - 32, LETTER + 1.5, PLOT_BEGIN, PLOT_INK, p->rows->knob->question);
    canvas_text(p->on, p->left - LEFT + 18, p->top - 12, LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED, axis);
    canvas_text(p->on, p->right, p->bottom + 32, LETTER - 0.5, PLOT_END, PLOT_MUTED, "time");
}

/* The next level of the front, to the right of a time. */
static const tradeoff_row *next_of_front(const panel *p, double seconds)
{
    const tradeoff_row *next = NULL;
    for (size_t i = 0; i < p->row_count; i++) {
        const tradeoff_row *row = &p->rows[i];
        if (row->is_front && row->seconds > seconds && (!next || row->seconds < next->seconds)) {
            next = row;
        }
    }
    return next;
}

static void draw_front(const panel *p)
{
    const tradeoff_row *from = next_of_front(p, -1), *to;
    for (; from && (to = next_of_front(p, from->seconds)) != NULL; from = to) {
        double x = place_x(p, from->seconds), y = place_y(p, error_of(from));
        double next_x = place_x(p, to->seconds), next_y = place_y(p, error_of(to));
        canvas_line(p->on, x, y, next_x, y, 1.4, PLOT_MUTED);
        canvas_line(p->on, next_x, y, next_x, next_y, 1.4, PLOT_MUTED);
    }
}

static void draw_point(const panel *p, const tradeoff_row *row)
{
    double x = place_x(p, row->seconds), y = place_y(p, error_of(row));
    if (row->is_knee) {
        canvas_disc(p->on, x, y, 9.5, PLOT_ACCENT);
        canvas_disc(p->on, x, y, 7.5, PLOT_PAPER);
    }
    canvas_disc(p->on, x, y, 5, row->is_front ? PLOT_INK : PLOT_MUTED);
    if (!row->is_front) {
        canvas_disc(p->on, x, y, 3.4, PLOT_PAPER);
    }
}

/* Where a label stands: its ends and its middle height. */
typedef struct label_place {
    double left, right, y;
} label_place;

static bool is_taken(const label_place *places, size_t count, label_place place)
{
    for (size_t i = 0; i < count; i++) {
        if (place.left < places[i].right + 4 && places[i].left < place.right + 4 && fabs(places[i].y - place.y) < 12) {
            return true;
        }
    }
    return false;
}

/* Labels stand to the right of their points, or to the left near the right end; one that would fall onto an earlier one
 * moves up. */
static void draw_labels(const panel *p)
{
    label_place places[64] = {{0}};
    size_t count = 0;
    for (size_t i = 0; i < p->row_count && count < 64; i++) {
        const tradeoff_row *row = &p->rows[i];
        char text[64];
        if (isnan(error_of(row))) {
            continue;
        }
        snprintf(text, sizeof text, row->is_knee ? "%s (knee)" : "%s", row->level);
        double x = place_x(p, row->seconds), width = canvas_text_width(p->on, LETTER, text);
        bool fits = x + 9 + width < p->right + RIGHT - 4;
        label_place place = {fits ? x + 9 : x - 9 - width, fits ? x + 9 + width : x - 9,
                             place_y(p, error_of(row)) - 10};
        for (size_t moved = 0; moved < count && is_taken(places, count, place); moved++) {
            place.y -= 13;
        }
        places[count++] = place;
        canvas_text(p->on, fits ? x + 9 : x - 9, place.y, LETTER, fits ? PLOT_BEGIN : PLOT_END,
                    row->is_knee ? PLOT_ACCENT : PLOT_INK, text);
    }
}

static void draw_panel(const canvas *on, const tradeoff_row *rows, size_t row_count, double x, double y)
{
    panel p = {.on = on, .rows = rows, .row_count = row_count};
    p.left = x + LEFT, p.top = y + TOP + 14;
    p.right = x + PANEL_WIDTH - RIGHT, p.bottom = y + PANEL_HEIGHT - BOTTOM;
    p.floor = p.bottom - 7;
    p.time = p.error = (scale){INFINITY, -INFINITY};
    for (size_t i = 0; i < row_count; i++) {
        widen(&p.time, rows[i].seconds);
        widen(&p.error, error_of(&rows[i]));
    }
    p.time = close_scale(p.time, 0.15);
    p.error = close_scale(p.error, 0.06);
    draw_frame(&p);
    draw_front(&p);
    for (size_t i = 0; i < row_count; i++) {
        if (!isnan(error_of(&rows[i]))) {
            draw_point(&p, &rows[i]);
        }
    }
    draw_labels(&p);
}

static size_t count_panels(const tradeoff_table *table)
{
    size_t count = 0;
    for (size_t i = 0; i < table->row_count; i++) {
        count += i == 0 || table->rows[i].knob != table->rows[i - 1].knob;
    }
    return count;
}

static void draw(const canvas *on, const tradeoff_subject *subject, const tradeoff_table *table, double width,
                 double height)
{
    char title[256];
    const char *slash = strrchr(subject->name, '/');
    snprintf(title, sizeof title, "What speed costs on %.120s (%u faces)", slash ? slash + 1 : subject->name,
             (unsigned)subject->mesh->face_count);
    canvas_begin(on, width, height);
    canvas_text(on, 18, 24, 12, PLOT_BEGIN, PLOT_INK, title);
    canvas_text(on, 18, 46, LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED, "Left is faster, lower is more exact.");
    canvas_text(on, 18, 62, LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED,
                "Filled: no other level is as fast and as exact. Ringed: the knee.");
    size_t number = 0;
    for (size_t begin = 0, end; begin < table->row_count; begin = end, number++) {
        for (end = begin; end < table->row_count && table->rows[end].knob == table->rows[begin].knob;) {
            end++;
        }
        double x = PANEL_WIDTH * (double)(number % COLUMNS);
        draw_panel(on, table->rows + begin, end - begin, x, HEADER + PANEL_HEIGHT * (double)(number / COLUMNS));
    }
    canvas_end(on);
}

static cli_exit write_svg(const cli_job *job, const tradeoff_subject *subject, const tradeoff_table *table,
                          const char *path, double width, double height)
{
    char *text = NULL;
    size_t size = 0;
    FILE *svg = open_memstream(&text, &size);
    if (!svg) {
        return cli_report_failure(job, path);
    }
    const canvas on = {.svg = svg};
    draw(&on, subject, table, width, height);
    fclose(svg);
    mt_status status = mt_file_write(job->context, path, text, size, job->common->no_clobber);
    free(text);
    return status == MT_OK ? CLI_EXIT_DONE : cli_report_failure(job, path);
}

cli_exit tradeoff_plot(const cli_job *job, const tradeoff_subject *subject, const tradeoff_table *table,
                       const char *path)
{
    size_t panels = count_panels(table), columns = panels < COLUMNS ? panels : COLUMNS;
    double width = PANEL_WIDTH * (double)(columns > 0 ? columns : 1);
    double height = HEADER + PANEL_HEIGHT * (double)((panels + COLUMNS - 1) / COLUMNS);
    if (is_svg(path)) {
        return write_svg(job, subject, table, path, width, height);
    }
    canvas on = {NULL, NULL};
    if (mt_image_create(job->context, (uint32_t)width, (uint32_t)height, 3, &on.image) != MT_OK) {
        return cli_report_failure(job, path);
    }
    draw(&on, subject, table, width, height);
    cli_exit code = cli_write_image(job, on.image, path);
    mt_image_destroy(job->context, on.image);
    return code;
}
