#include "lib/render/scene_world.h"

#include "lib/render/raster.h"

#include <meshtool/checked.h>

#include <string.h>

/* Copies of instances may come to so many times the triangles that the meshes have. */
#define MOST_COPIES 4

static bool is_identity(const mt_transform *t)
{
    const mt_transform identity = mt_transform_identity();
    bool same = t->translation.x == 0 && t->translation.y == 0 && t->translation.z == 0;
    for (int i = 0; i < 9; i++) {
        same = same && t->linear[i / 3][i % 3] == identity.linear[i / 3][i % 3];
    }
    return same;
}

static uint64_t triangles_of(const mt_mesh *mesh)
{
    return mesh->corner_count - 2 * (uint64_t)mesh->face_count;
}

bool mt_scene_world_fits(const mt_scene_plan *plan, const char **reason)
{
    const mt_scene *scene = plan->scene;
    uint64_t own = 0, copies = 0;
    for (mt_index i = 0; i < scene->mesh_count; i++) {
        own += triangles_of(scene->meshes[i].mesh);
    }
    for (mt_index i = 0; i < scene->object_count; i++) {
        if (scene->objects[i].kind == MT_OBJECT_MESH) {
            copies += triangles_of(scene->meshes[scene->objects[i].mesh].mesh);
        }
    }
    bool has_light = scene->light_count > 0;
    if (plan->has_followers) {
        *reason = "mirrors or glass: rays find what is seen";
    } else if (plan->has_shadows && has_light) {
        *reason = "shadows: rays find what is seen, by the trees that they need anyway";
    } else if (plan->part_count == 0) {
        *reason = "no meshes";
    } else if (copies > MOST_COPIES * own || !mt_count_fits(3 * copies)) {
        *reason = "many instances: rays find what is seen, as copies would fill memory";
    } else {
        *reason = "primary rays only: triangles go to the pixels that they cover";
        return true;
    }
    return false;
}

static mt_status build_parts(mt_context *context, mt_scene_plan *plan)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; status == MT_OK && i < plan->part_count; i++) {
        status = mt_scene_part_build(context, &plan->parts[i]);
    }
    return status;
}

static bool is_item(const mt_scene_plan *plan, mt_index i)
{
    return i < plan->scene->object_count ? plan->scene->objects[i].kind == MT_OBJECT_MESH : plan->loose != NULL;
}

static mt_status list_items(mt_context *context, mt_scene_world *world)
{
    const mt_scene_plan *plan = world->plan;
    mt_index count = 0;
    for (mt_index i = 0; i <= plan->scene->object_count; i++) {
        count += is_item(plan, i);
    }
    world->items = (mt_index *)mt_allocate_array(context, count, sizeof *world->items);
    world->firsts = (mt_index *)mt_allocate_array(context, (uint64_t)count + 1, sizeof *world->firsts);
    if (!world->items || !world->firsts) {
        return mt_context_error(context)->status;
    }
    world->firsts[0] = 0;
    for (mt_index i = 0; i <= plan->scene->object_count; i++) {
        if (is_item(plan, i)) {
            mt_index triangles = mt_scene_part_of(plan, i)->model.triangulation.triangle_count;
            world->items[world->item_count] = i;
            world->firsts[world->item_count + 1] = world->firsts[world->item_count] + triangles;
            world->item_count++;
        }
    }
    return MT_OK;
}

/* An item's vertices, carried into the scene, and its triangles. */
static void copy_item(const mt_scene_plan *plan, mt_index item, mt_mesh *mesh, mt_index first_vertex,
                      mt_index first_triangle)
{
    const mt_scene_part *part = mt_scene_part_of(plan, item);
    const mt_mesh *source = part->source.mesh;
    const mt_transform identity = mt_transform_identity();
    const mt_transform *place =
        item < plan->scene->object_count ? &plan->scene->objects[item].shape.transform : &identity;
    for (mt_index v = 0; v < source->vertex_count; v++) {
        mt_mesh_set_position(mesh, first_vertex + v, mt_transform_point(place, mt_mesh_position(source, v)));
    }
    for (mt_index t = 0; t < part->model.triangulation.triangle_count; t++) {
        for (mt_index side = 0; side < 3; side++) {
            mt_index corner = mt_triangulation_corner(&part->model.triangulation, t, side);
            mesh->corner_vertices[3 * (first_triangle + t) + side] = first_vertex + source->corner_vertices[corner];
        }
    }
}

static mt_status copy_items(mt_context *context, mt_scene_world *world)
{
    uint64_t vertices = 0;
    for (mt_index i = 0; i < world->item_count; i++) {
        vertices += mt_scene_part_of(world->plan, world->items[i])->source.mesh->vertex_count;
    }
    mt_mesh_layout layout = {.vertex_count = vertices,
                             .face_count = world->firsts[world->item_count],
                             .face_size = 3,
                             .position_type = MT_F64};
    int part = mt_part_begin(context, "meshes in one", "their vertices where they stand in the scene");
    mt_status status = mt_mesh_create(context, &layout, &world->mesh);
    mt_index vertex = 0;
    for (mt_index i = 0; status == MT_OK && i < world->item_count; i++) {
        copy_item(world->plan, world->items[i], world->mesh, vertex, world->firsts[i]);
        vertex += mt_scene_part_of(world->plan, world->items[i])->source.mesh->vertex_count;
    }
    if (status == MT_OK) {
        status = mt_model_init(context, world->mesh, &world->own_model);
        world->model = &world->own_model;
    }
    mt_part_end(context, part);
    return status;
}

static double scale_of(const mt_model *model)
{
    return model->scales[0] * model->scales[1] * model->unit;
}

/* The camera in the coordinates of the model. A parallel one comes close along its rays, as depth is counted from it;
 * what lay behind it before would then be seen, so it stays when there is any. */
static mt_camera camera_of(mt_scene_world *world)
{
    const mt_model *model = world->model;
    mt_camera camera = world->plan->camera;
    camera.eye = mt_model_point(model, camera.eye);
    if (!mt_camera_is_parallel(&camera)) {
        return camera;
    }
    camera.half_width *= scale_of(model);
    camera.half_height *= scale_of(model);
    double nearest = INFINITY;
    for (int i = 0; i < 8; i++) {
        mt_vec3 corner = mt_vec3_make(i & 1 ? model->high.x : model->low.x, i & 2 ? model->high.y : model->low.y,
                                      i & 4 ? model->high.z : model->low.z);
        nearest = fmin(nearest, mt_vec3_dot(mt_vec3_subtract(corner, camera.eye), camera.forward));
    }
    world->shift = nearest > 0.5 ? nearest - 0.5 : 0.0;
    mt_vec3 direction = mt_camera_ray_at(&camera, 0, 0).direction;
    camera.eye = mt_vec3_add(camera.eye, mt_vec3_scale(direction, world->shift));
    return camera;
}

static mt_tile_range triangle_range(const void *user, mt_index number)
{
    return mt_triangle_range((const mt_frame *)user, number);
}

static void triangle_narrow(const void *user, mt_index number, uint32_t tile_y, mt_tile_range *row)
{
    mt_triangle_narrow((const mt_frame *)user, number, tile_y, row);
}

static mt_status make_ready(mt_context *context, mt_scene_world *world)
{
    const mt_scene_plan *plan = world->plan;
    const mt_camera camera = camera_of(world);
    /* Sorted for the samples that reach farthest to the sides of pixels. */
    unsigned samples = plan->fine_samples > plan->samples ? plan->fine_samples : plan->samples;
    mt_status status =
        mt_frame_init(context, world->model, &camera, samples, plan->options.triangle_test, &world->frame);
    if (status == MT_OK && plan->options.method == MT_METHOD_RAY) {
        const mt_scene_options *options = &plan->options;
        mt_ray_structure_kind kind = mt_scene_structure_kind(options->has_structure, options->structure,
                                                             world->model->triangulation.triangle_count);
        return mt_occluder_init(context, world->model, options->triangle_test, kind, &world->occluder);
    }
    if (status != MT_OK) {
        return status;
    }
    int part = mt_part_begin(context, "tile lists", "triangles sorted by 32 x 32 pixels");
    const mt_binned binned = {&world->frame, world->model->triangulation.triangle_count, triangle_range,
                              triangle_narrow};
    status = mt_bins_init(context, &binned, camera.width, camera.height, &world->bins);
    mt_part_end(context, part);
    return status;
}

mt_status mt_scene_world_init(mt_context *context, mt_scene_plan *plan, mt_scene_world *world)
{
    memset(world, 0, sizeof *world);
    world->plan = plan;
    mt_status status = build_parts(context, plan);
    if (status == MT_OK) {
        status = list_items(context, world);
    }
    mt_index item = status == MT_OK && world->item_count > 0 ? world->items[0] : MT_NONE;
    bool is_as_it_is = world->item_count == 1 &&
                       (item == plan->scene->object_count || is_identity(&plan->scene->objects[item].shape.transform));
    if (status == MT_OK && is_as_it_is) {
        world->model = &mt_scene_part_of(plan, item)->model;
    } else if (status == MT_OK) {
        status = copy_items(context, world);
    }
    return status == MT_OK ? make_ready(context, world) : status;
}

void mt_scene_world_release(mt_context *context, mt_scene_world *world)
{
    mt_occluder_release(context, &world->occluder);
    mt_bins_release(context, &world->bins);
    mt_frame_release(context, &world->frame);
    mt_model_release(context, &world->own_model);
    mt_mesh_destroy(context, world->mesh);
    mt_free(context, world->items);
    mt_free(context, world->firsts);
    memset(world, 0, sizeof *world);
}

void mt_scene_world_draw(const mt_scene_world *world, const mt_sampling *sampling, mt_tile *tile)
{
    mt_frame frame = world->frame;
    frame.sampling = *sampling;
    mt_tile_clear(tile);
    if (world->plan->options.method == MT_METHOD_RAY) {
        mt_trace_triangles(&frame, &world->occluder, tile);
        return;
    }
    const mt_bins *bins = &world->bins;
    size_t number = (size_t)(tile->y / MT_TILE_SIZE) * bins->tiles_x + tile->x / MT_TILE_SIZE;
    size_t first = bins->firsts[number], count = bins->firsts[number + 1] - first;
    mt_draw_triangles(&frame, tile, bins->large, bins->large_count);
    mt_draw_triangles(&frame, tile, bins->numbers + first, count);
}

mt_scene_hit mt_scene_world_hit(const mt_scene_world *world, const mt_sampling *sampling, mt_index number, uint32_t x,
                                uint32_t y, unsigned sample)
{
    mt_scene_hit hit = mt_scene_no_hit();
    if (number == MT_NONE) {
        return hit;
    }
    mt_ray_setup setup;
    mt_ray_hit found;
    const mt_ray ray =
        mt_hit_ray(mt_camera_ray_at(&world->frame.camera, x + (double)sampling->x[sample] * (1.0 / MT_STEPS),
                                    y + (double)sampling->y[sample] * (1.0 / MT_STEPS)));
    mt_ray_setup_init(&world->model->space, &ray, world->frame.profile, &setup);
    if (!mt_hit(world->model, &setup, number, &found)) {
        return hit;
    }
    mt_index low = 0, high = world->item_count;
    while (high - low > 1) {
        mt_index middle = low + (high - low) / 2;
        *(world->firsts[middle] <= number ? &low : &high) = middle;
    }
    mt_index item = world->items[low], triangle = number - world->firsts[low];
    bool is_loose = item >= world->plan->scene->object_count;
    hit.t = (found.t + world->shift) / scale_of(world->model);
    hit.object = is_loose ? world->plan->loose_objects[triangle] : item;
    hit.triangle = triangle;
    memcpy(hit.weights, found.weights, sizeof hit.weights);
    return hit;
}
