/* Faces are joined across edges by union-find: parents point to lower faces only and paths are halved on the way. First
 * each face is linked to its lowest neighbour, which one pass does; of what is left only the faces outside of the
 * largest tree are looked at again. Where some edge is misoriented each link also says whether the two faces run
 * against each other, and an edge whose faces are joined already may contradict: then nothing can orient the surface.
 *
 * Source: Tarjan, van Leeuwen, "Worst-case Analysis of Set Union Algorithms", Journal of the ACM 31 (1984);
 * Sutton, Ben-Nun, Barak, "Optimizing Parallel Graph Connectivity Computation via Subgraph Sampling", IPDPS 2018.
 * Cost: nearly O(corners) time; 4 bytes a face, 1 more where edges are misoriented, 4 a corner where faces differ in
 * size. */
#include <meshtool/components.h>

#include <string.h>

#define RANGES_MAXIMUM 4 /* of faces, linked by a thread each */
#define SAMPLE_COUNT 64

typedef struct joining {
    const mt_mesh *mesh;
    const mt_edge_pairs *pairs;
    mt_index *corner_face; /* NULL when all faces have the same size */
    mt_index *parent;
    uint8_t *turned; /* against the parent; NULL when no edge is misoriented */
    mt_index unions;
    mt_index range_unions[RANGES_MAXIMUM];
    mt_index range_count;
    mt_index unorientable_corner;
} joining;

static inline mt_index face_of(const joining *job, mt_index corner)
{
    if (job->corner_face) {
        return job->corner_face[corner];
    }
    return job->mesh->face_size == 3 ? corner / 3 : corner / job->mesh->face_size;
}

static inline mt_index find_root(mt_index *parent, mt_index face)
{
    while (parent[face] != face) {
        mt_index above = parent[parent[face]];
        parent[face] = above;
        face = above;
    }
    return face;
}

static void join_faces(joining *job, mt_index a, mt_index b)
{
    mt_index low = find_root(job->parent, a);
    mt_index high = find_root(job->parent, b);
    if (low == high) {
        return;
    }
    job->parent[low < high ? high : low] = low < high ? low : high;
    job->unions++;
}

/* The root, with *turned telling whether the face runs against it; the path is halved with the signs kept. A root's own
 * sign is 0. */
static mt_index find_signed_root(joining *job, mt_index face, uint8_t *turned)
{
    mt_index *parent = job->parent;
    uint8_t sign = 0;
    while (parent[face] != face) {
        mt_index above = parent[face];
        job->turned[face] ^= job->turned[above];
        parent[face] = parent[above];
        sign ^= job->turned[face];
        face = parent[face];
    }
    *turned = sign;
    return face;
}

static void join_signed_faces(joining *job, mt_index a, mt_index b, bool against, mt_index corner)
{
    uint8_t a_turned, b_turned;
    mt_index low = find_signed_root(job, a, &a_turned);
    mt_index high = find_signed_root(job, b, &b_turned);
    uint8_t sign = a_turned ^ b_turned ^ (uint8_t)against;
    if (low == high) {
        if (sign && job->unorientable_corner == MT_NONE) {
            job->unorientable_corner = corner;
        }
        return;
    }
    mt_index from = low < high ? high : low;
    job->parent[from] = low < high ? low : high;
    job->turned[from] = sign;
    job->unions++;
}

/* The lowest corner across a side, or the face's own; MT_NONE, of a side a = b, is above all. */
static inline mt_index lowest_corner(const mt_index *next_side, mt_index begin, mt_index end)
{
    mt_index lowest = begin;
    for (mt_index c = begin; c < end; c++) {
        lowest = next_side[c] < lowest ? next_side[c] : lowest;
    }
    return lowest;
}

/* Some faces: each is joined to its lowest neighbour, and then hangs at that one's parent, which is a root or before
 * `begin`. */
static inline mt_index link_faces(const joining *job, mt_index begin, mt_index end, bool triangles)
{
    const mt_index *next_side = job->pairs->next_side;
    mt_index *parent = job->parent;
    mt_index unions = 0;
    for (mt_index face = begin; face < end; face++) {
        mt_index first = triangles ? 3 * face : mt_mesh_face_begin(job->mesh, face);
        mt_index last = triangles ? first + 3 : mt_mesh_face_end(job->mesh, face);
        mt_index lowest = lowest_corner(next_side, first, last);
        mt_index above = triangles ? lowest / 3 : face_of(job, lowest);
        unions += above != face;
        parent[face] = above;
        parent[face] = above < begin ? above : parent[above];
    }
    return unions;
}

static void link_range(joining *job, mt_index range)
{
    uint64_t face_count = job->mesh->face_count;
    mt_index begin = (mt_index)(face_count * range / job->range_count);
    mt_index end = (mt_index)(face_count * (range + 1) / job->range_count);
    bool triangles = !job->mesh->face_offsets && job->mesh->face_size == 3;
    job->range_unions[range] = triangles ? link_faces(job, begin, end, true) : link_faces(job, begin, end, false);
}

static void link_ranges(void *user, uint64_t begin, uint64_t end)
{
    for (uint64_t range = begin; range < end; range++) {
        link_range(user, (mt_index)range);
    }
}

/* The root of most of some faces: of the largest component so far, if there is a large one. */
static mt_index common_root(joining *job)
{
    mt_index roots[SAMPLE_COUNT];
    mt_index best = 0, best_count = 0;
    for (mt_index i = 0; i < SAMPLE_COUNT; i++) {
        roots[i] = find_root(job->parent, (mt_index)((uint64_t)job->mesh->face_count * i / SAMPLE_COUNT));
        mt_index count = 0;
        for (mt_index j = 0; j <= i; j++) {
            count += roots[j] == roots[i];
        }
        best = count > best_count ? roots[i] : best;
        best_count = count > best_count ? count : best_count;
    }
    return best;
}

/* Joins the faces that do not hang at the common root to all of their neighbours. That takes in what may join those
 * that do: around each edge every side leads to another, until all have been met. */
static void join_rest(joining *job, mt_index common)
{
    const mt_index *next_side = job->pairs->next_side;
    for (mt_index face = 0; face < job->mesh->face_count; face++) {
        if (job->parent[face] == common || find_root(job->parent, face) == common) {
            continue;
        }
        mt_index end = mt_mesh_face_end(job->mesh, face);
        for (mt_index c = mt_mesh_face_begin(job->mesh, face); c < end; c++) {
            if (next_side[c] != MT_NONE) {
                join_faces(job, face, face_of(job, next_side[c]));
            }
        }
    }
}

static void join_all(mt_context *context, joining *job)
{
    unsigned threads = mt_context_thread_count(context);
    job->range_count = threads < RANGES_MAXIMUM ? threads : RANGES_MAXIMUM;
    mt_parallel_for(context, job->range_count, 1, link_ranges, job);
    for (mt_index range = 0; range < job->range_count; range++) {
        job->unions += job->range_unions[range];
    }
    if (job->unions + 1 < job->mesh->face_count) {
        join_rest(job, common_root(job));
    }
}

static void join_all_signed(joining *job)
{
    const mt_mesh *mesh = job->mesh;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index end = mt_mesh_face_end(mesh, face);
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < end; c++) {
            mt_index other = job->pairs->next_side[c];
            if (other < c) {
                bool against = mt_edge_class_of(mesh, job->pairs, c) == MT_EDGE_MISORIENTED;
                join_signed_faces(job, face, face_of(job, other), against, c);
            }
        }
    }
}

static bool prepare(mt_context *context, joining *job)
{
    const mt_mesh *mesh = job->mesh;
    job->parent = mt_allocate_array(context, mesh->face_count, sizeof *job->parent);
    if (!job->parent) {
        return false;
    }
    if (job->pairs->misoriented_count) {
        for (mt_index face = 0; face < mesh->face_count; face++) {
            job->parent[face] = face;
        }
        job->turned = mt_allocate_zeroed(context, mesh->face_count);
        if (!job->turned) {
            return false;
        }
    }
    if (mesh->face_offsets) {
        job->corner_face = mt_allocate_array(context, mesh->corner_count, sizeof *job->corner_face);
        if (!job->corner_face) {
            return false;
        }
        for (mt_index face = 0; face < mesh->face_count; face++) {
            for (mt_index c = mesh->face_offsets[face]; c < mesh->face_offsets[face + 1]; c++) {
                job->corner_face[c] = face;
            }
        }
    }
    return true;
}

static void join_faces_of_mesh(mt_context *context, joining *job)
{
    if (job->turned) {
        join_all_signed(job);
    } else {
        join_all(context, job);
    }
}

/* A root is the lowest face of its component, so every face finds its root numbered. */
static mt_status keep_details(mt_context *context, joining *job, mt_components *components)
{
    mt_index face_count = job->mesh->face_count;
    components->face_component = mt_allocate_array(context, face_count, sizeof *components->face_component);
    components->face_turned = mt_allocate_zeroed(context, face_count);
    if (!components->face_component || !components->face_turned) {
        return mt_context_error(context)->status;
    }
    mt_index count = 0;
    for (mt_index face = 0; face < face_count; face++) {
        mt_index root =
            job->turned ? find_signed_root(job, face, &components->face_turned[face]) : find_root(job->parent, face);
        components->face_component[face] = root == face ? count++ : components->face_component[root];
    }
    return MT_OK;
}

mt_status mt_components_create(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs, bool details,
                               mt_components **out)
{
    *out = NULL;
    mt_components *components = mt_allocate_zeroed(context, sizeof *components);
    joining job = {.mesh = mesh, .pairs = pairs, .unorientable_corner = MT_NONE};
    mt_status status = components && prepare(context, &job) ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        join_faces_of_mesh(context, &job);
        components->face_count = mesh->face_count;
        components->component_count = mesh->face_count - job.unions;
        components->unorientable_corner = job.unorientable_corner;
        components->orientable = job.unorientable_corner == MT_NONE;
        status = details ? keep_details(context, &job, components) : MT_OK;
    }
    mt_free(context, job.parent);
    mt_free(context, job.turned);
    mt_free(context, job.corner_face);
    if (status == MT_OK) {
        *out = components;
    } else {
        mt_components_destroy(context, components);
    }
    return status;
}

void mt_components_destroy(mt_context *context, mt_components *components)
{
    if (components) {
        mt_free(context, components->face_component);
        mt_free(context, components->face_turned);
        mt_free(context, components);
    }
}
