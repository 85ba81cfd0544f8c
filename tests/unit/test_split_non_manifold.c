/* Splitting: that every structure takes the result, that each corner still stands for its old vertex, and that nothing
 * is split without need. */
#include "tests/support/cage.h"
#include "tests/support/census.h"
#include "tests/support/connectivity.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/split_non_manifold.h>
#include <meshtool/triangulate.h>

#include <string.h>

static mt_mesh *split(mt_context *context, const mt_mesh *mesh, mt_index **sources)
{
    mt_mesh *result = NULL;
    assert_int_equal(mt_split_non_manifold(context, mesh, &result, sources), MT_OK);
    assert_int_equal(mt_mesh_validate(context, result), MT_OK);
    return result;
}

/* Every face is there with its sides in their places, and every vertex is a copy of the one it stands for. */
static void expect_copies(const mt_mesh *mesh, const mt_mesh *result, const mt_index *sources)
{
    assert_int_equal(result->face_count, mesh->face_count);
    assert_int_equal(result->corner_count, mesh->corner_count);
    assert_true(result->vertex_count >= mesh->vertex_count);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        assert_int_equal(mt_mesh_face_end(result, face), mt_mesh_face_end(mesh, face));
    }
    mt_index used = mesh->vertex_count;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index vertex = result->corner_vertices[corner];
        assert_int_equal(sources[vertex], mesh->corner_vertices[corner]);
    }
    for (mt_index vertex = 0; vertex < result->vertex_count; vertex++) {
        mt_vec3 old = mt_mesh_position(mesh, sources[vertex]), copy = mt_mesh_position(result, vertex);
        assert_memory_equal(&old, &copy, sizeof old);
        if (vertex < mesh->vertex_count) {
            assert_int_equal(sources[vertex], vertex);
            continue;
        }
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            if (result->corner_vertices[corner] == vertex) {
                used++;
                break;
            }
        }
    }
    assert_int_equal(used, result->vertex_count);
}

static void expect_held(mt_context *context, const mt_mesh *mesh, mt_status status)
{
    mt_mesh *triangles = NULL;
    assert_int_equal(mt_mesh_triangulate(context, mesh, &triangles), MT_OK);
    bool same = triangles->corner_count == mesh->corner_count;
    mt_mesh_destroy(context, triangles);
    for (size_t i = 0; i < TEST_STRUCTURE_COUNT; i++) {
        const test_structure *kind = &test_structures[i];
        void *structure = NULL;
        if (!kind->triangles_only || same) {
            assert_int_equal(kind->create(context, mesh, &structure), status);
            assert_int_equal(status == MT_OK ? kind->validate(context, structure) : MT_OK, MT_OK);
            kind->destroy(context, structure);
            mt_context_clear_error(context);
        }
    }
}

/* Whether some face has the vertices of another, in the same direction. */
static bool has_double(const mt_mesh *mesh)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        const mt_index *a = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
        for (mt_index other = 0; other < face; other++) {
            const mt_index *b = mesh->corner_vertices + mt_mesh_face_begin(mesh, other);
            for (mt_index turn = 0; turn < sides && mt_mesh_face_sides(mesh, other) == sides; turn++) {
                mt_index equal = 0;
                for (mt_index i = 0; i < sides; i++) {
                    equal += a[i] == b[(i + turn) % sides];
                }
                if (equal == sides) {
                    return true;
                }
            }
        }
    }
    return false;
}

/* What a mesh counts that was nothing to split, and its result. Returns whether anything was split. */
static bool expect_split(mt_context *context, const mt_mesh *mesh)
{
    test_census before = test_census_of(mesh);
    mt_index *sources = NULL, *again_sources = NULL;
    mt_mesh *result = split(context, mesh, &sources);
    expect_copies(mesh, result, sources);
    test_census after = test_census_of(result);
    assert_int_equal(after.degenerate_faces, 0);
    assert_int_equal(after.non_manifold_edges, 0);
    assert_int_equal(after.non_manifold_vertices, 0);
    assert_true(after.misoriented_edges <= before.misoriented_edges);
    expect_held(context, result, after.misoriented_edges ? MT_ERROR_NOT_ORIENTED : MT_OK);
    bool clean = !before.degenerate_faces && !before.non_manifold_edges && !before.non_manifold_vertices;
    if (clean && !has_double(mesh)) {
        assert_int_equal(result->vertex_count, mesh->vertex_count);
        assert_true(test_mesh_hash(result) == test_mesh_hash(mesh));
    }
    mt_mesh *again = split(context, result, &again_sources);
    assert_true(test_mesh_hash(again) == test_mesh_hash(result));
    bool changed = result->vertex_count != mesh->vertex_count;
    mt_free(context, sources);
    mt_free(context, again_sources);
    mt_mesh_destroy(context, result);
    mt_mesh_destroy(context, again);
    return changed;
}

static void soups_are_split_until_they_are_held(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {77};
    int changed = 0, count = 6000;
    for (int turn = 0; turn < count; turn++) {
        mt_mesh *mesh = turn % 3 ? test_soup(context, &random) : test_patch(context, &random);
        changed += expect_split(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    assert_true(changed > count / 4);
    assert_true(changed < count - count / 8);
    test_context_end(context);
}

/* Many faces on few vertices: every edge has many sides. */
static void dense_soups_are_split_until_they_are_held(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {78};
    for (int turn = 0; turn < 1500; turn++) {
        mt_index face_count = 4 + (mt_index)test_random_below(&random, 40);
        mt_index vertex_count = 3 + (mt_index)test_random_below(&random, 4);
        mt_index sides = 3 + (mt_index)test_random_below(&random, 3);
        mt_mesh_layout layout = {
            .vertex_count = vertex_count, .face_count = face_count, .face_size = sides, .position_type = MT_F32};
        mt_mesh *mesh = NULL;
        assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
        memset(mesh->positions, 0, 12 * (size_t)vertex_count);
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            mesh->corner_vertices[corner] = (mt_index)test_random_below(&random, vertex_count);
        }
        expect_split(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void expect_vertices(mt_index vertex_count, mt_index face_count, const mt_index *faces, mt_index expected)
{
    static const double positions[3 * 16];
    mt_context *context = test_context();
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, face_count, faces);
    expect_split(context, mesh);
    mt_mesh *result = split(context, mesh, NULL);
    assert_int_equal(result->vertex_count, expected);
    mt_mesh_destroy(context, result);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void each_defect_is_split_as_little_as_it_takes(void **state)
{
    (void)state;
    const mt_index edge_joins_two_tetrahedra[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2,
                                                  3, 0, 4, 1, 3, 0, 1, 5, 3, 1, 4, 5, 3, 0, 5, 4};
    expect_vertices(6, 8, edge_joins_two_tetrahedra, 8);
    const mt_index vertex_joins_two_triangles[] = {3, 0, 1, 2, 3, 0, 3, 4};
    expect_vertices(5, 2, vertex_joins_two_triangles, 6);
    const mt_index fin_on_a_tetrahedron[] = {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 0, 3, 2, 3, 0, 1, 4};
    expect_vertices(5, 5, fin_on_a_tetrahedron, 7);
    const mt_index triangle_twice[] = {3, 0, 1, 2, 3, 1, 2, 0};
    expect_vertices(3, 2, triangle_twice, 6);
    const mt_index triangle_and_its_back[] = {3, 0, 1, 2, 3, 2, 1, 0};
    expect_vertices(3, 2, triangle_and_its_back, 3);
    const mt_index vertex_named_twice[] = {3, 0, 0, 1};
    expect_vertices(2, 1, vertex_named_twice, 3);
    const mt_index vertex_named_thrice[] = {3, 0, 0, 0};
    expect_vertices(1, 1, vertex_named_thrice, 3);
    const mt_index square_with_a_slit[] = {6, 0, 1, 2, 3, 4, 3};
    expect_vertices(5, 1, square_with_a_slit, 6);
    const mt_index two_faces_turned_alike[] = {3, 0, 1, 2, 3, 0, 1, 3};
    expect_vertices(4, 2, two_faces_turned_alike, 4);
    const mt_index three_pages[] = {3, 0, 1, 2, 3, 0, 1, 3, 3, 1, 0, 4};
    expect_vertices(5, 3, three_pages, 9);
}

/* Values per vertex are copied, and sharpness goes with each new edge and vertex. */
static void what_lies_on_vertices_follows(void **state)
{
    (void)state;
    mt_context *context = test_context();
    static const double positions[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const mt_index pages[] = {3, 0, 1, 2, 3, 0, 1, 3, 3, 1, 0, 4};
    mt_mesh *mesh = test_mesh(context, 5, positions, 3, pages);
    mt_attribute_layout layout = {"heat", MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, MT_U8, 1, 5, false};
    mt_attribute *heat = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &heat), MT_OK);
    memcpy(heat->values, "\x0a\x14\x1e\x28\x32", 5);
    mesh->creases = mt_allocate(context, 2 * sizeof *mesh->creases);
    mesh->creases[0] = (mt_edge_value){1, 0, 2.5};
    mesh->creases[1] = (mt_edge_value){2, 0, 1};
    mesh->crease_count = 2;
    mesh->sharp_vertices = mt_allocate(context, sizeof *mesh->sharp_vertices);
    mesh->sharp_vertices[0] = (mt_vertex_value){1, 7};
    mesh->sharp_vertex_count = 1;
    mt_index *sources = NULL;
    mt_mesh *result = split(context, mesh, &sources);
    assert_int_equal(result->vertex_count, 9);
    for (mt_index vertex = 0; vertex < 9; vertex++) {
        assert_int_equal(((uint8_t *)result->attributes[0].values)[vertex], 10 * (sources[vertex] + 1));
    }
    assert_int_equal(result->crease_count, 4);
    for (mt_index i = 0; i < 4; i++) {
        mt_edge_value crease = result->creases[i];
        bool spine = sources[crease.a] + sources[crease.b] == 1;
        assert_true(crease.value == (spine ? 2.5 : 1));
        assert_true(i < 2 || crease.a >= 5 || crease.b >= 5);
    }
    assert_int_equal(result->sharp_vertex_count, 3);
    for (mt_index i = 0; i < 3; i++) {
        assert_int_equal(sources[result->sharp_vertices[i].vertex], 1);
        assert_true(result->sharp_vertices[i].value == 7);
    }
    mt_free(context, sources);
    mt_mesh_destroy(context, result);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* A torus with a hundred thousand faces gone wrong, alike on any number of threads. */
static uint64_t hash_of_split(unsigned threads)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 400, 250, true);
    test_random random = {9};
    for (mt_index i = 0; i < mesh->face_count / 4; i++) {
        mt_index corner = (mt_index)test_random_below(&random, mesh->corner_count);
        mesh->corner_vertices[corner] = (mt_index)test_random_below(&random, mesh->vertex_count);
    }
    mt_mesh *result = split(context, mesh, NULL);
    uint64_t hash = test_mesh_hash(result);
    assert_true(result->vertex_count > mesh->vertex_count);
    mt_mesh_destroy(context, result);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return hash;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    uint64_t one = hash_of_split(1);
    assert_true(hash_of_split(2) == one);
    assert_true(hash_of_split(7) == one);
}

/* One vertex in all faces, each face alone: a million splits at one vertex take no longer than at many. */
static void a_vertex_of_a_million_faces_is_fast(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 1000000, false);
    for (mt_index face = 0; face < mesh->face_count; face += 2) {
        mesh->corner_vertices[3 * face + 1] = mesh->corner_vertices[3 * face + 2] = 0;
    }
    mt_mesh *result = split(context, mesh, NULL);
    assert_int_equal(result->vertex_count, mesh->vertex_count + 2000000 - 1);
    mt_mesh_destroy(context, result);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    mt_context *maker = test_context();
    static const double positions[15];
    const mt_index pages[] = {3, 0, 1, 2, 3, 0, 1, 3, 3, 1, 0, 4, 4, 0, 2, 0, 4};
    mt_mesh *mesh = test_mesh(maker, 5, positions, 4, pages);
    mesh->creases = mt_allocate(maker, sizeof *mesh->creases);
    mesh->creases[0] = (mt_edge_value){1, 0, 2.5};
    mesh->crease_count = 1;
    mesh->sharp_vertices = mt_allocate(maker, sizeof *mesh->sharp_vertices);
    mesh->sharp_vertices[0] = (mt_vertex_value){1, 7};
    mesh->sharp_vertex_count = 1;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    for (uint64_t nth = 1; status != MT_OK; nth++) {
        mt_context_options options = {.failing_allocation = nth, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        mt_mesh *result = NULL;
        mt_index *sources = NULL;
        status = mt_split_non_manifold(context, mesh, &result, &sources);
        assert_int_equal(mt_context_error(context)->status, status);
        assert_true(status == MT_OK || (status == MT_ERROR_OUT_OF_MEMORY && !result && !sources));
        mt_free(context, sources);
        mt_mesh_destroy(context, result);
        test_context_end(context);
        assert_true(nth < 200);
    }
    mt_mesh_destroy(maker, mesh);
    test_context_end(maker);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soups_are_split_until_they_are_held),
        cmocka_unit_test(dense_soups_are_split_until_they_are_held),
        cmocka_unit_test(each_defect_is_split_as_little_as_it_takes),
        cmocka_unit_test(what_lies_on_vertices_follows),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(a_vertex_of_a_million_faces_is_fast),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
