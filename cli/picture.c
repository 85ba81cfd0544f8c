#include "picture.h"

#include <meshtool/preview.h>

#include <string.h>

bool cli_parse_picture_size(const cli_option *option, const char *text, void *value)
{
    (void)option;
    double width = 0, height = 0;
    if (!cli_scan_number(&text, &width) || *text++ != 'x' || !cli_scan_number(&text, &height) || *text) {
        return false;
    }
    if (width < 1 || height < 1 || width > MT_PREVIEW_MAXIMUM_SIZE || height > MT_PREVIEW_MAXIMUM_SIZE ||
        width != (uint32_t)width || height != (uint32_t)height) {
        return false;
    }
    *(cli_picture_size *)value = (cli_picture_size){(uint32_t)width, (uint32_t)height};
    return true;
}

bool cli_parse_samples(const cli_option *option, const char *text, void *value)
{
    static const unsigned known[] = {1, 4, 9, 16, 25, 36, 49, 64};
    if (strcmp(text, "adaptive") == 0) {
        *(unsigned *)value = MT_SAMPLES_ADAPTIVE;
        return true;
    }
    bool found = cli_parse_count(option, text, value);
    for (size_t i = 0; found && i < sizeof known / sizeof known[0]; i++) {
        if (*(unsigned *)value == known[i]) {
            return true;
        }
    }
    return false;
}
