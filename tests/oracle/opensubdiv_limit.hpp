// The limit of the last level by OpenSubdiv's Far beside ours, vertex by vertex.
//
// Left out, as Far's masks do not hold there: vertices that are still semi-sharp (Far takes the rule of the level for
// one that holds for ever), darts that are sharp for ever (it takes the smooth mask), normals of creases and boundaries
// with more than two faces on a side (it takes a mask that belongs to other rules; ours is the same at every level,
// which Far's is not), and corners of several faces, which have no tangent plane;
// neither has a vertex where sheets meet.
#ifndef TESTS_ORACLE_OPENSUBDIV_LIMIT_HPP
#define TESTS_ORACLE_OPENSUBDIV_LIMIT_HPP

#include "tests/oracle/opensubdiv.hpp"

namespace osd
{

struct LimitDifference {
    double position = 0, normal = 0;
    std::size_t positions = 0, normals = 0, left_out = 0;
};

class Limit
{
  public:
    Limit(const Reference &reference, int last)
        : refiner(reference.topology()), level(refiner.GetLevel(last)), size(extent(reference.positions[0]))
    {
        const Values &source = reference.positions[std::size_t(last)];
        points.resize(source.size());
        along.resize(source.size());
        across.resize(source.size());
        Far::PrimvarRefinerReal<double>(refiner).Limit(source, points, along, across);
    }

    LimitDifference difference(const mt_mesh *ours, const Match &match) const
    {
        LimitDifference result;
        auto normals = normals_of(ours);
        for (mt_index v = 0; v < ours->vertex_count; v++) {
            int theirs = match.vertices[v];
            if (theirs < 0) {
                continue;
            }
            if (has_no_mask(theirs)) {
                result.left_out++;
                continue;
            }
            mt_vec3 p = mt_mesh_position(ours, v);
            result.position =
                std::max(result.position, distance({{p.x, p.y, p.z}}, points[std::size_t(theirs)]) / size);
            result.positions++;
            if (has_normal(theirs)) {
                result.normal = std::max(result.normal, nearest(normals[v], theirs));
                result.normals++;
            } else {
                result.left_out++;
            }
        }
        return result;
    }

  private:
    using Rule = OpenSubdiv::Sdc::Crease;

    static bool semi_sharp(float sharpness)
    {
        return sharpness > 0 && sharpness < 10;
    }

    bool has_no_mask(int vertex) const
    {
        bool two_faces = level.GetVertexRule(vertex) == Rule::RULE_SMOOTH && level.GetVertexFaces(vertex).size() == 2;
        bool any =
            two_faces || semi_sharp(level.GetVertexSharpness(vertex)) || level.GetVertexRule(vertex) == Rule::RULE_DART;
        for (int edge : level.GetVertexEdges(vertex)) {
            any = any || semi_sharp(level.GetEdgeSharpness(edge));
        }
        return any;
    }

    // The faces between the first two sharp edges, in Far's order, when the vertex follows a crease.
    int faces_beside_crease(int vertex) const
    {
        Far::ConstIndexArray edges = level.GetVertexEdges(vertex);
        std::vector<int> sharp;
        for (int i = 0; i < edges.size(); i++) {
            if (level.GetEdgeSharpness(edges[i]) > 0) {
                sharp.push_back(i);
            }
        }
        return sharp.size() == 2 ? sharp[1] - sharp[0] : 0;
    }

    bool has_normal(int vertex) const
    {
        if (level.IsVertexNonManifold(vertex)) {
            return false;
        }
        switch (level.GetVertexRule(vertex)) {
        case Rule::RULE_SMOOTH:
            return true;
        case Rule::RULE_CREASE: {
            int faces = faces_beside_crease(vertex);
            return faces == 1 || faces == 2;
        }
        default:
            return level.GetVertexFaces(vertex).size() == 1;
        }
    }

    static mt_vec3 vector(const Value &value)
    {
        return mt_vec3_make(value.x[0], value.x[1], value.x[2]);
    }

    static std::vector<std::vector<mt_vec3>> normals_of(const mt_mesh *mesh)
    {
        const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER);
        bool by_corner = normals != nullptr;
        normals = by_corner ? normals : mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
        std::vector<std::vector<mt_vec3>> result(mesh->vertex_count);
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            mt_index v = mesh->corner_vertices[corner];
            mt_index value = mt_attribute_value_index(normals, by_corner ? corner : v);
            result[v].push_back(mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                                             mt_attribute_get(normals, value, 2)));
        }
        return result;
    }

    // Of the normals around a vertex (one for each side of a crease, of which Far knows one) the nearest to Far's.
    double nearest(const std::vector<mt_vec3> &normals, int vertex) const
    {
        mt_vec3 u = vector(along[std::size_t(vertex)]), v = vector(across[std::size_t(vertex)]);
        mt_vec3 cross = mt_vec3_cross(u, v), theirs = mt_vec3_normalize(cross);
        double longer = std::max(mt_vec3_length(u), mt_vec3_length(v));
        double best = INFINITY;
        for (mt_vec3 normal : normals) {
            best = std::min(best, mt_vec3_max_abs(mt_vec3_subtract(normal, theirs)));
        }
        // Roundings weigh more where the tangents are nearly one, or one is nearly none.
        return longer > 0 ? best * (mt_vec3_length(cross) / (longer * longer)) : 0;
    }

    const Far::TopologyRefiner &refiner;
    const Far::TopologyLevel &level;
    double size;
    Values points, along, across;
};

} // namespace osd

#endif
