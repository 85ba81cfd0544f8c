/* Small scenes for tests: a camera at (0, 0, 5) that looks at the middle, one dull white material, nothing else. */
#ifndef TESTS_SUPPORT_SCENE_H
#define TESTS_SUPPORT_SCENE_H

#include "tests/support/fixture.h"

#include <meshtool/scene.h>

#define TEST_SCENE_ROOM 64

typedef struct test_scene {
    mt_scene scene;
    mt_scene_light lights[TEST_SCENE_ROOM];
    mt_material materials[TEST_SCENE_ROOM];
    mt_scene_mesh meshes[TEST_SCENE_ROOM];
    mt_scene_object objects[TEST_SCENE_ROOM];
} test_scene;

/* Black, in 1 sample a pixel, of a square picture. It is not to be moved. */
void test_scene_init(test_scene *scene, uint32_t size);

mt_material *test_scene_material(test_scene *scene, mt_index *number);
mt_scene_light *test_scene_light(test_scene *scene, mt_scene_light_kind kind, mt_vec3 place, bool shadows);
void test_scene_plane(test_scene *scene, mt_index material, mt_vec3 point, mt_vec3 normal);
void test_scene_sphere(test_scene *scene, mt_index material, mt_vec3 center, double radius);
/* A mesh is added to the scene when it is not among its meshes. */
void test_scene_mesh(test_scene *scene, mt_index material, const mt_mesh *mesh, mt_transform transform);

/* Draws it; fails the test when it cannot. */
mt_image *test_scene_draw(mt_context *context, const test_scene *scene, const mt_scene_options *options,
                          mt_scene_report *report);

/* The camera's ray through the middle of a pixel, written down independently: perspective, 40 degrees. */
mt_ray test_scene_ray(uint32_t size, uint32_t x, uint32_t y);

uint64_t test_image_hash(const mt_image *image);

#endif
