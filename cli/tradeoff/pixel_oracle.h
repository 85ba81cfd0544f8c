/* Which face a fixed sample of a picture's pixels shows, by a camera and rays of its own in 113 bits. */
#ifndef MESHTOOL_CLI_TRADEOFF_PIXEL_ORACLE_H
#define MESHTOOL_CLI_TRADEOFF_PIXEL_ORACLE_H

#include <meshtool/mesh.h>

/* Pixels on a side of the picture. */
#define PIXEL_ORACLE_SIZE 512

/* Of the camera: half of its field of view has the tangent 1. */
#define PIXEL_ORACLE_DEGREES 90

typedef struct pixel_oracle {
    mt_vec3 eye, target, up; /* of the camera, in the mesh's coordinates */
    size_t count;            /* of the sample; 0: the mesh has no extent to frame */
    uint32_t *pixels;        /* by rows from the top left corner */
    mt_index *faces;         /* seen at each pixel's middle, MT_NONE: none */
    unsigned char *is_clear; /* 0: too near to a side, or to a second surface, to tell; such a pixel is not judged */
} pixel_oracle;

/* `diagonal`: of the box around the mesh. `out` begins with zeros; released in every case. */
mt_status pixel_oracle_make(mt_context *context, const mt_mesh *mesh, double diagonal, pixel_oracle *out);
void pixel_oracle_release(mt_context *context, pixel_oracle *oracle);

#endif
