/* What shading needs of the whole picture. */
#ifndef MESHTOOL_RENDER_LOOK_H
#define MESHTOOL_RENDER_LOOK_H

#include "lib/render/corner_normals.h"
#include "lib/render/frame.h"
#include "lib/render/shade.h"
#include "lib/render/surface.h"
#include "lib/render/trace.h"

/* Light comes from lamps, or a value is shown as it is. */
typedef enum mt_paint { MT_PAINT_LIT, MT_PAINT_NORMAL, MT_PAINT_DEPTH } mt_paint;

/* A plane at right angles to `up`; points p of it have p . up = level. */
typedef struct mt_ground {
    bool is_drawn;
    mt_vec3 up, color;
    double level, radius; /* radius: of the mesh's bounds */
} mt_ground;

typedef struct mt_look {
    const mt_frame *frame;
    const mt_corner_normals *normals;
    const mt_occluder *shadows; /* what the main light does not pass; NULL: no shadows */
    mt_surface surface;
    mt_paint paint;
    bool has_colors; /* the surface gives some */
    mt_lighting lighting;
    mt_vec3 front_color, back_color; /* of a mesh without colours */
    mt_vec3 back_tint;               /* factor on the mesh's own colours, seen from behind */
    mt_vec3 wire_color;
    mt_ground ground;
    unsigned char *seen;      /* one a face, set to 1 where a sample shows it; NULL: nobody asks */
    double nearest, farthest; /* distances along the view, for MT_PAINT_DEPTH */
} mt_look;

void mt_look_init(mt_look *look, const mt_frame *frame, const mt_corner_normals *normals, const mt_mesh *colored,
                  const unsigned char *face_colors, mt_vec3 up);

/* A point of a surface, ready to be shaded. */
typedef struct mt_shading_point {
    mt_vec3 normal, toward_eye, color;
    double depth; /* for MT_PAINT_DEPTH */
    double lit;   /* share of the main light */
} mt_shading_point;

/* The one routine that says what light comes from a point of the mesh. */
mt_vec3 mt_look_light(const mt_look *look, const mt_shading_point *point);

#endif
