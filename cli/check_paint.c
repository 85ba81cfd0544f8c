/* check-manifold --paint: the mesh, or a picture of it, with each kind of defect in its colour. */
#include "defect_paint.h"
#include "message.h"
#include "paint.h"

#include <string.h>

static mt_status add_colors(mt_context *context, mt_mesh *mesh, mt_domain domain, const unsigned char *bytes)
{
    unsigned char *colors = NULL;
    mt_status status = cli_paint_add(context, mesh, domain, &colors);
    if (status == MT_OK) {
        memcpy(colors, bytes, 3 * (size_t)mt_mesh_domain_count(mesh, domain));
    }
    return status;
}

static cli_exit write_painted(const cli_job *job, const cli_check *check, const cli_defect_paint *paint,
                              const char *path)
{
    mt_context *context = job->context;
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_copy(context, check->mesh, &mesh);
    if (status == MT_OK) {
        cli_paint_clear(context, mesh);
        status = add_colors(context, mesh, MT_DOMAIN_VERTEX, paint->vertices);
    }
    if (status == MT_OK) {
        status = add_colors(context, mesh, MT_DOMAIN_FACE, paint->faces);
    }
    cli_exit code = status == MT_OK ? cli_write_mesh(job, mesh, path, NULL) : cli_report_failure(job, check->file);
    mt_mesh_destroy(context, mesh);
    return code;
}

static cli_exit write_picture(const cli_job *job, const cli_check *check, const cli_defect_paint *paint,
                              const char *path)
{
    mt_preview_options how = {0};
    cli_defect_paint_apply(paint, &how);
    mt_image *image = NULL;
    if (mt_preview(job->context, &paint->shown, &how, &image) != MT_OK) {
        return cli_report_failure(job, check->file);
    }
    cli_exit code = cli_write_image(job, image, path);
    mt_image_destroy(job->context, image);
    return code;
}

cli_exit cli_check_paint_output(const cli_job *job, const char *path)
{
    return cli_paint_check_output(job, path, MT_HOLDS_FACE_COLORS, "faces");
}

cli_exit cli_check_paint(const cli_job *job, const cli_check *check, const char *path)
{
    cli_defect_paint paint;
    bool for_picture = cli_paint_is_picture(job, path);
    if (cli_defect_paint_init(job->context, check, for_picture, &paint) != MT_OK) {
        return cli_report_failure(job, check->file);
    }
    cli_exit code = for_picture ? write_picture(job, check, &paint, path) : write_painted(job, check, &paint, path);
    if (code == CLI_EXIT_DONE) {
        cli_defect_legend(job, check, path);
    }
    cli_defect_paint_release(job->context, &paint);
    return code;
}
