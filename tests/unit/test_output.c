/* Writing: files appear whole or not at all, old ones keep their permissions, devices are written into. */
#include "tests/support/unit.h"

#include "formats/stream/output.h"
#include "tests/support/fixture.h"
#include "tests/support/scratch.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void check_file(const char *path, const char *expected)
{
    size_t size;
    unsigned char *bytes = test_read_file(path, &size);
    assert_non_null(bytes);
    assert_int_equal(size, strlen(expected));
    assert_memory_equal(bytes, expected, size);
    free(bytes);
}

static mt_status write_text(mt_context *context, const char *path, bool no_clobber, const char *text)
{
    mt_output *output;
    mt_context_clear_error(context);
    mt_status status = mt_output_open(context, path, no_clobber, &output);
    if (status == MT_OK) {
        status = mt_output_text(context, output, text);
        if (status != MT_OK) {
            mt_output_abandon(context, output);
            return status;
        }
        status = mt_output_commit(context, output);
    }
    return status;
}

static mode_t mode_of(const char *path)
{
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    return status.st_mode & 07777;
}

static void test_new_files_follow_the_mask(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_path("new.txt");
    mode_t old = umask(027);
    assert_int_equal(write_text(context, path, false, "hello"), MT_OK);
    umask(old);
    check_file(path, "hello");
    assert_int_equal(mode_of(path), 0640);
    assert_int_equal(test_scratch_count(), 1);
    unlink(path);
    test_context_end(context);
}

static void test_old_files_keep_their_mode_and_links(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_file("old.txt", "old", 3), *link = test_scratch_path("link.txt");
    chmod(path, 0604);
    assert_int_equal(symlink("old.txt", link), 0);
    assert_int_equal(write_text(context, link, false, "new"), MT_OK);
    check_file(path, "new");
    assert_int_equal(mode_of(path), 0604);
    struct stat status;
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(test_scratch_count(), 2);
    unlink(link);
    unlink(path);
    test_context_end(context);
}

/* Until the commit the old file is whole and nobody sees the new one; abandoned, nothing was. */
static void test_abandoned_leaves_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_file("kept.txt", "old", 3), *other = test_scratch_path("never.txt");
    mt_output *output;
    char *large = calloc(1, 1 << 20);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mt_output_open(context, i ? other : path, false, &output), MT_OK);
        assert_int_equal(mt_output_write(context, output, large, 1 << 20), MT_OK);
        check_file(path, "old");
        mt_output_abandon(context, output);
        check_file(path, "old");
        assert_int_equal(test_scratch_count(), 1);
    }
    free(large);
    unlink(path);
    test_context_end(context);
}

static void check_refused(mt_context *context, const char *path, bool no_clobber, const char *words)
{
    assert_int_equal(write_text(context, path, no_clobber, "x"), MT_ERROR_IO);
    if (!strstr(mt_context_error(context)->message, words) || !strstr(mt_context_error(context)->message, path)) {
        fail_msg("%s", mt_context_error(context)->message);
    }
}

static void test_what_cannot_be_written(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_file("there.txt", "old", 3), *dangling = test_scratch_path("dangling");
    check_refused(context, path, true, "exists already");
    chmod(path, 0444);
    check_refused(context, path, false, "is read-only");
    check_file(path, "old");
    check_refused(context, "/tmp", false, "is a directory");
    check_refused(context, "/nonexistent/a.txt", false, "No such file");
    assert_int_equal(symlink("nothing", dangling), 0);
    check_refused(context, dangling, false, "symbolic link");
    unlink(dangling);
    assert_int_equal(write_text(context, test_scratch_path("fresh.txt"), true, "x"), MT_OK);
    unlink(test_scratch_path("fresh.txt"));
    unlink(path);
    assert_int_equal(test_scratch_count(), 0);
    test_context_end(context);
}

/* Whoever makes the file between the opening and the commit keeps it. */
static void test_no_clobber_at_the_commit(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_path("race.txt");
    mt_output *output;
    assert_int_equal(mt_output_open(context, path, true, &output), MT_OK);
    assert_int_equal(mt_output_text(context, output, "ours"), MT_OK);
    test_scratch_file("race.txt", "theirs", 6);
    assert_int_equal(mt_output_commit(context, output), MT_ERROR_IO);
    check_file(path, "theirs");
    assert_int_equal(test_scratch_count(), 1);
    unlink(path);
    test_context_end(context);
}

static void test_full_device(void **state)
{
    (void)state;
    mt_context *context = test_context();
    if (access("/dev/full", W_OK) != 0) {
        print_message("skipped: no /dev/full\n");
    } else {
        assert_true(mt_output_is_stream("/dev/full"));
        check_refused(context, "/dev/full", false, "No space left");
        char *large = malloc(3 << 20);
        memset(large, 'a', (3 << 20) - 1);
        large[(3 << 20) - 1] = '\0';
        assert_int_equal(write_text(context, "/dev/full", false, large), MT_ERROR_IO);
        free(large);
        struct stat status;
        assert_int_equal(stat("/dev/full", &status), 0);
        assert_true(S_ISCHR(status.st_mode));
    }
    assert_int_equal(write_text(context, "/dev/null", false, "gone"), MT_OK);
    test_context_end(context);
}

static void test_pipes_are_written_into(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_path("out.pipe");
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_true(mt_output_is_stream(path));
    pid_t reader = fork();
    if (reader == 0) {
        char bytes[16] = {0};
        int file = open(path, O_RDONLY);
        ssize_t got = read(file, bytes, sizeof bytes);
        _exit(got == 5 && memcmp(bytes, "hello", 5) == 0 ? 0 : 1);
    }
    assert_int_equal(write_text(context, path, true, "hello"), MT_OK);
    int status;
    assert_int_equal(waitpid(reader, &status, 0), reader);
    assert_int_equal(status, 0);
    unlink(path);
    assert_true(mt_output_is_stream("-"));
    assert_true(mt_output_is_stream("/dev/stdout"));
    assert_false(mt_output_is_stream("a.obj"));
    assert_false(mt_output_is_stream("/tmp"));
    test_context_end(context);
}

static void test_memory_and_sizes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const char *path = test_scratch_path("parts.bin");
    test_random random = {8};
    size_t total = 3000000, size;
    unsigned char *bytes = malloc(total);
    for (size_t i = 0; i < total; i++) {
        bytes[i] = (unsigned char)test_random_next(&random);
    }
    mt_output *file, *memory;
    assert_int_equal(mt_output_open(context, path, false, &file), MT_OK);
    assert_int_equal(mt_output_open_memory(context, &memory), MT_OK);
    for (size_t at = 0; at < total;) {
        size_t part = (size_t)test_random_below(&random, test_random_below(&random, 8) ? 1000 : 600000);
        part = part < total - at ? part : total - at;
        assert_int_equal(mt_output_write(context, file, bytes + at, part), MT_OK);
        assert_int_equal(mt_output_write(context, memory, bytes + at, part), MT_OK);
        at += part;
    }
    void *taken;
    assert_int_equal(mt_output_commit(context, file), MT_OK);
    assert_int_equal(mt_output_take(context, memory, &taken, &size), MT_OK);
    assert_int_equal(size, total);
    assert_memory_equal(taken, bytes, total);
    mt_free(context, taken);
    unsigned char *back = test_read_file(path, &size);
    assert_int_equal(size, total);
    assert_memory_equal(back, bytes, total);
    free(back);
    free(bytes);
    unlink(path);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_new_files_follow_the_mask), cmocka_unit_test(test_old_files_keep_their_mode_and_links),
        cmocka_unit_test(test_abandoned_leaves_nothing),  cmocka_unit_test(test_what_cannot_be_written),
        cmocka_unit_test(test_no_clobber_at_the_commit),  cmocka_unit_test(test_full_device),
        cmocka_unit_test(test_pipes_are_written_into),    cmocka_unit_test(test_memory_and_sizes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
