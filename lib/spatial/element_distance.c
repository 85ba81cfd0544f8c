/* The nearest point of a triangle is its foot where that lies inside, else the nearest of its sides' (after Ericson,
 * "Real-Time Collision Detection", 5.1.5, without the regions). Sides are measured from their lower vertex to the
 * higher one, so that all triangles of a side measure the same bits; segments and points are triangles that name
 * vertices again. Known weakness: the normal of a sliver of aspect 10^k has lost k digits, and with it the foot. */
#include "lib/spatial/element_distance.h"

typedef struct side {
    int from, to; /* of the element's vertices */
} side;

/* From the origin to the side, whose ends are p[from] and p[to]. */
static void measure_side(const mt_vec3 p[3], side s, mt_element_distance *best)
{
    mt_vec3 a = p[s.from], e = mt_vec3_subtract(p[s.to], a);
    double length = mt_vec3_dot(e, e), along = -mt_vec3_dot(a, e);
    int end = along >= length && length > 0 ? s.to : s.from;
    bool is_inside = along > 0 && along < length;
    double share = is_inside ? along / length : 0;
    mt_vec3 nearest = is_inside ? mt_vec3_add(a, mt_vec3_scale(e, share)) : p[end];
    double square = mt_vec3_dot(nearest, nearest);
    if (square < best->square) {
        best->square = square;
        best->weights[0] = best->weights[1] = best->weights[2] = 0;
        best->weights[s.to] = share;
        best->weights[s.from] = 1 - share;
        if (!is_inside) {
            best->weights[s.to] = best->weights[s.from] = 0;
            best->weights[end] = 1;
        }
    }
}

/* The foot of the origin on the triangle's plane, where it lies inside the triangle. */
static void measure_inside(const mt_vec3 p[3], mt_element_distance *best)
{
    mt_vec3 normal = mt_vec3_cross(mt_vec3_subtract(p[1], p[0]), mt_vec3_subtract(p[2], p[0]));
    double u = mt_vec3_dot(normal, mt_vec3_cross(p[1], p[2]));
    double v = mt_vec3_dot(normal, mt_vec3_cross(p[2], p[0]));
    double w = mt_vec3_dot(normal, mt_vec3_cross(p[0], p[1]));
    double length = mt_vec3_dot(normal, normal), sum = u + v + w;
    if (!(u > 0 && v > 0 && w > 0 && length > 0)) {
        return;
    }
    double height = mt_vec3_dot(normal, p[0]);
    double square = height * height / length;
    if (square < best->square) {
        *best = (mt_element_distance){square, {u / sum, v / sum, w / sum}};
    }
}

mt_element_distance mt_element_distance_to(const mt_surface_tree *tree, mt_index number, mt_vec3 scaled)
{
    mt_surface_element element = mt_surface_element_of(tree->mesh, tree->triangulation, &tree->numbering, number);
    mt_vec3 p[3];
    for (int i = 0; i < 3; i++) {
        mt_vec3 vertex = mt_vec3_scale(mt_mesh_position(tree->mesh, element.vertices[i]), tree->space.scale);
        p[i] = mt_vec3_subtract(vertex, scaled);
    }
    mt_element_distance best = {INFINITY, {0, 0, 0}};
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        bool ascends = element.vertices[i] <= element.vertices[next];
        measure_side(p, ascends ? (side){i, next} : (side){next, i}, &best);
    }
    measure_inside(p, &best);
    return best;
}
