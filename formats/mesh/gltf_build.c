/* The shapes at their instances become one mesh: vertices and elements one instance after the other, nothing joined.
 * Positions stay floats when no instance is moved and the file holds floats; else they are doubles. */
#include "formats/mesh/gltf.h"

#include <meshtool/checked.h>

#include <math.h>
#include <string.h>

/* A file of which more than this becomes for each of its bytes is refused. An honest one has a byte and more for each
 * vertex, and shows it some times. */
#define ELEMENTS_PER_BYTE 256
#define ELEMENTS_FREE (1u << 20)

mt_status mt_gltf_justify(mt_gltf_file *file, uint64_t elements)
{
    uint64_t limit = ELEMENTS_FREE + ELEMENTS_PER_BYTE * file->bytes_read;
    return elements <= limit
               ? MT_OK
               : mt_fail(file->context, MT_ERROR_TOO_LARGE,
                         "%s: %llu bytes would become more than %llu vertices and indices, as meshes or accessors are "
                         "named again and again",
                         mt_input_name(file->input), (unsigned long long)file->bytes_read, (unsigned long long)limit);
}

static bool is_identity(const mt_transform *t)
{
    mt_transform identity = mt_transform_identity();
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (t->linear[i][k] != identity.linear[i][k]) {
                return false;
            }
        }
    }
    return t->translation.x == 0.0 && t->translation.y == 0.0 && t->translation.z == 0.0;
}

static double determinant(const mt_transform *t)
{
    const double(*m)[3] = t->linear;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

typedef struct totals {
    uint64_t vertices, triangles, wires, wire_vertices, points;
    mt_type type;
} totals;

static mt_status count_all(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                           size_t count, totals *out)
{
    mt_status status = MT_OK;
    *out = (totals){.type = MT_F32};
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        const mt_gltf_shape *shape = shapes[i];
        out->vertices += shape->vertex_count;
        out->triangles += shape->triangle_count;
        out->wires += shape->wire_count;
        out->wire_vertices += shape->wire_vertex_count;
        out->points += shape->point_count;
        status = mt_gltf_justify(file, out->vertices + 3 * out->triangles + out->wire_vertices + out->points);
        for (size_t k = 0; k < shape->set_count; k++) {
            bool floats = shape->sets[k].positions.type == MT_F32 && is_identity(&instances[i].transform);
            out->type = floats ? out->type : MT_F64;
        }
    }
    return status;
}

static void put_positions(const mt_gltf_values *from, const mt_transform *transform, mt_mesh *mesh, mt_index begin)
{
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
    if (mesh->position_type == MT_F32 && from->stride == 12) {
        memcpy((float *)mesh->positions + 3 * (size_t)begin, from->bytes, (size_t)from->count * 12);
        return;
    }
#endif
    bool moved = !is_identity(transform);
    for (uint64_t i = 0; i < from->count; i++) {
        mt_vec3 p = mt_vec3_make(mt_gltf_get(from, i, 0), mt_gltf_get(from, i, 1), mt_gltf_get(from, i, 2));
        mt_mesh_set_position(mesh, begin + (mt_index)i, moved ? mt_transform_point(transform, p) : p);
    }
}

/* How far the mesh is filled. */
typedef struct fill {
    mt_index vertex, corner, wire, wire_vertex, point;
} fill;

/* A mirrored shape turns its triangles round, so that their outside stays outside (section 3.7.4). */
static void put_triangles(mt_mesh *mesh, fill *at, const mt_gltf_elements *elements, bool mirrored)
{
    for (uint64_t i = 0; i < elements->count; i += 3) {
        const mt_index *from = elements->vertices + i;
        mt_index *to = mesh->corner_vertices + at->corner;
        to[0] = at->vertex + from[0];
        to[1] = at->vertex + from[mirrored ? 2 : 1];
        to[2] = at->vertex + from[mirrored ? 1 : 2];
        at->corner += 3;
    }
}

static void put_wires(mt_mesh *mesh, fill *at, const mt_gltf_elements *elements)
{
    uint64_t length = elements->corner_count ? elements->corner_count : elements->count;
    for (uint64_t i = 0; i < elements->count; i++) {
        mesh->wire_vertices[at->wire_vertex++] = at->vertex + elements->vertices[i];
        if ((i + 1) % length == 0) {
            mesh->wire_offsets[++at->wire] = at->wire_vertex;
        }
    }
}

static void put_shape(mt_mesh *mesh, fill *at, const mt_gltf_instance *instance, const mt_gltf_shape *shape)
{
    bool mirrored = determinant(&instance->transform) < 0.0;
    for (size_t i = 0; i < shape->set_count; i++) {
        put_positions(&shape->sets[i].positions, &instance->transform, mesh,
                      at->vertex + (mt_index)shape->sets[i].begin);
    }
    for (size_t i = 0; i < shape->element_count; i++) {
        const mt_gltf_elements *elements = &shape->elements[i];
        if (elements->corner_count == 3) {
            put_triangles(mesh, at, elements, mirrored);
        } else if (elements->corner_count == 1) {
            for (uint64_t k = 0; k < elements->count; k++) {
                mesh->point_vertices[at->point++] = at->vertex + elements->vertices[k];
            }
        } else {
            put_wires(mesh, at, elements);
        }
    }
    at->vertex += (mt_index)shape->vertex_count;
}

static mt_status make_mesh(mt_gltf_file *file, const totals *all, mt_mesh **out)
{
    mt_mesh_layout layout = {
        .vertex_count = all->vertices, .face_count = all->triangles, .face_size = 3, .position_type = all->type};
    if (!mt_count_fits(all->wire_vertices) || !mt_count_fits(all->points)) {
        return mt_fail(file->context, MT_ERROR_TOO_LARGE, "%s: more lines or points than can be held",
                       mt_input_name(file->input));
    }
    mt_status status = mt_mesh_create(file->context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    if (all->wires > 0) {
        mesh->wire_offsets = mt_allocate_array(file->context, all->wires + 1, sizeof(mt_index));
        mesh->wire_vertices = mt_allocate_array(file->context, all->wire_vertices, sizeof(mt_index));
    }
    if (all->points > 0) {
        mesh->point_vertices = mt_allocate_array(file->context, all->points, sizeof(mt_index));
    }
    bool had =
        (all->wires == 0 || (mesh->wire_offsets && mesh->wire_vertices)) && (all->points == 0 || mesh->point_vertices);
    if (!had) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mesh->wire_count = (mt_index)all->wires;
    mesh->point_count = (mt_index)all->points;
    if (all->wires > 0) {
        mesh->wire_offsets[0] = 0;
    }
    return MT_OK;
}

/* The name of a node, or of the mesh that it shows where it has none. */
static mt_status part_name(mt_gltf_file *file, const mt_gltf_instance *instance, const char **out)
{
    *out = "";
    mt_json_node node = mt_json_element(&file->lists[MT_GLTF_NODES], instance->node);
    mt_status status = node.value ? mt_json_string(file->context, &node, "name", MT_JSON_OPTIONAL, out) : MT_OK;
    if (status == MT_OK && !**out) {
        mt_json_node mesh = mt_json_element(&file->lists[MT_GLTF_MESHES], instance->mesh);
        status = mt_json_string(file->context, &mesh, "name", MT_JSON_OPTIONAL, out);
    }
    return status;
}

/* One part for each instance, when there are several or the only one has a name. */
static mt_status label_parts(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                             size_t count, mt_mesh *mesh)
{
    const char *name = "";
    mt_labels *labels = NULL;
    mt_index face = 0, number;
    mt_status status = count == 1 ? part_name(file, &instances[0], &name) : MT_OK;
    if (status != MT_OK || count == 0 || (count == 1 && !*name)) {
        return status;
    }
    status = mt_mesh_add_labels(file->context, mesh, MT_LABEL_PART, &labels);
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        status = part_name(file, &instances[i], &name);
        if (status == MT_OK) {
            status = mt_labels_add_name(file->context, labels, name, &number);
        }
        for (uint64_t k = 0; k < shapes[i]->triangle_count && status == MT_OK; k++) {
            labels->face_labels[face++] = number;
        }
    }
    return status;
}

static mt_status name_materials(mt_gltf_file *file, mt_labels *labels)
{
    mt_status status = MT_OK;
    for (size_t i = 0; i < file->counts[MT_GLTF_MATERIALS] && status == MT_OK; i++) {
        mt_json_node material = mt_json_element(&file->lists[MT_GLTF_MATERIALS], i);
        const char *name = "";
        mt_index number;
        status = mt_json_string(file->context, &material, "name", MT_JSON_OPTIONAL, &name);
        if (status == MT_OK) {
            status = mt_labels_add_name(file->context, labels, name, &number);
        }
    }
    return status;
}

static mt_status label_materials(mt_gltf_file *file, mt_gltf_shape *const *shapes, size_t count, mt_mesh *mesh)
{
    mt_labels *labels = NULL;
    mt_index face = 0;
    mt_status status = MT_OK;
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < shapes[i]->element_count && status == MT_OK; k++) {
            const mt_gltf_elements *elements = &shapes[i]->elements[k];
            uint64_t triangles = elements->corner_count == 3 ? elements->count / 3 : 0;
            if (!labels && triangles > 0 && elements->material != MT_NONE) {
                status = mt_mesh_add_labels(file->context, mesh, MT_LABEL_MATERIAL, &labels);
                status = status == MT_OK ? name_materials(file, labels) : status;
            }
            for (uint64_t t = 0; t < triangles && status == MT_OK; t++, face++) {
                if (labels) {
                    labels->face_labels[face] = elements->material;
                }
            }
        }
    }
    return status;
}

mt_status mt_gltf_build(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                        size_t count, mt_mesh **out)
{
    totals all;
    fill at = {0};
    mt_status status = count_all(file, instances, shapes, count, &all);
    if (status == MT_OK) {
        status = make_mesh(file, &all, out);
    }
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        put_shape(*out, &at, &instances[i], shapes[i]);
    }
    if (status == MT_OK) {
        status = mt_gltf_build_attributes(file, instances, shapes, count, *out);
    }
    if (status == MT_OK) {
        status = label_parts(file, instances, shapes, count, *out);
    }
    return status == MT_OK ? label_materials(file, shapes, count, *out) : status;
}
