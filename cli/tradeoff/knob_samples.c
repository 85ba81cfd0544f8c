/* How many samples a pixel of a preview takes, beside 1024: the same picture drawn four times as wide and high with 64
 * samples each, averaged in linear light. */
#include "tradeoff/tradeoff.h"

#include <meshtool/elementary.h>
#include <meshtool/image.h>
#include <meshtool/preview.h>

#include <math.h>
#include <stdio.h>

#define SIZE 256
#define FACTOR 4

/* Side of the squares over which pictures are compared as the eye does (Wang and others, "Image Quality Assessment:
 * From Error Visibility to Structural Similarity", IEEE TIP 13, 2004), and its two constants. */
#define WINDOW 8
#define FIRST_CONSTANT (0.01 * 0.01)
#define SECOND_CONSTANT (0.03 * 0.03)

static const char *const levels[] = {"1", "4", "9", "16", "25", "64", "adaptive", NULL};
static const unsigned counts[] = {1, 4, 9, 16, 25, 64, MT_SAMPLES_ADAPTIVE};

typedef struct sample_state {
    const mt_mesh *mesh;
    mt_image *reference; /* stored values, as files hold them */
    mt_image *picture;
    mt_preview_report report;
    mt_index hidden_count; /* faces that no sample of the reference sees */
} sample_state;

static mt_status draw(mt_context *context, const mt_mesh *mesh, uint32_t size, unsigned samples, mt_image **out,
                      mt_preview_report *report)
{
    mt_preview_options options = {.width = size, .height = size, .samples = samples, .count_unseen = true};
    return mt_preview_reported(context, mesh, &options, out, report);
}

/* The mean of FACTOR x FACTOR pixels, encoded. */
static void average(const mt_image *large, mt_image *small)
{
    for (uint32_t y = 0; y < small->height; y++) {
        for (uint32_t x = 0; x < small->width; x++) {
            for (uint32_t channel = 0; channel < 3; channel++) {
                double sum = 0;
                for (uint32_t i = 0; i < FACTOR * FACTOR; i++) {
                    sum += (double)mt_image_pixel(large, FACTOR * x + i % FACTOR, FACTOR * y + i / FACTOR)[channel];
                }
                mt_image_pixel(small, x, y)[channel] = (float)mt_srgb_encode(sum / (FACTOR * FACTOR));
            }
        }
    }
}

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->vertex_count == 0) {
        *why = "there is nothing to draw";
        return MT_OK;
    }
    sample_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    mt_image *large = NULL;
    mt_status status = draw(context, s->mesh, FACTOR * SIZE, 64, &large, &s->report);
    s->hidden_count = s->report.unseen_faces;
    if (status == MT_OK) {
        status = mt_image_create(context, SIZE, SIZE, 3, &s->reference);
    }
    if (status == MT_OK) {
        average(large, s->reference);
    }
    mt_image_destroy(context, large);
    return status;
}

static void release(void *state, mt_context *context)
{
    sample_state *s = state;
    mt_image_destroy(context, s->reference);
    mt_free(context, s);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    sample_state *s = state;
    return draw(context, s->mesh, SIZE, counts[level], &s->picture, &s->report);
}

static void discard(void *state, mt_context *context)
{
    sample_state *s = state;
    mt_image_destroy(context, s->picture);
    s->picture = NULL;
}

static double luminance(const float *pixel)
{
    return 0.2126 * (double)pixel[0] + 0.7152 * (double)pixel[1] + 0.0722 * (double)pixel[2];
}

/* Sums over one square of both pictures. */
static double similarity(const mt_image *a, const mt_image *b, uint32_t left, uint32_t top)
{
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0, n = WINDOW * WINDOW;
    for (uint32_t i = 0; i < WINDOW * WINDOW; i++) {
        double p = luminance(mt_image_pixel(a, left + i % WINDOW, top + i / WINDOW));
        double q = luminance(mt_image_pixel(b, left + i % WINDOW, top + i / WINDOW));
        sum_a += p, sum_b += q;
        sum_aa += p * p, sum_bb += q * q, sum_ab += p * q;
    }
    double mean_a = sum_a / n, mean_b = sum_b / n, shared = sum_ab / n - mean_a * mean_b;
    double spread = sum_aa / n - mean_a * mean_a + sum_bb / n - mean_b * mean_b;
    double means = 2 * mean_a * mean_b + FIRST_CONSTANT, squares = mean_a * mean_a + mean_b * mean_b + FIRST_CONSTANT;
    return means * (2 * shared + SECOND_CONSTANT) / (squares * (spread + SECOND_CONSTANT));
}

/* 0 for equal pictures. */
static double structural_difference(const mt_image *a, const mt_image *b)
{
    double sum = 0, count = 0;
    for (uint32_t y = 0; y + WINDOW <= SIZE; y += WINDOW / 2) {
        for (uint32_t x = 0; x + WINDOW <= SIZE; x += WINDOW / 2) {
            sum += similarity(a, b, x, y);
            count++;
        }
    }
    return 0.5 * (1 - sum / count);
}

static double root_mean_square(const mt_image *a, const mt_image *b)
{
    double sum = 0;
    size_t count = (size_t)SIZE * SIZE * 3;
    for (size_t i = 0; i < count; i++) {
        double difference = (double)a->pixels[i] - (double)b->pixels[i];
        sum += difference * difference;
    }
    return sqrt(sum / (double)count);
}

static double decibels(double x)
{
    return -20 * mt_log(x) / 2.30258509299404568402;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    (void)context;
    (void)level;
    sample_state *s = state;
    for (size_t i = 0; i < (size_t)SIZE * SIZE * 3; i++) {
        s->picture->pixels[i] = (float)mt_srgb_encode((double)s->picture->pixels[i]);
    }
    double rms = root_mean_square(s->picture, s->reference);
    tradeoff_add_error(row, "rmse", rms);
    tradeoff_add_error(row, "dssim", structural_difference(s->picture, s->reference));
    tradeoff_add_size(row, "psnr", rms > 0 ? decibels(rms) : INFINITY);
    mt_index unseen = s->report.unseen_faces, hidden = s->hidden_count;
    double lost = unseen > hidden ? (double)(unseen - hidden) : 0;
    tradeoff_add_error(row, "lost_faces", lost);
    snprintf(row->says, sizeof row->says, "%.2g of 255 steps off on average; %.0f faces fall between the samples",
             255 * rms, lost);
    return MT_OK;
}

const tradeoff_knob tradeoff_samples = {
    .name = "samples",
    .question = "How many samples a pixel does a picture take?",
    .oracle = "1024 samples a pixel",
    .axis = "rmse",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
