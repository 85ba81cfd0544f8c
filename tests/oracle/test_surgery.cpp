// Half-edge surgery beside CGAL::Euler and OpenMesh: random sequences, in which each operation is also done by them on
// the same faces. The verdicts must agree, and the faces that are left. Where a definition differs, the difference has
// a name, its cause is checked each time that it is met, and it is counted.
#include "tests/oracle/surgery_ours.hpp"
#include "tests/oracle/surgery_peers.hpp"

#include <map>
#include <set>

namespace
{

Tally tally;
std::map<std::string, int> differences, compared;

// Names a difference whose cause must hold.
void differ(const std::string &name, bool cause)
{
    differences[name]++;
    tally.expect(cause, name + ": the cause is not there");
}

template <typename Mesh> bool hold(Mesh &mesh, const Surgery &surgery, const Polygons &before)
{
    bool whole = mesh.build(surgery.structure().vertex_count, before);
    tally.expect(whole, "their mesh holds what ours does");
    return whole;
}

bool has_back_to_back(const Polygons &faces)
{
    std::set<Polygon> met;
    for (Polygon face : faces) {
        std::sort(face.begin(), face.end());
        if (!met.insert(face).second) {
            return true;
        }
    }
    return false;
}

bool all_triangles(const Polygons &faces)
{
    return std::all_of(faces.begin(), faces.end(), [](const Polygon &face) { return face.size() == 3; });
}

void compare(const std::string &what, const Polygons &ours, const Polygons &theirs)
{
    compared[what]++;
    tally.expect(ours == theirs, what + " leaves other faces");
}

void try_swap(Surgery &surgery, mt_index h)
{
    Polygons before = surgery.faces();
    std::size_t a = mt_halfedge_tail(&surgery.structure(), h), b = mt_halfedge_head(&surgery.structure(), h);
    bool may = mt_halfedge_can_swap_edge(surgery.ours, h / 2) == MT_SURGERY_ALLOWED;
    CgalMesh cgal;
    OpenMeshTriangles open_mesh;
    bool triangles = all_triangles(before);
    if (!hold(cgal, surgery, before) || (triangles && !hold(open_mesh, surgery, before))) {
        return;
    }
    tally.expect(cgal.may_swap(a, b) == may, "CGAL's verdict on a swap");
    if (triangles) {
        tally.expect(open_mesh.may_swap(a, b) == may, "OpenMesh's verdict on a swap");
    }
    if (may) {
        cgal.swap_edge(a, b);
        mt_halfedge_swap_edge(surgery.context, surgery.ours, h / 2);
        compare("CGAL's swap", surgery.faces(), cgal.faces());
        if (triangles) {
            open_mesh.swap_edge(a, b);
            compare("OpenMesh's swap", surgery.faces(), open_mesh.faces());
        }
    }
}

void try_split_edge(Surgery &surgery, mt_index h)
{
    Polygons before = surgery.faces();
    std::size_t a = mt_halfedge_tail(&surgery.structure(), h), b = mt_halfedge_head(&surgery.structure(), h);
    CgalMesh cgal;
    OpenMeshTriangles open_mesh;
    bool triangles = all_triangles(before);
    if (!hold(cgal, surgery, before) || (triangles && !hold(open_mesh, surgery, before))) {
        return;
    }
    if (mt_halfedge_can_split_edge(surgery.ours, h) != MT_SURGERY_ALLOWED) {
        differ("we split no edge between two triangles of the same vertices", has_back_to_back(before));
        return;
    }
    cgal.split_edge(a, b);
    mt_halfedge_split_edge(surgery.context, surgery.ours, h, 0.5, nullptr);
    compare("CGAL's edge split", surgery.faces(), cgal.faces());
    if (triangles) {
        open_mesh.split_edge(a, b);
        compare("OpenMesh's edge split", surgery.faces(), open_mesh.faces());
    }
}

void try_split_vertex(Surgery &surgery, mt_index from)
{
    Polygons before = surgery.faces();
    const mt_halfedge_mesh &own = surgery.structure();
    mt_index v = mt_halfedge_head(&own, from), to = from;
    for (std::size_t i = below(mt_halfedge_valence(&own, v)); i > 0; i--) {
        to = mt_halfedge_clockwise(&own, to);
    }
    bool boundary = mt_halfedge_vertex_is_boundary(&own, v);
    std::size_t missing = boundary ? below(4) : 2;
    from = missing == 0 ? MT_NONE : from;
    to = missing == 1 ? MT_NONE : to;
    std::size_t x = from == MT_NONE ? none : mt_halfedge_tail(&own, from);
    std::size_t y = to == MT_NONE ? none : mt_halfedge_tail(&own, to);
    CgalMesh cgal;
    OpenMeshTriangles open_mesh;
    bool may = mt_halfedge_can_split_vertex(surgery.ours, v, from, to) == MT_SURGERY_ALLOWED;
    bool triangles = all_triangles(before) && x != none && y != none;
    if (!hold(cgal, surgery, before) || (triangles && !hold(open_mesh, surgery, before))) {
        return;
    }
    tally.expect(may == (x != y), "a vertex is split along two edges");
    if (!may) {
        return;
    }
    bool inner = from != MT_NONE && to != MT_NONE && mt_halfedge_clockwise(&own, to) != from && !boundary;
    bool at_polygon = to != MT_NONE && mt_halfedge_face(&own, to) != MT_NONE &&
                      surgery.face(mt_halfedge_face(&own, to)).size() > 3 && mt_halfedge_clockwise(&own, to) == from;
    bool expressible = cgal.split_vertex(v, x, y);
    mt_halfedge_split_vertex(surgery.context, surgery.ours, v, from, to, nullptr);
    if (expressible) {
        compare("CGAL's vertex split", surgery.faces(), cgal.faces());
    } else {
        differ("CGAL does not split a vertex between two sides of a polygon", at_polygon);
    }
    if (triangles && inner) {
        open_mesh.split_vertex(v, x, y);
        compare("OpenMesh's vertex split", surgery.faces(), open_mesh.faces());
    }
}

void try_collapse(Surgery &surgery, mt_index h)
{
    Polygons before = surgery.faces();
    if (!all_triangles(before)) {
        return; /* their conditions are those of triangles */
    }
    std::size_t a = mt_halfedge_tail(&surgery.structure(), h), b = mt_halfedge_head(&surgery.structure(), h);
    mt_surgery_verdict verdict = mt_halfedge_can_collapse_edge(surgery.ours, h);
    bool may = verdict == MT_SURGERY_ALLOWED;
    CgalMesh cgal;
    OpenMeshTriangles open_mesh;
    if (!hold(cgal, surgery, before) || !hold(open_mesh, surgery, before)) {
        return;
    }
    tally.expect(cgal.may_collapse(a, b) == may,
                 "CGAL's verdict on a collapse, where ours is that " + std::string(mt_surgery_verdict_words(verdict)));
    bool open_mesh_may = open_mesh.may_collapse(a, b);
    if (open_mesh_may && verdict == MT_SURGERY_DUPLICATE_FACE) {
        open_mesh.collapse_edge(a, b);
        differ("OpenMesh collapses a tetrahedron to two faces back to back",
               !has_back_to_back(before) && has_back_to_back(open_mesh.faces()));
        return;
    }
    tally.expect(open_mesh_may == may, "OpenMesh's verdict on a collapse, where ours is that " +
                                           std::string(mt_surgery_verdict_words(verdict)));
    if (may) {
        std::size_t left = cgal.collapse_edge(a, b);
        mt_halfedge_collapse_edge(surgery.context, surgery.ours, h, 0);
        compare("CGAL's collapse", surgery.faces(), cgal.faces(left, b));
        open_mesh.collapse_edge(a, b);
        compare("OpenMesh's collapse", surgery.faces(), open_mesh.faces());
    }
}

void try_remove(Surgery &surgery, mt_index which)
{
    Polygons before = surgery.faces();
    CgalMesh cgal;
    if (!hold(cgal, surgery, before)) {
        return;
    }
    mt_surgery_verdict verdict = mt_halfedge_can_remove_face(surgery.ours, which);
    cgal.remove_face(surgery.face(which));
    tally.expect(cgal.has_non_manifold_vertex() == (verdict == MT_SURGERY_PINCH),
                 "what CGAL's removal leaves is pinched");
    if (verdict == MT_SURGERY_ALLOWED) {
        mt_halfedge_remove_face(surgery.context, surgery.ours, which);
        compare("CGAL's face removal", surgery.faces(), cgal.faces());
    }
}

void try_add(Surgery &surgery, const Polygon &face)
{
    Polygons before = surgery.faces();
    std::vector<mt_index> vertices(face.begin(), face.end());
    CgalMesh cgal;
    if (!hold(cgal, surgery, before)) {
        return;
    }
    mt_surgery_verdict verdict = mt_halfedge_can_add_face(surgery.ours, mt_index(vertices.size()), vertices.data());
    bool theirs = cgal.may_add(face);
    if (theirs && verdict == MT_SURGERY_PINCH) {
        cgal.add_face(face);
        differ("CGAL adds a face that pinches a vertex", cgal.has_non_manifold_vertex());
        return;
    }
    if (theirs && verdict == MT_SURGERY_DUPLICATE_FACE) {
        cgal.add_face(face);
        differ("CGAL adds a face on the back of another", has_back_to_back(cgal.faces()));
        return;
    }
    tally.expect(theirs == (verdict == MT_SURGERY_ALLOWED),
                 "CGAL's verdict on a new face, where ours is that " + std::string(mt_surgery_verdict_words(verdict)));
    if (verdict == MT_SURGERY_ALLOWED && theirs) {
        tally.expect(cgal.add_face(face), "CGAL adds the face that it says it can");
        mt_halfedge_add_face(surgery.context, surgery.ours, mt_index(vertices.size()), vertices.data(), nullptr);
        compare("CGAL's new face", surgery.faces(), cgal.faces());
    }
}

// Mostly beside a boundary edge, with the next or any third vertex.
Polygon random_face(const Surgery &surgery, mt_index h, bool triangles)
{
    const mt_halfedge_mesh &own = surgery.structure();
    for (int i = 0; i < 100 && !mt_halfedge_is_boundary(&own, h); i++) {
        h = surgery.random_halfedge();
    }
    Polygon face = {mt_halfedge_tail(&own, h), mt_halfedge_head(&own, h)};
    std::size_t count = triangles ? 3 : 3 + below(2);
    mt_index at = h;
    while (face.size() < count) {
        at = mt_halfedge_next(&own, at);
        std::size_t any = below(own.vertex_count);
        bool living = !surgery.ours->vertex_deleted[any] && std::count(face.begin(), face.end(), any) == 0;
        std::size_t along = mt_halfedge_head(&own, at);
        face.push_back(living && below(2) ? any : along);
    }
    bool simple = std::set<std::size_t>(face.begin(), face.end()).size() == face.size();
    return simple ? face : Polygon{};
}

void operate(Surgery &surgery, bool triangles)
{
    std::size_t face_count = surgery.faces().size();
    mt_index h = surgery.random_halfedge();
    if (h == MT_NONE) {
        return;
    }
    std::size_t kind = below(face_count < 40 ? 8 : 12);
    mt_index face = mt_halfedge_face(&surgery.structure(), h);
    if (kind < 2) {
        try_swap(surgery, h);
    } else if (kind < 4) {
        try_split_edge(surgery, h);
    } else if (kind < 6) {
        try_split_vertex(surgery, h);
    } else if (kind == 6) {
        Polygon added = random_face(surgery, h, triangles);
        if (!added.empty()) {
            try_add(surgery, added);
        }
    } else if (kind < 9 && face != MT_NONE) {
        try_remove(surgery, face);
    } else {
        try_collapse(surgery, h);
    }
}

void run(mt_context *context, std::size_t vertex_count, const Polygons &faces)
{
    bool triangles = all_triangles(faces);
    for (int sequence = 0; sequence < 40; sequence++) {
        Surgery surgery(context, vertex_count, faces);
        tally.expect(surgery.ours != nullptr && surgery.faces() == canonical(faces), "surgery begins with the faces");
        for (int i = 0; i < 100; i++) {
            operate(surgery, triangles);
        }
    }
}

} // namespace

int main()
{
    mt_context *context = mt_context_create(nullptr);
    run(context, 20, grid(5, 4, true, true));
    run(context, 25, grid(4, 4, false, true));
    run(context, 20, grid(5, 4, true, false));
    run(context, 27, grid(4, 4, false, false));
    run(context, 4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
    run(context, 8, {{0, 1, 2}, {2, 1, 0}, {3, 4, 5}});
    run(context, 9, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
    int all_compared = 0, all_differences = 0;
    for (const auto &[name, count] : compared) {
        std::printf("%s: %d results compared\n", name.c_str(), count);
        tally.expect(count > 50, name + " was hardly met");
        all_compared += count;
    }
    for (const auto &[name, count] : differences) {
        std::printf("difference: %s, %d times\n", name.c_str(), count);
        all_differences += count;
    }
    tally.expect(compared.size() == 10, "every operation was met");
    tally.expect(10 * all_differences < all_compared, "differences are few");
    mt_context_destroy(context);
    return tally.conclude();
}
