/* Transformations of points and normals. Normals are covectors: they go with the inverse transpose, which is the
 * matrix of cofactors up to a positive factor, so no division can fail. O(size) time, no memory. */
#include <meshtool/transform.h>

#include <meshtool/elementary.h>

#include <string.h>

#define BLOCK 8192

mt_transform mt_transform_identity(void)
{
    return mt_transform_scaling(1);
}

mt_transform mt_transform_scaling(double factor)
{
    mt_transform t = {{{factor, 0, 0}, {0, factor, 0}, {0, 0, factor}}, {0, 0, 0}};
    return t;
}

mt_transform mt_transform_translation(mt_vec3 offset)
{
    mt_transform t = mt_transform_identity();
    t.translation = offset;
    return t;
}

/* Sine and cosine of degrees; quarter turns are exact, and large angles lose nothing on the way to radians. */
static void sine_and_cosine(double degrees, double *sine, double *cosine)
{
    static const double quarter_sines[] = {0, 1, 0, -1};
    double turned = fmod(degrees, 360);
    double quarters = floor(turned / 90 + 0.5);
    double radians = (turned - 90 * quarters) * (MT_PI / 180);
    unsigned q = (unsigned)((int)quarters + 8) % 4;
    double s = mt_sin(radians), c = mt_cos(radians);
    double qs = quarter_sines[q], qc = quarter_sines[(q + 1) % 4];
    *sine = s * qc + c * qs;
    *cosine = c * qc - s * qs;
}

mt_transform mt_transform_rotation(mt_vec3 axis, double degrees)
{
    double s = 0, c = 1;
    sine_and_cosine(degrees, &s, &c);
    mt_vec3 u = mt_vec3_normalize(axis);
    double v = 1 - c;
    mt_transform t = {{{c + v * u.x * u.x, v * u.x * u.y - s * u.z, v * u.x * u.z + s * u.y},
                       {v * u.y * u.x + s * u.z, c + v * u.y * u.y, v * u.y * u.z - s * u.x},
                       {v * u.z * u.x - s * u.y, v * u.z * u.y + s * u.x, c + v * u.z * u.z}},
                      {0, 0, 0}};
    return t;
}

/* Terms with a factor of 0 are left out, so that an infinite coordinate spoils no other one. */
static double row_dot(const double row[3], mt_vec3 p, double offset)
{
    double sum = row[0] != 0 ? row[0] * p.x : 0;
    sum += row[1] != 0 ? row[1] * p.y : 0;
    sum += row[2] != 0 ? row[2] * p.z : 0;
    return sum + offset;
}

mt_transform mt_transform_then(const mt_transform *first, const mt_transform *second)
{
    mt_transform t;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            t.linear[i][j] = second->linear[i][0] * first->linear[0][j] + second->linear[i][1] * first->linear[1][j] +
                             second->linear[i][2] * first->linear[2][j];
        }
    }
    t.translation = mt_transform_point(second, first->translation);
    return t;
}

mt_vec3 mt_transform_point(const mt_transform *transform, mt_vec3 point)
{
    return mt_vec3_make(row_dot(transform->linear[0], point, transform->translation.x),
                        row_dot(transform->linear[1], point, transform->translation.y),
                        row_dot(transform->linear[2], point, transform->translation.z));
}

/* Three rows, each to be multiplied with a point. */
typedef struct matrix {
    double at[3][3];
} matrix;

/* The matrix scaled by a power of two, which rounds nothing, so that its largest element is in [0.5, 1). False when
 * all are 0. */
static bool normalize(matrix *m)
{
    double largest = 0;
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fabs(m->at[i / 3][i % 3]));
    }
    double scale = mt_power_of_two_scale(largest);
    for (int i = 0; i < 9; i++) {
        m->at[i / 3][i % 3] *= scale;
    }
    return largest > 0;
}

static double cofactor(const matrix *m, int row, int column)
{
    int r = (row + 1) % 3, s = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
    return m->at[r][c] * m->at[s][d] - m->at[r][d] * m->at[s][c];
}

/* The matrix for normals. False when the determinant is not positive. */
static bool normal_matrix(const mt_transform *transform, matrix *out)
{
    matrix m;
    memcpy(m.at, transform->linear, sizeof m.at);
    if (!normalize(&m)) {
        return false;
    }
    for (int i = 0; i < 9; i++) {
        out->at[i / 3][i % 3] = cofactor(&m, i / 3, i % 3);
    }
    double determinant = m.at[0][0] * out->at[0][0] + m.at[0][1] * out->at[0][1] + m.at[0][2] * out->at[0][2];
    return determinant > 0 && normalize(out);
}

/* Whether the matrix only permutes, turns signs and scales all alike: then normals need no new length. */
static bool permutes(const matrix *m)
{
    double size = 0;
    for (int i = 0; i < 3; i++) {
        int found = 0;
        for (int j = 0; j < 3; j++) {
            if (m->at[i][j] != 0) {
                found++;
                size = i == 0 ? fabs(m->at[i][j]) : size;
                found += fabs(m->at[i][j]) != size;
            }
        }
        if (found != 1) {
            return false;
        }
    }
    return true;
}

typedef struct position_work {
    mt_mesh *mesh;
    const mt_transform *transform;
} position_work;

static void transform_positions(void *user, uint64_t begin, uint64_t end)
{
    const position_work *work = user;
    for (mt_index v = (mt_index)begin; v < end; v++) {
        mt_mesh_set_position(work->mesh, v, mt_transform_point(work->transform, mt_mesh_position(work->mesh, v)));
    }
}

typedef struct normal_work {
    mt_attribute *attribute;
    matrix matrix;
    bool keeps_length; /* the matrix alone does */
} normal_work;

static mt_vec3 transform_normal(const normal_work *work, mt_vec3 normal)
{
    mt_vec3 turned = {row_dot(work->matrix.at[0], normal, 0), row_dot(work->matrix.at[1], normal, 0),
                      row_dot(work->matrix.at[2], normal, 0)};
    if (work->keeps_length) {
        return turned;
    }
    return mt_vec3_scale(mt_vec3_normalize(turned), mt_vec3_length(normal));
}

static void transform_normals(void *user, uint64_t begin, uint64_t end)
{
    const normal_work *work = user;
    mt_attribute *attribute = work->attribute;
    for (mt_index i = (mt_index)begin; i < end; i++) {
        mt_vec3 normal = {mt_attribute_get(attribute, i, 0), mt_attribute_get(attribute, i, 1),
                          mt_attribute_get(attribute, i, 2)};
        mt_vec3 turned = transform_normal(work, normal);
        mt_attribute_set(attribute, i, 0, turned.x);
        mt_attribute_set(attribute, i, 1, turned.y);
        mt_attribute_set(attribute, i, 2, turned.z);
    }
}

static void transform_all_normals(mt_context *context, mt_mesh *mesh, const matrix *m)
{
    normal_work work = {.matrix = *m, .keeps_length = permutes(m)};
    double unit = work.keeps_length ? fabs(m->at[0][0]) + fabs(m->at[0][1]) + fabs(m->at[0][2]) : 1;
    for (int i = 0; i < 9; i++) {
        work.matrix.at[i / 3][i % 3] /= unit;
    }
    const matrix *n = &work.matrix;
    if (work.keeps_length && n->at[0][0] == 1 && n->at[1][1] == 1 && n->at[2][2] == 1) {
        return;
    }
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        work.attribute = &mesh->attributes[i];
        if (work.attribute->semantic == MT_SEMANTIC_NORMAL && work.attribute->component_count == 3) {
            mt_parallel_for(context, work.attribute->value_count, BLOCK, transform_normals, &work);
        }
    }
}

static bool is_finite(const mt_transform *transform)
{
    bool finite = mt_vec3_is_finite(transform->translation);
    for (int i = 0; i < 9; i++) {
        finite = finite && isfinite(transform->linear[i / 3][i % 3]);
    }
    return finite;
}

mt_status mt_mesh_transform(mt_context *context, mt_mesh *mesh, const mt_transform *transform)
{
    matrix normals;
    if (!is_finite(transform)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the transformation has a number that is not finite");
    }
    if (!normal_matrix(transform, &normals)) {
        return mt_fail(context, MT_ERROR_ARGUMENT,
                       "the transformation flattens the mesh or mirrors it, which would turn its faces inwards");
    }
    mt_index before = mt_mesh_bounds(mesh).non_finite_count;
    position_work work = {mesh, transform};
    mt_parallel_for(context, mesh->vertex_count, BLOCK, transform_positions, &work);
    mt_index after = mt_mesh_bounds(mesh).non_finite_count;
    if (after > before) {
        mt_warn(context, "%u vertices left the range of the stored precision and became infinite", after - before);
    }
    transform_all_normals(context, mesh, &normals);
    return MT_OK;
}
