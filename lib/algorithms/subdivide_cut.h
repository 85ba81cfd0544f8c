/* Non-manifold meshes as OpenSubdiv refines them: what no two faces can share smoothly is infinitely sharp. Then the
 * sheets that meet there do not feel each other, and can be cut apart, refined, and joined again. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_CUT_H
#define LIB_ALGORITHMS_SUBDIVIDE_CUT_H

#include "lib/algorithms/subdivide_topology.h"

#include <meshtool/subdivide.h>

/* A side of an edge that sheets share. */
typedef struct mt_cut_side {
    mt_index side, edge; /* numbers of shared edges, 2e and 2e + 1 being the halves of e, of its lower end first */
    bool flipped;        /* runs from the higher end to the lower */
} mt_cut_side;

typedef struct mt_subdivide_cut {
    mt_mesh *mesh;                                   /* cut apart, with all that was asked to be sharp; the cut's */
    mt_index *sources;                               /* per vertex the one that it is a copy of; copies come last */
    mt_index asked_crease_count, asked_corner_count; /* of the mesh's: those after are implied by the cut */
    mt_index edge_count;                             /* shared edges at the level in work */
    mt_index side_count;
    mt_cut_side *sides;
    uint64_t join_count, join_room;
    mt_index (*joins)[2]; /* vertices, and those that they are one with, which are lower */
} mt_subdivide_cut;

/* Cuts the mesh, whose pairs are given. Sharpness of the settings goes into the mesh of the cut, with what is sharp
 * because of it: vertices where sheets meet, but those inside of one crease of them. */
mt_status mt_subdivide_cut_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                                  const mt_subdivide_options *settings, mt_subdivide_cut *cut);
void mt_subdivide_cut_release(mt_context *context, mt_subdivide_cut *cut);

/* Notes what is to be joined of the next level's vertices; `topology` is this level's. */
mt_status mt_subdivide_cut_refine(mt_context *context, const mt_subdivide_topology *topology, mt_subdivide_cut *cut);

/* Whether any vertex was copied. */
static inline bool mt_subdivide_cut_has_copies(const mt_subdivide_cut *cut)
{
    mt_index count = cut->mesh->vertex_count;
    return count > 0 && cut->sources[count - 1] != count - 1;
}

/* Replaces *result by one in which the copies are one vertex again. On failure *result is as it was. */
mt_status mt_subdivide_cut_join(mt_context *context, const mt_subdivide_cut *cut, mt_mesh **result);

#endif
