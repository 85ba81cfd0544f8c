/* The limit of Catmull-Clark and Loop: a vertex goes to the same point, with the same normal, whichever level is asked
 * for it, and finer levels come near to both. The comparison with OpenSubdiv is in tests/oracle/test_opensubdiv.cpp. */
#include "tests/support/cage.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>
#include <meshtool/triangulate.h>

#include <math.h>
#include <string.h>

/* Edges are 32 times shorter five levels on, and the roundings of their ends weigh as much more; where the two tangents
 * are nearly one they weigh more still. */
#define NORMAL_TOLERANCE 1e-9

/* A cage and what is sharp on it. */
typedef struct sharp_case {
    const char *name;
    double crease, corner; /* sharpness of random edges and vertices; 0: none; below 0: of any, at random */
    bool chaikin, sheet;
    mt_subdivide_boundary boundary;
    mt_subdivide_scheme scheme;
} sharp_case;

static const sharp_case cases[] = {
    {.name = "smooth"},
    {.name = "boundary", .sheet = true},
    {.name = "boundary with corners", .sheet = true, .boundary = MT_SUBDIVIDE_BOUNDARY_CORNERS},
    {.name = "half a level", .crease = 0.5},
    {.name = "semi-sharp creases", .crease = 2.5},
    {.name = "semi-sharp corners", .corner = 1.5},
    {.name = "infinite creases", .crease = 10},
    {.name = "infinite corners", .corner = 10},
    {.name = "creases of any sharpness", .crease = -1, .corner = -1, .sheet = true},
    {.name = "Chaikin's creases", .crease = -1, .chaikin = true, .sheet = true},
    {.name = "triangles", .scheme = MT_SUBDIVIDE_SCHEME_LOOP},
    {.name = "triangles with a boundary", .scheme = MT_SUBDIVIDE_SCHEME_LOOP, .sheet = true},
    {.name = "triangles and infinite creases", .scheme = MT_SUBDIVIDE_SCHEME_LOOP, .crease = 10},
    {.name = "triangles and creases", .scheme = MT_SUBDIVIDE_SCHEME_LOOP, .crease = -1, .corner = -1, .sheet = true},
};

static double some_sharpness(test_random *random, double asked)
{
    static const double any[] = {0.25, 0.5, 1, 1.75, 2.5, 4, 10};
    return asked < 0 ? any[test_random_below(random, 7)] : asked;
}

/* Every eighth side and vertex, so that darts, creases and corners come about. */
static void sharpen(mt_context *context, test_random *random, const sharp_case *sharp, mt_mesh *mesh)
{
    mesh->creases = mt_allocate_array(context, mesh->corner_count, sizeof *mesh->creases);
    mesh->sharp_vertices = mt_allocate_array(context, mesh->vertex_count, sizeof *mesh->sharp_vertices);
    for (mt_index face = 0; sharp->crease != 0 && face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            if (test_random_below(random, 8) == 0) {
                mt_index next = corner + 1 < end ? corner + 1 : begin;
                mesh->creases[mesh->crease_count++] = (mt_edge_value){
                    mesh->corner_vertices[corner], mesh->corner_vertices[next], some_sharpness(random, sharp->crease)};
            }
        }
    }
    for (mt_index vertex = 0; sharp->corner != 0 && vertex < mesh->vertex_count; vertex++) {
        if (test_random_below(random, 8) == 0) {
            mesh->sharp_vertices[mesh->sharp_vertex_count++] =
                (mt_vertex_value){vertex, some_sharpness(random, sharp->corner)};
        }
    }
}

static mt_mesh *limit_of(mt_context *context, const mt_mesh *mesh, const sharp_case *sharp, unsigned level_count)
{
    mt_subdivide_options options = {.level_count = level_count, .limit = true, .boundary = sharp->boundary};
    options.scheme = sharp->scheme;
    options.crease_method = sharp->chaikin ? MT_SUBDIVIDE_CREASES_CHAIKIN : MT_SUBDIVIDE_CREASES_NORMAL;
    mt_mesh *limit = NULL;
    if (mt_subdivide(context, mesh, &options, &limit) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    assert_int_equal(mt_mesh_validate(context, limit), MT_OK);
    return limit;
}

static const mt_attribute *normals_of(const mt_mesh *mesh)
{
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    normals = normals ? normals : mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    assert_non_null(normals);
    return normals;
}

static mt_vec3 normal_at(const mt_mesh *mesh, mt_index corner)
{
    const mt_attribute *normals = normals_of(mesh);
    mt_index element = normals->domain == MT_DOMAIN_CORNER ? corner : mesh->corner_vertices[corner];
    mt_index value = mt_attribute_value_index(normals, element);
    return mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                        mt_attribute_get(normals, value, 2));
}

static mt_vec3 face_normal(const mt_mesh *mesh, mt_index face)
{
    const mt_index *v = mesh->corner_vertices + mesh->face_size * (size_t)face;
    mt_index last = mesh->face_size - 1; /* of a triangle b is a side, too */
    mt_vec3 a = mt_vec3_subtract(mt_mesh_position(mesh, v[2]), mt_mesh_position(mesh, v[0]));
    mt_vec3 b = mt_vec3_subtract(mt_mesh_position(mesh, v[last]), mt_mesh_position(mesh, v[1]));
    return mt_vec3_normalize(mt_vec3_cross(a, b));
}

static double apart(mt_vec3 a, mt_vec3 b)
{
    return mt_vec3_max_abs(mt_vec3_subtract(a, b));
}

/* Per vertex how many edges end there that are sharp for ever, boundaries among them; many when the vertex is. */
static mt_index *count_infinite(mt_context *context, const mt_mesh *limit)
{
    mt_index *infinite = mt_allocate_array_zeroed(context, limit->vertex_count, sizeof *infinite);
    mt_edge_pairs *pairs = NULL;
    assert_int_equal(mt_edge_pairs_create(context, limit, &pairs), MT_OK);
    for (mt_index corner = 0; corner < limit->corner_count; corner++) {
        if (pairs->next_side[corner] == corner) {
            infinite[limit->corner_vertices[corner]]++;
            mt_index begin = corner - corner % limit->face_size;
            infinite[limit->corner_vertices[begin + (corner + 1 - begin) % limit->face_size]]++;
        }
    }
    for (mt_index i = 0; i < limit->crease_count; i++) {
        if (limit->creases[i].value >= 10) {
            infinite[limit->creases[i].a]++;
            infinite[limit->creases[i].b]++;
        }
    }
    for (mt_index i = 0; i < limit->sharp_vertex_count; i++) {
        infinite[limit->sharp_vertices[i].vertex] += limit->sharp_vertices[i].value >= 10 ? 3 : 0;
    }
    mt_edge_pairs_destroy(context, pairs);
    return infinite;
}

/* At each corner of the first level the limit's normals are those of the later one; corners of several faces have no
 * tangent plane, and are left out. Returns how far the later faces there are from them on the mean. */
static double expect_same_normals(const mt_mesh *first, const mt_mesh *later, unsigned shift, const mt_index *infinite)
{
    double sum = 0;
    mt_index count = 0;
    for (mt_index corner = 0; corner < first->corner_count; corner++) {
        mt_index vertex = first->corner_vertices[corner];
        mt_vec3 normal = normal_at(first, corner);
        double error = apart(normal, normal_at(later, corner << shift));
        assert_true(fabs(mt_vec3_length(normal) - 1) < 1e-15);
        if (infinite[vertex] < 3 && !(error < NORMAL_TOLERANCE)) {
            fail_msg("the normal of vertex %u differs by %g", vertex, error);
        }
        sum += infinite[vertex] < 3 ? apart(normal, face_normal(later, (corner << shift) / later->face_size)) : 0;
        count += infinite[vertex] < 3;
    }
    return sum / count;
}

static void expect_same_limit(mt_context *context, const sharp_case *sharp, const mt_mesh *mesh)
{
    mt_mesh *first = limit_of(context, mesh, sharp, 1), *later = limit_of(context, mesh, sharp, 6);
    mt_index *infinite = count_infinite(context, first);
    for (mt_index vertex = 0; vertex < first->vertex_count; vertex++) {
        double error = apart(mt_mesh_position(first, vertex), mt_mesh_position(later, vertex));
        if (!(error < 1e-14)) {
            fail_msg("%s: vertex %u differs by %g", sharp->name, vertex, error);
        }
    }
    double faces = expect_same_normals(first, later, 10, infinite);
    if (!(faces < 0.1)) {
        fail_msg("%s: faces differ from the limit's normals by %g on the mean", sharp->name, faces);
    }
    mt_free(context, infinite);
    mt_mesh_destroy(context, first);
    mt_mesh_destroy(context, later);
}

static void test_levels_agree(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mt_context *context = test_context();
        test_random random = {11 + i};
        mt_mesh *cage = test_cage(context, &random, 9, 7, !cases[i].sheet);
        if (cases[i].scheme == MT_SUBDIVIDE_SCHEME_LOOP) {
            mt_mesh *polygons = cage;
            assert_int_equal(mt_mesh_triangulate(context, polygons, &cage), MT_OK);
            mt_mesh_destroy(context, polygons);
        }
        sharpen(context, &random, &cases[i], cage);
        expect_same_limit(context, &cases[i], cage);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
}

/* Two pyramids base to base, their tips of any valence. */
static mt_mesh *pyramid(mt_context *context, mt_index valence)
{
    double *positions = mt_allocate_array(context, 3 * ((uint64_t)valence + 2), sizeof *positions);
    mt_index *faces = mt_allocate_array(context, 8 * (uint64_t)valence, sizeof *faces);
    for (mt_index i = 0; i < valence; i++) {
        double angle = 2 * 3.14159265358979 * i / valence;
        const double ring[3] = {cos(angle), sin(angle), 0};
        mt_index next = (i + 1) % valence;
        const mt_index upper[4] = {3, i, next, valence}, lower[4] = {3, next, i, valence + 1};
        memcpy(positions + 3 * (size_t)i, ring, sizeof ring);
        memcpy(faces + 8 * (size_t)i, upper, sizeof upper);
        memcpy(faces + 8 * (size_t)i + 4, lower, sizeof lower);
    }
    const double tips[6] = {0, 0, 1, 0, 0, -1};
    memcpy(positions + 3 * (size_t)valence, tips, sizeof tips);
    mt_mesh *mesh = test_mesh(context, valence + 2, positions, 2 * valence, faces);
    mt_free(context, positions);
    mt_free(context, faces);
    return mesh;
}

/* The tip stays on its axis, with the axis as its normal, whether its ring is small or large. */
static void expect_tip(mt_subdivide_scheme scheme)
{
    static const mt_index valences[] = {3, 4, 5, 6, 16, 17, 50, 1000};
    for (size_t i = 0; i < sizeof valences / sizeof *valences; i++) {
        mt_context *context = test_context();
        mt_mesh *mesh = pyramid(context, valences[i]);
        const sharp_case smooth = {.name = "pyramid", .scheme = scheme};
        mt_mesh *limit = limit_of(context, mesh, &smooth, 1), *later = limit_of(context, mesh, &smooth, 3);
        const mt_attribute *normals = normals_of(limit);
        mt_vec3 tip = mt_mesh_position(limit, valences[i]);
        double most = mt_vec3_max_abs(mt_vec3_subtract(tip, mt_mesh_position(later, valences[i])));
        assert_true(most < 1e-14 && fabs(tip.x) < 1e-14 && fabs(tip.y) < 1e-14 && tip.z > 0.1 && tip.z < 1);
        assert_true(mt_attribute_get(normals, valences[i], 2) > 1 - 1e-14);
        mt_mesh_destroy(context, later);
        mt_mesh_destroy(context, limit);
        mt_mesh_destroy(context, mesh);
        test_context_end(context);
    }
}

static void test_valence(void **state)
{
    (void)state;
    expect_tip(MT_SUBDIVIDE_SCHEME_CATMULL_CLARK);
    expect_tip(MT_SUBDIVIDE_SCHEME_LOOP);
}

/* The corner (1, 1, 1) has the neighbours (1, 1, -1) and so on, and the opposite corners (1, -1, -1) and so on: it goes
 * to (9 (1, 1, 1) + 4 (1, 1, 1) - (1, 1, 1)) / 24, from every level. */
static void test_cube_by_hand(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    for (unsigned level_count = 0; level_count < 3; level_count++) {
        mt_subdivide_options options = {.level_count = level_count, .no_levels = level_count == 0, .limit = true};
        mt_mesh *limit = NULL;
        assert_int_equal(mt_subdivide(context, cube, &options, &limit), MT_OK);
        mt_vec3 p = mt_mesh_position(limit, 7);
        assert_true(apart(p, mt_vec3_make(0.5, 0.5, 0.5)) < 1e-15);
        assert_true(apart(normal_at(limit, 0), mt_vec3_normalize(mt_mesh_position(limit, limit->corner_vertices[0]))) <
                    1e-15);
        mt_mesh_destroy(context, limit);
    }
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

static void test_evaluate(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *cube = test_cube(context);
    mt_limit_distance distance;
    mt_subdivide_options options = {.no_levels = true};
    assert_int_equal(mt_subdivide_evaluate(context, cube, &options, &distance), MT_OK);
    /* every corner moves from (1, 1, 1) to its half */
    assert_true(fabs(distance.max - sqrt(0.75)) < 1e-15 && fabs(distance.root_mean_square - distance.max) < 1e-15);
    double before = distance.max;
    for (options = (mt_subdivide_options){.level_count = 1}; options.level_count < 6; options.level_count++) {
        assert_int_equal(mt_subdivide_evaluate(context, cube, &options, &distance), MT_OK);
        assert_true(distance.max < before && distance.root_mean_square <= distance.max);
        assert_true(options.level_count < 3 || fabs(before / distance.max - 4) < 0.1);
        before = distance.max;
    }
    mt_mesh_destroy(context, cube);
    test_context_end(context);
}

/* Masks of level 0 are known for quads; what has other faces is refused by name. */
static void test_level_0_needs_quads(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = pyramid(context, 4), *limit = NULL;
    mt_subdivide_options options = {.no_levels = true, .limit = true};
    assert_int_equal(mt_subdivide(context, mesh, &options, &limit), MT_ERROR_INVALID_MESH);
    assert_null(limit);
    assert_non_null(strstr(mt_context_error(context)->message, "face 0 has 3 sides"));
    mt_context_clear_error(context);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_levels_agree), cmocka_unit_test(test_valence),
                                       cmocka_unit_test(test_cube_by_hand), cmocka_unit_test(test_evaluate),
                                       cmocka_unit_test(test_level_0_needs_quads)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
