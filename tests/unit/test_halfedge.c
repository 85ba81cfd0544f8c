/* The half-edge structure: what it holds comes back, what it cannot hold is refused by name, and validate sees every
 * broken link. */
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/components.h>
#include <meshtool/degenerate_faces.h>
#include <meshtool/edge_pairs.h>
#include <meshtool/generate.h>
#include <meshtool/halfedge.h>
#include <meshtool/vertex_fans.h>

#include <stdlib.h>
#include <string.h>

/* What the builder must say, decided by the definitions. */
static mt_status expected_status(mt_context *context, const mt_mesh *mesh)
{
    uint8_t *flags = mt_allocate(context, mesh->face_count);
    mt_index degenerate_count = 0;
    assert_int_equal(mt_find_degenerate_faces(context, mesh, flags, &degenerate_count), MT_OK);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    mt_vertex_fans *fans = NULL;
    assert_int_equal(mt_vertex_fans_create(context, mesh, pairs, flags, &fans), MT_OK);
    mt_status status = MT_OK;
    if (degenerate_count || pairs->non_manifold_count) {
        status = MT_ERROR_NOT_MANIFOLD;
    } else if (pairs->misoriented_count) {
        status = MT_ERROR_NOT_ORIENTED;
    } else if (fans->several_count) {
        status = MT_ERROR_NOT_MANIFOLD;
    }
    mt_vertex_fans_destroy(context, fans);
    mt_edge_pairs_destroy(context, pairs);
    mt_free(context, flags);
    return status;
}

static void expect_rings(const mt_halfedge_mesh *structure)
{
    for (mt_index v = 0; v < structure->vertex_count; v++) {
        mt_index begin = structure->vertex_halfedge[v];
        mt_index valence = mt_halfedge_valence(structure, v);
        mt_index h = begin;
        for (mt_index i = 0; i < valence; i++) {
            assert_int_equal(mt_halfedge_head(structure, h), v);
            assert_int_equal(mt_halfedge_next(structure, mt_halfedge_previous(structure, h)), h);
            assert_int_equal(mt_halfedge_counterclockwise(structure, mt_halfedge_clockwise(structure, h)), h);
            h = mt_halfedge_clockwise(structure, h);
        }
        assert_int_equal(h, begin);
    }
}

static mt_index faces_beside(const mt_halfedge_mesh *structure, mt_index edge)
{
    return (mt_index)!mt_halfedge_is_boundary(structure, 2 * edge) +
           (mt_index)!mt_halfedge_is_boundary(structure, 2 * edge + 1);
}

/* Edges in the order of their first corners, the even half-edge the side of that corner. */
static void expect_numbering(mt_context *context, const mt_mesh *mesh, const mt_halfedge_mesh *structure)
{
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    mt_index edge = 0;
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        if (mt_edge_is_first(pairs, c)) {
            assert_int_equal(mt_halfedge_face(structure, 2 * edge), mt_mesh_corner_face(mesh, c));
            assert_int_equal(mt_halfedge_tail(structure, 2 * edge), mesh->corner_vertices[c]);
            bool boundary = mt_edge_class_of(mesh, pairs, c) == MT_EDGE_BOUNDARY;
            assert_int_equal(faces_beside(structure, edge), boundary ? 1 : 2);
            assert_int_equal(mt_halfedge_edge_is_boundary(structure, edge), boundary);
            edge++;
        }
    }
    assert_int_equal(structure->halfedge_count, 2 * edge);
    mt_edge_pairs_destroy(context, pairs);
}

static void expect_round_trip(mt_context *context, const mt_mesh *mesh, const mt_halfedge_mesh *structure)
{
    mt_mesh *back = NULL;
    assert_int_equal(mt_halfedge_to_mesh(context, structure, mesh, &back), MT_OK);
    assert_int_equal(back->face_count, mesh->face_count);
    assert_int_equal(back->corner_count, mesh->corner_count);
    assert_memory_equal(back->corner_vertices, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
    for (mt_index face = 0; face < mesh->face_count; face++) {
        assert_int_equal(mt_mesh_face_end(back, face), mt_mesh_face_end(mesh, face));
    }
    assert_memory_equal(back->positions, mesh->positions, 24 * (size_t)mesh->vertex_count);
    mt_mesh_destroy(context, back);
}

static bool expect_build(mt_context *context, const mt_mesh *mesh)
{
    mt_halfedge_mesh *structure = NULL;
    mt_status expected = expected_status(context, mesh);
    assert_int_equal(mt_halfedge_create(context, mesh, &structure), expected);
    if (expected != MT_OK) {
        assert_null(structure);
        assert_true(strlen(mt_context_error(context)->message) > 20);
        mt_context_clear_error(context);
        return false;
    }
    assert_int_equal(mt_halfedge_validate(context, structure), MT_OK);
    expect_rings(structure);
    expect_numbering(context, mesh, structure);
    expect_round_trip(context, mesh, structure);
    mt_halfedge_destroy(context, structure);
    return true;
}

static void random_meshes_are_built_or_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {99};
    int built = 0;
    for (int i = 0; i < 6000; i++) {
        mt_mesh *mesh = i % 3 ? test_patch(context, &random) : test_soup(context, &random);
        built += expect_build(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    assert_in_range(built, 500, 5500);
    test_context_end(context);
}

static void expect_refusal(mt_index vertex_count, mt_index face_count, const mt_index *faces, mt_status status,
                           const char *words)
{
    mt_context *context = test_context();
    double positions[30] = {0};
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, face_count, faces);
    mt_halfedge_mesh *structure = NULL;
    assert_int_equal(mt_halfedge_create(context, mesh, &structure), status);
    assert_null(structure);
    if (!strstr(mt_context_error(context)->message, words)) {
        fail_msg("\"%s\" does not say \"%s\"", mt_context_error(context)->message, words);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void refusals_name_the_first_offender(void **state)
{
    (void)state;
    const mt_index book[] = {3, 0, 1, 2, 3, 1, 0, 3, 3, 0, 1, 4};
    expect_refusal(5, 3, book, MT_ERROR_NOT_MANIFOLD, "edge 0-1 is shared by 3 faces (0, 1, 2)");
    expect_refusal(5, 3, book, MT_ERROR_NOT_MANIFOLD, "repair --split");
    const mt_index flipped[] = {3, 0, 1, 2, 3, 0, 1, 3};
    expect_refusal(4, 2, flipped, MT_ERROR_NOT_ORIENTED, "faces 0, 1 run along edge 0-1 in the same direction");
    expect_refusal(4, 2, flipped, MT_ERROR_NOT_ORIENTED, "repair --orient");
    const mt_index bow_tie[] = {3, 0, 1, 2, 3, 2, 3, 4};
    expect_refusal(5, 2, bow_tie, MT_ERROR_NOT_MANIFOLD, "vertex 2 alone");
    const mt_index doubled[] = {3, 0, 1, 2, 4, 0, 3, 1, 3};
    expect_refusal(4, 2, doubled, MT_ERROR_NOT_MANIFOLD, "face 1 names vertex 3 more than once");
    const mt_index folded[] = {3, 0, 0, 1};
    expect_refusal(2, 1, folded, MT_ERROR_NOT_MANIFOLD, "face 0 names vertex 0 more than once");
    const mt_index strip[] = {4, 0, 1, 4, 3, 4, 1, 2, 5, 4, 4, 2, 3, 0, 5};
    expect_refusal(6, 3, strip, MT_ERROR_NOT_ORIENTED, "only one side");
}

static void two_closed_fans_at_a_vertex_are_refused(void **state)
{
    (void)state;
    const mt_index tetrahedra[] = {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 1, 3, 1, 3, 2,
                                   3, 0, 4, 5, 3, 0, 5, 6, 3, 0, 6, 4, 3, 4, 6, 5};
    expect_refusal(7, 8, tetrahedra, MT_ERROR_NOT_MANIFOLD, "vertex 0 alone");
}

static mt_halfedge_mesh *build_torus(mt_context *context, mt_index columns, mt_index rows, bool shuffled)
{
    mt_mesh *mesh = test_torus(context, columns, rows, shuffled);
    mt_halfedge_mesh *structure = NULL;
    assert_int_equal(mt_halfedge_create(context, mesh, &structure), MT_OK);
    mt_mesh_destroy(context, mesh);
    return structure;
}

static void validate_sees_every_broken_link(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {5};
    for (int i = 0; i < 2000; i++) {
        mt_mesh *fan = test_fan(context, 7, false);
        mt_halfedge_mesh *structure = NULL;
        assert_int_equal(mt_halfedge_create(context, fan, &structure), MT_OK);
        mt_halfedge *own = &structure->halfedges[test_random_below(&random, structure->halfedge_count)];
        mt_index *fields[] = {&own->next, &own->head, &own->face,
                              &structure->face_halfedge[test_random_below(&random, structure->face_count)]};
        mt_index *field = fields[i % 4];
        mt_index before = *field;
        *field = (mt_index)test_random_below(&random, structure->halfedge_count + 2u);
        bool same_face = i % 4 == 3 && *field < structure->halfedge_count &&
                         mt_halfedge_face(structure, *field) == (mt_index)(field - structure->face_halfedge);
        mt_status expected = *field == before || same_face ? MT_OK : MT_ERROR_INTERNAL;
        assert_int_equal(mt_halfedge_validate(context, structure), expected);
        mt_context_clear_error(context);
        mt_halfedge_destroy(context, structure);
        mt_mesh_destroy(context, fan);
    }
    test_context_end(context);
}

static uint64_t hash_structure(const mt_halfedge_mesh *structure)
{
    uint64_t sum = test_hash(structure->halfedges, structure->halfedge_count * sizeof *structure->halfedges);
    sum = sum * 31 + test_hash(structure->vertex_halfedge, structure->vertex_count * sizeof(mt_index));
    return sum * 31 + test_hash(structure->face_halfedge, structure->face_count * sizeof(mt_index));
}

static void large_meshes_are_built_alike_on_any_threads(void **state)
{
    (void)state;
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        uint64_t first = 0;
        for (unsigned threads = 1; threads <= 7; threads += 3) {
            mt_context *context = test_context_with_threads(threads);
            mt_halfedge_mesh *structure = build_torus(context, 300, 200, shuffled);
            assert_int_equal(structure->halfedge_count, 6 * 300 * 200);
            assert_int_equal(mt_halfedge_validate(context, structure), MT_OK);
            uint64_t hash = hash_structure(structure);
            first = threads == 1 ? hash : first;
            assert_true(hash == first);
            mt_halfedge_destroy(context, structure);
            test_context_end(context);
        }
    }
}

/* 42 bytes a triangle on a closed mesh, and some room for boundaries. */
static void the_structure_is_small(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_halfedge_mesh *structure = build_torus(context, 300, 200, false);
    assert_true(mt_context_bytes(context) <= (uint64_t)structure->face_count * 45);
    assert_true(mt_halfedge_size(structure) <= (uint64_t)structure->face_count * 42 + 64);
    mt_halfedge_destroy(context, structure);
    test_context_end(context);
}

static void a_vertex_of_a_million_edges_is_built(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (int closed = 0; closed < 2; closed++) {
        mt_mesh *fan = test_fan(context, 1000000, closed);
        mt_halfedge_mesh *structure = NULL;
        assert_int_equal(mt_halfedge_create(context, fan, &structure), MT_OK);
        assert_int_equal(mt_halfedge_valence(structure, 0), closed ? 1000000 : 1000001);
        assert_int_equal(mt_halfedge_validate(context, structure), MT_OK);
        mt_halfedge_destroy(context, structure);
        mt_mesh_destroy(context, fan);
    }
    test_context_end(context);
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    bool done = false;
    for (uint64_t nth = 1; !done; nth++) {
        mt_context *maker = test_context();
        test_random random = {nth};
        mt_mesh *mesh = nth % 2 ? test_fan(maker, 50, true) : test_soup(maker, &random);
        mt_context_options options = {.failing_allocation = nth};
        mt_context *context = mt_context_create(&options);
        mt_halfedge_mesh *structure = NULL;
        mt_status status = mt_halfedge_create(context, mesh, &structure);
        mt_mesh *back = NULL;
        if (status == MT_OK) {
            status = mt_halfedge_validate(context, structure);
        }
        if (status == MT_OK) {
            status = mt_halfedge_to_mesh(context, structure, mesh, &back);
        }
        assert_true(status == MT_OK || mt_context_error(context)->status == status);
        done = status == MT_OK && nth > 40;
        mt_mesh_destroy(context, back);
        mt_halfedge_destroy(context, structure);
        test_context_end(context);
        mt_mesh_destroy(maker, mesh);
        test_context_end(maker);
        assert_true(nth < 200);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_meshes_are_built_or_refused),
        cmocka_unit_test(refusals_name_the_first_offender),
        cmocka_unit_test(two_closed_fans_at_a_vertex_are_refused),
        cmocka_unit_test(validate_sees_every_broken_link),
        cmocka_unit_test(large_meshes_are_built_alike_on_any_threads),
        cmocka_unit_test(the_structure_is_small),
        cmocka_unit_test(a_vertex_of_a_million_edges_is_built),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
