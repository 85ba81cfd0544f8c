/* Surgery on half-edges: random sequences keep every invariant, collapse is allowed just where the face list stays a
 * manifold of the same shape, and positions follow. */
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

static void random_operations_keep_the_invariants(void **state)
{
    (void)state;
    for (int which = 0; which < 3; which++) {
        mt_context *context = test_context();
        mt_mesh *mesh = starting_mesh(context, which);
        mt_halfedge_surgery *surgery = begin(context, mesh);
        int64_t shape = euler(&surgery->structure);
        test_random random = {7 + (uint64_t)which};
        for (int i = 0; i < 10000; i++) {
            mt_index h = (mt_index)test_random_below(&random, surgery->structure.halfedge_count);
            uint64_t kinds = i / 500 % 2 ? 2 : 4;
            assert_int_equal(operate(context, surgery, h, test_random_below(&random, kinds)), MT_OK);
            if (i % 50 == 0) {
                mt_halfedge_mesh *left = NULL;
                assert_int_equal(compact(context, surgery, &left), MT_OK);
                assert_true(euler(left) == shape);
                mt_halfedge_destroy(context, left);
            }
        }
        mt_halfedge_surgery_destroy(context, surgery);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void edits_mix_their_parents(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true);
    mt_halfedge_surgery *surgery = begin(context, mesh);
    mt_index vertex = MT_NONE;
    mt_index tail = surgery->structure.halfedges[1].head, head = surgery->structure.halfedges[0].head;
    assert_int_equal(mt_halfedge_split_edge(context, surgery, 0, 0.25, &vertex), MT_OK);
    double values[16] = {0};
    values[tail] = 4;
    values[head] = 8;
    mt_edit_log_replay(&surgery->log, MT_DOMAIN_VERTEX, MT_INTERPOLATE_LINEAR, 1, values);
    assert_true(values[vertex] == 5);
    assert_int_equal(mt_halfedge_can_swap_edge(surgery, 1000), MT_SURGERY_NO_ELEMENT);
    assert_int_equal(mt_halfedge_swap_edge(context, surgery, 1000), MT_ERROR_ARGUMENT);
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
        cmocka_unit_test(random_operations_keep_the_invariants),
        cmocka_unit_test(edits_mix_their_parents),
        cmocka_unit_test(a_tetrahedron_is_not_collapsed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
