#include "formats/codec/draco_job.h"

static bool hold(void *user, uint64_t bytes)
{
    mt_draco_job *job = user;
    if (mt_hold_bytes(job->context, bytes) != MT_OK) {
        return false;
    }
    job->held += bytes;
    return true;
}

static void *allocate(void *user, uint64_t size)
{
    return mt_allocate(((mt_draco_job *)user)->context, size);
}

static mt_status status_of(mt_draco_result result)
{
    static const mt_status statuses[] = {
        [MT_DRACO_OK] = MT_OK,
        [MT_DRACO_WRONG] = MT_ERROR_SYNTAX,
        [MT_DRACO_VERSION] = MT_ERROR_UNSUPPORTED,
        [MT_DRACO_TOO_LARGE] = MT_ERROR_TOO_LARGE,
        [MT_DRACO_REFUSED] = MT_ERROR_OUT_OF_MEMORY,
        [MT_DRACO_NO_MEMORY] = MT_ERROR_OUT_OF_MEMORY,
        [MT_DRACO_MISSING] = MT_ERROR_UNSUPPORTED,
    };
    return statuses[result];
}

mt_status mt_draco_job_decode(mt_context *context, mt_place place, const char *where, const void *bytes, size_t size,
                              mt_draco_job *out)
{
    char message[MT_DRACO_MESSAGE] = "Draco ran out of memory";
    *out = (mt_draco_job){.context = context};
    mt_draco_result result = mt_draco_decode(bytes, size, hold, out, &out->mesh, &out->consumed, message);
    if (result == MT_DRACO_OK || result == MT_DRACO_REFUSED) {
        return status_of(result);
    }
    return mt_fail_at(context, status_of(result), place, "%sthe Draco stream is not read: %s", where, message);
}

void mt_draco_job_close(mt_draco_job *job)
{
    mt_draco_destroy(job->mesh);
    if (job->held > 0) {
        mt_release_bytes(job->context, job->held);
    }
    job->mesh = NULL;
    job->held = 0;
}

mt_status mt_draco_job_encode(mt_context *context, const mt_draco_source *source, mt_draco_bytes *out)
{
    char message[MT_DRACO_MESSAGE] = "Draco ran out of memory";
    mt_draco_job job = {.context = context};
    mt_draco_result result = mt_draco_encode(source, hold, allocate, &job, out, message);
    mt_draco_job_close(&job);
    if (result == MT_DRACO_OK || result == MT_DRACO_REFUSED) {
        return status_of(result);
    }
    mt_status status = result == MT_DRACO_WRONG ? MT_ERROR_UNSUPPORTED : status_of(result);
    return mt_fail(context, status, "the mesh could not be compressed: %s", message);
}
