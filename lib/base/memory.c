/* Blocks carry their size in front, so that the limit and the peak are exact. Large ones are aligned to the huge
 * page and advised to it: the kernel then fills 2 MB at a fault instead of 4 KB, which costs less than the
 * algorithms that fill the memory. Those below, but above what malloc keeps, are filled at one call. */
#include "lib/base/context.h"

#include <meshtool/checked.h>

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define HEADER_SIZE 64
#define HUGE_BLOCK ((uint64_t)1 << 20)
#define HUGE_PAGE ((uint64_t)2 << 20)
#define POPULATED_BLOCK ((uint64_t)128 << 10) /* what malloc takes fresh from the kernel */
#define PAGE ((uintptr_t)4096)

typedef struct block_header {
    uint64_t size; /* as asked for */
    void *base;    /* what free takes */
} block_header;

static block_header *header_of(void *block)
{
    return (block_header *)(void *)((char *)block - HEADER_SIZE);
}

static bool reserve_bytes(mt_context *context, uint64_t size)
{
    uint64_t serial = atomic_fetch_add(&context->allocation_count, 1) + 1;
    uint64_t failing = context->options.failing_allocation;
    if (failing && serial >= failing) {
        return false;
    }
    uint64_t held = atomic_fetch_add(&context->bytes, size) + size;
    uint64_t limit = context->options.memory_limit;
    if (held < size || (limit && held > limit)) {
        atomic_fetch_sub(&context->bytes, size);
        return false;
    }
    uint_fast64_t peak = atomic_load(&context->peak_bytes);
    while (held > peak && !atomic_compare_exchange_weak(&context->peak_bytes, &peak, held)) {
    }
    return true;
}

/* The whole pages of a block at one call. A kernel before 5.14 refuses, and fills them one fault each. */
static void populate(char *base, uint64_t size)
{
#ifdef MADV_POPULATE_WRITE
    uintptr_t begin = ((uintptr_t)base + PAGE - 1) / PAGE * PAGE, end = ((uintptr_t)base + size) / PAGE * PAGE;
    if (begin < end) {
        madvise((void *)begin, end - begin, MADV_POPULATE_WRITE);
    }
#else
    (void)base, (void)size;
#endif
}

static void *allocate_block(uint64_t size)
{
    if (size > SIZE_MAX / 2) {
        return NULL;
    }
    bool huge = size >= HUGE_BLOCK;
    uint64_t alignment = huge ? HUGE_PAGE : HEADER_SIZE;
    uint64_t whole = (size + HEADER_SIZE + alignment - 1) / alignment * alignment;
    char *base = aligned_alloc(alignment, whole);
    if (!base) {
        return NULL;
    }
    if (huge) {
        madvise(base, whole, MADV_HUGEPAGE);
    } else if (size >= POPULATED_BLOCK) {
        populate(base, whole);
    }
    block_header *header = (block_header *)(void *)base;
    header->size = size;
    header->base = base;
    return base + HEADER_SIZE;
}

void *mt_try_allocate(mt_context *context, uint64_t size)
{
    if (!reserve_bytes(context, size)) {
        return NULL;
    }
    void *block = allocate_block(size);
    if (!block) {
        atomic_fetch_sub(&context->bytes, size);
    }
    return block;
}

static void *record_missing_memory(mt_context *context, uint64_t size)
{
    uint64_t limit = context->options.memory_limit;
    if (limit) {
        mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "%llu bytes more would exceed the memory limit of %llu (%llu in use)",
                (unsigned long long)size, (unsigned long long)limit, (unsigned long long)mt_context_bytes(context));
    } else {
        mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "out of memory: %llu bytes could not be had",
                (unsigned long long)size);
    }
    return NULL;
}

void *mt_allocate(mt_context *context, uint64_t size)
{
    void *block = mt_try_allocate(context, size);
    return block ? block : record_missing_memory(context, size);
}

void *mt_allocate_zeroed(mt_context *context, uint64_t size)
{
    void *block = mt_allocate(context, size);
    if (block) {
        memset(block, 0, (size_t)size);
    }
    return block;
}

static bool array_size(mt_context *context, uint64_t count, size_t size, uint64_t *bytes)
{
    if (mt_checked_multiply(count, size, bytes)) {
        return true;
    }
    mt_fail(context, MT_ERROR_TOO_LARGE, "%llu elements of %zu bytes are more than memory can address",
            (unsigned long long)count, size);
    return false;
}

void *mt_allocate_array(mt_context *context, uint64_t count, size_t size)
{
    uint64_t bytes;
    return array_size(context, count, size, &bytes) ? mt_allocate(context, bytes) : NULL;
}

void *mt_allocate_array_zeroed(mt_context *context, uint64_t count, size_t size)
{
    uint64_t bytes;
    return array_size(context, count, size, &bytes) ? mt_allocate_zeroed(context, bytes) : NULL;
}

void *mt_reallocate(mt_context *context, void *block, uint64_t size)
{
    void *fresh = mt_allocate(context, size);
    if (!fresh || !block) {
        return fresh;
    }
    uint64_t old = header_of(block)->size;
    memcpy(fresh, block, (size_t)(old < size ? old : size));
    mt_free(context, block);
    return fresh;
}

void mt_free(mt_context *context, void *block)
{
    if (block) {
        block_header *header = header_of(block);
        atomic_fetch_sub(&context->bytes, header->size);
        free(header->base);
    }
}

mt_status mt_hold_bytes(mt_context *context, uint64_t size)
{
    if (reserve_bytes(context, size)) {
        return MT_OK;
    }
    record_missing_memory(context, size);
    return MT_ERROR_OUT_OF_MEMORY;
}

void mt_release_bytes(mt_context *context, uint64_t size)
{
    atomic_fetch_sub(&context->bytes, size);
}

char *mt_duplicate_string(mt_context *context, const char *text)
{
    size_t size = strlen(text) + 1;
    char *copy = mt_allocate(context, size);
    if (copy) {
        memcpy(copy, text, size);
    }
    return copy;
}

uint64_t mt_context_bytes(const mt_context *context)
{
    return atomic_load(&context->bytes);
}

uint64_t mt_context_peak_bytes(const mt_context *context)
{
    return atomic_load(&context->peak_bytes);
}

uint64_t mt_context_allocation_count(const mt_context *context)
{
    return atomic_load(&context->allocation_count);
}
