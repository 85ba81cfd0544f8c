#include "tests/support/polygon.h"
#include "tests/support/unit.h"

#include <meshtool/triangulate.h>

#include <stdlib.h>
#include <string.h>
#include <time.h>

static const int64_t flat[2] = {0, 0};

static mt_index *triangulate_first(mt_context *context, const mt_mesh *mesh)
{
    mt_index *triangles = malloc(3 * (mesh->corner_count - 2) * sizeof *triangles);
    assert_non_null(triangles);
    mt_triangulator triangulator = {0};
    assert_int_equal(mt_triangulate_face(context, &triangulator, mesh, 0, triangles), MT_OK);
    mt_triangulator_release(context, &triangulator);
    return triangles;
}

/* Triangulates a polygon in a plane; returns the number of flat triangles. */
static size_t check_in(const test_polygon *polygon, const int64_t slope[2], int axis, double scale)
{
    mt_context *context = test_context();
    mt_mesh *mesh = test_polygon_mesh(context, polygon, slope, axis, scale);
    mt_index *triangles = triangulate_first(context, mesh);
    size_t result = test_polygon_check(polygon, triangles);
    free(triangles);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return result;
}

/* In every plane and of both sides; the simple polygon must get no flat triangle. */
static void check_simple(test_polygon polygon)
{
    static const int64_t slopes[3][2] = {{0, 0}, {3, -7}, {-1, 1}};
    for (int turned = 0; turned < 2; turned++) {
        for (int axis = 0; axis < 3; axis++) {
            assert_int_equal(check_in(&polygon, slopes[axis], axis, 1), 0);
        }
        test_polygon_reverse(&polygon);
    }
    test_polygon_release(&polygon);
}

static void test_simple_polygons_are_covered(void **state)
{
    (void)state;
    test_random random = {1};
    for (size_t count = 3; count < 30; count++) {
        check_simple(test_polygon_convex(count, 1000));
        for (int i = 0; i < 20; i++) {
            check_simple(test_polygon_star(&random, count, 1000));
            check_simple(test_polygon_tour(&random, count, 12));
        }
        check_simple(test_polygon_comb(&random, count));
        check_simple(test_polygon_monotone(&random, count));
    }
    for (size_t count = 100; count <= 3000; count *= 5) {
        check_simple(test_polygon_star(&random, count, 100000));
        check_simple(test_polygon_comb(&random, count));
        check_simple(test_polygon_monotone(&random, count));
    }
    check_simple(test_polygon_tour(&random, 150, 1000));
    check_simple(test_polygon_spiral(10, 7));
    check_simple(test_polygon_spiral(5, 300));
}

static void test_mazes_are_covered(void **state)
{
    (void)state;
    test_random random = {2};
    for (size_t size = 1; size < 12; size++) {
        check_simple(test_polygon_maze(&random, size, 12 - size, 2));
    }
    check_simple(test_polygon_maze(&random, 40, 40, 1));
}

static void test_collinear_corners_get_no_flat_triangle(void **state)
{
    (void)state;
    test_random random = {3};
    for (size_t count = 3; count < 40; count++) {
        test_polygon plain = test_polygon_tour(&random, count, 30);
        check_simple(test_polygon_with_middles(&random, &plain, count));
        test_polygon_release(&plain);
    }
}

static void test_repeated_points_cost_one_flat_triangle_each(void **state)
{
    (void)state;
    test_random random = {4};
    for (size_t count = 3; count < 40; count++) {
        test_polygon plain = test_polygon_tour(&random, count, 30);
        test_polygon repeated = test_polygon_with_repeats(&random, &plain, count / 3 + 1);
        assert_int_equal(check_in(&repeated, flat, 0, 1), count / 3 + 1);
        test_polygon_release(&plain);
        test_polygon_release(&repeated);
    }
}

static void test_holes_with_bridges_are_covered(void **state)
{
    (void)state;
    for (size_t rows = 1; rows < 6; rows++) {
        for (size_t columns = 1; columns < 6; columns++) {
            check_simple(test_polygon_sieve(rows, columns));
        }
    }
    check_simple(test_polygon_sieve(30, 30));
}

/* Polygons that touch themselves: a hole at a corner, a corner at a corner from inside, whiskers in and out. */
static void test_touching_polygons_are_covered(void **state)
{
    (void)state;
    static const struct {
        size_t count;
        int64_t points[12][2];
    } cases[] = {
        {7, {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {2, 6}, {6, 2}}},
        {7, {{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}, {-5, 5}, {-2, 1}}},
        {8, {{0, 0}, {5, 0}, {10, 0}, {10, 10}, {7, 10}, {5, 0}, {3, 10}, {0, 10}}},
        {6, {{0, 0}, {10, 0}, {10, 10}, {5, 5}, {10, 10}, {0, 10}}},
        {6, {{0, 0}, {10, 0}, {10, 10}, {15, 15}, {10, 10}, {0, 10}}},
        {7, {{0, 0}, {10, 0}, {10, 5}, {20, 5}, {10, 5}, {10, 10}, {0, 10}}},
        {9, {{0, 0}, {10, 0}, {10, 10}, {5, 10}, {8, 2}, {2, 2}, {5, 10}, {0, 10}, {0, 5}}},
        {8, {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {-4, 0}, {-4, -4}, {0, -4}}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        for (size_t first = 0; first < cases[i].count; first++) {
            test_polygon polygon = {0};
            for (size_t k = 0; k < cases[i].count; k++) {
                const int64_t *p = cases[i].points[(first + k) % cases[i].count];
                test_polygon_add(&polygon, p[0], p[1]);
            }
            check_in(&polygon, flat, 0, 1);
            test_polygon_reverse(&polygon);
            check_in(&polygon, flat, 0, 1);
            test_polygon_release(&polygon);
        }
    }
}

static void test_mazes_with_thin_walls_are_covered(void **state)
{
    (void)state;
    test_random random = {10};
    for (size_t i = 0; i < 300; i++) {
        test_polygon polygon = test_polygon_maze(&random, 1 + i % 7, 1 + i / 7 % 7, 0);
        check_in(&polygon, flat, 0, 1);
        test_polygon_reverse(&polygon);
        check_in(&polygon, flat, 0, 1);
        test_polygon_release(&polygon);
    }
}

static void test_scale_changes_nothing(void **state)
{
    (void)state;
    static const double scales[] = {0x1p-1060, 0x1p-500, 0x1p-30, 0x1p30, 0x1p500, 0x1p1000};
    static const int64_t slope[2] = {2, 5};
    test_random random = {5};
    for (size_t count = 4; count < 20; count++) {
        test_polygon polygon = test_polygon_tour(&random, count, 12);
        for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
            check_in(&polygon, slope, 1, scales[i]);
        }
        test_polygon_release(&polygon);
    }
}

/* A needle whose area vector rounding could turn around: the exact turn must decide. */
static void test_needles_keep_their_side(void **state)
{
    (void)state;
    test_random random = {6};
    for (int i = 0; i < 200; i++) {
        int64_t far = (int64_t)1 << 40, near = 1 + (int64_t)test_random_below(&random, 1000);
        test_polygon polygon = {0};
        test_polygon_add(&polygon, 0, 0);
        test_polygon_add(&polygon, far / 2 + near, 0);
        test_polygon_add(&polygon, far, 1);
        test_polygon_add(&polygon, far + 1, 1);
        test_polygon_add(&polygon, far / 2, 1);
        check_in(&polygon, flat, i % 3, 1);
        test_polygon_release(&polygon);
    }
}

static double seconds_for(test_polygon polygon, size_t flat_count)
{
    struct timespec begin, end;
    mt_context *context = test_context();
    mt_mesh *mesh = test_polygon_mesh(context, &polygon, flat, 0, 1);
    clock_gettime(CLOCK_MONOTONIC, &begin);
    mt_index *triangles = triangulate_first(context, mesh);
    clock_gettime(CLOCK_MONOTONIC, &end);
    assert_int_equal(test_polygon_check(&polygon, triangles), flat_count);
    free(triangles);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    double seconds = (double)(end.tv_sec - begin.tv_sec) + (double)(end.tv_nsec - begin.tv_nsec) * 1e-9;
    print_message("%zu sides: %.1f ms\n", polygon.count, seconds * 1e3);
    test_polygon_release(&polygon);
    return seconds;
}

/* The bounds are far above what is measured and far below what a quadratic search needs under sanitizers. */
static void test_large_polygons_finish(void **state)
{
    (void)state;
    test_random random = {7};
    assert_true(seconds_for(test_polygon_convex(100000, 1000), 0) < 10);
    assert_true(seconds_for(test_polygon_star(&random, 100000, 1000000), 0) < 60);
    assert_true(seconds_for(test_polygon_comb(&random, 50000), 0) < 60);
    assert_true(seconds_for(test_polygon_monotone(&random, 100000), 0) < 60);
    assert_true(seconds_for(test_polygon_spiral(100, 500), 0) < 60);
    assert_true(seconds_for(test_polygon_maze(&random, 160, 160, 2), 0) < 60);
    assert_true(seconds_for(test_polygon_sieve(130, 130), 0) < 60);
}

static mt_index *triangulate_doubles(mt_context *context, size_t count, const double *positions)
{
    mt_index *face = malloc((count + 1) * sizeof *face);
    assert_non_null(face);
    face[0] = (mt_index)count;
    for (size_t i = 0; i < count; i++) {
        face[i + 1] = (mt_index)i;
    }
    mt_mesh *mesh = test_mesh(context, (mt_index)count, positions, 1, face);
    mt_index *triangles = triangulate_first(context, mesh);
    test_polygon_check_sides(count, triangles);
    mt_mesh_destroy(context, mesh);
    free(face);
    return triangles;
}

/* Crossings, one line, one point, random knots, coordinates that are no numbers: sides - 2 triangles each. */
static void test_hopeless_polygons_get_triangles(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {8};
    double *positions = malloc(3 * 100000 * sizeof *positions);
    assert_non_null(positions);
    static const double odd[] = {0, 1, -1, NAN, INFINITY, -INFINITY, 1e308, -1e308, 5e-324};
    for (int round = 0; round < 300; round++) {
        size_t count = 3 + test_random_below(&random, 40);
        for (size_t i = 0; i < 3 * count; i++) {
            size_t kinds = round % 3 == 0 ? 1 : round % 3 == 1 ? 3 : sizeof odd / sizeof *odd;
            positions[i] = odd[test_random_below(&random, kinds)];
        }
        free(triangulate_doubles(context, count, positions));
    }
    for (size_t count = 5; count <= 100000; count *= 27) {
        for (size_t i = 0; i < 3 * count; i++) {
            positions[i] = test_random_unit(&random);
        }
        free(triangulate_doubles(context, count, positions));
    }
    free(positions);
    test_context_end(context);
}

static void assert_quad(const double positions[12], const mt_index expected[6])
{
    mt_context *context = test_context();
    mt_index *triangles = triangulate_doubles(context, 4, positions);
    assert_memory_equal(triangles, expected, 6 * sizeof *expected);
    free(triangles);
    test_context_end(context);
}

static void test_quads_take_the_right_diagonal(void **state)
{
    (void)state;
    static const mt_index first[6] = {0, 1, 2, 0, 2, 3}, second[6] = {1, 2, 3, 1, 3, 0};
    assert_quad((double[12]){0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, first);
    assert_quad((double[12]){0, 0, 0, 1, 0, 0, 1.0000001, 1.0000001, 0, 0, 1, 0}, first);
    assert_quad((double[12]){0, 0, 0, 1, 0, 0, 2, 2, 0, 0, 1, 0}, second);
    assert_quad((double[12]){0, 0, 0, 1e200, 0, 0, 2e200, 2e200, 0, 0, 1e200, 0}, second);
    assert_quad((double[12]){0, 0, 0, 0, 1e-200, 0, 0, 2e-200, 2e-200, 0, 0, 1e-200}, second);
    assert_quad((double[12]){0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0}, first);  /* concave at corner 2 */
    assert_quad((double[12]){1, 1, 0, 0, 4, 0, 0, 0, 0, 4, 0, 0}, first);  /* at corner 0 */
    assert_quad((double[12]){4, 0, 0, 1, 1, 0, 0, 4, 0, 0, 0, 0}, second); /* at corner 1 */
    assert_quad((double[12]){0, 0, 0, 2, 0, 0, 4, 0, 0, 0, 4, 0}, second); /* straight at corner 1 */
    assert_quad((double[12]){NAN, 0, 0, 2, 0, 0, 4, 0, 0, 0, 4, 0}, first);
}

/* Quads in the same way as larger polygons: against the definition, in any position. */
static void test_quads_are_covered(void **state)
{
    (void)state;
    test_random random = {9};
    for (int i = 0; i < 2000; i++) {
        check_simple(test_polygon_tour(&random, 4, 4 + i % 60));
    }
}

/* A grid of n-gons for the whole-mesh functions: cells of 3 to 7 sides, every third one concave. */
static mt_mesh *mixed_mesh(mt_context *context, mt_index cell_count)
{
    static const double cell[7][2] = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}, {-1, 3}, {-1, 1}};
    mt_mesh_layout layout = {
        .vertex_count = 7 * (uint64_t)cell_count, .face_count = cell_count, .position_type = MT_F32};
    for (mt_index i = 0; i < cell_count; i++) {
        layout.corner_count += 3 + i % 5;
    }
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    mt_index corner = 0;
    for (mt_index i = 0; i < cell_count; i++) {
        for (mt_index k = 0; k < 7; k++) {
            mt_mesh_set_position(mesh, 7 * i + k, mt_vec3_make(cell[k][0] + 8 * i, cell[k][1], 0));
        }
        for (mt_index k = 0; k < 3 + i % 5; k++) {
            mesh->corner_vertices[corner++] = 7 * i + k;
        }
        mesh->face_offsets[i + 1] = corner;
    }
    return mesh;
}

static void test_a_mesh_is_the_same_for_any_threads(void **state)
{
    (void)state;
    uint64_t hashes[2];
    for (unsigned threads = 1; threads <= 2; threads++) {
        mt_context *context = test_context_with_threads(threads);
        mt_mesh *mesh = mixed_mesh(context, 20000), *triangles;
        assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
        assert_int_equal(mt_mesh_validate(context, triangles), MT_OK);
        assert_int_equal(triangles->face_count, mesh->corner_count - 2 * mesh->face_count);
        hashes[threads - 1] = test_mesh_hash(triangles);
        mt_mesh_destroy(context, triangles);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(hashes[0] == hashes[1]);
}

static void add_numbered(mt_context *context, mt_mesh *mesh, mt_domain domain, bool indexed)
{
    mt_index count = mt_mesh_domain_count(mesh, domain);
    mt_attribute_layout layout = {.name = "number",
                                  .domain = domain,
                                  .type = indexed ? MT_F64 : MT_U32,
                                  .component_count = 1,
                                  .value_count = count,
                                  .indexed = indexed};
    mt_attribute *attribute;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    for (mt_index i = 0; i < count; i++) {
        mt_attribute_set(attribute, indexed ? count - 1 - i : i, 0, i);
        if (indexed) {
            attribute->indices[i] = count - 1 - i;
        }
    }
}

/* Each attribute holds the number of its element, so what follows can be compared with the triangulation itself. */
static void check_followers(const mt_mesh *mesh, const mt_mesh *triangles, const mt_triangulation *triangulation)
{
    assert_int_equal(triangles->attribute_count, mesh->attribute_count);
    for (mt_index which = 0; which < triangles->attribute_count; which++) {
        const mt_attribute *attribute = &triangles->attributes[which];
        mt_index count = mt_mesh_domain_count(triangles, attribute->domain);
        for (mt_index i = 0; i < count; i++) {
            mt_index expected = attribute->domain == MT_DOMAIN_CORNER ? triangulation->corners[i]
                                : attribute->domain == MT_DOMAIN_FACE ? triangulation->faces[i]
                                                                      : i;
            double number = mt_attribute_get(attribute, mt_attribute_value_index(attribute, i), 0);
            assert_true(number == expected);
        }
    }
    for (mt_index i = 0; i < triangles->corner_count; i++) {
        assert_int_equal(triangles->corner_vertices[i], mesh->corner_vertices[triangulation->corners[i]]);
    }
    for (mt_index i = 0; i < triangles->face_count; i++) {
        assert_int_equal(triangles->label_sets[0].face_labels[i], triangulation->faces[i] % 3);
    }
}

static mt_mesh *laden_mesh(mt_context *context)
{
    mt_mesh *mesh = mixed_mesh(context, 23);
    for (int domain = MT_DOMAIN_MESH; domain <= MT_DOMAIN_FACE; domain++) {
        add_numbered(context, mesh, (mt_domain)domain, false);
    }
    add_numbered(context, mesh, MT_DOMAIN_CORNER, true);
    mt_labels *labels;
    mt_index number;
    assert_int_equal(mt_mesh_add_labels(context, mesh, MT_LABEL_GROUP, &labels), MT_OK);
    for (int i = 0; i < 3; i++) {
        assert_int_equal(mt_labels_add_name(context, labels, "abc", &number), MT_OK);
    }
    for (mt_index i = 0; i < mesh->face_count; i++) {
        labels->face_labels[i] = i % 3;
    }
    mesh->creases = mt_allocate_array_zeroed(context, 1, sizeof *mesh->creases);
    mesh->creases[0] = (mt_edge_value){3, 4, 2.5};
    mesh->crease_count = 1;
    mesh->up = MT_UP_Z;
    return mesh;
}

static void test_attributes_and_labels_follow(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = laden_mesh(context), *triangles;
    mt_triangulation triangulation;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
    assert_int_equal(mt_mesh_validate(context, triangles), MT_OK);
    check_followers(mesh, triangles, &triangulation);
    assert_int_equal(triangles->label_sets[0].name_count, 3);
    assert_int_equal(triangles->crease_count, 1);
    assert_true(triangles->creases[0].value == 2.5);
    assert_int_equal(triangles->up, MT_UP_Z);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, triangles);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_triangles_need_no_tables(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const mt_index face[4] = {3, 0, 1, 2};
    for (mt_index face_count = 0; face_count < 2; face_count++) {
        mt_mesh *mesh = test_mesh(context, 3, positions, face_count, face), *triangles;
        mt_triangulation triangulation;
        assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
        assert_int_equal(triangulation.triangle_count, face_count);
        assert_null(triangulation.corners);
        assert_int_equal(mt_triangulation_corner(&triangulation, 5, 1), 16);
        assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
        assert_true(test_mesh_hash(mesh) == test_mesh_hash(triangles));
        mt_triangulation_release(context, &triangulation);
        mt_mesh_destroy(context, triangles);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void test_missing_memory_is_an_error(void **state)
{
    (void)state;
    bool succeeded = false;
    for (uint64_t failing = 1; !succeeded; failing++) {
        mt_context *maker = test_context();
        mt_mesh *mesh = laden_mesh(maker), *triangles;
        mt_context_options options = {.failing_allocation = failing};
        mt_context *context = mt_context_create(&options);
        assert_non_null(context);
        mt_status status = mt_mesh_triangulate(context, mesh, &triangles);
        succeeded = status == MT_OK;
        assert_true(succeeded || (status == MT_ERROR_OUT_OF_MEMORY && !triangles));
        mt_mesh_destroy(context, triangles);
        test_context_end(context);
        mt_mesh_destroy(maker, mesh);
        test_context_end(maker);
        assert_true(failing < 1000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_simple_polygons_are_covered),
        cmocka_unit_test(test_mazes_are_covered),
        cmocka_unit_test(test_collinear_corners_get_no_flat_triangle),
        cmocka_unit_test(test_repeated_points_cost_one_flat_triangle_each),
        cmocka_unit_test(test_holes_with_bridges_are_covered),
        cmocka_unit_test(test_touching_polygons_are_covered),
        cmocka_unit_test(test_mazes_with_thin_walls_are_covered),
        cmocka_unit_test(test_scale_changes_nothing),
        cmocka_unit_test(test_needles_keep_their_side),
        cmocka_unit_test(test_large_polygons_finish),
        cmocka_unit_test(test_hopeless_polygons_get_triangles),
        cmocka_unit_test(test_quads_take_the_right_diagonal),
        cmocka_unit_test(test_quads_are_covered),
        cmocka_unit_test(test_a_mesh_is_the_same_for_any_threads),
        cmocka_unit_test(test_attributes_and_labels_follow),
        cmocka_unit_test(test_triangles_need_no_tables),
        cmocka_unit_test(test_missing_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
