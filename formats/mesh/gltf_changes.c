/* What writing glTF changes of a mesh although it holds it: vertices split and repeated, numbers rounded, values made
 * up where there are none. */
#include "formats/mesh/draco_options.h"
#include "formats/mesh/gltf_write.h"
#include "formats/mesh/loss.h"

#include <math.h>

/* Whether the component is written as it is. */
static bool is_written(const mt_gltf_column *column, mt_index value, unsigned k, double from)
{
    union {
        float floats[4];
        uint16_t shorts[8];
        uint8_t bytes[16];
    } to;
    mt_gltf_make_value(column, value, &to);
    double number = column->type == MT_U8 ? to.bytes[k] : column->type == MT_U16 ? to.shorts[k] : (double)to.floats[k];
    return from == (column->attribute->semantic == MT_SEMANTIC_UV && k == 1 ? 1.0 - number : number);
}

/* Values of a column that are not written as they are. */
static void count_values(const mt_gltf_column *column, mt_loss *loss)
{
    const mt_attribute *attribute = column->attribute;
    bool normals = attribute->semantic == MT_SEMANTIC_NORMAL, uvs = attribute->semantic == MT_SEMANTIC_UV;
    uint64_t rounded = 0, scaled = 0, lost = 0, clamped = 0;
    for (mt_index i = 0; i < attribute->value_count; i++) {
        double square = 0.0;
        bool same = !column->is_quantised, within = true;
        for (unsigned k = 0; k < attribute->component_count && k < column->component_count; k++) {
            double from = mt_attribute_get(attribute, i, k);
            square += from * from;
            within = within && from >= 0.0 && from <= mt_color_maximum(attribute->type);
            same = same && is_written(column, i, k, from);
        }
        bool unit = fabs(square - 1.0) < 2e-3;
        rounded += !same && (!normals || unit) && (normals || uvs || within);
        scaled += !same && normals && !unit && square > 0.0;
        lost += normals && square == 0.0;
        clamped += !normals && !uvs && !within;
    }
    bool exact = column->is_quantised || column->type != MT_F32; /* or said of all together */
    mt_loss_add_count(loss, exact ? 0 : rounded,
                      normals ? "normal rounded"
                      : uvs   ? "UV rounded"
                              : "color rounded",
                      normals ? "normals rounded"
                      : uvs   ? "UVs rounded"
                              : "colors rounded");
    mt_loss_add_count(loss, scaled, "normal scaled to length 1", "normals scaled to length 1");
    mt_loss_add_count(loss, lost, "normal of no length (written as 0 0 1)", "normals of no length (written as 0 0 1)");
    mt_loss_add_count(loss, clamped, "color clamped to 0 to 1", "colors clamped to 0 to 1");
}

/* Elements in faces that have no value, where glTF needs one. */
static void count_missing(const mt_mesh *mesh, const mt_gltf_column *column, mt_loss *loss)
{
    const mt_attribute *attribute = column->attribute;
    uint64_t missing = 0;
    for (mt_index i = 0; attribute->indices && i < mt_mesh_domain_count(mesh, attribute->domain); i++) {
        missing += attribute->indices[i] == MT_NONE;
    }
    static const char *const words[] = {"", "a normal (written as 0 0 1)", "a UV (written as 0 1)",
                                        "a color (written as white)"};
    bool corner = attribute->domain == MT_DOMAIN_CORNER;
    if (missing > 0) {
        mt_loss_add(loss, "%llu %s without %s", (unsigned long long)missing,
                    missing == 1 ? (corner ? "corner" : "vertex") : (corner ? "corners" : "vertices"),
                    words[attribute->semantic]);
    }
}

static void count_vertices(const mt_gltf_plan *plan, mt_loss *loss)
{
    uint64_t total = 0;
    for (size_t i = 0; i < plan->chunk_count; i++) {
        total += plan->chunks[i].vertex_count;
    }
    mt_loss_add_count(loss, plan->split.vertex_count - plan->mesh->vertex_count, "shared vertex (split at corners)",
                      "shared vertices (split at corners)");
    mt_loss_add_count(loss, total > plan->split.vertex_count ? total - plan->split.vertex_count : 0,
                      "shared vertex (repeated by part)", "shared vertices (repeated by part)");
    if (plan->reordered) {
        mt_loss_add(loss, "the order of faces (gathered by name)");
    }
}

mt_status mt_gltf_changes(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options, mt_loss *loss)
{
    mt_gltf_plan plan;
    mt_status status = mt_gltf_plan_make(context, mesh, options, &plan);
    if (status != MT_OK) {
        return status;
    }
    count_vertices(&plan, loss);
    for (size_t i = 0; i < plan.column_count; i++) {
        count_values(&plan.columns[i], loss);
        count_missing(mesh, &plan.columns[i], loss);
    }
    mt_gltf_add_quantised(&plan, loss);
    mt_gltf_plan_release(&plan);
    return options->draco.compress ? mt_draco_changes(context, mesh, &options->draco, loss) : MT_OK;
}
