/* How many digits of a coordinate go into a text file. What is left of it is read back by the C library. */
#include "tradeoff/tradeoff.h"

#include <meshtool/mesh_format.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const levels[] = {"shortest", "12", "9", "6", NULL};
static const unsigned digits[] = {0, 12, 9, 6};

typedef struct digit_state {
    const mt_mesh *mesh;
    double diagonal;
    void *bytes;
    size_t size;
} digit_state;

static mt_status prepare(const tradeoff_subject *subject, void **state, const char **why)
{
    mt_context *context = subject->job->context;
    if (subject->mesh->vertex_count == 0) {
        *why = "the mesh has no coordinates";
        return MT_OK;
    }
    digit_state *s = mt_allocate_zeroed(context, sizeof *s);
    *state = s;
    if (!s) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->mesh = subject->mesh;
    s->diagonal = subject->diagonal;
    return MT_OK;
}

static void release(void *state, mt_context *context)
{
    mt_free(context, state);
}

static mt_status run(void *state, size_t level, mt_context *context)
{
    digit_state *s = state;
    mt_mesh_write_options options = {.format = "obj", .digits = digits[level]};
    return mt_mesh_write_memory(context, s->mesh, &options, &s->bytes, &s->size);
}

static void discard(void *state, mt_context *context)
{
    digit_state *s = state;
    mt_free(context, s->bytes);
    s->bytes = NULL;
}

/* The farthest that a vertex was moved; the text ends in a zero byte. */
static double largest_displacement(const mt_mesh *mesh, const char *text)
{
    double largest = 0;
    mt_index vertex = 0;
    for (const char *line = text; line && vertex < mesh->vertex_count; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strncmp(line, "v ", 2) != 0) {
            continue;
        }
        char *at = (char *)line + 2;
        double x = strtod(at, &at), y = strtod(at, &at), z = strtod(at, &at);
        mt_vec3 p = mt_mesh_position(mesh, vertex++);
        if (mt_vec3_is_finite(p)) {
            largest = fmax(largest, mt_vec3_length(mt_vec3_subtract(mt_vec3_make(x, y, z), p)));
        }
    }
    return vertex == mesh->vertex_count ? largest : (double)NAN;
}

static mt_status judge(void *state, size_t level, mt_context *context, tradeoff_row *row)
{
    const digit_state *s = state;
    char *text = mt_allocate(context, s->size + 1);
    if (!text) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memcpy(text, s->bytes, s->size);
    text[s->size] = '\0';
    double largest = largest_displacement(s->mesh, text), share = s->diagonal > 0 ? largest / s->diagonal : largest;
    mt_free(context, text);
    tradeoff_add_size(row, "bytes", (double)s->size);
    tradeoff_add_error(row, "displacement", share);
    row->is_defect = digits[level] == 0 && largest > 0 && s->mesh->position_type == MT_F64;
    if (largest > 0) {
        snprintf(row->says, sizeof row->says, "vertices move by up to %.2g of the diagonal", share);
    } else {
        snprintf(row->says, sizeof row->says, "nothing: every coordinate reads back the same");
    }
    return MT_OK;
}

const tradeoff_knob tradeoff_digits = {
    .name = "digits",
    .question = "How many digits of a coordinate go into text?",
    .oracle = "the C library's strtod",
    .axis = "displacement",
    .levels = levels,
    .prepare = prepare,
    .run = run,
    .discard = discard,
    .judge = judge,
    .release = release,
};
