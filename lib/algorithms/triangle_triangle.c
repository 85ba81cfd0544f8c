/* Contact of triangles by signs of orientations alone, so that the answer is exact.
 *
 * Two closed triangles meet when an edge of one meets the other. A segment that does not lie in the triangle's plane
 * meets it when its ends are not strictly on one side and its line passes the three edges on the same side; one that
 * lies in it is decided in a projection along an axis in which the triangle keeps an area. */
#include "lib/algorithms/triangle_triangle.h"

/* The arithmetic is a constant wherever these are called from, so that each has a copy of the code and none asks. */
#define MT_ALWAYS __attribute__((always_inline)) static inline

/* Coordinates kept by the projection along x, y and z. */
static const int kept_axes[3][2] = {{1, 2}, {2, 0}, {0, 1}};

typedef struct flat_point {
    double at[2];
} flat_point;

static flat_point flatten(mt_vec3 p, int dropped)
{
    const double all[3] = {p.x, p.y, p.z};
    flat_point flat = {{all[kept_axes[dropped][0]], all[kept_axes[dropped][1]]}};
    return flat;
}

MT_ALWAYS int turn(mt_arithmetic how, flat_point a, flat_point b, flat_point c)
{
    if (how == MT_ARITHMETIC_EXACT) {
        return mt_orient2d_exact(a.at, b.at, c.at);
    }
    if (how == MT_ARITHMETIC_FLOATING) {
        double left = (a.at[0] - c.at[0]) * (b.at[1] - c.at[1]), right = (a.at[1] - c.at[1]) * (b.at[0] - c.at[0]);
        return (left > right) - (left < right);
    }
    return mt_orient2d(a.at, b.at, c.at);
}

MT_ALWAYS int side_of(mt_arithmetic how, mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d)
{
    if (how == MT_ARITHMETIC_EXACT) {
        return mt_orient3d_exact(a, b, c, d);
    }
    if (how == MT_ARITHMETIC_FLOATING) {
        mt_vec3 e = mt_vec3_subtract(a, d), f = mt_vec3_subtract(b, d), g = mt_vec3_subtract(c, d);
        double determinant = mt_vec3_dot(e, mt_vec3_cross(f, g));
        return (determinant > 0) - (determinant < 0);
    }
    return mt_orient3d(a, b, c, d);
}

/* An axis along which the triangle's projection has an area; its turn there goes to *sense. */
MT_ALWAYS int projection_axis(mt_arithmetic how, const mt_vec3 triangle[3], int *sense)
{
    for (int axis = 0; axis < 3; axis++) {
        *sense = turn(how, flatten(triangle[0], axis), flatten(triangle[1], axis), flatten(triangle[2], axis));
        if (*sense) {
            return axis;
        }
    }
    return 0;
}

static bool between(double x, double a, double b)
{
    return (a <= x && x <= b) || (b <= x && x <= a);
}

/* Whether p, known to be on the line of a and b, lies on the closed segment. */
static bool on_segment(flat_point p, flat_point a, flat_point b)
{
    return between(p.at[0], a.at[0], b.at[0]) && between(p.at[1], a.at[1], b.at[1]);
}

MT_ALWAYS bool flat_segments_meet(mt_arithmetic how, flat_point a, flat_point b, flat_point c, flat_point d)
{
    int abc = turn(how, a, b, c), abd = turn(how, a, b, d), cda = turn(how, c, d, a), cdb = turn(how, c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) {
        return true;
    }
    return (abc == 0 && on_segment(c, a, b)) || (abd == 0 && on_segment(d, a, b)) ||
           (cda == 0 && on_segment(a, c, d)) || (cdb == 0 && on_segment(b, c, d));
}

MT_ALWAYS bool flat_triangle_holds(mt_arithmetic how, const flat_point corner[3], int sense, flat_point p)
{
    return turn(how, corner[0], corner[1], p) * sense >= 0 && turn(how, corner[1], corner[2], p) * sense >= 0 &&
           turn(how, corner[2], corner[0], p) * sense >= 0;
}

MT_ALWAYS bool coplanar_segment_meets(mt_arithmetic how, mt_vec3 s, mt_vec3 t, const mt_vec3 triangle[3])
{
    int sense;
    int axis = projection_axis(how, triangle, &sense);
    flat_point corner[3], a = flatten(s, axis), b = flatten(t, axis);
    for (int i = 0; i < 3; i++) {
        corner[i] = flatten(triangle[i], axis);
    }
    return flat_triangle_holds(how, corner, sense, a) || flat_triangle_holds(how, corner, sense, b) ||
           flat_segments_meet(how, a, b, corner[0], corner[1]) || flat_segments_meet(how, a, b, corner[1], corner[2]) ||
           flat_segments_meet(how, a, b, corner[2], corner[0]);
}

/* The segment's ends on the sides s_side and t_side of the triangle's plane. */
MT_ALWAYS bool segment_meets(mt_arithmetic how, mt_vec3 s, mt_vec3 t, const mt_vec3 triangle[3], int s_side, int t_side)
{
    if (s_side * t_side > 0) {
        return false;
    }
    if (s_side == 0 && t_side == 0) {
        return coplanar_segment_meets(how, s, t, triangle);
    }
    int first = side_of(how, s, t, triangle[0], triangle[1]);
    int second = side_of(how, s, t, triangle[1], triangle[2]);
    if (first * second < 0) {
        return false;
    }
    int third = side_of(how, s, t, triangle[2], triangle[0]);
    return first * third >= 0 && second * third >= 0;
}

MT_ALWAYS int plane_side(mt_arithmetic how, const mt_vec3 triangle[3], mt_vec3 p)
{
    return side_of(how, triangle[0], triangle[1], triangle[2], p);
}

/* Whether b's three points lie strictly on one side of a's plane; otherwise their sides. */
MT_ALWAYS bool is_apart(mt_arithmetic how, const indexed_triangle *a, const indexed_triangle *b, int sides[3])
{
    for (int i = 0; i < 3; i++) {
        sides[i] = plane_side(how, a->points, b->points[i]);
    }
    return (sides[0] > 0 && sides[1] > 0 && sides[2] > 0) || (sides[0] < 0 && sides[1] < 0 && sides[2] < 0);
}

MT_ALWAYS bool an_edge_meets(mt_arithmetic how, const indexed_triangle *edges_of, const indexed_triangle *other,
                             const int sides[3])
{
    for (int i = 0; i < 3; i++) {
        int next = i == 2 ? 0 : i + 1;
        if (segment_meets(how, edges_of->points[i], edges_of->points[next], other->points, sides[i], sides[next])) {
            return true;
        }
    }
    return false;
}

MT_ALWAYS bool separate_triangles_meet(mt_arithmetic how, const indexed_triangle *a, const indexed_triangle *b)
{
    int b_sides[3], a_sides[3];
    if (is_apart(how, a, b, b_sides) || is_apart(how, b, a, a_sides)) {
        return false;
    }
    return an_edge_meets(how, b, a, b_sides) || an_edge_meets(how, a, b, a_sides);
}

/* a's corner i and b's corner j are the same vertex. Where the opposite edge of one lies strictly on one side of the
 * other's plane, so does all of it but that vertex, and nothing meets. */
MT_ALWAYS bool joined_triangles_meet(mt_arithmetic how, const indexed_triangle *a, int i, const indexed_triangle *b,
                                     int j)
{
    static const int after[3] = {1, 2, 0}, before[3] = {2, 0, 1};
    mt_vec3 p = a->points[after[i]], q = a->points[before[i]], r = b->points[after[j]], s = b->points[before[j]];
    int p_side = plane_side(how, b->points, p), q_side = plane_side(how, b->points, q);
    if (p_side * q_side > 0) {
        return false;
    }
    int r_side = plane_side(how, a->points, r), s_side = plane_side(how, a->points, s);
    if (r_side * s_side > 0) {
        return false;
    }
    return segment_meets(how, p, q, b->points, p_side, q_side) || segment_meets(how, r, s, a->points, r_side, s_side);
}

/* a's edge opposite its corner i is b's edge opposite its corner j. */
MT_ALWAYS bool adjacent_triangles_overlap(mt_arithmetic how, const indexed_triangle *a, int i,
                                          const indexed_triangle *b, int j)
{
    static const int after[3] = {1, 2, 0}, before[3] = {2, 0, 1};
    mt_vec3 apex = b->points[j];
    if (plane_side(how, a->points, apex) != 0) {
        return false;
    }
    int sense;
    int axis = projection_axis(how, a->points, &sense);
    flat_point p = flatten(a->points[after[i]], axis), q = flatten(a->points[before[i]], axis);
    return turn(how, p, q, flatten(apex, axis)) * sense > 0;
}

MT_ALWAYS bool intersect(mt_arithmetic how, const indexed_triangle *a, const indexed_triangle *b)
{
    int shared = 0, a_corner = 0, b_corner = 0, a_sum = 0, b_sum = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            if (a->vertices[i] == b->vertices[j]) {
                shared++;
                a_corner = i, b_corner = j;
                a_sum += i, b_sum += j;
            }
        }
    }
    switch (shared) {
    case 0:
        return separate_triangles_meet(how, a, b);
    case 1:
        return joined_triangles_meet(how, a, a_corner, b, b_corner);
    case 2:
        return adjacent_triangles_overlap(how, a, 3 - a_sum, b, 3 - b_sum);
    default:
        return false;
    }
}

bool mt_triangles_intersect(mt_arithmetic how, const indexed_triangle *a, const indexed_triangle *b)
{
    switch (how) {
    case MT_ARITHMETIC_FLOATING:
        return intersect(MT_ARITHMETIC_FLOATING, a, b);
    case MT_ARITHMETIC_EXACT:
        return intersect(MT_ARITHMETIC_EXACT, a, b);
    default:
        return intersect(MT_ARITHMETIC_ADAPTIVE, a, b);
    }
}
