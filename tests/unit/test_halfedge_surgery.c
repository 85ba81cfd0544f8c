/* Surgery on half-edges, beside what all structures share (test_surgery.c): collapse is allowed just where the check
 * finds a manifold of the same shape, edges are mapped, bad elements and weights refused. */
#include "tests/support/fixture.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>
#include <meshtool/halfedge_surgery.h>
#include <meshtool/manifold.h>

#include <math.h>

static mt_halfedge_surgery *begin(mt_context *context, const mt_mesh *mesh)
{
    mt_halfedge_mesh *structure = NULL;
    mt_halfedge_surgery *surgery = NULL;
    assert_int_equal(mt_halfedge_create(context, mesh, &structure), MT_OK);
    assert_int_equal(mt_halfedge_surgery_create(context, structure, &surgery), MT_OK);
    mt_halfedge_destroy(context, structure);
    return surgery;
}

static mt_status compact(mt_context *context, const mt_halfedge_surgery *surgery, mt_halfedge_mesh **out)
{
    mt_surgery_map map;
    mt_status status = mt_halfedge_surgery_compact(context, surgery, &map, out);
    status = status == MT_OK ? mt_halfedge_validate(context, *out) : status;
    mt_surgery_map_release(context, &map);
    return status;
}

static int64_t euler(const mt_halfedge_mesh *own)
{
    return (int64_t)own->vertex_count - own->halfedge_count / 2 + own->face_count;
}

static mt_mesh *starting_mesh(mt_context *context, int which)
{
    return which == 0 ? test_torus(context, 5, 4, false) : test_fan(context, 6, which == 1);
}

static mt_status operate(mt_context *context, mt_halfedge_surgery *surgery, mt_index halfedge, uint64_t kind)
{
    if (kind == 0 && mt_halfedge_can_swap_edge(surgery, halfedge >> 1) == MT_SURGERY_ALLOWED) {
        return mt_halfedge_swap_edge(context, surgery, halfedge >> 1);
    }
    if (kind == 1 && mt_halfedge_can_split_edge(surgery, halfedge >> 1) == MT_SURGERY_ALLOWED) {
        return mt_halfedge_split_edge(context, surgery, halfedge >> 1, 0.25, NULL);
    }
    if (kind > 1 && mt_halfedge_can_collapse_edge(surgery, halfedge) == MT_SURGERY_ALLOWED) {
        return mt_halfedge_collapse_edge(context, surgery, halfedge, 0.5);
    }
    return MT_OK;
}

/* Whether the triangles with the half-edge's tail renamed to its head still make a manifold of the same shape. */
static bool may_collapse(mt_context *context, const mt_halfedge_mesh *own, mt_index halfedge)
{
    static double positions[3 * 64];
    mt_index faces[4 * 128];
    mt_index count = 0;
    mt_index gone = mt_halfedge_tail(own, halfedge), kept = mt_halfedge_head(own, halfedge);
    for (mt_index face = 0; face < own->face_count; face++) {
        mt_index h = own->face_halfedge[face], *to = faces + 4 * (size_t)count;
        to[0] = 3;
        for (int i = 1; i < 4; i++, h = mt_halfedge_next(own, h)) {
            mt_index v = mt_halfedge_head(own, h);
            to[i] = v == gone ? kept : v;
        }
        count += to[1] != to[2] && to[2] != to[3] && to[3] != to[1];
    }
    mt_mesh *mesh = test_mesh(context, own->vertex_count, positions, count, faces);
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    mt_index expected = own->face_count - (mt_halfedge_edge_is_boundary(own, halfedge >> 1) ? 1 : 2);
    bool same = (int64_t)own->vertex_count - 1 - report.edge_count + count == euler(own);
    bool may = count == expected && same && report.manifold_class != MT_NON_MANIFOLD &&
               report.defect_counts[MT_DEFECT_DUPLICATE_FACE] == 0 &&
               report.defect_counts[MT_DEFECT_ISOLATED_VERTEX] == 1;
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    return may;
}

static void collapse_is_allowed_where_the_face_list_stays_manifold(void **state)
{
    (void)state;
    mt_index counts[2] = {0, 0};
    for (int which = 0; which < 3; which++) {
        mt_context *context = test_context();
        mt_mesh *mesh = starting_mesh(context, which);
        mt_halfedge_surgery *surgery = begin(context, mesh);
        test_random random = {3 + (uint64_t)which};
        for (int i = 0; i < 60; i++) {
            mt_halfedge_mesh *left = NULL;
            assert_int_equal(compact(context, surgery, &left), MT_OK);
            mt_halfedge_surgery_destroy(context, surgery);
            assert_int_equal(mt_halfedge_surgery_create(context, left, &surgery), MT_OK);
            for (mt_index h = 0; h < left->halfedge_count; h++) {
                bool may = mt_halfedge_can_collapse_edge(surgery, h) == MT_SURGERY_ALLOWED;
                assert_int_equal(may, may_collapse(context, left, h));
                counts[may]++;
            }
            mt_index h = (mt_index)test_random_below(&random, left->halfedge_count);
            uint64_t kind = test_random_below(&random, 4);
            kind = kind == 1 && left->vertex_count > 24 ? 2 : kind;
            assert_int_equal(operate(context, surgery, h, kind), MT_OK);
            mt_halfedge_destroy(context, left);
        }
        mt_halfedge_surgery_destroy(context, surgery);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(counts[0] > 1000 && counts[1] > 1000);
}

static void bad_elements_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true);
    mt_halfedge_surgery *surgery = begin(context, mesh);
    mt_index vertex = MT_NONE;
    assert_int_equal(mt_halfedge_split_edge(context, surgery, 0, 0.25, &vertex), MT_OK);
    assert_int_equal(mt_halfedge_can_swap_edge(surgery, 1000), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_halfedge_swap_edge(context, surgery, 1000), MT_ERROR_ARGUMENT);
    mt_halfedge_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void compaction_says_where_edges_went(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 5, 4, false);
    mt_halfedge_surgery *surgery = begin(context, mesh);
    test_random random = {5};
    for (int i = 0; i < 200; i++) {
        mt_index h = (mt_index)test_random_below(&random, surgery->structure.halfedge_count);
        assert_int_equal(operate(context, surgery, h, test_random_below(&random, 4)), MT_OK);
    }
    mt_surgery_map map;
    mt_halfedge_mesh *left = NULL;
    assert_int_equal(mt_halfedge_surgery_compact(context, surgery, &map, &left), MT_OK);
    const mt_halfedge_mesh *own = &surgery->structure;
    assert_int_equal(map.edge_count, own->halfedge_count / 2);
    mt_index next_edge = 0;
    for (mt_index h = 0; h < own->halfedge_count; h++) {
        mt_index edge = map.edges[h / 2];
        assert_int_equal(edge == MT_NONE, own->halfedges[h].head == MT_NONE);
        if (edge != MT_NONE) {
            assert_int_equal(edge, next_edge);
            next_edge += h % 2;
            assert_int_equal(left->halfedges[2 * edge + h % 2].head, map.vertices[own->halfedges[h].head]);
        }
    }
    assert_int_equal(2 * next_edge, left->halfedge_count);
    assert_true(left->halfedge_count < own->halfedge_count);
    mt_surgery_map_release(context, &map);
    mt_halfedge_destroy(context, left);
    mt_halfedge_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void a_log_that_is_off_costs_nothing_and_gives_nothing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true), *out = NULL;
    mt_halfedge_surgery *surgery = begin(context, mesh);
    surgery->log.is_off = true;
    assert_int_equal(mt_halfedge_split_edge(context, surgery, 0, 0.5, NULL), MT_OK);
    assert_true(surgery->log.count == 0 && surgery->log.edits == NULL);
    assert_int_equal(mt_halfedge_surgery_to_mesh(context, surgery, mesh, &out), MT_ERROR_ARGUMENT);
    assert_null(out);
    mt_halfedge_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void weights_lie_between_the_ends(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true);
    mt_halfedge_surgery *surgery = begin(context, mesh);
    const double bad[] = {-0.25, 1.5, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(mt_halfedge_split_edge(context, surgery, 0, bad[i], NULL), MT_ERROR_ARGUMENT);
        assert_int_equal(mt_halfedge_collapse_edge(context, surgery, 0, bad[i]), MT_ERROR_ARGUMENT);
    }
    assert_true(surgery->log.count == 0);
    mt_halfedge_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void a_tetrahedron_is_not_collapsed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const mt_index faces[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2};
    mt_mesh *mesh = test_mesh(context, 4, positions, 4, faces);
    mt_halfedge_surgery *surgery = begin(context, mesh);
    for (mt_index h = 0; h < 12; h++) {
        assert_int_equal(mt_halfedge_can_collapse_edge(surgery, h), MT_SURGERY_DUPLICATE_FACE);
        assert_int_equal(mt_halfedge_can_swap_edge(surgery, h >> 1), MT_SURGERY_EDGE_EXISTS);
    }
    mt_halfedge_surgery_destroy(context, surgery);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collapse_is_allowed_where_the_face_list_stays_manifold),
        cmocka_unit_test(bad_elements_are_refused),
        cmocka_unit_test(compaction_says_where_edges_went),
        cmocka_unit_test(a_log_that_is_off_costs_nothing_and_gives_nothing),
        cmocka_unit_test(weights_lie_between_the_ends),
        cmocka_unit_test(a_tetrahedron_is_not_collapsed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
