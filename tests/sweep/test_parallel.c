/* Large meshes on two threads, so that readers and writers work in many blocks: the n-th allocation fails, for many n,
 * and the work is cancelled at every step. Either leaves nothing behind. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>
#include <meshtool/triangulate.h>

#include <stdio.h>
#include <string.h>

/* About 2 MB of text and 1 of binary: several blocks of either. */
enum { SIDE = 160 };

typedef struct target {
    const mt_mesh_format *format;
    mt_encoding encoding;
    char name[32];
    void *bytes;
    size_t size;
    uint64_t hash;
} target;

static mt_mesh *grid(mt_context *context, mt_index side)
{
    mt_generate_options options = {.resolution = side};
    mt_mesh *mesh, *triangles;
    assert_int_equal(mt_generate(context, "torus", &options, &mesh), MT_OK);
    assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
    mt_mesh_destroy(context, mesh);
    return triangles;
}

/* Of the formats that hold indices, or of those that do not. */
static size_t prepare(mt_context *context, const mt_mesh *mesh, unsigned indices, target *targets)
{
    size_t count = 0;
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int encoding = 0; encoding < 3; encoding++) {
            if (!has[encoding] || ((*format)->abilities & MT_HOLDS_INDICES) != indices) {
                continue;
            }
            target *t = &targets[count++];
            *t = (target){.format = *format, .encoding = (mt_encoding)(MT_ENCODING_ASCII + encoding)};
            mt_mesh_write_options options = {.format = t->format->name, .encoding = t->encoding};
            snprintf(t->name, sizeof t->name, "large.%s", t->format->extensions[0]);
            assert_int_equal(mt_mesh_write_memory(context, mesh, &options, &t->bytes, &t->size), MT_OK);
            mt_mesh *again;
            assert_int_equal(mt_mesh_read_memory(context, t->name, t->bytes, t->size, NULL, &again, NULL), MT_OK);
            t->hash = test_mesh_hash(again);
            mt_mesh_destroy(context, again);
        }
    }
    return count;
}

static void check_stopped(mt_context *context, mt_status status, mt_status expected, const target *t, uint64_t n)
{
    if (status != expected || mt_context_error(context)->status != expected || mt_context_bytes(context) != 0) {
        fail_msg("%s, encoding %d, stopped at %llu: status %d, \"%s\", %llu bytes held", t->name, t->encoding,
                 (unsigned long long)n, status, mt_context_error(context)->message,
                 (unsigned long long)mt_context_bytes(context));
    }
}

/* Reads or writes; true when that was not stopped, with its result checked. */
static bool run(mt_context *context, const mt_mesh *mesh, const target *t, bool writing, mt_status expected, uint64_t n)
{
    mt_status status;
    if (writing) {
        mt_mesh_write_options options = {.format = t->format->name, .encoding = t->encoding};
        void *bytes;
        size_t size;
        status = mt_mesh_write_memory(context, mesh, &options, &bytes, &size);
        if (status == MT_OK) {
            assert_int_equal(size, t->size);
            assert_memory_equal(bytes, t->bytes, size);
            mt_free(context, bytes);
        }
    } else {
        mt_mesh *again;
        status = mt_mesh_read_memory(context, t->name, t->bytes, t->size, NULL, &again, NULL);
        if (status == MT_OK) {
            assert_int_equal(test_mesh_hash(again), t->hash);
            mt_mesh_destroy(context, again);
        }
    }
    if (status != MT_OK) {
        check_stopped(context, status, expected, t, n);
        return false;
    }
    test_context_end(context);
    return true;
}

static void sweep_allocations(const mt_mesh *mesh, const target *t, bool writing)
{
    bool done = false;
    /* Every early one, then ever fewer: those of the blocks are alike. */
    for (uint64_t n = 1; !done; n += 1 + n / 16) {
        mt_context_options options = {.thread_count = 2, .failing_allocation = n};
        mt_context *context = mt_context_create(&options);
        done = run(context, mesh, t, writing, MT_ERROR_OUT_OF_MEMORY, n);
        if (!done) {
            mt_context_destroy(context);
        }
    }
}

static void test_failing_allocations(void **state)
{
    (void)state;
    target targets[32];
    mt_context *context = test_context_with_threads(2);
    mt_mesh *mesh = grid(context, SIDE);
    size_t count = prepare(context, mesh, MT_HOLDS_INDICES, targets);
    count += prepare(context, mesh, 0, targets + count);
    for (size_t i = 0; i < count; i++) {
        sweep_allocations(mesh, &targets[i], false);
        sweep_allocations(mesh, &targets[i], true);
        mt_free(context, targets[i].bytes);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

typedef struct steps {
    uint64_t left, count;
} steps;

static bool step(void *user, const char *task, double fraction)
{
    steps *s = user;
    assert_true(task[0] && fraction >= 0.0 && fraction <= 1.0);
    s->count++;
    return s->left-- > 0;
}

/* At the first two steps, and at ever later ones. Returns how many there are. */
static uint64_t sweep_cancelling(const mt_mesh *mesh, const target *t, bool writing)
{
    for (uint64_t n = 0;; n = n == 0 ? 1 : 8 * n) {
        steps s = {.left = n};
        mt_context_options options = {.thread_count = 2, .progress = step, .progress_user = &s};
        mt_context *context = mt_context_create(&options);
        if (run(context, mesh, t, writing, MT_ERROR_CANCELLED, n)) {
            return s.count;
        }
        assert_int_equal(s.count, n + 1);
        mt_context_destroy(context);
    }
}

/* Enough for the readers of text to ask whether to go on: 32 MB and more. A format without indices takes five times
 * the bytes for the same faces. */
static void test_cancelling(void **state)
{
    (void)state;
    target targets[32];
    mt_context *context = test_context_with_threads(2);
    for (unsigned indexed = 0; indexed < 2; indexed++) {
        mt_mesh *mesh = grid(context, indexed ? 1000 : 450);
        size_t count = prepare(context, mesh, indexed ? MT_HOLDS_INDICES : 0, targets);
        for (size_t i = 0; i < count; i++) {
            uint64_t reads = sweep_cancelling(mesh, &targets[i], false);
            uint64_t writes = sweep_cancelling(mesh, &targets[i], true);
            print_message("%s, encoding %d: %llu steps of reading, %llu of writing\n", targets[i].name,
                          targets[i].encoding, (unsigned long long)reads, (unsigned long long)writes);
            mt_free(context, targets[i].bytes);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_failing_allocations), cmocka_unit_test(test_cancelling)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
