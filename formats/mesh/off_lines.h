/* Reading OFF as text: what the passes over the lines share with the scanning of a line. */
#ifndef MESHTOOL_OFF_LINES_H
#define MESHTOOL_OFF_LINES_H

#include "formats/mesh/off_parts.h"

typedef struct mt_off_block {
    uint64_t first_line; /* lines of the body before it that say something */
    uint64_t line_count;
    uint64_t first_corner, corner_count;
    mt_index fewest_sides, most_sides; /* of its faces; fewest > most when it has none */
    bool differs;                      /* a face has other sides than the reader's */
    mt_off_colors vertex_colors, face_colors;
} mt_off_block;

typedef struct mt_off_reader {
    mt_context *context;
    mt_text *text;
    mt_off_header header;
    uint64_t block_count;
    mt_off_block *blocks;
    mt_mesh *mesh;
    mt_index sides; /* not 0: of every face, as far as is known */
    double *normals, *uvs;
} mt_off_reader;

/* The sides that a face's line claims, which must fit the line; 0 when they do not. */
mt_index mt_off_scan_sides(const char *at, const char **stop);

/* Scan the line of a vertex or a face into its place; *corner is the place of the face's first corner and moves on.
 * Return a byte of the line past all numbers, NULL after a failure. */
const char *mt_off_scan_vertex(mt_off_reader *reader, mt_text_block *block, const char *line, uint64_t vertex);
const char *mt_off_scan_face(mt_off_reader *reader, mt_text_block *block, const char *line, uint64_t face,
                             mt_index *corner);

#endif
