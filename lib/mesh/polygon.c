/* The area vector is summed about the face's first corner, in differences scaled by a power of two, so that faces far
 * from the origin, of 1e-150 and of 1e150 keep their digits. It only picks the axis and the side; where rounding could
 * have decided either, the exact turn at the polygon's extreme corner decides instead. */
#include "lib/mesh/polygon.h"

#include <meshtool/predicates.h>

/* Relative error of the summed area vector per corner, with room to spare. Smaller: the side of a needle is left to
 * rounding; larger: the exact turn is asked for more faces than need it. */
#define AREA_ERROR 0x1p-49

/* Past this a difference of two coordinates may overflow. */
#define LARGEST_DIFFERENCE 0x1p1021

typedef struct area_sum {
    double vector[3];
    double magnitude[3]; /* sums of the absolute terms */
} area_sum;

static mt_vec3 corner_position(const mt_mesh *mesh, mt_index corner)
{
    return mt_mesh_position(mesh, mesh->corner_vertices[corner]);
}

/* The largest absolute coordinate; NaN or infinite when one is. */
static double largest_coordinate(const mt_mesh *mesh, mt_index begin, mt_index end)
{
    double largest = 0;
    for (mt_index corner = begin; corner < end; corner++) {
        double m = mt_vec3_max_abs(corner_position(mesh, corner));
        if (!(m <= largest)) {
            largest = m;
        }
        if (!isfinite(largest)) {
            return largest;
        }
    }
    return largest;
}

static mt_vec3 difference(mt_vec3 a, mt_vec3 b, double shrink)
{
    return mt_vec3_make(a.x * shrink - b.x * shrink, a.y * shrink - b.y * shrink, a.z * shrink - b.z * shrink);
}

static double largest_difference(const mt_mesh *mesh, mt_index begin, mt_index end, double shrink)
{
    mt_vec3 origin = corner_position(mesh, begin);
    double largest = 0;
    for (mt_index corner = begin + 1; corner < end; corner++) {
        largest = fmax(largest, mt_vec3_max_abs(difference(corner_position(mesh, corner), origin, shrink)));
    }
    return largest;
}

static void add_cross(area_sum *sum, mt_vec3 a, mt_vec3 b)
{
    double left[3] = {a.y * b.z, a.z * b.x, a.x * b.y};
    double right[3] = {a.z * b.y, a.x * b.z, a.y * b.x};
    for (int axis = 0; axis < 3; axis++) {
        sum->vector[axis] += left[axis] - right[axis];
        sum->magnitude[axis] += fabs(left[axis]) + fabs(right[axis]);
    }
}

static area_sum sum_area(const mt_mesh *mesh, mt_index begin, mt_index end, double largest)
{
    area_sum sum = {0};
    double shrink = largest > LARGEST_DIFFERENCE ? 0.25 : 1;
    double scale = mt_power_of_two_scale(largest_difference(mesh, begin, end, shrink));
    mt_vec3 origin = corner_position(mesh, begin);
    mt_vec3 previous = mt_vec3_make(0, 0, 0);
    for (mt_index corner = begin + 1; corner < end; corner++) {
        mt_vec3 arm = mt_vec3_scale(difference(corner_position(mesh, corner), origin, shrink), scale);
        add_cross(&sum, previous, arm);
        previous = arm;
    }
    return sum;
}

/* The corners without their coordinate `axis`, mirrored when `mirrored`. */
static void drop_axis(const mt_mesh *mesh, mt_index begin, mt_index end, int axis, bool mirrored, mt_point2 *points)
{
    int first = (axis + 1) % 3, second = (axis + 2) % 3;
    if (mirrored) {
        int swap = first;
        first = second;
        second = swap;
    }
    for (mt_index corner = begin; corner < end; corner++) {
        mt_vec3 p = corner_position(mesh, corner);
        double coordinates[3] = {p.x, p.y, p.z};
        points[corner - begin][0] = coordinates[first];
        points[corner - begin][1] = coordinates[second];
    }
}

/* The turn at the leftmost, then lowest point: the side of a simple polygon, 0 when it is a line or a spike. */
static int extreme_turn(mt_point2 *points, mt_index count)
{
    mt_index extreme = 0;
    for (mt_index i = 1; i < count; i++) {
        double dx = points[i][0] - points[extreme][0];
        if (dx < 0 || (dx == 0 && points[i][1] < points[extreme][1])) {
            extreme = i;
        }
    }
    mt_index before = extreme, after = extreme;
    for (mt_index i = 1; i < count && mt_point2_equal(points[before], points[extreme]); i++) {
        before = before ? before - 1 : count - 1;
    }
    for (mt_index i = 1; i < count && mt_point2_equal(points[after], points[extreme]); i++) {
        after = after + 1 < count ? after + 1 : 0;
    }
    return mt_orient2d(points[before], points[extreme], points[after]);
}

static int largest_axis(const double vector[3])
{
    int axis = fabs(vector[0]) > fabs(vector[1]) ? 0 : 1;
    return fabs(vector[2]) >= fabs(vector[axis]) ? 2 : axis;
}

bool mt_polygon_project(const mt_mesh *mesh, mt_index face, mt_point2 *points)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    double largest = largest_coordinate(mesh, begin, end);
    if (!isfinite(largest)) {
        return false;
    }
    area_sum sum = sum_area(mesh, begin, end, largest);
    int axis = largest_axis(sum.vector);
    bool certain = fabs(sum.vector[axis]) > (end - begin) * AREA_ERROR * sum.magnitude[axis];
    drop_axis(mesh, begin, end, axis, certain && sum.vector[axis] < 0, points);
    for (int step = 0; step < 3 && !certain; step++) {
        int turn = extreme_turn(points, end - begin);
        if (turn != 0) {
            drop_axis(mesh, begin, end, (axis + step) % 3, turn < 0, points);
            return true;
        }
        drop_axis(mesh, begin, end, (axis + step + 1) % 3, false, points);
    }
    return true;
}
