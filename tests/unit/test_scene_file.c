/* Scene files: what every wrong one is told, with line and column; every truncation; memory; and that the scenes of
 * meshes/scenes are read as what they are. */
#include "tests/support/fixture.h"
#include "tests/support/scratch.h"
#include "tests/support/unit.h"

#include <meshtool/scene_format.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CAMERA "\"camera\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0]}"

/* `text` is put into line 2 of a scene that lacks nothing, unless it begins with '!': then it is the whole. */
static const struct {
    const char *text;
    int line, column;
    const char *message;
} wrong[] = {
    {"!", 1, 1, "the JSON ends here"},
    {"![]", 1, 1, "the root: expected an object, got an array of 0"},
    {"!{\"objects\": []}", 1, 1, "camera: is missing, expected an object"},
    {"!{" CAMERA "}", 1, 1, "objects: is missing, expected an array of objects"},
    {"!{" CAMERA ", \"objects\": 5}", 1, 64, "objects: expected an array of objects, got 5"},
    {"!{\"camera\": {\"eye\": [0, 0], \"target\": [0, 0, 0]}, \"objects\": []}", 1, 20,
     "camera.eye: expected three numbers, got an array of 2"},
    {"!{\"camera\": {\"eye\": [1, 2, 3], \"target\": [1, 2, 3]}, \"objects\": []}", 1, 12,
     "camera: the eye and the target are the same point"},
    {"!{\"camera\": {\"eye\": [1, 2, 3], \"target\": [0, 0, 0], \"fov\": 180}, \"objects\": []}", 1, 59,
     "camera.fov: expected a number from 0.001 to 179, got 180"},
    {"!{\"camera\": {\"eye\": [1, 2, 3], \"target\": [0, 0, 0], \"projection\": \"fish\"}, \"objects\": []}", 1, 66,
     "camera.projection: expected \"perspective\", \"orthographic\", \"cabinet\" or \"cavalier\", got \"fish\""},
    {"\"lihgts\": [],", 2, 11,
     "lihgts: this key is unknown here; known are image, camera, background, ambient, lights, materials, meshes and "
     "objects"},
    {"\"ambient\": 1, \"ambient\": 2,", 2, 23, "duplicate"},
    {"\"ambient\": [1, 1, -0.5],", 2, 12, "ambient: expected a colour: a number or three, not negative"},
    {"\"ambient\": \"#12345g\",", 2, 12, "ambient: expected a colour"},
    {"\"ambient\": 1e999,", 2, 0, "too large"},
    {"\"image\": {\"width\": 0},", 2, 20, "image.width: expected a whole number from 1 to 65535, got 0"},
    {"\"image\": {\"width\": 2.5},", 2, 20, "image.width: expected a whole number"},
    {"\"image\": {\"samples\": 5},", 2, 22,
     "image.samples: expected a square number from 1 to 64, or \"adaptive\", got 5"},
    {"\"image\": {\"depth\": 65},", 2, 20, "image.depth: expected a whole number from 1 to 64, got 65"},
    {"\"background\": {\"top\": 1, \"transparent\": true},", 2, 15, "background: a transparent background has no top"},
    {"\"background\": {\"transparent\": 1},", 2, 31, "background.transparent: expected true or false, got 1"},
    {"\"lights\": {},", 2, 11, "lights: expected an array of lights, got an object"},
    {"\"lights\": [{}],", 2, 12, "lights[0].kind: is missing, expected \"directional\" or \"point\""},
    {"\"lights\": [{\"kind\": \"spot\"}],", 2, 21,
     "lights[0].kind: expected \"directional\" or \"point\", got \"spot\""},
    {"\"lights\": [{\"kind\": \"point\"}],", 2, 12, "lights[0].position: is missing, expected three numbers"},
    {"\"lights\": [{\"kind\": \"point\", \"position\": [0, 0, 0], \"direction\": [0, 1, 0]}],", 2, 66,
     "lights[0].direction: this key is unknown here; known are kind, color, intensity, shadows, position and fade"},
    {"\"lights\": [{\"kind\": \"directional\", \"direction\": [0, 0, 0]}],", 2, 49,
     "lights[0].direction: expected three numbers that are not all 0"},
    {"\"materials\": {\"red\": {\"colour\": 1}},", 2, 33, "materials.red.colour: this key is unknown here"},
    {"\"materials\": {\"red\": {\"mirror\": [1, 2, 0]}},", 2, 33, "materials.red.mirror: expected a colour"},
    {"\"materials\": {\"g\": {\"refractive_index\": 0.5}},", 2, 41,
     "materials.g.refractive_index: expected a number from 1 to 10, got 0.5"},
    {"\"meshes\": {\"m\": {}},", 2, 17, "meshes.m: expected either the key \"file\" or the key \"generate\""},
    {"\"meshes\": {\"m\": {\"file\": \"/etc/passwd\"}},", 2, 26, "is an absolute path"},
    {"\"meshes\": {\"m\": {\"file\": \"-\"}},", 2, 26, "meshes.m.file: \"-\" would be standard input"},
    {"\"meshes\": {\"m\": {\"generate\": \"teacup\"}},", 2, 30, "meshes.m.generate: expected a kind"},
    {"\"meshes\": {\"m\": {\"generate\": \"cube\", \"resolution\": 4}},", 2, 52, "\"cube\" has no resolution"},
    {"\"meshes\": {\"m\": {\"generate\": \"torus\", \"resolution\": 1}},", 2, 53, "expected a whole number from"},
    {"\"objects\": [5],", 2, 13, "objects[0]: expected an object, got 5"},
    {"\"objects\": [{\"kind\": \"cone\"}],", 2, 22,
     "objects[0].kind: expected \"plane\", \"sphere\", \"triangle\", \"mesh\" or \"instances\", got \"cone\""},
    {"\"objects\": [{\"kind\": \"sphere\", \"center\": [0, 0, 0], \"radius\": 0}],", 2, 63,
     "objects[0].radius: expected a number greater than 0, got 0"},
    {"\"objects\": [{\"kind\": \"plane\", \"material\": \"gold\"}],", 2, 43,
     "objects[0].material: the scene has no material \"gold\""},
    {"\"objects\": [{\"kind\": \"mesh\", \"mesh\": \"m\"}],", 2, 38, "objects[0].mesh: the scene has no mesh \"m\""},
    {"\"objects\": [{\"kind\": \"triangle\", \"corners\": [[0, 0, 0], [1, 0, 0]]}],", 2, 45,
     "objects[0].corners: expected three points"},
    {"\"objects\": [{\"kind\": \"triangle\", \"corners\": [[0, 0, 0], [1, 0, 0], [1, 1]]}],", 2, 68,
     "objects[0].corners[2]: expected three numbers"},
    {"\"meshes\": {\"m\": {\"generate\": \"cube\"}}, \"objects\": [{\"kind\": \"mesh\", \"mesh\": \"m\", "
     "\"transform\": "
     "{\"scale\": [1, 0, 1]}}],",
     2, 105, "objects[0].transform.scale: a scale of 0 leaves nothing"},
    {"\"meshes\": {\"m\": {\"generate\": \"cube\"}}, \"objects\": [{\"kind\": \"mesh\", \"mesh\": \"m\", "
     "\"transform\": "
     "[1, 2, 3, 0, 2, 4, 6, 0, 0, 0, 1, 0]}],",
     2, 95, "objects[0].transform: the transform cannot be undone"},
};

static const char *scene_of(const char *text, char *room, size_t size)
{
    if (*text == '!') {
        return text + 1;
    }
    bool has_objects = strstr(text, "\"objects\"") != NULL;
    snprintf(room, size, "{\n%s\n%s" CAMERA "}", text, has_objects ? "" : "\"objects\": [], ");
    return room;
}

static void wrong_scenes_are_told_why_and_where(void **state)
{
    (void)state;
    int failures = 0;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char room[2000];
        const char *text = scene_of(wrong[i].text, room, sizeof room);
        mt_context *context = test_context();
        mt_scene_file *file = NULL;
        mt_status status = mt_scene_read_memory(context, "wrong.json", text, strlen(text), &file);
        const mt_error *error = mt_context_error(context);
        bool placed = (int)error->place.line == wrong[i].line &&
                      (wrong[i].column == 0 || (int)error->place.column == wrong[i].column);
        if (status == MT_OK || file || !strstr(error->message, wrong[i].message) || !placed) {
            print_message("%s\n  expected %d:%d %s\n", error->message, wrong[i].line, wrong[i].column,
                          wrong[i].message);
            failures++;
        }
        mt_scene_file_destroy(context, file);
        test_context_end(context);
    }
    assert_int_equal(failures, 0);
}

static const char whole[] =
    "{\"image\": {\"width\": 32, \"height\": 16, \"samples\": \"adaptive\", \"depth\": 3, \"cutoff\": 0},\n" CAMERA
    ", \"background\": {\"color\": 0.5, \"top\": \"#ffffff\"}, \"ambient\": [0.1, 0.2, 0.3],\n"
    "\"lights\": [{\"kind\": \"point\", \"position\": [1, 2, 3], \"intensity\": 2, \"color\": [1, 0.5, 0], \"fade\": "
    "4, "
    "\"shadows\": false}, {\"kind\": \"directional\", \"direction\": [0, -2, 0]}],\n"
    "\"materials\": {\"b\": {\"mirror\": 0.5}, \"a\": {\"transparency\": 1, \"exponent\": 7.5}},\n"
    "\"meshes\": {\"t\": {\"generate\": \"torus\", \"resolution\": 8, \"shading\": \"smooth\", \"colors\": false}},\n"
    "\"objects\": [{\"kind\": \"plane\", \"normal\": [0, 2, 0], \"material\": \"a\"}, {\"kind\": \"sphere\", "
    "\"center\": "
    "[1, 2, 3], \"radius\": 4}, {\"kind\": \"triangle\", \"corners\": [[0, 0, 0], [1, 0, 0], [0, 1, 0]]},\n"
    "{\"kind\": \"mesh\", \"mesh\": \"t\", \"transform\": {\"scale\": 2, \"rotate\": [0, 0, 1, 90], \"translate\": [5, "
    "6, 7]}}, {\"kind\": \"instances\", \"mesh\": \"t\", \"material\": \"b\", \"transforms\": [[1, 0, 0, 1, 0, 1, 0, "
    "2, "
    "0, 0, 1, 3], {}]}]}";

static void everything_is_read(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_scene_file *file = NULL;
    if (mt_scene_read_memory(context, "whole.json", whole, strlen(whole), &file) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    const mt_scene *s = mt_scene_file_scene(file);
    assert_true(s->width == 32 && s->height == 16 && s->samples == MT_SAMPLES_ADAPTIVE && s->depth_limit == 3);
    assert_true(s->cutoff < 0 && s->camera.eye.z == 5 && s->ambient.y == 0.2);
    assert_true(s->background.kind == MT_SCENE_GRADIENT && s->background.color.x == 0.5 && s->background.top.z == 1);
    assert_int_equal(s->light_count, 2);
    assert_true(s->lights[0].kind == MT_LIGHT_POINT && s->lights[0].color.y == 1 && s->lights[0].fade == 4);
    assert_true(!s->lights[0].casts_shadows && s->lights[1].casts_shadows && s->lights[1].place.y == 2);
    assert_int_equal(s->material_count, 3);
    assert_true(s->materials[0].mirror.z == 0.5 && s->materials[1].exponent == 7.5);
    assert_int_equal(s->mesh_count, 1);
    assert_true(s->meshes[0].shading == MT_SHADING_SMOOTH && s->meshes[0].uses_material_color);
    assert_int_equal(s->object_count, 6);
    assert_true(s->objects[0].material == 1 && s->objects[1].material == 2 && s->objects[4].material == 0);
    assert_true(s->objects[1].shape.sphere.radius == 4 && s->objects[2].shape.triangle.corners[2].y == 1);
    const mt_transform *t = &s->objects[3].shape.transform;
    assert_true(t->linear[1][0] == 2 && t->linear[0][1] == -2 && t->translation.z == 7);
    assert_true(s->objects[4].shape.transform.translation.y == 2 && s->objects[5].shape.transform.linear[2][2] == 1);
    mt_scene_file_destroy(context, file);
    test_context_end(context);
}

static void every_cut_is_refused(void **state)
{
    (void)state;
    mt_context *context = test_context();
    for (size_t size = 0; size < strlen(whole); size++) {
        char *part = malloc(size + 1); /* of that size, so that a byte too many is noticed */
        assert_non_null(part);
        memcpy(part, whole, size);
        mt_scene_file *file = NULL;
        mt_context_clear_error(context);
        mt_status status = mt_scene_read_memory(context, "cut.json", part, size, &file);
        assert_true(status == MT_ERROR_SYNTAX && !file && mt_context_error(context)->message[0]);
        free(part);
    }
    test_context_end(context);
}

static void missing_memory_is_an_error(void **state)
{
    (void)state;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    int failures = 0;
    for (uint64_t n = 1; status != MT_OK; n++) {
        mt_context_options options = {.failing_allocation = n, .thread_count = 1};
        mt_context *context = mt_context_create(&options);
        mt_scene_file *file = NULL;
        status = mt_scene_read_memory(context, "whole.json", whole, strlen(whole), &file);
        assert_true(status == MT_OK || (status == MT_ERROR_OUT_OF_MEMORY && !file));
        failures += status != MT_OK;
        mt_scene_file_destroy(context, file);
        test_context_end(context);
        assert_true(n < 1000);
    }
    assert_true(failures > 8);
    const mt_context_options small = {.memory_limit = 20000};
    mt_context *context = mt_context_create(&small);
    mt_scene_file *file = NULL;
    assert_int_equal(mt_scene_read_memory(context, "whole.json", whole, strlen(whole), &file), MT_ERROR_OUT_OF_MEMORY);
    test_context_end(context);
}

/* Objects and materials by the thousand: names are found by halving, not one by one. */
static void many_names_take_no_time(void **state)
{
    (void)state;
    const int count = 20000;
    char *text = malloc(200u * (size_t)count), *at = text;
    assert_non_null(text);
    at += sprintf(at, "{" CAMERA ", \"materials\": {");
    for (int i = 0; i < count; i++) {
        at += sprintf(at, "%s\"m%d\": {}", i ? ", " : "", i);
    }
    at += sprintf(at, "}, \"objects\": [");
    for (int i = 0; i < count; i++) {
        at += sprintf(at, "%s{\"kind\": \"plane\", \"material\": \"m%d\"}", i ? ", " : "", count - 1 - i);
    }
    at += sprintf(at, "]}");
    mt_context *context = test_context();
    mt_scene_file *file = NULL;
    assert_int_equal(mt_scene_read_memory(context, "many.json", text, (size_t)(at - text), &file), MT_OK);
    for (int i = 0; i < count; i++) {
        assert_int_equal(mt_scene_file_scene(file)->objects[i].material, count - 1 - i);
    }
    mt_scene_file_destroy(context, file);
    free(text);
    test_context_end(context);
}

/* A mesh beside the scene, and one that is missing, whose own error is told. */
static void meshes_are_beside_the_scene(void **state)
{
    (void)state;
    static const char mesh[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    test_scratch_file("beside.obj", mesh, strlen(mesh));
    const char *names[] = {"beside.obj", "missing.obj"};
    for (int i = 0; i < 2; i++) {
        char text[400];
        snprintf(text, sizeof text, "{" CAMERA ", \"meshes\": {\"m\": {\"file\": \"%s\"}}, \"objects\": []}", names[i]);
        const char *path = test_scratch_file("scene.json", text, strlen(text));
        mt_context *context = test_context();
        mt_scene_file *file = NULL;
        mt_status status = mt_scene_read_file(context, path, &file);
        assert_int_equal(status, i == 0 ? MT_OK : MT_ERROR_IO);
        assert_true(i == 1 || mt_scene_file_scene(file)->meshes[0].mesh->face_count == 1);
        assert_true(i == 0 || strstr(mt_context_error(context)->message, "missing.obj"));
        mt_scene_file_destroy(context, file);
        test_context_end(context);
    }
}

static void the_stored_scenes_are_drawn(void **state)
{
    (void)state;
    static const struct {
        const char *path;
        mt_index lights;
        bool mirrors, glass;
    } rows[] = {{"meshes/scenes/mirror_and_glass.json", 2, true, true},
                {"meshes/scenes/many_lights.json", 10, true, false},
                {"meshes/scenes/cut_away.json", 2, true, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        mt_context *context = test_context();
        mt_scene_file *file = NULL;
        if (mt_scene_read_file(context, rows[i].path, &file) != MT_OK) {
            fail_msg("%s", mt_context_error(context)->message);
        }
        mt_scene *scene = mt_scene_file_scene(file);
        scene->width = 48, scene->height = 32, scene->samples = 1;
        mt_image *image = NULL;
        mt_scene_report report;
        assert_int_equal(scene->light_count, rows[i].lights);
        assert_int_equal(mt_scene_render(context, scene, NULL, &image, &report), MT_OK);
        assert_int_equal(report.reflected_rays > 0, rows[i].mirrors);
        assert_int_equal(report.refracted_rays > 0, rows[i].glass);
        assert_true(report.shadow_rays > 0 && report.triangles > 500);
        mt_image_destroy(context, image);
        mt_scene_file_destroy(context, file);
        test_context_end(context);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_scenes_are_told_why_and_where),
        cmocka_unit_test(everything_is_read),
        cmocka_unit_test(every_cut_is_refused),
        cmocka_unit_test(missing_memory_is_an_error),
        cmocka_unit_test(many_names_take_no_time),
        cmocka_unit_test(meshes_are_beside_the_scene),
        cmocka_unit_test(the_stored_scenes_are_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
