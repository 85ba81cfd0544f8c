/* PNG files, decoded again by libspng and compared sample by sample. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <spng.h>

#include <stdlib.h>
#include <string.h>

/* Decodes a PNG file and compares it with what the encoder gives. */
static void compare(mt_context *context, const mt_image *image, unsigned bits)
{
    size_t size = 0, decoded_size = 0;
    unsigned char *bytes = test_picture_file(context, image, "png", bits, &size);
    spng_ctx *png = spng_ctx_new(0);
    assert_int_equal(spng_set_png_buffer(png, bytes, size), 0);
    struct spng_ihdr header;
    assert_int_equal(spng_get_ihdr(png, &header), 0);
    assert_int_equal(header.width, image->width);
    assert_int_equal(header.height, image->height);
    assert_int_equal(header.bit_depth, bits);
    static const int color_types[] = {0, SPNG_COLOR_TYPE_GRAYSCALE, 0, SPNG_COLOR_TYPE_TRUECOLOR,
                                      SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
    assert_int_equal(header.color_type, color_types[image->channel_count]);
    uint8_t intent = 9;
    assert_int_equal(spng_get_srgb(png, &intent), 0);
    assert_int_equal(spng_decoded_image_size(png, SPNG_FMT_RAW, &decoded_size), 0);
    unsigned char *decoded = malloc(decoded_size), *expected = malloc(decoded_size);
    assert_int_equal(spng_decode_image(png, decoded, decoded_size, SPNG_FMT_RAW, 0), 0);
    mt_image_encoder *encoder = NULL;
    assert_int_equal(mt_image_encoder_create(context, image, bits, &encoder), MT_OK);
    assert_int_equal(decoded_size, image->height * mt_image_encoder_row_size(encoder));
    mt_image_encode_rows(context, encoder, 0, image->height, expected);
    assert_memory_equal(decoded, expected, decoded_size);
    mt_image_encoder_destroy(context, encoder);
    free(decoded);
    free(expected);
    spng_ctx_free(png);
    mt_free(context, bytes);
}

static void every_kind_comes_back(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {3, 5}, {1, 200}, {257, 3}, {640, 480}, {65535, 1}, {300, 2500}};
    test_random random = {11};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (uint32_t channels = 1; channels <= 4; channels += channels == 1 ? 2 : 1) {
            mt_image *image = test_picture(context, &random, sizes[i][0], sizes[i][1], channels);
            compare(context, image, 8);
            image->space = MT_COLOR_LINEAR;
            compare(context, image, 8);
            compare(context, image, 16);
            mt_image_destroy(context, image);
        }
    }
    test_context_end(context);
}

static void smooth_pictures_are_small(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_image *image = NULL;
    assert_int_equal(mt_image_create(context, 512, 512, 3, &image), MT_OK);
    for (uint32_t y = 0; y < 512; y++) {
        for (uint32_t x = 0; x < 512; x++) {
            mt_image_pixel(image, x, y)[0] = (float)y / 512.0F;
        }
    }
    size_t size = 0;
    unsigned char *bytes = test_picture_file(context, image, "png", 8, &size);
    assert_true(size < 512 * 512 * 3 / 50);
    mt_free(context, bytes);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static void the_same_picture_gives_the_same_file(void **state)
{
    (void)state;
    uint64_t hashes[2];
    for (unsigned i = 0; i < 2; i++) {
        mt_context *context = test_context_with_threads(i == 0 ? 1 : 5);
        test_random random = {4};
        mt_image *image = test_picture(context, &random, 300, 300, 4);
        size_t size = 0;
        unsigned char *bytes = test_picture_file(context, image, "png", 8, &size);
        hashes[i] = test_hash(bytes, size);
        mt_free(context, bytes);
        mt_image_destroy(context, image);
        test_context_end(context);
    }
    assert_true(hashes[0] == hashes[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_comes_back),
        cmocka_unit_test(smooth_pictures_are_small),
        cmocka_unit_test(the_same_picture_gives_the_same_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
