/* A visible triangle made ready to be shaded at any of its points. */
#ifndef MESHTOOL_RENDER_FACET_H
#define MESHTOOL_RENDER_FACET_H

#include "lib/render/look.h"

typedef struct mt_facet {
    mt_index triangle; /* MT_NONE: nothing yet */
    bool is_small;     /* a pixel or so: `light` is that of all its points, and the rest is not set */
    mt_vec3 light;
    /* The corners' weights at a place (in steps) are, but for a common factor, forms[i] . (x - this x, y - this y, 1);
     * in perspective their sum is the depth. */
    double x, y;
    double forms[3][3];
    double depths[3];
    mt_vec3 normals[3]; /* all on the side that is seen */
    mt_vec3 colors[3];
    bool one_normal, one_color;
    mt_vec3 face_normal; /* on the side that is seen, not a unit vector; for shadows alone, as are: */
    mt_vec3 positions[3];
} mt_facet;

void mt_facet_prepare(const mt_look *look, mt_index triangle, mt_facet *facet);

/* The light from a facet that is not small, at a point of the picture (in steps) inside it. lit: the share of the main
 * light that arrives there. */
mt_vec3 mt_facet_shade(const mt_look *look, const mt_facet *facet, double x, double y, double lit);

/* The share of the main light that arrives at the places of a pixel's samples. */
double mt_facet_lit(const mt_look *look, const mt_facet *facet, const mt_sampling *sampling, uint64_t samples,
                    uint32_t x, uint32_t y);

/* The light from a dot of a radius in steps, shaded as a small ball. */
mt_vec3 mt_dot_shade(const mt_look *look, mt_index vertex, double radius, double x, double y);

#endif
