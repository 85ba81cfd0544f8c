/* What the files of lib/base know of the context and others do not. */
#ifndef MT_BASE_CONTEXT_H
#define MT_BASE_CONTEXT_H

#include <meshtool/context.h>

#include <stdatomic.h>

#define MT_PART_CAPACITY 64 /* parts of one operation; more are not recorded */

struct mt_context {
    mt_context_options options;
    unsigned thread_count;
    atomic_uint_fast64_t bytes;
    atomic_uint_fast64_t peak_bytes;
    atomic_uint_fast64_t allocation_count;
    mt_error error;
    char error_file[512];
    mt_part parts[MT_PART_CAPACITY];
    double part_begins[MT_PART_CAPACITY]; /* milliseconds */
    uint64_t part_bytes[MT_PART_CAPACITY];
    size_t part_count;
    uint64_t parts_left_out;
    int measured_part; /* 1 + the token of a skipped part that is being measured: what it is made of is not recorded */
};

/* CPUs that this process may use, at least 1. */
unsigned mt_available_threads(void);

#endif
