/* libjpeg leaves by a jump when something is wrong: where to, and what to say. The jump never crosses this library's
 * callers: each function that calls libjpeg sets the place to return to itself. */
#ifndef MESHTOOL_FORMATS_IMAGE_JPEG_ERRORS_H
#define MESHTOOL_FORMATS_IMAGE_JPEG_ERRORS_H

#include <meshtool/context.h>

#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

typedef struct mt_jpeg_errors {
    struct jpeg_error_mgr manager; /* first: libjpeg knows this part */
    jmp_buf place;
    mt_status status; /* of our own input or output, when that was the cause */
    char message[JMSG_LENGTH_MAX];
} mt_jpeg_errors;

/* Silences libjpeg, and makes its errors jump to errors->place. */
struct jpeg_error_mgr *mt_jpeg_errors_init(mt_jpeg_errors *errors);

/* Leaves for errors->place with a failure of our own, already recorded. */
void mt_jpeg_leave(mt_jpeg_errors *errors, mt_status status);

#endif
