// The tree's building and single rays beside Embree 3: medium quality, robust, rtcIntersect1, one thread. The error
// column of ray rows counts ours that miss a closed mesh when aimed from inside at its vertices; the note has Embree's.
#include "tests/bench/bench.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <random>

namespace bench
{
namespace
{

RTCScene new_scene(RTCDevice device, const mt_mesh *mesh)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto *vertices = static_cast<float *>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh->vertex_count));
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        vertices[3 * v] = static_cast<float>(p.x);
        vertices[3 * v + 1] = static_cast<float>(p.y);
        vertices[3 * v + 2] = static_cast<float>(p.z);
    }
    void *faces = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh->face_count);
    std::memcpy(faces, mesh->corner_vertices, 12 * static_cast<std::size_t>(mesh->face_count));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    return scene;
}

RTCRayHit embree_ray(const mt_ray &ray)
{
    RTCRayHit one{};
    one.ray.org_x = static_cast<float>(ray.origin.x);
    one.ray.org_y = static_cast<float>(ray.origin.y);
    one.ray.org_z = static_cast<float>(ray.origin.z);
    one.ray.dir_x = static_cast<float>(ray.direction.x);
    one.ray.dir_y = static_cast<float>(ray.direction.y);
    one.ray.dir_z = static_cast<float>(ray.direction.z);
    one.ray.tfar = INFINITY;
    one.ray.mask = 0xffffffffu;
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return one;
}

struct Target {
    mt_mesh *mesh;
    mt_triangulation triangulation{};
    mt_surface_tree *tree = nullptr;
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene scene = nullptr;

    explicit Target(std::uint64_t faces) : mesh(wavy_torus(faces, false, false))
    {
        mt_context *context = shared_context();
        require(context, mt_mesh_set_position_type(context, mesh, MT_F32, nullptr));
        require(context, mt_triangulation_init(context, mesh, &triangulation));
        require(context, mt_surface_tree_create(context, mesh, &triangulation, nullptr, &tree));
        scene = new_scene(device, mesh);
        rtcCommitScene(scene);
    }
    ~Target()
    {
        mt_context *context = shared_context();
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
        mt_surface_tree_destroy(context, tree);
        mt_triangulation_release(context, &triangulation);
        mt_mesh_destroy(context, mesh);
    }
    Target(const Target &) = delete;
    Target &operator=(const Target &) = delete;

    mt_ray_hit ours(const mt_ray &ray) const
    {
        mt_ray_hit hit;
        mt_surface_tree_nearest_hit(tree, &ray, MT_RAY_WATERTIGHT, &hit);
        return hit;
    }
    bool theirs(const mt_ray &ray) const
    {
        RTCIntersectContext how;
        rtcInitIntersectContext(&how);
        RTCRayHit one = embree_ray(ray);
        rtcIntersect1(scene, &how, &one);
        return one.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
};

using Rays = std::vector<mt_ray>;

// Pixel centres of a square picture, row by row.
Rays primary_rays(int size)
{
    mt_vec3 eye = {0.3, -2.6, 2.2}, forward = mt_vec3_normalize(mt_vec3_scale(eye, -1));
    mt_vec3 right = mt_vec3_normalize(mt_vec3_cross(forward, mt_vec3_make(0, 0, 1)));
    mt_vec3 up = mt_vec3_cross(right, forward);
    Rays rays;
    for (int i = 0; i < size * size; i++) {
        double x = 0.45 * ((i % size + 0.5) / size * 2 - 1), y = 0.45 * (1 - (i / size + 0.5) / size * 2);
        mt_vec3 aside = mt_vec3_add(mt_vec3_scale(right, x), mt_vec3_scale(up, y));
        rays.push_back(mt_ray_make(eye, mt_vec3_add(forward, aside)));
    }
    return rays;
}

mt_vec3 corner_of(const mt_mesh *mesh, mt_index corner)
{
    return mt_mesh_position(mesh, mesh->corner_vertices[corner]);
}

// From where those hit, in random directions away from the surface, in a random order.
Rays bounce_rays(const Target &target, const Rays &primary)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    Rays rays;
    for (const mt_ray &ray : primary) {
        mt_ray_hit hit = target.ours(ray);
        if (hit.triangle == MT_NONE) {
            continue;
        }
        mt_vec3 a = corner_of(target.mesh, 3 * hit.triangle);
        mt_vec3 ab = mt_vec3_subtract(corner_of(target.mesh, 3 * hit.triangle + 1), a);
        mt_vec3 ac = mt_vec3_subtract(corner_of(target.mesh, 3 * hit.triangle + 2), a);
        mt_vec3 normal = mt_vec3_normalize(mt_vec3_cross(ab, ac));
        normal = mt_vec3_scale(normal, mt_vec3_dot(normal, ray.direction) > 0 ? -1 : 1);
        mt_vec3 away = {unit(random), unit(random), unit(random)};
        away = mt_vec3_scale(away, mt_vec3_dot(away, normal) < 0 ? -1 : 1);
        mt_vec3 start = mt_ray_offset(mt_surface_tree_space(target.tree), mt_ray_at(&ray, hit.t), normal);
        rays.push_back(mt_ray_make(start, away));
    }
    std::shuffle(rays.begin(), rays.end(), random);
    return rays;
}

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
    const Target *target;
    const Rays *rays;
};

void shoot_block(void *user, std::uint64_t begin, std::uint64_t end)
{
    auto *shooting = static_cast<Shooting *>(user);
    for (std::uint64_t i = begin; i < end; i++) {
        shooting->target->ours((*shooting->rays)[i]);
    }
}

void compare_rays(const char *name, const Target &target, const Rays &rays, const std::string &note, double misses)
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

void compare_building(const Target &target)
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
            RTCScene scene = new_scene(target.device, target.mesh);
            rtcCommitScene(scene);
            rtcReleaseScene(scene);
        });
}

} // namespace

void run_rays()
{
    for (std::uint64_t size : sizes) {
        Target target(size);
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
