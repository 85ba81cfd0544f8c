/* The way back, by cofactors. The matrix is scaled by a power of two first, so that nothing over- or underflows. */
#include <meshtool/transform.h>

/* A determinant below this part of the product of the rows' lengths has lost so many of its digits to cancellation that
 * points brought back would not be where they were: larger refuses thin shears that still work. */
#define SMALLEST_RATIO 0x1p-36

static double cofactor(double at[3][3], int row, int column)
{
    int r = (row + 1) % 3, s = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
    return at[r][c] * at[s][d] - at[r][d] * at[s][c];
}

static bool is_finite(const mt_transform *transform)
{
    bool finite = mt_vec3_is_finite(transform->translation);
    for (int i = 0; i < 9; i++) {
        finite = finite && isfinite(transform->linear[i / 3][i % 3]);
    }
    return finite;
}

/* Scaled so that its largest element is in [0.5, 1); returns the factor. */
static double scale_down(const mt_transform *transform, double out[3][3])
{
    double largest = 0;
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fabs(transform->linear[i / 3][i % 3]));
    }
    double scale = mt_power_of_two_scale(largest);
    for (int i = 0; i < 9; i++) {
        out[i / 3][i % 3] = transform->linear[i / 3][i % 3] * scale;
    }
    return scale;
}

bool mt_transform_inverse(const mt_transform *transform, mt_transform *out)
{
    double at[3][3], lengths = 1;
    double scale = scale_down(transform, at);
    for (int i = 0; i < 3; i++) {
        lengths *= sqrt(at[i][0] * at[i][0] + at[i][1] * at[i][1] + at[i][2] * at[i][2]);
    }
    double determinant = at[0][0] * cofactor(at, 0, 0) + at[0][1] * cofactor(at, 0, 1) + at[0][2] * cofactor(at, 0, 2);
    if (!is_finite(transform) || !(fabs(determinant) > SMALLEST_RATIO * lengths)) {
        return false;
    }
    for (int i = 0; i < 9; i++) {
        out->linear[i / 3][i % 3] = cofactor(at, i % 3, i / 3) / determinant * scale;
    }
    out->translation = mt_vec3_make(0, 0, 0);
    out->translation = mt_vec3_scale(mt_transform_point(out, transform->translation), -1.0);
    return is_finite(out);
}
