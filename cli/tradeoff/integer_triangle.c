#include "tradeoff/integer_triangle.h"

#include "tradeoff/integer.h"

/* Both triangles' points as whole numbers: 0 to 2 and 3 to 5; of three points alone, the first three. */
typedef struct pair {
    integer points[6][3];
} pair;

static void load(pair *p, const mt_vec3 *points, int count)
{
    double coordinates[6][3];
    int least = 0;
    bool is_first = true;
    for (int i = 0; i < count; i++) {
        coordinates[i][0] = points[i].x, coordinates[i][1] = points[i].y, coordinates[i][2] = points[i].z;
        for (int axis = 0; axis < 3; axis++) {
            int exponent = integer_exponent(coordinates[i][axis]);
            least = is_first || exponent < least ? exponent : least;
            is_first = false;
        }
    }
    for (int i = 0; i < count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            integer_from(coordinates[i][axis], least, &p->points[i][axis]);
        }
    }
}

/* a d - b c. */
static void determinant(const integer *a, const integer *b, const integer *c, const integer *d, integer *out)
{
    integer first, second;
    integer_multiply(a, d, &first);
    integer_multiply(b, c, &second);
    integer_subtract(&first, &second, out);
}

/* How the points turn in the projection along an axis. */
static int turn(const pair *p, int a, int b, int c, int axis)
{
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    integer bu, bv, cu, cv, area;
    integer_subtract(&p->points[b][u], &p->points[a][u], &bu);
    integer_subtract(&p->points[b][v], &p->points[a][v], &bv);
    integer_subtract(&p->points[c][u], &p->points[a][u], &cu);
    integer_subtract(&p->points[c][v], &p->points[a][v], &cv);
    determinant(&bu, &bv, &cu, &cv, &area);
    return area.sign;
}

/* An axis along which the three points are not seen in a line, -1: there is none. */
static int open_axis(const pair *p, int a, int b, int c)
{
    for (int axis = 0; axis < 3; axis++) {
        if (turn(p, a, b, c, axis) != 0) {
            return axis;
        }
    }
    return -1;
}

/* The sign of the volume of the tetrahedron. */
static int side(const pair *p, int a, int b, int c, int d)
{
    const int others[3] = {b, c, d};
    integer edges[3][3], minor, term, sum, next;
    for (int i = 0; i < 3; i++) {
        for (int axis = 0; axis < 3; axis++) {
            integer_subtract(&p->points[others[i]][axis], &p->points[a][axis], &edges[i][axis]);
        }
    }
    determinant(&edges[1][1], &edges[1][2], &edges[2][1], &edges[2][2], &minor);
    integer_multiply(&edges[0][0], &minor, &sum);
    determinant(&edges[1][2], &edges[1][0], &edges[2][2], &edges[2][0], &minor);
    integer_multiply(&edges[0][1], &minor, &term);
    integer_add(&sum, &term, &next);
    determinant(&edges[1][0], &edges[1][1], &edges[2][0], &edges[2][1], &minor);
    integer_multiply(&edges[0][2], &minor, &term);
    integer_add(&next, &term, &sum);
    return sum.sign;
}

static bool are_mixed(int a, int b, int c)
{
    return (a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0);
}

/* Of a point on the segment's line, in the projection. */
static bool is_between(const pair *p, int point, int a, int b, int axis)
{
    for (int i = 1; i < 3; i++) {
        integer from, to;
        int u = (axis + i) % 3;
        integer_subtract(&p->points[point][u], &p->points[a][u], &from);
        integer_subtract(&p->points[b][u], &p->points[point][u], &to);
        if (from.sign * to.sign < 0) {
            return false;
        }
    }
    return true;
}

static bool do_segments_meet(const pair *p, const int first[2], const int second[2], int axis)
{
    int a = first[0], b = first[1], c = second[0], d = second[1];
    int at_c = turn(p, a, b, c, axis), at_d = turn(p, a, b, d, axis);
    int at_a = turn(p, c, d, a, axis), at_b = turn(p, c, d, b, axis);
    return (at_c * at_d < 0 && at_a * at_b < 0) || (at_c == 0 && is_between(p, c, a, b, axis)) ||
           (at_d == 0 && is_between(p, d, a, b, axis)) || (at_a == 0 && is_between(p, a, c, d, axis)) ||
           (at_b == 0 && is_between(p, b, c, d, axis));
}

/* A segment in the triangle's plane. */
static bool does_flat_segment_meet(const pair *p, const int segment[2], int triangle)
{
    int a = triangle, b = triangle + 1, c = triangle + 2, from = segment[0], axis = open_axis(p, a, b, c);
    if (!are_mixed(turn(p, a, b, from, axis), turn(p, b, c, from, axis), turn(p, c, a, from, axis))) {
        return true;
    }
    return do_segments_meet(p, segment, (int[2]){a, b}, axis) || do_segments_meet(p, segment, (int[2]){b, c}, axis) ||
           do_segments_meet(p, segment, (int[2]){c, a}, axis);
}

/* The side of triangle `from` opposite to its point `at`, and the triangle that begins at `other`. */
static bool does_side_meet(const pair *p, int from, int at, int other)
{
    const int segment[2] = {from + (at + 1) % 3, from + (at + 2) % 3};
    int a = other, b = other + 1, c = other + 2;
    int begin = side(p, a, b, c, segment[0]), end = side(p, a, b, c, segment[1]);
    if (begin * end > 0) {
        return false;
    }
    if (begin == 0 && end == 0) {
        return does_flat_segment_meet(p, segment, other);
    }
    return !are_mixed(side(p, segment[0], segment[1], a, b), side(p, segment[0], segment[1], b, c),
                      side(p, segment[0], segment[1], c, a));
}

/* All contacts of two triangles begin or end on a side of one. */
static bool do_apart_meet(const pair *p)
{
    for (int at = 0; at < 3; at++) {
        if (does_side_meet(p, 0, at, 3) || does_side_meet(p, 3, at, 0)) {
            return true;
        }
    }
    return false;
}

/* Triangles that share the side opposite to both points. */
static bool are_folded(const pair *p, int at, int other)
{
    int a = (at + 1) % 3, b = (at + 2) % 3, c = 3 + other;
    if (side(p, a, b, at, c) != 0) {
        return false;
    }
    int axis = open_axis(p, 0, 1, 2);
    return turn(p, a, b, at, axis) == turn(p, a, b, c, axis);
}

bool integer_triangles_intersect(const integer_triangle *a, const integer_triangle *b)
{
    int shared = 0, of_a = 0, of_b = 0;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            if (a->vertices[i] == b->vertices[j]) {
                shared++;
                of_a += i, of_b += j;
            }
        }
    }
    const mt_vec3 points[6] = {a->points[0], a->points[1], a->points[2], b->points[0], b->points[1], b->points[2]};
    pair p;
    load(&p, points, 6);
    if (shared > 2 || open_axis(&p, 0, 1, 2) < 0 || open_axis(&p, 3, 4, 5) < 0) {
        return false;
    }
    switch (shared) {
    case 0:
        return do_apart_meet(&p);
    case 1:
        return does_side_meet(&p, 0, of_a, 3) || does_side_meet(&p, 3, of_b, 0);
    default: /* two of 0, 1 and 2 are the sum's complement to 3 */
        return are_folded(&p, 3 - of_a, 3 - of_b);
    }
}

bool integer_points_are_collinear(const mt_vec3 points[3])
{
    pair p;
    load(&p, points, 3);
    return open_axis(&p, 0, 1, 2) < 0;
}
