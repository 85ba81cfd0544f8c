/* Exact geometric predicates: the sign is that of the exact value for all finite doubles, subnormal
 * and huge ones included. After Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast
 * Robust Geometric Predicates", Discrete & Computational Geometry 18 (1997): a floating-point filter
 * decides almost always; expansions, and where exponents would leave their range a scaled or wider
 * evaluation, decide the rest. Results are -1, 0 or 1. No allocation. */
#ifndef MESHTOOL_PREDICATES_H
#define MESHTOOL_PREDICATES_H

#include <meshtool/vector.h>

#ifdef __cplusplus
extern "C" {
#endif

/* 1 when a, b, c turn counter-clockwise, -1 clockwise, 0 when they lie on one line. */
int mt_orient2d(const double a[2], const double b[2], const double c[2]);

/* Sign of the determinant of (a-d, b-d, c-d): 1 when d lies below the plane through a, b, c, where
 * "above" is the side from which a, b, c appear counter-clockwise; -1 above, 0 on it. */
int mt_orient3d(mt_vec3 a, mt_vec3 b, mt_vec3 c, mt_vec3 d);

/* Whether three points in space lie exactly on one line (coincident ones do). */
bool mt_collinear(mt_vec3 a, mt_vec3 b, mt_vec3 c);

#ifdef __cplusplus
}
#endif
#endif
