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

#include <meshtool/predicates.h>
#include <meshtool/triangulate.h>

/* Between these a mesh's largest coordinate needs no scaling: products of up to six of them stay far inside the
 * exponents of doubles. */
#define PLAIN_MINIMUM 0x1p-100
#define PLAIN_MAXIMUM 0x1p100

/* Of the cross product of rounded differences, relative to the sum of the products' sizes; the constant term stands for
 * what underflows. Larger only sends more faces to the exact test. */
#define CROSS_ERROR 0x1p-50
#define CROSS_UNDERFLOW 0x1p-1000

typedef struct compensated_sum {
    double sum, rest;
} compensated_sum;

static inline void add_term(compensated_sum *total, double term)
{
    double sum = total->sum + term;
    bool large = fabs(total->sum) >= fabs(term);
    total->rest += large ? (total->sum - sum) + term : (term - sum) + total->sum;
    total->sum = sum;
}

typedef struct block_sums {
    compensated_sum area, volume;
    mt_index zero_area_count;
} block_sums;

typedef struct measurement {
    manifold_check *check;
    const mt_triangulation *triangulation;
    double scale;
    mt_vec3 origin; /* scaled */
    bool faces_are_triangles;
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

/* Whether all vertices of a face lie on one line: all on the line through the first and one that differs from it. */
static bool face_is_collinear(const mt_mesh *mesh, const mt_index *vertices, mt_index sides)
{
    mt_vec3 a = mt_mesh_position(mesh, vertices[0]);
    mt_vec3 b = a;
    for (mt_index i = 1; i < sides; i++) {
        mt_vec3 p = mt_mesh_position(mesh, vertices[i]);
        if (b.x == a.x && b.y == a.y && b.z == a.z) {
            b = p;
        } else if (is_surely_not_collinear(mt_vec3_subtract(b, a), mt_vec3_subtract(p, a)) || !mt_collinear(a, b, p)) {
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
    if (counts && face_is_collinear(check->mesh, vertices, sides)) {
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
    add_term(&sums->area, mt_vec3_length(cross));
    add_term(&sums->volume, mt_vec3_dot(mt_vec3_subtract(a, job->origin), cross));
    if (job->faces_are_triangles && !is_surely_not_collinear(ab, ac)) {
        test_face(job, triangle, sums);
    }
}

/* Triangles that memory is given to fetch positions, which are far apart when the faces are in a random order. */
#define LOOK_AHEAD 16

static inline void look_ahead(const measurement *job, mt_index triangle)
{
    if (job->triangulation->triangle_count - triangle <= LOOK_AHEAD) {
        return;
    }
    const mt_mesh *mesh = job->check->mesh;
    size_t size = 3 * mt_type_size(mesh->position_type);
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(job->triangulation, triangle + LOOK_AHEAD, side);
        __builtin_prefetch((const char *)mesh->positions + mesh->corner_vertices[corner] * size);
    }
}

static void measure_block(void *user, uint64_t begin, uint64_t end)
{
    const measurement *job = user;
    const mt_mesh *mesh = job->check->mesh;
    block_sums sums = {0};
    for (mt_index t = (mt_index)begin; t < end; t++) {
        look_ahead(job, t);
        mt_index vertex[3];
        for (mt_index side = 0; side < 3; side++) {
            vertex[side] = mesh->corner_vertices[mt_triangulation_corner(job->triangulation, t, side)];
        }
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
    block_sums total = {0};
    for (uint64_t block = 0; block < block_count; block++) {
        const block_sums *own = &job->blocks[block];
        add_term(&total.area, own->area.sum);
        add_term(&total.area, own->area.rest);
        add_term(&total.volume, own->volume.sum);
        add_term(&total.volume, own->volume.rest);
    }
    report->area = unscale((total.area.sum + total.area.rest) / 2, job->scale, 2);
    report->has_volume = report->manifold_class == MT_MANIFOLD && report->oriented == MT_YES;
    report->volume = unscale((total.volume.sum + total.volume.rest) / 6, job->scale, 3);
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
    if (!job.faces_are_triangles) {
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
