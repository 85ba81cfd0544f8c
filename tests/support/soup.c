#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SIDES_MAXIMUM 7
#define FACES_MAXIMUM 64

/* Faces being gathered, in the form that test_mesh takes. */
typedef struct face_list {
    mt_index count;
    mt_index size;
    mt_index data[FACES_MAXIMUM * (SIDES_MAXIMUM + 1)];
    mt_index begins[FACES_MAXIMUM];
} face_list;

static void add_face(face_list *list, mt_index sides, const mt_index *vertices)
{
    list->begins[list->count++] = list->size;
    list->data[list->size++] = sides;
    memcpy(list->data + list->size, vertices, sides * sizeof *vertices);
    list->size += sides;
}

static void random_face(face_list *list, test_random *random, mt_index vertex_count, bool triangles)
{
    mt_index vertices[SIDES_MAXIMUM];
    mt_index sides = triangles ? 3 : 3 + (mt_index)test_random_below(random, SIDES_MAXIMUM - 2);
    for (mt_index i = 0; i < sides; i++) {
        vertices[i] = (mt_index)test_random_below(random, vertex_count);
    }
    add_face(list, sides, vertices);
}

/* An earlier face again, turned and perhaps reversed. */
static void repeat_face(face_list *list, test_random *random)
{
    const mt_index *face = list->data + list->begins[test_random_below(random, list->count)];
    mt_index sides = face[0];
    mt_index turn = (mt_index)test_random_below(random, sides);
    bool reversed = test_random_below(random, 2);
    mt_index vertices[SIDES_MAXIMUM];
    for (mt_index i = 0; i < sides; i++) {
        mt_index at = (i + turn) % sides;
        vertices[i] = face[1 + (reversed ? sides - 1 - at : at)];
    }
    add_face(list, sides, vertices);
}

/* A triangle across a side of an earlier face, so that some edges pair well. */
static void neighbor_face(face_list *list, test_random *random, mt_index vertex_count)
{
    const mt_index *face = list->data + list->begins[test_random_below(random, list->count)];
    mt_index side = (mt_index)test_random_below(random, face[0]);
    mt_index vertices[3] = {face[1 + (side + 1) % face[0]], face[1 + side],
                            (mt_index)test_random_below(random, vertex_count)};
    add_face(list, 3, vertices);
}

static mt_mesh *finish(mt_context *context, test_random *random, mt_index vertex_count, const face_list *list)
{
    double positions[3 * 64];
    for (mt_index i = 0; i < 3 * vertex_count; i++) {
        positions[i] = (double)test_random_below(random, 4);
    }
    if (vertex_count && test_random_below(random, 8) == 0) {
        positions[test_random_below(random, 3 * vertex_count)] = test_random_below(random, 2) ? NAN : INFINITY;
    }
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, list->count, list->data);
    mt_mesh_compact_faces(context, mesh);
    return mesh;
}

mt_mesh *test_soup(mt_context *context, test_random *random)
{
    mt_index vertex_count = 3 + (mt_index)test_random_below(random, 10);
    mt_index face_count = (mt_index)test_random_below(random, 14);
    bool triangles = test_random_below(random, 2);
    face_list list = {0};
    while (list.count < face_count) {
        uint64_t choice = list.count ? test_random_below(random, 8) : 0;
        if (choice == 1) {
            repeat_face(&list, random);
        } else if (choice >= 4) {
            neighbor_face(&list, random, vertex_count);
        } else {
            random_face(&list, random, vertex_count, triangles);
        }
    }
    return finish(context, random, vertex_count, &list);
}

/* Grid vertex of a patch of 5 x 4, rolled up as `kind` says: 0 open, 1 tube, 2 torus, 3 Moebius strip, 4 Klein bottle.
 */
static mt_index patch_vertex(mt_index column, mt_index row, unsigned kind)
{
    if (kind && column == 5) {
        column = 0;
        if (kind >= 3) {
            row = kind == 3 ? 4 - row : (4 - row) % 4;
        }
    }
    if (kind == 2 || kind == 4) {
        row %= 4;
    }
    return row * 6 + column;
}

static void add_patch_face(face_list *list, test_random *random, mt_index sides, const mt_index *vertices, bool turns)
{
    mt_index turned[4];
    bool reversed = turns && test_random_below(random, 6) == 0;
    for (mt_index i = 0; i < sides; i++) {
        turned[i] = vertices[reversed ? sides - 1 - i : i];
    }
    if (list->count < FACES_MAXIMUM) {
        add_face(list, sides, turned);
    }
}

mt_mesh *test_patch(mt_context *context, test_random *random)
{
    unsigned kind = (unsigned)test_random_below(random, 5);
    uint64_t holes = test_random_below(random, 5);
    bool turns = test_random_below(random, 2);
    face_list list = {0};
    for (mt_index row = 0; row < 4; row++) {
        for (mt_index column = 0; column < 5; column++) {
            if (test_random_below(random, 10) < holes) {
                continue;
            }
            mt_index v[4] = {patch_vertex(column, row, kind), patch_vertex(column + 1, row, kind),
                             patch_vertex(column + 1, row + 1, kind), patch_vertex(column, row + 1, kind)};
            if (test_random_below(random, 2)) {
                add_patch_face(&list, random, 4, v, turns);
            } else {
                mt_index second[3] = {v[0], v[2], v[3]};
                add_patch_face(&list, random, 3, v, turns);
                add_patch_face(&list, random, 3, second, turns);
            }
        }
    }
    return finish(context, random, 30, &list);
}

static mt_mesh *triangle_mesh(mt_context *context, mt_index vertex_count, mt_index face_count)
{
    mt_mesh_layout layout = {
        .vertex_count = vertex_count, .face_count = face_count, .face_size = 3, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    return mesh;
}

mt_mesh *test_fan(mt_context *context, mt_index count, bool closed)
{
    mt_index rim = closed ? count : count + 1;
    mt_mesh *mesh = triangle_mesh(context, rim + 1, count);
    mt_mesh_set_position(mesh, 0, mt_vec3_make(0, 0, 1));
    for (mt_index i = 0; i < rim; i++) {
        double turn = 2.0 * 3.14159265358979323846 * i / rim;
        mt_mesh_set_position(mesh, i + 1, mt_vec3_make(cos(turn), sin(turn), 0));
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index *vertex = mesh->corner_vertices + 3 * (size_t)i;
        vertex[0] = 0;
        vertex[1] = 1 + i;
        vertex[2] = 1 + (i + 1) % rim;
    }
    return mesh;
}

static mt_index *random_order(test_random *random, mt_index count, bool shuffled)
{
    mt_index *order = malloc((count + (size_t)1) * sizeof *order);
    assert_non_null(order);
    for (mt_index i = 0; i < count; i++) {
        mt_index j = shuffled ? (mt_index)test_random_below(random, (uint64_t)i + 1) : i;
        order[i] = i;
        mt_index other = order[j];
        order[j] = i;
        order[i] = other;
    }
    return order;
}

static void place_torus_vertices(mt_mesh *mesh, const mt_index *order, mt_index columns, mt_index rows)
{
    double turn = 2.0 * 3.14159265358979323846;
    for (mt_index row = 0; row < rows; row++) {
        for (mt_index column = 0; column < columns; column++) {
            double u = turn * column / columns;
            double v = turn * row / rows;
            mt_vec3 p = {(3 + cos(v)) * cos(u), (3 + cos(v)) * sin(u), sin(v)};
            mt_mesh_set_position(mesh, order[row * columns + column], p);
        }
    }
}

mt_mesh *test_torus(mt_context *context, mt_index columns, mt_index rows, bool shuffled)
{
    test_random random = {7};
    mt_mesh *mesh = triangle_mesh(context, columns * rows, 2 * columns * rows);
    mt_index *vertices = random_order(&random, columns * rows, shuffled);
    mt_index *faces = random_order(&random, mesh->face_count, shuffled);
    place_torus_vertices(mesh, vertices, columns, rows);
    for (mt_index row = 0; row < rows; row++) {
        for (mt_index column = 0; column < columns; column++) {
            mt_index cell = row * columns + column;
            mt_index right = (column + 1) % columns;
            mt_index above = (row + 1) % rows;
            mt_index v[4] = {vertices[cell], vertices[row * columns + right], vertices[above * columns + right],
                             vertices[above * columns + column]};
            mt_index *lower = mesh->corner_vertices + 3 * (size_t)faces[2 * cell];
            mt_index *upper = mesh->corner_vertices + 3 * (size_t)faces[2 * cell + 1];
            lower[0] = v[0], lower[1] = v[1], lower[2] = v[2];
            upper[0] = v[0], upper[1] = v[2], upper[2] = v[3];
        }
    }
    free(vertices);
    free(faces);
    return mesh;
}
