/* A tile's samples into pixels. */
#ifndef MESHTOOL_RENDER_RESOLVE_H
#define MESHTOOL_RENDER_RESOLVE_H

#include "lib/render/picture.h"

/* Triangles prepared lately: a triangle is met again in the next pixel or the next row. */
#define MT_FACET_CACHE_SIZE 256

typedef struct mt_facet_cache {
    mt_facet facets[MT_FACET_CACHE_SIZE]; /* a triangle's place is its number modulo the size */
} mt_facet_cache;

void mt_facet_cache_clear(mt_facet_cache *cache);

/* Stores the tile's pixels in picture->image; returns how many of its samples show the mesh. */
uint64_t mt_resolve_tile(const mt_picture *picture, const mt_tile *tile, mt_facet_cache *cache);

/* The same for a tile in which nothing was drawn: its buffers are not looked at. */
void mt_resolve_blank(const mt_picture *picture, const mt_tile *tile);

#endif
