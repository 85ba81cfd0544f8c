#include "tests/support/cage.h"

#include "tests/support/unit.h"

#include <meshtool/edge_pairs.h>
#include <meshtool/triangulate.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

mt_mesh *test_cube(mt_context *context)
{
    double positions[24];
    for (int i = 0; i < 8; i++) {
        positions[3 * i] = i & 1 ? 1 : -1;
        positions[3 * i + 1] = i & 2 ? 1 : -1;
        positions[3 * i + 2] = i & 4 ? 1 : -1;
    }
    static const mt_index faces[] = {4, 0, 2, 3, 1, 4, 4, 5, 7, 6, 4, 0, 1, 5, 4,
                                     4, 2, 6, 7, 3, 4, 0, 4, 6, 2, 4, 1, 3, 7, 5};
    return test_mesh(context, 8, positions, 6, faces);
}

typedef struct cage_shape {
    mt_index columns, rows, width, height; /* cells, and vertices */
    mt_index *faces;
    size_t used;
    mt_index face_count;
} cage_shape;

static mt_index vertex_at(const cage_shape *shape, mt_index column, mt_index row)
{
    return row % shape->height * shape->width + column % shape->width;
}

static void add_face(cage_shape *shape, mt_index size, const mt_index *vertices)
{
    shape->faces[shape->used++] = size;
    memcpy(shape->faces + shape->used, vertices, size * sizeof *vertices);
    shape->used += size;
    shape->face_count++;
}

/* Returns how many cells it used. */
static mt_index add_cell(cage_shape *shape, test_random *random, mt_index column, mt_index row)
{
    mt_index a = vertex_at(shape, column, row), b = vertex_at(shape, column + 1, row);
    mt_index c = vertex_at(shape, column + 1, row + 1), d = vertex_at(shape, column, row + 1);
    switch (test_random_below(random, 5)) {
    case 0:
        add_face(shape, 3, (mt_index[]){a, b, c});
        add_face(shape, 3, (mt_index[]){a, c, d});
        return 1;
    case 1:
        add_face(shape, 3, (mt_index[]){b, c, d});
        add_face(shape, 3, (mt_index[]){a, b, d});
        return 1;
    case 2:
        if (column + 1 < shape->columns) {
            mt_index e = vertex_at(shape, column + 2, row), f = vertex_at(shape, column + 2, row + 1);
            add_face(shape, 6, (mt_index[]){a, b, e, f, c, d});
            return 2;
        }
        break;
    default:
        break;
    }
    add_face(shape, 4, (mt_index[]){a, b, c, d});
    return 1;
}

/* A torus, or a sheet, without sines: any closed curve does. */
static void place_vertices(const cage_shape *shape, test_random *random, bool closed, double *positions)
{
    for (mt_index row = 0; row < shape->height; row++) {
        for (mt_index column = 0; column < shape->width; column++) {
            double *p = positions + 3 * ((size_t)row * shape->width + column);
            double u = (double)column / shape->width, v = (double)row / shape->height;
            double bend = closed ? u * (1 - u) * 4 : u, turn = closed ? v * (1 - v) * 4 : v;
            p[0] = 5 * bend + test_random_unit(random);
            p[1] = 5 * turn + test_random_unit(random);
            p[2] = (u - 0.5) * (v - 0.5) + test_random_unit(random);
        }
    }
}

mt_mesh *test_cage(mt_context *context, test_random *random, mt_index columns, mt_index rows, bool closed)
{
    cage_shape shape = {.columns = columns, .rows = rows};
    shape.width = closed ? columns : columns + 1;
    shape.height = closed ? rows : rows + 1;
    shape.faces = malloc(8 * (size_t)columns * rows * sizeof(mt_index));
    mt_index vertex_count = shape.width * shape.height;
    double *positions = malloc(3 * (size_t)vertex_count * sizeof *positions);
    assert_non_null(shape.faces);
    assert_non_null(positions);
    for (mt_index row = 0; row < rows; row++) {
        for (mt_index column = 0; column < columns;) {
            column += add_cell(&shape, random, column, row);
        }
    }
    place_vertices(&shape, random, closed, positions);
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, shape.face_count, shape.faces);
    free(positions);
    free(shape.faces);
    return mesh;
}

mt_mesh *test_triangle_cage(mt_context *context, test_random *random, mt_index columns, mt_index rows, bool closed)
{
    for (;;) {
        mt_mesh *polygons = test_cage(context, random, columns, rows, closed), *triangles = NULL;
        mt_edge_pairs *pairs = NULL;
        assert_int_equal(mt_mesh_triangulate(context, polygons, &triangles), MT_OK);
        assert_int_equal(mt_edge_pairs_create(context, triangles, &pairs), MT_OK);
        bool manifold = pairs->non_manifold_count == 0;
        mt_edge_pairs_destroy(context, pairs);
        mt_mesh_destroy(context, polygons);
        if (manifold) {
            return triangles;
        }
        mt_mesh_destroy(context, triangles);
    }
}

/* A random order of the numbers below count, malloc'ed. */
static mt_index *random_order(test_random *random, mt_index count)
{
    mt_index *order = malloc(((size_t)count + 1) * sizeof *order);
    assert_non_null(order);
    for (mt_index i = 0; i < count; i++) {
        mt_index j = (mt_index)test_random_below(random, (uint64_t)i + 1);
        order[i] = order[j];
        order[j] = i;
    }
    return order;
}

mt_mesh *test_renumbered(mt_context *context, test_random *random, const mt_mesh *mesh, bool reverse,
                         mt_index *corner_images)
{
    mt_index *vertices = random_order(random, mesh->vertex_count), *faces = random_order(random, mesh->face_count);
    mt_mesh_layout layout = {.vertex_count = mesh->vertex_count,
                             .face_count = mesh->face_count,
                             .corner_count = mesh->corner_count,
                             .position_type = mesh->position_type};
    mt_mesh *copy = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &copy), MT_OK);
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_mesh_set_position(copy, vertices[vertex], mt_mesh_position(mesh, vertex));
    }
    for (mt_index i = 0; i < mesh->face_count; i++) {
        mt_index begin = mt_mesh_face_begin(mesh, faces[i]), sides = mt_mesh_face_sides(mesh, faces[i]);
        mt_index turn = (mt_index)test_random_below(random, sides);
        copy->face_offsets[i + 1] = copy->face_offsets[i] + sides;
        for (mt_index k = 0; k < sides; k++) {
            mt_index slot = (reverse ? sides - k : k) + turn;
            mt_index image = copy->face_offsets[i] + slot % sides;
            corner_images[begin + k] = image;
            copy->corner_vertices[image] = vertices[mesh->corner_vertices[begin + k]];
        }
    }
    mt_mesh_compact_faces(context, copy);
    free(vertices);
    free(faces);
    return copy;
}

void test_sharpen(mt_context *context, test_random *random, mt_mesh *mesh)
{
    static const double values[] = {0.5, 1, 1.5, 2.5, 10};
    mesh->creases = mt_allocate_array(context, mesh->corner_count, sizeof *mesh->creases);
    mesh->sharp_vertices = mt_allocate_array(context, mesh->vertex_count, sizeof *mesh->sharp_vertices);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index next = corner + 1 < end ? corner + 1 : begin;
            if (test_random_below(random, 3) == 0) {
                mesh->creases[mesh->crease_count++] = (mt_edge_value){
                    mesh->corner_vertices[corner], mesh->corner_vertices[next], values[test_random_below(random, 5)]};
            }
        }
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        if (test_random_below(random, 10) == 0) {
            mesh->sharp_vertices[mesh->sharp_vertex_count++] =
                (mt_vertex_value){vertex, values[test_random_below(random, 5)]};
        }
    }
}

void test_add_uvs(mt_context *context, test_random *random, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = MT_F64,
                                  .component_count = 2,
                                  .value_count = 2 * (uint64_t)mesh->vertex_count,
                                  .indexed = true};
    mt_attribute *uv = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &uv), MT_OK);
    for (mt_index value = 0; value < uv->value_count; value++) {
        mt_attribute_set(uv, value, 0, test_random_unit(random));
        mt_attribute_set(uv, value, 1, test_random_unit(random));
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        uv->indices[corner] =
            mesh->corner_vertices[corner] + (test_random_below(random, 6) == 0 ? mesh->vertex_count : 0);
    }
}

void test_expect_within_hull(test_random *random, const mt_mesh *cage, const mt_mesh *refined)
{
    for (unsigned i = 0; i < 50; i++) {
        mt_vec3 direction = {test_random_unit(random) - 0.5, test_random_unit(random) - 0.5,
                             test_random_unit(random) - 0.5};
        double farthest = -INFINITY;
        for (mt_index vertex = 0; vertex < cage->vertex_count; vertex++) {
            farthest = fmax(farthest, mt_vec3_dot(direction, mt_mesh_position(cage, vertex)));
        }
        for (mt_index vertex = 0; vertex < refined->vertex_count; vertex++) {
            assert_true(mt_vec3_dot(direction, mt_mesh_position(refined, vertex)) <= farthest + 1e-14);
        }
    }
}
