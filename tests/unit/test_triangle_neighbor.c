/* What the triangle-neighbour structure has for itself: its two forms, its refusal of polygons, and that its validation
 * sees every kind of damage. */
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/triangle_neighbor.h>

#include <stdlib.h>
#include <string.h>

static const double grid_positions[3 * 9];

/* A square of eight triangles around vertex 4, open at its rim. */
static mt_mesh *square(mt_context *context)
{
    static const mt_index faces[] = {3, 0, 1, 4, 3, 0, 4, 3, 3, 1, 2, 4, 3, 2, 5, 4,
                                     3, 3, 4, 6, 3, 4, 7, 6, 3, 4, 5, 8, 3, 4, 8, 7};
    return test_mesh(context, 9, grid_positions, 8, faces);
}

static mt_triangle_neighbor_mesh *build(mt_context *context, const mt_mesh *mesh)
{
    mt_triangle_neighbor_mesh *structure = NULL;
    assert_int_equal(mt_triangle_neighbor_create(context, mesh, &structure), MT_OK);
    return structure;
}

/* Triangle 0 of the square is (0, 1, 4): below it lies nothing, then (1, 2, 4), then (0, 4, 3). */
static void neighbors_are_packed_as_triangle_and_side(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = square(context);
    mt_triangle_neighbor_mesh *structure = build(context, mesh);
    assert_int_equal(structure->neighbors[0], MT_NONE);
    assert_int_equal(structure->neighbors[1], 3 * 2 + 2);
    assert_int_equal(structure->neighbors[2], 3 * 1 + 0);
    assert_int_equal(mt_triangle_neighbor_across(structure, 0), MT_NONE);
    assert_int_equal(mt_triangle_neighbor_across(structure, 1), 2);
    assert_true(mt_triangle_neighbor_vertex_is_boundary(structure, 0));
    assert_false(mt_triangle_neighbor_vertex_is_boundary(structure, 4));
    assert_int_equal(mt_triangle_neighbor_valence(structure, 4), 8);
    assert_int_equal(mt_triangle_neighbor_valence(structure, 0), 3);
    assert_int_equal(structure->vertex_corner[4], 21);
    assert_int_equal(structure->vertices[structure->vertex_corner[3]], 3);
    assert_int_equal(structure->neighbors[structure->vertex_corner[3]], MT_NONE);
    mt_triangle_neighbor_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static mt_index *unpack(const mt_triangle_neighbor_mesh *structure)
{
    mt_index *plain = malloc((3 * (size_t)structure->triangle_count + 1) * sizeof *plain);
    assert_non_null(plain);
    mt_triangle_neighbor_unpack(structure, plain);
    return plain;
}

static void expect_same_forms(mt_context *context, const mt_triangle_neighbor_mesh *structure, const mt_index *plain)
{
    mt_triangle_neighbor_mesh *packed = NULL;
    assert_int_equal(mt_triangle_neighbor_pack(context, structure->vertex_count, structure->triangle_count,
                                               structure->vertices, plain, &packed),
                     MT_OK);
    size_t size = 3 * (size_t)structure->triangle_count * sizeof *plain;
    assert_memory_equal(packed->vertices, structure->vertices, size);
    assert_memory_equal(packed->neighbors, structure->neighbors, size);
    assert_memory_equal(packed->vertex_corner, structure->vertex_corner, structure->vertex_count * sizeof *plain);
    mt_triangle_neighbor_destroy(context, packed);
}

/* Around every vertex the plain form meets the triangles that the packed one meets. */
static void expect_same_walk(const mt_triangle_neighbor_mesh *structure, const mt_index *plain, mt_index vertex)
{
    mt_triangle_ring ring = mt_triangle_ring_begin_clockwise(structure, vertex);
    if (mt_triangle_ring_goes_on(&ring) && ring.corner == MT_NONE) {
        mt_triangle_ring_clockwise(structure, &ring);
    }
    mt_index triangle = mt_triangle_of_corner(ring.corner);
    while (mt_triangle_ring_goes_on(&ring)) {
        assert_int_equal(triangle, mt_triangle_of_corner(ring.corner));
        triangle = mt_plain_neighbor_clockwise(structure->vertices, plain, triangle, vertex);
        mt_triangle_ring_clockwise(structure, &ring);
    }
}

static void both_forms_hold_the_same(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *meshes[] = {square(context), test_torus(context, 9, 7, true), test_fan(context, 12, false),
                         test_fan(context, 12, true), test_mesh(context, 3, grid_positions, 0, NULL)};
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        mt_triangle_neighbor_mesh *structure = build(context, meshes[i]);
        mt_index *plain = unpack(structure);
        expect_same_forms(context, structure, plain);
        for (mt_index vertex = 0; vertex < structure->vertex_count; vertex++) {
            expect_same_walk(structure, plain, vertex);
        }
        free(plain);
        mt_triangle_neighbor_destroy(context, structure);
        mt_mesh_destroy(context, meshes[i]);
    }
    test_context_end(context);
}

static void expect_no_packing(mt_context *context, mt_index vertex_count, mt_index triangle_count,
                              const mt_index *vertices, const mt_index *plain, const char *word)
{
    mt_triangle_neighbor_mesh *packed = NULL;
    mt_context_clear_error(context);
    assert_int_equal(mt_triangle_neighbor_pack(context, vertex_count, triangle_count, vertices, plain, &packed),
                     MT_ERROR_ARGUMENT);
    assert_null(packed);
    assert_non_null(strstr(mt_context_error(context)->message, word));
}

static void wrong_plain_neighbors_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_index vertices[] = {0, 1, 2, 2, 1, 3};
    const mt_index lonely[] = {MT_NONE, MT_NONE, MT_NONE, MT_NONE, MT_NONE, MT_NONE};
    const mt_index one_way[] = {MT_NONE, 1, MT_NONE, MT_NONE, MT_NONE, MT_NONE};
    const mt_index past[] = {MT_NONE, 7, MT_NONE, MT_NONE, MT_NONE, MT_NONE};
    expect_no_packing(context, 4, 2, vertices, one_way, "triangle 0");
    expect_no_packing(context, 4, 2, vertices, past, "triangle 7");
    expect_no_packing(context, 3, 2, vertices, lonely, "vertex 3");
    expect_no_packing(context, 4, 2, vertices, lonely, "vertex 1"); /* two fans there */
    test_context_end(context);
}

static void the_first_polygon_is_named(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const mt_index faces[] = {3, 0, 1, 2, 4, 2, 1, 3, 4, 5, 4, 3, 5, 6, 7};
    mt_mesh *mesh = test_mesh(context, 9, grid_positions, 3, faces);
    mt_triangle_neighbor_mesh *structure = NULL;
    assert_int_equal(mt_triangle_neighbor_create(context, mesh, &structure), MT_ERROR_INVALID_MESH);
    assert_null(structure);
    assert_non_null(strstr(mt_context_error(context)->message, "face 1 has 4 sides"));
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void expect_damage(mt_context *context, mt_triangle_neighbor_mesh *structure, mt_index *place, mt_index value,
                          const char *words)
{
    mt_index kept = *place;
    *place = value;
    mt_context_clear_error(context);
    assert_int_equal(mt_triangle_neighbor_validate(context, structure), MT_ERROR_INTERNAL);
    if (!strstr(mt_context_error(context)->message, words)) {
        fail_msg("\"%s\" does not say \"%s\"", mt_context_error(context)->message, words);
    }
    *place = kept;
    mt_context_clear_error(context);
    assert_int_equal(mt_triangle_neighbor_validate(context, structure), MT_OK);
}

static void every_damage_is_seen_and_located(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = square(context);
    mt_triangle_neighbor_mesh *structure = build(context, mesh);
    expect_damage(context, structure, &structure->vertices[7], 9, "triangle 2 names vertex 9 of 9");
    expect_damage(context, structure, &structure->vertices[7], 1, "triangle 2 names vertex 1 twice");
    expect_damage(context, structure, &structure->vertices[7], 3, "does not run along the same vertices");
    expect_damage(context, structure, &structure->neighbors[1], 24, "side 1 of triangle 0 has corner 24");
    expect_damage(context, structure, &structure->neighbors[1], 9, "side 1 of triangle 0 has corner 9");
    expect_damage(context, structure, &structure->neighbors[0], 0, "side 0 of triangle 0");
    expect_damage(context, structure, &structure->neighbors[1], MT_NONE, "triangle 2");
    expect_damage(context, structure, &structure->vertex_corner[4], 0, "vertex 4 has corner 0");
    expect_damage(context, structure, &structure->vertex_corner[4], MT_NONE, "vertex 4 meets 0 of its 8");
    expect_damage(context, structure, &structure->vertex_corner[0], 3, "vertex 0 meets 1 of its 2");
    mt_triangle_neighbor_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(neighbors_are_packed_as_triangle_and_side), cmocka_unit_test(both_forms_hold_the_same),
        cmocka_unit_test(wrong_plain_neighbors_are_refused),         cmocka_unit_test(the_first_polygon_is_named),
        cmocka_unit_test(every_damage_is_seen_and_located),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
