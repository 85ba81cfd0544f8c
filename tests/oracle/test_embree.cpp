// Our nearest hits beside those of Embree 3 (robust): the same triangle, or the same t within its error, on random rays
// at every mesh; and that neither sees anything where the other does not, but at edges and vertices, where it may leak.
#include "tests/oracle/mesh_files.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <cstring>
#include <random>

namespace
{

struct Target {
    mt_context *context;
    mt_mesh *mesh;
    mt_triangulation triangulation{};
    mt_surface_tree *tree = nullptr;
    RTCScene scene = nullptr;
};

// Positions as floats on both sides, so that both see the same mesh.
bool prepare(Target &target, RTCDevice device)
{
    if (mt_mesh_set_position_type(target.context, target.mesh, MT_F32, nullptr) != MT_OK ||
        mt_triangulation_init(target.context, target.mesh, &target.triangulation) != MT_OK ||
        mt_surface_tree_create(target.context, target.mesh, &target.triangulation, nullptr, &target.tree) != MT_OK) {
        return false;
    }
    target.scene = rtcNewScene(device);
    rtcSetSceneFlags(target.scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *vertices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, target.mesh->vertex_count);
    std::memcpy(vertices, target.mesh->positions, 12 * static_cast<std::size_t>(target.mesh->vertex_count));
    auto *faces = static_cast<mt_index *>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                  12, target.triangulation.triangle_count));
    for (mt_index t = 0; t < target.triangulation.triangle_count; t++) {
        for (mt_index side = 0; side < 3; side++) {
            faces[3 * t + side] = target.mesh->corner_vertices[mt_triangulation_corner(&target.triangulation, t, side)];
        }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(target.scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(target.scene);
    return true;
}

// Whole floats, so that both shoot the same ray.
mt_ray random_ray(const mt_bounds &bounds, std::mt19937 &random)
{
    std::uniform_real_distribution<float> unit(0, 1);
    mt_vec3 size = mt_vec3_subtract(bounds.maximum, bounds.minimum);
    double reach = mt_vec3_max_abs(size);
    mt_vec3 middle = mt_vec3_scale(mt_vec3_add(bounds.minimum, bounds.maximum), 0.5);
    mt_vec3 ends[2];
    for (int i = 0; i < 2; i++) {
        double scale = reach * (i ? 1 : 3);
        ends[i] =
            mt_vec3_add(middle, mt_vec3_scale({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5}, scale));
    }
    mt_vec3 d = mt_vec3_subtract(ends[1], ends[0]);
    mt_vec3 origin = {(float)ends[0].x, (float)ends[0].y, (float)ends[0].z};
    return mt_ray_make(origin, {(float)d.x, (float)d.y, (float)d.z});
}

struct Counts {
    long long same = 0, tied = 0, missed_by_one = 0, wrong = 0;
};

void compare_ray(const Target &target, const mt_ray &ray, Counts &counts)
{
    mt_ray_hit hit;
    bool found = mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_WATERTIGHT, &hit);
    RTCIntersectContext how;
    rtcInitIntersectContext(&how);
    RTCRayHit one{};
    one.ray = {(float)ray.origin.x,
               (float)ray.origin.y,
               (float)ray.origin.z,
               0,
               (float)ray.direction.x,
               (float)ray.direction.y,
               (float)ray.direction.z,
               0,
               INFINITY,
               0xffffffffu,
               0,
               0};
    one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    one.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(target.scene, &how, &one);
    bool theirs = one.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    if (found && theirs && hit.triangle != one.hit.primID) {
        // theirs has an error of its own: floats of the mesh's coordinates, divided by how much the ray grazes
        mt_ray_setup setup;
        mt_ray_triangle triangle;
        mt_ray_setup_init(mt_surface_tree_space(target.tree), &ray, MT_RAY_WATERTIGHT, &setup);
        mt_ray_triangle_load(mt_surface_tree_space(target.tree), target.mesh, &target.triangulation, hit.triangle,
                             MT_RAY_WATERTIGHT, &triangle);
        double error = 4 * mt_ray_hit_error(&setup, &triangle) + 1e-5 * hit.t;
        std::fabs(hit.t - one.ray.tfar) <= error ? counts.tied++ : counts.wrong++;
    } else if (found != theirs) {
        counts.missed_by_one++;
    } else {
        counts.same++;
    }
}

} // namespace

int main()
{
    Tally tally;
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    mt_context *context = mt_context_create(nullptr);
    const int count = 20000;
    for (const std::string &file : mesh_files()) {
        Target target{context, nullptr};
        if (mt_mesh_read_file(context, file.c_str(), nullptr, &target.mesh, nullptr) != MT_OK) {
            mt_context_clear_error(context);
            continue;
        }
        mt_bounds bounds = mt_mesh_bounds(target.mesh);
        bool usable = target.mesh->face_count && !bounds.non_finite_count &&
                      mt_vec3_max_abs(mt_vec3_subtract(bounds.maximum, bounds.minimum)) < 1e15;
        if (usable && prepare(target, device)) {
            Counts counts;
            std::mt19937 random(1);
            bounds = mt_mesh_bounds(target.mesh);
            for (int i = 0; i < count; i++) {
                compare_ray(target, random_ray(bounds, random), counts);
            }
            std::string numbers = std::to_string(counts.same) + " same, " + std::to_string(counts.tied) +
                                  " at the same t, " + std::to_string(counts.missed_by_one) + " seen by one, " +
                                  std::to_string(counts.wrong) + " wrong";
            tally.expect(counts.wrong == 0 && counts.missed_by_one <= count / 1000, file + ": " + numbers);
        }
        if (target.scene) {
            rtcReleaseScene(target.scene);
        }
        mt_surface_tree_destroy(context, target.tree);
        mt_triangulation_release(context, &target.triangulation);
        mt_mesh_destroy(context, target.mesh);
    }
    mt_context_destroy(context);
    rtcReleaseDevice(device);
    return tally.conclude();
}
