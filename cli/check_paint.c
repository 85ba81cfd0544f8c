/* check-manifold --paint: the mesh, or a picture of it, with each kind of defect in its colour. */
#include "defect_paint.h"
#include "message.h"

#include <string.h>

static mt_status add_colors(mt_context *context, mt_mesh *mesh, mt_domain domain, const unsigned char *bytes)
{
    mt_attribute_layout layout = {
        .name = "color",
        .semantic = MT_SEMANTIC_COLOR,
        .domain = domain,
        .type = MT_U8,
        .component_count = 3,
        .value_count = mt_mesh_domain_count(mesh, domain),
    };
    mt_attribute *attribute = NULL;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    if (status == MT_OK) {
        memcpy(attribute->values, bytes, 3 * (size_t)layout.value_count);
    }
    return status;
}

static void remove_colors(mt_mesh *mesh, mt_context *context)
{
    for (mt_index i = mesh->attribute_count; i-- > 0;) {
        if (mesh->attributes[i].semantic == MT_SEMANTIC_COLOR) {
            mt_mesh_remove_attribute(context, mesh, i);
        }
    }
}

static cli_exit write_painted(const cli_job *job, const cli_check *check, const cli_defect_paint *paint,
                              const char *path)
{
    mt_context *context = job->context;
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_copy(context, check->mesh, &mesh);
    if (status == MT_OK) {
        remove_colors(mesh, context);
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

/* Whether the output is to be a picture, by --to or else by its extension. */
static bool is_picture(const cli_job *job, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *extension = job->common->to ? cli_extension(job->common->to) : dot ? dot + 1 : "";
    return mt_image_format_by_extension(extension) != NULL;
}

cli_exit cli_check_paint_output(const cli_job *job, const char *path)
{
    if (is_picture(job, path)) {
        const mt_image_format *picture = NULL;
        return cli_check_image_output(job, path, &picture);
    }
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_check_mesh_output(job, path, &format);
    if (code == CLI_EXIT_DONE && !(format->abilities & MT_HOLDS_FACE_COLORS)) {
        return cli_wrong_usage(job->command, "--paint: %s files hold no colours of faces; write a ply or a png",
                               format->name);
    }
    return code;
}

cli_exit cli_check_paint(const cli_job *job, const cli_check *check, const char *path)
{
    cli_defect_paint paint;
    bool for_picture = is_picture(job, path);
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
