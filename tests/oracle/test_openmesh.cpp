// Half-edges beside OpenMesh's. What we build, OpenMesh must hold whole, with the same edges, boundary loops, valences
// and components; where OpenMesh drops faces in silence, which is printed by name, we must have refused.
#include "tests/oracle/mesh_files.hpp"

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

bool same_rings(const mt_halfedge_mesh *ours, const OpenMeshMesh &theirs)
{
    for (mt_index v = 0; v < ours->vertex_count; v++) {
        OpenMeshMesh::VertexHandle handle(static_cast<int>(v));
        std::multiset<mt_index> mine, other;
        mt_index begin = ours->vertex_halfedge[v];
        for (mt_index h = begin; h != MT_NONE;) {
            mine.insert(mt_halfedge_tail(ours, h));
            h = mt_halfedge_clockwise(ours, h);
            h = h == begin ? MT_NONE : h;
        }
        for (auto around : theirs.vv_range(handle)) {
            other.insert(static_cast<mt_index>(around.idx()));
        }
        if (mine != other) {
            return false;
        }
    }
    return true;
}

void compare_structures(mt_context *context, const mt_mesh *mesh, const mt_halfedge_mesh *ours,
                        const OpenMeshMesh &theirs, const std::string &name)
{
    tally.expect_equal(ours->halfedge_count / 2, theirs.n_edges(), name + ": edges");
    tally.expect_equal(count_loops(ours), count_loops(theirs), name + ": boundary loops");
    tally.expect(same_rings(ours, theirs), name + ": neighbours of every vertex");
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
