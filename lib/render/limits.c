/* What a preview cannot be asked for. */
#include "lib/render/series.h"

#include <math.h>

static mt_status check_samples(mt_context *context, unsigned samples)
{
    for (unsigned n = 1; n * n <= MT_MAXIMUM_SAMPLES; n++) {
        if (n * n == samples) {
            return MT_OK;
        }
    }
    return mt_fail(context, MT_ERROR_ARGUMENT, "samples a pixel are a square number from 1 to %d, not %u",
                   MT_MAXIMUM_SAMPLES, samples);
}

static bool is_direction(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]) && (v[0] != 0 || v[1] != 0 || v[2] != 0);
}

static mt_status check_view(mt_context *context, const mt_preview_options *options)
{
    static const double zero[3] = {0, 0, 0};
    if (!(options->fov_degrees >= 0 && options->fov_degrees < 180)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the field of view lies between 0 and 180 degrees, not at %g",
                       options->fov_degrees);
    }
    if (options->has_up && !is_direction(options->up)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the up direction is not zero and finite");
    }
    const double *eye = options->has_eye ? options->eye : zero, *target = options->has_target ? options->target : zero;
    for (int axis = 0; axis < 3; axis++) {
        if (!isfinite(eye[axis]) || !isfinite(target[axis])) {
            return mt_fail(context, MT_ERROR_ARGUMENT, "the eye and the target have finite coordinates");
        }
    }
    return MT_OK;
}

mt_status mt_preview_check(mt_context *context, const mt_mesh *mesh, const mt_preview_options *options)
{
    uint32_t largest = options->width > options->height ? options->width : options->height;
    if (largest > MT_PREVIEW_MAXIMUM_SIZE) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "a picture has up to %d pixels on a side, not %u",
                       MT_PREVIEW_MAXIMUM_SIZE, largest);
    }
    if (!(options->crease_degrees >= 0 && options->crease_degrees <= 180)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the crease angle lies between 0 and 180 degrees, not at %g",
                       options->crease_degrees);
    }
    for (size_t i = 0; i < 2 * options->edge_mark_count; i++) {
        if (options->edge_marks[i] >= mesh->vertex_count) {
            return mt_fail(context, MT_ERROR_ARGUMENT, "a marked edge names vertex %u of a mesh of %u vertices",
                           options->edge_marks[i], mesh->vertex_count);
        }
    }
    mt_status status = check_view(context, options);
    bool counted = options->samples != 0 && options->samples != MT_SAMPLES_ADAPTIVE;
    return status == MT_OK && counted ? check_samples(context, options->samples) : status;
}
