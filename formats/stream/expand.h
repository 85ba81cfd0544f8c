/* Decompression of an input, member after member, with a cap: what comes out may not exceed 64 MB and 256 times what
 * went in. What is read whole is held in the context's memory besides, so that a memory limit holds too. */
#ifndef MESHTOOL_STREAM_EXPAND_H
#define MESHTOOL_STREAM_EXPAND_H

#include "formats/stream/codec.h"
#include "formats/stream/input.h"

typedef struct mt_expander mt_expander;

/* Takes the source over, if it fails too. MT_ERROR_UNSUPPORTED when the codec's library was left out. */
mt_status mt_expander_create(mt_context *context, const mt_codec *codec, mt_input *source, mt_expander **out);
void mt_expander_destroy(mt_context *context, mt_expander *expander); /* NULL is allowed */

/* Fills `bytes`; *got is less than `size` only at the end. MT_ERROR_SYNTAX with the place in the compressed file for
 * damaged and incomplete data, MT_ERROR_TOO_LARGE at the cap. */
mt_status mt_expander_read(mt_context *context, mt_expander *expander, uint8_t *bytes, size_t size, size_t *got);

#endif
