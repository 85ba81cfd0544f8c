/* The principal axes of what is spread in space. */
#ifndef MT_SPATIAL_PRINCIPAL_AXES_H
#define MT_SPATIAL_PRINCIPAL_AXES_H

#include <meshtool/types.h>

/* The eigenvectors of a symmetric matrix (which is used up), one a row, of length 1 and at right angles within some
 * units of 2^-53, that of the largest eigenvalue first. Whatever is not finite, and equal eigenvalues, give some such
 * axes all the same.
 *
 * Jacobi's rotations, "Ueber ein leichtes Verfahren, die in der Theorie der Saecularstoerungen vorkommenden Gleichungen
 * numerisch aufzuloesen", Crelle 30 (1846), in cyclic order, with Rutishauser's formulas (Handbook for Automatic
 * Computation, II/1, 1971): four operations and square roots, so the same bits everywhere. */
void mt_principal_axes(double matrix[3][3], double axes[3][3]);

#endif
