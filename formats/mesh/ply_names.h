/* The property names by which PLY files hold normals, colours and texture coordinates. */
#ifndef MESHTOOL_PLY_NAMES_H
#define MESHTOOL_PLY_NAMES_H

#include <meshtool/attribute.h>

#define PLY_GROUP_MAX 4

typedef struct ply_group {
    mt_semantic semantic;
    uint32_t fewest, most; /* components; the last ones may be missing */
    bool integers;         /* uchar and ushort too, not only float and double */
    const char *names[PLY_GROUP_MAX];
} ply_group;

/* In the order in which they are looked for; the first of each meaning is how it is written. */
const ply_group *mt_ply_groups(uint32_t *count);

#endif
