/* meshtool formats: what is read and written, and what each can hold; a loop over the format tables. */
#include "files.h"
#include "help.h"
#include "line.h"

typedef struct formats_settings {
    cli_common common;
} formats_settings;

static const struct {
    unsigned ability;
    const char *name;  /* in JSON */
    const char *words; /* for people */
} abilities[] = {
    {MT_HOLDS_POLYGONS, "polygons", "polygons"},
    {MT_HOLDS_INDICES, "indices", "shared vertices"},
    {MT_HOLDS_WIRES, "wires", "wires"},
    {MT_HOLDS_POINTS, "points", "points"},
    {MT_HOLDS_VERTEX_NORMALS, "vertex_normals", "normals per vertex"},
    {MT_HOLDS_CORNER_NORMALS, "corner_normals", "normals per corner"},
    {MT_HOLDS_FACE_NORMALS, "face_normals", "normals per face"},
    {MT_HOLDS_VERTEX_UVS, "vertex_uvs", "texture coordinates per vertex"},
    {MT_HOLDS_CORNER_UVS, "corner_uvs", "texture coordinates per corner"},
    {MT_HOLDS_VERTEX_COLORS, "vertex_colors", "colours per vertex"},
    {MT_HOLDS_FACE_COLORS, "face_colors", "colours per face"},
    {MT_HOLDS_GENERIC, "generic", "any other values by name"},
    {MT_HOLDS_GROUPS, "groups", "groups and materials"},
    {MT_HOLDS_SOLIDS, "solids", "solids"},
    {MT_HOLDS_CREASES, "creases", "creases"},
    {MT_HOLDS_F64, "f64", "double precision"},
    {MT_HOLDS_ALPHA, "alpha", "transparent colours"},
    {MT_HOLDS_UV_DEPTH, "uv_depth", "texture coordinates of three numbers"},
    {MT_HOLDS_PARTS, "parts", "parts and materials by name"},
    {MT_SPLITS_VERTICES, "split_corners", "values per corner (by splitting vertices)"},
    {MT_HOLDS_LIBRARIES, "libraries", "names of material libraries"},
};

#define ABILITY_COUNT (sizeof abilities / sizeof abilities[0])

static json_t *texts_json(const char *const *texts)
{
    json_t *array = cli_json_array();
    for (; *texts; texts++) {
        cli_json_append(array, cli_json_text(*texts));
    }
    return array;
}

static json_t *encodings_json(const mt_mesh_format *format)
{
    json_t *array = cli_json_array();
    if (format->has_ascii) {
        cli_json_append(array, cli_json_text("ascii"));
    }
    if (format->has_binary) {
        cli_json_append(array, cli_json_text("binary"));
    }
    if (format->has_binary_big) {
        cli_json_append(array, cli_json_text("binary-be"));
    }
    return array;
}

static json_t *mesh_format_json(const mt_mesh_format *format)
{
    json_t *object = cli_json_object(), *holds = cli_json_array();
    for (size_t i = 0; i < ABILITY_COUNT; i++) {
        if (format->abilities & abilities[i].ability) {
            cli_json_append(holds, cli_json_text(abilities[i].name));
        }
    }
    cli_json_set(object, "name", cli_json_text(format->name));
    cli_json_set(object, "title", cli_json_text(format->title));
    cli_json_set(object, "extensions", texts_json(format->extensions));
    cli_json_set(object, "read", json_boolean(format->read != NULL));
    cli_json_set(object, "write", json_boolean(format->write != NULL));
    cli_json_set(object, "encodings", encodings_json(format));
    cli_json_set(object, "holds", holds);
    return object;
}

static json_t *image_format_json(const mt_image_format *format)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "name", cli_json_text(format->name));
    cli_json_set(object, "title", cli_json_text(format->title));
    cli_json_set(object, "extensions", texts_json(format->extensions));
    cli_json_set(object, "read", json_boolean(format->read != NULL));
    cli_json_set(object, "write", json_boolean(format->write != NULL));
    cli_json_set(object, "alpha", json_boolean(format->holds_alpha));
    return object;
}

static cli_exit print_json(void)
{
    json_t *object = cli_json_object(), *meshes = cli_json_array(), *images = cli_json_array();
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        cli_json_append(meshes, mesh_format_json(*format));
    }
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        cli_json_append(images, image_format_json(*format));
    }
    cli_json_set(object, "meshes", meshes);
    cli_json_set(object, "images", images);
    cli_json_print_line(object);
    json_decref(object);
    return CLI_EXIT_DONE;
}

static void print_extensions(const char *const *extensions)
{
    int column = 0;
    for (; *extensions; extensions++) {
        column += printf(".%s ", *extensions);
    }
    printf("%*s", column < 12 ? 12 - column : 0, "");
}

static void print_mesh_format(const mt_mesh_format *format)
{
    cli_line holds = {0};
    for (size_t i = 0; i < ABILITY_COUNT; i++) {
        if (format->abilities & abilities[i].ability) {
            cli_line_add(&holds, "%s%s", holds.length ? ", " : "", abilities[i].words);
        }
    }
    print_extensions(format->extensions);
    printf("%s\n    %s", format->title, format->read ? "read" : "not read");
    if (format->write) {
        printf("; written as %s%s%s", format->has_ascii ? "text" : "",
               format->has_ascii && format->has_binary ? " or " : "",
               !format->has_binary      ? ""
               : format->has_binary_big ? "binary of either byte order"
                                        : "binary");
    }
    printf("\n    holds ");
    cli_print_wrapped(stdout, holds.text, 10, 10);
}

static cli_exit run(const cli_job *job)
{
    if (job->common->json) {
        return print_json();
    }
    puts("Meshes:");
    for (const mt_mesh_format *const *format = mt_mesh_formats(); *format; format++) {
        print_mesh_format(*format);
    }
    puts("\nPictures:");
    for (const mt_image_format *const *format = mt_image_formats(); *format; format++) {
        print_extensions((*format)->extensions);
        printf("%s\n    %s; written%s\n", (*format)->title, (*format)->read ? "read" : "not read",
               (*format)->holds_alpha ? ", transparent or not" : "");
    }
    return CLI_EXIT_DONE;
}

const cli_command cli_formats_command = {
    .name = "formats",
    .usage = "",
    .summary = "List the file formats, and what each can hold",
    .description =
        "Files are recognised by content first, then by extension. Writing what a format cannot hold is said "
        "as a warning, or refused with --strict-loss.",
    .examples = "  meshtool formats --json\n",
    .groups = CLI_GROUP_EVERY,
    .settings_size = sizeof(formats_settings),
    .run = run,
};
