// Files beside those of assimp, OpenMesh and admesh: what we write they read with the same faces and coordinates, and
// what they write we read. Faces are compared one by one, as the sequence of their corners' coordinates, so that it
// does not matter how a reader shares vertices. Differences by definition, by name: OpenMesh drops faces that its
// half-edges cannot hold, so meshes of class non-manifold are not given to it; assimp drops polygons' repeated points
// in no format here, and writes text with nine digits; STL has triangles only.
#include "tests/oracle/faces.hpp"

#include <assimp/cexport.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

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

struct Kind {
    const char *extension;
    mt_encoding encoding;
    const char *name;
};
const Kind kinds[] = {{"obj", MT_ENCODING_ASCII, "OBJ"},
                      {"off", MT_ENCODING_ASCII, "OFF"},
                      {"ply", MT_ENCODING_ASCII, "ASCII PLY"},
                      {"ply", MT_ENCODING_BINARY, "binary PLY"},
                      {"ply", MT_ENCODING_BINARY_BIG, "big-endian PLY"},
                      {"stl", MT_ENCODING_ASCII, "ASCII STL"},
                      {"stl", MT_ENCODING_BINARY, "binary STL"}};

class Comparison
{
  public:
    Comparison(mt_context *context_, const fs::path &source_, const fs::path &folder_)
        : context(context_), source(source_.filename().string()), folder(folder_)
    {
        if (mt_mesh_read_file(context, source_.c_str(), nullptr, &mesh, nullptr) == MT_OK) {
            with_corner_attributes();
            drop_corner_attributes();
            mt_mesh_triangulate(context, mesh, &triangles);
        }
        judge(mesh && triangles, source + ": read by us");
        mt_context_clear_error(context);
    }
    Comparison(const Comparison &) = delete;
    Comparison &operator=(const Comparison &) = delete;
    ~Comparison()
    {
        mt_mesh_destroy(context, mesh);
        mt_mesh_destroy(context, triangles);
    }

    void run()
    {
        if (!mesh || !triangles) {
            return;
        }
        clean = openmesh_holds(mesh);
        for (const Kind &kind : kinds) {
            written_by_us(kind);
        }
        written_by_assimp();
        if (clean) {
            written_by_openmesh();
        }
    }

  private:
    mt_context *context;
    std::string source;
    fs::path folder;
    mt_mesh *mesh = nullptr, *triangles = nullptr;
    bool clean = false;

    void with_corner_attributes()
    {
        std::string path = (folder / "corners.ply").string();
        Faces found;
        judge(mt_mesh_write_file(context, mesh, path.c_str(), nullptr, nullptr) == MT_OK && read_assimp(path, found) &&
                  same(faces_of(mesh), found, 2e-7),
              source + " as PLY by us, with all its attributes, read by assimp");
    }

    // OpenMesh stops at a PLY face that has a second list, as texture coordinates are; so the meshes go without.
    void drop_corner_attributes()
    {
        for (mt_index i = mesh->attribute_count; i-- > 0;) {
            if (mesh->attributes[i].domain == MT_DOMAIN_CORNER) {
                mt_mesh_remove_attribute(context, mesh, i);
            }
        }
    }

    bool read_ours(const std::string &path, Faces &faces)
    {
        mt_mesh *read = nullptr;
        bool done = mt_mesh_read_file(context, path.c_str(), nullptr, &read, nullptr) == MT_OK;
        if (!done) {
            std::printf("  %s\n", mt_context_error(context)->message);
            mt_context_clear_error(context);
            return false;
        }
        faces = faces_of(read);
        mt_mesh_destroy(context, read);
        return true;
    }

    void written_by_us(const Kind &kind)
    {
        std::string path = (folder / (std::string("ours.") + kind.extension)).string();
        std::string what = source + " as " + kind.name + " by us, read by ";
        bool is_stl = std::string(kind.extension) == "stl";
        mt_mesh_write_options options{};
        options.encoding = kind.encoding;
        if (mt_mesh_write_file(context, mesh, path.c_str(), &options, nullptr) != MT_OK) {
            judge(false, what + "nobody: " + mt_context_error(context)->message);
            mt_context_clear_error(context);
            return;
        }
        Faces expected = faces_of(is_stl ? triangles : mesh), found;
        // Text without types holds the shortest digits of a float, which are read as a double.
        double rounding = is_stl || mesh->position_type == MT_F32 ? 6e-8 : 0;
        judge(read_ours(path, found) && same(expected, found, rounding), what + "us");
        found.clear();
        if (std::string(kind.extension) != "off" || most_sides(expected) <= 9) { // its OFF reader drops larger faces
            judge(read_assimp(path, found) && same(expected, found, 2e-7), what + "assimp");
        }
        if (is_stl && (kind.encoding == MT_ENCODING_ASCII || expected.size() >= 4)) { // admesh: 4 facets in binary
            found.clear();
            judge(read_admesh(path, found) && same(expected, found, 2e-7), what + "admesh");
        }
        OpenMeshMesh theirs;
        if (clean && !is_stl) {
            bool read = read_openmesh(path, theirs);
            judge(read && theirs.n_vertices() == mesh->vertex_count, what + "OpenMesh, vertices");
            judge(read && same(expected, faces_of(theirs), 2e-7, true), what + "OpenMesh");
        } else if (clean) {
            // Its tolerance of welding may drop facets that it makes degenerate; never more than there are.
            judge(read_openmesh(path, theirs) && theirs.n_faces() <= expected.size(), what + "OpenMesh");
        }
    }

    void written_by_assimp()
    {
        static const struct {
            const char *id, *extension;
            bool is_stl;
        } writers[] = {{"objnomtl", "obj", false},
                       {"ply", "ply", false},
                       {"plyb", "ply", false},
                       {"stl", "stl", true},
                       {"stlb", "stl", true}};
        std::string original = (folder / "source.ply").string();
        mt_mesh_write_file(context, mesh, original.c_str(), nullptr, nullptr);
        for (const auto &writer : writers) {
            if (std::string(writer.id) == "plyb" && most_sides(faces_of(mesh)) > UINT8_MAX) {
                continue; // it writes the number of sides as one byte, whatever it is
            }
            // Its STL writer needs triangles.
            const aiScene *scene = aiImportFile(original.c_str(), 0);
            std::string plain = (folder / "triangles.ply").string();
            if (writer.is_stl) {
                aiReleaseImport(scene);
                mt_mesh_write_file(context, triangles, plain.c_str(), nullptr, nullptr);
                scene = aiImportFile(plain.c_str(), 0);
            }
            std::string path = (folder / (std::string("assimp.") + writer.extension)).string();
            bool written = scene && aiExportScene(scene, writer.id, path.c_str(), 0) == aiReturn_SUCCESS;
            aiReleaseImport(scene);
            Faces found;
            judge(written && read_ours(path, found) && same(faces_of(writer.is_stl ? triangles : mesh), found, 1e-5),
                  source + " as " + writer.id + " by assimp, read by us");
        }
    }

    void written_by_openmesh()
    {
        using OpenMesh::IO::Options;
        // Its binary OFF lacks the count of a face's colours, so that no other reader can take it.
        static const struct {
            const char *extension;
            Options::Flag flag;
            bool big, is_stl;
        } writers[] = {{"obj", Options::Default, false, false}, {"off", Options::Default, false, false},
                       {"ply", Options::Default, false, false}, {"ply", Options::Binary, false, false},
                       {"ply", Options::Binary, true, false},   {"stl", Options::Default, false, true},
                       {"stl", Options::Binary, false, true}};
        std::string original = (folder / "source.off").string(), plain = (folder / "triangles.off").string();
        mt_mesh_write_file(context, mesh, original.c_str(), nullptr, nullptr);
        mt_mesh_write_file(context, triangles, plain.c_str(), nullptr, nullptr);
        bool plain_is_clean = openmesh_holds(triangles);
        for (const auto &writer : writers) {
            OpenMeshMesh theirs;
            if (writer.is_stl && !plain_is_clean) {
                continue;
            }
            if (writer.flag == Options::Binary && most_sides(faces_of(mesh)) > UINT8_MAX && !writer.is_stl) {
                continue; // it writes the number of sides as one byte, whatever it is
            }
            Options options(writer.flag);
            if (writer.big) {
                options += Options::MSB;
            }
            std::string path = (folder / (std::string("openmesh.") + writer.extension)).string();
            bool written = read_openmesh(writer.is_stl ? plain : original, theirs) &&
                           OpenMesh::IO::write_mesh(theirs, path, options, 17);
            Faces found;
            judge(written && read_ours(path, found) && same(faces_of(theirs), found, 1e-5, true),
                  source + " as " + writer.extension + (options.is_binary() ? " (binary)" : "") +
                      (writer.big ? " (big-endian)" : "") + " by OpenMesh, read by us");
        }
    }
};

void add_files(const fs::path &folder, std::vector<fs::path> &files)
{
    if (!fs::exists(folder)) {
        std::printf("skipped: %s is not here\n", folder.c_str());
        return;
    }
    for (const auto &entry : fs::directory_iterator(folder)) {
        std::string extension = entry.path().extension().string();
        if (mt_mesh_format_by_extension(extension.empty() ? "" : extension.c_str() + 1)) {
            files.push_back(entry.path());
        }
    }
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    std::string pattern = (fs::temp_directory_path() / "meshtool-formats-XXXXXX").string();
    if (!context || !mkdtemp(pattern.data())) {
        return 1;
    }
    std::vector<fs::path> files;
    add_files("meshes/valid", files);
    add_files("meshes/non_manifold", files);
    add_files("../shared/corpus", files);
    std::sort(files.begin(), files.end());
    omerr().disable();
    omlog().disable();
    for (const fs::path &file : files) {
        Comparison(context, file, pattern).run();
    }
    fs::remove_all(pattern);
    mt_context_destroy(context);
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed ? 1 : 0;
}
