/* How a preview finds what each sample sees: triangle by triangle or ray by ray. The two find the same pictures, or one
 * of them is wrong. */
#include "tradeoff/tradeoff.h"

#include <meshtool/image.h>
#include <meshtool/preview.h>

#include <stdio.h>
#include <string.h>

#define SIZE 512
#define SAMPLES 4

static const char *const levels[] = {"raster", "ray", NULL};
static const mt_visibility_method methods[] = {MT_METHOD_RASTER, MT_METHOD_RAY};

typedef struct visibility_state {
    const mt_mesh *mesh;
    mt_image *reference; /* by the other method */
    mt_image *picture;
} visibility_state;

static mt_status draw(mt_context *context, const mt_mesh *mesh, mt_visibility_method method, mt_image **out)
{
    mt_preview_options options = {.width = SIZE, .height = SIZE, .samples = SAMPLES, .method = method};
    return mt_preview(context, mesh, &options, out);
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->face_count == 0) {
        *why = "the mesh has no faces for rays to meet";
        return MT_OK;
    }
    visibility_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    return draw(context, s->mesh, MT_METHOD_RASTER, &s->reference);
}

static void release(void *state, mt_context *context)
{
    visibility_state *s = state;
    mt_image_destroy(context, s->reference);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    visibility_state *s = state;
    return draw(context, s->mesh, methods[level], &s->picture);
}

static void discard(void *state, mt_context *context)
{
    visibility_state *s = state;
    mt_image_destroy(context, s->picture);
    s->picture = NULL;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    (void)level;
    const visibility_state *s = state;
    size_t differing = 0, size = s->picture->channel_count * sizeof(float);
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        const float *a = s->picture->pixels + (size_t)i * s->picture->channel_count;
        differing += memcmp(a, s->reference->pixels + (size_t)i * s->reference->channel_count, size) != 0;
    }
    tradeoff_add_error(row, "differing_pixels", (double)differing);
    row->is_defect = differing > 0;
    snprintf(row->says, sizeof row->says,
             differing ? "%zu pixels differ: a defect" : "nothing: the pictures are the same", differing);
    return MT_OK;
}

const tradeoff_knob tradeoff_visibility = {
    .name = "visibility",
    .question = "Does a picture go triangle by triangle or ray by ray?",
    .oracle = "each other",
    .axis = "differing_pixels",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
