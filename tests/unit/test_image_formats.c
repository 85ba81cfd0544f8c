/* The table of image formats, the netpbm family and PFM byte by byte, and writing to a path. */
#include "tests/support/picture.h"
#include "tests/support/scratch.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static mt_image two_by_two(float *pixels, uint32_t channel_count)
{
    for (uint32_t i = 0; i < 4 * channel_count; i++) {
        pixels[i] = (float)i / 255.0F;
    }
    return (mt_image){.width = 2, .height = 2, .channel_count = channel_count, .pixels = pixels};
}

static void expect(const mt_image *image, const char *format, unsigned bits, const char *header, unsigned body_scale)
{
    mt_context *context = test_context();
    size_t size = 0, count = 4 * (size_t)image->channel_count;
    unsigned char *bytes = test_picture_file(context, image, format, bits, &size);
    size_t header_size = strlen(header);
    assert_int_equal(size, header_size + count * (bits / 8));
    assert_memory_equal(bytes, header, header_size);
    for (size_t i = 0; i < count; i++) {
        const unsigned char *value = bytes + header_size + i * (bits / 8);
        assert_int_equal(bits == 8 ? value[0] : value[0] << 8 | value[1], i * body_scale);
    }
    mt_free(context, bytes);
    test_context_end(context);
}

static void netpbm_files_are_exact(void **state)
{
    (void)state;
    float pixels[16];
    mt_image grey = two_by_two(pixels, 1);
    expect(&grey, "pgm", 8, "P5\n2 2\n255\n", 1);
    expect(&grey, "ppm", 8, "P5\n2 2\n255\n", 1);
    expect(&grey, "pgm", 16, "P5\n2 2\n65535\n", 257);
    expect(&grey, "pam", 8, "P7\nWIDTH 2\nHEIGHT 2\nDEPTH 1\nMAXVAL 255\nTUPLTYPE GRAYSCALE\nENDHDR\n", 1);
    mt_image color = two_by_two(pixels, 3);
    expect(&color, "ppm", 8, "P6\n2 2\n255\n", 1);
    expect(&color, "PNM", 16, "P6\n2 2\n65535\n", 257);
    expect(&color, "pam", 8, "P7\nWIDTH 2\nHEIGHT 2\nDEPTH 3\nMAXVAL 255\nTUPLTYPE RGB\nENDHDR\n", 1);
    mt_image alpha = two_by_two(pixels, 4);
    expect(&alpha, "pam", 16, "P7\nWIDTH 2\nHEIGHT 2\nDEPTH 4\nMAXVAL 65535\nTUPLTYPE RGB_ALPHA\nENDHDR\n", 257);
}

static void pfm_holds_the_floats_from_the_bottom_up(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {3};
    mt_image *image = test_picture(context, &random, 5, 3, 3);
    image->pixels[4] = -1e30F;
    image->pixels[5] = NAN;
    size_t size = 0;
    unsigned char *bytes = test_picture_file(context, image, "pfm", 0, &size);
    const char header[] = "PF\n5 3\n-1.0\n";
    assert_int_equal(size, sizeof header - 1 + 5 * 3 * 3 * 4);
    assert_memory_equal(bytes, header, sizeof header - 1);
    for (uint32_t y = 0; y < 3; y++) {
        assert_memory_equal(bytes + sizeof header - 1 + (size_t)y * 60, mt_image_pixel(image, 0, 2 - y), 60);
    }
    mt_free(context, bytes);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static void what_a_format_cannot_hold_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        uint32_t channel_count;
        unsigned bits;
        mt_status status;
        const char *says;
    } rows[] = {{"x.ppm", 4, 8, MT_ERROR_UNSUPPORTED, "transparency"},
                {"x.pfm", 4, 0, MT_ERROR_UNSUPPORTED, "transparency"},
                {"x.pgm", 3, 8, MT_ERROR_UNSUPPORTED, "grey"},
                {"x.ppm", 3, 12, MT_ERROR_ARGUMENT, "12"},
                {"x.pfm", 3, 8, MT_ERROR_ARGUMENT, "with 32 bits"},
                {"x.png", 3, 32, MT_ERROR_ARGUMENT, "8 or 16 bits"},
                {"x.tiff", 3, 2, MT_ERROR_ARGUMENT, "1, 8, 16 or 32 bits"},
                {"x.gif", 3, 8, MT_ERROR_ARGUMENT, "\"gif\""},
                {"folder.ppm/x", 3, 8, MT_ERROR_ARGUMENT, "extension"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_context *context = test_context();
        test_random random = {1};
        mt_image *image = test_picture(context, &random, 4, 4, rows[i].channel_count);
        const char *path = test_scratch_path(rows[i].path);
        mt_image_write_options options = {.bits = rows[i].bits};
        assert_int_equal(mt_image_write_file(context, image, path, &options), rows[i].status);
        assert_non_null(strstr(mt_context_error(context)->message, rows[i].says));
        assert_int_not_equal(access(path, F_OK), 0);
        mt_image_destroy(context, image);
        test_context_end(context);
    }
    assert_int_equal(test_scratch_count(), 0);
}

static void a_path_names_its_format(void **state)
{
    (void)state;
    mt_context *context = test_context();
    assert_string_equal(mt_image_format_for_output(context, "a.b/c.PPM", NULL)->name, "ppm");
    mt_image_write_options options = {.format = "pam"};
    assert_string_equal(mt_image_format_for_output(context, "c.ppm", &options)->name, "pam");
    const mt_image_format *pipe = mt_image_format_for_output(context, "-", NULL);
    const mt_image_format *png = mt_image_format_by_extension("png");
    assert_ptr_equal(pipe, png);
    if (!png) {
        assert_non_null(strstr(mt_context_error(context)->message, "built without PNG"));
    }
    test_context_end(context);
}

static void files_are_written_and_kept(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_path("picture.ppm");
    test_random random = {9};
    mt_image *image = test_picture(context, &random, 33, 17, 3);
    assert_int_equal(mt_image_write_file(context, image, path, NULL), MT_OK);
    size_t file_size = 0, size = 0;
    unsigned char *file = test_read_file(path, &file_size);
    unsigned char *bytes = test_picture_file(context, image, "ppm", 8, &size);
    assert_int_equal(file_size, size);
    assert_memory_equal(file, bytes, size);
    mt_image_write_options options = {.no_clobber = true};
    assert_int_equal(mt_image_write_file(context, image, path, &options), MT_ERROR_IO);
    free(file);
    mt_free(context, bytes);
    mt_image_destroy(context, image);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(test_scratch_count(), 0);
    test_context_end(context);
}

/* Bands must join without a seam: more than a band's bytes. */
static void large_pictures_come_out_whole(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {5};
    mt_image *image = test_picture(context, &random, 1201, 907, 3);
    image->space = MT_COLOR_LINEAR;
    size_t size = 0;
    unsigned char *bytes = test_picture_file(context, image, "ppm", 8, &size);
    const unsigned char *body = bytes + size - (size_t)1201 * 907 * 3;
    for (size_t i = 0; i < (size_t)1201 * 907 * 3; i += 101) {
        double exact = mt_srgb_encode((double)image->pixels[i]) * 255.0;
        assert_true(fabs(exact - body[i]) < 0.5001);
    }
    mt_free(context, bytes);
    mt_image_destroy(context, image);
    test_context_end(context);
}

static mt_status write_once(mt_context *context, const mt_image *image, const char *path)
{
    mt_context_clear_error(context);
    return mt_image_write_file(context, image, path, NULL);
}

static void missing_memory_leaves_no_file(void **state)
{
    (void)state;
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        char name[32];
        snprintf(name, sizeof name, "x.%s", (*format)->extensions[0]);
        const char *path = test_scratch_path(name);
        for (uint64_t n = 3; status != MT_OK; n++) {
            mt_context_options options = {.failing_allocation = n, .thread_count = 1};
            mt_context *context = mt_context_create(&options);
            test_random random = {1};
            mt_image *image = test_picture(context, &random, 5, 5, 1);
            status = write_once(context, image, path);
            assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
            assert_int_equal(access(path, F_OK) == 0, status == MT_OK);
            mt_image_destroy(context, image);
            test_context_end(context);
            assert_true(n < 100);
        }
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(test_scratch_count(), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(netpbm_files_are_exact),
        cmocka_unit_test(pfm_holds_the_floats_from_the_bottom_up),
        cmocka_unit_test(what_a_format_cannot_hold_is_refused),
        cmocka_unit_test(a_path_names_its_format),
        cmocka_unit_test(files_are_written_and_kept),
        cmocka_unit_test(large_pictures_come_out_whole),
        cmocka_unit_test(missing_memory_leaves_no_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
