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
    double magnitude;      /* of an extreme, with has_magnitude; primitives have none */
    bool has_magnitude;    /* false: the extreme's default */
} mt_generate_options;

/* One kind. Faces of closed, orientable kinds are counter-clockwise seen from outside; +Y is up. */
typedef struct mt_primitive {
    const char *name;               /* "cube" */
    const char *summary;            /* one line for help */
    const char *resolution_meaning; /* NULL when it takes none */
    mt_index resolution;            /* the default; 0: takes none */
    mt_index minimum, maximum;      /* of the resolution */
    /* Makes it in doubles, with a resolution within its range. */
    mt_status (*generate)(mt_context *context, mt_index resolution, mt_mesh **out);
} mt_primitive;

/* The table; *count receives its length. */
const mt_primitive *mt_primitives(size_t *count);

/* A mesh that breaks naive programs: what its magnitude stands for is made larger or smaller until they do. */
typedef struct mt_extreme {
    const char *name; /* "offset" */
    const char *summary;
    const char *meaning; /* of the magnitude */
    double magnitude;    /* the default */
    double minimum, maximum;
    bool is_whole; /* the magnitude is a count */
    mt_status (*generate)(mt_context *context, double magnitude, mt_mesh **out);
} mt_extreme;

/* The table; *count receives its length. */
const mt_extreme *mt_extremes(size_t *count);

/* Makes the primitive `name`, or the extreme "extreme:NAME". options may be NULL. MT_ERROR_ARGUMENT for an unknown
 * name, a resolution or magnitude out of range or one for a kind that takes none; MT_ERROR_TOO_LARGE and
 * MT_ERROR_OUT_OF_MEMORY as mt_mesh_create. */
mt_status mt_generate(mt_context *context, const char *name, const mt_generate_options *options, mt_mesh **out);

#ifdef __cplusplus
}
#endif
#endif
