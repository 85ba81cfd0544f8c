#include <meshtool/file.h>

#include "formats/stream/output.h"

mt_status mt_file_write(mt_context *context, const char *path, const void *bytes, size_t size, bool no_clobber)
{
    mt_output *output = NULL;
    mt_status status = mt_output_open(context, path, no_clobber, &output);
    if (status != MT_OK) {
        return status;
    }
    status = mt_output_write(context, output, bytes, size);
    if (status != MT_OK) {
        mt_output_abandon(context, output);
        return status;
    }
    return mt_output_commit(context, output);
}
