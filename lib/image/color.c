#include <meshtool/color.h>

#include <math.h>
#include <string.h>

#define ROW_GRAIN 16

/* Changes one colour; `amount` is the operation's. */
typedef void (*color_function)(double color[3], double amount);

typedef struct color_task {
    const mt_image *image;
    color_function change;
    double amount;
} color_task;

static void change_rows(void *user, uint64_t begin, uint64_t end)
{
    const color_task *task = user;
    uint32_t channels = task->image->channel_count;
    float *pixel = mt_image_pixel(task->image, 0, (uint32_t)begin);
    for (uint64_t count = (end - begin) * task->image->width; count > 0; count--, pixel += channels) {
        double color[3] = {(double)pixel[0], (double)pixel[1], (double)pixel[2]};
        task->change(color, task->amount);
        for (int k = 0; k < 3; k++) {
            pixel[k] = (float)color[k];
        }
    }
}

static mt_status change_colors(mt_context *context, mt_image *image, color_function change, double amount)
{
    if (image->channel_count == 1) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED, "a grey picture has no hue, saturation and value");
    }
    color_task task = {image, change, amount};
    mt_parallel_for(context, image->height, ROW_GRAIN, change_rows, &task);
    return MT_OK;
}

static void to_hsv(double color[3], double amount)
{
    (void)amount;
    double hsv[3];
    mt_rgb_to_hsv(color, hsv);
    hsv[0] = (float)hsv[0] < 360.0F ? hsv[0] : 0.0; /* the float nearest to it may be 360 */
    memcpy(color, hsv, sizeof hsv);
}

static void to_rgb(double color[3], double amount)
{
    (void)amount;
    double rgb[3];
    mt_hsv_to_rgb(color, rgb);
    memcpy(color, rgb, sizeof rgb);
}

static void desaturate(double color[3], double factor)
{
    double hsv[3];
    mt_rgb_to_hsv(color, hsv);
    hsv[1] *= 1.0 - factor;
    mt_hsv_to_rgb(hsv, color);
}

static void shift_hue(double color[3], double degrees)
{
    double hsv[3];
    mt_rgb_to_hsv(color, hsv);
    hsv[0] += degrees;
    mt_hsv_to_rgb(hsv, color);
}

mt_status mt_image_rgb_to_hsv(mt_context *context, mt_image *image)
{
    return change_colors(context, image, to_hsv, 0.0);
}

mt_status mt_image_hsv_to_rgb(mt_context *context, mt_image *image)
{
    return change_colors(context, image, to_rgb, 0.0);
}

mt_status mt_image_desaturate(mt_context *context, mt_image *image, double factor)
{
    if (!(factor >= 0.0 && factor <= 1.0)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture is desaturated by a factor from 0 to 1, not %g", factor);
    }
    return image->channel_count == 1 ? MT_OK : change_colors(context, image, desaturate, factor);
}

mt_status mt_image_shift_hue(mt_context *context, mt_image *image, double degrees)
{
    if (!isfinite(degrees)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "hues are shifted by a finite number of degrees");
    }
    return image->channel_count == 1 ? MT_OK : change_colors(context, image, shift_hue, fmod(degrees, 360.0));
}

typedef struct luminance_task {
    const mt_image *from;
    mt_image *to;
} luminance_task;

static void luminance_rows(void *user, uint64_t begin, uint64_t end)
{
    const luminance_task *task = user;
    const float *from = mt_image_pixel(task->from, 0, (uint32_t)begin);
    float *to = mt_image_pixel(task->to, 0, (uint32_t)begin);
    uint32_t channels = task->from->channel_count;
    for (uint64_t count = (end - begin) * task->from->width; count > 0; count--, from += channels) {
        double light = channels == 1 ? (double)from[0]
                                     : 0.2126 * (double)from[0] + 0.7152 * (double)from[1] + 0.0722 * (double)from[2];
        for (uint32_t k = 0; k < (channels == 4 ? 3u : 1u); k++) {
            *to++ = (float)light;
        }
        if (channels == 4) {
            *to++ = from[3];
        }
    }
}

mt_status mt_image_luminance(mt_context *context, const mt_image *image, mt_image **out)
{
    uint32_t channels = image->channel_count == 4 ? 4 : 1;
    mt_status status = mt_image_create_unfilled(context, image->width, image->height, channels, out);
    if (status == MT_OK) {
        luminance_task task = {image, *out};
        (*out)->space = image->space;
        (*out)->is_premultiplied = image->is_premultiplied;
        mt_parallel_for(context, image->height, ROW_GRAIN, luminance_rows, &task);
    }
    return status;
}

typedef struct curve_task {
    const mt_image *image;
    double (*curve)(double number);
} curve_task;

static void curve_rows(void *user, uint64_t begin, uint64_t end)
{
    const curve_task *task = user;
    uint32_t channels = task->image->channel_count, colors = channels == 1 ? 1 : 3;
    float *pixel = mt_image_pixel(task->image, 0, (uint32_t)begin);
    for (uint64_t count = (end - begin) * task->image->width; count > 0; count--, pixel += channels) {
        for (uint32_t k = 0; k < colors; k++) {
            pixel[k] = (float)task->curve((double)pixel[k]);
        }
    }
}

mt_status mt_image_to_linear(mt_context *context, mt_image *image)
{
    if (image->space != MT_COLOR_LINEAR) {
        curve_task task = {image, mt_srgb_decode};
        mt_parallel_for(context, image->height, ROW_GRAIN, curve_rows, &task);
        image->space = MT_COLOR_LINEAR;
    }
    return MT_OK;
}

mt_status mt_image_to_srgb(mt_context *context, mt_image *image)
{
    curve_task task = {image, mt_srgb_encode};
    mt_parallel_for(context, image->height, ROW_GRAIN, curve_rows, &task);
    image->space = MT_COLOR_STORED;
    return MT_OK;
}
