/* JSON to read: what is refused, where, with which words; getters; and that jansson never holds more than was counted
 * against the limit before. */
#include "tests/support/unit.h"

#include "formats/stream/json.h"
#include "tests/support/fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static mt_status parse(mt_context *context, const char *text, mt_json *json)
{
    mt_context_clear_error(context);
    return mt_json_parse(context, "a.json", text, strlen(text), json);
}

static void check_refused(mt_context *context, const char *text, size_t size, uint64_t line, uint64_t column,
                          const char *part)
{
    mt_json json;
    mt_context_clear_error(context);
    mt_status status = mt_json_parse(context, "a.json", text, size, &json);
    const mt_error *error = mt_context_error(context);
    if (status != MT_ERROR_SYNTAX || error->place.line != line || error->place.column != column ||
        !strstr(error->message, part)) {
        fail_msg("%s: status %d, \"%s\", expected line %llu, column %llu and \"%s\"", text, status, error->message,
                 (unsigned long long)line, (unsigned long long)column, part);
    }
    assert_null(json.root);
    assert_int_equal(mt_context_bytes(context), 0);
}

static void test_refusals_name_line_and_column(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        uint64_t line, column;
        const char *part;
    } cases[] = {
        {"", 1, 1, "ends here"},
        {"{\"a\": 1,\n \"a\": 2}", 2, 4, "duplicate object key"},
        {"{\"a\": 1,\n  \"b\" 2}", 2, 7, "':' expected"},
        {"[1, 2", 1, 5, "ends here"},
        {"[\"a", 1, 3, "ends here"},
        {"[1] 2", 1, 5, "end of file expected"},
        {"[NaN]", 1, 4, "invalid token"},
        {"[1e999]", 1, 6, "too large"},
        {"[-1e999]", 1, 7, "too large"},
        {"[01]", 1, 2, "invalid token"},
        {"[1,]", 1, 4, "unexpected"},
        {"[\"a\\u0000\"]", 1, 10, "NUL"},
        {"{\"a\\u0000\": 1}", 1, 10, "NUL"},
        {"[\"\xC3\x28\"]", 1, 3, "not UTF-8"},
        {"[\"\\ud800\"]", 1, 9, "invalid Unicode"},
        {"\"a\"", 1, 3, "'[' or '{' expected"},
        {"// a\n{}", 1, 1, "'[' or '{' expected"},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        check_refused(context, cases[i].text, strlen(cases[i].text), cases[i].line, cases[i].column, cases[i].part);
    }
    check_refused(context, "{\"a\": \0 1}", 10, 1, 7, "NUL byte");
    check_refused(context, "{}\0", 3, 1, 3, "NUL byte");
    check_refused(context, "[\"\0\"]", 5, 1, 3, "NUL byte");
    test_context_end(context);
}

static void test_nesting_is_limited(void **state)
{
    (void)state;
    enum { DEPTH = 10000 };
    static char text[2 * DEPTH];
    mt_context *context = test_context();
    mt_json json;
    memset(text, '[', DEPTH);
    memset(text + DEPTH, ']', DEPTH);
    check_refused(context, text, sizeof text, 1, MT_JSON_DEPTH + 1, "more than 500 deep");
    assert_int_equal(mt_json_parse(context, "a", text + DEPTH - MT_JSON_DEPTH, (size_t)2 * MT_JSON_DEPTH, &json),
                     MT_OK);
    mt_json_release(context, &json);
    test_context_end(context);
}

static void test_marks_of_encodings(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_json json;
    assert_int_equal(parse(context, "\xEF\xBB\xBF{}", &json), MT_OK);
    assert_true(json_is_object(json.root));
    mt_json_release(context, &json);
    check_refused(context, "\xEF\xBB\xBF{]", 5, 1, 5, "expected");
    mt_context_clear_error(context);
    assert_int_equal(mt_json_parse(context, "a.json", "\xff\xfe{\0}\0", 6, &json), MT_ERROR_UNSUPPORTED);
    assert_non_null(strstr(mt_context_error(context)->message, "UTF-16"));
    test_context_end(context);
}

/* What jansson holds, by allocators that count; a test may set them. */
static size_t held, most;

static void *count_allocation(size_t size)
{
    size_t *block = malloc(size + 16);
    *block = (size + 8 + 15) / 16 * 16 < 32 ? 32 : (size + 8 + 15) / 16 * 16; /* glibc's own sizes */
    held += *block;
    most = held > most ? held : most;
    return block + 2;
}

static void count_free(void *block)
{
    if (block) {
        size_t *base = (size_t *)block - 2;
        held -= *base;
        free(base);
    }
}

static void check_bound(mt_context *context, const char *text, size_t size)
{
    mt_json json;
    uint64_t bound = mt_json_bound(text, size);
    most = held = 0;
    mt_context_clear_error(context);
    if (mt_json_parse(context, "a", text, size, &json) == MT_OK) {
        assert_int_equal(mt_context_bytes(context), bound);
        mt_json_release(context, &json);
    }
    if (most > bound) {
        fail_msg("%.40s... of %zu bytes: %zu bytes were held, %llu were counted", text, size, most,
                 (unsigned long long)bound);
    }
    assert_int_equal(mt_context_bytes(context), 0);
    assert_int_equal(held, 0);
}

/* Texts of one piece repeated, with the number of the repetition in it. */
static void check_repeated(mt_context *context, const char *begin, const char *piece, const char *end)
{
    for (unsigned count = 1; count < 20000; count = count * 5 / 4 + 1) {
        size_t room = strlen(begin) + count * (strlen(piece) + 12) + strlen(end) + 1, size;
        char *text = malloc(room);
        size = (size_t)sprintf(text, "%s", begin);
        for (unsigned i = 0; i < count; i++) {
            size += (size_t)sprintf(text + size, piece, i); /* NOLINT: the pieces below are the formats */
            text[size++] = i + 1 < count ? ',' : ' ';
        }
        size += (size_t)sprintf(text + size, "%s", end);
        check_bound(context, text, size);
        free(text);
    }
}

static void test_memory_is_within_what_was_counted(void **state)
{
    (void)state;
    mt_context *context = test_context();
    json_set_alloc_funcs(count_allocation, count_free);
    static const char *const elements[] = {"{}", "[]", "0", "0.5", "\"\"", "\"%u\"", "{\"\":0}", "[[]]", "true"};
    for (size_t i = 0; i < sizeof elements / sizeof elements[0]; i++) {
        check_repeated(context, "[", elements[i], "]");
        check_repeated(context, "[", elements[i], "!"); /* a failure at the end */
    }
    static const char *const members[] = {"\"%u\":0", "\"%u\":\"\"", "\"%u\":{}", "\"%u\":[]", "\"key number %u\":0.5"};
    for (size_t i = 0; i < sizeof members / sizeof members[0]; i++) {
        check_repeated(context, "{", members[i], "}");
    }
    for (size_t length = 1; length < 3000000; length = length * 3 / 2 + 1) {
        char *text = malloc(length + 10);
        memset(text, 'a', length + 10);
        memcpy(text, "[\"", 2);
        memcpy(text + 2 + length, "\"]", 2);
        check_bound(context, text, length + 4);
        memcpy(text, "{\"", 2);
        memcpy(text + 2 + length, "\":0}", 4);
        check_bound(context, text, length + 6);
        text[1] = 'a'; /* a token outside of a string */
        check_bound(context, text, length + 6);
        free(text);
    }
    json_set_alloc_funcs(malloc, free);
    test_context_end(context);
}

static void test_the_limit_is_asked_first(void **state)
{
    (void)state;
    mt_context_options options = {.memory_limit = 10000};
    mt_context *context = mt_context_create(&options);
    mt_json json;
    char text[4000] = "[";
    memset(text + 1, '[', sizeof text - 2);
    assert_int_equal(mt_json_parse(context, "a", text, 400, &json), MT_ERROR_OUT_OF_MEMORY);
    assert_non_null(strstr(mt_context_error(context)->message, "limit"));
    assert_int_equal(mt_context_bytes(context), 0);
    assert_int_equal(parse(context, "[1, 2, 3]", &json), MT_OK);
    assert_true(mt_context_bytes(context) > 0);
    mt_json_release(context, &json);
    test_context_end(context);
}

/* The last failure must be this sentence. */
static void check_said(mt_context *context, mt_status status, const char *sentence)
{
    assert_int_equal(status, MT_ERROR_SYNTAX);
    assert_string_equal(mt_context_error(context)->message, sentence);
    mt_context_clear_error(context);
}

static void test_getters_read_what_is_there(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_json json;
    assert_int_equal(parse(context,
                           "{\"n\": 3, \"w\": 4.0, \"x\": -0.5, \"t\": true, \"s\": \"hey\", \"v\": [1, 2.5], "
                           "\"o\": {\"big\": 9223372036854775807}}",
                           &json),
                     MT_OK);
    mt_json_node root = mt_json_root("a.json", &json), node;
    uint64_t whole = 7;
    double number = 0.25, numbers[2];
    bool boolean = false;
    const char *string = NULL;
    size_t count;
    assert_int_equal(mt_json_whole(context, &root, "n", MT_JSON_REQUIRED, 0, 10, &whole), MT_OK);
    assert_int_equal(whole, 3);
    assert_int_equal(mt_json_whole(context, &root, "w", MT_JSON_OPTIONAL, 0, 10, &whole), MT_OK);
    assert_int_equal(whole, 4);
    assert_int_equal(mt_json_whole(context, &root, "none", MT_JSON_OPTIONAL, 0, 10, &whole), MT_OK);
    assert_int_equal(whole, 4);
    assert_int_equal(mt_json_number(context, &root, "x", MT_JSON_REQUIRED, &number), MT_OK);
    assert_true(number == -0.5);
    assert_int_equal(mt_json_boolean(context, &root, "t", MT_JSON_REQUIRED, &boolean), MT_OK);
    assert_true(boolean);
    assert_int_equal(mt_json_string(context, &root, "s", MT_JSON_REQUIRED, &string), MT_OK);
    assert_string_equal(string, "hey");
    assert_int_equal(mt_json_numbers(context, &root, "v", MT_JSON_REQUIRED, 2, numbers), MT_OK);
    assert_true(numbers[0] == 1.0 && numbers[1] == 2.5);
    assert_int_equal(mt_json_array(context, &root, "v", MT_JSON_REQUIRED, &node, &count), MT_OK);
    assert_int_equal(count, 2);
    assert_int_equal(mt_json_array(context, &root, "none", MT_JSON_OPTIONAL, &node, &count), MT_OK);
    assert_int_equal(count, 0);
    assert_int_equal(mt_json_object(context, &root, "o", MT_JSON_REQUIRED, &node), MT_OK);
    assert_int_equal(mt_json_whole(context, &node, "big", MT_JSON_REQUIRED, 1, UINT64_MAX, &whole), MT_OK);
    assert_true(whole == INT64_MAX);
    mt_json_release(context, &json);
    test_context_end(context);
}

static void test_getters_name_the_path(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_json json;
    assert_int_equal(parse(context,
                           "{\"accessors\": [{}, {\"count\": -1, \"half\": 0.5, \"type\": \"VEC\", \"min\": [0, "
                           "\"b\", 2]}]}",
                           &json),
                     MT_OK);
    mt_json_node root = mt_json_root("a.json", &json), accessors, other;
    uint64_t whole = 7;
    double numbers[3];
    bool boolean;
    size_t count;
    assert_int_equal(mt_json_array(context, &root, "accessors", MT_JSON_REQUIRED, &accessors, &count), MT_OK);
    mt_json_node first = mt_json_element(&accessors, 0), second = mt_json_element(&accessors, 1);
    mt_json_node third = mt_json_element(&accessors, 2);
    check_said(context, mt_json_whole(context, &first, "count", MT_JSON_REQUIRED, 1, 9, &whole),
               "a.json: accessors[0].count: is missing, expected a whole number from 1 to 9");
    check_said(context, mt_json_whole(context, &second, "count", MT_JSON_REQUIRED, 1, UINT64_MAX, &whole),
               "a.json: accessors[1].count: expected a whole number from 1 on, got -1");
    check_said(context, mt_json_whole(context, &second, "half", MT_JSON_OPTIONAL, 0, 9, &whole),
               "a.json: accessors[1].half: expected a whole number from 0 to 9, got 0.5");
    check_said(context, mt_json_number(context, &second, "type", MT_JSON_REQUIRED, numbers),
               "a.json: accessors[1].type: expected a number, got \"VEC\"");
    check_said(context, mt_json_numbers(context, &second, "min", MT_JSON_REQUIRED, 3, numbers),
               "a.json: accessors[1].min[1]: expected a number, got \"b\"");
    check_said(context, mt_json_numbers(context, &second, "min", MT_JSON_REQUIRED, 2, numbers),
               "a.json: accessors[1].min: expected an array of 2 numbers, got an array of 3");
    check_said(context, mt_json_boolean(context, &second, "min", MT_JSON_REQUIRED, &boolean),
               "a.json: accessors[1].min: expected true or false, got an array of 3");
    check_said(context, mt_json_object(context, &root, "accessors", MT_JSON_REQUIRED, &other),
               "a.json: accessors: expected an object, got an array of 2");
    check_said(context, mt_json_array(context, &root, "nodes", MT_JSON_REQUIRED, &other, &count),
               "a.json: nodes: is missing, expected an array");
    check_said(context, mt_json_whole(context, &third, "count", MT_JSON_OPTIONAL, 0, 9, &whole),
               "a.json: accessors[2]: is missing, expected an object");
    assert_int_equal(whole, 7);
    mt_json_release(context, &json);
    test_context_end(context);
}

static void test_long_paths_are_cut(void **state)
{
    (void)state;
    mt_json_node nodes[64] = {{.key = "a.json"}};
    char path[MT_JSON_PATH];
    mt_json_path(&nodes[0], path);
    assert_string_equal(path, "the root");
    for (size_t i = 1; i < 64; i++) {
        nodes[i] = (mt_json_node){.parent = &nodes[i - 1],
                                  .key = i % 2 ? "gr\xC3\xB6\xC3\x9F"
                                                 "e"
                                               : NULL,
                                  .index = i};
    }
    mt_json_path(&nodes[2], path);
    assert_string_equal(path, "gr\xC3\xB6\xC3\x9F"
                              "e[2]");
    mt_json_path(&nodes[63], path);
    assert_true(strlen(path) < MT_JSON_PATH && strncmp(path, "...", 3) == 0);
    assert_non_null(strstr(path, "[62].gr"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refusals_name_line_and_column),
        cmocka_unit_test(test_nesting_is_limited),
        cmocka_unit_test(test_marks_of_encodings),
        cmocka_unit_test(test_memory_is_within_what_was_counted),
        cmocka_unit_test(test_the_limit_is_asked_first),
        cmocka_unit_test(test_getters_read_what_is_there),
        cmocka_unit_test(test_getters_name_the_path),
        cmocka_unit_test(test_long_paths_are_cut),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
