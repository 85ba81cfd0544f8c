/* Every invariant of the half-edge structure, the first violation named. Cost: O(size) time, a byte for
 * each half-edge. */
#include <meshtool/halfedge.h>

#include <string.h>

#define BROKEN(context, ...) mt_fail(context, MT_ERROR_INTERNAL, __VA_ARGS__)

static mt_status check_ranges(mt_context *context, const mt_halfedge_mesh *structure)
{
    if (structure->halfedge_count % 2) {
        return BROKEN(context, "%u half-edges do not come in pairs", structure->halfedge_count);
    }
    for (mt_index h = 0; h < structure->halfedge_count; h++) {
        mt_halfedge own = structure->halfedges[h];
        if (own.next >= structure->halfedge_count || own.head >= structure->vertex_count ||
            (own.face >= structure->face_count && own.face != MT_NONE)) {
            return BROKEN(context, "half-edge %u has next %u, head %u, face %u: out of range", h, own.next, own.head,
                          own.face);
        }
    }
    for (mt_index v = 0; v < structure->vertex_count; v++) {
        mt_index own = structure->vertex_halfedge[v];
        if (own != MT_NONE && (own >= structure->halfedge_count || mt_halfedge_head(structure, own) != v)) {
            return BROKEN(context, "vertex %u has half-edge %u, which does not point to it", v, own);
        }
    }
    for (mt_index face = 0; face < structure->face_count; face++) {
        mt_index own = structure->face_halfedge[face];
        if (own >= structure->halfedge_count || mt_halfedge_face(structure, own) != face) {
            return BROKEN(context, "face %u has half-edge %u, which is not its own", face, own);
        }
    }
    return MT_OK;
}

/* Each half-edge against its twin and its next; each is the next of one other. */
static mt_status check_links(mt_context *context, const mt_halfedge_mesh *structure, uint8_t *is_next)
{
    for (mt_index h = 0; h < structure->halfedge_count; h++) {
        mt_halfedge own = structure->halfedges[h];
        if (own.head == mt_halfedge_tail(structure, h)) {
            return BROKEN(context, "half-edge %u runs from vertex %u to itself", h, own.head);
        }
        if (own.face == MT_NONE && mt_halfedge_is_boundary(structure, h ^ 1u)) {
            return BROKEN(context, "edge %u has no face on either side", h >> 1);
        }
        if (mt_halfedge_tail(structure, own.next) != own.head) {
            return BROKEN(context, "half-edge %u points to vertex %u, its next %u leaves %u", h, own.head, own.next,
                          mt_halfedge_tail(structure, own.next));
        }
        if (mt_halfedge_face(structure, own.next) != own.face) {
            return BROKEN(context, "half-edge %u and its next %u lie in different faces", h, own.next);
        }
        if (is_next[own.next]) {
            return BROKEN(context, "half-edge %u is the next of two others", own.next);
        }
        is_next[own.next] = 1;
        if (own.face == MT_NONE && structure->vertex_halfedge[own.head] != h) {
            return BROKEN(context, "boundary half-edge %u is not the one that vertex %u keeps", h, own.head);
        }
    }
    return MT_OK;
}

/* Walks each face from its half-edge: all half-edges of the face must be met, and there must be at least three. */
static mt_status check_faces(mt_context *context, const mt_halfedge_mesh *structure)
{
    uint64_t met = 0, inner = 0;
    for (mt_index h = 0; h < structure->halfedge_count; h++) {
        inner += !mt_halfedge_is_boundary(structure, h);
    }
    for (mt_index face = 0; face < structure->face_count; face++) {
        mt_index sides = 0;
        mt_index h = structure->face_halfedge[face];
        do {
            sides++;
            h = mt_halfedge_next(structure, h);
        } while (h != structure->face_halfedge[face]);
        if (sides < 3) {
            return BROKEN(context, "face %u has %u sides", face, sides);
        }
        met += sides;
    }
    if (met != inner) {
        return BROKEN(context, "walks around the faces meet %llu of %llu half-edges with a face",
                      (unsigned long long)met, (unsigned long long)inner);
    }
    return MT_OK;
}

/* Walks around each vertex: all half-edges that point to it must be met. */
static mt_status check_vertices(mt_context *context, const mt_halfedge_mesh *structure, uint8_t *met)
{
    memset(met, 0, structure->halfedge_count);
    for (mt_index v = 0; v < structure->vertex_count; v++) {
        mt_index h = structure->vertex_halfedge[v];
        while (h != MT_NONE && !met[h]) {
            met[h] = 1;
            h = mt_halfedge_clockwise(structure, h);
        }
    }
    for (mt_index h = 0; h < structure->halfedge_count; h++) {
        if (!met[h]) {
            return BROKEN(context, "the walk around vertex %u misses half-edge %u", mt_halfedge_head(structure, h), h);
        }
    }
    return MT_OK;
}

mt_status mt_halfedge_validate(mt_context *context, const mt_halfedge_mesh *structure)
{
    mt_status status = check_ranges(context, structure);
    if (status != MT_OK) {
        return status;
    }
    uint8_t *marks = mt_allocate_zeroed(context, structure->halfedge_count);
    if (!marks) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    status = check_links(context, structure, marks);
    status = status == MT_OK ? check_faces(context, structure) : status;
    status = status == MT_OK ? check_vertices(context, structure, marks) : status;
    mt_free(context, marks);
    return status;
}
