/* The area vector of a face in plain doubles, where they serve, and normals as they are stored. */
#ifndef MT_ALGORITHMS_NORMALS_FACE_H
#define MT_ALGORITHMS_NORMALS_FACE_H

#include <meshtool/normals.h>

/* What lies in the mesh's arrays, by their types known when compiled. */
MT_INLINE mt_vec3 mt_typed_position(const void *positions, bool is_double, mt_index vertex)
{
    size_t at = 3 * (size_t)vertex;
    if (is_double) {
        const double *p = (const double *)positions + at;
        return mt_vec3_make(p[0], p[1], p[2]);
    }
    const float *p = (const float *)positions + at;
    return mt_vec3_make((double)p[0], (double)p[1], (double)p[2]);
}

/* Stores the area vector of a triangle, or of a face of `sides`. False when it needs mt_face_area_vector. */
MT_INLINE bool mt_plain_area_vector(const void *positions, bool is_double, const mt_index *vertices, mt_index sides,
                                    mt_vec3 *area_vector)
{
    mt_vec3 origin = mt_typed_position(positions, is_double, vertices[0]);
    mt_area_sum area;
    mt_area_sum_begin(&area, mt_vec3_subtract(mt_typed_position(positions, is_double, vertices[1]), origin));
    for (mt_index i = 2; i < sides; i++) {
        mt_area_sum_add(&area, mt_vec3_subtract(mt_typed_position(positions, is_double, vertices[i]), origin));
    }
    *area_vector = area.sum;
    return mt_is_plain(area.sum) && mt_area_sum_is_sure(&area);
}

/* mt_face_area_vector, quickly where plain doubles serve. */
MT_INLINE mt_scaled_vector mt_any_area_vector(const mt_mesh *mesh, mt_index face)
{
    const mt_index *vertices = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
    bool is_double = mesh->position_type == MT_F64;
    mt_vec3 n;
    if (mt_plain_area_vector(mesh->positions, is_double, vertices, mt_mesh_face_sides(mesh, face), &n)) {
        mt_scaled_vector plain = {n, 0};
        return plain;
    }
    return mt_face_area_vector(mesh, face);
}

/* A unit normal, or zero, as number `at` of an attribute's values; never -0. */
MT_INLINE void mt_store_normal(void *values, mt_type type, size_t at, mt_vec3 n)
{
    n = mt_vec3_add(n, mt_vec3_make(0, 0, 0));
    if (type == MT_F64) {
        double *to = (double *)values + 3 * at;
        to[0] = n.x, to[1] = n.y, to[2] = n.z;
    } else {
        float *to = (float *)values + 3 * at;
        to[0] = (float)n.x, to[1] = (float)n.y, to[2] = (float)n.z;
    }
}

#endif
