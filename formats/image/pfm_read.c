/* Reading portable float maps: "PF" colour or "Pf" grey, the sides, a scale whose sign tells the order of bytes, then
 * the rows from the bottom up. The scale's size says what 1 stands for in some unit; the numbers are taken as they are.
 */
#include "formats/image/image_format.h"
#include "formats/image/samples.h"

#include "formats/stream/number.h"

#include <string.h>

#define HEADER_SIZE 256 /* longer ones are none */

typedef struct pfm_header {
    uint32_t channel_count;
    uint64_t width, height;
    double scale;
    size_t size; /* bytes up to the first row */
} pfm_header;

static bool is_space(char byte)
{
    return byte == ' ' || byte == '\t' || byte == '\n' || byte == '\r';
}

/* The next word, made a string in `room`; "" when there is none. */
static const char *next_word(const char *text, size_t size, size_t *at, char room[32])
{
    size_t length = 0;
    while (*at < size && is_space(text[*at])) {
        ++*at;
    }
    while (*at < size && !is_space(text[*at]) && length < 31) {
        room[length++] = text[(*at)++];
    }
    room[length] = '\0';
    return room;
}

static bool parse_side(const char *word, uint64_t *side)
{
    *side = 0;
    for (; *word >= '0' && *word <= '9' && *side <= UINT32_MAX; word++) {
        *side = 10 * *side + (uint64_t)(*word - '0');
    }
    return *word == '\0' && *side <= UINT32_MAX;
}

static bool parse_scale(const char *word, double *scale)
{
    const char *end = word + strlen(word), *stop;
    return mt_number_parse(word, end, scale, &stop) == MT_NUMBER_OK && stop == end && *scale != 0.0 &&
           *scale - *scale == 0.0;
}

/* False: *wrong names what was expected at the header's size. */
static bool parse_header(const char *text, size_t size, pfm_header *header, const char **expected)
{
    char word[32];
    size_t at = 2;
    header->channel_count = size >= 2 && text[1] == 'F' ? 3 : 1;
    *expected = "PF or Pf";
    if (size < 3 || text[0] != 'P' || (text[1] != 'F' && text[1] != 'f') || !is_space(text[2])) {
        return false;
    }
    *expected = "the picture's width and height";
    bool is_fine = parse_side(next_word(text, size, &at, word), &header->width) && word[0];
    is_fine = is_fine && parse_side(next_word(text, size, &at, word), &header->height) && word[0];
    if (is_fine) {
        *expected = "a scale that is not 0, and a line end";
        is_fine = parse_scale(next_word(text, size, &at, word), &header->scale) && at < size && is_space(text[at]);
    }
    header->size = at + (size_t)is_fine;
    return is_fine;
}

static void load_floats(const uint8_t *bytes, size_t count, bool is_little, float *values)
{
    for (size_t i = 0; i < count; i++) {
        uint32_t word = 0;
        for (unsigned k = 0; k < 4; k++) {
            word |= (uint32_t)bytes[4 * i + k] << (is_little ? 8 * k : 24 - 8 * k);
        }
        memcpy(values + i, &word, sizeof word);
    }
}

static mt_status read_rows(mt_context *context, mt_input *input, const pfm_header *header, mt_image *image)
{
    size_t count = (size_t)image->width * image->channel_count;
    uint8_t *row = mt_allocate_array(context, count, 4);
    mt_status status = row ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    for (uint32_t y = image->height; y > 0 && status == MT_OK; y--) {
        status = mt_input_read_exactly(context, input, row, count * 4, "a row of floats");
        if (status == MT_OK) {
            load_floats(row, count, header->scale < 0, mt_image_pixel(image, 0, y - 1));
        }
    }
    mt_free(context, row);
    return status;
}

mt_status mt_pfm_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits)
{
    pfm_header header = {0};
    const uint8_t *bytes;
    size_t size;
    const char *expected;
    char skipped[HEADER_SIZE];
    mt_status status = mt_input_peek(context, input, &bytes, &size);
    if (status != MT_OK) {
        return status;
    }
    if (!parse_header((const char *)bytes, size < HEADER_SIZE ? size : HEADER_SIZE, &header, &expected)) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, mt_input_place_offset(input, header.size), "expected %s", expected);
    }
    status = mt_input_read_exactly(context, input, skipped, header.size, "a header");
    if (status == MT_OK) {
        status = mt_input_collect(context, input);
    }
    if (status == MT_OK) {
        status = mt_picture_check_size(context, input, header.width, header.height);
    }
    uint64_t body = header.width * header.height * header.channel_count * 4, left = mt_input_size(input) - header.size;
    if (status == MT_OK) {
        status = mt_picture_check_bytes(context, input, left, body);
    }
    if (status == MT_OK) {
        status = mt_image_create_unfilled(context, (uint32_t)header.width, (uint32_t)header.height,
                                          header.channel_count, out);
    }
    if (status == MT_OK) {
        *bits = 32;
        status = read_rows(context, input, &header, *out);
    }
    if (status == MT_OK) {
        mt_picture_warn_of_rest(context, input, left - body);
    }
    return status;
}

int mt_pfm_sniff(const uint8_t *bytes, size_t size)
{
    return size >= 3 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') && is_space((char)bytes[2]) ? 90 : 0;
}
