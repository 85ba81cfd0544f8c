/* Objects, instances and their transforms. */
#include "formats/scene/scene_file.h"

#include <meshtool/checked.h>

#include <string.h>

static mt_status read_scale(mt_context *context, const mt_json_node *node, mt_transform *out)
{
    double s[3] = {1, 1, 1};
    mt_status status = MT_OK;
    if (json_is_number(node->value)) {
        s[0] = s[1] = s[2] = json_number_value(node->value);
    } else if (node->value) {
        status = scene_read_numbers(context, node, 3, "a number, or three, none 0", s);
    }
    for (int i = 0; i < 3; i++) {
        out->linear[i][i] = s[i];
        if (status == MT_OK && s[i] == 0) {
            status = mt_json_fail(context, node, MT_ERROR_SYNTAX, "a scale of 0 leaves nothing");
        }
    }
    return status;
}

static mt_status read_steps(mt_context *context, const mt_json_node *node, mt_transform *out)
{
    scene_transform record = {.translate = {0, 0, 0}};
    mt_status status = scene_read_fields(context, node, scene_transform_fields, &record);
    if (status == MT_OK) {
        status = read_scale(context, &record.scale, out);
    }
    double r[4] = {0, 1, 0, 0};
    if (status == MT_OK && record.rotation.value) {
        status = scene_read_numbers(context, &record.rotation, 4, "four numbers: an axis x, y, z and degrees", r);
        if (status == MT_OK && r[0] == 0 && r[1] == 0 && r[2] == 0) {
            status = mt_json_fail(context, &record.rotation, MT_ERROR_SYNTAX, "the axis is 0, 0, 0");
        }
    }
    if (status == MT_OK && record.rotation.value) {
        mt_transform turn = mt_transform_rotation(mt_vec3_make(r[0], r[1], r[2]), r[3]);
        *out = mt_transform_then(out, &turn);
    }
    out->translation = record.translate;
    return status;
}

static mt_status read_matrix(mt_context *context, const mt_json_node *node, mt_transform *out)
{
    double m[12];
    mt_status status =
        scene_read_numbers(context, node, 12, "an object, or 12 numbers: three rows of a matrix of four columns", m);
    for (int row = 0; status == MT_OK && row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            out->linear[row][column] = m[4 * row + column];
        }
    }
    if (status == MT_OK) {
        out->translation = mt_vec3_make(m[3], m[7], m[11]);
    }
    return status;
}

static mt_status read_transform(mt_context *context, const mt_json_node *node, mt_transform *out)
{
    mt_transform inverse;
    *out = mt_transform_identity();
    if (!node->value) {
        return MT_OK;
    }
    mt_status status = json_is_object(node->value) ? read_steps(context, node, out) : read_matrix(context, node, out);
    if (status == MT_OK && !mt_transform_inverse(out, &inverse)) {
        status = mt_json_fail(context, node, MT_ERROR_SYNTAX,
                              "the transform cannot be undone: it leaves no volume, or its numbers are too large");
    }
    return status;
}

static mt_status read_corners(mt_context *context, const mt_json_node *node, mt_triangle *out)
{
    static const char expects[] = "three points of three numbers each";
    mt_status status = json_is_array(node->value) && json_array_size(node->value) == 3
                           ? MT_OK
                           : mt_json_fail_expected(context, node, expects);
    for (size_t i = 0; status == MT_OK && i < 3; i++) {
        double p[3] = {0, 0, 0};
        mt_json_node corner = mt_json_element(node, i);
        status = scene_read_numbers(context, &corner, 3, "three numbers", p);
        out->corners[i] = mt_vec3_make(p[0], p[1], p[2]);
    }
    return status;
}

static mt_scene_object *add(const scene_reading *reading, const mt_scene_object *like)
{
    mt_scene_object *object = &reading->file->objects[reading->file->scene.object_count++];
    *object = *like;
    return object;
}

static mt_status add_instances(const scene_reading *reading, const mt_scene_object *like, const mt_json_node *node)
{
    mt_status status = MT_OK;
    for (size_t i = 0; status == MT_OK && i < json_array_size(node->value); i++) {
        mt_json_node transform = mt_json_element(node, i);
        status = read_transform(reading->context, &transform, &add(reading, like)->shape.transform);
    }
    return status;
}

static mt_status read_record(const scene_reading *reading, const mt_json_node *node, scene_object *record)
{
    static const scene_field kind_field[] = {
        {"kind", SCENE_CHOICE, offsetof(scene_object, kind), true, false, 0, 0, scene_object_kinds, NULL, NULL}, {0}};
    mt_json_node kind = mt_json_member(node, "kind");
    *record = (scene_object){.normal = {0, 1, 0}};
    if (!json_is_object(node->value)) {
        return mt_json_fail_expected(reading->context, node, "an object");
    }
    for (int i = 0; i < SCENE_OBJECT_KINDS; i++) {
        if (json_is_string(kind.value) && strcmp(json_string_value(kind.value), scene_object_kinds[i]) == 0) {
            return scene_read_fields(reading->context, node, scene_object_fields[i], record);
        }
    }
    char expects[SCENE_EXPECTS_ROOM];
    scene_expects(kind_field, expects);
    return mt_json_fail_expected(reading->context, &kind, expects);
}

static mt_status read_object(const scene_reading *reading, const mt_json_node *node)
{
    mt_context *context = reading->context;
    scene_object record;
    mt_scene_object object = {.kind = MT_OBJECT_PLANE, .material = reading->file->scene.material_count - 1};
    mt_status status = read_record(reading, node, &record);
    if (status == MT_OK && record.material) {
        status =
            scene_find_name(reading, node, &reading->material_names, "material", record.material, &object.material);
    }
    if (status == MT_OK && record.mesh) {
        status = scene_find_name(reading, node, &reading->mesh_names, "mesh", record.mesh, &object.mesh);
    }
    if (status != MT_OK) {
        return status;
    }
    switch (record.kind) {
    case SCENE_PLANE:
        object.shape.plane = (mt_plane){record.point, record.normal};
        break;
    case SCENE_SPHERE:
        object.kind = MT_OBJECT_SPHERE;
        object.shape.sphere = (mt_sphere){record.center, record.radius};
        break;
    case SCENE_TRIANGLE:
        object.kind = MT_OBJECT_TRIANGLE;
        status = read_corners(context, &record.corners, &object.shape.triangle);
        break;
    case SCENE_MESH:
        object.kind = MT_OBJECT_MESH;
        status = read_transform(context, &record.transform, &object.shape.transform);
        break;
    default:
        object.kind = MT_OBJECT_MESH;
        return add_instances(reading, &object, &record.transforms);
    }
    if (status == MT_OK) {
        add(reading, &object);
    }
    return status;
}

/* Room for every object and instance; what is no array counts for nothing, and is refused where it is read. */
static uint64_t count_objects(const mt_json_node *objects)
{
    uint64_t count = 0;
    for (size_t i = 0; i < json_array_size(objects->value); i++) {
        const json_t *transforms = json_object_get(json_array_get(objects->value, i), "transforms");
        count += json_is_array(transforms) ? json_array_size(transforms) : 0;
        count++;
    }
    return count;
}

mt_status scene_read_objects(const scene_reading *reading, const mt_json_node *objects)
{
    mt_context *context = reading->context;
    uint64_t count = count_objects(objects);
    if (!json_is_array(objects->value)) {
        return mt_json_fail_expected(context, objects, "an array of objects");
    }
    if (!mt_count_fits(count + 1)) {
        return mt_json_fail(context, objects, MT_ERROR_TOO_LARGE, "there are too many objects");
    }
    reading->file->objects = (mt_scene_object *)mt_allocate_array(context, count, sizeof *reading->file->objects);
    if (!reading->file->objects) {
        return mt_context_error(context)->status;
    }
    mt_status status = MT_OK;
    for (size_t i = 0; status == MT_OK && i < json_array_size(objects->value); i++) {
        mt_json_node object = mt_json_element(objects, i);
        status = read_object(reading, &object);
    }
    return status;
}
