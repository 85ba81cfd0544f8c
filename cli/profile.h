/* Profiles: settings that trade speed for accuracy, by one name. An option that is given beats the profile. No profile
 * drops faces, lets rays slip through or decides a predicate by luck; what fast gives up is said. */
#ifndef MESHTOOL_CLI_PROFILE_H
#define MESHTOOL_CLI_PROFILE_H

#include "common.h"

#include <meshtool/mesh_format.h>
#include <meshtool/ray.h>

typedef enum cli_profile_name { CLI_PROFILE_BALANCED, CLI_PROFILE_FAST, CLI_PROFILE_EXACT } cli_profile_name;

typedef struct cli_profile {
    const char *name;
    unsigned samples;             /* a pixel */
    mt_ray_profile triangle_test; /* where a ray meets a triangle */
    mt_precision precision;       /* in which refined positions are stored */
    unsigned digits;              /* of positions in text; 0: the shortest that read back the same */
    double tolerance;             /* of a largest distance, in diagonals */
    unsigned quantization;        /* bits of a coordinate where a format quantises; 0: none are lost */
    bool is_thorough;             /* strips: the shortest that the search finds */
} cli_profile;

/* The profile asked for; balanced by default. */
const cli_profile *cli_profile_of(const cli_common *common);

/* The table: per setting what each profile chooses, and the bound of what it loses. */
void cli_profiles_print(FILE *out);

#endif
