/* A regular file is written without a name where the system can (so that not even a killed run leaves anything),
 * otherwise under a name beside the target, and takes its place by a rename at the end. */
#include "formats/stream/output.h"

#include "formats/stream/pack.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define BUFFER_SIZE ((size_t)256 << 10)
#define NAME_ATTEMPTS 100

struct mt_output {
    char *name;   /* as the user named it */
    char *target; /* the place to rename to, NULL for streams and memory */
    char *temporary;
    int file; /* -1 for memory */
    bool owns_file;
    bool unnamed;  /* the file has no name yet */
    bool has_name; /* the file at `temporary` must go if the run fails */
    bool no_clobber;
    mt_status status;  /* the first failure */
    mt_packer *packer; /* NULL: the bytes are written as they are */
    char *buffer;
    size_t buffer_size, buffer_capacity; /* in memory outputs the buffer holds everything */
};

static mt_status fail_output(mt_context *context, const char *name, const char *what, int error)
{
    char text[128];
    mt_place place = {.file = name};
    return mt_fail_at(context, MT_ERROR_IO, place, "%s: %s", what, strerror_r(error, text, sizeof text));
}

static mt_status refuse(mt_context *context, const char *name, const char *why)
{
    mt_place place = {.file = name};
    return mt_fail_at(context, MT_ERROR_IO, place, "%s", why);
}

/* Names of open files: what a shell redirected is written into, whatever it is. */
static bool names_open_file(const char *path)
{
    return strcmp(path, "/dev/stdout") == 0 || strcmp(path, "/dev/stderr") == 0 || strncmp(path, "/dev/fd/", 8) == 0 ||
           strncmp(path, "/proc/", 6) == 0;
}

bool mt_output_is_stream(const char *path)
{
    struct stat status;
    if (strcmp(path, "-") == 0 || names_open_file(path)) {
        return true;
    }
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

static void destroy_output(mt_context *context, mt_output *output)
{
    if (output->owns_file && output->file >= 0) {
        close(output->file);
    }
    if (output->has_name) {
        unlink(output->temporary);
    }
    mt_free(context, output->name);
    mt_free(context, output->target);
    mt_free(context, output->temporary);
    mt_packer_destroy(context, output->packer);
    mt_free(context, output->buffer);
    mt_free(context, output);
}

static mt_output *create_output(mt_context *context, const char *name)
{
    mt_output *output = mt_allocate_zeroed(context, sizeof *output);
    if (!output) {
        return NULL;
    }
    output->file = -1;
    output->name = mt_duplicate_string(context, name);
    output->buffer = mt_allocate(context, BUFFER_SIZE);
    output->buffer_capacity = BUFFER_SIZE;
    if (!output->name || !output->buffer) {
        destroy_output(context, output);
        return NULL;
    }
    return output;
}

static mt_status open_stream(mt_context *context, mt_output *output, const char *path)
{
    if (strcmp(path, "-") == 0) {
        output->file = STDOUT_FILENO;
        return MT_OK;
    }
    output->file = open(path, O_WRONLY | O_CLOEXEC);
    output->owns_file = true;
    return output->file < 0 ? fail_output(context, path, "could not be opened for writing", errno) : MT_OK;
}

/* Whether the file at the path, if there is one, may be replaced; *mode receives its permissions. */
static mt_status examine_target(mt_context *context, const mt_output *output, struct stat *status, bool *exists)
{
    struct stat link;
    *exists = stat(output->name, status) == 0;
    if (!*exists && lstat(output->name, &link) == 0) {
        return refuse(context, output->name, "is a symbolic link to nothing, expected a place to write to");
    }
    if (!*exists) {
        return MT_OK;
    }
    if (S_ISDIR(status->st_mode)) {
        return refuse(context, output->name, "is a directory, expected a file to write");
    }
    if (output->no_clobber) {
        return refuse(context, output->name, "exists already and was not to be overwritten");
    }
    /* The permission bits count for root too, whom the system would let through. */
    if ((status->st_mode & 0222) == 0 || access(output->name, W_OK) != 0) {
        return refuse(context, output->name, "is read-only");
    }
    return MT_OK;
}

/* The target with symbolic links followed, so that a link stays a link, and room for a name beside it. */
static mt_status resolve_target(mt_context *context, mt_output *output, bool exists)
{
    char resolved[PATH_MAX];
    if (exists && !realpath(output->name, resolved)) {
        return fail_output(context, output->name, "could not be opened for writing", errno);
    }
    output->target = mt_duplicate_string(context, exists ? resolved : output->name);
    if (!output->target) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    output->temporary = mt_allocate(context, strlen(output->target) + 64);
    return output->temporary ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

/* Writes into `temporary` a name beside the target that differs from attempt to attempt. */
static void name_temporary(mt_output *output, unsigned attempt)
{
    const char *slash = strrchr(output->target, '/');
    size_t directory = slash ? (size_t)(slash - output->target) + 1 : 0;
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    memcpy(output->temporary, output->target, directory);
    snprintf(output->temporary + directory, 64, ".meshtool-%lx-%lx-%x", (unsigned long)getpid(),
             (unsigned long)now.tv_nsec, attempt);
}

static int open_unnamed(mt_output *output)
{
    if (access("/proc/self/fd", X_OK) != 0) {
        return -1;
    }
    const char *slash = strrchr(output->target, '/');
    size_t length = slash ? (size_t)(slash - output->target) + 1 : 0;
    memcpy(output->temporary, output->target, length);
    memcpy(output->temporary + length, ".", 2);
    return open(output->temporary, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
}

static mt_status open_beside(mt_context *context, mt_output *output)
{
    output->owns_file = true;
    output->file = open_unnamed(output);
    output->unnamed = output->file >= 0;
    for (unsigned attempt = 0; output->file < 0 && attempt < NAME_ATTEMPTS; attempt++) {
        name_temporary(output, attempt);
        output->file = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        output->has_name = output->file >= 0;
        if (output->file < 0 && errno != EEXIST) {
            break;
        }
    }
    return output->file < 0 ? fail_output(context, output->name, "could not be created", errno) : MT_OK;
}

/* By the name's end, as compressing tools name files. */
static mt_status open_packer(mt_context *context, mt_output *output)
{
    const mt_codec *codec = mt_codec_of_path(output->name);
    if (codec && !codec->create_packer) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "%s: this meshtool was built without %s", output->name,
                       codec->library);
    }
    return codec ? mt_packer_create(context, codec, &output->packer) : MT_OK;
}

static mt_status open_regular(mt_context *context, mt_output *output)
{
    struct stat old;
    bool exists;
    mt_status status = examine_target(context, output, &old, &exists);
    if (status == MT_OK) {
        status = open_packer(context, output);
    }
    if (status == MT_OK) {
        status = resolve_target(context, output, exists);
    }
    if (status == MT_OK) {
        status = open_beside(context, output);
    }
    if (status == MT_OK && exists) {
        /* The owner first: changing it clears bits of the mode. Not being allowed to is no failure. */
        if (fchown(output->file, old.st_uid, old.st_gid) != 0) {
            errno = 0;
        }
        if (fchmod(output->file, old.st_mode & 07777) != 0) {
            errno = 0;
        }
    }
    return status;
}

mt_status mt_output_open(mt_context *context, const char *path, bool no_clobber, mt_output **out)
{
    *out = NULL;
    bool standard = strcmp(path, "-") == 0;
    mt_output *output = create_output(context, standard ? "standard output" : path);
    if (!output) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    output->no_clobber = no_clobber;
    mt_status status = mt_output_is_stream(path) ? open_stream(context, output, path) : open_regular(context, output);
    if (status != MT_OK) {
        destroy_output(context, output);
        return status;
    }
    *out = output;
    return MT_OK;
}

mt_status mt_output_open_memory(mt_context *context, mt_output **out)
{
    *out = create_output(context, "memory");
    return *out ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status write_file(mt_context *context, void *user, const char *bytes, size_t size)
{
    mt_output *output = (mt_output *)user;
    while (size > 0) {
        ssize_t written = write(output->file, bytes, size);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            output->status = fail_output(context, output->name, "could not be written", errno);
            return output->status;
        }
        bytes += written;
        size -= (size_t)written;
    }
    return MT_OK;
}

static mt_status send(mt_context *context, mt_output *output, const char *bytes, size_t size, bool finish)
{
    if (!output->packer) {
        return write_file(context, output, bytes, size);
    }
    output->status = mt_packer_write(context, output->packer, bytes, size, finish, write_file, output);
    return output->status;
}

static mt_status flush_output(mt_context *context, mt_output *output, bool finish)
{
    size_t size = output->buffer_size;
    output->buffer_size = 0;
    return send(context, output, output->buffer, size, finish);
}

static mt_status grow_memory(mt_context *context, mt_output *output, size_t size)
{
    size_t needed;
    size_t doubled = 2 * output->buffer_capacity;
    if (__builtin_add_overflow(output->buffer_size, size, &needed)) {
        return output->status = mt_fail(context, MT_ERROR_TOO_LARGE, "more bytes were written than memory can address");
    }
    if (needed <= output->buffer_capacity) {
        return MT_OK;
    }
    size_t capacity = needed < doubled ? doubled : needed;
    char *buffer = mt_reallocate(context, output->buffer, capacity);
    if (!buffer) {
        return output->status = MT_ERROR_OUT_OF_MEMORY;
    }
    output->buffer = buffer;
    output->buffer_capacity = capacity;
    return MT_OK;
}

mt_status mt_output_write(mt_context *context, mt_output *output, const void *bytes, size_t size)
{
    mt_status status = output->status;
    if (status == MT_OK && output->file < 0) {
        status = grow_memory(context, output, size);
    } else if (status == MT_OK && output->buffer_capacity - output->buffer_size < size) {
        status = flush_output(context, output, false);
        if (status == MT_OK && size >= output->buffer_capacity) {
            return send(context, output, bytes, size, false);
        }
    }
    if (status == MT_OK && size > 0) {
        memcpy(output->buffer + output->buffer_size, bytes, size);
        output->buffer_size += size;
    }
    return status;
}

mt_status mt_output_text(mt_context *context, mt_output *output, const char *text)
{
    return mt_output_write(context, output, text, strlen(text));
}

mt_status mt_output_format(mt_context *context, mt_output *output, const char *format, ...)
{
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (length < 0 || (size_t)length >= sizeof text) {
        return output->status =
                   mt_fail(context, MT_ERROR_INTERNAL, "a formatted line is longer than %zu bytes", sizeof text);
    }
    return mt_output_write(context, output, text, (size_t)length);
}

/* Gives the unnamed file a name beside the target. */
static bool link_unnamed(mt_output *output)
{
    char source[64];
    snprintf(source, sizeof source, "/proc/self/fd/%d", output->file);
    for (unsigned attempt = 0; attempt < NAME_ATTEMPTS; attempt++) {
        name_temporary(output, attempt);
        if (linkat(AT_FDCWD, source, AT_FDCWD, output->temporary, AT_SYMLINK_FOLLOW) == 0) {
            output->has_name = true;
            return true;
        }
        if (errno != EEXIST) {
            return false;
        }
    }
    return false;
}

static bool rename_into_place(mt_output *output)
{
    if (!output->no_clobber) {
        return rename(output->temporary, output->target) == 0;
    }
    /* A hard link never replaces: whoever made the file meanwhile keeps it. */
    return link(output->temporary, output->target) == 0 && unlink(output->temporary) == 0;
}

static mt_status put_into_place(mt_context *context, mt_output *output)
{
    if (output->unnamed && !link_unnamed(output)) {
        return fail_output(context, output->name, "could not be created", errno);
    }
    int file = output->file;
    output->file = -1;
    if (close(file) != 0) {
        return fail_output(context, output->name, "could not be written", errno);
    }
    if (!rename_into_place(output)) {
        return fail_output(context, output->name, "could not be put into place", errno);
    }
    output->has_name = false;
    return MT_OK;
}

mt_status mt_output_commit(mt_context *context, mt_output *output)
{
    mt_status status = output->status;
    if (status == MT_OK && output->file >= 0) {
        status = flush_output(context, output, true);
    }
    if (status == MT_OK && output->target) {
        status = put_into_place(context, output);
    } else if (status == MT_OK && output->owns_file && close(output->file) != 0) {
        output->file = -1;
        status = fail_output(context, output->name, "could not be written", errno);
    } else if (status == MT_OK && output->owns_file) {
        output->file = -1;
    }
    destroy_output(context, output);
    return status;
}

mt_status mt_output_take(mt_context *context, mt_output *output, void **bytes, size_t *size)
{
    mt_status status = output->status;
    *bytes = status == MT_OK ? output->buffer : NULL;
    *size = status == MT_OK ? output->buffer_size : 0;
    if (status == MT_OK) {
        output->buffer = NULL;
    }
    destroy_output(context, output);
    return status;
}

void mt_output_abandon(mt_context *context, mt_output *output)
{
    if (output) {
        destroy_output(context, output);
    }
}
