/* A picture of any mesh, with no option needed: framed, lit, smooth where smooth, creased where creased, two-sided. */
#ifndef MESHTOOL_PREVIEW_H
#define MESHTOOL_PREVIEW_H

#include <meshtool/image.h>
#include <meshtool/mesh.h>
#include <meshtool/ray.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_background { MT_BACKGROUND_DEFAULT, MT_BACKGROUND_COLOR, MT_BACKGROUND_TRANSPARENT } mt_background;

/* Oblique: the front is drawn as it is, and what is farther away is shifted up and to the right, by as much (cavalier)
 * or half as much (cabinet; also the meaning of plain oblique). */
typedef enum mt_projection {
    MT_PROJECTION_PERSPECTIVE,
    MT_PROJECTION_ORTHOGRAPHIC,
    MT_PROJECTION_CABINET,
    MT_PROJECTION_CAVALIER
} mt_projection;

/* The side from which the mesh is seen; the front is -Y with Z up, +Z with Y up. Default: three quarters from above, or
 * for an oblique projection the front. */
typedef enum mt_view_name {
    MT_VIEW_DEFAULT,
    MT_VIEW_FRONT,
    MT_VIEW_BACK,
    MT_VIEW_LEFT,
    MT_VIEW_RIGHT,
    MT_VIEW_TOP,
    MT_VIEW_BOTTOM,
    MT_VIEW_ISO, /* along the diagonal of the axes, so that all three look equally long */
    MT_VIEW_COUNT
} mt_view_name;

typedef enum mt_shading { MT_SHADING_CREASE, MT_SHADING_FLAT, MT_SHADING_SMOOTH } mt_shading;

/* What colours stand for, instead of the mesh's own. */
typedef enum mt_coloring {
    MT_COLORING_DEFAULT,     /* the mesh's colours, or a neutral one */
    MT_COLORING_NONE,        /* a neutral one, whatever the mesh has */
    MT_COLORING_NORMAL,      /* the normal seen: (x, y, z) from -1..1 to red, green and blue; not lit */
    MT_COLORING_FACE,        /* each face its own */
    MT_COLORING_COMPONENT,   /* each component of faces connected across edges its own */
    MT_COLORING_QUALITY,     /* twice the ratio of the radii of the circles inside and around a triangle, the least of a
                                face's triangles: 1 (blue) for an equilateral one, 0 (red) for one of no area */
    MT_COLORING_DEPTH,       /* light near, dark far; not lit */
    MT_COLORING_ORIENTATION, /* fronts blue, backs red */
    MT_COLORING_COUNT
} mt_coloring;

/* How visibility is found. Both orders give the same picture. */
typedef enum mt_visibility_method {
    MT_METHOD_AUTO, /* raster: no tree pays for primary rays alone */
    MT_METHOD_RASTER,
    MT_METHOD_RAY
} mt_visibility_method;

typedef enum mt_acceleration {
    MT_ACCELERATION_AUTO, /* AABB where there are rays to trace and more than a few triangles */
    MT_ACCELERATION_NONE, /* every ray against every triangle */
    MT_ACCELERATION_AABB, /* and the other structures of meshtool/ray_structure.h: the same picture */
    MT_ACCELERATION_OBB,
    MT_ACCELERATION_GRID,
    MT_ACCELERATION_BSP
} mt_acceleration;

/* The largest picture: pixels on a side. */
#define MT_PREVIEW_MAXIMUM_SIZE 65535

/* For samples: 4 everywhere, and 64 where the face changes together with its normal or its colour. */
#define MT_SAMPLES_ADAPTIVE UINT32_MAX

/* All zeros means the defaults. */
typedef struct mt_preview_options {
    uint32_t width, height;     /* pixels, up to MT_PREVIEW_MAXIMUM_SIZE; 0: 1024 */
    mt_background background;   /* default: a light grey that fades downwards */
    double background_color[3]; /* sRGB, 0 to 1, for MT_BACKGROUND_COLOR */
    double crease_degrees;      /* faces meeting at more than this, up to 180, show an edge; 0: 41, which no regular
                                   solid or prism has, or the normals that the mesh brings when all are finite */
    unsigned samples;           /* per pixel: a square number up to 64, or MT_SAMPLES_ADAPTIVE; 0: 16 */
    const unsigned char *face_colors;  /* sRGB triples, one a face, NULL: the mesh's colours or a neutral one */
    const unsigned char *vertex_marks; /* not 0: the vertex is drawn as a dot; NULL: none */
    const mt_index *edge_marks; /* pairs of vertices drawn as lines over the mesh; what is hidden shows faintly */
    size_t edge_mark_count;
    const unsigned char *vertex_mark_colors; /* sRGB triples, one a vertex (marked or not); NULL: orange */
    const unsigned char *edge_mark_colors;   /* sRGB triples, one a marked edge; NULL: red */

    mt_projection projection;
    mt_view_name view;
    bool has_up, has_eye, has_target;
    double up[3];       /* the direction that points upwards; the mesh's up axis */
    double eye[3];      /* of a parallel projection only its direction from the target counts, unless fov is given */
    double target[3];   /* in the middle of the picture; the middle of the mesh */
    double fov_degrees; /* of the picture's shorter side, below 180; 0: 28, or with an eye what shows all */
    mt_shading shading;
    mt_coloring coloring; /* with face_colors: DEFAULT or NONE */
    bool wireframe;       /* the edges of faces, as lines of one width */
    bool shadows;         /* hard ones, of the main light */
    bool ground;          /* a floor under the mesh */
    bool axes;            /* three arrows in a corner */
    bool scale_bar;       /* a bar with its length in the mesh's units; in perspective true at the target */
    mt_visibility_method method;
    mt_acceleration acceleration;
    mt_ray_profile triangle_test; /* what decides whether a ray hits a triangle */
    bool turntable;               /* pictures turn around the up axis: the mesh has one size in all */
    bool measure_skipped;         /* for mt_context_parts: also build and measure what the picture does without */
    bool count_unseen;            /* find mt_preview_report.unseen_faces */
} mt_preview_options;

/* What a preview found out beside the picture. */
typedef struct mt_preview_report {
    double eye[3],
        target[3];           /* in the mesh's coordinates; target: the point of the view's axis nearest to the middle */
    double scale_bar_length; /* in the mesh's units; 0: none was drawn */
    double units_per_pixel;  /* at the target */
    mt_index
        unseen_faces; /* with count_unseen: faces that no sample shows: hidden, too small, or outside the picture */
} mt_preview_report;

/* Draws the mesh, seen in perspective from three quarters above unless told otherwise; options may be NULL. The up axis
 * is the mesh's. Faces, wires and points are drawn, or every vertex when there is none of these; faces too thin to be
 * seen are outlined. Colours of the mesh are used; the back of a surface is bluish. Faces with a vertex that is not
 * finite are left out, with a warning.
 *
 * The picture is linear, RGBA when transparent and RGB otherwise, and the same bytes for any number of threads.
 * MT_ERROR_INVALID_MESH, with the reason, when there is nothing to see: no finite vertex. MT_ERROR_ARGUMENT for an
 * option out of range. Ownership of *out: the caller's, until mt_image_destroy. */
mt_status mt_preview(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, mt_image **out);

/* The same, with a report. */
mt_status mt_preview_reported(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                              mt_image **out, mt_preview_report *report);

/* Several pictures of one mesh; what does not depend on the view is made once. */
typedef struct mt_preview_series mt_preview_series;

/* The mesh and what the options point to are borrowed until mt_preview_series_destroy. Errors as for mt_preview. */
mt_status mt_preview_series_create(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                                   mt_preview_series **out);
/* Draws one picture: `view` takes the place of the options' unless it is MT_VIEW_DEFAULT, and the eye is turned around
 * the up axis by turn_degrees, to the right. report may be NULL. */
mt_status mt_preview_series_draw(mt_context *context, mt_preview_series *series, mt_view_name view, double turn_degrees,
                                 mt_image **out, mt_preview_report *report);
void mt_preview_series_destroy(mt_context *context, mt_preview_series *series); /* NULL is allowed */

/* A contact sheet: the six views from the sides, or `turns` (2 or more) views around the up axis, with their names. The
 * options' size is that of the sheet. turns 0: six sides. */
mt_status mt_preview_sheet(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options, unsigned turns,
                           mt_image **out);

#ifdef __cplusplus
}
#endif
#endif
