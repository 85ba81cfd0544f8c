/* Strips and fans as glTF: a primitive each over the vertices of the mesh, as glTF has no restart index. */
#include "formats/mesh/gltf_write.h"
#include "formats/mesh/records.h"

#include <string.h>

/* The mesh with what lies on its vertices: strips know no corners. Only `attributes` is new. */
static mt_status view_vertices(mt_context *context, const mt_mesh *mesh, mt_mesh *view)
{
    *view = *mesh;
    view->attributes = mt_allocate_array(context, mesh->attribute_count, sizeof *view->attributes);
    view->attribute_count = view->label_set_count = view->wire_count = view->point_count = 0;
    if (!view->attributes) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    mt_index left_out = 0;
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (mesh->attributes[i].domain == MT_DOMAIN_VERTEX) {
            view->attributes[view->attribute_count++] = mesh->attributes[i];
        } else {
            left_out++;
        }
    }
    if (left_out > 0 || mesh->label_set_count > 0) {
        mt_warn(context, "strips are over vertices: what lies on corners and faces is left out");
    }
    return MT_OK;
}

static mt_status add_strips(mt_gltf_plan *plan, const mt_strips *strips)
{
    mt_gltf_chunk *chunk = mt_gltf_add_chunk(plan);
    if (!chunk) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    chunk->vertex_count = plan->mesh->vertex_count;
    for (mt_index i = 0; i < strips->strip_count; i++) {
        mt_gltf_primitive *primitive = mt_gltf_add_primitive(plan);
        if (!primitive) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        primitive->mode = i < strips->fan_begin ? MT_GLTF_TRIANGLE_STRIP : MT_GLTF_TRIANGLE_FAN;
        primitive->begin = strips->offsets[i];
        primitive->count = strips->offsets[i + 1] - strips->offsets[i];
    }
    return MT_OK;
}

static mt_status write_view(mt_context *context, const mt_mesh *view, const mt_strips *strips, mt_output *output,
                            bool binary)
{
    mt_gltf_plan plan = {.context = context,
                         .mesh = view,
                         .indices = strips->indices,
                         .index_count = strips->offsets[strips->strip_count]};
    mt_status status = mt_gltf_check_finite(context, view);
    plan.column_count = mt_gltf_list_columns(view, plan.columns);
    if (status == MT_OK) {
        status = mt_gltf_split_make(context, view, plan.columns, plan.column_count, &plan.split);
    }
    if (status == MT_OK && strips->strip_count > 0) {
        status = add_strips(&plan, strips);
    }
    if (status == MT_OK) {
        status = mt_gltf_write_plan(&plan, output, binary);
    }
    mt_gltf_plan_release(&plan);
    return status;
}

static mt_status write_strips(mt_context *context, const mt_mesh *mesh, const mt_strips *strips, mt_output *output,
                              bool binary)
{
    mt_mesh view;
    mt_status status = view_vertices(context, mesh, &view);
    if (status == MT_OK) {
        status = write_view(context, &view, strips, output, binary);
        mt_free(context, view.attributes);
    }
    return status;
}

static mt_status write_binary(mt_context *context, const mt_mesh *mesh, const mt_strips *strips,
                              const mt_strip_write_options *options, mt_output *output)
{
    (void)options;
    return write_strips(context, mesh, strips, output, true);
}

static mt_status write_text(mt_context *context, const mt_mesh *mesh, const mt_strips *strips,
                            const mt_strip_write_options *options, mt_output *output)
{
    (void)options;
    return write_strips(context, mesh, strips, output, false);
}

static const char *const binary_extensions[] = {"glb", NULL};
static const char *const text_extensions[] = {"gltf", NULL};

const mt_strip_format mt_strips_glb_format = {.name = "glb",
                                              .title = "binary glTF",
                                              .extensions = binary_extensions,
                                              .holds_vertices = true,
                                              .write = write_binary};

const mt_strip_format mt_strips_gltf_format = {
    .name = "gltf", .title = "glTF", .extensions = text_extensions, .holds_vertices = true, .write = write_text};
