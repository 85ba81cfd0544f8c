/* Compression of what is written, piece after piece. */
#ifndef MESHTOOL_STREAM_PACK_H
#define MESHTOOL_STREAM_PACK_H

#include "formats/stream/codec.h"

typedef struct mt_packer mt_packer;

/* Takes compressed bytes. */
typedef mt_status (*mt_packer_sink)(mt_context *context, void *user, const char *bytes, size_t size);

/* The codec must be one that this meshtool was built with. */
mt_status mt_packer_create(mt_context *context, const mt_codec *codec, mt_packer **out);
void mt_packer_destroy(mt_context *context, mt_packer *packer); /* NULL is allowed */

/* Compresses bytes and hands on what comes of it; finish: also all that was held back, and the end. */
mt_status mt_packer_write(mt_context *context, mt_packer *packer, const char *bytes, size_t size, bool finish,
                          mt_packer_sink sink, void *user);

#endif
