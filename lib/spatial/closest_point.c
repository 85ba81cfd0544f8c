/* Nearest points through the tree: boxes and elements are culled by lower bounds of their squared distance in float,
 * eight at a time; what may be nearest, or as near, is measured in double (element_distance.c). Depth-first on a
 * bounded stack, or best-first from a bounded heap, in which case what finds no room is searched depth-first.
 *
 * Cost: about the logarithm of the count near the surface; for a point in the middle of a sphere every element. */
#include <meshtool/closest_point.h>

#include "lib/spatial/element_distance.h"
#include "lib/spatial/surface_walk.h"

/* Room of the heap: an array on the stack, for there is no context to allocate from. */
#define HEAP_SIZE 512

/* Relative loss of a squared float distance: subtraction, square and two sums round by half a unit each. */
#define BELOW 0.9999995f

/* Brings a distance rounded to float, and its comparison, to the safe side. */
#define ABOVE 1.000001f

/* Brings the squared distance of a box's farthest point to the safe side where doubles round more than floats do. */
#define FAR_MARGIN 0x1p-80f

/* What rounding takes from the float distance to an element, in units of the reach (1 + the point's largest
 * coordinate): corners and point round by half of 2^-24 each, the arithmetic by some more. */
#define DISTANCE_MARGIN 0x1p-21f
#define ROUNDING 0x1p-21f

typedef struct nearest_walk {
    const mt_surface_tree *tree;
    mt_vec3 scaled;               /* the point times the space's scale */
    float low[3], high[3], at[3]; /* the point in space, rounded down, up, to nearest */
    float margin;
    float limit; /* not below the squared distance of the nearest element, once one is sure to be within it */
    mt_index element;
    mt_element_distance best;
    double distance; /* of the best, in space */
} nearest_walk;

/* Nothing farther counts from now on; several squares have the same root. */
static void bound(nearest_walk *walk, double distance)
{
    float square = mt_round_up(distance * distance * (1 + 0x1p-50));
    walk->distance = distance;
    walk->limit = square < walk->limit ? square : walk->limit;
}

static void keep(nearest_walk *walk, mt_index number, const mt_element_distance *found)
{
    double distance = sqrt(found->square), best = walk->distance;
    if (distance < best || (distance == best && number < walk->element)) {
        walk->best = *found;
        walk->element = number;
        bound(walk, distance);
    }
}

/* Squared distances of a node's boxes, none too large; passes: -1 for those not beyond the limit, else 0. */
MT_INLINE void approach_children(const nearest_walk *walk, const mt_surface_node *node, float near[MT_WIDTH],
                                 int32_t passes[MT_WIDTH])
{
    const float limit = walk->limit;
    const float lx = walk->low[0], ly = walk->low[1], lz = walk->low[2];
    const float hx = walk->high[0], hy = walk->high[1], hz = walk->high[2];
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float x = node->planes[0][lane] - hx, x2 = lx - node->planes[1][lane];
        float y = node->planes[2][lane] - hy, y2 = ly - node->planes[3][lane];
        float z = node->planes[4][lane] - hz, z2 = lz - node->planes[5][lane];
        x = x > x2 ? x : x2;
        y = y > y2 ? y : y2;
        z = z > z2 ? z : z2;
        x = x > 0 ? x : 0;
        y = y > 0 ? y : 0;
        z = z > 0 ? z : 0;
        near[lane] = (x * x + y * y + z * z) * BELOW;
        passes[lane] = near[lane] <= limit ? -1 : 0;
    }
}

/* Pushes the children that pass, the nearest on top; returns the new depth. Each goes to the place that the number of
 * farther ones tells, so that there is nothing to predict; those that do not pass all go above the top. */
MT_INLINE size_t push_in_order(const mt_surface_node *node, const float near[MT_WIDTH], const int32_t passes[MT_WIDTH],
                               mt_pending *stack, size_t depth)
{
    int32_t keys[MT_WIDTH], places[MT_WIDTH] = {0};
    memcpy(keys, near, sizeof keys);
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        keys[lane] = ((keys[lane] & ~(MT_WIDTH - 1)) | lane) | ~passes[lane]; /* ordered as the floats; no two alike */
    }
    for (int other = 0; other < MT_WIDTH; other++) {
        for (int lane = 0; lane < MT_WIDTH; lane++) {
            places[lane] += keys[other] > keys[lane];
        }
    }
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        stack[depth + (size_t)places[lane]] = mt_pending_make(near[lane], node->children[lane]);
    }
    return depth + (size_t)__builtin_popcount(mt_bits_of(passes));
}

/* While no element is known, the farthest points of a node's boxes bound the distance: each box holds an element. That
 * spares ordering children that cannot count. */
MT_INLINE void bound_by_boxes(nearest_walk *walk, const mt_surface_node *node)
{
    float far[MT_WIDTH];
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float x = walk->high[0] - node->planes[0][lane], x2 = node->planes[1][lane] - walk->low[0];
        float y = walk->high[1] - node->planes[2][lane], y2 = node->planes[3][lane] - walk->low[1];
        float z = walk->high[2] - node->planes[4][lane], z2 = node->planes[5][lane] - walk->low[2];
        x = x > x2 ? x : x2;
        y = y > y2 ? y : y2;
        z = z > z2 ? z : z2;
        float square = (x * x + y * y + z * z) * ABOVE + FAR_MARGIN;
        far[lane] = node->children[lane] == MT_SURFACE_UNUSED ? INFINITY : square;
    }
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        walk->limit = far[lane] < walk->limit ? far[lane] : walk->limit;
    }
}

/* Squared distance from the origin to the side from a to b, where e = b - a. */
MT_INLINE float side_square(float ax, float ay, float az, float ex, float ey, float ez)
{
    float length = ex * ex + ey * ey + ez * ez;
    float along = -(ax * ex + ay * ey + az * ez) / (length > 0x1p-120f ? length : 0x1p-120f);
    along = along > 0 ? along : 0;
    along = along < 1 ? along : 1;
    float x = ax + along * ex, y = ay + along * ey, z = az + along * ez;
    return x * x + y * y + z * z;
}

/* Lower bounds of the elements' distances, and bits of those not beyond the best: their float distance less what it may
 * be off. Corners rounded to float, and relative to the point once more, are those of a triangle moved by less than the
 * margin, and so is its distance; what is left is the rounding of sides and normal, relative to them, which does not
 * grow where the point is far and the triangle small. The distance is that of the foot unless that surely lies outside
 * (areas s, t, and the third), which is never above the sides'; slivers become candidates by their normal. */
MT_INLINE uint32_t filter_elements(const nearest_walk *walk, const float *rows, mt_index count, float near[MT_WIDTH])
{
    const float qx = walk->at[0], qy = walk->at[1], qz = walk->at[2];
    const float best = (float)walk->distance * ABOVE, margin = walk->margin;
    const float *r[9];
    int32_t passes[MT_WIDTH];
    for (int i = 0; i < 9; i++) {
        r[i] = rows + (size_t)i * count;
    }
    for (int lane = 0; lane < MT_WIDTH; lane++) {
        float ax = r[0][lane] - qx, ay = r[1][lane] - qy, az = r[2][lane] - qz;
        float bx = r[3][lane] - qx, by = r[4][lane] - qy, bz = r[5][lane] - qz;
        float cx = r[6][lane] - qx, cy = r[7][lane] - qy, cz = r[8][lane] - qz;
        float ux = bx - ax, uy = by - ay, uz = bz - az, vx = cx - ax, vy = cy - ay, vz = cz - az;
        float ab = side_square(ax, ay, az, ux, uy, uz), ac = side_square(ax, ay, az, vx, vy, vz);
        float bc = side_square(bx, by, bz, cx - bx, cy - by, cz - bz);
        float side = ab < ac ? ab : ac;
        side = bc < side ? bc : side;
        float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        float square_length = nx * nx + ny * ny + nz * nz, length = sqrtf(square_length);
        float sides = ux * ux + uy * uy + uz * uz + vx * vx + vy * vy + vz * vz;
        float root = sqrtf(ax * ax + ay * ay + az * az), wrong = ROUNDING * sides;
        float s = nx * (vy * az - vz * ay) + ny * (vz * ax - vx * az) + nz * (vx * ay - vy * ax);
        float t = nx * (ay * uz - az * uy) + ny * (az * ux - ax * uz) + nz * (ax * uy - ay * ux);
        float third = square_length - s - t;
        float low = s < t ? s : t;
        low = third < low ? third : low;
        float divisor = length > 0x1p-60f ? length : 0x1p-60f;
        float foot = (nx * ax + ny * ay + nz * az) / divisor, foot_square = foot * foot;
        bool is_outside = low < -4 * wrong * (root * sqrtf(sides) + sides);
        float square = is_outside ? side : foot_square;
        near[lane] = sqrtf(square) - (is_outside ? margin : margin + root * wrong / divisor);
        passes[lane] = near[lane] > best ? 0 : -1; /* NaN passes: infinities met */
    }
    return mt_bits_of(passes);
}

MT_INLINE int nearest_lane(const float near[MT_WIDTH], uint32_t bits)
{
    int nearest = __builtin_ctz(bits);
    for (bits &= bits - 1; bits; bits &= bits - 1) {
        int lane = __builtin_ctz(bits);
        nearest = near[lane] < near[nearest] ? lane : nearest;
    }
    return nearest;
}

MT_INLINE void visit_leaf(nearest_walk *walk, uint32_t child)
{
    if (child == MT_SURFACE_UNUSED) { /* infinitely far, which counts while nothing nearer is known */
        return;
    }
    mt_index count = mt_surface_leaf_count(child);
    const float *rows = mt_leaf_rows(walk->tree, child);
    float near[MT_WIDTH];
    uint32_t bits = filter_elements(walk, rows, count, near) & ((1u << count) - 1);
    while (bits) {
        int lane = nearest_lane(near, bits);
        bits &= ~(1u << lane);
        if (near[lane] > (float)walk->distance * ABOVE) {
            return;
        }
        mt_index number = mt_leaf_number(rows, count, (mt_index)lane);
        mt_element_distance found = mt_element_distance_inline(walk->tree, number, walk->scaled);
        keep(walk, number, &found);
    }
}

MT_CLONES static void walk_depth_first(nearest_walk *walk, mt_pending start)
{
    mt_pending stack[MT_SURFACE_STACK + 1];
    size_t depth = 1;
    stack[0] = start;
    while (depth) {
        mt_pending item = stack[--depth];
        if (mt_pending_near(item) > walk->limit) {
            continue;
        }
        uint32_t child = mt_pending_child(item);
        if (child & MT_SURFACE_LEAF) {
            visit_leaf(walk, child);
            continue;
        }
        float near[MT_WIDTH];
        int32_t passes[MT_WIDTH];
        const mt_surface_node *node = &walk->tree->nodes[child];
        if (walk->element == MT_NONE) {
            bound_by_boxes(walk, node);
        }
        approach_children(walk, node, near, passes);
        depth = push_in_order(node, near, passes, stack, depth);
    }
}

static void heap_push(mt_pending *heap, size_t at, mt_pending item)
{
    while (at && heap[(at - 1) / 2] > item) {
        heap[at] = heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    heap[at] = item;
}

/* Takes the nearest out of a heap of `size`, which then has one less. */
static mt_pending heap_pop(mt_pending *heap, size_t size)
{
    mt_pending nearest = heap[0], last = heap[size - 1];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        child += child + 1 < size - 1 && heap[child + 1] < heap[child];
        if (child >= size - 1 || heap[child] >= last) {
            break;
        }
        heap[at] = heap[child];
        at = child;
    }
    heap[at] = last;
    return nearest;
}

/* Opens a node into the heap; false when there was no room for all of its children, and none was put in. */
MT_CLONES static bool open_node(nearest_walk *walk, uint32_t child, mt_pending *heap, size_t *size)
{
    float near[MT_WIDTH];
    int32_t passes[MT_WIDTH];
    const mt_surface_node *node = &walk->tree->nodes[child];
    approach_children(walk, node, near, passes);
    if (*size + MT_WIDTH > HEAP_SIZE) {
        return false;
    }
    for (uint32_t bits = mt_bits_of(passes); bits; bits &= bits - 1) {
        heap_push(heap, (*size)++, mt_pending_first(node, near, bits));
    }
    return true;
}

static void walk_best_first(nearest_walk *walk)
{
    mt_pending heap[HEAP_SIZE];
    size_t size = 1;
    heap[0] = mt_pending_make(0, 0);
    while (size) {
        mt_pending item = heap_pop(heap, size--);
        if (mt_pending_near(item) > walk->limit) {
            return;
        }
        uint32_t child = mt_pending_child(item);
        if ((child & MT_SURFACE_LEAF) || !open_node(walk, child, heap, &size)) {
            walk_depth_first(walk, item);
        }
    }
}

static void start_walk(nearest_walk *walk, mt_vec3 point, const mt_closest_options *options)
{
    mt_vec3 q = mt_ray_space_point(&walk->tree->space, point);
    const double x[3] = {q.x, q.y, q.z};
    for (int axis = 0; axis < 3; axis++) {
        walk->at[axis] = (float)x[axis];
        walk->high[axis] = mt_round_up(x[axis]);
        walk->low[axis] = mt_round_down(x[axis]);
    }
    walk->scaled = mt_vec3_scale(point, walk->tree->space.scale);
    walk->margin = DISTANCE_MARGIN * (1 + (float)mt_vec3_max_abs(q));
    walk->element = MT_NONE;
    walk->limit = INFINITY;
    bound(walk, options->maximum > 0 ? options->maximum * walk->tree->space.scale : INFINITY);
    if (options->has_hint) {
        mt_element_distance found = mt_element_distance_to(walk->tree, options->hint, walk->scaled);
        keep(walk, options->hint, &found);
    }
}

static void report(const mt_surface_tree *tree, mt_index number, const mt_element_distance *found, mt_closest *out)
{
    mt_surface_element element = mt_surface_element_of(tree->mesh, tree->triangulation, &tree->numbering, number);
    *out = (mt_closest){.distance = sqrt(found->square) / tree->space.scale, .element = number};
    for (int i = 0; i < 3; i++) {
        out->weights[i] = found->weights[i];
        mt_vec3 vertex = mt_mesh_position(tree->mesh, element.vertices[i]);
        out->point = mt_vec3_add(out->point, mt_vec3_scale(vertex, found->weights[i]));
    }
}

bool mt_surface_tree_closest(const mt_surface_tree *tree, mt_vec3 point, const mt_closest_options *options,
                             mt_closest *out)
{
    const mt_closest_options defaults = {0};
    options = options ? options : &defaults;
    *out = (mt_closest){.distance = INFINITY, .element = MT_NONE};
    if (!tree->node_count || !mt_vec3_is_finite(mt_ray_space_point(&tree->space, point))) {
        return false;
    }
    nearest_walk walk = {.tree = tree};
    start_walk(&walk, point, options);
    if (options->order == MT_CLOSEST_BEST_FIRST) {
        walk_best_first(&walk);
    } else {
        walk_depth_first(&walk, mt_pending_make(0, 0));
    }
    if (walk.element == MT_NONE) {
        return false;
    }
    report(tree, walk.element, &walk.best, out);
    return true;
}

void mt_surface_element_closest(const mt_surface_tree *tree, mt_index element, mt_vec3 point, mt_closest *out)
{
    mt_element_distance found = mt_element_distance_to(tree, element, mt_vec3_scale(point, tree->space.scale));
    report(tree, element, &found, out);
}

double mt_surface_element_distance(const mt_surface_tree *tree, mt_index element, mt_vec3 point)
{
    mt_element_distance found = mt_element_distance_to(tree, element, mt_vec3_scale(point, tree->space.scale));
    return sqrt(found.square) / tree->space.scale;
}
