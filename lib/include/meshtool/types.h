/* The scalar types, limits and status codes that every other header speaks of. */
#ifndef MESHTOOL_TYPES_H
#define MESHTOOL_TYPES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Number of a vertex, face, corner, edge or half-edge. Counts are computed in 64 bits and checked
 * against MT_INDEX_MAX before anything is allocated. */
typedef uint32_t mt_index;

/* "No such element": no face on this side, no value for this corner, no twin. */
#define MT_NONE UINT32_MAX

/* The largest count of any kind of element; one less than MT_NONE so that every index is valid. */
#define MT_INDEX_MAX (UINT32_MAX - 1u)

/* What a function that can fail returns. The sentence that goes with it stands in the context. */
typedef enum mt_status {
    MT_OK = 0,
    MT_ERROR_ARGUMENT,      /* an option's value is outside its range */
    MT_ERROR_SYNTAX,        /* a file's bytes break the rules of its format */
    MT_ERROR_UNSUPPORTED,   /* well-formed, but a variant that is not read or cannot be written */
    MT_ERROR_INVALID_MESH,  /* a mesh that the operation cannot take: empty, not finite, out of range */
    MT_ERROR_NOT_MANIFOLD,  /* a builder met an edge or vertex that it cannot hold */
    MT_ERROR_NOT_ORIENTED,  /* a builder met two faces that run along an edge in the same direction */
    MT_ERROR_LOSS,          /* the target cannot hold what the mesh has, and loss was forbidden */
    MT_ERROR_IO,            /* opening, reading, writing or renaming failed */
    MT_ERROR_OUT_OF_MEMORY, /* the allocator or the context's memory limit said no */
    MT_ERROR_TOO_LARGE,     /* a count or size past what an index or a limit can hold */
    MT_ERROR_CANCELLED,     /* the progress callback asked to stop */
    MT_ERROR_INTERNAL       /* a defect in meshtool */
} mt_status;

/* Type of a stored number. */
typedef enum mt_type { MT_U8, MT_I8, MT_U16, MT_I16, MT_U32, MT_I32, MT_F32, MT_F64 } mt_type;

/* Bytes of one number of the type: 1, 2, 4 or 8. */
static inline size_t mt_type_size(mt_type type)
{
    static const uint8_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

#ifdef __cplusplus
}
#endif
#endif
