/* Area, signed volume and zero-area faces of the shared triangulation.
 *
 * Volume is the sum of tetrahedra over the triangles from the middle of the bounds of the vertices that faces name, so
 * that a mesh far from the origin loses nothing; differences are taken before products. Where coordinates are huge or
 * tiny they are first scaled by a power of two, which is exact. Sums are compensated (Neumaier, "Rundungsfehleranalyse
 * einiger Verfahren zur Summation endlicher Summen", ZAMM 54, 1974) within fixed blocks and then over the blocks.
 *
 * Whether a face lies on a line is decided exactly: a bound on the error of the cross product settles nearly all faces,
 * mt_collinear the rest.
 * Cost: O(vertices + corners) time. */
#include "lib/algorithms/manifold_check.h"
#include "lib/algorithms/triangle_terms.h"

#include <meshtool/predicates.h>
#include <meshtool/triangulate.h>

/* Between these a mesh's largest coordinate needs no scaling: products of up to six of them stay far inside the
 * exponents of doubles. */
#define PLAIN_MINIMUM 0x1p-100
#define PLAIN_MAXIMUM 0x1p100

typedef struct block_sums {
    compensated_sum total;
    mt_index zero_area_count;
} block_sums;

typedef struct measurement {
    manifold_check *check;
    const mt_triangulation *triangulation;
    double scale;
    mt_vec3 origin; /* scaled */
    bool faces_are_triangles;
    bool tests_along; /* triangles that the sums' own products cannot tell from flat ones are tested there and then */
    block_sums *blocks;
} measurement;

/* Whether a component of the computed cross product is surely not zero. */
static inline bool component_is_sure(double left, double right)
{
    return fabs(left - right) > CROSS_ERROR * (fabs(left) + fabs(right)) + CROSS_UNDERFLOW;
}

static inline bool is_surely_not_collinear(mt_vec3 ab, mt_vec3 ac)
{
    return component_is_sure(ab.x * ac.y, ab.y * ac.x) || component_is_sure(ab.y * ac.z, ab.z * ac.y) ||
           component_is_sure(ab.z * ac.x, ab.x * ac.z);
}

static bool all_finite(const manifold_check *check, const mt_index *vertices, mt_index count)
{
    for (mt_index i = 0; i < count; i++) {
        if (check->vertex_is_non_finite[vertices[i]]) {
            return false;
        }
    }
    return true;
}

static bool points_are_collinear(mt_arithmetic how, mt_vec3 a, mt_vec3 b, mt_vec3 p)
{
    mt_vec3 ab = mt_vec3_subtract(b, a), ap = mt_vec3_subtract(p, a);
    if (how == MT_ARITHMETIC_EXACT) {
        return mt_collinear_exact(a, b, p);
    }
    if (how == MT_ARITHMETIC_FLOATING) {
        return ab.x * ap.y == ab.y * ap.x && ab.y * ap.z == ab.z * ap.y && ab.z * ap.x == ab.x * ap.z;
    }
    return !is_surely_not_collinear(ab, ap) && mt_collinear(a, b, p);
}

/* Whether all vertices of a face lie on one line: all on the line through the first and one that differs from it. */
static bool face_is_collinear(const manifold_check *check, const mt_index *vertices, mt_index sides)
{
    const mt_mesh *mesh = check->mesh;
    mt_vec3 a = mt_mesh_position(mesh, vertices[0]);
    mt_vec3 b = a;
    for (mt_index i = 1; i < sides; i++) {
        mt_vec3 p = mt_mesh_position(mesh, vertices[i]);
        if (b.x == a.x && b.y == a.y && b.z == a.z) {
            b = p;
        } else if (!points_are_collinear(check->arithmetic, a, b, p)) {
            return false;
        }
    }
    return true;
}

static void test_face(const measurement *job, mt_index face, block_sums *sums)
{
    const manifold_check *check = job->check;
    const mt_index *vertices = check->mesh->corner_vertices + mt_mesh_face_begin(check->mesh, face);
    mt_index sides = mt_mesh_face_sides(check->mesh, face);
    bool counts = !(check->face_flags[face] & FACE_DEGENERATE) &&
                  (!check->vertex_is_non_finite || all_finite(check, vertices, sides));
    if (counts && face_is_collinear(check, vertices, sides)) {
        check->face_flags[face] |= FACE_ZERO_AREA;
        sums->zero_area_count++;
    }
}

static inline mt_vec3 scaled_position(const measurement *job, mt_index vertex)
{
    return mt_vec3_scale(mt_mesh_position(job->check->mesh, vertex), job->scale);
}

static inline void measure_triangle(const measurement *job, mt_index triangle, const mt_index vertex[3],
                                    block_sums *sums)
{
    mt_vec3 a = scaled_position(job, vertex[0]);
    mt_vec3 ab = mt_vec3_subtract(scaled_position(job, vertex[1]), a);
    mt_vec3 ac = mt_vec3_subtract(scaled_position(job, vertex[2]), a);
    mt_vec3 cross = mt_vec3_cross(ab, ac);
    add_term(&sums->total, (double2){mt_vec3_length(cross), mt_vec3_dot(mt_vec3_subtract(a, job->origin), cross)});
    if (job->tests_along && !is_surely_not_collinear(ab, ac)) {
        test_face(job, triangle, sums);
    }
}

/* Triangles that memory is given to fetch positions, which are far apart when the faces are in a random order. */
#define LOOK_AHEAD 16

/* Fetches what a later pair of triangles will need. */
static inline void look_ahead(const measurement *job, mt_index first, bool plain)
{
    if (job->triangulation->triangle_count - first < LOOK_AHEAD + 2) {
        return;
    }
    const mt_mesh *mesh = job->check->mesh;
    size_t size = plain ? 3 * sizeof(double) : 3 * mt_type_size(mesh->position_type);
    for (mt_index side = 0; side < 6; side++) {
        mt_index at = 3 * (first + LOOK_AHEAD) + side;
        mt_index corner = plain || !job->triangulation->corners ? at : job->triangulation->corners[at];
        __builtin_prefetch((const char *)mesh->positions + mesh->corner_vertices[corner] * size);
    }
}

static inline void find_vertices(const measurement *job, mt_index triangle, mt_index vertex[3])
{
    for (mt_index side = 0; side < 3; side++) {
        vertex[side] = job->check->mesh->corner_vertices[mt_triangulation_corner(job->triangulation, triangle, side)];
    }
}

/* `plain`: positions are doubles and need no scaling, and the faces are the triangles. */
static inline mt_vec3 load_position(const measurement *job, mt_index vertex, bool plain)
{
    if (plain) {
        const double *p = (const double *)job->check->mesh->positions + 3 * (size_t)vertex;
        return mt_vec3_make(p[0], p[1], p[2]);
    }
    return scaled_position(job, vertex);
}

static inline void measure_two(const measurement *job, mt_index first, bool plain, block_sums *sums)
{
    mt_index found[6];
    const mt_index *vertices = job->check->mesh->corner_vertices + 3 * (size_t)first;
    if (!plain) {
        find_vertices(job, first, found);
        find_vertices(job, first + 1, found + 3);
        vertices = found;
    }
    triangle2 two;
    for (int i = 0; i < 3; i++) {
        mt_vec3 p = load_position(job, vertices[i], plain), q = load_position(job, vertices[i + 3], plain);
        two.corner[i] = (vector2){{p.x, q.x}, {p.y, q.y}, {p.z, q.z}};
    }
    bool sure = add_two_triangles(&two, job->origin, &sums->total);
    if (job->tests_along && !sure) {
        test_face(job, first, sums);
        test_face(job, first + 1, sums);
    }
}

/* Two at a time; returns where it stopped. */
static inline mt_index measure_pairs(const measurement *job, mt_index t, mt_index end, bool plain, block_sums *out)
{
    block_sums sums = {0};
    for (; end - t >= 2; t += 2) {
        look_ahead(job, t, plain);
        measure_two(job, t, plain, &sums);
    }
    *out = sums;
    return t;
}

static void measure_block(void *user, uint64_t begin, uint64_t end)
{
    const measurement *job = user;
    block_sums sums = {0};
    mt_index t = (mt_index)begin;
    if (!job->check->vertex_is_non_finite) {
        bool plain = job->faces_are_triangles && job->check->mesh->position_type == MT_F64 && job->scale == 1;
        t = plain ? measure_pairs(job, t, (mt_index)end, true, &sums)
                  : measure_pairs(job, t, (mt_index)end, false, &sums);
    }
    for (; t < end; t++) {
        mt_index vertex[3];
        find_vertices(job, t, vertex);
        if (!job->check->vertex_is_non_finite || all_finite(job->check, vertex, 3)) {
            measure_triangle(job, t, vertex, &sums);
        }
    }
    job->blocks[begin / MANIFOLD_GRAIN] = sums;
}

static void test_block(void *user, uint64_t begin, uint64_t end)
{
    const measurement *job = user;
    block_sums sums = {0};
    for (mt_index face = (mt_index)begin; face < end; face++) {
        test_face(job, face, &sums);
    }
    job->blocks[begin / MANIFOLD_GRAIN].zero_area_count = sums.zero_area_count;
}

/* What sums of products of `factors` coordinates must be multiplied by to undo the scale. */
static double unscale(double sum, double scale, int factors)
{
    int exponent;
    frexp(scale, &exponent);
    return ldexp(sum, -factors * (exponent - 1));
}

static void sum_blocks(const measurement *job, uint64_t block_count)
{
    mt_manifold_report *report = job->check->report;
    compensated_sum total = {0};
    for (uint64_t block = 0; block < block_count; block++) {
        add_term(&total, job->blocks[block].total.sum);
        add_term(&total, job->blocks[block].total.rest);
    }
    double2 sum = total.sum + total.rest;
    report->area = unscale(sum[0] / 2, job->scale, 2);
    report->has_volume = report->manifold_class == MT_MANIFOLD && report->oriented == MT_YES;
    report->volume = unscale(sum[1] / 6, job->scale, 3);
}

static void count_zero_area(const measurement *job, uint64_t block_count)
{
    for (uint64_t block = 0; block < block_count; block++) {
        job->check->report->defect_counts[MT_DEFECT_ZERO_AREA_FACE] += job->blocks[block].zero_area_count;
    }
}

static uint64_t block_count_of(uint64_t count)
{
    return (count + MANIFOLD_GRAIN - 1) / MANIFOLD_GRAIN;
}

static void choose_frame(measurement *job)
{
    mt_vec3 low = job->check->minimum, high = job->check->maximum;
    double largest = fmax(mt_vec3_max_abs(low), mt_vec3_max_abs(high));
    bool plain = largest >= PLAIN_MINIMUM && largest <= PLAIN_MAXIMUM;
    job->scale = plain || !(largest > 0) || !isfinite(largest) ? 1 : mt_power_of_two_scale(largest);
    job->origin = mt_vec3_add(mt_vec3_scale(low, job->scale / 2), mt_vec3_scale(high, job->scale / 2));
}

static mt_status measure(manifold_check *check, const mt_triangulation *triangulation)
{
    const mt_mesh *mesh = check->mesh;
    measurement job = {.check = check,
                       .triangulation = triangulation,
                       .faces_are_triangles = !mesh->face_offsets && mesh->face_size == 3};
    job.tests_along = job.faces_are_triangles && check->arithmetic == MT_ARITHMETIC_ADAPTIVE;
    choose_frame(&job);
    uint64_t triangle_blocks = block_count_of(triangulation->triangle_count);
    uint64_t face_blocks = block_count_of(mesh->face_count);
    uint64_t most = triangle_blocks > face_blocks ? triangle_blocks : face_blocks;
    job.blocks = mt_allocate_array_zeroed(check->context, most, sizeof *job.blocks);
    if (!job.blocks) {
        return mt_context_error(check->context)->status;
    }
    mt_parallel_for(check->context, triangulation->triangle_count, MANIFOLD_GRAIN, measure_block, &job);
    sum_blocks(&job, triangle_blocks);
    if (!job.tests_along) {
        mt_parallel_for(check->context, mesh->face_count, MANIFOLD_GRAIN, test_block, &job);
    }
    count_zero_area(&job, face_blocks);
    mt_free(check->context, job.blocks);
    return MT_OK;
}

mt_status mt_manifold_measure(manifold_check *check)
{
    mt_triangulation triangulation = {0};
    mt_status status = mt_triangulation_init(check->context, check->mesh, &triangulation);
    if (status == MT_OK) {
        status = measure(check, &triangulation);
    }
    mt_triangulation_release(check->context, &triangulation);
    return status;
}
