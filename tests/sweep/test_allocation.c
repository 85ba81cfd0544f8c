/* Every format, every small mesh: the n-th allocation fails, for every n, while reading and while writing. The answer
 * is MT_ERROR_OUT_OF_MEMORY with a sentence, nothing is leaked, and no file is left behind. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/scratch.h"
#include "tests/support/zoo.h"

#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* A context in which the allocations from number `failing` on fail; 0: none. */
static mt_context *failing_context(uint64_t failing)
{
    mt_context_options options = {.thread_count = 1, .failing_allocation = failing};
    mt_context *context = mt_context_create(&options);
    assert_non_null(context);
    return context;
}

static void check_failure(mt_context *context, mt_status status, const char *what, uint64_t n)
{
    const mt_error *error = mt_context_error(context);
    if (status != MT_ERROR_OUT_OF_MEMORY || error->status != status || !error->message[0] ||
        mt_context_bytes(context) != 0) {
        fail_msg("%s with allocation %llu failing: status %d, \"%s\", %llu bytes held", what, (unsigned long long)n,
                 status, error->message, (unsigned long long)mt_context_bytes(context));
    }
}

/* Returns how many allocations the reading takes. */
static uint64_t sweep_reading(const char *name, const void *bytes, size_t size, uint64_t hash)
{
    for (uint64_t n = 1;; n++) {
        mt_context *context = failing_context(n);
        mt_mesh *mesh;
        mt_status status = mt_mesh_read_memory(context, name, bytes, size, NULL, &mesh, NULL);
        if (status == MT_OK) {
            assert_int_equal(test_mesh_hash(mesh), hash);
            assert_true(mt_context_allocation_count(context) < n);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
            return n - 1;
        }
        assert_null(mesh);
        check_failure(context, status, name, n);
        mt_context_destroy(context);
    }
}

/* The mesh lives in a context of its own: a writer only looks at it. */
static uint64_t sweep_writing(const mt_mesh *mesh, const mt_mesh_write_options *options, const void *bytes, size_t size)
{
    for (uint64_t n = 1;; n++) {
        mt_context *context = failing_context(n);
        void *again;
        size_t again_size;
        mt_status status = mt_mesh_write_memory(context, mesh, options, &again, &again_size);
        if (status == MT_OK) {
            assert_int_equal(again_size, size);
            assert_memory_equal(again, bytes, size);
            mt_free(context, again);
            test_context_end(context);
            return n - 1;
        }
        assert_null(again);
        check_failure(context, status, options->format, n);
        mt_context_destroy(context);
    }
}

static void sweep_writing_files(const mt_mesh *mesh, const mt_mesh_write_options *options)
{
    const char *path = test_scratch_path("sweep.out");
    for (uint64_t n = 1;; n++) {
        mt_context *context = failing_context(n);
        mt_status status = mt_mesh_write_file(context, mesh, path, options, NULL);
        if (status == MT_OK) {
            test_context_end(context);
            assert_int_equal(test_scratch_count(), 1);
            unlink(path);
            return;
        }
        check_failure(context, status, options->format, n);
        mt_context_destroy(context);
        assert_int_equal(test_scratch_count(), 0);
    }
}

static void sweep_animal(mt_context *context, const test_animal *animal, const mt_mesh_format *format,
                         mt_encoding encoding, uint64_t *reads, uint64_t *writes)
{
    mt_mesh_write_options options = {.format = format->name, .encoding = encoding};
    char name[32];
    void *bytes;
    size_t size;
    mt_mesh *mesh;
    if (test_animal_is_refused(animal, format)) {
        return;
    }
    snprintf(name, sizeof name, "sweep.%s", format->extensions[0]);
    assert_int_equal(mt_mesh_write_memory(context, animal->mesh, &options, &bytes, &size), MT_OK);
    if (mt_mesh_read_memory(context, name, bytes, size, NULL, &mesh, NULL) != MT_OK) {
        fail_msg("%s: %s", animal->name, mt_context_error(context)->message);
    }
    *reads += sweep_reading(name, bytes, size, test_mesh_hash(mesh));
    *writes += sweep_writing(animal->mesh, &options, bytes, size);
    sweep_writing_files(animal->mesh, &options);
    mt_mesh_destroy(context, mesh);
    mt_free(context, bytes);
}

static void test_every_allocation_of_every_format(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context_with_threads(1);
    size_t count = test_zoo(context, animals);
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int encoding = 0; encoding < 3; encoding++) {
            uint64_t reads = 0, writes = 0;
            for (size_t i = 0; has[encoding] && i < count; i++) {
                sweep_animal(context, &animals[i], *format, (mt_encoding)(MT_ENCODING_ASCII + encoding), &reads,
                             &writes);
            }
            print_message("%s, encoding %d: %llu allocations of reading, %llu of writing\n", (*format)->name, encoding,
                          (unsigned long long)reads, (unsigned long long)writes);
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_allocation_of_every_format)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
