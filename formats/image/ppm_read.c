/* Reading the netpbm family: P1 to P6 (PBM, PGM, PPM; text and binary) and P7 (PAM), as netpbm's own pages define them.
 */
#include "formats/image/image_format.h"
#include "formats/image/samples.h"

#include <string.h>

#define SAMPLE_LIMIT 65535

/* The file's bytes, and how far they were read. */
typedef struct netpbm {
    mt_context *context;
    mt_input *input;
    uint8_t *bytes;
    size_t size, at;
    char kind; /* '1' to '7' */
    uint32_t width, height, depth, maximum;
} netpbm;

static mt_status fail_at(const netpbm *file, size_t at, const char *expected)
{
    mt_place place = mt_input_place_offset(file->input, at);
    return mt_fail_at(file->context, MT_ERROR_SYNTAX, place,
                      at < file->size ? "expected %s" : "the file ends here, expected %s", expected);
}

static bool is_space(uint8_t byte)
{
    return byte == ' ' || (byte >= '\t' && byte <= '\r');
}

/* White space and comments, which may stand wherever white space may in the header. */
static void skip_space(netpbm *file)
{
    while (file->at < file->size && (is_space(file->bytes[file->at]) || file->bytes[file->at] == '#')) {
        if (file->bytes[file->at] == '#') {
            const uint8_t *end = memchr(file->bytes + file->at, '\n', file->size - file->at);
            file->at = end ? (size_t)(end - file->bytes) : file->size;
        } else {
            file->at++;
        }
    }
}

/* A whole number up to `limit`; more is said to be so. */
static mt_status read_number(netpbm *file, const char *what, uint64_t limit, uint64_t *out)
{
    skip_space(file);
    size_t begin = file->at;
    uint64_t number = 0;
    while (file->at < file->size && file->bytes[file->at] >= '0' && file->bytes[file->at] <= '9') {
        number = number <= limit ? 10 * number + (file->bytes[file->at] - '0') : number;
        file->at++;
    }
    *out = number;
    bool is_ended = file->at == file->size || is_space(file->bytes[file->at]) || file->bytes[file->at] == '#';
    if (file->at == begin || !is_ended || number > limit) {
        return fail_at(file, is_ended && number <= limit ? begin : file->at, what);
    }
    return MT_OK;
}

static mt_status read_sides(netpbm *file)
{
    uint64_t width = 0, height = 0;
    mt_status status = read_number(file, "the picture's width", UINT32_MAX, &width);
    if (status == MT_OK) {
        status = read_number(file, "the picture's height", UINT32_MAX, &height);
    }
    file->width = (uint32_t)width;
    file->height = (uint32_t)height;
    return status;
}

static mt_status read_maximum(netpbm *file)
{
    uint64_t maximum = 1;
    mt_status status = read_number(file, "the largest sample, 1 to 65535", SAMPLE_LIMIT, &maximum);
    file->maximum = (uint32_t)maximum;
    return status == MT_OK && maximum == 0 ? fail_at(file, file->at, "a largest sample of 1 to 65535") : status;
}

/* One white space ends the header of a binary picture. */
static mt_status end_header(netpbm *file)
{
    if (file->at >= file->size || !is_space(file->bytes[file->at])) {
        return fail_at(file, file->at, "a line end after the header");
    }
    file->at++;
    return MT_OK;
}

static mt_status read_plain_header(netpbm *file)
{
    bool has_maximum = file->kind != '1' && file->kind != '4';
    file->depth = file->kind == '3' || file->kind == '6' ? 3 : 1;
    file->maximum = 1;
    mt_status status = read_sides(file);
    if (status == MT_OK && has_maximum) {
        status = read_maximum(file);
    }
    return status == MT_OK && file->kind >= '4' ? end_header(file) : status;
}

/* The word at the place, which moves past it. */
static size_t read_word(netpbm *file, const char **word)
{
    skip_space(file);
    size_t begin = file->at;
    while (file->at < file->size && !is_space(file->bytes[file->at])) {
        file->at++;
    }
    *word = (const char *)file->bytes + begin;
    return file->at - begin;
}

static bool ends_in(const char *word, size_t length, const char *end)
{
    size_t size = strlen(end);
    return length >= size && memcmp(word + length - size, end, size) == 0;
}

static mt_status check_tuples(const netpbm *file, bool has_alpha)
{
    if (file->depth == 0 || file->depth > 4 || has_alpha != (file->depth % 2 == 0)) {
        mt_place place = mt_input_place_offset(file->input, file->at);
        return mt_fail_at(file->context, MT_ERROR_UNSUPPORTED, place,
                          "expected grey or colour, with or without alpha, not %u channels%s", file->depth,
                          has_alpha ? " with alpha" : "");
    }
    return MT_OK;
}

static mt_status read_pam_header(netpbm *file)
{
    static const char *const names[] = {"WIDTH", "HEIGHT", "DEPTH", "MAXVAL"};
    static const uint64_t limits[] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, SAMPLE_LIMIT};
    uint64_t values[4] = {0, 0, 0, 0};
    bool has_alpha = false;
    for (;;) {
        const char *word;
        size_t length = read_word(file, &word), known = 0;
        if (length == 6 && memcmp(word, "ENDHDR", 6) == 0) {
            break;
        }
        if (length == 8 && memcmp(word, "TUPLTYPE", 8) == 0) {
            length = read_word(file, &word);
            has_alpha = has_alpha || ends_in(word, length, "_ALPHA");
            continue;
        }
        while (known < 4 && (strlen(names[known]) != length || memcmp(word, names[known], length) != 0)) {
            known++;
        }
        if (known == 4) {
            return fail_at(file, file->at - length, "WIDTH, HEIGHT, DEPTH, MAXVAL, TUPLTYPE or ENDHDR");
        }
        mt_status status = read_number(file, "a whole number", limits[known], &values[known]);
        if (status != MT_OK) {
            return status;
        }
    }
    file->width = (uint32_t)values[0], file->height = (uint32_t)values[1];
    file->depth = (uint32_t)values[2], file->maximum = (uint32_t)values[3];
    mt_status status = file->maximum ? check_tuples(file, has_alpha) : fail_at(file, file->at, "MAXVAL of 1 to 65535");
    return status == MT_OK ? end_header(file) : status;
}

static mt_status fail_past_maximum(const netpbm *file, size_t at)
{
    return mt_fail_at(file->context, MT_ERROR_SYNTAX, mt_input_place_offset(file->input, at),
                      "a sample is larger than %u, which the header declares to be the largest", file->maximum);
}

static mt_status read_binary(netpbm *file, const mt_sample_layout *layout, mt_image *image)
{
    size_t row_size = (size_t)mt_sample_row_size(layout, file->width);
    for (uint32_t y = 0; y < file->height; y++) {
        size_t wrong = mt_sample_fill_row(layout, file->bytes + file->at, image, y);
        if (wrong != SIZE_MAX) {
            return fail_past_maximum(file, file->at + wrong * (layout->bits / 8));
        }
        file->at += row_size;
    }
    return MT_OK;
}

/* The digits of a text PBM need no space between them. */
static mt_status read_bit(netpbm *file, uint64_t *bit)
{
    skip_space(file);
    if (file->at == file->size || (file->bytes[file->at] != '0' && file->bytes[file->at] != '1')) {
        return fail_at(file, file->at, "a pixel, 0 or 1");
    }
    *bit = file->bytes[file->at++] == '0';
    return MT_OK;
}

static mt_status read_text(netpbm *file, mt_image *image)
{
    size_t count = (size_t)file->width * file->height * file->depth;
    for (size_t i = 0; i < count; i++) {
        uint64_t sample = 0;
        mt_status status =
            file->kind == '1' ? read_bit(file, &sample) : read_number(file, "a sample", SAMPLE_LIMIT, &sample);
        if (status == MT_OK && sample > file->maximum) {
            status = fail_past_maximum(file, file->at);
        }
        if (status != MT_OK) {
            return status;
        }
        image->pixels[i] = (float)((double)sample / file->maximum);
    }
    skip_space(file);
    return MT_OK;
}

/* Bytes that the declared pixels take at least. */
static uint64_t least_size(const netpbm *file, const mt_sample_layout *layout)
{
    uint64_t count = (uint64_t)file->width * file->height * file->depth;
    switch (file->kind) {
    case '1':
        return count;
    case '2':
    case '3':
        return 2 * count - 1;
    default:
        return mt_sample_row_size(layout, file->width) * file->height;
    }
}

static mt_status read_pixels(netpbm *file, mt_image **out, unsigned *bits)
{
    bool is_text = file->kind <= '3';
    mt_sample_layout layout = {.channel_count = file->depth, .maximum = file->maximum};
    layout.bits = file->kind == '4' ? 1 : file->maximum > 255 ? 16 : 8;
    layout.is_inverted = file->kind == '4';
    *bits = file->maximum == 1 ? 1 : layout.bits;
    mt_status status = mt_picture_check_size(file->context, file->input, file->width, file->height);
    if (status == MT_OK) {
        status = mt_picture_check_bytes(file->context, file->input, file->size - file->at, least_size(file, &layout));
    }
    if (status == MT_OK) {
        status = mt_image_create_unfilled(file->context, file->width, file->height, mt_sample_channels(&layout), out);
    }
    if (status == MT_OK) {
        status = is_text ? read_text(file, *out) : read_binary(file, &layout, *out);
    }
    if (status == MT_OK) {
        mt_picture_warn_of_rest(file->context, file->input, file->size - file->at);
    }
    return status;
}

mt_status mt_netpbm_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits)
{
    netpbm file = {.context = context, .input = input};
    mt_status status = mt_picture_take_rest(context, input, &file.bytes, &file.size);
    if (status != MT_OK) {
        return status;
    }
    if (file.size < 2 || file.bytes[0] != 'P' || file.bytes[1] < '1' || file.bytes[1] > '7') {
        status = fail_at(&file, 0, "P1 to P7");
    } else {
        file.kind = (char)file.bytes[1];
        file.at = 2;
        status = file.kind == '7' ? read_pam_header(&file) : read_plain_header(&file);
    }
    if (status == MT_OK) {
        status = read_pixels(&file, out, bits);
    }
    mt_free(context, file.bytes);
    return status;
}

/* How sure: "P" and the digit, then white space or a comment. */
static int sniff_kinds(const uint8_t *bytes, size_t size, const char *kinds)
{
    bool is_known = size >= 3 && bytes[0] == 'P' && bytes[1] && strchr(kinds, bytes[1]);
    return is_known && (is_space(bytes[2]) || bytes[2] == '#') ? 90 : 0;
}

int mt_pbm_sniff(const uint8_t *bytes, size_t size)
{
    return sniff_kinds(bytes, size, "14");
}

int mt_pgm_sniff(const uint8_t *bytes, size_t size)
{
    return sniff_kinds(bytes, size, "25");
}

int mt_ppm_sniff(const uint8_t *bytes, size_t size)
{
    return sniff_kinds(bytes, size, "36");
}

int mt_pam_sniff(const uint8_t *bytes, size_t size)
{
    return sniff_kinds(bytes, size, "7");
}
