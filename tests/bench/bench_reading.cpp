// Reading each format into the peer's own structure. The file lies in the page cache. The error is the largest
// difference of a coordinate, where the peer keeps the order of the vertices.
#include "tests/bench/bench.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <admesh/stl.h>
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace bench
{
namespace
{

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

void fail(const char *who, const std::string &path)
{
    std::fprintf(stderr, "bench: %s could not read %s\n", who, path.c_str());
    std::exit(1);
}

void read_openmesh(const std::string &path, OpenMeshMesh &mesh)
{
    if (!OpenMesh::IO::read_mesh(mesh, path)) {
        fail("OpenMesh", path);
    }
}

void read_cgal(const std::string &path)
{
    CgalMesh mesh;
    if (!CGAL::IO::read_polygon_mesh(path, mesh)) {
        fail("CGAL", path);
    }
}

void read_assimp(const std::string &path)
{
    const aiScene *scene = aiImportFile(path.c_str(), 0);
    if (!scene) {
        fail("assimp", path);
    }
    aiReleaseImport(scene);
}

void read_admesh(const std::string &path)
{
    stl_file stl{};
    stl_open(&stl, const_cast<char *>(path.c_str()));
    if (stl_get_error(&stl)) {
        fail("admesh", path);
    }
    stl_close(&stl);
}

double error_against_openmesh(const mt_mesh *mesh, const std::string &path)
{
    OpenMeshMesh theirs;
    read_openmesh(path, theirs);
    if (theirs.n_vertices() != mesh->vertex_count) {
        return -1;
    }
    double largest = 0;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        auto q = theirs.point(OpenMeshMesh::VertexHandle(static_cast<int>(v)));
        largest = std::max(
            {largest, std::abs(p.x - double(q[0])), std::abs(p.y - double(q[1])), std::abs(p.z - double(q[2]))});
    }
    return largest;
}

struct Format {
    const char *name, *extension;
    mt_encoding encoding;
};

const Format formats[] = {
    {"read obj", "obj", MT_ENCODING_DEFAULT}, {"read off", "off", MT_ENCODING_DEFAULT},
    {"read ply", "ply", MT_ENCODING_DEFAULT}, {"read ply as text", "ply", MT_ENCODING_ASCII},
    {"read stl", "stl", MT_ENCODING_DEFAULT},
};

Row write_for(const mt_mesh *source, const std::string &path, const Format &format)
{
    mt_mesh_write_options options{};
    options.encoding = format.encoding;
    require(shared_context(), mt_mesh_write_file(shared_context(), source, path.c_str(), &options, nullptr));
    Row row;
    row.name = format.name;
    row.mesh = "torus";
    row.faces = source->face_count;
    row.bytes = std::filesystem::file_size(path);
    return row;
}

void compare_on(const mt_mesh *source, const std::string &folder, const Format &format)
{
    mt_context *context = shared_context();
    std::string path = folder + "/mesh." + format.extension;
    Row row = write_for(source, path, format);
    mt_mesh *read = nullptr;
    require(context, mt_mesh_read_file(context, path.c_str(), nullptr, &read, nullptr));
    auto ours = [&path](mt_context *with) {
        mt_mesh *mesh = nullptr;
        require(with, mt_mesh_read_file(with, path.c_str(), nullptr, &mesh, nullptr));
        mt_mesh_destroy(with, mesh);
    };
    bool is_stl = std::string(format.extension) == "stl";
    row.peer = "OpenMesh";
    row.error = error_against_openmesh(read, path);
    compare(row, ours, [&path] {
        OpenMeshMesh mesh;
        read_openmesh(path, mesh);
    });
    row.error = -1;
    row.peer = is_stl ? "admesh" : "CGAL";
    compare(row, ours, [&path, is_stl] { is_stl ? read_admesh(path) : read_cgal(path); });
    row.peer = "assimp";
    compare(row, ours, [&path] { read_assimp(path); });
    mt_mesh_destroy(context, read);
    std::filesystem::remove(path);
}

// Ten million corners, which are found to be 1.7 million vertices.
void weld_ten_million(const std::string &folder)
{
    mt_mesh *mesh = wavy_torus(3333334, false, false);
    std::string path = folder + "/mesh.stl";
    Row row = write_for(mesh, path, {"read stl", "stl", MT_ENCODING_DEFAULT});
    mt_mesh_destroy(shared_context(), mesh);
    auto ours = [&path](mt_context *with) {
        mt_mesh *read = nullptr;
        require(with, mt_mesh_read_file(with, path.c_str(), nullptr, &read, nullptr));
        mt_mesh_destroy(with, read);
    };
    row.peer = "admesh";
    compare_once(row, ours, [&path] { read_admesh(path); });
    std::filesystem::remove(path);
}

} // namespace

void run_reading()
{
    std::string folder = make_scratch_folder();
    for (std::uint64_t size : sizes) {
        mt_mesh *mesh = wavy_torus(size, false, false);
        require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
        for (const Format &format : formats) {
            compare_on(mesh, folder, format);
        }
        mt_mesh_destroy(shared_context(), mesh);
    }
    weld_ten_million(folder);
    std::filesystem::remove_all(folder);
}

} // namespace bench
