/* The block reader: whatever the size of its blocks and the kind of line ends, the lines are those of the text, and
 * failures name the first line in the file. */
#include "tests/support/unit.h"

#include "formats/stream/cursor.h"
#include "formats/stream/input.h"
#include "formats/stream/text.h"
#include "tests/support/fixture.h"

#include <stdio.h>
#include <stdlib.h>

enum { TEXT_ROOM = 2000, LINE_ROOM = 2100 };

/* Where each line of the text begins, by the definition, and where the logical ones do. */
static size_t split_lines(const char *text, size_t size, bool continuations, size_t *begins)
{
    size_t count = 0;
    bool begin = true, joined = false;
    for (size_t i = 0; i < size; i++) {
        if (begin && !joined) {
            begins[count++] = i;
        }
        begin = text[i] == '\n' || (text[i] == '\r' && !(i + 1 < size && text[i + 1] == '\n'));
        if (begin) {
            size_t last = text[i] == '\n' && i > 0 && text[i - 1] == '\r' ? i - 1 : i;
            joined = continuations && last > 0 && text[last - 1] == '\\';
        }
    }
    return count;
}

static size_t random_text(test_random *random, char *text)
{
    size_t size = (size_t)test_random_below(random, TEXT_ROOM);
    static const char letters[] = "aab  b\n\n\r\\";
    unsigned count = 4 + (unsigned)test_random_below(random, sizeof letters - 4);
    for (size_t i = 0; i < size; i++) {
        text[i] = letters[test_random_below(random, count)];
    }
    return size;
}

typedef struct collection {
    size_t begins[300], ends[300]; /* per block */
    uint64_t first_lines[300];
    uint64_t bytes;
    uint8_t *copy;
} collection;

static void collect(void *user, mt_text_block *block)
{
    collection *c = user;
    size_t size = (size_t)(block->end - block->begin);
    c->begins[block->number] = (size_t)block->offset;
    c->ends[block->number] = (size_t)block->offset + size;
    c->first_lines[block->number] = block->first_line;
    memcpy(c->copy + block->offset, block->begin, size);
    assert_true(*block->end == '\n');
    for (int i = 1; i <= MT_TEXT_PADDING; i++) {
        assert_int_equal(block->end[i], 0);
    }
}

static bool contains(const size_t *sorted, size_t count, size_t value)
{
    for (size_t i = 0; i < count; i++) {
        if (sorted[i] == value) {
            return true;
        }
    }
    return false;
}

static size_t lines_before(const size_t *begins, size_t count, size_t offset)
{
    size_t before = 0;
    while (before < count && begins[before] < offset) {
        before++;
    }
    return before;
}

/* One text: blocks cover it without a gap, begin at logical lines only, and know their line numbers. */
static void check_blocks(mt_context *context, const char *bytes, size_t size, const mt_text_options *options)
{
    static size_t logical[LINE_ROOM], physical[LINE_ROOM];
    uint8_t copy[TEXT_ROOM];
    collection c = {.copy = copy};
    mt_input *input;
    mt_text *text;
    uint64_t total;
    size_t logical_count = split_lines(bytes, size, options->continuations, logical);
    size_t physical_count = split_lines(bytes, size, false, physical);
    assert_int_equal(mt_input_open_memory(context, "text", bytes, size, &input), MT_OK);
    assert_int_equal(mt_text_open(context, input, options, &text), MT_OK);
    assert_int_equal(mt_text_count_lines(context, text, &total), MT_OK);
    assert_int_equal(total, physical_count);
    assert_int_equal(mt_text_parse(context, text, "reading", collect, &c), MT_OK);
    size_t covered = 0;
    for (uint64_t i = 0; i < mt_text_block_count(text); i++) {
        if (c.ends[i] == 0) {
            continue;
        }
        assert_int_equal(c.begins[i], covered);
        assert_true(contains(logical, logical_count, c.begins[i]));
        assert_int_equal(c.first_lines[i], lines_before(physical, physical_count, c.begins[i]));
        covered = c.ends[i];
    }
    assert_int_equal(covered, size);
    assert_memory_equal(copy, bytes, size);
    for (int i = 0; size > 0 && i < 10; i++) {
        size_t at = (size_t)i * (size - 1) / 9;
        mt_place place = mt_text_place(context, text, at);
        size_t line = lines_before(physical, physical_count, at + 1);
        assert_int_equal(place.line, line);
        assert_int_equal(place.column, at - physical[line - 1] + 1);
    }
    mt_text_close(context, text);
    mt_input_close(context, input);
}

static void test_lines_are_kept_whole(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(2);
    test_random random = {11};
    char bytes[TEXT_ROOM];
    for (int round = 0; round < 3000; round++) {
        size_t size = random_text(&random, bytes);
        mt_text_options options = {.continuations = round % 2, .block_size = 16 + test_random_below(&random, 100)};
        check_blocks(context, bytes, size, &options);
    }
    test_context_end(context);
}

/* By the definition: a line at a time. */
static size_t count_telling(const char *bytes, size_t size, char comment)
{
    static size_t begins[LINE_ROOM];
    size_t count = split_lines(bytes, size, false, begins), telling = 0;
    for (size_t i = 0; i < count; i++) {
        size_t at = begins[i], end = i + 1 < count ? begins[i + 1] : size;
        while (at < end && (mt_is_blank(bytes[at]) || mt_is_line_end(bytes[at]))) {
            at++;
        }
        telling += at < end && (!comment || bytes[at] != comment);
    }
    return telling;
}

static void test_telling_lines(void **state)
{
    (void)state;
    test_random random = {13};
    char bytes[TEXT_ROOM + MT_TEXT_PADDING + 1];
    for (int round = 0; round < 20000; round++) {
        static const char letters[] = "aaaaaaa\n\n b#\t\r";
        unsigned kinds = 8 + (unsigned)test_random_below(&random, sizeof letters - 8);
        size_t size = (size_t)test_random_below(&random, round % 2 ? 30 : 600);
        for (size_t i = 0; i < size; i++) {
            bytes[i] = letters[test_random_below(&random, kinds)];
        }
        memset(bytes + size, 0, MT_TEXT_PADDING + 1);
        bytes[size] = '\n';
        char comment = round % 3 ? '#' : '\0';
        assert_int_equal(mt_text_count_telling_lines(bytes, bytes + size, comment),
                         count_telling(bytes, size, comment));
    }
}

static bool begins_with_b(const char *line, const char *end)
{
    return line < end && *line == 'b';
}

static void check_begin(void *user, mt_text_block *block)
{
    uint64_t *bytes = user;
    assert_true(block->offset == 0 || *block->begin == 'b');
    __atomic_fetch_add(bytes, (uint64_t)(block->end - block->begin), __ATOMIC_RELAXED);
}

static void test_blocks_begin_where_allowed(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(2);
    test_random random = {12};
    char bytes[TEXT_ROOM];
    for (int round = 0; round < 500; round++) {
        size_t size = random_text(&random, bytes);
        mt_text_options options = {.may_begin = begins_with_b, .block_size = 16 + test_random_below(&random, 100)};
        mt_input *input;
        mt_text *text;
        uint64_t covered = 0;
        assert_int_equal(mt_input_open_memory(context, "text", bytes, size, &input), MT_OK);
        assert_int_equal(mt_text_open(context, input, &options, &text), MT_OK);
        assert_int_equal(mt_text_parse(context, text, "reading", check_begin, &covered), MT_OK);
        assert_int_equal(covered, size);
        mt_text_close(context, text);
        mt_input_close(context, input);
    }
    test_context_end(context);
}

/* Fails at every 'x'. */
static void fail_at_x(void *user, mt_text_block *block)
{
    (void)user;
    for (const char *at = block->begin; at < block->end && !mt_text_failed(block); at++) {
        if (*at == 'x') {
            mt_text_fail(block, MT_ERROR_SYNTAX, at, "an x");
        }
    }
}

static const mt_error *parse_failing(mt_context *context, const char *bytes, size_t size)
{
    mt_text_options options = {.block_size = 32};
    mt_input *input;
    mt_text *text;
    mt_context_clear_error(context);
    assert_int_equal(mt_input_open_memory(context, "text", bytes, size, &input), MT_OK);
    assert_int_equal(mt_text_open(context, input, &options, &text), MT_OK);
    assert_int_equal(mt_text_parse(context, text, "reading", fail_at_x, NULL), MT_ERROR_SYNTAX);
    mt_text_close(context, text);
    mt_input_close(context, input);
    return mt_context_error(context);
}

static void test_first_failure_in_the_file_wins(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(2);
    char bytes[1000];
    for (size_t first = 0; first < sizeof bytes; first += 7) {
        for (size_t i = 0; i < sizeof bytes; i++) {
            bytes[i] = i % 10 == 9 ? '\n' : 'a';
        }
        size_t x = first % 10 == 9 ? first - 1 : first;
        bytes[x] = bytes[sizeof bytes - 2] = 'x';
        char expected[64];
        snprintf(expected, sizeof expected, "text:%zu:%zu: an x", x / 10 + 1, x % 10 + 1);
        assert_string_equal(parse_failing(context, bytes, sizeof bytes)->message, expected);
        bytes[x] = 0;
        snprintf(expected, sizeof expected, "text:%zu:%zu: a NUL byte in text", x / 10 + 1, x % 10 + 1);
        assert_string_equal(parse_failing(context, bytes, sizeof bytes)->message, expected);
    }
    test_context_end(context);
}

static void count_bytes(void *user, mt_text_block *block)
{
    __atomic_fetch_add((uint64_t *)user, (uint64_t)(block->end - block->begin), __ATOMIC_RELAXED);
}

/* A line of 100 MB is read in a time linear in its length: with 1 MB of blocks a scan of it by each would show. */
static void test_long_line(void **state)
{
    (void)state;
    mt_context *context = test_context_with_threads(2);
    size_t size = 100000000;
    char *bytes = malloc(size);
    memset(bytes, 'a', size);
    mt_text_options options = {.block_size = 4096};
    mt_input *input;
    mt_text *text;
    uint64_t count = 0;
    assert_int_equal(mt_input_open_memory(context, "text", bytes, size, &input), MT_OK);
    assert_int_equal(mt_text_open(context, input, &options, &text), MT_OK);
    assert_int_equal(mt_text_parse(context, text, "reading", count_bytes, &count), MT_OK);
    assert_int_equal(count, size);
    mt_text_close(context, text);
    mt_input_close(context, input);
    free(bytes);
    test_context_end(context);
}

static void test_marks(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_input *input;
    mt_text *text;
    uint64_t count = 0;
    assert_int_equal(mt_input_open_memory(context, "text", "\xEF\xBB\xBFv", 4, &input), MT_OK);
    assert_int_equal(mt_text_open(context, input, NULL, &text), MT_OK);
    assert_int_equal(mt_text_parse(context, text, "reading", count_bytes, &count), MT_OK);
    assert_int_equal(count, 1);
    mt_text_close(context, text);
    mt_input_close(context, input);
    assert_int_equal(mt_input_open_memory(context, "text", "\xFF\xFEv\0", 4, &input), MT_OK);
    assert_int_equal(mt_text_open(context, input, NULL, &text), MT_ERROR_UNSUPPORTED);
    assert_null(text);
    assert_non_null(strstr(mt_context_error(context)->message, "UTF-16"));
    mt_input_close(context, input);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines_are_kept_whole),
        cmocka_unit_test(test_telling_lines),
        cmocka_unit_test(test_blocks_begin_where_allowed),
        cmocka_unit_test(test_first_failure_in_the_file_wins),
        cmocka_unit_test(test_long_line),
        cmocka_unit_test(test_marks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
