#include "formats/stream/path.h"

#include "formats/stream/codec.h"
#include "formats/stream/output.h"

#include <stdio.h>
#include <string.h>

/* The path's last part from its last dot before `end` on; `end` when it has none. */
static const char *last_dot(const char *path, const char *end)
{
    for (const char *at = end; at > path && at[-1] != '/'; at--) {
        if (at[-1] == '.') {
            return at - 1;
        }
    }
    return end;
}

const char *mt_path_suffix(const char *path)
{
    const char *dot = last_dot(path, path + strlen(path));
    return *dot ? dot + 1 : dot;
}

static mt_extension make_extension(const char *begin, size_t length)
{
    mt_extension extension;
    snprintf(extension.text, sizeof extension.text, "%.*s", (int)(length < sizeof extension.text ? length : 23), begin);
    return extension;
}

mt_extension mt_path_extension(const char *path)
{
    const char *end = path + strlen(path);
    if (mt_codec_of_path(path)) {
        end = last_dot(path, end);
    }
    const char *dot = last_dot(path, end);
    return dot < end ? make_extension(dot + 1, (size_t)(end - dot) - 1) : make_extension("", 0);
}

mt_status mt_path_output_extension(mt_context *context, const char *path, const char *wanted, const char *fallback,
                                   mt_extension *out)
{
    bool is_stream = mt_output_is_stream(path);
    const mt_codec *codec = is_stream ? NULL : mt_codec_of_path(path);
    *out = wanted ? make_extension(wanted, strlen(wanted)) : mt_path_extension(path);
    if (!wanted && is_stream) {
        *out = make_extension(fallback, strlen(fallback));
    }
    if (codec && !codec->create_packer) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "%s: this meshtool was built without %s, and cannot write .%s files",
                       path, codec->library, codec->extension);
    }
    return MT_OK;
}
