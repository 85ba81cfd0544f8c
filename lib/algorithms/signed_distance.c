/* The sign of a distance by angle-weighted pseudonormals (Baerentzen and Aanaes 2005).
 *
 * A triangle copy of the mesh, its tree, its pairs of sides and a pseudonormal a vertex; that of an edge is the sum of
 * the two unit normals, made when it is asked for. Whether the nearest point lies on an edge or a vertex is exact: the
 * search gives such points weights of exactly zero. Linear time and memory besides the tree. Known failure: triangles
 * without area have no normal; where all around the nearest point are such, the distance counts as outside. */
#include <meshtool/edge_pairs.h>
#include <meshtool/elementary.h>
#include <meshtool/signed_distance.h>

struct mt_signed_distance {
    mt_mesh *mesh; /* triangles */
    mt_triangulation triangulation;
    mt_edge_pairs *pairs;
    mt_surface_tree *tree;
    mt_vec3 *vertex_normals;
};

static mt_vec3 scaled_position(const mt_signed_distance *s, mt_index vertex)
{
    return mt_vec3_scale(mt_mesh_position(s->mesh, vertex), mt_surface_tree_space(s->tree)->scale);
}

static mt_vec3 triangle_normal(const mt_signed_distance *s, mt_index triangle)
{
    const mt_index *v = s->mesh->corner_vertices + 3 * (size_t)triangle;
    mt_vec3 a = scaled_position(s, v[0]);
    mt_vec3 ab = mt_vec3_subtract(scaled_position(s, v[1]), a), ac = mt_vec3_subtract(scaled_position(s, v[2]), a);
    return mt_vec3_normalize(mt_vec3_cross(ab, ac));
}

static double corner_angle(const mt_signed_distance *s, mt_index triangle, mt_index side)
{
    const mt_index *v = s->mesh->corner_vertices + 3 * (size_t)triangle;
    mt_vec3 a = scaled_position(s, v[side]);
    mt_vec3 ab = mt_vec3_subtract(scaled_position(s, v[(side + 1) % 3]), a);
    mt_vec3 ac = mt_vec3_subtract(scaled_position(s, v[(side + 2) % 3]), a);
    return mt_atan2(mt_vec3_length(mt_vec3_cross(ab, ac)), mt_vec3_dot(ab, ac));
}

/* In the order of the triangles: the same sums on any machine. */
static void sum_vertex_normals(mt_signed_distance *s)
{
    for (mt_index triangle = 0; triangle < s->mesh->face_count; triangle++) {
        mt_vec3 normal = triangle_normal(s, triangle);
        for (mt_index side = 0; side < 3; side++) {
            mt_vec3 *sum = &s->vertex_normals[s->mesh->corner_vertices[3 * (size_t)triangle + side]];
            *sum = mt_vec3_add(*sum, mt_vec3_scale(normal, corner_angle(s, triangle, side)));
        }
    }
}

static mt_status refuse_edge(mt_context *context, const mt_signed_distance *s, mt_index corner, mt_edge_class class)
{
    static const char *const words[] = {
        [MT_EDGE_NONE] = "names a vertex twice in one face",
        [MT_EDGE_BOUNDARY] = "has one face",
        [MT_EDGE_REGULAR] = "",
        [MT_EDGE_MISORIENTED] = "has two faces of opposite orientation",
        [MT_EDGE_NON_MANIFOLD] = "has three faces or more",
    };
    mt_index next = corner % 3 == 2 ? corner - 2 : corner + 1;
    const mt_index *v = s->mesh->corner_vertices;
    mt_status status = class == MT_EDGE_MISORIENTED ? MT_ERROR_NOT_ORIENTED : MT_ERROR_NOT_MANIFOLD;
    return mt_fail(
        context, status,
        "inside and outside need a closed, oriented mesh, but edge %u-%u %s; `meshtool repair --all` may mend it",
        v[corner], v[next], words[class]);
}

static mt_status check_closed(mt_context *context, const mt_signed_distance *s)
{
    if (!s->mesh->face_count) {
        return mt_fail(context, MT_ERROR_INVALID_MESH, "a mesh without faces has no inside; give a closed mesh");
    }
    if (mt_surface_tree_left_out(s->tree)) {
        return mt_fail(context, MT_ERROR_INVALID_MESH,
                       "%u triangles have a vertex that is not finite, which leaves the mesh open",
                       mt_surface_tree_left_out(s->tree));
    }
    for (mt_index corner = 0; corner < s->mesh->corner_count; corner++) {
        mt_edge_class class = mt_edge_class_of(s->mesh, s->pairs, corner);
        if (class != MT_EDGE_REGULAR) {
            return refuse_edge(context, s, corner, class);
        }
    }
    return MT_OK;
}

static mt_status fill(mt_context *context, const mt_mesh *mesh, mt_signed_distance *s)
{
    mt_status status = mt_mesh_triangulate(context, mesh, &s->mesh);
    if (status == MT_OK) {
        status = mt_triangulation_init(context, s->mesh, &s->triangulation);
    }
    if (status == MT_OK) {
        status = mt_edge_pairs_create(context, s->mesh, &s->pairs);
    }
    if (status == MT_OK) {
        status = mt_surface_tree_create(context, s->mesh, &s->triangulation, NULL, &s->tree);
    }
    if (status == MT_OK) {
        status = check_closed(context, s);
    }
    if (status == MT_OK) {
        s->vertex_normals = mt_allocate_array_zeroed(context, s->mesh->vertex_count, sizeof *s->vertex_normals);
        status = s->vertex_normals ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        sum_vertex_normals(s);
    }
    return status;
}

mt_status mt_signed_distance_create(mt_context *context, const mt_mesh *mesh, mt_signed_distance **out)
{
    *out = NULL;
    mt_signed_distance *s = mt_allocate_zeroed(context, sizeof *s);
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_status status = fill(context, mesh, s);
    if (status != MT_OK) {
        mt_signed_distance_destroy(context, s);
        return status;
    }
    *out = s;
    return MT_OK;
}

void mt_signed_distance_destroy(mt_context *context, mt_signed_distance *s)
{
    if (s) {
        mt_free(context, s->vertex_normals);
        mt_surface_tree_destroy(context, s->tree);
        mt_edge_pairs_destroy(context, s->pairs);
        mt_triangulation_release(context, &s->triangulation);
        mt_mesh_destroy(context, s->mesh);
        mt_free(context, s);
    }
}

static mt_vec3 pseudonormal(const mt_signed_distance *s, const mt_closest *nearest)
{
    mt_index zeros = 0, zero = 0, one = 0, corner = 3 * nearest->element;
    for (mt_index side = 0; side < 3; side++) {
        bool is_zero = nearest->weights[side] == 0;
        zeros += is_zero;
        zero = is_zero ? side : zero;
        one = is_zero ? one : side;
    }
    if (zeros == 2) {
        return s->vertex_normals[s->mesh->corner_vertices[corner + one]];
    }
    mt_vec3 normal = triangle_normal(s, nearest->element);
    if (zeros == 1) {
        /* the side opposite to the corner without weight begins after it */
        mt_index twin = mt_edge_twin(s->mesh, s->pairs, corner + (zero + 1) % 3);
        normal = mt_vec3_add(normal, triangle_normal(s, twin / 3));
    }
    return normal;
}

double mt_signed_distance_at(const mt_signed_distance *s, mt_vec3 point, mt_closest *nearest)
{
    mt_closest own;
    nearest = nearest ? nearest : &own;
    if (!mt_surface_tree_closest(s->tree, point, NULL, nearest)) {
        return NAN;
    }
    mt_vec3 from = mt_vec3_subtract(point, nearest->point);
    return mt_vec3_dot(from, pseudonormal(s, nearest)) < 0 ? -nearest->distance : nearest->distance;
}
