/* Primitives around the axis of y: sphere, cylinder, cone, prism. Radius 1, height from -1 to 1. */
#include "lib/mesh/generate.h"

static mt_vec3 ring_point(mt_index i, mt_index sides, double radius, double height)
{
    mt_circle_point around = mt_circle(i, sides);
    return mt_vec3_make(radius * around.x, height, -radius * around.y);
}

/* The ring's vertices are `first` and the following ones. */
static void set_ring(mt_mesh *mesh, mt_index first, mt_index sides, double radius, double height)
{
    for (mt_index i = 0; i < sides; i++) {
        mt_mesh_set_position(mesh, first + i, ring_point(i, sides, radius, height));
    }
}

static mt_index after(mt_index i, mt_index sides)
{
    return i + 1 < sides ? i + 1 : 0;
}

/* Quads between two rings; returns the next face. */
static mt_index add_band(mt_mesh *mesh, mt_index face, mt_index lower, mt_index upper, mt_index sides)
{
    for (mt_index i = 0; i < sides; i++) {
        mt_index j = after(i, sides);
        const mt_index quad[4] = {lower + i, lower + j, upper + j, upper + i};
        mt_generate_face(mesh, face++, quad, 4);
    }
    return face;
}

/* Triangles between a ring and the point over it, or under it. */
static mt_index add_fan(mt_mesh *mesh, mt_index face, mt_index ring, mt_index tip, mt_index sides, bool is_over)
{
    for (mt_index i = 0; i < sides; i++) {
        mt_index j = after(i, sides);
        const mt_index triangle[3] = {ring + (is_over ? i : j), ring + (is_over ? j : i), tip};
        mt_generate_face(mesh, face++, triangle, 3);
    }
    return face;
}

/* One polygon over all of a ring, seen from above or from below. */
static mt_index add_cap(mt_mesh *mesh, mt_index face, mt_index ring, mt_index sides, bool from_above)
{
    mt_index begin = mesh->face_offsets[face];
    for (mt_index i = 0; i < sides; i++) {
        mesh->corner_vertices[begin + i] = ring + (from_above ? i : sides - 1 - i);
    }
    mesh->face_offsets[face + 1] = begin + sides;
    return face + 1;
}

mt_status mt_generate_uv_sphere(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_index sides = resolution, bands = resolution < 4 ? 2 : resolution / 2;
    uint64_t ring_count = bands - 1, n = sides;
    mt_mesh_layout layout = {.vertex_count = ring_count * n + 2,
                             .face_count = bands * n,
                             .corner_count = 6 * n + 4 * n * (ring_count - 1),
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    mt_index south = 0, north = mesh->vertex_count - 1, face = 0;
    mt_mesh_set_position(mesh, south, mt_vec3_make(0, -1, 0));
    mt_mesh_set_position(mesh, north, mt_vec3_make(0, 1, 0));
    for (mt_index ring = 0; ring < ring_count; ring++) {
        mt_circle_point latitude = mt_circle(ring + 1, 2 * (uint64_t)bands);
        set_ring(mesh, 1 + ring * sides, sides, latitude.y, -latitude.x);
    }
    face = add_fan(mesh, face, 1, south, sides, false);
    for (mt_index ring = 0; ring + 1 < ring_count; ring++) {
        face = add_band(mesh, face, 1 + ring * sides, 1 + (ring + 1) * sides, sides);
    }
    add_fan(mesh, face, north - sides, north, sides, true);
    mt_mesh_compact_faces(context, mesh);
    return MT_OK;
}

mt_status mt_generate_cylinder(mt_context *context, mt_index resolution, mt_mesh **out)
{
    uint64_t n = resolution;
    mt_mesh_layout layout = {
        .vertex_count = 2 * n + 2, .face_count = 3 * n, .corner_count = 10 * n, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    mt_index bottom = 2 * resolution, top = bottom + 1;
    set_ring(mesh, 0, resolution, 1, -1);
    set_ring(mesh, resolution, resolution, 1, 1);
    mt_mesh_set_position(mesh, bottom, mt_vec3_make(0, -1, 0));
    mt_mesh_set_position(mesh, top, mt_vec3_make(0, 1, 0));
    mt_index face = add_band(mesh, 0, 0, resolution, resolution);
    face = add_fan(mesh, face, 0, bottom, resolution, false);
    add_fan(mesh, face, resolution, top, resolution, true);
    return MT_OK;
}

mt_status mt_generate_cone(mt_context *context, mt_index resolution, mt_mesh **out)
{
    uint64_t n = resolution;
    mt_mesh_layout layout = {
        .vertex_count = n + 1, .face_count = n + 1, .corner_count = 4 * n, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    set_ring(mesh, 0, resolution, 1, -1);
    mt_mesh_set_position(mesh, resolution, mt_vec3_make(0, 1, 0));
    mt_index face = add_fan(mesh, 0, 0, resolution, resolution, true);
    add_cap(mesh, face, 0, resolution, false);
    mt_mesh_compact_faces(context, mesh);
    return MT_OK;
}

mt_status mt_generate_prism(mt_context *context, mt_index resolution, mt_mesh **out)
{
    uint64_t n = resolution;
    mt_mesh_layout layout = {
        .vertex_count = 2 * n, .face_count = n + 2, .corner_count = 6 * n, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    set_ring(mesh, 0, resolution, 1, -1);
    set_ring(mesh, resolution, resolution, 1, 1);
    mt_index face = add_band(mesh, 0, 0, resolution, resolution);
    face = add_cap(mesh, face, 0, resolution, false);
    add_cap(mesh, face, resolution, resolution, true);
    mt_mesh_compact_faces(context, mesh);
    return MT_OK;
}
