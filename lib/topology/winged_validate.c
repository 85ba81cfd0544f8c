/* The invariants of the winged-edge structure: first each edge with its own neighbours, then whole faces and rings,
 * which may be walked once the edges are sound. Wings that answer each other make every walk come back to its
 * beginning.
 *
 * Cost: O(size) time, 8 bytes a vertex and 4 a face. */
#include <meshtool/winged_edge.h>

#include <string.h>

typedef struct winged_inspection {
    mt_context *context;
    const mt_winged_edge_mesh *structure;
    mt_index *degree;  /* per vertex, edges that name it */
    mt_index *sides;   /* per face, edges that name it */
    mt_index *ring_of; /* per vertex the last one in whose ring it was met */
} winged_inspection;

static mt_status inspect_ranges(const winged_inspection *job, mt_index number)
{
    const mt_winged_edge_mesh *structure = job->structure;
    const mt_winged_edge *edge = &structure->edges[number];
    if (edge->head >= structure->vertex_count || edge->tail >= structure->vertex_count || edge->head == edge->tail) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "edge %u runs from vertex %u to %u of %u", number, edge->tail,
                       edge->head, structure->vertex_count);
    }
    bool left = edge->left < structure->face_count, right = edge->right < structure->face_count;
    bool sound = (left || edge->left == MT_NONE) && (right || edge->right == MT_NONE);
    if (!sound || edge->left == edge->right) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "edge %u lies between faces %u and %u of %u", number,
                       edge->left, edge->right, structure->face_count);
    }
    const mt_index wings[4] = {edge->lprev, edge->lnext, edge->rprev, edge->rnext};
    for (int i = 0; i < 4; i++) {
        if (wings[i] >= structure->edge_count) {
            return mt_fail(job->context, MT_ERROR_INTERNAL, "edge %u has edge %u of %u as a wing", number, wings[i],
                           structure->edge_count);
        }
    }
    job->degree[edge->head]++;
    job->degree[edge->tail]++;
    job->sides[left ? edge->left : edge->right]++;
    if (left && right) {
        job->sides[edge->right]++;
    }
    return MT_OK;
}

/* Whether a side of edge `number` that has `face` on its left begins at `tail` and ends at `head`. */
static bool has_side(const mt_winged_edge_mesh *structure, mt_index number, mt_index face, mt_index vertex, bool begins)
{
    const mt_winged_edge *edge = &structure->edges[number];
    return (edge->left == face && (begins ? edge->tail : edge->head) == vertex) ||
           (edge->right == face && (begins ? edge->head : edge->tail) == vertex);
}

/* The side with `face` on its left runs from `tail` to `head`; its wings must touch it there and answer. */
static mt_status inspect_wings(const winged_inspection *job, mt_index number, bool is_left)
{
    const mt_winged_edge_mesh *structure = job->structure;
    const mt_winged_edge *edge = &structure->edges[number];
    mt_index face = is_left ? edge->left : edge->right;
    mt_index previous = is_left ? edge->lprev : edge->rprev, next = is_left ? edge->lnext : edge->rnext;
    mt_index tail = is_left ? edge->tail : edge->head, head = is_left ? edge->head : edge->tail;
    const char *side = is_left ? "left" : "right";
    if (!has_side(structure, previous, face, tail, false) || mt_winged_edge_next(structure, previous, face) != number) {
        return mt_fail(job->context, MT_ERROR_INTERNAL,
                       "edge %u has edge %u before it on its %s, which does not lead there", number, previous, side);
    }
    if (!has_side(structure, next, face, head, true) || mt_winged_edge_previous(structure, next, face) != number) {
        return mt_fail(job->context, MT_ERROR_INTERNAL,
                       "edge %u has edge %u after it on its %s, which does not come from there", number, next, side);
    }
    return MT_OK;
}

static mt_status inspect_face(const winged_inspection *job, mt_index face)
{
    const mt_winged_edge_mesh *structure = job->structure;
    mt_index begin = structure->face_edge[face], count = 0;
    if (begin >= structure->edge_count ||
        (structure->edges[begin].left != face && structure->edges[begin].right != face)) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "face %u has edge %u, which is not one of its own", face,
                       begin);
    }
    mt_index edge = begin;
    do {
        edge = mt_winged_edge_next(structure, edge, face);
        count++;
    } while (edge != begin);
    if (count != job->sides[face] || count < 3) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "the walk around face %u meets %u of its %u edges", face, count,
                       job->sides[face]);
    }
    return MT_OK;
}

static mt_status inspect_ring(const winged_inspection *job, mt_index vertex)
{
    const mt_winged_edge_mesh *structure = job->structure;
    mt_index begin = structure->vertex_edge[vertex], count = 0, holes = 0;
    if (begin != MT_NONE && (begin >= structure->edge_count ||
                             (structure->edges[begin].tail != vertex && structure->edges[begin].head != vertex))) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "vertex %u has edge %u, which is not one of its own", vertex,
                       begin);
    }
    mt_index last_face = 0;
    for (mt_winged_ring ring = mt_winged_ring_begin(structure, vertex); mt_winged_ring_goes_on(&ring);
         mt_winged_ring_counterclockwise(structure, &ring)) {
        if (job->ring_of[ring.neighbor] == vertex) {
            return mt_fail(job->context, MT_ERROR_INTERNAL, "two edges join vertices %u and %u", vertex, ring.neighbor);
        }
        job->ring_of[ring.neighbor] = vertex;
        last_face = ring.face;
        holes += ring.face == MT_NONE;
        count++;
    }
    if (count != job->degree[vertex] || holes > 1) {
        return mt_fail(job->context, MT_ERROR_INTERNAL, "the ring of vertex %u meets %u of its %u edges and %u holes",
                       vertex, count, job->degree[vertex], holes);
    }
    if (holes && last_face != MT_NONE) {
        return mt_fail(job->context, MT_ERROR_INTERNAL,
                       "the ring of vertex %u on the boundary does not begin there, at edge %u", vertex, begin);
    }
    return MT_OK;
}

static mt_status inspect_all(const winged_inspection *job)
{
    const mt_winged_edge_mesh *structure = job->structure;
    mt_status status = MT_OK;
    for (mt_index edge = 0; edge < structure->edge_count && status == MT_OK; edge++) {
        status = inspect_ranges(job, edge);
    }
    for (mt_index edge = 0; edge < structure->edge_count && status == MT_OK; edge++) {
        status = inspect_wings(job, edge, true);
        status = status == MT_OK ? inspect_wings(job, edge, false) : status;
    }
    for (mt_index face = 0; face < structure->face_count && status == MT_OK; face++) {
        status = inspect_face(job, face);
    }
    for (mt_index vertex = 0; vertex < structure->vertex_count && status == MT_OK; vertex++) {
        status = inspect_ring(job, vertex);
    }
    return status;
}

mt_status mt_winged_edge_validate(mt_context *context, const mt_winged_edge_mesh *structure)
{
    winged_inspection job = {.context = context, .structure = structure};
    job.degree = mt_allocate_array_zeroed(context, structure->vertex_count, sizeof *job.degree);
    job.sides = mt_allocate_array_zeroed(context, structure->face_count, sizeof *job.sides);
    job.ring_of = mt_allocate_array(context, structure->vertex_count, sizeof *job.ring_of);
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (job.degree && job.sides && job.ring_of) {
        memset(job.ring_of, 0xff, structure->vertex_count * sizeof *job.ring_of);
        status = inspect_all(&job);
    }
    mt_free(context, job.degree);
    mt_free(context, job.sides);
    mt_free(context, job.ring_of);
    return status;
}
