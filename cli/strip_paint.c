#include "strip_paint.h"

#include "message.h"
#include "paint.h"

#include <meshtool/palette.h>

static void color_faces(const mt_mesh *mesh, const mt_strips *strips, unsigned char *colors)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_palette_distinct_color(strips->face_runs[face], colors + 3 * (size_t)face);
    }
}

mt_status cli_strip_colors(mt_context *context, const mt_mesh *mesh, unsigned char **colors)
{
    mt_strips *strips = NULL;
    *colors = NULL;
    mt_status status = mt_strips_create(context, mesh, NULL, &strips);
    if (status == MT_OK) {
        *colors = mt_allocate_array(context, mesh->face_count, 3);
        status = *colors ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    }
    if (status == MT_OK) {
        color_faces(mesh, strips, *colors);
    }
    mt_strips_destroy(context, strips);
    return status;
}

cli_exit cli_strip_paint(const cli_job *job, const mt_mesh *mesh, const mt_strips *strips, const char *path)
{
    mt_mesh *copy = NULL;
    unsigned char *colors = NULL;
    mt_status status = mt_mesh_copy(job->context, mesh, &copy);
    if (status == MT_OK) {
        cli_paint_clear(job->context, copy);
        status = cli_paint_add(job->context, copy, MT_DOMAIN_FACE, &colors);
    }
    cli_exit code = CLI_EXIT_DONE;
    if (status == MT_OK) {
        color_faces(mesh, strips, colors);
        code = cli_paint_write(job, copy, path);
    } else {
        code = cli_report_failure(job, job->operands[0]);
    }
    mt_mesh_destroy(job->context, copy);
    return code;
}
