#include "tradeoff/plot_panel.h"

#include "tradeoff/plot_labels.h"
#include "tradeoff/plot_scale.h"
#include "tradeoff/unit.h"

#include <math.h>
#include <string.h>

#define LEFT 74.0
#define RIGHT 34.0
#define TOP 60.0
#define BOTTOM 58.0
#define ABOVE_FLOOR 24.0 /* from the field's end to the least error above zero */
#define LETTER PLOT_LETTER

typedef struct panel {
    const canvas *on;
    const tradeoff_row *rows;
    size_t row_count;
    double left, top, right, bottom; /* of the field */
    double floor;                    /* where errors of 0 stand */
    plot_scale time, error;          /* the error's is empty when there is none */
} panel;

static double error_of(const tradeoff_row *row)
{
    return tradeoff_figure_of(row, row->knob->axis);
}

static double place_x(const panel *p, double seconds)
{
    return p->left + plot_scale_share(&p->time, seconds) * (p->right - p->left);
}

static double place_y(const panel *p, double error)
{
    if (!(error > 0)) {
        return p->floor;
    }
    double low = p->bottom - ABOVE_FLOOR;
    return low - plot_scale_share(&p->error, error) * (low - p->top);
}

static void draw_time_ticks(const panel *p)
{
    double ticks[PLOT_TICK_MAXIMUM];
    size_t count = plot_scale_ticks(&p->time, ticks);
    for (size_t i = 0; i < count; i++) {
        char text[32];
        double x = place_x(p, ticks[i]), seconds = ticks[i];
        snprintf(text, sizeof text, seconds < 0.9995 ? "%.3g ms" : "%.3g s",
                 seconds < 0.9995 ? 1e3 * seconds : seconds);
        canvas_line(p->on, x, p->top, x, p->bottom, 1, PLOT_FAINT);
        canvas_text(p->on, x, p->bottom + 13, LETTER - 1, PLOT_MIDDLE, PLOT_MUTED, text);
    }
}

static void draw_error_ticks(const panel *p)
{
    double ticks[PLOT_TICK_MAXIMUM];
    size_t count = plot_scale_ticks(&p->error, ticks);
    for (size_t i = 0; i < count; i++) {
        char text[32];
        double y = place_y(p, ticks[i]);
        snprintf(text, sizeof text, "%g", ticks[i]);
        canvas_line(p->on, p->left, y, p->right, y, 1, PLOT_FAINT);
        canvas_text(p->on, p->left - 7, y, LETTER - 1, PLOT_END, PLOT_MUTED, text);
    }
}

/* Where nothing is wrong there is no scale of errors to read. */
static void draw_errors(const panel *p)
{
    bool has_zero = false;
    for (size_t i = 0; i < p->row_count; i++) {
        has_zero = has_zero || error_of(&p->rows[i]) == 0;
    }
    if (!plot_scale_is_empty(&p->error)) {
        draw_error_ticks(p);
    } else if (has_zero) {
        canvas_text(p->on, 0.5 * (p->left + p->right), p->top + 24, LETTER, PLOT_MIDDLE, PLOT_MUTED,
                    "No level has an error on this mesh.");
    } else {
        canvas_text(p->on, 0.5 * (p->left + p->right), p->top + 24, LETTER, PLOT_MIDDLE, PLOT_MUTED,
                    "The error is not known on this mesh.");
    }
    if (has_zero) {
        canvas_text(p->on, p->left - 7, p->floor, LETTER - 1, PLOT_END, PLOT_MUTED, "0");
        canvas_line(p->on, p->left, p->floor, p->right, p->floor, 1, PLOT_FAINT);
    }
}

/* What stands upwards: the figure as the table calls it, its meaning and its unit. */
static void name_error(const panel *p, char *text, size_t size)
{
    const char *figure = p->rows->knob->axis;
    const tradeoff_unit *unit = tradeoff_unit_of(figure);
    snprintf(text, size, unit ? "%s: %s (%s)" : "%s", figure, unit ? unit->meaning : "", unit ? unit->unit : "");
    for (char *at = text; *at; at++) {
        *at = *at == '_' ? ' ' : *at;
    }
}

static void name_left_out(const panel *p, const tradeoff_table *table, char *text, size_t size)
{
    size_t length = 0;
    for (size_t i = 0; i < table->skip_count; i++) {
        const tradeoff_skip *skip = &table->skips[i];
        if (skip->knob == p->rows->knob && skip->level && length < size) {
            length +=
                (size_t)snprintf(text + length, size - length, "%s%s", length == 0 ? "left out: " : ", ", skip->level);
        }
    }
}

static void draw_frame(const panel *p, const tradeoff_table *table)
{
    char axis[160], left_out[160] = "";
    double edge = p->left - LEFT + 18;
    draw_time_ticks(p);
    draw_errors(p);
    canvas_line(p->on, p->left, p->top, p->left, p->bottom, 1.2, PLOT_MUTED);
    canvas_line(p->on, p->left, p->bottom, p->right, p->bottom, 1.2, PLOT_MUTED);
    name_error(p, axis, sizeof axis);
    name_left_out(p, table, left_out, sizeof left_out);
    canvas_text(p->on, edge, p->top - 34, LETTER + 1.5, PLOT_BEGIN, PLOT_INK, p->rows->knob->question);
    canvas_text(p->on, edge, p->top - 14, LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED, axis);
    canvas_text(p->on, edge, p->bottom + 32, LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED, left_out);
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

static void draw_levels(const panel *p)
{
    plot_label labels[TRADEOFF_KNOB_LEVEL_MAXIMUM];
    size_t count = 0;
    for (size_t i = 0; i < p->row_count && count < TRADEOFF_KNOB_LEVEL_MAXIMUM; i++) {
        const tradeoff_row *row = &p->rows[i];
        if (!isnan(error_of(row))) {
            plot_label *label = &labels[count++];
            *label = (plot_label){.x = place_x(p, row->seconds),
                                  .y = place_y(p, error_of(row)),
                                  .radius = row->is_knee ? 9.5 : 5,
                                  .shade = row->is_knee ? PLOT_ACCENT : PLOT_INK};
            snprintf(label->text, sizeof label->text, row->is_knee ? "%s (knee)" : "%s", row->level);
            draw_point(p, row);
        }
    }
    plot_labels_draw(p->on, labels, count, LETTER, p->left, p->right + RIGHT - 4, p->top);
}

void plot_panel_draw(const canvas *on, const tradeoff_table *table, size_t begin, size_t end, double x, double y)
{
    panel p = {.on = on, .rows = table->rows + begin, .row_count = end - begin};
    p.left = x + LEFT, p.top = y + TOP;
    p.right = x + PLOT_PANEL_WIDTH - RIGHT, p.bottom = y + PLOT_PANEL_HEIGHT - BOTTOM;
    p.time = p.error = plot_scale_empty();
    for (size_t i = 0; i < p.row_count; i++) {
        plot_scale_widen(&p.time, p.rows[i].seconds);
        plot_scale_widen(&p.error, error_of(&p.rows[i]));
    }
    p.floor = plot_scale_is_empty(&p.error) ? 0.5 * (p.top + p.bottom) : p.bottom - 8;
    plot_scale_close(&p.time, 0.15);
    if (!plot_scale_is_empty(&p.error)) {
        plot_scale_close(&p.error, 0.06);
    }
    draw_frame(&p, table);
    draw_front(&p);
    draw_levels(&p);
}
