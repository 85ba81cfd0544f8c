/* The table of what rays can search, and the record of the tree of axis-aligned boxes, which is a noun of its own. */
#include "lib/spatial/ray_structure.h"

#include <meshtool/surface_tree.h>

#define MOST_TRIANGLES (1u << 28)

struct mt_ray_structure {
    mt_ray_structure_kind kind;
    mt_ray_space space;
    void *body;
};

static mt_status create_tree(mt_context *context, const mt_ray_source *source, void **body)
{
    mt_surface_tree *tree = NULL;
    const mt_surface_tree_options options = {.quality = source->quality};
    mt_status status = mt_surface_tree_create(context, source->mesh, source->triangulation, &options, &tree);
    *body = tree;
    return status;
}

static void destroy_tree(mt_context *context, void *body)
{
    mt_surface_tree_destroy(context, body);
}

static mt_status validate_tree(mt_context *context, const void *body)
{
    return mt_surface_tree_validate(context, body);
}

static uint64_t tree_size(const void *body)
{
    return mt_surface_tree_size(body);
}

static bool find_in_tree(const void *body, const mt_ray *ray, mt_ray_profile profile, bool any, mt_ray_hit *hit)
{
    if (any) {
        return mt_surface_tree_any_hit(body, ray, profile);
    }
    return mt_surface_tree_nearest_hit(body, ray, profile, hit);
}

static const mt_ray_structure_record aabb = {"aabb", create_tree, destroy_tree, validate_tree, tree_size, find_in_tree};

static const mt_ray_structure_record *const records[MT_RAY_STRUCTURE_COUNT] = {
    [MT_RAY_STRUCTURE_AABB] = &aabb,
    [MT_RAY_STRUCTURE_NONE] = &mt_ray_structure_none,
    [MT_RAY_STRUCTURE_OBB] = &mt_ray_structure_obb,
    [MT_RAY_STRUCTURE_GRID] = &mt_ray_structure_grid,
    [MT_RAY_STRUCTURE_BSP] = &mt_ray_structure_bsp,
};

static const mt_ray_structure_record *record_of(mt_ray_structure_kind kind)
{
    return (unsigned)kind < MT_RAY_STRUCTURE_COUNT ? records[kind] : NULL;
}

const char *mt_ray_structure_name(mt_ray_structure_kind kind)
{
    const mt_ray_structure_record *record = record_of(kind);
    return record ? record->name : NULL;
}

static mt_status check_order(mt_context *context, const mt_triangulation *triangulation, mt_ray_structure_kind kind)
{
    if (!record_of(kind)) {
        return mt_fail(context, MT_ERROR_ARGUMENT, "no structure for rays has the number %d; they go from 0 to %d",
                       (int)kind, MT_RAY_STRUCTURE_COUNT - 1);
    }
    if (triangulation->triangle_count >= MOST_TRIANGLES) {
        return mt_fail(context, MT_ERROR_TOO_LARGE,
                       "the mesh has %u triangles, a structure for rays holds fewer than %u; split the mesh",
                       triangulation->triangle_count, MOST_TRIANGLES);
    }
    return MT_OK;
}

mt_status mt_ray_structure_create(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                  mt_ray_structure_kind kind, mt_build_quality quality, mt_ray_structure **out)
{
    *out = NULL;
    mt_status status = check_order(context, triangulation, kind);
    if (status != MT_OK) {
        return status;
    }
    mt_ray_structure *structure = mt_allocate_zeroed(context, sizeof *structure);
    if (!structure) {
        return mt_context_error(context)->status;
    }
    const mt_ray_source source = {mesh, triangulation, mt_ray_space_of(mesh), quality};
    structure->kind = kind;
    structure->space = source.space;
    status = records[kind]->create(context, &source, &structure->body);
    if (status == MT_OK) {
        *out = structure;
    } else {
        mt_ray_structure_destroy(context, structure);
    }
    return status;
}

void mt_ray_structure_destroy(mt_context *context, mt_ray_structure *structure)
{
    if (!structure) {
        return;
    }
    if (structure->body) {
        records[structure->kind]->destroy(context, structure->body);
    }
    mt_free(context, structure);
}

mt_status mt_ray_structure_validate(mt_context *context, const mt_ray_structure *structure)
{
    return records[structure->kind]->validate(context, structure->body);
}

mt_ray_structure_kind mt_ray_structure_kind_of(const mt_ray_structure *structure)
{
    return structure->kind;
}

const mt_ray_space *mt_ray_structure_space(const mt_ray_structure *structure)
{
    return &structure->space;
}

uint64_t mt_ray_structure_size(const mt_ray_structure *structure)
{
    return sizeof *structure + records[structure->kind]->size(structure->body);
}

bool mt_ray_structure_nearest_hit(const mt_ray_structure *structure, const mt_ray *ray, mt_ray_profile profile,
                                  mt_ray_hit *hit)
{
    return records[structure->kind]->find_hit(structure->body, ray, profile, false, hit);
}

bool mt_ray_structure_any_hit(const mt_ray_structure *structure, const mt_ray *ray, mt_ray_profile profile)
{
    mt_ray_hit hit;
    return records[structure->kind]->find_hit(structure->body, ray, profile, true, &hit);
}
