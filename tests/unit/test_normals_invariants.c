/* What must not change normals, bit for bit: quarter turns, scaling by powers of two, the number of threads. What may
 * change them by rounding alone: moving, the order of faces, where a face begins. */
#include "tests/support/unit.h"

#include "tests/support/cage.h"
#include "tests/support/normals_reference.h"
#include "tests/support/zoo.h"

#include <math.h>
#include <string.h>

typedef mt_vec3 (*change)(mt_vec3 p);

static mt_vec3 to_yzx(mt_vec3 p)
{
    return mt_vec3_make(p.y, p.z, p.x);
}
static mt_vec3 about_x(mt_vec3 p)
{
    return mt_vec3_make(p.x, -p.z, p.y);
}
static mt_vec3 about_y(mt_vec3 p)
{
    return mt_vec3_make(p.z, p.y, -p.x);
}
static mt_vec3 about_z(mt_vec3 p)
{
    return mt_vec3_make(-p.y, p.x, p.z);
}

static const mt_normal_options all_options[] = {
    {.weight = MT_NORMAL_WEIGHT_AREA},
    {.weight = MT_NORMAL_WEIGHT_ANGLE},
    {.weight = MT_NORMAL_WEIGHT_MAX},
    {.weight = MT_NORMAL_WEIGHT_UNIFORM},
    {.kind = MT_NORMALS_FACE},
    {.kind = MT_NORMALS_CORNER, .crease_angle = 0.3},
    {.kind = MT_NORMALS_CORNER, .crease_angle = 0.3, .weight = MT_NORMAL_WEIGHT_ANGLE, .reachable_only = true},
};
#define OPTION_COUNT (sizeof all_options / sizeof *all_options)

static mt_domain domain_of(const mt_normal_options *options)
{
    static const mt_domain domains[] = {MT_DOMAIN_VERTEX, MT_DOMAIN_FACE, MT_DOMAIN_CORNER};
    return domains[options->kind];
}

/* Cages of several kinds, some with needles. */
static mt_mesh *make(mt_context *context, test_random *random, mt_index trial)
{
    mt_mesh *mesh = test_cage(context, random, 4 + trial % 5, 4, trial % 2);
    for (mt_index vertex = 0; trial % 3 == 0 && vertex < mesh->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(mesh, vertex);
        mt_mesh_set_position(mesh, vertex, mt_vec3_make(p.x, p.y * 1e-9, p.z));
    }
    if (trial % 4 == 3) {
        assert_int_equal(mt_mesh_set_position_type(context, mesh, MT_F32, NULL), MT_OK);
    }
    return mesh;
}

/* Positions of the copy are `by` of the old, times 2^exponent; its normals must be `by` of the old, bit for bit. */
static void expect_same_bits(mt_context *context, const mt_mesh *mesh, change by, int exponent)
{
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        mt_mesh *first, *second;
        mt_normal_options options = all_options[i];
        options.type = MT_F64;
        assert_int_equal(mt_mesh_copy(context, mesh, &first), MT_OK);
        assert_int_equal(mt_mesh_copy(context, mesh, &second), MT_OK);
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            mt_vec3 p = by(mt_mesh_position(mesh, vertex));
            p = mt_vec3_make(ldexp(p.x, exponent), ldexp(p.y, exponent), ldexp(p.z, exponent));
            mt_mesh_set_position(second, vertex, p);
        }
        assert_int_equal(mt_mesh_add_normals(context, first, &options, NULL), MT_OK);
        assert_int_equal(mt_mesh_add_normals(context, second, &options, NULL), MT_OK);
        mt_domain domain = domain_of(&options);
        for (mt_index element = 0; element < mt_mesh_domain_count(mesh, domain); element++) {
            mt_vec3 a = by(test_stored_normal(first, domain, element)), b = test_stored_normal(second, domain, element);
            if (!(a.x == b.x && a.y == b.y && a.z == b.z)) {
                fail_msg("options %zu, scale 2^%d, element %u: (%.17g %.17g %.17g) became (%.17g %.17g %.17g)", i,
                         exponent, element, a.x, a.y, a.z, b.x, b.y, b.z);
            }
        }
        mt_mesh_destroy(context, first);
        mt_mesh_destroy(context, second);
    }
}

static mt_vec3 stay(mt_vec3 p)
{
    return p;
}

static void test_quarter_turns(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {41};
    const change turns[] = {to_yzx, about_x, about_y, about_z};
    for (mt_index trial = 0; trial < 24; trial++) {
        mt_mesh *mesh = make(context, &random, trial);
        expect_same_bits(context, mesh, turns[trial % 4], 0);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* From where every digit is kept among the subnormal numbers to where differences overflow. */
static void test_powers_of_two(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {42};
    const int exponents[] = {1, -1, 52, -130, 190, -201, -260, 300, -340, -500, 511, 512, 700, -900, -960, 1000, 1018};
    for (mt_index trial = 0; trial < 34; trial++) {
        mt_mesh *mesh = make(context, &random, trial % 3 == 0 ? trial + 1 : trial);
        if (mesh->position_type == MT_F64) {
            expect_same_bits(context, mesh, stay, exponents[trial % 17]);
        }
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

static void test_threads(void **state)
{
    (void)state;
    test_animal animals[TEST_ZOO_ROOM];
    mt_context *context = test_context();
    size_t count = test_zoo(context, animals);
    test_random random = {43};
    animals[count++] = (test_animal){"large cage", test_cage(context, &random, 200, 150, true)};
    for (size_t animal = 0; animal < count; animal++) {
        for (size_t i = 0; i < OPTION_COUNT; i++) {
            uint64_t hash = 0;
            for (unsigned threads = 1; threads <= 11; threads += 1 + threads / 3) {
                mt_context *with = test_context_with_threads(threads);
                mt_mesh *copy;
                assert_int_equal(mt_mesh_copy(with, animals[animal].mesh, &copy), MT_OK);
                assert_int_equal(mt_mesh_add_normals(with, copy, &all_options[i], NULL), MT_OK);
                if (threads > 1 && test_mesh_hash(copy) != hash) {
                    fail_msg("%s, options %zu: %u threads make other bytes", animals[animal].name, i, threads);
                }
                hash = test_mesh_hash(copy);
                mt_mesh_destroy(with, copy);
                test_context_end(with);
            }
        }
    }
    test_zoo_end(context, animals, count);
    test_context_end(context);
}

/* Adds the same normals to both; the largest angle between those of elements and of their images. */
static double largest_angle(mt_context *context, mt_mesh *a, mt_mesh *b, const mt_normal_options *options,
                            const mt_index *images)
{
    mt_domain domain = domain_of(options);
    assert_int_equal(mt_mesh_add_normals(context, a, options, NULL), MT_OK);
    assert_int_equal(mt_mesh_add_normals(context, b, options, NULL), MT_OK);
    double largest = 0;
    for (mt_index i = 0; i < mt_mesh_domain_count(a, domain); i++) {
        mt_index image = images ? images[i] : i;
        double angle = test_angle_between(test_stored_normal(a, domain, i), test_stored_normal(b, domain, image));
        largest = fmax(largest, angle);
    }
    return largest;
}

/* Moved by 2^20 steps of 2^-20 that the positions are rounded to first: positions stay exact, and normals the same. */
static void test_moving(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {44};
    for (mt_index trial = 0; trial < 12; trial++) {
        mt_mesh *mesh = test_cage(context, &random, 5, 4, trial % 2), *moved;
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(mesh, vertex);
            p = mt_vec3_make(rint(p.x * 0x1p20), rint(p.y * 0x1p20), rint(p.z * 0x1p20));
            mt_mesh_set_position(mesh, vertex, mt_vec3_scale(p, 0x1p-20));
        }
        assert_int_equal(mt_mesh_copy(context, mesh, &moved), MT_OK);
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            mt_vec3 p = mt_mesh_position(mesh, vertex);
            mt_mesh_set_position(moved, vertex, mt_vec3_add(p, mt_vec3_make(0x1p30, -0x1p29, 0x1p31)));
        }
        for (size_t i = 0; i < OPTION_COUNT; i++) {
            assert_true(largest_angle(context, mesh, moved, &all_options[i], NULL) == 0);
        }
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, moved);
    }
    test_context_end(context);
}

static void test_order_of_faces_and_corners(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {45};
    for (mt_index trial = 0; trial < 12; trial++) {
        mt_mesh *mesh = test_cage(context, &random, 6, 5, trial % 2);
        mt_index *images = mt_allocate_array(context, mesh->corner_count, sizeof *images);
        mt_mesh *other = test_renumbered(context, &random, mesh, false, images);
        for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
            mt_normal_options options = {.kind = MT_NORMALS_CORNER, .weight = weight, .crease_angle = 0.4};
            assert_true(largest_angle(context, mesh, other, &options, images) < 1e-13);
        }
        mt_free(context, images);
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, other);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_quarter_turns),
        cmocka_unit_test(test_powers_of_two),
        cmocka_unit_test(test_threads),
        cmocka_unit_test(test_moving),
        cmocka_unit_test(test_order_of_faces_and_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
