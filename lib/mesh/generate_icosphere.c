/* The icosahedron with every edge cut into 2^level equal parts, pushed out to the unit sphere. The vertices are those
 * of the icosahedron, then those inside its edges, then those inside its faces: all numbers are closed forms. */
#include "lib/mesh/generate.h"

#define BASE_VERTICES 12
#define BASE_EDGES 30
#define BASE_FACES 20

typedef struct icosphere {
    mt_index parts; /* of an edge */
    mt_mesh *base, *mesh;
    mt_index edges[BASE_VERTICES][BASE_VERTICES]; /* number of the edge between two base vertices */
} icosphere;

static void number_edges(icosphere *sphere)
{
    mt_index count = 0;
    for (mt_index corner = 0; corner < 3 * BASE_FACES; corner++) {
        mt_index a = sphere->base->corner_vertices[corner];
        mt_index b = sphere->base->corner_vertices[corner % 3 == 2 ? corner - 2 : corner + 1];
        if (a < b) {
            sphere->edges[a][b] = count++;
        }
    }
}

/* The vertex `step` parts from a towards b, 0 < step < parts. */
static mt_index edge_vertex(const icosphere *sphere, mt_index a, mt_index b, mt_index step)
{
    mt_index first = a < b ? sphere->edges[a][b] : sphere->edges[b][a];
    mt_index from_lower = a < b ? step : sphere->parts - step;
    return BASE_VERTICES + first * (sphere->parts - 1) + from_lower - 1;
}

/* The vertex in row r (0 at the face's first corner, `parts` at its opposite side), column c <= r. */
static mt_index lattice_vertex(const icosphere *sphere, mt_index face, mt_index r, mt_index c)
{
    const mt_index *v = sphere->base->corner_vertices + 3 * (size_t)face;
    mt_index n = sphere->parts;
    if (r == 0 || (r == n && (c == 0 || c == n))) {
        return v[r == 0 ? 0 : c == 0 ? 1 : 2];
    }
    if (c == 0 || c == r) {
        return edge_vertex(sphere, v[0], v[c == 0 ? 1 : 2], r);
    }
    if (r == n) {
        return edge_vertex(sphere, v[1], v[2], c);
    }
    mt_index inside = (n - 1) * (n - 2) / 2;
    return BASE_VERTICES + BASE_EDGES * (n - 1) + face * inside + (r - 1) * (r - 2) / 2 + c - 1;
}

static mt_vec3 lattice_position(const icosphere *sphere, mt_index face, mt_index r, mt_index c)
{
    const mt_index *v = sphere->base->corner_vertices + 3 * (size_t)face;
    mt_vec3 p = mt_vec3_scale(mt_mesh_position(sphere->base, v[0]), sphere->parts - r);
    p = mt_vec3_add(p, mt_vec3_scale(mt_mesh_position(sphere->base, v[1]), r - c));
    return mt_vec3_normalize(mt_vec3_add(p, mt_vec3_scale(mt_mesh_position(sphere->base, v[2]), c)));
}

static void fill_face(const icosphere *sphere, mt_index face)
{
    mt_index n = sphere->parts;
    mt_index *corner = sphere->mesh->corner_vertices + 3 * (size_t)n * n * face;
    for (mt_index r = 0; r <= n; r++) {
        for (mt_index c = 0; c <= r; c++) {
            mt_index here = lattice_vertex(sphere, face, r, c);
            mt_mesh_set_position(sphere->mesh, here, lattice_position(sphere, face, r, c));
            if (r == n) {
                continue;
            }
            mt_index below = lattice_vertex(sphere, face, r + 1, c),
                     beside = lattice_vertex(sphere, face, r + 1, c + 1);
            *corner++ = here, *corner++ = below, *corner++ = beside;
            if (c < r) {
                *corner++ = here, *corner++ = beside, *corner++ = lattice_vertex(sphere, face, r, c + 1);
            }
        }
    }
}

mt_status mt_generate_icosphere(mt_context *context, mt_index resolution, mt_mesh **out)
{
    icosphere sphere = {.parts = (mt_index)1 << resolution};
    uint64_t n = sphere.parts;
    mt_mesh_layout layout = {
        .vertex_count = 10 * n * n + 2, .face_count = 20 * n * n, .face_size = 3, .position_type = MT_F64};
    mt_status status = mt_generate_icosahedron(context, 0, &sphere.base);
    if (status == MT_OK) {
        status = mt_mesh_create(context, &layout, out);
    }
    if (status == MT_OK) {
        sphere.mesh = *out;
        number_edges(&sphere);
        for (mt_index face = 0; face < BASE_FACES; face++) {
            fill_face(&sphere, face);
        }
    }
    mt_mesh_destroy(context, sphere.base);
    return status;
}
