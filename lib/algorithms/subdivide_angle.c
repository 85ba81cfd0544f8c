/* Normals of polygons by Newell's method, about their first vertex so that a far origin costs no digits.
 * Cost: O(corners); 24 bytes a face meanwhile. */
#include "lib/algorithms/subdivide_angle.h"

#include <meshtool/elementary.h>
#include <meshtool/vector.h>

#define FACE_GRAIN 4096

typedef struct normal_job {
    const mt_mesh *mesh;
    mt_vec3 *normals;
} normal_job;

static void compute_normals(void *user, uint64_t begin, uint64_t end)
{
    const normal_job *job = user;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index first = mt_mesh_face_begin(job->mesh, face), last = mt_mesh_face_end(job->mesh, face);
        mt_vec3 origin = mt_mesh_position(job->mesh, job->mesh->corner_vertices[first]);
        mt_vec3 sum = mt_vec3_make(0, 0, 0), before = sum;
        for (mt_index corner = first + 1; corner < last; corner++) {
            mt_vec3 p = mt_vec3_subtract(mt_mesh_position(job->mesh, job->mesh->corner_vertices[corner]), origin);
            sum = mt_vec3_add(sum, mt_vec3_cross(before, p));
            before = p;
        }
        job->normals[face] = mt_vec3_normalize(sum);
    }
}

/* Walks the edges with two faces; lists them unless `creases` is NULL, and returns their number. */
static mt_index list_creases(const mt_mesh *mesh, const mt_index *twins, const mt_vec3 *normals, double cosine,
                             double sharpness, mt_edge_value *creases)
{
    mt_index count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            if (twins[corner] <= corner) {
                continue;
            }
            mt_vec3 other = normals[mt_mesh_corner_face(mesh, twins[corner])];
            if (!(mt_vec3_dot(normals[face], other) < cosine) || mt_vec3_max_abs(normals[face]) == 0 ||
                mt_vec3_max_abs(other) == 0) {
                continue;
            }
            mt_index next = corner + 1 < end ? corner + 1 : begin;
            if (creases) {
                creases[count] = (mt_edge_value){mesh->corner_vertices[corner], mesh->corner_vertices[next], sharpness};
            }
            count++;
        }
    }
    return count;
}

mt_status mt_creases_of_angle(mt_context *context, const mt_mesh *mesh, const mt_index *twins, double angle,
                              double sharpness, mt_edge_value **creases, mt_index *count)
{
    normal_job job = {mesh, mt_allocate_array(context, mesh->face_count, sizeof(mt_vec3))};
    double cosine = mt_cos(angle < MT_PI ? angle : MT_PI);
    *creases = NULL;
    *count = 0;
    if (job.normals) {
        mt_parallel_for(context, mesh->face_count, FACE_GRAIN, compute_normals, &job);
        *count = list_creases(mesh, twins, job.normals, cosine, sharpness, NULL);
        *creases = mt_allocate_array(context, *count, sizeof **creases);
    }
    if (*creases) {
        list_creases(mesh, twins, job.normals, cosine, sharpness, *creases);
    }
    mt_free(context, job.normals);
    return *creases ? MT_OK : mt_context_error(context)->status;
}
