/* libmeshoptimizer orders triangles by a score of their vertices' places in a cache (after Forsyth, "Linear-Speed
 * Vertex Cache Optimisation", 2006). It gives back vertices and not which triangle they were, so that is found again by
 * a hash of the three. */
#include <meshtool/order.h>

#include <meshtool/derive.h>
#include <meshtool/triangulate.h>

#include <string.h>

#ifdef MESHTOOL_MESHOPT
#include <meshoptimizer.h>

/* What the library allocates for itself, at most: five arrays over vertices and corners, checked against the limit. */
#define OWN_BYTES_A_VERTEX 16
#define OWN_BYTES_A_TRIANGLE 32

typedef struct order_job {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    mt_index *vertices, *ordered; /* 3 a triangle */
    mt_index *heads, *nexts;      /* triangles by the hash of their vertices, the lowest first */
    mt_index mask;                /* heads - 1 */
    mt_index *face_sources, *corner_sources, *face_offsets;
} order_job;

static mt_index hash_of(const order_job *job, const mt_index *v)
{
    uint64_t hash = v[0] * UINT64_C(0x9e3779b97f4a7c15) ^ v[1] * UINT64_C(0xbf58476d1ce4e5b9);
    hash = (hash ^ hash >> 29) * UINT64_C(0x94d049bb133111eb) ^ v[2] * UINT64_C(0xd6e8feb86659fd93);
    return (mt_index)(hash >> 32 ^ hash) & job->mask;
}

static mt_status allocate(mt_context *context, order_job *job)
{
    uint64_t count = job->triangulation.triangle_count, heads = 1;
    while (heads < count) {
        heads *= 2;
    }
    job->mask = (mt_index)(heads - 1);
    job->vertices = mt_allocate_array(context, count, 3 * sizeof(mt_index));
    job->ordered = mt_allocate_array(context, count, 3 * sizeof(mt_index));
    job->heads = mt_allocate_array(context, heads, sizeof(mt_index));
    job->nexts = mt_allocate_array(context, count, sizeof(mt_index));
    job->face_sources = mt_allocate_array(context, job->mesh->face_count, sizeof(mt_index));
    job->corner_sources = mt_allocate_array(context, job->mesh->corner_count, sizeof(mt_index));
    job->face_offsets = mt_allocate_array(context, job->mesh->face_count + (uint64_t)1, sizeof(mt_index));
    void *own = mt_allocate(context, job->mesh->vertex_count * (uint64_t)OWN_BYTES_A_VERTEX +
                                         count * (uint64_t)OWN_BYTES_A_TRIANGLE);
    bool done = job->vertices && job->ordered && job->heads && job->nexts && job->face_sources && job->corner_sources &&
                job->face_offsets && own;
    mt_free(context, own);
    return done ? MT_OK : mt_context_error(context)->status;
}

static void release(mt_context *context, order_job *job)
{
    void *blocks[] = {job->vertices,     job->ordered,        job->heads,       job->nexts,
                      job->face_sources, job->corner_sources, job->face_offsets};
    for (size_t i = 0; i < sizeof blocks / sizeof blocks[0]; i++) {
        mt_free(context, blocks[i]);
    }
    mt_triangulation_release(context, &job->triangulation);
}

static void enter_triangles(order_job *job)
{
    memset(job->heads, 0xff, ((size_t)job->mask + 1) * sizeof(mt_index));
    for (mt_index t = job->triangulation.triangle_count; t-- > 0;) {
        mt_index *v = job->vertices + 3 * (size_t)t;
        for (mt_index side = 0; side < 3; side++) {
            v[side] = job->mesh->corner_vertices[mt_triangulation_corner(&job->triangulation, t, side)];
        }
        mt_index *head = &job->heads[hash_of(job, v)];
        job->nexts[t] = *head;
        *head = t;
    }
}

/* Takes the first triangle of these vertices from its list. */
static mt_index take(order_job *job, const mt_index *v)
{
    mt_index *at = &job->heads[hash_of(job, v)];
    while (*at != MT_NONE && memcmp(job->vertices + 3 * (size_t)*at, v, 3 * sizeof(mt_index)) != 0) {
        at = &job->nexts[*at];
    }
    mt_index found = *at;
    if (found != MT_NONE) {
        *at = job->nexts[found];
    }
    return found;
}

static void append_face(order_job *job, mt_index face, mt_index *count)
{
    mt_index begin = mt_mesh_face_begin(job->mesh, face), sides = mt_mesh_face_sides(job->mesh, face);
    mt_index to = job->face_offsets[*count];
    for (mt_index i = 0; i < sides; i++) {
        job->corner_sources[to + i] = begin + i;
    }
    job->face_sources[(*count)++] = face;
    job->face_offsets[*count] = to + sides;
}

/* False when what came back are not the triangles that went in. */
static bool list_faces(order_job *job, uint8_t *done)
{
    mt_index count = 0;
    job->face_offsets[0] = 0;
    for (mt_index i = 0; i < job->triangulation.triangle_count; i++) {
        mt_index triangle = take(job, job->ordered + 3 * (size_t)i);
        if (triangle == MT_NONE) {
            return false;
        }
        mt_index face = mt_triangulation_face(&job->triangulation, triangle);
        if (!done[face]) {
            done[face] = 1;
            append_face(job, face, &count);
        }
    }
    return count == job->mesh->face_count;
}

static mt_status order(mt_context *context, order_job *job)
{
    uint8_t *done = mt_allocate_zeroed(context, job->mesh->face_count);
    if (!done) {
        return mt_context_error(context)->status;
    }
    enter_triangles(job);
    meshopt_optimizeVertexCache(job->ordered, job->vertices, 3 * (size_t)job->triangulation.triangle_count,
                                job->mesh->vertex_count);
    bool listed = list_faces(job, done);
    mt_free(context, done);
    return listed ? MT_OK
                  : mt_fail(context, MT_ERROR_INTERNAL, "libmeshoptimizer gave back other triangles than it was given");
}

mt_status mt_mesh_order_faces(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    order_job job = {.mesh = mesh};
    *out = NULL;
    mt_status status = mt_triangulation_init(context, mesh, &job.triangulation);
    if (status == MT_OK) {
        status = allocate(context, &job);
    }
    if (status == MT_OK) {
        status = order(context, &job);
    }
    if (status == MT_OK) {
        mt_derivation derivation = {.vertex_count = mesh->vertex_count,
                                    .face_count = mesh->face_count,
                                    .face_size = mesh->face_size,
                                    .face_offsets = job.face_offsets,
                                    .face_sources = job.face_sources,
                                    .corner_count = mesh->corner_count,
                                    .corner_sources = job.corner_sources};
        status = mt_mesh_derive(context, mesh, &derivation, out);
    }
    release(context, &job);
    return status;
}

/* The library takes whole triangles: the corners of n-gons are filled up by their last. Returns how many vertices faces
 * name; MT_NONE: memory is missing. */
static mt_index order_by_use(mt_context *context, const mt_mesh *mesh, mt_index *targets)
{
    uint64_t count = (mesh->corner_count + (uint64_t)2) / 3 * 3;
    mt_index *corners = mt_allocate_array(context, count, sizeof *corners);
    if (!corners) {
        return MT_NONE;
    }
    for (uint64_t i = 0; i < count; i++) {
        corners[i] = mesh->corner_vertices[i < mesh->corner_count ? i : mesh->corner_count - 1];
    }
    size_t used = meshopt_optimizeVertexFetchRemap(targets, corners, (size_t)count, mesh->vertex_count);
    mt_free(context, corners);
    return (mt_index)used;
}

static mt_status derive_vertices(mt_context *context, const mt_mesh *mesh, mt_index *targets, mt_index *sources,
                                 mt_mesh **out)
{
    mt_index next = order_by_use(context, mesh, targets);
    if (next == MT_NONE) {
        return mt_context_error(context)->status;
    }
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        targets[v] = targets[v] == MT_NONE ? next++ : targets[v];
        sources[targets[v]] = v;
    }
    mt_derivation derivation = {.vertex_count = mesh->vertex_count,
                                .vertex_sources = sources,
                                .vertex_targets = targets,
                                .face_count = mesh->face_count,
                                .face_size = mesh->face_size,
                                .face_offsets = mesh->face_offsets,
                                .corner_count = mesh->corner_count};
    return mt_mesh_derive(context, mesh, &derivation, out);
}

mt_status mt_mesh_order_vertices(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_index *targets = mt_allocate_array(context, mesh->vertex_count, sizeof(mt_index));
    mt_index *sources = mt_allocate_array(context, mesh->vertex_count, sizeof(mt_index));
    mt_status status =
        targets && sources ? derive_vertices(context, mesh, targets, sources, out) : mt_context_error(context)->status;
    mt_free(context, targets);
    mt_free(context, sources);
    return status;
}

#else

static mt_status fail_missing(mt_context *context, mt_mesh **out)
{
    *out = NULL;
    return mt_fail(context, MT_ERROR_UNSUPPORTED,
                   "this meshtool was built without libmeshoptimizer, which orders faces and vertices");
}

mt_status mt_mesh_order_faces(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    (void)mesh;
    return fail_missing(context, out);
}

mt_status mt_mesh_order_vertices(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    (void)mesh;
    return fail_missing(context, out);
}

#endif
