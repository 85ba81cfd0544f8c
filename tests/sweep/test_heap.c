/* The whole heap while files are read, that of libtiff, libjpeg, libspng, jansson, Draco, zlib and zstd too. Under a
 * limit it stays within twice the limit and a constant, whatever the file; and where any single allocation fails, or
 * all from one on, reading says so, gives everything back and never returns something else. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/picture.h"
#include "tests/support/scratch.h"
#include "tests/sweep/heap.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The limit counts bytes as they are asked for; blocks of a megabyte and more are rounded up to pages of two. */
#define LIMIT_FACTOR 2

/* What is not counted against the limit: stdio, the context, the state of a decoder before it has seen a size. */
#define UNCOUNTED_BYTES ((uint64_t)1 << 20)

enum { FLIPS = 10, ROOM = 512 };

/* Reads a file; the hash is of what was read. */
typedef mt_status (*reader)(mt_context *context, const char *path, uint64_t *hash);

static mt_status read_mesh(mt_context *context, const char *path, uint64_t *hash)
{
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_read_file(context, path, NULL, &mesh, NULL);
    *hash = status == MT_OK ? test_mesh_hash(mesh) : 0;
    mt_mesh_destroy(context, mesh);
    return status;
}

static mt_status read_picture(mt_context *context, const char *path, uint64_t *hash)
{
    mt_image *image = NULL;
    mt_status status = mt_image_read_file(context, path, NULL, &image, NULL);
    *hash = status == MT_OK ? test_hash(image->pixels, (size_t)image->width * image->height * image->channel_count *
                                                           sizeof *image->pixels)
                            : 0;
    mt_image_destroy(context, image);
    return status;
}

/* A file to read. */
typedef struct sample {
    char path[ROOM];
    reader read;
} sample;

typedef void (*sample_function)(const sample *sample);

static mt_context *limited_context(uint64_t limit)
{
    mt_context_options options = {.thread_count = 1, .memory_limit = limit};
    mt_context *context = mt_context_create(&options);
    assert_non_null(context);
    return context;
}

/* The mesh in every format and encoding, and those of them that are text also compressed. */
static void for_each_mesh_file(const char *primitive, mt_index resolution, sample_function function)
{
    static const char *const ends[] = {"", ".gz", ".zst"};
    mt_context *context = limited_context(0);
    mt_generate_options size = {.resolution = resolution};
    mt_mesh *mesh;
    assert_int_equal(mt_generate(context, primitive, &size, &mesh), MT_OK);
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int i = 0; i < 9; i++) {
            mt_mesh_write_options options = {.encoding = (mt_encoding)(MT_ENCODING_ASCII + i / 3)};
            char name[ROOM];
            sample s = {.read = read_mesh};
            snprintf(name, sizeof name, "heap.%s%s", (*format)->extensions[0], ends[i % 3]);
            snprintf(s.path, sizeof s.path, "%s", test_scratch_path(name));
            if (has[i / 3] && (i == 0 || i % 3 == 0 || i / 3 == 0)) {
                assert_int_equal(mt_mesh_write_file(context, mesh, s.path, &options, NULL), MT_OK);
                function(&s);
                unlink(s.path);
            }
        }
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A picture in every format, of as many channels and bits as there are. */
static void for_each_picture_file(uint32_t width, uint32_t height, sample_function function)
{
    mt_context *context = limited_context(0);
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        static const unsigned channels[] = {1, 3, 4}, bits[] = {0, 1, 16, 32};
        for (int i = 0; i < 12; i++) {
            test_random random = {(uint64_t)i};
            mt_image *image = test_picture(context, &random, width, height, channels[i / 4]);
            mt_image_write_options options = {.bits = bits[i % 4]};
            char name[ROOM];
            sample s = {.read = read_picture};
            snprintf(name, sizeof name, "heap.%s", (*format)->extensions[0]);
            snprintf(s.path, sizeof s.path, "%s", test_scratch_path(name));
            if (mt_image_write_file(context, image, s.path, &options) == MT_OK) {
                function(&s);
                unlink(s.path);
            }
            mt_context_clear_error(context);
            mt_image_destroy(context, image);
        }
    }
    test_context_end(context);
}

static void read_under_limit(const sample *s, uint64_t limit, const char *how)
{
    uint64_t before = test_heap_bytes(), hash;
    mt_context *context = limited_context(limit);
    test_heap_begin(0, false);
    mt_status status = s->read(context, s->path, &hash);
    test_heap_end();
    uint64_t taken = test_heap_peak() - before;
    if (taken > LIMIT_FACTOR * limit + UNCOUNTED_BYTES || (status != MT_OK && !mt_context_error(context)->message[0])) {
        fail_msg("%s, %s, limit %llu: %llu bytes taken, status %d, \"%s\"", s->path, how, (unsigned long long)limit,
                 (unsigned long long)taken, status, mt_context_error(context)->message);
    }
    test_context_end(context);
    if (test_heap_bytes() != before) {
        fail_msg("%s, %s, limit %llu: %lld bytes not given back", s->path, how, (unsigned long long)limit,
                 (long long)(test_heap_bytes() - before));
    }
}

static void read_under_limits(const sample *s, const char *how)
{
    static const uint64_t limits[] = {16 << 10, 256 << 10, 2 << 20};
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++) {
        read_under_limit(s, limits[i], how);
    }
}

/* As it is, cut short, and with a bit changed: some in the first bytes, where sizes are declared. */
static void sweep_limits(const sample *s)
{
    test_random random = {1};
    size_t size;
    unsigned char *bytes = test_read_file(s->path, &size);
    sample changed = {.read = s->read};
    const char *dot = strchr(strrchr(s->path, '/'), '.');
    char name[ROOM], how[ROOM];
    snprintf(name, sizeof name, "changed%s", dot);
    read_under_limits(s, "whole");
    snprintf(changed.path, sizeof changed.path, "%s", test_scratch_file(name, bytes, size - size / 8));
    read_under_limits(&changed, "cut");
    for (int flip = 0; flip < FLIPS; flip++) {
        uint64_t at = test_random_below(&random, flip % 2 || size < 64 ? size : 64),
                 bit = test_random_below(&random, 8);
        bytes[at] ^= (unsigned char)(1u << bit);
        snprintf(changed.path, sizeof changed.path, "%s", test_scratch_file(name, bytes, size));
        snprintf(how, sizeof how, "bit %llu of byte %llu", (unsigned long long)bit, (unsigned long long)at);
        read_under_limits(&changed, how);
        bytes[at] ^= (unsigned char)(1u << bit);
    }
    unlink(changed.path);
    free(bytes);
}

static bool must_skip(void)
{
    if (!test_heap_is_watched()) {
        print_message("the heap cannot be watched in this build: skipped\n");
    }
    return !test_heap_is_watched();
}

static void test_limits_hold_for_all_bytes(void **state)
{
    (void)state;
    if (must_skip()) {
        return;
    }
    for_each_mesh_file("torus", 40, sweep_limits);
    for_each_picture_file(200, 150, sweep_limits);
}

/* Where sizes are declared that are not there. */
static void test_limits_hold_for_malformed_files(void **state)
{
    (void)state;
    static const char *const folders[] = {"obj", "off", "ply", "stl", "gltf", "glb", "drc"};
    size_t count = 0;
    for (size_t i = 0; !must_skip() && i < sizeof folders / sizeof folders[0]; i++) {
        char folder[64];
        snprintf(folder, sizeof folder, "meshes/malformed/%s", folders[i]);
        DIR *directory = opendir(folder);
        assert_non_null(directory);
        for (const struct dirent *entry; (entry = readdir(directory));) {
            sample s = {.read = read_mesh};
            if (entry->d_name[0] != '.') {
                snprintf(s.path, sizeof s.path, "%s/%s", folder, entry->d_name);
                read_under_limits(&s, "malformed");
                count++;
            }
        }
        closedir(directory);
    }
    assert_true(count > 100 || !test_heap_is_watched());
}

/* Returns whether the n-th allocation was still asked for. */
static bool fail_allocation(const sample *s, uint64_t n, bool alone, uint64_t right)
{
    uint64_t before = test_heap_bytes(), hash;
    mt_context *context = limited_context(0);
    test_heap_begin(n, alone);
    mt_status status = s->read(context, s->path, &hash);
    uint64_t count = test_heap_end();
    /* A library may do without what it asked for. */
    bool is_right = status == MT_OK ? hash == right : status == MT_ERROR_OUT_OF_MEMORY;
    if (!is_right || mt_context_bytes(context) != 0 || (status != MT_OK && !mt_context_error(context)->message[0])) {
        fail_msg("%s, allocation %llu%s failing: status %d, \"%s\", %llu bytes held", s->path, (unsigned long long)n,
                 alone ? " alone" : " and on", status, mt_context_error(context)->message,
                 (unsigned long long)mt_context_bytes(context));
    }
    mt_context_destroy(context);
    if (test_heap_bytes() != before) {
        fail_msg("%s, allocation %llu%s failing: %lld bytes not given back", s->path, (unsigned long long)n,
                 alone ? " alone" : " and on", (long long)(test_heap_bytes() - before));
    }
    return count >= n;
}

static void sweep_failures(const sample *s)
{
    uint64_t right;
    if (strstr(s->path, ".tif")) {
        return; /* libtiff 4.5 follows a null pointer in TIFFReadDirectory where an early allocation fails */
    }
    mt_context *context = limited_context(0);
    if (s->read(context, s->path, &right) != MT_OK) {
        fail_msg("%s: %s", s->path, mt_context_error(context)->message);
    }
    test_context_end(context);
    for (int alone = 0; alone < 2; alone++) {
        uint64_t n = 1;
        while (fail_allocation(s, n, alone != 0, right)) {
            n++;
        }
        assert_true(n > 3);
    }
}

static void test_any_allocation_may_fail(void **state)
{
    (void)state;
    if (must_skip()) {
        return;
    }
    for_each_mesh_file("cube", 0, sweep_failures);
    for_each_mesh_file("bowtie", 0, sweep_failures);
    for_each_picture_file(9, 7, sweep_failures);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_limits_hold_for_all_bytes),
                                       cmocka_unit_test(test_limits_hold_for_malformed_files),
                                       cmocka_unit_test(test_any_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
