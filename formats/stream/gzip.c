/* gzip (RFC 1952) by zlib, which checks the sums and lengths, and writes no time into the header. */
#include "formats/stream/codec.h"

static bool recognise(const uint8_t *bytes, size_t size)
{
    return size >= 2 && bytes[0] == 0x1f && bytes[1] == 0x8b;
}

#ifdef MESHTOOL_ZLIB
#include <limits.h>
#include <zlib.h>

#define GZIP_WRAPPER 16 /* added to the window's bits: gzip's header and sums instead of zlib's */
#define WINDOW_BITS (15 + GZIP_WRAPPER)
#define MEMORY_LEVEL 8 /* zlib's default */

typedef struct gzip_state {
    mt_context *context;
    z_stream stream;
} gzip_state;

static gzip_state *allocate_state(mt_context *context)
{
    gzip_state *state = (gzip_state *)mt_allocate_zeroed(context, sizeof *state);
    if (state) {
        state->context = context;
        state->stream.zalloc = mt_codec_allocate_array;
        state->stream.zfree = mt_codec_free;
        state->stream.opaque = context;
    }
    return state;
}

static void *create_expander(mt_context *context)
{
    gzip_state *state = allocate_state(context);
    if (state && inflateInit2(&state->stream, WINDOW_BITS) != Z_OK) {
        mt_free(context, state);
        return NULL;
    }
    return state;
}

static void destroy_expander(void *data)
{
    gzip_state *state = (gzip_state *)data;
    if (state) {
        inflateEnd(&state->stream);
        mt_free(state->context, state);
    }
}

static void *create_packer(mt_context *context)
{
    gzip_state *state = allocate_state(context);
    if (state && deflateInit2(&state->stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, WINDOW_BITS, MEMORY_LEVEL,
                              Z_DEFAULT_STRATEGY) != Z_OK) {
        mt_free(context, state);
        return NULL;
    }
    return state;
}

static void destroy_packer(void *data)
{
    gzip_state *state = (gzip_state *)data;
    if (state) {
        deflateEnd(&state->stream);
        mt_free(state->context, state);
    }
}

static uInt clip(size_t size)
{
    return size < UINT_MAX ? (uInt)size : UINT_MAX;
}

static void lend(z_stream *stream, const mt_codec_bytes *bytes)
{
    stream->next_in = (z_const Bytef *)bytes->in;
    stream->avail_in = clip(bytes->in_size);
    stream->next_out = bytes->out;
    stream->avail_out = clip(bytes->out_size);
}

static void take_back(const z_stream *stream, mt_codec_bytes *bytes)
{
    bytes->in_size -= (size_t)(stream->next_in - bytes->in);
    bytes->in = stream->next_in;
    bytes->out_size -= (size_t)(stream->next_out - bytes->out);
    bytes->out = stream->next_out;
}

static mt_codec_result expand(void *data, mt_codec_bytes *bytes, const char **problem)
{
    z_stream *stream = &((gzip_state *)data)->stream;
    lend(stream, bytes);
    int code = inflate(stream, Z_NO_FLUSH);
    take_back(stream, bytes);
    *problem = stream->msg ? stream->msg : "it asks for a dictionary";
    switch (code) {
    case Z_STREAM_END:
        inflateReset(stream);
        return MT_CODEC_END;
    case Z_OK:
    case Z_BUF_ERROR:
        return MT_CODEC_MORE;
    case Z_MEM_ERROR:
        return MT_CODEC_NO_MEMORY;
    default:
        return MT_CODEC_DAMAGED;
    }
}

static mt_codec_result pack(void *data, mt_codec_bytes *bytes, bool finish)
{
    z_stream *stream = &((gzip_state *)data)->stream;
    lend(stream, bytes);
    bool is_last = finish && stream->avail_in == bytes->in_size;
    int code = deflate(stream, is_last ? Z_FINISH : Z_NO_FLUSH);
    take_back(stream, bytes);
    return code == Z_STREAM_END ? MT_CODEC_END : MT_CODEC_MORE;
}
#endif

const mt_codec mt_gzip_codec = {
    .title = "gzip",
    .extension = "gz",
    .library = "zlib",
    .tool = "gunzip",
    .zero_padding = true,
    .recognise = recognise,
#ifdef MESHTOOL_ZLIB
    .create_expander = create_expander,
    .destroy_expander = destroy_expander,
    .expand = expand,
    .create_packer = create_packer,
    .destroy_packer = destroy_packer,
    .pack = pack,
#endif
};
