/* What the files of formats/image share: their records, and writing a picture band by band. */
#ifndef MESHTOOL_FORMATS_IMAGE_FORMAT_H
#define MESHTOOL_FORMATS_IMAGE_FORMAT_H

#include <meshtool/image_format.h>

#ifdef MESHTOOL_PNG
extern const mt_image_format mt_png_format;
#endif
#ifdef MESHTOOL_JPEG
extern const mt_image_format mt_jpeg_format;
#endif
#ifdef MESHTOOL_TIFF
extern const mt_image_format mt_tiff_format;
#endif
extern const mt_image_format mt_pbm_format;
extern const mt_image_format mt_ppm_format;
extern const mt_image_format mt_pgm_format;
extern const mt_image_format mt_pam_format;
extern const mt_image_format mt_pfm_format;

/* The readers, each as a record's `read`, and how sure they are of first bytes. */
mt_status mt_png_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits);
int mt_png_sniff(const uint8_t *bytes, size_t size);
mt_status mt_jpeg_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits);
int mt_jpeg_sniff(const uint8_t *bytes, size_t size);
mt_status mt_tiff_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits);
int mt_tiff_sniff(const uint8_t *bytes, size_t size);
mt_status mt_netpbm_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits); /* P1 to P7 */
int mt_pbm_sniff(const uint8_t *bytes, size_t size);
int mt_pgm_sniff(const uint8_t *bytes, size_t size);
int mt_ppm_sniff(const uint8_t *bytes, size_t size);
int mt_pam_sniff(const uint8_t *bytes, size_t size);
mt_status mt_pfm_read(mt_context *context, mt_input *input, mt_image **out, unsigned *bits);
int mt_pfm_sniff(const uint8_t *bytes, size_t size);

/* The format to read the input with. `wanted` (may be NULL) is an extension that decides alone. A content that belies
 * the name is warned of, and wins. MT_ERROR_SYNTAX when neither tells, MT_ERROR_UNSUPPORTED when it was left out. */
mt_status mt_recognise_image(mt_context *context, mt_input *input, const char *wanted, const mt_image_format **out);

/* "PNG, with libspng" when the extension is of a format that this meshtool was built without, or NULL. */
const char *mt_image_format_left_out(const char *extension);

/* Takes some encoded rows, one after the other. */
typedef mt_status (*mt_rows_function)(mt_context *context, void *user, const unsigned char *bytes, uint32_t row_count);

/* Encodes the picture in bands of rows, so that no second picture is held, and hands each band on. */
mt_status mt_image_write_bands(mt_context *context, const mt_image *image, unsigned bits, mt_rows_function write,
                               void *user);

#endif
