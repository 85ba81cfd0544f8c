#include "tradeoff/pair_oracle.h"

#include "tradeoff/integer_triangle.h"

#include <meshtool/triangulate.h>

#include <stdlib.h>
#include <string.h>

/* Boxes compared, and pairs decided, in all. */
#define BOX_WORK 200000000U
#define PAIR_WORK 200000U

typedef struct box {
    double low[3], high[3];
} box;

typedef struct sampling {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    box *boxes;               /* a triangle each; an empty one meets nothing */
    mt_index *firsts;         /* triangles of face f: firsts[f] up to firsts[f + 1] */
    mt_index *faces;          /* judged */
    uint64_t *offsets;        /* into `found`, a judged face each */
    mt_index *found;          /* faces that meet a judged one, MT_NONE: candidates that do not */
    unsigned char *is_judged; /* a face */
    mt_index count;           /* of judged faces */
} sampling;

static void load(const sampling *s, mt_index number, integer_triangle *out)
{
    for (mt_index side = 0; side < 3; side++) {
        out->vertices[side] = s->mesh->corner_vertices[mt_triangulation_corner(&s->triangulation, number, side)];
        out->points[side] = mt_mesh_position(s->mesh, out->vertices[side]);
    }
}

static box box_of(const integer_triangle *triangle)
{
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}}, empty = b;
    for (int i = 0; i < 3; i++) {
        mt_vec3 point = triangle->points[i];
        const double p[3] = {point.x, point.y, point.z};
        for (int axis = 0; axis < 3; axis++) {
            if (!isfinite(p[axis])) {
                return empty;
            }
            b.low[axis] = p[axis] < b.low[axis] ? p[axis] : b.low[axis];
            b.high[axis] = p[axis] > b.high[axis] ? p[axis] : b.high[axis];
        }
    }
    return b;
}

static bool do_overlap(const box *a, const box *b)
{
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] && b->low[1] <= a->high[1] &&
           a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

static void measure_boxes(sampling *s)
{
    mt_index face = 0;
    for (mt_index number = 0; number < s->triangulation.triangle_count; number++) {
        integer_triangle triangle;
        load(s, number, &triangle);
        s->boxes[number] = box_of(&triangle);
        while (face <= mt_triangulation_face(&s->triangulation, number)) {
            s->firsts[face++] = number;
        }
    }
    while (face <= s->mesh->face_count) {
        s->firsts[face++] = s->triangulation.triangle_count;
    }
}

static bool is_candidate(const sampling *s, mt_index face, mt_index a, mt_index b)
{
    return do_overlap(&s->boxes[a], &s->boxes[b]) && mt_triangulation_face(&s->triangulation, b) != face;
}

static void count_candidates(void *user, uint64_t begin, uint64_t end)
{
    sampling *s = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_index face = s->faces[i];
        for (mt_index a = s->firsts[face]; a < s->firsts[face + 1]; a++) {
            for (mt_index b = 0; b < s->triangulation.triangle_count; b++) {
                s->offsets[i] += is_candidate(s, face, a, b);
            }
        }
    }
}

static void decide_candidates(void *user, uint64_t begin, uint64_t end)
{
    sampling *s = user;
    for (uint64_t i = begin; i < end; i++) {
        mt_index face = s->faces[i], *found = s->found + s->offsets[i];
        for (mt_index a = s->firsts[face]; a < s->firsts[face + 1]; a++) {
            integer_triangle first, second;
            load(s, a, &first);
            for (mt_index b = 0; b < s->triangulation.triangle_count; b++) {
                if (is_candidate(s, face, a, b)) {
                    load(s, b, &second);
                    bool meet = integer_triangles_intersect(&first, &second);
                    *found++ = meet ? mt_triangulation_face(&s->triangulation, b) : MT_NONE;
                }
            }
        }
    }
}

/* Every step-th face, as far as the work allows. */
static void choose_faces(sampling *s, mt_index step)
{
    uint64_t triangles = 0;
    s->count = 0;
    for (mt_index face = 0; face < s->mesh->face_count; face++) {
        uint64_t sum = triangles + s->firsts[face + 1] - s->firsts[face];
        s->is_judged[face] = face % step == 0 && sum * s->triangulation.triangle_count <= BOX_WORK;
        if (s->is_judged[face]) {
            s->faces[s->count++] = face;
            triangles = sum;
        }
    }
}

/* Turns counts into offsets, and drops the faces whose candidates would be too many. Returns the candidates' number. */
static uint64_t limit_faces(sampling *s)
{
    uint64_t sum = 0;
    mt_index kept = 0;
    for (mt_index i = 0; i < s->count; i++) {
        uint64_t count = s->offsets[i];
        s->is_judged[s->faces[i]] = sum + count <= PAIR_WORK;
        if (sum + count <= PAIR_WORK) {
            s->faces[kept] = s->faces[i];
            s->offsets[kept++] = sum;
            sum += count;
        }
    }
    s->count = kept;
    return sum;
}

static int compare_pairs(const void *left, const void *right)
{
    const mt_face_pair *p = left, *q = right;
    int first = (p->a > q->a) - (p->a < q->a);
    return first ? first : (p->b > q->b) - (p->b < q->b);
}

/* A pair of judged faces is found from both, and faces of several triangles meet several times. */
static mt_status gather(const sampling *s, mt_context *context, uint64_t candidate_count, pair_oracle *out)
{
    out->pairs = mt_allocate_array(context, candidate_count, sizeof *out->pairs);
    if (!out->pairs) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    uint64_t count = 0;
    for (mt_index i = 0; i < s->count; i++) {
        uint64_t end = i + 1 < s->count ? s->offsets[i + 1] : candidate_count;
        for (uint64_t at = s->offsets[i]; at < end; at++) {
            mt_index face = s->faces[i], other = s->found[at];
            if (other != MT_NONE) {
                out->pairs[count++] = face < other ? (mt_face_pair){face, other} : (mt_face_pair){other, face};
            }
        }
    }
    qsort(out->pairs, count, sizeof *out->pairs, compare_pairs);
    for (uint64_t i = 0; i < count; i++) {
        if (i == 0 || compare_pairs(&out->pairs[i - 1], &out->pairs[i]) != 0) {
            out->pairs[out->pair_count++] = out->pairs[i];
        }
    }
    return MT_OK;
}

/* Twice: the first time tells how many pairs there are to decide, and so how many faces can be judged. */
static mt_status decide(sampling *s, mt_context *context, pair_oracle *out)
{
    mt_index most = (mt_index)(BOX_WORK / ((uint64_t)s->triangulation.triangle_count + 1) + 1);
    choose_faces(s, (s->mesh->face_count - 1) / most + 1);
    mt_parallel_for(context, s->count, 1, count_candidates, s);
    uint64_t candidate_count = limit_faces(s);
    s->found = mt_allocate_array(context, candidate_count, sizeof *s->found);
    if (!s->found) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, s->count, 1, decide_candidates, s);
    out->judged_count = s->count;
    return gather(s, context, candidate_count, out);
}

mt_status pair_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out)
{
    sampling s = {.mesh = mesh};
    mt_status status = mt_triangulation_init(context, mesh, &s.triangulation);
    if (status == MT_OK) {
        s.boxes = mt_allocate_array(context, s.triangulation.triangle_count, sizeof *s.boxes);
        s.firsts = mt_allocate_array_zeroed(context, (uint64_t)mesh->face_count + 1, sizeof *s.firsts);
        s.faces = mt_allocate_array(context, mesh->face_count, sizeof *s.faces);
        s.offsets = mt_allocate_array_zeroed(context, mesh->face_count, sizeof *s.offsets);
        s.is_judged = mt_allocate_zeroed(context, mesh->face_count);
        out->is_judged = s.is_judged;
        status = s.boxes && s.firsts && s.faces && s.offsets && s.is_judged ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        measure_boxes(&s);
        status = decide(&s, context, out);
    }
    mt_free(context, s.boxes);
    mt_free(context, s.firsts);
    mt_free(context, s.faces);
    mt_free(context, s.offsets);
    mt_free(context, s.found);
    mt_triangulation_release(context, &s.triangulation);
    return status;
}

void pair_oracle_release(mt_context *context, pair_oracle *oracle)
{
    mt_free(context, oracle->is_judged);
    mt_free(context, oracle->pairs);
    memset(oracle, 0, sizeof *oracle);
}
