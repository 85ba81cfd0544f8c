// The meshes that oracles run over: all of meshes/ that reads well, and the corpus beside the project where there is
// one.
#ifndef TESTS_ORACLE_MESH_FILES_HPP
#define TESTS_ORACLE_MESH_FILES_HPP

#include <meshtool/meshtool.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

inline std::vector<std::string> mesh_files()
{
    std::vector<std::string> files;
    for (const char *folder : {"meshes/valid", "meshes/non_manifold", "../shared/corpus"}) {
        if (!std::filesystem::is_directory(folder)) {
            std::printf("skipped: %s is not there\n", folder);
            continue;
        }
        for (const auto &entry : std::filesystem::directory_iterator(folder)) {
            std::string extension = entry.path().extension().string();
            if (extension == ".obj" || extension == ".off" || extension == ".ply" || extension == ".stl") {
                files.push_back(entry.path().string());
            }
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

using Polygons = std::vector<std::vector<std::size_t>>;

inline Polygons polygons_of(const mt_mesh *mesh)
{
    Polygons polygons(mesh->face_count);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            polygons[face].push_back(mesh->corner_vertices[c]);
        }
    }
    return polygons;
}

// Counts what agrees and names what does not.
struct Tally {
    int passed = 0, failed = 0;

    void expect(bool agrees, const std::string &what)
    {
        agrees ? passed++ : failed++;
        if (!agrees) {
            std::printf("FAILED %s\n", what.c_str());
        }
    }

    template <typename A, typename B> void expect_equal(A ours, B theirs, const std::string &what)
    {
        bool agrees = static_cast<long long>(ours) == static_cast<long long>(theirs);
        expect(agrees, what + ": " + std::to_string(ours) + ", they say " + std::to_string(theirs));
    }

    int conclude() const
    {
        std::printf("%d passed, %d failed\n", passed, failed);
        return failed != 0 || passed == 0;
    }
};

#endif
