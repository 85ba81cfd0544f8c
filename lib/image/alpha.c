#include <meshtool/alpha.h>

#define ROW_GRAIN 16

typedef struct multiply_task {
    const mt_image *image;
    bool is_inverse;
} multiply_task;

static void multiply_rows(void *user, uint64_t begin, uint64_t end)
{
    const multiply_task *task = user;
    float *pixel = mt_image_pixel(task->image, 0, (uint32_t)begin);
    for (uint64_t count = (end - begin) * task->image->width; count > 0; count--, pixel += 4) {
        double alpha = (double)pixel[3];
        for (int k = 0; k < 3; k++) {
            double color = (double)pixel[k];
            pixel[k] = (float)(!task->is_inverse ? color * alpha : alpha != 0.0 ? color / alpha : 0.0);
        }
    }
}

static void multiply(mt_context *context, mt_image *image, bool is_inverse)
{
    multiply_task task = {image, is_inverse};
    mt_parallel_for(context, image->height, ROW_GRAIN, multiply_rows, &task);
    image->is_premultiplied = !is_inverse;
}

mt_status mt_image_premultiply(mt_context *context, mt_image *image)
{
    if (image->channel_count == 4 && !image->is_premultiplied) {
        multiply(context, image, false);
    }
    return MT_OK;
}

mt_status mt_image_unpremultiply(mt_context *context, mt_image *image)
{
    if (image->channel_count == 4) {
        multiply(context, image, true);
    }
    return MT_OK;
}

/* A pixel of any picture with its colour multiplied by alpha. */
typedef struct premultiplied {
    double color[3], alpha;
} premultiplied;

static premultiplied load(const mt_image *image, const float *pixel)
{
    uint32_t channels = image->channel_count;
    double alpha = channels == 4 ? (double)pixel[3] : 1.0;
    double factor = image->is_premultiplied ? 1.0 : alpha;
    premultiplied loaded = {.alpha = alpha};
    for (uint32_t k = 0; k < 3; k++) {
        loaded.color[k] = (double)pixel[channels == 1 ? 0 : k] * factor;
    }
    return loaded;
}

typedef struct over_task {
    const mt_image *front, *back; /* back NULL: the color */
    const double *color;
    mt_image *to;
} over_task;

static void store(const premultiplied *pixel, const mt_image *to, float *out)
{
    bool has_alpha = to->channel_count == 4;
    for (uint32_t k = 0; k < (to->channel_count == 1 ? 1u : 3u); k++) {
        double color = pixel->color[k];
        out[k] = (float)(!has_alpha ? color : pixel->alpha != 0.0 ? color / pixel->alpha : 0.0);
    }
    if (has_alpha) {
        out[3] = (float)pixel->alpha;
    }
}

static void over_rows(void *user, uint64_t begin, uint64_t end)
{
    const over_task *task = user;
    const float *front = mt_image_pixel(task->front, 0, (uint32_t)begin);
    const float *back = task->back ? mt_image_pixel(task->back, 0, (uint32_t)begin) : NULL;
    float *out = mt_image_pixel(task->to, 0, (uint32_t)begin);
    premultiplied under = {.alpha = 1.0};
    for (uint32_t k = 0; k < 3 && task->color; k++) {
        under.color[k] = task->color[k];
    }
    for (uint64_t count = (end - begin) * task->front->width; count > 0; count--) {
        premultiplied pixel = load(task->front, front);
        if (task->back) {
            under = load(task->back, back);
            back += task->back->channel_count;
        }
        double rest = 1.0 - pixel.alpha;
        for (uint32_t k = 0; k < 3; k++) {
            pixel.color[k] += under.color[k] * rest;
        }
        pixel.alpha += under.alpha * rest;
        store(&pixel, task->to, out);
        front += task->front->channel_count;
        out += task->to->channel_count;
    }
}

static mt_status lay_over(mt_context *context, over_task *task, uint32_t channel_count, mt_image **out)
{
    const mt_image *front = task->front;
    mt_status status = mt_image_create_unfilled(context, front->width, front->height, channel_count, out);
    if (status == MT_OK) {
        task->to = *out;
        (*out)->space = front->space;
        mt_parallel_for(context, front->height, ROW_GRAIN, over_rows, task);
    }
    return status;
}

mt_status mt_image_over_color(mt_context *context, const mt_image *image, const double color[3], mt_image **out)
{
    over_task task = {.front = image, .color = color};
    return lay_over(context, &task, image->channel_count == 1 ? 1 : 3, out);
}

mt_status mt_image_over(mt_context *context, const mt_image *image, const mt_image *background, mt_image **out)
{
    *out = NULL;
    if (image->width != background->width || image->height != background->height) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "the picture has %u x %u pixels and its background %u x %u, expected the same", image->width,
                       image->height, background->width, background->height);
    }
    if (image->space != background->space) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED, "the picture and its background must both be linear, or neither");
    }
    over_task task = {.front = image, .back = background};
    uint32_t colors = image->channel_count == 1 && background->channel_count == 1 ? 1 : 3;
    return lay_over(context, &task, background->channel_count == 4 ? 4 : colors, out);
}

/* Copies with other channels: colours repeated or left out, alpha 1 where there was none. */
static mt_status copy_with(mt_context *context, const mt_image *image, uint32_t channel_count, mt_image **out)
{
    mt_status status = mt_image_create_unfilled(context, image->width, image->height, channel_count, out);
    if (status != MT_OK) {
        return status;
    }
    const float *from = image->pixels;
    float *to = (*out)->pixels;
    uint32_t channels = image->channel_count;
    for (uint64_t count = (uint64_t)image->width * image->height; count > 0; count--, from += channels) {
        for (uint32_t k = 0; k < channel_count; k++) {
            *to++ = k == 3 && channels != 4 ? 1.0F : channels == 1 ? from[0] : from[k];
        }
    }
    (*out)->space = image->space;
    (*out)->is_premultiplied = image->is_premultiplied && channel_count == 4;
    return MT_OK;
}

mt_status mt_image_drop_alpha(mt_context *context, const mt_image *image, mt_image **out)
{
    return copy_with(context, image, image->channel_count == 4 ? 3 : image->channel_count, out);
}

mt_status mt_image_add_alpha(mt_context *context, const mt_image *image, mt_image **out)
{
    return copy_with(context, image, 4, out);
}
