/* Google's Draco behind plain functions: arrays in, arrays out. No exception leaves it. It knows no context: memory
 * that Draco is about to take is asked for beforehand, by a function of the caller's. Built without MESHTOOL_DRACO it
 * says so. Bit streams of version 2.2 (meshes) and 2.2 to 2.3 (points) are read, 2.2 and 2.3 are written. */
#ifndef MESHTOOL_CODEC_DRACO_H
#define MESHTOOL_CODEC_DRACO_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_draco_result {
    MT_DRACO_OK,
    MT_DRACO_WRONG,     /* the bytes break the format's rules, or end too early */
    MT_DRACO_VERSION,   /* a version or kind of stream that is not read */
    MT_DRACO_TOO_LARGE, /* the counts are more than the bytes can justify */
    MT_DRACO_REFUSED,   /* the caller's hold function said no */
    MT_DRACO_NO_MEMORY, /* Draco ran out of memory */
    MT_DRACO_MISSING    /* built without Draco */
} mt_draco_result;

typedef enum mt_draco_kind {
    MT_DRACO_POSITION,
    MT_DRACO_NORMAL,
    MT_DRACO_COLOR,
    MT_DRACO_UV,
    MT_DRACO_GENERIC
} mt_draco_kind;

typedef struct mt_draco_attribute {
    mt_draco_kind kind;
    mt_type type;
    unsigned component_count;
    bool normalized;
    unsigned bits;      /* when encoding floats: quantised to so many, 1 to 30; 0, or where their extent is beyond what
                           floats can divide by: as they are */
    uint32_t id;        /* by which containers name it; when encoding its place among the attributes */
    const void *values; /* when encoding: vertex_count * component_count numbers; decoded: NULL */
} mt_draco_attribute;

typedef struct mt_draco_source {
    mt_index vertex_count, triangle_count;
    const mt_index *triangles; /* 3 a triangle; NULL: points alone */
    const mt_draco_attribute *attributes;
    size_t attribute_count;
    unsigned speed;  /* 0 (smallest) to 10 (fastest) */
    bool sequential; /* keeps the order, and every vertex; else edgebreaker */
} mt_draco_source;

typedef struct mt_draco_bytes {
    void *bytes; /* of the allocate function */
    size_t size;
    mt_index vertex_count, triangle_count; /* that it decodes to */
} mt_draco_bytes;

/* A sentence about the last failure, for people. */
#define MT_DRACO_MESSAGE 160

/* Asks whether so many bytes may be taken. */
typedef bool (*mt_draco_hold)(void *user, uint64_t bytes);
typedef void *(*mt_draco_allocate)(void *user, uint64_t size);

/* Encodes. hold is asked once for what Draco may take at most; allocate is asked for the result. */
mt_draco_result mt_draco_encode(const mt_draco_source *source, mt_draco_hold hold, mt_draco_allocate allocate,
                                void *user, mt_draco_bytes *out, char message[MT_DRACO_MESSAGE]);

typedef struct mt_draco_mesh mt_draco_mesh;

/* Decodes. Counts are checked against the number of bytes, and hold is asked, before Draco allocates by them. *consumed
 * (may be NULL) receives the bytes that were read. *out is NULL on failure. */
mt_draco_result mt_draco_decode(const void *bytes, size_t size, mt_draco_hold hold, void *user, mt_draco_mesh **out,
                                size_t *consumed, char message[MT_DRACO_MESSAGE]);
void mt_draco_destroy(mt_draco_mesh *mesh); /* NULL is allowed */

mt_index mt_draco_vertex_count(const mt_draco_mesh *mesh);
mt_index mt_draco_triangle_count(const mt_draco_mesh *mesh);
size_t mt_draco_attribute_count(const mt_draco_mesh *mesh);
/* false: its type is none of ours (64-bit integers). */
bool mt_draco_attribute_at(const mt_draco_mesh *mesh, size_t number, mt_draco_attribute *out);
/* vertex_count * component_count numbers, in the machine's byte order; false when a vertex has a value that is not
 * there. */
bool mt_draco_copy_values(const mt_draco_mesh *mesh, size_t number, void *out);
/* 3 * triangle_count vertices; false when one is past the count. */
bool mt_draco_copy_triangles(const mt_draco_mesh *mesh, mt_index *out);

#ifdef __cplusplus
}
#endif
#endif
