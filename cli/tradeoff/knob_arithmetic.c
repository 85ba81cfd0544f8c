/* How the signs behind self-intersections are found. Exact integers decide what is right; the tests hold those beside
 * another program's exact kernel. */
#include "tradeoff/tradeoff.h"

#include <meshtool/self_intersection.h>

#include <stdio.h>

/* Exact signs for every pair of boxes that overlap take microseconds each. */
#define FACE_LIMIT 300000U

static const char *const levels[] = {"floating", "adaptive", "exact", NULL};
static const mt_arithmetic arithmetics[] = {MT_ARITHMETIC_FLOATING, MT_ARITHMETIC_ADAPTIVE, MT_ARITHMETIC_EXACT};

typedef struct arithmetic_state {
    const mt_mesh *mesh;
    mt_self_intersections exact, found;
} arithmetic_state;

static mt_status find(mt_context *context, const mt_mesh *mesh, mt_arithmetic arithmetic, mt_self_intersections *out)
{
    mt_self_intersection_options options = {.arithmetic = arithmetic};
    return mt_find_self_intersections(context, mesh, &options, out);
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0 || subject->mesh->face_count > FACE_LIMIT) {
        *why = subject->mesh->face_count == 0 ? "the mesh has no faces"
                                              : "exact signs for every pair of neighbours would take minutes";
        return MT_OK;
    }
    arithmetic_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    return find(context, s->mesh, MT_ARITHMETIC_EXACT, &s->exact);
}

static void release(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    mt_self_intersections_release(context, &s->exact);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    arithmetic_state *s = state;
    return find(context, s->mesh, arithmetics[level], &s->found);
}

static void discard(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    mt_self_intersections_release(context, &s->found);
}

/* Pairs in one list and not in the other: missed by the first, made up by the second. Both ascend. */
static void count_wrong(const mt_self_intersections *exact, const mt_self_intersections *found, uint64_t *missed,
                        uint64_t *made_up)
{
    uint64_t i = 0, j = 0;
    *missed = *made_up = 0;
    while (i < exact->pair_count || j < found->pair_count) {
        const mt_face_pair *p = i < exact->pair_count ? &exact->pairs[i] : NULL;
        const mt_face_pair *q = j < found->pair_count ? &found->pairs[j] : NULL;
        bool before = !q || (p && (p->a < q->a || (p->a == q->a && p->b < q->b)));
        bool after = !p || (q && (q->a < p->a || (q->a == p->a && q->b < p->b)));
        *missed += before;
        *made_up += after;
        i += !after;
        j += !before;
    }
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    const arithmetic_state *s = state;
    uint64_t missed, made_up;
    count_wrong(&s->exact, &s->found, &missed, &made_up);
    tradeoff_add_error(row, "wrong_pairs", (double)(missed + made_up));
    tradeoff_add_error(row, "missed", (double)missed);
    tradeoff_add_error(row, "made_up", (double)made_up);
    tradeoff_add_size(row, "pairs", (double)s->found.pair_count);
    row->is_defect = arithmetics[level] != MT_ARITHMETIC_FLOATING && missed + made_up > 0;
    if (missed + made_up > 0) {
        snprintf(row->says, sizeof row->says, "%llu pairs are missed and %llu made up, of %llu",
                 (unsigned long long)missed, (unsigned long long)made_up, (unsigned long long)s->exact.pair_count);
    } else {
        snprintf(row->says, sizeof row->says, "nothing on this mesh: %llu pairs, all right",
                 (unsigned long long)s->exact.pair_count);
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_arithmetic = {
    .name = "arithmetic",
    .question = "How are the signs behind self-intersections found?",
    .oracle = "exact integers",
    .axis = "wrong_pairs",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
