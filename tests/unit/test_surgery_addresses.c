/* How surgery names edges on winged edges and triangle neighbours: by number and the vertex they run from, or by either
 * corner; what does not belong there is no element, and what triangles cannot hold is said. A compacted
 * triangle-neighbour structure is the one that is built from its faces. */
#include "tests/support/fixture.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/triangle_neighbor_surgery.h>
#include <meshtool/winged_edge_surgery.h>

#include <string.h>

static mt_winged_surgery *begin_winged(mt_context *context, const mt_mesh *mesh)
{
    mt_winged_edge_mesh *structure = NULL;
    mt_winged_surgery *surgery = NULL;
    assert_int_equal(mt_winged_edge_create(context, mesh, &structure), MT_OK);
    assert_int_equal(mt_winged_surgery_create(context, structure, &surgery), MT_OK);
    mt_winged_edge_destroy(context, structure);
    return surgery;
}

static mt_triangle_surgery *begin_triangles(mt_context *context, const mt_mesh *mesh)
{
    mt_triangle_neighbor_mesh *structure = NULL;
    mt_triangle_surgery *surgery = NULL;
    assert_int_equal(mt_triangle_neighbor_create(context, mesh, &structure), MT_OK);
    assert_int_equal(mt_triangle_surgery_create(context, structure, &surgery), MT_OK);
    mt_triangle_neighbor_destroy(context, structure);
    return surgery;
}

static void a_winged_edge_runs_from_one_of_its_ends(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 5, false);
    mt_winged_surgery *surgery = begin_winged(context, mesh);
    const mt_winged_edge_mesh *own = &surgery->structure;
    for (mt_index edge = 0; edge <= own->edge_count; edge++) {
        for (mt_index vertex = 0; vertex <= own->vertex_count; vertex++) {
            bool is_end =
                edge < own->edge_count && (own->edges[edge].tail == vertex || own->edges[edge].head == vertex);
            mt_surgery_verdict split = mt_winged_can_split_edge(surgery, edge, vertex);
            assert_int_equal(split, is_end ? MT_SURGERY_ALLOWED : MT_SURGERY_NO_ELEMENT);
            bool no_collapse = mt_winged_can_collapse_edge(surgery, edge, vertex) == MT_SURGERY_NO_ELEMENT;
            assert_int_equal(no_collapse, !is_end);
            if (edge < own->edge_count && vertex < own->vertex_count) {
                bool no_cut = mt_winged_can_split_vertex(surgery, vertex, edge, MT_NONE) == MT_SURGERY_NO_ELEMENT;
                assert_int_equal(no_cut, !is_end);
            }
        }
    }
    assert_int_equal(mt_winged_can_split_vertex(surgery, 0, MT_NONE, MT_NONE), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_winged_can_split_vertex(surgery, 0, own->edge_count, 0), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_winged_can_swap_edge(surgery, MT_NONE), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_winged_can_remove_face(surgery, MT_NONE), MT_SURGERY_NO_ELEMENT);
    mt_winged_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void new_winged_edges_run_as_promised(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 5, true);
    for (int backwards = 0; backwards < 2; backwards++) {
        mt_winged_surgery *surgery = begin_winged(context, mesh);
        const mt_winged_edge_mesh *own = &surgery->structure;
        mt_index edge = mt_winged_surgery_find(surgery, 0, 1), first = own->edge_count, middle = MT_NONE;
        mt_index tail = backwards ? own->edges[edge].head : own->edges[edge].tail;
        mt_index head = mt_winged_edge_other_vertex(own, edge, tail);
        assert_int_equal(mt_winged_split_edge(context, surgery, edge, tail, 0.5, &middle), MT_OK);
        assert_int_equal(own->edge_count, first + 3);
        for (mt_index added = first; added < first + 3; added++) {
            assert_int_equal(own->edges[added].tail, middle);
        }
        assert_int_equal(own->edges[first].head, head);
        assert_int_equal(mt_winged_edge_other_vertex(own, edge, middle), tail);
        assert_int_equal(mt_winged_edge_validate(context, own), MT_OK);
        mt_winged_surgery_destroy(context, surgery);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void either_corner_names_an_edge_of_triangles(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 5, false);
    mt_triangle_surgery *surgery = begin_triangles(context, mesh);
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    for (mt_index side = 0; side < 3 * own->triangle_count; side++) {
        mt_index ends[2] = {own->vertices[side], own->vertices[mt_triangle_next_corner(side)]};
        mt_index across = own->neighbors[side];
        for (int i = 0; i < 2; i++) {
            mt_surgery_verdict verdict = mt_triangle_can_collapse_edge(surgery, side, ends[i]);
            assert_true(verdict != MT_SURGERY_NO_ELEMENT);
            assert_true(across == MT_NONE || mt_triangle_can_collapse_edge(surgery, across, ends[i]) == verdict);
            mt_index found = mt_triangle_surgery_find(surgery, ends[i], ends[1 - i]);
            assert_int_equal(found, i == 0 || across == MT_NONE ? side : across);
        }
        mt_index third = own->vertices[mt_triangle_previous_corner(side)];
        assert_int_equal(mt_triangle_can_split_edge(surgery, side, third), MT_SURGERY_NO_ELEMENT);
        assert_int_equal(mt_triangle_can_collapse_edge(surgery, side, MT_NONE), MT_SURGERY_NO_ELEMENT);
    }
    assert_int_equal(mt_triangle_can_swap_edge(surgery, 3 * own->triangle_count), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_triangle_can_swap_edge(surgery, MT_NONE), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_triangle_can_remove_face(surgery, own->triangle_count), MT_SURGERY_NO_ELEMENT);
    mt_triangle_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void triangles_do_not_hold_polygons(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[3 * 5] = {0};
    const mt_index faces[] = {3, 0, 1, 2};
    mt_mesh *mesh = test_mesh(context, 5, positions, 1, faces);
    mt_triangle_surgery *triangles = begin_triangles(context, mesh);
    mt_winged_surgery *winged = begin_winged(context, mesh);
    const mt_index quad[4] = {1, 0, 3, 4}, repeated[4] = {1, 0, 3, 0}, missing[4] = {1, 0, 3, 5};
    assert_int_equal(mt_triangle_can_add_face(triangles, 4, quad), MT_SURGERY_NOT_TRIANGLES);
    assert_int_equal(mt_triangle_can_add_face(triangles, 4, repeated), MT_SURGERY_NOT_A_FACE);
    assert_int_equal(mt_triangle_can_add_face(triangles, 4, missing), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_triangle_can_add_face(triangles, 2, quad), MT_SURGERY_NOT_A_FACE);
    mt_index face = 7;
    assert_int_equal(mt_triangle_add_face(context, triangles, 4, quad, &face), MT_ERROR_ARGUMENT);
    assert_non_null(strstr(mt_context_error(context)->message, mt_surgery_verdict_words(MT_SURGERY_NOT_TRIANGLES)));
    assert_int_equal(face, 7);
    assert_int_equal(mt_winged_add_face(context, winged, 4, quad, &face), MT_OK);
    assert_int_equal(face, 1);
    assert_int_equal(mt_winged_edge_validate(context, &winged->structure), MT_OK);
    mt_triangle_surgery_destroy(context, triangles);
    mt_winged_surgery_destroy(context, winged);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void operate_at_random(mt_context *context, mt_triangle_surgery *surgery, test_random *random)
{
    const mt_triangle_neighbor_mesh *own = &surgery->structure;
    mt_index side = (mt_index)test_random_below(random, 3 * own->triangle_count), tail = own->vertices[side];
    switch (test_random_below(random, 4)) {
    case 0:
        (void)mt_triangle_swap_edge(context, surgery, side);
        break;
    case 1:
        (void)mt_triangle_split_edge(context, surgery, side, tail, 0.5, NULL);
        break;
    case 2:
        (void)mt_triangle_remove_face(context, surgery, side / 3);
        break;
    default:
        (void)mt_triangle_collapse_edge(context, surgery, side, tail, 0.5);
    }
    mt_context_clear_error(context);
}

static void expect_same_structure(const mt_triangle_neighbor_mesh *one, const mt_triangle_neighbor_mesh *other)
{
    assert_int_equal(one->vertex_count, other->vertex_count);
    assert_int_equal(one->triangle_count, other->triangle_count);
    assert_memory_equal(one->vertices, other->vertices, 3 * one->triangle_count * sizeof(mt_index));
    assert_memory_equal(one->neighbors, other->neighbors, 3 * one->triangle_count * sizeof(mt_index));
    assert_memory_equal(one->vertex_corner, other->vertex_corner, one->vertex_count * sizeof(mt_index));
}

static void compacted_triangles_are_as_if_built(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        mt_context *context = test_context();
        test_random random = {seed};
        mt_mesh *mesh = test_torus(context, 5, 4, seed % 2 == 1), *left = NULL;
        mt_triangle_surgery *surgery = begin_triangles(context, mesh);
        for (int i = 0; i < 60; i++) {
            operate_at_random(context, surgery, &random);
        }
        mt_triangle_neighbor_mesh *compacted = NULL, *built = NULL;
        assert_int_equal(mt_triangle_surgery_compact(context, surgery, NULL, &compacted), MT_OK);
        assert_int_equal(mt_triangle_surgery_to_mesh(context, surgery, mesh, &left), MT_OK);
        assert_int_equal(mt_triangle_neighbor_create(context, left, &built), MT_OK);
        expect_same_structure(compacted, built);
        mt_triangle_neighbor_destroy(context, built);
        mt_triangle_neighbor_destroy(context, compacted);
        mt_triangle_surgery_destroy(context, surgery);
        mt_mesh_destroy(context, left);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_winged_edge_runs_from_one_of_its_ends),  cmocka_unit_test(new_winged_edges_run_as_promised),
        cmocka_unit_test(either_corner_names_an_edge_of_triangles), cmocka_unit_test(triangles_do_not_hold_polygons),
        cmocka_unit_test(compacted_triangles_are_as_if_built),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
