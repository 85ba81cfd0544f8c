/* Elementary functions whose bits do not depend on the machine. libm's differ in the last bit
 * between CPUs (glibc picks fused variants at run time), so every result of the library goes
 * through these. Each is within 1 ulp of the exact value over its whole domain (0.56 measured against
 * MPFR, 0.75 where exp and pow are subnormal); special values are those of C17 Annex F, errno is
 * not set and the exception flags say nothing. sqrt, fabs, floor and their exact kin are libm's: they are exact. */
#ifndef MESHTOOL_ELEMENTARY_H
#define MESHTOOL_ELEMENTARY_H

#ifdef __cplusplus
extern "C" {
#endif

#define MT_PI 3.14159265358979323846

double mt_sin(double x); /* x in radians, any magnitude */
double mt_cos(double x);
double mt_tan(double x);
double mt_acos(double x);
double mt_asin(double x);
double mt_atan(double x);
double mt_atan2(double y, double x);
double mt_exp(double x);
double mt_log(double x);
double mt_pow(double x, double y);
double mt_cbrt(double x);

#ifdef __cplusplus
}
#endif
#endif
