/* Filling holes: every boundary loop gets triangles that run against its sides.
 *
 * A loop is walked from boundary side to boundary side about the fan between them, so that loops which touch at a
 * vertex stay apart. Left alone are loops that meet a non-manifold or misoriented edge on the way, the rim of a face
 * that stands alone (it would get itself as a duplicate) or of a flat sheet (the triangles would lie on its faces),
 * loops through a vertex twice, and those that no triangulation fills without a taken edge or a triangle without area.
 */
#include "lib/algorithms/edge_set.h"
#include "lib/algorithms/flat_components.h"
#include "lib/algorithms/hole_triangulation.h"
#include "lib/algorithms/repair_state.h"

#include <meshtool/edge_pairs.h>

#include <string.h>

typedef struct index_list {
    uint64_t count, capacity;
    mt_index *numbers;
} index_list;

typedef struct hole_job {
    repair_state *state;
    const mt_repair_options *options;
    const mt_edge_pairs *pairs;
    mt_components *components;
    uint8_t *flat;       /* components */
    double scale;        /* a power of two that brings coordinates to 1 */
    edge_set edges;      /* between boundary vertices */
    uint8_t *visited;    /* corners */
    uint32_t *last_loop; /* per vertex the number of the last loop through it */
    uint32_t loop_number;
    index_list loop;      /* vertices, against the faces' direction */
    index_list triangles; /* vertices of the new triangles */
    mt_repair_result *result;
} hole_job;

static mt_status push(mt_context *context, index_list *list, mt_index number)
{
    if (list->count == list->capacity) {
        uint64_t capacity = list->capacity ? 2 * list->capacity : 64;
        mt_index *grown = mt_reallocate(context, list->numbers, capacity * sizeof *grown);
        if (!grown) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        list->numbers = grown;
        list->capacity = capacity;
    }
    list->numbers[list->count++] = number;
    return MT_OK;
}

static mt_index next_corner(const mt_mesh *mesh, mt_index corner)
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    return corner + 1 == mt_mesh_face_end(mesh, face) ? mt_mesh_face_begin(mesh, face) : corner + 1;
}

/* The boundary side that follows about the head of this one; MT_NONE where the fan is broken. */
static mt_index next_boundary(const hole_job *job, mt_index corner)
{
    const mt_mesh *mesh = job->state->mesh;
    corner = next_corner(mesh, corner);
    for (;;) {
        mt_edge_class edge = mt_edge_class_of(mesh, job->pairs, corner);
        if (edge == MT_EDGE_BOUNDARY) {
            return corner;
        }
        if (edge != MT_EDGE_REGULAR) {
            return MT_NONE;
        }
        corner = next_corner(mesh, job->pairs->next_side[corner]);
    }
}

static bool enter_vertex(hole_job *job, mt_index vertex)
{
    bool is_new = job->last_loop[vertex] != job->loop_number;
    job->last_loop[vertex] = job->loop_number;
    return is_new;
}

/* Walks the loop and keeps its vertices; *good tells whether it is one to fill. */
static mt_status walk_loop(hole_job *job, mt_index first, bool *good)
{
    const mt_mesh *mesh = job->state->mesh;
    mt_index corner = first, face = mt_mesh_corner_face(mesh, first);
    bool one_face = true;
    *good = true;
    job->loop.count = 0;
    job->loop_number++;
    do {
        mt_index vertex = mesh->corner_vertices[corner];
        job->visited[corner] = 1;
        one_face = one_face && mt_mesh_corner_face(mesh, corner) == face;
        *good = enter_vertex(job, vertex) && *good;
        mt_status status = push(job->state->context, &job->loop, vertex);
        if (status != MT_OK) {
            return status;
        }
        corner = next_boundary(job, corner);
    } while (corner != first && corner != MT_NONE);
    *good = *good && corner == first && !one_face && job->loop.count > 2;
    return MT_OK;
}

/* Twice the area vector of a polygon, about its first vertex, with coordinates scaled. */
static mt_vec3 area_vector(const mt_mesh *mesh, const mt_index *vertices, uint64_t count, double scale)
{
    mt_vec3 origin = mt_vec3_scale(mt_mesh_position(mesh, vertices[0]), scale);
    mt_vec3 sum = {0, 0, 0}, before = {0, 0, 0};
    for (uint64_t i = 1; i < count; i++) {
        mt_vec3 point = mt_vec3_subtract(mt_vec3_scale(mt_mesh_position(mesh, vertices[i]), scale), origin);
        sum = mt_vec3_add(sum, mt_vec3_cross(before, point));
        before = point;
    }
    return sum;
}

/* Whether the loop goes around its flat component, not around a hole in it: filled it would look the other way. */
static bool is_rim_of_sheet(const hole_job *job, mt_index corner)
{
    const mt_mesh *mesh = job->state->mesh;
    mt_index face = mt_mesh_corner_face(mesh, corner), begin = mt_mesh_face_begin(mesh, face);
    if (!job->flat[job->components->face_component[face]]) {
        return false;
    }
    mt_vec3 side = area_vector(mesh, mesh->corner_vertices + begin, mt_mesh_face_sides(mesh, face), job->scale);
    mt_vec3 loop = area_vector(mesh, job->loop.numbers, job->loop.count, job->scale);
    return mt_vec3_dot(side, loop) > 0; /* the loop still runs as the faces do */
}

static void reverse(index_list *list)
{
    for (uint64_t i = 0, j = list->count; i + 1 < j; i++) {
        mt_index swapped = list->numbers[i];
        list->numbers[i] = list->numbers[--j];
        list->numbers[j] = swapped;
    }
}

static bool edge_is_taken(void *user, mt_index a, mt_index b)
{
    const hole_job *job = user;
    return mt_edge_set_has(&job->edges, a, b);
}

static mt_status keep_triangles(hole_job *job, const mt_index *local)
{
    mt_context *context = job->state->context;
    const mt_index *vertices = job->loop.numbers;
    mt_status status = MT_OK;
    for (uint64_t i = 0; status == MT_OK && i < 3 * (job->loop.count - 2); i++) {
        uint64_t next = i % 3 == 2 ? i - 2 : i + 1;
        status = push(context, &job->triangles, vertices[local[i]]);
        if (status == MT_OK) {
            status = mt_edge_set_add(context, &job->edges, vertices[local[i]], vertices[local[next]]);
        }
    }
    return status;
}

static mt_status fill_loop(hole_job *job, mt_index first)
{
    mt_context *context = job->state->context;
    bool good;
    mt_status status = walk_loop(job, first, &good);
    if (status != MT_OK) {
        return status;
    }
    mt_index most = job->options->hole_sides_maximum;
    if (!good || (most && job->loop.count > most) || is_rim_of_sheet(job, first)) {
        job->result->left_count++;
        return MT_OK;
    }
    reverse(&job->loop);
    mt_index *local = mt_allocate_array(context, 3 * (job->loop.count - 2), sizeof *local);
    if (!local) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    bool filled;
    status = mt_triangulate_hole(context, job->state->mesh, job->loop.numbers, (mt_index)job->loop.count, edge_is_taken,
                                 job, local, &filled);
    if (status == MT_OK && filled) {
        job->result->count++;
        status = keep_triangles(job, local);
    } else {
        job->result->left_count++;
    }
    mt_free(context, local);
    return status;
}

static mt_status collect_edges(hole_job *job)
{
    const mt_mesh *mesh = job->state->mesh;
    const mt_index *vertices = mesh->corner_vertices;
    mt_status status = MT_OK;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) { /* marks boundary vertices as loop 0 */
        if (mt_edge_class_of(mesh, job->pairs, corner) == MT_EDGE_BOUNDARY) {
            job->last_loop[vertices[corner]] = 0;
            job->last_loop[vertices[next_corner(mesh, corner)]] = 0;
        }
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; status == MT_OK && corner < end; corner++) {
            mt_index a = vertices[corner], b = vertices[corner + 1 == end ? begin : corner + 1];
            if (job->last_loop[a] == 0 && job->last_loop[b] == 0 && a != b) {
                status = mt_edge_set_add(job->state->context, &job->edges, a, b);
            }
        }
    }
    return status;
}

/* The old faces and corners, then the triangles, which come from none. */
static void list_faces(const mt_mesh *mesh, const index_list *triangles, mt_derivation *derivation, mt_index *faces,
                       mt_index *offsets, mt_index *sources, mt_index *vertices)
{
    mt_index old_count = mesh->face_count, added = (mt_index)(triangles->count / 3);
    for (mt_index face = 0; face < old_count + added; face++) {
        faces[face] = face < old_count ? face : MT_NONE;
        offsets[face] = face < old_count ? mt_mesh_face_begin(mesh, face) : mesh->corner_count + 3 * (face - old_count);
    }
    offsets[old_count + added] = mesh->corner_count + 3 * added;
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        sources[corner] = corner;
        vertices[corner] = mesh->corner_vertices[corner];
    }
    memset(sources + mesh->corner_count, 0xff, triangles->count * sizeof *sources); /* MT_NONE */
    memcpy(vertices + mesh->corner_count, triangles->numbers, triangles->count * sizeof *vertices);
    *derivation = (mt_derivation){.vertex_count = mesh->vertex_count,
                                  .face_count = (uint64_t)old_count + added,
                                  .face_size = mesh->face_size == 3 ? 3 : 0,
                                  .face_offsets = offsets,
                                  .face_sources = faces,
                                  .corner_count = mesh->corner_count + triangles->count,
                                  .corner_sources = sources,
                                  .corner_vertices = vertices};
}

static mt_status add_faces(repair_state *state, const index_list *triangles, mt_repair_result *result)
{
    mt_context *context = state->context;
    const mt_mesh *mesh = state->mesh;
    uint64_t face_count = mesh->face_count + triangles->count / 3;
    uint64_t corner_count = mesh->corner_count + triangles->count;
    mt_status status = MT_OK;
    for (uint64_t face = mesh->face_count; status == MT_OK && face < face_count; face++) {
        status = mt_repair_note_face(context, result, (mt_index)face);
    }
    mt_index *faces = mt_allocate_array(context, face_count, sizeof *faces);
    mt_index *offsets = mt_allocate_array(context, face_count + 1, sizeof *offsets);
    mt_index *sources = mt_allocate_array(context, corner_count, sizeof *sources);
    mt_index *vertices = mt_allocate_array(context, corner_count, sizeof *vertices);
    if (status == MT_OK && faces && offsets && sources && vertices) {
        mt_derivation derivation;
        list_faces(mesh, triangles, &derivation, faces, offsets, sources, vertices);
        status = mt_repair_replace(state, &derivation);
    } else {
        status = MT_ERROR_OUT_OF_MEMORY;
    }
    mt_free(context, vertices);
    mt_free(context, sources);
    mt_free(context, offsets);
    mt_free(context, faces);
    return status;
}

static mt_status find_sheets(hole_job *job)
{
    mt_context *context = job->state->context;
    mt_bounds bounds = mt_mesh_bounds(job->state->mesh);
    job->scale = mt_power_of_two_scale(fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum)));
    mt_status status = mt_components_create(context, job->state->mesh, job->pairs, true, &job->components);
    if (status != MT_OK) {
        return status;
    }
    job->flat = mt_allocate(context, job->components->component_count);
    return job->flat ? mt_find_flat_components(context, job->state->mesh, job->components, job->flat)
                     : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status fill_all(hole_job *job)
{
    const mt_mesh *mesh = job->state->mesh;
    mt_context *context = job->state->context;
    job->visited = mt_allocate_zeroed(context, mesh->corner_count);
    job->last_loop = mt_allocate_array(context, mesh->vertex_count, sizeof *job->last_loop);
    if (!job->visited || !job->last_loop) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(job->last_loop, 0xff, mesh->vertex_count * sizeof *job->last_loop);
    mt_status status = find_sheets(job);
    if (status == MT_OK) {
        status = collect_edges(job);
    }
    for (mt_index corner = 0; status == MT_OK && corner < mesh->corner_count; corner++) {
        bool is_boundary = mt_edge_class_of(mesh, job->pairs, corner) == MT_EDGE_BOUNDARY;
        if (is_boundary && !job->visited[corner]) {
            status = fill_loop(job, corner);
        }
    }
    if (status == MT_OK && job->triangles.count) {
        status = add_faces(job->state, &job->triangles, job->result);
    }
    return status;
}

mt_status mt_repair_fill_holes(repair_state *state, const mt_repair_options *options, mt_repair_result *result)
{
    mt_context *context = state->context;
    mt_edge_pairs *pairs;
    mt_status status = mt_edge_pairs_create(context, state->mesh, &pairs);
    if (status != MT_OK) {
        return status;
    }
    hole_job job = {.state = state, .options = options, .pairs = pairs, .result = result};
    status = fill_all(&job);
    mt_edge_set_release(context, &job.edges);
    mt_components_destroy(context, job.components);
    mt_free(context, job.flat);
    mt_free(context, job.visited);
    mt_free(context, job.last_loop);
    mt_free(context, job.loop.numbers);
    mt_free(context, job.triangles.numbers);
    mt_edge_pairs_destroy(context, pairs);
    return status;
}
