/* Reading pictures: what is written comes back from every format, what netpbm's text may look like, and what is
 * refused. Cuts, flipped bits and missing memory go over the table of formats. Other programs' files are in
 * tests/cli/test_image.sh. */
#include "tests/support/picture.h"
#include "tests/support/scratch.h"
#include "tests/support/text_reading.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether the format holds pictures of so many channels. */
static bool holds(const mt_image_format *format, uint32_t channels)
{
    bool is_grey_only = strcmp(format->name, "pgm") == 0 || strcmp(format->name, "pbm") == 0;
    return channels == 1 || (!is_grey_only && (channels == 3 || format->holds_alpha));
}

static unsigned default_bits(const mt_image_format *format)
{
    return strcmp(format->name, "pfm") == 0 ? 32 : strcmp(format->name, "pbm") == 0 ? 1 : 8;
}

static mt_image *read_back(mt_context *context, const mt_image_format *format, const void *bytes, size_t size,
                           unsigned bits)
{
    mt_image *image = NULL;
    mt_image_source source;
    if (mt_image_read_memory(context, "picture", bytes, size, NULL, &image, &source) != MT_OK) {
        fail_msg("%s: %s", format->name, mt_context_error(context)->message);
    }
    /* A grey picture that was called .ppm is a PGM. */
    assert_true(source.format == format || source.format->read == format->read);
    assert_int_equal(source.bits, bits);
    return image;
}

static void check_round_trip(mt_context *context, const mt_image_format *format, uint32_t channels, unsigned bits)
{
    test_random random = {channels + bits};
    mt_image *image = test_picture(context, &random, 37, 23, channels);
    double levels = bits >= 32 ? 0 : pow(2, bits) - 1, mean;
    bool is_lossy = strcmp(format->name, "jpeg") == 0;
    for (size_t i = 0; levels > 0 && !is_lossy && i < (size_t)37 * 23 * channels; i++) {
        image->pixels[i] = (float)(floor((double)image->pixels[i] * levels + 0.5) / levels);
    }
    for (size_t i = 0; is_lossy && i < (size_t)37 * 23 * channels; i++) { /* smooth: noise is what JPEG drops */
        image->pixels[i] = (float)(0.5 + 0.4 * sin((double)i / channels / 100));
    }
    size_t size;
    unsigned char *bytes =
        test_picture_file(context, image, format->name, bits == 1 && default_bits(format) == 1 ? 0 : bits, &size);
    mt_image *again = read_back(context, format, bytes, size, bits);
    assert_int_equal(again->space, MT_COLOR_STORED);
    double worst = test_picture_difference(image, again, &mean);
    if (is_lossy ? mean > 0.01 : worst != 0) {
        fail_msg("%s, %u channels of %u bits: %g away", format->name, channels, bits, worst);
    }
    mt_image_destroy(context, again);
    mt_image_destroy(context, image);
    mt_free(context, bytes);
}

static void what_is_written_comes_back(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        bool is_tiff = strcmp((*format)->name, "tiff") == 0, is_jpeg = strcmp((*format)->name, "jpeg") == 0;
        for (uint32_t channels = 1; channels <= 4; channels += channels == 1 ? 2 : 1) {
            if (!holds(*format, channels)) {
                continue;
            }
            check_round_trip(context, *format, channels, default_bits(*format));
            if (default_bits(*format) == 8 && !is_jpeg) {
                check_round_trip(context, *format, channels, 16);
            }
            if (is_tiff) {
                check_round_trip(context, *format, channels, 32);
            }
        }
        if (is_tiff) {
            check_round_trip(context, *format, 1, 1);
        }
    }
    test_context_end(context);
}

/* A file in every format, small. */
static unsigned char *small_file(mt_context *context, const mt_image_format *format, size_t *size)
{
    test_random random = {12};
    mt_image *image = test_picture(context, &random, 9, 7, holds(format, 4) ? 4 : holds(format, 3) ? 3 : 1);
    unsigned char *bytes = test_picture_file(context, image, format->name, 0, size);
    mt_image_destroy(context, image);
    return bytes;
}

/* Reads bytes that may be bad: a picture of the size given at most, or a failure with a sentence. */
static mt_status try_bytes(mt_context *context, const mt_image_format *format, const void *bytes, size_t size,
                           uint64_t *pixels)
{
    mt_image *image = NULL;
    mt_image_read_options options = {.format = format->extensions[0]};
    uint64_t before = mt_context_bytes(context);
    mt_context_clear_error(context);
    mt_status status = mt_image_read_memory(context, "bad", bytes, size, &options, &image, NULL);
    *pixels = image ? (uint64_t)image->width * image->height : 0;
    assert_true((image != NULL) == (status == MT_OK));
    assert_int_equal(mt_context_error(context)->status, status);
    if (status == MT_ERROR_INTERNAL || (status != MT_OK && !mt_context_error(context)->message[0])) {
        fail_msg("%s of %zu bytes: status %d, \"%s\"", format->name, size, status, mt_context_error(context)->message);
    }
    mt_image_destroy(context, image);
    assert_int_equal(mt_context_bytes(context), before);
    return status;
}

static void every_cut_is_refused(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(1);
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        size_t size;
        uint64_t pixels;
        unsigned char *bytes = small_file(context, *format, &size);
        assert_int_equal(try_bytes(context, *format, bytes, size, &pixels), MT_OK);
        for (size_t cut = 0; cut < size; cut++) {
            mt_status status = try_bytes(context, *format, bytes, cut, &pixels);
            if (status != MT_ERROR_SYNTAX && status != MT_ERROR_UNSUPPORTED && status != MT_ERROR_TOO_LARGE) {
                fail_msg("%s cut at %zu of %zu: status %d", (*format)->name, cut, size, status);
            }
        }
        mt_free(context, bytes);
    }
    test_context_end(context);
}

/* One bit after the other: whatever it makes of the file, nothing crashes or leaks, and no more than a few megabytes
 * are taken for a few hundred bytes. */
static void flipped_bits_do_no_harm(void **state)
{
    (void)state;
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        mt_context *context = test_context_with_threads(1);
        size_t size, counts[2] = {0, 0};
        uint64_t pixels;
        unsigned char *bytes = small_file(context, *format, &size);
        for (size_t bit = 0; bit < 8 * size; bit++) {
            bytes[bit / 8] ^= (unsigned char)(1u << (bit % 8));
            counts[try_bytes(context, *format, bytes, size, &pixels) == MT_OK]++;
            bytes[bit / 8] ^= (unsigned char)(1u << (bit % 8));
        }
        print_message("%s: %zu flips read, %zu refused, at most %llu bytes\n", (*format)->name, counts[1], counts[0],
                      (unsigned long long)mt_context_peak_bytes(context));
        assert_true(mt_context_peak_bytes(context) < (uint64_t)256 << 20);
        mt_free(context, bytes);
        test_context_end(context);
    }
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    mt_context *all = test_context();
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        size_t size;
        unsigned char *bytes = small_file(all, *format, &size);
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        for (uint64_t n = 1; status != MT_OK; n++) {
            mt_context_options options = {.failing_allocation = n, .thread_count = 1};
            mt_context *context = mt_context_create(&options);
            mt_image *image = NULL;
            void *written = NULL;
            size_t written_size;
            mt_image_write_options to = {.format = (*format)->name};
            status = mt_image_read_memory(context, "picture", bytes, size, NULL, &image, NULL);
            status = status == MT_OK ? mt_image_write_memory(context, image, &to, &written, &written_size) : status;
            if (status != MT_OK && (status != MT_ERROR_OUT_OF_MEMORY || mt_context_error(context)->status != status)) {
                fail_msg("%s without allocation %llu: status %d", (*format)->name, (unsigned long long)n, status);
            }
            mt_free(context, written);
            mt_image_destroy(context, image);
            assert_true(n < 200);
            test_context_end(context);
        }
        mt_free(all, bytes);
    }
    test_context_end(all);
}

static void refuse(const char *bytes, size_t size, mt_status status, const char *words)
{
    mt_context_options options = {.thread_count = 1};
    mt_context *context = mt_context_create(&options);
    mt_image *image = NULL;
    mt_status got = mt_image_read_memory(context, "bad", bytes, size, NULL, &image, NULL);
    if (got != status || image || !strstr(mt_context_error(context)->message, words)) {
        fail_msg("\"%.20s\": status %d, \"%s\", expected %d and \"%s\"", bytes, got, mt_context_error(context)->message,
                 status, words);
    }
    if (mt_context_peak_bytes(context) > 4 << 20) {
        fail_msg("\"%.20s\": %llu bytes were taken", bytes, (unsigned long long)mt_context_peak_bytes(context));
    }
    test_context_end(context);
}

#define REFUSE(text, status, words) refuse(text, sizeof(text) - 1, status, words)

static void declared_sizes_are_checked(void **state)
{
    (void)state;
    REFUSE("P5\n0 5\n255\n", MT_ERROR_SYNTAX, "has no pixel");
    REFUSE("P6\n46341 46341\n255\n", MT_ERROR_TOO_LARGE, "less than 2^31 pixels");
    REFUSE("P5\n4294967295 4294967295\n255\n", MT_ERROR_TOO_LARGE, "less than 2^31 pixels");
    REFUSE("P5\n4294967296 1\n255\n", MT_ERROR_SYNTAX, "expected the picture's width");
    REFUSE("P5\n40000 40000\n255\n1234", MT_ERROR_SYNTAX, "expected 1599999996 bytes more");
    REFUSE("P2\n30000 30000\n255\n1 2 3", MT_ERROR_SYNTAX, "bytes more");
    REFUSE("P7\nWIDTH 30000\nHEIGHT 30000\nDEPTH 4\nMAXVAL 65535\nTUPLTYPE RGB_ALPHA\nENDHDR\n", MT_ERROR_SYNTAX,
           "bytes more");
    REFUSE("PF\n30000 30000\n-1.0\n", MT_ERROR_SYNTAX, "bytes more");
    REFUSE("Pf\n65536 32768\n1\n", MT_ERROR_TOO_LARGE, "less than 2^31 pixels");
    REFUSE("Pf\n3 0\n1\n", MT_ERROR_SYNTAX, "has no pixel");
    /* PNG of 65536 x 32768 and of 30000 x 30000, with a right sum over the header. */
    if (mt_image_format_by_extension("png")) {
        REFUSE("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\1\0\0\0\0\x80\0\1\0\0\0\0\x00\x43\xe7\x22", MT_ERROR_TOO_LARGE,
               "less than 2^31 pixels");
    }
}

static void netpbm_headers(void **state)
{
    (void)state;
    REFUSE("P8\n1 1\n255\n0", MT_ERROR_SYNTAX, "neither the content nor the name");
    REFUSE("P5\n1 x\n255\n0", MT_ERROR_SYNTAX, "bad@5: expected the picture's height");
    REFUSE("P5\n1 1\n0\n0", MT_ERROR_SYNTAX, "largest sample");
    REFUSE("P5\n1 1\n65536\n00", MT_ERROR_SYNTAX, "largest sample");
    REFUSE("P5\n-1 1\n255\n0", MT_ERROR_SYNTAX, "width");
    REFUSE("P5\n1 1\n7\n\x08", MT_ERROR_SYNTAX, "bad@9: a sample is larger than 7");
    REFUSE("P2\n2 1\n7\n7 8\n", MT_ERROR_SYNTAX, "a sample is larger than 7");
    REFUSE("P2\n2 1\n7\n7 1,5\n", MT_ERROR_SYNTAX, "expected a sample");
    REFUSE("P1\n2 1\n1 2\n", MT_ERROR_SYNTAX, "0 or 1");
    REFUSE("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 5\nMAXVAL 255\nENDHDR\n12345", MT_ERROR_UNSUPPORTED, "5 channels");
    REFUSE("P7\nWIDTH 1\nHEIGHT 1\nDEPTH 2\nMAXVAL 255\nENDHDR\n12", MT_ERROR_UNSUPPORTED, "2 channels");
    REFUSE("P7\nWIDTH 1\nSIZE 1\nENDHDR\n12", MT_ERROR_SYNTAX, "expected WIDTH");
    REFUSE("PF\n1 1\n0\n123456789012", MT_ERROR_SYNTAX, "a scale that is not 0");
    REFUSE("PF\n1 1\nnan\n123456789012", MT_ERROR_SYNTAX, "a scale that is not 0");
    REFUSE("GIF89a12", MT_ERROR_UNSUPPORTED, "is a GIF picture");
    REFUSE("", MT_ERROR_SYNTAX, "is empty (0 bytes)");
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_image *image = NULL;
    static const char text[] = "P2#c\n# a comment\r\n 2\t# another\n1 \n#\n4\n1 # even here\n 4\n\n";
    assert_int_equal(mt_image_read_memory(context, "a", text, sizeof text - 1, NULL, &image, NULL), MT_OK);
    assert_true(image->width == 2 && image->height == 1 && image->pixels[0] == 0.25F && image->pixels[1] == 1.0F);
    assert_string_equal(warnings.text, "");
    mt_image_destroy(context, image);
    assert_int_equal(mt_image_read_memory(context, "a", "P1 3 2 101\n0 1 0", 16, NULL, &image, NULL), MT_OK);
    assert_memory_equal(image->pixels, ((float[6]){0, 1, 0, 1, 0, 1}), 6 * sizeof(float));
    mt_image_destroy(context, image);
    assert_int_equal(mt_image_read_memory(context, "a", "P4 9 1\n\x80\x80more", 13, NULL, &image, NULL), MT_OK);
    assert_memory_equal(image->pixels, ((float[9]){0, 1, 1, 1, 1, 1, 1, 1, 0}), 9 * sizeof(float));
    assert_string_equal(warnings.text, "a: 4 bytes after the picture are ignored\n");
    mt_image_destroy(context, image);
    static const char pam[] = "P7\nTUPLTYPE GRAYSCALE_ALPHA\nWIDTH 1\nHEIGHT 1\nDEPTH 2\nMAXVAL 3\nENDHDR\n\1\3";
    assert_int_equal(mt_image_read_memory(context, "a", pam, sizeof pam - 1, NULL, &image, NULL), MT_OK);
    float third = (float)(1.0 / 3);
    assert_memory_equal(image->pixels, ((float[4]){third, third, third, 1}), 4 * sizeof(float));
    mt_image_destroy(context, image);
    static const char pfm[] = "Pf 1 2 1.0\n\x3f\x80\0\0\xff\x80\0\0";
    assert_int_equal(mt_image_read_memory(context, "a", pfm, sizeof pfm - 1, NULL, &image, NULL), MT_OK);
    assert_true(image->pixels[1] == 1.0F && isinf(image->pixels[0]) && image->pixels[0] < 0);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static void content_wins_over_the_name(void **state)
{
    (void)state;
    test_warnings warnings;
    mt_context *context = test_context_with_warnings(&warnings, 1);
    mt_image *image = NULL;
    mt_image_source source;
    assert_int_equal(mt_image_read_memory(context, "a.pfm", "P5 1 1 255 x", 12, NULL, &image, &source), MT_OK);
    assert_string_equal(source.format->name, "pgm");
    assert_string_equal(warnings.text,
                        "a.pfm: the content is Portable graymap although the name says Portable float map; read as "
                        "Portable graymap\n");
    mt_image_destroy(context, image);
    assert_int_equal(mt_image_read_memory(context, "a.png", "hello", 5, NULL, &image, &source),
                     mt_image_format_by_extension("png") ? MT_ERROR_SYNTAX : MT_ERROR_UNSUPPORTED);
    assert_null(image);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_comes_back), cmocka_unit_test(every_cut_is_refused),
        cmocka_unit_test(flipped_bits_do_no_harm),    cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(declared_sizes_are_checked), cmocka_unit_test(netpbm_headers),
        cmocka_unit_test(content_wins_over_the_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
