#include "tradeoff/extremes.h"

#include "json.h"
#include "message.h"
#include "progress.h"

#include <meshtool/generate.h>
#include <meshtool/manifold.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ROOM 20

/* Magnitudes from harmless to extreme. */
typedef struct sweep {
    const char *extreme;
    size_t count;
    double magnitudes[ROOM];
} sweep;

static const sweep sweeps[] = {
    {"offset", 14, {0, 1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}},
    {"scale", 14, {1, 1e-5, 1e-10, 1e-15, 1e-20, 1e-30, 1e-36, 1e-50, 1e-100, 1e-150, 1e-200, 1e-250, 1e-290, 1e-300}},
    {"scale", 13, {1, 1e5, 1e10, 1e15, 1e20, 1e30, 1e37, 1e50, 1e100, 1e150, 1e200, 1e250, 1e300}},
    {"sliver", 13, {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12}},
    {"grazing", 9, {1, 1e1, 1e2, 1e3, 1e4, 1e6, 1e8, 1e10, 1e12}},
    {"flat", 9, {1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-15, 0}},
    {"nearly-flat", 9, {1e-1, 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 1e-15, 0}},
    {"walls", 9, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12}},
    {"stadium", 8, {1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e8, 1e10}},
    {"valence", 5, {1e1, 1e2, 1e3, 1e4, 1e5}},
    {"pole", 6, {3, 1e1, 1e2, 1e3, 1e4, 1e5}},
    {"polygon", 5, {1e1, 1e2, 1e3, 1e4, 1e5}},
    {"warped", 6, {0, 1e-3, 1e-1, 1, 1e3, 1e6}},
    {"duplicates", 4, {1e1, 1e2, 1e3, 1e4}},
    {"centroids", 4, {1e1, 1e2, 1e3, 1e4}},
    {"specks", 7, {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8}},
};

#define SWEEP_COUNT (sizeof sweeps / sizeof *sweeps)

typedef enum verdict { HOLDS, BREAKS_BY_INPUT, BREAKS_BY_US } verdict;

typedef struct finding {
    const sweep *over;
    const extreme_operation *operation;
    mt_type precision;
    verdict verdict;
    double magnitude; /* where it breaks, or the last of the sweep */
    double error;     /* there, or the largest of the sweep */
} finding;

/* The mesh in the precision asked for. *is_lost: storing it moved a vertex by a good part of a side, or to infinity or
 * nothing, so that no operation can know the shape that was meant. */
static mt_status make(mt_context *context, const char *name, double magnitude, mt_type precision, mt_mesh **out,
                      bool *is_lost)
{
    char full[64];
    mt_generate_options options = {.magnitude = magnitude, .has_magnitude = true};
    snprintf(full, sizeof full, "extreme:%s", name);
    mt_mesh *intended = NULL;
    *is_lost = false;
    mt_status status = mt_generate(context, full, &options, out);
    if (status == MT_OK && precision == MT_F32) {
        status = mt_mesh_copy(context, *out, &intended);
        status = status == MT_OK ? mt_mesh_set_position_type(context, *out, MT_F32, NULL) : status;
    }
    for (mt_index face = 0; status == MT_OK && intended && face < intended->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(intended, face), end = mt_mesh_face_end(intended, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index a = intended->corner_vertices[corner];
            mt_index b = intended->corner_vertices[corner + 1 < end ? corner + 1 : begin];
            mt_vec3 p = mt_mesh_position(intended, a), stored = mt_mesh_position(*out, a);
            mt_vec3 side = mt_vec3_subtract(mt_mesh_position(intended, b), p), moved = mt_vec3_subtract(stored, p);
            double length = mt_vec3_max_abs(side);
            *is_lost = *is_lost || (length > 0 && !(mt_vec3_max_abs(moved) < 0.25 * length));
        }
    }
    mt_mesh_destroy(context, intended);
    return status;
}

static mt_status is_suitable(mt_context *context, const extreme_operation *operation, const mt_mesh *mesh, bool *out)
{
    mt_manifold_report report;
    *out = !operation->needs_faces || mesh->face_count > 0;
    if (!operation->needs_manifold || !*out) {
        return MT_OK;
    }
    mt_status status = mt_check_manifold(context, mesh, NULL, &report);
    if (status == MT_OK) {
        *out = report.manifold_class != MT_NON_MANIFOLD && report.oriented == MT_YES;
        mt_manifold_report_release(context, &report);
    }
    return status;
}

/* One magnitude: *error is NAN when the operation has nothing to do. */
static mt_status try_magnitude(mt_context *context, const finding *f, double magnitude, double *error, bool *is_lost)
{
    mt_mesh *mesh = NULL;
    bool suitable = false;
    *error = (double)NAN;
    mt_status status = make(context, f->over->extreme, magnitude, f->precision, &mesh, is_lost);
    if (status == MT_OK && !*is_lost) {
        status = is_suitable(context, f->operation, mesh, &suitable);
    }
    if (status == MT_OK && suitable) {
        status = f->operation->error(context, mesh, error);
    }
    mt_mesh_destroy(context, mesh);
    return status;
}

static mt_status run_sweep(mt_context *context, finding *f)
{
    for (size_t i = 0; i < f->over->count; i++) {
        double error;
        bool is_lost;
        mt_status status = try_magnitude(context, f, f->over->magnitudes[i], &error, &is_lost);
        if (status != MT_OK) {
            return status;
        }
        f->magnitude = f->over->magnitudes[i];
        f->error = isnan(error) ? f->error : fmax(f->error, error);
        if (is_lost || error > f->operation->bound) {
            f->verdict = is_lost ? BREAKS_BY_INPUT : BREAKS_BY_US;
            return MT_OK;
        }
    }
    return MT_OK;
}

static const char *why(const finding *f)
{
    switch (f->verdict) {
    case HOLDS:
        return "holds";
    case BREAKS_BY_INPUT:
        return "the input's rounding: single precision cannot hold the shape";
    default:
        return "a defect: the result is wrong for the numbers that are stored";
    }
}

static void print_text(const finding *f)
{
    char error[32];
    snprintf(error, sizeof error, "%.1e of %.0e", f->error, f->operation->bound);
    printf("%-12s %-10s %-4s %-9s %9g  %-20s %s\n", f->over->extreme, f->operation->name,
           f->precision == MT_F32 ? "f32" : "f64", f->verdict == HOLDS ? "holds to" : "breaks at", f->magnitude, error,
           why(f));
}

static json_t *finding_json(const finding *f)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "extreme", cli_json_text(f->over->extreme));
    cli_json_set(object, "operation", cli_json_text(f->operation->name));
    cli_json_set(object, "precision", cli_json_text(f->precision == MT_F32 ? "f32" : "f64"));
    cli_json_set(object, "breaks", f->verdict == HOLDS ? json_false() : json_true());
    cli_json_set(object, "magnitude", cli_json_real(f->magnitude));
    cli_json_set(object, "error", cli_json_real(f->error));
    cli_json_set(object, "bound", cli_json_real(f->operation->bound));
    cli_json_set(object, "why", cli_json_text(why(f)));
    return object;
}

cli_exit tradeoff_extremes(const cli_job *job)
{
    static const mt_type precisions[] = {MT_F64, MT_F32};
    json_t *rows = cli_json_array(), *object = cli_json_object();
    cli_exit code = CLI_EXIT_DONE;
    for (size_t i = 0; code != CLI_EXIT_LIMIT && i < 2 * SWEEP_COUNT; i++) {
        for (size_t k = 0; extreme_operations[k]; k++) {
            finding f = {.over = &sweeps[i / 2], .operation = extreme_operations[k], .precision = precisions[i % 2]};
            if (run_sweep(job->context, &f) != MT_OK) {
                json_decref(rows);
                json_decref(object);
                return cli_report_failure(job, f.over->extreme);
            }
            cli_progress_clear();
            code = f.verdict == BREAKS_BY_US ? CLI_EXIT_DEFECT : code;
            if (job->common->json) {
                cli_json_append(rows, finding_json(&f));
            } else {
                print_text(&f);
            }
        }
    }
    cli_json_set(object, "rows", rows);
    if (job->common->json) {
        cli_json_print_line(object);
    }
    json_decref(object);
    return code;
}
