/* The nearest point of one element, in double.
 *
 * It is the foot of the perpendicular where that lies inside the triangle, else the nearest of its sides' (after
 * Ericson, "Real-Time Collision Detection", 5.1.5, without the regions). The three sides are measured side by side, and
 * so are the three areas about the foot. Sides are measured from their lower vertex to the higher one, so that all
 * triangles of a side measure the same bits; segments and points are triangles that name vertices again. Known
 * weakness: the normal of a sliver of aspect 10^k has lost k digits, and with it the foot. */
#ifndef MT_SPATIAL_ELEMENT_DISTANCE_H
#define MT_SPATIAL_ELEMENT_DISTANCE_H

#include <meshtool/clones.h>

#include "lib/spatial/surface_tree.h"

typedef struct mt_element_distance {
    double square; /* in space */
    double weights[3];
} mt_element_distance;

/* Vectors of four are what processors have; the last lane repeats the first. */
#define MT_SIDES 4

/* Three vectors, a lane each. */
typedef struct mt_lanes {
    double x[MT_SIDES], y[MT_SIDES], z[MT_SIDES];
} mt_lanes;

/* Where the nearest point of each side is. */
typedef struct mt_side_distances {
    double squares[MT_SIDES];
    double shares[MT_SIDES]; /* of the way from the lower vertex to the higher */
} mt_side_distances;

MT_INLINE void mt_set_lane(mt_lanes *lanes, int lane, mt_vec3 v)
{
    lanes->x[lane] = v.x;
    lanes->y[lane] = v.y;
    lanes->z[lane] = v.z;
}

/* From the origin to the sides from `a` to `b`. */
MT_INLINE void mt_measure_sides(const mt_lanes *a, const mt_lanes *b, mt_side_distances *out)
{
    for (int i = 0; i < MT_SIDES; i++) {
        double ex = b->x[i] - a->x[i], ey = b->y[i] - a->y[i], ez = b->z[i] - a->z[i];
        double length = ex * ex + ey * ey + ez * ez;
        double along = -(a->x[i] * ex + a->y[i] * ey + a->z[i] * ez);
        bool is_past = along >= length, is_after = along > 0;
        double share = along / length;
        double x = a->x[i] + ex * share, y = a->y[i] + ey * share, z = a->z[i] + ez * share;
        x = is_past ? b->x[i] : x, y = is_past ? b->y[i] : y, z = is_past ? b->z[i] : z;
        x = is_after ? x : a->x[i], y = is_after ? y : a->y[i], z = is_after ? z : a->z[i];
        share = is_past ? 1 : share;
        out->shares[i] = is_after ? share : 0;
        out->squares[i] = x * x + y * y + z * z;
    }
}

/* The foot of the origin on the triangle's plane, where it lies inside the triangle: lane i is corner i of `p`, the one
 * after it of `q`. */
MT_INLINE void mt_measure_inside(const mt_lanes *p, const mt_lanes *q, mt_element_distance *best)
{
    double ux = q->x[0] - p->x[0], uy = q->y[0] - p->y[0], uz = q->z[0] - p->z[0];
    double vx = p->x[2] - p->x[0], vy = p->y[2] - p->y[0], vz = p->z[2] - p->z[0];
    double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    double areas[MT_SIDES]; /* lane i: of the side from i to the one after it */
    for (int i = 0; i < MT_SIDES; i++) {
        double x = p->y[i] * q->z[i] - p->z[i] * q->y[i];
        double y = p->z[i] * q->x[i] - p->x[i] * q->z[i];
        double z = p->x[i] * q->y[i] - p->y[i] * q->x[i];
        areas[i] = nx * x + ny * y + nz * z;
    }
    double length = nx * nx + ny * ny + nz * nz;
    if (!(areas[0] > 0 && areas[1] > 0 && areas[2] > 0 && length > 0)) {
        return;
    }
    double height = nx * p->x[0] + ny * p->y[0] + nz * p->z[0];
    double square = height * height / length, sum = areas[1] + areas[2] + areas[0];
    if (square < best->square) {
        *best = (mt_element_distance){square, {areas[1] / sum, areas[2] / sum, areas[0] / sum}};
    }
}

/* From a point to an element of the tree. `scaled` is the point times the space's scale: differences to the vertices,
 * scaled alike, keep all of their digits, which the tree's own coordinates would not. */
MT_INLINE mt_element_distance mt_element_distance_inline(const mt_surface_tree *tree, mt_index number, mt_vec3 scaled)
{
    mt_surface_element element = mt_surface_element_of(tree->mesh, tree->triangulation, &tree->numbering, number);
    const mt_index *vertices = element.vertices;
    mt_vec3 corners[3];
    mt_lanes p, q, from, to;
    for (int i = 0; i < 3; i++) {
        mt_vec3 vertex = mt_vec3_scale(mt_mesh_position(tree->mesh, vertices[i]), tree->space.scale);
        corners[i] = mt_vec3_subtract(vertex, scaled);
    }
    const int ends[MT_SIDES][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 1}};
    for (int i = 0; i < MT_SIDES; i++) {
        int a = ends[i][0], b = ends[i][1];
        bool ascends = vertices[a] <= vertices[b];
        mt_set_lane(&p, i, corners[a]);
        mt_set_lane(&q, i, corners[b]);
        mt_set_lane(&from, i, corners[ascends ? a : b]);
        mt_set_lane(&to, i, corners[ascends ? b : a]);
    }
    mt_side_distances sides;
    mt_measure_sides(&from, &to, &sides);
    int side = sides.squares[1] < sides.squares[0];
    side = sides.squares[2] < sides.squares[side] ? 2 : side;
    mt_element_distance best = {sides.squares[side], {0, 0, 0}};
    bool ascends = vertices[ends[side][0]] <= vertices[ends[side][1]];
    best.weights[ends[side][ascends]] = sides.shares[side];
    best.weights[ends[side][!ascends]] = 1 - sides.shares[side];
    mt_measure_inside(&p, &q, &best);
    return best;
}

/* The same, called. */
mt_element_distance mt_element_distance_to(const mt_surface_tree *tree, mt_index number, mt_vec3 scaled);

#endif
