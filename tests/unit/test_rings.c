/* Rings: what only they give away while a structure is built, and sums over them. */
#include "tests/support/connectivity.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/halfedge.h>
#include <meshtool/triangle_neighbor.h>

#include <string.h>

/* Two tetrahedra with the edge 0 1 in common, its four sides in an order that joins each to one of the other
 * tetrahedron: then both ends have a single fan, which only its meeting the other end twice gives away. */
static void an_edge_of_two_crossed_pairs_is_refused(void **state)
{
    (void)state;
    static const mt_index corners[] = {0, 1, 2, 0, 1, 4, 1, 0, 3, 1, 0, 5, 0, 2, 3, 1, 3, 2, 0, 4, 5, 1, 5, 4};
    mt_context *context = test_context();
    mt_mesh_layout layout = {.vertex_count = 6, .face_count = 8, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    memcpy(mesh->corner_vertices, corners, sizeof corners);
    for (mt_index v = 0; v < 6; v++) {
        mt_mesh_set_position(mesh, v, (mt_vec3){v, v * v, 1});
    }
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        void *structure = &structure;
        assert_int_equal(test_structures[i].create(context, mesh, &structure), MT_ERROR_NOT_MANIFOLD);
        assert_null(structure);
        assert_non_null(strstr(mt_context_error(context)->message, "edge"));
        mt_context_clear_error(context);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Whole numbers, so that the order of adding does not matter. */
static void expect_neighbor_sums(mt_context *context, const mt_mesh *mesh, mt_index component_count)
{
    mt_halfedge_mesh *halfedges = NULL;
    mt_triangle_neighbor_mesh *triangles = NULL;
    assert_int_equal(mt_halfedge_create(context, mesh, &halfedges), MT_OK);
    assert_int_equal(mt_triangle_neighbor_create(context, mesh, &triangles), MT_OK);
    size_t count = (size_t)mesh->vertex_count * component_count;
    double *values = mt_allocate_array(context, 3 * count, sizeof *values), *sums = values + count;
    for (size_t i = 0; i < count; i++) {
        values[i] = (double)(i * i % 1009);
        sums[i] = -1;
    }
    mt_halfedge_sum_neighbors(halfedges, values, component_count, sums);
    mt_triangle_neighbor_sum_neighbors(triangles, values, component_count, sums + count);
    for (size_t i = 0; i < count; i++) {
        mt_index vertex = (mt_index)(i / component_count);
        double expected = 0;
        for (mt_halfedge_ring ring = mt_halfedge_ring_begin_clockwise(halfedges, vertex);
             mt_halfedge_ring_goes_on(&ring); mt_halfedge_ring_clockwise(halfedges, &ring)) {
            expected += values[(size_t)ring.neighbor * component_count + i % component_count];
        }
        assert_true(sums[i] == expected && sums[count + i] == expected);
    }
    mt_free(context, values);
    mt_halfedge_destroy(context, halfedges);
    mt_triangle_neighbor_destroy(context, triangles);
}

static void sums_over_neighbors_are_those_of_the_rings(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (mt_index component_count = 1; component_count <= 4; component_count++) {
        mt_mesh *torus = test_torus(context, 9, 7, true);
        expect_neighbor_sums(context, torus, component_count);
        mt_mesh_destroy(context, torus);
        mt_mesh *open_fan = test_fan(context, 20, false);
        expect_neighbor_sums(context, open_fan, component_count);
        mt_mesh_destroy(context, open_fan);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_edge_of_two_crossed_pairs_is_refused),
        cmocka_unit_test(sums_over_neighbors_are_those_of_the_rings),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
