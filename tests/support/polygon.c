#include "tests/support/polygon.h"

#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

void test_polygon_add(test_polygon *polygon, int64_t x, int64_t y)
{
    if (polygon->count == polygon->capacity) {
        polygon->capacity = polygon->capacity ? 2 * polygon->capacity : 64;
        polygon->points = realloc(polygon->points, polygon->capacity * sizeof *polygon->points);
        assert_non_null(polygon->points);
    }
    polygon->points[polygon->count][0] = x;
    polygon->points[polygon->count][1] = y;
    polygon->count++;
}

void test_polygon_reverse(test_polygon *polygon)
{
    for (size_t i = 0, j = polygon->count; i + 1 < j; i++) {
        j--;
        for (int axis = 0; axis < 2; axis++) {
            int64_t swap = polygon->points[i][axis];
            polygon->points[i][axis] = polygon->points[j][axis];
            polygon->points[j][axis] = swap;
        }
    }
}

void test_polygon_release(test_polygon *polygon)
{
    free(polygon->points);
    *polygon = (test_polygon){0};
}

static int64_t turn(const int64_t *a, const int64_t *b, const int64_t *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

int64_t test_polygon_area(const test_polygon *polygon)
{
    int64_t area = 0;
    for (size_t i = 1; i + 1 < polygon->count; i++) {
        area += turn(polygon->points[0], polygon->points[i], polygon->points[i + 1]);
    }
    return area;
}

/* ---- triangulations ---- */

typedef struct side {
    mt_index from, to;
} side;

static int compare_sides(const void *a, const void *b)
{
    const side *p = a, *q = b;
    if (p->from != q->from) {
        return p->from < q->from ? -1 : 1;
    }
    return (p->to > q->to) - (p->to < q->to);
}

void test_polygon_check_sides(size_t count, const mt_index *triangles)
{
    size_t side_count = 3 * (count - 2);
    side *sides = malloc(side_count * sizeof *sides);
    assert_non_null(sides);
    for (size_t i = 0; i < side_count; i++) {
        assert_true(triangles[i] < count);
        size_t next = i % 3 == 2 ? i - 2 : i + 1;
        sides[i] = (side){triangles[i], triangles[next]};
    }
    qsort(sides, side_count, sizeof *sides, compare_sides);
    size_t outer = 0;
    for (size_t i = 0; i < side_count; i++) {
        assert_true(i == 0 || compare_sides(&sides[i - 1], &sides[i]) < 0);
        side reverse = {sides[i].to, sides[i].from};
        bool is_outer = sides[i].to == (sides[i].from + 1) % count;
        bool is_paired = bsearch(&reverse, sides, side_count, sizeof *sides, compare_sides) != NULL;
        assert_true(is_outer != is_paired);
        outer += is_outer;
    }
    assert_int_equal(outer, count);
    free(sides);
}

size_t test_polygon_check(const test_polygon *polygon, const mt_index *triangles)
{
    test_polygon_check_sides(polygon->count, triangles);
    int64_t whole = test_polygon_area(polygon), sum = 0;
    size_t flat = 0;
    for (size_t i = 0; i < polygon->count - 2; i++) {
        const mt_index *t = triangles + 3 * i;
        int64_t area = turn(polygon->points[t[0]], polygon->points[t[1]], polygon->points[t[2]]);
        assert_true(whole >= 0 ? area >= 0 : area <= 0);
        flat += area == 0;
        sum += area;
    }
    assert_true(sum == whole);
    return flat;
}

mt_mesh *test_polygon_mesh(mt_context *context, const test_polygon *polygon, const int64_t slope[2], int axis,
                           double scale)
{
    mt_mesh_layout layout = {.vertex_count = polygon->count,
                             .face_count = 1,
                             .face_size = (mt_index)polygon->count,
                             .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index i = 0; i < polygon->count; i++) {
        int64_t x = polygon->points[i][0], y = polygon->points[i][1];
        double p[3] = {(double)x, (double)y, (double)(x * slope[0] + y * slope[1])};
        mt_mesh_set_position(mesh, i,
                             mt_vec3_scale(mt_vec3_make(p[axis % 3], p[(axis + 1) % 3], p[(axis + 2) % 3]), scale));
        mesh->corner_vertices[i] = i;
    }
    return mesh;
}

/* ---- makers ---- */

test_polygon test_polygon_convex(size_t count, int64_t radius)
{
    test_polygon polygon = {0};
    for (size_t i = 0; i < count; i++) {
        int64_t x = (int64_t)i - (int64_t)(count / 2);
        test_polygon_add(&polygon, x * radius, x * x);
    }
    return polygon;
}

static bool is_lower_half(const int64_t *p)
{
    return p[1] < 0 || (p[1] == 0 && p[0] < 0);
}

static int compare_angles(const void *a, const void *b)
{
    const int64_t *p = a, *q = b, origin[2] = {0, 0};
    if (is_lower_half(p) != is_lower_half(q)) {
        return is_lower_half(p) ? 1 : -1;
    }
    int64_t t = turn(origin, p, q);
    return t > 0 ? -1 : t < 0;
}

test_polygon test_polygon_star(test_random *random, size_t count, int64_t radius)
{
    test_polygon all = {0}, polygon = {0};
    test_polygon_add(&all, radius, 1); /* three directions around the origin, so that it lies inside */
    test_polygon_add(&all, -radius, radius + 1);
    test_polygon_add(&all, -radius, -radius - 1);
    while (all.count < count) {
        int64_t reach = 1 + (int64_t)test_random_below(random, (uint64_t)radius);
        int64_t x = (int64_t)test_random_below(random, 2 * (uint64_t)reach + 1) - reach;
        int64_t y = (int64_t)test_random_below(random, 2 * (uint64_t)reach + 1) - reach;
        if (x || y) {
            test_polygon_add(&all, x, y);
        }
    }
    qsort(all.points, all.count, sizeof *all.points, compare_angles);
    for (size_t i = 0; i < all.count; i++) {
        if (i == 0 || compare_angles(all.points[i - 1], all.points[i]) != 0) {
            test_polygon_add(&polygon, all.points[i][0], all.points[i][1]);
        }
    }
    test_polygon_release(&all);
    return polygon;
}

test_polygon test_polygon_comb(test_random *random, size_t teeth)
{
    test_polygon polygon = {0};
    test_polygon_add(&polygon, 0, -10);
    test_polygon_add(&polygon, (int64_t)teeth * 4, -10);
    for (size_t i = teeth; i-- > 0;) {
        int64_t x = (int64_t)i * 4;
        test_polygon_add(&polygon, x + 3, 1000 + (int64_t)test_random_below(random, 1000));
        test_polygon_add(&polygon, x + 1, (int64_t)test_random_below(random, 900));
    }
    return polygon;
}

test_polygon test_polygon_spiral(size_t turns, size_t per_turn)
{
    test_polygon polygon = {0};
    size_t count = turns * per_turn;
    double step = 2 * 3.14159265358979 / (double)per_turn;
    for (size_t i = 0; i <= count; i++) {
        double radius = 1e6 + 4e5 * (double)i / (double)per_turn;
        test_polygon_add(&polygon, (int64_t)(radius * cos(step * (double)i)),
                         (int64_t)(radius * sin(step * (double)i)));
    }
    for (size_t i = count + 1; i-- > 0;) {
        double radius = 0.9e6 + 4e5 * (double)i / (double)per_turn;
        test_polygon_add(&polygon, (int64_t)(radius * cos(step * (double)i)),
                         (int64_t)(radius * sin(step * (double)i)));
    }
    return polygon;
}

test_polygon test_polygon_monotone(test_random *random, size_t count)
{
    test_polygon polygon = {0};
    size_t lower = (count + 1) / 2, upper = count - lower;
    for (size_t i = 0; i < lower; i++) {
        test_polygon_add(&polygon, (int64_t)i, -(int64_t)test_random_below(random, 1000));
    }
    for (size_t i = upper; i-- > 0;) {
        test_polygon_add(&polygon, (int64_t)i, 1 + (int64_t)test_random_below(random, 1000));
    }
    return polygon;
}

/* Cells of a maze: bit d of doors is set when the wall towards direction d (east, north, west, south) is open. */
static const int directions[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

static void carve_maze(test_random *random, size_t width, size_t height, unsigned char *doors)
{
    size_t *path = malloc(width * height * sizeof *path);
    assert_non_null(path);
    unsigned char *seen = calloc(width * height, 1);
    assert_non_null(seen);
    size_t length = 1;
    path[0] = 0;
    seen[0] = 1;
    while (length > 0) {
        size_t cell = path[length - 1], first = test_random_below(random, 4);
        bool moved = false;
        for (size_t turned = 0; turned < 4 && !moved; turned++) {
            size_t d = (first + turned) % 4;
            int64_t x = (int64_t)(cell % width) + directions[d][0], y = (int64_t)(cell / width) + directions[d][1];
            if (x < 0 || y < 0 || x >= (int64_t)width || y >= (int64_t)height) {
                continue;
            }
            size_t other = (size_t)y * width + (size_t)x;
            if (!seen[other]) {
                seen[other] = 1;
                doors[cell] = (unsigned char)(doors[cell] | 1u << d);
                doors[other] = (unsigned char)(doors[other] | 1u << (d + 2) % 4);
                path[length++] = other;
                moved = true;
            }
        }
        length -= !moved;
    }
    free(seen);
    free(path);
}

/* The outline with the right hand on the wall: at each step from a corner of a cell (numbered by the direction
 * before it, counter-clockwise) either along the cell's wall or through the door. */
test_polygon test_polygon_maze(test_random *random, size_t width, size_t height, int wall)
{
    static const int corners[4][2] = {{1, 0}, {1, 1}, {0, 1}, {0, 0}}; /* where the wall of direction d begins */
    unsigned char *doors = calloc(width * height, 1);
    assert_non_null(doors);
    carve_maze(random, width, height, doors);
    test_polygon polygon = {0};
    size_t cell = 0, d = 3;
    do {
        int64_t x = (int64_t)(cell % width), y = (int64_t)(cell / width);
        test_polygon_add(&polygon, x * (2 + wall) + 2 * corners[d][0], y * (2 + wall) + 2 * corners[d][1]);
        if (doors[cell] & 1u << d) {
            cell = (size_t)((int64_t)cell + directions[d][0] + directions[d][1] * (int64_t)width);
            d = (d + 3) % 4;
        } else {
            d = (d + 1) % 4;
        }
    } while (cell != 0 || d != 3);
    free(doors);
    return polygon;
}

static int sign(int64_t x)
{
    return (x > 0) - (x < 0);
}

static bool touches(const int64_t *a, const int64_t *b, const int64_t *p)
{
    return turn(a, b, p) == 0 && (p[0] - a[0]) * (p[0] - b[0]) <= 0 && (p[1] - a[1]) * (p[1] - b[1]) <= 0;
}

static bool segments_meet(const int64_t *a, const int64_t *b, const int64_t *c, const int64_t *d)
{
    bool crosses = sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 && sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
    return crosses || touches(a, b, c) || touches(a, b, d) || touches(c, d, a) || touches(c, d, b);
}

static void reverse_between(test_polygon *polygon, size_t begin, size_t end)
{
    test_polygon part = {.count = end - begin, .points = polygon->points + begin};
    test_polygon_reverse(&part);
}

static bool has_point(const test_polygon *polygon, int64_t x, int64_t y)
{
    for (size_t i = 0; i < polygon->count; i++) {
        if (polygon->points[i][0] == x && polygon->points[i][1] == y) {
            return true;
        }
    }
    return false;
}

/* Reversing the part between two sides that meet shortens the tour, so that this ends. */
static bool uncross_once(test_polygon *polygon)
{
    size_t count = polygon->count;
    for (size_t i = 0; i + 2 < count; i++) {
        for (size_t j = i + 2; j < count; j++) {
            size_t after = (j + 1) % count;
            if (after != i &&
                segments_meet(polygon->points[i], polygon->points[i + 1], polygon->points[j], polygon->points[after])) {
                reverse_between(polygon, i + 1, j + 1);
                return true;
            }
        }
    }
    return false;
}

test_polygon test_polygon_tour(test_random *random, size_t count, int64_t size)
{
    test_polygon polygon = {0};
    do {
        polygon.count = 0;
        while (polygon.count < count) {
            int64_t x = (int64_t)test_random_below(random, (uint64_t)size);
            int64_t y = (int64_t)test_random_below(random, (uint64_t)size);
            if (!has_point(&polygon, x, y)) {
                test_polygon_add(&polygon, x, y);
            }
        }
        for (size_t i = 0; i < count * count && uncross_once(&polygon); i++) {
        }
    } while (uncross_once(&polygon)); /* a tour through points on one line may go on for ever */
    if (test_polygon_area(&polygon) < 0) {
        test_polygon_reverse(&polygon);
    }
    return polygon;
}

test_polygon test_polygon_sieve(size_t rows, size_t columns)
{
    test_polygon polygon = {0};
    int64_t width = (int64_t)columns * 10 + 10, height = (int64_t)rows * 10 + 10;
    test_polygon_add(&polygon, 0, 0);
    test_polygon_add(&polygon, width, 0);
    test_polygon_add(&polygon, width, height);
    test_polygon_add(&polygon, 0, height);
    for (size_t row = rows; row-- > 0;) {
        int64_t y = (int64_t)row * 10 + 10;
        test_polygon_add(&polygon, 0, y);
        for (size_t column = 0; column < columns; column++) {
            int64_t x = (int64_t)column * 10 + 10;
            test_polygon_add(&polygon, x - 4, y);
            test_polygon_add(&polygon, x, y + 4);
            test_polygon_add(&polygon, x + 4, y);
        }
        for (size_t column = columns; column-- > 0;) {
            int64_t x = (int64_t)column * 10 + 10;
            if (column + 1 < columns) {
                test_polygon_add(&polygon, x + 4, y);
            }
            test_polygon_add(&polygon, x, y - 4);
            test_polygon_add(&polygon, x - 4, y);
        }
        test_polygon_add(&polygon, 0, y);
    }
    return polygon;
}

static unsigned char *choose(test_random *random, size_t from, size_t count)
{
    unsigned char *times = calloc(from, 1);
    assert_non_null(times);
    for (size_t i = 0; i < count; i++) {
        times[test_random_below(random, from)]++;
    }
    return times;
}

test_polygon test_polygon_with_repeats(test_random *random, const test_polygon *polygon, size_t count)
{
    test_polygon result = {0};
    unsigned char *times = choose(random, polygon->count, count);
    for (size_t i = 0; i < polygon->count; i++) {
        for (size_t copy = 0; copy <= times[i]; copy++) {
            test_polygon_add(&result, polygon->points[i][0], polygon->points[i][1]);
        }
    }
    free(times);
    return result;
}

test_polygon test_polygon_with_middles(test_random *random, const test_polygon *polygon, size_t count)
{
    test_polygon result = {0};
    unsigned char *times = choose(random, polygon->count, count);
    for (size_t i = 0; i < polygon->count; i++) {
        const int64_t *p = polygon->points[i], *q = polygon->points[(i + 1) % polygon->count];
        test_polygon_add(&result, 2 * p[0], 2 * p[1]);
        if (times[i]) {
            test_polygon_add(&result, p[0] + q[0], p[1] + q[1]);
        }
    }
    free(times);
    return result;
}
