/* Every vertex to its limit: most by one mask of the quads around it, those at creases by what is sharp there.
 * Sources and masks: subdivide_limit_ring.h. Cost: O(corners); the positions once more, 4 bytes a
 * vertex, 4 an edge when anything is sharp. */
#include "lib/algorithms/subdivide_limit.h"

#include "lib/algorithms/subdivide_limit_rings.h"

#include <string.h>

#define LIMIT_GRAIN 4096

typedef struct limit_job {
    mt_limit_rings rings;
    void *positions;
    mt_attribute *normals;
} limit_job;

static void store(const limit_job *job, mt_index vertex, mt_vec3 position)
{
    const double numbers[3] = {position.x, position.y, position.z};
    for (unsigned k = 0; k < 3; k++) {
        if (job->rings.mesh->position_type == MT_F64) {
            ((double *)job->positions)[3 * (size_t)vertex + k] = numbers[k];
        } else {
            ((float *)job->positions)[3 * (size_t)vertex + k] = (float)numbers[k];
        }
    }
}

/* Adding 0 leaves no -0, which text would show. */
static void store_normal(const limit_job *job, mt_index value, mt_vec3 normal)
{
    mt_attribute_set(job->normals, value, 0, normal.x + 0.0);
    mt_attribute_set(job->normals, value, 1, normal.y + 0.0);
    mt_attribute_set(job->normals, value, 2, normal.z + 0.0);
}

/* Of a vertex as if nothing were sharp but the boundary. */
static void limit_ring(const limit_job *job, mt_index vertex, const mt_limit_ring *ring)
{
    mt_subdivide_vertex_rule rule = ring->closed ? MT_VERTEX_SMOOTH : MT_VERTEX_CREASE;
    store(job, vertex, mt_limit_position(ring, rule, 0, ring->closed ? 0 : ring->face_count));
    store_normal(job, vertex, mt_limit_normal(ring, rule, (mt_limit_sector){0, ring->face_count}));
}

static void limit_small_rings(void *user, uint64_t begin, uint64_t end)
{
    const limit_job *job = user;
    mt_vec3 ends[MT_LIMIT_SMALL_RING + 1], diagonals[MT_LIMIT_SMALL_RING];
    mt_limit_ring ring = {.ends = ends, .diagonals = diagonals};
    for (mt_index vertex = (mt_index)begin; vertex < end; vertex++) {
        if (job->rings.topology->vertex_corners[vertex] == MT_NONE) {
            store(job, vertex, mt_mesh_position(job->rings.mesh, vertex));
            store_normal(job, vertex, mt_vec3_make(0, 0, 1));
        } else if (mt_limit_ring_gather(&job->rings, vertex, MT_LIMIT_SMALL_RING, &ring, NULL)) {
            limit_ring(job, vertex, &ring);
        }
    }
}

static void limit_large_rings(limit_job *job)
{
    mt_limit_ring *ring = &job->rings.ring.ring;
    for (mt_index i = 0; i < job->rings.large_count; i++) {
        mt_limit_ring_gather(&job->rings, job->rings.large[i], MT_INDEX_MAX, ring, NULL);
        limit_ring(job, job->rings.large[i], ring);
    }
}

/* The first sector has the vertex's own normal, each other a new one at the end of the list. */
static void limit_sectors(limit_job *job, mt_index vertex, mt_subdivide_vertex_rule rule, mt_index sector_count,
                          mt_index *value_count)
{
    for (mt_index i = 0; i < sector_count; i++) {
        mt_limit_sector sector = mt_limit_rings_sector(&job->rings, i, sector_count);
        mt_index value = i ? (*value_count)++ : vertex;
        store_normal(job, value, mt_limit_normal(&job->rings.ring.ring, rule, sector));
        for (mt_index k = 0; job->normals->indices && k < sector.face_count; k++) {
            mt_index face = (sector.first + k) % job->rings.ring.ring.face_count;
            job->normals->indices[job->rings.corners[face]] = value;
        }
    }
}

static void limit_sharp_rings(limit_job *job)
{
    const mt_subdivide_sharp *sharp = job->rings.sharp;
    mt_index value_count = job->rings.topology->vertex_count;
    for (mt_index i = 0; i < sharp->vertex_count; i++) {
        mt_index vertex = job->rings.topology->corner_vertices[sharp->vertices[i].corner];
        mt_vec3 normal = {0, 0, 1};
        mt_limit_rings_gather_sharp(&job->rings, i);
        mt_subdivide_vertex_rule rule = mt_limit_refine(&job->rings.ring, &normal);
        mt_index sector_count = mt_limit_rings_part(&job->rings);
        const mt_index *ends = job->rings.starts;
        store(job, vertex,
              mt_limit_position(&job->rings.ring.ring, rule, ends[0], rule == MT_VERTEX_CREASE ? ends[1] : 0));
        if (rule == MT_VERTEX_DART) {
            store_normal(job, vertex, normal);
        } else {
            limit_sectors(job, vertex, rule, sector_count, &value_count);
        }
    }
}

/* On vertices as long as each has one normal, else on corners; so too when vertices will be joined. */
static mt_status add_normals(mt_context *context, const limit_job *job, bool joined, mt_mesh *result,
                             mt_attribute **normals)
{
    for (mt_index i = result->attribute_count; i-- > 0;) {
        const mt_attribute *attribute = &result->attributes[i];
        if (attribute->semantic == MT_SEMANTIC_NORMAL && attribute->domain != MT_DOMAIN_FACE) {
            mt_mesh_remove_attribute(context, result, i);
        }
    }
    mt_index extra = mt_limit_rings_extra_sectors(&job->rings);
    bool on_corners = joined || extra > 0;
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = on_corners ? MT_DOMAIN_CORNER : MT_DOMAIN_VERTEX,
                                  .type = result->position_type,
                                  .component_count = 3,
                                  .value_count = (uint64_t)result->vertex_count + extra,
                                  .indexed = on_corners};
    mt_status status = mt_mesh_add_attribute(context, result, &layout, normals);
    if (status == MT_OK && on_corners) {
        memcpy((*normals)->indices, result->corner_vertices, result->corner_count * sizeof(mt_index));
    }
    return status;
}

static mt_status move_to_limit(mt_context *context, limit_job *job, bool joined, mt_mesh *result)
{
    mt_status status = add_normals(context, job, joined, result, &job->normals);
    if (status != MT_OK) {
        return status;
    }
    job->positions = mt_allocate_array(context, result->vertex_count, 3 * mt_type_size(result->position_type));
    if (!job->positions) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, result->vertex_count, LIMIT_GRAIN, limit_small_rings, job);
    limit_large_rings(job);
    limit_sharp_rings(job);
    mt_free(context, result->positions);
    result->positions = job->positions;
    return MT_OK;
}

mt_status mt_subdivide_to_limit(mt_context *context, mt_subdivide_state *state, mt_mesh *result)
{
    mt_subdivide_topology *topology = &state->topologies[0];
    mt_subdivide_patches patches = {0};
    limit_job job = {.rings = {.topology = topology,
                               .mesh = result,
                               .sharp = &state->sharp,
                               .irregular_count = topology->scheme == MT_SUBDIVIDE_SCHEME_LOOP
                                                      ? topology->vertex_count
                                                      : topology->vertex_corner_count}};
    mt_status status = mt_subdivide_sharp_plan(context, topology, &state->sharp, &patches);
    if (status == MT_OK && topology->level) {
        status = mt_subdivide_find_vertex_corners(context, topology);
    }
    if (status == MT_OK) {
        job.rings.halves = patches.halves;
        status = mt_limit_rings_create(context, &job.rings);
    }
    if (status == MT_OK) {
        bool joined = state->cut && mt_subdivide_cut_has_copies(state->cut);
        status = move_to_limit(context, &job, joined, result);
        mt_limit_rings_release(context, &job.rings);
    }
    mt_subdivide_patches_release(context, &patches);
    return status;
}
