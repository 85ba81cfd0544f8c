/* Draco files (.drc): one stream, a mesh of triangles or points alone. */
#include "formats/mesh/draco_options.h"
#include "formats/mesh/gltf_write.h"
#include "formats/mesh/loss.h"
#include "formats/mesh/records.h"
#include "formats/stream/input.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static int sniff_drc(const uint8_t *bytes, size_t size, uint64_t total)
{
    (void)total;
    return size >= 5 && memcmp(bytes, "DRACO", 5) == 0 ? 100 : 0;
}

/* The whole input in memory. */
static mt_status read_content(mt_context *context, mt_input *input, uint8_t **bytes)
{
    mt_status status = mt_input_collect(context, input);
    *bytes = status == MT_OK ? mt_allocate(context, mt_input_size(input)) : NULL;
    if (!*bytes) {
        return status == MT_OK ? MT_ERROR_OUT_OF_MEMORY : status;
    }
    return mt_input_read_exactly(context, input, *bytes, (size_t)mt_input_size(input), "the rest of the file");
}

/* The first attribute that holds positions. */
static bool find_positions(const mt_draco_mesh *from, size_t *number, mt_draco_attribute *out)
{
    for (*number = 0; *number < mt_draco_attribute_count(from); ++*number) {
        if (mt_draco_attribute_at(from, *number, out) && out->kind == MT_DRACO_POSITION) {
            return true;
        }
    }
    return false;
}

/* Integers and floats become positions; only doubles need to stay such. */
static mt_status read_positions(mt_context *context, const mt_draco_mesh *from, size_t number,
                                const mt_draco_attribute *attribute, mt_mesh *mesh)
{
    size_t size = 3 * mt_type_size(attribute->type);
    void *values = mt_allocate_array(context, mesh->vertex_count, size);
    if (!values) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    bool right = mt_draco_copy_values(from, number, values);
    mt_attribute view = {.type = attribute->type, .component_count = 3, .values = values};
    for (mt_index i = 0; i < mesh->vertex_count && right; i++) {
        mt_mesh_set_position(
            mesh, i,
            mt_vec3_make(mt_attribute_get(&view, i, 0), mt_attribute_get(&view, i, 1), mt_attribute_get(&view, i, 2)));
    }
    mt_free(context, values);
    return right ? MT_OK : mt_fail(context, MT_ERROR_SYNTAX, "the Draco stream has a vertex without a position");
}

/* What an attribute is for us; false: nothing that is kept. */
static bool layout_of(const mt_draco_attribute *attribute, mt_index count, mt_attribute_layout *out)
{
    static const struct {
        mt_semantic semantic;
        unsigned least, most;
    } kinds[] = {[MT_DRACO_POSITION] = {MT_SEMANTIC_GENERIC, 1, 0},
                 [MT_DRACO_NORMAL] = {MT_SEMANTIC_NORMAL, 3, 3},
                 [MT_DRACO_COLOR] = {MT_SEMANTIC_COLOR, 1, 4},
                 [MT_DRACO_UV] = {MT_SEMANTIC_UV, 2, 3},
                 [MT_DRACO_GENERIC] = {MT_SEMANTIC_GENERIC, 1, 4}};
    unsigned components = attribute->component_count;
    *out = (mt_attribute_layout){.semantic = kinds[attribute->kind].semantic,
                                 .domain = MT_DOMAIN_VERTEX,
                                 .type = attribute->type,
                                 .component_count = components,
                                 .value_count = count};
    return components >= kinds[attribute->kind].least && components <= kinds[attribute->kind].most;
}

static mt_status read_attributes(mt_context *context, const mt_input *input, const mt_draco_mesh *from,
                                 size_t positions, mt_mesh *mesh)
{
    mt_status status = MT_OK;
    for (size_t i = 0; i < mt_draco_attribute_count(from) && status == MT_OK; i++) {
        mt_draco_attribute attribute;
        mt_attribute_layout layout;
        mt_attribute *to = NULL;
        char name[24];
        if (i == positions) {
            continue;
        }
        if (!mt_draco_attribute_at(from, i, &attribute) || !layout_of(&attribute, mesh->vertex_count, &layout)) {
            mt_warn(context, "%s: attribute number %zu is not kept", mt_input_name(input), i);
            continue;
        }
        snprintf(name, sizeof name, "attribute_%u", attribute.id);
        layout.name = attribute.kind == MT_DRACO_GENERIC ? name : "";
        status = mt_mesh_add_attribute(context, mesh, &layout, &to);
        if (status == MT_OK && !mt_draco_copy_values(from, i, to->values)) {
            status = mt_fail(context, MT_ERROR_SYNTAX, "%s: the Draco stream has a vertex without a value",
                             mt_input_name(input));
        }
    }
    return status;
}

static mt_status make_mesh(mt_context *context, const mt_input *input, const mt_draco_mesh *from, mt_mesh **out)
{
    size_t positions;
    mt_draco_attribute attribute = {0};
    mt_place place = mt_input_place_offset(input, 0);
    bool found = find_positions(from, &positions, &attribute) && attribute.component_count == 3;
    if (!found && mt_draco_vertex_count(from) > 0) {
        return mt_fail_at(context, MT_ERROR_SYNTAX, place, "the Draco stream has no positions of 3 components");
    }
    bool wide = attribute.type == MT_F64 || attribute.type == MT_I32 || attribute.type == MT_U32;
    mt_mesh_layout layout = {.vertex_count = mt_draco_vertex_count(from),
                             .face_count = mt_draco_triangle_count(from),
                             .face_size = 3,
                             .position_type = wide ? MT_F64 : MT_F32};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status == MT_OK && found) {
        status = read_positions(context, from, positions, &attribute, *out);
    }
    if (status == MT_OK && !mt_draco_copy_triangles(from, (*out)->corner_vertices)) {
        status = mt_fail_at(context, MT_ERROR_SYNTAX, place, "a triangle in the Draco stream names no vertex");
    }
    return status == MT_OK ? read_attributes(context, input, from, positions, *out) : status;
}

static mt_status read_drc(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out)
{
    uint8_t *bytes = NULL;
    mt_draco_job job = {.context = context};
    (void)options;
    *out = NULL;
    mt_status status = read_content(context, input, &bytes);
    if (status == MT_OK) {
        size_t size = (size_t)mt_input_size(input);
        status = mt_draco_job_decode(context, mt_input_place_offset(input, 0), "", bytes, size, &job);
        if (status == MT_OK && job.consumed < size) {
            mt_warn(context, "%s: %zu bytes after the end of the Draco stream are left alone", mt_input_name(input),
                    size - job.consumed);
        }
    }
    if (status == MT_OK) {
        status = make_mesh(context, input, job.mesh, out);
    }
    mt_draco_job_close(&job);
    mt_free(context, bytes);
    if (status != MT_OK) {
        mt_mesh_destroy(context, *out);
        *out = NULL;
    }
    return status;
}

/* Draco quantises finite numbers only. */
static mt_status check_finite(mt_context *context, const mt_mesh *mesh)
{
    for (uint64_t i = 0; i < 3 * (uint64_t)mesh->vertex_count; i++) {
        float number = mesh->position_type == MT_F64 ? (float)((const double *)mesh->positions)[i]
                                                     : ((const float *)mesh->positions)[i];
        if (!isfinite(number)) {
            return mt_fail(context, MT_ERROR_UNSUPPORTED,
                           "a Draco file holds finite single-precision numbers only, and vertex %u has one that is not",
                           (mt_index)(i / 3));
        }
    }
    return MT_OK;
}

/* Values as they are stored here, one for each vertex of the split. */
static mt_status gather_column(const mt_gltf_plan *plan, const mt_attribute *attribute, mt_draco_attribute *out,
                               void **memory)
{
    mt_type type = attribute->type == MT_F64 ? MT_F32 : attribute->type;
    mt_gltf_chunk whole = {.vertex_count = plan->split.vertex_count};
    mt_attribute to = {.type = type, .component_count = attribute->component_count};
    *memory = to.values =
        mt_allocate_array(plan->context, plan->split.vertex_count, attribute->component_count * mt_type_size(type));
    if (!to.values) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < plan->split.vertex_count; i++) {
        mt_index element =
            attribute->domain == MT_DOMAIN_CORNER ? plan->split.corners[i] : mt_gltf_source_of(plan, &whole, i);
        mt_index value = element == MT_NONE ? MT_NONE : mt_attribute_value_index(attribute, element);
        double missing = attribute->semantic == MT_SEMANTIC_COLOR ? mt_color_maximum(type) : 0.0;
        for (uint32_t k = 0; k < attribute->component_count; k++) {
            mt_attribute_set(&to, i, k, value == MT_NONE ? missing : mt_attribute_get(attribute, value, k));
        }
    }
    out->type = type;
    out->component_count = attribute->component_count;
    out->normalized = attribute->semantic == MT_SEMANTIC_COLOR && type != MT_F32;
    out->values = to.values;
    return MT_OK;
}

static mt_status gather_positions(const mt_gltf_plan *plan, mt_draco_attribute *out, void **memory)
{
    mt_gltf_chunk whole = {.vertex_count = plan->split.vertex_count};
    float *positions = mt_allocate_array(plan->context, plan->split.vertex_count, 3 * sizeof *positions);
    *memory = positions;
    for (mt_index i = 0; positions && i < whole.vertex_count; i++) {
        mt_gltf_put_position(plan, &whole, i, positions + 3 * (size_t)i);
    }
    *out = (mt_draco_attribute){
        .kind = MT_DRACO_POSITION, .type = MT_F32, .component_count = 3, .bits = out->bits, .values = positions};
    return positions ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

static mt_status write_plan(const mt_gltf_plan *plan, const mt_mesh_write_options *options, mt_output *output)
{
    static const mt_draco_kind kinds[] = {
        [MT_SEMANTIC_NORMAL] = MT_DRACO_NORMAL, [MT_SEMANTIC_UV] = MT_DRACO_UV, [MT_SEMANTIC_COLOR] = MT_DRACO_COLOR};
    mt_draco_attribute attributes[1 + MT_GLTF_COLUMNS] = {{.bits = mt_draco_bits(&options->draco, MT_DRACO_POSITION)}};
    void *memory[1 + MT_GLTF_COLUMNS] = {0};
    mt_draco_bytes bytes = {0};
    mt_status status = gather_positions(plan, &attributes[0], &memory[0]);
    for (size_t i = 0; i < plan->column_count && status == MT_OK; i++) {
        mt_draco_attribute *to = &attributes[i + 1];
        to->kind = kinds[plan->columns[i].attribute->semantic];
        to->bits = mt_draco_bits(&options->draco, to->kind);
        status = gather_column(plan, plan->columns[i].attribute, to, &memory[i + 1]);
    }
    mt_draco_source source = {.vertex_count = plan->split.vertex_count,
                              .triangle_count = plan->triangulation.triangle_count,
                              .triangles = plan->triangulation.triangle_count ? plan->indices : NULL,
                              .attributes = attributes,
                              .attribute_count = 1 + plan->column_count};
    if (status == MT_OK) {
        status = mt_draco_compress(plan->context, &source, &options->draco, options->strict_loss, &bytes);
    }
    if (status == MT_OK) {
        status = mt_output_write(plan->context, output, bytes.bytes, bytes.size);
    }
    mt_free(plan->context, bytes.bytes);
    for (size_t i = 0; i <= plan->column_count; i++) {
        mt_free(plan->context, memory[i]);
    }
    return status;
}

/* A plan of triangles alone: labels, wires and points do not matter to it. */
static mt_status write_drc(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                           mt_output *output)
{
    mt_gltf_plan plan;
    mt_mesh triangles = *mesh;
    triangles.label_set_count = 0;
    triangles.wire_count = triangles.point_count = 0;
    mt_status status = options->draco.lossless ? MT_OK : check_finite(context, mesh);
    if (status == MT_OK) {
        status = mt_gltf_plan_make(context, &triangles, NULL, &plan);
    }
    if (status == MT_OK) {
        status = write_plan(&plan, options, output);
        mt_gltf_plan_release(&plan);
    }
    return status;
}

static mt_status changes(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options, mt_loss *loss)
{
    mt_gltf_column columns[MT_GLTF_COLUMNS];
    mt_gltf_split split;
    size_t count = mt_gltf_list_columns(mesh, columns);
    mt_status status = mt_gltf_split_make(context, mesh, columns, count, &split);
    if (status != MT_OK) {
        return status;
    }
    mt_loss_add_count(loss, split.vertex_count - mesh->vertex_count, "shared vertex (split at corners)",
                      "shared vertices (split at corners)");
    mt_gltf_split_release(context, &split);
    return mt_draco_changes(context, mesh, &options->draco, loss);
}

const mt_mesh_format mt_drc_format = {
    .name = "drc",
    .title = "Draco",
    .extensions = (const char *const[]){"drc", NULL},
    .abilities = MT_HOLDS_INDICES | MT_HOLDS_VERTEX_NORMALS | MT_HOLDS_VERTEX_UVS | MT_HOLDS_VERTEX_COLORS |
                 MT_HOLDS_ALPHA | MT_HOLDS_UV_DEPTH | MT_SPLITS_VERTICES | MT_NEEDS_FINITE | MT_TAKES_DRACO,
    .has_binary = true,
    .sniff = sniff_drc,
    .holds_attribute = mt_gltf_holds_attribute,
    .changes = changes,
    .read = read_drc,
    .write = write_drc,
};
