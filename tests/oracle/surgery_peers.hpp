// Single operations on a mesh held by CGAL and by OpenMesh, so named by vertices that ours can be held beside them.
#ifndef TESTS_ORACLE_SURGERY_PEERS_HPP
#define TESTS_ORACLE_SURGERY_PEERS_HPP

#include "tests/oracle/surgery_ours.hpp"

#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

// A number that stands for no vertex.
constexpr std::size_t none = std::size_t(-1);

class CgalMesh
{
    using Graph = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
    using Vertex = Graph::Vertex_index;
    using Halfedge = Graph::Halfedge_index;

    Graph graph;

    static Vertex vertex(std::size_t v)
    {
        return Vertex(Graph::size_type(v));
    }

    Halfedge between(std::size_t a, std::size_t b) const
    {
        return graph.halfedge(vertex(a), vertex(b));
    }

    std::vector<Vertex> vertices_of(const Polygon &face) const
    {
        std::vector<Vertex> vertices;
        for (std::size_t v : face) {
            vertices.push_back(vertex(v));
        }
        return vertices;
    }

    // The half-edge towards v outside; v must lie on the boundary.
    Halfedge border_into(std::size_t v) const
    {
        Halfedge h = graph.halfedge(vertex(v));
        while (!graph.is_border(h)) {
            h = graph.opposite(graph.next(h));
        }
        return h;
    }

    bool split_corner(Halfedge in, std::size_t v, std::size_t x, std::size_t y)
    {
        if (in_triangle(in)) {
            CGAL::Euler::add_center_vertex(in, graph);
            return true;
        }
        if (!graph.is_border(in)) {
            return false;
        }
        std::size_t w = std::size_t(graph.add_vertex());
        if (x != none) {
            graph.add_face(vertices_of({v, x, w}));
        }
        if (y != none) {
            graph.add_face(vertices_of({v, w, y}));
        }
        return true;
    }

    bool in_triangle(Halfedge h) const
    {
        return !graph.is_border(h) && graph.next(graph.next(graph.next(h))) == h;
    }

  public:
    // False when CGAL cannot hold all faces.
    bool build(std::size_t vertex_count, const Polygons &polygons)
    {
        bool whole = true;
        for (std::size_t v = 0; v < vertex_count; v++) {
            graph.add_vertex(CGAL::Simple_cartesian<double>::Point_3(double(v), 0, 0));
        }
        for (const Polygon &face : polygons) {
            whole = whole && graph.add_face(vertices_of(face)) != Graph::null_face();
        }
        return whole;
    }

    // `renamed` is called `name`.
    Polygons faces(std::size_t renamed = none, std::size_t name = none) const
    {
        Polygons polygons;
        for (auto face : graph.faces()) {
            polygons.emplace_back();
            for (auto v : graph.vertices_around_face(graph.halfedge(face))) {
                polygons.back().push_back(std::size_t(v) == renamed ? name : std::size_t(v));
            }
        }
        return canonical(polygons);
    }

    bool has_non_manifold_vertex() const
    {
        std::vector<Halfedge> found;
        CGAL::Polygon_mesh_processing::non_manifold_vertices(graph, std::back_inserter(found));
        return !found.empty();
    }

    // CGAL's flip has no predicate; its preconditions say triangles, and that the new edge is not there.
    bool may_swap(std::size_t a, std::size_t b) const
    {
        Halfedge h = between(a, b), o = graph.opposite(h);
        return in_triangle(h) && in_triangle(o) && graph.target(graph.next(h)) != graph.target(graph.next(o)) &&
               !graph.halfedge(graph.target(graph.next(h)), graph.target(graph.next(o))).is_valid();
    }

    void swap_edge(std::size_t a, std::size_t b)
    {
        CGAL::Euler::flip_edge(between(a, b), graph);
    }

    void split_edge(std::size_t a, std::size_t b)
    {
        Halfedge h = between(a, b), o = graph.opposite(h);
        bool left = in_triangle(h), right = in_triangle(o);
        Halfedge in = CGAL::Euler::split_edge(h, graph);
        if (left) {
            CGAL::Euler::split_face(in, graph.next(h), graph);
        }
        if (right) {
            o = graph.opposite(h);
            CGAL::Euler::split_face(o, graph.next(graph.opposite(in)), graph);
        }
    }

    // CGAL's split gives the faces at the cuts a side; cutting those off is a second step. It must move an edge: where
    // none lies between the cuts, a triangle there is cut in three, or triangles are hung on the edges outside. False
    // where a polygon of more sides lies there, for which CGAL has no such step.
    bool split_vertex(std::size_t v, std::size_t x, std::size_t y)
    {
        Halfedge from = x == none ? Halfedge() : between(x, v);
        Halfedge first = y == none ? border_into(v) : between(y, v);
        Halfedge last = x == none ? border_into(v) : graph.prev(graph.opposite(from));
        if (first == last) {
            return split_corner(first, v, x, y);
        }
        Halfedge joined = CGAL::Euler::split_vertex(first, last, graph), back = graph.opposite(joined);
        std::size_t w = std::size_t(graph.target(back));
        if (x != none && !graph.is_border(joined)) {
            CGAL::Euler::split_face(graph.prev(joined), graph.next(joined), graph);
        } else if (x != none) {
            graph.add_face(vertices_of({v, x, w}));
        }
        if (y != none && !graph.is_border(back)) {
            CGAL::Euler::split_face(back, graph.prev(graph.prev(back)), graph);
        } else if (y != none) {
            graph.add_face(vertices_of({v, w, y}));
        }
        return true;
    }

    bool may_collapse(std::size_t a, std::size_t b) const
    {
        return CGAL::Euler::does_satisfy_link_condition(graph.edge(between(a, b)), graph);
    }

    // Returns the vertex that is left of the two.
    std::size_t collapse_edge(std::size_t a, std::size_t b)
    {
        return std::size_t(CGAL::Euler::collapse_edge(graph.edge(between(a, b)), graph));
    }

    void remove_face(const Polygon &face)
    {
        CGAL::Euler::remove_face(between(face[0], face[1]), graph);
    }

    bool may_add(const Polygon &face) const
    {
        return CGAL::Euler::can_add_face(vertices_of(face), graph);
    }

    bool add_face(const Polygon &face)
    {
        return graph.add_face(vertices_of(face)) != Graph::null_face();
    }
};

class OpenMeshTriangles
{
    using Mesh = OpenMesh::TriMesh_ArrayKernelT<>;
    Mesh mesh;

    static Mesh::VertexHandle vertex(std::size_t v)
    {
        return Mesh::VertexHandle(int(v));
    }

    Mesh::HalfedgeHandle between(std::size_t a, std::size_t b) const
    {
        return mesh.find_halfedge(vertex(a), vertex(b));
    }

  public:
    bool build(std::size_t vertex_count, const Polygons &polygons)
    {
        bool whole = true;
        mesh.request_face_status();
        mesh.request_edge_status();
        mesh.request_vertex_status();
        for (std::size_t v = 0; v < vertex_count; v++) {
            mesh.add_vertex({float(v), 0, 0});
        }
        for (const Polygon &face : polygons) {
            whole = whole && mesh.add_face(vertex(face[0]), vertex(face[1]), vertex(face[2])).is_valid();
        }
        return whole;
    }

    Polygons faces() const
    {
        Polygons polygons;
        for (auto face : mesh.faces()) {
            polygons.emplace_back();
            for (auto v : mesh.fv_range(face)) {
                polygons.back().push_back(std::size_t(v.idx()));
            }
        }
        return canonical(polygons);
    }

    bool may_swap(std::size_t a, std::size_t b) const
    {
        return mesh.is_flip_ok(mesh.edge_handle(between(a, b)));
    }

    void swap_edge(std::size_t a, std::size_t b)
    {
        mesh.flip(mesh.edge_handle(between(a, b)));
    }

    void split_edge(std::size_t a, std::size_t b)
    {
        mesh.split(mesh.edge_handle(between(a, b)), mesh.add_vertex({0, 0, 0}));
    }

    bool may_collapse(std::size_t a, std::size_t b)
    {
        return mesh.is_collapse_ok(between(a, b));
    }

    void collapse_edge(std::size_t a, std::size_t b)
    {
        mesh.collapse(between(a, b));
    }

    void split_vertex(std::size_t v, std::size_t x, std::size_t y)
    {
        mesh.vertex_split(mesh.add_vertex({0, 0, 0}), vertex(v), vertex(x), vertex(y));
    }
};

#endif
