/* Duplicate faces. A face that repeats another shares every edge with it, so the pairs rule out nearly all faces at a
 * glance; the rest are brought to a canonical form (the least of all rotations of both directions) and looked up in a
 * hash table in the order of the faces, so that each repeats the first of its kind.
 *
 * Source of the least rotation: Shiloach, "Fast Canonization of Circular Strings", Journal of Algorithms 2 (1981), in
 * the form of two candidates that advance past each other. Cost: O(corners) time expected; 24 bytes for each face not
 * ruled out. */
#include "lib/algorithms/manifold_check.h"

#include <string.h>

/* Whether three corners that follow each other around a face, in either direction, could be these. */
static bool in_one_face(const mt_mesh *mesh, const mt_index *corners)
{
    if (!mesh->face_offsets) {
        mt_index size = mesh->face_size;
        mt_index face = size == 3 ? corners[0] / 3 : corners[0] / size;
        return face == (size == 3 ? corners[1] / 3 : corners[1] / size);
    }
    /* At most one of the two steps wraps around; the other leads to a neighbour. */
    mt_index first = corners[1] - corners[0], second = corners[2] - corners[1];
    if (first + 1 > 2 && second + 1 > 2) {
        return false;
    }
    mt_index face = mt_mesh_corner_face(mesh, corners[0]);
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    return corners[1] >= begin && corners[1] < end && corners[2] >= begin && corners[2] < end;
}

/* Whether some other face may have all the face's sides. Never false for a face that has a duplicate. */
static bool may_repeat(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face);
    const mt_index *other = pairs->next_side + begin;
    for (mt_index i = 0; i < 3; i++) {
        if (other[i] == begin + i) {
            return false;
        }
        if (other[i] == MT_NONE || (pairs->non_manifold_count && pairs->next_side[other[i]] != begin + i)) {
            return true;
        }
    }
    return in_one_face(mesh, other);
}

/* As may_repeat, for triangles without a side a = b or an edge of three sides. */
static inline bool triangle_may_repeat(const mt_index *next_side, mt_index begin)
{
    const mt_index *other = next_side + begin;
    bool are_near = other[0] - other[1] + 2 <= 4 && other[1] - other[2] + 2 <= 4;
    return are_near && other[0] / 3 == other[1] / 3 && other[1] / 3 == other[2] / 3 && other[0] / 3 != begin / 3;
}

static void mark_triangles(void *user, uint64_t begin, uint64_t end)
{
    const manifold_check *check = user;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        if (triangle_may_repeat(check->pairs->next_side, 3 * face)) {
            check->face_flags[face] |= FACE_MAY_REPEAT;
        }
    }
}

static void mark_candidates(void *user, uint64_t begin, uint64_t end)
{
    const manifold_check *check = user;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        if (may_repeat(check->mesh, check->pairs, face)) {
            check->face_flags[face] |= FACE_MAY_REPEAT;
        }
    }
}

/* A face's cycle of vertices from one of its corners in one direction. */
typedef struct vertex_cycle {
    const mt_index *vertices;
    mt_index sides;
    mt_index start;
    bool reversed;
} vertex_cycle;

static inline mt_index cycle_at(const vertex_cycle *cycle, mt_index i)
{
    mt_index at = cycle->start + i;
    at = at < cycle->sides ? at : at - cycle->sides;
    return cycle->vertices[cycle->reversed ? cycle->sides - 1 - at : at];
}

static int compare_cycles(const vertex_cycle *a, const vertex_cycle *b)
{
    for (mt_index i = 0; i < a->sides; i++) {
        mt_index x = cycle_at(a, i), y = cycle_at(b, i);
        if (x != y) {
            return x < y ? -1 : 1;
        }
    }
    return 0;
}

/* Sets the start of the least rotation in the cycle's direction. */
static void rotate_to_least(vertex_cycle *cycle)
{
    cycle->start = 0;
    mt_index i = 0, j = 1, k = 0, sides = cycle->sides;
    while (i < sides && j < sides && k < sides) {
        mt_index x = cycle_at(cycle, (mt_index)(((uint64_t)i + k) % sides));
        mt_index y = cycle_at(cycle, (mt_index)(((uint64_t)j + k) % sides));
        if (x == y) {
            k++;
            continue;
        }
        *(x > y ? &i : &j) += k + 1;
        j += i == j;
        k = 0;
    }
    cycle->start = i < j ? i : j;
}

static vertex_cycle canonical_cycle(const mt_mesh *mesh, mt_index face)
{
    vertex_cycle forward = {mesh->corner_vertices + mt_mesh_face_begin(mesh, face), mt_mesh_face_sides(mesh, face), 0,
                            false};
    vertex_cycle backward = forward;
    backward.reversed = true;
    rotate_to_least(&forward);
    rotate_to_least(&backward);
    return compare_cycles(&forward, &backward) <= 0 ? forward : backward;
}

static uint64_t hash_cycle(const vertex_cycle *cycle)
{
    uint64_t hash = cycle->sides;
    for (mt_index i = 0; i < cycle->sides; i++) {
        hash = (hash ^ cycle_at(cycle, i)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 29;
    }
    return hash;
}

/* A face of a kind not met before. */
typedef struct table_slot {
    uint64_t hash;
    mt_index face; /* MT_NONE: free */
    mt_index start;
    bool reversed;
} table_slot;

/* The earlier face with the same cycle; MT_NONE when there is none, and then the face is entered. */
static mt_index find_or_enter(table_slot *table, uint64_t mask, const mt_mesh *mesh, mt_index face)
{
    vertex_cycle cycle = canonical_cycle(mesh, face);
    uint64_t hash = hash_cycle(&cycle);
    uint64_t at = hash & mask;
    for (; table[at].face != MT_NONE; at = (at + 1) & mask) {
        vertex_cycle earlier = {mesh->corner_vertices + mt_mesh_face_begin(mesh, table[at].face),
                                mt_mesh_face_sides(mesh, table[at].face), table[at].start, table[at].reversed};
        if (table[at].hash == hash && earlier.sides == cycle.sides && compare_cycles(&earlier, &cycle) == 0) {
            return table[at].face;
        }
    }
    table[at] = (table_slot){hash, face, cycle.start, cycle.reversed};
    return MT_NONE;
}

static mt_index look_up_candidates(manifold_check *check, table_slot *table, uint64_t mask, duplicate_face *duplicates)
{
    mt_index count = 0;
    for (mt_index face = 0; face < check->mesh->face_count; face++) {
        if (check->face_flags[face] & FACE_MAY_REPEAT) {
            mt_index earlier = find_or_enter(table, mask, check->mesh, face);
            if (earlier != MT_NONE) {
                check->face_flags[face] |= FACE_DUPLICATE;
                duplicates[count++] = (duplicate_face){face, earlier};
            }
        }
    }
    return count;
}

mt_status mt_manifold_find_duplicates(manifold_check *check)
{
    const mt_mesh *mesh = check->mesh;
    bool plain = !mesh->face_offsets && mesh->face_size == 3 && check->pairs->degenerate_side_count == 0 &&
                 check->pairs->non_manifold_count == 0;
    mt_parallel_for(check->context, mesh->face_count, MANIFOLD_GRAIN, plain ? mark_triangles : mark_candidates, check);
    mt_index candidate_count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        candidate_count += (check->face_flags[face] & FACE_MAY_REPEAT) != 0;
    }
    if (candidate_count < 2) {
        return MT_OK;
    }
    uint64_t capacity = 4;
    while (capacity < 2 * (uint64_t)candidate_count) {
        capacity *= 2;
    }
    table_slot *table = mt_allocate_array(check->context, capacity, sizeof *table);
    check->duplicates = mt_allocate_array(check->context, candidate_count, sizeof *check->duplicates);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (table && check->duplicates) {
        memset(table, 0xff, capacity * sizeof *table); /* face MT_NONE */
        check->report->defect_counts[MT_DEFECT_DUPLICATE_FACE] =
            look_up_candidates(check, table, capacity - 1, check->duplicates);
        status = MT_OK;
    }
    mt_free(check->context, table);
    return status;
}
