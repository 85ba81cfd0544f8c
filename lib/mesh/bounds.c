#include <meshtool/mesh.h>

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

static double larger(double a, double b)
{
    return a > b ? a : b;
}

mt_bounds mt_mesh_bounds(const mt_mesh *mesh)
{
    mt_bounds bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0, 0};
    mt_vec3 low = bounds.minimum, high = bounds.maximum;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_vec3 p = mt_mesh_position(mesh, vertex);
        if (!mt_vec3_is_finite(p)) {
            bounds.non_finite_count++;
            continue;
        }
        low = mt_vec3_make(smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z));
        high = mt_vec3_make(larger(high.x, p.x), larger(high.y, p.y), larger(high.z, p.z));
    }
    bounds.minimum = low;
    bounds.maximum = high;
    bounds.finite_count = mesh->vertex_count - bounds.non_finite_count;
    return bounds;
}
