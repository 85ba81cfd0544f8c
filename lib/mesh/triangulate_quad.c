/* Quads have two triangulations. The one whose smaller turn is better wins: both triangles turned as the quad, then a
 * flat one, then one turned over. Of two good ones the shorter diagonal wins. All signs are exact. */
#include "lib/mesh/triangulate_quad.h"

#include "lib/mesh/polygon.h"

#include <meshtool/predicates.h>

#include <string.h>

/* The second diagonal must be shorter by this share of its square. Smaller: on a regular grid, whose diagonals are
 * equal but for rounding, directions alternate at random, and strips and shading with them; larger: longer diagonals
 * are kept where shorter ones would bend less. */
#define DIAGONAL_MARGIN 0x1p-10

/* Between these the squares and products of the fast path neither overflow nor lose digits. */
#define SMALLEST_AREA 0x1p-900
#define LARGEST_AREA 0x1p900

/* Share of the product of the diagonals below which rounding could decide on which side the front is. */
#define NEEDLE_AREA 0x1p-45

static const mt_index diagonals[2][6] = {{0, 1, 2, 0, 2, 3}, {1, 2, 3, 1, 3, 0}};

static int worse_turn(mt_point2 *points, const mt_index corners[6])
{
    int first = mt_orient2d(points[corners[0]], points[corners[1]], points[corners[2]]);
    int second = mt_orient2d(points[corners[3]], points[corners[4]], points[corners[5]]);
    return first < second ? first : second;
}

static bool second_is_shorter(double first_square, double second_square)
{
    return second_square < first_square * (1 - DIAGONAL_MARGIN);
}

static int choose(mt_point2 points[4], double first_square, double second_square)
{
    int first = worse_turn(points, diagonals[0]), second = worse_turn(points, diagonals[1]);
    if (first != second) {
        return second > first;
    }
    return second_is_shorter(first_square, second_square);
}

static int choose_carefully(const mt_mesh *mesh, mt_index face, const mt_vec3 p[4])
{
    mt_point2 points[4];
    if (!mt_polygon_project(mesh, face, points)) {
        return 0;
    }
    double largest = 0;
    for (int i = 0; i < 4; i++) {
        largest = fmax(largest, mt_vec3_max_abs(p[i]));
    }
    double shrink = largest > 1 ? 0.25 : 1; /* a difference must not overflow */
    mt_vec3 arms[2];
    for (int i = 0; i < 2; i++) {
        arms[i] = mt_vec3_subtract(mt_vec3_scale(p[i + 2], shrink), mt_vec3_scale(p[i], shrink));
    }
    double scale = mt_power_of_two_scale(fmax(mt_vec3_max_abs(arms[0]), mt_vec3_max_abs(arms[1])));
    mt_vec3 first = mt_vec3_scale(arms[0], scale), second = mt_vec3_scale(arms[1], scale);
    return choose(points, mt_vec3_dot(first, first), mt_vec3_dot(second, second));
}

/* p seen along `axis`, from the side on which `sign` points. */
static void see_along(const mt_vec3 p[4], int axis, bool mirrored, mt_point2 points[4])
{
    for (int i = 0; i < 4; i++) {
        double coordinates[5] = {p[i].x, p[i].y, p[i].z, p[i].x, p[i].y};
        points[i][mirrored] = coordinates[axis + 1];
        points[i][!mirrored] = coordinates[axis + 2];
    }
}

void mt_triangulate_quad(const mt_mesh *mesh, mt_index face, mt_index triangles[6])
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    mt_vec3 p[4];
    for (mt_index i = 0; i < 4; i++) {
        p[i] = mt_mesh_position(mesh, mesh->corner_vertices[begin + i]);
    }
    mt_vec3 first = mt_vec3_subtract(p[2], p[0]), second = mt_vec3_subtract(p[3], p[1]);
    mt_vec3 area = mt_vec3_cross(first, second);
    double x = fabs(area.x), y = fabs(area.y), z = fabs(area.z);
    int axis = z >= x && z >= y ? 2 : x > y ? 0 : 1;
    double largest = axis == 2 ? z : axis == 0 ? x : y, sum = x + y + z;
    double first_square = mt_vec3_dot(first, first), second_square = mt_vec3_dot(second, second);
    bool safe = sum < LARGEST_AREA && largest > SMALLEST_AREA && first_square * second_square < LARGEST_AREA &&
                largest * largest > first_square * second_square * (NEEDLE_AREA * NEEDLE_AREA);
    int which;
    if (safe) {
        double signed_largest = axis == 2 ? area.z : axis == 0 ? area.x : area.y;
        mt_point2 points[4];
        see_along(p, axis, signed_largest < 0, points);
        which = choose(points, first_square, second_square);
    } else {
        which = choose_carefully(mesh, face, p);
    }
    memcpy(triangles, diagonals[which], sizeof diagonals[which]);
}
