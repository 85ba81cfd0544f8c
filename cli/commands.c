/* The table of commands: help, suggestions and dispatch loop over it. */
#include "command.h"

#include "nearest.h"

#include <string.h>
#include <unistd.h>

const cli_command *const cli_commands[] = {
    &cli_check_manifold_command,
    &cli_repair_command,
    &cli_info_command,
    &cli_topology_command,
    &cli_preview_command,
    &cli_render_command,
    &cli_subdivide_command,
    &cli_normals_command,
    &cli_strips_command,
    &cli_distance_command,
    &cli_convert_command,
    &cli_image_command,
    &cli_generate_command,
    &cli_tradeoff_command,
    &cli_formats_command,
    &cli_help_command,
    NULL,
};

const cli_command *cli_find_command(const char *name)
{
    for (size_t i = 0; cli_commands[i]; i++) {
        if (strcmp(cli_commands[i]->name, name) == 0) {
            return cli_commands[i];
        }
    }
    return NULL;
}

cli_exit cli_unknown_command(const char *name)
{
    const char *names[sizeof cli_commands / sizeof cli_commands[0]];
    size_t count = 0;
    while (cli_commands[count]) {
        names[count] = cli_commands[count]->name;
        count++;
    }
    const char *nearest = cli_nearest(name, names, count);
    fprintf(stderr, "meshtool: unknown command \"%s\"", name);
    if (nearest) {
        fprintf(stderr, "; did you mean %s?", nearest);
    } else if (access(name, F_OK) == 0) {
        fprintf(stderr, "; it is a file, and the command comes first: meshtool info %s", name);
    }
    fputs("\nThe commands are", stderr);
    for (size_t i = 0; i < count; i++) {
        fprintf(stderr, "%s %s", i == 0 ? "" : i + 1 < count ? "," : " and", names[i]);
    }
    fputs(".\n", stderr);
    return CLI_EXIT_USAGE;
}
