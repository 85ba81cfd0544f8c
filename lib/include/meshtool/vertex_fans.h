/* How the faces around each vertex hang together. The faces incident to a vertex, joined across the edges at that
 * vertex that they share, form its fans; a manifold has one at every vertex. */
#ifndef MESHTOOL_VERTEX_FANS_H
#define MESHTOOL_VERTEX_FANS_H

#include <meshtool/edge_pairs.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_fan_class {
    MT_FANS_NONE, /* in no face: an isolated vertex */
    MT_FANS_ONE,
    MT_FANS_SEVERAL /* a non-manifold vertex */
} mt_fan_class;

typedef struct mt_vertex_fans {
    mt_index vertex_count;
    mt_index isolated_count;
    mt_index several_count;
    uint8_t *fans; /* per vertex an mt_fan_class */
} mt_vertex_fans;

/* Decides it for every vertex of any mesh, broken ones too. `degenerate` holds 1 for each face that names a vertex more
 * than once (mt_find_degenerate_faces); NULL when there is none. O(vertices + corners) time; 8 bytes a vertex
 * meanwhile, and 4 a corner where faces differ in size. */
mt_status mt_vertex_fans_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                const uint8_t *degenerate, mt_vertex_fans **out);
void mt_vertex_fans_destroy(mt_context *context, mt_vertex_fans *fans); /* NULL is allowed */

#ifdef __cplusplus
}
#endif
#endif
