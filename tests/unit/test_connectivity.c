/* All connectivity structures against one another and against rings read from the faces by brute force. */
#include "tests/support/cage.h"
#include "tests/support/census.h"
#include "tests/support/connectivity.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/triangulate.h>

#include <stdlib.h>
#include <string.h>

static bool is_triangles(const mt_mesh *mesh)
{
    bool triangles = true;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        triangles = triangles && mt_mesh_face_sides(mesh, face) == 3;
    }
    return triangles;
}

/* A face around a vertex: from one neighbour to the next, counter-clockwise. */
typedef struct sector {
    mt_index from, to, face;
} sector;

static mt_index list_sectors(const mt_mesh *mesh, mt_index vertex, sector *sectors)
{
    mt_index count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), sides = mt_mesh_face_sides(mesh, face);
        const mt_index *v = mesh->corner_vertices + begin;
        for (mt_index i = 0; i < sides; i++) {
            if (v[i] == vertex) {
                assert_true(count < TEST_RING_ROOM);
                sectors[count++] = (sector){v[(i + 1) % sides], v[(i + sides - 1) % sides], face};
            }
        }
    }
    return count;
}

/* The ring from the faces: it begins where no face comes before, or anywhere. */
static void expected_ring(const mt_mesh *mesh, mt_index vertex, test_ring *ring)
{
    static sector sectors[TEST_RING_ROOM];
    mt_index count = list_sectors(mesh, vertex, sectors);
    ring->count = 0;
    mt_index at = 0;
    for (mt_index i = 0; i < count; i++) {
        bool follows = false;
        for (mt_index j = 0; j < count; j++) {
            follows = follows || sectors[j].to == sectors[i].from;
        }
        at = follows ? at : i;
    }
    for (mt_index begin = at, found = count; found < TEST_RING_ROOM && count;) {
        ring->spokes[ring->count++] = (test_spoke){sectors[at].from, sectors[at].face};
        mt_index to = sectors[at].to;
        for (at = 0; at < count && sectors[at].from != to; at++) {
        }
        if (at == count) {
            ring->spokes[ring->count++] = (test_spoke){to, MT_NONE};
        }
        found = at == count || at == begin ? TEST_RING_ROOM : found;
    }
}

static bool same_spoke(test_spoke a, test_spoke b)
{
    return a.neighbor == b.neighbor && a.face == b.face;
}

/* The same ring; closed ones may begin anywhere. */
static void expect_same_ring(const test_ring *ring, const test_ring *expected)
{
    assert_int_equal(ring->count, expected->count);
    mt_index turn = 0;
    bool closed = expected->count && expected->spokes[expected->count - 1].face != MT_NONE;
    while (closed && turn + 1 < expected->count && !same_spoke(ring->spokes[0], expected->spokes[turn])) {
        turn++;
    }
    for (mt_index i = 0; i < ring->count; i++) {
        assert_true(same_spoke(ring->spokes[i], expected->spokes[(i + turn) % expected->count]));
    }
}

static void expect_reversed(const test_ring *ring, const test_ring *forward)
{
    assert_int_equal(ring->count, forward->count);
    for (mt_index i = 0; i < ring->count; i++) {
        assert_true(same_spoke(ring->spokes[i], forward->spokes[ring->count - 1 - i]));
    }
}

static mt_index expected_across(const mt_mesh *mesh, mt_index tail, mt_index head)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        const mt_index *v = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
        for (mt_index i = 0; i < sides; i++) {
            if (v[i] == head && v[(i + 1) % sides] == tail) {
                return face;
            }
        }
    }
    return MT_NONE;
}

static void expect_face(const test_structure *kind, const void *structure, const mt_mesh *mesh, mt_index face)
{
    static test_ring ring, backward;
    mt_index sides = mt_mesh_face_sides(mesh, face);
    const mt_index *v = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
    ring.count = backward.count = 0;
    kind->face_ring(structure, face, false, &ring);
    kind->face_ring(structure, face, true, &backward);
    assert_int_equal(ring.count, sides);
    assert_int_equal(backward.count, sides);
    for (mt_index i = 0; i < sides; i++) {
        test_spoke side = {v[i], expected_across(mesh, v[i], v[(i + 1) % sides])};
        assert_true(same_spoke(ring.spokes[i], side));
        assert_true(same_spoke(backward.spokes[(sides - i) % sides], side));
    }
}

static void expect_faces_back(const mt_mesh *mesh, const mt_mesh *back)
{
    assert_int_equal(back->face_count, mesh->face_count);
    assert_int_equal(back->corner_count, mesh->corner_count);
    assert_memory_equal(back->corner_vertices, mesh->corner_vertices, mesh->corner_count * sizeof(mt_index));
    for (mt_index face = 0; face < mesh->face_count; face++) {
        assert_int_equal(mt_mesh_face_end(back, face), mt_mesh_face_end(mesh, face));
    }
    size_t size = 3 * (size_t)mesh->vertex_count * mt_type_size(mesh->position_type);
    assert_memory_equal(back->positions, mesh->positions, size);
}

static void expect_structure(mt_context *context, const test_structure *kind, const mt_mesh *mesh)
{
    static test_ring expected, ring, backward;
    void *structure = NULL;
    assert_int_equal(kind->create(context, mesh, &structure), MT_OK);
    assert_int_equal(kind->validate(context, structure), MT_OK);
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        expected_ring(mesh, vertex, &expected);
        ring.count = backward.count = 0;
        kind->vertex_ring(structure, vertex, false, &ring);
        kind->vertex_ring(structure, vertex, true, &backward);
        expect_same_ring(&ring, &expected);
        expect_reversed(&backward, &ring);
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        expect_face(kind, structure, mesh, face);
    }
    mt_mesh *back = NULL;
    assert_int_equal(kind->to_mesh(context, structure, mesh, &back), MT_OK);
    assert_int_equal(mt_mesh_validate(context, back), MT_OK);
    expect_faces_back(mesh, back);
    mt_mesh_destroy(context, back);
    kind->destroy(context, structure);
}

/* What the definitions say that no structure may take. */
static mt_status expected_status(const mt_mesh *mesh)
{
    test_census census = test_census_of(mesh);
    if (census.degenerate_faces || census.non_manifold_edges) {
        return MT_ERROR_NOT_MANIFOLD;
    }
    if (census.misoriented_edges) {
        return MT_ERROR_NOT_ORIENTED;
    }
    return census.non_manifold_vertices ? MT_ERROR_NOT_MANIFOLD : MT_OK;
}

static void expect_refusal(mt_context *context, const test_structure *kind, const mt_mesh *mesh, mt_status status,
                           char message[1024])
{
    void *structure = &structure;
    mt_context_clear_error(context);
    assert_int_equal(kind->create(context, mesh, &structure), status);
    assert_null(structure);
    assert_int_equal(mt_context_error(context)->status, status);
    char offender[1024]; /* what comes before the first semicolon; who needs it otherwise comes after */
    strcpy(offender, mt_context_error(context)->message);
    offender[strcspn(offender, ";")] = 0;
    if (*message) {
        assert_string_equal(offender, message);
    }
    strcpy(message, offender);
    mt_context_clear_error(context);
}

/* Returns whether the mesh could be held. */
static bool expect_mesh(mt_context *context, const mt_mesh *mesh)
{
    mt_status status = expected_status(mesh);
    char message[1024] = "";
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        const test_structure *kind = &test_structures[i];
        if (kind->triangles_only && !is_triangles(mesh)) {
            char polygons[1024] = "";
            expect_refusal(context, kind, mesh, MT_ERROR_INVALID_MESH, polygons);
        } else if (status != MT_OK) {
            expect_refusal(context, kind, mesh, status, message);
        } else {
            expect_structure(context, kind, mesh);
        }
    }
    return status == MT_OK;
}

static mt_mesh *random_mesh(mt_context *context, test_random *random, int turn)
{
    mt_index columns = 3 + (mt_index)test_random_below(random, 6), rows = 3 + (mt_index)test_random_below(random, 6);
    mt_mesh *mesh = turn % 4 == 0   ? test_soup(context, random)
                    : turn % 4 == 3 ? test_cage(context, random, columns, rows, turn % 8 == 3)
                                    : test_patch(context, random);
    if (turn % 2) {
        mt_mesh *triangles = NULL;
        assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
        mt_mesh_destroy(context, mesh);
        mesh = triangles;
    }
    return mesh;
}

static void structures_agree_with_the_faces(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {31};
    int held = 0, refused = 0;
    for (int turn = 0; turn < 2000; turn++) {
        mt_mesh *mesh = random_mesh(context, &random, turn);
        bool is_held = expect_mesh(context, mesh);
        held += is_held;
        refused += !is_held;
        mt_mesh_destroy(context, mesh);
    }
    assert_true(held > 500);
    assert_true(refused > 500);
    test_context_end(context);
}

static void small_meshes_are_held(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    const mt_index triangle[] = {3, 0, 1, 2}, pillow[] = {3, 0, 1, 2, 3, 2, 1, 0};
    mt_mesh *meshes[] = {test_mesh(context, 0, positions, 0, NULL), test_mesh(context, 1, positions, 0, NULL),
                         test_mesh(context, 4, positions, 1, triangle), test_mesh(context, 3, positions, 2, pillow)};
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        assert_true(expect_mesh(context, meshes[i]));
        mt_mesh_destroy(context, meshes[i]);
    }
    test_context_end(context);
}

/* Validation and the way back to a mesh, where rings by brute force would take too long. */
static void expect_round_trip(mt_context *context, const test_structure *kind, const mt_mesh *mesh)
{
    void *structure = NULL;
    mt_mesh *back = NULL;
    assert_int_equal(kind->create(context, mesh, &structure), MT_OK);
    assert_int_equal(kind->validate(context, structure), MT_OK);
    assert_int_equal(kind->to_mesh(context, structure, mesh, &back), MT_OK);
    expect_faces_back(mesh, back);
    mt_mesh_destroy(context, back);
    kind->destroy(context, structure);
}

/* Large meshes in a random order are built another way than small ones: polygons with a boundary, and bad ones. */
static void large_shuffled_meshes_are_held_or_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {6};
    mt_mesh *cage = test_cage(context, &random, 220, 220, false);
    mt_index *images = malloc(cage->corner_count * sizeof *images);
    assert_non_null(images);
    mt_mesh *mesh = test_renumbered(context, &random, cage, false, images);
    mt_mesh *triangles = test_torus(context, 400, 50, true);
    triangles->face_count--; /* a hole */
    triangles->corner_count -= 3;
    assert_true(mesh->corner_count > 100000);
    assert_true(triangles->corner_count > 100000);
    char message[1024] = "";
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        const test_structure *kind = &test_structures[i];
        expect_round_trip(context, kind, kind->triangles_only ? triangles : mesh);
        expect_round_trip(context, kind, triangles);
    }
    mt_index last = triangles->corner_count - 1;
    triangles->corner_vertices[last] = triangles->corner_vertices[0];
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        expect_refusal(context, &test_structures[i], triangles, MT_ERROR_NOT_MANIFOLD, message);
    }
    free(images);
    mt_mesh_destroy(context, triangles);
    mt_mesh_destroy(context, mesh);
    mt_mesh_destroy(context, cage);
    test_context_end(context);
}

static uint64_t hash_on(const test_structure *kind, unsigned threads, bool shuffled)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 301, 100, shuffled);
    void *structure = NULL;
    assert_int_equal(kind->create(context, mesh, &structure), MT_OK);
    assert_int_equal(kind->validate(context, structure), MT_OK);
    uint64_t hash = kind->hash(structure);
    kind->destroy(context, structure);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return hash;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2 * TEST_STRUCTURE_COUNT; i++) {
        const test_structure *kind = &test_structures[i / 2];
        uint64_t one = hash_on(kind, 1, i % 2);
        assert_true(hash_on(kind, 2, i % 2) == one);
        assert_true(hash_on(kind, 7, i % 2) == one);
    }
}

static void a_closed_triangle_mesh_takes_the_bytes_that_were_promised(void **state)
{
    (void)state;
    static const unsigned bytes_per_triangle[TEST_STRUCTURE_COUNT] = {44, 56, 26};
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 200, 100, false);
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        const test_structure *kind = &test_structures[i];
        void *structure = NULL;
        uint64_t before = mt_context_bytes(context);
        assert_int_equal(kind->create(context, mesh, &structure), MT_OK);
        uint64_t held = mt_context_bytes(context) - before;
        assert_true(kind->size(structure) <= held);
        assert_true(held <= bytes_per_triangle[i] * (uint64_t)mesh->face_count + 64);
        kind->destroy(context, structure);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void expect_clean_failures(const test_structure *kind, const mt_mesh *mesh, mt_status final, unsigned threads)
{
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t nth = 1; status == MT_ERROR_OUT_OF_MEMORY; nth++) {
        mt_context_options options = {.failing_allocation = nth, .thread_count = threads};
        mt_context *context = mt_context_create(&options);
        void *structure = NULL;
        mt_mesh *back = NULL;
        status = kind->create(context, mesh, &structure);
        if (status == MT_OK) {
            status = kind->validate(context, structure);
        }
        if (status == MT_OK) {
            status = kind->to_mesh(context, structure, mesh, &back);
        }
        assert_int_equal(mt_context_error(context)->status, status);
        kind->destroy(context, structure);
        mt_mesh_destroy(context, back);
        test_context_end(context);
        assert_true(nth < 200);
    }
    assert_int_equal(status, final);
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *good = test_torus(context, 30, 20, true);
    const double positions[15] = {0};
    const mt_index bow_tie[] = {3, 0, 1, 2, 3, 0, 3, 4};
    mt_mesh *pinched = test_mesh(context, 5, positions, 2, bow_tie);
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        expect_clean_failures(&test_structures[i], good, MT_OK, 1);
        expect_clean_failures(&test_structures[i], good, MT_OK, 7);
        expect_clean_failures(&test_structures[i], pinched, MT_ERROR_NOT_MANIFOLD, 1);
    }
    mt_mesh_destroy(context, good);
    mt_mesh_destroy(context, pinched);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(structures_agree_with_the_faces),
        cmocka_unit_test(small_meshes_are_held),
        cmocka_unit_test(large_shuffled_meshes_are_held_or_refused),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_closed_triangle_mesh_takes_the_bytes_that_were_promised),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
