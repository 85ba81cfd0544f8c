/* Files are read by pread, never mapped: a file that shrinks is then an error with a sentence instead of a signal. */
#include "formats/stream/input.h"

#include "formats/stream/expand.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define BUFFER_SIZE ((size_t)64 << 10)
#define CHUNK_SIZE ((size_t)4 << 20) /* of a collected stream */

struct mt_input {
    char *name;
    int file;              /* -1 for memory */
    bool owns_file;        /* false for standard input */
    bool has_folder;       /* the name is a path that was opened */
    bool positioned;       /* pread works */
    uint64_t base;         /* where in the file byte 0 lies: standard input may be half read */
    uint64_t size;         /* UINT64_MAX: unknown */
    uint64_t offset;       /* bytes handed out */
    const uint8_t *memory; /* of a memory input */
    mt_expander *expander; /* of a compressed input, whose bytes are those that come out */
    uint8_t *buffer;       /* bytes read ahead */
    size_t buffer_begin, buffer_end;
    uint8_t **chunks; /* of a collected stream, which lies there from chunk_base on */
    size_t chunk_count, chunk_capacity;
    uint64_t chunk_base;
};

static mt_status fail_open(mt_context *context, const char *path, int error)
{
    char text[128];
    mt_place place = {.file = path};
    return mt_fail_at(context, MT_ERROR_IO, place, "could not be opened: %s", strerror_r(error, text, sizeof text));
}

static mt_input *create_input(mt_context *context, const char *name)
{
    mt_input *input = mt_allocate_zeroed(context, sizeof *input);
    if (!input) {
        return NULL;
    }
    input->file = -1;
    input->name = mt_duplicate_string(context, name);
    if (!input->name) {
        mt_free(context, input);
        return NULL;
    }
    return input;
}

void mt_input_close(mt_context *context, mt_input *input)
{
    if (!input) {
        return;
    }
    if (input->owns_file) {
        close(input->file);
    }
    for (size_t i = 0; i < input->chunk_count; i++) {
        mt_free(context, input->chunks[i]);
    }
    mt_expander_destroy(context, input->expander);
    mt_free(context, input->chunks);
    mt_free(context, input->buffer);
    mt_free(context, input->name);
    mt_free(context, input);
}

/* What kind of file it is. Regular files that say 0 bytes (those of /proc) are read as streams. */
static mt_status examine_file(mt_context *context, mt_input *input)
{
    struct stat status;
    if (fstat(input->file, &status) != 0) {
        return fail_open(context, input->name, errno);
    }
    if (S_ISDIR(status.st_mode)) {
        mt_place place = {.file = input->name};
        return mt_fail_at(context, MT_ERROR_UNSUPPORTED, place, "is a directory, expected a file");
    }
    input->size = UINT64_MAX;
    if (S_ISREG(status.st_mode) && status.st_size > 0) {
        off_t now = lseek(input->file, 0, SEEK_CUR);
        input->base = now > 0 ? (uint64_t)now : 0;
        uint64_t size = (uint64_t)status.st_size;
        input->size = input->base < size ? size - input->base : 0;
        input->positioned = true;
    }
    return MT_OK;
}

static mt_status open_plain(mt_context *context, const char *path, mt_input **out)
{
    bool standard = strcmp(path, "-") == 0;
    int file = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    if (file < 0) {
        return fail_open(context, path, errno);
    }
    mt_input *input = create_input(context, standard ? "standard input" : path);
    if (!input) {
        if (!standard) {
            close(file);
        }
        return MT_ERROR_OUT_OF_MEMORY;
    }
    input->file = file;
    input->owns_file = input->has_folder = !standard;
    mt_status status = examine_file(context, input);
    if (status == MT_OK) {
        input->buffer = mt_allocate(context, BUFFER_SIZE);
        status = input->buffer ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status != MT_OK) {
        mt_input_close(context, input);
        return status;
    }
    *out = input;
    return MT_OK;
}

/* The kind of compression that the first bytes begin, NULL for none. A file is not read ahead for it. */
static mt_status find_codec(mt_context *context, mt_input *source, const mt_codec **out)
{
    uint8_t magic[MT_CODEC_MAGIC];
    const uint8_t *bytes = magic;
    size_t size = 0;
    mt_status status = MT_OK;
    *out = NULL;
    if (mt_input_can_read_at(source)) {
        size = mt_input_read_at(source, 0, magic, sizeof magic);
    } else {
        status = mt_input_peek(context, source, &bytes, &size);
    }
    if (status == MT_OK && size != SIZE_MAX) {
        *out = mt_codec_of_content(bytes, size);
    }
    return status;
}

/* Takes the source over: itself when its bytes are plain, or what comes out of them. */
static mt_status see_through(mt_context *context, mt_input *source, mt_input **out)
{
    const mt_codec *codec;
    mt_status status = find_codec(context, source, &codec);
    if (status != MT_OK) {
        mt_input_close(context, source);
        return status;
    }
    if (!codec) {
        *out = source;
        return MT_OK;
    }
    mt_input *input = create_input(context, source->name);
    bool has_folder = source->has_folder;
    mt_expander *expander = NULL;
    status = mt_expander_create(context, codec, source, &expander);
    if (input && status == MT_OK) {
        input->size = UINT64_MAX;
        input->expander = expander;
        input->has_folder = has_folder;
        input->buffer = mt_allocate(context, BUFFER_SIZE);
    } else {
        mt_expander_destroy(context, expander);
    }
    if (!input || !input->buffer) {
        mt_input_close(context, input);
        return mt_context_error(context)->status;
    }
    *out = input;
    return MT_OK;
}

mt_status mt_input_open(mt_context *context, const char *path, mt_input **out)
{
    mt_input *plain = NULL;
    *out = NULL;
    mt_status status = open_plain(context, path, &plain);
    return status == MT_OK ? see_through(context, plain, out) : status;
}

mt_status mt_input_open_memory(mt_context *context, const char *name, const void *bytes, size_t size, mt_input **out)
{
    *out = NULL;
    mt_input *plain = create_input(context, name);
    if (!plain) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    plain->memory = bytes;
    plain->size = size;
    return see_through(context, plain, out);
}

const char *mt_input_name(const mt_input *input)
{
    return input->name;
}

bool mt_input_has_folder(const mt_input *input)
{
    return input->has_folder;
}

uint64_t mt_input_size(const mt_input *input)
{
    return input->size;
}

uint64_t mt_input_offset(const mt_input *input)
{
    return input->offset;
}

mt_place mt_input_place_offset(const mt_input *input, uint64_t offset)
{
    mt_place place = {.file = input->name, .offset = offset, .has_offset = true};
    return place;
}

mt_place mt_input_place_line(const mt_input *input, uint64_t line)
{
    mt_place place = {.file = input->name, .line = line};
    return place;
}

static mt_status fail_shrunk(mt_context *context, const mt_input *input, uint64_t offset)
{
    return mt_fail_at(
        context, MT_ERROR_SYNTAX, mt_input_place_offset(input, offset),
        "the file ends here though it had %llu bytes when it was opened: it became shorter while it was read",
        (unsigned long long)input->size);
}

/* Bytes from the file into memory, as many as there are; SIZE_MAX with errno on failure. */
static size_t read_file(const mt_input *input, uint64_t offset, uint8_t *bytes, size_t size)
{
    size_t done = 0;
    while (done < size) {
        ssize_t got = input->positioned
                          ? pread(input->file, bytes + done, size - done, (off_t)(input->base + offset + done))
                          : read(input->file, bytes + done, size - done);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return SIZE_MAX;
        }
        if (got == 0) {
            break;
        }
        done += (size_t)got;
    }
    return done;
}

static size_t read_chunks(const mt_input *input, uint64_t offset, uint8_t *bytes, size_t size)
{
    size_t done = 0;
    while (done < size) {
        uint64_t at = offset - input->chunk_base + done;
        size_t within = (size_t)(at % CHUNK_SIZE);
        size_t part = CHUNK_SIZE - within < size - done ? CHUNK_SIZE - within : size - done;
        memcpy(bytes + done, input->chunks[at / CHUNK_SIZE] + within, part);
        done += part;
    }
    return done;
}

bool mt_input_can_read_at(const mt_input *input)
{
    return input->memory || input->positioned || input->chunks;
}

size_t mt_input_read_at(const mt_input *input, uint64_t offset, void *buffer, size_t size)
{
    if (offset >= input->size || size == 0) {
        return 0;
    }
    size = input->size - offset < size ? (size_t)(input->size - offset) : size;
    if (input->memory) {
        memcpy(buffer, input->memory + offset, size);
        return size;
    }
    if (input->chunks) {
        return offset < input->chunk_base ? SIZE_MAX : read_chunks(input, offset, buffer, size);
    }
    size_t got = read_file(input, offset, buffer, size);
    return got == size ? size : SIZE_MAX;
}

mt_status mt_input_fail_read_at(mt_context *context, const mt_input *input, uint64_t offset)
{
    struct stat status;
    if (fstat(input->file, &status) == 0 && (uint64_t)status.st_size < input->base + input->size) {
        uint64_t left = (uint64_t)status.st_size;
        return fail_shrunk(context, input, left < input->base ? 0 : left - input->base);
    }
    return mt_fail_at(context, MT_ERROR_IO, mt_input_place_offset(input, offset), "could not be read");
}

/* Bytes at the current offset, past the buffer. */
static mt_status read_on(mt_context *context, mt_input *input, uint64_t offset, uint8_t *bytes, size_t size,
                         size_t *got)
{
    bool sized = input->size != UINT64_MAX;
    if (sized) {
        uint64_t left = offset < input->size ? input->size - offset : 0;
        size = left < size ? (size_t)left : size;
    }
    if (input->memory || input->chunks) {
        *got = mt_input_read_at(input, offset, bytes, size);
        return MT_OK;
    }
    if (input->expander) {
        return mt_expander_read(context, input->expander, bytes, size, got);
    }
    *got = read_file(input, offset, bytes, size);
    if (*got == SIZE_MAX) {
        char text[128];
        *got = 0;
        return mt_fail_at(context, MT_ERROR_IO, mt_input_place_offset(input, offset), "could not be read: %s",
                          strerror_r(errno, text, sizeof text));
    }
    return sized && *got < size ? fail_shrunk(context, input, offset + *got) : MT_OK;
}

mt_status mt_input_peek(mt_context *context, mt_input *input, const uint8_t **bytes, size_t *size)
{
    if (input->memory) {
        *bytes = input->memory;
        *size = input->size < MT_INPUT_PEEK ? (size_t)input->size : MT_INPUT_PEEK;
        return MT_OK;
    }
    mt_status status = MT_OK;
    if (input->offset == 0 && input->buffer_end == 0) {
        status = read_on(context, input, 0, input->buffer, MT_INPUT_PEEK, &input->buffer_end);
    }
    *bytes = input->buffer;
    *size = input->buffer_end < MT_INPUT_PEEK ? input->buffer_end : MT_INPUT_PEEK;
    return status;
}

mt_status mt_input_read(mt_context *context, mt_input *input, void *buffer, size_t size, size_t *got)
{
    uint8_t *bytes = buffer;
    mt_status status = MT_OK;
    *got = 0;
    while (status == MT_OK && *got < size) {
        size_t ready = input->buffer_end - input->buffer_begin;
        size_t part = size - *got;
        if (ready == 0 && (part >= BUFFER_SIZE || !input->buffer)) {
            status = read_on(context, input, input->offset, bytes + *got, part, &part);
            input->offset += part;
            *got += part;
            return status;
        }
        if (ready == 0) {
            status = read_on(context, input, input->offset, input->buffer, BUFFER_SIZE, &input->buffer_end);
            input->buffer_begin = 0;
            if (input->buffer_end == 0) {
                return status;
            }
            continue;
        }
        part = part < ready ? part : ready;
        memcpy(bytes + *got, input->buffer + input->buffer_begin, part);
        input->buffer_begin += part;
        input->offset += part;
        *got += part;
    }
    return status;
}

mt_status mt_input_read_exactly(mt_context *context, mt_input *input, void *buffer, size_t size, const char *what)
{
    size_t got;
    mt_status status = mt_input_read(context, input, buffer, size, &got);
    if (status == MT_OK && got < size) {
        status =
            mt_fail_at(context, MT_ERROR_SYNTAX, mt_input_place_offset(input, input->offset),
                       "the file ends here, after %llu bytes, expected %s", (unsigned long long)input->offset, what);
    }
    return status;
}

static mt_status add_chunk(mt_context *context, mt_input *input)
{
    if (input->chunk_count == input->chunk_capacity) {
        size_t capacity = 2 * input->chunk_capacity + 16;
        uint8_t **chunks = mt_reallocate(context, input->chunks, capacity * sizeof *chunks);
        if (!chunks) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        input->chunks = chunks;
        input->chunk_capacity = capacity;
    }
    uint8_t *chunk = mt_allocate(context, CHUNK_SIZE);
    if (!chunk) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    input->chunks[input->chunk_count++] = chunk;
    return MT_OK;
}

mt_status mt_input_collect(mt_context *context, mt_input *input)
{
    if (mt_input_can_read_at(input)) {
        return MT_OK;
    }
    /* Until the end is known the chunks stay hidden, so that reading still asks the stream. */
    mt_input collected = *input;
    collected.chunk_base = input->offset;
    mt_status status = MT_OK;
    size_t got = CHUNK_SIZE;
    uint64_t size = input->offset;
    while (status == MT_OK && got == CHUNK_SIZE) {
        status = add_chunk(context, &collected);
        if (status == MT_OK) {
            status = mt_input_read(context, input, collected.chunks[collected.chunk_count - 1], CHUNK_SIZE, &got);
            size += got;
        }
    }
    input->chunks = collected.chunks;
    input->chunk_count = collected.chunk_count;
    input->chunk_capacity = collected.chunk_capacity;
    input->chunk_base = collected.chunk_base;
    input->offset = collected.chunk_base;
    input->size = size;
    input->buffer_begin = input->buffer_end = 0;
    return status;
}
