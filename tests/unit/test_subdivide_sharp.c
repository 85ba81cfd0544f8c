/* What follows from the rules of creases and seams for every mesh. The rules themselves are held beside
 * OpenSubdiv in tests/oracle/test_opensubdiv.cpp. */
#include "tests/support/cage.h"
#include "tests/support/unit.h"

#include <meshtool/subdivide.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static mt_mesh *subdivide(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options)
{
    mt_mesh *refined = NULL;
    mt_status status = mt_subdivide(context, mesh, options, &refined);
    if (status != MT_OK) {
        print_message("%s\n", mt_context_error(context)->message);
    }
    assert_int_equal(status, MT_OK);
    assert_int_equal(mt_mesh_validate(context, refined), MT_OK);
    return refined;
}

typedef void (*cage_check)(mt_context *context, test_random *random, mt_mesh *cage);

static void on_sharp_cages(unsigned count, cage_check check)
{
    test_random random = {77};
    mt_context *context = test_context();
    for (unsigned i = 0; i < count; i++) {
        mt_index columns = 3 + (mt_index)test_random_below(&random, 5);
        mt_mesh *cage = test_cage(context, &random, columns, 4, i % 2 == 0);
        test_sharpen(context, &random, cage);
        check(context, &random, cage);
        mt_mesh_destroy(context, cage);
    }
    test_context_end(context);
}

static void check_unity(mt_context *context, test_random *random, mt_mesh *cage)
{
    mt_vec3 point = {test_random_unit(random), -1e7 * test_random_unit(random), 1e-150 * test_random_unit(random)};
    mt_subdivide_options options = {.level_count = 4, .crease_method = MT_SUBDIVIDE_CREASES_CHAIKIN};
    for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
        mt_mesh_set_position(cage, vertex, point);
    }
    mt_mesh *refined = subdivide(context, cage, &options);
    for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(refined, vertex);
        assert_memory_equal(&p, &point, sizeof p);
    }
    mt_mesh_destroy(context, refined);
}

static void test_partition_of_unity(void **state)
{
    (void)state;
    on_sharp_cages(20, check_unity);
}

static mt_vec3 shear(mt_vec3 p)
{
    return mt_vec3_make(2 * p.x + 0.5 * p.y - p.z + 3, p.y - 0.25 * p.x - 7, 0.75 * p.z + p.x * 0.125 + 1);
}

static void check_affine(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    mt_subdivide_options options = {.level_count = 3};
    mt_mesh *refined = subdivide(context, cage, &options);
    for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
        mt_mesh_set_position(cage, vertex, shear(mt_mesh_position(cage, vertex)));
    }
    mt_mesh *sheared = subdivide(context, cage, &options);
    for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
        mt_vec3 expected = shear(mt_mesh_position(refined, vertex));
        mt_vec3 error = mt_vec3_subtract(mt_mesh_position(sheared, vertex), expected);
        assert_true(mt_vec3_max_abs(error) < 1e-13);
    }
    mt_mesh_destroy(context, sheared);
    mt_mesh_destroy(context, refined);
}

static void test_affine_invariance(void **state)
{
    (void)state;
    on_sharp_cages(10, check_affine);
}

static void check_hull(mt_context *context, test_random *random, mt_mesh *cage)
{
    mt_subdivide_options options = {.level_count = 3};
    mt_mesh *refined = subdivide(context, cage, &options);
    test_expect_within_hull(random, cage, refined);
    mt_mesh_destroy(context, refined);
}

static void test_convex_hull(void **state)
{
    (void)state;
    on_sharp_cages(10, check_hull);
}

/* test_renumbered drops sharpness; this gives the copy the mesh's, by the images of its corners. Later creases of an
 * edge win, so the order stays. */
static void copy_sharpness(mt_context *context, const mt_mesh *cage, const mt_index *images, mt_mesh *copy)
{
    mt_index *vertices = malloc((cage->vertex_count + (size_t)1) * sizeof *vertices);
    assert_non_null(vertices);
    for (mt_index corner = 0; corner < cage->corner_count; corner++) {
        vertices[cage->corner_vertices[corner]] = copy->corner_vertices[images[corner]];
    }
    copy->creases = mt_allocate_array(context, cage->crease_count, sizeof *copy->creases);
    copy->sharp_vertices = mt_allocate_array(context, cage->sharp_vertex_count, sizeof *copy->sharp_vertices);
    for (mt_index i = 0; i < cage->crease_count; i++) {
        const mt_edge_value *crease = &cage->creases[i];
        copy->creases[i] = (mt_edge_value){vertices[crease->b], vertices[crease->a], crease->value};
    }
    for (mt_index i = 0; i < cage->sharp_vertex_count; i++) {
        copy->sharp_vertices[i] =
            (mt_vertex_value){vertices[cage->sharp_vertices[i].vertex], cage->sharp_vertices[i].value};
    }
    copy->crease_count = cage->crease_count;
    copy->sharp_vertex_count = cage->sharp_vertex_count;
    free(vertices);
}

/* Renumbered, turned and reversed faces and mirrored positions: the same numbers to the last bit, mirrored. */
static void check_symmetry(mt_context *context, test_random *random, mt_mesh *cage)
{
    mt_index *images = malloc(cage->corner_count * sizeof *images);
    assert_non_null(images);
    for (int reverse = 0; reverse < 2; reverse++) {
        mt_subdivide_options options = {.crease_method =
                                            reverse ? MT_SUBDIVIDE_CREASES_CHAIKIN : MT_SUBDIVIDE_CREASES_NORMAL};
        mt_mesh *copy = test_renumbered(context, random, cage, reverse, images);
        copy_sharpness(context, cage, images, copy);
        for (mt_index vertex = 0; reverse && vertex < copy->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(copy, vertex);
            mt_mesh_set_position(copy, vertex, mt_vec3_make(-p.y, p.x, p.z));
        }
        mt_mesh *refined = subdivide(context, cage, &options), *other = subdivide(context, copy, &options);
        for (mt_index corner = 0; corner < cage->corner_count; corner++) {
            for (unsigned k = 0; k < 4; k++) {
                mt_index their = other->corner_vertices[4 * (size_t)images[corner] + (reverse ? (4 - k) % 4 : k)];
                mt_vec3 p = mt_mesh_position(refined, refined->corner_vertices[4 * (size_t)corner + k]);
                mt_vec3 q = mt_mesh_position(other, their);
                q = reverse ? mt_vec3_make(q.y, -q.x, q.z) : q;
                assert_true(p.x == q.x && p.y == q.y && p.z == q.z);
            }
        }
        mt_mesh_destroy(context, other);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, copy);
    }
    free(images);
}

static void test_renumbering_and_mirrors(void **state)
{
    (void)state;
    on_sharp_cages(40, check_symmetry);
}

/* Sharpness that is left is passed on: level by level is as all levels at once. */
static void check_levels(mt_context *context, test_random *random, mt_mesh *cage)
{
    (void)random;
    for (int method = MT_SUBDIVIDE_CREASES_NORMAL; method <= MT_SUBDIVIDE_CREASES_CHAIKIN; method++) {
        mt_subdivide_options options = {.level_count = 1, .crease_method = (mt_subdivide_crease_method)method};
        mt_mesh *mesh = subdivide(context, cage, &options);
        for (unsigned level = 2; level <= 4; level++) {
            mt_mesh *next = subdivide(context, mesh, &options);
            mt_mesh_destroy(context, mesh);
            mesh = next;
        }
        options.level_count = 4;
        mt_mesh *at_once = subdivide(context, cage, &options);
        assert_memory_equal(at_once->positions, mesh->positions, 24 * (size_t)mesh->vertex_count);
        assert_memory_equal(at_once->corner_vertices, mesh->corner_vertices, 4 * (size_t)mesh->corner_count);
        mt_mesh_destroy(context, at_once);
        mt_mesh_destroy(context, mesh);
    }
}

static void test_level_by_level(void **state)
{
    (void)state;
    on_sharp_cages(10, check_levels);
}

static void test_threads_do_not_matter(void **state)
{
    (void)state;
    static const unsigned threads[] = {1, 2, 7};
    mt_subdivide_options options = {.level_count = 3, .face_varying = MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1};
    uint64_t hashes[3];
    for (unsigned i = 0; i < 3; i++) {
        test_random random = {5};
        mt_context *context = test_context_with_threads(threads[i]);
        mt_mesh *cage = test_cage(context, &random, 70, 50, i == 3);
        test_sharpen(context, &random, cage);
        test_add_uvs(context, &random, cage);
        mt_mesh *refined = subdivide(context, cage, &options);
        hashes[i] = test_mesh_hash(refined);
        mt_mesh_destroy(context, refined);
        mt_mesh_destroy(context, cage);
        test_context_end(context);
    }
    assert_int_equal(hashes[0], hashes[1]);
    assert_int_equal(hashes[0], hashes[2]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_partition_of_unity), cmocka_unit_test(test_affine_invariance),
        cmocka_unit_test(test_convex_hull),        cmocka_unit_test(test_renumbering_and_mirrors),
        cmocka_unit_test(test_level_by_level),     cmocka_unit_test(test_threads_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
