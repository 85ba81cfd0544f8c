/* The faces of a PLY file, gathered record by record when their lists may differ in length. */
#ifndef MESHTOOL_PLY_FACES_H
#define MESHTOOL_PLY_FACES_H

#include "formats/mesh/ply_plan.h"

/* All zeros, but for has_uvs and uv_type, to begin with. */
typedef struct ply_faces {
    mt_index *vertices; /* of the corners so far */
    uint64_t corner_count, corner_room;
    uint64_t record_begin; /* the first corner of the record being read */
    uint64_t sides;        /* not 0: of every face, and the vertices are a part of the mesh's own array */
    bool differs;          /* a face has other sides than that */

    bool has_uvs;
    mt_type uv_type;        /* MT_F32 or MT_F64 */
    uint32_t uv_components; /* 0: no face had any yet */
    char *uv_values;
    uint64_t uv_count, uv_room; /* numbers, not pairs */
    uint64_t uv_begin;          /* the first number of the record being read */
    mt_index *uv_indices;       /* per corner; has the room of the vertices */
    bool some_without_uvs;
} ply_faces;

/* Make room for `count` more corners, or texture coordinates counted in numbers; the caller then fills the arrays from
 * corner_count (uv_count) on and raises it. `expected` is what the room should be in all, if more. False when memory is
 * missing. May be called inside a parallel body. */
bool mt_ply_faces_reserve(mt_context *context, ply_faces *faces, uint64_t count, uint64_t expected);
bool mt_ply_faces_reserve_uvs(mt_context *context, ply_faces *faces, uint64_t count);

/* Ends a record: what was added since the last belongs to one face. NULL, or what is wrong with it. */
const char *mt_ply_faces_end_record(ply_faces *faces);

/* Makes the faces of `count` parts, one after the other, the mesh's, and empties the parts. The caller sees to
 * face_offsets. MT_ERROR_TOO_LARGE, MT_ERROR_OUT_OF_MEMORY, and MT_ERROR_SYNTAX when some have texture coordinates of
 * two numbers and some of three. */
mt_status mt_ply_faces_finish(mt_context *context, ply_faces *parts, size_t count, mt_mesh *mesh);
void mt_ply_faces_release(mt_context *context, ply_faces *faces);

#endif
