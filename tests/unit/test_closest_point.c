/* Nearest points through the tree against asking every element, in both orders, and known answers. */
#include "tests/support/unit.h"

#include "tests/support/rays.h"
#include "tests/support/soup.h"
#include "tests/support/zoo.h"

#include <meshtool/closest_point.h>
#include <meshtool/generate.h>

static const unsigned everything = MT_SURFACE_TRIANGLES | MT_SURFACE_WIRES | MT_SURFACE_POINTS | MT_SURFACE_VERTICES;

/* The lowest element of the least distance, over the numbers that the tree of those elements holds. */
static mt_closest brute_force(const mt_surface_tree *tree, const uint8_t *held, uint64_t end, mt_vec3 point)
{
    mt_closest best = {.distance = INFINITY, .element = MT_NONE}, one;
    for (uint64_t i = 0; i < end; i++) {
        if (held[i]) {
            mt_surface_element_closest(tree, (mt_index)i, point, &one);
            assert_true(mt_surface_element_distance(tree, (mt_index)i, point) == one.distance);
            best = one.distance < best.distance ? one : best;
        }
    }
    return best;
}

static bool vertex_is_finite(const mt_mesh *mesh, mt_index vertex)
{
    return mt_vec3_is_finite(mt_mesh_position(mesh, vertex));
}

/* Which numbers name an element that a tree holds. */
static uint8_t *list_elements(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                              unsigned elements, uint64_t *end)
{
    mt_index wire_size = mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0;
    mt_index wires = triangulation->triangle_count, points = wires + wire_size;
    mt_index vertices = points + mesh->point_count;
    *end = vertices + mesh->vertex_count;
    uint8_t *held = mt_allocate_array_zeroed(context, *end, 1);
    for (mt_index t = 0; t < wires && (elements & MT_SURFACE_TRIANGLES); t++) {
        held[t] = 1;
        for (mt_index side = 0; side < 3; side++) {
            held[t] &= vertex_is_finite(mesh, mesh->corner_vertices[mt_triangulation_corner(triangulation, t, side)]);
        }
    }
    for (mt_index wire = 0; wire < mesh->wire_count && (elements & MT_SURFACE_WIRES); wire++) {
        for (mt_index i = mesh->wire_offsets[wire]; i + 1 < mesh->wire_offsets[wire + 1]; i++) {
            held[wires + i] =
                vertex_is_finite(mesh, mesh->wire_vertices[i]) && vertex_is_finite(mesh, mesh->wire_vertices[i + 1]);
        }
    }
    for (mt_index i = 0; i < mesh->point_count && (elements & MT_SURFACE_POINTS); i++) {
        held[points + i] = vertex_is_finite(mesh, mesh->point_vertices[i]);
    }
    for (mt_index v = 0; v < mesh->vertex_count && (elements & MT_SURFACE_VERTICES); v++) {
        held[vertices + v] = vertex_is_finite(mesh, v);
    }
    return held;
}

static mt_vec3 random_point(const mt_mesh *mesh, test_random *random)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    uint64_t kind = test_random_below(random, 4);
    if (kind == 0 && mesh->vertex_count) {
        mt_vec3 p = mt_mesh_position(mesh, (mt_index)test_random_below(random, mesh->vertex_count));
        return mt_vec3_is_finite(p) ? p : mt_vec3_make(0, 0, 0);
    }
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    double reach = kind == 1 ? 10 : 1.5;
    return mt_vec3_make(bounds.minimum.x + size.x * (reach * (test_random_unit(random) - 0.5) + 0.5),
                        bounds.minimum.y + size.y * (reach * (test_random_unit(random) - 0.5) + 0.5),
                        bounds.minimum.z + size.z * (reach * (test_random_unit(random) - 0.5) + 0.5));
}

static void expect_same(const mt_closest *a, const mt_closest *b)
{
    assert_int_equal(a->element, b->element);
    if (a->element != MT_NONE) {
        assert_true(a->distance == b->distance && a->point.x == b->point.x && a->point.y == b->point.y &&
                    a->point.z == b->point.z);
    }
}

static void compare_mesh(mt_context *context, const mt_mesh *mesh, unsigned elements, int count)
{
    mt_triangulation triangulation;
    mt_surface_tree *tree = NULL;
    uint64_t end;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    const mt_surface_tree_options options = {.elements = elements};
    assert_int_equal(mt_surface_tree_create(context, mesh, &triangulation, &options, &tree), MT_OK);
    assert_int_equal(mt_surface_tree_validate(context, tree), MT_OK);
    uint8_t *held = list_elements(context, mesh, &triangulation, elements, &end);
    test_random random = {(uint64_t)count};
    for (int i = 0; i < count; i++) {
        mt_vec3 point = random_point(mesh, &random);
        mt_closest expected = brute_force(tree, held, end, point), found;
        mt_surface_tree_closest(tree, point, NULL, &found);
        expect_same(&found, &expected);
        mt_closest_options other = {.order = MT_CLOSEST_BEST_FIRST};
        mt_surface_tree_closest(tree, point, &other, &found);
        expect_same(&found, &expected);
        if (expected.element != MT_NONE) {
            other = (mt_closest_options){.has_hint = true, .hint = expected.element};
            mt_surface_tree_closest(tree, point, &other, &found);
            expect_same(&found, &expected);
            other = (mt_closest_options){.maximum = expected.distance * 0.999};
            assert_true(expected.distance == 0 || !mt_surface_tree_closest(tree, point, &other, &found));
        }
    }
    mt_free(context, held);
    mt_surface_tree_destroy(context, tree);
    mt_triangulation_release(context, &triangulation);
}

static void every_animal_answers_as_brute_force(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_animal animals[TEST_ZOO_ROOM];
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        for (unsigned elements = 1; elements <= MT_SURFACE_VERTICES; elements *= 2) {
            compare_mesh(context, animals[i].mesh, elements, 100);
        }
        compare_mesh(context, animals[i].mesh, everything, 100);
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

static void soups_answer_as_brute_force(void **state)
{
    (void)state;
    test_random random = {21};
    for (int round = 0; round < 300; round++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_soup(context, &random);
        compare_mesh(context, mesh, MT_SURFACE_TRIANGLES, 100);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* Meshes with many triangles, at places and sizes where floats alone fail. */
static void larger_meshes_answer_as_brute_force(void **state)
{
    (void)state;
    const struct {
        double scale, offset;
    } places[] = {{1, 0}, {1e-3, 1e7}, {1e-150, 0}, {1e150, 0}, {1e-30, 0}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_torus(context, 40, 25, true);
        for (mt_index v = 0; v < mesh->vertex_count; v++) {
            mt_vec3 p = mt_vec3_scale(mt_mesh_position(mesh, v), places[i].scale);
            double d = places[i].offset;
            mt_mesh_set_position(mesh, v, mt_vec3_add(p, mt_vec3_make(d, -d, d / 3)));
        }
        compare_mesh(context, mesh, MT_SURFACE_TRIANGLES, (int)test_ray_count(1000));
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* Aspects up to 2^20, where the float filter is at its limits. */
static void slivers_answer_as_brute_force(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 30, 20, false);
    test_random random = {8};
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        p.x *= ldexp(1, -(int)test_random_below(&random, 20));
        p.z *= ldexp(1, -(int)test_random_below(&random, 20));
        mt_mesh_set_position(mesh, v, p);
    }
    compare_mesh(context, mesh, MT_SURFACE_TRIANGLES, (int)test_ray_count(3000));
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void points_of_a_cube_are_where_they_should(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    mt_triangulation triangulation;
    mt_surface_tree *tree = NULL;
    assert_int_equal(mt_generate(context, "cube", NULL, &mesh), MT_OK);
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(mt_surface_tree_create(context, mesh, &triangulation, NULL, &tree), MT_OK);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    mt_vec3 high = bounds.maximum;
    mt_closest found;
    assert_true(mt_surface_tree_closest(tree, mt_vec3_add(high, mt_vec3_make(1, 2, 2)), NULL, &found));
    assert_true(found.distance == 3 && found.point.x == high.x && found.point.y == high.y && found.point.z == high.z);
    assert_true(mt_surface_tree_closest(tree, mt_vec3_make(high.x + 0.5, 0.1, 0.2), NULL, &found));
    assert_true(fabs(found.distance - 0.5) < 1e-15 && fabs(found.point.y - 0.1) < 1e-15);
    assert_false(mt_surface_tree_closest(tree, mt_vec3_make(NAN, 0, 0), NULL, &found));
    assert_int_equal(found.element, MT_NONE);
    mt_surface_tree_destroy(context, tree);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_animal_answers_as_brute_force),    cmocka_unit_test(soups_answer_as_brute_force),
        cmocka_unit_test(larger_meshes_answer_as_brute_force),    cmocka_unit_test(slivers_answer_as_brute_force),
        cmocka_unit_test(points_of_a_cube_are_where_they_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
