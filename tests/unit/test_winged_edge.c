/* What the winged-edge structure has for itself: the textbook's tetrahedron, its loops, numbers and directions of
 * edges, linked holes, and that its validation sees every kind of damage. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/winged_edge.h>

#include <string.h>

/* Fundamentals of Computer Graphics, figure 12.15: per edge its vertices, faces, and the predecessors and successors
 * around these. Row f is misprinted there: its successor on the left is a. */
typedef struct figure_row {
    char name, tail, head;
    mt_index left, right;
    char left_previous, left_next, right_previous, right_next;
} figure_row;

static const figure_row figure[6] = {
    {'a', 'A', 'D', 3, 0, 'f', 'e', 'c', 'b'}, {'b', 'A', 'B', 0, 2, 'a', 'c', 'd', 'f'},
    {'c', 'B', 'D', 0, 1, 'b', 'a', 'e', 'd'}, {'d', 'B', 'C', 1, 2, 'c', 'e', 'f', 'b'},
    {'e', 'C', 'D', 1, 3, 'd', 'c', 'a', 'f'}, {'f', 'C', 'A', 3, 2, 'e', 'a', 'b', 'd'},
};

static const double no_positions[3 * 64];

/* Faces 0 to 3 of the figure, A to D being vertices 0 to 3. */
static mt_mesh *tetrahedron(mt_context *context)
{
    static const mt_index faces[] = {3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 2, 1, 3, 0, 3, 2};
    return test_mesh(context, 4, no_positions, 4, faces);
}

static mt_winged_edge_mesh *build(mt_context *context, const mt_mesh *mesh)
{
    mt_winged_edge_mesh *structure = NULL;
    assert_int_equal(mt_winged_edge_create(context, mesh, &structure), MT_OK);
    return structure;
}

static mt_index find_edge(const mt_winged_edge_mesh *structure, mt_index a, mt_index b)
{
    mt_index found = MT_NONE;
    for (mt_index edge = 0; edge < structure->edge_count; edge++) {
        const mt_winged_edge *at = &structure->edges[edge];
        if ((at->tail == a && at->head == b) || (at->tail == b && at->head == a)) {
            assert_int_equal(found, MT_NONE);
            found = edge;
        }
    }
    return found;
}

static char edge_name(const mt_winged_edge_mesh *structure, mt_index edge)
{
    const mt_winged_edge *at = &structure->edges[edge];
    for (int i = 0; i < 6; i++) {
        mt_index tail = (mt_index)(figure[i].tail - 'A'), head = (mt_index)(figure[i].head - 'A');
        if ((at->tail == tail && at->head == head) || (at->tail == head && at->head == tail)) {
            return figure[i].name;
        }
    }
    return '?';
}

/* The edge may run the other way than in the figure: then its left is the figure's right. */
static mt_winged_edge turned_as_in_figure(const mt_winged_edge_mesh *structure, const figure_row *row)
{
    mt_index tail = (mt_index)(row->tail - 'A'), head = (mt_index)(row->head - 'A');
    mt_winged_edge edge = structure->edges[find_edge(structure, tail, head)];
    if (edge.tail == tail) {
        return edge;
    }
    return (mt_winged_edge){.tail = edge.head,
                            .head = edge.tail,
                            .left = edge.right,
                            .right = edge.left,
                            .lprev = edge.rprev,
                            .lnext = edge.rnext,
                            .rprev = edge.lprev,
                            .rnext = edge.lnext};
}

static void the_tetrahedron_of_the_textbook_comes_out(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = tetrahedron(context);
    mt_winged_edge_mesh *structure = build(context, mesh);
    assert_int_equal(structure->edge_count, 6);
    for (int i = 0; i < 6; i++) {
        const figure_row *row = &figure[i];
        mt_winged_edge edge = turned_as_in_figure(structure, row);
        assert_int_equal(edge.head, row->head - 'A');
        assert_int_equal(edge.left, row->left);
        assert_int_equal(edge.right, row->right);
        assert_int_equal(edge_name(structure, edge.lprev), row->left_previous);
        assert_int_equal(edge_name(structure, edge.lnext), row->left_next);
        assert_int_equal(edge_name(structure, edge.rprev), row->right_previous);
        assert_int_equal(edge_name(structure, edge.rnext), row->right_next);
    }
    for (mt_index vertex = 0; vertex < 4; vertex++) {
        const mt_winged_edge *own = &structure->edges[structure->vertex_edge[vertex]];
        assert_true(own->tail == vertex || own->head == vertex);
        const mt_winged_edge *side = &structure->edges[structure->face_edge[vertex]];
        assert_true(side->left == vertex || side->right == vertex);
    }
    mt_winged_edge_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Edges come in the order of their first corners, and run as those do: as half-edges 2e do. */
static void edges_are_numbered_by_their_first_corners(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {5};
    mt_mesh *mesh = test_cage(context, &random, 7, 5, false);
    mt_winged_edge_mesh *structure = build(context, mesh);
    mt_index next = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), sides = mt_mesh_face_sides(mesh, face);
        const mt_index *v = mesh->corner_vertices + begin;
        assert_int_equal(structure->face_edge[face], find_edge(structure, v[0], v[1]));
        for (mt_index i = 0; i < sides; i++) {
            mt_index edge = find_edge(structure, v[i], v[(i + 1) % sides]);
            assert_true(edge <= next);
            if (edge == next) {
                assert_int_equal(structure->edges[edge].tail, v[i]);
                assert_int_equal(structure->edges[edge].left, face);
                next++;
            } else {
                assert_int_equal(structure->edges[edge].right, face);
            }
        }
    }
    assert_int_equal(next, structure->edge_count);
    mt_winged_edge_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* Around a hole the edges follow each other, the outside to their left: clockwise around the faces. */
static void holes_are_linked_around(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true);
    mt_winged_edge_mesh *structure = build(context, mesh);
    mt_index begin = structure->vertex_edge[1], edge = begin, vertex = 1;
    assert_true(mt_winged_edge_is_boundary(structure, begin));
    assert_true(mt_winged_edge_vertex_is_boundary(structure, 1));
    assert_false(mt_winged_edge_vertex_is_boundary(structure, 0));
    for (mt_index step = 0; step < 6; step++) {
        assert_int_equal(structure->edges[edge].right, MT_NONE);
        assert_int_equal(structure->edges[edge].tail, vertex);
        edge = mt_winged_edge_previous(structure, edge, MT_NONE);
        vertex = vertex % 6 + 1;
    }
    assert_int_equal(edge, begin);
    assert_int_equal(mt_winged_edge_valence(structure, 0), 6);
    assert_int_equal(mt_winged_edge_valence(structure, 1), 3);
    mt_winged_edge_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void expect_damage(mt_context *context, mt_winged_edge_mesh *structure, mt_index *place, mt_index value,
                          const char *words)
{
    mt_index kept = *place;
    *place = value;
    mt_context_clear_error(context);
    assert_int_equal(mt_winged_edge_validate(context, structure), MT_ERROR_INTERNAL);
    if (!strstr(mt_context_error(context)->message, words)) {
        fail_msg("\"%s\" does not say \"%s\"", mt_context_error(context)->message, words);
    }
    *place = kept;
    mt_context_clear_error(context);
    assert_int_equal(mt_winged_edge_validate(context, structure), MT_OK);
}

static void every_damage_is_seen_and_located(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 6, true);
    mt_winged_edge_mesh *structure = build(context, mesh);
    mt_winged_edge *edge = &structure->edges[3];
    expect_damage(context, structure, &edge->head, 7, "edge 3 runs from vertex");
    expect_damage(context, structure, &edge->head, edge->tail, "edge 3 runs from vertex");
    expect_damage(context, structure, &edge->left, 6, "edge 3 lies between faces 6");
    expect_damage(context, structure, &edge->left, edge->right, "edge 3 lies between faces");
    expect_damage(context, structure, &edge->lprev, 12, "edge 3 has edge 12 of 12 as a wing");
    mt_index *fields[] = {&edge->head, &edge->left, &edge->lprev, &edge->lnext, &edge->rprev, &edge->rnext};
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        expect_damage(context, structure, fields[i], (*fields[i] + 2) % 6, "edge");
    }
    expect_damage(context, structure, &structure->face_edge[2], 0, "face 2 has edge 0");
    expect_damage(context, structure, &structure->vertex_edge[0], 1, "vertex 0 has edge 1");
    expect_damage(context, structure, &structure->vertex_edge[0], MT_NONE, "vertex 0 meets 0 of its 6");
    expect_damage(context, structure, &structure->vertex_edge[1], 0, "vertex 1 on the boundary does not begin there");
    mt_winged_edge_destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_tetrahedron_of_the_textbook_comes_out),
        cmocka_unit_test(edges_are_numbered_by_their_first_corners),
        cmocka_unit_test(holes_are_linked_around),
        cmocka_unit_test(every_damage_is_seen_and_located),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
