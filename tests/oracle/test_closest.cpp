// Nearest points, exact ray hits and Hausdorff distances beside CGAL's AABB_tree: nearest points and hits in exact
// arithmetic, of random points and rays at every small mesh.
#include "tests/oracle/mesh_files.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/distance.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <random>
#include <set>

namespace
{

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Triangles = std::vector<Exact::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Exact, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Exact, Primitive>>;

Exact::Point_3 exact_point(mt_vec3 p)
{
    return {p.x, p.y, p.z};
}

struct Target {
    mt_mesh *mesh = nullptr;
    mt_triangulation triangulation{};
    mt_surface_tree *tree = nullptr;
    Triangles triangles;
};

// CGAL takes no triangles without area; both sides do without them.
bool prepare(mt_context *context, Target &target)
{
    if (mt_triangulation_init(context, target.mesh, &target.triangulation) != MT_OK ||
        mt_surface_tree_create(context, target.mesh, &target.triangulation, nullptr, &target.tree) != MT_OK) {
        return false;
    }
    for (mt_index t = 0; t < target.triangulation.triangle_count; t++) {
        Exact::Point_3 p[3];
        for (mt_index side = 0; side < 3; side++) {
            mt_index corner = mt_triangulation_corner(&target.triangulation, t, side);
            p[side] = exact_point(mt_mesh_position(target.mesh, target.mesh->corner_vertices[corner]));
        }
        target.triangles.emplace_back(p[0], p[1], p[2]);
        if (target.triangles.back().is_degenerate()) {
            return false;
        }
    }
    return true;
}

mt_vec3 random_point(const mt_bounds &bounds, std::mt19937 &random, double reach)
{
    std::uniform_real_distribution<double> unit(-reach, reach);
    mt_vec3 middle = mt_vec3_scale(mt_vec3_add(bounds.minimum, bounds.maximum), 0.5);
    double size = mt_vec3_max_abs(mt_vec3_subtract(bounds.maximum, bounds.minimum));
    return mt_vec3_add(middle, mt_vec3_scale({unit(random), unit(random), unit(random)}, size));
}

void compare_points(const Target &target, const Tree &cgal, const std::string &file, Tally &tally)
{
    std::mt19937 random(1);
    mt_bounds bounds = mt_mesh_bounds(target.mesh);
    double worst = 0, size = mt_vec3_max_abs(mt_vec3_subtract(bounds.maximum, bounds.minimum));
    for (int i = 0; i < 200; i++) {
        mt_vec3 p = random_point(bounds, random, i % 2 ? 0.6 : 2);
        mt_closest closest;
        mt_surface_tree_closest(target.tree, p, nullptr, &closest);
        double theirs = std::sqrt(CGAL::to_double(cgal.squared_distance(exact_point(p))));
        worst = std::max(worst, std::fabs(closest.distance - theirs) / size);
    }
    tally.expect(worst < 1e-15, file + ": nearest points, off by " + std::to_string(worst * 1e15) + "e-15 of the size");
}

// Exactly which triangles the ray meets, and the least t of them.
struct ExactHits {
    std::set<std::size_t> triangles;
    double t = INFINITY;
};

ExactHits exact_hits(const Target &target, const Tree &cgal, const mt_ray &ray)
{
    Exact::Point_3 origin = exact_point(ray.origin);
    Exact::Vector_3 direction(ray.direction.x, ray.direction.y, ray.direction.z);
    std::vector<Tree::Primitive_id> met;
    cgal.all_intersected_primitives(Exact::Ray_3(origin, direction), std::back_inserter(met));
    ExactHits hits;
    for (auto one : met) {
        Exact::Vector_3 normal = one->supporting_plane().orthogonal_vector();
        if (normal * direction != 0) { // in its plane: a miss by definition
            double t = CGAL::to_double((normal * (one->vertex(0) - origin)) / (normal * direction));
            hits.triangles.insert(static_cast<std::size_t>(one - target.triangles.cbegin()));
            hits.t = std::min(hits.t, t);
        }
    }
    return hits;
}

void compare_rays(const Target &target, const Tree &cgal, const std::string &file, Tally &tally)
{
    std::mt19937 random(2);
    mt_bounds bounds = mt_mesh_bounds(target.mesh);
    int wrong = 0;
    for (int i = 0; i < 300; i++) {
        mt_vec3 from = random_point(bounds, random, 2), to = random_point(bounds, random, 0.5);
        mt_ray ray = mt_ray_make(from, mt_vec3_subtract(to, from));
        ExactHits exact = exact_hits(target, cgal, ray);
        mt_ray_hit hit;
        bool found = mt_surface_tree_nearest_hit(target.tree, &ray, MT_RAY_EXACT, &hit);
        bool agrees = found == !exact.triangles.empty();
        agrees = agrees && (!found || (exact.triangles.count(hit.triangle) && std::fabs(hit.t - exact.t) < 1e-12));
        wrong += !agrees;
    }
    tally.expect_equal(wrong, 0, file + ": rays that differ from exact arithmetic");
}

using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Inexact::Point_3>;

CgalMesh cgal_of(const mt_mesh *mesh)
{
    CgalMesh built;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        built.add_vertex(Inexact::Point_3(p.x, p.y, p.z));
    }
    using Vertex = CgalMesh::Vertex_index;
    for (const mt_index *c = mesh->corner_vertices; c < mesh->corner_vertices + mesh->corner_count; c += 3) {
        built.add_face(Vertex(c[0]), Vertex(c[1]), Vertex(c[2]));
    }
    return built;
}

void compare_hausdorff(mt_context *context, const char *name, mt_index coarse, mt_index fine, Tally &tally)
{
    const double bound = 1e-4;
    mt_mesh *meshes[2] = {nullptr, nullptr}, *triangles[2] = {nullptr, nullptr};
    for (int i = 0; i < 2; i++) {
        mt_generate_options how{};
        how.resolution = i ? fine : coarse;
        mt_generate(context, name, &how, &meshes[i]);
        mt_mesh_triangulate(context, meshes[i], &triangles[i]);
    }
    mt_deviation_options options{};
    options.tolerance = bound;
    mt_deviation ours{};
    mt_measure_deviation(context, triangles[0], triangles[1], &options, &ours);
    CgalMesh first = cgal_of(triangles[0]), second = cgal_of(triangles[1]);
    double theirs = CGAL::Polygon_mesh_processing::bounded_error_symmetric_Hausdorff_distance<CGAL::Sequential_tag>(
        first, second, bound);
    tally.expect(ours.hausdorff > 0 && std::fabs(ours.hausdorff - theirs) <= 2 * bound,
                 std::string(name) + ": Hausdorff " + std::to_string(ours.hausdorff) + ", they say " +
                     std::to_string(theirs));
    mt_deviation_release(context, &ours);
    for (int i = 0; i < 2; i++) {
        mt_mesh_destroy(context, meshes[i]);
        mt_mesh_destroy(context, triangles[i]);
    }
}

} // namespace

int main()
{
    Tally tally;
    mt_context *context = mt_context_create(nullptr);
    for (const std::string &file : mesh_files()) {
        Target target;
        if (mt_mesh_read_file(context, file.c_str(), nullptr, &target.mesh, nullptr) != MT_OK) {
            mt_context_clear_error(context);
            continue;
        }
        bool is_small = target.mesh->face_count && target.mesh->face_count < 20000;
        if (is_small && !mt_mesh_bounds(target.mesh).non_finite_count && prepare(context, target)) {
            Tree cgal(target.triangles.cbegin(), target.triangles.cend());
            compare_points(target, cgal, file, tally);
            compare_rays(target, cgal, file, tally);
        }
        mt_surface_tree_destroy(context, target.tree);
        mt_triangulation_release(context, &target.triangulation);
        mt_mesh_destroy(context, target.mesh);
    }
    compare_hausdorff(context, "icosphere", 2, 4, tally);
    compare_hausdorff(context, "torus", 12, 40, tally);
    mt_context_destroy(context);
    return tally.conclude();
}
