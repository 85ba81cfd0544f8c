/* How long strips are searched for. Whether they draw every triangle once is found by sorting triangles that are
 * read off the strips here. */
#include "tradeoff/tradeoff.h"

#include <meshtool/strips.h>
#include <meshtool/triangulate.h>

#include <stdio.h>
#include <stdlib.h>

static const char *const levels[] = {"fast", "thorough", NULL};

typedef struct triple {
    mt_index v[3];
} triple;

typedef struct strip_state {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    triple *sorted;
    mt_strips *strips;
} strip_state;

static int compare_triples(const void *left, const void *right)
{
    const triple *a = left, *b = right;
    for (int i = 0; i < 3; i++) {
        if (a->v[i] != b->v[i]) {
            return a->v[i] < b->v[i] ? -1 : 1;
        }
    }
    return 0;
}

/* The lowest vertex first, orientation kept. */
static triple turned(mt_index a, mt_index b, mt_index c)
{
    if (b < a && b <= c) {
        return (triple){{b, c, a}};
    }
    return c < a && c < b ? (triple){{c, a, b}} : (triple){{a, b, c}};
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces";
        return MT_OK;
    }
    strip_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    mt_status status = mt_triangulation_init(context, s->mesh, &s->triangulation);
    mt_index count = s->triangulation.triangle_count;
    s->sorted = status == MT_OK ? mt_allocate_array(context, count, sizeof *s->sorted) : NULL;
    if (!s->sorted) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < count; i++) {
        mt_index v[3];
        for (mt_index side = 0; side < 3; side++) {
            v[side] = s->mesh->corner_vertices[mt_triangulation_corner(&s->triangulation, i, side)];
        }
        s->sorted[i] = turned(v[0], v[1], v[2]);
    }
    qsort(s->sorted, count, sizeof *s->sorted, compare_triples);
    return MT_OK;
}

static void release(void *state, mt_context *context)
{
    strip_state *s = state;
    mt_free(context, s->sorted);
    mt_triangulation_release(context, &s->triangulation);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    strip_state *s = state;
    mt_strip_options options = {.thorough = level == 1};
    return mt_strips_create(context, s->mesh, &options, &s->strips);
}

static void discard(void *state, mt_context *context)
{
    strip_state *s = state;
    mt_strips_destroy(context, s->strips);
    s->strips = NULL;
}

/* What a strip draws, by its definition: every index after the second makes a triangle, each other one turned over;
 * those that name a vertex twice only serve to turn, unless they are the strip. Returns how many it wrote. */
static size_t draw(const mt_index *indices, size_t length, triple *drawn)
{
    size_t count = 0;
    for (size_t i = 2; i < length; i++) {
        mt_index a = indices[i - 2], b = indices[i - 1], c = indices[i];
        if ((a != b && b != c && c != a) || length == 3) {
            drawn[count++] = i % 2 == 0 ? turned(a, b, c) : turned(b, a, c);
        }
    }
    return count;
}

/* Triangles that strips draw too often or not at all. */
static size_t count_wrong(const strip_state *s, triple *scratch)
{
    size_t count = 0, total = s->triangulation.triangle_count, i = 0, j = 0;
    for (mt_index strip = 0; strip < s->strips->strip_count; strip++) {
        mt_index begin = s->strips->offsets[strip], end = s->strips->offsets[strip + 1];
        count += draw(s->strips->indices + begin, end - begin, scratch + count);
    }
    qsort(scratch, count, sizeof *scratch, compare_triples);
    size_t wrong = 0;
    while (i < total || j < count) {
        int order = i == total ? 1 : j == count ? -1 : compare_triples(&s->sorted[i], &scratch[j]);
        wrong += order != 0;
        i += order <= 0;
        j += order >= 0;
    }
    return wrong;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)level;
    const strip_state *s = state;
    triple *scratch = mt_allocate_array(context, s->strips->offsets[s->strips->strip_count], sizeof *scratch);
    if (scratch) {
        size_t wrong = count_wrong(s, scratch);
        double length = (double)mt_strips_index_count(s->strips) / (double)s->triangulation.triangle_count;
        tradeoff_add_error(row, "wrong_triangles", (double)wrong);
        tradeoff_add_size(row, "indices_per_triangle", length);
        tradeoff_add_size(row, "strips", s->strips->strip_count);
        row->is_defect = wrong > 0;
        snprintf(row->says, sizeof row->says, "%.3f indices a triangle, restarts counted; separate triangles take 3",
                 length);
    }
    mt_free(context, scratch);
    return scratch ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

const tradeoff_knob tradeoff_strips = {
    .name = "strips",
    .question = "How long are short strips searched for?",
    .oracle = "a sorted list of all triangles",
    .axis = "indices_per_triangle",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
