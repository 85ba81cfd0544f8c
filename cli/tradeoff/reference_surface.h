/* Catmull-Clark in 113 bits from the published rules, by accumulation over a sorted list of edges: for judging the
 * library's, with which it shares no code. */
#ifndef MESHTOOL_CLI_TRADEOFF_REFERENCE_SURFACE_H
#define MESHTOOL_CLI_TRADEOFF_REFERENCE_SURFACE_H

#include "tradeoff/quad.h"

#include <meshtool/mesh.h>

typedef struct reference_surface {
    uint32_t vertex_count, face_count, corner_count;
    quad3 *positions;
    uint32_t *offsets; /* face_count + 1 */
    uint32_t *corners;
} reference_surface;

/* A mesh's faces and positions; creases and all else are left out. */
mt_status reference_surface_make(mt_context *context, const mt_mesh *mesh, reference_surface *out);
void reference_surface_release(mt_context *context, reference_surface *surface);

/* One level, with vertices and faces in the library's order. The mesh must be manifold and oriented. */
mt_status reference_surface_refine(mt_context *context, const reference_surface *surface, reference_surface *out);

/* Moves all vertices of a surface of quads to where further levels would take them. */
mt_status reference_surface_to_limit(mt_context *context, reference_surface *surface);

/* The surface rounded to doubles. */
mt_status reference_surface_mesh(mt_context *context, const reference_surface *surface, mt_mesh **out);

/* The mesh with its positions and faces alone, in the precision asked for. */
mt_status tradeoff_bare_mesh(mt_context *context, const mt_mesh *mesh, mt_type type, mt_mesh **out);

#endif
