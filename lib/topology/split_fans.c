/* At a vertex each corner has two sides, and each of these is joined to at most one other corner of the vertex: so fans
 * are paths or cycles, walked from their beginning to their end. Misoriented edges are crossed too: then the walk goes
 * on the other way round the faces, and remembers by which side it came.
 *
 * Invariant: vertices are only ever told apart, never made one; so what one step has separated stays so.
 *
 * Cost: O(vertices + corners) time. */
#include "lib/topology/split_fans.h"

#include <string.h>

/* A corner, and whether the walk goes on across its own side or across the one before. */
typedef struct fan_place {
    mt_index corner; /* MT_NONE: the end of the fan */
    bool by_own_side;
} fan_place;

/* A fan from its first corner on. */
typedef struct fan_path {
    fan_place begin;
    mt_index count;
    bool closed;
} fan_path;

static mt_index face_of(const fan_splitting *splitting, mt_index corner)
{
    return splitting->corner_face ? splitting->corner_face[corner] : corner / splitting->mesh.face_size;
}

static mt_index next_corner(const fan_splitting *splitting, mt_index corner)
{
    mt_index face = face_of(splitting, corner);
    bool last = corner + 1 == mt_mesh_face_end(&splitting->mesh, face);
    return last ? mt_mesh_face_begin(&splitting->mesh, face) : corner + 1;
}

static mt_index previous_corner(const fan_splitting *splitting, mt_index corner)
{
    mt_index face = face_of(splitting, corner);
    bool first = corner == mt_mesh_face_begin(&splitting->mesh, face);
    return first ? mt_mesh_face_end(&splitting->mesh, face) - 1 : corner - 1;
}

/* The side that is one edge with that of a corner, and still has the same ends; MT_NONE: there is none. */
static mt_index joined_side(const fan_splitting *splitting, const mt_edge_pairs *pairs, mt_index corner)
{
    const mt_index *vertices = splitting->mesh.corner_vertices;
    mt_index other = pairs->next_side[corner];
    if (other == MT_NONE || other == corner || pairs->next_side[other] != corner) {
        return MT_NONE;
    }
    mt_index tail = vertices[corner], head = vertices[next_corner(splitting, corner)];
    mt_index other_tail = vertices[other], other_head = vertices[next_corner(splitting, other)];
    bool opposite = tail == other_head && head == other_tail;
    bool same = tail == other_tail && head == other_head && splitting->misoriented[corner];
    return opposite || same ? other : MT_NONE;
}

static fan_place step(const fan_splitting *splitting, const mt_edge_pairs *pairs, fan_place place)
{
    mt_index vertex = splitting->mesh.corner_vertices[place.corner];
    mt_index side = place.by_own_side ? place.corner : previous_corner(splitting, place.corner);
    mt_index other = joined_side(splitting, pairs, side);
    if (other == MT_NONE) {
        return (fan_place){MT_NONE, false};
    }
    if (splitting->mesh.corner_vertices[other] == vertex) {
        return (fan_place){other, false};
    }
    return (fan_place){next_corner(splitting, other), true};
}

static fan_path find_path(const fan_splitting *splitting, const mt_edge_pairs *pairs, mt_index corner)
{
    fan_path path = {{corner, false}, 1, false};
    fan_place at = {corner, true};
    fan_place next = step(splitting, pairs, at);
    while (next.corner != MT_NONE && next.corner != corner) {
        at = next;
        next = step(splitting, pairs, at);
        path.count++;
    }
    if (next.corner == corner) {
        path.closed = true;
        return path;
    }
    path.begin = (fan_place){at.corner, !at.by_own_side};
    path.count = 0;
    for (at = path.begin; at.corner != MT_NONE; at = step(splitting, pairs, at)) {
        path.count++;
    }
    return path;
}

static mt_index new_vertex(fan_splitting *splitting, mt_index vertex)
{
    mt_index number = splitting->mesh.vertex_count++;
    splitting->sources[number] = splitting->sources[vertex];
    splitting->vertex_seen[number] = 1;
    return number;
}

/* The vertex at the other end of the side by which the walk goes on, or of the one by which it came. */
static mt_index far_vertex(const fan_splitting *splitting, fan_place place, bool onward)
{
    bool own = place.by_own_side == onward;
    mt_index corner = own ? next_corner(splitting, place.corner) : previous_corner(splitting, place.corner);
    return splitting->mesh.corner_vertices[corner];
}

/* Marks what the corner brings to the run; false when the run has it already. `closes`: the far side is the one where
 * the run began. */
static bool join_run(fan_splitting *splitting, fan_place place, bool first, bool closes)
{
    mt_index run = splitting->run_count;
    mt_index *face = &splitting->face_run[face_of(splitting, place.corner)];
    mt_index *far = &splitting->vertex_run[far_vertex(splitting, place, true)];
    bool fits = first || (*face != run && (*far != run || closes));
    *face = *far = run;
    return fits;
}

static void begin_run(fan_splitting *splitting, fan_place place)
{
    splitting->run_count++;
    splitting->vertex_run[far_vertex(splitting, place, false)] = splitting->run_count;
    join_run(splitting, place, true, false);
}

static void split_path(fan_splitting *splitting, const mt_edge_pairs *pairs, const fan_path *path, mt_index vertex,
                       bool cut)
{
    bool is_cut = false;
    fan_place at = path->begin;
    for (mt_index i = 0; i < path->count; i++) {
        fan_place next = step(splitting, pairs, at);
        bool closes = path->closed && !is_cut && i + 1 == path->count;
        if (cut && i == 0) {
            begin_run(splitting, at);
        } else if (cut && !join_run(splitting, at, false, closes)) {
            vertex = new_vertex(splitting, vertex);
            is_cut = true;
            begin_run(splitting, at);
        }
        splitting->mesh.corner_vertices[at.corner] = vertex;
        splitting->corner_done[at.corner] = 1;
        at = next;
    }
}

void mt_split_fans(fan_splitting *splitting, const mt_edge_pairs *pairs, bool cut)
{
    mt_index corner_count = splitting->mesh.corner_count;
    memset(splitting->corner_done, 0, corner_count);
    memset(splitting->vertex_seen, 0, splitting->vertex_room);
    memset(splitting->vertex_run, 0, splitting->vertex_room * sizeof(mt_index));
    memset(splitting->face_run, 0, splitting->mesh.face_count * sizeof(mt_index));
    splitting->run_count = 0;
    for (mt_index corner = 0; corner < corner_count; corner++) {
        if (splitting->corner_done[corner]) {
            continue;
        }
        fan_path path = find_path(splitting, pairs, corner);
        mt_index vertex = splitting->mesh.corner_vertices[corner];
        if (splitting->vertex_seen[vertex]) {
            vertex = new_vertex(splitting, vertex);
        }
        splitting->vertex_seen[vertex] = 1;
        split_path(splitting, pairs, &path, vertex, cut);
    }
}
