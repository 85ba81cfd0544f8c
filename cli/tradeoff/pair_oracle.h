/* The pairs of faces that intersect, by whole numbers (integer_triangle.h) and plain boxes: all of them on a small
 * mesh, those of a fixed sample of its faces on a large one. */
#ifndef MESHTOOL_CLI_TRADEOFF_PAIR_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_PAIR_ORACLE_H

#include <meshtool/self_intersection.h>

typedef struct pair_oracle {
    unsigned char *is_judged; /* a face: the pairs with it are known */
    mt_index judged_count;    /* of faces */
    mt_face_pair *pairs;      /* ascending; each with a judged face */
    uint64_t pair_count;
} pair_oracle;

/* Begins with zeros; released in every case. */
mt_status pair_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out);
void pair_oracle_release(mt_context *context, pair_oracle *oracle);

#endif
