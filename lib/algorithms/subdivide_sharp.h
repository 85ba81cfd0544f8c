/* What is sharp at a level: the edges with a sharpness above 0, and the vertices at their ends or sharp themselves.
 * All others are smooth, or lie on a boundary and follow it. Creases are curves on a surface: these lists double with
 * a level where the mesh grows fourfold, and a mesh without them pays nothing. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_SHARP_H
#define LIB_ALGORITHMS_SUBDIVIDE_SHARP_H

#include "lib/algorithms/subdivide_rule.h"
#include "lib/algorithms/subdivide_topology.h"

typedef struct mt_sharp_edge {
    mt_index side; /* a side of it: of the two ends, 0 is the side's vertex, 1 the next corner's */
    float sharpness;
    bool boundary; /* then infinitely sharp, whatever its sharpness, which is only passed on */
    bool implied;  /* by what the mesh is, not asked for: not to be told of in the result */
} mt_sharp_edge;

typedef struct mt_sharp_vertex {
    mt_index corner;      /* one of its corners */
    mt_index first_spoke; /* its spokes go to the next vertex's first */
    float sharpness;
    bool boundary; /* two more edges, those of the boundary, are infinitely sharp */
} mt_sharp_vertex;

/* A spoke is a sharp edge, not of the boundary, seen from one of its ends: 2 * edge + end. */
typedef struct mt_subdivide_sharp {
    mt_index edge_count, vertex_count;
    mt_sharp_edge *edges;
    mt_sharp_vertex *vertices; /* vertex_count + 1: the last one is only an end of spokes */
    mt_index *spokes;
    bool chaikin;
    mt_index missing_count; /* creases of the mesh on which no face lies; they stay as they are */
    mt_edge_value *missing;
} mt_subdivide_sharp;

/* How values at a vertex are made when the rule for all (smooth inside, along the boundary on it) does not hold:
 * w times the parent's rule and 1 - w times the child's. A dart or smooth rule is what was made by the rule for all. */
typedef struct mt_vertex_patch {
    mt_index corner;
    mt_index ends[2]; /* corners at the far ends of the crease that the parent's or child's rule follows */
    float weight;     /* of the parent's rule; below 0: the rule for all holds */
    mt_subdivide_vertex_rule parent, child;
} mt_vertex_patch;

/* An edge point: weight times the middle of the edge, the rest of the smooth one; 1 and more-than-crease weights come
 * with Chaikin's rule. Below 0: the rule for all holds. */
typedef struct mt_edge_patch {
    mt_index side;
    float weight;
} mt_edge_patch;

/* What the next level of the sharp vertices and edges is made with, in their order. */
typedef struct mt_subdivide_patches {
    mt_vertex_patch *vertices;
    mt_edge_patch *edges;
    float *halves; /* per spoke number the sharpness of that half at the next level */
} mt_subdivide_patches;

/* What is given as sharp at level 0; later ones of the same edge or vertex replace earlier ones. */
typedef struct mt_sharp_input {
    mt_index crease_count, vertex_count;
    mt_index asked_crease_count; /* those after them are implied */
    const mt_edge_value *creases;
    const mt_vertex_value *vertices;
    bool corners; /* vertices of one face are infinitely sharp too */
    bool chaikin;
} mt_sharp_input;

/* Finds it all on the topology of level 0. */
mt_status mt_subdivide_sharp_create(mt_context *context, const mt_subdivide_topology *topology,
                                    const mt_sharp_input *input, mt_subdivide_sharp *sharp);
void mt_subdivide_sharp_release(mt_context *context, mt_subdivide_sharp *sharp);

/* The rules of this level and what is sharp at the next. vertex_images receives, per sharp vertex, its number there,
 * MT_NONE: no longer sharp (the caller frees it). The edge points of sharp edges follow. */
mt_status mt_subdivide_sharp_plan(mt_context *context, const mt_subdivide_topology *topology,
                                  const mt_subdivide_sharp *sharp, mt_subdivide_patches *patches);
mt_status mt_subdivide_sharp_refine(mt_context *context, const mt_subdivide_topology *topology,
                                    const mt_subdivide_sharp *sharp, const mt_subdivide_patches *patches,
                                    mt_subdivide_sharp *next, mt_index **vertex_images);
void mt_subdivide_patches_release(mt_context *context, mt_subdivide_patches *patches);

/* The corner at the far end of a spoke. O(1). */
mt_index mt_subdivide_spoke_end(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, mt_index spoke);

/* Of a sharp vertex its rule, and if that is a crease inside the surface the two spokes that it follows. */
mt_subdivide_vertex_rule mt_subdivide_sharp_rule(const mt_subdivide_sharp *sharp, mt_index vertex, mt_index ends[2]);

#endif
