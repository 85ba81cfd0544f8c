// A mesh that rays are shot at, ours and Embree's, and the rays of a picture and of what is seen by reflection.
#pragma once

#include "tests/bench/bench.hpp"

#include <embree3/rtcore.h>

#include <vector>

namespace bench
{

using Rays = std::vector<mt_ray>;

// Medium quality, robust; not committed yet.
RTCScene embree_scene(RTCDevice device, const mt_mesh *mesh);

// A wavy torus in float with its tree and Embree's.
struct RayTarget {
    mt_mesh *mesh;
    mt_triangulation triangulation{};
    mt_surface_tree *tree = nullptr;
    RTCDevice device = rtcNewDevice("threads=1,set_affinity=0");
    RTCScene scene = nullptr;

    explicit RayTarget(std::uint64_t faces);
    ~RayTarget();
    RayTarget(const RayTarget &) = delete;
    RayTarget &operator=(const RayTarget &) = delete;

    mt_ray_hit ours(const mt_ray &ray) const; // watertight, through the tree
    bool theirs(const mt_ray &ray) const;
};

// Pixel centres of a square picture, row by row.
Rays primary_rays(int size);

// From where those hit, in random directions away from the surface, in a random order.
Rays bounce_rays(const RayTarget &target, const Rays &primary);

} // namespace bench
