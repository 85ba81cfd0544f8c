/* The scene (section 3.5): a forest of nodes, walked without recursion, with the transforms multiplied on the way. */
#include "formats/mesh/gltf.h"

#include <math.h>
#include <string.h>

#define NONE SIZE_MAX

/* Columns of glTF's matrix, which is affine: its last row is 0 0 0 1. */
static mt_status take_matrix(mt_gltf_file *file, const mt_json_node *node, mt_transform *out)
{
    double m[16];
    mt_status status = mt_json_numbers(file->context, node, "matrix", MT_JSON_REQUIRED, 16, m);
    if (status != MT_OK) {
        return status;
    }
    if (m[3] != 0.0 || m[7] != 0.0 || m[11] != 0.0 || m[15] != 1.0) {
        return mt_json_fail(file->context, node, MT_ERROR_SYNTAX,
                            "the matrix is not affine: its last row is not 0 0 0 1");
    }
    for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++) {
            out->linear[row][column] = m[4 * column + row];
        }
    }
    out->translation = mt_vec3_make(m[12], m[13], m[14]);
    return MT_OK;
}

/* Rotation by a unit quaternion x y z w, times the scale on its right. The sums are exact for no rotation. */
static void take_rotation(const double q[4], const double scale[3], mt_transform *out)
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    const double rows[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                               {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                               {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    for (size_t row = 0; row < 3; row++) {
        for (size_t column = 0; column < 3; column++) {
            out->linear[row][column] = rows[row][column] * scale[column];
        }
    }
}

mt_status mt_gltf_node_transform(mt_gltf_file *file, const mt_json_node *node, mt_transform *out)
{
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    *out = mt_transform_identity();
    if (json_object_get(node->value, "matrix")) {
        file->has_both = file->has_both || json_object_get(node->value, "translation") ||
                         json_object_get(node->value, "rotation") || json_object_get(node->value, "scale");
        return take_matrix(file, node, out);
    }
    mt_status status = mt_json_numbers(file->context, node, "translation", MT_JSON_OPTIONAL, 3, t);
    if (status == MT_OK) {
        status = mt_json_numbers(file->context, node, "rotation", MT_JSON_OPTIONAL, 4, q);
    }
    if (status == MT_OK) {
        status = mt_json_numbers(file->context, node, "scale", MT_JSON_OPTIONAL, 3, s);
    }
    if (status != MT_OK) {
        return status;
    }
    /* Floats in text are a little off unit length; the scale that this would bring in is taken out again. */
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(length > 0.0) || isinf(length)) {
        mt_json_node place = mt_json_member(node, "rotation");
        return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX, "expected a unit quaternion");
    }
    for (size_t i = 0; i < 4 && length != 1.0; i++) {
        q[i] /= length;
    }
    take_rotation(q, s, out);
    out->translation = mt_vec3_make(t[0], t[1], t[2]);
    return MT_OK;
}

/* The forest: per node its parent, and where its children stand in `children`. */
typedef struct forest {
    size_t count;
    size_t *parents;
    size_t *begins; /* count + 1 */
    size_t *children;
    size_t *order;  /* nodes, each after its parent */
    uint8_t *shown; /* below a root of the scene */
    mt_transform *transforms;
} forest;

static mt_status add_child(mt_gltf_file *file, forest *f, size_t parent, const mt_json_node *place, size_t at)
{
    uint64_t child = 0;
    mt_status status = mt_json_node_whole(file->context, place, 0, f->count - 1, &child);
    if (status == MT_OK && f->parents[child] != NONE) {
        return mt_json_fail(file->context, place, MT_ERROR_SYNTAX,
                            "nodes[%llu] has two parents, nodes[%zu] and nodes[%zu]", (unsigned long long)child,
                            f->parents[child], parent);
    }
    if (status == MT_OK) {
        f->parents[child] = parent;
        f->children[at] = (size_t)child;
    }
    return status;
}

static mt_status read_children(mt_gltf_file *file, forest *f)
{
    size_t at = 0;
    mt_status status = MT_OK;
    for (size_t i = 0; i < f->count && status == MT_OK; i++) {
        mt_json_node node = mt_json_element(&file->lists[MT_GLTF_NODES], i), list;
        size_t count = 0;
        f->begins[i] = at;
        status = mt_json_array(file->context, &node, "children", MT_JSON_OPTIONAL, &list, &count);
        for (size_t k = 0; k < count && status == MT_OK; k++) {
            /* A node is the child of one other at most: more children than nodes cannot all be right. */
            mt_json_node child = mt_json_element(&list, k);
            status = at < f->count ? add_child(file, f, i, &child, at)
                                   : mt_json_fail(file->context, &child, MT_ERROR_SYNTAX, "a node has two parents");
            at++;
        }
    }
    f->begins[f->count] = at;
    return status;
}

static mt_status make_forest(mt_gltf_file *file, forest *f)
{
    f->count = file->counts[MT_GLTF_NODES];
    f->parents = mt_gltf_allocate(file, f->count, sizeof *f->parents);
    f->begins = mt_gltf_allocate(file, (uint64_t)f->count + 1, sizeof *f->begins);
    f->children = mt_gltf_allocate(file, f->count, sizeof *f->children);
    f->order = mt_gltf_allocate(file, f->count, sizeof *f->order);
    f->shown = mt_gltf_allocate(file, f->count, sizeof *f->shown);
    f->transforms = mt_gltf_allocate(file, f->count, sizeof *f->transforms);
    if (!f->parents || !f->begins || !f->children || !f->order || !f->shown || !f->transforms) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (size_t i = 0; i < f->count; i++) {
        f->parents[i] = NONE;
        f->shown[i] = 0;
    }
    return read_children(file, f);
}

/* Marks the roots of the scene that is shown: all roots where the file names no scene. */
static mt_status mark_roots(mt_gltf_file *file, forest *f)
{
    mt_json_node scene, list;
    size_t count = 0, index = 0;
    mt_status status = mt_gltf_refer(file, &file->root, "scene", MT_JSON_OPTIONAL, MT_GLTF_SCENES, &scene, &index);
    if (status == MT_OK && !scene.value && file->counts[MT_GLTF_SCENES] > 0) {
        scene = mt_json_element(&file->lists[MT_GLTF_SCENES], 0);
    }
    if (status != MT_OK || !scene.value) {
        for (size_t i = 0; i < f->count; i++) {
            f->shown[i] = f->parents[i] == NONE;
        }
        return status;
    }
    if (file->counts[MT_GLTF_SCENES] > 1) {
        mt_warn(file->context, "%s: of %zu scenes only scenes[%zu] is read", mt_input_name(file->input),
                file->counts[MT_GLTF_SCENES], index);
    }
    status = mt_json_array(file->context, &scene, "nodes", MT_JSON_OPTIONAL, &list, &count);
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        mt_json_node place = mt_json_element(&list, i);
        uint64_t node = 0;
        status = f->count ? mt_json_node_whole(file->context, &place, 0, f->count - 1, &node)
                          : mt_json_fail(file->context, &place, MT_ERROR_SYNTAX, "there are no nodes");
        if (status == MT_OK && f->parents[node] != NONE) {
            status = mt_json_fail(file->context, &place, MT_ERROR_SYNTAX,
                                  "nodes[%llu] is no root, it has the parent nodes[%zu]", (unsigned long long)node,
                                  f->parents[node]);
        }
        if (status == MT_OK) {
            f->shown[node] = 1;
        }
    }
    return status;
}

/* Every node after its parent, each family together: a walk from root to root with a stack. */
static mt_status order_nodes(mt_gltf_file *file, forest *f)
{
    size_t *stack = mt_gltf_allocate(file, f->count, sizeof *stack), depth = 0, done = 0;
    if (!stack) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (size_t root = 0; root < f->count; root++) {
        if (f->parents[root] != NONE) {
            continue;
        }
        stack[depth++] = root;
        while (depth > 0) {
            size_t node = stack[--depth];
            f->order[done++] = node;
            for (size_t k = f->begins[node + 1]; k > f->begins[node]; k--) {
                stack[depth++] = f->children[k - 1];
            }
        }
    }
    if (done == f->count) {
        return MT_OK;
    }
    /* What no root leads to has parents all the way round. */
    memset(stack, 0, f->count * sizeof *stack);
    for (size_t i = 0; i < done; i++) {
        stack[f->order[i]] = 1;
    }
    size_t lost = 0;
    while (stack[lost]) {
        lost++;
    }
    mt_json_node place = mt_json_element(&file->lists[MT_GLTF_NODES], lost);
    return mt_json_fail(file->context, &place, MT_ERROR_SYNTAX, "the node is below itself: its parents form a cycle");
}

static mt_status place_node(mt_gltf_file *file, forest *f, size_t node)
{
    mt_json_node place = mt_json_element(&file->lists[MT_GLTF_NODES], node);
    size_t parent = f->parents[node];
    mt_transform own;
    mt_status status = mt_gltf_node_transform(file, &place, &own);
    if (status == MT_OK) {
        f->shown[node] = parent == NONE ? f->shown[node] : f->shown[parent];
        f->transforms[node] = parent == NONE ? own : mt_transform_then(&own, &f->transforms[parent]);
    }
    return status;
}

static mt_status list_instances(mt_gltf_file *file, const forest *f, mt_gltf_instance *out, size_t *count)
{
    mt_status status = MT_OK;
    *count = 0;
    for (size_t i = 0; i < f->count && status == MT_OK; i++) {
        size_t node = f->order[i], index = 0;
        mt_json_node place = mt_json_element(&file->lists[MT_GLTF_NODES], node), mesh;
        status = mt_gltf_refer(file, &place, "mesh", MT_JSON_OPTIONAL, MT_GLTF_MESHES, &mesh, &index);
        if (status == MT_OK && mesh.value && f->shown[node]) {
            out[(*count)++] = (mt_gltf_instance){node, index, f->transforms[node]};
        }
    }
    return status;
}

mt_status mt_gltf_walk(mt_gltf_file *file, mt_gltf_instance **out, size_t *count)
{
    forest f = {0};
    *count = 0;
    mt_status status = make_forest(file, &f);
    if (status == MT_OK) {
        status = mark_roots(file, &f);
    }
    if (status == MT_OK) {
        status = order_nodes(file, &f);
    }
    for (size_t i = 0; i < f.count && status == MT_OK; i++) {
        status = place_node(file, &f, f.order[i]);
    }
    *out = status == MT_OK ? mt_gltf_allocate(file, f.count, sizeof **out) : NULL;
    if (status == MT_OK && !*out) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    return status == MT_OK ? list_instances(file, &f, *out, count) : status;
}
