/* gzip and zstd, in and out: what is written comes back, the bytes are always the same, and damaged, incomplete or
 * exploding data is refused with its place. Other programs' files are in tests/cli/test_compression.sh. */
#include "tests/support/unit.h"

#include "formats/stream/codec.h"
#include "formats/stream/input.h"
#include "formats/stream/output.h"
#include "tests/support/fixture.h"
#include "tests/support/scratch.h"

#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Text-like bytes: runs and repetitions among noise. */
static unsigned char *make_bytes(size_t size, uint64_t seed)
{
    unsigned char *bytes = malloc(size + 1);
    test_random random = {seed};
    for (size_t i = 0; i < size; i++) {
        bytes[i] = (unsigned char)(test_random_below(&random, 8) ? i / 64 : test_random_next(&random));
    }
    return bytes;
}

static const char *scratch(const mt_codec *codec)
{
    static char name[64];
    snprintf(name, sizeof name, "file.bin.%s", codec->extension);
    return test_scratch_path(name);
}

/* Writes in pieces of random sizes up to `piece`. */
static void write_file(mt_context *context, const char *path, const unsigned char *bytes, size_t size, size_t piece)
{
    test_random random = {piece};
    mt_output *output;
    assert_int_equal(mt_output_open(context, path, false, &output), MT_OK);
    for (size_t done = 0; done < size;) {
        size_t part = 1 + (size_t)test_random_below(&random, piece);
        part = part < size - done ? part : size - done;
        assert_int_equal(mt_output_write(context, output, bytes + done, part), MT_OK);
        done += part;
    }
    assert_int_equal(mt_output_commit(context, output), MT_OK);
}

static unsigned char *pack(mt_context *context, const mt_codec *codec, const unsigned char *bytes, size_t size,
                           size_t piece, size_t *packed_size)
{
    const char *path = scratch(codec);
    write_file(context, path, bytes, size, piece);
    unsigned char *packed = test_read_file(path, packed_size);
    assert_non_null(packed);
    unlink(path);
    return packed;
}

/* Reads all, in pieces; NULL when it fails, *size then being what came before. */
static unsigned char *unpack(mt_context *context, const void *packed, size_t packed_size, size_t room, size_t *size)
{
    mt_input *input;
    unsigned char *bytes = malloc(room + 100);
    size_t got = 1;
    *size = 0;
    mt_context_clear_error(context);
    mt_status status = mt_input_open_memory(context, "packed", packed, packed_size, &input);
    while (status == MT_OK && got > 0) {
        size_t part = *size + 1000 < room + 100 ? 1000 : room + 100 - *size;
        status = mt_input_read(context, input, bytes + *size, part, &got);
        *size += got;
    }
    mt_input_close(context, input);
    if (status != MT_OK) {
        free(bytes);
        return NULL;
    }
    return bytes;
}

static void for_each_codec(void (*check)(const mt_codec *codec))
{
    for (const mt_codec *const *codec = mt_codecs(); *codec; codec++) {
        if ((*codec)->create_packer) {
            check(*codec);
        } else {
            print_message("built without %s: not tested\n", (*codec)->library);
        }
    }
}

static void check_round_trips(const mt_codec *codec)
{
    const size_t sizes[] = {0, 1, 100, 65535, 65536, 300000, 5000000};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        unsigned char *bytes = make_bytes(sizes[i], i + 1);
        size_t packed_size, again_size, size;
        unsigned char *packed = pack(context, codec, bytes, sizes[i], 100000, &packed_size);
        unsigned char *again = pack(context, codec, bytes, sizes[i], 700000, &again_size);
        assert_int_equal(packed_size, again_size);
        assert_memory_equal(packed, again, packed_size);
        assert_true(sizes[i] < 1000 || packed_size < sizes[i] / 2);
        assert_ptr_equal(mt_codec_of_content(packed, packed_size), codec);
        free(again);
        again = unpack(context, packed, packed_size, sizes[i], &size);
        assert_non_null(again);
        assert_int_equal(size, sizes[i]);
        assert_memory_equal(again, bytes, size);
        free(again);
        free(packed);
        free(bytes);
    }
    test_context_end(context);
}

static void what_is_written_comes_back(void **state)
{
    (void)state;
    for_each_codec(check_round_trips);
}

static void gzip_files_hold_no_time(void **state)
{
    (void)state;
    if (!mt_gzip_codec.create_packer) {
        skip();
    }
    mt_context *context = test_context();
    size_t size;
    unsigned char *packed = pack(context, &mt_gzip_codec, (const unsigned char *)"abc", 3, 3, &size);
    assert_memory_equal(packed, "\x1f\x8b\x08\x00\x00\x00\x00\x00", 8);
    free(packed);
    test_context_end(context);
}

/* A stream that is collected: its size becomes known, and any place can be read at. */
static void check_collecting(const mt_codec *codec)
{
    enum { SIZE = 9000000 };
    mt_context *context = test_context();
    unsigned char *bytes = make_bytes(SIZE, 5), part[100];
    const char *path = scratch(codec);
    mt_input *input;
    const uint8_t *peeked;
    size_t peek_size;
    write_file(context, path, bytes, SIZE, 1000000);
    assert_int_equal(mt_input_open(context, path, &input), MT_OK);
    assert_true(mt_input_size(input) == UINT64_MAX && !mt_input_can_read_at(input));
    assert_int_equal(mt_input_peek(context, input, &peeked, &peek_size), MT_OK);
    assert_int_equal(peek_size, MT_INPUT_PEEK);
    assert_memory_equal(peeked, bytes, peek_size);
    assert_int_equal(mt_input_collect(context, input), MT_OK);
    assert_int_equal(mt_input_size(input), SIZE);
    for (size_t at = 0; at + sizeof part <= SIZE; at += 99991) {
        assert_int_equal(mt_input_read_at(input, at, part, sizeof part), sizeof part);
        assert_memory_equal(part, bytes + at, sizeof part);
    }
    mt_input_close(context, input);
    unlink(path);
    free(bytes);
    test_context_end(context);
}

static void a_compressed_file_can_be_collected(void **state)
{
    (void)state;
    for_each_codec(check_collecting);
}

/* Two members, and for gzip zeros behind them. */
static void check_members(const mt_codec *codec)
{
    mt_context *context = test_context();
    size_t one_size, two_size, size;
    unsigned char *one = pack(context, codec, (const unsigned char *)"first ", 6, 6, &one_size);
    unsigned char *two = pack(context, codec, (const unsigned char *)"second", 6, 6, &two_size);
    unsigned char *both = calloc(1, one_size + two_size + 70000);
    memcpy(both, one, one_size);
    memcpy(both + one_size, two, two_size);
    for (size_t zeros = 0; zeros <= 70000; zeros += 35000) {
        unsigned char *bytes = unpack(context, both, one_size + two_size + zeros, 12, &size);
        assert_int_equal(bytes != NULL, zeros == 0 || codec->zero_padding);
        if (bytes) {
            assert_int_equal(size, 12);
            assert_memory_equal(bytes, "first second", 12);
        }
        free(bytes);
    }
    both[one_size + two_size + 10] = 'x';
    assert_null(unpack(context, both, one_size + two_size + 20, 12, &size));
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_SYNTAX);
    both[one_size + two_size] = 'x';
    assert_null(unpack(context, both, one_size + two_size + 4, 12, &size));
    assert_int_equal(mt_context_error(context)->status, MT_ERROR_SYNTAX);
    free(both);
    free(one);
    free(two);
    test_context_end(context);
}

static void members_follow_each_other(void **state)
{
    (void)state;
    for_each_codec(check_members);
}

/* Every cut and every flipped bit: refused with a place in the compressed file, or the same bytes (a flip may fall on
 * what the content does not depend on). Never other bytes. */
static void check_damage(const mt_codec *codec)
{
    enum { SIZE = 3000 };
    mt_context *context = test_context();
    unsigned char *bytes = make_bytes(SIZE, 6);
    size_t packed_size, size, harmless = 0;
    unsigned char *packed = pack(context, codec, bytes, SIZE, SIZE, &packed_size);
    for (size_t cut = codec == &mt_gzip_codec ? 2 : 4; cut < packed_size; cut++) {
        assert_null(unpack(context, packed, cut, SIZE, &size));
        const mt_error *error = mt_context_error(context);
        assert_int_equal(error->status, MT_ERROR_SYNTAX);
        assert_true(error->place.has_offset && error->place.offset <= cut);
        assert_non_null(strstr(error->message, "the file ends inside its "));
    }
    for (size_t bit = 16; bit < 8 * packed_size; bit++) {
        packed[bit / 8] ^= (unsigned char)(1u << (bit % 8));
        unsigned char *again = unpack(context, packed, packed_size, SIZE, &size);
        bool is_plain = mt_codec_of_content(packed, packed_size) == NULL;
        if (again && !is_plain) {
            assert_int_equal(size, SIZE);
            assert_memory_equal(again, bytes, SIZE);
            harmless++;
        }
        assert_true(again || mt_context_error(context)->message[0]);
        free(again);
        packed[bit / 8] ^= (unsigned char)(1u << (bit % 8));
    }
    print_message("%s: %zu of %zu flips changed nothing\n", codec->title, harmless, 8 * packed_size);
    assert_true(harmless < packed_size / 5); /* of eight times as many */
    free(packed);
    free(bytes);
    test_context_end(context);
}

static void damage_is_never_other_bytes(void **state)
{
    (void)state;
    for_each_codec(check_damage);
}

/* Half a gigabyte of zeros. */
static void check_bomb(const mt_codec *codec)
{
    mt_context *context = test_context();
    const char *path = scratch(codec);
    unsigned char *zeros = calloc(1, 1 << 20);
    mt_output *output;
    mt_input *input;
    assert_int_equal(mt_output_open(context, path, false, &output), MT_OK);
    for (int i = 0; i < 512; i++) {
        assert_int_equal(mt_output_write(context, output, zeros, 1 << 20), MT_OK);
    }
    assert_int_equal(mt_output_commit(context, output), MT_OK);
    assert_int_equal(mt_input_open(context, path, &input), MT_OK);
    assert_int_equal(mt_input_collect(context, input), MT_ERROR_TOO_LARGE);
    assert_non_null(strstr(mt_context_error(context)->message, "expands to more than 256 times its size"));
    assert_true(mt_context_peak_bytes(context) < (size_t)256 << 20);
    mt_input_close(context, input);
    test_context_end(context);
    mt_context_options options = {.memory_limit = 32 << 20};
    context = mt_context_create(&options);
    assert_int_equal(mt_input_open(context, path, &input), MT_OK);
    assert_int_equal(mt_input_collect(context, input), MT_ERROR_OUT_OF_MEMORY);
    assert_true(mt_context_peak_bytes(context) <= 32 << 20);
    mt_input_close(context, input);
    test_context_end(context);
    unlink(path);
    free(zeros);
}

static void bombs_are_refused(void **state)
{
    (void)state;
    for_each_codec(check_bomb);
}

static mt_status copy_through(mt_context *context, const char *path, const char *text)
{
    char bytes[100];
    size_t got = 0;
    mt_input *input = NULL;
    mt_output *output = NULL;
    mt_status status = mt_output_open(context, path, false, &output);
    if (status == MT_OK && (status = mt_output_text(context, output, text)) != MT_OK) {
        mt_output_abandon(context, output);
        return status;
    }
    status = status == MT_OK ? mt_output_commit(context, output) : status;
    status = status == MT_OK ? mt_input_open(context, path, &input) : status;
    status = status == MT_OK ? mt_input_read(context, input, bytes, sizeof bytes, &got) : status;
    if (status == MT_OK) {
        assert_int_equal(got, strlen(text));
        assert_memory_equal(bytes, text, got);
    }
    mt_input_close(context, input);
    return status;
}

static void check_missing_memory(const mt_codec *codec)
{
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n};
        mt_context *context = mt_context_create(&options);
        assert_non_null(context);
        status = copy_through(context, scratch(codec), "some text that is compressed");
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        unlink(scratch(codec));
        assert_int_equal(test_scratch_count(), 0);
        assert_true(n < 100);
        test_context_end(context);
    }
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    for_each_codec(check_missing_memory);
}

/* The extension before the compression's decides where the content does not. */
static void check_meshes(const mt_codec *codec)
{
    static const char text[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    mt_context *context = test_context();
    const mt_mesh_format *format;
    mt_mesh *mesh;
    size_t size;
    char name[32];
    unsigned char *packed = pack(context, codec, (const unsigned char *)text, strlen(text), 7, &size);
    snprintf(name, sizeof name, "mesh.off.%s", codec->extension);
    assert_int_equal(mt_mesh_read_memory(context, name, packed, size, NULL, &mesh, &format), MT_OK);
    assert_string_equal(format->name, "off");
    const char *path = test_scratch_path(name);
    assert_int_equal(mt_mesh_write_file(context, mesh, path, NULL, NULL), MT_OK);
    mt_mesh_destroy(context, mesh);
    assert_int_equal(mt_mesh_read_file(context, path, NULL, &mesh, &format), MT_OK);
    assert_string_equal(format->name, "off");
    assert_int_equal(mesh->face_count, 1);
    mt_mesh_destroy(context, mesh);
    unlink(path);
    free(packed);
    snprintf(name, sizeof name, "mesh.%s", codec->extension);
    assert_null(mt_mesh_format_for_output(context, name, NULL));
    assert_non_null(strstr(mt_context_error(context)->message, "no extension"));
    test_context_end(context);
}

static void meshes_are_read_and_written_compressed(void **state)
{
    (void)state;
    for_each_codec(check_meshes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_comes_back),         cmocka_unit_test(gzip_files_hold_no_time),
        cmocka_unit_test(a_compressed_file_can_be_collected), cmocka_unit_test(members_follow_each_other),
        cmocka_unit_test(damage_is_never_other_bytes),        cmocka_unit_test(bombs_are_refused),
        cmocka_unit_test(every_allocation_may_fail),          cmocka_unit_test(meshes_are_read_and_written_compressed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
