/* Which face each pixel of a preview shows, read off its colours. */
#ifndef MESHTOOL_CLI_TRADEOFF_FACE_PICTURE_H
#define MESHTOOL_CLI_TRADEOFF_FACE_PICTURE_H

#include <meshtool/preview.h>

/* Fills the faces, one a pixel, MT_NONE: none. The options' size, camera and method count; pictures have one sample a
 * pixel, and faces are black or white by the bits of their numbers. */
mt_status face_picture_draw(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                            mt_index *faces);

#endif
