/* Previews: what they show, on which background, at which magnitudes, and what they refuse. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/preview.h>

#include <math.h>
#include <string.h>

static const double triangle_positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
static const mt_index triangle[] = {3, 0, 1, 2};

static mt_image *draw(mt_context *context, const mt_mesh *mesh, uint32_t size, mt_background background)
{
    mt_preview_options options = {.width = size, .height = size, .background = background};
    mt_image *image = NULL;
    mt_status status = mt_preview(context, mesh, &options, &image);
    if (status != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_int_equal(image->space, MT_COLOR_LINEAR);
    assert_int_equal(image->channel_count, background == MT_BACKGROUND_TRANSPARENT ? 4 : 3);
    for (size_t i = 0; i < (size_t)size * size * image->channel_count; i++) {
        assert_true(image->pixels[i] >= 0 && image->pixels[i] < 2);
    }
    return image;
}

static double coverage_of(mt_context *context, const mt_mesh *mesh, uint32_t size)
{
    mt_image *image = draw(context, mesh, size, MT_BACKGROUND_TRANSPARENT);
    double coverage = test_picture_coverage(image);
    mt_image_destroy(context, image);
    return coverage;
}

/* A ball fills the frame up to the margin of 5 %, and is seen as a disc. */
static void a_ball_covers_a_disc(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 400, 200, 7.0);
    double exact = acos(-1.0) * 0.45 * 0.45;
    assert_true(fabs(coverage_of(context, ball, 400) - exact) < 0.001 * exact);
    assert_true(fabs(coverage_of(context, ball, 37) - exact) < 0.004 * exact);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static void the_background_is_what_was_asked_for(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 30, 15, 1.0);
    mt_image *clear = draw(context, ball, 64, MT_BACKGROUND_TRANSPARENT);
    assert_true(mt_image_pixel(clear, 0, 0)[3] == 0.0F && mt_image_pixel(clear, 63, 63)[3] == 0.0F);
    assert_true(mt_image_pixel(clear, 32, 32)[3] == 1.0F);
    mt_preview_options options = {
        .width = 64, .height = 64, .background = MT_BACKGROUND_COLOR, .background_color = {1.0, 0.0, 0.5}};
    mt_image *plain = NULL;
    assert_int_equal(mt_preview(context, ball, &options, &plain), MT_OK);
    const float *corner = mt_image_pixel(plain, 63, 0);
    assert_true(corner[0] == 1.0F && corner[1] == 0.0F);
    assert_true(fabs((double)corner[2] - mt_srgb_decode(0.5)) < 1e-6);
    mt_image *usual = draw(context, ball, 64, MT_BACKGROUND_DEFAULT);
    assert_true(mt_image_pixel(usual, 0, 0)[0] > mt_image_pixel(usual, 0, 63)[0]);
    for (uint32_t y = 0; y < 64; y++) {
        for (uint32_t x = 0; x < 64; x++) {
            /* Over its own background the transparent picture is the plain one. */
            const float *c = mt_image_pixel(clear, x, y), *p = mt_image_pixel(plain, x, y);
            for (int i = 0; i < 3; i++) {
                double over = (double)c[3] * (double)c[i] + (1 - (double)c[3]) * (double)corner[i];
                assert_true(fabs(over - (double)p[i]) < 1e-5);
            }
        }
    }
    mt_image_destroy(context, clear);
    mt_image_destroy(context, plain);
    mt_image_destroy(context, usual);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static void scale_and_move(mt_mesh *mesh, double scale, double offset)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        mt_mesh_set_position(mesh, v,
                             mt_vec3_make(p.x * scale + offset, p.y * scale - 2 * offset, p.z * scale + offset));
    }
}

/* The teapot scaled and moved, against the teapot. */
static double worst_at(mt_context *context, double scale, double offset, mt_type type, double *mean)
{
    mt_mesh *mesh = NULL, *moved = NULL;
    assert_int_equal(mt_generate(context, "teapot", NULL, &mesh), MT_OK);
    assert_int_equal(mt_mesh_copy(context, mesh, &moved), MT_OK);
    scale_and_move(moved, scale, offset);
    assert_int_equal(mt_mesh_set_position_type(context, moved, type, NULL), MT_OK);
    mt_image *a = draw(context, mesh, 96, MT_BACKGROUND_DEFAULT), *b = draw(context, moved, 96, MT_BACKGROUND_DEFAULT);
    double worst = test_picture_difference(a, b, mean);
    mt_image_destroy(context, a);
    mt_image_destroy(context, b);
    mt_mesh_destroy(context, mesh);
    mt_mesh_destroy(context, moved);
    return worst;
}

static void powers_of_two_change_nothing(void **state)
{
    (void)state;
    static const int exponents[] = {-900, -400, -40, -1, 1, 40, 400, 1000};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        double mean = 0;
        assert_true(worst_at(context, ldexp(1.0, exponents[i]), 0, MT_F64, &mean) == 0);
    }
    test_context_end(context);
}

static void no_magnitude_upsets_a_picture(void **state)
{
    (void)state;
    static const struct {
        double scale, offset;
        mt_type type;
    } rows[] = {{1e-150, 0, MT_F64}, {1e150, 0, MT_F64},      {1e307, 0, MT_F64}, {1e-300, 0, MT_F64},
                {3e-312, 0, MT_F64}, {1e-3, 1e7, MT_F64},     {1, 1e7, MT_F64},   {1e30, 0, MT_F32},
                {1e-30, 0, MT_F32},  {1e-150, 1e-143, MT_F64}};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        double mean = 0;
        worst_at(context, rows[i].scale, rows[i].offset, rows[i].type, &mean);
        assert_true(mean < 1e-4);
    }
    test_context_end(context);
}

static void nothing_to_see_says_why(void **state)
{
    (void)state;
    mt_context *context = test_context();
    double positions[] = {NAN, 0, 0, 1, INFINITY, 0, 0, 1, -INFINITY};
    const struct {
        mt_index vertex_count, face_count;
        const char *says;
    } rows[] = {{0, 0, "no vertices"}, {3, 1, "finite"}, {3, 0, "finite"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_mesh *mesh = test_mesh(context, rows[i].vertex_count, positions, rows[i].face_count, triangle);
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, mesh, NULL, &image), MT_ERROR_INVALID_MESH);
        assert_null(image);
        assert_non_null(strstr(mt_context_error(context)->message, rows[i].says));
        mt_context_clear_error(context);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void wrong_options_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 3, triangle_positions, 1, triangle);
    const mt_index beyond[] = {0, 3};
    const mt_preview_options rows[] = {{.width = 65536},
                                       {.height = UINT32_MAX},
                                       {.samples = 5},
                                       {.samples = 81},
                                       {.crease_degrees = -1},
                                       {.crease_degrees = 181.0},
                                       {.crease_degrees = (double)NAN},
                                       {.edge_marks = beyond, .edge_mark_count = 1}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, mesh, &rows[i], &image), MT_ERROR_ARGUMENT);
        assert_null(image);
        mt_context_clear_error(context);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

typedef struct heard {
    int count;
    char last[256];
} heard;

static void hear(void *user, const char *sentence)
{
    heard *ears = user;
    ears->count++;
    strncpy(ears->last, sentence, sizeof ears->last - 1);
}

/* The ball with one vertex spoiled is the ball with that vertex's faces left out. */
static void faces_with_a_nan_are_left_out(void **state)
{
    (void)state;
    heard ears = {0};
    mt_context_options options = {.warning = hear, .warning_user = &ears};
    mt_context *context = mt_context_create(&options);
    mt_mesh *ball = test_ball(context, 12, 6, 1.0);
    double whole = coverage_of(context, ball, 100);
    assert_int_equal(ears.count, 0);
    mt_mesh_set_position(ball, 0, mt_vec3_make(0, (double)NAN, 0));
    double open = coverage_of(context, ball, 100);
    assert_true(open > 0.5 * whole && open < 1.2 * whole);
    assert_int_equal(ears.count, 1);
    assert_non_null(strstr(ears.last, "12 of 120 faces"));
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

/* A stray vertex in no face does not shrink the picture. */
static void only_what_is_drawn_is_framed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1e300, 0, 5};
    mt_mesh *alone = test_mesh(context, 3, positions, 1, triangle),
            *stray = test_mesh(context, 4, positions, 1, triangle);
    assert_true(coverage_of(context, alone, 80) == coverage_of(context, stray, 80));
    mt_mesh_destroy(context, alone);
    mt_mesh_destroy(context, stray);
    test_context_end(context);
}

static void every_primitive_is_seen(void **state)
{
    (void)state;
    mt_context *context = test_context();
    size_t count = 0;
    const mt_primitive *primitives = mt_primitives(&count);
    assert_true(count > 10);
    for (size_t i = 0; i < count; i++) {
        mt_mesh *mesh = NULL;
        if (mt_generate(context, primitives[i].name, NULL, &mesh) != MT_OK) {
            fail_msg("%s: %s", primitives[i].name, mt_context_error(context)->message);
        }
        for (int up = 0; up < 2; up++) {
            mesh->up = up ? MT_UP_Z : MT_UP_Y;
            if (coverage_of(context, mesh, 64) < 0.03) {
                fail_msg("%s covers less than 3 %% of its picture", primitives[i].name);
            }
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Meshes that a careless renderer shows as nothing at all. */
static void thin_and_odd_meshes_are_seen(void **state)
{
    (void)state;
    static const double edge_on[] = {0, 0, 0, 0.5, 0.38, 0.78, 1, 0.76, 1.56}; /* a line along the usual view */
    static const double needle[] = {0, 0, 0, 1, 0, 0, 0.5, 1e-12, 0};
    static const double in_view[] = {0, 0, 0, 0.5, 0.38, 0.78, 0.5, 1.38, 0.78}; /* a triangle that contains it */
    static const double point[] = {4, 5, 6, 4, 5, 6, 4, 5, 6};
    static const double line[] = {0, 0, 0, 5e-324, 0, 0, 0, 5e-324, 0};
    static const double *const rows[] = {edge_on, needle, in_view, point, line};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (mt_index faces = 0; faces < 2; faces++) {
            mt_mesh *mesh = test_mesh(context, 3, rows[i], faces, triangle);
            double coverage = coverage_of(context, mesh, 128);
            if (coverage < 0.00025) {
                fail_msg("mesh %zu with %u faces covers %g of its picture", i, faces, coverage);
            }
            mt_mesh_destroy(context, mesh);
        }
    }
    test_context_end(context);
}

static void all_sizes_and_samples_work(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {{1, 1}, {1, 64}, {64, 1}, {31, 33}, {65535, 1}, {1, 65535}, {200, 20}};
    static const unsigned samples[] = {1, 4, 9, 16, 25, 36, 49, 64};
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 20, 10, 1.0);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        mt_preview_options options = {.width = sizes[i][0], .height = sizes[i][1]};
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, ball, &options, &image), MT_OK);
        mt_image_destroy(context, image);
    }
    double first = 0;
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        mt_preview_options options = {
            .width = 100, .height = 100, .samples = samples[i], .background = MT_BACKGROUND_TRANSPARENT};
        mt_image *image = NULL;
        assert_int_equal(mt_preview(context, ball, &options, &image), MT_OK);
        double coverage = test_picture_coverage(image);
        first = i == 0 ? coverage : first;
        assert_true(fabs(coverage - first) < 0.003);
        mt_image_destroy(context, image);
    }
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_covers_a_disc),          cmocka_unit_test(the_background_is_what_was_asked_for),
        cmocka_unit_test(powers_of_two_change_nothing),  cmocka_unit_test(no_magnitude_upsets_a_picture),
        cmocka_unit_test(nothing_to_see_says_why),       cmocka_unit_test(wrong_options_are_refused),
        cmocka_unit_test(faces_with_a_nan_are_left_out), cmocka_unit_test(only_what_is_drawn_is_framed),
        cmocka_unit_test(every_primitive_is_seen),       cmocka_unit_test(thin_and_odd_meshes_are_seen),
        cmocka_unit_test(all_sizes_and_samples_work),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
