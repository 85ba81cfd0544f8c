#include "lib/algorithms/subdivide_count.h"

#include "lib/algorithms/subdivide_field.h"
#include "lib/algorithms/subdivide_settings.h"

#include <meshtool/checked.h>

#define SIZE_CLAMP ((uint64_t)1 << 62)

static uint64_t clamp(uint64_t count)
{
    return count < SIZE_CLAMP ? count : SIZE_CLAMP;
}

mt_subdivide_size mt_subdivide_size_at(mt_subdivide_scheme scheme, mt_subdivide_size size, unsigned level)
{
    bool triangles = scheme == MT_SUBDIVIDE_SCHEME_LOOP;
    for (unsigned i = 0; i < level; i++) {
        uint64_t vertices = clamp(clamp(size.vertices + (triangles ? 0 : size.faces)) + size.edges);
        uint64_t edges = clamp(clamp(2 * size.edges) + size.corners);
        size.faces = triangles ? clamp(4 * size.faces) : size.corners;
        size.corners = size.corners >= SIZE_CLAMP / 4 ? SIZE_CLAMP : 4 * size.corners;
        size.vertices = vertices;
        size.edges = edges;
    }
    return size;
}

mt_status mt_subdivide_check_size(mt_context *context, const mt_subdivide_size *size, unsigned level)
{
    if (mt_count_fits(size->vertices) && mt_count_fits(size->corners) && mt_count_fits(size->edges)) {
        return MT_OK;
    }
    return mt_fail(
        context, MT_ERROR_TOO_LARGE,
        "level %u would have %llu vertices and %llu faces with %llu corners, more than the %u of a kind that "
        "a mesh can hold: ask for fewer levels",
        level, (unsigned long long)size->vertices, (unsigned long long)size->faces, (unsigned long long)size->corners,
        MT_INDEX_MAX);
}

/* What is counted, and how it is asked to be refined. */
typedef struct count_job {
    const mt_mesh *mesh;
    const mt_edge_pairs *pairs;
    mt_subdivide_scheme scheme;
    bool smooth_values; /* corner attributes are not linear */
    unsigned level;
    mt_subdivide_size size; /* at the level */
} count_job;

/* Values of a corner attribute, each vertex having its own. Corners are gone through by value: chains of corners with
 * the same value, and a stamp on the vertices that were met in the chain. */
static mt_status count_values(mt_context *context, const count_job *job, const mt_attribute *attribute, uint64_t *count)
{
    const mt_mesh *mesh = job->mesh;
    uint64_t chain_count = (uint64_t)attribute->value_count + 1;
    mt_index *heads = mt_allocate_array(context, chain_count, sizeof *heads);
    mt_index *next = mt_allocate_array(context, mesh->corner_count, sizeof *next);
    mt_index *stamps = mt_allocate_array(context, mesh->vertex_count, sizeof *stamps);
    bool complete = heads && next && stamps;
    *count = 0;
    for (uint64_t i = 0; complete && i < chain_count; i++) {
        heads[i] = MT_NONE;
    }
    for (mt_index vertex = 0; complete && vertex < mesh->vertex_count; vertex++) {
        stamps[vertex] = MT_NONE;
    }
    for (mt_index corner = 0; complete && corner < mesh->corner_count; corner++) {
        mt_index value = mt_attribute_value_index(attribute, corner);
        mt_index *head = &heads[value == MT_NONE ? attribute->value_count : value];
        next[corner] = *head;
        *head = corner;
    }
    for (uint64_t chain = 0; complete && chain < chain_count; chain++) {
        for (mt_index corner = heads[chain]; corner != MT_NONE; corner = next[corner]) {
            mt_index *stamp = &stamps[mesh->corner_vertices[corner]];
            *count += *stamp != (mt_index)chain;
            *stamp = (mt_index)chain;
        }
    }
    mt_free(context, heads);
    mt_free(context, next);
    mt_free(context, stamps);
    return complete ? MT_OK : mt_context_error(context)->status;
}

/* Values of an attribute at the level: those of a field grow like vertices. */
static mt_status value_count(mt_context *context, const count_job *job, const mt_attribute *attribute, uint64_t *count)
{
    const uint64_t domain_counts[] = {1, job->size.vertices, job->size.corners, job->size.faces};
    if (job->level == 0 || mt_subdivide_carriage_of(attribute) != MT_SUBDIVIDE_CARRY_FIELD) {
        *count = attribute->indices || job->level == 0 ? attribute->value_count : domain_counts[attribute->domain];
        return MT_OK;
    }
    if (attribute->domain == MT_DOMAIN_VERTEX) {
        *count = job->size.vertices;
        return MT_OK;
    }
    mt_subdivide_size values = {.vertices = attribute->value_count,
                                .faces = job->mesh->face_count,
                                .corners = job->mesh->corner_count,
                                .edges = job->mesh->corner_count};
    mt_status status = MT_OK;
    if (job->smooth_values) {
        status = count_values(context, job, attribute, &values.vertices);
    }
    if (attribute->indices) {
        values.edges = (uint64_t)job->pairs->edge_count +
                       mt_subdivide_seam_count(job->mesh, job->pairs, attribute, job->smooth_values);
    }
    *count = mt_subdivide_size_at(job->scheme, values, job->level).vertices;
    return status;
}

static bool has_indices(const mt_attribute *attribute, unsigned level)
{
    bool field = level && mt_subdivide_carriage_of(attribute) == MT_SUBDIVIDE_CARRY_FIELD;
    return field ? attribute->domain == MT_DOMAIN_CORNER : attribute->indices != NULL;
}

static uint64_t bytes_of(uint64_t count, uint64_t size)
{
    uint64_t bytes;
    return mt_checked_multiply(count, size, &bytes) ? clamp(bytes) : SIZE_CLAMP;
}

static mt_status add_attribute_bytes(mt_context *context, const count_job *job, const mt_attribute *attribute,
                                     uint64_t *bytes)
{
    const uint64_t domain_counts[] = {1, job->size.vertices, job->size.corners, job->size.faces};
    uint64_t values = 0;
    mt_status status = value_count(context, job, attribute, &values);
    uint64_t indices = has_indices(attribute, job->level) ? domain_counts[attribute->domain] : 0;
    *bytes = clamp(*bytes + bytes_of(values, attribute->component_count * mt_type_size(attribute->type)));
    *bytes = clamp(*bytes + bytes_of(indices, sizeof(mt_index)));
    return status;
}

/* Without the holes: faces, corners and edges as of a mesh of the other faces. */
static void leave_out_holes(const mt_mesh *mesh, const mt_edge_pairs *pairs, const uint8_t *holes, unsigned level,
                            mt_subdivide_scheme scheme, mt_subdivide_size *size)
{
    mt_subdivide_size kept = {0};
    for (mt_index face = 0; face < mesh->face_count; face++) {
        kept.faces += !holes[face];
        for (mt_index c = mt_mesh_face_begin(mesh, face); !holes[face] && c < mt_mesh_face_end(mesh, face); c++) {
            mt_index twin = pairs->next_side[c];
            bool other = twin < mesh->corner_count && twin < c && !holes[mt_mesh_corner_face(mesh, twin)];
            kept.corners++;
            kept.edges += !other;
        }
    }
    kept = mt_subdivide_size_at(scheme, kept, level);
    size->faces = kept.faces;
    size->corners = kept.corners;
    size->edges = kept.edges;
}

static mt_status count_bytes(mt_context *context, const count_job *job, const uint8_t *holes, uint64_t *bytes)
{
    const mt_mesh *mesh = job->mesh;
    mt_status status = MT_OK;
    *bytes = clamp(bytes_of(job->size.vertices, 3 * mt_type_size(mesh->position_type)) +
                   bytes_of(job->size.corners, sizeof(mt_index)));
    if (job->level == 0 && mesh->face_offsets) {
        *bytes += bytes_of(job->size.faces + 1, sizeof(mt_index));
    }
    const mt_attribute *marks = holes ? mt_mesh_find_holes(mesh) : NULL;
    for (mt_index i = 0; status == MT_OK && i < mesh->attribute_count; i++) {
        if (&mesh->attributes[i] != marks) {
            status = add_attribute_bytes(context, job, &mesh->attributes[i], bytes);
        }
    }
    *bytes = clamp(*bytes + bytes_of(bytes_of(job->size.faces, sizeof(mt_index)), mesh->label_set_count));
    return status;
}

mt_status mt_subdivide_count(mt_context *context, const mt_mesh *mesh, const mt_edge_pairs *pairs,
                             const mt_subdivide_options *options, unsigned level, mt_subdivide_counts *out)
{
    mt_subdivide_options settings;
    mt_subdivide_size size = {mesh->vertex_count, mesh->face_count, mesh->corner_count, pairs->edge_count};
    count_job job = {.mesh = mesh, .pairs = pairs, .level = level};
    job.scheme = options ? options->scheme : MT_SUBDIVIDE_SCHEME_CATMULL_CLARK;
    job.size = mt_subdivide_size_at(job.scheme, size, level);
    uint8_t *holes = NULL;
    size = job.size;
    *out = (mt_subdivide_counts){size.vertices, size.faces, size.corners, size.edges, 0};
    mt_status status = mt_subdivide_settle(context, mesh, options, &settings);
    if (status == MT_OK && level > 0) {
        status = mt_subdivide_holes(context, mesh, pairs, &settings, &holes);
    }
    if (holes) {
        leave_out_holes(mesh, pairs, holes, level, job.scheme, &job.size);
    }
    if (status == MT_OK) {
        job.smooth_values = settings.face_varying != MT_SUBDIVIDE_FACE_VARYING_ALL;
        *out = (mt_subdivide_counts){job.size.vertices, job.size.faces, job.size.corners, job.size.edges, 0};
        status = count_bytes(context, &job, holes, &out->bytes);
    }
    mt_free(context, holes);
    return status == MT_OK ? mt_subdivide_check_size(context, &size, level) : status;
}
