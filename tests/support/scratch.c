#include "tests/support/unit.h"

#include "tests/support/scratch.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[192];
static pid_t owner, writer;

static void remove_folder(void)
{
    if (getpid() != owner) {
        return;
    }
    DIR *entries = opendir(folder);
    struct dirent *entry;
    while (entries && (entry = readdir(entries))) {
        unlinkat(dirfd(entries), entry->d_name, 0);
    }
    if (entries) {
        closedir(entries);
    }
    rmdir(folder);
}

static void make_folder(void)
{
    if (!folder[0]) {
        const char *place = getenv("TMPDIR");
        int length = snprintf(folder, sizeof folder, "%s/meshtool-test-XXXXXX", place && place[0] ? place : P_tmpdir);
        assert_in_range(length, 1, sizeof folder - 1);
        assert_non_null(mkdtemp(folder));
        owner = getpid();
        atexit(remove_folder);
    }
}

const char *test_scratch_path(const char *name)
{
    static char paths[8][256];
    static unsigned next;
    make_folder();
    char *path = paths[next++ % 8];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

const char *test_scratch_file(const char *name, const void *bytes, size_t size)
{
    const char *path = test_scratch_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static void fill_pipe(const char *path, const char *bytes, size_t size)
{
    signal(SIGPIPE, SIG_IGN);
    int file = open(path, O_WRONLY);
    while (file >= 0 && size > 0) {
        ssize_t written = write(file, bytes, size);
        if (written < 0) {
            break;
        }
        bytes += written;
        size -= (size_t)written;
    }
    _exit(0);
}

const char *test_scratch_pipe(const char *name, const void *bytes, size_t size)
{
    const char *path = test_scratch_path(name);
    assert_int_equal(mkfifo(path, 0600), 0);
    writer = fork();
    assert_true(writer >= 0);
    if (writer == 0) {
        fill_pipe(path, bytes, size);
    }
    return path;
}

void test_scratch_pipe_end(const char *path)
{
    int status;
    assert_int_equal(waitpid(writer, &status, 0), writer);
    assert_int_equal(unlink(path), 0);
}

size_t test_scratch_count(void)
{
    size_t count = 0;
    make_folder();
    DIR *entries = opendir(folder);
    assert_non_null(entries);
    while (readdir(entries)) {
        count++;
    }
    closedir(entries);
    return count - 2;
}
