// Whole processes from an OBJ of more than 50 MB to binary PLY and to GLB: ours, and assimp's command line. Memory is
// the most that was resident in either process, with the pages of the file that it mapped.
#include "tests/bench/bench.hpp"

#include <malloc.h>

#include <cstdio>
#include <filesystem>

namespace bench
{
namespace
{

constexpr std::uint64_t face_count = 1500000;

struct Target {
    const char *extension, *assimp_format;
};

// The mesh is gone before anything is measured: a process starts with the memory of the one that made it.
mt_index write_source(const std::string &path)
{
    mt_mesh *mesh = wavy_torus(face_count, false, false);
    require(shared_context(), mt_mesh_set_position_type(shared_context(), mesh, MT_F32, nullptr));
    require(shared_context(), mt_mesh_write_file(shared_context(), mesh, path.c_str(), nullptr, nullptr));
    mt_index faces = mesh->face_count;
    mt_mesh_destroy(shared_context(), mesh);
    malloc_trim(0);
    return faces;
}

void beside_assimp(const Target &target, const std::string &folder, const std::string &source, mt_index faces)
{
    std::string ours_path = folder + "/ours." + target.extension, theirs_path = folder + "/theirs." + target.extension;
    std::string ours = std::string(MESHTOOL_BINARY) + " convert " + source + " " + ours_path;
    std::string theirs = "assimp export " + source + " " + theirs_path + " -f" + target.assimp_format;
    Row row;
    row.name = std::string("convert obj to ") + target.extension;
    row.mesh = "torus";
    row.faces = faces;
    row.peer = "assimp";
    row.note = "whole process, " + std::to_string(std::filesystem::file_size(source) / 1000000) + " MB read";
    compare(
        row,
        [&](mt_context *context) {
            run_quietly(ours + " --threads " + std::to_string(mt_context_thread_count(context)));
        },
        [&] { run_quietly(theirs); });
}

} // namespace

void run_convert()
{
    if (!installed("assimp")) {
        std::puts("convert: assimp-utils is not installed, left out");
        return;
    }
    std::string folder = make_scratch_folder(), source = folder + "/source.obj";
    mt_index faces = write_source(source);
    const Target targets[] = {{"ply", "plyb"}, {"glb", "glb2"}};
    for (const Target &target : targets) {
        beside_assimp(target, folder, source, faces);
    }
    std::filesystem::remove_all(folder);
}

} // namespace bench
