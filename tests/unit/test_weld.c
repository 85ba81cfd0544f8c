#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/weld.h>

#include <math.h>
#include <string.h>

static float float_of_bits(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The definition, in quadratic time: the first earlier point whose coordinates have the same bits, -0 as +0. */
static bool same_place(const float *a, const float *b)
{
    for (int i = 0; i < 3; i++) {
        if (!(a[i] == b[i]) && memcmp(&a[i], &b[i], sizeof(float)) != 0) {
            return false;
        }
    }
    return true;
}

static mt_index weld_by_definition(const float *points, mt_index count, mt_index *numbers)
{
    mt_index places = 0;
    for (mt_index i = 0; i < count; i++) {
        mt_index j = 0;
        while (j < i && !same_place(points + 3 * (size_t)i, points + 3 * (size_t)j)) {
            j++;
        }
        numbers[i] = j < i ? numbers[j] : places++;
    }
    return places;
}

static void check_weld(mt_context *context, const float *points, mt_index count)
{
    mt_index *expected = mt_allocate_array(context, count, sizeof *expected);
    mt_index *numbers = mt_allocate_array(context, count, sizeof *numbers);
    float *distinct = mt_allocate_array(context, count, 3 * sizeof *distinct);
    double *wide = mt_allocate_array(context, count, 3 * sizeof *wide);
    mt_index places = weld_by_definition(points, count, expected), got, next = 0;
    assert_int_equal(mt_weld_exact(context, points, MT_F32, count, distinct, numbers, &got), MT_OK);
    assert_int_equal(got, places);
    assert_memory_equal(numbers, expected, count * sizeof *numbers);
    for (mt_index i = 0; i < count; i++) {
        if (numbers[i] == next) {
            assert_memory_equal(distinct + 3 * (size_t)next, points + 3 * (size_t)i, 3 * sizeof *distinct);
            next++;
        }
    }
    for (size_t i = 0; i < 3 * (size_t)count; i++) {
        wide[i] = (double)points[i];
    }
    bool possible;
    assert_int_equal(mt_points_may_coincide(context, points, MT_F32, count, &possible), MT_OK);
    assert_int_equal(possible, places < count);
    assert_int_equal(mt_points_may_coincide(context, wide, MT_F64, count, &possible), MT_OK);
    assert_int_equal(possible, places < count);
    assert_int_equal(mt_weld_exact(context, wide, MT_F64, count, wide, numbers, &got), MT_OK); /* in place */
    assert_int_equal(got, places);
    assert_memory_equal(numbers, expected, count * sizeof *numbers);
    mt_free(context, expected);
    mt_free(context, numbers);
    mt_free(context, distinct);
    mt_free(context, wide);
}

static void test_small_and_empty(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const float points[] = {1, 2, 3, 1, 2, 3};
    check_weld(context, points, 0);
    check_weld(context, points, 1);
    check_weld(context, points, 2);
    test_context_end(context);
}

static void test_zeros_and_nans(void **state)
{
    (void)state;
    mt_context *context = test_context();
    float one = float_of_bits(0x7fc00000), other = float_of_bits(0x7fc00001), negative = float_of_bits(0xffc00000);
    const float points[] = {0.0f, 1,     2,        -0.0f, 1,        2,         one, 1,        2, one, 1,
                            2,    other, 1,        2,     negative, 1,         2,   INFINITY, 0, 0,   -INFINITY,
                            0,    0,     INFINITY, -0.0f, 0,        0x1p-149f, 0,   0,        0, 0,   0};
    mt_index numbers[11], count;
    float distinct[33];
    assert_int_equal(mt_weld_exact(context, points, MT_F32, 11, distinct, numbers, &count), MT_OK);
    const mt_index expected[] = {0, 0, 1, 1, 2, 3, 4, 5, 4, 6, 7};
    assert_memory_equal(numbers, expected, sizeof expected);
    assert_int_equal(count, 8);
    test_context_end(context);
}

static void test_random_points(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {1};
    for (int round = 0; round < 20; round++) {
        mt_index count = 1 + (mt_index)test_random_below(&random, 3000);
        uint64_t side = 1 + test_random_below(&random, 20);
        float *points = mt_allocate_array(context, count, 3 * sizeof *points);
        for (size_t i = 0; i < 3 * (size_t)count; i++) {
            points[i] = (float)test_random_below(&random, side) - 3.0f;
            points[i] = test_random_below(&random, 7) ? points[i] : -points[i];
        }
        check_weld(context, points, count);
        mt_free(context, points);
    }
    test_context_end(context);
}

/* More points than one run of the algorithm, in an order without coherence, and more places than the table has room for
 * at first; any number of threads. */
static void test_many_points(void **state)
{
    (void)state;
    enum { COUNT = 200000, PLACES = 150000 };
    static mt_index first[PLACES];
    for (unsigned threads = 1; threads <= 3; threads++) {
        mt_context *context = test_context_with_threads(threads);
        double *points = mt_allocate_array(context, COUNT, 3 * sizeof *points);
        mt_index *numbers = mt_allocate_array(context, COUNT, sizeof *numbers), count, places = 0;
        test_random random = {7};
        memset(first, 0xff, sizeof first);
        mt_index *expected = mt_allocate_array(context, COUNT, sizeof *expected);
        for (size_t i = 0; i < COUNT; i++) {
            size_t place = test_random_below(&random, PLACES);
            points[3 * i] = (double)(place % 31);
            points[3 * i + 1] = (double)(place / 31 % 31) * 0.1;
            points[3 * i + 2] = -(double)(place / 961);
            first[place] = first[place] == MT_NONE ? places++ : first[place];
            expected[i] = first[place];
        }
        assert_int_equal(mt_weld_exact(context, points, MT_F64, COUNT, points, numbers, &count), MT_OK);
        assert_int_equal(count, places);
        assert_memory_equal(numbers, expected, COUNT * sizeof *numbers);
        mt_free(context, points);
        mt_free(context, numbers);
        mt_free(context, expected);
        test_context_end(context);
    }
}

/* Regular coordinates of few bits, none twice; then two that are far apart in the array. */
static void test_a_grid_coincides_nowhere(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_index count = 64 * 64 * 64;
    float *points = mt_allocate_array(context, count, 3 * sizeof *points);
    for (mt_index i = 0; i < count; i++) {
        points[3 * (size_t)i] = (float)(i % 64);
        points[3 * (size_t)i + 1] = (float)(i / 64 % 64) / 64;
        points[3 * (size_t)i + 2] = (float)(i / 64 / 64) * 1024;
    }
    bool possible;
    for (mt_index part = 2; part <= count; part = part < count / 3 ? 3 * part : count + (part == count)) {
        assert_int_equal(mt_points_may_coincide(context, points, MT_F32, part, &possible), MT_OK);
        assert_false(possible);
    }
    memcpy(points + 3 * (size_t)(count - 2), points + 3, 3 * sizeof *points);
    assert_int_equal(mt_points_may_coincide(context, points, MT_F32, count, &possible), MT_OK);
    assert_true(possible);
    memset(points, 0, count * 3 * sizeof *points);
    assert_int_equal(mt_points_may_coincide(context, points, MT_F32, count, &possible), MT_OK);
    assert_true(possible);
    mt_free(context, points);
    test_context_end(context);
}

static void test_missing_memory(void **state)
{
    (void)state;
    const float points[] = {1, 2, 3, 1, 2, 3};
    for (uint64_t failing = 1;; failing++) {
        mt_context_options options = {.thread_count = 1, .failing_allocation = failing};
        mt_context *context = mt_context_create(&options);
        mt_index numbers[2], count;
        float distinct[6];
        bool possible;
        mt_status status = mt_points_may_coincide(context, points, MT_F32, 2, &possible);
        if (status == MT_OK) {
            status = mt_weld_exact(context, points, MT_F32, 2, distinct, numbers, &count);
        }
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        test_context_end(context);
        if (status == MT_OK) {
            assert_true(failing > 1);
            break;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_and_empty),
        cmocka_unit_test(test_zeros_and_nans),
        cmocka_unit_test(test_random_points),
        cmocka_unit_test(test_many_points),
        cmocka_unit_test(test_a_grid_coincides_nowhere),
        cmocka_unit_test(test_missing_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
