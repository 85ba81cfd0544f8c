/* Compression that readers and writers do not see: one record a kind, in the table that mt_codecs returns. */
#ifndef MESHTOOL_STREAM_CODEC_H
#define MESHTOOL_STREAM_CODEC_H

#include <meshtool/context.h>

typedef enum mt_codec_result {
    MT_CODEC_MORE,      /* went as far as the bytes and the room allow */
    MT_CODEC_END,       /* a member (gzip) or frame (zstd) ended; another may follow */
    MT_CODEC_DAMAGED,   /* the bytes break the rules */
    MT_CODEC_TOO_LARGE, /* they ask for a window past the limit */
    MT_CODEC_NO_MEMORY
} mt_codec_result;

/* What a step takes and fills; it moves the pointers past what was used, and shortens the sizes. */
typedef struct mt_codec_bytes {
    const uint8_t *in;
    size_t in_size;
    uint8_t *out;
    size_t out_size;
} mt_codec_bytes;

typedef struct mt_codec {
    const char *title;     /* "gzip" */
    const char *extension; /* "gz" */
    const char *library;   /* "zlib" */
    const char *tool;      /* "gunzip": what decompresses without us */
    bool zero_padding;     /* zeros may follow the last member, as on tapes */
    bool (*recognise)(const uint8_t *bytes, size_t size);
    /* NULL: built without the library. States are made with the context's memory; NULL: there was none, recorded. */
    void *(*create_expander)(mt_context *context);
    void (*destroy_expander)(void *state); /* NULL is allowed */
    /* *problem receives the library's words when the result is MT_CODEC_DAMAGED. */
    mt_codec_result (*expand)(void *state, mt_codec_bytes *bytes, const char **problem);
    void *(*create_packer)(mt_context *context);
    void (*destroy_packer)(void *state);
    /* MT_CODEC_END: all is written, with `finish` alone. The same bytes for the same input, whatever the pieces. */
    mt_codec_result (*pack)(void *state, mt_codec_bytes *bytes, bool finish);
} mt_codec;

/* The table, NULL-terminated. */
const mt_codec *const *mt_codecs(void);

/* The kind that these first bytes begin, or NULL. */
const mt_codec *mt_codec_of_content(const uint8_t *bytes, size_t size);
/* The kind that a path ends in (".gz"), any case, or NULL. */
const mt_codec *mt_codec_of_path(const char *path);

#define MT_CODEC_MAGIC 4 /* bytes that mt_codec_of_content wants to see */

/* Part of the codecs: memory for a library of C, from the context. */
void *mt_codec_allocate_array(void *context, unsigned count, unsigned size);
void *mt_codec_allocate(void *context, size_t size);
void mt_codec_free(void *context, void *block);

extern const mt_codec mt_gzip_codec;
extern const mt_codec mt_zstd_codec;

#endif
