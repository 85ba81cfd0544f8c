/* The header of a PLY file: its encoding, and the elements and properties that it declares. */
#ifndef MESHTOOL_PLY_HEADER_H
#define MESHTOOL_PLY_HEADER_H

#include "formats/stream/input.h"

#define PLY_MAX_PROPERTIES 1024u /* of one element; beyond it a header is refused */

typedef enum ply_encoding { PLY_ASCII, PLY_LITTLE, PLY_BIG } ply_encoding;

typedef struct ply_property {
    char *name;
    mt_type type; /* of the number, or of a list's items */
    bool is_list;
    mt_type count_type; /* of a list's length */
} ply_property;

typedef struct ply_element {
    char *name;
    uint64_t count;
    uint64_t line; /* where it is declared */
    uint32_t property_count;
    ply_property *properties;
} ply_element;

typedef struct ply_header {
    ply_encoding encoding;
    uint32_t element_count;
    ply_element *elements;
    uint64_t body_offset; /* in bytes */
    uint64_t body_line;   /* the number of the body's first line */
} ply_header;

/* Reads the header from the start of the input and leaves the input at the body. Line ends may be LF, CRLF or CR,
 * as the first line has it. MT_ERROR_SYNTAX with the line. On failure *out is empty. */
mt_status mt_ply_header_read(mt_context *context, mt_input *input, ply_header *out);
void mt_ply_header_release(mt_context *context, ply_header *header);

/* The number of the property of that name, UINT32_MAX when there is none. */
uint32_t mt_ply_find_property(const ply_element *element, const char *name);

/* The fewest bytes that a record of the element can take in a file of that encoding. */
uint64_t mt_ply_smallest_record(const ply_element *element, ply_encoding encoding);

/* The names that PLY gives to a type: "uchar", "int", "float". */
const char *mt_ply_type_name(mt_type type);

#endif
