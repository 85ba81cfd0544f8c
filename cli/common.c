#include "common.h"

#include <assert.h>

#define VALUE(field) offsetof(cli_common, field)

static const char *const precision_choices[] = {"auto", "f32", "f64", NULL};
static const char *const progress_choices[] = {"auto", "always", "never", NULL};
static const char *const profile_choices[] = {"balanced", "fast", "exact", NULL}; /* as in profile.h */
static const char *const encoding_choices[] = {"ascii", "binary", "binary-be", NULL};

/* mt_encoding begins with the default, which has no name. */
static bool parse_encoding(const cli_option *option, const char *text, void *value)
{
    bool found = cli_parse_choice(option, text, value);
    *(unsigned *)value += found;
    return found;
}

static const cli_option output_options[] = {
    {.name = "output",
     .letter = 'o',
     .offset = VALUE(output),
     .parse = cli_parse_text,
     .argument = "OUT",
     .expects = "a file's name",
     .help = "write to OUT; - is standard output"},
    {0},
};

static const cli_option write_options[] = {
    {.name = "to",
     .offset = VALUE(to),
     .parse = cli_parse_text,
     .argument = "EXT",
     .expects = "an extension, such as ply",
     .help = "write this format, whatever the extension of OUT"},
    {.name = "no-clobber", .offset = VALUE(no_clobber), .help = "leave an existing OUT alone and fail (exit 4)"},
    {.name = "force", .letter = 'f', .offset = VALUE(force), .help = "overwrite OUT; this is the default"},
    {0},
};

static const cli_option mesh_options[] = {
    {.name = "encoding",
     .offset = VALUE(encoding),
     .parse = parse_encoding,
     .argument = "KIND",
     .expects = "ascii, binary or binary-be",
     .choices = encoding_choices,
     .help = "ascii, binary or binary-be; binary where the format has both"},
    {.name = "strict-loss", .offset = VALUE(strict_loss), .help = "fail rather than lose what the format cannot hold"},
    {0},
};

static const cli_option read_options[] = {
    {.name = "from",
     .offset = VALUE(from),
     .parse = cli_parse_text,
     .argument = "EXT",
     .expects = "an extension, such as obj",
     .help = "read this format, instead of recognising it by content"},
    {0},
};

static const cli_option precision_options[] = {
    {.name = "precision",
     .offset = VALUE(precision),
     .parse = cli_parse_choice,
     .argument = "KIND",
     .expects = "auto, f32 or f64",
     .choices = precision_choices,
     .help = "of positions: auto (what the file holds), f32 or f64"},
    {0},
};

static const cli_option work_options[] = {
    {.name = "threads",
     .offset = VALUE(threads),
     .parse = cli_parse_count,
     .argument = "N",
     .expects = "a whole number from 1 to 1024",
     .minimum = 1,
     .maximum = 1024,
     .help = "threads to use; all CPUs that this process may use"},
    {.name = "max-memory",
     .offset = VALUE(max_memory),
     .parse = cli_parse_size,
     .argument = "SIZE",
     .expects = "a size, such as 512M or 2GiB",
     .help = "fail (exit 5) rather than hold more: 512M, 2GiB"},
    {.name = "progress",
     .offset = VALUE(progress),
     .parse = cli_parse_choice,
     .argument = "WHEN",
     .expects = "auto, always or never",
     .choices = progress_choices,
     .help = "show a bar: auto (work over a second, on a terminal), always or never"},
    {.name = "explain",
     .offset = VALUE(explain),
     .help = "say on standard error what was built or skipped, with its time and bytes; with --json as JSON"},
    {.name = "explain=measure",
     .offset = VALUE(measure),
     .help = "also measure what was skipped, where the command knows how (preview)"},
    {0},
};

static const cli_option every_options[] = {
    {.name = "profile",
     .offset = VALUE(profile),
     .parse = cli_parse_choice,
     .argument = "NAME",
     .expects = "fast, balanced or exact",
     .choices = profile_choices,
     .help = "settings that trade speed for accuracy: fast, balanced (default) or exact; `meshtool help profiles`"},
    {.name = "json", .offset = VALUE(json), .help = "print one JSON object, for scripts"},
    {.name = "quiet", .letter = 'q', .offset = VALUE(quiet), .help = "no warnings, and no text but errors"},
    {.name = "verbose", .letter = 'v', .offset = VALUE(verbose), .help = "say what is read and written"},
    {.name = "help", .letter = 'h', .offset = VALUE(help), .help = "show this"},
    {0},
};

void cli_option_tables(const cli_option *own, unsigned groups, const cli_option *tables[CLI_TABLE_ROOM])
{
    static const struct {
        unsigned group;
        const cli_option *options;
    } known[] = {
        {CLI_GROUP_OUTPUT, output_options}, {CLI_GROUP_WRITE, write_options},         {CLI_GROUP_MESH, mesh_options},
        {CLI_GROUP_READ, read_options},     {CLI_GROUP_PRECISION, precision_options}, {CLI_GROUP_WORK, work_options},
        {CLI_GROUP_EVERY, every_options},
    };
    static_assert(sizeof known / sizeof known[0] == CLI_GROUP_COUNT, "the room for tables follows the groups");
    size_t count = 0;
    if (own) {
        tables[count++] = own;
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (groups & known[i].group) {
            tables[count++] = known[i].options;
        }
    }
    tables[count] = NULL;
}
