#include "lib/render/scene_part.h"

#include "lib/render/interpolate.h"

#include <string.h>

/* No regular solid or prism has this angle (as in a preview). */
#define DEFAULT_CREASE 41.0

/* With fewer triangles a ray tries them all: a tree would not be paid for. */
#define FEW_TRIANGLES 64

/* How far beside a triangle a ray may hit it, as a part of the mesh's extent: vertices and shears are rounded to
 * floats. */
#define HIT_MARGIN 0x1p-18

void mt_scene_part_init(const mt_scene_mesh *source, const mt_scene_options *options, mt_scene_part *part)
{
    memset(part, 0, sizeof *part);
    part->source = *source;
    part->has_kind = options->has_structure;
    part->kind = options->structure;
    part->profile = options->triangle_test;
    part->bounds = mt_mesh_bounds(source->mesh);
    double extent = mt_vec3_max_abs(mt_vec3_subtract(part->bounds.maximum, part->bounds.minimum));
    mt_vec3 margin = mt_vec3_scale(mt_vec3_make(1, 1, 1), extent * HIT_MARGIN);
    part->bounds.minimum = mt_vec3_subtract(part->bounds.minimum, margin);
    part->bounds.maximum = mt_vec3_add(part->bounds.maximum, margin);
}

static mt_status make_normals(mt_context *context, mt_scene_part *part)
{
    const mt_scene_mesh *source = &part->source;
    mt_status status = mt_corner_normals_init(context, &part->model, &part->normals);
    if (status != MT_OK || source->shading == MT_SHADING_FLAT) {
        part->normals.flat = true;
        return status;
    }
    bool smooth = source->shading == MT_SHADING_SMOOTH;
    double crease = source->crease_degrees > 0 ? source->crease_degrees : DEFAULT_CREASE;
    part->normals.own = smooth || source->crease_degrees > 0;
    return mt_corner_normals_build(context, &part->model, smooth ? 180.0 : crease, &part->normals);
}

mt_status mt_scene_part_build(mt_context *context, mt_scene_part *part)
{
    int token = mt_part_begin(context, "mesh", "triangles and corner normals");
    mt_status status = mt_model_init(context, part->source.mesh, &part->model);
    if (status == MT_OK) {
        status = make_normals(context, part);
    }
    if (status == MT_OK) {
        const mt_mesh *colored = part->source.uses_material_color ? NULL : part->source.mesh;
        mt_surface_init(part->source.mesh, colored, NULL, &part->surface);
        part->has_colors = part->surface.colors != NULL;
        part->space = mt_ray_space_of(part->source.mesh);
    }
    mt_part_end(context, token);
    return status;
}

mt_ray_structure_kind mt_scene_structure_kind(bool has_kind, mt_ray_structure_kind kind, mt_index triangle_count)
{
    if (has_kind) {
        return kind;
    }
    return triangle_count <= FEW_TRIANGLES ? MT_RAY_STRUCTURE_NONE : MT_RAY_STRUCTURE_AABB;
}

mt_status mt_scene_part_build_tree(mt_context *context, mt_scene_part *part)
{
    mt_ray_structure_kind kind =
        mt_scene_structure_kind(part->has_kind, part->kind, part->model.triangulation.triangle_count);
    if (kind == MT_RAY_STRUCTURE_NONE) {
        mt_part_skip(context, "surface tree",
                     part->has_kind ? "asked to do without: every ray meets every triangle"
                                    : "few triangles: every ray meets them all");
    }
    part->is_built = true;
    return mt_ray_structure_create(context, part->source.mesh, &part->model.triangulation, kind, MT_BUILD_BALANCED,
                                   &part->structure);
}

void mt_scene_part_release(mt_context *context, mt_scene_part *part)
{
    mt_ray_structure_destroy(context, part->structure);
    mt_corner_normals_release(context, &part->normals);
    mt_model_release(context, &part->model);
    memset(part, 0, sizeof *part);
}

mt_ray_hit mt_scene_part_nearest(const mt_scene_part *part, const mt_ray *ray)
{
    mt_ray_hit hit;
    return mt_ray_structure_nearest_hit(part->structure, ray, part->profile, &hit) ? hit : mt_ray_no_hit();
}

bool mt_scene_part_any(const mt_scene_part *part, const mt_ray *ray)
{
    return mt_ray_structure_any_hit(part->structure, ray, part->profile);
}

/* The colours of the corners, weighed; false where one has none. */
static bool weigh_colors(const mt_scene_part *part, mt_index triangle, const double weights[3], mt_vec3 *color)
{
    const mt_triangulation *triangulation = &part->model.triangulation;
    mt_index face = mt_triangulation_face(triangulation, triangle);
    mt_vec3 colors[3];
    for (mt_index i = 0; i < 3; i++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, i);
        mt_index vertex = part->source.mesh->corner_vertices[corner];
        if (!mt_surface_color(&part->surface, face, corner, vertex, &colors[i])) {
            return false;
        }
    }
    *color = mt_weigh(colors, weights);
    return true;
}

mt_part_point mt_scene_part_point(const mt_scene_part *part, mt_index triangle, const double weights[3],
                                  mt_vec3 direction)
{
    const mt_mesh *mesh = part->source.mesh;
    const mt_triangulation *triangulation = &part->model.triangulation;
    mt_index face = mt_triangulation_face(triangulation, triangle);
    mt_triangle corners;
    mt_vec3 normals[3];
    for (mt_index i = 0; i < 3; i++) {
        mt_index corner = mt_triangulation_corner(triangulation, triangle, i);
        corners.corners[i] = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
        normals[i] = mt_corner_normal(&part->normals, face, corner);
    }
    mt_part_point point = {.face_normal = mt_triangle_normal(&corners)};
    for (int i = 0; i < 3; i++) {
        normals[i] = mt_vec3_max_abs(normals[i]) > 0 ? mt_facing(normals[i], point.face_normal) : point.face_normal;
    }
    point.position = mt_weigh(corners.corners, weights);
    point.normal = mt_unit_or(mt_weigh(normals, weights), point.face_normal);
    double side = mt_vec3_dot(point.face_normal, direction) > 0 ? -1.0 : 1.0;
    for (int i = 0; i < 3; i++) {
        normals[i] = mt_vec3_scale(normals[i], side);
    }
    point.lifted = mt_lifted_position(point.position, corners.corners, normals, weights);
    point.has_color = part->has_colors && weigh_colors(part, triangle, weights, &point.color);
    return point;
}
