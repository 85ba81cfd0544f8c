#include "formats/stream/pack.h"

#define PIECE_SIZE ((size_t)64 << 10)

struct mt_packer {
    const mt_codec *codec;
    void *state;
    uint8_t piece[PIECE_SIZE];
};

mt_status mt_packer_create(mt_context *context, const mt_codec *codec, mt_packer **out)
{
    *out = NULL;
    mt_packer *packer = mt_allocate(context, sizeof *packer);
    void *state = packer ? codec->create_packer(context) : NULL;
    if (!state) {
        mt_free(context, packer);
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory to compress with");
    }
    packer->codec = codec;
    packer->state = state;
    *out = packer;
    return MT_OK;
}

void mt_packer_destroy(mt_context *context, mt_packer *packer)
{
    if (packer) {
        packer->codec->destroy_packer(packer->state);
        mt_free(context, packer);
    }
}

mt_status mt_packer_write(mt_context *context, mt_packer *packer, const char *bytes, size_t size, bool finish,
                          mt_packer_sink sink, void *user)
{
    mt_codec_bytes task = {.in = (const uint8_t *)bytes, .in_size = size};
    mt_status status = MT_OK;
    bool is_done = size == 0 && !finish;
    while (status == MT_OK && !is_done) {
        task.out = packer->piece;
        task.out_size = PIECE_SIZE;
        mt_codec_result result = packer->codec->pack(packer->state, &task, finish);
        if (result == MT_CODEC_NO_MEMORY || result == MT_CODEC_DAMAGED || result == MT_CODEC_TOO_LARGE) {
            return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory to compress with");
        }
        status = sink(context, user, (const char *)packer->piece, PIECE_SIZE - task.out_size);
        is_done = finish ? result == MT_CODEC_END : task.in_size == 0 && task.out_size > 0;
    }
    return status;
}
