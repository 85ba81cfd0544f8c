/* meshtool preview: a picture of any mesh. */
#include "preview.h"

#include <string.h>

static bool parse_background(const cli_option *option, const char *text, void *value)
{
    (void)option;
    preview_background *background = value;
    if (strcmp(text, "transparent") == 0) {
        background->kind = MT_BACKGROUND_TRANSPARENT;
        return true;
    }
    background->kind = MT_BACKGROUND_COLOR;
    if (!cli_scan_numbers(text, 3, background->color)) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        background->color[i] /= 255;
        if (background->color[i] < 0 || background->color[i] > 1) {
            return false;
        }
    }
    return true;
}

static bool parse_point(const cli_option *option, const char *text, void *value)
{
    (void)option;
    preview_point *point = value;
    point->is_given = true;
    return cli_scan_numbers(text, 3, point->at);
}

static bool parse_up(const cli_option *option, const char *text, void *value)
{
    static const preview_point y = {true, {0, 1, 0}}, z = {true, {0, 0, 1}};
    preview_point *up = value;
    if (strcmp(text, "y") == 0 || strcmp(text, "z") == 0) {
        *up = *text == 'y' ? y : z;
        return true;
    }
    return parse_point(option, text, value) && (up->at[0] != 0 || up->at[1] != 0 || up->at[2] != 0);
}

/* In the order of the library's enumerations. */
static const char *const projections[] = {"perspective", "orthographic", "cabinet", "cavalier", "oblique", NULL};
static const char *const views[] = {"auto", "front", "back", "left", "right", "top", "bottom", "iso", NULL};
static const char *const shadings[] = {"crease", "flat", "smooth", NULL};
static const char *const methods[] = {"auto", "raster", "ray", NULL};
static const char *const tests[] = {"watertight", "fast", "exact", NULL};

#define SETTING(member) offsetof(preview_settings, member)

static const cli_option options[] = {
    {.name = "size",
     .offset = SETTING(size),
     .parse = cli_parse_picture_size,
     .argument = "WxH",
     .expects = "a width and a height in pixels from 1 to 65535, such as 1920x1080",
     .help = "pixels; 1024x1024"},
    {.name = "projection",
     .offset = SETTING(projection),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "perspective, orthographic, oblique, cabinet or cavalier",
     .choices = projections,
     .help = "perspective, orthographic, or oblique: cabinet (the same) or cavalier; perspective, but orthographic "
             "with --sheet"},
    {.name = "view",
     .offset = SETTING(view),
     .parse = cli_parse_choice,
     .argument = "SIDE",
     .expects = "front, back, left, right, top, bottom, iso or auto",
     .choices = views,
     .help = "front, back, left, right, top, bottom, iso; auto: three quarters from above, or the front if oblique"},
    {.name = "up",
     .offset = SETTING(up),
     .parse = parse_up,
     .argument = "AXIS",
     .expects = "y, z, or a direction x,y,z that is not 0,0,0",
     .help = "y, z, or a direction x,y,z; z for STL, y for the others"},
    {.name = "eye",
     .offset = SETTING(eye),
     .parse = parse_point,
     .argument = "x,y,z",
     .expects = "three numbers, such as 3,2,5",
     .help = "look from this point (a parallel projection: from its direction)"},
    {.name = "target",
     .offset = SETTING(target),
     .parse = parse_point,
     .argument = "x,y,z",
     .expects = "three numbers, such as 0,1,0",
     .help = "the point in the middle of the picture; the mesh's middle"},
    {.name = "fov",
     .offset = SETTING(fov),
     .parse = cli_parse_number,
     .argument = "DEG",
     .expects = "degrees from 0.001 to 179",
     .minimum = 0.001,
     .maximum = 179,
     .help = "angle of the picture's shorter side; 28, or with --eye what shows all"},
    {.name = "samples",
     .offset = SETTING(samples),
     .parse = cli_parse_samples,
     .argument = "N",
     .expects = "a square number from 1 to 64, or adaptive",
     .minimum = 1,
     .maximum = 64,
     .help = "samples a pixel, a square number, or adaptive: 4, and 64 where the face changes with its normal; 16"},
    {.name = "shading",
     .offset = SETTING(shading),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "crease, flat or smooth",
     .choices = shadings,
     .help = "crease: smooth but for sharp edges; flat: each face; smooth: all"},
    {.name = "crease",
     .offset = SETTING(crease),
     .parse = cli_parse_number,
     .argument = "DEG",
     .expects = "degrees from 0.001 to 180",
     .minimum = 0.001,
     .maximum = 180,
     .help = "faces that meet at more than this show an edge; 41, or the normals of the file"},
    {.name = "wireframe", .offset = SETTING(wireframe), .help = "draw the edges of all faces"},
    {.name = "color-by",
     .offset = SETTING(coloring),
     .parse = preview_parse_coloring,
     .argument = "WHAT",
     .expects = "none, normal, face, component, defect, quality, depth, orientation or strip",
     .help = "none, normal, face, component, defect, quality (radius ratio: red is bad, blue good), depth, orientation "
             "(fronts blue, backs red), strip; the mesh's colours"},
    {.name = "background",
     .offset = SETTING(background),
     .parse = parse_background,
     .argument = "COLOUR",
     .expects = "transparent, or three numbers from 0 to 255, such as 255,255,255",
     .help = "R,G,B from 0 to 255, or transparent; a light grey"},
    {.name = "shadows", .offset = SETTING(shadows), .help = "hard shadows of the main light"},
    {.name = "ground", .offset = SETTING(ground), .help = "a floor under the mesh"},
    {.name = "axes", .offset = SETTING(axes), .help = "the directions of x, y and z in a corner"},
    {.name = "scale-bar", .offset = SETTING(scale_bar), .help = "a bar with its length, true at the target"},
    {.name = "method",
     .offset = SETTING(method),
     .parse = cli_parse_choice,
     .argument = "ORDER",
     .expects = "auto, raster or ray",
     .choices = methods,
     .help = "raster: triangle by triangle; ray: sample by sample; the same picture; auto: raster"},
    {.name = "accel",
     .offset = SETTING(acceleration),
     .parse = preview_parse_acceleration,
     .argument = "KIND",
     .expects = "auto, none, aabb, obb, grid or bsp",
     .help =
         "what rays search: none, a tree of boxes (aabb), of turned ones (obb), a grid, a bsp tree; the same picture; "
         "auto: aabb for more than 64 triangles"},
    {.name = "triangle-test",
     .offset = SETTING(test),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "watertight, fast or exact",
     .choices = tests,
     .help = "how a ray hits: watertight; fast: rays slip through at edges; exact: in doubles"},
    {.name = "turntable",
     .offset = SETTING(turntable),
     .parse = cli_parse_count,
     .argument = "N",
     .expects = "a whole number from 2 to 9999",
     .minimum = 2,
     .maximum = 9999,
     .help = "N pictures around the up axis, a number before the dot of each name; with --sheet on one"},
    {.name = "sheet", .offset = SETTING(sheet), .help = "six views on one picture"},
    {0},
};

static const preview_settings defaults = {.projection = PREVIEW_NO_PROJECTION, .test = PREVIEW_NO_TEST};

static cli_exit check_usage(const cli_job *job, const mt_image_format *written)
{
    const preview_settings *settings = job->settings;
    if (settings->background.kind == MT_BACKGROUND_TRANSPARENT && !written->holds_alpha) {
        return cli_wrong_usage(job->command, "%s pictures cannot be transparent; write a png", written->name);
    }
    if (settings->turntable && !settings->sheet && !preview_can_number(settings->common.output)) {
        return cli_wrong_usage(job->command, "--turntable writes several files, and cannot to a device or a pipe; name "
                                             "a file, or add --sheet for one picture");
    }
    return CLI_EXIT_DONE;
}

static cli_exit run(const cli_job *job)
{
    const mt_image_format *written = NULL;
    cli_exit code = cli_check_inputs(job);
    if (code == CLI_EXIT_DONE) {
        code = cli_check_image_output(job, job->common->output, &written);
    }
    if (code == CLI_EXIT_DONE) {
        code = check_usage(job, written);
    }
    const mt_mesh_format *read = NULL;
    mt_mesh *mesh = NULL;
    if (code == CLI_EXIT_DONE) {
        code = cli_read_mesh(job, job->operands[0], &mesh, &read);
    }
    if (code == CLI_EXIT_DONE) {
        code = preview_draw(job, mesh, read);
    }
    mt_mesh_destroy(job->context, mesh);
    return code;
}

const cli_command cli_preview_command = {
    .name = "preview",
    .usage = "IN -o IMAGE",
    .summary = "Draw a picture of a mesh",
    .description =
        "Any mesh, with no further option: framed, lit, smooth where it is smooth, creased where it is creased, "
        "both sides of every face shown, backs bluish. +Z is up for STL, +Y for the others.",
    .examples = "  meshtool preview teapot.obj -o teapot.png\n"
                "  meshtool preview part.stl -o part.png --size 1920x1080 --background transparent\n"
                "  meshtool preview part.stl -o part.png --shadows --ground --wireframe\n"
                "  meshtool preview part.stl -o sides.png --sheet --scale-bar --size 1500x1000\n"
                "  meshtool preview scan.ply -o holes.png --color-by defect\n"
                "  meshtool preview teapot.obj -o turn.png --turntable 36\n",
    .options = options,
    .groups =
        CLI_GROUP_OUTPUT | CLI_GROUP_WRITE | CLI_GROUP_READ | CLI_GROUP_PRECISION | CLI_GROUP_WORK | CLI_GROUP_EVERY,
    .settings_size = sizeof(preview_settings),
    .defaults = &defaults,
    .operand_minimum = 1,
    .operand_maximum = 1,
    .run = run,
};
