/* Arithmetic of 113 bits, for oracles: nothing of the library is computed in it. */
#ifndef MESHTOOL_CLI_TRADEOFF_QUAD_H
#define MESHTOOL_CLI_TRADEOFF_QUAD_H

#include <meshtool/vector.h>

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 quad;
#else
typedef long double quad; /* of 113 bits on 64-bit Arm */
#endif

typedef struct quad3 {
    quad x, y, z;
} quad3;

static inline quad3 quad3_make(quad x, quad y, quad z)
{
    quad3 v = {x, y, z};
    return v;
}

static inline quad3 quad3_from(mt_vec3 v)
{
    return quad3_make(v.x, v.y, v.z);
}

static inline mt_vec3 quad3_round(quad3 v)
{
    return mt_vec3_make((double)v.x, (double)v.y, (double)v.z);
}

static inline quad3 quad3_add(quad3 a, quad3 b)
{
    return quad3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline quad3 quad3_subtract(quad3 a, quad3 b)
{
    return quad3_make(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline quad3 quad3_scale(quad3 a, quad s)
{
    return quad3_make(a.x * s, a.y * s, a.z * s);
}

static inline quad quad3_dot(quad3 a, quad3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline quad3 quad3_cross(quad3 a, quad3 b)
{
    return quad3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline quad quad_absolute(quad x)
{
    return x < 0 ? -x : x;
}

/* Newton's steps from the double's root; for what a double can hold, squared. */
static inline quad quad_sqrt(quad x)
{
    quad scale = 1;
    while (x > 0x1p600) {
        x *= 0x1p-600, scale *= 0x1p300;
    }
    while (x > 0 && x < 0x1p-600) {
        x *= 0x1p600, scale *= 0x1p-300;
    }
    if (!(x > 0)) {
        return 0;
    }
    quad root = sqrt((double)x);
    for (int i = 0; i < 3; i++) {
        root = (root + x / root) / 2;
    }
    return root * scale;
}

/* The zero vector stays. */
static inline quad3 quad3_normalize(quad3 a)
{
    quad length = quad_sqrt(quad3_dot(a, a));
    return length > 0 ? quad3_scale(a, 1 / length) : a;
}

#endif
