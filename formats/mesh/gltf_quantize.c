/* Positions, normals, texture coordinates and float colours as small integers (KHR_mesh_quantization). */
#include "formats/mesh/gltf_write.h"
#include "formats/mesh/loss.h"

#include <float.h>
#include <math.h>

#define MOST_BITS 16
#define MOST_BYTE_BITS 8

mt_type mt_gltf_position_type(const mt_gltf_plan *plan)
{
    unsigned bits = plan->grid.bits;
    return bits == 0 ? MT_F32 : bits <= MOST_BYTE_BITS ? MT_U8 : MT_U16;
}

unsigned mt_gltf_position_stride(const mt_gltf_plan *plan)
{
    return mt_gltf_stride(3, mt_gltf_position_type(plan));
}

static unsigned most_of(const mt_gltf_grid *grid)
{
    return (1u << grid->bits) - 1;
}

static unsigned step_of(const mt_gltf_grid *grid, double number, double origin)
{
    double steps = (number - origin) / grid->step + 0.5;
    return steps < most_of(grid) ? (unsigned)steps : most_of(grid);
}

void mt_gltf_grid_steps(const mt_gltf_grid *grid, mt_vec3 position, unsigned steps[3])
{
    steps[0] = step_of(grid, position.x, grid->origin.x);
    steps[1] = step_of(grid, position.y, grid->origin.y);
    steps[2] = step_of(grid, position.z, grid->origin.z);
}

/* The same step on every axis: a node's scale that is not uniform would turn the normals that readers compute, and
 * those that are stored would need more digits than they have. */
static mt_status make_grid(mt_context *context, const mt_mesh *mesh, unsigned bits, mt_gltf_grid *out)
{
    mt_bounds bounds = mt_mesh_bounds(mesh);
    if (mesh->vertex_count == 0) {
        *out = (mt_gltf_grid){.bits = bits, .step = 1.0};
        return MT_OK;
    }
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    double extent = fmax(size.x, fmax(size.y, size.z));
    *out = (mt_gltf_grid){.bits = bits, .origin = bounds.minimum};
    out->step = extent > 0.0 ? extent / most_of(out) : 1.0;
    if (extent > FLT_MAX || out->step < FLT_MIN) {
        return mt_fail(context, MT_ERROR_UNSUPPORTED,
                       "quantised glTF needs an extent and steps within single precision, and an extent of %g in %u "
                       "steps is not; scale the mesh, or do not quantise it",
                       extent, most_of(out));
    }
    return MT_OK;
}

/* Texture coordinates outside of 0 to 1 repeat the image: no unsigned share says that. */
static bool lies_within(const mt_attribute *attribute)
{
    for (uint64_t i = 0; i < 2 * (uint64_t)attribute->value_count; i++) {
        double number = mt_attribute_get(attribute, (mt_index)(i / 2), (uint32_t)(i % 2));
        if (!(number >= 0.0 && number <= 1.0)) {
            return false;
        }
    }
    return true;
}

static void quantise_column(mt_gltf_column *column, unsigned bits)
{
    bool normals = column->attribute->semantic == MT_SEMANTIC_NORMAL;
    bool uvs = column->attribute->semantic == MT_SEMANTIC_UV;
    if (column->type == MT_F32 && !(uvs && !lies_within(column->attribute))) {
        column->is_quantised = true;
        column->type = !normals ? MT_U16 : bits <= MOST_BYTE_BITS ? MT_I8 : MT_I16;
        column->stride = mt_gltf_stride(column->component_count, column->type);
    }
}

mt_status mt_gltf_quantise(mt_gltf_plan *plan, const mt_mesh_write_options *options)
{
    unsigned bits = options->quantize_bits;
    if (bits == 0) {
        return MT_OK;
    }
    if (options->draco.compress) {
        return mt_fail(plan->context, MT_ERROR_ARGUMENT,
                       "glTF is quantised by Draco or by KHR_mesh_quantization, not by both");
    }
    if (bits > MOST_BITS) {
        return mt_fail(plan->context, MT_ERROR_ARGUMENT,
                       "glTF holds quantised positions of 1 to %d bits, not of %u; Draco takes up to 30", MOST_BITS,
                       bits);
    }
    mt_status status = mt_gltf_check_finite(plan->context, plan->mesh);
    if (status == MT_OK) {
        status = make_grid(plan->context, plan->mesh, bits, &plan->grid);
    }
    for (size_t i = 0; i < plan->column_count && status == MT_OK; i++) {
        quantise_column(&plan->columns[i], bits);
    }
    return status;
}

void mt_gltf_add_quantised(const mt_gltf_plan *plan, mt_loss *loss)
{
    static const char *const names[] = {"", "normals", "UVs", "float colors"};
    if (plan->grid.bits == 0 || plan->mesh->vertex_count == 0) {
        return;
    }
    mt_loss_add(loss, "positions (quantised to %u bits)", plan->grid.bits);
    mt_semantic last = MT_SEMANTIC_GENERIC;
    for (size_t i = 0; i < plan->column_count; i++) {
        const mt_gltf_column *column = &plan->columns[i];
        if (column->is_quantised && column->attribute->semantic != last) {
            last = column->attribute->semantic;
            mt_loss_add(loss, "%s (quantised to %u bits)", names[last], 8 * (unsigned)mt_type_size(column->type));
        }
    }
}
