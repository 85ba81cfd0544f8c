/* Normals, texture coordinates and colours of the shapes become attributes of the mesh's vertices. Where a part of the
 * shapes has an attribute and others have not, it is indexed, and those have none. */
#include "formats/mesh/gltf.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One slot over all instances. */
typedef struct slot_plan {
    unsigned slot;
    uint64_t count; /* vertices that have it */
    mt_type type;
    unsigned component_count;

} slot_plan;

static bool is_color(unsigned slot)
{
    return slot >= MT_GLTF_COLOR;
}

/* Colours stay bytes or words when all are the same; all else becomes floats. */
static void add_to_plan(slot_plan *plan, const mt_gltf_values *values)
{
    bool stored = is_color(plan->slot) && (values->type == MT_F32 || values->normalized);
    mt_type type = stored ? values->type : MT_F32;
    plan->type = plan->count == 0 || plan->type == type ? type : MT_F32;
    plan->component_count =
        values->component_count > plan->component_count ? values->component_count : plan->component_count;
    plan->count += values->count;
}

static slot_plan plan_slot(unsigned slot, mt_gltf_shape *const *shapes, size_t count)
{
    slot_plan plan = {.slot = slot, .type = MT_F32};
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < shapes[i]->set_count; k++) {
            const mt_gltf_values *values = &shapes[i]->sets[k].slots[slot];
            if (values->count > 0) {
                add_to_plan(&plan, values);
            }
        }
    }
    return plan;
}

static mt_status add_attribute(mt_gltf_file *file, const slot_plan *plan, mt_mesh *mesh, mt_attribute **out)
{
    char name[24] = "";
    unsigned set = is_color(plan->slot) ? plan->slot - MT_GLTF_COLOR : plan->slot - MT_GLTF_UV;
    mt_attribute_layout layout = {.name = name,
                                  .semantic = is_color(plan->slot)           ? MT_SEMANTIC_COLOR
                                              : plan->slot == MT_GLTF_NORMAL ? MT_SEMANTIC_NORMAL
                                                                             : MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = plan->type,
                                  .component_count = plan->component_count,
                                  .value_count = plan->count,
                                  .indexed = plan->count != mesh->vertex_count};
    if (plan->slot != MT_GLTF_NORMAL && set > 0) {
        snprintf(name, sizeof name, "%s_%u", is_color(plan->slot) ? "COLOR" : "TEXCOORD", set);
    }
    return mt_mesh_add_attribute(file->context, mesh, &layout, out);
}

/* The matrix that carries normals: the cofactors of the linear part, which is its inverse transpose times the
 * determinant; scaled before, so that no product leaves the range of doubles. */
static void normal_matrix(const mt_transform *transform, double out[3][3])
{
    double m[3][3], largest = 0.0, sign;
    for (int i = 0; i < 9; i++) {
        double size = fabs(transform->linear[i / 3][i % 3]);
        largest = size > largest ? size : largest;
    }
    int exponent = 0;
    frexp(largest, &exponent);
    for (int i = 0; i < 9; i++) {
        m[i / 3][i % 3] = ldexp(transform->linear[i / 3][i % 3], -exponent);
    }
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        for (int k = 0; k < 3; k++) {
            int c = (k + 1) % 3, d = (k + 2) % 3;
            out[i][k] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    }
    sign = m[0][0] * out[0][0] + m[0][1] * out[0][1] + m[0][2] * out[0][2] < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 9; i++) {
        out[i / 3][i % 3] *= sign;
    }
}

static bool keeps_normals(const mt_transform *t)
{
    mt_transform identity = mt_transform_identity();
    bool same = true;
    for (size_t i = 0; i < 9; i++) {
        same = same && t->linear[i / 3][i % 3] == identity.linear[i / 3][i % 3];
    }
    return same;
}

static void put_normals(const mt_gltf_values *from, const mt_transform *transform, float *to)
{
    double m[3][3];
    bool moved = !keeps_normals(transform);
    normal_matrix(transform, m);
    for (uint64_t i = 0; i < from->count; i++, to += 3) {
        double n[3] = {mt_gltf_get(from, i, 0), mt_gltf_get(from, i, 1), mt_gltf_get(from, i, 2)}, r[3];
        for (int k = 0; k < 3; k++) {
            r[k] = moved ? m[k][0] * n[0] + m[k][1] * n[1] + m[k][2] * n[2] : n[k];
        }
        double length = moved ? sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]) : 1.0;
        for (int k = 0; k < 3; k++) {
            to[k] = (float)(length > 0.0 ? r[k] / length : r[k]);
        }
    }
}

/* glTF counts v from the top, attributes here from the bottom. */
static void put_uvs(const mt_gltf_values *from, float *to)
{
    for (uint64_t i = 0; i < from->count; i++, to += 2) {
        to[0] = (float)mt_gltf_get(from, i, 0);
        to[1] = (float)(1.0 - mt_gltf_get(from, i, 1));
    }
}

static void put_colors(const mt_gltf_values *from, mt_attribute *attribute, mt_index begin)
{
    double scale = attribute->type == MT_F32 ? 1.0 : mt_color_maximum(attribute->type);
    for (uint64_t i = 0; i < from->count; i++) {
        for (unsigned k = 0; k < attribute->component_count; k++) {
            double number = k < from->component_count ? mt_gltf_get(from, i, k) : 1.0;
            mt_attribute_set(attribute, begin + (mt_index)i, k, number * scale);
        }
    }
}

static void put_values(const mt_gltf_values *from, const mt_transform *transform, unsigned slot,
                       mt_attribute *attribute, mt_index begin)
{
    if (is_color(slot)) {
        put_colors(from, attribute, begin);
    } else if (slot == MT_GLTF_NORMAL) {
        put_normals(from, transform, (float *)attribute->values + 3 * (size_t)begin);
    } else {
        put_uvs(from, (float *)attribute->values + 2 * (size_t)begin);
    }
}

static void fill_attribute(const slot_plan *plan, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                           size_t count, mt_attribute *attribute)
{
    mt_index vertex = 0, value = 0;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < shapes[i]->set_count; k++) {
            const mt_gltf_vertices *set = &shapes[i]->sets[k];
            const mt_gltf_values *values = &set->slots[plan->slot];
            for (uint64_t v = 0; v < set->positions.count && attribute->indices; v++) {
                attribute->indices[vertex + v] = values->count > 0 ? value + (mt_index)v : MT_NONE;
            }
            if (values->count > 0) {
                put_values(values, &instances[i].transform, plan->slot, attribute, value);
            }
            vertex += (mt_index)set->positions.count;
            value += (mt_index)values->count;
        }
    }
}

mt_status mt_gltf_build_attributes(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                                   size_t count, mt_mesh *mesh)
{
    mt_status status = MT_OK;
    for (unsigned slot = 0; slot < MT_GLTF_SLOT_COUNT && status == MT_OK; slot++) {
        slot_plan plan = plan_slot(slot, shapes, count);
        mt_attribute *attribute = NULL;
        if (plan.count > 0) {
            status = add_attribute(file, &plan, mesh, &attribute);
        }
        if (attribute) {
            fill_attribute(&plan, instances, shapes, count, attribute);
        }
    }
    return status;
}
