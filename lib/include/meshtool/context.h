/* The context: allocator with a limit, thread count, progress and cancellation, the last error,
 * warnings, and the record of what was built and skipped (--explain).
 *
 * A function that takes a context may fail, allocate, run in parallel or be cancelled; one that
 * takes none can do none of these. A context serves one calling thread at a time; two contexts
 * never share anything. There is no global state. */
#ifndef MESHTOOL_CONTEXT_H
#define MESHTOOL_CONTEXT_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(__GNUC__)
#define MT_PRINTF(format_at, first_at) __attribute__((format(printf, format_at, first_at)))
#else
#define MT_PRINTF(format_at, first_at)
#endif

typedef struct mt_context mt_context;

/* Called with a share of the work done, 0 to 1, and the name of the task. Return false to cancel:
 * the running operation then returns MT_ERROR_CANCELLED and leaves nothing behind. */
typedef bool (*mt_progress_function)(void *user, const char *task, double fraction);

/* Called once for each warning, with one sentence without a line end. */
typedef void (*mt_warning_function)(void *user, const char *sentence);

/* All zeros means the defaults. */
typedef struct mt_context_options {
    unsigned thread_count;       /* 0: the CPUs that this process may use */
    uint64_t memory_limit;       /* bytes that may be held at once; 0: no limit */
    uint64_t failing_allocation; /* for tests: the n-th allocation (1-based) and later ones fail; 0: none */
    bool explain;                /* keep the record that mt_context_parts returns */
    mt_progress_function progress;
    void *progress_user;
    mt_warning_function warning;
    void *warning_user;
} mt_context_options;

/* Where an error lies. Zero fields are unknown. */
typedef struct mt_place {
    const char *file; /* as the user named it; copied by mt_fail_at; may be NULL */
    uint64_t line;    /* 1-based */
    uint64_t column;  /* 1-based, in bytes */
    uint64_t offset;  /* byte offset, when has_offset */
    bool has_offset;
} mt_place;

/* The first failure since mt_context_clear_error. */
typedef struct mt_error {
    mt_status status;
    char message[1024]; /* "FILE:LINE: sentence", "FILE@OFFSET: sentence", or the sentence alone */
    mt_place place;     /* place.file points into the context */
} mt_error;

/* Makes a context. options may be NULL. Returns NULL only when memory for it is missing.
 * Ownership: the caller's, until mt_context_destroy. */
mt_context *mt_context_create(const mt_context_options *options);

/* Frees the context; every object made with it must have been destroyed before. NULL is allowed. */
void mt_context_destroy(mt_context *context);

/* The first failure, status MT_OK if there was none. Valid until the context is destroyed. */
const mt_error *mt_context_error(const mt_context *context);

/* Forgets the last failure, so that the next one is kept. */
void mt_context_clear_error(mt_context *context);

/* Threads that parallel loops use, at least 1. */
unsigned mt_context_thread_count(const mt_context *context);

/* Bytes held now, and the most that were held at once since the context was made. */
uint64_t mt_context_bytes(const mt_context *context);
uint64_t mt_context_peak_bytes(const mt_context *context);

/* Allocations asked for since the context was made, failed ones included. */
uint64_t mt_context_allocation_count(const mt_context *context);

/* Records a failure and returns status; the first one wins, later ones change nothing. The format
 * gives one sentence: what is wrong, where, what was expected. Not for use inside a parallel body:
 * there, keep the failure in the block's own slot and report the first after the loop. */
mt_status mt_fail(mt_context *context, mt_status status, const char *format, ...) MT_PRINTF(3, 4);
mt_status mt_fail_at(mt_context *context, mt_status status, mt_place place, const char *format, ...) MT_PRINTF(4, 5);

/* Sends one sentence to the warning callback, if there is one. Not inside a parallel body. */
void mt_warn(mt_context *context, const char *format, ...) MT_PRINTF(2, 3);

/* Memory. Sizes are counted against the limit. A size of 0 gives a valid block. Blocks of 1 MB
 * and more begin on a 2 MB page and are advised to huge pages: fresh 4 KB pages cost more than the
 * algorithms that fill them. All blocks are aligned to 64 bytes. Free with mt_free, with the same
 * context. mt_allocate and its kin record MT_ERROR_OUT_OF_MEMORY and return NULL on failure;
 * mt_try_allocate only returns NULL, and may be called inside a parallel body, as may mt_free. */
void *mt_allocate(mt_context *context, uint64_t size);
void *mt_allocate_zeroed(mt_context *context, uint64_t size);
/* count * size bytes; a product past 64 bits is MT_ERROR_TOO_LARGE. */
void *mt_allocate_array(mt_context *context, uint64_t count, size_t size);
void *mt_allocate_array_zeroed(mt_context *context, uint64_t count, size_t size);
/* Grows or shrinks a block (NULL: allocates). On failure the old block is kept and NULL returned. */
void *mt_reallocate(mt_context *context, void *block, uint64_t size);
void *mt_try_allocate(mt_context *context, uint64_t size);
void mt_free(mt_context *context, void *block); /* NULL is allowed */
/* A copy of a string; NULL with the error recorded when memory is missing. */
char *mt_duplicate_string(mt_context *context, const char *text);

/* Counts bytes that a third-party library is about to allocate by itself, at most, against the limit, as if they had
 * been allocated here: MT_OK, or MT_ERROR_OUT_OF_MEMORY recorded. Give them back with mt_release_bytes once that
 * library has freed them. */
mt_status mt_hold_bytes(mt_context *context, uint64_t size);
void mt_release_bytes(mt_context *context, uint64_t size);

/* Reports a share of the work done (0 to 1) and asks whether to go on: MT_OK, or
 * MT_ERROR_CANCELLED recorded. Call between blocks of work, not per element. */
mt_status mt_progress(mt_context *context, const char *task, double fraction);

/* Parallel loop over [0, count) in fixed blocks of `grain` elements (the last may be shorter): the
 * blocks do not depend on the thread count, only who runs them does. grain 0 is a caller's bug.
 * The body must not fail; it may call mt_try_allocate and mt_free. */
typedef void (*mt_parallel_body)(void *user, uint64_t begin, uint64_t end);
void mt_parallel_for(mt_context *context, uint64_t count, uint64_t grain, mt_parallel_body body, void *user);

/* The record behind --explain: one part built or skipped. */
typedef struct mt_part {
    const char *name;   /* "edge pairs", "half-edges", "depth buffer"; a string literal */
    const char *reason; /* why it was built or skipped; a string literal, may be NULL */
    bool built;
    double milliseconds; /* wall time; of a part that was skipped what it would have taken, 0: not measured */
    uint64_t bytes;      /* growth of the bytes held while it was built; 0 when it shrank */
} mt_part;

/* Begins a part; returns a token for mt_part_end. Without options.explain these do nothing. */
int mt_part_begin(mt_context *context, const char *name, const char *reason);
void mt_part_end(mt_context *context, int token);
/* Begins to measure a part that the result does without; until its end no other part is recorded. */
int mt_part_begin_skipped(mt_context *context, const char *name, const char *reason);
void mt_part_skip(mt_context *context, const char *name, const char *reason);
/* The parts so far, in the order of their beginning; *count receives their number. */
const mt_part *mt_context_parts(const mt_context *context, size_t *count);
/* Parts that came after the first 64, which is as many as are kept. */
uint64_t mt_context_parts_left_out(const mt_context *context);

#ifdef __cplusplus
}
#endif
#endif
