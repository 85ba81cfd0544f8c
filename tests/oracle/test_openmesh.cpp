// Our structures beside OpenMesh's half-edges. What we build, OpenMesh must hold whole, with the same edges, boundary
// loops, valences and components; where OpenMesh drops faces in silence, which is printed by name, we must have
// refused.
#include "tests/oracle/mesh_files.hpp"

extern "C" {
#include "tests/support/connectivity.h"
}

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>

#include <random>
#include <set>

using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<>;

namespace
{

Tally tally;

// Returns how many faces it dropped. A face that names a vertex twice is not offered: OpenMesh does not survive it.
std::size_t build(const mt_mesh *mesh, OpenMeshMesh &theirs)
{
    std::size_t dropped = 0;
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(mesh, v);
        theirs.add_vertex({float(p.x), float(p.y), float(p.z)});
    }
    for (const auto &polygon : polygons_of(mesh)) {
        std::vector<OpenMeshMesh::VertexHandle> corners;
        for (std::size_t v : polygon) {
            corners.emplace_back(static_cast<int>(v));
        }
        bool simple = std::set<std::size_t>(polygon.begin(), polygon.end()).size() == polygon.size();
        dropped += !simple || !theirs.add_face(corners).is_valid();
    }
    return dropped;
}

std::size_t count_loops(const OpenMeshMesh &theirs)
{
    std::set<int> met;
    std::size_t loops = 0;
    for (auto h : theirs.halfedges()) {
        if (theirs.is_boundary(h) && met.insert(h.idx()).second) {
            loops++;
            for (auto at = theirs.next_halfedge_handle(h); at != h; at = theirs.next_halfedge_handle(at)) {
                met.insert(at.idx());
            }
        }
    }
    return loops;
}

std::size_t count_loops(const mt_halfedge_mesh *ours)
{
    std::vector<bool> met(ours->halfedge_count);
    std::size_t loops = 0;
    for (mt_index h = 0; h < ours->halfedge_count; h++) {
        if (mt_halfedge_is_boundary(ours, h) && !met[h]) {
            loops++;
            for (mt_index at = h; !met[at]; at = mt_halfedge_next(ours, at)) {
                met[at] = true;
            }
        }
    }
    return loops;
}

std::size_t count_components(const OpenMeshMesh &theirs)
{
    std::vector<bool> met(theirs.n_faces());
    std::size_t components = 0;
    for (auto seed : theirs.faces()) {
        std::vector<OpenMesh::SmartFaceHandle> open;
        if (!met[std::size_t(seed.idx())]) {
            components++;
            met[std::size_t(seed.idx())] = true;
            open.push_back(seed);
        }
        while (!open.empty()) {
            auto face = open.back();
            open.pop_back();
            for (auto beside : face.faces()) {
                if (!met[std::size_t(beside.idx())]) {
                    met[std::size_t(beside.idx())] = true;
                    open.push_back(beside);
                }
            }
        }
    }
    return components;
}

using Spokes = std::vector<std::pair<mt_index, mt_index>>; // a neighbour, and the face after it counter-clockwise

Spokes spokes_of(const OpenMeshMesh &theirs, mt_index vertex)
{
    Spokes spokes;
    if (theirs.is_isolated(OpenMeshMesh::VertexHandle(static_cast<int>(vertex)))) {
        return spokes; // its range would not be empty
    }
    for (auto h : theirs.voh_ccw_range(OpenMeshMesh::VertexHandle(static_cast<int>(vertex)))) {
        spokes.emplace_back(static_cast<mt_index>(theirs.to_vertex_handle(h).idx()),
                            static_cast<mt_index>(theirs.face_handle(h).idx())); // -1: MT_NONE
    }
    return spokes;
}

// In the same order, wherever they begin.
bool same_but_for_begin(const Spokes &a, const Spokes &b)
{
    Spokes twice = b;
    twice.insert(twice.end(), b.begin(), b.end());
    return a.size() == b.size() &&
           (a.empty() || std::search(twice.begin(), twice.end(), a.begin(), a.end()) != twice.end());
}

bool same_rings(const test_structure &kind, const void *ours, const OpenMeshMesh &theirs)
{
    static test_ring ring;
    for (mt_index vertex = 0; vertex < theirs.n_vertices(); vertex++) {
        Spokes expected = spokes_of(theirs, vertex), reversed;
        for (bool clockwise : {false, true}) {
            ring.count = 0;
            kind.vertex_ring(ours, vertex, clockwise, &ring);
            Spokes mine;
            for (mt_index i = 0; i < ring.count; i++) {
                mine.emplace_back(ring.spokes[i].neighbor, ring.spokes[i].face);
            }
            if (clockwise) {
                std::reverse(mine.begin(), mine.end());
            }
            if (!same_but_for_begin(mine, expected)) {
                return false;
            }
        }
    }
    return true;
}

// Every structure holds what OpenMesh holds, with the same neighbours and faces in the same order around each vertex.
void compare_rings(mt_context *context, const mt_mesh *mesh, const OpenMeshMesh &theirs, const std::string &name)
{
    bool triangles = !mesh->face_offsets && mesh->face_size == 3;
    for (const test_structure &kind : test_structures) {
        void *ours = nullptr;
        if (!kind.triangles_only || triangles) {
            tally.expect(kind.create(context, mesh, &ours) == MT_OK, name + ": " + kind.name + " is built");
            tally.expect(same_rings(kind, ours, theirs), name + ": " + kind.name + ", rings of every vertex");
            kind.destroy(context, ours);
        }
    }
}

void compare_structures(mt_context *context, const mt_mesh *mesh, const mt_halfedge_mesh *ours,
                        const OpenMeshMesh &theirs, const std::string &name)
{
    tally.expect_equal(ours->halfedge_count / 2, theirs.n_edges(), name + ": edges");
    tally.expect_equal(count_loops(ours), count_loops(theirs), name + ": boundary loops");
    compare_rings(context, mesh, theirs, name);
    mt_manifold_report report;
    tally.expect(mt_check_manifold(context, mesh, nullptr, &report) == MT_OK, name + ": the check runs");
    tally.expect_equal(report.component_count, count_components(theirs), name + ": components");
    tally.expect_equal(report.boundary_loop_count, count_loops(theirs), name + ": the check's boundary loops");
    mt_manifold_report_release(context, &report);
}

void compare(mt_context *context, const mt_mesh *mesh, const std::string &name, bool loud)
{
    mt_halfedge_mesh *ours = nullptr;
    mt_status status = mt_halfedge_create(context, mesh, &ours);
    OpenMeshMesh theirs;
    std::size_t dropped = build(mesh, theirs);
    if (status != MT_OK) {
        tally.expect(status == MT_ERROR_NOT_MANIFOLD || status == MT_ERROR_NOT_ORIENTED, name + ": a refusal");
        if (loud) {
            std::printf("%s: OpenMesh drops %zu of %u faces in silence; we say: %s\n", name.c_str(), dropped,
                        mesh->face_count, mt_context_error(context)->message);
        }
        mt_context_clear_error(context);
        return;
    }
    tally.expect_equal(std::size_t(0), dropped, name + ": faces dropped of a mesh that we hold");
    if (!dropped) {
        compare_structures(context, mesh, ours, theirs, name);
    }
    mt_halfedge_destroy(context, ours);
}

// A grid rolled to a tube, torus or strip, with some faces left out, so that what remains is mostly manifold.
mt_mesh *random_patch(mt_context *context, std::mt19937 &random)
{
    const mt_index columns = 6, rows = 5;
    bool roll_columns = random() % 2, roll_rows = random() % 2;
    unsigned holes = unsigned(random() % 4);
    std::vector<mt_index> corners;
    for (mt_index i = 0; i < columns; i++) {
        for (mt_index j = 0; j < rows; j++) {
            mt_index i1 = roll_columns ? (i + 1) % columns : i + 1, j1 = roll_rows ? (j + 1) % rows : j + 1;
            if (random() % 10 >= holes) {
                corners.insert(corners.end(),
                               {i * (rows + 1) + j, i1 * (rows + 1) + j, i1 * (rows + 1) + j1, i * (rows + 1) + j1});
            }
        }
    }
    mt_mesh_layout layout{};
    layout.vertex_count = (columns + 1) * (rows + 1);
    layout.face_count = corners.size() / 4;
    layout.face_size = 4;
    if (random() % 2) { // each square as two triangles
        std::vector<mt_index> squares;
        squares.swap(corners);
        for (std::size_t c = 0; c < squares.size(); c += 4) {
            corners.insert(corners.end(),
                           {squares[c], squares[c + 1], squares[c + 2], squares[c], squares[c + 2], squares[c + 3]});
        }
        layout.face_count *= 2;
        layout.face_size = 3;
    }
    layout.position_type = MT_F64;
    mt_mesh *mesh = nullptr;
    mt_mesh_create(context, &layout, &mesh);
    std::copy(corners.begin(), corners.end(), mesh->corner_vertices);
    for (mt_index v = 0; v < mesh->vertex_count; v++) {
        mt_mesh_set_position(mesh, v, mt_vec3_make(v / (rows + 1), v % (rows + 1), 0));
    }
    return mesh;
}

} // namespace

int main()
{
    omerr().disable();
    mt_context *context = mt_context_create(nullptr);
    for (const std::string &path : mesh_files()) {
        mt_mesh *mesh = nullptr;
        tally.expect(mt_mesh_read_file(context, path.c_str(), nullptr, &mesh, nullptr) == MT_OK, path + ": reads");
        compare(context, mesh, path, true);
        mt_mesh_destroy(context, mesh);
    }
    std::mt19937 random(77);
    for (int i = 0; i < 1000; i++) {
        mt_mesh *mesh = random_patch(context, random);
        compare(context, mesh, "patch " + std::to_string(i), false);
        mt_mesh_destroy(context, mesh);
    }
    mt_context_destroy(context);
    return tally.conclude();
}
