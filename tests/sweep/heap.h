/* The heap of this program, its libraries' blocks too: malloc and its kin are defined here and so stand before glibc's
 * for every library, and operator new calls them. */
#ifndef TESTS_SWEEP_HEAP_H
#define TESTS_SWEEP_HEAP_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Whether that can be: not under a sanitizer, which has an allocator of its own, nor without glibc. */
bool test_heap_is_watched(void);

/* Bytes in use, as large as the allocator made the blocks. */
uint64_t test_heap_bytes(void);

/* Forgets the peak and the number of allocations. The allocations from number `failing` on fail, or that one `alone`;
 * 0: none. */
void test_heap_begin(uint64_t failing, bool alone);
/* Lets all succeed again; returns how many there were since the beginning. */
uint64_t test_heap_end(void);
/* Most bytes in use since the beginning. */
uint64_t test_heap_peak(void);

#endif
