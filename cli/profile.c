#include "profile.h"

static const cli_profile profiles[] = {
    [CLI_PROFILE_BALANCED] = {"balanced", 16, MT_RAY_WATERTIGHT, MT_PRECISION_AUTO, 0, 1e-4, 14, false},
    [CLI_PROFILE_FAST] = {"fast", 4, MT_RAY_WATERTIGHT, MT_PRECISION_F32, 9, 1e-3, 11, false},
    [CLI_PROFILE_EXACT] = {"exact", 64, MT_RAY_EXACT, MT_PRECISION_F64, 0, 1e-6, 0, true},
};

/* Each bound is that of the profile beside it; `knob` of `meshtool tradeoff` measures it. */
static const struct {
    const char *commands, *setting, *fast, *balanced, *exact, *knob, *bound;
} rows[] = {
    {"preview, render", "samples a pixel", "4", "16", "64", "samples",
     "0.005, 0.002 and 0.001 of the brightest, root mean square, on spot.obj"},
    {"preview, render", "triangle test", "watertight", "watertight", "exact", "triangle-test",
     "corners are moved by 2^-24 of the extent; exact: not at all. No ray slips through"},
    {"subdivide", "positions stored in", "f32", "as in the file", "f64", "storage",
     "f32: each is rounded by 2^-24 of itself"},
    {"all that write text", "digits of positions", "9", "shortest", "shortest", "digits",
     "9 digits: each is rounded by 5e-9 of itself; shortest: not at all"},
    {"distance", "tolerance, in diagonals", "1e-3", "1e-4", "1e-6", "distance",
     "the true Hausdorff distance is larger by at most this"},
    {"convert --draco", "bits of a coordinate", "11", "14", "as they are", "quantization",
     "a vertex moves by at most 2^-bits of the largest side on each axis"},
    {"strips", "method", "fast", "fast", "thorough", "strips", "every triangle exactly once in all; length differs"},
};

const cli_profile *cli_profile_of(const cli_common *common)
{
    return &profiles[common->profile];
}

void cli_profiles_print(FILE *out)
{
    fprintf(out, "%-20s %-24s %-11s %-15s %-11s %s\n", "commands", "setting", "fast", "balanced", "exact", "bound");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        fprintf(out, "%-20s %-24s %-11s %-15s %-11s %s", rows[i].commands, rows[i].setting, rows[i].fast,
                rows[i].balanced, rows[i].exact, rows[i].bound);
        fprintf(out, rows[i].knob ? " (tradeoff --knob %s)\n" : "\n", rows[i].knob);
    }
}
