#include "formats/mesh/recognition.h"

#include "formats/stream/input.h"
#include "formats/stream/path.h"

#include <string.h>

/* From here on a content is believed against the name. Below it a name that tells a format decides. */
#define SURE_SCORE 50

static int score_of(const mt_mesh_format *format, const uint8_t *bytes, size_t size, uint64_t total)
{
    return format && format->sniff ? format->sniff(bytes, size, total) : 0;
}

/* Well-known contents that are not read, by name: the sentence says what to do. */
static const char *known_stranger(const uint8_t *bytes, size_t size)
{
    static const struct {
        const char *magic;
        size_t size;
        const char *sentence;
    } strangers[] = {
        {"\x1f\x8b", 2, "is compressed by gzip twice; decompress it first (gunzip)"},
        {"\x28\xb5\x2f\xfd", 4, "is compressed by zstd twice; decompress it first (unzstd)"},
        {"PK\x03\x04", 4, "is a zip archive; unpack it first"},
        {"\xff\xfe", 2, "is text in UTF-16; convert it to UTF-8 first (iconv -f utf-16 -t utf-8)"},
        {"\xfe\xff", 2, "is text in UTF-16; convert it to UTF-8 first (iconv -f utf-16 -t utf-8)"},
    };
    for (size_t i = 0; i < sizeof strangers / sizeof strangers[0]; i++) {
        if (size >= strangers[i].size && memcmp(bytes, strangers[i].magic, strangers[i].size) == 0) {
            return strangers[i].sentence;
        }
    }
    return NULL;
}

static const mt_mesh_format *best_format(const uint8_t *bytes, size_t size, uint64_t total, int *score)
{
    const mt_mesh_format *best = NULL;
    *score = 0;
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        int one = score_of(*format, bytes, size, total);
        if (one > *score) {
            *score = one;
            best = *format;
        }
    }
    return best;
}

static mt_status choose(mt_context *context, const mt_input *input, const uint8_t *bytes, size_t size,
                        const mt_mesh_format **out)
{
    const char *name = mt_input_name(input);
    int score;
    const mt_mesh_format *best = best_format(bytes, size, mt_input_size(input), &score);
    const mt_mesh_format *named = mt_mesh_format_by_extension(mt_path_extension(name).text);
    int named_score = score_of(named, bytes, size, mt_input_size(input));
    if (!best) {
        mt_place place = {.file = name};
        const char *stranger = known_stranger(bytes, size);
        if (stranger) {
            return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place, "%s", stranger);
        }
        *out = named;
        return named ? MT_OK
                     : mt_fail_at(context, MT_ERROR_SYNTAX, place,
                                  "neither the content nor the name tells a mesh format (--from EXT names one)");
    }
    *out = named && (named_score == score || score < SURE_SCORE) ? named : best;
    if (named && *out != named) {
        mt_warn(context, "%s: the content is %s although the name says %s; read as %s", name, best->title, named->title,
                best->title);
    }
    return MT_OK;
}

mt_status mt_recognise_mesh(mt_context *context, mt_input *input, const char *wanted, const mt_mesh_format **out)
{
    const uint8_t *bytes;
    size_t size;
    *out = NULL;
    mt_status status = mt_input_peek(context, input, &bytes, &size);
    if (status != MT_OK) {
        return status;
    }
    if (size == 0) {
        mt_place place = {.file = mt_input_name(input)};
        return mt_fail_at(context, MT_ERROR_SYNTAX, place, "is empty (0 bytes), expected a mesh");
    }
    if (!wanted) {
        return choose(context, input, bytes, size, out);
    }
    *out = mt_mesh_format_by_extension(wanted);
    return *out ? MT_OK : mt_fail(context, MT_ERROR_ARGUMENT, "no mesh format is called \"%s\"", wanted);
}
