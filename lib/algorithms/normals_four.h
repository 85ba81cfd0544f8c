/* Area vectors of four triangles, and the unit vectors of four sums, at once: lane i belongs to number i and does what
 * mt_plain_area_vector and mt_plain_unit do for one, operation by operation, so that the bits are theirs.
 *
 * Vectors pass by address, as meshtool/clones.h asks. */
#ifndef MT_ALGORITHMS_NORMALS_FOUR_H
#define MT_ALGORITHMS_NORMALS_FOUR_H

#include <meshtool/area_vector.h>

#include <string.h>

typedef double double4 __attribute__((vector_size(32)));
typedef int64_t long4 __attribute__((vector_size(32)));
typedef float float4 __attribute__((vector_size(16)));

typedef struct points4 {
    double4 x, y, z;
} points4;

/* What is squared lies within these bounds where mt_is_plain holds and a little is to spare. */
#define MT_PLAIN_SQUARE_MINIMUM 0x1p-798
#define MT_PLAIN_SQUARE_MAXIMUM 0x1p798

/* Sums of absolute components in place of the largest ones, of which they are at most three times as large: what
 * exceeds this share of them exceeds MT_AREA_CANCELLATION of those. */
#define MT_SUMS_CANCELLATION (4 * MT_AREA_CANCELLATION)

MT_INLINE bool mt_all_lanes(const long4 *mask)
{
    return (((*mask)[0] & (*mask)[1]) & ((*mask)[2] & (*mask)[3])) != 0;
}

/* Of vertices[0], [3], [6] and [9]. */
MT_INLINE void mt_gather_points(const void *positions, bool is_double, const mt_index *vertices, points4 *points)
{
    size_t a = 3 * (size_t)vertices[0], b = 3 * (size_t)vertices[3], c = 3 * (size_t)vertices[6],
           d = 3 * (size_t)vertices[9];
    if (is_double) {
        const double *p = positions;
        points->x = (double4){p[a], p[b], p[c], p[d]};
        points->y = (double4){p[a + 1], p[b + 1], p[c + 1], p[d + 1]};
        points->z = (double4){p[a + 2], p[b + 2], p[c + 2], p[d + 2]};
    } else {
        const float *p = positions;
        const float4 x = {p[a], p[b], p[c], p[d]};
        const float4 y = {p[a + 1], p[b + 1], p[c + 1], p[d + 1]};
        const float4 z = {p[a + 2], p[b + 2], p[c + 2], p[d + 2]};
        points->x = __builtin_convertvector(x, double4);
        points->y = __builtin_convertvector(y, double4);
        points->z = __builtin_convertvector(z, double4);
    }
}

MT_INLINE void mt_subtract_points(points4 *points, const points4 *origin)
{
    points->x -= origin->x, points->y -= origin->y, points->z -= origin->z;
}

MT_INLINE void mt_sum_sizes(const points4 *a, double4 *sums)
{
    *sums =
        ((double4)((long4)a->x & INT64_MAX) + (double4)((long4)a->y & INT64_MAX)) + (double4)((long4)a->z & INT64_MAX);
}

/* From a vector an axis to (x, y, z, 0) for each number. */
MT_INLINE void mt_transpose_points(const points4 *n, double4 *vectors)
{
    const double4 zero = {0};
    const double4 xy_even = __builtin_shufflevector(n->x, n->y, 0, 4, 2, 6);
    const double4 xy_odd = __builtin_shufflevector(n->x, n->y, 1, 5, 3, 7);
    const double4 z_even = __builtin_shufflevector(n->z, zero, 0, 4, 2, 6);
    const double4 z_odd = __builtin_shufflevector(n->z, zero, 1, 5, 3, 7);
    vectors[0] = __builtin_shufflevector(xy_even, z_even, 0, 1, 4, 5);
    vectors[1] = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 4, 5);
    vectors[2] = __builtin_shufflevector(xy_even, z_even, 2, 3, 6, 7);
    vectors[3] = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 6, 7);
}

/* Area vectors (x, y, z, 0) of the triangles at vertices[0], [3], [6] and [9]. False: not all of them are plain and
 * sure, or some so nearly not that each must be asked for. */
MT_INLINE bool mt_four_area_vectors(const void *positions, bool is_double, const mt_index *vertices, double4 *vectors)
{
    points4 origin = {0}, a = {0}, b = {0}, n;
    mt_gather_points(positions, is_double, vertices, &origin);
    mt_gather_points(positions, is_double, vertices + 1, &a);
    mt_gather_points(positions, is_double, vertices + 2, &b);
    mt_subtract_points(&a, &origin);
    mt_subtract_points(&b, &origin);
    n.x = a.y * b.z - a.z * b.y;
    n.y = a.z * b.x - a.x * b.z;
    n.z = a.x * b.y - a.y * b.x;
    double4 size, size_a, size_b;
    mt_sum_sizes(&n, &size);
    mt_sum_sizes(&a, &size_a);
    mt_sum_sizes(&b, &size_b);
    const long4 holds =
        (size > MT_SUMS_CANCELLATION * (size_a * size_b)) & (size > MT_PLAIN_MINIMUM) & (size < MT_PLAIN_MAXIMUM);
    mt_transpose_points(&n, vectors);
    return mt_all_lanes(&holds);
}

MT_INLINE void mt_sort_lanes(double4 *low, double4 *high)
{
    const long4 ordered = *low < *high;
    const double4 lower = (double4)(((long4)*low & ordered) | ((long4)*high & ~ordered));
    const double4 higher = (double4)(((long4)*high & ordered) | ((long4)*low & ~ordered));
    *low = lower;
    *high = higher;
}

/* mt_symmetric_dot of four vectors (x, y, z, 0) with themselves. */
MT_INLINE void mt_four_squares(const double4 *sums, double4 *squares)
{
    const double4 a = sums[0] * sums[0], b = sums[1] * sums[1], c = sums[2] * sums[2], d = sums[3] * sums[3];
    const double4 xz_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), xz_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6);
    const double4 y_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7), y_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    double4 low = __builtin_shufflevector(xz_ab, xz_cd, 0, 1, 4, 5);
    double4 middle = __builtin_shufflevector(y_ab, y_cd, 0, 1, 4, 5);
    double4 high = __builtin_shufflevector(xz_ab, xz_cd, 2, 3, 6, 7);
    mt_sort_lanes(&low, &middle);
    mt_sort_lanes(&middle, &high);
    *squares = (low + middle) + high;
}

/* Brings four sums (x, y, z, 0) to length 1, and stores them one after the other as mt_store_normal does. False, with
 * nothing stored: not all are plain. */
MT_INLINE bool mt_store_four_units(const double4 *sums, bool is_double, void *values)
{
    double4 squares;
    mt_four_squares(sums, &squares);
    const long4 plain = (squares > MT_PLAIN_SQUARE_MINIMUM) & (squares < MT_PLAIN_SQUARE_MAXIMUM);
    if (!mt_all_lanes(&plain)) {
        return false;
    }
    const double4 lengths = {sqrt(squares[0]), sqrt(squares[1]), sqrt(squares[2]), sqrt(squares[3])};
    const double4 scales = 1 / lengths, zero = {0};
    const double4 a = sums[0] * __builtin_shufflevector(scales, scales, 0, 0, 0, 0) + zero;
    const double4 b = sums[1] * __builtin_shufflevector(scales, scales, 1, 1, 1, 1) + zero;
    const double4 c = sums[2] * __builtin_shufflevector(scales, scales, 2, 2, 2, 2) + zero;
    const double4 d = sums[3] * __builtin_shufflevector(scales, scales, 3, 3, 3, 3) + zero;
    const double4 packed[3] = {__builtin_shufflevector(a, b, 0, 1, 2, 4), __builtin_shufflevector(b, c, 1, 2, 4, 5),
                               __builtin_shufflevector(c, d, 2, 4, 5, 6)};
    if (is_double) {
        memcpy(values, packed, sizeof packed);
    } else {
        const float4 narrow[3] = {__builtin_convertvector(packed[0], float4),
                                  __builtin_convertvector(packed[1], float4),
                                  __builtin_convertvector(packed[2], float4)};
        memcpy(values, narrow, sizeof narrow);
    }
    return true;
}

#endif
