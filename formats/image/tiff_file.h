/* A TIFF file for libtiff in memory: its bytes, and its messages kept instead of printed. */
#ifndef MESHTOOL_FORMATS_IMAGE_TIFF_FILE_H
#define MESHTOOL_FORMATS_IMAGE_TIFF_FILE_H

#include <meshtool/context.h>

#include <tiffio.h>

typedef struct mt_tiff_file {
    mt_context *context;
    uint8_t *bytes;
    uint64_t size, capacity; /* capacity 0: only to be read */
    uint64_t at;
    bool is_full;      /* no memory for what was to be written */
    bool is_short;     /* libtiff failed for want of memory, for which it has no code */
    char message[256]; /* libtiff's first error */
} mt_tiff_file;

/* mode: "r" or "w". The largest block that libtiff may allocate by itself is given. NULL: it says why in
 * file->message, or memory is missing. */
TIFF *mt_tiff_open(mt_tiff_file *file, const char *mode, uint64_t largest_block);

#endif
