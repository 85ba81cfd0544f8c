// The files of Debian's package assimp-testmodels in the formats that we read, each beside assimp: the same faces, the
// same triangles when faces are cut into them, the same box, area and, where nothing moves vertices, the same number of
// places. What differs is named with its reason in tests/oracle/assimp_models.txt; a difference that is not there
// fails, and so does a line there that is no longer true.
#include "tests/oracle/mesh_files.hpp"

#include <assimp/cimport.h>
#include <assimp/scene.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

namespace
{

namespace fs = std::filesystem;

const char models[] = "/usr/share/assimp/models";
const char table_path[] = "tests/oracle/assimp_models.txt";

using Point = std::array<double, 3>;

// What two readers of one file must agree on. Points and wires are no faces.
struct Summary {
    long long faces = 0, triangles = 0;
    double area = 0;
    Point low{{INFINITY, INFINITY, INFINITY}}, high{{-INFINITY, -INFINITY, -INFINITY}};
    std::set<std::array<float, 3>> places;

    // The area is half the length of Newell's sum, which does not depend on how a face is cut.
    void add(const std::vector<Point> &corners)
    {
        if (corners.size() < 3) {
            return;
        }
        faces++;
        triangles += static_cast<long long>(corners.size()) - 2;
        Point sum{};
        for (std::size_t i = 0; i < corners.size(); i++) {
            const Point &p = corners[i], &q = corners[(i + 1) % corners.size()], &o = corners[0];
            for (std::size_t k = 0; k < 3; k++) {
                std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
                sum[k] += (p[l] - o[l]) * (q[m] - o[m]) - (p[m] - o[m]) * (q[l] - o[l]);
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
            places.insert({{float(p[0]), float(p[1]), float(p[2])}});
        }
        area += std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / 2;
    }

    double extent() const
    {
        double largest = 0;
        for (std::size_t k = 0; faces > 0 && k < 3; k++) {
            largest = std::max({largest, std::abs(low[k]), std::abs(high[k])});
        }
        return largest;
    }
};

void collect(const aiScene *scene, const aiNode *node, aiMatrix4x4 place, Summary &summary)
{
    place = place * node->mTransformation;
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        const aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            std::vector<Point> corners;
            for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++) {
                aiVector3D p = place * mesh->mVertices[mesh->mFaces[f].mIndices[k]];
                corners.push_back({{p.x, p.y, p.z}});
            }
            summary.add(corners);
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        collect(scene, node->mChildren[i], place, summary);
    }
}

bool read_theirs(const fs::path &path, Summary &summary)
{
    const aiScene *scene = aiImportFile(path.c_str(), 0);
    if (scene && scene->mRootNode) {
        collect(scene, scene->mRootNode, aiMatrix4x4(), summary);
    }
    aiReleaseImport(scene);
    return scene;
}

// Without a limit, assimp fills 15 GB with the vertices that invalid/OutOfMemory.off announces, in two minutes.
bool limit_address_space()
{
    const rlim_t gibibyte = rlim_t{1} << 30;
    rlimit limit{};
    bool is_known = getrlimit(RLIMIT_AS, &limit) == 0;
    limit.rlim_cur = std::min(limit.rlim_max, 4 * gibibyte);
    return is_known && setrlimit(RLIMIT_AS, &limit) == 0;
}

bool read_ours(mt_context *context, const fs::path &path, Summary &summary, std::string &message)
{
    mt_mesh *mesh = nullptr;
    if (mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr) != MT_OK) {
        message = mt_context_error(context)->message;
        mt_context_clear_error(context);
        return false;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        std::vector<Point> corners;
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
            mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]);
            corners.push_back({{p.x, p.y, p.z}});
        }
        summary.add(corners);
    }
    mt_mesh_destroy(context, mesh);
    return true;
}

std::string counts(const char *what, long long ours, long long theirs)
{
    return std::string(what) + " " + std::to_string(ours) + ", theirs " + std::to_string(theirs);
}

// Empty where both agree. They hold single precision, and multiply their matrices in it.
std::string difference(const Summary &ours, const Summary &theirs, bool moves_vertices)
{
    const double tolerance = 1e-5;
    if (ours.faces != theirs.faces) {
        return counts("faces", ours.faces, theirs.faces);
    }
    if (ours.triangles != theirs.triangles) {
        return counts("triangles", ours.triangles, theirs.triangles);
    }
    double bound = tolerance * theirs.extent();
    for (std::size_t k = 0; ours.faces > 0 && k < 3; k++) {
        if (!(std::abs(ours.low[k] - theirs.low[k]) <= bound && std::abs(ours.high[k] - theirs.high[k]) <= bound)) {
            return "another box";
        }
    }
    if (!(std::abs(ours.area - theirs.area) <= 10 * tolerance * std::max(ours.area, theirs.area))) {
        return "another area";
    }
    if (!moves_vertices && ours.places.size() != theirs.places.size()) {
        return counts("places", static_cast<long long>(ours.places.size()),
                      static_cast<long long>(theirs.places.size()));
    }
    return "";
}

std::string judge(mt_context *context, const fs::path &path)
{
    Summary ours, theirs;
    std::string message, extension = path.extension().string();
    bool we_read = read_ours(context, path, ours, message), they_read = read_theirs(path, theirs);
    if (!we_read) {
        std::string name = path.string(); // the sentence begins with it
        std::size_t at = message.find(name);
        at = at == std::string::npos ? 0 : at + name.size();
        return std::string(they_read ? "refused" : "both refuse") + message.substr(at);
    }
    if (!they_read) {
        return "they refuse; faces " + std::to_string(ours.faces);
    }
    return difference(ours, theirs, extension == ".gltf" || extension == ".glb");
}

struct Line {
    std::string what;
    bool is_used = false;
};

// "FILE | WHAT DIFFERS | WHY": WHAT is a part of what this test finds.
std::map<std::string, Line> read_table(Tally &tally)
{
    std::map<std::string, Line> lines;
    std::ifstream file(table_path);
    std::string text;
    tally.expect(file.good(), std::string(table_path) + " is there");
    while (std::getline(file, text)) {
        if (text.empty() || text[0] == '#') {
            continue;
        }
        std::size_t first = text.find(" | "), second = text.find(" | ", first == std::string::npos ? first : first + 3);
        bool whole = second != std::string::npos && second + 3 < text.size() && second > first + 3;
        tally.expect(whole, "three columns: " + text);
        if (whole) {
            bool is_new = lines.emplace(text.substr(0, first), Line{text.substr(first + 3, second - first - 3)}).second;
            tally.expect(is_new, "one line a file: " + text);
        }
    }
    return lines;
}

std::vector<fs::path> model_files()
{
    std::vector<fs::path> files;
    for (const auto &entry : fs::recursive_directory_iterator(models)) {
        std::string extension = entry.path().extension().string();
        if (extension.size() > 1 && entry.is_regular_file() && mt_mesh_format_by_extension(extension.c_str() + 1)) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

} // namespace

int main()
{
    if (!fs::is_directory(models)) {
        std::printf("skipped: %s is not there (package assimp-testmodels)\n", models);
        return 0;
    }
    Tally tally;
    tally.expect(limit_address_space(), "memory can be limited");
    std::map<std::string, Line> lines = read_table(tally);
    mt_context *context = mt_context_create(nullptr);
    int agreed = 0;
    for (const fs::path &path : model_files()) {
        std::string name = fs::relative(path, models).string(), found = judge(context, path);
        auto line = lines.find(name);
        if (line == lines.end()) {
            tally.expect(found.empty(), name + " | " + found);
            agreed += found.empty();
        } else {
            line->second.is_used = true;
            tally.expect(!found.empty() && found.find(line->second.what) != std::string::npos,
                         name + " is listed as \"" + line->second.what + "\", but found \"" + found + "\"");
        }
    }
    for (const auto &line : lines) {
        tally.expect(line.second.is_used, line.first + " is listed but not there");
    }
    mt_context_destroy(context);
    std::printf("%d files read the same, %zu differ as listed\n", agreed, lines.size());
    return tally.conclude();
}
