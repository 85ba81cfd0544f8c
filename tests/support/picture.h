/* Small pictures for tests. */
#ifndef TESTS_SUPPORT_PICTURE_H
#define TESTS_SUPPORT_PICTURE_H

#include "tests/support/fixture.h"

#include <meshtool/image_format.h>

/* A picture of random values in [0, 1). */
mt_image *test_picture(mt_context *context, test_random *random, uint32_t width, uint32_t height,
                       uint32_t channel_count);

/* The bytes of a file of that format; fails the test when it cannot be written. Free with mt_free. */
unsigned char *test_picture_file(mt_context *context, const mt_image *image, const char *format, unsigned bits,
                                 size_t *size);

/* The share of the picture that is covered: the mean alpha of a picture with four channels. */
double test_picture_coverage(const mt_image *image);

/* The largest difference between two pictures of the same size, and the mean one. */
double test_picture_difference(const mt_image *a, const mt_image *b, double *mean);

/* A ball of 2 * slices * stacks triangles or so around the origin. */
mt_mesh *test_ball(mt_context *context, mt_index slices, mt_index stacks, double radius);

#endif
