/* Every format to every other and back, in every encoding, for every small mesh: what both can hold is kept, bit for
 * bit. And each format to itself: writing what was read gives the same bytes again. */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/same.h"
#include "tests/support/zoo.h"

#include <meshtool/mesh_format.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct target {
    const mt_mesh_format *format;
    mt_encoding encoding;
} target;

static size_t list_targets(target *targets)
{
    size_t count = 0;
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        const bool has[] = {(*format)->has_ascii, (*format)->has_binary, (*format)->has_binary_big};
        for (int encoding = 0; encoding < 3; encoding++) {
            if (has[encoding]) {
                targets[count++] = (target){*format, (mt_encoding)(MT_ENCODING_ASCII + encoding)};
            }
        }
    }
    return count;
}

/* What the format holds in that encoding. */
static unsigned abilities_of(const target *t)
{
    return t->format->abilities & ~(t->encoding == MT_ENCODING_ASCII ? 0 : t->format->ascii_abilities);
}

/* Written and read again. */
static mt_mesh *pass(mt_context *context, const mt_mesh *mesh, const target *to, void **bytes, size_t *size)
{
    mt_mesh_write_options options = {
        .format = to->format->name, .encoding = to->encoding, .draco = {.lossless = true, .sequential = true}};
    char name[32];
    mt_mesh *again = NULL;
    snprintf(name, sizeof name, "pass.%s", to->format->extensions[0]);
    mt_context_clear_error(context);
    if (mt_mesh_write_memory(context, mesh, &options, bytes, size) != MT_OK ||
        mt_mesh_read_memory(context, name, *bytes, *size, NULL, &again, NULL) != MT_OK) {
        fail_msg("%s: %s", name, mt_context_error(context)->message);
    }
    return again;
}

static mt_mesh *pass_through(mt_context *context, const mt_mesh *mesh, const target *to)
{
    void *bytes;
    size_t size;
    mt_mesh *again = pass(context, mesh, to, &bytes, &size);
    mt_free(context, bytes);
    return again;
}

static void check(mt_context *context, const char *animal, const mt_mesh *a, const mt_mesh *b, const target *first,
                  const target *second, unsigned abilities)
{
    const char *difference = test_difference(context, a, b, abilities);
    if (difference) {
        fail_msg("%s through %s (encoding %d) and %s (encoding %d): %s differs", animal, first->format->name,
                 first->encoding, second->format->name, second->encoding, difference);
    }
}

static void test_every_pair_of_formats(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    target targets[32];
    mt_context *context = test_context_with_threads(1);
    size_t animal_count = test_zoo(context, animals), target_count = list_targets(targets), trips = 0;
    for (size_t i = 0; i < animal_count; i++) {
        for (size_t first = 0; first < target_count; first++) {
            const target *a = &targets[first];
            if (test_animal_is_refused(&animals[i], a->format)) {
                continue;
            }
            mt_mesh *once = pass_through(context, animals[i].mesh, a);
            check(context, animals[i].name, animals[i].mesh, once, a, a, abilities_of(a));
            for (size_t second = 0; second < target_count; second++) {
                const target *b = &targets[second];
                if (test_animal_is_refused(&animals[i], b->format)) {
                    continue;
                }
                mt_mesh *there = pass_through(context, once, b), *back = pass_through(context, there, a);
                unsigned both = abilities_of(a) & abilities_of(b);
                check(context, animals[i].name, once, there, a, b, both);
                check(context, animals[i].name, once, back, a, b, both);
                mt_mesh_destroy(context, there);
                mt_mesh_destroy(context, back);
                trips++;
            }
            mt_mesh_destroy(context, once);
        }
    }
    print_message("%zu meshes, %zu encodings of formats, %zu round trips\n", animal_count, target_count, trips);
    test_zoo_end(context, animals, animal_count);
    test_context_end(context);
}

static void test_writing_what_was_read_gives_the_same_bytes(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    target targets[32];
    mt_context *context = test_context_with_threads(1);
    size_t animal_count = test_zoo(context, animals), target_count = list_targets(targets);
    for (size_t i = 0; i < animal_count; i++) {
        for (size_t t = 0; t < target_count; t++) {
            void *first, *second, *third;
            size_t first_size, second_size, third_size;
            if (test_animal_is_refused(&animals[i], targets[t].format)) {
                continue;
            }
            mt_mesh *once = pass(context, animals[i].mesh, &targets[t], &first, &first_size);
            mt_mesh *twice = pass(context, once, &targets[t], &second, &second_size);
            mt_mesh *thrice = pass(context, twice, &targets[t], &third, &third_size);
            if (third_size != second_size || memcmp(second, third, second_size) != 0) {
                fail_msg("%s as %s, encoding %d: written again it differs", animals[i].name, targets[t].format->name,
                         targets[t].encoding);
            }
            assert_int_equal(test_mesh_hash(twice), test_mesh_hash(thrice));
            mt_mesh_destroy(context, once);
            mt_mesh_destroy(context, twice);
            mt_mesh_destroy(context, thrice);
            mt_free(context, first);
            mt_free(context, second);
            mt_free(context, third);
        }
    }
    test_zoo_end(context, animals, animal_count);
    test_context_end(context);
}

/* A conversion that loses nothing says so, and one that is told to lose nothing refuses what it cannot hold. */
static void test_loss_is_said(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    target targets[32];
    mt_context *context = test_context_with_threads(1);
    size_t animal_count = test_zoo(context, animals), target_count = list_targets(targets);
    for (size_t i = 0; i < animal_count; i++) {
        for (size_t t = 0; t < target_count; t++) {
            mt_mesh_write_options options = {
                .format = targets[t].format->name, .encoding = targets[t].encoding, .strict_loss = true};
            mt_loss loss;
            void *bytes;
            size_t size;
            mt_context_clear_error(context);
            if (test_animal_is_refused(&animals[i], targets[t].format)) {
                continue;
            }
            assert_int_equal(mt_mesh_format_loss(context, animals[i].mesh, targets[t].format, &options, &loss), MT_OK);
            mt_status status = mt_mesh_write_memory(context, animals[i].mesh, &options, &bytes, &size);
            assert_int_equal(status, loss.count > 0 ? MT_ERROR_LOSS : MT_OK);
            if (loss.count > 0) {
                assert_non_null(strstr(mt_context_error(context)->message, loss.items[0]));
            }
            mt_free(context, bytes);
        }
    }
    test_zoo_end(context, animals, animal_count);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_pair_of_formats),
        cmocka_unit_test(test_writing_what_was_read_gives_the_same_bytes),
        cmocka_unit_test(test_loss_is_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
