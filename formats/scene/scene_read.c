/* A scene file from its bytes to a scene. */
#include "formats/scene/scene_file.h"
#include "formats/stream/input.h"

#include <meshtool/checked.h>

#include <string.h>

/* A scene is written by people or scripts; larger ones than this are meant for something else. */
#define LARGEST_SCENE (UINT64_C(1) << 30)

static mt_status read_samples(mt_context *context, const mt_json_node *node, unsigned *out)
{
    static const char expects[] = "a square number from 1 to 64, or \"adaptive\"";
    const char *text = json_string_value(node->value);
    if (text && strcmp(text, "adaptive") == 0) {
        *out = MT_SAMPLES_ADAPTIVE;
        return MT_OK;
    }
    for (unsigned n = 1; n <= 8; n++) {
        if (json_is_number(node->value) && json_number_value(node->value) == n * n) {
            *out = n * n;
            return MT_OK;
        }
    }
    return node->value ? mt_json_fail_expected(context, node, expects) : MT_OK;
}

static mt_status read_image(mt_context *context, const mt_json_node *node, mt_scene *scene)
{
    scene_image record = {.cutoff = MT_SCENE_DEFAULT_CUTOFF};
    mt_status status = node->value ? scene_read_fields(context, node, scene_image_fields, &record) : MT_OK;
    scene->width = record.width;
    scene->height = record.height;
    scene->depth_limit = record.depth;
    scene->cutoff = record.cutoff > 0 ? record.cutoff : -1.0;
    return status == MT_OK ? read_samples(context, &record.samples, &scene->samples) : status;
}

static mt_status read_camera(mt_context *context, const mt_json_node *node, mt_scene_camera *camera)
{
    scene_camera record = {.up = {0, 1, 0}};
    mt_status status = scene_read_fields(context, node, scene_camera_fields, &record);
    mt_vec3 view = mt_vec3_subtract(record.target, record.eye);
    if (status == MT_OK && !(mt_vec3_max_abs(view) > 0 && mt_vec3_is_finite(view))) {
        status = mt_json_fail(context, node, MT_ERROR_SYNTAX, "the eye and the target are the same point, or too far");
    }
    *camera = (mt_scene_camera){
        (mt_projection)record.projection, record.eye, record.target, record.up, record.fov, record.width};
    return status;
}

static mt_status read_background(mt_context *context, const mt_json_node *node, mt_scene_background *background)
{
    scene_background record = {.transparent = false};
    if (!node->value) {
        return MT_OK;
    }
    mt_status status = scene_read_fields(context, node, scene_background_fields, &record);
    bool has_top = json_object_get(node->value, "top") != NULL;
    if (status == MT_OK && has_top && record.transparent) {
        status = mt_json_fail(context, node, MT_ERROR_SYNTAX, "a transparent background has no top");
    }
    background->kind = record.transparent ? MT_SCENE_TRANSPARENT : has_top ? MT_SCENE_GRADIENT : MT_SCENE_COLOR;
    background->color = record.color;
    background->top = record.top;
    return status;
}

static mt_status read_light(mt_context *context, const mt_json_node *node, mt_scene_light *light)
{
    mt_json_node kind = mt_json_member(node, "kind");
    const char *text = json_string_value(kind.value);
    bool is_point = text && strcmp(text, scene_light_kinds[MT_LIGHT_POINT]) == 0;
    scene_light record = {.color = {1, 1, 1}, .intensity = 1, .shadows = true};
    mt_status status =
        scene_read_fields(context, node, is_point ? scene_point_fields : scene_directional_fields, &record);
    *light = (mt_scene_light){.kind = (mt_scene_light_kind)record.kind,
                              .place = is_point ? record.position : mt_vec3_scale(record.direction, -1.0),
                              .color = mt_vec3_scale(record.color, record.intensity),
                              .fade = record.fade,
                              .casts_shadows = record.shadows};
    if (status == MT_OK && !mt_vec3_is_finite(light->color)) {
        status = mt_json_fail(context, node, MT_ERROR_SYNTAX, "color times intensity is too large for a number");
    }
    return status;
}

static mt_status read_lights(const scene_reading *reading, const mt_json_node *lights)
{
    mt_context *context = reading->context;
    size_t count = json_array_size(lights->value);
    if (lights->value && !json_is_array(lights->value)) {
        return mt_json_fail_expected(context, lights, "an array of lights");
    }
    if (!mt_count_fits(count)) {
        return mt_json_fail(context, lights, MT_ERROR_TOO_LARGE, "there are too many lights");
    }
    reading->file->lights = (mt_scene_light *)mt_allocate_array(context, count, sizeof *reading->file->lights);
    mt_status status = reading->file->lights ? MT_OK : mt_context_error(context)->status;
    for (size_t i = 0; status == MT_OK && i < count; i++) {
        mt_json_node light = mt_json_element(lights, i);
        status = read_light(context, &light, &reading->file->lights[i]);
    }
    reading->file->scene.light_count = (mt_index)count;
    return status;
}

static mt_status read_materials(const scene_reading *reading)
{
    mt_context *context = reading->context;
    const mt_json_node *materials = &reading->materials;
    mt_scene_file *file = reading->file;
    if (materials->value && !json_is_object(materials->value)) {
        return mt_json_fail_expected(context, materials, "an object of materials by name");
    }
    size_t count = json_object_size(materials->value) + 1;
    if (!mt_count_fits(count)) {
        return mt_json_fail(context, materials, MT_ERROR_TOO_LARGE, "there are too many materials");
    }
    file->materials = (mt_material *)mt_allocate_array(context, count, sizeof *file->materials);
    mt_status status = file->materials ? MT_OK : mt_context_error(context)->status;
    void *at = json_object_iter(materials->value);
    for (; status == MT_OK && at; at = json_object_iter_next(materials->value, at)) {
        mt_json_node material = mt_json_member(materials, json_object_iter_key(at));
        mt_material *out = &file->materials[file->scene.material_count++];
        *out = mt_material_default();
        status = scene_read_fields(context, &material, scene_material_fields, out);
    }
    if (status == MT_OK) {
        file->materials[file->scene.material_count++] = mt_material_default();
    }
    return status;
}

static mt_status read_root(scene_reading *reading, const mt_json_node *root)
{
    mt_context *context = reading->context;
    mt_scene *scene = &reading->file->scene;
    scene_root record = {.ambient = {0, 0, 0}};
    mt_status status = scene_read_fields(context, root, scene_root_fields, &record);
    reading->materials = record.materials;
    reading->meshes = record.meshes;
    scene->ambient = record.ambient;
    if (status == MT_OK) {
        status = read_image(context, &record.image, scene);
    }
    if (status == MT_OK) {
        status = read_camera(context, &record.camera, &scene->camera);
    }
    if (status == MT_OK) {
        status = read_background(context, &record.background, &scene->background);
    }
    if (status == MT_OK) {
        status = read_lights(reading, &record.lights);
    }
    if (status == MT_OK) {
        status = read_materials(reading);
    }
    if (status == MT_OK) {
        status = scene_read_meshes(reading);
    }
    if (status == MT_OK) {
        status = scene_names_init(context, &reading->materials, &reading->material_names);
    }
    if (status == MT_OK) {
        status = scene_names_init(context, &reading->meshes, &reading->mesh_names);
    }
    return status == MT_OK ? scene_read_objects(reading, &record.objects) : status;
}

static void connect(mt_scene_file *file)
{
    file->scene.lights = file->lights;
    file->scene.materials = file->materials;
    file->scene.meshes = file->meshes;
    file->scene.objects = file->objects;
}

mt_status mt_scene_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                               mt_scene_file **out)
{
    mt_json json;
    *out = NULL;
    mt_status status = mt_json_parse(context, name, bytes, size, &json);
    if (status != MT_OK) {
        return status;
    }
    mt_scene_file *file = (mt_scene_file *)mt_allocate_zeroed(context, sizeof *file);
    status = file ? MT_OK : mt_context_error(context)->status;
    if (file) {
        const mt_json_node root = mt_json_root_of_text(name, &json, bytes, size);
        scene_reading reading = {.context = context, .name = name, .file = file};
        status = read_root(&reading, &root);
        scene_names_release(context, &reading.material_names);
        scene_names_release(context, &reading.mesh_names);
    }
    mt_json_release(context, &json);
    if (status != MT_OK) {
        mt_scene_file_destroy(context, file);
        return status;
    }
    connect(file);
    *out = file;
    return MT_OK;
}

static mt_status read_all(mt_context *context, mt_input *input, void **bytes, size_t *size)
{
    mt_status status = mt_input_collect(context, input);
    uint64_t total = mt_input_size(input);
    if (status == MT_OK && total > LARGEST_SCENE) {
        return mt_fail(context, MT_ERROR_TOO_LARGE, "%s: a scene file has at most 1 GB, not %llu bytes",
                       mt_input_name(input), (unsigned long long)total);
    }
    *size = (size_t)total;
    *bytes = status == MT_OK ? mt_allocate(context, total) : NULL;
    if (!*bytes) {
        return mt_context_error(context)->status;
    }
    return mt_input_read_exactly(context, input, *bytes, *size, "the scene");
}

mt_status mt_scene_read_file(mt_context *context, const char *path, mt_scene_file **out)
{
    mt_input *input = NULL;
    void *bytes = NULL;
    size_t size = 0;
    *out = NULL;
    mt_status status = mt_input_open(context, path, &input);
    if (status != MT_OK) {
        return status;
    }
    status = read_all(context, input, &bytes, &size);
    if (status == MT_OK) {
        status = mt_scene_read_memory(context, mt_input_name(input), bytes, size, out);
    }
    mt_free(context, bytes);
    mt_input_close(context, input);
    return status;
}

void mt_scene_file_destroy(mt_context *context, mt_scene_file *file)
{
    if (!file) {
        return;
    }
    for (mt_index i = 0; i < file->owned_count; i++) {
        mt_mesh_destroy(context, file->owned[i]);
    }
    mt_free(context, file->lights);
    mt_free(context, file->materials);
    mt_free(context, file->meshes);
    mt_free(context, file->owned);
    mt_free(context, file->objects);
    mt_free(context, file);
}

mt_scene *mt_scene_file_scene(mt_scene_file *file)
{
    return &file->scene;
}
