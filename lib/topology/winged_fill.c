/* One pass over the corners numbers the edges and writes all that belongs to faces: an edge's number is known at its
 * first corner, and its second, later one finds it there. Holes are linked afterwards.
 *
 * Cost: O(corners) time, no memory. */
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

typedef struct winged_filling {
    mt_index *corner_side; /* next_side, as far as it has been replaced by 2 * edge + side */
    edge_record *edges;
    mt_index *vertex_edge;
    mt_index count; /* sides of edges so far, two an edge */
} winged_filling;

/* The side of a corner: the left of a new edge, or the right of the edge of the earlier corner. */
MT_ALWAYS_INLINE mt_index number_side(winged_filling *filling, mt_index corner)
{
    mt_index other = filling->corner_side[corner];
    bool is_first = other >= corner;
    mt_index earlier = filling->corner_side[is_first ? corner : other];
    mt_index side = is_first ? filling->count : earlier ^ 1u;
    filling->count += is_first ? 2 : 0;
    filling->corner_side[corner] = side;
    return side;
}

MT_ALWAYS_INLINE void write_side(winged_filling *filling, mt_index side, mt_index tail, mt_index head, mt_index face)
{
    edge_record *edge = &filling->edges[side >> 1];
    edge->vertices[side & 1] = head;
    edge->vertices[~side & 1] = tail;
    edge->faces[side & 1] = face;
    filling->vertex_edge[tail] = side >> 1;
}

MT_ALWAYS_INLINE void write_wings(winged_filling *filling, mt_index side, mt_index previous, mt_index next)
{
    mt_index *wings = filling->edges[side >> 1].wings[side & 1];
    wings[0] = previous >> 1;
    wings[1] = next >> 1;
}

MT_ALWAYS_INLINE void close_side(winged_filling *filling, bool is_boundary, mt_index side)
{
    if (is_boundary) {
        filling->edges[side >> 1].faces[1] = MT_NONE;
    }
}

MT_ALWAYS_INLINE mt_index fill_triangle(winged_filling *filling, const mt_index *vertex, mt_index corner, mt_index face)
{
    const mt_index *other = filling->corner_side + corner;
    bool a_bounds = other[0] == corner, b_bounds = other[1] == corner + 1, c_bounds = other[2] == corner + 2;
    mt_index a = number_side(filling, corner);
    mt_index b = number_side(filling, corner + 1);
    mt_index c = number_side(filling, corner + 2);
    write_side(filling, a, vertex[0], vertex[1], face);
    write_side(filling, b, vertex[1], vertex[2], face);
    write_side(filling, c, vertex[2], vertex[0], face);
    write_wings(filling, a, c, b);
    write_wings(filling, b, a, c);
    write_wings(filling, c, b, a);
    if (a_bounds | b_bounds | c_bounds) {
        close_side(filling, a_bounds, a);
        close_side(filling, b_bounds, b);
        close_side(filling, c_bounds, c);
    }
    return a >> 1;
}

MT_ALWAYS_INLINE mt_index fill_polygon(winged_filling *filling, const mt_index *vertices, mt_index begin, mt_index end,
                                       mt_index face)
{
    for (mt_index corner = begin; corner < end; corner++) {
        bool is_boundary = filling->corner_side[corner] == corner;
        mt_index side = number_side(filling, corner);
        write_side(filling, side, vertices[corner], vertices[corner + 1 < end ? corner + 1 : begin], face);
        close_side(filling, is_boundary, side);
    }
    const mt_index *sides = filling->corner_side;
    mt_index previous = sides[end - 1];
    for (mt_index corner = begin; corner < end; corner++) {
        mt_index side = sides[corner];
        write_wings(filling, side, previous, sides[corner + 1 < end ? corner + 1 : begin]);
        previous = side;
    }
    return sides[begin] >> 1;
}

static void fill_faces(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure)
{
    winged_filling filling = {pairs->next_side, (edge_record *)structure->edges, structure->vertex_edge, 0};
    mt_index *face_edge = structure->face_edge;
    const mt_index *vertices = mesh->corner_vertices;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        mt_index end = mt_mesh_face_end(mesh, face);
        bool triangle = end - begin == 3;
        face_edge[face] = triangle ? fill_triangle(&filling, vertices + begin, begin, face)
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

void mt_winged_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_winged_edge_mesh *structure)
{
    memset(structure->vertex_edge, 0xff, structure->vertex_count * sizeof *structure->vertex_edge);
    fill_faces(mesh, pairs, structure);
    if (pairs->boundary_count) {
        link_boundary(structure);
    }
}
