/* The triangles of a mesh and what lies across their sides, and the links that make runs of them.
 *
 * A cover is one byte a triangle: bit s says that it is linked across side s. It holds: a link is set on both sides of
 * an edge, no triangle has more than two, and no triangles are linked to a ring. */
#ifndef LIB_ALGORITHMS_STRIPS_GRAPH_H
#define LIB_ALGORITHMS_STRIPS_GRAPH_H

#include <meshtool/triangulate.h>

/* A side: 4 * triangle + (0, 1 or 2); side s runs from corner s to the next. */
typedef mt_index strip_side;

/* So many triangles at most, for sides to fit. */
#define STRIP_TRIANGLE_MAXIMUM (1u << 30)

typedef struct strip_graph {
    mt_triangulation triangulation;
    mt_index triangle_count, vertex_count, face_count;
    const mt_index *vertices; /* 3 a triangle */
    mt_index *own_vertices;   /* NULL when they are the mesh's */
    strip_side *across;       /* 4 a triangle (the last is not used): the side on the other triangle, MT_NONE */
} strip_graph;

/* What a cover costs, in indices. */
typedef struct strip_prices {
    int run;       /* for each run beside its triangles */
    int equal;     /* for two turns one after the other to the same side */
    int alternate; /* for two turns one after the other to different sides */
} strip_prices;

mt_status mt_strip_graph_init(mt_context *context, const mt_mesh *mesh, strip_graph *graph);
void mt_strip_graph_release(mt_context *context, strip_graph *graph);

/* The fast cover: strips[t] all zero to begin with. */
mt_status mt_strip_cover_greedily(mt_context *context, const strip_graph *graph, const strip_prices *prices,
                                  uint8_t *links);

/* The thorough one: betters a cover. */
mt_status mt_strip_cover_anneal(mt_context *context, const strip_graph *graph, const strip_prices *prices,
                                uint8_t *links);

/* Cuts runs so that each piece is a fan (or, when strips may stay, so that it costs least as one or the other), and
 * marks the triangles of fans. */
mt_status mt_strip_cut_fans(mt_context *context, const strip_graph *graph, bool keep_strips, uint8_t *links,
                            uint8_t *is_fan);

static inline mt_index strip_triangle_of(strip_side side)
{
    return side >> 2;
}

static inline unsigned strip_place_of(strip_side side)
{
    return side & 3u;
}

static inline unsigned strip_next(unsigned place)
{
    return place == 2 ? 0 : place + 1;
}

static inline unsigned strip_previous(unsigned place)
{
    return place == 0 ? 2 : place - 1;
}

static inline mt_index strip_vertex(const strip_graph *graph, mt_index triangle, unsigned corner)
{
    return graph->vertices[3 * (size_t)triangle + corner];
}

static inline strip_side strip_across(const strip_graph *graph, mt_index triangle, unsigned place)
{
    return graph->across[4 * (size_t)triangle + place];
}

static inline unsigned strip_link_count(unsigned links)
{
    return (links & 1u) + (links >> 1 & 1u) + (links >> 2 & 1u);
}

/* The lowest side that is linked, 3 for none. */
static inline unsigned strip_first_link(unsigned links)
{
    return links & 1u ? 0 : links & 2u ? 1 : links & 4u ? 2 : 3;
}

/* Where a triangle that was entered across `entry` (3: a run's first) is left: 3 for its last. */
static inline unsigned strip_exit(unsigned links, unsigned entry)
{
    return strip_first_link(links & ~(1u << entry));
}

/* How a triangle turns on the way to the side `place` that it is linked across: 1 when its other link is the next side,
 * 2 when it is the previous one, 0 without another link. */
static inline unsigned strip_turn(unsigned links, unsigned place)
{
    unsigned next = links >> strip_next(place) & 1u, previous = links >> strip_previous(place) & 1u;
    return next ? 1 : 2 * previous;
}

/* What the turns on both sides of a link cost: around one vertex they are equal, and seen from the link opposite. */
static inline int strip_turn_price(const strip_prices *prices, unsigned turn, unsigned turn_across)
{
    return !turn || !turn_across ? 0 : turn != turn_across ? prices->equal : prices->alternate;
}

#endif
