/* Every element of the new mesh knows the old one that it comes from; what lies on it is gathered. The vertices' side
 * elements (wires, points, sharpness) go the other way, from old vertices to new ones (derive_elements.c). */
#include "lib/mesh/derive_elements.h"
#include "lib/mesh/gather.h"

#include <string.h>

typedef struct derive_job {
    mt_context *context;
    const mt_mesh *source;
    const mt_derivation *derivation;
    mt_mesh *mesh;
} derive_job;

static const mt_index *sources_of(const mt_derivation *derivation, mt_domain domain)
{
    switch (domain) {
    case MT_DOMAIN_VERTEX:
        return derivation->vertex_sources;
    case MT_DOMAIN_CORNER:
        return derivation->corner_sources;
    case MT_DOMAIN_FACE:
        return derivation->face_sources;
    case MT_DOMAIN_MESH:
        break;
    }
    return NULL;
}

static mt_status add_attribute(const derive_job *job, const mt_attribute *source)
{
    const mt_index *map = sources_of(job->derivation, source->domain);
    mt_index domain_count = mt_mesh_domain_count(job->mesh, source->domain);
    mt_attribute_layout layout = {.name = source->name,
                                  .semantic = source->semantic,
                                  .domain = source->domain,
                                  .type = source->type,
                                  .component_count = source->component_count,
                                  .value_count = source->indices ? source->value_count : domain_count,
                                  .indexed = source->indices != NULL};
    mt_attribute *target;
    mt_status status = mt_mesh_add_attribute(job->context, job->mesh, &layout, &target);
    if (status != MT_OK) {
        return status;
    }
    size_t size = source->component_count * mt_type_size(source->type);
    if (source->indices) {
        mt_gather(job->context, source->values, target->values, NULL, source->value_count, size, 0);
        mt_gather(job->context, source->indices, target->indices, map, domain_count, sizeof(mt_index), 0xff);
    } else {
        mt_gather(job->context, source->values, target->values, map, domain_count, size, 0);
    }
    return MT_OK;
}

static mt_status add_labels(const derive_job *job, const mt_labels *source)
{
    mt_labels *target;
    mt_status status = mt_mesh_add_labels(job->context, job->mesh, source->kind, &target);
    for (mt_index i = 0; status == MT_OK && i < source->name_count; i++) {
        mt_index number;
        status = mt_labels_add_name(job->context, target, source->names[i], &number);
    }
    if (status == MT_OK) {
        mt_gather(job->context, source->face_labels, target->face_labels, job->derivation->face_sources,
                  job->mesh->face_count, sizeof(mt_index), 0xff);
    }
    return status;
}

static void find_corner_vertices(void *user, uint64_t begin, uint64_t end)
{
    const derive_job *job = user;
    const mt_derivation *derivation = job->derivation;
    for (uint64_t i = begin; i < end; i++) {
        mt_index corner = derivation->corner_sources ? derivation->corner_sources[i] : (mt_index)i;
        mt_index vertex = job->source->corner_vertices[corner];
        job->mesh->corner_vertices[i] = derivation->vertex_targets ? derivation->vertex_targets[vertex] : vertex;
    }
}

static void fill_faces(derive_job *job)
{
    const mt_derivation *derivation = job->derivation;
    mt_mesh *mesh = job->mesh;
    if (!mesh->face_size) {
        memcpy(mesh->face_offsets, derivation->face_offsets, ((size_t)mesh->face_count + 1) * sizeof(mt_index));
    }
    if (derivation->corner_vertices) {
        memcpy(mesh->corner_vertices, derivation->corner_vertices, mesh->corner_count * sizeof(mt_index));
    } else {
        mt_parallel_for(job->context, mesh->corner_count, 65536, find_corner_vertices, job);
    }
    size_t size = 3 * mt_type_size(mesh->position_type);
    mt_gather(job->context, job->source->positions, mesh->positions, derivation->vertex_sources, mesh->vertex_count,
              size, 0);
}

static mt_status fill_attributes(derive_job *job)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < job->source->attribute_count; i++) {
        status = add_attribute(job, &job->source->attributes[i]);
    }
    for (mt_index i = 0; status == MT_OK && i < job->source->label_set_count; i++) {
        status = add_labels(job, &job->source->label_sets[i]);
    }
    return status;
}

mt_status mt_mesh_derive(mt_context *context, const mt_mesh *source, const mt_derivation *derivation, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = derivation->vertex_count,
                             .face_count = derivation->face_count,
                             .corner_count = derivation->corner_count,
                             .face_size = derivation->face_size,
                             .position_type = source->position_type};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    derive_job job = {context, source, derivation, *out};
    fill_faces(&job);
    (*out)->up = source->up;
    (*out)->welded = source->welded;
    status = fill_attributes(&job);
    if (status == MT_OK) {
        status = mt_derive_elements(context, source, derivation, *out);
    }
    if (status == MT_OK) {
        status = mt_derive_turned_normals(context, source, derivation, *out);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}
