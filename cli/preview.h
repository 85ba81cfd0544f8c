/* The parts of preview: its options' values, and the drawing. */
#ifndef MESHTOOL_CLI_PREVIEW_H
#define MESHTOOL_CLI_PREVIEW_H

#include "files.h"
#include "message.h"
#include "picture.h"

#include <meshtool/preview.h>

typedef struct preview_background {
    mt_background kind;
    double color[3];
} preview_background;

typedef struct preview_point {
    bool is_given;
    double at[3];
} preview_point;

/* What --color-by asks for: one of the library's colourings, or what other parts of it find: the defects of the
 * manifold check, or strips. */
typedef struct preview_coloring {
    mt_coloring kind;
    bool defects, strips;
} preview_coloring;

typedef struct preview_settings {
    cli_common common;
    cli_picture_size size;
    preview_background background;
    preview_point up, eye, target;
    preview_coloring coloring;
    double crease, fov;
    unsigned projection;                  /* place among the choices; PREVIEW_NO_PROJECTION: not given */
    unsigned view, shading, method, test; /* places in the library's enumerations; PREVIEW_NO_TEST: not given */
    unsigned samples, turntable;
    mt_acceleration acceleration;
    bool wireframe, shadows, ground, axes, scale_bar, sheet;
} preview_settings;

#define PREVIEW_NO_PROJECTION 99u
#define PREVIEW_NO_TEST 99u

/* For the option table. */
bool preview_parse_coloring(const cli_option *option, const char *text, void *value);
bool preview_parse_acceleration(const cli_option *option, const char *text, void *value);

/* Whether pictures can be told apart by a number in the name of the output. */
bool preview_can_number(const char *path);

/* Draws and writes what the settings ask for. */
cli_exit preview_draw(const cli_job *job, const mt_mesh *mesh, const mt_mesh_format *read);

#endif
