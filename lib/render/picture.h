/* From primitives sorted into tiles to a finished picture. */
#ifndef MESHTOOL_RENDER_PICTURE_H
#define MESHTOOL_RENDER_PICTURE_H

#include "lib/render/facet.h"
#include "lib/render/stroke.h"

#include <meshtool/image.h>

/* Linear light from behind the mesh; transparent: none, and the picture has alpha. */
typedef struct mt_backdrop {
    mt_vec3 top, bottom;
    bool transparent;
} mt_backdrop;

typedef struct mt_picture {
    const mt_frame *frame;
    const mt_look *look;
    mt_stroke_set strokes;            /* of the mesh */
    mt_stroke_set marks;              /* over it; count 0: none */
    const unsigned char *mark_colors; /* sRGB triples, one a mark */
    mt_bins bins;                     /* triangles, then strokes */
    mt_bins mark_bins;
    mt_backdrop backdrop;
    mt_image *image;
    uint64_t covered_samples; /* set by mt_picture_draw: samples that show the mesh */
} mt_picture;

/* Sorts everything into tiles, and draws and shades them one by one, many at a time. */
mt_status mt_picture_draw(mt_context *context, mt_picture *picture);

#endif
