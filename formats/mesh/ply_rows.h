/* Records of a binary PLY element that all have the same layout, read in parallel blocks. */
#ifndef MESHTOOL_PLY_ROWS_H
#define MESHTOOL_PLY_ROWS_H

#include "formats/mesh/ply_plan.h"

#define PLY_ROW_MAX 8192 /* bytes of a record that is read in this way */

/* A number's place in the record, and where it goes. */
typedef struct ply_column {
    size_t offset;
    mt_type from;
    ply_target target;
} ply_column;

/* A list's length as the file's bytes have it; every record must repeat it. */
typedef struct ply_length {
    size_t offset;
    size_t size;
    uint8_t bytes[4];
} ply_length;

typedef struct ply_rows {
    uint64_t offset; /* of the first record in the file */
    uint64_t count;
    size_t size; /* bytes of a record */
    bool swap;   /* the file's byte order is not the machine's */
    uint32_t column_count, length_count;
    ply_column *columns;
    ply_length *lengths;
    const mt_index *indices; /* what some columns fill with vertex numbers, index_count a record; NULL: none do */
    uint32_t index_count;
    mt_index index_limit; /* they must be below it */
} ply_rows;

/* Whether all records were read; false: some list has another length, and the values stored are of no use. An index
 * out of range is not looked for in the order of the file: *bad_row receives the first record with one, UINT64_MAX
 * when there is none. */
mt_status mt_ply_rows_read(mt_context *context, const mt_input *input, const ply_rows *rows, bool *uniform,
                           uint64_t *bad_row);

/* One number from a file, in the other byte order when `swap`. Exact: PLY has no 64-bit whole numbers. */
double mt_ply_load(const uint8_t *bytes, mt_type type, bool swap);

/* Stores a number as a target has it: as MT_U32 whole numbers modulo 2^32, so that negative ones are out of range. */
void mt_ply_store(double number, mt_type type, void *value);

#endif
