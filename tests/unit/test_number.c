/* Numbers in text: exactly as strtod rounds them, and shortest on the way back. */
#include "tests/support/unit.h"

#include "formats/stream/cursor.h"
#include "tests/support/fixture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Parses a word as a block of text would hold it: a line end and padding behind. */
static mt_number_result parse(const char *word, double *number, size_t *length)
{
    char text[400] = {0};
    size_t size = strlen(word);
    const char *stop;
    memcpy(text, word, size);
    text[size] = '\n';
    mt_number_result result = mt_scan_number(text, text + size, number, &stop);
    double again = 0.0;
    const char *slow_stop;
    assert_int_equal(mt_number_parse(text, text + size, &again, &slow_stop), result);
    if (result != MT_NUMBER_MISSING) {
        assert_memory_equal(&again, number, sizeof again);
    }
    assert_ptr_equal(stop, slow_stop);
    *length = (size_t)(stop - text);
    return result;
}

static void check_word(const char *word)
{
    double number, expected = strtod(word, NULL);
    size_t length;
    assert_int_equal(parse(word, &number, &length), isinf(expected) ? MT_NUMBER_TOO_LARGE : MT_NUMBER_OK);
    if (memcmp(&number, &expected, sizeof number) != 0) {
        fail_msg("%s read as %a, expected %a", word, number, expected);
    }
    assert_int_equal(length, strlen(word));
}

static double random_double(test_random *random)
{
    double number;
    do {
        uint64_t bits = test_random_next(random);
        memcpy(&number, &bits, sizeof number);
    } while (!isfinite(number));
    return number;
}

static void test_rounding_agrees_with_strtod(void **state)
{
    (void)state;
    test_random random = {1};
    char word[64];
    check_word("12345678.12345678");
    for (int i = 0; i < 300000; i++) {
        int digits = 1 + (int)test_random_below(&random, 19);
        int places = (int)test_random_below(&random, 22);
        uint64_t mantissa = test_random_next(&random);
        for (int shorter = 20; shorter > digits; shorter--) {
            mantissa /= 10;
        }
        /* Written as whole digits with a point put in. */
        char all[64];
        int length = snprintf(all, sizeof all, "%022llu", (unsigned long long)mantissa);
        int skip = length - (digits > places ? digits : places);
        skip = skip < 0 ? 0 : skip;
        snprintf(word, sizeof word, "%s%.*s.%s", i % 2 ? "-" : "",
                 length - places - skip < 0 ? 0 : length - places - skip, all + skip, all + length - places);
        if (strcmp(word, ".") != 0 && strcmp(word, "-.") != 0) {
            check_word(word);
        }
        snprintf(word, sizeof word, "%.*g", 1 + i % 20, random_double(&random));
        check_word(word);
        snprintf(word, sizeof word, "%.*f", i % 18, 1000.0 * test_random_unit(&random) - 500.0);
        check_word(word);
    }
}

/* Halfway between two doubles, and one digit to either side: the hardest to round. */
static void test_ties(void **state)
{
    (void)state;
    static const char *const words[] = {"9007199254740993",
                                        "9007199254740992.9",
                                        "9007199254740993.1",
                                        "9007199254740995",
                                        "900719925474099.35",
                                        "0.500000000000000055",
                                        "0.50000000000000005551",
                                        "1.0000000000000001110",
                                        "1.000000000000000111",
                                        "18446744073709551615",
                                        "9999999999999999999",
                                        "0.9999999999999999999",
                                        "1e22",
                                        "1e23",
                                        "4.9e-324",
                                        "2.4703282292062327e-324",
                                        "2.4703282292062328e-324",
                                        "1.7976931348623157e308",
                                        "1.7976931348623158e308",
                                        "1e-400",
                                        "-1e-400",
                                        "0e999999999999",
                                        "1e309",
                                        "-1e309",
                                        "1e99999999999999999999"};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        check_word(words[i]);
    }
}

static void test_forms(void **state)
{
    (void)state;
    static const struct {
        const char *word;
        mt_number_result result;
        double number;
        size_t length;
    } cases[] = {
        {"+1", MT_NUMBER_OK, 1.0, 2},       {"-.5", MT_NUMBER_OK, -0.5, 3},
        {"5.", MT_NUMBER_OK, 5.0, 2},       {"1e-3", MT_NUMBER_OK, 1e-3, 4},
        {"1E+3", MT_NUMBER_OK, 1e3, 4},     {"+.5e1", MT_NUMBER_OK, 5.0, 5},
        {"inf", MT_NUMBER_OK, INFINITY, 3}, {"-Infinity", MT_NUMBER_OK, -INFINITY, 9},
        {"1,5", MT_NUMBER_OK, 1.0, 1},      {"0x10", MT_NUMBER_OK, 0.0, 1},
        {"1e", MT_NUMBER_OK, 1.0, 1},       {"1.5.2", MT_NUMBER_OK, 1.5, 3},
        {"-0", MT_NUMBER_OK, -0.0, 2},      {"", MT_NUMBER_MISSING, 0.0, 0},
        {"-", MT_NUMBER_MISSING, 0.0, 0},   {"+", MT_NUMBER_MISSING, 0.0, 0},
        {".", MT_NUMBER_MISSING, 0.0, 0},   {"+-1", MT_NUMBER_MISSING, 0.0, 0},
        {"--1", MT_NUMBER_MISSING, 0.0, 0}, {"abc", MT_NUMBER_MISSING, 0.0, 0},
        {"e5", MT_NUMBER_MISSING, 0.0, 0},  {" 1", MT_NUMBER_MISSING, 0.0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        double number = 0.0;
        size_t length;
        assert_int_equal(parse(cases[i].word, &number, &length), cases[i].result);
        assert_memory_equal(&number, &cases[i].number, sizeof number);
        assert_int_equal(length, cases[i].length);
    }
    double number;
    size_t length;
    assert_int_equal(parse("NaN", &number, &length), MT_NUMBER_OK);
    assert_true(isnan(number) && length == 3);
}

static void test_printing_round_trips_and_is_short(void **state)
{
    (void)state;
    test_random random = {2};
    char text[MT_NUMBER_ROOM + 1], shorter[64];
    for (int i = 0; i < 200000; i++) {
        double number = i % 2 ? random_double(&random) : (double)(float)(test_random_unit(&random) * 100.0);
        text[mt_number_print(number, text)] = '\0';
        double back = strtod(text, NULL);
        assert_memory_equal(&back, &number, sizeof number);
        /* One significant digit less does not read back. */
        size_t digits = 0;
        for (const char *c = text; *c && *c != 'e'; c++) {
            digits += mt_is_digit(*c);
        }
        if (digits > 1 && strchr(text, 'e')) {
            snprintf(shorter, sizeof shorter, "%.*e", (int)digits - 2, number);
            assert_true(strtod(shorter, NULL) != number);
        }
        float single = (float)number;
        if (isfinite(single)) {
            text[mt_number_print_float(single, text)] = '\0';
            assert_true(strtof(text, NULL) == single);
        }
    }
    assert_int_equal(mt_number_print_float(0.1f, text), 3);
    assert_memory_equal(text, "0.1", 3);
    assert_int_equal(mt_number_print(-0.0, text), 2);
}

static void test_unsigned(void **state)
{
    (void)state;
    const char *stop;
    assert_int_equal(mt_scan_unsigned("123/4567", &stop), 123);
    assert_int_equal(*stop, '/');
    assert_int_equal(mt_scan_unsigned("4294967296 ", &stop), 4294967296u);
    assert_int_equal(mt_scan_unsigned("12345678 12345678", &stop), 12345678);
    assert_true(mt_scan_unsigned("999999999999999999 ", &stop) == 999999999999999999u);
    const char *huge = "99999999999999999999999999999999 ";
    assert_true(mt_scan_unsigned(huge, &stop) == UINT64_MAX);
    assert_int_equal(*stop, ' ');
    const char *none = "/1234567";
    assert_int_equal(mt_scan_unsigned(none, &stop), 0);
    assert_ptr_equal(stop, none);
}

/* So many digits and no more, rounded as the C library rounds. */
static void test_digits_are_rounded(void **state)
{
    (void)state;
    uint64_t seed = 12345;
    for (int i = 0; i < 20000; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        double number = ((double)(seed >> 11) * 0x1p-53 - 0.5) * pow(10, (int)(seed % 40) - 20);
        unsigned digits = 1 + (unsigned)(seed >> 7) % 17;
        char ours[MT_NUMBER_ROOM + 1], theirs[64];
        ours[mt_number_print_digits(number, digits, ours)] = '\0';
        snprintf(theirs, sizeof theirs, "%.*g", (int)digits, number);
        assert_string_equal(ours, theirs);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits_are_rounded),
        cmocka_unit_test(test_rounding_agrees_with_strtod),
        cmocka_unit_test(test_ties),
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_printing_round_trips_and_is_short),
        cmocka_unit_test(test_unsigned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
