/* The refusals: each names the first offender in the order of the mesh and says what can mend it.
 * Cost: O(corners); what it takes to word a message is spent only on failure. */
#include "lib/algorithms/subdivide_check.h"

#include <stdio.h>
#include <string.h>

#define NEEDS "Catmull-Clark needs a manifold mesh"

/* Faces of up to so many sides are compared pairwise, larger ones by marks on their vertices. */
#define PAIRWISE_SIDES 8

typedef struct face_scan {
    const mt_mesh *mesh;
    mt_index gap;            /* corners nearer than this are known to differ */
    mt_index *first_repeats; /* per block the first face that names a vertex twice, MT_NONE: none */
    bool *has_large;         /* per block whether a face was too large to compare pairwise */
} face_scan;

/* The corner of the first vertex that the face names again, MT_NONE when there is none. */
static mt_index find_repeat(const mt_mesh *mesh, mt_index begin, mt_index end, mt_index gap)
{
    for (mt_index i = begin; i + gap < end; i++) {
        for (mt_index j = i + gap; j < end; j++) {
            if (mesh->corner_vertices[i] == mesh->corner_vertices[j]) {
                return i;
            }
        }
    }
    return MT_NONE;
}

static void scan_faces(void *user, uint64_t begin, uint64_t end)
{
    const face_scan *scan = user;
    mt_index first_repeat = MT_NONE;
    bool has_large = false;
    for (mt_index face = (mt_index)begin; face < end && first_repeat == MT_NONE; face++) {
        mt_index first = mt_mesh_face_begin(scan->mesh, face), last = mt_mesh_face_end(scan->mesh, face);
        if (last - first > PAIRWISE_SIDES) {
            has_large = true;
        } else if (find_repeat(scan->mesh, first, last, scan->gap) != MT_NONE) {
            first_repeat = face;
        }
    }
    scan->first_repeats[begin / MT_SUBDIVIDE_GRAIN] = first_repeat;
    scan->has_large[begin / MT_SUBDIVIDE_GRAIN] = has_large;
}

/* The first large face before `limit` that names a vertex twice; `marks` holds a face for each vertex. */
static mt_index find_large_repeat(const mt_mesh *mesh, mt_index *marks, mt_index limit)
{
    memset(marks, 0xff, (size_t)mesh->vertex_count * sizeof *marks); /* MT_NONE */
    for (mt_index face = 0; face < mesh->face_count && face < limit; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; end - begin > PAIRWISE_SIDES && corner < end; corner++) {
            mt_index vertex = mesh->corner_vertices[corner];
            if (marks[vertex] == face) {
                return face;
            }
            marks[vertex] = face;
        }
    }
    return limit;
}

static mt_status find_repeating_face(mt_context *context, face_scan *scan, mt_index *face)
{
    const mt_mesh *mesh = scan->mesh;
    uint64_t block_count = (uint64_t)mesh->face_count / MT_SUBDIVIDE_GRAIN + 1;
    memset(scan->first_repeats, 0xff, (size_t)block_count * sizeof(mt_index)); /* MT_NONE */
    memset(scan->has_large, 0, (size_t)block_count * sizeof(bool));
    mt_parallel_for(context, mesh->face_count, MT_SUBDIVIDE_GRAIN, scan_faces, scan);
    bool has_large = false;
    *face = MT_NONE;
    for (uint64_t block = 0; block < block_count && *face == MT_NONE; block++) {
        *face = scan->first_repeats[block];
        has_large = has_large || scan->has_large[block];
    }
    if (has_large) {
        mt_index *marks = mt_allocate_array(context, mesh->vertex_count, sizeof *marks);
        if (!marks) {
            return mt_context_error(context)->status;
        }
        *face = find_large_repeat(mesh, marks, *face);
        mt_free(context, marks);
    }
    return MT_OK;
}

static mt_status check_faces(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    mt_index gap = pairs->degenerate_side_count ? 1 : 2;
    if (gap == 2 && !mesh->face_offsets && mesh->face_size == 3) {
        return MT_OK;
    }
    uint64_t block_count = (uint64_t)mesh->face_count / MT_SUBDIVIDE_GRAIN + 1;
    face_scan scan = {.mesh = mesh, .gap = gap};
    scan.first_repeats = mt_allocate_array(context, block_count, sizeof(mt_index));
    scan.has_large = mt_allocate_array(context, block_count, sizeof(bool));
    mt_index face = MT_NONE;
    mt_status status = scan.first_repeats && scan.has_large ? find_repeating_face(context, &scan, &face)
                                                            : mt_context_error(context)->status;
    mt_free(context, scan.first_repeats);
    mt_free(context, scan.has_large);
    if (status != MT_OK || face == MT_NONE) {
        return status;
    }
    mt_index corner = find_repeat(mesh, mt_mesh_face_begin(mesh, face), mt_mesh_face_end(mesh, face), 1);
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD,
                   "face %u names vertex %u more than once; " NEEDS
                   ": `meshtool repair --drop-degenerate` can drop such faces",
                   face, mesh->corner_vertices[corner]);
}

static mt_index first_corner_of_class(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_edge_class edge_class)
{
    mt_index corner = 0;
    while (mt_edge_class_of(mesh, pairs, corner) != edge_class) {
        corner++;
    }
    return corner;
}

/* The ends of a corner's side, the lower number first. */
static void side_ends(const mt_mesh *mesh, mt_index corner, mt_index ends[2])
{
    mt_index face = mt_mesh_corner_face(mesh, corner);
    mt_index next = corner + 1 < mt_mesh_face_end(mesh, face) ? corner + 1 : mt_mesh_face_begin(mesh, face);
    mt_index a = mesh->corner_vertices[corner], b = mesh->corner_vertices[next];
    ends[0] = a < b ? a : b;
    ends[1] = a < b ? b : a;
}

/* "4, 9, 13", cut short where there are many; returns the number of sides on the edge. */
static mt_index list_faces(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first, char *text, size_t room)
{
    mt_index faces[6];
    mt_index count = mt_edge_faces(mesh, pairs, first, 6, faces);
    size_t length = 0;
    for (mt_index i = 0; i < count && i < 6; i++) {
        length += (size_t)snprintf(text + length, room - length, "%s%u", i ? ", " : "", faces[i]);
    }
    if (count > 6) {
        snprintf(text + length, room - length, ", ...");
    }
    return count;
}

/* Whether two faces, which name no vertex twice, have the same vertices in the same or in the opposite order. */
static bool are_duplicates(const mt_mesh *mesh, mt_index a, mt_index b)
{
    mt_index sides = mt_mesh_face_sides(mesh, a);
    const mt_index *from = mesh->corner_vertices + mt_mesh_face_begin(mesh, a);
    const mt_index *to = mesh->corner_vertices + mt_mesh_face_begin(mesh, b);
    mt_index start = 0;
    if (mt_mesh_face_sides(mesh, b) != sides) {
        return false;
    }
    while (start < sides && to[start] != from[0]) {
        start++;
    }
    if (start == sides) {
        return false;
    }
    bool forward = true, backward = true;
    for (uint64_t i = 0; i < sides; i++) {
        forward = forward && from[i] == to[(start + i) % sides];
        backward = backward && from[i] == to[(start + sides - i) % sides];
    }
    return forward || backward;
}

/* Whether the first face on the edge has a double among the others. */
static bool edge_has_duplicates(const mt_mesh *mesh, const mt_edge_pairs *pairs, mt_index first)
{
    mt_index face = mt_mesh_corner_face(mesh, first);
    mt_index corner = pairs->next_side[first];
    while (corner != first && !are_duplicates(mesh, face, mt_mesh_corner_face(mesh, corner))) {
        corner = pairs->next_side[corner];
    }
    return corner != first;
}

static mt_status refuse_non_manifold_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    char faces[128];
    mt_index ends[2];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_NON_MANIFOLD);
    mt_index count = list_faces(mesh, pairs, corner, faces, sizeof faces);
    side_ends(mesh, corner, ends);
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD, "edge %u-%u is shared by %u faces (%s); " NEEDS ": %s", ends[0],
                   ends[1], count, faces,
                   edge_has_duplicates(mesh, pairs, corner)
                       ? "some of them are the same face, and `meshtool repair --drop-duplicates` can drop those"
                       : "`meshtool repair --split` can separate them");
}

static mt_status refuse_misoriented_edge(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    char faces[128];
    mt_index ends[2];
    mt_index corner = first_corner_of_class(mesh, pairs, MT_EDGE_MISORIENTED);
    list_faces(mesh, pairs, corner, faces, sizeof faces);
    side_ends(mesh, corner, ends);
    return mt_fail(context, MT_ERROR_NOT_ORIENTED,
                   "faces %s run along edge %u-%u in the same direction; Catmull-Clark needs faces oriented alike: "
                   "`meshtool repair --orient` can turn them where the surface has two sides",
                   faces, ends[0], ends[1]);
}

mt_status mt_subdivide_check_edges(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs)
{
    mt_status status = check_faces(context, mesh, pairs);
    if (status != MT_OK) {
        return status;
    }
    if (pairs->non_manifold_count) {
        return refuse_non_manifold_edge(context, mesh, pairs);
    }
    return pairs->misoriented_count ? refuse_misoriented_edge(context, mesh, pairs) : MT_OK;
}

typedef struct ring_scan {
    const mt_subdivide_topology *topology;
    mt_index *block_counts; /* corners that the rings of a block's vertices reach */
} ring_scan;

MT_SUBDIVIDE_INLINE mt_index ring_length(const mt_subdivide_topology *topology, mt_index vertex, unsigned sides)
{
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    mt_index count = 0;
    mt_index corner = start;
    while (corner != MT_NONE) {
        count++;
        mt_index previous = mt_subdivide_previous(topology, corner, sides);
        corner = topology->twins[previous];
        if (corner == previous || corner == start) {
            break;
        }
    }
    return count;
}

#define RING_LOOP(name, sides)                                                                                         \
    static void name(void *user, uint64_t begin, uint64_t end)                                                         \
    {                                                                                                                  \
        const ring_scan *scan = user;                                                                                  \
        mt_index count = 0;                                                                                            \
        for (uint64_t vertex = begin; vertex < end; vertex++) {                                                        \
            count += ring_length(scan->topology, (mt_index)vertex, sides);                                             \
        }                                                                                                              \
        scan->block_counts[begin / MT_SUBDIVIDE_GRAIN] = count;                                                        \
    }
RING_LOOP(count_polygon_rings, 0)
RING_LOOP(count_triangle_rings, 3)
RING_LOOP(count_quad_rings, 4)

/* Names the first vertex whose ring misses some of its corners, and the first face of the ring and outside. */
static mt_status refuse_vertex(mt_context *context, const mt_subdivide_topology *topology)
{
    unsigned sides = topology->face_size;
    mt_index *missing = mt_allocate_array(context, topology->vertex_count, sizeof *missing);
    if (!missing) {
        return mt_context_error(context)->status;
    }
    for (mt_index vertex = 0; vertex < topology->vertex_count; vertex++) {
        missing[vertex] = 0u - ring_length(topology, vertex, sides);
    }
    for (mt_index corner = 0; corner < topology->corner_count; corner++) {
        missing[topology->corner_vertices[corner]]++;
    }
    mt_index vertex = 0;
    while (!missing[vertex]) {
        vertex++;
    }
    mt_free(context, missing);
    return mt_fail(context, MT_ERROR_NOT_MANIFOLD,
                   "vertex %u joins several separate fans of faces (one of them has face %u); " NEEDS
                   ": `meshtool repair --split` can separate them",
                   vertex, mt_subdivide_face(topology, mt_subdivide_vertex_corner(topology, vertex), sides));
}

mt_status mt_subdivide_check_rings(mt_context *context, const mt_subdivide_topology *topology)
{
    static const mt_parallel_body loops[] = {
        [0] = count_polygon_rings, [3] = count_triangle_rings, [4] = count_quad_rings};
    uint64_t block_count = (uint64_t)topology->vertex_count / MT_SUBDIVIDE_GRAIN + 1;
    ring_scan scan = {.topology = topology};
    scan.block_counts = mt_allocate_array_zeroed(context, block_count, sizeof(mt_index));
    if (!scan.block_counts) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, topology->vertex_count, MT_SUBDIVIDE_GRAIN, loops[topology->face_size], &scan);
    mt_index reached = 0;
    for (uint64_t block = 0; block < block_count; block++) {
        reached += scan.block_counts[block];
    }
    mt_free(context, scan.block_counts);
    return reached == topology->corner_count ? MT_OK : refuse_vertex(context, topology);
}
