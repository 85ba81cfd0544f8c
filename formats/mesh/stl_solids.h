/* A block of an ASCII STL file, parsed on its own: whole facets, and the solids that begin in it. */
#ifndef MESHTOOL_STL_SOLIDS_H
#define MESHTOOL_STL_SOLIDS_H

#include "formats/stream/text.h"

typedef struct stl_solid {
    char *name;
    uint64_t first_facet; /* in the block */
} stl_solid;

typedef struct stl_part {
    double *positions; /* nine a facet */
    uint64_t facet_count, facet_room;
    stl_solid *solids;
    uint64_t solid_count, solid_room;
    uint64_t offset;        /* of the block's first byte */
    bool is_read;           /* some word stands in it */
    bool begins_inside;     /* it begins with a facet of a solid that began before */
    bool ends_inside;       /* its last solid goes on */
    uint64_t junk_lines;    /* outside of solids */
    uint64_t contradicting; /* normals */
} stl_part;

/* Whether a block may begin with this line. */
bool mt_stl_may_begin(const char *line, const char *end);

/* Parses the block into an empty part; mt_text_fail when it cannot be. Positions are kept when `normals` is NULL; else
 * only the normals are, three a facet, there. */
void mt_stl_parse_part(mt_context *context, mt_text_block *block, stl_part *part, float *normals);

/* May be called inside a parallel body. */
void mt_stl_release_part(mt_context *context, stl_part *part);

#endif
