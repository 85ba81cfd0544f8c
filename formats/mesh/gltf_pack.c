/* Compressing the triangles of a plan with Draco (KHR_draco_mesh_compression). */
#include "formats/mesh/draco_options.h"
#include "formats/mesh/gltf_write.h"

#include <string.h>

/* The values of a chunk, gathered for Draco. */
typedef struct packing {
    mt_gltf_plan *plan;
    mt_gltf_chunk *chunk;
    mt_draco_attribute attributes[1 + MT_GLTF_COLUMNS];
    size_t attribute_count;
    void *memory[1 + MT_GLTF_COLUMNS];
} packing;

static mt_draco_kind kind_of(const mt_gltf_column *column)
{
    static const mt_draco_kind kinds[] = {[MT_SEMANTIC_GENERIC] = MT_DRACO_GENERIC,
                                          [MT_SEMANTIC_NORMAL] = MT_DRACO_NORMAL,
                                          [MT_SEMANTIC_UV] = MT_DRACO_UV,
                                          [MT_SEMANTIC_COLOR] = MT_DRACO_COLOR};
    return kinds[column->attribute->semantic];
}

static void *add_attribute(packing *p, const mt_draco_attribute *attribute)
{
    size_t size = attribute->component_count * mt_type_size(attribute->type), i = p->attribute_count++;
    p->attributes[i] = *attribute;
    p->memory[i] = mt_allocate_array(p->plan->context, p->chunk->vertex_count, size);
    p->attributes[i].values = p->memory[i];
    return p->memory[i];
}

static mt_status gather(packing *p, const mt_draco_options *options)
{
    mt_draco_attribute attribute = {.kind = MT_DRACO_POSITION, .type = MT_F32, .component_count = 3};
    attribute.bits = mt_draco_bits(options, attribute.kind);
    float *positions = add_attribute(p, &attribute);
    for (mt_index i = 0; positions && i < p->chunk->vertex_count; i++) {
        mt_gltf_put_position(p->plan, p->chunk, i, positions + 3 * (size_t)i);
    }
    if (!positions) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (size_t c = 0; c < p->plan->column_count; c++) {
        const mt_gltf_column *column = &p->plan->columns[c];
        attribute = (mt_draco_attribute){.kind = kind_of(column),
                                         .type = column->type,
                                         .component_count = column->component_count,
                                         .normalized = column->type != MT_F32,
                                         .bits = mt_draco_bits(options, kind_of(column)),
                                         .id = (uint32_t)c + 1};
        size_t size = column->component_count * mt_type_size(column->type);
        uint8_t *values = add_attribute(p, &attribute);
        if (!values) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        for (mt_index i = 0; i < p->chunk->vertex_count; i++) {
            uint32_t value[4];
            mt_gltf_put_value(p->plan, column, p->chunk, i, value);
            memcpy(values + i * size, value, size);
        }
    }
    return MT_OK;
}

static mt_status pack_chunk(packing *p, const mt_draco_options *options, bool strict_loss)
{
    const mt_gltf_primitive *primitive = &p->plan->primitives[p->chunk->primitive_begin];
    mt_status status = gather(p, options);
    if (status == MT_OK) {
        mt_draco_source source = {.vertex_count = p->chunk->vertex_count,
                                  .triangle_count = (mt_index)(primitive->count / 3),
                                  .triangles = p->plan->indices + primitive->begin,
                                  .attributes = p->attributes,
                                  .attribute_count = p->attribute_count};
        status = mt_draco_compress(p->plan->context, &source, options, strict_loss, &p->chunk->packed);
    }
    for (size_t i = 0; i < p->attribute_count; i++) {
        mt_free(p->plan->context, p->memory[i]);
    }
    return status;
}

mt_status mt_gltf_pack(mt_gltf_plan *plan, const mt_draco_options *options, bool strict_loss)
{
    mt_status status = MT_OK;
    for (size_t i = 0; i < plan->chunk_count && status == MT_OK; i++) {
        mt_gltf_chunk *chunk = &plan->chunks[i];
        if (chunk->primitive_count == 1 && plan->primitives[chunk->primitive_begin].mode == MT_GLTF_TRIANGLES) {
            packing p = {.plan = plan, .chunk = chunk};
            status = pack_chunk(&p, options, strict_loss);
        }
    }
    return status;
}
