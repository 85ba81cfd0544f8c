#include "lib/spatial/principal_axes.h"

#include <math.h>
#include <string.h>

/* Convergence is quadratic: five or six sweeps bring any matrix to its last bit. */
#define SWEEPS 12

/* Rotates rows and columns p and q so that their element vanishes; axes turn with them. */
static void rotate(double a[3][3], double axes[3][3], int p, int q)
{
    if (a[p][q] == 0) {
        return;
    }
    double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
    double tangent = (theta < 0 ? -1 : 1) / (fabs(theta) + sqrt(theta * theta + 1));
    double cosine = 1 / sqrt(tangent * tangent + 1), sine = tangent * cosine;
    int r = 3 - p - q;
    double shift = tangent * a[p][q], rp = a[r][p], rq = a[r][q];
    a[p][p] -= shift;
    a[q][q] += shift;
    a[p][q] = a[q][p] = 0;
    a[r][p] = a[p][r] = cosine * rp - sine * rq;
    a[r][q] = a[q][r] = sine * rp + cosine * rq;
    for (int i = 0; i < 3; i++) {
        double along_p = axes[p][i], along_q = axes[q][i];
        axes[p][i] = cosine * along_p - sine * along_q;
        axes[q][i] = sine * along_p + cosine * along_q;
    }
}

static void sort_axes(double a[3][3], double axes[3][3])
{
    double values[3] = {a[0][0], a[1][1], a[2][2]};
    for (int i = 1; i < 3; i++) {
        for (int j = i; j > 0 && values[j] > values[j - 1]; j--) {
            double value = values[j], axis[3];
            values[j] = values[j - 1];
            values[j - 1] = value;
            memcpy(axis, axes[j], sizeof axis);
            memcpy(axes[j], axes[j - 1], sizeof axis);
            memcpy(axes[j - 1], axis, sizeof axis);
        }
    }
}

static bool is_frame(double axes[3][3])
{
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        sum += fabs(axes[i / 3][i % 3]);
    }
    return sum < INFINITY;
}

void mt_principal_axes(double a[3][3], double axes[3][3])
{
    static const double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memcpy(axes, identity, sizeof identity);
    for (int sweep = 0; sweep < SWEEPS && (a[0][1] != 0 || a[0][2] != 0 || a[1][2] != 0); sweep++) {
        rotate(a, axes, 0, 1);
        rotate(a, axes, 0, 2);
        rotate(a, axes, 1, 2);
    }
    if (!is_frame(axes)) {
        memcpy(axes, identity, sizeof identity);
        return;
    }
    sort_axes(a, axes);
}
