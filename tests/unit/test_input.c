/* Opening and reading: files, pipes, memory, what cannot be opened, and files that change while they are read. */
#include "tests/support/unit.h"

#include "formats/stream/input.h"
#include "tests/support/fixture.h"
#include "tests/support/reading.h"
#include "tests/support/scratch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { SIZE = 300000 };

static unsigned char *pattern(size_t size)
{
    unsigned char *bytes = malloc(size);
    test_random random = {3};
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (unsigned char)test_random_next(&random);
    }
    return bytes;
}

/* Reads everything in pieces of random sizes and compares. */
static void check_reading(mt_context *context, mt_input *input, const unsigned char *expected, size_t size)
{
    test_random random = {4};
    unsigned char *bytes = malloc(size + 1);
    const uint8_t *peeked;
    size_t done = 0, got = 1, peek_size;
    assert_int_equal(mt_input_peek(context, input, &peeked, &peek_size), MT_OK);
    assert_int_equal(peek_size, size < MT_INPUT_PEEK ? size : MT_INPUT_PEEK);
    assert_memory_equal(peeked, expected, peek_size);
    while (got > 0) {
        size_t part = 1 + (size_t)test_random_below(&random, test_random_below(&random, 2) ? 100000 : 10);
        part = part < size + 1 - done ? part : size + 1 - done;
        assert_int_equal(mt_input_read(context, input, bytes + done, part, &got), MT_OK);
        done += got;
        assert_int_equal(mt_input_offset(input), done);
    }
    assert_int_equal(done, size);
    assert_memory_equal(bytes, expected, size);
    free(bytes);
}

static void check_reading_at(const mt_input *input, const unsigned char *expected, size_t begin, size_t size)
{
    test_random random = {5};
    unsigned char *bytes = malloc(size + 100);
    for (int i = 0; i < 200; i++) {
        size_t at = begin + (size_t)test_random_below(&random, size - begin + 10);
        size_t part = (size_t)test_random_below(&random, 70000), right = at > size          ? 0
                                                                         : size - at < part ? size - at
                                                                                            : part;
        part = part < size + 100 ? part : size + 100;
        right = right < part ? right : part;
        assert_int_equal(mt_input_read_at(input, at, bytes, part), right);
        assert_memory_equal(bytes, expected + (right ? at : 0), right);
    }
    free(bytes);
}

static void test_files_and_memory(void **state)
{
    (void)state;
    mt_context *context = test_context();
    unsigned char *bytes = pattern(SIZE);
    const size_t sizes[] = {1, 4095, 4096, 4097, 65536, SIZE};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        mt_input *input;
        const char *path = test_scratch_file("input.bin", bytes, sizes[i]);
        assert_int_equal(mt_input_open(context, path, &input), MT_OK);
        assert_int_equal(mt_input_size(input), sizes[i]);
        assert_string_equal(mt_input_name(input), path);
        assert_true(mt_input_can_read_at(input));
        check_reading(context, input, bytes, sizes[i]);
        check_reading_at(input, bytes, 0, sizes[i]);
        mt_input_close(context, input);
        assert_int_equal(mt_input_open_memory(context, "memory", bytes, sizes[i], &input), MT_OK);
        check_reading(context, input, bytes, sizes[i]);
        check_reading_at(input, bytes, 0, sizes[i]);
        mt_input_close(context, input);
        unlink(path);
    }
    free(bytes);
    test_context_end(context);
}

/* A pipe has no size and no place to read at, until it is collected. */
static void test_pipes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    unsigned char *bytes = pattern(9000000);
    const size_t sizes[] = {10, SIZE, 4 << 20, 9000000};
    for (size_t i = 0; i < 2 * sizeof sizes / sizeof sizes[0]; i++) {
        size_t size = sizes[i / 2], got;
        unsigned char first[5];
        mt_input *input;
        const char *path = test_scratch_pipe("input.pipe", bytes, size);
        assert_int_equal(mt_input_open(context, path, &input), MT_OK);
        assert_true(mt_input_size(input) == UINT64_MAX);
        assert_false(mt_input_can_read_at(input));
        if (i % 2) {
            check_reading(context, input, bytes, size);
        } else {
            assert_int_equal(mt_input_read(context, input, first, sizeof first, &got), MT_OK);
            assert_int_equal(mt_input_collect(context, input), MT_OK);
            assert_int_equal(mt_input_size(input), size);
            assert_int_equal(mt_input_offset(input), 5);
            check_reading_at(input, bytes, 5, size);
            unsigned char *rest = malloc(size);
            assert_int_equal(mt_input_read(context, input, rest, size, &got), MT_OK);
            assert_int_equal(got, size - 5);
            assert_memory_equal(rest, bytes + 5, got);
            free(rest);
        }
        mt_input_close(context, input);
        test_scratch_pipe_end(path);
    }
    free(bytes);
    test_context_end(context);
}

static void check_open_fails(mt_context *context, const char *path, mt_status status, const char *words)
{
    mt_input *input;
    mt_context_clear_error(context);
    assert_int_equal(mt_input_open(context, path, &input), status);
    assert_null(input);
    assert_non_null(strstr(mt_context_error(context)->message, words));
    assert_non_null(strstr(mt_context_error(context)->message, path));
}

static void test_what_cannot_be_opened(void **state)
{
    (void)state;
    mt_context *context = test_context();
    check_open_fails(context, "/nonexistent/a.obj", MT_ERROR_IO, "No such file");
    check_open_fails(context, "/tmp", MT_ERROR_UNSUPPORTED, "is a directory");
    if (geteuid() != 0) {
        const char *path = test_scratch_file("locked.obj", "v", 1);
        chmod(path, 0);
        check_open_fails(context, path, MT_ERROR_IO, "Permission denied");
        unlink(path);
    }
    test_context_end(context);
}

static void test_reading_exactly_names_what_is_missing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_input *input;
    char bytes[10];
    assert_int_equal(mt_input_open_memory(context, "a.bin", "1234567", 7, &input), MT_OK);
    assert_int_equal(mt_input_read_exactly(context, input, bytes, 5, "a header"), MT_OK);
    assert_int_equal(mt_input_read_exactly(context, input, bytes, 5, "a facet"), MT_ERROR_SYNTAX);
    assert_string_equal(mt_context_error(context)->message,
                        "a.bin@7: the file ends here, after 7 bytes, expected a facet");
    mt_input_close(context, input);
    test_context_end(context);
}

/* A file that becomes shorter after it was opened is an error with a place, by every way of reading. */
static void test_a_file_that_shrinks(void **state)
{
    (void)state;
    unsigned char *bytes = pattern(SIZE), *copy = malloc(SIZE);
    for (int way = 0; way < 2; way++) {
        mt_context *context = test_context();
        mt_input *input;
        size_t got;
        const char *path = test_scratch_file("shrinks.bin", bytes, SIZE);
        assert_int_equal(mt_input_open(context, path, &input), MT_OK);
        assert_int_equal(truncate(path, 1000), 0);
        if (way == 0) {
            assert_int_equal(mt_input_read(context, input, copy, SIZE, &got), MT_ERROR_SYNTAX);
        } else {
            assert_true(mt_input_read_at(input, 500, copy, 1000) == SIZE_MAX);
            assert_int_equal(mt_input_fail_read_at(context, input, 500), MT_ERROR_SYNTAX);
        }
        assert_non_null(
            strstr(mt_context_error(context)->message, "@1000: the file ends here though it had 300000 bytes"));
        mt_input_close(context, input);
        unlink(path);
        test_context_end(context);
    }
    free(copy);
    free(bytes);
}

/* The same seen from above, by a reader of text. */
static void test_standard_input_and_formats(void **state)
{
    (void)state;
    static const char text[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    mt_context *context = test_context();
    mt_mesh *mesh;
    const mt_mesh_format *format;
    const char *path = test_scratch_pipe("mesh.pipe", text, sizeof text - 1);
    assert_int_equal(mt_mesh_read_file(context, path, NULL, &mesh, &format), MT_OK);
    assert_string_equal(format->name, "obj");
    assert_int_equal(mesh->face_count, 1);
    mt_mesh_destroy(context, mesh);
    test_scratch_pipe_end(path);
    test_context_end(context);
}

static void test_memory_limit(void **state)
{
    (void)state;
    mt_context_options options = {.memory_limit = 6 << 20, .thread_count = 1};
    mt_context *context = mt_context_create(&options);
    unsigned char *bytes = calloc(1, 12 << 20);
    mt_input *input;
    const char *path = test_scratch_pipe("large.pipe", bytes, 12 << 20);
    assert_int_equal(mt_input_open(context, path, &input), MT_OK);
    assert_int_equal(mt_input_collect(context, input), MT_ERROR_OUT_OF_MEMORY);
    assert_true(mt_context_peak_bytes(context) <= 6 << 20);
    mt_input_close(context, input);
    test_scratch_pipe_end(path);
    free(bytes);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_files_and_memory),      cmocka_unit_test(test_pipes),
        cmocka_unit_test(test_what_cannot_be_opened), cmocka_unit_test(test_reading_exactly_names_what_is_missing),
        cmocka_unit_test(test_a_file_that_shrinks),   cmocka_unit_test(test_standard_input_and_formats),
        cmocka_unit_test(test_memory_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
