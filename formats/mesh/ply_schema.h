/* What a mesh is written as in PLY: the elements and properties, and where their values come from. */
#ifndef MESHTOOL_PLY_SCHEMA_H
#define MESHTOOL_PLY_SCHEMA_H

#include <meshtool/mesh.h>

typedef enum ply_source {
    PLY_FROM_VALUES,   /* the number at values + value * stride, where value is the record's own number or its index */
    PLY_FROM_FACE,     /* the list of a face's vertices */
    PLY_FROM_FACE_UVS, /* the list of its corners' texture coordinates */
    PLY_FROM_WIRE      /* the number at values + wire vertex * stride */
} ply_source;

typedef struct ply_field {
    ply_source source;
    char *name;
    mt_type type;
    mt_type count_type; /* of lists */
    bool is_position;
    const char *values;
    size_t stride;
    const mt_index *indices;       /* per record its value, MT_NONE: none; NULL: its own */
    const mt_attribute *attribute; /* of texture coordinates */
} ply_field;

typedef struct ply_fields {
    const char *element;
    uint64_t record_count;
    uint32_t field_count, field_room;
    ply_field *fields;
} ply_fields;

typedef struct ply_schema {
    ply_fields vertices, faces, edges;
} ply_schema;

/* The mesh must outlive the schema. Warns of what is renamed. On failure *out is empty. */
mt_status mt_ply_schema_make(mt_context *context, const mt_mesh *mesh, ply_schema *out);
void mt_ply_schema_release(mt_context *context, ply_schema *schema);

#endif
