/* Self-intersection: candidates from the tree of boxes against itself, decided by exact signs.
 *
 * Positions are first scaled by a power of two, which is exact, so that the predicates' floating-point filter works on
 * meshes of any size; where that would push a coordinate below the normal numbers they are left as they are, and the
 * predicates decide the slow way. Each task keeps the pairs that it finds; the whole is sorted at the end, so the
 * answer does not depend on threads. Most triangles whose boxes overlap are neighbours around a vertex, and at most
 * vertices it is plain that no neighbours intersect (flat_stars.h), so few pairs need a test.
 *
 * Cost: the stars (24 bytes a triangle) and then the tree with its keys (60 bytes a triangle), the positions in double
 * where they need scaling, and the pairs. A mesh in which very many triangles overlap has that many pairs:
 * MT_ERROR_TOO_LARGE past 2^31. */
#include "lib/algorithms/flat_stars.h"
#include "lib/algorithms/triangle_plane.h"

#include <meshtool/aabb_tree.h>
#include <meshtool/self_intersection.h>

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#define PAIR_COUNT_MAXIMUM ((uint64_t)1 << 31)

typedef struct pair_list {
    uint64_t count, capacity;
    mt_face_pair *pairs;
    bool failed;
} pair_list;

typedef struct search {
    mt_context *context;
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    const mt_vec3 *points; /* scaled positions, the mesh's own where they are fit */
    mt_vec3 *scaled;       /* NULL when those are */
    double scale;
    double reach;     /* no two points differ more in a coordinate */
    uint8_t *skip;    /* per triangle: of zero area */
    uint8_t *facings; /* per triangle, see flat_stars.h */
    uint8_t *flat;    /* per vertex: no two of its triangles intersect */
    mt_aabb_tree *tree;
    mt_index *keys; /* of the tree's primitives */
    bool only_first;
    mt_arithmetic arithmetic;
    atomic_bool found;
    pair_list lists[MT_PAIR_TASKS_MAXIMUM];
} search;

static void load_vertices(const search *job, mt_index triangle, mt_index vertices[3])
{
    for (mt_index side = 0; side < 3; side++) {
        vertices[side] = job->mesh->corner_vertices[mt_triangulation_corner(job->triangulation, triangle, side)];
    }
}

static void load_triangle(const search *job, mt_index triangle, indexed_triangle *out)
{
    load_vertices(job, triangle, out->vertices);
    for (int side = 0; side < 3; side++) {
        out->points[side] = job->points[out->vertices[side]];
    }
}

/* Smallest magnitude above zero, and the largest finite one. */
static void measure(const mt_mesh *mesh, double *smallest, double *largest)
{
    *smallest = INFINITY;
    *largest = 0;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(mesh, vertex);
        const double magnitudes[3] = {fabs(p.x), fabs(p.y), fabs(p.z)};
        for (int i = 0; i < 3; i++) {
            double m = magnitudes[i];
            *smallest = m > 0 && m < *smallest ? m : *smallest;
            *largest = m > *largest && isfinite(m) ? m : *largest;
        }
    }
}

static double exact_scale(double smallest, double largest)
{
    if (largest > 0x1p-100 && largest < 0x1p100) {
        return 1;
    }
    double scale = mt_power_of_two_scale(largest);
    return scale > 1 || smallest * scale > 0x1p-1000 ? scale : 1;
}

static void choose_scale(search *job)
{
    double smallest, largest;
    measure(job->mesh, &smallest, &largest);
    job->scale = exact_scale(smallest, largest);
    job->reach = 2 * largest * job->scale;
}

static void scale_points(void *user, uint64_t begin, uint64_t end)
{
    search *job = user;
    for (uint64_t i = begin; i < end; i++) {
        job->scaled[i] = mt_vec3_scale(mt_mesh_position(job->mesh, (mt_index)i), job->scale);
    }
}

static bool find_points(search *job)
{
    if (job->mesh->position_type == MT_F64 && job->scale == 1) {
        job->points = job->mesh->positions;
        return true;
    }
    job->scaled = mt_allocate_array(job->context, job->mesh->vertex_count, sizeof *job->scaled);
    job->points = job->scaled;
    if (job->scaled) {
        mt_parallel_for(job->context, job->mesh->vertex_count, 65536, scale_points, job);
    }
    return job->scaled;
}

static void judge_triangles(void *user, uint64_t begin, uint64_t end)
{
    search *job = user;
    for (uint64_t i = begin; i < end; i++) {
        indexed_triangle triangle;
        load_triangle(job, (mt_index)i, &triangle);
        job->facings[i] = triangle_facing(triangle.points);
        job->skip[i] = !job->facings[i] && mt_collinear(triangle.points[0], triangle.points[1], triangle.points[2]);
    }
}

static bool grow(search *job, pair_list *list)
{
    uint64_t capacity = list->capacity ? 2 * list->capacity : 256;
    mt_face_pair *pairs = mt_try_allocate(job->context, capacity * sizeof *pairs);
    if (!pairs) {
        list->failed = true;
        return false;
    }
    if (list->count) {
        memcpy(pairs, list->pairs, list->count * sizeof *pairs);
    }
    mt_free(job->context, list->pairs);
    list->pairs = pairs;
    list->capacity = capacity;
    return true;
}

static bool keep_pair(search *job, pair_list *list, mt_index face, mt_index other)
{
    if (list->count == list->capacity && !grow(job, list)) {
        return false;
    }
    list->pairs[list->count++] = face < other ? (mt_face_pair){face, other} : (mt_face_pair){other, face};
    return true;
}

static bool plane_parts(const search *job, const indexed_triangle *triangle, const indexed_triangle *other)
{
    triangle_plane plane = triangle_plane_make(triangle->points, job->reach);
    return triangle_plane_parts(&plane, triangle, other);
}

/* Most pairs are decided by the plane of one. False when there is no memory for the pair. */
static bool decide_pair(search *job, mt_index task, mt_primitive_pair pair)
{
    mt_index face = mt_triangulation_face(job->triangulation, pair.a);
    mt_index other = mt_triangulation_face(job->triangulation, pair.b);
    indexed_triangle a, b;
    load_triangle(job, pair.a, &a);
    load_triangle(job, pair.b, &b);
    bool may_skip = job->arithmetic == MT_ARITHMETIC_ADAPTIVE;
    if (face == other || (may_skip && (plane_parts(job, &a, &b) || plane_parts(job, &b, &a))) ||
        !mt_triangles_intersect(job->arithmetic, &a, &b)) {
        return true;
    }
    atomic_store_explicit(&job->found, true, memory_order_relaxed);
    return keep_pair(job, &job->lists[task], face, other);
}

static bool decide_pairs(void *user, mt_index task, const mt_primitive_pair *pairs, size_t count)
{
    search *job = user;
    if (job->only_first && atomic_load_explicit(&job->found, memory_order_relaxed)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!decide_pair(job, task, pairs[i])) {
            return false;
        }
    }
    return true;
}

/* A triangle's keys are its flat vertices: those that have one in common do not intersect. */
static void fill_keys(void *user, uint64_t begin, uint64_t end)
{
    const search *job = user;
    for (uint64_t place = begin; place < end; place++) {
        mt_index *keys = job->keys + 4 * place;
        load_vertices(job, job->tree->primitives[place].number, keys);
        for (int i = 0; i < 3; i++) {
            bool is_flat = job->flat[keys[i]] && job->arithmetic == MT_ARITHMETIC_ADAPTIVE;
            keys[i] = is_flat ? keys[i] : MT_NONE;
        }
        keys[3] = MT_NONE;
    }
}

static int compare_pairs(const void *left, const void *right)
{
    const mt_face_pair *p = left, *q = right;
    if (p->a != q->a) {
        return p->a < q->a ? -1 : 1;
    }
    return p->b < q->b ? -1 : p->b > q->b;
}

static uint64_t drop_repeats(mt_face_pair *pairs, uint64_t count)
{
    uint64_t kept = 0;
    for (uint64_t i = 0; i < count; i++) {
        if (kept == 0 || compare_pairs(&pairs[kept - 1], &pairs[i]) != 0) {
            pairs[kept++] = pairs[i];
        }
    }
    return kept;
}

static mt_status join_lists(search *job, mt_self_intersections *out)
{
    uint64_t count = 0;
    for (size_t task = 0; task < MT_PAIR_TASKS_MAXIMUM; task++) {
        if (job->lists[task].failed) {
            return mt_fail(job->context, MT_ERROR_OUT_OF_MEMORY, "out of memory for the pairs of intersecting faces");
        }
        count += job->lists[task].count;
    }
    if (count > PAIR_COUNT_MAXIMUM) {
        return mt_fail(job->context, MT_ERROR_TOO_LARGE, "more than 2^31 pairs of faces intersect");
    }
    out->pairs = mt_allocate_array(job->context, count, sizeof *out->pairs);
    if (!out->pairs) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    uint64_t at = 0;
    for (size_t task = 0; task < MT_PAIR_TASKS_MAXIMUM; task++) {
        const pair_list *list = &job->lists[task];
        if (list->count) {
            memcpy(out->pairs + at, list->pairs, list->count * sizeof *list->pairs);
        }
        at += list->count;
    }
    qsort(out->pairs, count, sizeof *out->pairs, compare_pairs);
    out->pair_count = drop_repeats(out->pairs, count);
    return MT_OK;
}

static mt_status search_tree(search *job)
{
    mt_status status = mt_progress(job->context, "looking for self-intersections", 0.3);
    if (status != MT_OK) {
        return status;
    }
    job->keys = mt_allocate_array(job->context, job->tree->primitive_count, 4 * sizeof *job->keys);
    if (!job->keys) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(job->context, job->tree->primitive_count, 16384, fill_keys, job);
    status = mt_aabb_tree_self_pairs(job->context, job->tree, job->keys, decide_pairs, job);
    mt_free(job->context, job->keys);
    return status;
}

static mt_status search_with_tree(search *job, mt_self_intersections *out)
{
    mt_context *context = job->context;
    mt_parallel_for(context, job->triangulation->triangle_count, 16384, judge_triangles, job);
    mt_status status = mt_find_flat_stars(context, job->mesh, job->triangulation, job->points, job->facings, job->flat);
    if (status == MT_OK) {
        status = mt_aabb_tree_create(context, job->mesh, job->triangulation, job->skip, &job->tree);
    }
    if (status != MT_OK) {
        return status;
    }
    int part = mt_part_begin(context, "pairs of triangles", "boxes that overlap, decided exactly");
    status = search_tree(job);
    mt_aabb_tree_destroy(context, job->tree);
    if (status == MT_OK) {
        status = join_lists(job, out);
    }
    mt_part_end(context, part);
    return status;
}

static mt_status run_search(search *job, mt_self_intersections *out)
{
    mt_context *context = job->context;
    mt_triangulation triangulation;
    mt_status status = mt_triangulation_init(context, job->mesh, &triangulation);
    if (status != MT_OK) {
        return status;
    }
    job->triangulation = &triangulation;
    choose_scale(job);
    job->skip = mt_allocate(context, triangulation.triangle_count);
    job->facings = mt_allocate(context, triangulation.triangle_count);
    job->flat = mt_allocate(context, job->mesh->vertex_count);
    bool ready = job->skip && job->facings && job->flat && find_points(job);
    status = ready ? search_with_tree(job, out) : MT_ERROR_OUT_OF_MEMORY;
    for (size_t task = 0; task < MT_PAIR_TASKS_MAXIMUM; task++) {
        mt_free(context, job->lists[task].pairs);
    }
    mt_free(context, job->flat);
    mt_free(context, job->facings);
    mt_free(context, job->skip);
    mt_free(context, job->scaled);
    mt_triangulation_release(context, &triangulation);
    return status;
}

mt_status mt_find_self_intersections(mt_context *context, const mt_mesh *mesh,
                                     const mt_self_intersection_options *options, mt_self_intersections *out)
{
    memset(out, 0, sizeof *out);
    search *job = mt_allocate_zeroed(context, sizeof *job);
    if (!job) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    job->context = context;
    job->mesh = mesh;
    job->only_first = options && options->only_first;
    job->arithmetic = options ? options->arithmetic : MT_ARITHMETIC_ADAPTIVE;
    mt_status status = run_search(job, out);
    mt_free(context, job);
    if (status != MT_OK) {
        mt_self_intersections_release(context, out);
    }
    return status;
}

void mt_self_intersections_release(mt_context *context, mt_self_intersections *intersections)
{
    mt_free(context, intersections->pairs);
    memset(intersections, 0, sizeof *intersections);
}
