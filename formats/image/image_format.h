/* What the files of formats/image share: their records, and writing a picture band by band. */
#ifndef MESHTOOL_FORMATS_IMAGE_FORMAT_H
#define MESHTOOL_FORMATS_IMAGE_FORMAT_H

#include <meshtool/image_format.h>

#ifdef MESHTOOL_PNG
extern const mt_image_format mt_png_format;
#endif
extern const mt_image_format mt_ppm_format;
extern const mt_image_format mt_pgm_format;
extern const mt_image_format mt_pam_format;
extern const mt_image_format mt_pfm_format;

/* Takes some encoded rows, one after the other. */
typedef mt_status (*mt_rows_function)(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count);

/* Encodes the picture in bands of rows, so that no second picture is held, and hands each band on. */
mt_status mt_image_write_bands(mt_context *context, const mt_image *image, unsigned bits, mt_rows_function write,
                               void *user);

#endif
