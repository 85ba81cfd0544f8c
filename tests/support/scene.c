#include "tests/support/scene.h"

#include "tests/support/unit.h"

#include <math.h>
#include <string.h>

void test_scene_init(test_scene *scene, uint32_t size)
{
    memset(scene, 0, sizeof *scene);
    mt_scene *s = &scene->scene;
    s->camera.eye = mt_vec3_make(0, 0, 5);
    s->camera.fov_degrees = 40;
    s->width = s->height = size;
    s->samples = 1;
    s->lights = scene->lights;
    s->materials = scene->materials;
    s->meshes = scene->meshes;
    s->objects = scene->objects;
    mt_index number;
    test_scene_material(scene, &number)->color = mt_vec3_make(1, 1, 1);
}

mt_material *test_scene_material(test_scene *scene, mt_index *number)
{
    assert_true(scene->scene.material_count < TEST_SCENE_ROOM);
    *number = scene->scene.material_count++;
    scene->materials[*number] = mt_material_default();
    return &scene->materials[*number];
}

mt_scene_light *test_scene_light(test_scene *scene, mt_scene_light_kind kind, mt_vec3 place, bool shadows)
{
    assert_true(scene->scene.light_count < TEST_SCENE_ROOM);
    mt_scene_light *light = &scene->lights[scene->scene.light_count++];
    *light = (mt_scene_light){kind, place, {1, 1, 1}, 0, shadows};
    return light;
}

static mt_scene_object *add(test_scene *scene, mt_scene_object_kind kind, mt_index material)
{
    assert_true(scene->scene.object_count < TEST_SCENE_ROOM);
    mt_scene_object *object = &scene->objects[scene->scene.object_count++];
    memset(object, 0, sizeof *object);
    object->kind = kind;
    object->material = material;
    return object;
}

void test_scene_plane(test_scene *scene, mt_index material, mt_vec3 point, mt_vec3 normal)
{
    add(scene, MT_OBJECT_PLANE, material)->shape.plane = (mt_plane){point, normal};
}

void test_scene_sphere(test_scene *scene, mt_index material, mt_vec3 center, double radius)
{
    add(scene, MT_OBJECT_SPHERE, material)->shape.sphere = (mt_sphere){center, radius};
}

void test_scene_mesh(test_scene *scene, mt_index material, const mt_mesh *mesh, mt_transform transform)
{
    mt_index number = 0;
    while (number < scene->scene.mesh_count && scene->meshes[number].mesh != mesh) {
        number++;
    }
    if (number == scene->scene.mesh_count) {
        assert_true(number < TEST_SCENE_ROOM);
        scene->meshes[scene->scene.mesh_count++] = (mt_scene_mesh){.mesh = mesh};
    }
    mt_scene_object *object = add(scene, MT_OBJECT_MESH, material);
    object->mesh = number;
    object->shape.transform = transform;
}

mt_image *test_scene_draw(mt_context *context, const test_scene *scene, const mt_scene_options *options,
                          mt_scene_report *report)
{
    mt_image *image = NULL;
    if (mt_scene_render(context, &scene->scene, options, &image, report) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    return image;
}

mt_ray test_scene_ray(uint32_t size, uint32_t x, uint32_t y)
{
    double tangent = tan(20 * acos(-1.0) / 180);
    mt_vec3 direction = {(2 * (x + 0.5) / size - 1) * tangent, (1 - 2 * (y + 0.5) / size) * tangent, -1};
    return mt_ray_make(mt_vec3_make(0, 0, 5), direction);
}

uint64_t test_image_hash(const mt_image *image)
{
    return test_hash(image->pixels, (size_t)image->width * image->height * image->channel_count * sizeof(float));
}
