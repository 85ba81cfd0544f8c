/* POV-Ray draws the same simple scene: a mirror, two dull balls, a checked floor, a point light with shadows. Its
 * "specular" is Blinn's half vector with the exponent 1 / roughness. Skipped where it is not installed. */
#include "tests/support/scene.h"
#include "tests/support/scratch.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 320, HEIGHT = 240 };

/* Left-handed: z is turned. `angle` is across the width: that of 40 degrees across the height. */
static const char pov_scene[] =
    "#version 3.7;\nglobal_settings { assumed_gamma 1 ambient_light rgb 1 max_trace_level 9 }\n"
    "camera { location <0.5, 1.5, -5> look_at <0, 0, 0> right x*4/3 angle 51.77578 }\n"
    "background { rgb <0.2, 0.3, 0.5> }\n"
    "light_source { <-3, 5, -4> rgb 1 }\n"
    "#declare dull = finish { ambient 0.15 diffuse 0.85 specular 0.5 roughness 0.02 }\n"
    "plane { y, -1 pigment { checker rgb <0.25, 0.1, 0.1> rgb <0.9, 0.9, 0.9> scale 0.5 }\n"
    "  finish { ambient 0.15 diffuse 0.85 } }\n"
    "sphere { <-1, 0, 0.5>, 1 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.8 } }\n"
    "sphere { <1.1, -0.3, -0.2>, 0.7 pigment { rgb <0.8, 0.3, 0.2> } finish { dull } }\n"
    "sphere { <0.2, -0.7, -1.4>, 0.3 pigment { rgb <0.2, 0.5, 0.8> } finish { dull } }\n";

static void fill(test_scene *s)
{
    mt_index mirror, floor, red, blue;
    test_scene_init(s, 0);
    s->scene.width = WIDTH, s->scene.height = HEIGHT, s->scene.samples = 16;
    s->scene.camera.eye = mt_vec3_make(0.5, 1.5, 5);
    s->scene.ambient = mt_vec3_make(1, 1, 1);
    s->scene.background.color = mt_vec3_make(0.2, 0.3, 0.5);
    test_scene_light(s, MT_LIGHT_POINT, mt_vec3_make(-3, 5, 4), true);
    mt_material *m = test_scene_material(s, &mirror);
    m->color = mt_vec3_make(0, 0, 0);
    m->mirror = mt_vec3_make(0.8, 0.8, 0.8);
    const mt_vec3 colors[3] = {{0.9, 0.9, 0.9}, {0.8, 0.3, 0.2}, {0.2, 0.5, 0.8}};
    mt_index *numbers[3] = {&floor, &red, &blue};
    for (int i = 0; i < 3; i++) {
        m = test_scene_material(s, numbers[i]);
        m->color = colors[i];
        m->ambient = 0.15;
        m->diffuse = 0.85;
        m->exponent = 50;
        m->specular = i == 0 ? mt_vec3_make(0, 0, 0) : mt_vec3_make(0.5, 0.5, 0.5);
    }
    s->materials[floor].checker_size = 0.5;
    s->materials[floor].checker_color = mt_vec3_make(0.25, 0.1, 0.1);
    test_scene_plane(s, floor, mt_vec3_make(0, -1, 0), mt_vec3_make(0, 1, 0));
    test_scene_sphere(s, mirror, mt_vec3_make(-1, 0, -0.5), 1);
    test_scene_sphere(s, red, mt_vec3_make(1.1, -0.3, 0.2), 0.7);
    test_scene_sphere(s, blue, mt_vec3_make(0.2, -0.7, 1.4), 0.3);
}

static void povray_draws_the_same(void **state)
{
    (void)state;
    if (system("command -v povray >/dev/null 2>&1") != 0) {
        skip();
    }
    char scene[512], picture[512], command[1400];
    snprintf(scene, sizeof scene, "%s", test_scratch_file("scene.pov", pov_scene, strlen(pov_scene)));
    snprintf(picture, sizeof picture, "%s", test_scratch_path("povray.ppm"));
    snprintf(command, sizeof command, "povray +I%s +O%s +W%d +H%d +FP8 -D +A0.0 +AM1 +R4 -J -GA >/dev/null 2>&1", scene,
             picture, WIDTH, HEIGHT);
    assert_int_equal(system(command), 0);
    size_t size = 0;
    unsigned char *bytes = test_read_file(picture, &size);
    assert_non_null(bytes);
    const size_t pixels = 3u * WIDTH * HEIGHT;
    assert_true(size > pixels && memcmp(bytes, "P6", 2) == 0);
    const unsigned char *theirs = bytes + size - pixels;
    mt_context *context = test_context();
    test_scene s;
    fill(&s);
    mt_image *image = test_scene_draw(context, &s, NULL, NULL);
    double squares = 0;
    for (size_t i = 0; i < pixels; i++) {
        double ours = 255 * mt_srgb_encode((double)image->pixels[i]);
        squares += (ours - theirs[i]) * (ours - theirs[i]);
    }
    double psnr = 10 * log10(255.0 * 255.0 * (double)pixels / squares);
    print_message("PSNR against POV-Ray: %.1f dB\n", psnr);
    assert_true(psnr > 30);
    mt_image_destroy(context, image);
    free(bytes);
    remove(picture);
    test_context_end(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(povray_draws_the_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
