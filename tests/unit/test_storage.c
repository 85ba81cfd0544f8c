/* Storage by formula beside what the context counts when it is built: the same but for each structure's own record. */
#include "tests/support/unit.h"

#include "tests/support/cage.h"
#include "tests/support/laden_mesh.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/generate.h>
#include <meshtool/halfedge.h>
#include <meshtool/storage.h>
#include <meshtool/strips.h>
#include <meshtool/triangle_neighbor.h>
#include <meshtool/triangulate.h>
#include <meshtool/winged_edge.h>

#define EDGE_BYTES 32 /* the larger of a winged edge and a pair of half-edges */

/* Bytes of the records on top of the arrays. */
static const uint64_t records[MT_STORAGE_COUNT] = {[MT_STORAGE_INDEXED_MESH] = sizeof(mt_mesh),
                                                   [MT_STORAGE_INDEXED_POLYGONS] = sizeof(mt_mesh),
                                                   [MT_STORAGE_TRIANGLE_NEIGHBOR] = sizeof(mt_triangle_neighbor_mesh),
                                                   [MT_STORAGE_WINGED_EDGE] = sizeof(mt_winged_edge_mesh),
                                                   [MT_STORAGE_HALF_EDGE] = sizeof(mt_halfedge_mesh)};

/* Half-edges and winged edges are built in one pass, before the number of edges is known, into room for one in 64
 * corners and 16 more than a closed mesh has. */
static uint64_t spare_bytes(const mt_mesh *mesh, mt_storage_kind kind)
{
    bool of_edges = kind == MT_STORAGE_WINGED_EDGE || kind == MT_STORAGE_HALF_EDGE;
    return of_edges ? EDGE_BYTES * ((uint64_t)mesh->corner_count / 64 + 16) : 0;
}

static uint64_t count_edges(mt_context *context, const mt_mesh *mesh)
{
    mt_edge_pairs *pairs;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    uint64_t count = pairs->edge_count;
    mt_edge_pairs_destroy(context, pairs);
    return count;
}

/* Their number is not known before they are built: all the strips one by one, and a restart between each two. */
static uint64_t count_strip_bytes(mt_context *context, const mt_mesh *mesh, mt_strip_kind kind)
{
    mt_strip_options options = {.kind = kind, .join = MT_STRIP_JOIN_RESTART};
    mt_strips *strips = NULL;
    assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_OK);
    uint64_t indices = strips->strip_count - 1;
    for (mt_index i = 0; i < strips->strip_count; i++) {
        indices += strips->offsets[i + 1] - strips->offsets[i];
    }
    mt_strips_destroy(context, strips);
    return 4 * indices + 3 * mt_type_size(mesh->position_type) * (uint64_t)mesh->vertex_count;
}

static void expect_strips_measured(mt_context *context, const mt_mesh *mesh)
{
    uint64_t strips = 0, fans = 0;
    assert_int_equal(mt_storage_measure(context, mesh, MT_STORAGE_TRIANGLE_STRIPS, &strips), MT_OK);
    assert_int_equal(mt_storage_measure(context, mesh, MT_STORAGE_TRIANGLE_FANS, &fans), MT_OK);
    assert_int_equal(strips, count_strip_bytes(context, mesh, MT_STRIP_KIND_STRIP));
    assert_int_equal(fans, count_strip_bytes(context, mesh, MT_STRIP_KIND_FAN));
    mt_storage least = mt_storage_by_formula(mesh, MT_STORAGE_TRIANGLE_STRIPS, MT_STORAGE_CLOSED);
    assert_true(strips >= mt_storage_bytes(mesh, &least));
}

static void expect_measured(mt_context *context, const mt_mesh *mesh)
{
    expect_strips_measured(context, mesh);
    for (mt_storage_kind kind = 0; kind < MT_STORAGE_COUNT; kind++) {
        if (kind == MT_STORAGE_TRIANGLE_STRIPS || kind == MT_STORAGE_TRIANGLE_FANS) {
            continue;
        }
        mt_storage storage = mt_storage_by_formula(mesh, kind, count_edges(context, mesh));
        uint64_t bytes = 0, before = mt_context_bytes(context);
        assert_int_equal(mt_storage_measure(context, mesh, kind, &bytes), MT_OK);
        assert_int_equal(mt_context_bytes(context), before);
        uint64_t formula = mt_storage_bytes(mesh, &storage) + records[kind];
        if (bytes < formula || bytes > formula + spare_bytes(mesh, kind) || (bytes - formula) % 8 != 0) {
            fail_msg("%s: %llu bytes measured, %llu by formula", storage.key, (unsigned long long)bytes,
                     (unsigned long long)mt_storage_bytes(mesh, &storage));
        }
    }
}

static void test_formulas_are_measured(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {61};
    for (mt_index trial = 0; trial < 12; trial++) {
        mt_mesh *mesh = trial % 3 == 2 ? test_cage(context, &random, 5, 4, trial % 2)
                                       : test_triangle_cage(context, &random, 5, 4, trial % 2);
        if (trial % 4 == 3) {
            assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F32, NULL), MT_OK);
        }
        expect_measured(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    mt_mesh *laden; /* what it carries is not counted */
    assert_int_equal(test_laden_mesh(context, &laden), MT_OK);
    expect_measured(context, laden);
    mt_mesh_destroy(context, laden);
    test_context_end(context);
}

/* The notes' units of a tetrahedron: 4 vertices, 4 triangles, 6 edges. */
static void test_tetrahedron(void **state)
{
    (void)state;
    const uint64_t units[MT_STORAGE_COUNT] = {36, 24, 24, 18, 18, 40, 40, 68, 56};
    mt_context *context = test_context();
    mt_mesh *mesh;
    assert_int_equal(mt_generate(context, "tetrahedron", NULL, &mesh), MT_OK);
    for (mt_storage_kind kind = 0; kind < MT_STORAGE_COUNT; kind++) {
        mt_storage closed = mt_storage_by_formula(mesh, kind, MT_STORAGE_CLOSED);
        mt_storage counted = mt_storage_by_formula(mesh, kind, 6);
        assert_int_equal(mt_storage_units(&closed), units[kind]);
        assert_int_equal(mt_storage_units(&counted), units[kind]);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void test_refused_and_failing(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0};
    const mt_index book[] = {3, 0, 1, 2, 3, 0, 1, 3, 3, 0, 1, 4};
    mt_mesh *mesh = test_mesh(context, 5, points, 3, book);
    uint64_t bytes;
    assert_int_equal(mt_storage_measure(context, mesh, MT_STORAGE_INDEXED_MESH, &bytes), MT_OK);
    for (mt_storage_kind kind = MT_STORAGE_TRIANGLE_NEIGHBOR; kind < MT_STORAGE_COUNT; kind++) {
        assert_int_equal(mt_storage_measure(context, mesh, kind, &bytes), MT_ERROR_NOT_MANIFOLD);
        mt_context_clear_error(context);
    }
    mt_mesh_destroy(context, mesh);
    mesh = test_cube(context);
    for (mt_storage_kind kind = 0; kind < MT_STORAGE_COUNT; kind++) {
        for (uint64_t failing = 1;; failing++) {
            mt_context_options options = {.failing_allocation = failing};
            mt_context *other = mt_context_create(&options);
            mt_status status = mt_storage_measure(other, mesh, kind, &bytes);
            test_context_end(other);
            if (status == MT_OK) {
                break;
            }
            assert_int_equal(status, MT_ERROR_OUT_OF_MEMORY);
        }
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_formulas_are_measured),
        cmocka_unit_test(test_tetrahedron),
        cmocka_unit_test(test_refused_and_failing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
