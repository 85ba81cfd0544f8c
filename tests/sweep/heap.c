#include "tests/sweep/heap.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define HEAP_IS_TAKEN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define HEAP_IS_TAKEN 1
#endif
#endif

#include <stdlib.h> /* defines __GLIBC__ */

#if defined(__GLIBC__) && !defined(HEAP_IS_TAKEN)

#include <errno.h>
#include <malloc.h>
#include <stdatomic.h>

/* Where glibc's own allocator stays reachable. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *block);

static atomic_uint_fast64_t bytes, peak, count, failing;
static atomic_bool alone;

/* Whether this allocation is to succeed. */
static bool may_allocate(void)
{
    uint64_t serial = atomic_fetch_add(&count, 1) + 1, first = atomic_load(&failing);
    if (first && (atomic_load(&alone) ? serial == first : serial >= first)) {
        errno = ENOMEM;
        return false;
    }
    return true;
}

static void *counted(void *block)
{
    if (block) {
        uint64_t size = malloc_usable_size(block), held = atomic_fetch_add(&bytes, size) + size;
        uint_fast64_t most = atomic_load(&peak);
        while (held > most && !atomic_compare_exchange_weak(&peak, &most, held)) {
        }
    }
    return block;
}

void *malloc(size_t size)
{
    return may_allocate() ? counted(__libc_malloc(size)) : NULL;
}

void *calloc(size_t number, size_t size)
{
    return may_allocate() ? counted(__libc_calloc(number, size)) : NULL;
}

void *realloc(void *block, size_t size)
{
    if (!may_allocate()) {
        return NULL;
    }
    uint64_t before = block ? malloc_usable_size(block) : 0;
    void *fresh = __libc_realloc(block, size);
    if (fresh || size == 0) {
        atomic_fetch_sub(&bytes, before);
    }
    return counted(fresh);
}

void *memalign(size_t alignment, size_t size)
{
    return may_allocate() ? counted(__libc_memalign(alignment, size)) : NULL;
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size)
{
    *block = memalign(alignment, size);
    return *block ? 0 : ENOMEM;
}

void free(void *block)
{
    if (block) {
        int kept = errno;
        atomic_fetch_sub(&bytes, malloc_usable_size(block));
        __libc_free(block);
        errno = kept;
    }
}

bool test_heap_is_watched(void)
{
    return true;
}

uint64_t test_heap_bytes(void)
{
    return atomic_load(&bytes);
}

void test_heap_begin(uint64_t first, bool only)
{
    atomic_store(&alone, only);
    atomic_store(&count, 0);
    atomic_store(&peak, atomic_load(&bytes));
    atomic_store(&failing, first);
}

uint64_t test_heap_end(void)
{
    atomic_store(&failing, 0);
    return atomic_load(&count);
}

uint64_t test_heap_peak(void)
{
    return atomic_load(&peak);
}

#else

bool test_heap_is_watched(void)
{
    return false;
}

uint64_t test_heap_bytes(void)
{
    return 0;
}

void test_heap_begin(uint64_t failing, bool alone)
{
    (void)failing;
    (void)alone;
}

uint64_t test_heap_end(void)
{
    return 0;
}

uint64_t test_heap_peak(void)
{
    return 0;
}

#endif
