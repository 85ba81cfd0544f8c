/* Attributes as glTF holds them: which are written, and how a value looks. */
#include "formats/mesh/gltf_write.h"

#include <math.h>
#include <string.h>

#define SETS 8

/* A normal whose length is within this of 1 stays as it is, to the bit; one farther off is scaled. Wider, and the
 * validator complains (at 0.0067); narrower, and normals that were rounded in a file change when they are copied. */
#define UNIT_TOLERANCE 1e-3

const mt_labels *mt_gltf_part_labels(const mt_mesh *mesh)
{
    static const mt_label_kind kinds[] = {MT_LABEL_PART, MT_LABEL_OBJECT, MT_LABEL_SOLID, MT_LABEL_GROUP};
    const mt_labels *labels = NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0] && !labels; i++) {
        labels = mt_mesh_find_labels(mesh, kinds[i]);
    }
    return labels;
}

unsigned mt_gltf_stride(unsigned component_count, mt_type type)
{
    return (unsigned)(component_count * mt_type_size(type) + 3) / 4 * 4;
}

static mt_gltf_column make_column(const mt_attribute *attribute, unsigned set)
{
    mt_gltf_column column = {.attribute = attribute, .set = set, .type = MT_F32};
    switch (attribute->semantic) {
    case MT_SEMANTIC_NORMAL:
        column.component_count = 3;
        break;
    case MT_SEMANTIC_UV:
        column.component_count = 2;
        break;
    default:
        column.component_count = attribute->component_count % 2 == 0 ? 4 : 3;
        column.type = attribute->type == MT_U8 || attribute->type == MT_U16 ? attribute->type : MT_F32;
    }
    column.stride = mt_gltf_stride(column.component_count, column.type);
    return column;
}

/* Of normals one, on corners before vertices; of the others as many as fit. */
static size_t list_kind(const mt_mesh *mesh, mt_semantic semantic, size_t most, mt_gltf_column *out)
{
    static const mt_domain domains[] = {MT_DOMAIN_CORNER, MT_DOMAIN_VERTEX};
    size_t count = 0;
    for (size_t d = 0; d < 2; d++) {
        for (mt_index i = 0; i < mesh->attribute_count && count < most; i++) {
            const mt_attribute *attribute = &mesh->attributes[i];
            if (attribute->semantic == semantic && attribute->domain == domains[d]) {
                out[count] = make_column(attribute, (unsigned)count);
                count++;
            }
        }
    }
    return count;
}

size_t mt_gltf_list_columns(const mt_mesh *mesh, mt_gltf_column columns[MT_GLTF_COLUMNS])
{
    size_t count = list_kind(mesh, MT_SEMANTIC_NORMAL, 1, columns);
    count += list_kind(mesh, MT_SEMANTIC_UV, SETS, columns + count);
    return count + list_kind(mesh, MT_SEMANTIC_COLOR, SETS, columns + count);
}

bool mt_gltf_holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding)
{
    mt_gltf_column columns[MT_GLTF_COLUMNS];
    size_t count = mt_gltf_list_columns(mesh, columns);
    (void)encoding;
    for (size_t i = 0; i < count; i++) {
        if (columns[i].attribute == attribute) {
            return true;
        }
    }
    return false;
}

static void make_normal(const mt_gltf_column *column, mt_index value, double *to)
{
    const mt_attribute *attribute = column->attribute;
    double n[3] = {0, 0, 0}, length = 0.0;
    for (uint32_t i = 0; i < 3 && value != MT_NONE; i++) {
        n[i] = mt_attribute_get(attribute, value, i);
    }
    double largest = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    for (int i = 0; i < 3 && largest > 0.0; i++) {
        length += (n[i] / largest) * (n[i] / largest);
    }
    length = largest * sqrt(length);
    bool unit = fabs(length - 1.0) <= UNIT_TOLERANCE && !column->is_quantised;
    for (int i = 0; i < 3; i++) {
        double number = unit ? n[i] : n[i] / largest / (length / largest);
        to[i] = length > 0.0 ? number : i == 2 ? 1.0 : 0.0;
    }
}

static void make_uv(const mt_attribute *attribute, mt_index value, double *to)
{
    to[0] = value == MT_NONE ? 0.0 : mt_attribute_get(attribute, value, 0);
    to[1] = value == MT_NONE ? 0.0 : 1.0 - mt_attribute_get(attribute, value, 1);
}

/* Component k of a colour as a share of its maximum: grey is spread, what is not there is 1. */
static double color_component(const mt_attribute *attribute, mt_index value, unsigned k)
{
    unsigned stored = attribute->component_count;
    if (value == MT_NONE || (k == 3 && stored % 2 == 1)) {
        return 1.0;
    }
    unsigned from = k == 3 ? stored - 1 : stored <= 2 ? 0 : k;
    double number = mt_attribute_get(attribute, value, from) / mt_color_maximum(attribute->type);
    return number < 0.0 ? 0.0 : number > 1.0 ? 1.0 : number;
}

/* The nearest whole number; from the middle between two the one away from 0. */
static int nearest(double number)
{
    return (int)(number < 0.0 ? number - 0.5 : number + 0.5);
}

/* Numbers from 0 to 1, or -1 to 1, as shares of an integer's maximum (section 3.11); or as floats. */
static void store(const mt_gltf_column *column, const double *numbers, void *to)
{
    if (column->type != MT_F32) {
        memset(to, 0, column->stride);
    }
    for (unsigned k = 0; k < column->component_count; k++) {
        if (column->type == MT_F32) {
            ((float *)to)[k] = (float)numbers[k];
        } else if (column->type == MT_U8) {
            ((uint8_t *)to)[k] = (uint8_t)nearest(numbers[k] * UINT8_MAX);
        } else if (column->type == MT_U16) {
            ((uint16_t *)to)[k] = (uint16_t)nearest(numbers[k] * UINT16_MAX);
        } else if (column->type == MT_I8) {
            ((int8_t *)to)[k] = (int8_t)nearest(numbers[k] * INT8_MAX);
        } else {
            ((int16_t *)to)[k] = (int16_t)nearest(numbers[k] * INT16_MAX);
        }
    }
}

void mt_gltf_make_value(const mt_gltf_column *column, mt_index value, void *to)
{
    double numbers[4];
    if (column->attribute->semantic == MT_SEMANTIC_NORMAL) {
        make_normal(column, value, numbers);
    } else if (column->attribute->semantic == MT_SEMANTIC_UV) {
        make_uv(column->attribute, value, numbers);
    } else {
        for (unsigned k = 0; k < column->component_count; k++) {
            numbers[k] = color_component(column->attribute, value, k);
        }
    }
    store(column, numbers, to);
}

/* The vertex of the split that a vertex of the chunk is. */
static mt_index split_vertex(const mt_gltf_chunk *chunk, mt_index vertex)
{
    return chunk->vertices ? chunk->vertices[vertex] : vertex;
}

mt_index mt_gltf_source_of(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex)
{
    mt_index split = split_vertex(chunk, vertex), count = plan->mesh->vertex_count;
    return split < count ? split : plan->split.sources[split - count];
}

static void put_steps(const mt_gltf_plan *plan, mt_vec3 position, void *to)
{
    unsigned steps[3];
    mt_gltf_grid_steps(&plan->grid, position, steps);
    memset(to, 0, mt_gltf_position_stride(plan));
    for (size_t i = 0; i < 3; i++) {
        if (mt_gltf_position_type(plan) == MT_U8) {
            ((uint8_t *)to)[i] = (uint8_t)steps[i];
        } else {
            ((uint16_t *)to)[i] = (uint16_t)steps[i];
        }
    }
}

void mt_gltf_put_position(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex, void *to)
{
    mt_index source = mt_gltf_source_of(plan, chunk, vertex);
    if (plan->grid.bits > 0) {
        put_steps(plan, mt_mesh_position(plan->mesh, source), to);
        return;
    }
    size_t at = 3 * (size_t)source;
    float *floats = to;
    for (size_t i = 0; i < 3; i++) {
        floats[i] = plan->mesh->position_type == MT_F64 ? (float)((const double *)plan->mesh->positions)[at + i]
                                                        : ((const float *)plan->mesh->positions)[at + i];
    }
}

void mt_gltf_get_position(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex, double out[3])
{
    union {
        float floats[3];
        uint16_t shorts[4];
        uint8_t bytes[4];
    } stored;
    mt_type type = mt_gltf_position_type(plan);
    mt_gltf_put_position(plan, chunk, vertex, &stored);
    for (size_t k = 0; k < 3; k++) {
        out[k] = type == MT_F32 ? (double)stored.floats[k] : type == MT_U16 ? stored.shorts[k] : stored.bytes[k];
    }
}

void mt_gltf_put_value(const mt_gltf_plan *plan, const mt_gltf_column *column, const mt_gltf_chunk *chunk,
                       mt_index vertex, void *to)
{
    mt_index element = column->attribute->domain == MT_DOMAIN_CORNER ? plan->split.corners[split_vertex(chunk, vertex)]
                                                                     : mt_gltf_source_of(plan, chunk, vertex);
    mt_gltf_make_value(column, element == MT_NONE ? MT_NONE : mt_attribute_value_index(column->attribute, element), to);
}
