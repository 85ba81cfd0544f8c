// Which triangle each sample of a picture shows, triangle by triangle and ray by ray, from a thousand triangles to ten
// million. The error counts pixels that differ. The note says from how many rays on building the tree takes less time
// than asking every triangle would.
#include "tests/bench/ray_target.hpp"

#include <meshtool/ray_structure.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace bench
{
namespace
{

const std::uint64_t face_counts[] = {1000, 10000, 100000, 1000000, 10000000};
constexpr std::uint32_t side = 1024;
// Triangles asked to learn how long asking one takes.
constexpr std::uint64_t asked = 20'000'000;

mt_image *draw(mt_context *context, const mt_mesh *mesh, mt_visibility_method method)
{
    mt_preview_options options{};
    options.width = options.height = side;
    options.samples = 1;
    options.method = method;
    mt_image *image = nullptr;
    require(context, mt_preview(context, mesh, &options, &image));
    return image;
}

double count_differences(const mt_mesh *mesh)
{
    mt_image *raster = draw(shared_context(), mesh, MT_METHOD_RASTER);
    mt_image *rays = draw(shared_context(), mesh, MT_METHOD_RAY);
    double count = 0;
    for (std::size_t pixel = 0; pixel < std::size_t{side} * side; pixel++) {
        const float *a = raster->pixels + pixel * raster->channel_count,
                    *b = rays->pixels + pixel * rays->channel_count;
        count += std::memcmp(a, b, raster->channel_count * sizeof *a) != 0;
    }
    mt_image_destroy(shared_context(), raster);
    mt_image_destroy(shared_context(), rays);
    return count;
}

double now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double seconds_a_ray(const mt_ray_structure *structure, const Rays &rays, std::size_t count)
{
    double begin = now();
    for (std::size_t i = 0; i < count; i++) {
        mt_ray_hit hit;
        mt_ray_structure_nearest_hit(structure, &rays[i * (rays.size() / count)], MT_RAY_WATERTIGHT, &hit);
    }
    return (now() - begin) / static_cast<double>(count);
}

// A structure over the mesh, and the seconds that building it took.
mt_ray_structure *build(const mt_mesh *mesh, const mt_triangulation *triangulation, mt_ray_structure_kind kind,
                        double *seconds)
{
    mt_ray_structure *structure = nullptr;
    double begin = now();
    require(shared_context(),
            mt_ray_structure_create(shared_context(), mesh, triangulation, kind, MT_BUILD_BALANCED, &structure));
    *seconds = now() - begin;
    return structure;
}

// One thread: what the tree costs more to build, over what a ray through it costs less.
double rays_that_pay(const mt_mesh *mesh)
{
    mt_triangulation triangulation{};
    require(shared_context(), mt_triangulation_init(shared_context(), mesh, &triangulation));
    double tree_seconds = 0, none_seconds = 0;
    mt_ray_structure *tree = build(mesh, &triangulation, MT_RAY_STRUCTURE_AABB, &tree_seconds);
    mt_ray_structure *none = build(mesh, &triangulation, MT_RAY_STRUCTURE_NONE, &none_seconds);
    const Rays rays = primary_rays(256);
    std::size_t few = std::max<std::size_t>(2, std::min<std::size_t>(rays.size(), asked / mesh->face_count));
    double saved = seconds_a_ray(none, rays, few) - seconds_a_ray(tree, rays, rays.size());
    mt_ray_structure_destroy(shared_context(), tree);
    mt_ray_structure_destroy(shared_context(), none);
    mt_triangulation_release(shared_context(), &triangulation);
    return std::ceil((tree_seconds - none_seconds) / saved);
}

} // namespace

void run_visibility()
{
    for (std::uint64_t face_count : face_counts) {
        mt_mesh *mesh = wavy_torus(face_count, false, false);
        require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
        char note[64];
        std::snprintf(note, sizeof note, "a tree pays from %.0f rays on", rays_that_pay(mesh));
        Row row;
        row.name = "1,048,576 samples by raster";
        row.mesh = "torus";
        row.faces = mesh->face_count;
        row.peer = "our rays";
        row.error = count_differences(mesh);
        row.note = note;
        compare_once(
            row, [&](mt_context *context) { mt_image_destroy(context, draw(context, mesh, MT_METHOD_RASTER)); },
            [&] { mt_image_destroy(shared_context(), draw(shared_context(), mesh, MT_METHOD_RAY)); });
        mt_mesh_destroy(shared_context(), mesh);
    }
}

} // namespace bench
