/* The options of a preview: the same bytes for any number of threads, any compiler and both orders; extremes; what a
 * series and a sheet keep; what is refused. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/preview.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static uint64_t hash_of(const mt_image *image)
{
    return test_hash(image->pixels, (size_t)image->width * image->height * image->channel_count * sizeof(float));
}

static mt_mesh *generate(mt_context *context, const char *name)
{
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, NULL, &mesh), MT_OK);
    return mesh;
}

static uint64_t draw(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options)
{
    mt_image *image = NULL;
    if (mt_preview(context, mesh, options, &image) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    uint64_t hash = hash_of(image);
    mt_image_destroy(context, image);
    return hash;
}

/* Pictures of the teapot, 64 x 48, and the sums of their pixels, looked at before they were written here. */
static const struct {
    mt_preview_options options;
    uint64_t hash;
} references[] = {
    {{.projection = MT_PROJECTION_ORTHOGRAPHIC, .axes = true}, 0xa8c0ad3d23626606u},
    {{.projection = MT_PROJECTION_CABINET, .wireframe = true, .scale_bar = true}, 0x08f29a36d9f888ffu},
    {{.projection = MT_PROJECTION_CAVALIER, .view = MT_VIEW_ISO, .shading = MT_SHADING_FLAT}, 0xfb8c322c50e5eb07u},
    {{.shadows = true, .ground = true}, 0x96bfdf4651296a71u},
    {{.shadows = true, .ground = true, .background = MT_BACKGROUND_TRANSPARENT, .view = MT_VIEW_LEFT},
     0xaf0393f0878f6232u},
    {{.has_eye = true, .eye = {0.2, 1.0, 0.1}, .has_target = true, .target = {2, 1, 0}, .wireframe = true},
     0x012c0ec2c78265d1u},
    {{.samples = MT_SAMPLES_ADAPTIVE, .coloring = MT_COLORING_COMPONENT}, 0xb135957a1edb21f4u},
    {{.coloring = MT_COLORING_NORMAL, .shading = MT_SHADING_SMOOTH}, 0xbe599e59720c928eu},
    {{.coloring = MT_COLORING_FACE, .fov_degrees = 80}, 0xc95620385d132fb2u},
    {{.coloring = MT_COLORING_QUALITY, .view = MT_VIEW_TOP}, 0xade4a0b6058a9bd1u},
    {{.coloring = MT_COLORING_DEPTH, .has_up = true, .up = {1, 1, 0}}, 0xf76f0cf5b5152c4fu},
    {{.coloring = MT_COLORING_ORIENTATION, .view = MT_VIEW_BOTTOM, .triangle_test = MT_RAY_EXACT}, 0x7815e7cc0da5779cu},
};

static void the_bytes_are_known(void **state)
{
    (void)state;
    static const unsigned threads[] = {1, 2, 7};
    int wrong = 0;
    for (size_t i = 0; i < sizeof references / sizeof *references; i++) {
        mt_preview_options options = references[i].options;
        options.width = 64, options.height = 48;
        for (int k = 0; k < 3; k++) {
            mt_context *context = test_context_with_threads(threads[k]);
            mt_mesh *teapot = generate(context, "teapot");
            options.method = k == 2 ? MT_METHOD_RAY : MT_METHOD_RASTER;
            uint64_t hash = draw(context, teapot, &options);
            if (hash != references[i].hash) {
                print_message("%zu, %u threads: 0x%016llxu\n", i, threads[k], (unsigned long long)hash);
                wrong++;
            }
            mt_mesh_destroy(context, teapot);
            test_context_end(context);
        }
    }
    assert_int_equal(wrong, 0);
}

static void scale_and_move(mt_mesh *mesh, double scale, double offset)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        mt_mesh_set_position(mesh, v, mt_vec3_make(p.x * scale + offset, p.y * scale - offset, p.z * scale + offset));
    }
}

/* Rays, shadows and the raster at any magnitude: powers of two change no bit, and far away the orders still agree. */
static void extremes_draw_like_the_teapot(void **state)
{
    (void)state;
    static const struct {
        double scale, offset;
        bool same;
    } rows[] = {{0x1p-900, 0, true}, {0x1p900, 0, true}, {1e-150, 0, false}, {1e150, 0, false},
                {1e307, 0, false},   {3e-312, 0, false}, {1e-3, 1e7, false}, {1e-150, 1e-143, false}};
    mt_context *context = test_context();
    mt_mesh *teapot = generate(context, "teapot");
    mt_preview_options options = {.width = 48, .height = 48, .samples = 4, .shadows = true, .ground = true};
    uint64_t plain = draw(context, teapot, &options);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_mesh *moved = NULL;
        assert_int_equal(mt_mesh_copy(context, teapot, &moved), MT_OK);
        scale_and_move(moved, rows[i].scale, rows[i].offset);
        options.method = MT_METHOD_RASTER;
        uint64_t raster = draw(context, moved, &options);
        options.method = MT_METHOD_RAY;
        uint64_t ray = draw(context, moved, &options);
        assert_true(raster == ray);
        assert_true(!rows[i].same || raster == plain);
        mt_mesh_destroy(context, moved);
    }
    mt_mesh_destroy(context, teapot);
    test_context_end(context);
}

/* Angles near 0 and 180, an eye that is the target, up along the view, an eye far away: a picture, without a NaN. */
static void odd_cameras_draw(void **state)
{
    (void)state;
    static const mt_preview_options rows[] = {
        {.fov_degrees = 1e-3},
        {.fov_degrees = 179},
        {.has_eye = true, .has_target = true},
        {.has_eye = true, .eye = {0, 9, 0}},
        {.has_eye = true, .eye = {1e12, 0, 0}},
        {.has_eye = true, .eye = {1e-9, 0, 0}, .fov_degrees = 120},
        {.has_up = true, .up = {0.3, 0.4, 0.8}},
        {.has_up = true, .up = {0, -1e-300, 0}, .view = MT_VIEW_TOP},
        {.view = MT_VIEW_FRONT, .projection = MT_PROJECTION_ORTHOGRAPHIC, .has_up = true, .up = {0, 0, 1}},
    };
    mt_context *context = test_context();
    mt_mesh *teapot = generate(context, "teapot");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        uint64_t hashes[2];
        for (int k = 0; k < 2; k++) {
            mt_preview_options options = rows[i];
            options.width = options.height = 32;
            options.samples = 4;
            options.method = k ? MT_METHOD_RAY : MT_METHOD_RASTER;
            mt_image *image = NULL;
            assert_int_equal(mt_preview(context, teapot, &options, &image), MT_OK);
            for (size_t v = 0; v < (size_t)32 * 32 * 3; v++) {
                assert_true(image->pixels[v] >= 0 && image->pixels[v] < 2);
            }
            hashes[k] = hash_of(image);
            mt_image_destroy(context, image);
        }
        assert_true(hashes[0] == hashes[1]);
    }
    mt_mesh_destroy(context, teapot);
    test_context_end(context);
}

static void wrong_options_are_refused(void **state)
{
    (void)state;
    const mt_preview_options rows[] = {{.fov_degrees = 180},
                                       {.fov_degrees = -1},
                                       {.fov_degrees = (double)NAN},
                                       {.has_up = true},
                                       {.has_up = true, .up = {(double)NAN, 0, 1}},
                                       {.has_eye = true, .eye = {0, (double)INFINITY, 0}},
                                       {.has_target = true, .target = {(double)NAN, 0, 0}}};
    mt_context *context = test_context();
    mt_mesh *cube = generate(context, "cube");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, cube, &rows[i], &image), MT_ERROR_ARGUMENT);
        assert_null(image);
        mt_context_clear_error(context);
    }
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* A shadow on the ground darkens it, and only with shadows. */
static void shadows_fall_on_the_ground(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = generate(context, "cube");
    double sums[3];
    for (int i = 0; i < 3; i++) {
        mt_preview_options options = {.width = 80, .height = 80, .ground = i > 0, .shadows = i > 1};
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, cube, &options, &image), MT_OK);
        sums[i] = 0;
        for (size_t k = 0; k < (size_t)80 * 80; k++) {
            sums[i] += (double)image->pixels[3 * k + 1];
        }
        mt_image_destroy(context, image);
    }
    assert_true(sums[0] != sums[1]);
    assert_true(sums[2] < 0.99 * sums[1]);
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* A turntable keeps the mesh inside, at one scale; a series gives what single pictures give. */
static void a_series_keeps_its_size(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *teapot = generate(context, "teapot");
    mt_preview_options options = {
        .width = 64, .height = 64, .background = MT_BACKGROUND_TRANSPARENT, .turntable = true};
    mt_preview_series *series = NULL;
    assert_int_equal(mt_preview_series_create(context, teapot, &options, &series), MT_OK);
    double first = 0;
    for (int i = 0; i < 8; i++) {
        mt_image *image = NULL;
        mt_preview_report report;
        assert_int_equal(mt_preview_series_draw(context, series, MT_VIEW_DEFAULT, 45.0 * i, &image, &report), MT_OK);
        first = i == 0 ? report.units_per_pixel : first;
        assert_true(fabs(report.units_per_pixel - first) < 1e-12 * first);
        for (uint32_t k = 0; k < 64; k++) {
            assert_true(mt_image_pixel(image, k, 0)[3] == 0.0F && mt_image_pixel(image, k, 63)[3] == 0.0F);
            assert_true(mt_image_pixel(image, 0, k)[3] == 0.0F && mt_image_pixel(image, 63, k)[3] == 0.0F);
        }
        assert_true(test_picture_coverage(image) > 0.1);
        mt_image_destroy(context, image);
    }
    mt_preview_series_destroy(context, series);
    options.turntable = false;
    assert_int_equal(mt_preview_series_create(context, teapot, &options, &series), MT_OK);
    mt_image *image = NULL;
    assert_int_equal(mt_preview_series_draw(context, series, MT_VIEW_LEFT, 0, &image, NULL), MT_OK);
    options.view = MT_VIEW_LEFT;
    assert_true(hash_of(image) == draw(context, teapot, &options));
    mt_image_destroy(context, image);
    mt_preview_series_destroy(context, series);
    mt_mesh_destroy(context, teapot);
    test_context_end(context);
}

/* What faces no sample shows: half of a closed ball; all but one of very many in one pixel. */
static void unseen_faces_are_counted(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = generate(context, "cube"), *ball = test_ball(context, 200, 100, 1.0);
    const struct {
        const mt_mesh *mesh;
        uint32_t size;
        mt_index low, high;
    } rows[] = {{cube, 100, 3, 3}, {ball, 800, 18000, 26000}, {ball, 1, 39584, 39599}};
    for (int i = 0; i < 3; i++) {
        mt_preview_options options = {.width = rows[i].size, .height = rows[i].size, .count_unseen = true};
        mt_image *image = NULL;
        mt_preview_report report;
        assert_int_equal(mt_preview_reported(context, rows[i].mesh, &options, &image, &report), MT_OK);
        if (report.unseen_faces < rows[i].low || report.unseen_faces > rows[i].high) {
            fail_msg("row %d: %u of %u faces unseen", i, report.unseen_faces, rows[i].mesh->face_count);
        }
        mt_image_destroy(context, image);
    }
    mt_mesh_destroy(context, cube);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static mt_status draw_everything(mt_context *context)
{
    mt_mesh *mesh = NULL;
    mt_status status = mt_generate(context, "icosphere", NULL, &mesh);
    if (status != MT_OK) {
        return status;
    }
    mt_preview_options options = {.width = 60,
                                  .height = 40,
                                  .samples = MT_SAMPLES_ADAPTIVE,
                                  .shadows = true,
                                  .ground = true,
                                  .wireframe = true,
                                  .axes = true,
                                  .scale_bar = true,
                                  .coloring = MT_COLORING_COMPONENT,
                                  .count_unseen = true,
                                  .measure_skipped = true};
    mt_image *image = NULL;
    status = mt_preview_sheet(context, mesh, &options, 0, &image);
    assert_int_equal(image == NULL, status != MT_OK);
    mt_image_destroy(context, image);
    mt_mesh_destroy(context, mesh);
    return status;
}

static void missing_memory_is_an_error(void **state)
{
    (void)state;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t n = 1; status != MT_OK; n += 1 + n / 24) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1 + (unsigned)(n % 2)};
        mt_context *context = mt_context_create(&options);
        status = draw_everything(context);
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        test_context_end(context);
        assert_true(n < 100000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bytes_are_known),        cmocka_unit_test(extremes_draw_like_the_teapot),
        cmocka_unit_test(odd_cameras_draw),           cmocka_unit_test(wrong_options_are_refused),
        cmocka_unit_test(shadows_fall_on_the_ground), cmocka_unit_test(a_series_keeps_its_size),
        cmocka_unit_test(unseen_faces_are_counted),   cmocka_unit_test(missing_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
