/* A PNG of 2 x 2 pixels with a colour profile of 15 kB that expands to 15 MB was read under a memory limit of 2 MB,
 * with 20 MB taken: libspng's room for side chunks was held to be no larger than the file, and is up to 1032 times. */
#include "tests/support/unit.h"

#include <meshtool/image_format.h>

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { PROFILE_SIZE = 15000000, ROOM = 1 << 16 };

static size_t put_chunk(unsigned char *at, const char *name, const void *data, size_t size)
{
    memcpy(at + 4, name, 4);
    if (size > 0) {
        memcpy(at + 8, data, size);
    }
    unsigned long sum = crc32(0, at + 4, (uInt)size + 4);
    for (int i = 0; i < 4; i++) {
        at[i] = (unsigned char)(size >> (24 - 8 * i));
        at[8 + size + (size_t)i] = (unsigned char)(sum >> (24 - 8 * i));
    }
    return size + 12;
}

static size_t make_picture(unsigned char *bytes, const unsigned char *profile)
{
    static const unsigned char signature[] = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
    static const unsigned char header[13] = {0, 0, 0, 2, 0, 0, 0, 2, 8, 0}, rows[6] = {0};
    static unsigned char data[ROOM] = "name\0";
    uLong size = ROOM - 6;
    memcpy(bytes, signature, sizeof signature);
    size_t end = sizeof signature;
    end += put_chunk(bytes + end, "IHDR", header, sizeof header);
    assert_int_equal(compress2(data + 6, &size, profile, PROFILE_SIZE, 9), Z_OK);
    end += put_chunk(bytes + end, "iCCP", data, size + 6);
    size = ROOM;
    assert_int_equal(compress2(data, &size, rows, sizeof rows, 9), Z_OK);
    end += put_chunk(bytes + end, "IDAT", data, size);
    return end + put_chunk(bytes + end, "IEND", NULL, 0);
}

static mt_status read_within(uint64_t limit, const unsigned char *bytes, size_t size)
{
    mt_context_options options = {.memory_limit = limit};
    mt_context *context = mt_context_create(&options);
    mt_image *image;
    mt_status status = mt_image_read_memory(context, "a.png", bytes, size, NULL, &image, NULL);
    mt_image_destroy(context, image);
    assert_int_equal(mt_context_bytes(context), 0);
    mt_context_destroy(context);
    return status;
}

static void test_profile_counts_against_the_limit(void **state)
{
    (void)state;
    static unsigned char bytes[2 * ROOM];
    unsigned char *profile = calloc(1, PROFILE_SIZE);
    assert_non_null(profile);
    size_t size = make_picture(bytes, profile);
    assert_int_equal(read_within(2 << 20, bytes, size), MT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(read_within(0, bytes, size), MT_OK);
    free(profile);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_profile_counts_against_the_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
