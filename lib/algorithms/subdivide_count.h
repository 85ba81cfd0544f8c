/* The closed forms of the counts, in 64 bits. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_COUNT_H
#define LIB_ALGORITHMS_SUBDIVIDE_COUNT_H

#include <meshtool/subdivide.h>

typedef struct mt_subdivide_size {
    uint64_t vertices, faces, corners, edges;
} mt_subdivide_size;

/* The size after `level` levels; every field is clamped to 2^62 where it would pass that. */
mt_subdivide_size mt_subdivide_size_at(mt_subdivide_scheme scheme, mt_subdivide_size size, unsigned level);

/* MT_ERROR_TOO_LARGE unless each count fits an index. */
mt_status mt_subdivide_check_size(mt_context *context, const mt_subdivide_size *size, unsigned level);

#endif
