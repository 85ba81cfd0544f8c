/* What of a mesh is drawn: faces whose vertices are all finite, wires, points; when there is none of these, every
 * finite vertex. Only drawn vertices count for the centre and the size, so that an isolated vertex far away does
 * not shrink the picture. Scaling is by powers of two, so it loses nothing; the centre is subtracted in doubles. */
#include "lib/render/model.h"

#include <meshtool/checked.h>

#include <math.h>
#include <string.h>

#define VERTEX_BLOCK 65536
#define FACE_BLOCK 65536

typedef struct finite_task {
    mt_model *model;
    bool *found; /* per block: a vertex that is not finite */
} finite_task;

static void find_finite(void *user, uint64_t begin, uint64_t end)
{
    const finite_task *task = (const finite_task *)user;
    bool all = true;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        bool finite = mt_vec3_is_finite(mt_mesh_position(task->model->mesh, (mt_index)vertex));
        task->model->flags[vertex] = finite ? MT_VERTEX_FINITE : 0;
        all = all && finite;
    }
    task->found[begin / VERTEX_BLOCK] = !all;
}

/* Threads may mark the same vertex; all of them store the same value. */
static void mark_drawn(mt_model *model, mt_index vertex)
{
    __atomic_store_n(&model->flags[vertex], MT_VERTEX_FINITE | MT_VERTEX_DRAWN, __ATOMIC_RELAXED);
}

static bool is_finite(const mt_model *model, mt_index vertex)
{
    return __atomic_load_n(&model->flags[vertex], __ATOMIC_RELAXED) != 0;
}

static bool is_whole(const mt_model *model, mt_index face)
{
    mt_index last = mt_mesh_face_end(model->mesh, face);
    for (mt_index corner = mt_mesh_face_begin(model->mesh, face); corner < last; corner++) {
        if (!is_finite(model, model->mesh->corner_vertices[corner])) {
            return false;
        }
    }
    return true;
}

static void mark_faces(void *user, uint64_t begin, uint64_t end)
{
    mt_model *model = (mt_model *)user;
    const mt_mesh *mesh = model->mesh;
    for (uint64_t f = begin; f < end; f++) {
        mt_index face = (mt_index)f;
        if (model->skipped_faces && !is_whole(model, face)) {
            model->skipped_faces[face] = 1;
            continue;
        }
        mt_index last = mt_mesh_face_end(mesh, face);
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < last; corner++) {
            mark_drawn(model, mesh->corner_vertices[corner]);
        }
    }
}

static mt_status flag_finite(mt_context *context, mt_model *model, bool *all_finite)
{
    mt_index vertex_count = model->mesh->vertex_count;
    size_t block_count = ((size_t)vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK;
    model->flags = (unsigned char *)mt_allocate_array(context, vertex_count, 1);
    bool *found = (bool *)mt_allocate_array(context, block_count, sizeof *found);
    if (!model->flags || !found) {
        mt_free(context, found);
        return mt_context_error(context)->status;
    }
    finite_task task = {model, found};
    mt_parallel_for(context, vertex_count, VERTEX_BLOCK, find_finite, &task);
    *all_finite = true;
    for (size_t block = 0; block < block_count; block++) {
        *all_finite = *all_finite && !found[block];
    }
    mt_free(context, found);
    return MT_OK;
}

static mt_index count_skipped(const mt_model *model)
{
    mt_index count = 0;
    for (mt_index face = 0; model->skipped_faces && face < model->mesh->face_count; face++) {
        count += model->skipped_faces[face];
    }
    return count;
}

static mt_status mark_elements(mt_context *context, mt_model *model)
{
    bool all_finite = true;
    mt_status status = flag_finite(context, model, &all_finite);
    if (status == MT_OK && !all_finite) {
        model->skipped_faces = (unsigned char *)mt_allocate_array_zeroed(context, model->mesh->face_count, 1);
        status = model->skipped_faces ? MT_OK : mt_context_error(context)->status;
    }
    if (status != MT_OK) {
        return status;
    }
    mt_parallel_for(context, model->mesh->face_count, FACE_BLOCK, mark_faces, model);
    mt_index skipped = count_skipped(model);
    if (skipped > 0) {
        mt_warn(context, "%u of %u faces are not drawn: they have a vertex with a NaN or infinite coordinate", skipped,
                model->mesh->face_count);
    }
    return MT_OK;
}

static void add_stroke(mt_model *model, mt_index a, mt_index b)
{
    if (!is_finite(model, a) || !is_finite(model, b)) {
        return;
    }
    mark_drawn(model, a);
    mark_drawn(model, b);
    model->strokes[model->stroke_count++] = (mt_stroke){a, b};
    model->dot_count += a == b;
}

static mt_status make_room(mt_context *context, mt_model *model, uint64_t count)
{
    mt_free(context, model->strokes);
    model->strokes = NULL;
    model->stroke_count = model->dot_count = 0;
    if (!mt_count_fits(count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%llu lines are too many for one picture",
                       (unsigned long long)count);
    }
    model->strokes = (mt_stroke *)mt_allocate_array(context, count, sizeof *model->strokes);
    return model->strokes ? MT_OK : mt_context_error(context)->status;
}

static mt_status collect_elements(mt_context *context, mt_model *model)
{
    const mt_mesh *mesh = model->mesh;
    mt_index wire_corners = mesh->wire_count > 0 ? mesh->wire_offsets[mesh->wire_count] : 0;
    mt_status status = make_room(context, model, (uint64_t)wire_corners + mesh->point_count);
    if (status != MT_OK) {
        return status;
    }
    for (mt_index wire = 0; wire < mesh->wire_count; wire++) {
        for (mt_index at = mesh->wire_offsets[wire]; at + 1 < mesh->wire_offsets[wire + 1]; at++) {
            add_stroke(model, mesh->wire_vertices[at], mesh->wire_vertices[at + 1]);
        }
    }
    for (mt_index point = 0; point < mesh->point_count; point++) {
        add_stroke(model, mesh->point_vertices[point], mesh->point_vertices[point]);
    }
    return MT_OK;
}

static mt_status collect_vertices(mt_context *context, mt_model *model)
{
    mt_status status = make_room(context, model, model->mesh->vertex_count);
    for (mt_index vertex = 0; status == MT_OK && vertex < model->mesh->vertex_count; vertex++) {
        add_stroke(model, vertex, vertex);
    }
    return status;
}

/* Bounds of the drawn vertices in fixed blocks; a largest value does not depend on the order. */
typedef struct bounds_task {
    const mt_model *model;
    double (*lows)[3], (*highs)[3];
} bounds_task;

static void find_bounds(void *user, uint64_t begin, uint64_t end)
{
    const bounds_task *task = (const bounds_task *)user;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        if (!(task->model->flags[vertex] & MT_VERTEX_DRAWN)) {
            continue;
        }
        mt_vec3 p = mt_mesh_position(task->model->mesh, (mt_index)vertex);
        const double q[3] = {p.x, p.y, p.z};
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = q[axis] < low[axis] ? q[axis] : low[axis];
            high[axis] = q[axis] > high[axis] ? q[axis] : high[axis];
        }
    }
    memcpy(task->lows[begin / VERTEX_BLOCK], low, sizeof low);
    memcpy(task->highs[begin / VERTEX_BLOCK], high, sizeof high);
}

static void set_scales(mt_model *model, const double low[3], const double high[3])
{
    double largest = 0;
    for (int axis = 0; axis < 3; axis++) {
        largest = fmax(largest, fmax(fabs(low[axis]), fabs(high[axis])));
    }
    /* Subnormal coordinates need two factors: no double is large enough to bring them to 1. */
    model->scales[0] = mt_power_of_two_scale(largest);
    model->scales[1] = mt_power_of_two_scale(largest * model->scales[0]);
    double center[3], extent = 0;
    for (int axis = 0; axis < 3; axis++) {
        double a = low[axis] * model->scales[0] * model->scales[1];
        double b = high[axis] * model->scales[0] * model->scales[1];
        center[axis] = 0.5 * (a + b);
        extent = fmax(extent, b - a);
    }
    model->center = mt_vec3_make(center[0], center[1], center[2]);
    model->unit = mt_power_of_two_scale(extent);
}

static mt_vec3 to_model(const mt_model *model, const double p[3])
{
    mt_vec3 q = {p[0], p[1], p[2]};
    return mt_model_point(model, q);
}

/* The space of a mesh of these coordinates. */
static void set_space(mt_model *model, const double low[3], const double high[3])
{
    model->low = to_model(model, low);
    model->high = to_model(model, high);
    double corners[6] = {model->low.x, model->low.y, model->low.z, model->high.x, model->high.y, model->high.z};
    const mt_mesh box = {.vertex_count = 2, .positions = corners, .position_type = MT_F64};
    model->space = mt_ray_space_of(&box);
}

static mt_status measure(mt_context *context, mt_model *model)
{
    size_t block_count = ((size_t)model->mesh->vertex_count + VERTEX_BLOCK - 1) / VERTEX_BLOCK;
    double(*blocks)[3] = (double(*)[3])mt_allocate_array(context, 2 * block_count, sizeof *blocks);
    if (!blocks) {
        return mt_context_error(context)->status;
    }
    bounds_task task = {model, blocks, blocks + block_count};
    mt_parallel_for(context, model->mesh->vertex_count, VERTEX_BLOCK, find_bounds, &task);
    for (size_t block = 1; block < block_count; block++) {
        for (int axis = 0; axis < 3; axis++) {
            task.lows[0][axis] = fmin(task.lows[0][axis], task.lows[block][axis]);
            task.highs[0][axis] = fmax(task.highs[0][axis], task.highs[block][axis]);
        }
    }
    set_scales(model, task.lows[0], task.highs[0]);
    set_space(model, task.lows[0], task.highs[0]);
    mt_free(context, blocks);
    return MT_OK;
}

static mt_status build(mt_context *context, mt_model *model)
{
    mt_status status = mark_elements(context, model);
    if (status == MT_OK) {
        status = collect_elements(context, model);
    }
    if (status == MT_OK && model->stroke_count == 0 && count_skipped(model) == model->mesh->face_count) {
        status = collect_vertices(context, model);
        if (status == MT_OK && model->stroke_count == 0) {
            status = mt_fail(context, MT_ERROR_INVALID_MESH,
                             "there is nothing to see: none of the mesh's %u vertices has finite coordinates",
                             model->mesh->vertex_count);
        }
    }
    if (status == MT_OK) {
        status = measure(context, model);
    }
    if (status == MT_OK) {
        status = mt_triangulation_init(context, model->mesh, &model->triangulation);
    }
    return status;
}

mt_status mt_model_init(mt_context *context, const mt_mesh *mesh, mt_model *model)
{
    memset(model, 0, sizeof *model);
    model->mesh = mesh;
    if (mesh->vertex_count == 0) {
        return mt_fail(context, MT_ERROR_INVALID_MESH, "there is nothing to see: the mesh has no vertices");
    }
    mt_status status = build(context, model);
    if (status != MT_OK) {
        mt_model_release(context, model);
    }
    return status;
}

void mt_model_release(mt_context *context, mt_model *model)
{
    mt_triangulation_release(context, &model->triangulation);
    mt_free(context, model->flags);
    mt_free(context, model->skipped_faces);
    mt_free(context, model->strokes);
    memset(model, 0, sizeof *model);
}

void mt_model_draw_vertex(mt_model *model, mt_index vertex)
{
    if (is_finite(model, vertex)) {
        mark_drawn(model, vertex);
    }
}

mt_status mt_model_outline(mt_context *context, mt_model *model)
{
    const mt_mesh *mesh = model->mesh;
    mt_status status = make_room(context, model, mesh->corner_count);
    for (mt_index face = 0; status == MT_OK && face < mesh->face_count; face++) {
        mt_index first = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = first; corner < end && !mt_model_skips(model, face); corner++) {
            mt_index next = corner + 1 < end ? corner + 1 : first;
            mt_index a = mesh->corner_vertices[corner], b = mesh->corner_vertices[next];
            model->strokes[model->stroke_count++] = (mt_stroke){a, b};
        }
    }
    return status;
}
