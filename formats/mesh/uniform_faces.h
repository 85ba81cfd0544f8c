/* Text whose faces are taken to have the sides of the first, so that all go straight to their places. */
#ifndef MESHTOOL_UNIFORM_FACES_H
#define MESHTOOL_UNIFORM_FACES_H

#include "formats/stream/text.h"

#include <meshtool/checked.h>

/* Whether memory may be asked for so many faces of so many sides: the text is long enough for them, two bytes a corner,
 * and a mesh can hold them. */
static inline bool mt_may_be_uniform(const mt_text *text, uint64_t sides, uint64_t face_count)
{
    uint64_t corners;
    return sides >= 3 && mt_checked_multiply(sides, face_count, &corners) && corners <= mt_text_size(text) / 2 &&
           mt_count_fits(corners);
}

#endif
