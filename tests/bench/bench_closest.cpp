// Nearest points beside CGAL's AABB_tree (doubles, squared distances), and the Hausdorff distance beside CGAL's bounded
// one at the same error bound. The error column is the largest difference of distances.
#include "tests/bench/bench.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <random>

namespace bench
{
namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
using CgalTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

CgalMesh cgal_of(const mt_mesh *mesh)
{
    CgalMesh built;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(Kernel::Point_3(p.x, p.y, p.z));
    }
    using Vertex = CgalMesh::Vertex_index;
    for (const mt_index *c = mesh->corner_vertices; c < mesh->corner_vertices + mesh->corner_count; c += 3) {
        built.add_face(Vertex(c[0]), Vertex(c[1]), Vertex(c[2]));
    }
    return built;
}

using Points = std::vector<mt_vec3>;

Points random_points(std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1.5, 1.5);
    Points points(count);
    for (mt_vec3 &p : points) {
        p = {unit(random), unit(random), unit(random)};
    }
    return points;
}

// Vertices moved by a thousandth.
Points near_points(const mt_mesh *mesh, std::size_t count)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1e-3, 1e-3);
    Points points(count);
    for (mt_vec3 &p : points) {
        mt_vec3 vertex = mt_mesh_position(mesh, static_cast<mt_index>(random() % mesh->vertex_count));
        p = mt_vec3_add(vertex, {unit(random), unit(random), unit(random)});
    }
    return points;
}

struct Search {
    const mt_surface_tree *tree;
    const Points *points;
};

void search_block(void *user, std::uint64_t begin, std::uint64_t end)
{
    auto *search = static_cast<Search *>(user);
    for (std::uint64_t i = begin; i < end; i++) {
        mt_closest closest;
        mt_surface_tree_closest(search->tree, (*search->points)[i], nullptr, &closest);
    }
}

double largest_difference(const mt_surface_tree *tree, const CgalTree &cgal, const Points &points)
{
    double largest = 0;
    for (mt_vec3 p : points) {
        mt_closest closest;
        mt_surface_tree_closest(tree, p, nullptr, &closest);
        double theirs = std::sqrt(cgal.squared_distance(Kernel::Point_3(p.x, p.y, p.z)));
        largest = std::max(largest, std::fabs(theirs - closest.distance));
    }
    return largest;
}

void compare_points(const char *name, const mt_mesh *mesh, const mt_surface_tree *tree, const CgalTree &cgal,
                    const Points &points)
{
    Row row;
    row.name = name;
    row.mesh = std::to_string(points.size()) + " points";
    row.faces = mesh->face_count;
    row.peer = "CGAL";
    row.error = largest_difference(tree, cgal, points);
    compare(
        row,
        [&](mt_context *context) {
            Search search{tree, &points};
            mt_parallel_for(context, points.size(), 256, search_block, &search);
        },
        [&] {
            for (mt_vec3 p : points) {
                cgal.closest_point_and_primitive(Kernel::Point_3(p.x, p.y, p.z));
            }
        });
}

// The torus against itself, moved a little and turned.
void compare_deviation(std::uint64_t size)
{
    mt_mesh *mesh = wavy_torus(size, false, false), *moved = wavy_torus(size, false, false);
    for (mt_index v = 0; v < moved->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(moved, v);
        mt_mesh_set_position(moved, v, {p.x * 1.01 + 0.01 * p.y, p.y - 0.01 * p.x, p.z + 0.005});
    }
    CgalMesh first = cgal_of(mesh), second = cgal_of(moved);
    const double bound = 1e-4;
    mt_deviation_options options{};
    options.tolerance = bound;
    options.maximum_only = true;
    mt_deviation ours{};
    require(shared_context(), mt_measure_deviation(shared_context(), mesh, moved, &options, &ours));
    namespace processing = CGAL::Polygon_mesh_processing;
    double theirs = 0;
    Row row;
    row.name = "Hausdorff distance";
    row.mesh = "torus, moved";
    row.faces = mesh->face_count;
    row.peer = "CGAL";
    row.note = "both bounded to 1e-4";
    theirs = processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(first, second, bound);
    row.error = std::fabs(theirs - ours.hausdorff);
    mt_deviation_release(shared_context(), &ours);
    compare(
        row,
        [&](mt_context *context) {
            mt_deviation deviation{};
            require(context, mt_measure_deviation(context, mesh, moved, &options, &deviation));
            mt_deviation_release(context, &deviation);
        },
        [&] { processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(first, second, bound); });
    mt_mesh_destroy(shared_context(), mesh);
    mt_mesh_destroy(shared_context(), moved);
}

} // namespace

void run_closest()
{
    mt_context *context = shared_context();
    for (std::uint64_t size : sizes) {
        mt_mesh *mesh = wavy_torus(size, false, false);
        mt_triangulation triangulation;
        mt_surface_tree *tree = nullptr;
        require(context, mt_triangulation_init(context, mesh, &triangulation));
        require(context, mt_surface_tree_create(context, mesh, &triangulation, nullptr, &tree));
        CgalMesh cgal_mesh = cgal_of(mesh);
        CgalTree cgal(faces(cgal_mesh).first, faces(cgal_mesh).second, cgal_mesh);
        cgal.accelerate_distance_queries();
        compare_points("nearest, at random", mesh, tree, cgal, random_points(5000));
        compare_points("nearest, at surface", mesh, tree, cgal, near_points(mesh, 20000));
        mt_surface_tree_destroy(context, tree);
        mt_triangulation_release(context, &triangulation);
        mt_mesh_destroy(context, mesh);
    }
    compare_deviation(10000);
    compare_deviation(100000);
}

} // namespace bench
