/* Normals by corner: the area-weighted mean of the faces around the vertex whose normals differ from the corner's
 * own face by less than the crease angle. Sides of a face count as one, so that mixed winding shades smoothly.
 *
 * Most vertices have no crease: all their faces lie within half the crease angle of their common mean, so that any
 * two lie within the whole of it and every corner's mean is the common one. That is stored per vertex. Only for the
 * other vertices are the incident faces listed, and their corners are answered when a picture asks for them.
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
    double *sums; /* 3 per vertex */
} sum_task;

static void sum_at_vertices(void *user, uint64_t begin, uint64_t end)
{
    const sum_task *task = (const sum_task *)user;
    const mt_mesh *mesh = task->normals->model->mesh;
    mt_index range = (mt_index)(end - begin);
    memset(task->sums + 3 * begin, 0, 3 * sizeof(double) * (size_t)range);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index last = mt_mesh_face_end(mesh, face);
        const float *n = task->normals->face_normals + 3 * (size_t)face;
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < last; corner++) {
            mt_index vertex = mesh->corner_vertices[corner];
            if (vertex - (mt_index)begin < range) {
                double *sum = task->sums + 3 * (size_t)vertex;
                sum[0] += (double)n[0], sum[1] += (double)n[1], sum[2] += (double)n[2];
            }
        }
    }
}

typedef struct unit_task {
    const double *sums;
    float *units;
} unit_task;

static void make_units(void *user, uint64_t begin, uint64_t end)
{
    const unit_task *task = (const unit_task *)user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        const double *s = task->sums + 3 * vertex;
        double length = sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]);
        double scale = length > 0 ? 1.0 / length : 0.0;
        for (int axis = 0; axis < 3; axis++) {
            task->units[3 * vertex + (size_t)axis] = (float)(s[axis] * scale);
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
    normals->vertex_normals = (float *)mt_allocate_array(context, 3 * (uint64_t)vertex_count, sizeof(float));
    double *sums = (double *)mt_allocate_array(context, 3 * (uint64_t)vertex_count, sizeof(double));
    if (!normals->vertex_normals || !sums) {
        mt_free(context, sums);
        return mt_context_error(context)->status;
    }
    sum_task task = {normals, sums};
    mt_parallel_for(context, vertex_count, range_size(context, vertex_count), sum_at_vertices, &task);
    unit_task units = {sums, normals->vertex_normals};
    mt_parallel_for(context, vertex_count, FACE_BLOCK, make_units, &units);
    mt_free(context, sums);
    return MT_OK;
}

typedef struct crease_task {
    const mt_corner_normals *normals;
    unsigned char *flags;
    double half_cosine_squared; /* of half the crease angle */
} crease_task;

static void find_creased(void *user, uint64_t begin, uint64_t end)
{
    const crease_task *task = (const crease_task *)user;
    const mt_mesh *mesh = task->normals->model->mesh;
    for (uint64_t f = begin; f < end; f++) {
        mt_index face = (mt_index)f, last = mt_mesh_face_end(mesh, face);
        mt_vec3 n = mt_face_normal(task->normals, face);
        double limit = task->half_cosine_squared * mt_vec3_dot(n, n);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); limit > 0 && corner < last; corner++) {
            mt_index vertex = mesh->corner_vertices[corner];
            const float *v = task->normals->vertex_normals + 3 * (size_t)vertex;
            double dot = (double)v[0] * n.x + (double)v[1] * n.y + (double)v[2] * n.z;
            if (!(dot > 0 && dot * dot >= limit)) {
                unsigned char flags = MT_VERTEX_FINITE | MT_VERTEX_DRAWN | MT_VERTEX_CREASED;
                __atomic_store_n(&task->flags[vertex], flags, __ATOMIC_RELAXED);
            }
        }
    }
}

/* Lists of faces around creased vertices, a range of vertices to a task, in two passes: `fill` false counts into
 * first_faces[vertex + 1], true stores, moving first_faces[vertex] on. */
typedef struct incidence_task {
    mt_corner_normals *normals;
    bool fill;
} incidence_task;

static void list_incident(void *user, uint64_t begin, uint64_t end)
{
    const incidence_task *task = (const incidence_task *)user;
    mt_corner_normals *normals = task->normals;
    const mt_mesh *mesh = normals->model->mesh;
    const unsigned char *flags = normals->model->flags;
    mt_index range = (mt_index)(end - begin);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index last = mt_mesh_face_end(mesh, face);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < last; corner++) {
            mt_index vertex = mesh->corner_vertices[corner];
            if (vertex - (mt_index)begin >= range || !(flags[vertex] & MT_VERTEX_CREASED)) {
                continue;
            }
            if (task->fill) {
                normals->incident_faces[normals->first_faces[vertex]++] = face;
            } else {
                normals->first_faces[vertex]++;
            }
        }
    }
}

/* Turns counts into first places; filling moves each on to the next one's, so they end shifted by one. */
static size_t accumulate(size_t *firsts, mt_index count)
{
    size_t sum = 0;
    for (mt_index i = 0; i < count; i++) {
        size_t here = firsts[i];
        firsts[i] = sum;
        sum += here;
    }
    return sum;
}

static mt_status list_creased(mt_context *context, mt_corner_normals *normals)
{
    mt_index vertex_count = normals->model->mesh->vertex_count;
    normals->first_faces = (size_t *)mt_allocate_array_zeroed(context, (uint64_t)vertex_count + 1, sizeof(size_t));
    if (!normals->first_faces) {
        return mt_context_error(context)->status;
    }
    size_t *firsts = normals->first_faces;
    uint64_t grain = range_size(context, vertex_count);
    incidence_task task = {normals, false};
    mt_parallel_for(context, vertex_count, grain, list_incident, &task);
    size_t total = accumulate(firsts, vertex_count);
    normals->incident_faces = (mt_index *)mt_allocate_array(context, total, sizeof(mt_index));
    if (!normals->incident_faces) {
        return mt_context_error(context)->status;
    }
    task.fill = true;
    mt_parallel_for(context, vertex_count, grain, list_incident, &task);
    memmove(firsts + 1, firsts, vertex_count * sizeof *firsts);
    firsts[0] = 0;
    return MT_OK;
}

static bool any_creased(const mt_model *model)
{
    for (mt_index vertex = 0; vertex < model->mesh->vertex_count; vertex++) {
        if (model->flags[vertex] & MT_VERTEX_CREASED) {
            return true;
        }
    }
    return false;
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
    normals->given = given_normals(model->mesh);
    if (normals->given || model->mesh->face_count == 0) {
        return MT_OK;
    }
    mt_status status = average(context, normals);
    if (status != MT_OK) {
        return status;
    }
    double half = mt_cos(0.5 * angle) - COSINE_MARGIN;
    crease_task task = {normals, model->flags, half * half};
    mt_parallel_for(context, model->mesh->face_count, FACE_BLOCK, find_creased, &task);
    return any_creased(model) ? list_creased(context, normals) : MT_OK;
}

void mt_corner_normals_release(mt_context *context, mt_corner_normals *normals)
{
    mt_free(context, normals->face_normals);
    mt_free(context, normals->vertex_normals);
    mt_free(context, normals->first_faces);
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
static mt_vec3 creased_normal(const mt_corner_normals *normals, mt_index face, mt_index vertex)
{
    mt_vec3 own = mt_face_normal(normals, face), sum = mt_vec3_make(0, 0, 0);
    size_t begin = normals->first_faces[vertex], end = normals->first_faces[vertex + 1];
    double own_squared = mt_vec3_dot(own, own), minimum = normals->minimum_cosine;
    if (end - begin > VALENCE_LIMIT || !(own_squared > 0)) {
        return unit_or_zero(own);
    }
    for (size_t at = begin; at < end; at++) {
        mt_vec3 other = mt_face_normal(normals, normals->incident_faces[at]);
        double dot = mt_vec3_dot(own, other);
        double cosine_limit = minimum * sqrt(own_squared * mt_vec3_dot(other, other));
        if (fabs(dot) >= cosine_limit) {
            sum = dot < 0 ? mt_vec3_subtract(sum, other) : mt_vec3_add(sum, other);
        }
    }
    return unit_or_zero(sum);
}

mt_vec3 mt_corner_normal(const mt_corner_normals *normals, mt_index face, mt_index corner)
{
    const mt_model *model = normals->model;
    mt_index vertex = model->mesh->corner_vertices[corner];
    const mt_attribute *given = normals->given;
    if (given) {
        mt_index element = given->domain == MT_DOMAIN_CORNER ? corner : vertex;
        mt_index value = mt_attribute_value_index(given, element);
        if (value != MT_NONE) {
            mt_vec3 n =
                mt_vec3_normalize(mt_vec3_make(mt_attribute_get(given, value, 0), mt_attribute_get(given, value, 1),
                                               mt_attribute_get(given, value, 2)));
            return mt_vec3_dot(n, n) > 0 ? n : unit_or_zero(mt_face_normal(normals, face));
        }
        return unit_or_zero(mt_face_normal(normals, face));
    }
    if (model->flags[vertex] & MT_VERTEX_CREASED) {
        return creased_normal(normals, face, vertex);
    }
    const float *n = normals->vertex_normals + 3 * (size_t)vertex;
    return mt_vec3_make((double)n[0], (double)n[1], (double)n[2]);
}
