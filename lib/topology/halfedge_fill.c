/* One pass over the corners numbers the edges and writes all that belongs to faces: an edge's number is known at its
 * first corner, and its second, later one finds it there, by way of the pairs or, faster where faces lie near each
 * other, among the open sides of its vertex. Boundary loops are linked afterwards.
 *
 * Cost: O(corners) time, no memory but the lists' heads. */
#include "lib/topology/halfedge_fill.h"
#include "lib/topology/inline.h"

#include <string.h>

typedef struct filling {
    mt_index *corner_halfedge; /* next_side, as far as it has been replaced */
    mt_halfedge *halfedges;
    mt_index *vertex_halfedge;
    mt_index corner_count;
    mt_index count; /* half-edges so far */
} filling;

/* Corners that memory is given to fetch what a side's earlier corner holds, and then to fetch the half-edge to write.
 */
#define LOOK_AHEAD 32

/* Asks for what later corners will touch: with faces in a random order nearly every second side is far away. */
MT_ALWAYS_INLINE void look_ahead(const filling *fill, mt_index corner)
{
    if (fill->corner_count - corner <= 2 * LOOK_AHEAD) {
        return;
    }
    mt_index later = corner + 2 * LOOK_AHEAD;
    mt_index earlier = fill->corner_halfedge[later];
    __builtin_prefetch(&fill->corner_halfedge[earlier < later ? earlier : later]);
    later = corner + LOOK_AHEAD;
    earlier = fill->corner_halfedge[later];
    mt_index halfedge = earlier < corner ? fill->corner_halfedge[earlier] : fill->count;
    __builtin_prefetch(&fill->halfedges[halfedge], 1);
}

/* The half-edge of a corner's side: the even one of a new edge, or the odd one of the edge of the earlier corner.
 * Without a branch, which would be mispredicted every other time. */
MT_ALWAYS_INLINE mt_index number_side(filling *fill, mt_index corner)
{
    look_ahead(fill, corner);
    mt_index other = fill->corner_halfedge[corner];
    bool is_first = other >= corner;
    mt_index earlier = fill->corner_halfedge[is_first ? corner : other];
    mt_index halfedge = is_first ? fill->count : earlier ^ 1u;
    fill->count += is_first ? 2 : 0;
    fill->corner_halfedge[corner] = halfedge;
    return halfedge;
}

/* Gives a boundary edge its outer half-edge, which points to the tail of the inner one. */
MT_ALWAYS_INLINE void close_side(filling *fill, bool is_boundary, mt_index halfedge, mt_index tail)
{
    if (is_boundary) {
        fill->halfedges[halfedge ^ 1u] = (mt_halfedge){MT_NONE, tail, MT_NONE};
    }
}

MT_ALWAYS_INLINE void write_side(filling *fill, mt_index halfedge, mt_index next, mt_index head, mt_index face)
{
    fill->halfedges[halfedge] = (mt_halfedge){next, head, face};
    fill->vertex_halfedge[head] = halfedge;
}

MT_ALWAYS_INLINE mt_index fill_triangle(filling *fill, const mt_index *vertex, mt_index corner, mt_index face)
{
    const mt_index *other = fill->corner_halfedge + corner;
    bool a_bounds = other[0] == corner, b_bounds = other[1] == corner + 1, c_bounds = other[2] == corner + 2;
    mt_index a = number_side(fill, corner);
    mt_index b = number_side(fill, corner + 1);
    mt_index c = number_side(fill, corner + 2);
    write_side(fill, a, b, vertex[1], face);
    write_side(fill, b, c, vertex[2], face);
    write_side(fill, c, a, vertex[0], face);
    if (a_bounds | b_bounds | c_bounds) {
        close_side(fill, a_bounds, a, vertex[0]);
        close_side(fill, b_bounds, b, vertex[1]);
        close_side(fill, c_bounds, c, vertex[2]);
    }
    return a;
}

MT_ALWAYS_INLINE mt_index fill_polygon(filling *fill, const mt_index *vertices, mt_index begin, mt_index end,
                                       mt_index face)
{
    mt_index previous = MT_NONE;
    for (mt_index corner = begin; corner < end; corner++) {
        bool is_boundary = fill->corner_halfedge[corner] == corner;
        mt_index halfedge = number_side(fill, corner);
        mt_index head = vertices[corner + 1 < end ? corner + 1 : begin];
        write_side(fill, halfedge, MT_NONE, head, face);
        close_side(fill, is_boundary, halfedge, vertices[corner]);
        if (previous != MT_NONE) {
            fill->halfedges[previous].next = halfedge;
        }
        previous = halfedge;
    }
    mt_index first = fill->corner_halfedge[begin];
    fill->halfedges[previous].next = first;
    return first;
}

static void fill_faces(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_halfedge_mesh *structure)
{
    filling fill = {pairs->next_side, structure->halfedges, structure->vertex_halfedge, pairs->corner_count, 0};
    mt_index *face_halfedge = structure->face_halfedge;
    const mt_index *vertices = mesh->corner_vertices;
    for (mt_index face = 0; face < structure->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        mt_index end = mt_mesh_face_end(mesh, face);
        bool triangle = end - begin == 3;
        face_halfedge[face] = triangle ? fill_triangle(&fill, vertices + begin, begin, face)
                                       : fill_polygon(&fill, vertices, begin, end, face);
    }
}

/* Makes the boundary half-edge the vertex's own. False when it has one already. */
static bool claim_boundary_heads(mt_halfedge_mesh *structure)
{
    for (mt_index h = 1; h < structure->halfedge_count; h += 2) {
        if (mt_halfedge_is_boundary(structure, h)) {
            mt_index *own = &structure->vertex_halfedge[mt_halfedge_head(structure, h)];
            if (mt_halfedge_is_boundary(structure, *own)) {
                return false;
            }
            *own = h;
        }
    }
    return true;
}

static void link_boundary(mt_halfedge_mesh *structure)
{
    for (mt_index h = 1; h < structure->halfedge_count; h += 2) {
        if (mt_halfedge_is_boundary(structure, h)) {
            mt_index before = structure->vertex_halfedge[mt_halfedge_tail(structure, h)];
            structure->halfedges[before].next = h;
        }
    }
}

/* Links the boundary half-edges into loops. False when two loops meet in a vertex. */
static bool close_boundary(mt_halfedge_mesh *structure)
{
    bool claimed = claim_boundary_heads(structure);
    if (claimed) {
        link_boundary(structure);
    }
    return claimed;
}

bool mt_halfedge_fill(const mt_mesh *mesh, mt_edge_pairs *pairs, mt_halfedge_mesh *structure)
{
    memset(structure->vertex_halfedge, 0xff, structure->vertex_count * sizeof *structure->vertex_halfedge);
    fill_faces(mesh, pairs, structure);
    return pairs->boundary_count == 0 || close_boundary(structure);
}

/* The pass over the faces by open sides: the odd half-edges without a face that leave a vertex are linked by `next`. */
typedef struct open_filling {
    open_sides open;
    mt_halfedge *halfedges;
    mt_index *vertex_halfedge;
    mt_index edge_count;
    bool fits; /* no side from a vertex to itself so far */
} open_filling;

/* The half-edge of a side: the open one that runs its way, or the even one of a new edge. */
MT_ALWAYS_INLINE mt_index place_side(open_filling *fill, mt_index tail, mt_index head)
{
    fill->fits &= tail != head;
    mt_index *link = &fill->open.newest[tail];
    mt_index at = *link;
    while (at != MT_NONE && fill->halfedges[at].head != head) {
        link = &fill->halfedges[at].next;
        at = *link;
        fill->open.steps++;
    }
    if (at != MT_NONE) {
        *link = fill->halfedges[at].next;
        return at;
    }
    mt_index halfedge = 2 * fill->edge_count++;
    fill->halfedges[halfedge + 1] = (mt_halfedge){fill->open.newest[head], tail, MT_NONE};
    fill->open.newest[head] = halfedge + 1;
    return halfedge;
}

MT_ALWAYS_INLINE mt_index place_triangle(open_filling *fill, const mt_index *vertex, mt_index face)
{
    mt_index a = place_side(fill, vertex[0], vertex[1]);
    mt_index b = place_side(fill, vertex[1], vertex[2]);
    mt_index c = place_side(fill, vertex[2], vertex[0]);
    fill->halfedges[a] = (mt_halfedge){b, vertex[1], face};
    fill->halfedges[b] = (mt_halfedge){c, vertex[2], face};
    fill->halfedges[c] = (mt_halfedge){a, vertex[0], face};
    fill->vertex_halfedge[vertex[1]] = a;
    fill->vertex_halfedge[vertex[2]] = b;
    fill->vertex_halfedge[vertex[0]] = c;
    return a;
}

MT_ALWAYS_INLINE mt_index place_polygon(open_filling *fill, const mt_index *vertices, mt_index sides, mt_index face)
{
    mt_index first = MT_NONE, previous = MT_NONE;
    for (mt_index i = 0; i < sides; i++) {
        mt_index head = vertices[i + 1 < sides ? i + 1 : 0];
        mt_index halfedge = place_side(fill, vertices[i], head);
        fill->halfedges[halfedge] = (mt_halfedge){first, head, face};
        fill->vertex_halfedge[head] = halfedge;
        if (previous == MT_NONE) {
            first = halfedge;
        } else {
            fill->halfedges[previous].next = halfedge;
        }
        previous = halfedge;
    }
    return first;
}

bool mt_halfedge_fill_open(const mt_mesh *mesh, const open_sides *open, mt_index edge_room, mt_halfedge_mesh *structure)
{
    memset(structure->vertex_halfedge, 0xff, structure->vertex_count * sizeof *structure->vertex_halfedge);
    open_filling fill = {*open, structure->halfedges, structure->vertex_halfedge, 0, true};
    mt_index *face_halfedge = structure->face_halfedge;
    uint64_t step_limit = edge_chain_step_limit(mesh->corner_count);
    mt_index face = 0;
    for (; face < mesh->face_count && fill.fits && fill.open.steps <= step_limit; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face);
        mt_index sides = mt_mesh_face_end(mesh, face) - begin;
        const mt_index *vertices = mesh->corner_vertices + begin;
        if (sides > edge_room - fill.edge_count) {
            return false;
        }
        face_halfedge[face] =
            sides == 3 ? place_triangle(&fill, vertices, face) : place_polygon(&fill, vertices, sides, face);
    }
    structure->halfedge_count = 2 * fill.edge_count;
    bool complete = face == mesh->face_count && fill.fits;
    return complete && (structure->halfedge_count == mesh->corner_count || close_boundary(structure));
}
