/* Wires, points, marks and colours in previews. */
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include <meshtool/preview.h>

#include <math.h>
#include <string.h>

static mt_image *draw(mt_context *context, const mt_mesh *mesh, const mt_preview_options *given)
{
    mt_preview_options options = *given;
    options.width = options.height = 120;
    mt_image *image = NULL;
    mt_status status = mt_preview(context, mesh, &options, &image);
    if (status != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    return image;
}

/* Pixels that are mostly of one of the three colours. */
static size_t count_colored(const mt_image *image, int channel)
{
    size_t count = 0;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        const float *p = image->pixels + i * image->channel_count;
        count += p[channel] > 3 * p[(channel + 1) % 3] && p[channel] > 3 * p[(channel + 2) % 3];
    }
    return count;
}

static void face_colors_are_used(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 20, 10, 1.0);
    unsigned char colors[3 * 2 * 20 * 9];
    for (size_t face = 0; face < ball->face_count; face++) {
        colors[3 * face] = 0, colors[3 * face + 1] = 255, colors[3 * face + 2] = 0;
    }
    mt_preview_options options = {.face_colors = colors};
    mt_image *plain = draw(context, ball, &(mt_preview_options){0}), *green = draw(context, ball, &options);
    assert_int_equal(count_colored(plain, 1), 0);
    assert_true(count_colored(green, 1) > 120 * 120 / 2);
    mt_image_destroy(context, plain);
    mt_image_destroy(context, green);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static void add_colors(mt_context *context, mt_mesh *mesh, mt_domain domain, mt_type type, bool blue)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_COLOR,
                                  .domain = domain,
                                  .type = type,
                                  .component_count = 4,
                                  .value_count = mt_mesh_domain_count(mesh, domain)};
    mt_attribute *colors = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &colors), MT_OK);
    for (mt_index i = 0; i < colors->value_count; i++) {
        for (uint32_t k = 0; k < 4; k++) {
            mt_attribute_set(colors, i, k, k == (blue ? 2u : 0u) ? mt_color_maximum(type) : 0);
        }
    }
}

/* Corners before vertices before faces, any type of number; NaN is no colour. */
static void colors_of_the_mesh_are_used(void **state)
{
    (void)state;
    static const mt_domain domains[] = {MT_DOMAIN_FACE, MT_DOMAIN_VERTEX, MT_DOMAIN_CORNER};
    static const mt_type types[] = {MT_U8, MT_F32, MT_U16};
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 20, 10, 1.0);
    for (int i = 0; i < 3; i++) {
        add_colors(context, ball, domains[i], types[i], i == 1);
        mt_image *image = draw(context, ball, &(mt_preview_options){0});
        assert_true(count_colored(image, i == 1 ? 2 : 0) > 120 * 120 / 2);
        assert_int_equal(count_colored(image, i == 1 ? 0 : 2), 0);
        mt_image_destroy(context, image);
    }
    mt_mesh_destroy(context, ball);
    ball = test_ball(context, 20, 10, 1.0);
    add_colors(context, ball, MT_DOMAIN_VERTEX, MT_F64, false);
    for (mt_index v = 0; v < ball->vertex_count; v++) {
        mt_attribute_set(ball->attributes, v, 1, (double)NAN);
    }
    mt_image *spoiled = draw(context, ball, &(mt_preview_options){0});
    assert_int_equal(count_colored(spoiled, 0), 0);
    mt_image_destroy(context, spoiled);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

static const double square_positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, 0, 0, 0.5, 0, 0, -0.5, 2, 0, NAN};
static const mt_index square[] = {4, 0, 1, 2, 3};

static void marks_show_in_front_and_faintly_behind(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, square_positions, 1, square);
    const mt_index sides[] = {0, 1, 1, 2, 2, 3, 3, 0}, behind[] = {5, 5};
    unsigned char none[7] = {0}, front_dot[7] = {0, 0, 0, 0, 1, 0, 0}, back_dot[7] = {0, 0, 0, 0, 0, 1, 1};
    const mt_preview_options rows[] = {{.vertex_marks = none},
                                       {.edge_marks = sides, .edge_mark_count = 4},
                                       {.vertex_marks = front_dot},
                                       {.vertex_marks = back_dot},
                                       {.edge_marks = behind, .edge_mark_count = 1}};
    mt_image *plain = draw(context, mesh, &rows[0]);
    double changes[5] = {0}, largest[5] = {0};
    for (int i = 0; i < 5; i++) {
        mt_image *image = draw(context, mesh, &rows[i]);
        largest[i] = test_picture_difference(plain, image, &changes[i]);
        mt_image_destroy(context, image);
    }
    assert_true(changes[0] == 0);
    assert_true(changes[1] > changes[2]);
    assert_true(changes[2] > changes[3] && changes[3] > 0);
    assert_true(largest[2] > 2 * largest[3]);
    assert_true(changes[4] > 0);
    mt_image_destroy(context, plain);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Wires and points of the mesh are hidden by faces and drawn with them. */
static void wires_and_points_are_drawn(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, 7, square_positions, 1, square);
    mt_image *plain = draw(context, mesh, &(mt_preview_options){0});
    mesh->wire_count = 1;
    mesh->wire_offsets = mt_allocate_array(context, 2, sizeof(mt_index));
    mesh->wire_vertices = mt_allocate_array(context, 3, sizeof(mt_index));
    mesh->wire_offsets[0] = 0, mesh->wire_offsets[1] = 3;
    mesh->wire_vertices[0] = 0, mesh->wire_vertices[1] = 2, mesh->wire_vertices[2] = 6; /* the last is not finite */
    mesh->point_count = 1;
    mesh->point_vertices = mt_allocate_array(context, 1, sizeof(mt_index));
    mesh->point_vertices[0] = 3;
    mt_image *image = draw(context, mesh, &(mt_preview_options){0});
    double mean = 0;
    assert_true(test_picture_difference(plain, image, &mean) > 0.3);
    assert_true(mean > 0.001 && mean < 0.05);
    mt_image_destroy(context, plain);
    mt_image_destroy(context, image);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(face_colors_are_used),
        cmocka_unit_test(colors_of_the_mesh_are_used),
        cmocka_unit_test(marks_show_in_front_and_faintly_behind),
        cmocka_unit_test(wires_and_points_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
