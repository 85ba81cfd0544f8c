/* Components that are inside out: sides sorted to tell which faces hang together and which edges have just two sides
 * that run against each other, then a sum of tetrahedra in whole numbers. */
#include "tradeoff/integer.h"
#include "tradeoff/pair_oracle.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A mesh of more corners is not judged. */
#define CORNER_WORK 200000U

typedef struct side {
    mt_index low, high, face;
    bool is_forward;
} side;

typedef struct member {
    mt_index component; /* its first face */
    mt_index face;
} member;

typedef struct sorting {
    const mt_mesh *mesh;
    side *sides;
    member *members;
    mt_index *leaders;      /* a face: one of its component, lower unless itself */
    unsigned char *is_open; /* a face: an edge of it does not have two sides, or not against each other */
} sorting;

static mt_index leader_of(const sorting *s, mt_index face)
{
    while (s->leaders[face] != face) {
        face = s->leaders[face] = s->leaders[s->leaders[face]];
    }
    return face;
}

static void unite(const sorting *s, mt_index a, mt_index b)
{
    a = leader_of(s, a), b = leader_of(s, b);
    s->leaders[a < b ? b : a] = a < b ? a : b;
}

static int compare_sides(const void *left, const void *right)
{
    const side *p = left, *q = right;
    int low = (p->low > q->low) - (p->low < q->low), high = (p->high > q->high) - (p->high < q->high);
    return low ? low : high ? high : (p->face > q->face) - (p->face < q->face);
}

static int compare_members(const void *left, const void *right)
{
    const member *p = left, *q = right;
    int component = (p->component > q->component) - (p->component < q->component);
    return component ? component : (p->face > q->face) - (p->face < q->face);
}

static void list_sides(const sorting *s)
{
    const mt_mesh *mesh = s->mesh;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        s->leaders[face] = face;
        for (mt_index c = begin; c < end; c++) {
            mt_index a = mesh->corner_vertices[c], b = mesh->corner_vertices[c + 1 < end ? c + 1 : begin];
            s->sides[c] = a < b ? (side){a, b, face, true} : (side){b, a, face, false};
        }
    }
    qsort(s->sides, mesh->corner_count, sizeof *s->sides, compare_sides);
}

/* A side from a vertex to itself is no edge; no face with one is closed. */
static void join_sides(const sorting *s)
{
    mt_index count = s->mesh->corner_count;
    for (mt_index begin = 0, end; begin < count; begin = end) {
        const side *first = &s->sides[begin];
        bool is_edge = first->low != first->high;
        for (end = begin + 1; end < count; end++) {
            if (s->sides[end].low != first->low || s->sides[end].high != first->high) {
                break;
            }
            if (is_edge) {
                unite(s, first->face, s->sides[end].face);
            }
        }
        bool is_regular = is_edge && end - begin == 2 && first[0].is_forward != first[1].is_forward;
        for (mt_index i = begin; i < end; i++) {
            s->is_open[s->sides[i].face] |= !is_regular;
        }
    }
}

static void list_members(const sorting *s)
{
    for (mt_index face = 0; face < s->mesh->face_count; face++) {
        mt_index component = leader_of(s, face);
        s->is_open[component] |= s->is_open[face];
        s->members[face] = (member){component, face};
    }
    qsort(s->members, s->mesh->face_count, sizeof *s->members, compare_members);
}

/* The largest exponent of which all coordinates of the faces are multiples; false when one is not finite. */
static bool find_exponent(const sorting *s, const member *members, mt_index count, int *exponent)
{
    *exponent = INT_MAX;
    for (mt_index i = 0; i < count; i++) {
        mt_index end = mt_mesh_face_end(s->mesh, members[i].face);
        for (mt_index c = mt_mesh_face_begin(s->mesh, members[i].face); c < end; c++) {
            mt_vec3 p = mt_mesh_position(s->mesh, s->mesh->corner_vertices[c]);
            const double x[3] = {p.x, p.y, p.z};
            for (int axis = 0; axis < 3; axis++) {
                int own = isfinite(x[axis]) ? integer_exponent(x[axis]) : INT_MIN;
                *exponent = own < *exponent ? own : *exponent;
            }
        }
    }
    return *exponent > INT_MIN;
}

static void load(const sorting *s, mt_index corner, int exponent, integer out[3])
{
    mt_vec3 p = mt_mesh_position(s->mesh, s->mesh->corner_vertices[corner]);
    integer_from(p.x, exponent, &out[0]);
    integer_from(p.y, exponent, &out[1]);
    integer_from(p.z, exponent, &out[2]);
}

/* Adds the six products of the determinant. */
static void add_tetrahedron(const integer a[3], const integer b[3], const integer c[3], integer *sum)
{
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        integer two, three, other;
        integer_multiply(&a[axis], &b[next], &two);
        integer_multiply(&two, &c[last], &three);
        integer_add(sum, &three, &other);
        integer_multiply(&a[axis], &b[last], &two);
        integer_multiply(&two, &c[next], &three);
        integer_subtract(&other, &three, sum);
    }
}

/* Faces count as fans about their first corners. */
static int volume_sign(const sorting *s, const member *members, mt_index count)
{
    int exponent;
    if (!find_exponent(s, members, count, &exponent)) {
        return 0;
    }
    integer sum = {0}, first[3], before[3], here[3];
    for (mt_index i = 0; i < count; i++) {
        mt_index begin = mt_mesh_face_begin(s->mesh, members[i].face), end = mt_mesh_face_end(s->mesh, members[i].face);
        load(s, begin, exponent, first);
        load(s, begin + 1, exponent, before);
        for (mt_index c = begin + 2; c < end; c++) {
            load(s, c, exponent, here);
            add_tetrahedron(first, before, here, &sum);
            memcpy(before, here, sizeof before);
        }
    }
    return sum.sign;
}

static void judge_components(const sorting *s, pair_oracle *out)
{
    mt_index face_count = s->mesh->face_count;
    for (mt_index begin = 0, end; begin < face_count; begin = end) {
        mt_index component = s->members[begin].component;
        end = begin + 1;
        while (end < face_count && s->members[end].component == component) {
            end++;
        }
        if (!s->is_open[component] && volume_sign(s, s->members + begin, end - begin) < 0) {
            out->pairs[out->pair_count++] = (mt_face_pair){component, component};
        }
    }
    memset(out->is_judged, 1, face_count);
    out->judged_count = face_count;
}

mt_status volume_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out)
{
    out->is_judged = mt_allocate_zeroed(context, mesh->face_count);
    if (!out->is_judged || mesh->corner_count > CORNER_WORK) {
        return out->is_judged ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    sorting s = {.mesh = mesh};
    s.sides = mt_allocate_array(context, mesh->corner_count, sizeof *s.sides);
    s.members = mt_allocate_array(context, mesh->face_count, sizeof *s.members);
    s.leaders = mt_allocate_array(context, mesh->face_count, sizeof *s.leaders);
    s.is_open = mt_allocate_zeroed(context, mesh->face_count);
    out->pairs = mt_allocate_array(context, mesh->face_count, sizeof *out->pairs);
    bool has_room = s.sides && s.members && s.leaders && s.is_open && out->pairs;
    if (has_room) {
        list_sides(&s);
        join_sides(&s);
        list_members(&s);
        judge_components(&s, out);
    }
    mt_free(context, s.sides);
    mt_free(context, s.members);
    mt_free(context, s.leaders);
    mt_free(context, s.is_open);
    return has_room ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}
