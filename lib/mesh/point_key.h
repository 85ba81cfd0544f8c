/* Points as keys that are equal exactly when the points are, bit for bit, -0 taken for +0; and hashes of those. */
#ifndef MT_MESH_POINT_KEY_H
#define MT_MESH_POINT_KEY_H

#include <meshtool/types.h>

#include <string.h>

typedef struct point_key {
    uint64_t x, y, z;
} point_key;

static inline point_key load_key(const char *point, mt_type type)
{
    if (type == MT_F32) {
        uint32_t word[3];
        memcpy(word, point, sizeof word);
        for (int i = 0; i < 3; i++) {
            word[i] = word[i] == UINT32_C(1) << 31 ? 0 : word[i];
        }
        return (point_key){word[0], word[1], word[2]};
    }
    uint64_t word[3];
    memcpy(word, point, sizeof word);
    for (int i = 0; i < 3; i++) {
        word[i] = word[i] == UINT64_C(1) << 63 ? 0 : word[i];
    }
    return (point_key){word[0], word[1], word[2]};
}

static inline bool same_key(point_key a, point_key b)
{
    return ((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) == 0;
}

/* Doubles that were floats have their low half empty: the high half is folded in before each multiplication. */
static inline uint64_t mix(uint64_t hash, uint64_t word)
{
    hash = (hash ^ word ^ (word >> 32)) * UINT64_C(0x9e3779b97f4a7c15);
    return hash ^ (hash >> 32);
}

static inline uint64_t hash_key(point_key key)
{
    return mix(mix(mix(0, key.x), key.y), key.z);
}

#endif
