#include "tests/bench/ray_target.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

namespace bench
{
namespace
{

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

mt_vec3 corner_of(const mt_mesh *mesh, mt_index corner)
{
    return mt_mesh_position(mesh, mesh->corner_vertices[corner]);
}

} // namespace

RTCScene embree_scene(RTCDevice device, const mt_mesh *mesh)
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

RayTarget::RayTarget(std::uint64_t faces) : mesh(wavy_torus(faces, false, false))
{
    mt_context *context = shared_context();
    require(context, mt_mesh_set_position_type(context, mesh, MT_F32, nullptr));
    require(context, mt_triangulation_init(context, mesh, &triangulation));
    require(context, mt_surface_tree_create(context, mesh, &triangulation, nullptr, &tree));
    scene = embree_scene(device, mesh);
    rtcCommitScene(scene);
}

RayTarget::~RayTarget()
{
    mt_context *context = shared_context();
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    mt_surface_tree_destroy(context, tree);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
}

mt_ray_hit RayTarget::ours(const mt_ray &ray) const
{
    mt_ray_hit hit;
    mt_surface_tree_nearest_hit(tree, &ray, MT_RAY_WATERTIGHT, &hit);
    return hit;
}

bool RayTarget::theirs(const mt_ray &ray) const
{
    RTCIntersectContext how;
    rtcInitIntersectContext(&how);
    RTCRayHit one = embree_ray(ray);
    rtcIntersect1(scene, &how, &one);
    return one.hit.geomID != RTC_INVALID_GEOMETRY_ID;
}

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

Rays bounce_rays(const RayTarget &target, const Rays &primary)
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

} // namespace bench
