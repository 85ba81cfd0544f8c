#include "formats/stream/expand.h"

#define SOURCE_SIZE ((size_t)64 << 10)

/* Past the first bytes, which any file may expand to, deflate reaches 1032 to 1 on zeros alone. Text of meshes and
 * their binary forms stay below 20, drawn pictures below 200. */
#define FREE_SIZE ((uint64_t)64 << 20)
#define MAXIMUM_RATIO 256

struct mt_expander {
    const mt_codec *codec;
    mt_input *source;
    void *state;
    uint64_t produced;
    bool is_inside;    /* a member, rather than before or between them */
    bool is_padded;    /* nothing but zeros may follow */
    size_t begin, end; /* of what is left in the buffer */
    uint8_t buffer[SOURCE_SIZE];
};

mt_status mt_expander_create(mt_context *context, const mt_codec *codec, mt_input *source, mt_expander **out)
{
    *out = NULL;
    if (!codec->create_expander) {
        mt_place place = {.file = mt_input_name(source)};
        mt_status status =
            mt_fail_at(context, MT_ERROR_UNSUPPORTED, place,
                       "is compressed by %s, and this meshtool was built without %s; decompress it first (%s)",
                       codec->title, codec->library, codec->tool);
        mt_input_close(context, source);
        return status;
    }
    mt_expander *expander = mt_allocate(context, sizeof *expander);
    void *state = expander ? codec->create_expander(context) : NULL;
    if (!state) {
        mt_free(context, expander);
        mt_input_close(context, source);
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory to decompress with");
    }
    *expander = (mt_expander){.codec = codec, .source = source, .state = state};
    *out = expander;
    return MT_OK;
}

void mt_expander_destroy(mt_context *context, mt_expander *expander)
{
    if (expander) {
        expander->codec->destroy_expander(expander->state);
        mt_input_close(context, expander->source);
        mt_free(context, expander);
    }
}

/* Bytes of the compressed file that were used. */
static uint64_t used(const mt_expander *expander)
{
    return mt_input_offset(expander->source) - (expander->end - expander->begin);
}

static mt_place place_of(const mt_expander *expander)
{
    return mt_input_place_offset(expander->source, used(expander));
}

static mt_status refill(mt_context *context, mt_expander *expander)
{
    if (expander->begin < expander->end) {
        return MT_OK;
    }
    expander->begin = 0;
    return mt_input_read(context, expander->source, expander->buffer, SOURCE_SIZE, &expander->end);
}

/* Whether the bytes that follow a member are zeros to the buffer's end; the zeros are taken. */
static void skip_padding(mt_expander *expander)
{
    size_t begin = expander->begin;
    while (expander->begin < expander->end && expander->buffer[expander->begin] == 0) {
        expander->begin++;
    }
    expander->is_padded = expander->is_padded || expander->begin > begin;
}

static mt_status check_result(mt_context *context, const mt_expander *expander, mt_codec_result result,
                              const char *problem)
{
    const char *title = expander->codec->title;
    switch (result) {
    case MT_CODEC_DAMAGED:
        return mt_fail_at(context, MT_ERROR_SYNTAX, place_of(expander), "the %s data is damaged: %s", title, problem);
    case MT_CODEC_TOO_LARGE:
        return mt_fail_at(context, MT_ERROR_TOO_LARGE, place_of(expander),
                          "the %s data needs a window of more than 128 MB; decompress it first (%s)", title,
                          expander->codec->tool);
    case MT_CODEC_NO_MEMORY:
        return mt_fail(context, MT_ERROR_OUT_OF_MEMORY, "no memory to decompress with");
    default:
        break;
    }
    if (expander->produced > FREE_SIZE && expander->produced - FREE_SIZE > MAXIMUM_RATIO * used(expander)) {
        return mt_fail_at(context, MT_ERROR_TOO_LARGE, place_of(expander),
                          "the %s data expands to more than %d times its size; if it is meant to, decompress it first "
                          "(%s)",
                          title, MAXIMUM_RATIO, expander->codec->tool);
    }
    return MT_OK;
}

static mt_status step(mt_context *context, mt_expander *expander, mt_codec_bytes *bytes)
{
    size_t in_size = expander->end - expander->begin, out_size = bytes->out_size;
    const char *problem = "";
    if (expander->is_padded) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, place_of(expander), "bytes follow the padding after the %s data",
                          expander->codec->title);
    }
    bytes->in = expander->buffer + expander->begin;
    bytes->in_size = in_size;
    mt_codec_result result = expander->codec->expand(expander->state, bytes, &problem);
    expander->begin = expander->end - bytes->in_size;
    expander->produced += out_size - bytes->out_size;
    expander->is_inside = result != MT_CODEC_END;
    if (result == MT_CODEC_MORE && in_size == 0 && bytes->out_size == out_size) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, place_of(expander),
                          "the file ends inside its %s data, expected more of it", expander->codec->title);
    }
    return check_result(context, expander, result, problem);
}

mt_status mt_expander_read(mt_context *context, mt_expander *expander, uint8_t *bytes, size_t size, size_t *got)
{
    mt_codec_bytes room = {.out = bytes, .out_size = size};
    mt_status status = MT_OK;
    while (status == MT_OK && room.out_size > 0) {
        status = refill(context, expander);
        if (!expander->is_inside && expander->produced + used(expander) > 0 && expander->codec->zero_padding) {
            skip_padding(expander);
        }
        bool is_empty = expander->begin == expander->end;
        if (status != MT_OK || (is_empty && expander->end == 0 && !expander->is_inside)) {
            break;
        }
        if (!is_empty || expander->is_inside) {
            status = step(context, expander, &room);
        }
    }
    *got = size - room.out_size;
    return status;
}
