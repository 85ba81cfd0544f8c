/* Image files: one table of formats. */
#ifndef MESHTOOL_IMAGE_FORMAT_H
#define MESHTOOL_IMAGE_FORMAT_H

#include <meshtool/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct mt_input mt_input;
typedef struct mt_output mt_output;

/* All zeros means the defaults. */
typedef struct mt_image_read_options {
    const char *format; /* an extension that overrides recognition by content; NULL: recognise */
} mt_image_read_options;

/* All zeros means the defaults. */
typedef struct mt_image_write_options {
    const char *format; /* an extension that overrides the path's; NULL: the path's, "png" for pipes */
    unsigned bits;      /* per channel, one of the format's; 0: 8 where it has them, else what it has */
    unsigned quality;   /* of JPEG, 1 to 100; 0: 90; other formats have none, and take 0 alone */
    bool no_clobber;
} mt_image_write_options;

typedef struct mt_image_format {
    const char *name;
    const char *title;
    const char *const *extensions; /* NULL-terminated, the first is preferred */
    bool holds_alpha;
    bool has_quality;
    unsigned bits[4]; /* of a channel, that may be written; 32 are floats; zeros follow the last */
    /* How sure the first bytes make it: 0 not this format, 100 certain. */
    int (*sniff)(const uint8_t *bytes, size_t size);
    /* *bits receives those of a sample in the file. On failure what *out holds is the caller's to destroy. */
    mt_status (*read)(mt_context *context, mt_input *input, mt_image **out, unsigned *bits);
    mt_status (*write)(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                       mt_output *output);
} mt_image_format;

/* The table, NULL-terminated. */
const mt_image_format *const *mt_image_formats(void);
const mt_image_format *mt_image_format_by_extension(const char *extension);

/* The format that a path's extension names for writing; "png" for "-", devices and pipes. NULL with
 * MT_ERROR_ARGUMENT recorded when it is unknown. */
const mt_image_format *mt_image_format_for_output(mt_context *context, const char *path,
                                                  const mt_image_write_options *options);

/* How many bits a channel are written; options may be NULL. MT_ERROR_ARGUMENT, which lists those that there are, when
 * the format has none of that size, and for a quality where it has none. */
mt_status mt_image_written_bits(mt_context *context, const mt_image_format *format,
                                const mt_image_write_options *options, unsigned *bits);

/* What a picture was read from. */
typedef struct mt_image_source {
    const mt_image_format *format;
    unsigned bits; /* of a sample in the file: 1 to 16 whole, 32 and 64 float */
} mt_image_source;

/* Reads a picture, MT_COLOR_STORED: whole samples as shares of the largest, floats as they are. Grey has one channel,
 * colour three, either with alpha four; palettes become colour, a transparent colour an alpha channel. The content is
 * recognised first, then the extension; .gz and .zst are read through. path "-" is standard input. source may be NULL.
 * MT_ERROR_SYNTAX with the place for what is damaged or incomplete, MT_ERROR_TOO_LARGE from 2^31 pixels on,
 * MT_ERROR_UNSUPPORTED for what is not read (CMYK). Nothing is allocated that the file's bytes cannot justify. */
mt_status mt_image_read_file(mt_context *context, const char *path, const mt_image_read_options *options,
                             mt_image **out, mt_image_source *source);

/* The same from memory; `name` stands in messages, and its extension may help recognition. */
mt_status mt_image_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                               const mt_image_read_options *options, mt_image **out, mt_image_source *source);

/* Writes a picture; linear pixels are sRGB-encoded where the format is (all but pfm). As mt_mesh_write_file:
 * beside its place, then renamed. */
mt_status mt_image_write_file(mt_context *context, const mt_image *image, const char *path,
                              const mt_image_write_options *options);

/* The same into memory, as options->format: *bytes is the caller's, freed with mt_free. */
mt_status mt_image_write_memory(mt_context *context, const mt_image *image, const mt_image_write_options *options,
                                void **bytes, size_t *size);

#ifdef __cplusplus
}
#endif
#endif
