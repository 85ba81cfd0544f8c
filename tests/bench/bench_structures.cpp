// Every structure that rays can search, beside Embree 3 (medium quality, robust, rtcIntersect1, one thread): building,
// the coherent rays of a picture, and what they see by reflection, in no order. The error column of ray rows counts
// those whose triangle differs from the tree's.
#include "tests/bench/ray_target.hpp"

#include <meshtool/ray_structure.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace bench
{
namespace
{

const std::uint64_t face_counts[] = {1000, 10000, 100000, 1000000};

// Triangles asked in a run by brute force, where every ray asks all.
const std::uint64_t most_asked = 100000000;

struct Search {
    const mt_ray_structure *structure;
    const Rays *rays;
};

void search_block(void *user, std::uint64_t begin, std::uint64_t end)
{
    auto *search = static_cast<Search *>(user);
    mt_ray_hit hit;
    for (std::uint64_t i = begin; i < end; i++) {
        mt_ray_structure_nearest_hit(search->structure, &(*search->rays)[i], MT_RAY_WATERTIGHT, &hit);
    }
}

std::string text_of(const char *format, double number)
{
    char text[64];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

mt_ray_structure *build(mt_context *context, const RayTarget &target, mt_ray_structure_kind kind)
{
    mt_ray_structure *structure = nullptr;
    require(context,
            mt_ray_structure_create(context, target.mesh, &target.triangulation, kind, MT_BUILD_BALANCED, &structure));
    return structure;
}

Row row_of(const std::string &name, const RayTarget &target, mt_ray_structure_kind kind)
{
    Row row;
    row.name = name + " " + mt_ray_structure_name(kind);
    row.faces = target.mesh->face_count;
    row.peer = "Embree";
    return row;
}

void compare_building(const RayTarget &target, mt_ray_structure_kind kind, const mt_ray_structure *structure)
{
    Row row = row_of("build", target, kind);
    double size = static_cast<double>(mt_ray_structure_size(structure));
    row.mesh = "torus";
    row.note = text_of("%.0f bytes a triangle", size / target.mesh->face_count);
    compare_once(
        row, [&](mt_context *context) { mt_ray_structure_destroy(context, build(context, target, kind)); },
        [&] {
            RTCScene scene = embree_scene(target.device, target.mesh);
            rtcCommitScene(scene);
            rtcReleaseScene(scene);
        });
}

double count_differences(const RayTarget &target, const mt_ray_structure *structure, const Rays &rays)
{
    double count = 0;
    for (const mt_ray &ray : rays) {
        mt_ray_hit hit;
        mt_ray_structure_nearest_hit(structure, &ray, MT_RAY_WATERTIGHT, &hit);
        count += hit.triangle != target.ours(ray).triangle;
    }
    return count;
}

double seconds_of(Search &search)
{
    auto begin = std::chrono::steady_clock::now();
    search_block(&search, 0, search.rays->size());
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void compare_rays(const char *name, const RayTarget &target, const mt_ray_structure *structure, const Rays &rays)
{
    Search search{structure, &rays};
    Row row = row_of(name, target, mt_ray_structure_kind_of(structure));
    row.mesh = std::to_string(rays.size()) + " rays";
    row.error = count_differences(target, structure, rays);
    row.note = text_of("%.3f million rays a second", 1e-6 * static_cast<double>(rays.size()) / seconds_of(search));
    auto ours = [&](mt_context *context) { mt_parallel_for(context, rays.size(), 1024, search_block, &search); };
    auto theirs = [&] {
        for (const mt_ray &ray : rays) {
            target.theirs(ray);
        }
    };
    compare_once(row, ours, theirs);
}

Rays first_of(const Rays &rays, std::uint64_t count)
{
    std::uint64_t size = rays.size();
    return Rays(rays.begin(), rays.begin() + static_cast<std::ptrdiff_t>(std::min(size, count)));
}

void compare_structure(const RayTarget &target, mt_ray_structure_kind kind, const Rays &primary, const Rays &bounce)
{
    mt_ray_structure *structure = build(shared_context(), target, kind);
    compare_building(target, kind, structure);
    std::uint64_t count = kind == MT_RAY_STRUCTURE_NONE ? most_asked / target.mesh->face_count : primary.size();
    compare_rays("primary", target, structure, first_of(primary, count));
    compare_rays("bounce", target, structure, first_of(bounce, count));
    mt_ray_structure_destroy(shared_context(), structure);
}

} // namespace

void run_structures()
{
    for (std::uint64_t face_count : face_counts) {
        RayTarget target(face_count);
        Rays primary = primary_rays(256), bounce = bounce_rays(target, primary);
        for (int kind = 0; kind < MT_RAY_STRUCTURE_COUNT; kind++) {
            compare_structure(target, static_cast<mt_ray_structure_kind>(kind), primary, bounce);
        }
    }
}

} // namespace bench
