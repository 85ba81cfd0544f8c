#include "tests/support/picture.h"

#include "formats/stream/output.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdlib.h>

mt_image *test_picture(mt_context *context, test_random *random, uint32_t width, uint32_t height,
                       uint32_t channel_count)
{
    mt_image *image = NULL;
    assert_int_equal(mt_image_create(context, width, height, channel_count, &image), MT_OK);
    for (size_t i = 0; i < (size_t)width * height * channel_count; i++) {
        image->pixels[i] = (float)test_random_unit(random);
    }
    return image;
}

unsigned char *test_picture_file(mt_context *context, const mt_image *image, const char *format, unsigned bits,
                                 size_t *size)
{
    const mt_image_format *found = mt_image_format_by_extension(format);
    assert_non_null(found);
    mt_output *output = NULL;
    assert_int_equal(mt_output_open_memory(context, &output), MT_OK);
    mt_image_write_options options = {.bits = bits};
    assert_int_equal(found->write(context, image, &options, output), MT_OK);
    void *bytes = NULL;
    assert_int_equal(mt_output_take(context, output, &bytes, size), MT_OK);
    return bytes;
}

double test_picture_coverage(const mt_image *image)
{
    assert_int_equal(image->channel_count, 4);
    size_t count = (size_t)image->width * image->height;
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += (double)image->pixels[4 * i + 3];
    }
    return sum / (double)count;
}

double test_picture_difference(const mt_image *a, const mt_image *b, double *mean)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_int_equal(a->channel_count, b->channel_count);
    size_t count = (size_t)a->width * a->height * a->channel_count;
    double largest = 0, sum = 0;
    for (size_t i = 0; i < count; i++) {
        double difference = fabs((double)a->pixels[i] - (double)b->pixels[i]);
        sum += difference;
        largest = difference > largest ? difference : largest;
    }
    *mean = sum / (double)count;
    return largest;
}

/* Vertex 0 at the top, then rings from the top down, then the bottom. */
mt_mesh *test_ball(mt_context *context, mt_index slices, mt_index stacks, double radius)
{
    mt_index rings = stacks - 1, vertex_count = slices * rings + 2, face_count = 2 * slices * rings;
    double *positions = malloc(3 * (size_t)vertex_count * sizeof *positions);
    mt_index *faces = malloc(4 * (size_t)face_count * sizeof *faces), *face = faces;
    assert_non_null(positions);
    assert_non_null(faces);
    const double pi = acos(-1.0);
    for (mt_index v = 0; v < vertex_count; v++) {
        double polar = v == 0 ? 0 : v == vertex_count - 1 ? pi : pi * ((v - 1) / slices + 1) / stacks;
        double turn = v == 0 ? 0 : 2 * pi * ((v - 1) % slices) / slices;
        positions[3 * v] = radius * sin(polar) * cos(turn);
        positions[3 * v + 1] = radius * cos(polar);
        positions[3 * v + 2] = radius * sin(polar) * sin(turn);
    }
    for (mt_index i = 0; i < slices; i++) {
        mt_index j = (i + 1) % slices, last = 1 + (rings - 1) * slices;
        *face++ = 3, *face++ = 0, *face++ = 1 + j, *face++ = 1 + i;
        for (mt_index ring = 0; ring + 1 < rings; ring++) {
            mt_index a = 1 + ring * slices, b = a + slices;
            *face++ = 3, *face++ = a + i, *face++ = a + j, *face++ = b + i;
            *face++ = 3, *face++ = a + j, *face++ = b + j, *face++ = b + i;
        }
        *face++ = 3, *face++ = vertex_count - 1, *face++ = last + i, *face++ = last + j;
    }
    mt_mesh *mesh = test_mesh(context, vertex_count, positions, face_count, faces);
    free(positions);
    free(faces);
    return mesh;
}
