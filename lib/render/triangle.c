/* Which tiles a triangle may touch. */
#include "lib/render/triangle.h"

#include "lib/render/raster.h"

mt_tile_range mt_triangle_range(const mt_frame *frame, mt_index triangle)
{
    const mt_tile_range empty = {1, 1, 0, 0};
    const mt_model *model = frame->model;
    if (model->skipped_faces && model->skipped_faces[mt_triangulation_face(&model->triangulation, triangle)]) {
        return empty;
    }
    if (triangle + PREFETCH_DISTANCE < model->triangulation.triangle_count) {
        prefetch_vertices(frame, triangle + PREFETCH_DISTANCE);
    }
    corners c = load_corners(frame, triangle);
    if (c.v[0]->depth == 0 || c.v[1]->depth == 0 || c.v[2]->depth == 0 || !(nearest_depth(&c) > 0)) {
        return empty;
    }
    pixel_box box = is_placed(&c) ? box_of(frame, &c) : mt_crossing_box(frame, triangle);
    return mt_tile_range_of(box.first_x, box.first_y, box.last_x, box.last_y, frame->camera.width,
                            frame->camera.height);
}

void mt_triangle_narrow(const mt_frame *frame, mt_index triangle, uint32_t tile_y, mt_tile_range *row)
{
    triangle_setup s;
    make_setup(frame, triangle, &s);
    double size = MT_TILE_SIZE * (double)MT_STEPS, low = row->first_x, high = row->last_x + 1.0;
    for (int i = 0; i < 3; i++) {
        const edge *e = &s.edges[i];
        /* The edge function is largest at the bottom or the top of the row; from there, where it is 0. */
        double at_zero = e->b * ((tile_y + (e->b > 0)) * size) + e->c + e->doubt;
        double crossing = -at_zero / (e->a * size);
        if (e->a > 0) {
            low = crossing > low ? crossing : low;
        } else if (e->a < 0) {
            high = crossing < high ? crossing : high;
        }
    }
    /* Rounding is far below a pixel, and a tile more does no harm. */
    low -= 1.0 / MT_TILE_SIZE;
    high += 1.0 / MT_TILE_SIZE;
    if (low > high) {
        *row = (mt_tile_range){1, 1, 0, 0};
        return;
    }
    row->first_x = low > row->first_x ? (uint16_t)low : row->first_x;
    row->last_x = high < row->last_x ? (uint16_t)high : row->last_x;
}
