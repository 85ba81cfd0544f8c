/* Draco under a context: its memory is held against the limit, its failures become sentences with a place. */
#ifndef MESHTOOL_CODEC_DRACO_JOB_H
#define MESHTOOL_CODEC_DRACO_JOB_H

#include "formats/codec/draco.h"

#include <meshtool/context.h>

/* A decoded stream, and the bytes held for it. */
typedef struct mt_draco_job {
    mt_context *context;
    uint64_t held;
    mt_draco_mesh *mesh;
    size_t consumed; /* bytes of the stream */
} mt_draco_job;

/* Decodes; close the job in any case. `where` begins the sentence of a failure: "" or "bufferViews[3]: ". */
mt_status mt_draco_job_decode(mt_context *context, mt_place place, const char *where, const void *bytes, size_t size,
                              mt_draco_job *out);
void mt_draco_job_close(mt_draco_job *job);

/* Encodes; out->bytes is freed with mt_free. */
mt_status mt_draco_job_encode(mt_context *context, const mt_draco_source *source, mt_draco_bytes *out);

#endif
