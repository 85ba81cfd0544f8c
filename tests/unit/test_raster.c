/* Which samples triangles cover, and which triangle wins, against the definition in whole numbers. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include "lib/render/raster.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64, TILES = SIZE / MT_TILE_SIZE };

/* Triangles given by their corners in pixels and depth, without a camera. */
typedef struct scene {
    mt_context *context;
    mt_mesh *mesh;
    mt_model model;
    mt_frame frame;
} scene;

static void scene_begin(scene *s, mt_context *context, mt_index triangle_count, unsigned samples)
{
    memset(s, 0, sizeof *s);
    s->context = context;
    mt_mesh_layout layout = {.vertex_count = 3 * (uint64_t)triangle_count,
                             .face_count = triangle_count,
                             .face_size = 3,
                             .position_type = MT_F64};
    assert_int_equal(mt_mesh_create(context, &layout, &s->mesh), MT_OK);
    for (mt_index i = 0; i < 3 * triangle_count; i++) {
        s->mesh->corner_vertices[i] = i;
        mt_mesh_set_position(s->mesh, i, mt_vec3_make(i % 3 == 0, i % 3 == 1, 0));
    }
    assert_int_equal(mt_model_init(context, s->mesh, &s->model), MT_OK);
    mt_camera camera = {.width = SIZE, .height = SIZE, .half_width = 1, .half_height = 1};
    mt_camera_frame(&camera, mt_vec3_make(0, 0, 1), mt_vec3_make(0, 1, 0));
    camera.eye = mt_vec3_make(0, 0, 5);
    assert_int_equal(mt_frame_init(context, &s->model, &camera, samples, MT_RAY_EXACT, &s->frame), MT_OK);
}

static void scene_end(scene *s)
{
    mt_frame_release(s->context, &s->frame);
    mt_model_release(s->context, &s->model);
    mt_mesh_destroy(s->context, s->mesh);
}

static void set_corner(scene *s, mt_index corner, double x, double y, double depth)
{
    s->frame.vertices[corner] = (mt_screen_vertex){x * MT_STEPS, y * MT_STEPS, depth};
}

/* All tiles drawn with all triangles; numbers by [y][x][lane]. */
static mt_index *draw(const scene *s, float **depths)
{
    unsigned lanes = s->frame.sampling.lane_count;
    size_t tile_lanes = mt_tile_lane_count(lanes), count = (size_t)SIZE * SIZE * lanes;
    mt_index *numbers = malloc(count * sizeof *numbers), triangle_count = s->mesh->face_count;
    *depths = malloc(count * sizeof **depths);
    mt_tile tile = {.width = MT_TILE_SIZE, .height = MT_TILE_SIZE, .lane_count = lanes};
    tile.depths = mt_allocate_array(s->context, tile_lanes, sizeof(float));
    tile.numbers = mt_allocate_array(s->context, tile_lanes, sizeof(mt_index));
    tile.floors = mt_allocate_array(s->context, MT_TILE_SIZE * MT_TILE_SIZE, sizeof(float));
    mt_index *all = malloc(triangle_count * sizeof *all);
    for (uint32_t t = 0; t < TILES * TILES; t++) {
        tile.x = t % TILES * MT_TILE_SIZE;
        tile.y = t / TILES * MT_TILE_SIZE;
        memset(tile.depths, 0, tile_lanes * sizeof(float));
        memset(tile.numbers, 0xff, tile_lanes * sizeof(mt_index));
        memset(tile.floors, 0, MT_TILE_SIZE * MT_TILE_SIZE * sizeof(float));
        size_t listed = 0;
        for (mt_index i = 0; i < triangle_count; i++) {
            mt_tile_range range = mt_triangle_range(&s->frame, i);
            uint32_t x = t % TILES, y = t / TILES;
            bool listed_here = range.first_x <= x && x <= range.last_x && range.first_y <= y && y <= range.last_y;
            if (listed_here) {
                mt_triangle_narrow(&s->frame, i, y, &range);
                listed_here = range.first_x <= x && x <= range.last_x;
            }
            if (listed_here) {
                all[listed++] = i;
            }
        }
        mt_draw_triangles(&s->frame, &tile, all, listed);
        for (uint32_t y = tile.y; y < tile.y + MT_TILE_SIZE; y++) {
            for (uint32_t x = tile.x; x < tile.x + MT_TILE_SIZE; x++) {
                size_t from = mt_tile_lane(&tile, x, y), to = ((size_t)y * SIZE + x) * lanes;
                memcpy(numbers + to, tile.numbers + from, lanes * sizeof(mt_index));
                memcpy(*depths + to, tile.depths + from, lanes * sizeof(float));
            }
        }
    }
    free(all);
    mt_free(s->context, tile.depths);
    mt_free(s->context, tile.numbers);
    mt_free(s->context, tile.floors);
    return numbers;
}

static int64_t side(const int64_t a[2], const int64_t b[2], int64_t x, int64_t y)
{
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

/* Whether a triangle covers a sample, borders included, decided in whole numbers. */
static bool covers(const scene *s, mt_index triangle, uint32_t x, uint32_t y, unsigned lane)
{
    int64_t c[3][2];
    for (mt_index k = 0; k < 3; k++) {
        const mt_screen_vertex *v = &s->frame.vertices[3 * triangle + k];
        c[k][0] = (int64_t)floor(v->x + 0.5);
        c[k][1] = (int64_t)floor(v->y + 0.5);
    }
    int64_t px = (int64_t)x * MT_STEPS + (int64_t)s->frame.sampling.x[lane];
    int64_t py = (int64_t)y * MT_STEPS + (int64_t)s->frame.sampling.y[lane];
    int64_t e[3] = {side(c[0], c[1], px, py), side(c[1], c[2], px, py), side(c[2], c[0], px, py)};
    if (side(c[0], c[1], c[2][0], c[2][1]) == 0) {
        return false;
    }
    return (e[0] >= 0 && e[1] >= 0 && e[2] >= 0) || (e[0] <= 0 && e[1] <= 0 && e[2] <= 0);
}

static double depth_of(const scene *s, mt_index triangle, uint32_t x, uint32_t y, unsigned lane)
{
    const mt_screen_vertex *v = &s->frame.vertices[3 * triangle];
    double px = x * (double)MT_STEPS + (double)s->frame.sampling.x[lane];
    double py = y * (double)MT_STEPS + (double)s->frame.sampling.y[lane];
    double area = (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
    double b = ((px - v[0].x) * (v[2].y - v[0].y) - (py - v[0].y) * (v[2].x - v[0].x)) / area;
    double c = ((v[1].x - v[0].x) * (py - v[0].y) - (v[1].y - v[0].y) * (px - v[0].x)) / area;
    return v[0].depth + b * (v[1].depth - v[0].depth) + c * (v[2].depth - v[0].depth);
}

static double random_in(test_random *random, double low, double high)
{
    return low + (high - low) * test_random_unit(random);
}

/* Fat, thin, tiny and huge triangles, some through each other; every sample is checked. */
static void compare(unsigned samples, uint64_t seed)
{
    enum { COUNT = 60 };
    mt_context *context = test_context();
    scene s;
    scene_begin(&s, context, COUNT, samples);
    test_random random = {seed};
    for (mt_index i = 0; i < COUNT; i++) {
        double reach = pow(2.0, random_in(&random, -4, 6)), x = random_in(&random, 0, SIZE),
               y = random_in(&random, 0, SIZE);
        for (mt_index k = 0; k < 3; k++) {
            double stretch = i % 5 == 0 ? 0.02 : 1.0;
            set_corner(&s, 3 * i + k, x + reach * random_in(&random, -1, 1),
                       y + stretch * reach * random_in(&random, -1, 1), random_in(&random, 0.4, 0.5));
        }
    }
    float *depths = NULL;
    mt_index *numbers = draw(&s, &depths);
    for (size_t pixel = 0; pixel < (size_t)SIZE * SIZE; pixel++) {
        for (unsigned lane = 0; lane < s.frame.sampling.sample_count; lane++) {
            uint32_t x = (uint32_t)(pixel % SIZE), y = (uint32_t)(pixel / SIZE);
            mt_index got = numbers[pixel * s.frame.sampling.lane_count + lane];
            double nearest = 0;
            for (mt_index i = 0; i < COUNT; i++) {
                if (covers(&s, i, x, y, lane)) {
                    double depth = fmin(fmax(depth_of(&s, i, x, y, lane), 0.4), 0.5);
                    nearest = fmax(nearest, depth);
                }
            }
            assert_int_equal(got == MT_NONE, nearest == 0);
            if (got != MT_NONE) {
                assert_true(covers(&s, got, x, y, lane));
                /* Needles' planes are steep: rounding to the grid moves their depth. */
                assert_true(got % 5 == 0 || depth_of(&s, got, x, y, lane) > nearest - 0.02);
            }
        }
    }
    free(numbers);
    free(depths);
    scene_end(&s);
    test_context_end(context);
}

static void samples_are_covered_by_definition(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 12; seed++) {
        compare(16, seed);
    }
    compare(1, 100);
    compare(4, 101);
    compare(9, 102);
    compare(64, 103);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Turns around a circle: the 12 of a clock, and between them random ones, many of them almost the same. */
static mt_index random_turns(test_random *random, double turns[212])
{
    mt_index count = 12 + (mt_index)test_random_below(random, 200);
    for (mt_index i = 0; i < count; i++) {
        double near = pow(2.0, random_in(random, -40, 0));
        turns[i] = 2 * acos(-1.0) * (i < 12 ? i / 12.0 : (double)test_random_below(random, 4) / 4 + near / 4);
    }
    qsort(turns, count, sizeof *turns, ascending);
    return count;
}

/* A fan of thin and very thin sectors around a random point covers its disc without a hole. */
static void fans_have_no_holes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {77};
    for (int round = 0; round < 40; round++) {
        double turns[212], x = random_in(&random, 28, 36), y = random_in(&random, 28, 36);
        mt_index count = random_turns(&random, turns);
        scene s;
        scene_begin(&s, context, count, 16);
        for (mt_index i = 0; i < count; i++) {
            mt_index j = (i + 1) % count;
            set_corner(&s, 3 * i, x, y, 0.5);
            set_corner(&s, 3 * i + 1, 32 + 30 * cos(turns[i]), 32 + 30 * sin(turns[i]), 0.4);
            set_corner(&s, 3 * i + 2, 32 + 30 * cos(turns[j]), 32 + 30 * sin(turns[j]), 0.4);
        }
        float *depths = NULL;
        mt_index *numbers = draw(&s, &depths);
        size_t inside = 0, holes = 0;
        for (uint32_t pixel = 0; pixel < SIZE * SIZE; pixel++) {
            double dx = pixel % SIZE + 0.5 - 32, dy = (double)(pixel / SIZE) + 0.5 - 32;
            for (unsigned lane = 0; dx * dx + dy * dy < 28.0 * 28.0 && lane < 16; lane++) {
                inside++;
                holes += numbers[pixel * s.frame.sampling.lane_count + lane] == MT_NONE;
            }
        }
        assert_true(inside > 30000);
        assert_int_equal(holes, 0);
        free(numbers);
        free(depths);
        scene_end(&s);
    }
    test_context_end(context);
}

/* One rectangle as two triangles along one diagonal, again along the other, corners turned and reversed: all four lie
 * in one plane, and the first two win everywhere. */
static void equal_depth_goes_to_the_lowest(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {5};
    static const int corners[6][3] = {{0, 1, 2}, {0, 2, 3}, {1, 2, 3}, {3, 1, 0}, {2, 1, 0}, {3, 0, 2}};
    for (int round = 0; round < 50; round++) {
        scene s;
        scene_begin(&s, context, 6, 16);
        double slope[3] = {0.5, random_in(&random, -1e-3, 1e-3), random_in(&random, -1e-3, 1e-3)}, quad[4][2];
        for (int k = 0; k < 4; k++) {
            quad[k][0] = (k == 1 || k == 2 ? 50.0 : 10.0) + random_in(&random, -5, 5);
            quad[k][1] = (k >= 2 ? 50.0 : 10.0) + random_in(&random, -5, 5);
        }
        for (mt_index i = 0; i < 18; i++) {
            const double *p = quad[corners[i / 3][i % 3]];
            set_corner(&s, i, p[0], p[1], slope[0] + slope[1] * p[0] + slope[2] * p[1]);
        }
        float *depths = NULL;
        mt_index *numbers = draw(&s, &depths);
        size_t covered = 0, wrong = 0;
        for (size_t i = 0; i < (size_t)SIZE * SIZE * s.frame.sampling.lane_count; i++) {
            covered += numbers[i] != MT_NONE;
            wrong += numbers[i] != MT_NONE && numbers[i] > 1;
        }
        assert_true(covered > 10000);
        assert_int_equal(wrong, 0);
        free(numbers);
        free(depths);
        scene_end(&s);
    }
    test_context_end(context);
}

static void what_cannot_be_seen_is_listed_nowhere(void **state)
{
    (void)state;
    mt_context *context = test_context();
    scene s;
    scene_begin(&s, context, 4, 16);
    for (mt_index i = 0; i < 12; i++) {
        set_corner(&s, i, 10 + i % 3, 10 + i % 3, 0.5); /* a line */
    }
    set_corner(&s, 4, 40, 10, 0.5);
    set_corner(&s, 5, 40, 40, 0.0); /* behind the eye */
    for (mt_index k = 6; k < 9; k++) {
        set_corner(&s, k, 100 + 9 * (k == 7), 10 + 9 * (k == 8), 0.5); /* beside the picture */
    }
    for (mt_index k = 9; k < 12; k++) {
        set_corner(&s, k, -9 + 5 * (k == 10), -9 + 5 * (k == 11), 0.5);
    }
    for (mt_index i = 0; i < 4; i++) {
        mt_tile_range range = mt_triangle_range(&s.frame, i);
        assert_true(range.first_x > range.last_x);
    }
    scene_end(&s);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_are_covered_by_definition),
        cmocka_unit_test(fans_have_no_holes),
        cmocka_unit_test(equal_depth_goes_to_the_lowest),
        cmocka_unit_test(what_cannot_be_seen_is_listed_nowhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
