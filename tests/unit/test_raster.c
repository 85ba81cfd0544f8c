/* Both orders of drawing show the same triangle in every sample, whatever the triangles, the camera and the hit test.
 */
#include "tests/support/fixture.h"
#include "tests/support/picture.h"
#include "tests/support/unit.h"

#include "lib/render/framing.h"
#include "lib/render/raster.h"
#include "lib/render/trace.h"

#include <meshtool/generate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64, TILES = SIZE / MT_TILE_SIZE };

typedef struct scene {
    mt_context *context;
    mt_mesh *mesh;
    mt_model model;
    mt_frame frame;
} scene;

static const struct {
    mt_projection projection;
    double shear;
} projections[] = {{MT_PROJECTION_PERSPECTIVE, 0}, {MT_PROJECTION_ORTHOGRAPHIC, 0}, {MT_PROJECTION_CAVALIER, 0.7}};

static const mt_ray_profile profiles[] = {MT_RAY_WATERTIGHT, MT_RAY_EXACT, MT_RAY_FAST};

/* eye: from where a perspective camera looks to the middle; NULL: all is framed. */
static void scene_begin(scene *s, mt_context *context, mt_mesh *mesh, int projection, mt_ray_profile profile,
                        unsigned samples, const mt_vec3 *eye)
{
    memset(s, 0, sizeof *s);
    s->context = context;
    s->mesh = mesh;
    assert_int_equal(mt_model_init(context, mesh, &s->model), MT_OK);
    mt_camera camera = {.width = SIZE, .height = SIZE, .projection = projections[projection].projection};
    camera.shear_x = camera.shear_y = projections[projection].shear;
    mt_framing framing = {.has_eye = eye != NULL, .fov_degrees = eye ? 70 : 0};
    mt_vec3 toward_eye = mt_vec3_make(0.3, 0.5, 0.8);
    if (eye) {
        framing.eye = *eye;
        toward_eye = mt_vec3_length(*eye) > 0 ? *eye : toward_eye;
    }
    mt_camera_frame(&camera, toward_eye, mt_vec3_make(0, 1, 0));
    assert_int_equal(mt_camera_fit(context, &camera, &s->model, &framing), MT_OK);
    assert_int_equal(mt_frame_init(context, &s->model, &camera, samples, profile, &s->frame), MT_OK);
}

static void scene_end(scene *s)
{
    mt_frame_release(s->context, &s->frame);
    mt_model_release(s->context, &s->model);
    mt_mesh_destroy(s->context, s->mesh);
}

/* The triangles that the raster draws in a tile. */
static mt_index list_triangles(const scene *s, uint32_t x, uint32_t y, mt_index *listed)
{
    mt_index count = 0;
    for (mt_index i = 0; i < s->model.triangulation.triangle_count; i++) {
        mt_tile_range range = mt_triangle_range(&s->frame, i);
        bool here = range.first_x <= x && x <= range.last_x && range.first_y <= y && y <= range.last_y;
        if (here) {
            mt_triangle_narrow(&s->frame, i, y, &range);
            here = range.first_x <= x && x <= range.last_x;
        }
        if (here) {
            listed[count++] = i;
        }
    }
    return count;
}

/* Front first in some tiles, or as they come, or backwards: no order shows anything else. */
static void draw_in_some_order(const scene *s, mt_tile *tile, mt_index *listed, mt_index count, uint32_t turn)
{
    if (turn % 3 == 0) {
        mt_draw_front_first(&s->frame, tile, listed, count);
        return;
    }
    for (mt_index i = 0; turn % 3 == 1 && i < count / 2; i++) {
        mt_index first = listed[i];
        listed[i] = listed[count - 1 - i];
        listed[count - 1 - i] = first;
    }
    mt_draw_triangles(&s->frame, tile, listed, count);
}

/* Compares the two orders in every sample; returns how many samples show something. */
static size_t compare_orders(const scene *s, mt_ray_structure_kind kind)
{
    mt_tile raster, rays;
    mt_occluder all;
    mt_index *listed = malloc(s->model.triangulation.triangle_count * sizeof *listed);
    assert_true(mt_tile_init(s->context, &s->frame, false, &raster) &&
                mt_tile_init(s->context, &s->frame, false, &rays));
    assert_int_equal(mt_occluder_init(s->context, &s->model, s->frame.profile, kind, &all), MT_OK);
    size_t seen = 0, different = 0;
    for (uint32_t t = 0; t < TILES * TILES; t++) {
        mt_tile_place(&raster, &s->frame.camera, t);
        mt_tile_place(&rays, &s->frame.camera, t);
        mt_tile_clear(&raster);
        mt_tile_clear(&rays);
        mt_index count = list_triangles(s, t % TILES, t / TILES, listed);
        draw_in_some_order(s, &raster, listed, count, t);
        mt_trace_triangles(&s->frame, &all, &rays);
        size_t lanes = (size_t)MT_TILE_SIZE * MT_TILE_SIZE * raster.lane_count;
        for (size_t lane = 0; lane < lanes; lane++) {
            seen += rays.numbers[lane] != MT_NONE;
            different += rays.numbers[lane] != raster.numbers[lane];
        }
    }
    mt_occluder_release(s->context, &all);
    mt_tile_release(s->context, &raster);
    mt_tile_release(s->context, &rays);
    free(listed);
    assert_int_equal(different, 0);
    return seen;
}

static double random_in(test_random *random, double low, double high)
{
    return low + (high - low) * test_random_unit(random);
}

/* Fat, thin, tiny and huge triangles, some through each other, some in one plane, some twice. */
static mt_mesh *random_triangles(mt_context *context, mt_index count, uint64_t seed)
{
    test_random random = {seed};
    mt_mesh_layout layout = {
        .vertex_count = 3 * (uint64_t)count, .face_count = count, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index i = 0; i < count; i++) {
        double reach = pow(2.0, random_in(&random, -8, 1)), center[3], stretch = i % 5 == 0 ? 1e-3 : 1.0;
        for (int axis = 0; axis < 3; axis++) {
            center[axis] = random_in(&random, -1, 1);
        }
        for (mt_index k = 0; k < 3; k++) {
            mt_vec3 p = {center[0] + reach * random_in(&random, -1, 1),
                         center[1] + stretch * reach * random_in(&random, -1, 1),
                         i % 7 == 0 ? 0.25 : center[2] + reach * random_in(&random, -1, 1)};
            if (i % 11 == 10) {
                p = mt_mesh_position(mesh, 3 * (i - 3) + k);
            }
            mesh->corner_vertices[3 * i + k] = 3 * i + k;
            mt_mesh_set_position(mesh, 3 * i + k, p);
        }
    }
    return mesh;
}

static void both_orders_agree(void **state)
{
    (void)state;
    static const unsigned samples[] = {1, 4, 9, 16};
    mt_context *context = test_context();
    for (uint64_t seed = 1; seed <= 6; seed++) {
        for (int projection = 0; projection < 3; projection++) {
            scene s;
            scene_begin(&s, context, random_triangles(context, 60, seed), projection, profiles[seed % 3],
                        samples[seed % 4], NULL);
            assert_true(compare_orders(&s, (mt_ray_structure_kind)(seed % MT_RAY_STRUCTURE_COUNT)) > SIZE * SIZE / 20);
            scene_end(&s);
        }
    }
    test_context_end(context);
}

/* From within, next to and on the triangles: many of them cross the plane of the eye. */
static void an_eye_inside_sees_the_same(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {77};
    for (uint64_t seed = 1; seed <= 12; seed++) {
        mt_vec3 eye = {random_in(&random, -0.3, 0.3), random_in(&random, -0.3, 0.3), random_in(&random, -0.3, 0.3)};
        mt_mesh *mesh = random_triangles(context, 60, 100 + seed);
        if (seed % 4 == 0) { /* in the plane of the first, whose middle becomes the middle of all by symmetry */
            for (mt_index k = 0; k < 3; k++) {
                mt_vec3 p = mt_mesh_position(mesh, k);
                mt_mesh_set_position(mesh, k, mt_vec3_make(4 * p.x, 4 * p.y, 0));
            }
        }
        scene s;
        scene_begin(&s, context, mesh, 0, profiles[seed % 3], 4, &eye);
        assert_true(compare_orders(&s, (mt_ray_structure_kind)(seed % MT_RAY_STRUCTURE_COUNT)) > 0);
        scene_end(&s);
    }
    test_context_end(context);
}

static mt_mesh *generate(mt_context *context, const char *name)
{
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, NULL, &mesh), MT_OK);
    return mesh;
}

/* From inside a closed mesh, and at an angle of view near zero, nothing shows through. */
static void closed_meshes_have_no_holes(void **state)
{
    (void)state;
    static const char *const names[] = {"icosphere", "cube", "dodecahedron"};
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        for (int profile = 0; profile < 2; profile++) {
            const mt_vec3 eyes[] = {{0, 0, 0}, {0.1, -0.02, 0.07}, {0, 0, 0.3}};
            for (size_t k = 0; k < sizeof eyes / sizeof *eyes; k++) {
                scene s;
                scene_begin(&s, context, generate(context, names[i]), 0, profiles[profile], 16, &eyes[k]);
                assert_int_equal(compare_orders(&s, MT_RAY_STRUCTURE_AABB), SIZE * SIZE * 16);
                scene_end(&s);
            }
        }
    }
    test_context_end(context);
}

/* Every triangle twice: the first of the two is seen. */
static void duplicates_go_to_the_lowest(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *ball = test_ball(context, 16, 8, 1.0);
    mt_index count = ball->face_count;
    mt_mesh_layout layout = {
        .vertex_count = ball->vertex_count, .face_count = 2 * (uint64_t)count, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index vertex = 0; vertex < ball->vertex_count; vertex++) {
        mt_mesh_set_position(mesh, vertex, mt_mesh_position(ball, vertex));
    }
    memcpy(mesh->corner_vertices, ball->corner_vertices, 3 * (size_t)count * sizeof(mt_index));
    memcpy(mesh->corner_vertices + 3 * (size_t)count, ball->corner_vertices, 3 * (size_t)count * sizeof(mt_index));
    scene s;
    scene_begin(&s, context, mesh, 0, MT_RAY_WATERTIGHT, 4, NULL);
    assert_true(compare_orders(&s, MT_RAY_STRUCTURE_AABB) > 0);
    mt_tile tile;
    assert_true(mt_tile_init(context, &s.frame, false, &tile));
    mt_tile_place(&tile, &s.frame.camera, 0);
    mt_tile_clear(&tile);
    mt_index *listed = malloc(2 * (size_t)count * sizeof *listed);
    mt_index listed_count = list_triangles(&s, 0, 0, listed);
    mt_draw_triangles(&s.frame, &tile, listed, listed_count);
    for (size_t lane = 0; lane < (size_t)MT_TILE_SIZE * MT_TILE_SIZE * tile.lane_count; lane++) {
        assert_true(tile.numbers[lane] == MT_NONE || tile.numbers[lane] < count);
    }
    free(listed);
    mt_tile_release(context, &tile);
    scene_end(&s);
    mt_mesh_destroy(context, ball);
    test_context_end(context);
}

/* Behind the eye, beside the picture, or with a vertex that is not finite. */
static void what_cannot_be_seen_is_listed_nowhere(void **state)
{
    (void)state;
    static const double rows[][9] = {
        {-0.1, 0, 3, 0.1, 0, 3, 0, 0.1, 3}, {5, 0, 0, 6, 0, 0, 5, 1, 0}, {0, 0, 0, NAN, 0, 0, 0, 1, 0}};
    mt_context *context = test_context();
    mt_mesh_layout layout = {.vertex_count = 12, .face_count = 4, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index i = 0; i < 12; i++) {
        mesh->corner_vertices[i] = i;
        const double *row = i < 9 ? rows[i / 3] + 3 * (i % 3) : NULL;
        mt_mesh_set_position(mesh, i,
                             row ? mt_vec3_make(row[0], row[1], row[2]) : mt_vec3_make(-6, -1, (i - 10.0) * 3));
    }
    const mt_vec3 eye = {0, 0, 0.1};
    scene s;
    scene_begin(&s, context, mesh, 0, MT_RAY_WATERTIGHT, 16, &eye);
    for (mt_index i = 0; i < 3; i++) {
        mt_tile_range range = mt_triangle_range(&s.frame, i);
        assert_true(range.first_x > range.last_x);
    }
    scene_end(&s);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_orders_agree),
        cmocka_unit_test(an_eye_inside_sees_the_same),
        cmocka_unit_test(closed_meshes_have_no_holes),
        cmocka_unit_test(duplicates_go_to_the_lowest),
        cmocka_unit_test(what_cannot_be_seen_is_listed_nowhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
