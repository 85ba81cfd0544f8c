#include "tests/support/unit.h"

#include "tests/support/normals_reference.h"

#include <math.h>
#include <stdlib.h>

typedef long double real;

typedef struct real3 {
    real x, y, z;
} real3;

static real3 subtract(mt_vec3 a, mt_vec3 b)
{
    return (real3){(real)a.x - (real)b.x, (real)a.y - (real)b.y, (real)a.z - (real)b.z};
}

static real3 cross(real3 a, real3 b)
{
    return (real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static real dot(real3 a, real3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static real3 add_scaled(real3 a, real3 b, real s)
{
    return (real3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static real3 unit(real3 a)
{
    real length = sqrtl(dot(a, a));
    return length > 0 ? (real3){a.x / length, a.y / length, a.z / length} : (real3){0, 0, 0};
}

static mt_vec3 point(const mt_mesh *mesh, mt_index corner)
{
    return mt_mesh_position(mesh, mesh->corner_vertices[corner]);
}

/* About the middle of the vertices, where the library sums about a corner. */
static real3 area_vector(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    mt_vec3 middle = {0, 0, 0};
    for (mt_index c = begin; c < end; c++) {
        middle = mt_vec3_add(middle, mt_vec3_scale(point(mesh, c), 1.0 / (end - begin)));
    }
    real3 sum = {0, 0, 0};
    real lengths = 0;
    for (mt_index c = begin; c < end; c++) {
        mt_index next = c + 1 < end ? c + 1 : begin;
        real3 part = cross(subtract(point(mesh, c), middle), subtract(point(mesh, next), middle));
        sum = add_scaled(sum, part, 1);
        lengths += sqrtl(dot(part, part));
    }
    bool is_something =
        sqrtl(dot(sum, sum)) > 1e-17L * lengths && isfinite(lengths); /* else rounding about the middle */
    return is_something ? sum : (real3){0, 0, 0};
}

static real3 term(const mt_mesh *mesh, const mt_normal_options *options, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    real3 area = area_vector(mesh, face), normal = unit(area);
    real3 next = subtract(point(mesh, corner + 1 < end ? corner + 1 : begin), point(mesh, corner));
    real3 previous = subtract(point(mesh, corner > begin ? corner - 1 : end - 1), point(mesh, corner));
    real3 turn = cross(next, previous);
    real squares = dot(next, next) * dot(previous, previous);
    bool has_normal = dot(area, area) > 0;
    switch (options->weight) {
    case MT_NORMAL_WEIGHT_AREA:
        return area;
    case MT_NORMAL_WEIGHT_UNIFORM:
        return normal;
    case MT_NORMAL_WEIGHT_MAX:
        return has_normal && squares > 0 ? add_scaled((real3){0, 0, 0}, turn, 1 / squares) : (real3){0, 0, 0};
    case MT_NORMAL_WEIGHT_ANGLE:
        break;
    }
    real angle = squares > 0 ? atan2l(sqrtl(dot(turn, turn)), dot(next, previous)) : 0;
    angle = dot(turn, normal) < 0 ? 2 * acosl(-1) - angle : angle;
    return add_scaled((real3){0, 0, 0}, normal, angle);
}

static mt_vec3 rounded(real3 a)
{
    a = unit(a);
    return mt_vec3_make((double)a.x, (double)a.y, (double)a.z);
}

/* A sum, and that of its terms' lengths. */
typedef struct term_sum {
    real3 sum;
    real lengths;
} term_sum;

static void add_term(term_sum *sum, real3 t)
{
    sum->sum = add_scaled(sum->sum, t, 1);
    sum->lengths += sqrtl(dot(t, t));
}

/* NaN where terms cancel so far that doubles keep no direction. */
static mt_vec3 direction(const term_sum *sum)
{
    bool cancels = sqrtl(dot(sum->sum, sum->sum)) < 1e-6L * sum->lengths;
    return cancels ? mt_vec3_make((double)NAN, (double)NAN, (double)NAN) : rounded(sum->sum);
}

/* The vertices before and after a corner in its face. */
static void find_ends(const mt_mesh *mesh, mt_index corner, mt_index ends[2])
{
    mt_index face = mt_mesh_corner_face(mesh, corner), begin = mt_mesh_face_begin(mesh, face);
    mt_index sides = mt_mesh_face_sides(mesh, face), local = corner - begin;
    ends[0] = mesh->corner_vertices[begin + (local + 1) % sides];
    ends[1] = mesh->corner_vertices[begin + (local + sides - 1) % sides];
}

/* How many sides at corners of a vertex lie on its edge to another. */
static mt_index count_sides(const mt_mesh *mesh, mt_index vertex, mt_index other)
{
    mt_index count = 0, ends[2];
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        if (mesh->corner_vertices[c] == vertex) {
            find_ends(mesh, c, ends);
            count += ends[0] == other;
            count += ends[1] == other;
        }
    }
    return count;
}

/* Whether two corners at one vertex have sides on one edge; the fewest sides that such an edge has go to *shared. */
static bool shares_edge(const mt_mesh *mesh, mt_index a, mt_index b, mt_index *shared)
{
    mt_index vertex = mesh->corner_vertices[a], ends_of_a[2], ends_of_b[2];
    find_ends(mesh, a, ends_of_a);
    find_ends(mesh, b, ends_of_b);
    *shared = MT_NONE;
    for (int i = 0; i < 4; i++) {
        mt_index end = ends_of_a[i / 2];
        if (end == ends_of_b[i % 2] && end != vertex) {
            mt_index count = count_sides(mesh, vertex, end);
            *shared = count < *shared ? count : *shared;
        }
    }
    return *shared != MT_NONE;
}

static bool is_smooth(const mt_mesh *mesh, mt_index a, mt_index b, real limit)
{
    real3 m = unit(area_vector(mesh, mt_mesh_corner_face(mesh, a)));
    real3 n = unit(area_vector(mesh, mt_mesh_corner_face(mesh, b)));
    return dot(m, n) > limit;
}

/* The corners that one reaches around its vertex, by spreading until nothing is added. */
static void spread(const mt_mesh *mesh, mt_index from, bool across_creases, real limit, bool *reached)
{
    reached[from] = true;
    for (bool grows = true; grows;) {
        grows = false;
        for (mt_index a = 0; a < mesh->corner_count; a++) {
            for (mt_index b = 0; reached[a] && b < mesh->corner_count; b++) {
                if (reached[b] || mesh->corner_vertices[b] != mesh->corner_vertices[from]) {
                    continue;
                }
                mt_index shared;
                bool same_face = mt_mesh_corner_face(mesh, a) == mt_mesh_corner_face(mesh, b);
                bool joined = same_face || (shares_edge(mesh, a, b, &shared) &&
                                            (across_creases || (shared == 2 && is_smooth(mesh, a, b, limit))));
                if (joined) {
                    reached[b] = grows = true;
                }
            }
        }
    }
}

static mt_vec3 corner_normal(const mt_mesh *mesh, const mt_normal_options *options, mt_index corner)
{
    bool *fan = calloc(mesh->corner_count, sizeof *fan), *patch = calloc(mesh->corner_count, sizeof *patch);
    assert_true(fan && patch);
    double angle = options->crease_angle == 0 ? MT_DEFAULT_CREASE_ANGLE : options->crease_angle;
    real limit = angle < 0 ? 2 : cosl(angle) + (mesh->position_type == MT_F64 ? 0x1p-40L : 0x1p-20L);
    real3 own = area_vector(mesh, mt_mesh_corner_face(mesh, corner));
    term_sum sum = {{0, 0, 0}, 0};
    spread(mesh, corner, true, limit, fan);
    if (options->reachable_only) {
        spread(mesh, corner, false, limit, patch);
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        bool smooth = is_smooth(mesh, corner, c, limit) && (patch[c] || !options->reachable_only);
        if (fan[c] && (c == corner || dot(own, own) == 0 || smooth)) {
            add_term(&sum, term(mesh, options, c));
        }
    }
    free(fan);
    free(patch);
    return direction(&sum);
}

mt_vec3 test_reference_normal(const mt_mesh *mesh, const mt_normal_options *options, mt_index element)
{
    if (options->kind == MT_NORMALS_FACE) {
        return rounded(area_vector(mesh, element));
    }
    if (options->kind == MT_NORMALS_CORNER) {
        return corner_normal(mesh, options, element);
    }
    term_sum sum = {{0, 0, 0}, 0};
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        if (mesh->corner_vertices[c] == element) {
            add_term(&sum, term(mesh, options, c));
        }
    }
    return direction(&sum);
}

double test_angle_between(mt_vec3 a, mt_vec3 b)
{
    mt_vec3 zero = mt_vec3_make(0, 0, 0);
    real3 m = subtract(a, zero), n = subtract(b, zero), turn = cross(m, n);
    if (!(dot(m, m) > 0 && dot(n, n) > 0)) {
        return (double)NAN;
    }
    return (double)atan2l(sqrtl(dot(turn, turn)), dot(m, n));
}

mt_vec3 test_stored_normal(const mt_mesh *mesh, mt_domain domain, mt_index element)
{
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, domain);
    assert_non_null(normals);
    mt_index value = mt_attribute_value_index(normals, element);
    return mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                        mt_attribute_get(normals, value, 2));
}

static const mt_domain domains[] = {
    [MT_NORMALS_VERTEX] = MT_DOMAIN_VERTEX, [MT_NORMALS_FACE] = MT_DOMAIN_FACE, [MT_NORMALS_CORNER] = MT_DOMAIN_CORNER};

double test_expect_normals(mt_context *context, mt_mesh *mesh, const mt_normal_options *options, double tolerance,
                           const char *what)
{
    mt_normal_report report;
    assert_int_equal(mt_mesh_add_normals(context, mesh, options, &report), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    mt_domain domain = domains[options->kind];
    mt_index undefined = 0;
    double largest = 0;
    for (mt_index i = 0; i < mt_mesh_domain_count(mesh, domain); i++) {
        mt_vec3 expected = test_reference_normal(mesh, options, i), n = test_stored_normal(mesh, domain, i);
        double length = mt_vec3_length(n), angle = test_angle_between(expected, n);
        undefined += length == 0;
        bool is_free = isnan(expected.x) || (length == 0 && mt_vec3_length(expected) == 0);
        bool is_unit_or_zero = length == 0 || fabs(length - 1) < 1e-6;
        if (!is_unit_or_zero || !(is_free || angle <= tolerance)) {
            fail_msg("%s, kind %d, weight %d, element %u: (%g %g %g), by definition (%g %g %g), %g apart", what,
                     options->kind, options->weight, i, n.x, n.y, n.z, expected.x, expected.y, expected.z, angle);
        }
        largest = angle > largest ? angle : largest;
    }
    assert_int_equal(report.undefined_count, undefined);
    return largest;
}
