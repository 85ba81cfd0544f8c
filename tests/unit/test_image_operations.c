/* Operations on pictures beside their closed forms, beside brute force written another way, and by what must hold of
 * any picture. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <meshtool/alpha.h>
#include <meshtool/bayer.h>
#include <meshtool/color.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const pattern_names[] = {"RGGB", "BGGR", "GRBG", "GBRG"};

static void close_to(double got, double expected, double tolerance)
{
    if (!(fabs(got - expected) <= tolerance)) {
        fail_msg("%.9g, expected %.9g", got, expected);
    }
}

/* By the letters of the pattern's name, not by the library's table. */
static char letter_at(mt_bayer pattern, long x, long y)
{
    return pattern_names[pattern][2 * (y & 1) + (x & 1)];
}

/* The mean of the neighbours that exist and have the letter; 0 without any. */
static double reference(const mt_image *mosaic, mt_bayer pattern, long x, long y, char letter)
{
    static const long steps[8][2] = {{1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 1}};
    double sum = 0;
    int count = 0;
    if (letter_at(pattern, x, y) == letter) {
        return (double)mosaic->pixels[y * (long)mosaic->width + x];
    }
    for (int i = 0; i < 8; i++) {
        long u = x + steps[i][0], v = y + steps[i][1];
        bool is_inside = u >= 0 && v >= 0 && u < (long)mosaic->width && v < (long)mosaic->height;
        if (is_inside && letter_at(pattern, u, v) == letter) {
            sum += (double)mosaic->pixels[v * (long)mosaic->width + u];
            count++;
        }
    }
    return count ? sum / count : 0;
}

static void check_demosaic(mt_context *context, const mt_image *mosaic, mt_bayer pattern)
{
    mt_image *image = NULL;
    assert_int_equal(mt_bayer_demosaic(context, mosaic, pattern, &image), MT_OK);
    assert_int_equal(image->width, mosaic->width);
    assert_int_equal(image->height, mosaic->height);
    assert_int_equal(image->channel_count, 3);
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            for (int k = 0; k < 3; k++) {
                close_to((double)mt_image_pixel(image, x, y)[k], reference(mosaic, pattern, x, y, "RGB"[k]), 1e-7);
            }
        }
    }
    /* The filter lets through just what was there. */
    mt_image *again = NULL;
    assert_int_equal(mt_bayer_mosaic(context, image, pattern, &again), MT_OK);
    assert_memory_equal(again->pixels, mosaic->pixels, (size_t)mosaic->width * mosaic->height * sizeof(float));
    mt_image_destroy(context, again);
    mt_image_destroy(context, image);
}

static void demosaicing_is_the_mean_of_neighbours(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {3, 3}, {1, 9}, {9, 1}, {17, 12}, {40, 33}};
    test_random random = {1};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        for (int pattern = 0; pattern < 4; pattern++) {
            mt_image *mosaic = test_picture(context, &random, sizes[i][0], sizes[i][1], 1);
            check_demosaic(context, mosaic, (mt_bayer)pattern);
            mt_image_destroy(context, mosaic);
        }
    }
    test_context_end(context);
}

/* A constant colour comes back wherever each colour has a neighbour; in one pixel the others are 0. */
static void a_constant_colour_survives_the_filter(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_image *image = NULL, *mosaic = NULL, *again = NULL;
    assert_int_equal(mt_image_create(context, 8, 6, 3, &image), MT_OK);
    for (size_t i = 0; i < 8 * 6 * 3; i++) {
        image->pixels[i] = (float)(i % 3 + 1) / 4.0F;
    }
    for (int pattern = 0; pattern < 4; pattern++) {
        assert_int_equal(mt_bayer_mosaic(context, image, (mt_bayer)pattern, &mosaic), MT_OK);
        assert_int_equal(mosaic->channel_count, 1);
        assert_int_equal(mt_bayer_demosaic(context, mosaic, (mt_bayer)pattern, &again), MT_OK);
        assert_memory_equal(again->pixels, image->pixels, 8 * 6 * 3 * sizeof(float));
        mt_image_destroy(context, again);
        mt_image_destroy(context, mosaic);
    }
    mt_image_destroy(context, image);
    float sample = 0.5F;
    mt_image one = {.width = 1, .height = 1, .channel_count = 1, .pixels = &sample};
    assert_int_equal(mt_bayer_demosaic(context, &one, MT_BAYER_GRBG, &again), MT_OK);
    assert_memory_equal(again->pixels, ((float[3]){0, 0.5F, 0}), 3 * sizeof(float));
    mt_image_destroy(context, again);
    test_context_end(context);
}

static void known_colours_have_known_hues(void **state)
{
    (void)state;
    static const double known[][6] = {
        {1, 0, 0, 0, 1, 1},
        {1, 1, 0, 60, 1, 1},
        {0, 1, 0, 120, 1, 1},
        {0, 1, 1, 180, 1, 1},
        {0, 0, 1, 240, 1, 1},
        {1, 0, 1, 300, 1, 1},
        {0, 0, 0, 0, 0, 0},
        {1, 1, 1, 0, 0, 1},
        {0.5, 0.5, 0.5, 0, 0, 0.5},
        {1, 0.5, 0, 30, 1, 1},
        {0.25, 0.5, 0.75, 210, 2.0 / 3, 0.75},
        {1, 0, 0.5, 330, 1, 1},
        {0.5, 0.25, 0.25, 0, 0.5, 0.5},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        double hsv[3], rgb[3];
        mt_rgb_to_hsv(known[i], hsv);
        mt_hsv_to_rgb(known[i] + 3, rgb);
        for (int k = 0; k < 3; k++) {
            close_to(hsv[k], known[i][3 + k], 1e-12);
            close_to(rgb[k], known[i][k], 1e-12);
        }
    }
    double turned[3];
    mt_hsv_to_rgb((double[3]){-120, 1, 1}, turned);
    assert_memory_equal(turned, ((double[3]){0, 0, 1}), sizeof turned);
    mt_hsv_to_rgb((double[3]){3600 + 60, 1, 1}, turned);
    assert_memory_equal(turned, ((double[3]){1, 1, 0}), sizeof turned);
}

static void hues_round_trip(void **state)
{
    (void)state;
    test_random random = {2};
    mt_context *context = test_context();
    for (uint32_t channels = 3; channels <= 4; channels++) {
        mt_image *image = test_picture(context, &random, 101, 57, channels);
        mt_image *copy = NULL;
        double mean;
        assert_int_equal(channels == 3 ? mt_image_drop_alpha(context, image, &copy)
                                       : mt_image_add_alpha(context, image, &copy),
                         MT_OK);
        assert_int_equal(mt_image_rgb_to_hsv(context, copy), MT_OK);
        for (size_t i = 0; i < 101 * 57; i++) {
            const float *hsv = copy->pixels + i * channels;
            assert_true(hsv[0] >= 0 && hsv[0] < 360 && hsv[1] >= 0 && hsv[1] <= 1 && hsv[2] >= 0 && hsv[2] <= 1);
        }
        assert_int_equal(mt_image_hsv_to_rgb(context, copy), MT_OK);
        assert_true(test_picture_difference(image, copy, &mean) < 1e-6);
        mt_image_destroy(context, copy);
        mt_image_destroy(context, image);
    }
    /* Hues just below 0 do not become 360. */
    float almost[3] = {1, 0, 1e-9F};
    mt_image one = {.width = 1, .height = 1, .channel_count = 3, .pixels = almost};
    assert_int_equal(mt_image_rgb_to_hsv(context, &one), MT_OK);
    assert_true(almost[0] < 360);
    mt_image *grey = test_picture(context, &random, 3, 3, 1);
    assert_int_equal(mt_image_rgb_to_hsv(context, grey), MT_ERROR_UNSUPPORTED);
    mt_image_destroy(context, grey);
    test_context_end(context);
}

static mt_image *copy_of(mt_context *context, const mt_image *image)
{
    mt_image *copy = NULL;
    assert_int_equal(mt_image_create(context, image->width, image->height, image->channel_count, &copy), MT_OK);
    memcpy(copy->pixels, image->pixels, (size_t)image->width * image->height * image->channel_count * sizeof(float));
    return copy;
}

/* Shifts add up, whole turns change nothing, thirds permute the channels; saturation 0 leaves the largest channel. */
static void hue_and_saturation_keep_their_laws(void **state)
{
    (void)state;
    test_random random = {3};
    mt_context *context = test_context();
    mt_image *image = test_picture(context, &random, 64, 20, 4), *a = copy_of(context, image),
             *b = copy_of(context, image);
    double mean;
    assert_int_equal(mt_image_shift_hue(context, a, 50), MT_OK);
    assert_int_equal(mt_image_shift_hue(context, a, -410), MT_OK);
    assert_true(test_picture_difference(image, a, &mean) < 1e-6);
    assert_int_equal(mt_image_shift_hue(context, b, 120), MT_OK);
    assert_int_equal(mt_image_shift_hue(context, a, -240), MT_OK);
    for (size_t i = 0; i < 64 * 20; i++) {
        const float *old = image->pixels + 4 * i, *one = b->pixels + 4 * i, *two = a->pixels + 4 * i;
        for (int k = 0; k < 3; k++) {
            close_to((double)one[(k + 1) % 3], (double)old[k], 1e-6);
            close_to((double)two[(k + 1) % 3], (double)old[k], 1e-6);
        }
        assert_true(one[3] == old[3] && two[3] == old[3]);
    }
    mt_image_destroy(context, a);
    a = copy_of(context, image);
    assert_int_equal(mt_image_desaturate(context, a, 0), MT_OK);
    assert_true(test_picture_difference(image, a, &mean) < 1e-6);
    assert_int_equal(mt_image_desaturate(context, a, 0.25), MT_OK);
    for (size_t i = 0; i < 64 * 20; i++) {
        const float *old = image->pixels + 4 * i, *new = a->pixels + 4 * i;
        double largest = fmax(fmax((double)old[0], (double)old[1]), (double)old[2]);
        for (int k = 0; k < 3; k++) {
            close_to((double)new[k], largest - 0.75 * (largest - (double)old[k]), 1e-6);
        }
    }
    assert_int_equal(mt_image_desaturate(context, a, 1), MT_OK);
    for (size_t i = 0; i < 64 * 20; i++) {
        const float *new = a->pixels + 4 * i;
        assert_true(new[0] == new[1] && new[1] == new[2]);
    }
    assert_int_equal(mt_image_desaturate(context, a, 1.5), MT_ERROR_ARGUMENT);
    mt_context_clear_error(context);
    assert_int_equal(mt_image_shift_hue(context, a, (double)NAN), MT_ERROR_ARGUMENT);
    mt_image_destroy(context, a);
    mt_image_destroy(context, b);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static void luminance_weighs_green_most(void **state)
{
    (void)state;
    test_random random = {4};
    mt_context *context = test_context();
    for (uint32_t channels = 1; channels <= 4; channels += channels == 1 ? 2 : 1) {
        mt_image *image = test_picture(context, &random, 31, 17, channels), *grey = NULL;
        assert_int_equal(mt_image_luminance(context, image, &grey), MT_OK);
        assert_int_equal(grey->channel_count, channels == 4 ? 4 : 1);
        for (size_t i = 0; i < 31 * 17; i++) {
            const float *from = image->pixels + i * channels, *to = grey->pixels + i * grey->channel_count;
            double expected = channels == 1
                                  ? (double)from[0]
                                  : 0.2126 * (double)from[0] + 0.7152 * (double)from[1] + 0.0722 * (double)from[2];
            close_to((double)to[0], expected, 1e-7);
            assert_true(channels < 4 || (to[1] == to[0] && to[2] == to[0] && to[3] == from[3]));
        }
        mt_image_destroy(context, grey);
        mt_image_destroy(context, image);
    }
    test_context_end(context);
}

static void over_obeys_porter_and_duff(void **state)
{
    (void)state;
    test_random random = {5};
    mt_context *context = test_context();
    mt_image *front = test_picture(context, &random, 23, 11, 4), *over = NULL, *again = NULL;
    const double color[3] = {0.25, 0.5, 1};
    for (size_t i = 0; i < 23 * 11; i++) {
        front->pixels[4 * i + 3] = i % 3 == 0 ? 0.0F : i % 3 == 1 ? 1.0F : front->pixels[4 * i + 3];
    }
    assert_int_equal(mt_image_over_color(context, front, color, &over), MT_OK);
    assert_int_equal(over->channel_count, 3);
    for (size_t i = 0; i < 23 * 11; i++) {
        const float *from = front->pixels + 4 * i, *to = over->pixels + 3 * i;
        double alpha = (double)from[3];
        for (int k = 0; k < 3; k++) {
            close_to((double)to[k], alpha * (double)from[k] + (1 - alpha) * color[k], 1e-7);
            assert_true(i % 3 != 0 || to[k] == (float)color[k]);
            assert_true(i % 3 != 1 || to[k] == from[k]);
        }
    }
    /* The same when the colours were multiplied first. */
    assert_int_equal(mt_image_premultiply(context, front), MT_OK);
    assert_true(front->is_premultiplied);
    assert_int_equal(mt_image_over_color(context, front, color, &again), MT_OK);
    double mean;
    assert_true(test_picture_difference(over, again, &mean) < 1e-6);
    mt_image_destroy(context, again);
    mt_image_destroy(context, over);
    mt_image_destroy(context, front);
    test_context_end(context);
}

/* Laying one over another, and that over a third, is the same in either order of doing it. */
static void over_is_associative(void **state)
{
    (void)state;
    test_random random = {6};
    mt_context *context = test_context();
    mt_image *a = test_picture(context, &random, 20, 10, 4), *b = test_picture(context, &random, 20, 10, 4);
    mt_image *c = test_picture(context, &random, 20, 10, 3), *ab = NULL, *bc = NULL, *left = NULL, *right = NULL;
    assert_int_equal(mt_image_over(context, a, b, &ab), MT_OK);
    assert_int_equal(ab->channel_count, 4);
    assert_int_equal(mt_image_over(context, ab, c, &left), MT_OK);
    assert_int_equal(mt_image_over(context, b, c, &bc), MT_OK);
    assert_int_equal(mt_image_over(context, a, bc, &right), MT_OK);
    double mean;
    assert_true(test_picture_difference(left, right, &mean) < 1e-6);
    mt_image *other = test_picture(context, &random, 20, 11, 3), *none = NULL;
    assert_int_equal(mt_image_over(context, a, other, &none), MT_ERROR_UNSUPPORTED);
    assert_null(none);
    mt_image *all[] = {a, b, c, ab, bc, left, right, other};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mt_image_destroy(context, all[i]);
    }
    test_context_end(context);
}

static void alpha_comes_and_goes(void **state)
{
    (void)state;
    test_random random = {7};
    mt_context *context = test_context();
    mt_image *image = test_picture(context, &random, 19, 7, 3), *with = NULL, *without = NULL;
    assert_int_equal(mt_image_add_alpha(context, image, &with), MT_OK);
    assert_true(test_picture_coverage(with) == 1.0);
    assert_int_equal(mt_image_drop_alpha(context, with, &without), MT_OK);
    assert_memory_equal(without->pixels, image->pixels, 19 * 7 * 3 * sizeof(float));
    for (size_t i = 0; i < 19 * 7; i++) {
        with->pixels[4 * i + 3] = i % 5 == 0 ? 0.0F : 0.5F;
    }
    mt_image *old = copy_of(context, with);
    assert_int_equal(mt_image_premultiply(context, with), MT_OK);
    assert_true(with->pixels[4] == 0.5F * old->pixels[4] && with->pixels[0] == 0.0F);
    assert_int_equal(mt_image_premultiply(context, with), MT_OK); /* once is enough */
    assert_true(with->pixels[4] == 0.5F * old->pixels[4]);
    assert_int_equal(mt_image_unpremultiply(context, with), MT_OK);
    for (size_t i = 0; i < 19 * 7; i++) {
        for (size_t k = 0; k < 3; k++) {
            assert_true(with->pixels[4 * i + k] == (i % 5 == 0 ? 0.0F : old->pixels[4 * i + k]));
        }
    }
    mt_image *all[] = {image, with, without, old};
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mt_image_destroy(context, all[i]);
    }
    test_context_end(context);
}

static void light_and_back(void **state)
{
    (void)state;
    test_random random = {8};
    mt_context *context = test_context();
    mt_image *image = test_picture(context, &random, 50, 40, 4), *light = copy_of(context, image);
    assert_int_equal(mt_image_to_linear(context, light), MT_OK);
    assert_int_equal(light->space, MT_COLOR_LINEAR);
    for (size_t i = 0; i < 50 * 40 * 4; i++) {
        double encoded = (double)image->pixels[i], expected = encoded;
        if (i % 4 < 3) {
            expected = encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
        }
        close_to((double)light->pixels[i], expected, 1e-7);
    }
    mt_image *twice = copy_of(context, light);
    twice->space = MT_COLOR_LINEAR;
    assert_int_equal(mt_image_to_linear(context, twice), MT_OK);
    assert_memory_equal(twice->pixels, light->pixels, 50 * 40 * 4 * sizeof(float));
    assert_int_equal(mt_image_to_srgb(context, light), MT_OK);
    assert_int_equal(light->space, MT_COLOR_STORED);
    double mean;
    assert_true(test_picture_difference(image, light, &mean) < 1e-6);
    mt_image_destroy(context, twice);
    mt_image_destroy(context, light);
    mt_image_destroy(context, image);
    test_context_end(context);
}

/* Everything gives the same bytes on any number of threads. */
static void threads_change_nothing(void **state)
{
    (void)state;
    float *first = NULL;
    for (unsigned threads = 1; threads <= 8; threads *= 2) {
        test_random random = {9};
        mt_context *context = test_context_with_threads(threads);
        mt_image *image = test_picture(context, &random, 200, 150, 3), *mosaic = NULL, *out = NULL;
        assert_int_equal(mt_image_to_linear(context, image), MT_OK);
        assert_int_equal(mt_image_shift_hue(context, image, 77), MT_OK);
        assert_int_equal(mt_bayer_mosaic(context, image, MT_BAYER_GBRG, &mosaic), MT_OK);
        assert_int_equal(mt_bayer_demosaic(context, mosaic, MT_BAYER_GBRG, &out), MT_OK);
        size_t size = (size_t)200 * 150 * 3 * sizeof(float);
        if (!first) {
            first = malloc(size);
            memcpy(first, out->pixels, size);
        }
        assert_memory_equal(first, out->pixels, size);
        mt_image_destroy(context, out);
        mt_image_destroy(context, mosaic);
        mt_image_destroy(context, image);
        test_context_end(context);
    }
    free(first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(demosaicing_is_the_mean_of_neighbours),
        cmocka_unit_test(a_constant_colour_survives_the_filter),
        cmocka_unit_test(known_colours_have_known_hues),
        cmocka_unit_test(hues_round_trip),
        cmocka_unit_test(hue_and_saturation_keep_their_laws),
        cmocka_unit_test(luminance_weighs_green_most),
        cmocka_unit_test(over_obeys_porter_and_duff),
        cmocka_unit_test(over_is_associative),
        cmocka_unit_test(alpha_comes_and_goes),
        cmocka_unit_test(light_and_back),
        cmocka_unit_test(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
