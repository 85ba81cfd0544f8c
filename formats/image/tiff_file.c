#ifdef MESHTOOL_TIFF
#include "formats/image/tiff_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#define PROBE_SIZE ((uint64_t)64 << 10)

static tmsize_t read_bytes(thandle_t handle, void *bytes, tmsize_t size)
{
    mt_tiff_file *file = (mt_tiff_file *)handle;
    uint64_t left = file->at < file->size ? file->size - file->at : 0;
    uint64_t part = (uint64_t)size < left ? (uint64_t)size : left;
    memcpy(bytes, file->bytes + file->at, (size_t)part);
    file->at += part;
    return (tmsize_t)part;
}

static bool grow(mt_tiff_file *file, uint64_t needed)
{
    if (needed <= file->capacity) {
        return true;
    }
    uint64_t capacity = needed + needed / 2 + 4096;
    uint8_t *bytes = mt_reallocate(file->context, file->bytes, capacity);
    if (!bytes) {
        file->is_full = true;
        return false;
    }
    file->bytes = bytes;
    file->capacity = capacity;
    return true;
}

static tmsize_t write_bytes(thandle_t handle, void *bytes, tmsize_t size)
{
    mt_tiff_file *file = (mt_tiff_file *)handle;
    uint64_t end = file->at + (uint64_t)size;
    if (!grow(file, end)) {
        return 0;
    }
    if (file->at > file->size) {
        memset(file->bytes + file->size, 0, (size_t)(file->at - file->size));
    }
    memcpy(file->bytes + file->at, bytes, (size_t)size);
    file->at = end;
    file->size = end > file->size ? end : file->size;
    return size;
}

static tmsize_t write_nothing(thandle_t handle, void *bytes, tmsize_t size)
{
    (void)handle, (void)bytes, (void)size;
    return 0;
}

static toff_t seek(thandle_t handle, toff_t offset, int from)
{
    mt_tiff_file *file = (mt_tiff_file *)handle;
    uint64_t begin = from == SEEK_CUR ? file->at : from == SEEK_END ? file->size : 0;
    file->at = begin + offset;
    return file->at;
}

static int close_nothing(thandle_t handle)
{
    (void)handle;
    return 0;
}

static toff_t tell_size(thandle_t handle)
{
    return ((mt_tiff_file *)handle)->size;
}

/* Keeps the first error; a result other than 0 keeps the process's handlers from printing it. */
static int keep_error(TIFF *tiff, void *user, const char *module, const char *format, va_list arguments)
{
    (void)tiff, (void)module;
    mt_tiff_file *file = (mt_tiff_file *)user;
    file->is_short = file->is_short || errno == ENOMEM;
    if (!file->message[0]) {
        vsnprintf(file->message, sizeof file->message, format, arguments);
        file->message[strcspn(file->message, "\n")] = '\0';
    }
    return 1;
}

/* Warnings are of tags that are not needed. */
static int drop_warning(TIFF *tiff, void *user, const char *module, const char *format, va_list arguments)
{
    (void)tiff, (void)user, (void)module, (void)format, (void)arguments;
    return 1;
}

TIFF *mt_tiff_open(mt_tiff_file *file, const char *mode, uint64_t largest_block)
{
    /* libtiff 4.5 follows a null pointer where its first allocations fail: see that they do not. */
    void *probe = mt_try_allocate(file->context, PROBE_SIZE);
    mt_free(file->context, probe);
    if (!probe) {
        file->is_short = true;
        return NULL;
    }
    errno = 0;
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
    if (!options) {
        file->is_short = true;
        return NULL;
    }
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, (tmsize_t)largest_block);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_error, file);
    TIFFOpenOptionsSetWarningHandlerExtR(options, drop_warning, file);
    TIFF *tiff = TIFFClientOpenExt("picture", mode, file, read_bytes, mode[0] == 'w' ? write_bytes : write_nothing,
                                   seek, close_nothing, tell_size, NULL, NULL, options);
    TIFFOpenOptionsFree(options);
    return tiff;
}
#endif
