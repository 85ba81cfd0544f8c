/* meshtool render: a scene from a file, ray traced. */
#include "files.h"
#include "help.h"
#include "message.h"
#include "picture.h"
#include "quantity.h"

#include <meshtool/scene_format.h>

#include <string.h>

/* Place of a structure's name among the choices of --accel; 0: auto. */
typedef struct render_settings {
    cli_common common;
    cli_picture_size size;
    unsigned samples, method, structure, test;
} render_settings;

/* In the order of the library's enumerations. */
static const char *const methods[] = {"auto", "raster", "ray", NULL};
static const char *const tests[] = {"watertight", "fast", "exact", NULL};

static bool parse_structure(const cli_option *option, const char *text, void *value)
{
    (void)option;
    unsigned *structure = value;
    *structure = 0;
    if (strcmp(text, "auto") == 0) {
        return true;
    }
    for (unsigned kind = 0; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
        if (strcmp(text, mt_ray_structure_name((mt_ray_structure_kind)kind)) == 0) {
            *structure = kind + 1;
            return true;
        }
    }
    return false;
}

#define SETTING(member) offsetof(render_settings, member)

static const cli_option options[] = {
    {.name = "size",
     .offset = SETTING(size),
     .parse = cli_parse_picture_size,
     .argument = "WxH",
     .expects = "a width and a height in pixels from 1 to 65535, such as 1920x1080",
     .help = "pixels, instead of the scene's"},
    {.name = "samples",
     .offset = SETTING(samples),
     .parse = cli_parse_samples,
     .argument = "N",
     .expects = "a square number from 1 to 64, or adaptive",
     .minimum = 1,
     .maximum = 64,
     .help = "samples a pixel, a square number, or adaptive: 4, and 64 where the picture changes; the scene's"},
    {.name = "method",
     .offset = SETTING(method),
     .parse = cli_parse_choice,
     .argument = "ORDER",
     .expects = "auto, raster or ray",
     .choices = methods,
     .help = "how what is seen is found where nothing is mirrored, refracted or in shadow: raster, or a ray for each "
             "sample; the same picture; auto: raster"},
    {.name = "accel",
     .offset = SETTING(structure),
     .parse = parse_structure,
     .argument = "KIND",
     .expects = "auto, none, aabb, obb, grid or bsp",
     .help = "what rays search in each mesh: none, aabb, obb, grid or bsp; auto: a tree of boxes for more than 64 "
             "triangles"},
    {.name = "triangle-test",
     .offset = SETTING(test),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "watertight, fast or exact",
     .choices = tests,
     .help = "how a ray hits: watertight; fast: rays slip through at edges; exact: in doubles"},
    {0},
};

static void print_schema(FILE *out)
{
    mt_scene_key key;
    const char *section = NULL;
    fputs("The scene is JSON; colours are linear light, or \"#rrggbb\" in sRGB. Keys, * those that are needed:\n", out);
    for (size_t i = 0; mt_scene_key_at(i, &key); i++) {
        if (!section || strcmp(section, key.section) != 0) {
            section = key.section;
            fprintf(out, "  %s:\n", *section ? section : "the scene");
        }
        int column = fprintf(out, "    %s%s", key.key, key.is_required ? "*" : "");
        column += fprintf(out, "%*s", column < 28 ? 28 - column : 1, "");
        char text[400];
        snprintf(text, sizeof text, "%s; %s", key.expects, key.means);
        cli_print_wrapped(out, text, column, 28);
    }
}

static json_t *rays_json(const mt_scene_report *report)
{
    json_t *rays = cli_json_object();
    cli_json_set(rays, "primary", cli_json_integer((int64_t)report->primary_rays));
    cli_json_set(rays, "shadow", cli_json_integer((int64_t)report->shadow_rays));
    cli_json_set(rays, "reflected", cli_json_integer((int64_t)report->reflected_rays));
    cli_json_set(rays, "refracted", cli_json_integer((int64_t)report->refracted_rays));
    return rays;
}

static void print_json(const cli_job *job, const mt_scene *scene, const mt_image *image, const mt_scene_report *report)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(job->operands[0]));
    cli_json_set(object, "output", cli_json_text(job->common->output));
    cli_json_set(object, "width", cli_json_integer(image->width));
    cli_json_set(object, "height", cli_json_integer(image->height));
    cli_json_set(object, "objects", cli_json_integer(scene->object_count));
    cli_json_set(object, "meshes", cli_json_integer(scene->mesh_count));
    cli_json_set(object, "triangles", cli_json_integer((int64_t)report->triangles));
    cli_json_set(object, "lights", cli_json_integer(scene->light_count));
    cli_json_set(object, "rays", rays_json(report));
    cli_json_print_line(object);
    json_decref(object);
}

static void apply(const render_settings *settings, mt_scene *scene)
{
    if (settings->size.width > 0) {
        scene->width = settings->size.width;
        scene->height = settings->size.height;
    }
    if (settings->samples > 0) {
        scene->samples = settings->samples;
    }
}

static cli_exit draw(const cli_job *job, mt_scene *scene, const mt_image_format *written)
{
    const render_settings *settings = job->settings;
    const mt_scene_options how = {
        .method = (mt_visibility_method)settings->method,
        .has_structure = settings->structure > 0,
        .structure = settings->structure > 0 ? (mt_ray_structure_kind)(settings->structure - 1) : MT_RAY_STRUCTURE_AABB,
        .triangle_test = (mt_ray_profile)settings->test,
        .measure_skipped = settings->common.measure,
    };
    mt_scene_report report;
    mt_image *image = NULL;
    apply(settings, scene);
    if (scene->background.kind == MT_SCENE_TRANSPARENT && !written->holds_alpha) {
        return cli_wrong_usage(job->command,
                               "the scene's background is transparent, which %s pictures cannot be; write "
                               "a png",
                               written->name);
    }
    if (mt_scene_render(job->context, scene, &how, &image, &report) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = cli_write_image(job, image, job->common->output);
    if (code == CLI_EXIT_DONE && job->common->json) {
        print_json(job, scene, image, &report);
    } else if (code == CLI_EXIT_DONE) {
        cli_say(job, "%s, %s", cli_counted(scene->object_count, "object").text,
                cli_counted(report.triangles, "triangle").text);
    }
    mt_image_destroy(job->context, image);
    return code;
}

static cli_exit run(const cli_job *job)
{
    const mt_image_format *written = NULL;
    mt_scene_file *file = NULL;
    cli_exit code = cli_check_image_output(job, job->common->output, &written);
    if (code != CLI_EXIT_DONE) {
        return code;
    }
    int part = mt_part_begin(job->context, "input", "the scene and its files");
    mt_status status = mt_scene_read_file(job->context, job->operands[0], &file);
    mt_part_end(job->context, part);
    if (status != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    code = draw(job, mt_scene_file_scene(file), written);
    mt_scene_file_destroy(job->context, file);
    return code;
}

const cli_command cli_render_command = {
    .name = "render",
    .usage = "SCENE.json -o IMAGE",
    .summary = "Ray trace a scene: mirrors, glass, shadows, many lights",
    .description =
        "Planes, spheres, triangles and meshes with materials, lights and a camera. Only what the scene requires is "
        "built: --explain says what, and what was left out. Meshes are named relative to the scene's folder.",
    .examples = "  meshtool render meshes/scenes/mirror_and_glass.json -o picture.png\n"
                "  meshtool render scene.json -o small.png --size 320x240 --samples 4 --explain\n",
    .options = options,
    .groups = CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(render_settings),
    .operand_minimum = 1,
    .operand_maximum = 1,
    .print_help = print_schema,
    .run = run,
};
