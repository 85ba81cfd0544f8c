#include "tradeoff/pair_oracle.h"

#include "tradeoff/integer_triangle.h"
#include "tradeoff/triangle_blocks.h"

#include <stdlib.h>
#include <string.h>

/* Faces of the sample, boxes and triangles that are looked at for candidates, and pairs decided, all at most. */
#define FACE_COUNT 20000U
#define BOX_WORK 100000000U
#define PAIR_WORK 400000U

typedef struct sampling {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    triangle_blocks blocks;
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

static bool do_overlap(const triangle_box *a, const triangle_box *b)
{
    return a->low[0] <= b->high[0] && b->low[0] <= a->high[0] && a->low[1] <= b->high[1] && b->low[1] <= a->high[1] &&
           a->low[2] <= b->high[2] && b->low[2] <= a->high[2];
}

static void find_firsts(sampling *s)
{
    mt_index face = 0;
    for (mt_index number = 0; number < s->triangulation.triangle_count; number++) {
        while (face <= mt_triangulation_face(&s->triangulation, number)) {
            s->firsts[face++] = number;
        }
    }
    while (face <= s->mesh->face_count) {
        s->firsts[face++] = s->triangulation.triangle_count;
    }
}

/* Of a judged face's triangle and those of other faces whose boxes touch its own. */
typedef struct search {
    const sampling *sampling;
    mt_index face;
    integer_triangle first;
    triangle_box box;
    uint64_t count;
    mt_index *found; /* NULL: they are counted only */
} search;

static bool may_touch(const void *user, const triangle_box *box)
{
    const search *for_one = user;
    return do_overlap(&for_one->box, box);
}

static void decide_candidate(void *user, mt_index number)
{
    search *for_one = user;
    const sampling *s = for_one->sampling;
    integer_triangle second;
    load(s, number, &second);
    triangle_box box = triangle_box_around(second.points);
    mt_index face = mt_triangulation_face(&s->triangulation, number);
    if (face == for_one->face || !do_overlap(&for_one->box, &box)) {
        return;
    }
    if (for_one->found) {
        for_one->found[for_one->count] = integer_triangles_intersect(&for_one->first, &second) ? face : MT_NONE;
    }
    for_one->count++;
}

static uint64_t search_around(sampling *s, mt_index face, mt_index *found)
{
    static const triangle_query query = {may_touch, decide_candidate};
    search for_one = {.sampling = s, .face = face, .found = found};
    for (mt_index a = s->firsts[face]; a < s->firsts[face + 1]; a++) {
        load(s, a, &for_one.first);
        const mt_vec3 *p = for_one.first.points;
        for_one.box = triangle_box_around(p);
        if (mt_vec3_is_finite(p[0]) && mt_vec3_is_finite(p[1]) && mt_vec3_is_finite(p[2])) {
            triangle_blocks_visit(&s->blocks, &query, &for_one);
        }
    }
    return for_one.count;
}

static void count_candidates(void *user, uint64_t begin, uint64_t end)
{
    sampling *s = user;
    for (uint64_t i = begin; i < end; i++) {
        s->offsets[i] = search_around(s, s->faces[i], NULL);
    }
}

static void decide_candidates(void *user, uint64_t begin, uint64_t end)
{
    sampling *s = user;
    for (uint64_t i = begin; i < end; i++) {
        search_around(s, s->faces[i], s->found + s->offsets[i]);
    }
}

/* Every so many faces one. */
static void choose_faces(sampling *s)
{
    mt_index step = (s->mesh->face_count - 1) / FACE_COUNT + 1;
    for (mt_index face = 0; face < s->mesh->face_count; face += step) {
        s->faces[s->count++] = face;
    }
}

/* Turns counts into offsets, and drops the faces whose candidates would be too many. Returns the candidates' number. */
static uint64_t limit_faces(sampling *s)
{
    uint64_t sum = 0;
    mt_index kept = 0;
    memset(s->is_judged, 0, s->mesh->face_count);
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
    choose_faces(s);
    s->count = (mt_index)triangle_blocks_ask(context, &s->blocks, s->count, BOX_WORK, count_candidates, s);
    uint64_t candidate_count = limit_faces(s);
    s->found = mt_allocate_array(context, candidate_count, sizeof *s->found);
    if (!s->found) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_parallel_for(context, s->count, 4, decide_candidates, s);
    out->judged_count = s->count;
    return gather(s, context, candidate_count, out);
}

mt_status pair_oracle_make(mt_context *context, const mt_mesh *mesh, pair_oracle *out)
{
    sampling s = {.mesh = mesh};
    mt_status status = mt_triangulation_init(context, mesh, &s.triangulation);
    if (status == MT_OK) {
        s.firsts = mt_allocate_array_zeroed(context, (uint64_t)mesh->face_count + 1, sizeof *s.firsts);
        s.faces = mt_allocate_array(context, mesh->face_count, sizeof *s.faces);
        s.offsets = mt_allocate_array_zeroed(context, mesh->face_count, sizeof *s.offsets);
        s.is_judged = mt_allocate_zeroed(context, mesh->face_count);
        out->is_judged = s.is_judged;
        status = s.firsts && s.faces && s.offsets && s.is_judged ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        status = triangle_blocks_make(context, mesh, &s.triangulation, &s.blocks);
    }
    if (status == MT_OK) {
        find_firsts(&s);
        status = decide(&s, context, out);
    }
    triangle_blocks_release(context, &s.blocks);
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
