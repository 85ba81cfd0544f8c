/* How the signs behind self-intersections are found. What is right is decided by determinants of whole numbers, for
 * every face of a small mesh, for a sample of the faces of a large one. */
#include "tradeoff/pair_oracle.h"
#include "tradeoff/tradeoff.h"

#include <stdio.h>

static const char *const levels[] = {"floating", "adaptive", "exact", NULL};
static const mt_arithmetic arithmetics[] = {MT_ARITHMETIC_FLOATING, MT_ARITHMETIC_ADAPTIVE, MT_ARITHMETIC_EXACT};

typedef struct arithmetic_state {
    const mt_mesh *mesh;
    pair_oracle oracle;
    mt_self_intersections found;
} arithmetic_state;

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces";
        return MT_OK;
    }
    arithmetic_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    return pair_oracle_make(context, s->mesh, &s->oracle);
}

static void release(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    pair_oracle_release(context, &s->oracle);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    arithmetic_state *s = state;
    mt_self_intersection_options options = {.arithmetic = arithmetics[level]};
    return mt_find_self_intersections(context, s->mesh, &options, &s->found);
}

static void discard(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    mt_self_intersections_release(context, &s->found);
}

/* Pairs of judged faces in one list and not in the other: missed by what was found, made up by it. Both ascend. */
static void count_wrong(const arithmetic_state *s, uint64_t *missed, uint64_t *made_up)
{
    const pair_oracle *oracle = &s->oracle;
    uint64_t i = 0, j = 0;
    *missed = *made_up = 0;
    while (i < oracle->pair_count || j < s->found.pair_count) {
        const mt_face_pair *p = i < oracle->pair_count ? &oracle->pairs[i] : NULL;
        const mt_face_pair *q = j < s->found.pair_count ? &s->found.pairs[j] : NULL;
        bool before = !q || (p && (p->a < q->a || (p->a == q->a && p->b < q->b)));
        bool after = !p || (q && (q->a < p->a || (q->a == p->a && q->b < p->b)));
        *missed += before;
        *made_up += after && (oracle->is_judged[q->a] || oracle->is_judged[q->b]);
        i += !after;
        j += !before;
    }
}

static void say(const arithmetic_state *s, uint64_t missed, uint64_t made_up, tradeoff_row *row)
{
    unsigned long long pair_count = s->oracle.pair_count;
    mt_index judged = s->oracle.judged_count, count = s->mesh->face_count;
    char sample[80] = "";
    if (judged < count) {
        snprintf(sample, sizeof sample, " with the %lu of %lu faces that are judged", (unsigned long)judged,
                 (unsigned long)count);
    }
    if (judged == 0) {
        snprintf(row->says, sizeof row->says, "not judged: the oracle has too many triangles to compare for a face");
    } else if (missed + made_up > 0) {
        snprintf(row->says, sizeof row->says, "%llu pairs are missed and %llu made up, of %llu%s",
                 (unsigned long long)missed, (unsigned long long)made_up, pair_count, sample);
    } else {
        snprintf(row->says, sizeof row->says, "nothing on this mesh: %llu pairs%s, all right", pair_count, sample);
    }
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    const arithmetic_state *s = state;
    uint64_t missed, made_up;
    count_wrong(s, &missed, &made_up);
    bool is_judged = s->oracle.judged_count > 0;
    tradeoff_add_error(row, "wrong_pairs", is_judged ? (double)(missed + made_up) : (double)NAN);
    tradeoff_add_error(row, "missed", is_judged ? (double)missed : (double)NAN);
    tradeoff_add_error(row, "made_up", is_judged ? (double)made_up : (double)NAN);
    tradeoff_add_size(row, "pairs", (double)s->found.pair_count);
    tradeoff_add_size(row, "judged_faces", (double)s->oracle.judged_count);
    row->is_defect = arithmetics[level] != MT_ARITHMETIC_FLOATING && missed + made_up > 0;
    say(s, missed, made_up, row);
    return MT_OK;
}

const tradeoff_knob tradeoff_arithmetic = {
    .name = "arithmetic",
    .question = "How are the signs behind self-intersections found?",
    .oracle = "determinants of whole numbers",
    .axis = "wrong_pairs",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
