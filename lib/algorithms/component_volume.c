/* Volumes are summed about the component's own first vertex, with coordinates scaled by a power of two, beside a bound
 * on the rounding errors; what that leaves open is gathered and decided in integers. */
#include "lib/algorithms/component_volume.h"

#include <meshtool/predicates.h>

/* Of the rounding of one term, relative to its absolute products, and of each addition, relative to all of them; the
 * constant stands for what underflows in a term. Less would pass wrong signs. */
#define TERM_ERROR 0x1p-49
#define ADDITION_ERROR 0x1p-52
#define UNDERFLOW_ERROR 0x1p-900

#define UNDECIDED 2

typedef struct component_volume {
    mt_vec3 origin; /* scaled position of its first vertex */
    double sum;     /* six times the volume */
    double size;    /* of the absolute products */
    mt_index triangle_count;
} component_volume;

typedef struct volume_job {
    mt_context *context;
    const mt_mesh *mesh;
    const mt_components *components;
    mt_arithmetic how;
    double scale;
    component_volume *volumes;
    int8_t *signs;
} volume_job;

/* The fan of a face: from the end with the lower vertex, so that a face turned over has the same triangles. */
typedef struct face_fan {
    mt_index begin, sides;
    bool backwards;
} face_fan;

static face_fan fan_of(const mt_mesh *mesh, mt_index face)
{
    face_fan fan = {mt_mesh_face_begin(mesh, face), mt_mesh_face_sides(mesh, face), false};
    const mt_index *vertices = mesh->corner_vertices + fan.begin;
    fan.backwards = vertices[fan.sides - 1] < vertices[1];
    return fan;
}

/* The i-th corner about the first, 1 to sides - 1. */
static mt_index fan_vertex(const mt_mesh *mesh, face_fan fan, mt_index i)
{
    return mesh->corner_vertices[fan.begin + (fan.backwards ? fan.sides - i : i)];
}

static mt_vec3 scaled_position(const volume_job *job, mt_index vertex)
{
    return mt_vec3_scale(mt_mesh_position(job->mesh, vertex), job->scale);
}

static void add_tetrahedron(component_volume *volume, mt_vec3 a, mt_vec3 b, mt_vec3 c, bool negative)
{
    double term = mt_vec3_dot(a, mt_vec3_cross(b, c));
    volume->sum += negative ? -term : term;
    volume->size += fabs(a.x) * (fabs(b.y * c.z) + fabs(b.z * c.y)) + fabs(a.y) * (fabs(b.z * c.x) + fabs(b.x * c.z)) +
                    fabs(a.z) * (fabs(b.x * c.y) + fabs(b.y * c.x));
    volume->triangle_count++;
}

static void add_face(volume_job *job, mt_index face)
{
    component_volume *volume = &job->volumes[job->components->face_component[face]];
    face_fan fan = fan_of(job->mesh, face);
    mt_vec3 first = scaled_position(job, job->mesh->corner_vertices[fan.begin]);
    if (volume->triangle_count == 0) {
        volume->origin = first;
    }
    mt_vec3 apex = mt_vec3_subtract(first, volume->origin);
    mt_vec3 before = mt_vec3_subtract(scaled_position(job, fan_vertex(job->mesh, fan, 1)), volume->origin);
    bool negative = fan.backwards != (job->components->face_turned[face] != 0);
    for (mt_index i = 2; i < fan.sides; i++) {
        mt_vec3 point = mt_vec3_subtract(scaled_position(job, fan_vertex(job->mesh, fan, i)), volume->origin);
        add_tetrahedron(volume, apex, before, point, negative);
        before = point;
    }
}

static int8_t sign_of(const component_volume *volume, mt_arithmetic how)
{
    if (how == MT_ARITHMETIC_EXACT) {
        return UNDECIDED;
    }
    if (how == MT_ARITHMETIC_FLOATING) {
        return (int8_t)(isfinite(volume->sum) ? (volume->sum > 0) - (volume->sum < 0) : 0);
    }
    double count = volume->triangle_count;
    double bound = (TERM_ERROR + count * ADDITION_ERROR) * volume->size + count * UNDERFLOW_ERROR;
    return volume->sum > bound ? 1 : volume->sum < -bound ? -1 : UNDECIDED;
}

/* Triangles of the undecided components, one component after the other. */
typedef struct triangle_lists {
    uint64_t *ends;   /* per component where its next corner goes, then where its last's ends */
    mt_vec3 *corners; /* three a triangle, in its direction after turning */
} triangle_lists;

static uint64_t place_lists(const volume_job *job, uint64_t *ends)
{
    uint64_t at = 0;
    for (mt_index i = 0; i < job->components->component_count; i++) {
        ends[i] = at;
        at += job->signs[i] == UNDECIDED ? 3 * (uint64_t)job->volumes[i].triangle_count : 0;
    }
    return at;
}

static void list_face(const volume_job *job, mt_index face, triangle_lists *lists)
{
    uint64_t *end = &lists->ends[job->components->face_component[face]];
    face_fan fan = fan_of(job->mesh, face);
    bool negative = fan.backwards != (job->components->face_turned[face] != 0);
    for (mt_index i = 2; i < fan.sides; i++) {
        mt_vec3 *corner = lists->corners + *end;
        corner[0] = mt_mesh_position(job->mesh, job->mesh->corner_vertices[fan.begin]);
        corner[negative ? 2 : 1] = mt_mesh_position(job->mesh, fan_vertex(job->mesh, fan, i - 1));
        corner[negative ? 1 : 2] = mt_mesh_position(job->mesh, fan_vertex(job->mesh, fan, i));
        *end += 3;
    }
}

static mt_status decide_exactly(volume_job *job)
{
    mt_index component_count = job->components->component_count;
    triangle_lists lists = {.ends = mt_allocate_array(job->context, component_count, sizeof *lists.ends)};
    if (!lists.ends) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    lists.corners = mt_allocate_array(job->context, place_lists(job, lists.ends), sizeof *lists.corners);
    for (mt_index face = 0; lists.corners && face < job->mesh->face_count; face++) {
        if (job->signs[job->components->face_component[face]] == UNDECIDED) {
            list_face(job, face, &lists);
        }
    }
    for (mt_index i = 0; lists.corners && i < component_count; i++) {
        if (job->signs[i] == UNDECIDED) {
            mt_index count = job->volumes[i].triangle_count;
            job->signs[i] = (int8_t)mt_volume_sign(lists.corners + lists.ends[i] - 3 * (uint64_t)count, count);
        }
    }
    mt_status status = lists.corners ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    mt_free(job->context, lists.corners);
    mt_free(job->context, lists.ends);
    return status;
}

static mt_status decide(volume_job *job)
{
    mt_bounds bounds = mt_mesh_bounds(job->mesh);
    job->scale = mt_power_of_two_scale(fmax(mt_vec3_max_abs(bounds.minimum), mt_vec3_max_abs(bounds.maximum)));
    for (mt_index face = 0; face < job->mesh->face_count; face++) {
        add_face(job, face);
    }
    bool decided = true;
    for (mt_index i = 0; i < job->components->component_count; i++) {
        job->signs[i] = sign_of(&job->volumes[i], job->how);
        decided = decided && job->signs[i] != UNDECIDED;
    }
    return decided ? MT_OK : decide_exactly(job);
}

mt_status mt_component_volume_signs(mt_context *context, const mt_mesh *mesh, const mt_components *components,
                                    mt_arithmetic how, int8_t *signs)
{
    volume_job job = {.context = context, .mesh = mesh, .components = components, .how = how, .signs = signs};
    job.volumes = mt_allocate_array_zeroed(context, components->component_count, sizeof *job.volumes);
    mt_status status = job.volumes ? decide(&job) : MT_ERROR_OUT_OF_MEMORY;
    mt_free(context, job.volumes);
    return status;
}
