/* Boxes along the principal axes of triangles: of the covariance of their surface, not of their corners, so that many
 * small triangles in one place turn nothing (Gottschalk, Lin and Manocha, "OBBTree: A Hierarchical Structure for Rapid
 * Interference Detection", SIGGRAPH 1996). Principal axes of what is as wide as it is long, such as a cube, are any:
 * where the box along x, y and z is the smaller one, it is taken. */
#include "lib/spatial/principal_axes.h"
#include "lib/spatial/ray_obb.h"
#include "lib/spatial/surface_tree.h"

/* Sums over a range, relative to a point of it. */
typedef struct spread {
    double weight, first[3], second[3][3];
} spread;

static double area_of(double corners[3][3])
{
    double ab[3], ac[3], normal[3];
    for (int axis = 0; axis < 3; axis++) {
        ab[axis] = corners[1][axis] - corners[0][axis];
        ac[axis] = corners[2][axis] - corners[0][axis];
    }
    MT_RAY_CROSS(ab, ac, normal);
    return sqrt(MT_RAY_DOT(normal, normal));
}

/* The integrals of x and x x' over a triangle are area/3 (a + b + c) and area/12 (a a' + b b' + c c' + s s'), where s
 * is a + b + c. */
static void add_triangle(spread *s, const mt_packed_triangle *triangle, const double origin[3], bool by_area)
{
    double corners[3][3], sum[3] = {0, 0, 0};
    for (int corner = 0; corner < 3; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            corners[corner][axis] = (double)triangle->rows[axis][corner] - origin[axis];
            sum[axis] += corners[corner][axis];
        }
    }
    double weight = by_area ? area_of(corners) : 1;
    s->weight += weight;
    for (int i = 0; i < 3; i++) {
        s->first[i] += weight * sum[i] / 3;
        for (int j = i; j < 3; j++) {
            double products = corners[0][i] * corners[0][j] + corners[1][i] * corners[1][j] +
                              corners[2][i] * corners[2][j] + sum[i] * sum[j];
            s->second[i][j] += weight * products / 12;
        }
    }
}

static spread spread_of(const mt_packed_triangles *triangles, mt_ray_obb_range range, bool by_area)
{
    spread s = {.weight = 0};
    double origin[3];
    for (int axis = 0; axis < 3; axis++) {
        origin[axis] = (double)triangles->items[range.begin].rows[axis][0];
    }
    for (mt_index at = range.begin; at < range.end; at++) {
        add_triangle(&s, &triangles->items[at], origin, by_area);
    }
    return s;
}

/* Triangles without area, such as wires, count alike. */
static void find_axes(const mt_packed_triangles *triangles, mt_ray_obb_range range, mt_oriented_box *frame)
{
    spread s = spread_of(triangles, range, true);
    if (!(s.weight > 0)) {
        s = spread_of(triangles, range, false);
    }
    double covariance[3][3], axes[3][3];
    for (int i = 0; i < 3; i++) {
        for (int j = i; j < 3; j++) {
            double own = s.second[i][j] / s.weight - s.first[i] / s.weight * (s.first[j] / s.weight);
            covariance[i][j] = covariance[j][i] = own;
        }
    }
    mt_principal_axes(covariance, axes);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            frame->columns[i][j] = (float)axes[j][i];
        }
    }
}

/* Rounded outwards. */
static void bound(const mt_packed_triangles *triangles, mt_ray_obb_range range, mt_oriented_box *frame)
{
    for (int axis = 0; axis < 3; axis++) {
        double low = INFINITY, high = -INFINITY;
        for (mt_index at = range.begin; at < range.end; at++) {
            for (int corner = 0; corner < 3; corner++) {
                double x = mt_oriented_box_along(frame, axis, &triangles->items[at], corner);
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
        }
        frame->lower[axis] = mt_round_down(low);
        frame->upper[axis] = mt_round_up(high);
    }
}

static float half_area(const mt_oriented_box *frame)
{
    float x = frame->upper[0] - frame->lower[0], y = frame->upper[1] - frame->lower[1],
          z = frame->upper[2] - frame->lower[2];
    return x * y + y * z + z * x;
}

mt_oriented_box mt_ray_obb_fit(const mt_packed_triangles *triangles, mt_ray_obb_range range)
{
    mt_oriented_box turned = {.lower = {0}}, straight = {.columns = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
    find_axes(triangles, range, &turned);
    bound(triangles, range, &turned);
    bound(triangles, range, &straight);
    return half_area(&turned) < half_area(&straight) ? turned : straight;
}
