// Catmull-Clark level by level, beside OpenSubdiv's Far (topology and values), OpenMesh, CGAL, and a bare copy of as
// many bytes as must move. The error is the largest distance between the moved vertices of the cage, whose order all
// keep. OpenMesh's and CGAL's meshes are built beforehand; the pairing of edges is in our time and in OpenSubdiv's.
#include "tests/bench/bench.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>

namespace bench
{
namespace
{

template <class Real> using Point = std::array<Real, 3>;

// One run of a peer: refines so many levels and returns the cage's vertices where they came to be.
template <class Real> class OpenSubdivPeer
{
  public:
    static constexpr const char *name = "OpenSubdiv";

    explicit OpenSubdivPeer(const mt_mesh *mesh) : sides(mesh->face_count, static_cast<int>(mesh->face_size))
    {
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            indices.push_back(static_cast<int>(mesh->corner_vertices[corner]));
        }
        for (mt_index v = 0; v < mesh->vertex_count; v++) {
            mt_vec3 p = mt_mesh_position(mesh, v);
            cage.push_back({{static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}});
        }
        descriptor.numVertices = static_cast<int>(mesh->vertex_count);
        descriptor.numFaces = static_cast<int>(mesh->face_count);
        descriptor.numVertsPerFace = sides.data();
        descriptor.vertIndicesPerFace = indices.data();
    }

    std::vector<Point<Real>> refine(unsigned levels) const
    {
        using Descriptor = OpenSubdiv::Far::TopologyDescriptor;
        using Factory = OpenSubdiv::Far::TopologyRefinerFactory<Descriptor>;
        OpenSubdiv::Sdc::Options rules;
        rules.SetVtxBoundaryInterpolation(OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
        std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner(
            Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_CATMARK, rules)));
        refiner->RefineUniform(OpenSubdiv::Far::TopologyRefiner::UniformOptions(static_cast<int>(levels)));
        OpenSubdiv::Far::PrimvarRefinerReal<Real> values(*refiner);
        std::vector<Value> from = cage;
        for (int level = 1; level <= static_cast<int>(levels); level++) {
            std::vector<Value> to(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
            values.Interpolate(level, from, to);
            from.swap(to);
        }
        std::vector<Point<Real>> moved;
        for (std::size_t v = 0; v < cage.size(); v++) {
            moved.push_back(from[v].x);
        }
        return moved;
    }

  private:
    struct Value {
        Point<Real> x;

        void Clear(void * = nullptr)
        {
            x = {0, 0, 0};
        }

        void AddWithWeight(const Value &other, Real weight)
        {
            x[0] += weight * other.x[0];
            x[1] += weight * other.x[1];
            x[2] += weight * other.x[2];
        }
    };

    std::vector<int> sides, indices;
    std::vector<Value> cage;
    OpenSubdiv::Far::TopologyDescriptor descriptor;
};

// A fresh copy each run: the copy is part of the peer's time, as the new mesh is of ours.
template <class Real> class OpenMeshPeer
{
  public:
    static constexpr const char *name = "OpenMesh";

    explicit OpenMeshPeer(const mt_mesh *mesh) : cage_count(mesh->vertex_count)
    {
        for (mt_index v = 0; v < mesh->vertex_count; v++) {
            mt_vec3 p = mt_mesh_position(mesh, v);
            built.add_vertex(
                typename Mesh::Point(static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)));
        }
        for (mt_index corner = 0; corner < mesh->corner_count; corner += mesh->face_size) {
            std::vector<typename Mesh::VertexHandle> handles;
            for (mt_index k = 0; k < mesh->face_size; k++) {
                handles.emplace_back(static_cast<int>(mesh->corner_vertices[corner + k]));
            }
            built.add_face(handles);
        }
    }

    std::vector<Point<Real>> refine(unsigned levels) const
    {
        Mesh copy = built;
        OpenMesh::Subdivider::Uniform::CatmullClarkT<Mesh, Real> subdivider;
        subdivider.attach(copy);
        subdivider(levels);
        subdivider.detach();
        std::vector<Point<Real>> moved;
        for (std::size_t v = 0; v < cage_count; v++) {
            auto p = copy.point(typename Mesh::VertexHandle(static_cast<int>(v)));
            moved.push_back({p[0], p[1], p[2]});
        }
        return moved;
    }

  private:
    struct Traits : OpenMesh::DefaultTraits {
        using Point = OpenMesh::VectorT<Real, 3>;
    };
    using Mesh = OpenMesh::PolyMesh_ArrayKernelT<Traits>;
    Mesh built;
    std::size_t cage_count;
};

template <class Real> class CgalPeer
{
  public:
    static constexpr const char *name = "CGAL";

    explicit CgalPeer(const mt_mesh *mesh) : cage_count(mesh->vertex_count)
    {
        for (mt_index v = 0; v < mesh->vertex_count; v++) {
            mt_vec3 p = mt_mesh_position(mesh, v);
            built.add_vertex(
                typename Mesh::Point(static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)));
        }
        for (mt_index corner = 0; corner < mesh->corner_count; corner += mesh->face_size) {
            std::vector<typename Mesh::Vertex_index> handles;
            for (mt_index k = 0; k < mesh->face_size; k++) {
                handles.emplace_back(mesh->corner_vertices[corner + k]);
            }
            built.add_face(handles);
        }
    }

    std::vector<Point<Real>> refine(unsigned levels) const
    {
        Mesh copy = built;
        CGAL::Subdivision_method_3::CatmullClark_subdivision(copy, CGAL::parameters::number_of_iterations(levels));
        std::vector<Point<Real>> moved;
        for (std::size_t v = 0; v < cage_count; v++) {
            auto p = copy.point(typename Mesh::Vertex_index(static_cast<mt_index>(v)));
            moved.push_back({p.x(), p.y(), p.z()});
        }
        return moved;
    }

  private:
    using Mesh = CGAL::Surface_mesh<typename CGAL::Simple_cartesian<Real>::Point_3>;
    Mesh built;
    std::size_t cage_count;
};

mt_mesh *refine_ours(mt_context *context, const mt_mesh *mesh, unsigned levels)
{
    mt_subdivide_options options{};
    options.level_count = levels;
    mt_mesh *result = nullptr;
    require(context, mt_subdivide(context, mesh, &options, &result));
    return result;
}

template <class Peer> void compare_with(Row row, const mt_mesh *mesh, unsigned levels)
{
    Peer peer(mesh);
    mt_mesh *refined = refine_ours(shared_context(), mesh, levels);
    auto moved = peer.refine(levels);
    row.peer = Peer::name;
    row.error = 0;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(refined, v);
        row.error = std::max({row.error, std::abs(p.x - double(moved[v][0])), std::abs(p.y - double(moved[v][1])),
                              std::abs(p.z - double(moved[v][2]))});
    }
    mt_mesh_destroy(shared_context(), refined);
    compare(
        row, [&](mt_context *context) { mt_mesh_destroy(context, refine_ours(context, mesh, levels)); },
        [&] { peer.refine(levels); });
}

// Bytes that the last level must read and write: vertices, corners, twins and edge numbers of the level before;
// vertices and corners of the last. Levels before move a quarter of that, and so on.
std::uint64_t bytes_of_levels(const mt_mesh *mesh, unsigned levels)
{
    std::uint64_t faces = mesh->face_count, vertices = mesh->vertex_count, edges = mesh->corner_count / 2, bytes = 0;
    std::uint64_t size = 3 * mt_type_size(mesh->position_type);
    for (unsigned level = 1; level <= levels; level++) {
        std::uint64_t corners = 4 * faces, children = vertices + faces + edges;
        bytes += vertices * size + corners * 8 + faces * 4 + children * size + corners * 16;
        bytes += level < levels ? corners * 16 + corners * 4 : 0; // twins and edge numbers for the next level
        vertices = children;
        edges = 2 * edges + corners;
        faces = corners;
    }
    return bytes;
}

void compare_with_copy(Row row, const mt_mesh *mesh, unsigned levels)
{
    std::uint64_t half = bytes_of_levels(mesh, levels) / 2;
    std::vector<char> from(half, 1), to(half, 2);
    row.peer = "memcpy";
    row.note = "copies as many bytes as the levels must read and write";
    compare(
        row, [&](mt_context *context) { mt_mesh_destroy(context, refine_ours(context, mesh, levels)); },
        [&] { std::memcpy(to.data(), from.data(), half); });
}

// Peers other than OpenSubdiv up to `last_of_others`: they take seconds a run on the largest.
template <class Real> void compare_on(std::uint64_t size, unsigned last, unsigned last_of_others)
{
    mt_mesh *mesh = wavy_torus(size, true, false);
    bool narrow = sizeof(Real) == sizeof(float);
    if (narrow) {
        require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
    }
    for (unsigned level = 1; level <= last; level++) {
        Row row;
        row.name = "Catmull-Clark L" + std::to_string(level) + (narrow ? " f32" : " f64");
        row.mesh = std::to_string(mesh->face_count) + " quads";
        row.faces = std::uint64_t(mesh->face_count) << (2 * level);
        compare_with<OpenSubdivPeer<Real>>(row, mesh, level);
        if (level <= last_of_others) {
            compare_with<OpenMeshPeer<Real>>(row, mesh, level);
            compare_with<CgalPeer<Real>>(row, mesh, level);
        }
        if (level == last) {
            compare_with_copy(row, mesh, level);
        }
    }
    mt_mesh_destroy(shared_context(), mesh);
}

} // namespace

void run_subdivision()
{
    compare_on<double>(2500, 6, 6);
    compare_on<float>(2500, 6, 5);
    compare_on<double>(517000, 1, 1);
    compare_on<float>(517000, 1, 1);
}

} // namespace bench
