/* The two ways to read the body of a PLY file into the mesh of its plan. The input stands at the body, and its bytes
 * can be read at. */
#ifndef MESHTOOL_PLY_BODY_H
#define MESHTOOL_PLY_BODY_H

#include "formats/mesh/ply_plan.h"

mt_status mt_ply_read_binary(mt_context *context, mt_input *input, ply_plan *plan);
mt_status mt_ply_read_ascii(mt_context *context, mt_input *input, ply_plan *plan);

/* Vertex numbers of a type must lie below this: those of signed types that are negative look larger. */
mt_index mt_ply_index_limit(const ply_plan *plan, mt_type type);

/* A vertex number as the file has it, given as it is stored. */
static inline int64_t mt_ply_shown_index(mt_index index, mt_type type)
{
    bool is_signed = type == MT_I8 || type == MT_I16 || type == MT_I32;
    return is_signed ? (int64_t)(int32_t)index : (int64_t)index;
}

#endif
