/* The blocks of an OBJ file put together in the order of the file. */
#ifndef MESHTOOL_OBJ_MERGE_H
#define MESHTOOL_OBJ_MERGE_H

#include "formats/mesh/obj_parser.h"

typedef struct mt_obj_reader {
    mt_context *context;
    mt_text *text;
    uint64_t block_count;
    mt_obj_block *blocks; /* what each block of the text holds */
    mt_obj_store *stores; /* per slot of the text */
    unsigned store_count;
    mt_obj_bases *bases;   /* per block; known after mt_obj_count */
    mt_index *first_faces; /* per block */
    mt_index *first_corners;
    mt_obj_limits limits; /* of all blocks together */
    uint64_t face_count, corner_count;
    bool *wrong; /* per block: it has a reference past the counts */
} mt_obj_reader;

/* Numbers the elements of every block. MT_ERROR_TOO_LARGE. */
mt_status mt_obj_count(mt_context *context, mt_obj_reader *reader);

/* Makes relative references absolute; marks the blocks with a reference that is out of range. */
void mt_obj_resolve(mt_context *context, mt_obj_reader *reader);

/* Builds the mesh. Arrays of the blocks are freed as they are copied. */
mt_status mt_obj_merge(mt_context *context, mt_obj_reader *reader, mt_mesh **out);

/* Frees one series of all blocks. */
void mt_obj_release_series(mt_context *context, mt_obj_reader *reader, mt_obj_series series);

/* Parts of the above. */
mt_status mt_obj_merge_elements(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);
mt_status mt_obj_merge_names(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);
mt_status mt_obj_merge_uvs(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);
mt_status mt_obj_merge_normals(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);
mt_status mt_obj_merge_tags(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);
mt_status mt_obj_merge_colors(mt_context *context, mt_obj_reader *reader, mt_mesh *mesh);

/* One sentence for each kind of thing that was let go. */
void mt_obj_warn(mt_context *context, const mt_obj_reader *reader);

#endif
