// The tree's building and single rays beside Embree 3: medium quality, robust, rtcIntersect1, one thread. The error
// column of ray rows counts ours that miss a closed mesh when aimed from inside at its vertices; the note has Embree's.
#include "tests/bench/ray_target.hpp"

#include <cmath>

namespace bench
{
namespace
{

// From points of the torus' core circle at each vertex: all must hit.
Rays probe_rays(const mt_mesh *mesh, std::size_t count)
{
    Rays rays;
    for (std::size_t i = 0; i < count; i++) {
        mt_vec3 p = mt_mesh_position(mesh, static_cast<mt_index>(i % mesh->vertex_count));
        double length = std::sqrt(p.x * p.x + p.y * p.y), jitter = 0.1 * std::sin(static_cast<double>(i));
        mt_vec3 core = {p.x / length + jitter, p.y / length, jitter / 3};
        rays.push_back(mt_ray_make(core, mt_vec3_subtract(p, core)));
    }
    return rays;
}

struct Shooting {
    const RayTarget *target;
    const Rays *rays;
};

void shoot_block(void *user, std::uint64_t begin, std::uint64_t end)
{
    auto *shooting = static_cast<Shooting *>(user);
    for (std::uint64_t i = begin; i < end; i++) {
        shooting->target->ours((*shooting->rays)[i]);
    }
}

void compare_rays(const char *name, const RayTarget &target, const Rays &rays, const std::string &note, double misses)
{
    Row row;
    row.name = name;
    row.mesh = std::to_string(rays.size()) + " rays";
    row.faces = target.mesh->face_count;
    row.peer = "Embree";
    row.error = misses;
    row.note = note;
    compare(
        row,
        [&](mt_context *context) {
            Shooting shooting{&target, &rays};
            mt_parallel_for(context, rays.size(), 4096, shoot_block, &shooting);
        },
        [&] {
            for (const mt_ray &ray : rays) {
                target.theirs(ray);
            }
        });
}

void compare_building(const RayTarget &target)
{
    Row row;
    row.name = "ray tree";
    row.mesh = "torus";
    row.faces = target.mesh->face_count;
    row.peer = "Embree";
    row.note = std::to_string(static_cast<double>(mt_surface_tree_size(target.tree)) / target.mesh->face_count) +
               " bytes a triangle";
    compare(
        row,
        [&](mt_context *context) {
            mt_surface_tree *tree = nullptr;
            require(context, mt_surface_tree_create(context, target.mesh, &target.triangulation, nullptr, &tree));
            mt_surface_tree_destroy(context, tree);
        },
        [&] {
            RTCScene scene = embree_scene(target.device, target.mesh);
            rtcCommitScene(scene);
            rtcReleaseScene(scene);
        });
}

} // namespace

void run_rays()
{
    for (std::uint64_t size : sizes) {
        RayTarget target(size);
        Rays primary = primary_rays(512), bounce = bounce_rays(target, primary);
        Rays probe = probe_rays(target.mesh, 1000000);
        std::size_t ours = 0, theirs = 0;
        for (const mt_ray &ray : probe) {
            ours += target.ours(ray).triangle == MT_NONE;
            theirs += !target.theirs(ray);
        }
        std::string note = "misses of 1000000 at vertices; Embree " + std::to_string(theirs);
        compare_building(target);
        compare_rays("primary rays", target, primary, note, static_cast<double>(ours));
        compare_rays("bounce rays", target, bounce, note, static_cast<double>(ours));
    }
}

} // namespace bench
