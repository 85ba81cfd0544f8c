/* Numbers that look random and are the same on every machine: splitmix64 (Steele, Lea and Flood, "Fast Splittable
 * Pseudorandom Number Generators", OOPSLA 2014). */
#ifndef MESHTOOL_CLI_TRADEOFF_RANDOM_H
#define MESHTOOL_CLI_TRADEOFF_RANDOM_H

#include <meshtool/vector.h>

#include <stdint.h>

typedef struct tradeoff_random {
    uint64_t state;
} tradeoff_random;

static inline uint64_t tradeoff_random_bits(tradeoff_random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15U;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31);
}

/* In [0, 1). */
static inline double tradeoff_random_unit(tradeoff_random *random)
{
    return (double)(tradeoff_random_bits(random) >> 11) * 0x1p-53;
}

/* Uniform on the unit sphere, by rejection from the cube. */
static inline mt_vec3 tradeoff_random_direction(tradeoff_random *random)
{
    for (;;) {
        double x = 2 * tradeoff_random_unit(random) - 1, y = 2 * tradeoff_random_unit(random) - 1;
        mt_vec3 v = mt_vec3_make(x, y, 2 * tradeoff_random_unit(random) - 1);
        double squared = mt_vec3_dot(v, v);
        if (squared > 1e-4 && squared <= 1) {
            return mt_vec3_normalize(v);
        }
    }
}

#endif
