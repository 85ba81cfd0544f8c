/* Where the values of a PLY file go: the mesh that its header calls for, and for every property a place in it. */
#ifndef MESHTOOL_PLY_PLAN_H
#define MESHTOOL_PLY_PLAN_H

#include "formats/mesh/ply_header.h"

typedef enum ply_use {
    PLY_SKIP,
    PLY_SCALAR,        /* one number a record, to values + record * stride */
    PLY_FACE_VERTICES, /* the list of a face's vertices */
    PLY_FACE_UVS       /* the list of two (or three) texture coordinates for each side of a face */
} ply_use;

typedef struct ply_target {
    ply_use use;
    mt_type type; /* as it is stored: the file's, or MT_F64 or MT_U32 where those of the file differ */
    char *values;
    size_t stride;
} ply_target;

typedef struct ply_plan {
    ply_header header;
    mt_mesh *mesh;                   /* positions, attributes and wires allocated; face_count set, corners not */
    ply_target **targets;            /* per element its properties' */
    uint32_t vertices, faces, edges; /* the elements' numbers, UINT32_MAX: none */
    bool has_corner_uvs;
    mt_type corner_uv_type;
} ply_plan;

/* Makes the plan for a header, which it takes over, whether it succeeds or not. `body_size` bytes follow the header:
 * counts that they cannot hold are MT_ERROR_SYNTAX before anything is allocated for them. Warns of every property and
 * element that is not kept. On failure *out is empty. */
mt_status mt_ply_plan_make(mt_context *context, const mt_input *input, ply_header *header, uint64_t body_size,
                           ply_plan *out);
/* Frees the plan and the mesh, if it still has it. */
void mt_ply_plan_release(mt_context *context, ply_plan *plan);

/* Whether the element's values go anywhere. */
bool mt_ply_plan_uses(const ply_plan *plan, uint32_t element);

#endif
