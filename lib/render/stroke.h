/* Lines and dots: wires, points, and marks laid over the mesh. Their width is in pixels, whatever the mesh's size. */
#ifndef MESHTOOL_RENDER_STROKE_H
#define MESHTOOL_RENDER_STROKE_H

#include "lib/render/tile.h"

typedef struct mt_stroke_set {
    const mt_frame *frame;
    const mt_stroke *strokes;
    mt_index count;
    double line_radius;  /* pixels; half a line's width */
    mt_index thin_first; /* lines from here on have the other radius; MT_NONE: none */
    double thin_radius;
    double dot_radius; /* pixels */
    double nearness;   /* factor on depth, a little over 1, so that lines on a surface are not half buried */
} mt_stroke_set;

/* For mt_bins_init. */
mt_tile_range mt_stroke_range(const mt_stroke_set *set, mt_index stroke);
void mt_stroke_narrow(const mt_stroke_set *set, mt_index stroke, uint32_t tile_y, mt_tile_range *row);

/* Draws strokes among the triangles; in the tile they are called first_number + their own number. */
void mt_draw_strokes(const mt_stroke_set *set, mt_tile *tile, const mt_index *numbers, size_t count,
                     mt_index first_number);

/* Lays strokes over the finished tile, into tile->marks: a visible one wins over a hidden one, then the first. */
void mt_draw_marks(const mt_stroke_set *set, mt_tile *tile, const mt_index *strokes, size_t count);

#endif
