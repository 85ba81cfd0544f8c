/* Meshes that break naive programs: each is what its name says, at its default and at the ends of its range. */
#include "tests/support/census.h"
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include <meshtool/generate.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static mt_mesh *make(mt_context *context, const char *name, double magnitude)
{
    char full[64];
    mt_generate_options options = {.magnitude = magnitude, .has_magnitude = true};
    mt_mesh *mesh = NULL;
    snprintf(full, sizeof full, "extreme:%s", name);
    assert_int_equal(mt_generate(context, full, &options, &mesh), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    return mesh;
}

/* Magnitudes that a test can afford. */
static double affordable(const mt_extreme *extreme, double magnitude)
{
    return extreme->is_whole && magnitude > 20000 && magnitude > extreme->magnitude ? 20000 : magnitude;
}

static void test_every_extreme_of_the_table(void **state)
{
    (void)state;
    size_t count;
    const mt_extreme *extremes = mt_extremes(&count);
    mt_context *context = test_context();
    assert_true(count >= 19);
    for (size_t i = 0; i < count; i++) {
        const double magnitudes[] = {extremes[i].magnitude, extremes[i].minimum, extremes[i].maximum};
        for (size_t k = 0; k < 3; k++) {
            mt_mesh *mesh = make(context, extremes[i].name, affordable(&extremes[i], magnitudes[k]));
            mt_bounds bounds = mt_mesh_bounds(mesh);
            bool is_spoilt = strcmp(extremes[i].name, "non-finite") == 0;
            assert_true(is_spoilt || bounds.non_finite_count == 0);
            mt_mesh_destroy(context, mesh);
        }
    }
    test_context_end(context);
}

/* Closed, or with so many boundary loops, or turned over. */
static void test_shapes(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double magnitude;
        size_t vertices, faces, boundary_edges, misoriented, components;
    } expected[] = {
        {"offset", 1e7, 512, 512, 0, 0, 1},
        {"scale", 1e-150, 512, 512, 0, 0, 1},
        {"sliver", 1e12, 8, 12, 0, 0, 1},
        {"flat", 0, 8, 12, 0, 0, 1},
        {"nearly-flat", 1e-15, 4, 4, 0, 0, 1},
        {"pole", 50, 102, 100, 0, 0, 1},
        {"pole", 3, 8, 6, 0, 0, 1},
        {"valence", 1000, 1001, 1000, 1000, 0, 1},
        {"walls", 4e-5, 8, 4, 8, 0, 2},
        {"polygon", 1000, 1000, 1, 1000, 0, 1},
        {"crease", 8, 16, 10, 0, 0, 1},
        {"duplicates", 7, 21, 7, 21, 0, 7},
        {"centroids", 5, 15, 5, 15, 0, 5},
        {"empty", 3, 3, 0, 0, 0, 0},
    };
    mt_context *context = test_context();
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        mt_mesh *mesh = make(context, expected[i].name, expected[i].magnitude);
        test_census census = test_census_of(mesh);
        assert_int_equal(census.vertices, expected[i].vertices);
        assert_int_equal(census.faces, expected[i].faces);
        assert_int_equal(census.boundary_edges, expected[i].boundary_edges);
        assert_int_equal(census.misoriented_edges, expected[i].misoriented);
        assert_int_equal(census.components, expected[i].components);
        assert_int_equal(census.non_manifold_edges, 0);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* What the magnitude stands for. */
static void test_magnitudes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = make(context, "offset", 1e9);
    assert_true(mt_mesh_bounds(mesh).minimum.x > 9e8);
    mt_mesh_destroy(context, mesh);
    mesh = make(context, "sliver", 1e12);
    mt_bounds bounds = mt_mesh_bounds(mesh);
    assert_true(bounds.maximum.x == 1 && bounds.maximum.y == 1e-12);
    mt_mesh_destroy(context, mesh);
    mesh = make(context, "non-finite", 7);
    assert_int_equal(mt_mesh_bounds(mesh).non_finite_count, 7);
    mt_mesh_destroy(context, mesh);
    mesh = make(context, "winding", 1);
    assert_int_equal(test_census_of(mesh).misoriented_edges, 0); /* all turned over agree again */
    mt_mesh_destroy(context, mesh);
    mesh = make(context, "walls", 0x1p-20);
    assert_true(mt_mesh_bounds(mesh).maximum.y == 0x1p-20);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void refuse(const char *name, const mt_generate_options *options, const char *reason)
{
    mt_context *context = test_context();
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_generate(context, name, options, &mesh), MT_ERROR_ARGUMENT);
    assert_null(mesh);
    assert_non_null(strstr(mt_context_error(context)->message, reason));
    mt_context_clear_error(context);
    test_context_end(context);
}

static void test_refusals(void **state)
{
    (void)state;
    refuse("extreme:nothing", NULL, "no extreme is called 'extreme:nothing'; known are offset, ");
    refuse("extreme:offset", &(mt_generate_options){.resolution = 3}, "has no resolution");
    refuse("extreme:sliver", &(mt_generate_options){.magnitude = 0.5, .has_magnitude = true},
           "from 1 to 1e+300, not 0.5");
    refuse("extreme:valence", &(mt_generate_options){.magnitude = 3.5, .has_magnitude = true}, "whole number");
    refuse("extreme:scale", &(mt_generate_options){.magnitude = (double)NAN, .has_magnitude = true}, "not nan");
    refuse("cube", &(mt_generate_options){.magnitude = 1, .has_magnitude = true}, "has no magnitude");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_extreme_of_the_table),
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_magnitudes),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
