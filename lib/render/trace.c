#include "lib/render/trace.h"

#include <string.h>

#define VERTEX_BLOCK 65536

/* Vertices outside of what is drawn become NaN, so that they do not set the space of the rays. */
static void fill_positions(void *user, uint64_t begin, uint64_t end)
{
    const mt_occluder *occluder = (const mt_occluder *)user;
    const mt_model *model = occluder->model;
    double *positions = (double *)occluder->mesh.positions;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_vec3 p = mt_model_position(model, (mt_index)vertex), low = model->low, high = model->high;
        bool inside = p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
        positions[3 * vertex] = inside ? p.x : (double)NAN;
        positions[3 * vertex + 1] = inside ? p.y : (double)NAN;
        positions[3 * vertex + 2] = inside ? p.z : (double)NAN;
    }
}

mt_status mt_occluder_init(mt_context *context, const mt_model *model, mt_ray_profile profile,
                           mt_ray_structure_kind kind, mt_occluder *occluder)
{
    memset(occluder, 0, sizeof *occluder);
    occluder->model = model;
    occluder->profile = profile;
    mt_mesh *mesh = &occluder->mesh;
    mesh->vertex_count = model->mesh->vertex_count;
    mesh->face_count = model->mesh->face_count;
    mesh->corner_count = model->mesh->corner_count;
    mesh->face_offsets = model->mesh->face_offsets;
    mesh->corner_vertices = model->mesh->corner_vertices;
    mesh->position_type = MT_F64;
    mesh->positions = mt_allocate_array(context, mesh->vertex_count, 3 * sizeof(double));
    if (!mesh->positions) {
        return mt_context_error(context)->status;
    }
    mt_parallel_for(context, mesh->vertex_count, VERTEX_BLOCK, fill_positions, occluder);
    mt_status status =
        mt_ray_structure_create(context, mesh, &model->triangulation, kind, MT_BUILD_BALANCED, &occluder->structure);
    if (status != MT_OK) {
        mt_occluder_release(context, occluder);
    }
    return status;
}

void mt_occluder_release(mt_context *context, mt_occluder *occluder)
{
    mt_ray_structure_destroy(context, occluder->structure);
    mt_free(context, occluder->mesh.positions);
    memset(occluder, 0, sizeof *occluder);
}

bool mt_occluder_hides(const mt_occluder *occluder, const mt_ray *ray)
{
    return mt_ray_structure_any_hit(occluder->structure, ray, occluder->profile);
}

static void trace_pixel(const mt_frame *frame, const mt_occluder *occluder, mt_tile *tile, uint32_t x, uint32_t y)
{
    const mt_sampling *sampling = &frame->sampling;
    size_t first = mt_tile_lane(tile, x, y);
    for (unsigned lane = 0; lane < sampling->lane_count; lane++) {
        if (lane >= sampling->sample_count) { /* repeats the first */
            tile->numbers[first + lane] = tile->numbers[first];
            continue;
        }
        const mt_ray ray = mt_hit_ray(mt_frame_ray(frame, x, y, lane));
        mt_ray_hit hit;
        mt_ray_structure_nearest_hit(occluder->structure, &ray, occluder->profile, &hit);
        tile->numbers[first + lane] = hit.triangle;
    }
}

void mt_trace_triangles(const mt_frame *frame, const mt_occluder *occluder, mt_tile *tile)
{
    for (uint32_t y = tile->y; y < tile->y + tile->height; y++) {
        for (uint32_t x = tile->x; x < tile->x + tile->width; x++) {
            if (!tile->wanted || tile->wanted[mt_tile_pixel(tile, x, y)]) {
                trace_pixel(frame, occluder, tile, x, y);
            }
        }
    }
}
