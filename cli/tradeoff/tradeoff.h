/* The trade between speed and accuracy, measured on the user's own mesh.
 *
 * A knob is a choice that the toolkit leaves to its user; its levels are run in turn, timed, and judged beside an
 * oracle that shares no code with what it judges. One knob a file, one line in the table of knobs.c. */
#ifndef MESHTOOL_CLI_TRADEOFF_H
#define MESHTOOL_CLI_TRADEOFF_H

#include "command.h"

#include <meshtool/mesh.h>

#define TRADEOFF_FIGURE_MAXIMUM 10

/* One number of a row beside its time and memory. */
typedef struct tradeoff_figure {
    const char *name;
    double value;  /* NAN: not known here */
    bool is_error; /* of the result, 0 being right; else a size or a count */
} tradeoff_figure;

typedef struct tradeoff_knob tradeoff_knob;

/* A level of a knob, measured. */
typedef struct tradeoff_row {
    const tradeoff_knob *knob;
    const char *level;
    double seconds, spread; /* the median, and half of what the runs differ by as a share of it; NAN after one run */
    uint64_t peak_bytes;    /* held at most while it ran, beyond the mesh */
    tradeoff_figure figures[TRADEOFF_FIGURE_MAXIMUM];
    size_t figure_count;
    char says[200]; /* what the user loses */
    bool is_defect; /* the error is one that no level may have */
    bool is_front;  /* no other level of the knob is as fast and as exact */
    bool is_knee;   /* of the front, where a further gain costs most */
} tradeoff_row;

/* The mesh at hand. */
typedef struct tradeoff_subject {
    const cli_job *job;
    const char *name;
    const mt_mesh *mesh;
    double diagonal; /* of the box around its finite vertices */
    double reach;    /* the largest of their coordinates, without its sign */
} tradeoff_subject;

struct tradeoff_knob {
    const char *name;
    const char *question;      /* what is chosen, as a person would ask */
    const char *oracle;        /* beside what the errors are found */
    const char *axis;          /* the figure that stands for the error in the plot */
    const char *const *levels; /* NULL-terminated */
    /* Makes what the levels share, with the job's context. When the knob has no meaning on this mesh, *why receives a
     * sentence that says so. *state is released in every case, if it is not NULL. */
    mt_status (*prepare)(const tradeoff_subject *subject, void **state, const char **why);
    /* Why a level is left out on this mesh, NULL: it is not. May itself be NULL: no level is. */
    const char *(*refuse)(const void *state, size_t level);
    /* What is timed. Its result stays in the state until `discard`, which may be NULL. */
    mt_status (*run)(void *state, size_t level, mt_context *context);
    void (*discard)(void *state, mt_context *context);
    /* Fills the figures and `says` of a level that has just run. Deterministic. */
    mt_status (*judge)(void *state, size_t level, mt_context *context, tradeoff_row *row);
    void (*release)(void *state, mt_context *context);
};

/* The table, NULL-terminated. */
extern const tradeoff_knob *const tradeoff_knobs[];

/* Adds a figure to a row. */
void tradeoff_add_error(tradeoff_row *row, const char *name, double value);
void tradeoff_add_size(tradeoff_row *row, const char *name, double value);
/* The figure of that name, NAN when the row has none. */
double tradeoff_figure_of(const tradeoff_row *row, const char *name);

/* A knob, or a level of one, that was left out, and why. */
typedef struct tradeoff_skip {
    const tradeoff_knob *knob;
    const char *level; /* NULL: all of them */
    const char *why;
} tradeoff_skip;

#define TRADEOFF_KNOB_MAXIMUM 16
#define TRADEOFF_KNOB_LEVEL_MAXIMUM 16
#define TRADEOFF_ROW_MAXIMUM 96

typedef struct tradeoff_table {
    tradeoff_row rows[TRADEOFF_ROW_MAXIMUM];
    size_t row_count;
    tradeoff_skip skips[TRADEOFF_ROW_MAXIMUM];
    size_t skip_count;
    double reference_seconds; /* of a fixed sum, so that times of two machines can be compared */
} tradeoff_table;

/* Measures one knob for about so many seconds, its oracle included; adds its rows and its skips. A level whose first
 * run takes too much of them and can be stopped is left out; with 0 seconds every level runs once. */
mt_status tradeoff_measure(const tradeoff_subject *subject, const tradeoff_knob *knob, double seconds,
                           tradeoff_table *table);
/* Seconds of a clock that never goes back. */
double tradeoff_now(void);
/* The reference kernel's median time. */
double tradeoff_reference(void);

void tradeoff_print_text(const tradeoff_subject *subject, const tradeoff_table *table);
void tradeoff_print_json(const tradeoff_subject *subject, const tradeoff_table *table);

/* Draws time against error, a panel for each knob, as SVG or into a picture, by the path's extension. */
cli_exit tradeoff_check_plot(const cli_job *job, const char *path);
cli_exit tradeoff_plot(const cli_job *job, const tradeoff_subject *subject, const tradeoff_table *table,
                       const char *path);

#endif
