/* What Exif says of a JPEG picture. */
#ifndef MESHTOOL_JPEG_ORIENTATION_H
#define MESHTOOL_JPEG_ORIENTATION_H

#include "formats/stream/input.h"

/* 1 to 8 as Exif counts: 1 is upright, and what is not said, or not rightly. The input can be read anywhere. */
unsigned mt_jpeg_orientation(const mt_input *input);

#endif
