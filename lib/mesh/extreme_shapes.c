/* Shapes that are extreme by themselves. */
#include "lib/mesh/generate.h"

#include <string.h>

static mt_status make_triangles(mt_context *context, uint64_t vertex_count, uint64_t face_count, mt_index sides,
                                mt_mesh **out)
{
    mt_mesh_layout layout = {
        .vertex_count = vertex_count, .face_count = face_count, .face_size = sides, .position_type = MT_F64};
    return mt_mesh_create(context, &layout, out);
}

/* A closed box of twelve triangles. */
static mt_status make_box(mt_context *context, mt_vec3 size, mt_mesh **out)
{
    static const mt_index faces[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    mt_status status = make_triangles(context, 8, 12, 3, out);
    for (mt_index i = 0; status == MT_OK && i < 8; i++) {
        bool right = i % 4 == 1 || i % 4 == 2, top = i % 4 >= 2, front = i >= 4;
        mt_mesh_set_position(*out, i, mt_vec3_make(right ? size.x : 0, top ? size.y : 0, front ? size.z : 0));
    }
    if (status == MT_OK) {
        memcpy((*out)->corner_vertices, faces, sizeof faces);
    }
    return status;
}

mt_status mt_extreme_sliver(mt_context *context, double magnitude, mt_mesh **out)
{
    return make_box(context, mt_vec3_make(1, 1 / magnitude, 1 / magnitude), out);
}

mt_status mt_extreme_flat(mt_context *context, double magnitude, mt_mesh **out)
{
    return make_box(context, mt_vec3_make(1, 1, magnitude), out);
}

mt_status mt_extreme_nearly_flat(mt_context *context, double magnitude, mt_mesh **out)
{
    static const mt_index faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const mt_vec3 points[4] = {{0.1, 0.2, 0.3}, {1.1, 0.3, 0.3}, {0.4, 1.2, 0.3}, {0.5, 0.6, 0.3 + magnitude}};
    mt_status status = make_triangles(context, 4, 4, 3, out);
    for (mt_index i = 0; status == MT_OK && i < 4; i++) {
        mt_mesh_set_position(*out, i, points[i]);
    }
    if (status == MT_OK) {
        memcpy((*out)->corner_vertices, faces, sizeof faces);
    }
    return status;
}

/* A square of two triangles at a place, of vertices 4 k .. 4 k + 3 and faces 2 k and 2 k + 1. */
static void put_square(mt_mesh *mesh, mt_index k, mt_vec3 corner, double side)
{
    mt_index *face = mesh->corner_vertices + 6 * (size_t)k, first = 4 * k;
    const mt_index corners[6] = {first, first + 1, first + 2, first, first + 2, first + 3};
    for (mt_index i = 0; i < 4; i++) {
        double x = i == 1 || i == 2 ? side : 0, z = i >= 2 ? -side : 0;
        mt_mesh_set_position(mesh, first + i, mt_vec3_make(corner.x + x, corner.y, corner.z + z));
    }
    memcpy(face, corners, sizeof corners);
}

mt_status mt_extreme_walls(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_status status = make_triangles(context, 8, 4, 3, out);
    if (status == MT_OK) {
        put_square(*out, 0, mt_vec3_make(0, 0, 0), 1);
        put_square(*out, 1, mt_vec3_make(0, magnitude, 0), 1);
    }
    return status;
}

mt_status mt_extreme_specks(mt_context *context, double magnitude, mt_mesh **out)
{
    enum { ALONG = 32 };
    mt_status status = make_triangles(context, 4 * ALONG * ALONG, 2 * ALONG * ALONG, 3, out);
    for (mt_index k = 0; status == MT_OK && k < ALONG * ALONG; k++) {
        put_square(*out, k, mt_vec3_make(k % ALONG, 0, k / (mt_index)ALONG), magnitude);
    }
    return status;
}

/* The teapot stands on the field; the stadium is a ring of quads, its rows rising outwards. */
mt_status mt_extreme_stadium(mt_context *context, double magnitude, mt_mesh **out)
{
    enum { AROUND = 64, ROWS = 4 };
    mt_mesh *teapot = NULL;
    mt_status status = mt_generate_teapot(context, 4, &teapot);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_layout layout = {.vertex_count = (uint64_t)teapot->vertex_count + AROUND * (ROWS + 1),
                             .face_count = (uint64_t)teapot->face_count + AROUND * ROWS,
                             .corner_count = (uint64_t)teapot->corner_count + 4 * AROUND * ROWS,
                             .position_type = MT_F64};
    status = mt_mesh_create(context, &layout, out);
    if (status == MT_OK) {
        memcpy((*out)->positions, teapot->positions, 3 * sizeof(double) * teapot->vertex_count);
        for (mt_index face = 0; face < teapot->face_count; face++) {
            mt_generate_face(*out, face, teapot->corner_vertices + mt_mesh_face_begin(teapot, face),
                             mt_mesh_face_sides(teapot, face));
        }
        for (mt_index i = 0; i < AROUND * (ROWS + 1); i++) {
            mt_circle_point at = mt_circle(i % AROUND, AROUND);
            double row = i / (mt_index)AROUND, radius = magnitude * (1 + 0.25 * row);
            mt_mesh_set_position(*out, teapot->vertex_count + i,
                                 mt_vec3_make(radius * at.x, magnitude * 0.15 * row, -radius * at.y));
        }
        for (mt_index i = 0; i < AROUND * ROWS; i++) {
            mt_index first = teapot->vertex_count + i / AROUND * AROUND, a = i % AROUND, b = (a + 1) % AROUND;
            const mt_index quad[4] = {first + a, first + b, first + AROUND + b, first + AROUND + a};
            mt_generate_face(*out, teapot->face_count + i, quad, 4);
        }
    }
    mt_mesh_destroy(context, teapot);
    return status;
}

mt_status mt_extreme_valence(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_index count = (mt_index)magnitude;
    mt_status status = make_triangles(context, (uint64_t)count + 1, count, 3, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_set_position(*out, count, mt_vec3_make(0, 1, 0));
    for (mt_index i = 0; i < count; i++) {
        mt_circle_point at = mt_circle(i, count);
        mt_index *corners = (*out)->corner_vertices + 3 * (size_t)i;
        mt_mesh_set_position(*out, i, mt_vec3_make(at.x, 0, -at.y));
        corners[0] = i, corners[1] = (i + 1) % count, corners[2] = count;
    }
    return status;
}

/* A lantern: meridians of two quads each from pole to pole, around a ring of twice as many vertices. */
mt_status mt_extreme_pole(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_index count = (mt_index)magnitude, ring = 2 * count, north = ring, south = ring + 1;
    mt_status status = make_triangles(context, (uint64_t)ring + 2, (uint64_t)ring, 4, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_set_position(*out, north, mt_vec3_make(0, 1, 0));
    mt_mesh_set_position(*out, south, mt_vec3_make(0, -1, 0));
    for (mt_index i = 0; i < ring; i++) {
        mt_circle_point at = mt_circle(i, ring);
        mt_mesh_set_position(*out, i, mt_vec3_make(at.x, i % 2 ? -0.25 : 0.25, -at.y));
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index a = 2 * i, b = (2 * i + 1) % ring, c = (2 * i + 2) % ring, d = (2 * i + 3) % ring;
        const mt_index upper[4] = {a, b, c, north}, lower[4] = {b, south, d, c};
        memcpy((*out)->corner_vertices + 8 * (size_t)i, upper, sizeof upper);
        memcpy((*out)->corner_vertices + 8 * (size_t)i + 4, lower, sizeof lower);
    }
    return status;
}

/* Teeth of a comb: the lower side is straight, the upper one goes up and down. */
mt_status mt_extreme_polygon(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_index count = (mt_index)magnitude, teeth = count - 2;
    mt_mesh_layout layout = {.vertex_count = count, .face_count = 1, .corner_count = count, .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh_set_position(*out, 0, mt_vec3_make(0, 0, 0));
    mt_mesh_set_position(*out, 1, mt_vec3_make(1, 0, 0));
    for (mt_index i = 0; i < teeth; i++) {
        double x = 1 - (double)i / (double)(teeth - 1);
        mt_mesh_set_position(*out, 2 + i, mt_vec3_make(x, i % 2 ? 0.1 : 0.5, 0));
    }
    for (mt_index i = 0; i < count; i++) {
        (*out)->corner_vertices[i] = i;
    }
    (*out)->face_offsets[1] = count;
    mt_mesh_compact_faces(context, *out);
    return MT_OK;
}

mt_status mt_extreme_duplicates(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_index count = (mt_index)magnitude;
    mt_status status = make_triangles(context, 3 * (uint64_t)count, count, 3, out);
    for (mt_index i = 0; status == MT_OK && i < 3 * count; i++) {
        mt_mesh_set_position(*out, i, mt_vec3_make(i % 3 == 1, i % 3 == 2, 0));
        (*out)->corner_vertices[i] = i;
    }
    return status;
}

/* Sizes double and turn; the three corners sum to zero. */
mt_status mt_extreme_centroids(mt_context *context, double magnitude, mt_mesh **out)
{
    mt_index count = (mt_index)magnitude;
    mt_status status = make_triangles(context, 3 * (uint64_t)count, count, 3, out);
    for (mt_index i = 0; status == MT_OK && i < count; i++) {
        mt_circle_point at = mt_circle(i, 97);
        double size = 1 + (double)(i % 1024) / 64;
        mt_vec3 a = mt_vec3_make(size * at.x, size * at.y, 0), b = mt_vec3_make(-size * at.y, size * at.x, size);
        mt_mesh_set_position(*out, 3 * i, a);
        mt_mesh_set_position(*out, 3 * i + 1, b);
        mt_mesh_set_position(*out, 3 * i + 2, mt_vec3_make(-a.x - b.x, -a.y - b.y, -a.z - b.z));
        for (mt_index k = 0; k < 3; k++) {
            (*out)->corner_vertices[3 * i + k] = 3 * i + k;
        }
    }
    return status;
}
