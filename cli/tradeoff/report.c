/* The table as people read it, and as scripts do. */
#include "tradeoff/tradeoff.h"

#include "json.h"
#include "quantity.h"
#include "tradeoff/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CELL 16

/* Three significant digits. */
static const char *number(char text[CELL], double value)
{
    if (isnan(value)) {
        snprintf(text, CELL, "-");
    } else if (isinf(value)) {
        snprintf(text, CELL, value < 0 ? "-infinite" : "infinite");
    } else {
        double size = fabs(value);
        snprintf(text, CELL, size >= 1e3 && size < 1e12 ? "%.0f" : "%.3g", value);
    }
    return text;
}

static const char *duration(char text[CELL], double seconds)
{
    static const struct {
        double unit;
        const char *name;
    } units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}};
    size_t i = 0;
    while (i + 1 < sizeof units / sizeof *units && seconds < units[i].unit) {
        i++;
    }
    snprintf(text, CELL, "%.3g %s", seconds / units[i].unit, units[i].name);
    return text;
}

static int width_of(const char *heading)
{
    int length = (int)strlen(heading);
    return length > 9 ? length : 9;
}

static void print_head(const tradeoff_row *row)
{
    printf("\n%s (--knob %s; judged by %s)\n", row->knob->question, row->knob->name, row->knob->oracle);
    printf("  %-14s %9s %7s %9s", "level", "time", "+-", "memory");
    for (size_t i = 0; i < row->figure_count; i++) {
        printf("  %*s", width_of(row->figures[i].name), row->figures[i].name);
    }
    putchar('\n');
}

static void print_row(const tradeoff_row *row)
{
    char time[CELL], spread[CELL] = "-", cell[CELL];
    if (!isnan(row->spread)) {
        snprintf(spread, sizeof spread, "%.0f %%", 100 * row->spread);
    }
    printf("%c %-14s %9s %7s %9s", row->is_knee ? '*' : ' ', row->level, duration(time, row->seconds), spread,
           cli_bytes(row->peak_bytes).text);
    for (size_t i = 0; i < row->figure_count; i++) {
        printf("  %*s", width_of(row->figures[i].name), number(cell, row->figures[i].value));
    }
    putchar('\n');
}

static void print_losses(const tradeoff_table *table, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i++) {
        printf("    %s: %s\n", table->rows[i].level, table->rows[i].says);
    }
}

static void print_legend(const tradeoff_table *table)
{
    bool has_knee = false;
    for (size_t i = 0; i < table->row_count; i++) {
        has_knee |= table->rows[i].is_knee;
    }
    puts(has_knee ? "\n* the knee: beyond it, a little more exactness costs much time." : "");
    puts("Times are medians; +- is half of their range; without it there was one run. Errors, 0 being right, in the "
         "unit\n"
         "after the semicolon (p50: half of all are below it, p99: 99 of 100; diagonals: of the mesh's box):");
    tradeoff_print_units(table);
}

void tradeoff_print_text(const tradeoff_subject *subject, const tradeoff_table *table)
{
    printf("%s: %s, %s\n", subject->name, cli_counted(subject->mesh->vertex_count, "vertex").text,
           cli_counted(subject->mesh->face_count, "face").text);
    for (size_t begin = 0, end; begin < table->row_count; begin = end) {
        print_head(&table->rows[begin]);
        for (end = begin; end < table->row_count && table->rows[end].knob == table->rows[begin].knob; end++) {
            print_row(&table->rows[end]);
        }
        print_losses(table, begin, end);
    }
    for (size_t i = 0; i < table->skip_count; i++) {
        const tradeoff_skip *skip = &table->skips[i];
        printf("%s%s%s%s: left out, %s\n", i == 0 ? "\n" : "", skip->knob->name, skip->level ? ", " : "",
               skip->level ? skip->level : "", skip->why);
    }
    if (table->row_count > 0) {
        print_legend(table);
    }
}

static json_t *row_json(const tradeoff_row *row)
{
    json_t *object = cli_json_object(), *errors = cli_json_object(), *sizes = cli_json_object();
    cli_json_set(object, "knob", cli_json_text(row->knob->name));
    cli_json_set(object, "level", cli_json_text(row->level));
    cli_json_set(object, "seconds", cli_json_real(row->seconds));
    cli_json_set(object, "spread", cli_json_real(row->spread));
    cli_json_set(object, "peak_bytes", cli_json_integer((int64_t)row->peak_bytes));
    for (size_t i = 0; i < row->figure_count; i++) {
        const tradeoff_figure *figure = &row->figures[i];
        cli_json_set(figure->is_error ? errors : sizes, figure->name, cli_json_real(figure->value));
    }
    cli_json_set(object, "error", errors);
    cli_json_set(object, "size", sizes);
    cli_json_set(object, "says", cli_json_text(row->says));
    cli_json_set(object, "front", row->is_front ? json_true() : json_false());
    cli_json_set(object, "knee", row->is_knee ? json_true() : json_false());
    return object;
}

void tradeoff_print_json(const tradeoff_subject *subject, const tradeoff_table *table)
{
    json_t *object = cli_json_object(), *rows = cli_json_array(), *skips = cli_json_array();
    cli_json_set(object, "file", cli_json_text(subject->name));
    cli_json_set(object, "vertices", cli_json_integer(subject->mesh->vertex_count));
    cli_json_set(object, "faces", cli_json_integer(subject->mesh->face_count));
    cli_json_set(object, "reference_seconds", cli_json_real(table->reference_seconds));
    for (size_t i = 0; i < table->row_count; i++) {
        cli_json_append(rows, row_json(&table->rows[i]));
    }
    for (size_t i = 0; i < table->skip_count; i++) {
        json_t *skip = cli_json_object();
        cli_json_set(skip, "knob", cli_json_text(table->skips[i].knob->name));
        cli_json_set(skip, "level", table->skips[i].level ? cli_json_text(table->skips[i].level) : json_null());
        cli_json_set(skip, "why", cli_json_text(table->skips[i].why));
        cli_json_append(skips, skip);
    }
    cli_json_set(object, "rows", rows);
    cli_json_set(object, "skipped", skips);
    cli_json_print_line(object);
    json_decref(object);
}
