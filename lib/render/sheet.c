/* A contact sheet: pictures side by side, each with its name. */
#include "lib/render/overlay.h"

#include <stdio.h>
#include <string.h>

/* The order of an engineer's drawing: the front and what is beside it, then the others. */
static const struct {
    mt_view_name view;
    const char *name;
} sides[] = {{MT_VIEW_FRONT, "front"}, {MT_VIEW_RIGHT, "right"}, {MT_VIEW_TOP, "top"},
             {MT_VIEW_BACK, "back"},   {MT_VIEW_LEFT, "left"},   {MT_VIEW_BOTTOM, "bottom"}};

/* Cells as nearly square as they come. */
static void lay_out(unsigned count, uint32_t width, uint32_t height, uint32_t *columns, uint32_t *rows)
{
    double best = INFINITY;
    for (uint32_t n = 1; n <= count; n++) {
        uint32_t m = (count + n - 1) / n;
        double wide = (double)width / n, high = (double)height / m, shape = wide > high ? wide / high : high / wide;
        double score = shape * (1.0 + (double)(n * m - count) / count);
        if (score < best) {
            best = score;
            *columns = n;
            *rows = m;
        }
    }
}

static void paste(const mt_image *cell, mt_image *sheet, uint32_t x, uint32_t y)
{
    for (uint32_t row = 0; row < cell->height; row++) {
        memcpy(mt_image_pixel(sheet, x, y + row), mt_image_pixel(cell, 0, row),
               (size_t)cell->width * cell->channel_count * sizeof(float));
    }
}

static void write_name(const mt_preview_options *options, mt_image *cell, const char *name)
{
    double shorter = cell->width < cell->height ? cell->width : cell->height, height = fmax(7.0, 0.034 * shorter);
    const mt_ink ink = {cell, mt_overlay_color(options), fmax(0.5, height / 14.0)};
    double from_edge = 0.045 * shorter;
    mt_ink_text(&ink, from_edge + 0.5 * mt_ink_text_width(height, name), from_edge + 0.5 * height, height, name);
}

/* A cell of the background alone. */
static mt_status draw_blank(mt_context *context, const mt_preview_series *series, mt_image **out)
{
    const mt_preview_options *options = &series->options;
    bool transparent = options->background == MT_BACKGROUND_TRANSPARENT;
    mt_status status = mt_image_create(context, options->width, options->height, transparent ? 4 : 3, out);
    if (status != MT_OK) {
        return status;
    }
    mt_surface surface;
    mt_surface_init(series->model.mesh, NULL, NULL, &surface);
    mt_backdrop backdrop = mt_backdrop_make(options, &surface);
    (*out)->space = MT_COLOR_LINEAR;
    for (uint32_t y = 0; y < options->height && !transparent; y++) {
        mt_vec3 color = mt_backdrop_at(&backdrop, y, options->height);
        for (uint32_t x = 0; x < options->width; x++) {
            float *pixel = mt_image_pixel(*out, x, y);
            pixel[0] = (float)color.x, pixel[1] = (float)color.y, pixel[2] = (float)color.z;
        }
    }
    return MT_OK;
}

static mt_status draw_cell(mt_context *context, mt_preview_series *series, unsigned number, unsigned turns,
                           mt_image **out)
{
    char name[32];
    double turn = turns > 0 ? 360.0 * number / turns : 0.0;
    mt_view_name view = turns > 0 ? MT_VIEW_DEFAULT : sides[number].view;
    snprintf(name, sizeof name, "%.4g", turn);
    mt_status status = mt_preview_series_draw(context, series, view, turn, out, NULL);
    if (status == MT_OK) {
        write_name(&series->options, *out, turns > 0 ? name : sides[number].name);
    }
    return status;
}

static mt_status draw_cells(mt_context *context, mt_preview_series *series, unsigned turns, mt_image *sheet)
{
    uint32_t columns = 1, rows = 1, x = 0, y = 0;
    unsigned count = turns > 0 ? turns : sizeof sides / sizeof *sides;
    lay_out(count, sheet->width, sheet->height, &columns, &rows);
    mt_status status = MT_OK;
    for (unsigned i = 0; status == MT_OK && i < columns * rows; i++) {
        x = i % columns * sheet->width / columns;
        y = i / columns * sheet->height / rows;
        series->options.width = (i % columns + 1) * sheet->width / columns - x;
        series->options.height = (i / columns + 1) * sheet->height / rows - y;
        mt_image *cell = NULL;
        if (i < count) {
            status = draw_cell(context, series, i, turns, &cell);
        } else {
            status = draw_blank(context, series, &cell);
        }
        if (status == MT_OK) {
            paste(cell, sheet, x, y);
        }
        mt_image_destroy(context, cell);
    }
    return status;
}

mt_status mt_preview_sheet(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, unsigned turns,
                           mt_image **out)
{
    static const mt_preview_options defaults = {0};
    *out = NULL;
    mt_preview_options own = options ? *options : defaults;
    own.turntable = true; /* one size in all */
    mt_preview_series *series = NULL;
    mt_image *sheet = NULL;
    mt_status status = mt_preview_series_create(context, mesh, &own, &series);
    if (status == MT_OK) {
        uint32_t channels = own.background == MT_BACKGROUND_TRANSPARENT ? 4 : 3;
        status = mt_image_create(context, series->options.width, series->options.height, channels, &sheet);
    }
    if (status == MT_OK) {
        sheet->space = MT_COLOR_LINEAR;
        series->shows_sides = turns == 0;
        status = draw_cells(context, series, turns, sheet);
    }
    mt_preview_series_destroy(context, series);
    if (status != MT_OK) {
        mt_image_destroy(context, sheet);
        return status;
    }
    *out = sheet;
    return MT_OK;
}
