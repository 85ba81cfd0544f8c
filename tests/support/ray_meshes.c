#include "tests/support/unit.h"

#include "tests/support/ray_meshes.h"
#include "tests/support/soup.h"

#include <math.h>

/* `count` triangles without a shared vertex. */
static mt_mesh *loose_triangles(mt_context *context, mt_index count, const double *positions)
{
    mt_index *faces = mt_allocate_array(context, 4 * (uint64_t)count, sizeof *faces);
    assert_non_null(faces);
    for (mt_index i = 0; i < count; i++) {
        faces[4 * i] = 3, faces[4 * i + 1] = 3 * i, faces[4 * i + 2] = 3 * i + 1, faces[4 * i + 3] = 3 * i + 2;
    }
    mt_mesh *mesh = test_mesh(context, 3 * count, positions, count, faces);
    mt_free(context, faces);
    return mesh;
}

mt_mesh *test_slivers(mt_context *context)
{
    enum { COUNT = 150 };
    double positions[9 * COUNT];
    test_random random = {5};
    for (mt_index i = 0; i < COUNT; i++) {
        double thin = ldexp(1, -(int)test_random_below(&random, 20));
        for (mt_index c = 0; c < 9; c++) {
            positions[9 * i + c] =
                c < 6 ? test_random_unit(&random) : positions[9 * i + c - 6] + thin * test_random_unit(&random);
        }
    }
    return loose_triangles(context, COUNT, positions);
}

mt_mesh *test_flat_duplicates(mt_context *context)
{
    enum { SIDE = 6, QUADS = SIDE * SIDE };
    double positions[3 * (SIDE + 1) * (SIDE + 1)];
    mt_index faces[5 * QUADS * 3];
    for (mt_index i = 0; i < (SIDE + 1) * (SIDE + 1); i++) {
        positions[3 * i] = i % (SIDE + 1);
        positions[3 * i + 1] = 2.5;
        positions[3 * i + 2] = i / (SIDE + 1);
    }
    for (mt_index i = 0; i < 3 * QUADS; i++) {
        mt_index quad = i % QUADS, v = quad / SIDE * (SIDE + 1) + quad % SIDE;
        mt_index *face = &faces[5 * i];
        face[0] = 4, face[1] = v, face[2] = v + 1, face[3] = v + SIDE + 2, face[4] = v + SIDE + 1;
    }
    return test_mesh(context, (SIDE + 1) * (SIDE + 1), positions, 3 * QUADS, faces);
}

static mt_mesh *map_positions(mt_mesh *mesh, mt_vec3 (*map)(mt_vec3 p))
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v, map(mt_mesh_position(mesh, v)));
    }
    return mesh;
}

static mt_vec3 slant(mt_vec3 p)
{
    return mt_vec3_make(p.x * 0.7 + p.z * 0.2, p.x * 0.1 - p.z * 0.6, p.x * -0.3 + p.z * 0.9);
}

mt_mesh *test_slanted_plane(mt_context *context)
{
    return map_positions(test_flat_duplicates(context), slant);
}

mt_mesh *test_two_scales(mt_context *context)
{
    mt_mesh *mesh = test_torus(context, 16, 8, false);
    for (mt_index v = 0; v < mesh->vertex_count / 2; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_scale(mt_mesh_position(mesh, v), 1e-6));
    }
    return mesh;
}

static mt_vec3 move_far(mt_vec3 p)
{
    return mt_vec3_add(mt_vec3_scale(p, 1e-3), mt_vec3_make(1e7, -1e7, 3e6));
}

mt_mesh *test_far_torus(mt_context *context)
{
    return map_positions(test_torus(context, 16, 8, false), move_far);
}

static mt_vec3 shrink(mt_vec3 p)
{
    return mt_vec3_scale(p, 1e-150);
}

mt_mesh *test_tiny_torus(mt_context *context)
{
    return map_positions(test_torus(context, 16, 8, false), shrink);
}

static mt_vec3 enlarge(mt_vec3 p)
{
    return mt_vec3_scale(p, 1e150);
}

mt_mesh *test_huge_torus(mt_context *context)
{
    return map_positions(test_torus(context, 16, 8, false), enlarge);
}

mt_mesh *test_equal_triangles(mt_context *context, mt_index count)
{
    mt_index *faces = mt_allocate_array(context, 4 * (uint64_t)count, sizeof *faces);
    assert_non_null(faces);
    for (mt_index i = 0; i < count; i++) {
        faces[4 * i] = 3, faces[4 * i + 1] = 0, faces[4 * i + 2] = 1, faces[4 * i + 3] = 2;
    }
    mt_mesh *mesh = test_mesh(context, 3, (const double[]){0, 0, 0, 1, 0, 0, 0, 1, 0}, count, faces);
    mt_free(context, faces);
    return mesh;
}

mt_mesh *test_geometric_series(mt_context *context, mt_index count)
{
    double *positions = mt_allocate_array(context, 9 * (uint64_t)count, sizeof *positions);
    assert_non_null(positions);
    for (mt_index i = 0; i < count; i++) {
        double size = ldexp(1 + (i % 20) / 20.0, -(int)(i / 20));
        for (mt_index c = 0; c < 9; c++) {
            positions[9 * i + c] = size * (1 + (c == i % 9) * 0.5);
        }
    }
    mt_mesh *mesh = loose_triangles(context, count, positions);
    mt_free(context, positions);
    return mesh;
}
