/* One direction of a deviation: what its steps share. */
#ifndef MT_ALGORITHMS_DEVIATION_SIDE_H
#define MT_ALGORITHMS_DEVIATION_SIDE_H

#include <meshtool/closest_point.h>
#include <meshtool/deviation.h>

/* A mesh with its triangulation and its tree. */
typedef struct mt_deviation_surface {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    mt_surface_tree *tree;
} mt_deviation_surface;

/* The nearest element of the other surface, and how far it is. */
typedef struct mt_deviation_near {
    double distance; /* NAN: the point is not finite */
    mt_index element;
} mt_deviation_near;

typedef struct mt_deviation_job {
    mt_context *context;
    const mt_deviation_surface *from, *to;
    double tolerance, spacing;
    bool maximum_only;
    double unit;                 /* power of two that brings the diagonal to 1: for squares and areas */
    mt_deviation_near *vertices; /* per vertex of `from` */
    mt_deviation_near *centers;  /* per triangle of `from` its centroid's; MT_NONE: not known */
    mt_deviation_side *out;
} mt_deviation_job;

/* Fills `vertices`, `centers`, mean, rms, normals, and the maximum over all samples. */
mt_status mt_deviation_sample(mt_deviation_job *job);

/* Raises the maximum, or lowers its error, to the tolerance. */
mt_status mt_deviation_refine(mt_deviation_job *job);

typedef struct mt_deviation_triangle {
    mt_vec3 corners[3];
} mt_deviation_triangle;

static inline mt_deviation_triangle mt_deviation_triangle_of(const mt_deviation_surface *surface, mt_index triangle)
{
    mt_deviation_triangle t;
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(&surface->triangulation, triangle, side);
        t.corners[side] = mt_mesh_position(surface->mesh, surface->mesh->corner_vertices[corner]);
    }
    return t;
}

static inline mt_vec3 mt_deviation_point(const mt_deviation_triangle *t, double u, double v, double w)
{
    return mt_vec3_add(mt_vec3_scale(t->corners[0], u),
                       mt_vec3_add(mt_vec3_scale(t->corners[1], v), mt_vec3_scale(t->corners[2], w)));
}

/* The nearest element, sought near `hint` first (MT_NONE: none). */
static inline mt_deviation_near mt_deviation_nearest(const mt_deviation_surface *surface, mt_vec3 point, mt_index hint)
{
    mt_closest_options options = {.has_hint = hint != MT_NONE, .hint = hint};
    mt_closest closest;
    if (!mt_surface_tree_closest(surface->tree, point, &options, &closest)) {
        return (mt_deviation_near){NAN, MT_NONE};
    }
    return (mt_deviation_near){closest.distance, closest.element};
}

#endif
