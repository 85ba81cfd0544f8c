/* From primitives sorted into tiles to a finished picture. */
#ifndef MESHTOOL_RENDER_PICTURE_H
#define MESHTOOL_RENDER_PICTURE_H

#include "lib/render/backdrop.h"
#include "lib/render/facet.h"
#include "lib/render/stroke.h"
#include "lib/render/trace.h"

#include <meshtool/image.h>

typedef struct mt_picture {
    const mt_frame *frame;
    const mt_look *look;
    const mt_occluder *rays;          /* what rays find in image order; NULL: the raster finds what is seen */
    mt_stroke_set strokes;            /* of the mesh */
    mt_stroke_set marks;              /* over it; count 0: none */
    const unsigned char *mark_colors; /* sRGB triples, one a mark */
    mt_index faint_mark;              /* marks from here on have this opacity, and do not shine through */
    double faint_opacity;
    unsigned fine_samples; /* where the picture changes within a pixel; 0: as everywhere */
    mt_bins triangle_bins, stroke_bins, mark_bins;
    mt_backdrop backdrop;
    mt_image *image;
    uint64_t covered_samples; /* set by mt_picture_draw: samples that show the mesh */
    uint64_t fine_pixels;     /* likewise: that took fine_samples */
} mt_picture;

/* Sorts everything into tiles, and draws and shades them one by one, many at a time. */
mt_status mt_picture_draw(mt_context *context, mt_picture *picture);

#endif
