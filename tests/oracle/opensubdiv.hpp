// A cage refined by OpenSubdiv's Far, uniformly, beside the same cage refined by us: element by element.
//
// Far numbers edges and turns faces in its own way after the first level, so ours are followed from level to level: the
// child of our corner c is the child of the same corner of the same face there.
#ifndef TESTS_ORACLE_OPENSUBDIV_HPP
#define TESTS_ORACLE_OPENSUBDIV_HPP

#include <meshtool/meshtool.h>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace osd
{

namespace Far = OpenSubdiv::Far;
using SdcOptions = OpenSubdiv::Sdc::Options;

// One value of three numbers, as PrimvarRefiner wants it.
struct Value {
    std::array<double, 3> x = {0, 0, 0};

    void Clear(void * = nullptr)
    {
        x = {0, 0, 0};
    }

    void AddWithWeight(const Value &other, double weight)
    {
        for (std::size_t k = 0; k < 3; k++) {
            x[k] += weight * other.x[k];
        }
    }
};

using Values = std::vector<Value>;

inline SdcOptions sdc_options(const mt_subdivide_options &options)
{
    SdcOptions result;
    result.SetVtxBoundaryInterpolation(options.boundary == MT_SUBDIVIDE_BOUNDARY_NONE ? SdcOptions::VTX_BOUNDARY_NONE
                                       : options.boundary == MT_SUBDIVIDE_BOUNDARY_CORNERS
                                           ? SdcOptions::VTX_BOUNDARY_EDGE_AND_CORNER
                                           : SdcOptions::VTX_BOUNDARY_EDGE_ONLY);
    result.SetCreasingMethod(options.crease_method == MT_SUBDIVIDE_CREASES_CHAIKIN ? SdcOptions::CREASE_CHAIKIN
                                                                                   : SdcOptions::CREASE_UNIFORM);
    result.SetTriangleSubdivision(options.triangles == MT_SUBDIVIDE_TRIANGLES_SMOOTH ? SdcOptions::TRI_SUB_SMOOTH
                                                                                     : SdcOptions::TRI_SUB_CATMARK);
    static const SdcOptions::FVarLinearInterpolation face_varying[] = {
        SdcOptions::FVAR_LINEAR_ALL,           SdcOptions::FVAR_LINEAR_ALL,
        SdcOptions::FVAR_LINEAR_NONE,          SdcOptions::FVAR_LINEAR_CORNERS_ONLY,
        SdcOptions::FVAR_LINEAR_CORNERS_PLUS1, SdcOptions::FVAR_LINEAR_CORNERS_PLUS2,
        SdcOptions::FVAR_LINEAR_BOUNDARIES};
    result.SetFVarLinearInterpolation(face_varying[options.face_varying]);
    return result;
}

// The UVs of a mesh, on corners or else on vertices, and the number of a corner's.
inline const mt_attribute *uvs_of(const mt_mesh *mesh)
{
    const mt_attribute *uv = mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    return uv ? uv : mt_mesh_find_attribute(mesh, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX);
}

inline mt_index uv_index(const mt_mesh *mesh, const mt_attribute *uv, mt_index corner)
{
    return mt_attribute_value_index(uv, uv->domain == MT_DOMAIN_CORNER ? corner : mesh->corner_vertices[corner]);
}

// The UVs as a channel; empty when not every corner has one.
inline std::vector<int> channel_of(const mt_mesh *mesh)
{
    const mt_attribute *uv = uvs_of(mesh);
    std::vector<int> indices;
    for (mt_index corner = 0; uv && corner < mesh->corner_count; corner++) {
        mt_index index = uv_index(mesh, uv, corner);
        if (index == MT_NONE) {
            return {};
        }
        indices.push_back(static_cast<int>(index));
    }
    return indices;
}

class Reference
{
  public:
    Reference(const mt_mesh *mesh, const SdcOptions &options, unsigned levels,
              OpenSubdiv::Sdc::SchemeType type = OpenSubdiv::Sdc::SCHEME_CATMARK)
        : scheme(type), indices(mesh->corner_vertices, mesh->corner_vertices + mesh->corner_count),
          uv_indices(channel_of(mesh))
    {
        describe(mesh, options);
        if (!refiner) {
            return;
        }
        Far::TopologyRefiner::UniformOptions uniform(levels);
        uniform.fullTopologyInLastLevel = true;
        refiner->RefineUniform(uniform);
        interpolate(mesh, levels);
    }

    bool works() const
    {
        return refiner != nullptr;
    }

    const Far::TopologyRefiner &topology() const
    {
        return *refiner;
    }

    OpenSubdiv::Sdc::SchemeType scheme;
    std::vector<Values> positions, uvs; // per level
    std::vector<int> indices, uv_indices;

  private:
    void describe(const mt_mesh *mesh, const SdcOptions &options)
    {
        Far::TopologyDescriptor descriptor;
        std::vector<int> sides, crease_vertices, corners, holes;
        std::vector<float> crease_weights, corner_weights;
        for (mt_index face = 0; face < mesh->face_count; face++) {
            sides.push_back(static_cast<int>(mt_mesh_face_sides(mesh, face)));
        }
        for (mt_index i = 0; i < mesh->crease_count; i++) {
            crease_vertices.push_back(static_cast<int>(mesh->creases[i].a));
            crease_vertices.push_back(static_cast<int>(mesh->creases[i].b));
            crease_weights.push_back(static_cast<float>(mesh->creases[i].value));
        }
        for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
            corners.push_back(static_cast<int>(mesh->sharp_vertices[i].vertex));
            corner_weights.push_back(static_cast<float>(mesh->sharp_vertices[i].value));
        }
        descriptor.numVertices = static_cast<int>(mesh->vertex_count);
        descriptor.numFaces = static_cast<int>(mesh->face_count);
        descriptor.numVertsPerFace = sides.data();
        descriptor.vertIndicesPerFace = indices.data();
        descriptor.numCreases = static_cast<int>(mesh->crease_count);
        descriptor.creaseVertexIndexPairs = crease_vertices.data();
        descriptor.creaseWeights = crease_weights.data();
        descriptor.numCorners = static_cast<int>(mesh->sharp_vertex_count);
        descriptor.cornerVertexIndices = corners.data();
        descriptor.cornerWeights = corner_weights.data();
        Far::TopologyDescriptor::FVarChannel channel;
        if (!uv_indices.empty()) {
            channel.numValues = *std::max_element(uv_indices.begin(), uv_indices.end()) + 1;
            channel.valueIndices = uv_indices.data();
            descriptor.numFVarChannels = 1;
            descriptor.fvarChannels = &channel;
        }
        using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
        Factory::Options how(scheme, options);
        refiner.reset(Factory::Create(descriptor, how));
    }

    void interpolate(const mt_mesh *mesh, unsigned levels)
    {
        Far::PrimvarRefinerReal<double> primvars(*refiner);
        positions.resize(levels + 1);
        for (mt_index v = 0; v < mesh->vertex_count; v++) {
            mt_vec3 p = mt_mesh_position(mesh, v);
            positions[0].push_back({{p.x, p.y, p.z}});
        }
        for (unsigned level = 1; level <= levels; level++) {
            positions[level].resize(
                static_cast<std::size_t>(refiner->GetLevel(static_cast<int>(level)).GetNumVertices()));
            primvars.Interpolate(static_cast<int>(level), positions[level - 1], positions[level]);
        }
        if (uv_indices.empty()) {
            return;
        }
        const mt_attribute *uv = uvs_of(mesh);
        uvs.resize(levels + 1);
        for (mt_index value = 0; value < uv->value_count; value++) {
            uvs[0].push_back({{mt_attribute_get(uv, value, 0), mt_attribute_get(uv, value, 1), 0}});
        }
        for (unsigned level = 1; level <= levels; level++) {
            uvs[level].resize(static_cast<std::size_t>(refiner->GetLevel(static_cast<int>(level)).GetNumFVarValues(0)));
            primvars.InterpolateFaceVarying(static_cast<int>(level), uvs[level - 1], uvs[level]);
        }
    }

    std::unique_ptr<Far::TopologyRefiner> refiner;
};

// Far takes a value that returns around a vertex (A B A B) for a third one, by a slip in how it looks for known ones
// (FVarLevel::completeTopologyFromFaceValues, 3.5). Such a value stays where it is here, as Far has it for A B A C.
inline bool splits_values(const Reference &reference)
{
    if (reference.uv_indices.empty()) {
        return false;
    }
    const Far::TopologyLevel &base = reference.topology().GetLevel(0), &next = reference.topology().GetLevel(1);
    for (int v = 0; v < base.GetNumVertices(); v++) {
        std::vector<int> before, after;
        Far::ConstIndexArray faces = base.GetVertexFaces(v),
                             child_faces = next.GetVertexFaces(base.GetVertexChildVertex(v));
        Far::ConstLocalIndexArray in_face = base.GetVertexFaceLocalIndices(v),
                                  in_child = next.GetVertexFaceLocalIndices(base.GetVertexChildVertex(v));
        for (int i = 0; i < faces.size(); i++) {
            before.push_back(base.GetFaceFVarValues(faces[i], 0)[in_face[i]]);
            after.push_back(next.GetFaceFVarValues(child_faces[i], 0)[in_child[i]]);
        }
        for (std::vector<int> *list : {&before, &after}) {
            std::sort(list->begin(), list->end());
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
        if (before.size() != after.size()) {
            return true;
        }
    }
    return false;
}

// Where our elements of one level are in Far's.
struct Match {
    std::vector<int> vertices;              // per vertex
    std::vector<std::pair<int, int>> faces; // per face, Far's and the place there of our first corner
};

inline Match first_match(const mt_mesh *mesh)
{
    Match match;
    match.vertices.assign(mesh->vertex_count, -1); // in no face: Far makes nothing of those
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        match.vertices[mesh->corner_vertices[corner]] = static_cast<int>(mesh->corner_vertices[corner]);
    }
    for (mt_index f = 0; f < mesh->face_count; f++) {
        match.faces.emplace_back(static_cast<int>(f), 0);
    }
    return match;
}

// From one of our levels to the next. `parent` has the faces of the level before.
inline Match next_match(const Far::TopologyRefiner &refiner, int level, const mt_mesh *parent, const Match &match,
                        const mt_mesh *child)
{
    const Far::TopologyLevel &from = refiner.GetLevel(level - 1), &to = refiner.GetLevel(level);
    Match next;
    next.vertices.assign(child->vertex_count, -1);
    for (mt_index v = 0; v < parent->vertex_count; v++) {
        next.vertices[v] = match.vertices[v] < 0 ? -1 : from.GetVertexChildVertex(match.vertices[v]);
    }
    mt_index corner = 0;
    for (mt_index f = 0; f < parent->face_count; f++) {
        auto [face, turn] = match.faces[f];
        int sides = from.GetFaceVertices(face).size();
        next.vertices[parent->vertex_count + f] = from.GetFaceChildVertex(face);
        for (int i = 0; i < sides; i++, corner++) {
            int at = (turn + i) % sides;
            next.vertices[child->corner_vertices[4 * std::size_t(corner) + 1]] =
                from.GetEdgeChildVertex(from.GetFaceEdges(face)[at]);
            int child_face = from.GetFaceChildFaces(face)[at];
            int first =
                to.GetFaceVertices(child_face).FindIndex(from.GetVertexChildVertex(from.GetFaceVertices(face)[at]));
            next.faces.emplace_back(child_face, first);
        }
    }
    return next;
}

// The same of Loop's triangles: 4f .. 4f + 2 at the corners of f, and 4f + 3 between them.
inline Match next_match_of_triangles(const Far::TopologyRefiner &refiner, int level, const mt_mesh *parent,
                                     const Match &match, const mt_mesh *child)
{
    const Far::TopologyLevel &from = refiner.GetLevel(level - 1), &to = refiner.GetLevel(level);
    Match next;
    next.vertices.assign(child->vertex_count, -1);
    for (mt_index v = 0; v < parent->vertex_count; v++) {
        next.vertices[v] = from.GetVertexChildVertex(match.vertices[v]);
    }
    for (mt_index f = 0; f < parent->face_count; f++) {
        auto [face, turn] = match.faces[f];
        for (int i = 0; i < 3; i++) {
            next.vertices[child->corner_vertices[12 * std::size_t(f) + 9 + std::size_t(i)]] =
                from.GetEdgeChildVertex(from.GetFaceEdges(face)[(turn + i) % 3]);
        }
        for (int i = 0; i < 4; i++) {
            int child_face = from.GetFaceChildFaces(face)[i < 3 ? (turn + i) % 3 : 3];
            mt_index first = child->corner_vertices[12 * std::size_t(f) + 3 * std::size_t(i)];
            next.faces.emplace_back(child_face, to.GetFaceVertices(child_face).FindIndex(next.vertices[first]));
        }
    }
    return next;
}

inline double distance(const Value &a, const Value &b)
{
    return std::max({std::abs(a.x[0] - b.x[0]), std::abs(a.x[1] - b.x[1]), std::abs(a.x[2] - b.x[2])});
}

// The largest coordinate difference, over the largest extent of the cage; infinite where shapes differ.
struct Difference {
    double position = 0, uv = 0;
};

inline double extent(const Values &values)
{
    double low = INFINITY, high = -INFINITY, largest = 0;
    for (std::size_t k = 0; k < 3; k++, low = INFINITY, high = -INFINITY) {
        for (const Value &value : values) {
            low = std::min(low, value.x[k]);
            high = std::max(high, value.x[k]);
        }
        largest = std::max(largest, high - low);
    }
    return largest > 0 ? largest : 1;
}

inline Difference difference_at(const Reference &reference, int level, const mt_mesh *ours, const Match &match)
{
    Difference result;
    const Values &theirs = reference.positions[static_cast<std::size_t>(level)];
    const Far::TopologyLevel &topology = reference.topology().GetLevel(level);
    if (theirs.size() != ours->vertex_count || topology.GetNumFaces() != static_cast<int>(ours->face_count)) {
        return {INFINITY, INFINITY};
    }
    for (mt_index v = 0; v < ours->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(ours, v);
        if (match.vertices[v] >= 0) { // else in no face, which Far does not number alike
            Value value = {{p.x, p.y, p.z}};
            result.position = std::max(result.position, distance(value, theirs[std::size_t(match.vertices[v])]));
        }
    }
    result.position /= extent(reference.positions[0]);
    const mt_attribute *uv = uvs_of(ours);
    if (reference.uvs.empty() || !uv) {
        return result;
    }
    for (mt_index corner = 0; corner < ours->corner_count; corner++) {
        auto sides = int(ours->face_size);
        auto [face, turn] = match.faces[corner / ours->face_size];
        Far::ConstIndexArray values = topology.GetFaceFVarValues(face, 0);
        const Value &value =
            reference.uvs[std::size_t(level)][std::size_t(values[(turn + int(corner) % sides) % sides])];
        mt_index index = uv_index(ours, uv, corner);
        Value mine = {{mt_attribute_get(uv, index, 0), mt_attribute_get(uv, index, 1), 0}};
        result.uv = std::max(result.uv, distance(mine, value));
    }
    result.uv /= extent(reference.uvs[0]);
    return result;
}

} // namespace osd

#endif
