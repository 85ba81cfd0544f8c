/* Edge pairs, fans and components of meshes that are large enough for every way of finding them: by one thread, by two
 * that share the vertices, by many that deal sides to ranges; in the order of the surface and in none. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/components.h>
#include <meshtool/vertex_fans.h>

#include <stdlib.h>
#include <string.h>

#define COLUMNS 90
#define ROWS 100
#define VERTEX_COUNT (COLUMNS * ROWS)
#define FACE_COUNT (2 * COLUMNS * ROWS)

static mt_mesh *make_torus(mt_context *context)
{
    mt_mesh_layout layout = {
        .vertex_count = VERTEX_COUNT, .face_count = FACE_COUNT, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    memset(mesh->positions, 0, 3 * sizeof(double) * VERTEX_COUNT);
    mt_index *corner = mesh->corner_vertices;
    for (mt_index i = 0; i < COLUMNS; i++) {
        for (mt_index j = 0; j < ROWS; j++) {
            mt_index right = (i + 1) % COLUMNS * ROWS, up = (j + 1) % ROWS;
            mt_index a = i * ROWS + j, b = right + j, c = right + up, d = i * ROWS + up;
            const mt_index two[6] = {a, b, c, a, c, d};
            memcpy(corner, two, sizeof two);
            corner += 6;
        }
    }
    return mesh;
}

/* Swaps runs of `size` faces at random. */
static void shuffle_runs(mt_mesh *mesh, mt_index size, test_random *random)
{
    mt_index *spare = malloc(3 * (size_t)size * sizeof *spare);
    assert_non_null(spare);
    size_t bytes = 3 * (size_t)size * sizeof *spare;
    for (mt_index i = mesh->face_count / size; i > 1; i--) {
        mt_index *a = mesh->corner_vertices + 3 * (size_t)size * (i - 1);
        mt_index *b = mesh->corner_vertices + 3 * (size_t)size * test_random_below(random, i);
        memcpy(spare, a, bytes);
        memmove(a, b, bytes);
        memcpy(b, spare, bytes);
    }
    free(spare);
}

/* Gives `count` vertices the place of one: fans that meet in a vertex, of edges that stay as they are. */
static void pinch(mt_mesh *mesh, mt_index count, mt_index stride)
{
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_index vertex = mesh->corner_vertices[c];
        if (vertex % stride == 0 && vertex / stride < count) {
            mesh->corner_vertices[c] = 0;
        }
    }
}

/* Drops every face that chance takes, one in `share`. */
static void make_holes(mt_mesh *mesh, mt_index share, test_random *random)
{
    mt_index kept = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (test_random_below(random, share)) {
            memmove(mesh->corner_vertices + 3 * (size_t)kept++, mesh->corner_vertices + 3 * (size_t)face,
                    3 * sizeof(mt_index));
        }
    }
    mesh->face_count = kept;
    mesh->corner_count = 3 * kept;
}

static void turn_some(mt_mesh *mesh, test_random *random)
{
    for (int i = 0; i < 20; i++) {
        mt_index *corner = mesh->corner_vertices + 3 * (size_t)test_random_below(random, mesh->face_count);
        mt_index first = corner[0];
        corner[0] = corner[1];
        corner[1] = first;
    }
}

static void repeat_some(mt_mesh *mesh, test_random *random)
{
    for (int i = 0; i < 20; i++) {
        mt_index *from = mesh->corner_vertices + 3 * (size_t)test_random_below(random, mesh->face_count);
        mt_index *to = mesh->corner_vertices + 3 * (size_t)test_random_below(random, mesh->face_count);
        memmove(to, from, 3 * sizeof *to);
    }
    mesh->corner_vertices[1] = mesh->corner_vertices[0];
}

static void number_vertices_anew(mt_mesh *mesh, test_random *random)
{
    mt_index *number = malloc(VERTEX_COUNT * sizeof *number);
    assert_non_null(number);
    for (mt_index i = 0; i < VERTEX_COUNT; i++) {
        mt_index at = (mt_index)test_random_below(random, i + 1);
        number[i] = number[at];
        number[at] = i;
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mesh->corner_vertices[c] = number[mesh->corner_vertices[c]];
    }
    free(number);
}

static mt_index root_of(mt_index *parent, mt_index i)
{
    while (parent[i] != i) {
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

static bool join(mt_index *parent, mt_index a, mt_index b)
{
    a = root_of(parent, a), b = root_of(parent, b);
    parent[a > b ? a : b] = a > b ? b : a;
    return a != b;
}

static mt_index *singletons(mt_index count)
{
    mt_index *parent = malloc(count * sizeof *parent);
    assert_non_null(parent);
    for (mt_index i = 0; i < count; i++) {
        parent[i] = i;
    }
    return parent;
}

static mt_index count_components(const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    mt_index *parent = singletons(mesh->face_count), count = mesh->face_count;
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        count -= pairs->next_side[c] != MT_NONE && join(parent, c / 3, pairs->next_side[c] / 3);
    }
    free(parent);
    return count;
}

static mt_index corner_at(const mt_mesh *mesh, mt_index face, mt_index vertex)
{
    for (mt_index c = 3 * face; c < 3 * face + 3; c++) {
        if (mesh->corner_vertices[c] == vertex) {
            return c;
        }
    }
    fail();
    return MT_NONE;
}

/* Corners at one vertex joined where their faces share an edge there: how many sets each vertex has, up to 2. */
static void expect_fans(const mt_mesh *mesh, const mt_edge_pairs *pairs, const mt_vertex_fans *fans)
{
    mt_index *parent = singletons(mesh->corner_count);
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_index other = pairs->next_side[c];
        mt_index ends[2] = {mesh->corner_vertices[c], mesh->corner_vertices[c % 3 == 2 ? c - 2 : c + 1]};
        for (int i = 0; i < 2 && other != MT_NONE; i++) {
            join(parent, corner_at(mesh, c / 3, ends[i]), corner_at(mesh, other / 3, ends[i]));
        }
        mt_index begin = c - c % 3;
        join(parent, c, corner_at(mesh, begin / 3, mesh->corner_vertices[c])); /* one face, one vertex twice */
    }
    uint8_t *expected = calloc(VERTEX_COUNT, 1);
    assert_non_null(expected);
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        uint8_t *sets = &expected[mesh->corner_vertices[c]];
        *sets = (uint8_t)(*sets + (parent[c] == c && *sets < 2));
    }
    assert_memory_equal(fans->fans, expected, VERTEX_COUNT);
    free(expected);
    free(parent);
}

/* Per face 1 when it names a vertex twice; NULL when none does. */
static uint8_t *find_degenerate(const mt_mesh *mesh)
{
    uint8_t *degenerate = calloc(mesh->face_count, 1);
    assert_non_null(degenerate);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_index *v = mesh->corner_vertices + 3 * (size_t)face;
        degenerate[face] = v[0] == v[1] || v[1] == v[2] || v[2] == v[0];
    }
    if (!memchr(degenerate, 1, mesh->face_count)) {
        free(degenerate);
        return NULL;
    }
    return degenerate;
}

static void expect_same_pairs(const mt_edge_pairs *pairs, const mt_edge_pairs *expected)
{
    assert_memory_equal(pairs->next_side, expected->next_side, pairs->corner_count * sizeof(mt_index));
    mt_edge_pairs a = *pairs, b = *expected;
    a.next_side = b.next_side = NULL;
    assert_memory_equal(&a, &b, sizeof a);
}

static void expect_with(const mt_mesh *mesh, unsigned threads, const mt_edge_pairs *expected)
{
    mt_context *context = test_context_with_threads(threads);
    mt_edge_pairs *pairs = NULL;
    mt_vertex_fans *fans = NULL;
    mt_components *components = NULL;
    uint8_t *degenerate = find_degenerate(mesh);
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    assert_int_equal(mt_vertex_fans_create(context, mesh, pairs, degenerate, &fans), MT_OK);
    assert_int_equal(mt_components_create(context, mesh, pairs, false, &components), MT_OK);
    expect_same_pairs(pairs, expected);
    expect_fans(mesh, pairs, fans);
    assert_int_equal(components->component_count, count_components(mesh, pairs));
    free(degenerate);
    mt_components_destroy(context, components);
    mt_vertex_fans_destroy(context, fans);
    mt_edge_pairs_destroy(context, pairs);
    test_context_end(context);
}

static void expect_all_ways(const mt_mesh *mesh)
{
    mt_context *context = test_context_with_threads(7);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, mesh, &pairs), MT_OK);
    expect_with(mesh, 1, pairs);
    expect_with(mesh, 2, pairs);
    expect_with(mesh, 7, pairs);
    mt_edge_pairs_destroy(context, pairs);
    test_context_end(context);
}

static void run(mt_index run_size, void (*spoil)(mt_mesh *mesh, test_random *random))
{
    mt_context *context = test_context();
    test_random random = {run_size + 7};
    mt_mesh *mesh = make_torus(context);
    spoil(mesh, &random);
    if (run_size) {
        shuffle_runs(mesh, run_size, &random);
    }
    expect_all_ways(mesh);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void pinch_few(mt_mesh *mesh, test_random *random)
{
    (void)random;
    pinch(mesh, 5, 1234);
}

static void pinch_many(mt_mesh *mesh, test_random *random)
{
    (void)random;
    pinch(mesh, 400, 7);
}

static void make_large_holes(mt_mesh *mesh, test_random *random)
{
    make_holes(mesh, 3, random);
}

static void make_small_holes(mt_mesh *mesh, test_random *random)
{
    make_holes(mesh, 500, random);
    pinch(mesh, 3, 2001);
}

static void leave_whole(mt_mesh *mesh, test_random *random)
{
    (void)mesh;
    (void)random;
}

static void every_way_agrees_with_the_definitions(void **state)
{
    (void)state;
    void (*const spoils[])(mt_mesh *, test_random *) = {leave_whole,      pinch_few, pinch_many,  make_small_holes,
                                                        make_large_holes, turn_some, repeat_some, number_vertices_anew};
    for (size_t i = 0; i < sizeof spoils / sizeof *spoils; i++) {
        run(0, spoils[i]);
        run(300, spoils[i]);
        run(10, spoils[i]);
        run(1, spoils[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_way_agrees_with_the_definitions)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
