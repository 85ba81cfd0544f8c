/* How a preview finds what each sample sees: triangle by triangle or ray by ray. Which faces are seen is judged by rays
 * in 113 bits through a sample of pixels, from a camera that both know; the usual pictures must be the same as well. */
#include "tradeoff/face_picture.h"
#include "tradeoff/pixel_oracle.h"
#include "tradeoff/tradeoff.h"

#include <meshtool/preview.h>

#include <stdio.h>
#include <string.h>

#define SIZE 512
#define SAMPLES 4

static const char *const levels[] = {"raster", "ray", NULL};
static const mt_visibility_method methods[] = {MT_METHOD_RASTER, MT_METHOD_RAY};

typedef struct visibility_state {
    const mt_mesh *mesh;
    pixel_oracle oracle;
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
    return pixel_oracle_make(context, s->mesh, subject->diagonal, &s->oracle);
}

static void release(void *state, mt_context *context)
{
    visibility_state *s = state;
    pixel_oracle_release(context, &s->oracle);
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

/* Pixels in which the usual picture is not the other method's. */
static mt_status count_differing(const visibility_state *s, size_t level, mt_context *context, size_t *differing)
{
    mt_image *other = NULL;
    mt_status status = draw(context, s->mesh, methods[!level], &other);
    size_t channel_count = s->picture->channel_count, size = channel_count * sizeof(float);
    for (size_t i = 0; status == MT_OK && i < (size_t)SIZE * SIZE; i++) {
        const float *a = s->picture->pixels + i * channel_count, *b = other->pixels + i * channel_count;
        *differing += memcmp(a, b, size) != 0;
    }
    mt_image_destroy(context, other);
    return status;
}

static void copy(mt_vec3 v, double out[3])
{
    out[0] = v.x, out[1] = v.y, out[2] = v.z;
}

/* Pixels of the oracle's sample that show another face than its ray meets. */
static mt_status count_wrong(const visibility_state *s, size_t level, mt_context *context, size_t *judged,
                             size_t *wrong)
{
    const pixel_oracle *oracle = &s->oracle;
    mt_preview_options options = {.width = PIXEL_ORACLE_SIZE, .height = PIXEL_ORACLE_SIZE, .method = methods[level]};
    options.has_eye = options.has_target = options.has_up = true;
    options.fov_degrees = PIXEL_ORACLE_DEGREES;
    copy(oracle->eye, options.eye);
    copy(oracle->target, options.target);
    copy(oracle->up, options.up);
    mt_index *faces = mt_allocate_array(context, (uint64_t)PIXEL_ORACLE_SIZE * PIXEL_ORACLE_SIZE, sizeof *faces);
    if (!faces) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_status status = oracle->count > 0 ? face_picture_draw(context, s->mesh, &options, faces) : MT_OK;
    for (size_t i = 0; status == MT_OK && i < oracle->count; i++) {
        *judged += oracle->is_clear[i];
        *wrong += oracle->is_clear[i] && faces[oracle->pixels[i]] != oracle->faces[i];
    }
    mt_free(context, faces);
    return status;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    const visibility_state *s = state;
    size_t differing = 0, judged = 0, wrong = 0, hits = 0;
    mt_status status = count_differing(s, level, context, &differing);
    if (status == MT_OK) {
        status = count_wrong(s, level, context, &judged, &wrong);
    }
    for (size_t i = 0; i < s->oracle.count; i++) {
        hits += s->oracle.is_clear[i] && s->oracle.faces[i] != MT_NONE;
    }
    tradeoff_add_error(row, "wrong_pixels", judged > 0 ? (double)wrong : (double)NAN);
    tradeoff_add_error(row, "differing_pixels", (double)differing);
    tradeoff_add_size(row, "judged_pixels", (double)judged);
    row->is_defect = differing > 0 || wrong > 0;
    if (row->is_defect) {
        snprintf(row->says, sizeof row->says,
                 "%zu of %zu pixels do not show what a ray meets, and %zu differ from the other's: a defect", wrong,
                 judged, differing);
    } else if (judged == 0) {
        snprintf(row->says, sizeof row->says, "no pixel could be judged; the pictures of both are the same");
    } else {
        snprintf(row->says, sizeof row->says,
                 "nothing: %zu pixels show what a ray meets, %zu of them a face; the pictures of both are the same",
                 judged, hits);
    }
    return status;
}

const tradeoff_knob tradeoff_visibility = {
    .name = "visibility",
    .question = "Does a picture go triangle by triangle or ray by ray?",
    .oracle = "rays in 113-bit arithmetic; each other",
    .axis = "wrong_pixels",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
