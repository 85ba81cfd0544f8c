/* Exact geometric predicates: the sign is that of the exact value for all finite doubles, subnormal
 * and huge ones included. Results are -1, 0 or 1; 0 when a coordinate is not finite. No allocation.
 *
 * A floating-point filter, inline here, decides almost always: its bounds are those of Shewchuk,
 * "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
 * Computational Geometry 18 (1997), section 4, rounded up, with a term for what products lose when
 * they underflow; one that overflows makes the bound infinite, which decides nothing. The rest is
 * decided in two doubles a number, ten times as slow, and what is zero or extreme in integers. */
#ifndef MESHTOOL_PREDICATES_H
#define MESHTOOL_PREDICATES_H

#include <meshtool/vector.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The same answers as mt_orient2d and mt_orient3d, without the filter. */
int mt_orient2d_exact(const double a[2], const double b[2], const double c[2]);
int mt_orient3d_exact(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d);

/* 1 when a, b, c turn counter-clockwise, -1 clockwise, 0 when they lie on one line. */
static inline int mt_orient2d(const double a[2], const double b[2], const double c[2])
{
    double left = (a[0] - c[0]) * (b[1] - c[1]);
    double right = (a[1] - c[1]) * (b[0] - c[0]);
    double determinant = left - right;
    double bound = 0x1p-51 * (fabs(left) + fabs(right)) + 0x1p-1000;
    if (determinant > bound) {
        return 1;
    }
    if (determinant < -bound) {
        return -1;
    }
    return mt_orient2d_exact(a, b, c);
}

/* Sign of the determinant of (a-d, b-d, c-d): 1 when d lies below the plane through a, b, c, where
 * "above" is the side from which a, b, c appear counter-clockwise; -1 above, 0 on it. */
static inline int mt_orient3d(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d)
{
    mt_vec3 e = mt_vec3_subtract(a, d), f = mt_vec3_subtract(b, d), g = mt_vec3_subtract(c, d);
    double fg = f.x * g.y, gf = g.x * f.y;
    double ge = g.x * e.y, eg = e.x * g.y;
    double ef = e.x * f.y, fe = f.x * e.y;
    double ez = fabs(e.z), fz = fabs(f.z), gz = fabs(g.z);
    double determinant = e.z * (fg - gf) + f.z * (ge - eg) + g.z * (ef - fe);
    double permanent = ez * (fabs(fg) + fabs(gf)) + fz * (fabs(ge) + fabs(eg)) + gz * (fabs(ef) + fabs(fe));
    double bound = 0x1p-50 * permanent + 0x1p-1000 * (ez + fz + gz + 1);
    if (determinant > bound) {
        return 1;
    }
    if (determinant < -bound) {
        return -1;
    }
    return mt_orient3d_exact(a, b, c, d);
}

/* Whether three points in space lie exactly on one line (coincident ones do). The second: without the filter. */
bool mt_collinear(mt_vec3 a, mt_vec3 b, mt_vec3 c);
bool mt_collinear_exact(mt_vec3 a, mt_vec3 b, mt_vec3 c);

/* The sign of the volume that triangles, three corners each, enclose: of the sum of their tetrahedra with the origin,
 * which where they form a closed surface is the same about any point. Exact and without a filter: some microseconds a
 * triangle. */
int mt_volume_sign(const mt_vec3 *corners, uint64_t triangle_count);

#ifdef __cplusplus
}
#endif
#endif
