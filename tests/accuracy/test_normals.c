/* How right vertex normals are: beside the analytic normals of spheres and tori, tessellated evenly, unevenly and by
 * needles; and at the extremes of scale, offset, shape and valence, beside normals in 113 bits, where two errors are
 * told apart: what rounding the positions to the stored precision loses, which nothing can bring back, and what we add.
 */
#include "tests/support/unit.h"

#include "tests/support/fixture.h"
#include "tests/support/normals_reference.h"

#include <meshtool/elementary.h>
#include <meshtool/generate.h>

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Against what is known in closed form */

static const char *const weight_names[] = {"area", "angle", "max", "uniform"};

typedef mt_vec3 (*analytic_normal)(mt_vec3 p);

static mt_vec3 normal_of_sphere(mt_vec3 p)
{
    return p;
}

/* Of radii 1 and 0.4 around z. */
static mt_vec3 normal_of_torus(mt_vec3 p)
{
    double ring = sqrt(p.x * p.x + p.y * p.y);
    return mt_vec3_make(p.x - p.x / ring, p.y - p.y / ring, p.z);
}

static mt_vec3 sphere_point(double u, double v)
{
    double down = 0.2 + 2.7 * v; /* a band without the poles */
    return mt_vec3_make(mt_sin(down) * mt_cos(u), mt_sin(down) * mt_sin(u), mt_cos(down));
}

static mt_vec3 torus_point(double u, double v)
{
    double ring = 1 + 0.4 * mt_cos(2 * MT_PI * v);
    return mt_vec3_make(ring * mt_cos(u), ring * mt_sin(u), 0.4 * mt_sin(2 * MT_PI * v));
}

/* A grid around u, rolled in v too when `closed`; `uneven`: steps between 0.1 and 1.9 of the even ones, and diagonals
 * either way. */
static mt_mesh *make_grid(mt_context *context, mt_vec3 (*point)(double, double), mt_index columns, mt_index rows,
                          bool closed, bool uneven)
{
    mt_mesh_layout layout = {.vertex_count = columns * rows,
                             .face_count = 2 * columns * (closed ? rows : rows - 1),
                             .face_size = 3,
                             .position_type = MT_F64};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    test_random random = {71};
    double *u = malloc(columns * sizeof *u), *v = malloc(rows * sizeof *v);
    assert_true(u && v);
    for (mt_index i = 0; i < columns; i++) {
        u[i] = 2 * MT_PI * (i + (uneven ? 0.9 * test_random_unit(&random) : 0)) / columns;
    }
    for (mt_index j = 0; j < rows; j++) {
        v[j] = (j + (uneven ? 0.9 * test_random_unit(&random) : 0)) / rows;
    }
    mt_index *corner = mesh->corner_vertices;
    for (mt_index i = 0; i < columns; i++) {
        for (mt_index j = 0; j < rows; j++) {
            mt_mesh_set_position(mesh, i * rows + j, point(u[i], v[j]));
            mt_index i1 = (i + 1) % columns, j1 = (j + 1) % rows;
            mt_index a = i * rows + j, b = i1 * rows + j, c = i1 * rows + j1, d = i * rows + j1;
            const mt_index one[] = {a, b, c, a, c, d}, other[] = {a, b, d, b, c, d};
            if (closed || j + 1 < rows) {
                memcpy(corner, uneven && test_random_next(&random) % 2 ? other : one, sizeof one);
                corner += 6;
            }
        }
    }
    free(u);
    free(v);
    return mesh;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct spread {
    double half, most, largest; /* p50, p99, maximum, in degrees */
} spread;

/* Of the errors of normals, on either side; vertices on the boundary, which see half a ring, do not count. */
static spread measure(mt_context *context, mt_mesh *mesh, mt_normal_weight weight, analytic_normal analytic,
                      mt_index rows_at_boundary)
{
    mt_normal_options options = {.weight = weight};
    assert_int_equal(mt_mesh_add_normals(context, mesh, &options, NULL), MT_OK);
    double *errors = malloc(mesh->vertex_count * sizeof *errors);
    assert_non_null(errors);
    mt_index count = 0;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_index row = rows_at_boundary ? vertex % rows_at_boundary : 1;
        if (rows_at_boundary && (row == 0 || row == rows_at_boundary - 1)) {
            continue;
        }
        mt_vec3 n = test_stored_normal(mesh, MT_DOMAIN_VERTEX, vertex);
        double angle = test_angle_between(n, analytic(mt_mesh_position(mesh, vertex))) * (180 / MT_PI);
        errors[count++] = fmin(angle, 180 - angle);
    }
    qsort(errors, count, sizeof *errors, compare_doubles);
    spread result = {errors[count / 2], errors[(size_t)count * 99 / 100], errors[count - 1]};
    free(errors);
    return result;
}

/* Bounds on the largest error, a third above what was measured; Max's weights leave rounding alone on a sphere, and on
 * a torus along its circles. */
typedef struct shape {
    const char *name;
    double bounds[4];
} shape;

static void expect_shape(mt_context *context, mt_mesh *mesh, analytic_normal analytic, mt_index rows, const shape *of)
{
    for (mt_normal_weight weight = MT_NORMAL_WEIGHT_AREA; weight <= MT_NORMAL_WEIGHT_UNIFORM; weight++) {
        spread s = measure(context, mesh, weight, analytic, rows);
        print_message("%-24s %-8s p50 %9.3g  p99 %9.3g  max %9.3g degrees\n", of->name, weight_names[weight], s.half,
                      s.most, s.largest);
        assert_true(s.largest <= of->bounds[weight]);
        assert_true(s.half <= s.most && s.most <= s.largest);
    }
    mt_mesh_destroy(context, mesh);
}

static void test_analytic(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *icosphere;
    mt_generate_options options = {.resolution = 5};
    assert_int_equal(mt_generate(context, "icosphere", &options, &icosphere), MT_OK);
    expect_shape(context, icosphere, normal_of_sphere, 0, &(shape){"icosphere", {0.095, 0.023, 1e-9, 0.113}});
    expect_shape(context, make_grid(context, sphere_point, 128, 64, false, false), normal_of_sphere, 64,
                 &(shape){"sphere, even", {0.1, 0.025, 1e-9, 0.013}});
    expect_shape(context, make_grid(context, sphere_point, 128, 64, false, true), normal_of_sphere, 64,
                 &(shape){"sphere, uneven", {3.3, 1.65, 1e-9, 2}});
    expect_shape(context, make_grid(context, sphere_point, 4000, 24, false, false), normal_of_sphere, 24,
                 &(shape){"sphere, needles", {0.5, 0.0021, 1e-9, 0.0011}});
    expect_shape(context, make_grid(context, torus_point, 256, 128, true, false), normal_of_torus, 0,
                 &(shape){"torus, even", {0.0146, 0.0147, 1e-9, 0.0077}});
    expect_shape(context, make_grid(context, torus_point, 256, 128, true, true), normal_of_torus, 0,
                 &(shape){"torus, uneven", {3.2, 1.45, 1e-9, 2.1}});
    expect_shape(context, make_grid(context, torus_point, 16, 2000, true, false), normal_of_torus, 0,
                 &(shape){"torus, needles", {0.0094, 0.015, 1e-9, 0.008}});
    test_context_end(context);
}

/* At the extremes */

#if LDBL_MANT_DIG == 113
typedef long double quad;
#else
__extension__ typedef __float128 quad;
#endif

typedef struct quad3 {
    quad x, y, z;
} quad3;

static quad3 minus(quad3 a, quad3 b)
{
    return (quad3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static quad3 cross(quad3 a, quad3 b)
{
    return (quad3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static quad dot(quad3 a, quad3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* The angle between two directions of any magnitude; pi when one is none. */
static double angle_between(quad3 a, quad3 b)
{
    quad3 turn = cross(a, b);
    quad squares = dot(a, a) * dot(b, b);
    if (!(squares > 0)) {
        return MT_PI;
    }
    double sine = sqrt((double)(dot(turn, turn) / squares));
    return dot(a, b) < 0 ? MT_PI - asin(fmin(sine, 1)) : asin(fmin(sine, 1));
}

/* Area-weighted sums, not of length 1, of the `points` that stand for the vertices; `lengths` receives the sum of the
 * terms' largest components. */
static void sum_in_quads(const mt_mesh *mesh, const quad3 *points, quad3 *sums, quad *lengths)
{
    memset(sums, 0, mesh->vertex_count * sizeof *sums);
    memset(lengths, 0, mesh->vertex_count * sizeof *lengths);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_index *v = mesh->corner_vertices + 3 * face;
        quad3 n = cross(minus(points[v[1]], points[v[0]]), minus(points[v[2]], points[v[0]]));
        for (int i = 0; i < 3; i++) {
            quad3 *sum = &sums[v[i]];
            *sum = (quad3){sum->x + n.x, sum->y + n.y, sum->z + n.z};
            quad size = n.x < 0 ? -n.x : n.x;
            size += n.y < 0 ? -n.y : n.y;
            lengths[v[i]] += size + (n.z < 0 ? -n.z : n.z);
        }
    }
}

/* What an extreme does to a point. */
typedef quad3 (*distortion)(quad3 p, double magnitude);

static quad3 scaled(quad3 p, double magnitude)
{
    quad s = magnitude;
    return (quad3){p.x * s, p.y * s, p.z * s};
}

static quad3 moved(quad3 p, double magnitude)
{
    quad s = magnitude;
    return (quad3){p.x + s, p.y - s / 3, p.z + s / 7};
}

/* Made thin around a direction that is no axis, so that faces are needles and products cancel. */
static quad3 thinned(quad3 p, double magnitude)
{
    const quad3 along = {(quad)2 / 7, (quad)3 / 7, (quad)6 / 7};
    quad share = 1 / (quad)magnitude, height = dot(p, along) * (1 - share);
    return (quad3){p.x * share + height * along.x, p.y * share + height * along.y, p.z * share + height * along.z};
}

typedef struct outcome {
    double lost;      /* by storing the positions: the largest angle between normals of stored and of true ones */
    double added;     /* by us: the largest angle to the normals of the stored positions, over their conditioning */
    mt_index unknown; /* vertices whose stored positions give no normal */
} outcome;

static quad3 widened(mt_vec3 p)
{
    return (quad3){p.x, p.y, p.z};
}

/* The mesh has the true points rounded to its precision. */
static outcome judge(mt_context *context, mt_mesh *mesh, const quad3 *truth)
{
    size_t count = mesh->vertex_count;
    quad3 *stored = calloc(count, sizeof *stored), *sums = malloc(count * sizeof *sums);
    quad3 *true_sums = malloc(count * sizeof *true_sums);
    quad *lengths = malloc(count * sizeof *lengths);
    assert_true(stored && sums && true_sums && lengths);
    bool finite = true;
    for (mt_index vertex = 0; vertex < count; vertex++) {
        mt_vec3 p = mt_mesh_position(mesh, vertex);
        finite = finite && mt_vec3_is_finite(p);
        stored[vertex] = widened(p);
    }
    sum_in_quads(mesh, truth, true_sums, lengths);
    sum_in_quads(mesh, stored, sums, lengths);
    mt_normal_options options = {.type = MT_F64};
    assert_int_equal(mt_mesh_add_normals(context, mesh, &options, NULL), MT_OK);
    outcome result = {0, 0, 0};
    for (mt_index vertex = 0; vertex < count && finite; vertex++) {
        mt_vec3 n = test_stored_normal(mesh, MT_DOMAIN_VERTEX, vertex);
        quad size = dot(sums[vertex], sums[vertex]);
        result.lost = fmax(result.lost, angle_between(sums[vertex], true_sums[vertex]));
        if (!(size > 0)) {
            result.unknown++;
            continue;
        }
        double share = (double)(size / (lengths[vertex] * lengths[vertex]));
        result.added = fmax(result.added, angle_between(widened(n), sums[vertex]) * sqrt(share));
    }
    result.unknown = finite ? result.unknown : (mt_index)count;
    result.lost = finite ? result.lost : MT_PI;
    free(stored);
    free(sums);
    free(true_sums);
    free(lengths);
    return result;
}

/* Where more than this is lost a precision is said to break. */
#define BROKEN 0.01

/* What plain doubles may add before the careful way sets in (2^-53 over MT_AREA_CANCELLATION), with room. */
#define ADDED_MAXIMUM 1e-9

static outcome expect_extreme(mt_context *context, const mt_mesh *plain, distortion distort, double magnitude,
                              mt_type type)
{
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_copy(context, plain, &mesh), MT_OK);
    quad3 *truth = malloc(mesh->vertex_count * sizeof *truth);
    assert_non_null(truth);
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        truth[vertex] = distort(widened(mt_mesh_position(plain, vertex)), magnitude);
        mt_vec3 p = {(double)truth[vertex].x, (double)truth[vertex].y, (double)truth[vertex].z};
        if (type == MT_F32) { /* at once from the true point */
            p = mt_vec3_make((double)(float)truth[vertex].x, (double)(float)truth[vertex].y,
                             (double)(float)truth[vertex].z);
        }
        mt_mesh_set_position(mesh, vertex, p);
    }
    assert_int_equal(mt_mesh_set_position_type(context, mesh, type, NULL), MT_OK);
    outcome result = judge(context, mesh, truth);
    mt_mesh_destroy(context, mesh);
    free(truth);
    return result;
}

static void expect_row(mt_context *context, const mt_mesh *plain, const char *name, distortion distort,
                       double magnitude, double breaks_at[2])
{
    outcome f32 = expect_extreme(context, plain, distort, magnitude, MT_F32);
    outcome f64 = expect_extreme(context, plain, distort, magnitude, MT_F64);
    print_message("%-9s %8.0e | f32 lost %8.1e added %8.1e unknown %5u | f64 lost %8.1e added %8.1e unknown %5u\n",
                  name, magnitude, f32.lost, f32.added, f32.unknown, f64.lost, f64.added, f64.unknown);
    assert_true(f32.added <= ADDED_MAXIMUM && f64.added <= ADDED_MAXIMUM);
    breaks_at[0] = f32.lost > BROKEN && breaks_at[0] == 0 ? magnitude : breaks_at[0];
    breaks_at[1] = f64.lost > BROKEN && breaks_at[1] == 0 ? magnitude : breaks_at[1];
}

static void expect_series(mt_context *context, const mt_mesh *plain, const char *name, distortion distort,
                          const double *magnitudes, const double expected[2])
{
    double breaks_at[2] = {0, 0};
    for (size_t i = 0; magnitudes[i] > 0; i++) {
        expect_row(context, plain, name, distort, magnitudes[i], breaks_at);
    }
    print_message("%-9s breaks at: f32 %.0e, f64 %.0e (0: nowhere)\n", name, breaks_at[0], breaks_at[1]);
    assert_true(breaks_at[0] == expected[0] && breaks_at[1] == expected[1]);
}

static void test_extremes(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *torus = make_grid(context, torus_point, 40, 24, true, true);
    expect_series(context, torus, "offset", moved,
                  (const double[]){1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 0},
                  (const double[]){1e5, 1e13});
    expect_series(context, torus, "large", scaled,
                  (const double[]){1e10, 1e20, 1e30, 1e38, 1e39, 1e100, 1e150, 1e200, 1e250, 1e300, 1e307, 0},
                  (const double[]){1e39, 0});
    expect_series(context, torus, "small", scaled,
                  (const double[]){1e-10, 1e-20, 1e-30, 1e-38, 1e-40, 1e-41, 1e-45, 1e-100, 1e-150, 1e-200, 1e-250,
                                   1e-300, 1e-310, 1e-320, 0},
                  (const double[]){1e-45, 0});
    expect_series(context, torus, "needles", thinned,
                  (const double[]){1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 0},
                  (const double[]){1e5, 1e14});
    mt_mesh_destroy(context, torus);
    test_context_end(context);
}

static mt_mesh *make_cone(mt_context *context, mt_index n)
{
    mt_mesh_layout layout = {.vertex_count = n + 1, .face_count = n, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    mt_mesh_set_position(mesh, 0, mt_vec3_make(0.125, 0.25, 1));
    for (mt_index i = 0; i < n; i++) {
        double at = 2 * MT_PI * i / n;
        mt_mesh_set_position(mesh, i + 1, mt_vec3_make(mt_cos(at), mt_sin(at), 0));
        const mt_index face[] = {0, i + 1, (i + 1) % n + 1};
        memcpy(mesh->corner_vertices + 3 * i, face, sizeof face);
    }
    return mesh;
}

/* A vertex of up to a million faces: sums in plain doubles lose a ten-thousandth of the last place a face. */
static void test_valence(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (mt_index n = 100; n <= 1000000; n *= 10) {
        mt_mesh *cone = make_cone(context, n);
        outcome tip = expect_extreme(context, cone, scaled, 1, MT_F64);
        assert_int_equal(tip.unknown, 0);
        print_message("valence   %8u | f64 lost %8.1e added %8.1e\n", n, tip.lost, tip.added);
        assert_true(tip.lost == 0 && tip.added < 1e-11);
        mt_mesh_destroy(context, cone);
    }
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_analytic),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_valence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
