#include <meshtool/bayer.h>

#define ROW_GRAIN 16

typedef struct bayer_task {
    const mt_image *from;
    mt_image *to;
    mt_bayer pattern;
} bayer_task;

static void mosaic_rows(void *user, uint64_t begin, uint64_t end)
{
    const bayer_task *task = user;
    uint32_t channels = task->from->channel_count;
    for (uint32_t y = (uint32_t)begin; y < end; y++) {
        const float *from = mt_image_pixel(task->from, 0, y);
        float *to = mt_image_pixel(task->to, 0, y);
        for (uint32_t x = 0; x < task->to->width; x++, from += channels) {
            to[x] = channels == 1 ? from[0] : from[mt_bayer_channel(task->pattern, x, y)];
        }
    }
}

/* Sums of the samples of each colour among the pixel and its neighbours, row by row, but a colour of the pixel's own.
 */
static void demosaic_pixel(const bayer_task *task, uint32_t x, uint32_t y, float *pixel)
{
    const mt_image *from = task->from;
    uint32_t own = mt_bayer_channel(task->pattern, x, y);
    uint32_t left = x > 0 ? x - 1 : 0, right = x + 1 < from->width ? x + 1 : x;
    uint32_t top = y > 0 ? y - 1 : 0, bottom = y + 1 < from->height ? y + 1 : y;
    double sums[3] = {0, 0, 0};
    unsigned counts[3] = {0, 0, 0};
    for (uint32_t v = top; v <= bottom; v++) {
        for (uint32_t u = left; u <= right; u++) {
            uint32_t channel = mt_bayer_channel(task->pattern, u, v);
            sums[channel] += (double)*mt_image_pixel(from, u, v);
            counts[channel]++;
        }
    }
    for (uint32_t k = 0; k < 3; k++) {
        pixel[k] = counts[k] ? (float)(sums[k] / counts[k]) : 0.0F;
    }
    pixel[own] = *mt_image_pixel(from, x, y);
}

static void demosaic_rows(void *user, uint64_t begin, uint64_t end)
{
    const bayer_task *task = user;
    for (uint32_t y = (uint32_t)begin; y < end; y++) {
        float *pixel = mt_image_pixel(task->to, 0, y);
        for (uint32_t x = 0; x < task->to->width; x++, pixel += 3) {
            demosaic_pixel(task, x, y, pixel);
        }
    }
}

static mt_status run(mt_context *context, const mt_image *image, mt_bayer pattern, uint32_t channel_count,
                     mt_parallel_body body, mt_image **out)
{
    mt_status status = mt_image_create_unfilled(context, image->width, image->height, channel_count, out);
    if (status == MT_OK) {
        bayer_task task = {image, *out, pattern};
        (*out)->space = image->space;
        mt_parallel_for(context, image->height, ROW_GRAIN, body, &task);
    }
    return status;
}

mt_status mt_bayer_mosaic(mt_context *context, const mt_image *image, mt_bayer pattern, mt_image **out)
{
    *out = NULL;
    if (image->channel_count == 4) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "a Bayer filter has no alpha: drop it, or lay the picture over a background first");
    }
    return run(context, image, pattern, 1, mosaic_rows, out);
}

mt_status mt_bayer_demosaic(mt_context *context, const mt_image *mosaic, mt_bayer pattern, mt_image **out)
{
    *out = NULL;
    if (mosaic->channel_count != 1) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "demosaicing takes one channel of samples, and this picture has %u channels",
                       mosaic->channel_count);
    }
    return run(context, mosaic, pattern, 3, demosaic_rows, out);
}
