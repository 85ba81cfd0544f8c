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
    if (!(c.v[0]->depth > 0 && c.v[1]->depth > 0 && c.v[2]->depth > 0) || doubled_area(&c) == 0) {
        return empty;
    }
    pixel_box box = box_of(frame, &c);
    return mt_tile_range_of(box.first_x, box.first_y, box.last_x, box.last_y, frame->camera.width,
                            frame->camera.height);
}

bool mt_triangle_touches(const mt_frame *frame, mt_index triangle, uint32_t tile_x, uint32_t tile_y)
{
    corners c = load_corners(frame, triangle);
    edge edges[3];
    make_edges(&c, edges);
    for (int i = 0; i < 3; i++) {
        int64_t x = tile_x + (edges[i].a > 0), y = tile_y + (edges[i].b > 0);
        if (edge_at(&edges[i], x * MT_TILE_SIZE * MT_STEPS, y * MT_TILE_SIZE * MT_STEPS) < 0) {
            return false;
        }
    }
    return true;
}
