// Catmull-Clark beside CGAL, OpenMesh and the published masks, one and two levels; Loop beside CGAL and OpenMesh.
//
// The masks are written out here once more, vertex by vertex with maps of edges, and compared by number: so the order
// of vertices and faces is checked too. CGAL and OpenMesh number new vertices in their own way, and are compared by
// position. OpenMesh moves boundary vertices by (2/3, 1/6, 1/6), which is not the cubic B-spline's (3/4, 1/8, 1/8): on
// open meshes it is compared after one level, without the old boundary vertices.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Utils/vector_traits.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/CatmullClarkT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>

#include <meshtool/meshtool.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace
{

int passed, failed;

void expect(bool condition, const std::string &what)
{
    condition ? passed++ : failed++;
    if (!condition) {
        std::printf("FAILED: %s\n", what.c_str());
    }
}

using Point = std::array<double, 3>;
using Face = std::vector<mt_index>;
struct Polygons {
    std::vector<Point> points;
    std::vector<Face> faces;
};

// Tolerance relative to the bounds; two levels of sums of a few terms err by some units in the last place.
constexpr double tolerance = 1e-12;

double diagonal(const Polygons &mesh)
{
    Point low = mesh.points[0], high = low;
    for (const Point &p : mesh.points) {
        for (int k = 0; k < 3; k++) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Polygons polygons_of(const mt_mesh *mesh)
{
    Polygons result;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        result.points.push_back({p.x, p.y, p.z});
    }
    for (mt_index f = 0; f < mesh->face_count; f++) {
        const mt_index *corners = mesh->corner_vertices;
        result.faces.emplace_back(corners + mt_mesh_face_begin(mesh, f), corners + mt_mesh_face_end(mesh, f));
    }
    return result;
}

Point mean(const std::vector<Point> &points)
{
    Point sum = {0, 0, 0};
    for (const Point &p : points) {
        for (int k = 0; k < 3; k++) {
            sum[k] += p[k];
        }
    }
    for (double &x : sum) {
        x /= static_cast<double>(points.size());
    }
    return sum;
}

// The masks by definition.
class Reference
{
  public:
    explicit Reference(const Polygons &polygons)
        : mesh(polygons), around(polygons.points.size()), midpoints(polygons.points.size()), rim(polygons.points.size())
    {
        for (std::size_t f = 0; f < mesh.faces.size(); f++) {
            collect(f);
        }
        for (const auto &[edge, faces] : edges) {
            Point middle = mean({mesh.points[edge.first], mesh.points[edge.second]});
            for (mt_index end : {edge.first, edge.second}) {
                midpoints[end].push_back(middle);
                if (faces.size() == 1) {
                    rim[end].push_back(mesh.points[end == edge.first ? edge.second : edge.first]);
                }
            }
        }
    }

    bool on_boundary(mt_index v) const
    {
        return !rim[v].empty();
    }

    Polygons refined()
    {
        Polygons result;
        for (mt_index v = 0; v < mesh.points.size(); v++) {
            result.points.push_back(vertex_point(v));
        }
        result.points.insert(result.points.end(), face_points.begin(), face_points.end());
        std::map<std::pair<mt_index, mt_index>, mt_index> numbers;
        for (const Face &face : mesh.faces) {
            for (std::size_t i = 0; i < face.size(); i++) {
                auto edge = std::minmax(face[i], face[(i + 1) % face.size()]);
                if (numbers.emplace(edge, static_cast<mt_index>(result.points.size())).second) {
                    result.points.push_back(edge_point(edge));
                }
            }
        }
        for (std::size_t f = 0; f < mesh.faces.size(); f++) {
            const Face &face = mesh.faces[f];
            for (std::size_t i = 0; i < face.size(); i++) {
                mt_index before = face[(i + face.size() - 1) % face.size()], after = face[(i + 1) % face.size()];
                result.faces.push_back({face[i], numbers.at(std::minmax(face[i], after)),
                                        static_cast<mt_index>(mesh.points.size() + f),
                                        numbers.at(std::minmax(face[i], before))});
            }
        }
        return result;
    }

  private:
    void collect(std::size_t f)
    {
        const Face &face = mesh.faces[f];
        std::vector<Point> points;
        for (std::size_t i = 0; i < face.size(); i++) {
            points.push_back(mesh.points[face[i]]);
            edges[std::minmax(face[i], face[(i + 1) % face.size()])].push_back(f);
        }
        face_points.push_back(mean(points));
        for (mt_index v : face) {
            around[v].push_back(face_points.back());
        }
    }

    Point edge_point(const std::pair<mt_index, mt_index> &edge) const
    {
        const std::vector<std::size_t> &faces = edges.at(edge);
        std::vector<Point> points = {mesh.points[edge.first], mesh.points[edge.second]};
        if (faces.size() == 2) {
            points.push_back(face_points[faces[0]]);
            points.push_back(face_points[faces[1]]);
        }
        return mean(points);
    }

    Point vertex_point(mt_index v) const
    {
        Point p = mesh.points[v], result = p;
        if (on_boundary(v)) {
            for (int k = 0; k < 3; k++) {
                result[k] = 3 * p[k] / 4 + rim[v][0][k] / 8 + rim[v][1][k] / 8;
            }
        } else if (!around[v].empty()) {
            Point faces = mean(around[v]), middles = mean(midpoints[v]);
            double n = static_cast<double>(around[v].size());
            for (int k = 0; k < 3; k++) {
                result[k] = (faces[k] + 2 * middles[k] + (n - 3) * p[k]) / n;
            }
        }
        return result;
    }

    const Polygons &mesh;
    std::vector<Point> face_points;
    std::vector<std::vector<Point>> around, midpoints, rim;
    std::map<std::pair<mt_index, mt_index>, std::vector<std::size_t>> edges;
};

double distance(const Point &a, const Point &b)
{
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

// Finds points by position.
class Finder
{
  public:
    Finder(const std::vector<Point> &cloud, double reach) : points(cloud), radius(reach)
    {
        for (std::size_t i = 0; i < points.size(); i++) {
            cells[cell(points[i], {0, 0, 0})].push_back(i);
        }
    }

    bool has(const Point &p) const
    {
        for (int corner = 0; corner < 27; corner++) {
            auto found = cells.find(cell(p, {corner % 3 - 1, corner / 3 % 3 - 1, corner / 9 - 1}));
            if (found != cells.end() && std::any_of(found->second.begin(), found->second.end(),
                                                    [&](std::size_t i) { return distance(points[i], p) <= radius; })) {
                return true;
            }
        }
        return false;
    }

  private:
    // Cells a thousand times the reach: few points share one, and a point's neighbours lie in the cells around.
    std::size_t cell(const Point &p, const std::array<int, 3> &step) const
    {
        std::size_t hash = 0;
        for (int k = 0; k < 3; k++) {
            auto at = static_cast<long long>(std::floor(p[k] / (1000 * radius))) + step[k];
            hash = hash * 0x9e3779b97f4a7c15u + static_cast<std::size_t>(at);
        }
        return hash;
    }

    const std::vector<Point> &points;
    double radius;
    std::unordered_map<std::size_t, std::vector<std::size_t>> cells;
};

// The largest number of points of `ours` that lie apart from all of `theirs`; `skip` names those not asked for.
std::size_t unmatched(const std::vector<Point> &ours, const std::vector<Point> &theirs, double reach,
                      const std::vector<bool> &skip)
{
    Finder finder(theirs, reach);
    std::size_t count = 0;
    for (std::size_t i = 0; i < ours.size(); i++) {
        count += !(i < skip.size() && skip[i]) && !finder.has(ours[i]);
    }
    return count;
}

struct DoubleTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d; // LoopT casts points to it
};
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using CatmullClark = OpenMesh::Subdivider::Uniform::CatmullClarkT<OpenMeshMesh, double>;
using OpenMeshTriangles = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;
using Loop = OpenMesh::Subdivider::Uniform::LoopT<OpenMeshTriangles, double>;
using CgalMesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

// Each builds the peer's mesh, refines it and returns its points; empty when the peer refused a face.
enum class Scheme { catmull_clark, loop };

std::vector<Point> cgal_points(const Polygons &mesh, unsigned levels, Scheme scheme = Scheme::catmull_clark)
{
    CgalMesh built;
    for (const Point &p : mesh.points) {
        built.add_vertex(CgalMesh::Point(p[0], p[1], p[2]));
    }
    for (const Face &face : mesh.faces) {
        std::vector<CgalMesh::Vertex_index> corners(face.begin(), face.end());
        if (built.add_face(corners) == CgalMesh::null_face()) {
            return {};
        }
    }
    auto count = CGAL::parameters::number_of_iterations(levels);
    if (scheme == Scheme::loop) {
        CGAL::Subdivision_method_3::Loop_subdivision(built, count);
    } else {
        CGAL::Subdivision_method_3::CatmullClark_subdivision(built, count);
    }
    std::vector<Point> points;
    for (auto v : built.vertices()) {
        auto p = built.point(v);
        points.push_back({p.x(), p.y(), p.z()});
    }
    return points;
}

template <class Mesh, class Subdivider> std::vector<Point> openmesh_points(const Polygons &mesh, unsigned levels)
{
    Mesh built;
    for (const Point &p : mesh.points) {
        built.add_vertex(typename Mesh::Point(p[0], p[1], p[2]));
    }
    for (const Face &face : mesh.faces) {
        std::vector<typename Mesh::VertexHandle> corners;
        for (mt_index v : face) {
            corners.emplace_back(static_cast<int>(v));
        }
        if (!built.add_face(corners).is_valid()) {
            return {};
        }
    }
    Subdivider subdivider;
    subdivider.attach(built);
    subdivider(levels);
    subdivider.detach();
    std::vector<Point> points;
    for (auto v : built.vertices()) {
        points.push_back({built.point(v)[0], built.point(v)[1], built.point(v)[2]});
    }
    return points;
}

// Without the vertices that no face uses, which the peers cannot hold through a subdivision.
Polygons without_isolated(const Polygons &mesh)
{
    std::vector<mt_index> numbers(mesh.points.size(), MT_NONE);
    Polygons result;
    for (const Face &face : mesh.faces) {
        result.faces.emplace_back();
        for (mt_index v : face) {
            if (numbers[v] == MT_NONE) {
                numbers[v] = static_cast<mt_index>(result.points.size());
                result.points.push_back(mesh.points[v]);
            }
            result.faces.back().push_back(numbers[v]);
        }
    }
    return result;
}

void compare_with_masks(const std::string &name, const Polygons &ours, const Polygons &masks, double reach)
{
    expect(ours.points.size() == masks.points.size() && ours.faces == masks.faces, name + ": order of the masks");
    double worst = 0;
    for (std::size_t i = 0; i < std::min(ours.points.size(), masks.points.size()); i++) {
        worst = std::max(worst, distance(ours.points[i], masks.points[i]));
    }
    expect(worst <= reach, name + ": " + std::to_string(worst / reach) + " tolerances from the masks");
}

void compare_with_peers(const std::string &name, const Polygons &input, const Polygons &ours, unsigned levels,
                        const std::vector<bool> &boundary, double reach)
{
    bool open = std::find(boundary.begin(), boundary.end(), true) != boundary.end();
    std::vector<bool> isolated(input.points.size(), true), skip = boundary;
    for (const Face &face : input.faces) {
        for (mt_index v : face) {
            isolated[v] = false;
        }
    }
    Polygons used = without_isolated(input);
    std::vector<Point> cgal = cgal_points(used, levels);
    if (cgal.empty()) {
        std::printf("skipped %s: CGAL refuses a face\n", name.c_str());
    } else {
        expect(unmatched(ours.points, cgal, reach, isolated) == 0, name + ": CGAL");
    }
    for (std::size_t i = 0; i < skip.size(); i++) {
        skip[i] = skip[i] || isolated[i];
    }
    std::vector<Point> openmesh =
        open && levels > 1 ? std::vector<Point>() : openmesh_points<OpenMeshMesh, CatmullClark>(used, levels);
    if (open && levels > 1) {
        std::printf("skipped %s: OpenMesh's boundary mask is not the cubic B-spline's\n", name.c_str());
    } else if (openmesh.empty()) {
        std::printf("skipped %s: OpenMesh refuses a face\n", name.c_str());
    } else {
        expect(unmatched(ours.points, openmesh, reach, skip) == 0, name + ": OpenMesh");
    }
}

// The mesh cut into triangles, by Loop's scheme. Each vertex of the peers is asked for, not the other way round: ours
// has the isolated ones, too.
void compare_loop(mt_context *context, const std::string &name, const mt_mesh *mesh, unsigned levels)
{
    mt_mesh *triangles = nullptr, *refined = nullptr;
    mt_subdivide_options options = {};
    options.scheme = MT_SUBDIVIDE_SCHEME_LOOP;
    options.level_count = levels;
    std::string label = name + ", Loop, level " + std::to_string(levels);
    if (mt_mesh_triangulate(context, mesh, &triangles) != MT_OK ||
        mt_subdivide(context, triangles, &options, &refined) != MT_OK) {
        std::printf("skipped %s: %s\n", label.c_str(), mt_context_error(context)->message);
        mt_context_clear_error(context);
        mt_mesh_destroy(context, triangles);
        return;
    }
    Polygons input = polygons_of(triangles), ours = polygons_of(refined), used = without_isolated(input);
    double reach = tolerance * diagonal(input);
    std::vector<Point> cgal = cgal_points(used, levels, Scheme::loop);
    std::vector<Point> openmesh = openmesh_points<OpenMeshTriangles, Loop>(used, levels);
    for (const auto &[peer, points] : {std::pair("CGAL", &cgal), std::pair("OpenMesh", &openmesh)}) {
        if (points->empty()) {
            std::printf("skipped %s: %s refuses a face\n", label.c_str(), peer);
            continue;
        }
        std::size_t isolated = input.points.size() - used.points.size();
        expect(points->size() + isolated == ours.points.size(), label + ": vertices of " + peer);
        expect(unmatched(*points, ours.points, reach, {}) == 0, label + ": " + peer);
    }
    mt_mesh_destroy(context, refined);
    mt_mesh_destroy(context, triangles);
}

// Level 2 of larger meshes would only take long.
constexpr mt_index two_level_corners = 60000;

void compare(mt_context *context, const std::string &name, mt_mesh *mesh)
{
    if (mesh->position_type != MT_F64) {
        mt_mesh_set_position_type(context, mesh, MT_F64, nullptr);
    }
    Polygons input = polygons_of(mesh), masks = input;
    std::vector<bool> boundary;
    for (unsigned level = 1; level <= (mesh->corner_count <= two_level_corners ? 2u : 1u); level++) {
        mt_subdivide_options options = {};
        options.level_count = level;
        mt_mesh *refined = nullptr;
        if (mt_subdivide(context, mesh, &options, &refined) != MT_OK) {
            std::printf("skipped %s: %s\n", name.c_str(), mt_context_error(context)->message);
            mt_context_clear_error(context);
            return;
        }
        Reference reference(masks);
        for (mt_index v = 0; level == 1 && v < mesh->vertex_count; v++) {
            boundary.push_back(reference.on_boundary(v));
        }
        masks = reference.refined();
        Polygons ours = polygons_of(refined);
        mt_mesh_destroy(context, refined);
        std::string label = name + ", level " + std::to_string(level);
        double reach = tolerance * diagonal(input);
        compare_with_masks(label, ours, masks, reach);
        compare_with_peers(label, input, ours, level, boundary, reach);
        compare_loop(context, name, mesh, level);
    }
}

void compare_primitives(mt_context *context)
{
    std::size_t count = 0;
    const mt_primitive *primitives = mt_primitives(&count);
    for (std::size_t i = 0; i < count; i++) {
        mt_mesh *mesh = nullptr;
        mt_status status = mt_generate(context, primitives[i].name, nullptr, &mesh);
        expect(status == MT_OK, std::string("generating ") + primitives[i].name);
        if (status == MT_OK && mesh->face_count) {
            compare(context, primitives[i].name, mesh);
        }
        mt_mesh_destroy(context, mesh);
    }
}

void compare_folder(mt_context *context, const std::string &folder)
{
    if (!std::filesystem::is_directory(folder)) {
        std::printf("skipped %s: not there\n", folder.c_str());
        return;
    }
    std::set<std::string> paths;
    for (const auto &entry : std::filesystem::directory_iterator(folder)) {
        if (mt_mesh_format_by_extension(entry.path().extension().string().c_str() + (entry.path().has_extension()))) {
            paths.insert(entry.path().string());
        }
    }
    for (const std::string &path : paths) {
        mt_mesh *mesh = nullptr;
        mt_status status = mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr);
        expect(status == MT_OK, "reading " + path + ": " + mt_context_error(context)->message);
        mt_context_clear_error(context);
        if (status == MT_OK && mesh->face_count) {
            compare(context, path, mesh);
        }
        mt_mesh_destroy(context, mesh);
    }
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    compare_primitives(context);
    compare_folder(context, "meshes/valid");
    compare_folder(context, "../shared/corpus");
    mt_context_destroy(context);
    std::printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
