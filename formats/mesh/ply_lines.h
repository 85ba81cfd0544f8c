/* One line of an ASCII PLY file: one record of one element. */
#ifndef MESHTOOL_PLY_LINES_H
#define MESHTOOL_PLY_LINES_H

#include "formats/mesh/ply_faces.h"
#include "formats/stream/text.h"

typedef struct ply_line {
    mt_context *context;
    const ply_plan *plan;
    mt_text_block *block;
    ply_faces *faces;    /* of the block */
    uint64_t face_count; /* that the block holds */
    mt_index *overflows; /* numbers that became infinite as float, counted */
    uint32_t element;
    uint64_t record;
    const char *at;
} ply_line;

/* Reads the record that begins at line->at into its places, and a face also into `faces`; face_offsets then ends where
 * the face ends in `faces`, unless all have the same sides. Leaves line->at in the line. False: mt_text_fail was
 * called. May be called inside a parallel body. */
bool mt_ply_read_line(ply_line *line);

#endif
