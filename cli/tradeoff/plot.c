/* Small multiples: a panel for each knob, and above them how to read them. */
#include "tradeoff/plot_panel.h"

#include "files.h"
#include "message.h"
#include "quantity.h"

#include <meshtool/file.h>

#include <stdlib.h>
#include <string.h>
#include <strings.h>

#define COLUMNS 2
#define HEADER 100.0

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

static size_t count_panels(const tradeoff_table *table)
{
    size_t count = 0;
    for (size_t i = 0; i < table->row_count; i++) {
        count += i == 0 || table->rows[i].knob != table->rows[i - 1].knob;
    }
    return count;
}

static void draw_header(const canvas *on, const tradeoff_subject *subject)
{
    static const char *const lines[] = {
        "Left is faster, lower is more exact. Diagonals are those of the box around the mesh.",
        "Filled: no other level is as fast and as exact.",
        "Ringed: the knee. Beyond it, a little more exactness costs much time.",
    };
    char title[300];
    const char *slash = strrchr(subject->name, '/');
    snprintf(title, sizeof title, "What speed costs on %.120s (%.100s)", slash ? slash + 1 : subject->name,
             cli_counted(subject->mesh->face_count, "face").text);
    canvas_text(on, 18, 24, 12, PLOT_BEGIN, PLOT_INK, title);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        canvas_text(on, 18, 46 + 16 * (double)i, PLOT_LETTER - 0.5, PLOT_BEGIN, PLOT_MUTED, lines[i]);
    }
}

static void draw(const canvas *on, const tradeoff_subject *subject, const tradeoff_table *table, double width,
                 double height)
{
    canvas_begin(on, width, height);
    draw_header(on, subject);
    size_t number = 0;
    for (size_t begin = 0, end; begin < table->row_count; begin = end, number++) {
        for (end = begin; end < table->row_count && table->rows[end].knob == table->rows[begin].knob;) {
            end++;
        }
        plot_panel_draw(on, table, begin, end, PLOT_PANEL_WIDTH * (double)(number % COLUMNS),
                        HEADER + PLOT_PANEL_HEIGHT * (double)(number / COLUMNS));
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
    double width = PLOT_PANEL_WIDTH * (double)(columns > 0 ? columns : 1);
    double height = HEADER + PLOT_PANEL_HEIGHT * (double)((panels + COLUMNS - 1) / COLUMNS);
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
