/* Faces of a few sides are compared with themselves, larger ones by marks on their vertices, so that a face of 10^5
 * sides costs linear time too. */
#include <meshtool/degenerate_faces.h>

#include <stdatomic.h>
#include <string.h>

#define PAIRWISE_SIDES 8
#define GRAIN 32768

typedef struct degenerate_scan {
    const mt_mesh *mesh;
    uint8_t *flags;
    atomic_uint count;
    atomic_bool has_large;
} degenerate_scan;

static bool repeats_vertex(const mt_index *vertices, mt_index sides)
{
    mt_index repeats = 0;
    for (mt_index i = 1; i < sides; i++) {
        for (mt_index j = 0; j < i; j++) {
            repeats |= vertices[i] == vertices[j];
        }
    }
    return repeats;
}

static void scan_triangles(void *user, uint64_t begin, uint64_t end)
{
    degenerate_scan *scan = user;
    mt_index count = 0;
    const mt_index *vertex = scan->mesh->corner_vertices + 3 * begin;
    for (uint64_t face = begin; face < end; face++, vertex += 3) {
        uint8_t repeats = (uint8_t)((vertex[0] == vertex[1]) | (vertex[1] == vertex[2]) | (vertex[2] == vertex[0]));
        scan->flags[face] = repeats;
        count += repeats;
    }
    atomic_fetch_add(&scan->count, count);
}

static void scan_quads(void *user, uint64_t begin, uint64_t end)
{
    degenerate_scan *scan = user;
    mt_index count = 0;
    const mt_index *v = scan->mesh->corner_vertices + 4 * begin;
    for (uint64_t face = begin; face < end; face++, v += 4) {
        uint8_t repeats = (uint8_t)((v[0] == v[1]) | (v[1] == v[2]) | (v[2] == v[3]) | (v[3] == v[0]) | (v[0] == v[2]) |
                                    (v[1] == v[3]));
        scan->flags[face] = repeats;
        count += repeats;
    }
    atomic_fetch_add(&scan->count, count);
}

static void scan_polygons(void *user, uint64_t begin, uint64_t end)
{
    degenerate_scan *scan = user;
    mt_index count = 0;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index sides = mt_mesh_face_sides(scan->mesh, face);
        const mt_index *vertices = scan->mesh->corner_vertices + mt_mesh_face_begin(scan->mesh, face);
        bool large = sides > PAIRWISE_SIDES;
        if (large) {
            atomic_store(&scan->has_large, true);
        }
        scan->flags[face] = !large && repeats_vertex(vertices, sides);
        count += scan->flags[face];
    }
    atomic_fetch_add(&scan->count, count);
}

static void scan_large(degenerate_scan *scan, mt_index *last_face)
{
    const mt_mesh *mesh = scan->mesh;
    memset(last_face, 0xff, mesh->vertex_count * sizeof *last_face);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index end = mt_mesh_face_end(mesh, face);
        mt_index begin = mt_mesh_face_begin(mesh, face);
        if (end - begin <= PAIRWISE_SIDES) {
            continue;
        }
        for (mt_index c = begin; c < end; c++) {
            mt_index *last = &last_face[mesh->corner_vertices[c]];
            scan->flags[face] |= *last == face;
            *last = face;
        }
        scan->count += scan->flags[face];
    }
}

mt_status mt_find_degenerate_faces(mt_context *context, const mt_mesh *mesh, uint8_t *flags, mt_index *count)
{
    degenerate_scan scan = {.mesh = mesh, .flags = flags};
    mt_index size = mesh->face_offsets ? 0 : mesh->face_size;
    mt_parallel_body body = size == 3 ? scan_triangles : size == 4 ? scan_quads : scan_polygons;
    mt_parallel_for(context, mesh->face_count, GRAIN, body, &scan);
    if (scan.has_large) {
        mt_index *last_face = mt_allocate_array(context, mesh->vertex_count, sizeof *last_face);
        if (!last_face) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        scan_large(&scan, last_face);
        mt_free(context, last_face);
    }
    *count = scan.count;
    return MT_OK;
}
