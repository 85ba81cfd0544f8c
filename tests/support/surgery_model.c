#include "tests/support/surgery_model.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

void test_model_read(test_model *model, const mt_mesh *mesh)
{
    memset(model, 0, sizeof *model);
    assert_true(mesh->vertex_count < TEST_MODEL_VERTICES && mesh->face_count < TEST_MODEL_FACES);
    model->vertex_count = mesh->vertex_count;
    model->face_count = mesh->face_count;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        test_model_face *to = &model->faces[face];
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            assert_true(to->count < TEST_MODEL_SIDES);
            to->vertices[to->count++] = mesh->corner_vertices[c];
        }
    }
}

/* The place of a vertex in a face, MT_NONE when it is not there. */
static mt_index place_of(const test_model_face *face, mt_index vertex)
{
    for (mt_index i = 0; i < face->count; i++) {
        if (face->vertices[i] == vertex) {
            return i;
        }
    }
    return MT_NONE;
}

static mt_index vertex_at(const test_model_face *face, mt_index place)
{
    return face->vertices[place % face->count];
}

mt_index test_model_face_of(const test_model *model, mt_index u, mt_index v)
{
    for (mt_index face = 0; face < model->face_count; face++) {
        mt_index place = place_of(&model->faces[face], u);
        if (place != MT_NONE && vertex_at(&model->faces[face], place + 1) == v) {
            return face;
        }
    }
    return MT_NONE;
}

static mt_index opposite(const test_model_face *face, mt_index u)
{
    return vertex_at(face, place_of(face, u) + 2);
}

static void add_face(test_model *model, mt_index count, const mt_index *vertices)
{
    assert_true(model->face_count < TEST_MODEL_FACES && count < TEST_MODEL_SIDES);
    test_model_face *face = &model->faces[model->face_count++];
    face->count = count;
    memcpy(face->vertices, vertices, count * sizeof *vertices);
}

static void set_triangle(test_model_face *face, mt_index a, mt_index b, mt_index c)
{
    face->vertices[0] = a, face->vertices[1] = b, face->vertices[2] = c;
}

static bool swap_edge(test_model *model, mt_index a, mt_index b)
{
    mt_index left = test_model_face_of(model, a, b), right = test_model_face_of(model, b, a);
    if (left == MT_NONE || right == MT_NONE || model->faces[left].count != 3 || model->faces[right].count != 3) {
        return false;
    }
    mt_index c = opposite(&model->faces[left], a), d = opposite(&model->faces[right], b);
    set_triangle(&model->faces[left], a, d, c);
    set_triangle(&model->faces[right], b, c, d);
    return true;
}

static void insert_after(test_model_face *face, mt_index u, mt_index middle)
{
    mt_index place = place_of(face, u) + 1;
    assert_true(face->count < TEST_MODEL_SIDES);
    memmove(face->vertices + place + 1, face->vertices + place, (face->count - place) * sizeof(mt_index));
    face->vertices[place] = middle;
    face->count++;
}

static mt_index new_vertex(test_model *model)
{
    assert_true(model->vertex_count < TEST_MODEL_VERTICES);
    model->deleted[model->vertex_count] = 0;
    return model->vertex_count++;
}

static bool split_edge(test_model *model, mt_index a, mt_index b)
{
    mt_index left = test_model_face_of(model, a, b), right = test_model_face_of(model, b, a);
    if (left == MT_NONE && right == MT_NONE) {
        return false;
    }
    mt_index middle = new_vertex(model);
    if (left != MT_NONE && model->faces[left].count == 3) {
        mt_index c = opposite(&model->faces[left], a);
        set_triangle(&model->faces[left], a, middle, c);
        add_face(model, 3, (const mt_index[]){middle, b, c});
    } else if (left != MT_NONE) {
        insert_after(&model->faces[left], a, middle);
    }
    if (right != MT_NONE && model->faces[right].count == 3) {
        mt_index d = opposite(&model->faces[right], b);
        set_triangle(&model->faces[right], middle, a, d);
        add_face(model, 3, (const mt_index[]){b, middle, d});
    } else if (right != MT_NONE) {
        insert_after(&model->faces[right], b, middle);
    }
    return true;
}

/* The face counter-clockwise of the edge from v to x, and the edge's end after it; MT_NONE outside. */
static mt_index face_after(const test_model *model, mt_index v, mt_index x, mt_index *end)
{
    mt_index face = test_model_face_of(model, v, x);
    if (face != MT_NONE) {
        const test_model_face *own = &model->faces[face];
        *end = vertex_at(own, place_of(own, v) + own->count - 1);
    }
    return face;
}

/* The end of the first edge counter-clockwise of the outside, MT_NONE when v does not lie on the boundary. */
static mt_index first_end(const test_model *model, mt_index v)
{
    for (mt_index face = 0; face < model->face_count; face++) {
        mt_index place = place_of(&model->faces[face], v);
        if (place != MT_NONE && test_model_face_of(model, vertex_at(&model->faces[face], place + 1), v) == MT_NONE) {
            return vertex_at(&model->faces[face], place + 1);
        }
    }
    return MT_NONE;
}

static bool are_joined(const test_model *model, mt_index u, mt_index v)
{
    return test_model_face_of(model, u, v) != MT_NONE || test_model_face_of(model, v, u) != MT_NONE;
}

static bool split_vertex(test_model *model, mt_index v, mt_index x, mt_index y)
{
    mt_index first = first_end(model, v), passed[TEST_MODEL_FACES], count = 0;
    if ((x == MT_NONE && y == MT_NONE) || (x != MT_NONE && !are_joined(model, v, x)) ||
        (y != MT_NONE && !are_joined(model, v, y)) || ((x == MT_NONE || y == MT_NONE) && first == MT_NONE)) {
        return false;
    }
    mt_index at = x == MT_NONE ? first : x;
    for (bool begins = x != MT_NONE; at != y || begins; begins = false) {
        mt_index face = face_after(model, v, at, &at);
        if (face != MT_NONE) {
            passed[count++] = face;
        } else if (y == MT_NONE) {
            break;
        } else {
            at = first;
        }
    }
    mt_index w = new_vertex(model);
    for (mt_index i = 0; i < count; i++) {
        model->faces[passed[i]].vertices[place_of(&model->faces[passed[i]], v)] = w;
    }
    if (x != MT_NONE) {
        add_face(model, 3, (const mt_index[]){v, x, w});
    }
    if (y != MT_NONE) {
        add_face(model, 3, (const mt_index[]){v, w, y});
    }
    return true;
}

static bool collapse_edge(test_model *model, mt_index a, mt_index b)
{
    if (!are_joined(model, a, b)) {
        return false;
    }
    for (mt_index f = 0; f < model->face_count; f++) {
        test_model_face *face = &model->faces[f];
        mt_index count = 0;
        for (mt_index i = 0; i < face->count; i++) {
            mt_index v = face->vertices[i] == a ? b : face->vertices[i];
            if (count == 0 || v != face->vertices[count - 1]) {
                face->vertices[count++] = v;
            }
        }
        count -= count > 1 && face->vertices[count - 1] == face->vertices[0];
        face->count = count < 3 ? 0 : count;
    }
    model->deleted[a] = 1;
    return true;
}

static bool can_name(const test_model *model, mt_index count, const mt_index *vertices)
{
    bool can = count >= 3;
    for (mt_index i = 0; i < count; i++) {
        can = can && vertices[i] < model->vertex_count && !model->deleted[vertices[i]];
    }
    return can;
}

bool test_model_apply(test_model *model, const test_operation *at)
{
    switch (at->kind) {
    case TEST_SWAP_EDGE:
        return swap_edge(model, at->a, at->b);
    case TEST_SPLIT_EDGE:
        return split_edge(model, at->a, at->b);
    case TEST_SPLIT_VERTEX:
        return split_vertex(model, at->a, at->b, at->c);
    case TEST_COLLAPSE_EDGE:
        return collapse_edge(model, at->a, at->b);
    case TEST_REMOVE_FACE:
        if (at->face >= model->face_count || model->faces[at->face].count == 0) {
            return false;
        }
        model->faces[at->face].count = 0;
        return true;
    default:
        if (!can_name(model, at->count, at->vertices)) {
            return false;
        }
        add_face(model, at->count, at->vertices);
        return true;
    }
}
