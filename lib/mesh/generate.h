/* What the families of primitives share, and their entries for the table in generate.c. */
#ifndef MT_MESH_GENERATE_H
#define MT_MESH_GENERATE_H

#include <meshtool/generate.h>

/* A mesh written out: xyz triples, and faces as "sides, vertices ..." one after the other. */
typedef struct mt_literal {
    mt_index vertex_count, face_count;
    const double *positions;
    const uint8_t *faces;
} mt_literal;
mt_status mt_generate_literal(mt_context *context, const mt_literal *literal, mt_mesh **out);

/* Point i of n on the unit circle, counter-clockwise from (1, 0): multiples of an eighth turn away from each other
 * mirror each other exactly, and those on the axes lie on them. i may be any number, n > 0. */
typedef struct mt_circle_point {
    double x, y;
} mt_circle_point;
mt_circle_point mt_circle(uint64_t i, uint64_t n);

/* Appends the next face while a mesh with face_offsets is filled in order. */
void mt_generate_face(mt_mesh *mesh, mt_index face, const mt_index *vertices, mt_index sides);

/* A sheet of columns x rows quads over vertices (i, j), i along the columns. Where it wraps, the last line of vertices
 * is the first one; twisted: the last column of vertices is the first one read backwards, which no orientation can
 * follow. Seen with i to the right and j upwards the faces are counter-clockwise. */
typedef struct mt_sheet {
    mt_index columns, rows;
    bool wraps_columns, wraps_rows;
    bool twisted;       /* only where columns wrap */
    mt_index twist_row; /* of a sheet whose rows wrap: row j meets row twist_row - j */
    mt_vec3 (*position)(const struct mt_sheet *sheet, mt_index i, mt_index j);
} mt_sheet;
mt_status mt_generate_sheet(mt_context *context, const mt_sheet *sheet, mt_mesh **out);

/* An extreme by its name without "extreme:". */
mt_status mt_generate_extreme(mt_context *context, const char *name, const mt_generate_options *options, mt_mesh **out);

/* The extremes' shapes, for the table in extremes.c. */
mt_status mt_extreme_sliver(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_flat(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_nearly_flat(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_walls(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_stadium(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_valence(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_pole(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_polygon(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_duplicates(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_centroids(mt_context *context, double magnitude, mt_mesh **out);
mt_status mt_extreme_specks(mt_context *context, double magnitude, mt_mesh **out);

mt_status mt_generate_tetrahedron(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_cube(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_octahedron(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_icosahedron(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_dodecahedron(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_icosphere(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_uv_sphere(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_cylinder(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_cone(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_prism(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_grid(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_torus(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_moebius(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_klein(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_double_torus(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_teapot(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_book(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_bowtie(mt_context *context, mt_index resolution, mt_mesh **out);
mt_status mt_generate_book_bowtie(mt_context *context, mt_index resolution, mt_mesh **out);

#endif
