/* What colour a mesh's surface has, in linear light. */
#ifndef MESHTOOL_RENDER_SURFACE_H
#define MESHTOOL_RENDER_SURFACE_H

#include <meshtool/mesh.h>

/* A byte k of a colour is entry 4 k exactly; floats fall between. */
#define MT_DECODE_STEPS 1020

typedef struct mt_surface {
    const unsigned char *face_colors; /* the caller's sRGB triples; NULL: none */
    const mt_attribute *colors;       /* the mesh's; NULL: none */
    const mt_index *corner_vertices;
    double per_maximum;
    double decoded[MT_DECODE_STEPS + 1];
} mt_surface;

/* The colours asked for, else those of the mesh `colored` (NULL: none): by corner, vertex or face, in this order. */
void mt_surface_init(const mt_mesh *mesh, const mt_mesh *colored, const unsigned char *face_colors,
                     mt_surface *surface);

/* The colour of a corner of a face, or of a vertex alone (face and corner MT_NONE). False: it has none. */
bool mt_surface_color(const mt_surface *surface, mt_index face, mt_index corner, mt_index vertex, mt_vec3 *color);

/* An sRGB colour, 0 to 1 each, in linear light. */
mt_vec3 mt_linear_color(const mt_surface *surface, double red, double green, double blue);

#endif
