/* Float pictures, the sRGB curve, and their encoding to 8 and 16 bits. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/image.h>

#include <math.h>

static void a_new_picture_is_zero(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_image *image = NULL;
    assert_int_equal(mt_image_create(context, 7, 5, 3, &image), MT_OK);
    for (int i = 0; i < 7 * 5 * 3; i++) {
        assert_true(image->pixels[i] == 0.0F);
    }
    assert_ptr_equal(mt_image_pixel(image, 6, 4), image->pixels + 3 * 34);
    mt_image_destroy(context, image);
    mt_image_destroy(context, NULL);
    test_context_end(context);
}

static void impossible_pictures_are_refused(void **state)
{
    (void)state;
    static const struct {
        uint32_t width, height, channel_count;
        mt_status status;
    } rows[] = {{0, 5, 3, MT_ERROR_ARGUMENT},
                {5, 0, 3, MT_ERROR_ARGUMENT},
                {5, 5, 2, MT_ERROR_ARGUMENT},
                {5, 5, 0, MT_ERROR_ARGUMENT},
                {UINT32_MAX, UINT32_MAX, 4, MT_ERROR_TOO_LARGE}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_context *context = test_context();
        mt_image *image = NULL;
        assert_int_equal(mt_image_create(context, rows[i].width, rows[i].height, rows[i].channel_count, &image),
                         rows[i].status);
        assert_null(image);
        test_context_end(context);
    }
}

/* Values of IEC 61966-2-1, computed with 40 digits. */
static void the_curve_is_srgb(void **state)
{
    (void)state;
    static const double rows[][2] = {{0, 0},
                                     {0.0031308, 0.040449936},
                                     {0.5, 0.735356983052449},
                                     {0.18, 0.461356129500442},
                                     {0.01, 0.0998528227341719},
                                     {1, 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_true(fabs(mt_srgb_encode(rows[i][0]) - rows[i][1]) < 1e-9);
        assert_true(fabs(mt_srgb_decode(rows[i][1]) - rows[i][0]) < 1e-9);
    }
    double last = -1;
    for (int i = 0; i <= 10000; i++) {
        double x = i / 10000.0, encoded = mt_srgb_encode(x);
        assert_true(encoded > last);
        assert_true(fabs(mt_srgb_decode(encoded) - x) < 1e-7);
        last = encoded;
    }
}

static void values_outside_are_clamped(void **state)
{
    (void)state;
    assert_true(mt_srgb_encode(-1) == 0);
    assert_true(mt_srgb_encode(2) == 1);
    assert_true(mt_srgb_encode((double)NAN) == 0);
    assert_true(mt_srgb_decode((double)-INFINITY) == 0);
    assert_true(mt_srgb_decode((double)INFINITY) == 1);
    assert_true(mt_srgb_decode((double)NAN) == 0);
}

static unsigned nearest_byte(double linear)
{
    return (unsigned)(mt_srgb_encode(linear) * 255.0 + 0.5);
}

/* One row of values through the encoder. */
static void encode(mt_context *context, const float *values, uint32_t count, uint32_t channels, mt_color_space space,
                   unsigned bits, unsigned char *bytes)
{
    mt_image image = {.width = count / channels,
                      .height = 1,
                      .channel_count = channels,
                      .space = space,
                      .pixels = (float *)(uintptr_t)values};
    mt_image_encoder *encoder = NULL;
    assert_int_equal(mt_image_encoder_create(context, &image, bits, &encoder), MT_OK);
    assert_int_equal(mt_image_encoder_row_size(encoder), count * bits / 8);
    mt_image_encode_rows(context, encoder, 0, 1, bytes);
    mt_image_encoder_destroy(context, encoder);
}

static void bytes_are_the_nearest(void **state)
{
    (void)state;
    enum { COUNT = 60000 };
    mt_context *context = test_context();
    float *values = mt_allocate_array(context, COUNT, sizeof *values);
    unsigned char *bytes = mt_allocate(context, COUNT);
    test_random random = {7};
    for (int i = 0; i < COUNT; i++) {
        values[i] = (float)test_random_unit(&random);
    }
    /* Both sides of every step between two bytes. */
    for (int k = 0; k < 255; k++) {
        float step = (float)mt_srgb_decode((k + 0.5) / 255.0);
        values[3 * k] = nextafterf(step, 0.0F);
        values[3 * k + 1] = step;
        values[3 * k + 2] = nextafterf(step, 1.0F);
    }
    encode(context, values, COUNT, 1, MT_COLOR_LINEAR, 8, bytes);
    for (int i = 0; i < COUNT; i++) {
        double exact = mt_srgb_encode((double)values[i]) * 255.0;
        assert_true(bytes[i] == nearest_byte((double)values[i]) || fabs(exact - bytes[i]) < 0.5 + 1e-9);
    }
    encode(context, values, COUNT, 1, MT_COLOR_STORED, 8, bytes);
    for (int i = 0; i < COUNT; i++) {
        assert_true(fabs((double)values[i] * 255.0 - bytes[i]) <= 0.5 + 1e-5);
    }
    mt_free(context, values);
    mt_free(context, bytes);
    test_context_end(context);
}

static void sixteen_bits_have_the_high_byte_first(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const float values[] = {0.0F, 1.0F, 0.5F, 0.5F, -3.0F, NAN, 7.0F, 0.25F};
    unsigned char bytes[16];
    encode(context, values, 8, 4, MT_COLOR_LINEAR, 16, bytes);
    unsigned curve = (unsigned)(mt_srgb_encode(0.5) * 65535.0 + 0.5);
    assert_int_equal(bytes[0] << 8 | bytes[1], 0);
    assert_int_equal(bytes[2] << 8 | bytes[3], 65535);
    assert_int_equal(bytes[4] << 8 | bytes[5], curve);
    assert_int_equal(bytes[6] << 8 | bytes[7], 32768); /* alpha is not curved */
    assert_int_equal(bytes[8] << 8 | bytes[9], 0);
    assert_int_equal(bytes[10] << 8 | bytes[11], 0);
    assert_int_equal(bytes[12] << 8 | bytes[13], 65535);
    assert_int_equal(bytes[14] << 8 | bytes[15], 16384);
    encode(context, values, 8, 4, MT_COLOR_LINEAR, 8, bytes);
    assert_int_equal(bytes[2], nearest_byte(0.5));
    assert_int_equal(bytes[3], 128);
    assert_int_equal(bytes[5], 0);
    test_context_end(context);
}

static void other_depths_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    float pixel = 0;
    mt_image image = {.width = 1, .height = 1, .channel_count = 1, .space = MT_COLOR_LINEAR, .pixels = &pixel};
    mt_image_encoder *encoder = NULL;
    assert_int_equal(mt_image_encoder_create(context, &image, 12, &encoder), MT_ERROR_ARGUMENT);
    assert_null(encoder);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_new_picture_is_zero),    cmocka_unit_test(impossible_pictures_are_refused),
        cmocka_unit_test(the_curve_is_srgb),        cmocka_unit_test(values_outside_are_clamped),
        cmocka_unit_test(bytes_are_the_nearest),    cmocka_unit_test(sixteen_bits_have_the_high_byte_first),
        cmocka_unit_test(other_depths_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
