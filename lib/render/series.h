/* What the pictures of one mesh share. */
#ifndef MESHTOOL_RENDER_SERIES_H
#define MESHTOOL_RENDER_SERIES_H

#include "lib/render/framing.h"
#include "lib/render/marks.h"
#include "lib/render/picture.h"
#include "lib/render/view.h"

/* The extent and the distance at which a mesh on a turntable stays inside the picture. */
typedef struct mt_steady {
    bool is_set;
    double distance, half_width, half_height;
} mt_steady;

struct mt_preview_series {
    mt_preview_options options;
    unsigned samples, fine_samples;
    mt_model model;
    mt_corner_normals normals;
    unsigned char *face_colors; /* made by the colouring; NULL: the options' */
    mt_marks marks;
    bool by_rays;
    bool has_occluder;
    mt_occluder occluder;
    mt_steady steady; /* for a turntable, or for the six sides of a sheet */
    bool shows_sides;
};

/* MT_ERROR_ARGUMENT for an option out of its range. */
mt_status mt_preview_check(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options);

/* The camera of one picture: view and turn as in mt_preview_series_draw. */
mt_status mt_series_camera(mt_context *context, mt_preview_series *series, mt_view_name view, double turn_degrees,
                           mt_camera *camera, mt_view *seen);

#endif
