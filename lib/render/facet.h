/* A visible triangle made ready to be shaded at any of its points. */
#ifndef MESHTOOL_RENDER_FACET_H
#define MESHTOOL_RENDER_FACET_H

#include "lib/render/corner_normals.h"
#include "lib/render/frame.h"
#include "lib/render/shade.h"
#include "lib/render/surface.h"

/* What shading needs of the whole picture. */
typedef struct mt_look {
    const mt_frame *frame;
    const mt_corner_normals *normals;
    mt_surface surface;
    bool has_colors; /* the surface gives some */
    mt_lighting lighting;
    mt_vec3 front_color, back_color; /* of a mesh without colours */
    mt_vec3 back_tint;               /* factor on the mesh's own colours, seen from behind */
    mt_vec3 wire_color;
} mt_look;

typedef struct mt_facet {
    mt_index triangle; /* MT_NONE: nothing yet */
    bool is_small;     /* a pixel or so: `light` is that of all its points, and the rest is not set */
    mt_vec3 light;
    double x, y;         /* of the first corner, in steps of the grid */
    double slopes[2][2]; /* of the second and third barycentric coordinate over the picture */
    double depths[3];
    mt_vec3 normals[3]; /* all on the side that is seen */
    mt_vec3 colors[3];
    bool one_normal, one_color;
} mt_facet;

void mt_look_init(mt_look *look, const mt_frame *frame, const mt_corner_normals *normals,
                  const unsigned char *face_colors, mt_vec3 up);

void mt_facet_prepare(const mt_look *look, mt_index triangle, mt_facet *facet);

/* The light from a facet that is not small, at a point of the picture (in steps) inside it. */
mt_vec3 mt_facet_shade(const mt_look *look, const mt_facet *facet, double x, double y);

/* The light from a dot of a radius in steps, shaded as a small ball. */
mt_vec3 mt_dot_shade(const mt_look *look, mt_index vertex, double radius, double x, double y);

#endif
