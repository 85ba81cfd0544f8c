/* What the definitions say of a list of faces. */
#include "tests/support/surgery_model.h"
#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

/* Which face runs from u to v: 1 + its number at u * vertex_count + v, 0 for none. */
typedef struct side_census {
    const test_model *model;
    uint16_t *face_of;
    int64_t edge_count, face_count;
    mt_index isolated_count, living_count;
} side_census;

static uint16_t *side_of(const side_census *census, mt_index u, mt_index v)
{
    return &census->face_of[(size_t)u * census->model->vertex_count + v];
}

/* False when a face names a vertex twice or a deleted one, or two faces run along a side in the same direction. */
static bool count_sides(side_census *census)
{
    const test_model *model = census->model;
    for (mt_index f = 0; f < model->face_count; f++) {
        const test_model_face *face = &model->faces[f];
        census->face_count += face->count != 0;
        for (mt_index i = 0; i < face->count; i++) {
            mt_index u = face->vertices[i], v = face->vertices[(i + 1) % face->count];
            if (u == v || model->deleted[u] || *side_of(census, u, v)) {
                return false;
            }
            for (mt_index j = 0; j < i; j++) {
                if (face->vertices[j] == u) {
                    return false;
                }
            }
            *side_of(census, u, v) = (uint16_t)(f + 1);
            census->edge_count += !*side_of(census, v, u);
        }
    }
    return true;
}

/* Faces met from one face at the vertex on, over shared edges, in one direction; stops when it is back. */
static mt_index walk(const side_census *census, mt_index vertex, mt_index begin, bool counterclockwise, bool *closed)
{
    mt_index met = 0, f = begin;
    *closed = false;
    while (f != MT_NONE && !(met && f == begin)) {
        const test_model_face *face = &census->model->faces[f];
        mt_index place = 0;
        while (face->vertices[place] != vertex) {
            place++;
        }
        mt_index end = face->vertices[(place + (counterclockwise ? face->count - 1 : 1)) % face->count];
        uint16_t next = counterclockwise ? *side_of(census, vertex, end) : *side_of(census, end, vertex);
        met++;
        f = next ? next - 1u : MT_NONE;
    }
    *closed = f == begin;
    return met;
}

static bool vertices_have_one_fan(side_census *census)
{
    const test_model *model = census->model;
    mt_index counts[TEST_MODEL_VERTICES] = {0}, firsts[TEST_MODEL_VERTICES];
    for (mt_index f = 0; f < model->face_count; f++) {
        for (mt_index i = 0; i < model->faces[f].count; i++) {
            firsts[model->faces[f].vertices[i]] = f;
            counts[model->faces[f].vertices[i]]++;
        }
    }
    for (mt_index v = 0; v < model->vertex_count; v++) {
        census->living_count += !model->deleted[v];
        census->isolated_count += !model->deleted[v] && counts[v] == 0;
        bool closed = false;
        if (counts[v]) {
            mt_index met = walk(census, v, firsts[v], true, &closed);
            met += closed ? 0 : walk(census, v, firsts[v], false, &closed) - 1;
            if (met != counts[v]) {
                return false;
            }
        }
    }
    return true;
}

/* The same vertices in the same order or the opposite one. */
static bool lie_back_to_back(const test_model_face *a, const test_model_face *b)
{
    if (a->count != b->count || a->count == 0) {
        return false;
    }
    for (mt_index turn = 0; turn < 2 * a->count; turn++) {
        bool same = true;
        for (mt_index i = 0; same && i < a->count; i++) {
            mt_index j = turn < a->count ? (turn + i) % a->count : (2 * a->count + turn - i) % a->count;
            same = a->vertices[i] == b->vertices[j];
        }
        if (same) {
            return true;
        }
    }
    return false;
}

static mt_index count_duplicates(const test_model *model)
{
    mt_index count = 0, sums[TEST_MODEL_FACES] = {0}; /* faces of other sums differ */
    for (mt_index f = 0; f < model->face_count; f++) {
        for (mt_index i = 0; i < model->faces[f].count; i++) {
            sums[f] += 1000 + model->faces[f].vertices[i];
        }
        for (mt_index g = 0; g < f; g++) {
            count += sums[f] == sums[g] && lie_back_to_back(&model->faces[f], &model->faces[g]);
        }
    }
    return count;
}

static bool take_census(const test_model *model, side_census *census)
{
    memset(census, 0, sizeof *census);
    census->model = model;
    census->face_of = calloc((size_t)model->vertex_count * model->vertex_count + 1, sizeof *census->face_of);
    assert_non_null(census->face_of);
    bool manifold = count_sides(census) && vertices_have_one_fan(census);
    free(census->face_of);
    return manifold;
}

bool test_model_allows(const test_model *before, const test_model *after, const test_operation *operation)
{
    side_census old, new;
    assert_true(take_census(before, &old));
    if (!take_census(after, &new) || count_duplicates(after) > count_duplicates(before)) {
        return false;
    }
    if (operation->kind == TEST_REMOVE_FACE || operation->kind == TEST_ADD_FACE) {
        return true;
    }
    return old.living_count - old.edge_count + old.face_count ==
           new.living_count - new.edge_count + new.face_count &&old.isolated_count == new.isolated_count;
}

mt_mesh *test_model_mesh(mt_context *context, const test_model *model, mt_index *vertex_map, mt_index *face_map)
{
    mt_index vertex_count = 0, face_count = 0, corner_count = 0;
    for (mt_index v = 0; v < model->vertex_count; v++) {
        vertex_map[v] = model->deleted[v] ? MT_NONE : vertex_count++;
    }
    mt_index *faces = malloc(sizeof *faces * TEST_MODEL_FACES * (TEST_MODEL_SIDES + 1));
    double *positions = calloc(3 * TEST_MODEL_VERTICES, sizeof *positions);
    assert_true(faces && positions);
    for (mt_index f = 0; f < model->face_count; f++) {
        const test_model_face *face = &model->faces[f];
        face_map[f] = face->count ? face_count++ : MT_NONE;
        if (face->count) {
            faces[corner_count++] = face->count;
        }
        for (mt_index i = 0; i < face->count; i++) {
            faces[corner_count++] = vertex_map[face->vertices[i]];
        }
    }
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, face_count, faces);
    free(faces);
    free(positions);
    return mesh;
}

void test_same_faces(const mt_mesh *a, const mt_mesh *b)
{
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->face_count, b->face_count);
    assert_int_equal(a->corner_count, b->corner_count);
    for (mt_index face = 0; face < a->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(a, face), turn = 0;
        assert_int_equal(sides, mt_mesh_face_sides(b, face));
        const mt_index *left = a->corner_vertices + mt_mesh_face_begin(a, face);
        const mt_index *right = b->corner_vertices + mt_mesh_face_begin(b, face);
        while (turn < sides && right[turn] != left[0]) {
            turn++;
        }
        for (mt_index i = 0; i < sides; i++) {
            assert_int_equal(left[i], right[(turn + i) % sides]);
        }
    }
}
