/* Normals of faces: the area vector brought to length 1. Cost: linear. */
#include "lib/algorithms/normals_face.h"

#include "lib/algorithms/normals.h"

typedef struct face_points {
    const mt_mesh *mesh;
    mt_index begin;
} face_points;

static mt_vec3 point_of_face(const void *user, mt_index i)
{
    const face_points *face = user;
    return mt_mesh_position(face->mesh, face->mesh->corner_vertices[face->begin + i]);
}

mt_scaled_vector mt_face_area_vector(const mt_mesh *mesh, mt_index face)
{
    face_points points = {mesh, mt_mesh_face_begin(mesh, face)};
    return mt_polygon_area_vector(point_of_face, &points, mt_mesh_face_sides(mesh, face));
}

static void find_normals(void *user, uint64_t begin, uint64_t end)
{
    mt_normals_job *job = user;
    mt_index undefined = 0;
    for (uint64_t face = begin; face < end; face++) {
        mt_vec3 n = mt_unit_vector(mt_any_area_vector(job->mesh, (mt_index)face).vector);
        mt_store_normal(job->values->values, job->values->type, face, n);
        undefined += mt_vector_is_zero(n);
    }
    mt_count_undefined(job, undefined);
}

void mt_normals_of_faces(mt_normals_job *job)
{
    mt_parallel_for(job->context, job->mesh->face_count, MT_NORMALS_GRAIN, find_normals, job);
}
