/* A mesh of the triangles alone: what lies on vertices stays, what lies on corners and faces is gathered. */
#include <meshtool/triangulate.h>

#include <meshtool/checked.h>

#include <string.h>

#define GATHER_GRAIN 65536 /* elements in a block: some 100 microseconds of copying */

/* target[i] = source[map[i]], elements of `size` bytes. */
typedef struct gather {
    const char *source;
    char *target;
    const mt_index *map;
    size_t size;
} gather;

static void gather_block(void *user, uint64_t begin, uint64_t end)
{
    const gather *job = user;
    if (job->size == sizeof(mt_index)) {
        const uint32_t *source = (const void *)job->source;
        uint32_t *target = (void *)job->target;
        for (uint64_t i = begin; i < end; i++) {
            target[i] = source[job->map[i]];
        }
        return;
    }
    for (uint64_t i = begin; i < end; i++) {
        memcpy(job->target + i * job->size, job->source + job->map[i] * job->size, job->size);
    }
}

static void gather_elements(mt_context *context, const void *source, void *target, const mt_index *map, uint64_t count,
                            size_t size)
{
    gather job = {source, target, map, size};
    mt_parallel_for(context, count, GATHER_GRAIN, gather_block, &job);
}

/* The triangle that a new element comes from, as old corners or faces; NULL: elements keep their numbers. */
static const mt_index *map_of(const mt_triangulation *triangulation, mt_domain domain)
{
    if (domain == MT_DOMAIN_CORNER) {
        return triangulation->corners;
    }
    return domain == MT_DOMAIN_FACE ? triangulation->faces : NULL;
}

static mt_status add_attribute(mt_context *context, const mt_attribute *source, const mt_triangulation *triangulation,
                               mt_mesh *mesh)
{
    const mt_index *map = map_of(triangulation, source->domain);
    mt_index domain_count = mt_mesh_domain_count(mesh, source->domain);
    bool gathers_values = map && !source->indices;
    mt_attribute_layout layout = {.name = source->name,
                                  .semantic = source->semantic,
                                  .domain = source->domain,
                                  .type = source->type,
                                  .component_count = source->component_count,
                                  .value_count = gathers_values ? domain_count : source->value_count,
                                  .indexed = source->indices != NULL};
    mt_attribute *target;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &target);
    if (status != MT_OK) {
        return status;
    }
    size_t size = source->component_count * mt_type_size(source->type);
    if (gathers_values) {
        gather_elements(context, source->values, target->values, map, domain_count, size);
    } else {
        memcpy(target->values, source->values, source->value_count * size);
    }
    if (source->indices && map) {
        gather_elements(context, source->indices, target->indices, map, domain_count, sizeof(mt_index));
    } else if (source->indices) {
        memcpy(target->indices, source->indices, domain_count * sizeof(mt_index));
    }
    return MT_OK;
}

static mt_status add_labels(mt_context *context, const mt_labels *source, const mt_triangulation *triangulation,
                            mt_mesh *mesh)
{
    mt_labels *target;
    mt_status status = mt_mesh_add_labels(context, mesh, source->kind, &target);
    for (mt_index i = 0; status == MT_OK && i < source->name_count; i++) {
        mt_index number;
        status = mt_labels_add_name(context, target, source->names[i], &number);
    }
    if (status == MT_OK) {
        gather_elements(context, source->face_labels, target->face_labels, triangulation->faces, mesh->face_count,
                        sizeof(mt_index));
    }
    return status;
}

/* A copy without faces and what lies on them: vertices, wires, points, creases. */
static mt_status copy_frame(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    mt_mesh frame = *mesh;
    frame.face_count = 0;
    frame.corner_count = 0;
    frame.face_size = 3;
    frame.face_offsets = NULL;
    frame.corner_vertices = NULL;
    frame.attribute_count = 0;
    frame.label_set_count = 0;
    return mt_mesh_copy(context, &frame, out);
}

static mt_status add_triangles(mt_context *context, const mt_mesh *source, const mt_triangulation *triangulation,
                               mt_mesh *mesh)
{
    mesh->corner_vertices = mt_allocate_array(context, 3 * (uint64_t)triangulation->triangle_count, sizeof(mt_index));
    if (!mesh->corner_vertices) {
        return mt_context_error(context)->status;
    }
    mesh->face_count = triangulation->triangle_count;
    mesh->corner_count = 3 * triangulation->triangle_count;
    gather_elements(context, source->corner_vertices, mesh->corner_vertices, triangulation->corners, mesh->corner_count,
                    sizeof(mt_index));
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < source->attribute_count; i++) {
        status = add_attribute(context, &source->attributes[i], triangulation, mesh);
    }
    for (mt_index i = 0; status == MT_OK && i < source->label_set_count; i++) {
        status = add_labels(context, &source->label_sets[i], triangulation, mesh);
    }
    return status;
}

static mt_status build(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation, mt_mesh **out)
{
    if (!mt_count_fits(3 * (uint64_t)triangulation->triangle_count)) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%u triangles have more corners than the %u that a mesh can hold",
                       triangulation->triangle_count, MT_INDEX_MAX);
    }
    mt_status status = copy_frame(context, mesh, out);
    if (status == MT_OK) {
        status = add_triangles(context, mesh, triangulation, *out);
    }
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}

mt_status mt_mesh_triangulate(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_triangulation triangulation;
    mt_status status = mt_triangulation_init(context, mesh, &triangulation);
    if (status != MT_OK) {
        return status;
    }
    if (triangulation.corners) {
        status = build(context, mesh, &triangulation, out);
    } else {
        status = mt_mesh_copy(context, mesh, out);
        if (status == MT_OK) {
            mt_mesh_compact_faces(context, *out);
        }
    }
    mt_triangulation_release(context, &triangulation);
    return status;
}
