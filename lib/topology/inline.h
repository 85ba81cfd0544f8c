/* For the few functions whose arguments must stay in the registers of the loop that calls them. */
#ifndef MT_TOPOLOGY_INLINE_H
#define MT_TOPOLOGY_INLINE_H

#define MT_ALWAYS_INLINE static inline __attribute__((always_inline))

#endif
