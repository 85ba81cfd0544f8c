#include "tradeoff/face_picture.h"

#include <string.h>

typedef struct drawing {
    mt_preview_series *series; /* borrows the colours and reads them at each picture */
    unsigned char *colors;
    mt_index face_count;
    mt_image *black, *white, *bits;
} drawing;

/* Each channel of a face is one bit of its number. */
static void paint(drawing *d, unsigned first_bit)
{
    for (mt_index face = 0; face < d->face_count; face++) {
        for (unsigned channel = 0; channel < 3; channel++) {
            unsigned bit = first_bit + channel;
            d->colors[3 * (size_t)face + channel] = bit < 32 && (face >> bit & 1) ? 255 : 0;
        }
    }
}

static mt_status take(mt_context *context, const drawing *d, mt_image **out)
{
    mt_image_destroy(context, *out);
    return mt_preview_series_draw(context, d->series, MT_VIEW_DEFAULT, 0, out, NULL);
}

/* Light is added to what a colour reflects, so a bit is told by the same pixel in black and in white. */
static void read_bits(const drawing *d, unsigned first_bit, mt_index *faces)
{
    size_t count = (size_t)d->bits->width * d->bits->height;
    for (size_t pixel = 0; pixel < count; pixel++) {
        for (unsigned channel = 0; channel < 3 && faces[pixel] != MT_NONE; channel++) {
            size_t at = 4 * pixel + channel;
            float middle = 0.5F * (d->black->pixels[at] + d->white->pixels[at]);
            faces[pixel] |= d->bits->pixels[at] > middle ? (mt_index)1 << (first_bit + channel) : 0;
        }
    }
}

static mt_status draw_all(mt_context *context, drawing *d, mt_index *faces)
{
    memset(d->colors, 0, 3 * (size_t)d->face_count);
    mt_status status = take(context, d, &d->black);
    memset(d->colors, 255, 3 * (size_t)d->face_count);
    status = status == MT_OK ? take(context, d, &d->white) : status;
    for (size_t pixel = 0; status == MT_OK && pixel < (size_t)d->black->width * d->black->height; pixel++) {
        faces[pixel] = d->black->pixels[4 * pixel + 3] > 0.5F ? 0 : MT_NONE;
    }
    for (unsigned bit = 0; status == MT_OK && bit < 30 && (d->face_count - 1) >> bit; bit += 3) {
        paint(d, bit);
        status = take(context, d, &d->bits);
        if (status == MT_OK) {
            read_bits(d, bit, faces);
        }
    }
    return status;
}

mt_status face_picture_draw(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options,
                            mt_index *faces)
{
    mt_mesh bare = *mesh; /* lines and dots would lie over faces */
    bare.wire_count = bare.point_count = 0;
    drawing d = {.face_count = mesh->face_count};
    d.colors = mt_allocate_array(context, mesh->face_count, 3);
    if (!d.colors) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_preview_options own = *options;
    own.samples = 1;
    own.background = MT_BACKGROUND_TRANSPARENT;
    own.shading = MT_SHADING_FLAT;
    own.face_colors = d.colors;
    mt_status status = mt_preview_series_create(context, &bare, &own, &d.series);
    if (status == MT_OK) {
        status = draw_all(context, &d, faces);
    }
    mt_image_destroy(context, d.black);
    mt_image_destroy(context, d.white);
    mt_image_destroy(context, d.bits);
    mt_preview_series_destroy(context, d.series);
    mt_free(context, d.colors);
    return status;
}
