/* Distances at vertices, centroids and further samples, in parallel; sums by fixed blocks, in their order.
 *
 * A triangle no longer than the spacing is integrated by its corners (1/12 each) and its centroid (3/4), a longer one
 * by three points in each of n^2 equal parts; both rules are exact for quadratics, and so for squared distances to a
 * plane. One search a vertex and a triangle, each begun at the answer of the one before, which is mostly near. */
#include <meshtool/elementary.h>

#include "lib/algorithms/deviation_side.h"

#define BLOCK_SIZE 4096
#define LARGEST_DIVISION 1024

typedef struct sample_sums {
    double area, distance, square, normal_area, normal, normal_max;
    double max;
    mt_vec3 at;
    uint64_t count;
} sample_sums;

typedef struct sampling {
    mt_deviation_job *job;
    sample_sums *blocks;
} sampling;

static void note_maximum(sample_sums *sums, double distance, mt_vec3 at)
{
    if (distance > sums->max) {
        sums->max = distance;
        sums->at = at;
    }
}

static void add(sample_sums *sums, double weight, double distance)
{
    sums->area += weight;
    sums->distance += weight * distance;
    sums->square += weight * (distance * distance);
}

static void sample_vertices(void *user, uint64_t begin, uint64_t end)
{
    sampling *work = user;
    mt_deviation_job *job = work->job;
    sample_sums *sums = &work->blocks[begin / BLOCK_SIZE];
    mt_index hint = MT_NONE;
    bool has_area = job->from->triangulation.triangle_count != 0;
    for (uint64_t i = begin; i < end; i++) {
        mt_vec3 point = mt_mesh_position(job->from->mesh, (mt_index)i);
        mt_deviation_near near = mt_deviation_nearest(job->to, point, hint);
        job->vertices[i] = near;
        hint = near.element != MT_NONE ? near.element : hint;
        if (!has_area && near.element != MT_NONE) {
            note_maximum(sums, near.distance, point);
            add(sums, 1, near.distance * job->unit);
            sums->count++;
        }
    }
}

static mt_vec3 area_vector(const mt_deviation_triangle *t, double unit)
{
    mt_vec3 a = mt_vec3_scale(t->corners[0], unit);
    mt_vec3 ab = mt_vec3_subtract(mt_vec3_scale(t->corners[1], unit), a);
    mt_vec3 ac = mt_vec3_subtract(mt_vec3_scale(t->corners[2], unit), a);
    return mt_vec3_scale(mt_vec3_cross(ab, ac), 0.5);
}

static double longest_side(const mt_deviation_triangle *t)
{
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        double side = mt_vec3_length(mt_vec3_subtract(t->corners[(i + 1) % 3], t->corners[i]));
        longest = side > longest ? side : longest;
    }
    return longest;
}

static void compare_normals(const mt_deviation_job *job, mt_vec3 normal, double weight, mt_index element,
                            sample_sums *sums)
{
    if (element >= job->to->triangulation.triangle_count) {
        return;
    }
    mt_deviation_triangle other = mt_deviation_triangle_of(job->to, element);
    mt_vec3 theirs = area_vector(&other, job->unit);
    mt_vec3 ours = mt_vec3_normalize(normal);
    theirs = mt_vec3_normalize(theirs);
    if (mt_vec3_max_abs(ours) > 0 && mt_vec3_max_abs(theirs) > 0) {
        double angle = mt_atan2(mt_vec3_length(mt_vec3_cross(ours, theirs)), mt_vec3_dot(ours, theirs)) * (180 / MT_PI);
        sums->normal_area += weight;
        sums->normal += weight * angle;
        sums->normal_max = angle > sums->normal_max ? angle : sums->normal_max;
    }
}

/* One point of a triangle, by its weights. */
static mt_deviation_near sample_point(const mt_deviation_job *job, const mt_deviation_triangle *t, mt_vec3 weights,
                                      mt_index hint, sample_sums *sums)
{
    mt_vec3 point = mt_deviation_point(t, weights.x, weights.y, weights.z);
    mt_deviation_near near = mt_deviation_nearest(job->to, point, hint);
    note_maximum(sums, near.distance, point);
    sums->count++;
    return near;
}

/* Three points in each of n^2 parts: the upright ones (i, j) and the turned ones between them. */
static void sample_parts(const mt_deviation_job *job, const mt_deviation_triangle *t, mt_vec3 normal, int n,
                         mt_index hint, sample_sums *sums)
{
    double weight = mt_vec3_length(normal) / (3.0 * n * n);
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < 2 * (n - i) - 1; j++) {
            bool is_turned = j % 2;
            double u = (i + (is_turned ? 2.0 : 1.0) / 3) / n, v = (j / 2 + (is_turned ? 2.0 : 1.0) / 3) / n;
            double w = 1 - u - v, off = (is_turned ? -1.0 : 1.0) / (6.0 * n);
            for (int k = 0; k < 3; k++) {
                mt_vec3 at =
                    mt_vec3_make(u + (k == 0 ? 2 : -1) * off, v + (k == 1 ? 2 : -1) * off, w + (k == 2 ? 2 : -1) * off);
                mt_deviation_near near = sample_point(job, t, at, hint, sums);
                hint = near.element;
                add(sums, weight, near.distance * job->unit);
                compare_normals(job, normal, weight, near.element, sums);
            }
        }
    }
}

static int choose_division(const mt_deviation_job *job, const mt_deviation_triangle *t)
{
    double parts = ceil(longest_side(t) / job->spacing / 1.5); /* three points a part lie closer than one */
    return parts <= 1 ? 1 : parts < LARGEST_DIVISION ? (int)parts : LARGEST_DIVISION;
}

static void sample_triangle(const mt_deviation_job *job, mt_index triangle, sample_sums *sums)
{
    mt_deviation_triangle t = mt_deviation_triangle_of(job->from, triangle);
    mt_vec3 normal = area_vector(&t, job->unit);
    double area = mt_vec3_length(normal);
    mt_deviation_near near[3];
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&job->from->triangulation, triangle, side);
        near[side] = job->vertices[job->from->mesh->corner_vertices[corner]];
        if (near[side].element == MT_NONE) {
            job->centers[triangle] = (mt_deviation_near){NAN, MT_NONE};
            return;
        }
        note_maximum(sums, near[side].distance, t.corners[side]);
    }
    if (job->maximum_only) {
        job->centers[triangle] = (mt_deviation_near){NAN, MT_NONE};
        return;
    }
    const mt_vec3 middle = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    mt_deviation_near center = sample_point(job, &t, middle, near[0].element, sums);
    job->centers[triangle] = center;
    int n = choose_division(job, &t);
    if (n > 1) {
        sample_parts(job, &t, normal, n, center.element, sums);
        return;
    }
    for (int side = 0; side < 3; side++) {
        add(sums, area / 12, near[side].distance * job->unit);
    }
    add(sums, area * 0.75, center.distance * job->unit);
    compare_normals(job, normal, area, center.element, sums);
}

static void sample_triangles(void *user, uint64_t begin, uint64_t end)
{
    sampling *work = user;
    sample_sums *sums = &work->blocks[begin / BLOCK_SIZE];
    for (uint64_t i = begin; i < end; i++) {
        sample_triangle(work->job, (mt_index)i, sums);
    }
}

static void join_blocks(const mt_deviation_job *job, const sample_sums *blocks, uint64_t block_count)
{
    sample_sums all = {.max = -1};
    for (uint64_t i = 0; i < block_count; i++) {
        all.area += blocks[i].area;
        all.distance += blocks[i].distance;
        all.square += blocks[i].square;
        all.normal_area += blocks[i].normal_area;
        all.normal += blocks[i].normal;
        all.normal_max = blocks[i].normal_max > all.normal_max ? blocks[i].normal_max : all.normal_max;
        all.count += blocks[i].count;
        note_maximum(&all, blocks[i].max, blocks[i].at);
    }
    mt_deviation_side *out = job->out;
    out->max = all.max;
    out->from = all.at;
    out->mean = all.distance / all.area / job->unit; /* NAN where there is no area, or only the maximum was asked for */
    out->rms = sqrt(all.square / all.area) / job->unit;
    out->normal_mean = all.normal_area > 0 ? all.normal / all.normal_area : NAN;
    out->normal_max = all.normal_area > 0 ? all.normal_max : NAN;
    out->sample_count = all.count < MT_INDEX_MAX ? (mt_index)all.count : MT_INDEX_MAX;
}

mt_status mt_deviation_sample(mt_deviation_job *job)
{
    mt_index vertex_count = job->from->mesh->vertex_count, count = job->from->triangulation.triangle_count;
    uint64_t block_count = (vertex_count > count ? vertex_count : count) / BLOCK_SIZE + 1;
    sampling work = {job, mt_allocate_array_zeroed(job->context, block_count, sizeof *work.blocks)};
    if (!work.blocks) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (uint64_t i = 0; i < block_count; i++) {
        work.blocks[i].max = -1;
    }
    mt_parallel_for(job->context, vertex_count, BLOCK_SIZE, sample_vertices, &work);
    mt_parallel_for(job->context, count, BLOCK_SIZE, sample_triangles, &work);
    join_blocks(job, work.blocks, block_count);
    mt_free(job->context, work.blocks);
    return MT_OK;
}
