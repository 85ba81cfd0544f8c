/* Which normals are asked for, and where they go on the mesh. */
#include "lib/algorithms/normals.h"

#include <meshtool/elementary.h>

static mt_status check(mt_context *context, const mt_mesh *mesh, mt_normal_options *options)
{
    options->type = options->type ? options->type : mesh->position_type;
    if (options->type != MT_F32 && options->type != MT_F64) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "normals are stored as f32 or f64");
    }
    if (!(options->crease_angle <= MT_PI)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "the crease angle is %g; it lies between 0 and 180 degrees",
                       options->crease_angle * (180 / MT_PI));
    }
    options->crease_angle = options->crease_angle == 0 ? MT_DEFAULT_CREASE_ANGLE : options->crease_angle;
    return MT_OK;
}

static mt_domain domain_of(mt_normal_kind kind)
{
    static const mt_domain domains[] = {MT_DOMAIN_VERTEX, MT_DOMAIN_FACE, MT_DOMAIN_CORNER};
    return domains[kind];
}

static bool replaces(mt_domain domain, const mt_attribute *attribute)
{
    bool of_faces = attribute->domain == MT_DOMAIN_FACE;
    return attribute->semantic == MT_SEMANTIC_NORMAL && of_faces == (domain == MT_DOMAIN_FACE);
}

/* The first `old_count` attributes are those that the mesh had. */
static void remove_replaced(mt_context *context, mt_mesh *mesh, mt_domain domain, mt_index old_count)
{
    for (mt_index i = old_count; i-- > 0;) {
        if (replaces(domain, &mesh->attributes[i])) {
            mt_mesh_remove_attribute(context, mesh, i);
        }
    }
}

static mt_status compute(mt_normals_job *job)
{
    switch (job->options.kind) {
    case MT_NORMALS_FACE:
        mt_normals_of_faces(job);
        return MT_OK;
    case MT_NORMALS_CORNER:
        return mt_normals_of_corners(job);
    case MT_NORMALS_VERTEX:
        break;
    }
    return mt_normals_of_vertices(job);
}

static mt_status add(mt_context *context, mt_mesh *mesh, mt_normals_job *job)
{
    mt_domain domain = domain_of(job->options.kind);
    mt_index old_count = mesh->attribute_count;
    bool indexed = domain == MT_DOMAIN_CORNER;
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = domain,
                                  .type = job->options.type,
                                  .component_count = 3,
                                  .value_count = indexed ? 0 : mt_mesh_domain_count(mesh, domain),
                                  .indexed = indexed};
    mt_attribute *attribute;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    if (status != MT_OK) {
        return status;
    }
    job->values = attribute;
    status = compute(job);
    if (status == MT_OK) {
        status = mt_progress(context, "computing normals", 1);
    }
    if (status == MT_OK) {
        remove_replaced(context, mesh, domain, old_count);
    } else {
        mt_mesh_remove_attribute(context, mesh, old_count);
    }
    return status;
}

mt_status mt_mesh_add_normals(mt_context *context, mt_mesh *mesh, const mt_normal_options *options,
                              mt_normal_report *report)
{
    mt_normals_job job = {.context = context, .mesh = mesh};
    job.options = options ? *options : job.options;
    mt_status status = check(context, mesh, &job.options);
    if (status == MT_OK) {
        status = add(context, mesh, &job);
    }
    if (status == MT_OK && report) {
        mt_domain domain = domain_of(job.options.kind);
        report->element_count = mt_mesh_domain_count(mesh, domain);
        report->value_count = mesh->attributes[mesh->attribute_count - 1].value_count;
        report->undefined_count = job.undefined_count;
    }
    return status;
}
