/* The table of codecs, recognition by content and by name. */
#include "formats/stream/codec.h"

#include "formats/stream/path.h"

#include <string.h>
#include <strings.h>

const mt_codec *const *mt_codecs(void)
{
    static const mt_codec *const table[] = {&mt_gzip_codec, &mt_zstd_codec, NULL};
    return table;
}

const mt_codec *mt_codec_of_content(const uint8_t *bytes, size_t size)
{
    for (const mt_codec *const *codec = mt_codecs(); *codec; codec++) {
        if ((*codec)->recognise(bytes, size)) {
            return *codec;
        }
    }
    return NULL;
}

const mt_codec *mt_codec_of_path(const char *path)
{
    const char *extension = mt_path_suffix(path);
    for (const mt_codec *const *codec = mt_codecs(); *codec; codec++) {
        if (strcasecmp(extension, (*codec)->extension) == 0) {
            return *codec;
        }
    }
    return NULL;
}

void *mt_codec_allocate_array(void *context, unsigned count, unsigned size)
{
    return mt_allocate_array((mt_context *)context, count, size);
}

void *mt_codec_allocate(void *context, size_t size)
{
    return mt_allocate((mt_context *)context, size);
}

void mt_codec_free(void *context, void *block)
{
    mt_free((mt_context *)context, block);
}
