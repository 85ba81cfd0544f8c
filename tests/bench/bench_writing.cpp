// Writing text, with the shortest numbers that read back the same, beside OpenMesh's writers of as many digits as it
// has by default. The file stays in the page cache.
#include "tests/bench/bench.hpp"

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace bench
{
namespace
{

using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<>;

OpenMeshMesh as_openmesh(const mt_mesh *mesh)
{
    OpenMeshMesh result;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        result.add_vertex({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_index *c = mesh->corner_vertices + 3 * std::size_t(face);
        result.add_face(OpenMeshMesh::VertexHandle(int(c[0])), OpenMeshMesh::VertexHandle(int(c[1])),
                        OpenMeshMesh::VertexHandle(int(c[2])));
    }
    return result;
}

void compare_on(const mt_mesh *mesh, const OpenMeshMesh &peer, const std::string &folder, const char *extension)
{
    std::string path = folder + "/ours." + extension, their_path = folder + "/theirs." + extension;
    mt_mesh_write_options options{};
    options.encoding = MT_ENCODING_ASCII;
    auto ours = [&](mt_context *context) {
        require(context, mt_mesh_write_file(context, mesh, path.c_str(), &options, nullptr));
    };
    ours(shared_context());
    Row row;
    row.name = std::string("write ") + extension + " text";
    row.mesh = mesh->position_type == MT_F32 ? "torus, floats" : "torus, doubles";
    row.faces = mesh->face_count;
    row.peer = "OpenMesh";
    row.bytes = std::filesystem::file_size(path);
    compare(row, ours, [&] {
        if (!OpenMesh::IO::write_mesh(peer, their_path)) {
            std::fprintf(stderr, "bench: OpenMesh could not write %s\n", their_path.c_str());
            std::exit(1);
        }
    });
}

} // namespace

void run_writing()
{
    std::string folder = make_scratch_folder();
    mt_mesh *mesh = wavy_torus(1000000, false, false);
    OpenMeshMesh peer = as_openmesh(mesh);
    for (mt_type type : {MT_F64, MT_F32}) {
        require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, type, nullptr));
        for (const char *extension : {"obj", "off", "ply"}) {
            compare_on(mesh, peer, folder, extension);
        }
    }
    mt_mesh_destroy(shared_context(), mesh);
    std::filesystem::remove_all(folder);
}

} // namespace bench
