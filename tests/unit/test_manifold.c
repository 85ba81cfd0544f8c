/* The manifold check against a reference written from the definitions, on thousands of broken soups, and on shapes
 * whose answers are known. */
#include "tests/support/manifold_reference.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/self_intersection.h>
#include <meshtool/weld.h>

#include <math.h>
#include <string.h>

static void expect_same_counts(const mt_manifold_report *report, const mt_manifold_report *expected)
{
    assert_int_equal(report->vertex_count, expected->vertex_count);
    assert_int_equal(report->face_count, expected->face_count);
    assert_int_equal(report->corner_count, expected->corner_count);
    assert_int_equal(report->triangle_count, expected->triangle_count);
    assert_int_equal(report->edge_count, expected->edge_count);
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        if (report->defect_counts[kind] != expected->defect_counts[kind]) {
            fail_msg("%s: %u, expected %u", mt_defect_key(kind), report->defect_counts[kind],
                     expected->defect_counts[kind]);
        }
    }
    assert_int_equal(report->component_count, expected->component_count);
    assert_int_equal(report->boundary_loop_count, expected->boundary_loop_count);
    assert_int_equal(report->euler_characteristic, expected->euler_characteristic);
    assert_int_equal(report->manifold_class, expected->manifold_class);
    assert_int_equal(report->oriented, expected->oriented);
    assert_int_equal(report->orientable, expected->orientable);
    assert_int_equal(report->has_genus, expected->has_genus);
    assert_int_equal(report->genus, expected->genus);
    assert_int_equal(report->has_volume, expected->has_volume);
}

/* An element that the reference calls a defect of that kind, told by its first vertex or last face. */
static bool reference_agrees(const mt_mesh *mesh, const mt_defect *defect)
{
    switch (defect->kind) {
    case MT_DEFECT_NON_FINITE_VERTEX:
    case MT_DEFECT_NON_MANIFOLD_VERTEX:
    case MT_DEFECT_ISOLATED_VERTEX:
    case MT_DEFECT_BOUNDARY_PINCH:
        return defect->vertex_count == 1 && test_vertex_is_defect(mesh, defect->kind, defect->vertices[0]);
    case MT_DEFECT_DEGENERATE_FACE:
    case MT_DEFECT_DUPLICATE_FACE:
    case MT_DEFECT_ZERO_AREA_FACE:
    case MT_DEFECT_INSIDE_OUT_COMPONENT:
        return defect->face_count >= 1 &&
               test_face_is_defect(mesh, defect->kind, defect->faces[defect->face_count - 1]);
    case MT_DEFECT_SELF_INTERSECTION: /* not asked for where the reference is */
        return false;
    default:
        return defect->vertex_count == 2 &&
               test_edge_is_defect(mesh, defect->kind, defect->vertices[0], defect->vertices[1]);
    }
}

static void expect_lists(const mt_mesh *mesh, const mt_manifold_report *report, uint64_t limit)
{
    mt_index counts[MT_DEFECT_KIND_COUNT] = {0};
    for (size_t i = 0; i < report->defect_list_count; i++) {
        const mt_defect *defect = &report->defects[i];
        assert_true(i == 0 || report->defects[i - 1].kind <= defect->kind);
        assert_true(i == 0 || report->defects[i - 1].kind != defect->kind ||
                    !test_is_same_element(&report->defects[i - 1], defect));
        assert_true(reference_agrees(mesh, defect));
        for (mt_index v = 0; v < defect->vertex_count; v++) {
            assert_in_range(defect->vertices[v], 0, mesh->vertex_count - 1);
        }
        for (mt_index f = 0; f < defect->face_count; f++) {
            assert_in_range(defect->faces[f], 0, mesh->face_count - 1);
        }
        counts[defect->kind]++;
    }
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        uint64_t expected = report->defect_counts[kind] < limit ? report->defect_counts[kind] : limit;
        assert_int_equal(counts[kind], expected);
    }
}

/* `size` is the largest coordinate's; the reference can tell signs of volumes only of coordinates of few bits. */
static void expect_reference(mt_context *context, const mt_mesh *mesh, uint64_t limit, double size, bool has_few_bits)
{
    mt_manifold_report report, expected;
    mt_manifold_options options = {.defects_per_kind = limit, .inside_out = has_few_bits};
    assert_int_equal(mt_check_manifold(context, mesh, &options, &report), MT_OK);
    test_manifold_reference(mesh, &expected);
    if (!has_few_bits) {
        expected.defect_counts[MT_DEFECT_INSIDE_OUT_COMPONENT] = 0;
    }
    expect_same_counts(&report, &expected);
    expect_lists(mesh, &report, limit);
    if (!mesh->face_offsets && mesh->face_size == 3) {
        assert_true(fabs(report.area - expected.area) <= 1e-13 * (size * size + expected.area));
        assert_true(!report.has_volume ||
                    fabs(report.volume - expected.volume) <= 1e-12 * (size * size + expected.area) * size);
    }
    mt_manifold_report_release(context, &report);
}

static void soups_agree_with_the_reference(void **state)
{
    (void)state;
    test_random random = {4711};
    for (int i = 0; i < 6000; i++) {
        mt_context *context = test_context_with_threads(i % 4 ? 1 : 3);
        mt_mesh *mesh = test_soup(context, &random);
        expect_reference(context, mesh, i % 5 ? UINT64_MAX : 1, 1, true);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void patches_agree_with_the_reference(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {815};
    for (int i = 0; i < 400; i++) {
        mt_mesh *mesh = test_patch(context, &random);
        expect_reference(context, mesh, UINT64_MAX, 1, true);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Far from the origin, where products lose what the differences have, and so small or large that products under- and
 * overflow. */
static void moved_and_scaled_meshes_agree_with_the_reference(void **state)
{
    (void)state;
    static const struct {
        double offset, factor, size;
        bool has_few_bits;
    } changes[] = {{1e7, 1, 1e7, true},
                   {1e7 + 1.0 / 3, 1, 1e7, false},
                   {0, 1e-30, 1e-30, false},
                   {0, 1e30, 1e30, false},
                   {0, 0x1p-1000, 0x1p-340, true}};
    test_random random = {1e7};
    for (int i = 0; i < 1500; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = i % 4 ? test_soup(context, &random) : test_patch(context, &random);
        int change = i % (int)(sizeof changes / sizeof changes[0]);
        double *coordinates = mesh->positions;
        for (size_t c = 0; c < 3 * (size_t)mesh->vertex_count; c++) {
            coordinates[c] = coordinates[c] * changes[change].factor + changes[change].offset;
        }
        expect_reference(context, mesh, UINT64_MAX, changes[change].size, changes[change].has_few_bits);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

/* A shape and what must be said of it. */
typedef struct known_shape {
    const char *name;
    mt_index vertex_count, face_count;
    mt_index faces[64];
    mt_manifold_class manifold_class;
    int64_t euler_characteristic;
    mt_index boundary_loop_count;
    mt_answer oriented, orientable;
    int genus; /* -1: none */
    mt_defect_kind kind;
    mt_index kind_count;
} known_shape;

static const known_shape shapes[] = {
    {"tetrahedron",
     4,
     4,
     {3, 0, 2, 1, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3},
     MT_MANIFOLD,
     2,
     0,
     MT_YES,
     MT_YES,
     0,
     MT_DEFECT_BOUNDARY_EDGE,
     0},
    {"one triangle",
     3,
     1,
     {3, 0, 1, 2},
     MT_MANIFOLD_WITH_BOUNDARY,
     1,
     1,
     MT_YES,
     MT_YES,
     0,
     MT_DEFECT_BOUNDARY_EDGE,
     3},
    {"no face", 3, 0, {0}, MT_MANIFOLD_WITH_BOUNDARY, 0, 0, MT_YES, MT_YES, 0, MT_DEFECT_ISOLATED_VERTEX, 3},
    {"two sides of one triangle",
     3,
     2,
     {3, 0, 1, 2, 3, 2, 1, 0},
     MT_MANIFOLD,
     2,
     0,
     MT_YES,
     MT_YES,
     0,
     MT_DEFECT_DUPLICATE_FACE,
     1},
    {"book",
     5,
     3,
     {3, 0, 1, 2, 3, 1, 0, 3, 3, 0, 1, 4},
     MT_NON_MANIFOLD,
     1,
     MT_NONE,
     MT_UNDEFINED,
     MT_UNDEFINED,
     -1,
     MT_DEFECT_NON_MANIFOLD_EDGE,
     1},
    {"bow-tie",
     5,
     2,
     {3, 0, 1, 2, 3, 2, 3, 4},
     MT_NON_MANIFOLD,
     1,
     MT_NONE,
     MT_YES,
     MT_YES,
     -1,
     MT_DEFECT_NON_MANIFOLD_VERTEX,
     1},
    {"one face turned",
     4,
     4,
     {3, 0, 1, 2, 3, 0, 1, 3, 3, 1, 2, 3, 3, 2, 0, 3},
     MT_MANIFOLD,
     2,
     0,
     MT_NO,
     MT_YES,
     0,
     MT_DEFECT_MISORIENTED_EDGE,
     3},
    {"Moebius strip",
     6,
     3,
     {4, 0, 1, 4, 3, 4, 1, 2, 5, 4, 4, 2, 3, 0, 5},
     MT_MANIFOLD_WITH_BOUNDARY,
     0,
     1,
     MT_NO,
     MT_NO,
     -1,
     MT_DEFECT_MISORIENTED_EDGE,
     1},
    {"projective plane",
     6,
     10,
     {3, 0, 1, 2, 3, 0, 2, 3, 3, 0, 3, 4, 3, 0, 4, 5, 3, 0, 5, 1,
      3, 1, 2, 4, 3, 2, 3, 5, 3, 3, 4, 1, 3, 4, 5, 2, 3, 5, 1, 3},
     MT_MANIFOLD,
     1,
     0,
     MT_NO,
     MT_NO,
     -1,
     MT_DEFECT_BOUNDARY_EDGE,
     0},
    {"a face that names a vertex twice",
     4,
     1,
     {4, 0, 1, 0, 2},
     MT_NON_MANIFOLD,
     2,
     MT_NONE,
     MT_YES,
     MT_YES,
     -1,
     MT_DEFECT_DEGENERATE_FACE,
     1},
    {"a point as a face",
     1,
     2,
     {3, 0, 0, 0, 3, 0, 0, 0},
     MT_NON_MANIFOLD,
     3,
     MT_NONE,
     MT_YES,
     MT_YES,
     -1,
     MT_DEFECT_DUPLICATE_FACE,
     1},
};

static void known_shapes_are_known(void **state)
{
    (void)state;
    mt_context *context = test_context();
    double positions[30];
    for (int i = 0; i < 30; i++) {
        positions[i] = (double)(i * i * i % 17);
    }
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const known_shape *shape = &shapes[i];
        mt_mesh *mesh = test_mesh(context, shape->vertex_count, positions, shape->face_count, shape->faces);
        mt_manifold_report report;
        assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
        bool right = report.manifold_class == shape->manifold_class &&
                     report.euler_characteristic == shape->euler_characteristic &&
                     report.boundary_loop_count == shape->boundary_loop_count && report.oriented == shape->oriented &&
                     report.orientable == shape->orientable && report.has_genus == (shape->genus >= 0) &&
                     (shape->genus < 0 || report.genus == shape->genus) &&
                     report.defect_counts[shape->kind] == shape->kind_count;
        if (!right) {
            fail_msg("%s: class %d, Euler characteristic %d, loops %u, oriented %d, orientable %d, genus %d, %u %s",
                     shape->name, (int)report.manifold_class, (int)report.euler_characteristic,
                     report.boundary_loop_count, (int)report.oriented, (int)report.orientable, (int)report.genus,
                     report.defect_counts[shape->kind], mt_defect_key(shape->kind));
        }
        mt_manifold_report_release(context, &report);
        expect_reference(context, mesh, UINT64_MAX, 1, true);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void kinds_have_names(void **state)
{
    (void)state;
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        assert_true(strlen(mt_defect_key(kind)) > 5);
        assert_true(strlen(mt_defect_words(kind)) > 5);
        assert_null(strchr(mt_defect_words(kind), '_'));
    }
}

static uint64_t hash_report(unsigned threads, bool shuffled)
{
    mt_context *context = test_context_with_threads(threads);
    mt_mesh *mesh = test_torus(context, 300, 200, shuffled);
    test_random random = {3};
    for (int i = 0; i < 50; i++) {
        mt_index corner = (mt_index)test_random_below(&random, mesh->corner_count);
        mesh->corner_vertices[corner] = (mt_index)test_random_below(&random, mesh->vertex_count);
    }
    mt_manifold_report report;
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    uint64_t hash = test_hash(report.defect_counts, sizeof report.defect_counts);
    hash = hash * 31 + test_hash(&report.area, sizeof report.area);
    hash = hash * 31 + test_hash(&report.volume, sizeof report.volume);
    hash = hash * 31 + report.component_count;
    for (size_t i = 0; i < report.defect_list_count; i++) {
        const mt_defect *defect = &report.defects[i];
        hash = hash * 31 + test_hash(defect->vertices, defect->vertex_count * sizeof(mt_index));
        hash = hash * 31 + test_hash(defect->faces, defect->face_count * sizeof(mt_index));
    }
    assert_true(report.defect_counts[MT_DEFECT_BOUNDARY_EDGE] > 0);
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    return hash;
}

static void threads_change_nothing(void **state)
{
    (void)state;
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        uint64_t one = hash_report(1, shuffled);
        assert_true(hash_report(2, shuffled) == one);
        assert_true(hash_report(7, shuffled) == one);
    }
}

/* Linear whatever the mesh: each of these would take hours if anything were quadratic. */
static void extremes_are_fast(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_manifold_report report;
    mt_mesh *mesh = test_fan(context, 1000000, true);
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.manifold_class, MT_MANIFOLD_WITH_BOUNDARY);
    assert_int_equal(report.boundary_loop_count, 1);
    mt_manifold_report_release(context, &report);
    for (mt_index c = 0; c < mesh->corner_count; c += 3) { /* a book of a million pages */
        mesh->corner_vertices[c + 1] = 1;
        mesh->corner_vertices[c + 2] = 2 + c / 3 % 999999;
    }
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE], 1);
    assert_int_equal(report.defect_counts[MT_DEFECT_DUPLICATE_FACE], 1);
    assert_int_equal(report.component_count, 1);
    mt_manifold_report_release(context, &report);
    for (mt_index c = 0; c < mesh->corner_count; c++) { /* one face a million times */
        mesh->corner_vertices[c] = c % 3;
    }
    assert_int_equal(mt_check_manifold(context, mesh, NULL, &report), MT_OK);
    assert_int_equal(report.defect_counts[MT_DEFECT_DUPLICATE_FACE], 999999);
    assert_int_equal(report.defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE], 3);
    mt_manifold_report_release(context, &report);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

/* The pairs that the search finds, with the vertices that both faces name. */
static void expect_pairs_listed(const mt_mesh *mesh, const mt_manifold_report *report,
                                const mt_self_intersections *found)
{
    assert_true(report->has_self_intersections);
    assert_int_equal(report->defect_counts[MT_DEFECT_SELF_INTERSECTION], found->pair_count);
    uint64_t at = 0;
    for (size_t i = 0; i < report->defect_list_count; i++) {
        const mt_defect *defect = &report->defects[i];
        if (defect->kind != MT_DEFECT_SELF_INTERSECTION) {
            continue;
        }
        assert_int_equal(defect->face_count, 2);
        assert_int_equal(defect->faces[0], found->pairs[at].a);
        assert_int_equal(defect->faces[1], found->pairs[at++].b);
        for (mt_index v = 0; v < defect->vertex_count; v++) {
            for (int side = 0; side < 2; side++) {
                mt_index c = mt_mesh_face_begin(mesh, defect->faces[side]);
                while (c < mt_mesh_face_end(mesh, defect->faces[side]) &&
                       mesh->corner_vertices[c] != defect->vertices[v]) {
                    c++;
                }
                assert_true(c < mt_mesh_face_end(mesh, defect->faces[side]));
            }
        }
    }
    assert_int_equal(at, found->pair_count);
}

static void self_intersections_are_listed_when_asked_for(void **state)
{
    (void)state;
    test_random random = {815};
    uint64_t total = 0;
    for (int i = 0; i < 500; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = test_soup(context, &random);
        mt_self_intersections found;
        assert_int_equal(mt_find_self_intersections(context, mesh, NULL, &found), MT_OK);
        mt_manifold_options options = {.defects_per_kind = UINT64_MAX, .self_intersections = true};
        mt_manifold_report report;
        assert_int_equal(mt_check_manifold(context, mesh, &options, &report), MT_OK);
        expect_pairs_listed(mesh, &report, &found);
        total += found.pair_count;
        mt_manifold_report_release(context, &report);
        mt_self_intersections_release(context, &found);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(total > 500);
}

/* The same as welding a copy and checking that. */
static void the_welded_mesh_is_told_beside(void **state)
{
    (void)state;
    test_random random = {1066};
    int joined = 0, differing = 0;
    for (int i = 0; i < 2000; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = i % 2 ? test_soup(context, &random) : test_patch(context, &random);
        mt_manifold_options options = {.as_welded = true};
        mt_manifold_report report, expected;
        assert_int_equal(mt_check_manifold(context, mesh, &options, &report), MT_OK);
        assert_true(report.has_as_welded);
        mt_manifold_class before = report.manifold_class;
        mt_manifold_welded welded = report.as_welded;
        mt_index removed = 0;
        assert_int_equal(mt_mesh_weld(context, mesh, &removed), MT_OK);
        assert_int_equal(mt_check_manifold(context, mesh, NULL, &expected), MT_OK);
        assert_false(expected.has_as_welded);
        assert_int_equal(welded.manifold_class, expected.manifold_class);
        assert_int_equal(welded.vertex_count, expected.vertex_count);
        assert_int_equal(welded.boundary_edge_count, expected.defect_counts[MT_DEFECT_BOUNDARY_EDGE]);
        assert_int_equal(welded.non_manifold_edge_count, expected.defect_counts[MT_DEFECT_NON_MANIFOLD_EDGE]);
        assert_int_equal(welded.non_manifold_vertex_count, expected.defect_counts[MT_DEFECT_NON_MANIFOLD_VERTEX]);
        joined += removed > 0;
        differing += before != expected.manifold_class;
        mt_manifold_report_release(context, &report);
        mt_manifold_report_release(context, &expected);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
    assert_true(joined > 100 && differing > 10);
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    for (uint64_t nth = 1; nth < 120; nth++) {
        mt_context *maker = test_context();
        test_random random = {nth % 7 + 40};
        mt_mesh *mesh = test_soup(maker, &random);
        mt_context_options options = {.failing_allocation = nth};
        mt_context *context = mt_context_create(&options);
        mt_manifold_options how = {
            .self_intersections = nth % 2 == 0, .inside_out = nth % 5 != 0, .as_welded = nth % 3 == 0};
        mt_manifold_report report;
        mt_status status = mt_check_manifold(context, mesh, &how, &report);
        assert_true(status == MT_OK || status == MT_ERROR_OUT_OF_MEMORY);
        assert_int_equal(mt_context_error(context)->status, status);
        if (status != MT_OK) {
            assert_null(report.defects);
        }
        mt_manifold_report_release(context, &report);
        test_context_end(context);
        mt_mesh_destroy(maker, mesh);
        test_context_end(maker);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soups_agree_with_the_reference),
        cmocka_unit_test(patches_agree_with_the_reference),
        cmocka_unit_test(moved_and_scaled_meshes_agree_with_the_reference),
        cmocka_unit_test(known_shapes_are_known),
        cmocka_unit_test(kinds_have_names),
        cmocka_unit_test(threads_change_nothing),
        cmocka_unit_test(extremes_are_fast),
        cmocka_unit_test(self_intersections_are_listed_when_asked_for),
        cmocka_unit_test(the_welded_mesh_is_told_beside),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
