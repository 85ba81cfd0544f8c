/* Primitives by name, from one table. */
#ifndef MESHTOOL_GENERATE_H
#define MESHTOOL_GENERATE_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* All zeros means each kind's own defaults. */
typedef struct mt_generate_options {
    mt_index resolution;   /* segments, level or sides; what it means stands in the kind's record */
    mt_type position_type; /* 0 or MT_F64: doubles; MT_F32 */
    double magnitude;      /* size of an extreme; 0: its default */
} mt_generate_options;

typedef struct mt_primitive {
    const char *name;               /* "cube" */
    const char *summary;            /* one line for help */
    mt_index resolution;            /* the default; 0: takes none */
    const char *resolution_meaning; /* NULL when it takes none */
} mt_primitive;

/* The table; *count receives its length. */
const mt_primitive *mt_primitives(size_t *count);

/* Makes the primitive `name`. MT_ERROR_ARGUMENT for an unknown name or a resolution out of range. */
mt_status mt_generate(mt_context *context, const char *name, const mt_generate_options *options, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
