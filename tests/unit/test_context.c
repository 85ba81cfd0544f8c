/* The context: the limit and the count of bytes, the failing allocation, the first error, parallel blocks. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <string.h>

static void bytes_are_counted_and_given_back(void **state)
{
    (void)state;
    mt_context *context = test_context();
    char *small = mt_allocate(context, 100);
    char *large = mt_allocate(context, (uint64_t)9 << 20);
    assert_non_null(small);
    assert_non_null(large);
    assert_int_equal((uintptr_t)small % 64, 0);
    assert_int_equal((uintptr_t)large % 64, 0);
    memset(large, 1, (size_t)9 << 20);
    assert_int_equal(mt_context_bytes(context), 100 + ((uint64_t)9 << 20));
    mt_free(context, large);
    assert_int_equal(mt_context_bytes(context), 100);
    assert_int_equal(mt_context_peak_bytes(context), 100 + ((uint64_t)9 << 20));
    small = mt_reallocate(context, small, 200);
    assert_int_equal(mt_context_bytes(context), 200);
    mt_free(context, small);
    mt_free(context, NULL);
    test_context_end(context);
}

static void reallocation_keeps_the_contents(void **state)
{
    (void)state;
    mt_context *context = test_context();
    unsigned char *block = mt_reallocate(context, NULL, 10);
    for (unsigned char i = 0; i < 10; i++) {
        block[i] = i;
    }
    block = mt_reallocate(context, block, 100000);
    block = mt_reallocate(context, block, 5);
    for (unsigned char i = 0; i < 5; i++) {
        assert_int_equal(block[i], i);
    }
    mt_free(context, block);
    test_context_end(context);
}

static void the_limit_holds(void **state)
{
    (void)state;
    mt_context_options options = {.memory_limit = 1000};
    mt_context *context = mt_context_create(&options);
    void *block = mt_allocate(context, 600);
    assert_non_null(block);
    assert_null(mt_allocate(context, 401));
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_OUT_OF_MEMORY);
    assert_non_null(strstr(mt_context_error(context)->message, "1000"));
    void *rest = mt_try_allocate(context, 400);
    assert_non_null(rest);
    mt_free(context, rest);
    mt_free(context, block);
    test_context_end(context);
}

static void held_bytes_count_like_allocated_ones(void **state)
{
    (void)state;
    mt_context_options options = {.memory_limit = 1000};
    mt_context *context = mt_context_create(&options);
    assert_int_equal(mt_hold_bytes(context, 600), MT_OK);
    assert_int_equal(mt_context_bytes(context), 600);
    assert_null(mt_try_allocate(context, 401));
    assert_int_equal(mt_hold_bytes(context, 401), MT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(mt_context_bytes(context), 600);
    mt_release_bytes(context, 600);
    assert_int_equal(mt_context_peak_bytes(context), 600);
    test_context_end(context);
}

static void the_chosen_allocation_fails_and_all_after_it(void **state)
{
    (void)state;
    mt_context_options options = {.failing_allocation = 2};
    mt_context *context = mt_context_create(&options);
    void *first = mt_allocate(context, 1);
    assert_non_null(first);
    assert_null(mt_try_allocate(context, 1));
    assert_null(mt_try_allocate(context, 1));
    assert_int_equal(mt_context_allocation_count(context), 3);
    mt_free(context, first);
    test_context_end(context);
}

static void sizes_that_overflow_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    assert_null(mt_allocate_array(context, UINT64_MAX / 2, 3));
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_TOO_LARGE);
    mt_context_clear_error(context);
    assert_null(mt_allocate(context, UINT64_MAX - 5));
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_OUT_OF_MEMORY);
    test_context_end(context);
}

static void the_first_error_wins_and_keeps_its_place(void **state)
{
    (void)state;
    mt_context *context = test_context();
    char file[] = "a.obj";
    mt_place place = {.file = file, .line = 7};
    assert_int_equal(mt_fail_at(context, MT_ERROR_SYNTAX, place, "index %d is 0", 3), MT_ERROR_SYNTAX);
    file[0] = 'x';
    mt_fail(context, MT_ERROR_IO, "later");
    assert_string_equal(mt_context_error(context)->message, "a.obj:7: index 3 is 0");
    assert_string_equal(mt_context_error(context)->place.file, "a.obj");
    mt_context_clear_error(context);
    place = (mt_place){.file = "b.stl", .offset = 84, .has_offset = true};
    mt_fail_at(context, MT_ERROR_SYNTAX, place, "short");
    assert_string_equal(mt_context_error(context)->message, "b.stl@84: short");
    test_context_end(context);
}

static void long_messages_are_cut_and_not_overrun(void **state)
{
    (void)state;
    mt_context *context = test_context();
    char name[2000];
    memset(name, 'n', sizeof name - 1);
    name[sizeof name - 1] = 0;
    mt_place place = {.file = name, .line = 1};
    mt_fail_at(context, MT_ERROR_IO, place, "%s", name);
    assert_true(strlen(mt_context_error(context)->message) < sizeof mt_context_error(context)->message);
    test_context_end(context);
}

static void mark_block(void *user, uint64_t begin, uint64_t end)
{
    uint64_t *ends = user;
    for (uint64_t i = begin; i < end; i++) {
        ends[i] = end;
    }
}

static void parallel_blocks_are_the_same_for_any_thread_count(void **state)
{
    (void)state;
    static uint64_t ends[3][1000];
    const unsigned threads[] = {1, 2, 7};
    for (int i = 0; i < 3; i++) {
        mt_context *context = test_context_with_threads(threads[i]);
        mt_parallel_for(context, 1000, 64, mark_block, ends[i]);
        mt_parallel_for(context, 0, 64, mark_block, NULL);
        test_context_end(context);
    }
    assert_int_equal(ends[0][0], 64);
    assert_int_equal(ends[0][999], 1000);
    assert_memory_equal(ends[0], ends[1], sizeof ends[0]);
    assert_memory_equal(ends[0], ends[2], sizeof ends[0]);
}

static bool refuse(void *user, const char *task, double fraction)
{
    (void)task;
    *(double *)user = fraction;
    return fraction < 0.5;
}

static void progress_can_cancel(void **state)
{
    (void)state;
    double last = 0;
    mt_context_options options = {.progress = refuse, .progress_user = &last};
    mt_context *context = mt_context_create(&options);
    assert_int_equal(mt_progress(context, "working", 0.25), MT_OK);
    assert_int_equal(mt_progress(context, "working", 0.5), MT_ERROR_CANCELLED);
    assert_true(last == 0.5);
    test_context_end(context);
}

static void parts_are_recorded_when_asked(void **state)
{
    (void)state;
    mt_context_options options = {.explain = true};
    mt_context *context = mt_context_create(&options);
    int token = mt_part_begin(context, "tree", "many rays");
    void *block = mt_allocate(context, 1234);
    mt_part_end(context, token);
    mt_part_skip(context, "shadows", "no light casts them");
    size_t count;
    const mt_part *parts = mt_context_parts(context, &count);
    assert_int_equal(count, 2);
    assert_string_equal(parts[0].name, "tree");
    assert_int_equal(parts[0].bytes, 1234);
    assert_true(parts[0].built && !parts[1].built);
    mt_free(context, block);
    assert_int_equal(mt_context_parts_left_out(context), 0);
    for (int i = 0; i < 100; i++) {
        mt_part_skip(context, "rays", NULL);
    }
    mt_context_parts(context, &count);
    assert_int_equal(count + mt_context_parts_left_out(context), 102);
    assert_true(mt_context_parts_left_out(context) > 0);
    test_context_end(context);
    context = test_context();
    mt_part_end(context, mt_part_begin(context, "tree", NULL));
    mt_context_parts(context, &count);
    assert_int_equal(count, 0);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bytes_are_counted_and_given_back),
        cmocka_unit_test(reallocation_keeps_the_contents),
        cmocka_unit_test(the_limit_holds),
        cmocka_unit_test(held_bytes_count_like_allocated_ones),
        cmocka_unit_test(the_chosen_allocation_fails_and_all_after_it),
        cmocka_unit_test(sizes_that_overflow_are_refused),
        cmocka_unit_test(the_first_error_wins_and_keeps_its_place),
        cmocka_unit_test(long_messages_are_cut_and_not_overrun),
        cmocka_unit_test(parallel_blocks_are_the_same_for_any_thread_count),
        cmocka_unit_test(progress_can_cancel),
        cmocka_unit_test(parts_are_recorded_when_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
