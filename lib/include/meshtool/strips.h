/* Triangle strips and fans: the triangles of a mesh as few runs of indices.
 *
 * A strip v0 v1 v2 v3 ... is the triangles (v0, v1, v2), (v2, v1, v3), (v2, v3, v4), ...: every index after the second
 * gives one, the odd ones turned over. A triangle that names a vertex twice is drawn by nobody; strips use such ones to
 * turn (a swap, one index more) and to reach another strip. A fan v0 v1 v2 v3 ... is the triangles (v0, v1, v2),
 * (v0, v2, v3), ... */
#ifndef MESHTOOL_STRIPS_H
#define MESHTOOL_STRIPS_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum mt_strip_kind {
    MT_STRIP_KIND_STRIP,
    MT_STRIP_KIND_FAN,
    MT_STRIP_KIND_MIXED /* strips, and fans where they are shorter */
} mt_strip_kind;

typedef enum mt_strip_join {
    MT_STRIP_JOIN_RESTART, /* strips that a restart index keeps apart; one that begins where another ends is joined to
                              it by two triangles without area instead, which is an index shorter */
    MT_STRIP_JOIN_DEGENERATE, /* all strips in one, by triangles without area; not for fans */
    MT_STRIP_JOIN_NONE        /* every strip by itself */
} mt_strip_join;

/* Between two strips of one buffer. */
#define MT_STRIP_RESTART UINT32_MAX

/* All zeros means the defaults. */
typedef struct mt_strip_options {
    mt_strip_kind kind;
    mt_strip_join join;
    bool thorough; /* search long for few indices, see mt_strips_create */
} mt_strip_options;

typedef struct mt_strips {
    mt_index strip_count;    /* strips and fans */
    mt_index fan_begin;      /* number of the first fan; strip_count when there is none */
    mt_index *offsets;       /* strip_count + 1: where each begins in `indices`, and where the last ends */
    mt_index *indices;       /* the mesh's vertices */
    mt_index triangle_count; /* of the mesh's shared triangulation */
    mt_index single_count;   /* strips and fans of one triangle */
    mt_index *faces;         /* per triangle, in the order in which they are drawn, the mesh's face */
    mt_index run_count;      /* strips and fans before any were joined by triangles without area */
    mt_index *face_runs;     /* per face of the mesh the run that draws its first triangle, for colours */
    mt_strip_join join;
} mt_strips;

/* Covers the shared triangulation of any mesh: every triangle exactly once and with its orientation, no vertex added.
 * Strips cross edges of two opposite sides; where an edge has more sides they are paired. What runs along an edge the
 * same way twice is never neighbours. A face that names a vertex twice is a strip of its own (joined by degenerate
 * triangles it cannot be told from these).
 *
 * Fast: greedily, from the triangles that have the fewest neighbours left; O(vertices + corners). Thorough: anneals
 * that cover, in a time that grows with the triangles too, about fifty times as long for large meshes and more for
 * small ones; the same on every machine. MT_ERROR_ARGUMENT for fans to be joined by degenerate triangles,
 * MT_ERROR_TOO_LARGE for more than 2^30 triangles. Ownership of *out: the caller's, until mt_strips_destroy. */
mt_status mt_strips_create(mt_context *context, const mt_mesh *mesh, const mt_strip_options *options, mt_strips **out);
void mt_strips_destroy(mt_context *context, mt_strips *strips); /* NULL is allowed */

/* Indices that one buffer of all strips takes: with a restart index between each two if they are joined so. */
static inline uint64_t mt_strips_index_count(const mt_strips *strips)
{
    uint64_t count = strips->offsets[strips->strip_count];
    bool restarts = strips->join == MT_STRIP_JOIN_RESTART && strips->strip_count > 0;
    return count + (restarts ? strips->strip_count - 1 : 0);
}

/* The triangles that strips and fans draw, in that order and with their orientation: 3 vertices each, strips->
 * triangle_count of them. Those that name a vertex twice are left out unless they are a strip of their own: after
 * MT_STRIP_JOIN_DEGENERATE there may be fewer than triangle_count. *triangles is the caller's, freed with mt_free. */
mt_status mt_strips_triangles(mt_context *context, const mt_strips *strips, mt_index **triangles, mt_index *count);

/* What a vertex cache that holds the last `cache_size` vertices transformed (first in, first out) does with the strips,
 * drawn one after the other. */
typedef struct mt_cache_use {
    uint64_t miss_count;
    double acmr; /* misses a triangle; 0 without triangles */
    double atvr; /* misses a vertex used, 1 at best; 0 without any */
} mt_cache_use;
mt_status mt_strips_cache_use(mt_context *context, const mt_strips *strips, mt_index cache_size, mt_cache_use *out);

#ifdef __cplusplus
}
#endif
#endif
