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
    column.stride = (unsigned)(column.component_count * mt_type_size(column.type) + 3) / 4 * 4;
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

static void make_normal(const mt_attribute *attribute, mt_index value, float *to)
{
    double n[3] = {0, 0, 0}, length = 0.0;
    for (uint32_t i = 0; i < 3 && value != MT_NONE; i++) {
        n[i] = mt_attribute_get(attribute, value, i);
    }
    double largest = fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2])));
    for (int i = 0; i < 3 && largest > 0.0; i++) {
        length += (n[i] / largest) * (n[i] / largest);
    }
    length = largest * sqrt(length);
    bool unit = fabs(length - 1.0) <= UNIT_TOLERANCE;
    for (int i = 0; i < 3; i++) {
        double number = unit ? n[i] : n[i] / largest / (length / largest);
        to[i] = length > 0.0 ? (float)number : i == 2 ? 1.0F : 0.0F;
    }
}

static void make_uv(const mt_attribute *attribute, mt_index value, float *to)
{
    to[0] = value == MT_NONE ? 0.0F : (float)mt_attribute_get(attribute, value, 0);
    to[1] = value == MT_NONE ? 0.0F : (float)(1.0 - mt_attribute_get(attribute, value, 1));
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

static void make_color(const mt_gltf_column *column, mt_index value, void *to)
{
    memset(to, 0, column->stride);
    for (unsigned k = 0; k < column->component_count; k++) {
        double share = color_component(column->attribute, value, k);
        if (column->type == MT_F32) {
            ((float *)to)[k] = (float)share;
        } else if (column->type == MT_U8) {
            ((uint8_t *)to)[k] = (uint8_t)(share * 255.0 + 0.5);
        } else {
            ((uint16_t *)to)[k] = (uint16_t)(share * 65535.0 + 0.5);
        }
    }
}

void mt_gltf_make_value(const mt_gltf_column *column, mt_index value, void *to)
{
    if (column->attribute->semantic == MT_SEMANTIC_NORMAL) {
        make_normal(column->attribute, value, to);
    } else if (column->attribute->semantic == MT_SEMANTIC_UV) {
        make_uv(column->attribute, value, to);
    } else {
        make_color(column, value, to);
    }
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

void mt_gltf_put_position(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex, float *to)
{
    size_t at = 3 * (size_t)mt_gltf_source_of(plan, chunk, vertex);
    for (size_t i = 0; i < 3; i++) {
        to[i] = plan->mesh->position_type == MT_F64 ? (float)((const double *)plan->mesh->positions)[at + i]
                                                    : ((const float *)plan->mesh->positions)[at + i];
    }
}

void mt_gltf_put_value(const mt_gltf_plan *plan, const mt_gltf_column *column, const mt_gltf_chunk *chunk,
                       mt_index vertex, void *to)
{
    mt_index element = column->attribute->domain == MT_DOMAIN_CORNER ? plan->split.corners[split_vertex(chunk, vertex)]
                                                                     : mt_gltf_source_of(plan, chunk, vertex);
    mt_gltf_make_value(column, element == MT_NONE ? MT_NONE : mt_attribute_value_index(column->attribute, element), to);
}
