/* Strips and fans against their definition: what they draw is read here from their indices alone, and must be the
 * mesh's triangles, each once and turned the same way; how short they are, against an exhaustive search. */
#include "tests/support/random_mesh.h"
#include "tests/support/soup.h"
#include "tests/support/strip_optimum.h"
#include "tests/support/unit.h"
#include "tests/support/zoo.h"

#include <meshtool/generate.h>
#include <meshtool/mesh_format.h>
#include <meshtool/strips.h>
#include <meshtool/triangulate.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct drawn {
    mt_index a, b, c, face;
} drawn;

/* Begins with the lowest vertex; of two equal ones with the one whose next is lower. */
static drawn turned(mt_index a, mt_index b, mt_index c, mt_index face)
{
    drawn ways[3] = {{a, b, c, face}, {b, c, a, face}, {c, a, b, face}}, best = ways[0];
    for (int i = 1; i < 3; i++) {
        if (ways[i].a < best.a || (ways[i].a == best.a && ways[i].b < best.b)) {
            best = ways[i];
        }
    }
    return best;
}

static int compare(const void *left, const void *right)
{
    const drawn *l = left, *r = right;
    const mt_index pairs[4][2] = {{l->a, r->a}, {l->b, r->b}, {l->c, r->c}, {l->face, r->face}};
    for (int i = 0; i < 4; i++) {
        if (pairs[i][0] != pairs[i][1]) {
            return pairs[i][0] < pairs[i][1] ? -1 : 1;
        }
    }
    return 0;
}

static bool is_flat(drawn t)
{
    return t.a == t.b || t.b == t.c || t.c == t.a;
}

/* The sorted triangles of the mesh. */
static drawn *list_triangles(mt_context *context, const mt_mesh *mesh, mt_index *count)
{
    mt_triangulation triangulation;
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    drawn *list = malloc((triangulation.triangle_count + (size_t)1) * sizeof *list);
    assert_non_null(list);
    *count = 0;
    for (mt_index t = 0; t < triangulation.triangle_count; t++) {
        mt_index v[3];
        for (mt_index side = 0; side < 3; side++) {
            v[side] = mesh->corner_vertices[mt_triangulation_corner(&triangulation, t, side)];
        }
        list[(*count)++] = turned(v[0], v[1], v[2], mt_triangulation_face(&triangulation, t));
    }
    mt_triangulation_release(context, &triangulation);
    qsort(list, *count, sizeof *list, compare);
    return list;
}

/* What strips draw, by the definition, with the faces that they name. */
static drawn *draw(const mt_mesh *mesh, const mt_strips *strips, bool without_flat, mt_index *count)
{
    drawn *list = malloc((strips->triangle_count + (size_t)1) * sizeof *list);
    assert_non_null(list);
    *count = 0;
    for (mt_index i = 0; i < strips->strip_count; i++) {
        const mt_index *v = strips->indices + strips->offsets[i];
        mt_index length = strips->offsets[i + 1] - strips->offsets[i];
        assert_true(length >= 3);
        for (mt_index k = 0; k < length; k++) {
            assert_true(v[k] < mesh->vertex_count);
        }
        for (mt_index k = 0; k + 2 < length; k++) {
            drawn t = i >= strips->fan_begin ? turned(v[0], v[k + 1], v[k + 2], 0)
                      : k % 2                ? turned(v[k + 1], v[k], v[k + 2], 0)
                                             : turned(v[k], v[k + 1], v[k + 2], 0);
            if (is_flat(t) && (length > 3 || without_flat)) {
                continue;
            }
            assert_true(*count < strips->triangle_count);
            t.face = without_flat ? 0 : strips->faces[*count];
            list[(*count)++] = t;
        }
    }
    qsort(list, *count, sizeof *list, compare);
    return list;
}

static void expect_round_trip(mt_context *context, const mt_strips *strips, const drawn *list, mt_index count)
{
    mt_index *triangles = NULL, found = 0;
    assert_int_equal(mt_strips_triangles(context, strips, &triangles, &found), MT_OK);
    assert_int_equal(found, count);
    drawn *back = malloc((count + (size_t)1) * sizeof *back);
    assert_non_null(back);
    for (mt_index i = 0; i < count; i++) {
        const mt_index *v = triangles + 3 * (size_t)i;
        back[i] = turned(v[0], v[1], v[2], list[i].face);
    }
    qsort(back, count, sizeof *back, compare);
    for (mt_index i = 0; i < count; i++) {
        assert_int_equal(back[i].a, list[i].a);
        assert_int_equal(back[i].b, list[i].b);
        assert_int_equal(back[i].c, list[i].c);
    }
    free(back);
    mt_free(context, triangles);
}

static void expect_counts(const mt_mesh *mesh, const mt_strips *strips)
{
    mt_index singles = 0;
    for (mt_index i = 0; i < strips->strip_count; i++) {
        singles += strips->offsets[i + 1] - strips->offsets[i] == 3;
    }
    assert_int_equal(strips->offsets[0], 0);
    assert_true(strips->single_count == singles);
    assert_true(strips->fan_begin <= strips->strip_count && strips->strip_count <= strips->run_count);
    uint64_t restarts = strips->join == MT_STRIP_JOIN_RESTART && strips->strip_count ? strips->strip_count - 1 : 0;
    assert_true(mt_strips_index_count(strips) == strips->offsets[strips->strip_count] + restarts);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        assert_true(strips->face_runs[face] < strips->run_count);
    }
}

/* The triangles are those drawn; where strips are joined by flat ones, those that are not flat, of whatever face. */
static void expect_drawn(const drawn *triangles, mt_index triangle_count, bool without_flat, const drawn *found,
                         mt_index found_count)
{
    mt_index count = 0;
    for (mt_index i = 0; i < triangle_count; i++) {
        drawn expected = triangles[i];
        if (without_flat && is_flat(expected)) {
            continue;
        }
        expected.face = without_flat ? 0 : expected.face;
        assert_true(count < found_count);
        assert_int_equal(compare(&expected, &found[count++]), 0);
    }
    assert_int_equal(count, found_count);
}

/* All that the header promises of one way to make strips of a mesh with these triangles. */
static void expect_strips_of(mt_context *context, const mt_mesh *mesh, const drawn *triangles, mt_index count,
                             const mt_strip_options *options)
{
    mt_strips *strips = NULL;
    assert_int_equal(mt_strips_create(context, mesh, options, &strips), MT_OK);
    bool without_flat = options->join == MT_STRIP_JOIN_DEGENERATE;
    mt_index found_count;
    drawn *found = draw(mesh, strips, without_flat, &found_count);
    expect_drawn(triangles, count, without_flat, found, found_count);
    expect_counts(mesh, strips);
    if (!without_flat) {
        expect_round_trip(context, strips, found, found_count);
    } else {
        assert_true(strips->strip_count <= 1);
    }
    free(found);
    mt_strips_destroy(context, strips);
}

static void expect_strips(mt_context *context, const mt_mesh *mesh, const mt_strip_options *options)
{
    mt_index count;
    drawn *triangles = list_triangles(context, mesh, &count);
    expect_strips_of(context, mesh, triangles, count, options);
    free(triangles);
}

static void expect_every_way(mt_context *context, const mt_mesh *mesh, bool thorough)
{
    mt_index count;
    drawn *triangles = list_triangles(context, mesh, &count);
    for (mt_strip_kind kind = MT_STRIP_KIND_STRIP; kind <= MT_STRIP_KIND_MIXED; kind++) {
        for (mt_strip_join join = MT_STRIP_JOIN_RESTART; join <= MT_STRIP_JOIN_NONE; join++) {
            mt_strip_options options = {kind, join, thorough};
            if (kind == MT_STRIP_KIND_STRIP || join != MT_STRIP_JOIN_DEGENERATE) {
                expect_strips_of(context, mesh, triangles, count, &options);
            }
        }
    }
    free(triangles);
}

static void small_meshes_are_covered(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_animal animals[TEST_ZOO_ROOM];
    size_t count = test_zoo(context, animals);
    for (size_t i = 0; i < count; i++) {
        const mt_strip_options thorough = {.kind = MT_STRIP_KIND_MIXED, .thorough = true};
        expect_every_way(context, animals[i].mesh, false);
        expect_strips(context, animals[i].mesh, &thorough);
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

static void broken_and_random_meshes_are_covered(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {20261128};
    for (int i = 0; i < 900; i++) {
        mt_mesh *mesh = i % 3 == 0   ? test_soup(context, &random)
                        : i % 3 == 1 ? test_patch(context, &random)
                                     : test_random_mesh(context, &random);
        expect_every_way(context, mesh, false);
        if (i < 12) {
            expect_every_way(context, mesh, true);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Edges of a dozen triangles, turned both ways: sides that run in opposite directions are neighbours. */
static void edges_of_many_triangles_are_crossed(void **state)
{
    (void)state;
    mt_context *context = test_context();
    double positions[3 * 14] = {0};
    mt_index faces[4 * 12];
    for (mt_index i = 0; i < 12; i++) {
        const mt_index face[4] = {3, i % 2, 1 - i % 2, i + 2};
        memcpy(faces + 4 * (size_t)i, face, sizeof face);
    }
    mt_mesh *mesh = test_mesh(context, 14, positions, 12, faces);
    expect_every_way(context, mesh, false);
    mt_strips *strips = NULL;
    mt_strip_options options = {.join = MT_STRIP_JOIN_NONE};
    assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_OK);
    assert_int_equal(strips->strip_count, 6);
    mt_strips_destroy(context, strips);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void check_files_in(mt_context *context, const char *folder)
{
    DIR *entries = opendir(folder);
    if (!entries) {
        print_message("skipped: %s is not there\n", folder);
        return;
    }
    for (struct dirent *entry = readdir(entries); entry; entry = readdir(entries)) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        mt_mesh *mesh = NULL;
        if (entry->d_name[0] != '.' && mt_mesh_read_file(context, path, NULL, &mesh, NULL) == MT_OK) {
            expect_every_way(context, mesh, false);
            mt_strip_options thorough = {.thorough = true};
            if (mesh->face_count < 10000) {
                expect_strips(context, mesh, &thorough);
            }
            mt_mesh_destroy(context, mesh);
        }
        mt_context_clear_error(context);
    }
    closedir(entries);
}

static void meshes_in_files_are_covered(void **state)
{
    (void)state;
    mt_context *context = test_context();
    check_files_in(context, "meshes/valid");
    check_files_in(context, "meshes/non_manifold");
    check_files_in(context, "../shared/corpus");
    test_context_end(context);
}

static uint64_t hash_strips(unsigned threads, const mt_strip_options *options)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 90, 60, true);
    mt_strips *strips = NULL;
    assert_int_equal(mt_strips_create(context, mesh, options, &strips), MT_OK);
    uint64_t hash = test_hash(strips->indices, strips->offsets[strips->strip_count] * sizeof(mt_index));
    hash ^= 3 * test_hash(strips->offsets, (strips->strip_count + (size_t)1) * sizeof(mt_index));
    hash ^= 5 * test_hash(strips->faces, strips->triangle_count * sizeof(mt_index));
    hash ^= 7 * test_hash(strips->face_runs, mesh->face_count * sizeof(mt_index));
    mt_strips_destroy(context, strips);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return hash;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    for (int thorough = 0; thorough < 2; thorough++) {
        mt_strip_options options = {MT_STRIP_KIND_MIXED, MT_STRIP_JOIN_RESTART, thorough};
        assert_true(hash_strips(1, &options) == hash_strips(2, &options));
        assert_true(hash_strips(1, &options) == hash_strips(7, &options));
    }
}

/* A closed fan of n triangles is one fan of n + 2 indices, a mixed cover too, and as a strip it takes a swap for all
 * but three triangles or is cut. */
static void a_fan_is_one_fan(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (int thorough = 0; thorough < 2; thorough++) {
        mt_mesh *mesh = test_fan(context, 100, true);
        for (int kind = MT_STRIP_KIND_FAN; kind <= MT_STRIP_KIND_MIXED; kind++) {
            mt_strip_options options = {(mt_strip_kind)kind, MT_STRIP_JOIN_RESTART, thorough};
            mt_strips *strips = NULL;
            assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_OK);
            assert_int_equal(strips->strip_count, 1);
            assert_int_equal(strips->fan_begin, 0);
            assert_int_equal(mt_strips_index_count(strips), 102);
            mt_strips_destroy(context, strips);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void a_vertex_of_a_million_triangles_is_fast(void **state)
{
    (void)state;
    mt_context *context = test_context();
    const mt_strip_options strip = {.kind = MT_STRIP_KIND_STRIP}, mixed = {.kind = MT_STRIP_KIND_MIXED};
    mt_mesh *mesh = test_fan(context, 1000000, true);
    expect_strips(context, mesh, &mixed);
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mesh->corner_vertices[c] = c % 3 ? 1 + c % 1000000 : 0; /* most share nothing but a vertex */
    }
    expect_strips(context, mesh, &strip);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* ---- How short ---- */

typedef struct length_sums {
    uint64_t optimum, fast, thorough, worst; /* worst: how far the thorough method ever is from the optimum */
} length_sums;

static uint64_t count_indices(mt_context *context, const mt_mesh *mesh, bool thorough)
{
    mt_strip_options options = {.thorough = thorough};
    mt_strips *strips = NULL;
    assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_OK);
    uint64_t count = mt_strips_index_count(strips);
    mt_strips_destroy(context, strips);
    return count;
}

/* Over 400 meshes of 1 to 8 triangles, beside the fewest indices of any sequence that draws them. */
static length_sums compare_with_optimum(bool manifold)
{
    mt_context *context = test_context();
    test_random random = {7};
    length_sums sums = {0};
    for (int i = 0; i < 400; i++) {
        mt_mesh *mesh = test_few_triangles(context, &random, manifold);
        uint64_t optimum = test_strip_optimum(mesh);
        uint64_t fast = count_indices(context, mesh, false), thorough = count_indices(context, mesh, true);
        assert_true(fast >= optimum && thorough >= optimum);
        sums.optimum += optimum;
        sums.fast += fast;
        sums.thorough += thorough;
        sums.worst = thorough - optimum > sums.worst ? thorough - optimum : sums.worst;
        mt_mesh_destroy(context, mesh);
    }
    print_message("%s: optimum %lu, thorough %lu, fast %lu; at worst %lu over\n", manifold ? "manifold" : "any",
                  (unsigned long)sums.optimum, (unsigned long)sums.thorough, (unsigned long)sums.fast,
                  (unsigned long)sums.worst);
    test_context_end(context);
    return sums;
}

/* Measured: 1.0 % over on surfaces, and 3 indices more at worst; where edges have many sides their pairing is fixed
 * before the search, which costs more. */
static void thorough_strips_are_near_the_optimum(void **state)
{
    (void)state;
    length_sums surface = compare_with_optimum(true);
    assert_true(50 * surface.thorough <= 51 * surface.optimum);
    assert_true(surface.worst <= 2 && surface.thorough < surface.fast);
    length_sums any = compare_with_optimum(false);
    assert_true(10 * any.thorough <= 11 * any.optimum);
    assert_true(any.thorough < any.fast);
}

/* The first is a torus in the order of its rows, which alone would take 25 strips of 82 indices. */
static void thorough_strips_are_never_longer(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {3};
    for (int i = 0; i < 40; i++) {
        mt_mesh *mesh = i < 2 ? test_torus(context, 40, 25, i == 1) : test_patch(context, &random);
        uint64_t fast = count_indices(context, mesh, false), thorough = count_indices(context, mesh, true);
        assert_true(thorough <= fast);
        assert_true(i > 0 || fast <= 2160);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* ---- The cache ---- */

/* A first-in-first-out queue, kept as a queue. */
static uint64_t count_misses(const mt_strips *strips, mt_index size)
{
    mt_index queue[64], next = 0;
    uint64_t misses = 0;
    memset(queue, 0xff, sizeof queue);
    for (mt_index i = 0; i < strips->offsets[strips->strip_count]; i++) {
        bool hit = false;
        for (mt_index k = 0; k < size; k++) {
            hit = hit || queue[k] == strips->indices[i];
        }
        if (!hit) {
            queue[next] = strips->indices[i];
            next = (next + 1) % size;
            misses++;
        }
    }
    return misses;
}

static void the_cache_is_a_queue(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 40, 25, true);
    mt_strips *strips = NULL;
    assert_int_equal(mt_strips_create(context, mesh, NULL, &strips), MT_OK);
    for (mt_index size = 1; size <= 64; size *= 2) {
        mt_cache_use use;
        assert_int_equal(mt_strips_cache_use(context, strips, size, &use), MT_OK);
        uint64_t misses = count_misses(strips, size);
        assert_true(use.miss_count == misses);
        assert_true(use.acmr == (double)misses / 2000.0 && use.atvr == (double)misses / 1000.0);
    }
    mt_strips_destroy(context, strips);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* ---- Failures ---- */

static void fans_and_degenerate_joins_are_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_fan(context, 10, true);
    mt_strip_options options = {.kind = MT_STRIP_KIND_MIXED, .join = MT_STRIP_JOIN_DEGENERATE};
    mt_strips *strips = (mt_strips *)mesh;
    assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_ERROR_ARGUMENT);
    assert_null(strips);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static bool make_with_failure(uint64_t nth, mt_strip_kind kind)
{
    mt_context *maker = test_context();
    test_random random = {5};
    mt_mesh *mesh = NULL;
    do { /* one with n-gons, so that there is a triangulation */
        mt_mesh_destroy(maker, mesh);
        mesh = test_soup(maker, &random);
    } while (mesh->face_size);
    mt_context_options limits = {.failing_allocation = nth};
    mt_context *context = mt_context_create(&limits);
    mt_strip_options options = {kind, MT_STRIP_JOIN_RESTART, true};
    mt_strips *strips = NULL;
    mt_index *triangles = NULL, count = 0;
    mt_cache_use use;
    mt_status status = mt_strips_create(context, mesh, &options, &strips);
    assert_true((status == MT_OK) == (strips != NULL));
    if (status == MT_OK) {
        status = mt_strips_triangles(context, strips, &triangles, &count);
    }
    if (status == MT_OK) {
        status = mt_strips_cache_use(context, strips, 16, &use);
    }
    assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
    assert_int_equal(mt_context_error(context)->status, status);
    mt_free(context, triangles);
    mt_strips_destroy(context, strips);
    test_context_end(context);
    mt_mesh_destroy(maker, mesh);
    test_context_end(maker);
    return status == MT_OK;
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    for (mt_strip_kind kind = MT_STRIP_KIND_STRIP; kind <= MT_STRIP_KIND_MIXED; kind++) {
        uint64_t nth = 1;
        while (!make_with_failure(nth, kind)) {
            nth++;
            assert_true(nth < 200);
        }
        assert_true(nth > 10);
    }
}

static bool lose_patience(void *user, const char *task, double fraction)
{
    (void)task;
    (void)fraction;
    int *patience = user;
    return (*patience)-- > 0;
}

static void a_search_can_be_cancelled(void **state)
{
    (void)state;
    for (int steps = 0; steps < 8; steps++) {
        int patience = steps;
        mt_context_options limits = {.progress = lose_patience, .progress_user = &patience};
        mt_context *context = mt_context_create(&limits);
        mt_mesh *mesh = test_torus(context, 30, 20, true);
        mt_strip_options options = {.thorough = true};
        mt_strips *strips = NULL;
        assert_int_equal(mt_strips_create(context, mesh, &options, &strips), MT_ERROR_CANCELLED);
        assert_null(strips);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_meshes_are_covered),
        cmocka_unit_test(broken_and_random_meshes_are_covered),
        cmocka_unit_test(edges_of_many_triangles_are_crossed),
        cmocka_unit_test(meshes_in_files_are_covered),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(thorough_strips_are_never_longer),
        cmocka_unit_test(a_fan_is_one_fan),
        cmocka_unit_test(a_vertex_of_a_million_triangles_is_fast),
        cmocka_unit_test(thorough_strips_are_near_the_optimum),
        cmocka_unit_test(the_cache_is_a_queue),
        cmocka_unit_test(fans_and_degenerate_joins_are_refused),
        cmocka_unit_test(every_failed_allocation_is_clean),
        cmocka_unit_test(a_search_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
