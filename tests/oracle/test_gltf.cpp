// glTF beside assimp: what we write it reads with the same triangles, and what it writes we read. What meshoptimizer
// compresses we read to the bit. Faces are compared one by one, as the sequence of their corners' coordinates.
#include "tests/oracle/faces.hpp"

#include <assimp/cexport.h>
#include <assimp/postprocess.h>
#include <meshoptimizer.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <meshtool/generate.h>
#include <meshtool/triangulate.h>

namespace
{

namespace fs = std::filesystem;

int passed = 0, failed = 0;

void judge(bool agrees, const std::string &what)
{
    agrees ? passed++ : failed++;
    if (!agrees) {
        std::printf("FAILED %s\n", what.c_str());
    }
}

bool read_ours(mt_context *context, const std::string &path, Faces &faces)
{
    mt_mesh *read = nullptr;
    if (mt_mesh_read_file(context, path.c_str(), nullptr, &read, nullptr) != MT_OK) {
        std::printf("  %s\n", mt_context_error(context)->message);
        mt_context_clear_error(context);
        return false;
    }
    faces = faces_of(read);
    mt_mesh_destroy(context, read);
    return true;
}

void compare(mt_context *context, const fs::path &source, const fs::path &folder)
{
    mt_mesh *mesh = nullptr, *triangles = nullptr;
    if (mt_mesh_read_file(context, source.c_str(), nullptr, &mesh, nullptr) != MT_OK ||
        mt_mesh_triangulate(context, mesh, &triangles) != MT_OK) {
        judge(false, source.string() + " could not be read");
        mt_mesh_destroy(context, mesh);
        return;
    }
    Faces expected = faces_of(triangles), found;
    for (const char *extension : {"glb", "gltf"}) {
        std::string path = (folder / (std::string("ours.") + extension)).string();
        bool written = mt_mesh_write_file(context, mesh, path.c_str(), nullptr, nullptr) == MT_OK;
        found.clear();
        judge(written && read_assimp(path, found) && same(expected, found, 2e-7),
              source.string() + " as " + extension + " by us, read by assimp");
        const aiScene *scene = aiImportFile(source.c_str(), aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
        std::string format = std::string(extension) == "glb" ? "glb2" : "gltf2";
        path = (folder / (std::string("theirs.") + extension)).string();
        if (scene && aiExportScene(scene, format.c_str(), path.c_str(), 0) == aiReturn_SUCCESS) {
            Faces theirs;
            found.clear();
            judge(read_assimp(path, theirs) && read_ours(context, path, found) && same(theirs, found, 2e-7),
                  source.string() + " as " + extension + " by assimp, read by us");
        }
        aiReleaseImport(scene);
    }
    mt_mesh_destroy(context, triangles);
    mt_mesh_destroy(context, mesh);
}

// A sphere whose positions and triangles meshoptimizer compresses, in a file beside.
void compare_meshopt(mt_context *context, const fs::path &folder)
{
    mt_generate_options options = {};
    options.resolution = 3;
    options.position_type = MT_F32;
    mt_mesh *mesh = nullptr, *read = nullptr;
    mt_generate(context, "icosphere", &options, &mesh);
    std::vector<unsigned char> packed(meshopt_encodeVertexBufferBound(mesh->vertex_count, 12));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), mesh->positions, mesh->vertex_count, 12));
    std::size_t first = packed.size();
    std::vector<unsigned char> indices(meshopt_encodeIndexSequenceBound(mesh->corner_count, mesh->vertex_count));
    indices.resize(
        meshopt_encodeIndexSequence(indices.data(), indices.size(), mesh->corner_vertices, mesh->corner_count));
    packed.insert(packed.end(), indices.begin(), indices.end());
    std::ofstream(folder / "packed.bin", std::ios::binary)
        .write(reinterpret_cast<const char *>(packed.data()), static_cast<std::streamsize>(packed.size()));
    char text[4096];
    std::snprintf(text, sizeof text,
                  R"({"asset":{"version":"2.0"},"extensionsRequired":["EXT_meshopt_compression"],"nodes":[{"mesh":0}],)"
                  R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
                  R"({"bufferView":0,"componentType":5126,"count":%u,"type":"VEC3"},)"
                  R"({"bufferView":1,"componentType":5125,"count":%u,"type":"SCALAR"}],"bufferViews":[)"
                  R"({"buffer":1,"byteLength":%u,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteLength":%zu,)"
                  R"("byteStride":12,"count":%u,"mode":"ATTRIBUTES"}}},)"
                  R"({"buffer":1,"byteLength":%u,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":%zu,)"
                  R"("byteLength":%zu,"byteStride":4,"count":%u,"mode":"INDICES"}}}],)"
                  R"("buffers":[{"byteLength":%zu,"uri":"packed.bin"},{"byteLength":1000000}]})",
                  mesh->vertex_count, mesh->corner_count, 12 * mesh->vertex_count, first, mesh->vertex_count,
                  4 * mesh->corner_count, first, packed.size() - first, mesh->corner_count, packed.size());
    std::string path = (folder / "packed.gltf").string();
    std::ofstream(path) << text;
    bool done = mt_mesh_read_file(context, path.c_str(), nullptr, &read, nullptr) == MT_OK;
    judge(done && read->vertex_count == mesh->vertex_count && read->corner_count == mesh->corner_count &&
              std::memcmp(read->positions, mesh->positions, 12 * std::size_t(mesh->vertex_count)) == 0 &&
              std::memcmp(read->corner_vertices, mesh->corner_vertices, 4 * std::size_t(mesh->corner_count)) == 0,
          std::string("compressed by meshoptimizer: ") + mt_context_error(context)->message);
    mt_mesh_destroy(context, read);
    mt_mesh_destroy(context, mesh);
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    std::string folder = (fs::temp_directory_path() / "meshtool-gltf-XXXXXX").string();
    if (!context || !mkdtemp(folder.data())) {
        return 1;
    }
    for (const char *from : {"meshes/valid", "meshes/non_manifold"}) {
        for (const auto &entry : fs::directory_iterator(from)) {
            compare(context, entry.path(), folder);
        }
    }
    compare_meshopt(context, folder);
    fs::remove_all(folder);
    mt_context_destroy(context);
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed ? 1 : 0;
}
