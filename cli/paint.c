#include "paint.h"

#include "message.h"

#include <meshtool/preview.h>

#include <string.h>

bool cli_paint_is_picture(const cli_job *job, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *extension = job->common->to ? cli_extension(job->common->to) : dot ? dot + 1 : "";
    return mt_image_format_by_extension(extension) != NULL;
}

cli_exit cli_paint_check_output(const cli_job *job, const char *path, mt_ability ability, const char *elements)
{
    if (cli_paint_is_picture(job, path)) {
        const mt_image_format *picture = NULL;
        return cli_check_image_output(job, path, &picture);
    }
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_check_mesh_output(job, path, &format);
    if (code == CLI_EXIT_DONE && !(format->abilities & ability)) {
        return cli_wrong_usage(job->command, "--paint: %s files hold no colours of %s; write a ply or a png",
                               format->name, elements);
    }
    return code;
}

void cli_paint_clear(mt_context *context, mt_mesh *mesh)
{
    for (mt_index i = mesh->attribute_count; i-- > 0;) {
        if (mesh->attributes[i].semantic == MT_SEMANTIC_COLOR) {
            mt_mesh_remove_attribute(context, mesh, i);
        }
    }
}

mt_status cli_paint_add(mt_context *context, mt_mesh *mesh, mt_domain domain, unsigned char **colors)
{
    mt_attribute_layout layout = {.name = "color",
                                  .semantic = MT_SEMANTIC_COLOR,
                                  .domain = domain,
                                  .type = MT_U8,
                                  .component_count = 3,
                                  .value_count = mt_mesh_domain_count(mesh, domain)};
    mt_attribute *attribute = NULL;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    *colors = status == MT_OK ? attribute->values : NULL;
    return status;
}

cli_exit cli_paint_write(const cli_job *job, const mt_mesh *mesh, const char *path)
{
    if (!cli_paint_is_picture(job, path)) {
        return cli_write_mesh(job, mesh, path, NULL);
    }
    mt_image *image = NULL;
    if (mt_preview(job->context, mesh, NULL, &image) != MT_OK) {
        return cli_report_failure(job, job->operands[0]);
    }
    cli_exit code = cli_write_image(job, image, path);
    mt_image_destroy(job->context, image);
    return code;
}
