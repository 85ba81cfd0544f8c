/* What a manifold check must find, by whole numbers (integer_triangle.h) and plain searches: all of it on a small mesh,
 * on a large one what concerns a fixed sample of its faces. */
#ifndef MESHTOOL_CLI_TRADEOFF_PAIR_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_PAIR_ORACLE_H

#include <meshtool/self_intersection.h>

typedef struct pair_oracle {
    unsigned char *is_judged; /* a face: what concerns it is known */
    mt_index judged_count;    /* of faces */
    mt_face_pair *pairs;      /* ascending; each with a judged face. A face alone is paired with itself */
    uint64_t pair_count;
} pair_oracle;

/* Each begins with zeros; released in every case. Pairs of faces that intersect; faces whose vertices, all different,
 * lie on one line; the first faces of closed and oriented components whose volume is below zero. */
mt_status pair_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out);
mt_status area_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out);
mt_status volume_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out);
void pair_oracle_release(mt_context *context, pair_oracle *oracle);

#endif
