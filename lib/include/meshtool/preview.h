/* A picture of any mesh, with no option needed: framed, lit, smooth where smooth, creased where creased, two-sided. */
#ifndef MESHTOOL_PREVIEW_H
#define MESHTOOL_PREVIEW_H

#include <meshtool/image.h>
#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_background { MT_BACKGROUND_DEFAULT, MT_BACKGROUND_COLOR, MT_BACKGROUND_TRANSPARENT } mt_background;

/* The largest picture: pixels on a side. */
#define MT_PREVIEW_MAXIMUM_SIZE 65535

/* All zeros means the defaults. */
typedef struct mt_preview_options {
    uint32_t width, height;     /* pixels, up to MT_PREVIEW_MAXIMUM_SIZE; 0: 1024 */
    mt_background background;   /* default: a light grey that fades downwards */
    double background_color[3]; /* sRGB, 0 to 1, for MT_BACKGROUND_COLOR */
    double crease_degrees;      /* faces meeting at more than this, up to 180, show an edge; 0: 41, which no regular
                                   solid or prism has. Normals that the mesh brings are used instead when all are finite */
    unsigned samples;           /* per pixel: a square number up to 64; 0: 16 */
    const unsigned char *face_colors;  /* sRGB triples, one a face, NULL: the mesh's colours or a neutral one */
    const unsigned char *vertex_marks; /* not 0: the vertex is drawn as a dot; NULL: none */
    const mt_index *edge_marks; /* pairs of vertices drawn as lines over the mesh; what is hidden shows faintly */
    size_t edge_mark_count;
    const unsigned char *vertex_mark_colors; /* sRGB triples, one a vertex (marked or not); NULL: orange */
    const unsigned char *edge_mark_colors;   /* sRGB triples, one a marked edge; NULL: red */
} mt_preview_options;

/* Draws the mesh, seen in perspective from three quarters above; options may be NULL. The up axis is the mesh's.
 * Faces, wires and points are drawn, or every vertex when there is none of these; faces too thin to be seen are
 * outlined. Colours of the mesh are used; the back of a surface is bluish. Faces with a vertex that is not finite are
 * left out, with a warning.
 *
 * The picture is linear, RGBA when transparent and RGB otherwise, and the same bytes for any number of threads.
 * MT_ERROR_INVALID_MESH, with the reason, when there is nothing to see: no finite vertex. MT_ERROR_ARGUMENT for an
 * option out of range. Ownership of *out: the caller's, until mt_image_destroy. */
mt_status mt_preview(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, mt_image **out);

#ifdef __cplusplus
}
#endif
#endif
