/* Loops whose speed wider instructions raise are compiled twice, and the processor chooses when the program starts.
 *
 * Results do not differ: nothing is contracted or reassociated. Sanitizers start too late for the choice, and clang 14
 * finds it in the same file alone: only static functions are cloned. Vectors pass through them by address: as values,
 * how they are passed would depend on the clone. */
#ifndef MESHTOOL_CLONES_H
#define MESHTOOL_CLONES_H

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MT_SANITIZED 1
#endif
#endif

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(MT_SANITIZED) && !defined(__AVX2__)
#define MT_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define MT_CLONES
#endif

/* For what a cloned function calls: only what is inlined is compiled with it. */
#define MT_INLINE static inline __attribute__((always_inline))

#endif
