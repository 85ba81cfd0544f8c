/* A preview is the same bytes for any number of threads, any compiler, and after any failure. */
#include "tests/support/picture.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/preview.h>

#include <stdio.h>
#include <string.h>

static uint64_t hash_of(const mt_image *image)
{
    return test_hash(image->pixels, (size_t)image->width * image->height * image->channel_count * sizeof(float));
}

/* Random pieces of surface: pinches, holes, flips, all at once. */
static mt_mesh *random_mesh(mt_context *context, uint64_t seed)
{
    test_random random = {seed};
    return seed % 2 ? test_patch(context, &random) : test_soup(context, &random);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    static const unsigned threads[] = {1, 2, 7};
    for (uint64_t seed = 0; seed < 12; seed++) {
        uint64_t hashes[3] = {0};
        for (int i = 0; i < 3; i++) {
            mt_context *context = test_context_with_threads(threads[i]);
            mt_mesh *mesh = seed == 0 ? test_torus(context, 400, 300, true) : random_mesh(context, seed);
            mt_preview_options options = {.width = 300, .height = 200};
            mt_image *image = NULL;
            if (mt_preview(context, mesh, &options, &image) == MT_OK) {
                hashes[i] = hash_of(image);
            }
            mt_image_destroy(context, image);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
        }
        assert_true(hashes[0] == hashes[1] && hashes[0] == hashes[2]);
    }
}

/* Sums of pictures as every compiler and processor must give them; a change of light or view changes them all. */
static const struct {
    const char *name;
    uint64_t hash;
} expected[] = {
    {"cube", 0x32353b54208bf27au},    {"teapot", 0x4700b094af9635e1u},    {"torus", 0x64ef571a1f61e3c0u},
    {"moebius", 0x3fb6346b7371f4c2u}, {"icosphere", 0x2aaa68be7e7c649fu},
};

static void the_bytes_are_known(void **state)
{
    (void)state;
    mt_context *context = test_context();
    int wrong = 0;
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        mt_mesh *mesh = NULL;
        mt_image *image = NULL;
        assert_int_equal(mt_generate(context, expected[i].name, NULL, &mesh), MT_OK);
        mt_preview_options options = {.width = 96, .height = 64};
        assert_int_equal(mt_preview(context, mesh, &options, &image), MT_OK);
        if (hash_of(image) != expected[i].hash) {
            print_message("{\"%s\", 0x%016llxu},\n", expected[i].name, (unsigned long long)hash_of(image));
            wrong++;
        }
        mt_image_destroy(context, image);
        mt_mesh_destroy(context, mesh);
    }
    assert_int_equal(wrong, 0);
    test_context_end(context);
}

/* A small mesh that uses every part: creases, a seam, a wire, a hole, marks. */
static mt_status draw_everything(mt_context *context)
{
    static const double positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0, 0, 5, 5, 5};
    static const mt_index sides[] = {0, 2, 1, 3};
    mt_mesh_layout layout = {.vertex_count = 9, .face_count = 3, .corner_count = 11, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_create(context, &layout, &mesh);
    if (status != MT_OK) {
        return status;
    }
    static const mt_index offsets[] = {0, 4, 8, 11}, corners[] = {0, 1, 2, 3, 6, 7, 5, 4, 0, 2, 5};
    memcpy(mesh->positions, positions, sizeof positions);
    memcpy(mesh->face_offsets, offsets, sizeof offsets);
    memcpy(mesh->corner_vertices, corners, sizeof corners);
    static const unsigned char marks[9] = {1, 0, 0, 0, 0, 0, 0, 0, 1};
    mt_preview_options options = {
        .width = 40, .height = 40, .vertex_marks = marks, .edge_marks = sides, .edge_mark_count = 2};
    mt_image *image = NULL;
    status = mt_preview(context, mesh, &options, &image);
    assert_int_equal(image == NULL, status != MT_OK);
    mt_image_destroy(context, image);
    mt_mesh_destroy(context, mesh);
    return status;
}

static void missing_memory_is_an_error(void **state)
{
    (void)state;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    int failures = 0;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1 + (unsigned)(n % 2)};
        mt_context *context = mt_context_create(&options);
        status = draw_everything(context);
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        failures += status != MT_OK;
        test_context_end(context);
        assert_true(n < 1000);
    }
    assert_true(failures > 20);
}

static bool stop_at(void *user, const char *task, double fraction)
{
    (void)task;
    (void)fraction;
    return --*(int *)user >= 0;
}

static void cancelling_leaves_nothing(void **state)
{
    (void)state;
    mt_status status = MT_ERROR_CANCELLED;
    int rounds = 0;
    for (; status != MT_OK; rounds++) {
        int left = rounds;
        mt_context_options options = {.progress = stop_at, .progress_user = &left};
        mt_context *context = mt_context_create(&options);
        status = draw_everything(context);
        assert_true(status == MT_OK || status == MT_ERROR_CANCELLED);
        test_context_end(context);
        assert_true(rounds < 100);
    }
    assert_true(rounds > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(the_bytes_are_known),
        cmocka_unit_test(missing_memory_is_an_error),
        cmocka_unit_test(cancelling_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
