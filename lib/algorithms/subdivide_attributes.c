/* Fields back into the attributes of the refined mesh.
 * With L levels the corner k of the result comes from corner k >> 2L of the mesh, and its face q from corner
 * q >> 2(L-1), with Loop's scheme from face q >> 2L: what is copied from parents needs no tables. Cost: O(values of the
 * result). */
#include "lib/algorithms/subdivide_field.h"

#include <meshtool/vector.h>

#include <string.h>

#define GATHER_GRAIN 16384

static const mt_subdivide_field *field_of(const mt_subdivide_state *state, mt_index attribute)
{
    for (mt_index i = 1; i < state->field_count; i++) {
        if (state->fields[i].attribute == attribute) {
            return &state->fields[i];
        }
    }
    return NULL;
}

static mt_status add_attribute(mt_context *context, const mt_subdivide_state *state, mt_index number, mt_mesh *result)
{
    const mt_attribute *source = &state->mesh->attributes[number];
    mt_attribute_layout layout = {.name = source->name,
                                  .semantic = source->semantic,
                                  .domain = source->domain,
                                  .type = source->type,
                                  .component_count = source->component_count,
                                  .value_count = source->value_count,
                                  .indexed = source->indices != NULL};
    const mt_subdivide_field *field = field_of(state, number);
    if (field && source->domain == MT_DOMAIN_CORNER) {
        layout.value_count = mt_subdivide_child_vertex_count(&state->topologies[field->topology]);
        layout.indexed = true;
    } else if (field) {
        layout.value_count = result->vertex_count;
        layout.indexed = false;
    } else if (!source->indices) {
        layout.value_count = mt_mesh_domain_count(result, source->domain);
    }
    mt_attribute *added;
    return mt_mesh_add_attribute(context, result, &layout, &added);
}

mt_status mt_subdivide_attributes_add(mt_context *context, const mt_subdivide_state *state, mt_mesh *result)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < state->mesh->attribute_count; i++) {
        status = add_attribute(context, state, i, result);
    }
    return status;
}

typedef struct gather_job {
    const mt_subdivide_state *state;
    const mt_subdivide_field *field;
    const mt_attribute *source;
    mt_attribute *target;
    size_t size;    /* bytes of a value */
    unsigned shift; /* from an old corner to its first new one */
} gather_job;

typedef struct spread_job {
    const mt_mesh *mesh;
    bool of_corners; /* of each face; else a parent has its own children */
    unsigned shift;  /* from an old element to its first new one */
    size_t size;
    const char *from;
    char *to;
} spread_job;

static void spread_parents(void *user, uint64_t begin, uint64_t end)
{
    const spread_job *job = user;
    for (uint64_t parent = begin; parent < end; parent++) {
        uint64_t first = parent, last = parent + 1;
        if (job->of_corners) {
            first = mt_mesh_face_begin(job->mesh, (mt_index)parent);
            last = mt_mesh_face_end(job->mesh, (mt_index)parent);
        }
        for (uint64_t element = first << job->shift; element < last << job->shift; element++) {
            memcpy(job->to + element * job->size, job->from + parent * job->size, job->size);
        }
    }
}

void mt_subdivide_spread(mt_context *context, const mt_subdivide_state *state, bool of_faces, unsigned level_count,
                         size_t size, const void *from, void *to)
{
    const mt_mesh *mesh = state->mesh;
    spread_job job = {.mesh = mesh, .size = size, .from = from, .to = to};
    job.of_corners = of_faces && state->settings.scheme == MT_SUBDIVIDE_SCHEME_CATMULL_CLARK;
    job.shift = job.of_corners ? 2 * (level_count - 1) : 2 * level_count;
    mt_parallel_for(context, of_faces ? mesh->face_count : mesh->corner_count, GATHER_GRAIN, spread_parents, &job);
}

/* With indices those are copied from the parents, and the values stay as they are. */
static void copy_from_parents(mt_context *context, const gather_job *job, unsigned level_count)
{
    const mt_attribute *source = job->source;
    size_t value_size = source->component_count * mt_type_size(source->type);
    bool of_faces = source->domain == MT_DOMAIN_FACE;
    if (!source->indices) {
        mt_subdivide_spread(context, job->state, of_faces, level_count, value_size, source->values,
                            job->target->values);
        return;
    }
    memcpy(job->target->values, source->values, source->value_count * value_size);
    mt_subdivide_spread(context, job->state, of_faces, level_count, sizeof(mt_index), source->indices,
                        job->target->indices);
}

static void gather_origins(void *user, uint64_t begin, uint64_t end)
{
    const gather_job *job = user;
    const mt_index *origins = job->field->values;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_index value = mt_attribute_value_index(job->source, origins[vertex]);
        char *to = (char *)job->target->values + vertex * job->size;
        if (value == MT_NONE) {
            memset(to, 0, job->size);
        } else {
            memcpy(to, (const char *)job->source->values + value * job->size, job->size);
        }
    }
}

static void convert_values(void *user, uint64_t begin, uint64_t end)
{
    const gather_job *job = user;
    mt_attribute work = {
        .type = job->field->type, .component_count = job->field->component_count, .values = job->field->owned};
    for (mt_index value = (mt_index)begin; value < end; value++) {
        for (uint32_t k = 0; k < work.component_count; k++) {
            mt_attribute_set(job->target, value, k, mt_attribute_get(&work, value, k));
        }
    }
}

static void make_unit(void *user, uint64_t begin, uint64_t end)
{
    mt_attribute *target = ((const gather_job *)user)->target;
    for (mt_index value = (mt_index)begin; value < end; value++) {
        mt_vec3 vector = mt_vec3_make(mt_attribute_get(target, value, 0), mt_attribute_get(target, value, 1),
                                      mt_attribute_get(target, value, 2));
        mt_vec3 unit = mt_vec3_normalize(vector);
        mt_attribute_set(target, value, 0, unit.x);
        mt_attribute_set(target, value, 1, unit.y);
        mt_attribute_set(target, value, 2, unit.z);
    }
}

/* The children of a face that misses a value have none. */
static void clear_missing(void *user, uint64_t begin, uint64_t end)
{
    const gather_job *job = user;
    const mt_mesh *mesh = job->state->mesh;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        uint64_t first = mt_mesh_face_begin(mesh, face), last = mt_mesh_face_end(mesh, face);
        bool complete = true;
        for (uint64_t corner = first; corner < last; corner++) {
            complete = complete && job->source->indices[corner] != MT_NONE;
        }
        for (uint64_t corner = first << job->shift; !complete && corner < last << job->shift; corner++) {
            job->target->indices[corner] = MT_NONE;
        }
    }
}

static void finish_field(mt_context *context, gather_job *job, unsigned level_count)
{
    mt_attribute *target = job->target;
    job->size = target->component_count * mt_type_size(target->type);
    job->shift = 2 * level_count;
    if (job->field->rule == MT_SUBDIVIDE_ORIGIN) {
        mt_parallel_for(context, target->value_count, GATHER_GRAIN, gather_origins, job);
        return;
    }
    if (job->field->owned) {
        mt_parallel_for(context, target->value_count, GATHER_GRAIN, convert_values, job);
    }
    bool unit = mt_semantic_interpolation(target->semantic, target->type) == MT_INTERPOLATE_UNIT;
    if (unit && target->component_count == 3 && (target->type == MT_F32 || target->type == MT_F64)) {
        mt_parallel_for(context, target->value_count, GATHER_GRAIN, make_unit, job);
    }
    if (target->domain == MT_DOMAIN_CORNER && job->source->indices) {
        mt_parallel_for(context, job->state->mesh->face_count, GATHER_GRAIN, clear_missing, job);
    }
}

void mt_subdivide_attributes_finish(mt_context *context, const mt_subdivide_state *state, unsigned level_count,
                                    mt_mesh *result)
{
    for (mt_index i = 0; i < result->attribute_count; i++) {
        gather_job job = {.state = state,
                          .field = field_of(state, i),
                          .source = &state->mesh->attributes[i],
                          .target = &result->attributes[i]};
        switch (mt_subdivide_carriage_of(job.source)) {
        case MT_SUBDIVIDE_CARRY_FIELD:
            finish_field(context, &job, level_count);
            break;
        case MT_SUBDIVIDE_CARRY_PARENT:
            copy_from_parents(context, &job, level_count);
            break;
        case MT_SUBDIVIDE_CARRY_WHOLE:
            job.size = job.source->component_count * mt_type_size(job.source->type);
            memcpy(job.target->values, job.source->values, job.source->value_count * job.size);
            if (job.source->indices) {
                job.target->indices[0] = job.source->indices[0];
            }
            break;
        }
    }
}
