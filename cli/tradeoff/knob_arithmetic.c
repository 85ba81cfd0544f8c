/* How the signs behind a manifold check are found: of self-intersections, of faces without an area, and of volumes.
 * What is right is decided by determinants of whole numbers, for every face of a small mesh, for a sample of the faces
 * of a large one. */
#include "tradeoff/pair_oracle.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/manifold.h>

#include <stdio.h>

static const char *const levels[] = {"floating", "adaptive", "exact", NULL};
static const mt_arithmetic arithmetics[] = {MT_ARITHMETIC_FLOATING, MT_ARITHMETIC_ADAPTIVE, MT_ARITHMETIC_EXACT};

enum { PAIRS, FLAT_FACES, INSIDE_OUT, VERDICT_COUNT };

/* What is judged: each a list of pairs of faces, or of faces. */
static const struct {
    mt_defect_kind kind;
    mt_status (*make_oracle)(mt_context *context, const mt_mesh *mesh, pair_oracle *out);
    const char *wrong, *found;
} verdicts[VERDICT_COUNT] = {
    [PAIRS] = {MT_DEFECT_SELF_INTERSECTION, pair_oracle_make, "wrong_pairs", "pairs"},
    [FLAT_FACES] = {MT_DEFECT_ZERO_AREA_FACE, area_oracle_make, "wrong_faces", "flat_faces"},
    [INSIDE_OUT] = {MT_DEFECT_INSIDE_OUT_COMPONENT, volume_oracle_make, "wrong_volumes", "inside_out"},
};

typedef struct arithmetic_state {
    const mt_mesh *mesh;
    pair_oracle oracles[VERDICT_COUNT];
    mt_manifold_report found;
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
    mt_status status = MT_OK;
    for (int i = 0; status == MT_OK && i < VERDICT_COUNT; i++) {
        status = verdicts[i].make_oracle(context, s->mesh, &s->oracles[i]);
    }
    return status;
}

static void release(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    for (int i = 0; i < VERDICT_COUNT; i++) {
        pair_oracle_release(context, &s->oracles[i]);
    }
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    arithmetic_state *s = state;
    const mt_manifold_options options = {.defects_per_kind = UINT64_MAX,
                                         .self_intersections = true,
                                         .inside_out = true,
                                         .arithmetic = arithmetics[level]};
    return mt_check_manifold(context, s->mesh, &options, &s->found);
}

static void discard(void *state, mt_context *context)
{
    arithmetic_state *s = state;
    mt_manifold_report_release(context, &s->found);
}

/* Of the verdicts on judged faces. */
typedef struct wrong_verdicts {
    uint64_t missed, made_up; /* not found though right, and found though not */
} wrong_verdicts;

static mt_face_pair pair_of(const mt_defect *defect)
{
    return (mt_face_pair){defect->faces[0], defect->faces[defect->face_count - 1]};
}

/* Both lists ascend. */
static wrong_verdicts compare(const pair_oracle *oracle, const mt_defect *found, uint64_t count)
{
    wrong_verdicts wrong = {0, 0};
    uint64_t i = 0, j = 0;
    while (i < oracle->pair_count || j < count) {
        mt_face_pair p = i < oracle->pair_count ? oracle->pairs[i] : (mt_face_pair){MT_NONE, MT_NONE};
        mt_face_pair q = j < count ? pair_of(&found[j]) : (mt_face_pair){MT_NONE, MT_NONE};
        bool before = p.a < q.a || (p.a == q.a && p.b < q.b);
        bool after = q.a < p.a || (q.a == p.a && q.b < p.b);
        wrong.missed += before;
        wrong.made_up += after && (oracle->is_judged[q.a] || oracle->is_judged[q.b]);
        i += !after;
        j += !before;
    }
    return wrong;
}

/* The report lists defects by kind. */
static wrong_verdicts judge_verdicts(const arithmetic_state *s, int verdict)
{
    size_t begin = 0;
    while (begin < s->found.defect_list_count && s->found.defects[begin].kind < verdicts[verdict].kind) {
        begin++;
    }
    return compare(&s->oracles[verdict], s->found.defects + begin, s->found.defect_counts[verdicts[verdict].kind]);
}

static void say_what_is_wrong(const wrong_verdicts wrong[VERDICT_COUNT], const char *sample, tradeoff_row *row)
{
    unsigned long long numbers[VERDICT_COUNT][2];
    for (int i = 0; i < VERDICT_COUNT; i++) {
        numbers[i][0] = wrong[i].missed, numbers[i][1] = wrong[i].made_up;
    }
    snprintf(row->says, sizeof row->says,
             "missed and made up: %llu and %llu pairs, %llu and %llu flat faces, %llu and %llu inside-out parts%s",
             numbers[PAIRS][0], numbers[PAIRS][1], numbers[FLAT_FACES][0], numbers[FLAT_FACES][1],
             numbers[INSIDE_OUT][0], numbers[INSIDE_OUT][1], sample);
}

static void say(const arithmetic_state *s, const wrong_verdicts wrong[VERDICT_COUNT], bool is_wrong, tradeoff_row *row)
{
    mt_index judged = s->oracles[PAIRS].judged_count, count = s->mesh->face_count;
    char sample[80] = "";
    if (judged < count) {
        snprintf(sample, sizeof sample, "; pairs are judged with %lu of %lu faces", (unsigned long)judged,
                 (unsigned long)count);
    }
    if (is_wrong) {
        say_what_is_wrong(wrong, sample, row);
    } else if (judged == 0) {
        snprintf(row->says, sizeof row->says, "pairs are not judged: the oracle has too many triangles to compare");
    } else {
        snprintf(row->says, sizeof row->says, "nothing on this mesh: %llu pairs, %llu flat faces, all right%s",
                 (unsigned long long)s->oracles[PAIRS].pair_count,
                 (unsigned long long)s->oracles[FLAT_FACES].pair_count, sample);
    }
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    const arithmetic_state *s = state;
    wrong_verdicts wrong[VERDICT_COUNT];
    uint64_t sum = 0;
    for (int i = 0; i < VERDICT_COUNT; i++) {
        wrong[i] = judge_verdicts(s, i);
        sum += wrong[i].missed + wrong[i].made_up;
    }
    tradeoff_add_error(row, "wrong", (double)sum);
    for (int i = 0; i < VERDICT_COUNT; i++) {
        bool is_judged = s->oracles[i].judged_count > 0;
        double count = (double)(wrong[i].missed + wrong[i].made_up);
        tradeoff_add_error(row, verdicts[i].wrong, is_judged ? count : (double)NAN);
    }
    for (int i = 0; i < VERDICT_COUNT; i++) {
        tradeoff_add_size(row, verdicts[i].found, (double)s->found.defect_counts[verdicts[i].kind]);
    }
    tradeoff_add_size(row, "judged_faces", (double)s->oracles[PAIRS].judged_count);
    row->is_defect = arithmetics[level] != MT_ARITHMETIC_FLOATING && sum > 0;
    say(s, wrong, sum > 0, row);
    return MT_OK;
}

const tradeoff_knob tradeoff_arithmetic = {
    .name = "arithmetic",
    .question = "How are the signs behind a manifold check found?",
    .oracle = "determinants of whole numbers",
    .axis = "wrong",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
