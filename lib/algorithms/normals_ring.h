/* The corners at each vertex, and what each adds to a normal there. */
#ifndef MT_ALGORITHMS_NORMALS_RING_H
#define MT_ALGORITHMS_NORMALS_RING_H

#include "lib/algorithms/normals.h"

typedef struct mt_normal_rings {
    const mt_mesh *mesh;
    mt_normal_weight weight;
    mt_index *begins;       /* vertex_count + 1: where each vertex's corners begin */
    mt_index *corners;      /* of each vertex ascending */
    mt_index *corner_faces; /* NULL when all faces have the same size */
    mt_vec3 *units;         /* per face its unit normal, or zero */
    mt_index most;          /* corners at any vertex */
} mt_normal_rings;

/* Lists the corners and finds the faces' unit normals. O(vertices + corners); 4 bytes a vertex and a corner, 24 a face.
 * On failure all is released. */
mt_status mt_normal_rings_init(mt_normals_job *job, mt_normal_rings *rings);
void mt_normal_rings_release(mt_context *context, mt_normal_rings *rings);

static inline mt_index mt_ring_face(const mt_normal_rings *rings, mt_index corner)
{
    return rings->corner_faces ? rings->corner_faces[corner] : corner / rings->mesh->face_size;
}

/* The corners after and before one in its face. */
static inline mt_index mt_ring_next(const mt_normal_rings *rings, mt_index corner, mt_index face)
{
    return corner + 1 == mt_mesh_face_end(rings->mesh, face) ? mt_mesh_face_begin(rings->mesh, face) : corner + 1;
}

static inline mt_index mt_ring_previous(const mt_normal_rings *rings, mt_index corner, mt_index face)
{
    return corner == mt_mesh_face_begin(rings->mesh, face) ? mt_mesh_face_end(rings->mesh, face) - 1 : corner - 1;
}

/* What a corner adds by the weight. Zero where its face has no normal. */
mt_scaled_vector mt_corner_term(const mt_normal_rings *rings, mt_index corner);

/* sum += term, at the larger of both exponents. */
static inline void mt_add_term(mt_scaled_vector *sum, mt_scaled_vector term)
{
    if (sum->exponent != term.exponent) {
        if (mt_vector_is_zero(term.vector)) {
            return;
        }
        bool rises = mt_vector_is_zero(sum->vector) || sum->exponent < term.exponent;
        int exponent = rises ? term.exponent : sum->exponent;
        sum->vector = mt_shift_vector(sum->vector, sum->exponent - exponent);
        term.vector = mt_shift_vector(term.vector, term.exponent - exponent);
        sum->exponent = exponent;
    }
    sum->vector = mt_vec3_add(sum->vector, term.vector);
}

#endif
