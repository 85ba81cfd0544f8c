// The sum of the neighbours' positions at every vertex, around each vertex through each structure and a plain list of
// neighbours, and by the functions for such sums, which pass over the structure once; beside OpenMesh's circulator.
#include "tests/bench/bench.hpp"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>

namespace bench
{
namespace
{

struct Doubles : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<Doubles>;

// Everything that is walked; built before the clock runs.
struct Ring {
    const mt_mesh *mesh = nullptr;
    const double *positions = nullptr;
    mt_halfedge_mesh *halfedges = nullptr;
    mt_winged_edge_mesh *winged = nullptr;
    mt_triangle_neighbor_mesh *triangles = nullptr;
    std::vector<mt_index> list, list_begins;
    OpenMeshMesh peer;
    mutable std::vector<mt_vec3> sums;
    std::vector<mt_vec3> peer_sums;
};

inline void add(mt_vec3 &sum, const double *positions, mt_index vertex)
{
    const double *p = positions + 3 * std::size_t(vertex);
    sum.x += p[0];
    sum.y += p[1];
    sum.z += p[2];
}

void by_halfedges(void *user, std::uint64_t begin, std::uint64_t end)
{
    const Ring &ring = *static_cast<const Ring *>(user);
    for (std::uint64_t v = begin; v < end; v++) {
        mt_vec3 sum = {0, 0, 0};
        mt_index first = ring.halfedges->vertex_halfedge[v], h = first;
        do {
            add(sum, ring.positions, mt_halfedge_tail(ring.halfedges, h));
            h = mt_halfedge_clockwise(ring.halfedges, h);
        } while (h != first);
        ring.sums[v] = sum;
    }
}

void by_winged_edges(void *user, std::uint64_t begin, std::uint64_t end)
{
    const Ring &ring = *static_cast<const Ring *>(user);
    for (std::uint64_t v = begin; v < end; v++) {
        mt_vec3 sum = {0, 0, 0};
        for (mt_winged_ring at = mt_winged_ring_begin(ring.winged, mt_index(v)); mt_winged_ring_goes_on(&at);
             mt_winged_ring_counterclockwise(ring.winged, &at)) {
            add(sum, ring.positions, at.neighbor);
        }
        ring.sums[v] = sum;
    }
}

void by_triangles(void *user, std::uint64_t begin, std::uint64_t end)
{
    const Ring &ring = *static_cast<const Ring *>(user);
    for (std::uint64_t v = begin; v < end; v++) {
        mt_vec3 sum = {0, 0, 0};
        for (mt_triangle_ring at = mt_triangle_ring_begin(ring.triangles, mt_index(v)); mt_triangle_ring_goes_on(&at);
             mt_triangle_ring_counterclockwise(ring.triangles, &at)) {
            add(sum, ring.positions, at.neighbor);
        }
        ring.sums[v] = sum;
    }
}

void by_list(void *user, std::uint64_t begin, std::uint64_t end)
{
    const Ring &ring = *static_cast<const Ring *>(user);
    for (std::uint64_t v = begin; v < end; v++) {
        mt_vec3 sum = {0, 0, 0};
        for (mt_index i = ring.list_begins[v]; i < ring.list_begins[v + 1]; i++) {
            add(sum, ring.positions, ring.list[i]);
        }
        ring.sums[v] = sum;
    }
}

void by_openmesh(Ring &ring)
{
    for (auto vertex : ring.peer.vertices()) {
        OpenMesh::Vec3d sum(0, 0, 0);
        for (auto at = ring.peer.cvv_begin(vertex); at.is_valid(); ++at) {
            sum += ring.peer.point(*at);
        }
        ring.peer_sums[std::size_t(vertex.idx())] = mt_vec3_make(sum[0], sum[1], sum[2]);
    }
}

void fill_list(Ring &ring)
{
    ring.list_begins.push_back(0);
    for (mt_index v = 0; v < ring.mesh->vertex_count; v++) {
        for (mt_triangle_ring at = mt_triangle_ring_begin(ring.triangles, v); mt_triangle_ring_goes_on(&at);
             mt_triangle_ring_counterclockwise(ring.triangles, &at)) {
            ring.list.push_back(at.neighbor);
        }
        ring.list_begins.push_back(mt_index(ring.list.size()));
    }
}

void fill_peer(Ring &ring)
{
    ring.peer.reserve(ring.mesh->vertex_count, ring.mesh->corner_count / 2, ring.mesh->face_count);
    std::vector<OpenMeshMesh::VertexHandle> handles(ring.mesh->vertex_count);
    for (mt_index v = 0; v < ring.mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(ring.mesh, v);
        handles[v] = ring.peer.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
    }
    const mt_index *corner = ring.mesh->corner_vertices;
    for (mt_index face = 0; face < ring.mesh->face_count; face++, corner += 3) {
        ring.peer.add_face(handles[corner[0]], handles[corner[1]], handles[corner[2]]);
    }
}

double largest_difference(const Ring &ring)
{
    double largest = 0;
    for (std::size_t v = 0; v < ring.sums.size(); v++) {
        largest = std::max(largest, mt_vec3_max_abs(mt_vec3_subtract(ring.sums[v], ring.peer_sums[v])));
    }
    return largest;
}

struct Walk {
    const char *name;
    mt_parallel_body body;
};
const Walk walks[] = {
    {"one-ring half-edges", by_halfedges},
    {"one-ring winged", by_winged_edges},
    {"one-ring triangles", by_triangles},
    {"one-ring plain list", by_list},
};

double *sums_of(const Ring &ring)
{
    return &ring.sums[0].x;
}

// On one thread, whatever the context: it is not used.
const struct {
    const char *name;
    void (*sum)(const Ring &ring);
} passes[] = {
    {"neighbour sums half-edges",
     [](const Ring &ring) { mt_halfedge_sum_neighbors(ring.halfedges, ring.positions, 3, sums_of(ring)); }},
    {"neighbour sums triangles",
     [](const Ring &ring) { mt_triangle_neighbor_sum_neighbors(ring.triangles, ring.positions, 3, sums_of(ring)); }},
};

void compare_on(std::uint64_t size, bool shuffled)
{
    mt_context *context = shared_context();
    mt_mesh *mesh = wavy_torus(size, false, shuffled);
    Ring ring;
    ring.mesh = mesh;
    ring.positions = static_cast<const double *>(mesh->positions);
    require(context, mt_halfedge_create(context, mesh, &ring.halfedges));
    require(context, mt_winged_edge_create(context, mesh, &ring.winged));
    require(context, mt_triangle_neighbor_create(context, mesh, &ring.triangles));
    ring.sums.resize(mesh->vertex_count);
    ring.peer_sums.resize(mesh->vertex_count);
    fill_list(ring);
    fill_peer(ring);
    by_openmesh(ring);
    Row row;
    row.mesh = shuffled ? "torus shuffled" : "torus";
    row.faces = mesh->face_count;
    row.peer = "OpenMesh";
    for (const Walk &walk : walks) {
        row.name = walk.name;
        walk.body(&ring, 0, mesh->vertex_count);
        row.error = largest_difference(ring);
        auto ours = [&](mt_context *with) { mt_parallel_for(with, mesh->vertex_count, 8192, walk.body, &ring); };
        compare(row, ours, [&] { by_openmesh(ring); });
    }
    for (const auto &pass : passes) {
        row.name = pass.name;
        pass.sum(ring);
        row.error = largest_difference(ring);
        compare(
            row, [&](mt_context *) { pass.sum(ring); }, [&] { by_openmesh(ring); });
    }
    mt_halfedge_destroy(context, ring.halfedges);
    mt_winged_edge_destroy(context, ring.winged);
    mt_triangle_neighbor_destroy(context, ring.triangles);
    mt_mesh_destroy(context, mesh);
}

} // namespace

void run_one_ring()
{
    compare_on(100000, false);
    compare_on(1000000, false);
    compare_on(1000000, true);
}

} // namespace bench
