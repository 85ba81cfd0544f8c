/* One pass over the corners numbers the edges and writes all that belongs to faces: an edge's number is known at its
 * first corner, and its second, later one finds it there, by way of the pairs or, faster where faces lie near each
 * other, among the open sides of its vertex. Holes are linked afterwards.
 *
 * Cost: O(corners) time, no memory but the lists' heads. */
#include "lib/topology/winged_fill.h"
#include "lib/topology/inline.h"

#include <string.h>

/* An edge's fields by side, 0 its left and 1 its right: written without asking which it is, since a branch would be
 * mispredicted every other time. */
typedef struct edge_record {
    mt_index vertices[2]; /* of the side: head, tail */
    mt_index faces[2];
    mt_index wings[2][2]; /* of the side: previous, next */
} edge_record;
_Static_assert(sizeof(edge_record) == sizeof(mt_winged_edge), "two views of one record");
_Static_assert(offsetof(mt_winged_edge, tail) == sizeof(mt_index), "head and tail");
_Static_assert(offsetof(mt_winged_edge, left) == offsetof(edge_record, faces), "left and right");
_Static_assert(offsetof(mt_winged_edge, rprev) == offsetof(edge_record, wings[1]), "the wings of the right");

typedef struct edge_records {
    edge_record *edges;
    mt_index *vertex_edge;
} edge_records;

typedef struct winged_filling {
    edge_records records;
    mt_index *corner_side; /* next_side, as far as it has been replaced by 2 * edge + side */
    mt_index corner_count;
    mt_index count; /* sides of edges so far, two an edge */
    const mt_index *corner_vertices;
} winged_filling;

/* Corners that memory is given to fetch what a side's earlier corner holds, and then to fetch the edge to write. */
#define LOOK_AHEAD 32

/* Asks for what later corners will touch: with faces in a random order nearly every second side is far away. */
MT_ALWAYS_INLINE void look_ahead(const winged_filling *filling, mt_index corner)
{
    if (filling->corner_count - corner <= 2 * LOOK_AHEAD) {
        return;
    }
    mt_index later = corner + 2 * LOOK_AHEAD;
    mt_index earlier = filling->corner_side[later];
    __builtin_prefetch(&filling->corner_side[earlier < later ? earlier : later]);
    later = corner + LOOK_AHEAD;
    earlier = filling->corner_side[later];
    mt_index side = earlier < corner ? filling->corner_side[earlier] : filling->count;
    __builtin_prefetch(&filling->records.vertex_edge[filling->corner_vertices[later]], 1);
    __builtin_prefetch(&filling->records.edges[side >> 1], 1);
}

/* The side of a corner: the left of a new edge, or the right of the edge of the earlier corner. */
MT_ALWAYS_INLINE mt_index number_side(winged_filling *filling, mt_index corner)
{
    look_ahead(filling, corner);
    mt_index other = filling->corner_side[corner];
    bool is_first = other >= corner;
    mt_index earlier = filling->corner_side[is_first ? corner : other];
    mt_index side = is_first ? filling->count : earlier ^ 1u;
    filling->count += is_first ? 2 : 0;
    filling->corner_side[corner] = side;
    return side;
}

MT_ALWAYS_INLINE void write_side(edge_records *records, mt_index side, mt_index tail, mt_index head, mt_index face)
{
    edge_record *edge = &records->edges[side >> 1];
    edge->vertices[side & 1] = head;
    edge->vertices[~side & 1] = tail;
    edge->faces[side & 1] = face;
    records->vertex_edge[tail] = side >> 1;
}

MT_ALWAYS_INLINE void write_wings(edge_records *records, mt_index side, mt_index previous, mt_index next)
{
    mt_index *wings = records->edges[side >> 1].wings[side & 1];
    wings[0] = previous >> 1;
    wings[1] = next >> 1;
}

MT_ALWAYS_INLINE void write_triangle(edge_records *records, const mt_index *vertex, mt_index a, mt_index b, mt_index c,
                                     mt_index face)
{
    write_side(records, a, vertex[0], vertex[1], face);
    write_side(records, b, vertex[1], vertex[2], face);
    write_side(records, c, vertex[2], vertex[0], face);
    write_wings(records, a, c, b);
    write_wings(records, b, a, c);
    write_wings(records, c, b, a);
}

/* The outside comes to the right of a new edge, until its second side is met. */
MT_ALWAYS_INLINE void open_side(winged_filling *filling, bool is_boundary, mt_index side)
{
    if (is_boundary) {
        filling->records.edges[side >> 1].faces[1] = MT_NONE;
    }
}

MT_ALWAYS_INLINE mt_index fill_triangle(winged_filling *filling, const mt_index *vertex, mt_index corner, mt_index face)
{
    const mt_index *other = filling->corner_side + corner;
    bool a_bounds = other[0] == corner, b_bounds = other[1] == corner + 1, c_bounds = other[2] == corner + 2;
    mt_index a = number_side(filling, corner);
    mt_index b = number_side(filling, corner + 1);
    mt_index c = number_side(filling, corner + 2);
    write_triangle(&filling->records, vertex, a, b, c, face);
    if (a_bounds | b_bounds | c_bounds) {
        open_side(filling, a_bounds, a);
        open_side(filling, b_bounds, b);
        open_side(filling, c_bounds, c);
    }
    return a >> 1;
}

MT_ALWAYS_INLINE mt_index fill_polygon(winged_filling *filling, const mt_index *vertices, mt_index begin, mt_index end,
                                       mt_index face)
{
    for (mt_index corner = begin; corner < end; corner++) {
        bool is_boundary = filling->corner_side[corner] == corner;
        mt_index side = number_side(filling, corner);
        write_side(&filling->records, side, vertices[corner - begin],
                   vertices[corner + 1 < end ? corner + 1 - begin : 0], face);
        open_side(filling, is_boundary, side);
    }
    const mt_index *sides = filling->corner_side;
    mt_index previous = sides[end - 1];
    for (mt_index corner = begin; corner < end; corner++) {
        mt_index side = sides[corner];
        write_wings(&filling->records, side, previous, sides[corner + 1 < end ? corner + 1 : begin]);
        previous = side;
    }
    return sides[begin] >> 1;
}

static void fill_faces(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure)
{
    winged_filling filling = {.records = {(edge_record *)structure->edges, structure->vertex_edge},
                              .corner_side = pairs->next_side,
                              .corner_count = mesh->corner_count,
                              .corner_vertices = mesh->corner_vertices};
    mt_index *face_edge = structure->face_edge;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        mt_index end = mt_mesh_face_end(mesh, face);
        const mt_index *vertices = mesh->corner_vertices + begin;
        bool triangle = end - begin == 3;
        face_edge[face] = triangle ? fill_triangle(&filling, vertices, begin, face)
                                   : fill_polygon(&filling, vertices, begin, end, face);
    }
}

/* The edge that leaves a vertex with the outside to its right is where the vertex's fan begins; around the hole it
 * comes before the edge that arrives there. */
static void link_boundary(mt_winged_edge_mesh *structure)
{
    mt_winged_edge *edges = structure->edges;
    for (mt_index edge = 0; edge < structure->edge_count; edge++) {
        if (edges[edge].right == MT_NONE) {
            structure->vertex_edge[edges[edge].tail] = edge;
        }
    }
    for (mt_index edge = 0; edge < structure->edge_count; edge++) {
        if (edges[edge].right == MT_NONE) {
            mt_index before = structure->vertex_edge[edges[edge].head];
            edges[edge].rprev = before;
            edges[before].rnext = edge;
        }
    }
}

static void forget_edges(mt_winged_edge_mesh *structure)
{
    memset(structure->vertex_edge, 0xff, structure->vertex_count * sizeof *structure->vertex_edge);
}

void mt_winged_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure)
{
    forget_edges(structure);
    fill_faces(mesh, pairs, structure);
    if (pairs->boundary_count) {
        link_boundary(structure);
    }
}

/* The pass over the faces by open sides: edges without a right face, of one head, are linked by the first wing there.
 */
typedef struct open_filling {
    open_sides open;
    edge_records records;
    mt_index edge_count;
    bool fits; /* no side from a vertex to itself so far */
} open_filling;

/* The side of an edge: the right of an open one that runs the other way, or the left of a new one. */
MT_ALWAYS_INLINE mt_index place_side(open_filling *fill, mt_index tail, mt_index head)
{
    fill->fits &= tail != head;
    edge_record *edges = fill->records.edges;
    mt_index *link = &fill->open.newest[tail];
    mt_index at = *link;
    while (at != MT_NONE && edges[at].vertices[1] != head) {
        link = &edges[at].wings[1][0];
        at = *link;
        fill->open.steps++;
    }
    if (at != MT_NONE) {
        *link = edges[at].wings[1][0];
        return 2 * at + 1;
    }
    mt_index edge = fill->edge_count++;
    edges[edge].vertices[1] = tail;
    edges[edge].faces[1] = MT_NONE;
    edges[edge].wings[1][0] = fill->open.newest[head];
    fill->open.newest[head] = edge;
    return 2 * edge;
}

MT_ALWAYS_INLINE mt_index place_polygon(open_filling *fill, const mt_index *vertices, mt_index sides, mt_index face)
{
    mt_index first = place_side(fill, vertices[0], vertices[1]);
    write_side(&fill->records, first, vertices[0], vertices[1], face);
    mt_index before = first, side = first;
    for (mt_index i = 1; i < sides; i++) {
        mt_index head = vertices[i + 1 < sides ? i + 1 : 0];
        mt_index next = place_side(fill, vertices[i], head);
        write_side(&fill->records, next, vertices[i], head, face);
        write_wings(&fill->records, side, before, next);
        before = side;
        side = next;
    }
    write_wings(&fill->records, side, before, first);
    fill->records.edges[first >> 1].wings[first & 1][0] = side >> 1;
    return first >> 1;
}

MT_ALWAYS_INLINE mt_index place_triangle(open_filling *fill, const mt_index *vertex, mt_index face)
{
    mt_index a = place_side(fill, vertex[0], vertex[1]);
    mt_index b = place_side(fill, vertex[1], vertex[2]);
    mt_index c = place_side(fill, vertex[2], vertex[0]);
    write_triangle(&fill->records, vertex, a, b, c, face);
    return a >> 1;
}

bool mt_winged_fill_open(const mt_mesh *mesh, const open_sides *open, mt_index edge_room,
                         mt_winged_edge_mesh *structure)
{
    forget_edges(structure);
    open_filling fill = {*open, {(edge_record *)structure->edges, structure->vertex_edge}, 0, true};
    mt_index *face_edge = structure->face_edge;
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    mt_index face = 0;
    for (; face < mesh->face_count && fill.fits && fill.open.steps <= step_limit; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        mt_index sides = mt_mesh_face_end(mesh, face) - begin;
        const mt_index *vertices = mesh->corner_vertices + begin;
        if (sides > edge_room - fill.edge_count) {
            return false;
        }
        face_edge[face] =
            sides == 3 ? place_triangle(&fill, vertices, face) : place_polygon(&fill, vertices, sides, face);
    }
    structure->edge_count = fill.edge_count;
    bool complete = fill.fits && face == mesh->face_count;
    if (complete && 2 * (uint64_t)structure->edge_count != mesh->corner_count) {
        link_boundary(structure);
    }
    return complete;
}
