#include "formats/mesh/ply_rows.h"

#include <meshtool/checked.h>

#include <stdatomic.h>
#include <string.h>

#define BLOCK_SIZE ((size_t)64 << 10) /* bytes of a block, small enough to stay in the cache between its passes */

enum { ROWS_READ, ROWS_DIFFER, ROWS_UNREADABLE, ROWS_OUT_OF_RANGE };

typedef struct rows_job {
    const mt_input *input;
    const ply_rows *rows;
    uint64_t rows_per_block;
    uint8_t *outcomes; /* per block */
    atomic_bool stop;  /* some block differs: the others need not be read */
} rows_job;

static void swap_number(uint8_t *bytes, size_t size)
{
    for (size_t i = 0; i < size / 2; i++) {
        uint8_t byte = bytes[i];
        bytes[i] = bytes[size - 1 - i];
        bytes[size - 1 - i] = byte;
    }
}

double mt_ply_load(const uint8_t *bytes, mt_type type, bool swap)
{
    union {
        uint8_t bytes[8];
        int8_t i8;
        uint16_t u16;
        int16_t i16;
        uint32_t u32;
        int32_t i32;
        float f32;
        double f64;
    } number;
    size_t size = mt_type_size(type);
    memcpy(number.bytes, bytes, size);
    if (swap) {
        swap_number(number.bytes, size);
    }
    switch (type) {
    case MT_U8:
        return number.bytes[0];
    case MT_I8:
        return number.i8;
    case MT_U16:
        return number.u16;
    case MT_I16:
        return number.i16;
    case MT_U32:
        return number.u32;
    case MT_I32:
        return number.i32;
    case MT_F32:
        return (double)number.f32;
    case MT_F64:
        break;
    }
    return number.f64;
}

void mt_ply_store(double number, mt_type type, void *value)
{
    if (type == MT_F64) {
        memcpy(value, &number, sizeof number);
    } else if (type == MT_F32) {
        float narrow = (float)number;
        memcpy(value, &narrow, sizeof narrow);
    } else {
        uint32_t whole = (uint32_t)(int64_t)number;
        memcpy(value, &whole, mt_type_size(type)); /* the low bytes come first */
    }
}

static inline void copy_column(const uint8_t *from, size_t from_stride, char *to, size_t to_stride, size_t count,
                               size_t size)
{
    for (size_t i = 0; i < count; i++) {
        memcpy(to + i * to_stride, from + i * from_stride, size);
    }
}

static inline void swap_column(const uint8_t *from, size_t from_stride, char *to, size_t to_stride, size_t count,
                               size_t size)
{
    for (size_t i = 0; i < count; i++) {
        uint8_t number[8];
        memcpy(number, from + i * from_stride, size);
        swap_number(number, size);
        memcpy(to + i * to_stride, number, size);
    }
}

/* The size is a constant in each case, so that the loops move whole words. */
static void move_column(const uint8_t *from, size_t from_stride, char *to, size_t to_stride, size_t count, size_t size,
                        bool swap)
{
    switch (size) {
    case 1:
        copy_column(from, from_stride, to, to_stride, count, 1);
        break;
    case 2:
        swap ? swap_column(from, from_stride, to, to_stride, count, 2)
             : copy_column(from, from_stride, to, to_stride, count, 2);
        break;
    case 4:
        swap ? swap_column(from, from_stride, to, to_stride, count, 4)
             : copy_column(from, from_stride, to, to_stride, count, 4);
        break;
    default:
        swap ? swap_column(from, from_stride, to, to_stride, count, 8)
             : copy_column(from, from_stride, to, to_stride, count, 8);
        break;
    }
}

static void convert_column(const ply_rows *rows, const ply_column *column, const uint8_t *bytes, uint64_t first,
                           size_t count)
{
    const ply_target *target = &column->target;
    const uint8_t *from = bytes + column->offset;
    char *to = target->values + first * target->stride;
    bool same = column->from == target->type || (column->from == MT_I32 && target->type == MT_U32);
    if (same) {
        move_column(from, rows->size, to, target->stride, count, mt_type_size(column->from), rows->swap);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        mt_ply_store(mt_ply_load(from + i * rows->size, column->from, rows->swap), target->type,
                     to + i * target->stride);
    }
}

static bool lengths_agree(const ply_rows *rows, const uint8_t *bytes, size_t count)
{
    for (uint32_t i = 0; i < rows->length_count; i++) {
        const ply_length *length = &rows->lengths[i];
        unsigned difference = 0;
        for (size_t row = 0; row < count; row++) {
            const uint8_t *at = bytes + row * rows->size + length->offset;
            for (size_t j = 0; j < length->size; j++) {
                difference |= (unsigned)(at[j] ^ length->bytes[j]);
            }
        }
        if (difference) {
            return false;
        }
    }
    return true;
}

static bool indices_fit(const ply_rows *rows, uint64_t begin, uint64_t end)
{
    mt_index largest = 0;
    for (uint64_t i = begin * rows->index_count; i < end * rows->index_count; i++) {
        largest = rows->indices[i] > largest ? rows->indices[i] : largest;
    }
    return largest < rows->index_limit;
}

static void read_block(void *user, uint64_t begin, uint64_t end)
{
    rows_job *job = user;
    const ply_rows *rows = job->rows;
    uint8_t bytes[BLOCK_SIZE];
    size_t count = (size_t)(end - begin), size = count * rows->size;
    uint8_t *outcome = &job->outcomes[begin / job->rows_per_block];
    *outcome = ROWS_DIFFER;
    if (atomic_load_explicit(&job->stop, memory_order_relaxed)) {
        return;
    }
    if (mt_input_read_at(job->input, rows->offset + begin * rows->size, bytes, size) != size) {
        *outcome = ROWS_UNREADABLE;
        return;
    }
    if (!lengths_agree(rows, bytes, count)) {
        atomic_store_explicit(&job->stop, true, memory_order_relaxed);
        return;
    }
    for (uint32_t i = 0; i < rows->column_count; i++) {
        convert_column(rows, &rows->columns[i], bytes, begin, count);
    }
    *outcome = rows->indices && !indices_fit(rows, begin, end) ? ROWS_OUT_OF_RANGE : ROWS_READ;
}

static uint64_t first_bad_row(const ply_rows *rows, uint64_t from)
{
    while (from < rows->count && indices_fit(rows, from, from + 1)) {
        from++;
    }
    return from;
}

/* The outcome of the earliest block counts, except that one that differs makes all the others void. */
static mt_status judge_blocks(mt_context *context, const rows_job *job, uint64_t block_count, bool *uniform,
                              uint64_t *bad_row)
{
    *uniform = !atomic_load(&job->stop);
    for (uint64_t block = 0; *uniform && block < block_count; block++) {
        uint64_t row = block * job->rows_per_block;
        if (job->outcomes[block] == ROWS_UNREADABLE) {
            return mt_input_fail_read_at(context, job->input, job->rows->offset + row * job->rows->size);
        }
        if (job->outcomes[block] == ROWS_OUT_OF_RANGE) {
            *bad_row = first_bad_row(job->rows, row);
            break;
        }
    }
    return MT_OK;
}

mt_status mt_ply_rows_read(mt_context *context, const mt_input *input, const ply_rows *rows, bool *uniform,
                           uint64_t *bad_row)
{
    rows_job job = {.input = input, .rows = rows};
    *uniform = true;
    *bad_row = UINT64_MAX;
    if (rows->count == 0 || rows->size == 0) {
        return MT_OK;
    }
    job.rows_per_block = BLOCK_SIZE / rows->size; /* at least 8 */
    uint64_t block_count = (rows->count - 1) / job.rows_per_block + 1;
    job.outcomes = mt_allocate(context, block_count);
    if (!job.outcomes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, rows->count, job.rows_per_block, read_block, &job);
    mt_status status = judge_blocks(context, &job, block_count, uniform, bad_row);
    mt_free(context, job.outcomes);
    return status;
}
