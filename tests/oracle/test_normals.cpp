// Our normals beside those of CGAL and OpenMesh, as far as the definitions agree. Face normals are the same on
// triangles and on planar faces; of a polygon that is not planar OpenMesh takes Newell's area vector as we do, and CGAL
// the sum over a fan of triangles from a corner, which is the same vector. At vertices OpenMesh's
// calc_vertex_normal_fast is our uniform weight and calc_vertex_normal_correct, sums of cross products of the two sides
// at the vertex, our area weight on triangles, after whose lengths nothing is divided. CGAL's compute_vertex_normal
// seeks the direction that is as near as can be to the worst of the faces around: it weighs nothing, and agrees with no
// weight of ours; what can be said is that where all faces around share one normal both have that one, and that the
// worst angle to a face is no larger with CGAL's, which is what it minimises.
#include "tests/oracle/mesh_files.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <cmath>
#include <set>

namespace
{

struct Doubles : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<Doubles>;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

Tally tally;

// Angles are compared up to here where the sums do not cancel; slivers of files lose digits in the peers' own sums.
const double tolerance = 1e-6;

mt_vec3 vector(const OpenMesh::Vec3d &v)
{
    return mt_vec3_make(v[0], v[1], v[2]);
}

mt_vec3 vector(const Kernel::Vector_3 &v)
{
    return mt_vec3_make(v.x(), v.y(), v.z());
}

// CGAL's search passes over faces that are nearly parallel: how much worse than ours its worst angle may be. 0.0086 was
// measured.
const double cgal_slack = 0.02;

double angle(mt_vec3 a, mt_vec3 b)
{
    return std::atan2(mt_vec3_length(mt_vec3_cross(a, b)), mt_vec3_dot(a, b));
}

// Our normals, computed onto the mesh.
struct Normals {
    const mt_attribute *attribute;

    Normals(mt_context *context, mt_mesh *mesh, mt_normal_kind kind, mt_normal_weight weight)
    {
        mt_normal_options options{};
        options.kind = kind;
        options.weight = weight;
        options.type = MT_F64;
        tally.expect(mt_mesh_add_normals(context, mesh, &options, nullptr) == MT_OK, "normals are computed");
        attribute = &mesh->attributes[mesh->attribute_count - 1];
    }

    mt_vec3 operator[](mt_index i) const
    {
        const double *n = static_cast<const double *>(attribute->values) + 3 * std::size_t(i);
        return mt_vec3_make(n[0], n[1], n[2]);
    }
};

// False when it would drop or mistake a face.
bool build(const mt_mesh *mesh, OpenMeshMesh &theirs, CgalMesh &cgal)
{
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        theirs.add_vertex({p.x, p.y, p.z});
        cgal.add_vertex({p.x, p.y, p.z});
    }
    for (const auto &polygon : polygons_of(mesh)) {
        std::vector<OpenMeshMesh::VertexHandle> corners;
        std::vector<CgalMesh::Vertex_index> indices;
        for (std::size_t v : polygon) {
            corners.emplace_back(static_cast<int>(v));
            indices.emplace_back(static_cast<unsigned>(v));
        }
        bool simple = std::set<std::size_t>(polygon.begin(), polygon.end()).size() == polygon.size();
        if (!simple || !theirs.add_face(corners).is_valid() || cgal.add_face(indices) == CgalMesh::null_face()) {
            return false;
        }
    }
    return mesh->face_count > 0;
}

// The share of a face's size that is left of its area: where that is small the peers, who do not take more digits, lose
// the direction.
double thickness(const mt_mesh *mesh, mt_index face)
{
    mt_scaled_vector area = mt_face_area_vector(mesh, face);
    double squares = 0;
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    mt_vec3 first = mt_mesh_position(mesh, mesh->corner_vertices[begin]);
    for (mt_index c = begin + 1; c < end; c++) {
        mt_vec3 side = mt_vec3_subtract(mt_mesh_position(mesh, mesh->corner_vertices[c]), first);
        squares = std::max(squares, mt_vec3_dot(side, side));
    }
    return squares > 0 ? std::ldexp(mt_vec3_length(area.vector), area.exponent) / squares : 0;
}

void check_faces(mt_context *context, mt_mesh *mesh, OpenMeshMesh &theirs, CgalMesh &cgal, const std::string &name)
{
    Normals ours(context, mesh, MT_NORMALS_FACE, MT_NORMAL_WEIGHT_AREA);
    double worst_openmesh = 0, worst_cgal = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        if (thickness(mesh, face) < 1e-6) {
            continue;
        }
        mt_vec3 by_openmesh = vector(theirs.calc_face_normal(OpenMeshMesh::FaceHandle(int(face))));
        mt_vec3 by_cgal = vector(CGAL::Polygon_mesh_processing::compute_face_normal(CgalMesh::Face_index(face), cgal));
        worst_openmesh = std::max(worst_openmesh, angle(ours[face], by_openmesh));
        worst_cgal = std::max(worst_cgal, angle(ours[face], by_cgal));
    }
    tally.expect(worst_openmesh < tolerance, name + ": OpenMesh's face normals, " + std::to_string(worst_openmesh));
    tally.expect(worst_cgal < tolerance, name + ": CGAL's face normals, " + std::to_string(worst_cgal));
}

bool is_thin_around(const mt_mesh *mesh, const OpenMeshMesh &theirs, OpenMeshMesh::VertexHandle vertex)
{
    for (auto face : theirs.vf_range(vertex)) {
        if (thickness(mesh, mt_index(face.idx())) < 1e-6) {
            return true;
        }
    }
    return theirs.is_isolated(vertex);
}

// Where the faces' normals nearly cancel no sum has a direction to compare.
bool cancels(const Normals &faces, const OpenMeshMesh &theirs, OpenMeshMesh::VertexHandle vertex)
{
    mt_vec3 sum = {0, 0, 0};
    double count = 0;
    for (auto face : theirs.vf_range(vertex)) {
        sum = mt_vec3_add(sum, faces[mt_index(face.idx())]);
        count++;
    }
    return mt_vec3_length(sum) < 1e-3 * count;
}

// The sum of the areas around a vertex, twice.
double area_sum(const mt_mesh *mesh, const OpenMeshMesh &theirs, OpenMeshMesh::VertexHandle vertex)
{
    double sum = 0;
    for (auto face : theirs.vf_range(vertex)) {
        mt_scaled_vector area = mt_face_area_vector(mesh, mt_index(face.idx()));
        sum += std::ldexp(mt_vec3_length(area.vector), area.exponent);
    }
    return sum;
}

double worst_angle(const Normals &faces, const OpenMeshMesh &theirs, OpenMeshMesh::VertexHandle vertex, mt_vec3 n)
{
    double worst = 0;
    for (auto face : theirs.vf_range(vertex)) {
        worst = std::max(worst, angle(faces[mt_index(face.idx())], n));
    }
    return worst;
}

void check_vertices(mt_context *context, mt_mesh *mesh, OpenMeshMesh &theirs, CgalMesh &cgal, const std::string &name)
{
    theirs.update_face_normals();
    bool triangles = !mesh->face_offsets && mesh->face_size == 3;
    double worst_fast = 0, worst_correct = 0, worst_excess = 0;
    std::vector<mt_vec3> uniform, area;
    Normals by_uniform(context, mesh, MT_NORMALS_VERTEX, MT_NORMAL_WEIGHT_UNIFORM);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        uniform.push_back(by_uniform[v]);
    }
    Normals by_area(context, mesh, MT_NORMALS_VERTEX, MT_NORMAL_WEIGHT_AREA);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        area.push_back(by_area[v]);
    }
    Normals again(context, mesh, MT_NORMALS_FACE, MT_NORMAL_WEIGHT_AREA); // adding moves attributes
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        OpenMeshMesh::VertexHandle vertex(static_cast<int>(v));
        if (is_thin_around(mesh, theirs, vertex) || cancels(again, theirs, vertex)) {
            continue;
        }
        OpenMesh::Vec3d fast, correct;
        theirs.calc_vertex_normal_fast(vertex, fast);
        worst_fast = std::max(worst_fast, angle(uniform[v], vector(fast)));
        if (triangles && !theirs.is_boundary(vertex)) {
            theirs.calc_vertex_normal_correct(vertex, correct);
            double cancellation = correct.norm() / (1e-300 + area_sum(mesh, theirs, vertex));
            worst_correct = std::max(worst_correct, cancellation > 1e-3 ? angle(area[v], vector(correct)) : 0);
        }
        mt_vec3 by_cgal = vector(CGAL::Polygon_mesh_processing::compute_vertex_normal(CgalMesh::Vertex_index(v), cgal));
        double theirs_worst = worst_angle(again, theirs, vertex, by_cgal);
        double ours_worst = worst_angle(again, theirs, vertex, area[v]);
        bool has_one = ours_worst < 1e-9;
        worst_excess = std::max(worst_excess, has_one ? angle(area[v], by_cgal) : theirs_worst - ours_worst);
    }
    tally.expect(worst_fast < tolerance, name + ": OpenMesh's fast normals, " + std::to_string(worst_fast));
    tally.expect(worst_correct < tolerance, name + ": OpenMesh's correct normals, " + std::to_string(worst_correct));
    tally.expect(worst_excess < cgal_slack, name + ": CGAL's worst angle, " + std::to_string(worst_excess));
}

} // namespace

int main()
{
    omerr().disable();
    mt_context *context = mt_context_create(nullptr);
    int held = 0;
    for (const std::string &file : mesh_files()) {
        mt_mesh *mesh = nullptr;
        if (mt_mesh_read_file(context, file.c_str(), nullptr, &mesh, nullptr) != MT_OK) {
            mt_context_clear_error(context);
            continue;
        }
        OpenMeshMesh theirs;
        theirs.request_face_normals();
        CgalMesh cgal;
        if (mesh->face_count < 200000 && build(mesh, theirs, cgal)) {
            check_faces(context, mesh, theirs, cgal, file);
            check_vertices(context, mesh, theirs, cgal, file);
            held++;
        }
        mt_mesh_destroy(context, mesh);
    }
    mt_context_destroy(context);
    std::printf("%d meshes that OpenMesh and CGAL can hold\n", held);
    tally.expect(held >= 10, "ten meshes were compared");
    return tally.conclude();
}
