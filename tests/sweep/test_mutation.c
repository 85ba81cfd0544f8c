/* Every format, every small mesh, with bytes changed, dropped and repeated at random (the seed is fixed): an error with
 * a sentence, or a mesh that keeps its invariants; and never more memory than the bytes justify. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/zoo.h"

#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 300, ROOM = 1 << 16 };

/* What a reader of a few kilobytes may hold: its buffers, and the numbers that so many bytes can spell. */
#define PEAK_LIMIT ((uint64_t)24 << 20)

static size_t mutate(test_random *random, uint8_t *bytes, size_t size)
{
    static const char favourites[] = "0123456789-+.eE/#\\\n\r\t nifv\xFF\x80\x7F";
    unsigned changes = 1 + (unsigned)test_random_below(random, 6);
    for (unsigned i = 0; i < changes && size > 0; i++) {
        size_t at = (size_t)test_random_below(random, size), length = (size_t)test_random_below(random, 16);
        length = length < size - at ? length : size - at;
        switch (test_random_below(random, 5)) {
        case 0:
            bytes[at] ^= (uint8_t)(1u << test_random_below(random, 8));
            break;
        case 1:
            bytes[at] = (uint8_t)test_random_next(random);
            break;
        case 2:
            bytes[at] = (uint8_t)favourites[test_random_below(random, sizeof favourites)];
            break;
        case 3:
            memmove(bytes + at, bytes + at + length, size - at - length);
            size -= length;
            break;
        default:
            if (size + length <= ROOM) {
                memmove(bytes + at + length, bytes + at, size - at);
                size += length;
            }
            break;
        }
    }
    return size;
}

static void try_bytes(const char *name, const uint8_t *bytes, size_t size, size_t *accepted)
{
    mt_context *context = test_context_with_threads(1);
    mt_mesh *mesh;
    mt_status status = mt_mesh_read_memory(context, name, bytes, size, NULL, &mesh, NULL);
    const mt_error *error = mt_context_error(context);
    if (status == MT_OK) {
        assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
        mt_mesh_destroy(context, mesh);
        ++*accepted;
    } else if (mesh || status == MT_ERROR_INTERNAL || error->status != status || !error->message[0]) {
        fail_msg("%s: status %d, \"%s\"", name, status, error->message);
    }
    if (mt_context_peak_bytes(context) > PEAK_LIMIT) {
        fail_msg("%s: %zu bytes took %llu", name, size, (unsigned long long)mt_context_peak_bytes(context));
    }
    test_context_end(context);
}

static void sweep_animal(mt_context *context, const test_animal *animal, const mt_mesh_format *format,
                         mt_encoding encoding, size_t *accepted)
{
    static uint8_t copy[ROOM];
    mt_mesh_write_options options = {.format = format->name, .encoding = encoding};
    test_random random = {(uint64_t)encoding};
    char name[32];
    void *bytes;
    size_t size;
    if (test_animal_is_refused(animal, format)) {
        return;
    }
    snprintf(name, sizeof name, "mutant.%s", format->extensions[0]);
    assert_int_equal(mt_mesh_write_memory(context, animal->mesh, &options, &bytes, &size), MT_OK);
    for (int round = 0; round < ROUNDS && size < ROOM / 2; round++) {
        memcpy(copy, bytes, size);
        try_bytes(name, copy, mutate(&random, copy, size), accepted);
    }
    mt_free(context, bytes);
}

static void test_mutants_of_every_format(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context_with_threads(1);
    size_t count = test_zoo(context, animals);
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int encoding = 0; encoding < 3; encoding++) {
            size_t accepted = 0;
            for (size_t i = 0; has[encoding] && i < count; i++) {
                sweep_animal(context, &animals[i], *format, (mt_encoding)(MT_ENCODING_ASCII + encoding), &accepted);
            }
            print_message("%s, encoding %d: %zu of %zu mutants read\n", (*format)->name, encoding, accepted,
                          has[encoding] ? count * ROUNDS : 0);
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_mutants_of_every_format)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
