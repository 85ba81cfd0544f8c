/* Normals by corner: the area-weighted mean of the faces around the vertex whose normals differ from the corner's
 * own face by less than the crease angle. Sides of a face count as one, so that mixed winding shades smoothly.
 *
 * Most vertices have no crease: all their faces lie within half the crease angle of their common mean, so that any
 * two lie within the whole of it and every corner's mean is the common one. That is stored per vertex. Only for the
 * other vertices are the incident faces listed, and their corners are answered when a picture asks for them. Vertices
 * at the two sides of a seam count as one.
 *
 * Cost: linear, one float triple a face and one a vertex, and one index for each corner at a creased vertex. Sums
 * run over faces in ascending order: each task owns a range of vertices and passes over all faces.
 *
 * Known limit: at a creased vertex of more than VALENCE_LIMIT faces a corner takes its face's own normal, since
 * the mean for each of its corners would take quadratic time. */
#include "lib/render/corner_normals.h"

#include <meshtool/elementary.h>

#include <math.h>
#include <string.h>

#define FACE_BLOCK 32768
#define VALENCE_LIMIT 256

/* Added to cosines, so that faces that meet at exactly the crease angle count as smooth whatever the rounding of
 * their normals (floats, 6e-8); larger would move the angle itself by more than 0.001 degrees. */
#define COSINE_MARGIN 1e-6

/* Twice the area vector. Differences are taken to the first corner, before products. */
static mt_vec3 area_vector(const mt_model *model, mt_index face)
{
    const mt_mesh *mesh = model->mesh;
    mt_index first = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    mt_vec3 origin = mt_model_position(model, mesh->corner_vertices[first]);
    mt_vec3 side = mt_vec3_subtract(mt_model_position(model, mesh->corner_vertices[first + 1]), origin);
    mt_vec3 sum = mt_vec3_make(0, 0, 0);
    for (mt_index corner = first + 2; corner < end; corner++) {
        mt_vec3 next = mt_vec3_subtract(mt_model_position(model, mesh->corner_vertices[corner]), origin);
        sum = mt_vec3_add(sum, mt_vec3_cross(side, next));
        side = next;
    }
    return sum;
}

static void find_face_normals(void *user, uint64_t begin, uint64_t end)
{
    mt_corner_normals *normals = (mt_corner_normals *)user;
    for (uint64_t face = begin; face < end; face++) {
        mt_vec3 n = mt_vec3_make(0, 0, 0);
        if (!mt_model_skips(normals->model, (mt_index)face)) {
            n = area_vector(normals->model, (mt_index)face);
        }
        float *out = normals->face_normals + 3 * face;
        out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
    }
}

/* Sums of one range of vertices. */
typedef struct sum_task {
    const mt_corner_normals *normals;
    uint32_t *open;
} sum_task;

/* Spread so that sums of a few of them do not cancel by chance. */
static inline uint32_t spread(mt_index vertex)
{
    uint32_t h = vertex * 0x9E3779B1u;
    return h ^ (h >> 15);
}

static inline void add_face(const sum_task *task, mt_index face, mt_index begin, mt_index range)
{
    const mt_mesh *mesh = task->normals->model->mesh;
    mt_index first = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    const float *n = task->normals->face_normals + 3 * (size_t)face;
    mt_index before = mesh->corner_vertices[end - 1], vertex = mesh->corner_vertices[first];
    for (mt_index corner = first; corner < end; corner++) {
        mt_index after = mesh->corner_vertices[corner + 1 < end ? corner + 1 : first];
        if (vertex - begin < range) {
            float *sum = task->normals->vertices[vertex].normal;
            sum[0] += n[0], sum[1] += n[1], sum[2] += n[2];
            task->open[vertex] += spread(after) - spread(before);
        }
        before = vertex;
        vertex = after;
    }
}

/* Sums the normals around vertices, and the neighbours after minus those before: where the faces close around a vertex,
 * each neighbour is once the one and once the other. */
static void sum_at_vertices(void *user, uint64_t begin, uint64_t end)
{
    const sum_task *task = (const sum_task *)user;
    mt_index face_count = task->normals->model->mesh->face_count;
    memset(task->normals->vertices + begin, 0, (size_t)(end - begin) * sizeof(mt_vertex_shading));
    memset(task->open + begin, 0, (size_t)(end - begin) * sizeof(uint32_t));
    for (mt_index face = 0; face < face_count; face++) {
        add_face(task, face, (mt_index)begin, (mt_index)(end - begin));
    }
}

static void make_units(void *user, uint64_t begin, uint64_t end)
{
    const mt_corner_normals *normals = (const mt_corner_normals *)user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        float *n = normals->vertices[vertex].normal;
        double x = (double)n[0], y = (double)n[1], z = (double)n[2];
        double length = sqrt(x * x + y * y + z * z);
        double scale = length > 0 ? 1.0 / length : 0.0;
        n[0] = (float)(x * scale), n[1] = (float)(y * scale), n[2] = (float)(z * scale);
    }
}

/* The sum of a place stands at the vertex that the others are joined to. */
static void add_joined(mt_corner_normals *normals)
{
    mt_index vertex_count = normals->model->mesh->vertex_count;
    for (mt_index vertex = 0; normals->joined && vertex < vertex_count; vertex++) {
        mt_index first = normals->joined[vertex];
        float *n = normals->vertices[vertex].normal, *sum = normals->vertices[first].normal;
        for (int axis = 0; axis < 3 && first != vertex; axis++) {
            sum[axis] += n[axis];
        }
    }
}

/* A range for each thread: a sum does not depend on which range its vertex is in. */
static uint64_t range_size(const mt_context *context, mt_index vertex_count)
{
    unsigned threads = mt_context_thread_count(context);
    uint64_t size = ((uint64_t)vertex_count + threads - 1) / threads;
    return size > 0 ? size : 1;
}

static mt_status average(mt_context *context, mt_corner_normals *normals)
{
    mt_index vertex_count = normals->model->mesh->vertex_count;
    normals->vertices = (mt_vertex_shading *)mt_allocate_array(context, vertex_count, sizeof *normals->vertices);
    uint32_t *open = (uint32_t *)mt_allocate_array(context, vertex_count, sizeof *open);
    mt_status status = normals->vertices && open ? MT_OK : mt_context_error(context)->status;
    if (status == MT_OK) {
        sum_task task = {normals, open};
        mt_parallel_for(context, vertex_count, range_size(context, vertex_count), sum_at_vertices, &task);
        status = mt_join_seams(context, normals, open);
    }
    mt_free(context, open);
    if (status == MT_OK) {
        add_joined(normals);
        mt_parallel_for(context, vertex_count, FACE_BLOCK, make_units, normals);
    }
    return status;
}

typedef struct crease_task {
    const mt_corner_normals *normals;
    unsigned char *flags;
    double half_cosine_squared; /* of half the crease angle */
    bool *found;                /* per block of faces */
} crease_task;

static void find_creased(void *user, uint64_t begin, uint64_t end)
{
    const crease_task *task = (const crease_task *)user;
    const mt_mesh *mesh = task->normals->model->mesh;
    const unsigned char flags = MT_VERTEX_FINITE | MT_VERTEX_DRAWN | MT_VERTEX_CREASED;
    bool found = false;
    for (uint64_t f = begin; f < end; f++) {
        mt_index face = (mt_index)f, last = mt_mesh_face_end(mesh, face);
        mt_vec3 n = mt_face_normal(task->normals, face);
        double limit = task->half_cosine_squared * mt_vec3_dot(n, n);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); limit > 0 && corner < last; corner++) {
            mt_index vertex = mt_joined_vertex(task->normals, mesh->corner_vertices[corner]);
            const float *v = task->normals->vertices[vertex].normal;
            double dot = (double)v[0] * n.x + (double)v[1] * n.y + (double)v[2] * n.z;
            if (!(dot > 0 && dot * dot >= limit)) {
                __atomic_store_n(&task->flags[vertex], flags, __ATOMIC_RELAXED);
                found = true;
            }
        }
    }
    task->found[begin / FACE_BLOCK] = found;
}

static mt_status find_creases(mt_context *context, mt_model *model, double half_cosine, mt_corner_normals *normals)
{
    mt_index face_count = model->mesh->face_count;
    size_t block_count = ((size_t)face_count + FACE_BLOCK - 1) / FACE_BLOCK;
    bool *found = (bool *)mt_allocate_array(context, block_count, sizeof *found), any = false;
    if (!found) {
        return mt_context_error(context)->status;
    }
    crease_task task = {normals, model->flags, half_cosine * half_cosine, found};
    mt_parallel_for(context, face_count, FACE_BLOCK, find_creased, &task);
    for (size_t block = 0; block < block_count; block++) {
        any = any || found[block];
    }
    mt_free(context, found);
    return any ? mt_list_creased(context, normals) : MT_OK;
}

/* Normals of the file are used when all of them can be: a NaN would leave holes in the shading. */
static const mt_attribute *given_normals(const mt_mesh *mesh)
{
    const mt_attribute *attribute = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
    attribute = attribute ? attribute : mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
    if (!attribute || attribute->component_count != 3) {
        return NULL;
    }
    for (mt_index value = 0; value < attribute->value_count; value++) {
        for (uint32_t axis = 0; axis < 3; axis++) {
            if (!isfinite(mt_attribute_get(attribute, value, axis))) {
                return NULL;
            }
        }
    }
    return attribute;
}

mt_status mt_corner_normals_init(mt_context *context, const mt_model *model, mt_corner_normals *normals)
{
    memset(normals, 0, sizeof *normals);
    normals->model = model;
    uint64_t face_count = model->mesh->face_count;
    normals->face_normals = (float *)mt_allocate_array(context, 3 * face_count, sizeof(float));
    if (!normals->face_normals) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, face_count, FACE_BLOCK, find_face_normals, normals);
    return MT_OK;
}

mt_status mt_corner_normals_build(mt_context *context, mt_model *model, double crease_degrees,
                                  mt_corner_normals *normals)
{
    double angle = crease_degrees * (MT_PI / 180.0);
    normals->minimum_cosine = mt_cos(angle) - COSINE_MARGIN;
    normals->given = normals->own ? NULL : given_normals(model->mesh);
    if (normals->given || model->mesh->face_count == 0) {
        return MT_OK;
    }
    mt_status status = average(context, normals);
    double half_cosine = mt_cos(0.5 * angle) - COSINE_MARGIN;
    return status == MT_OK ? find_creases(context, model, half_cosine, normals) : status;
}

void mt_corner_normals_release(mt_context *context, mt_corner_normals *normals)
{
    mt_free(context, normals->face_normals);
    mt_free(context, normals->vertices);
    mt_free(context, normals->joined);
    mt_free(context, normals->incident_faces);
    memset(normals, 0, sizeof *normals);
}

double mt_corner_normals_facing(const mt_corner_normals *normals, mt_vec3 direction)
{
    /* So many faces tell a sheet from a body; the step depends on nothing but their number. */
    mt_index count = normals->model->mesh->face_count, step = count / 65536 + 1;
    double facing = 0, area = 0;
    for (mt_index face = 0; face < count; face += step) {
        mt_vec3 n = mt_face_normal(normals, face);
        facing += fabs(mt_vec3_dot(n, direction));
        area += mt_vec3_length(n);
        if (count - face <= step) {
            break;
        }
    }
    return area > 0 ? facing / area : 1.0;
}

static mt_vec3 unit_or_zero(mt_vec3 a)
{
    double length = mt_vec3_length(a);
    return length > 0 ? mt_vec3_scale(a, 1.0 / length) : mt_vec3_make(0, 0, 0);
}

/* The mean over the faces around a creased vertex that lie within the crease angle of this one. */
static mt_vec3 creased_normal(const mt_corner_normals *normals, mt_index face, const mt_vertex_shading *vertex)
{
    mt_vec3 own = mt_face_normal(normals, face), sum = mt_vec3_make(0, 0, 0);
    double own_squared = mt_vec3_dot(own, own), minimum = normals->minimum_cosine;
    if (vertex->faces.count > VALENCE_LIMIT || !(own_squared > 0)) {
        return unit_or_zero(own);
    }
    for (mt_index i = 0; i < vertex->faces.count; i++) {
        mt_vec3 other = mt_face_normal(normals, normals->incident_faces[vertex->faces.first + i]);
        double dot = mt_vec3_dot(own, other);
        if (fabs(dot) >= minimum * sqrt(own_squared * mt_vec3_dot(other, other))) {
            sum = dot < 0 ? mt_vec3_subtract(sum, other) : mt_vec3_add(sum, other);
        }
    }
    return unit_or_zero(sum);
}

static mt_vec3 given_normal(const mt_corner_normals *normals, mt_index face, mt_index corner)
{
    const mt_attribute *given = normals->given;
    mt_index vertex = normals->model->mesh->corner_vertices[corner];
    mt_index value = mt_attribute_value_index(given, given->domain == MT_DOMAIN_CORNER ? corner : vertex);
    mt_vec3 n = mt_vec3_make(0, 0, 0);
    if (value != MT_NONE) {
        n = mt_vec3_normalize(mt_vec3_make(mt_attribute_get(given, value, 0), mt_attribute_get(given, value, 1),
                                           mt_attribute_get(given, value, 2)));
    }
    return mt_vec3_dot(n, n) > 0 ? n : unit_or_zero(mt_face_normal(normals, face));
}

mt_vec3 mt_corner_normal(const mt_corner_normals *normals, mt_index face, mt_index corner)
{
    if (normals->flat) {
        return unit_or_zero(mt_face_normal(normals, face));
    }
    if (normals->given) {
        return given_normal(normals, face, corner);
    }
    mt_index vertex = mt_joined_vertex(normals, normals->model->mesh->corner_vertices[corner]);
    const mt_vertex_shading *at = &normals->vertices[vertex];
    if (normals->model->flags[vertex] & MT_VERTEX_CREASED) {
        return creased_normal(normals, face, at);
    }
    return mt_vec3_make((double)at->normal[0], (double)at->normal[1], (double)at->normal[2]);
}
