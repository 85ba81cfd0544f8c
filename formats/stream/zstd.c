/* Zstandard (RFC 8878) by libzstd: windows up to 128 MB, its own limit; frames are written with a checksum, by one
 * thread. Contexts that take an allocator are in the part of the interface for static linking, unchanged since 1.3. */
#include "formats/stream/codec.h"

/* A frame, or a frame to skip, with which parallel compressors begin. */
static bool recognise(const uint8_t *bytes, size_t size)
{
    bool is_frame = size >= 4 && bytes[0] == 0x28 && bytes[1] == 0xb5 && bytes[2] == 0x2f && bytes[3] == 0xfd;
    bool is_skipped =
        size >= 4 && (bytes[0] & 0xf0) == 0x50 && bytes[1] == 0x2a && bytes[2] == 0x4d && bytes[3] == 0x18;
    return is_frame || is_skipped;
}

#ifdef MESHTOOL_ZSTD
#define ZSTD_STATIC_LINKING_ONLY
#include <zstd.h>
#include <zstd_errors.h>

static ZSTD_customMem memory_of(mt_context *context)
{
    return (ZSTD_customMem){mt_codec_allocate, mt_codec_free, context};
}

static void *create_expander(mt_context *context)
{
    return ZSTD_createDCtx_advanced(memory_of(context));
}

static void destroy_expander(void *state)
{
    ZSTD_freeDCtx((ZSTD_DCtx *)state);
}

static void *create_packer(mt_context *context)
{
    ZSTD_CCtx *state = ZSTD_createCCtx_advanced(memory_of(context));
    if (state) {
        ZSTD_CCtx_setParameter(state, ZSTD_c_checksumFlag, 1);
    }
    return state;
}

static void destroy_packer(void *state)
{
    ZSTD_freeCCtx((ZSTD_CCtx *)state);
}

static mt_codec_result result_of(size_t code, const char **problem)
{
    if (!ZSTD_isError(code)) {
        return code == 0 ? MT_CODEC_END : MT_CODEC_MORE;
    }
    *problem = ZSTD_getErrorName(code);
    switch (ZSTD_getErrorCode(code)) {
    case ZSTD_error_memory_allocation:
        return MT_CODEC_NO_MEMORY;
    case ZSTD_error_frameParameter_windowTooLarge:
        return MT_CODEC_TOO_LARGE;
    case ZSTD_error_noForwardProgress_destFull:
    case ZSTD_error_noForwardProgress_inputEmpty:
        return MT_CODEC_MORE;
    default:
        return MT_CODEC_DAMAGED;
    }
}

static mt_codec_result expand(void *state, mt_codec_bytes *bytes, const char **problem)
{
    ZSTD_inBuffer in = {bytes->in, bytes->in_size, 0};
    ZSTD_outBuffer out = {bytes->out, bytes->out_size, 0};
    size_t code = ZSTD_decompressStream((ZSTD_DCtx *)state, &out, &in);
    *bytes = (mt_codec_bytes){bytes->in + in.pos, in.size - in.pos, bytes->out + out.pos, out.size - out.pos};
    return result_of(code, problem);
}

static mt_codec_result pack(void *state, mt_codec_bytes *bytes, bool finish)
{
    const char *problem;
    ZSTD_inBuffer in = {bytes->in, bytes->in_size, 0};
    ZSTD_outBuffer out = {bytes->out, bytes->out_size, 0};
    size_t code = ZSTD_compressStream2((ZSTD_CCtx *)state, &out, &in, finish ? ZSTD_e_end : ZSTD_e_continue);
    *bytes = (mt_codec_bytes){bytes->in + in.pos, in.size - in.pos, bytes->out + out.pos, out.size - out.pos};
    mt_codec_result result = result_of(code, &problem);
    return result == MT_CODEC_END && !finish ? MT_CODEC_MORE : result;
}
#endif

const mt_codec mt_zstd_codec = {
    .title = "zstd",
    .extension = "zst",
    .library = "libzstd",
    .tool = "unzstd",
    .recognise = recognise,
#ifdef MESHTOOL_ZSTD
    .create_expander = create_expander,
    .destroy_expander = destroy_expander,
    .expand = expand,
    .create_packer = create_packer,
    .destroy_packer = destroy_packer,
    .pack = pack,
#endif
};
