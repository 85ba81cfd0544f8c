// Meshes as plain lists of faces, from us, OpenMesh, assimp and admesh.
#ifndef TESTS_ORACLE_FACES_HPP
#define TESTS_ORACLE_FACES_HPP

#include <meshtool/meshtool.h>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <admesh/stl.h>
#include <assimp/cimport.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

struct DoubleTraits : OpenMesh::DefaultTraits {
    typedef OpenMesh::Vec3d Point;
    typedef OpenMesh::Vec3d Normal;
};
using OpenMeshMesh = OpenMesh::PolyMesh_ArrayKernelT<DoubleTraits>;
using Face = std::vector<double>; // x y z of each corner in order
using Faces = std::vector<Face>;

inline Faces faces_of(const mt_mesh *mesh)
{
    Faces faces(mesh->face_count);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
            faces[face].insert(faces[face].end(), {p.x, p.y, p.z});
        }
    }
    return faces;
}

inline double extent(const Faces &faces)
{
    double largest = 1e-30;
    for (const Face &face : faces) {
        for (double number : face) {
            largest = std::max(largest, std::abs(number));
        }
    }
    return largest;
}

inline bool close(const Face &a, const Face &b, std::size_t turn, double bound)
{
    for (std::size_t j = 0; j < a.size(); j++) {
        if (!(std::abs(a[j] - b[(j + 3 * turn) % b.size()]) <= bound)) {
            return false;
        }
    }
    return true;
}

// Whether the faces are the same, one by one, to within the tolerance relative to the largest coordinate. `turned`:
// where a face begins may differ, as half-edges do not keep it.
inline bool same(const Faces &a, const Faces &b, double tolerance, bool turned = false)
{
    double bound = tolerance * extent(a);
    if (a.size() != b.size()) {
        std::printf("  %zu and %zu faces\n", a.size(), b.size());
        return false;
    }
    for (std::size_t i = 0; i < a.size(); i++) {
        std::size_t turn = 0, turns = turned ? a[i].size() / 3 : 1;
        bool equal = a[i].size() == b[i].size();
        while (equal && turn < turns && !close(a[i], b[i], turn, bound)) {
            turn++;
        }
        if (!equal || turn == turns) {
            std::printf("  face %zu differs (%zu and %zu numbers)\n", i, a[i].size(), b[i].size());
            return false;
        }
    }
    return true;
}

inline std::size_t most_sides(const Faces &faces)
{
    std::size_t most = 0;
    for (const Face &face : faces) {
        most = std::max(most, face.size() / 3);
    }
    return most;
}

inline void collect(const aiScene *scene, const aiNode *node, Faces &faces)
{
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        const aiMesh *mesh = scene->mMeshes[node->mMeshes[i]];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            const aiFace &face = mesh->mFaces[f];
            Face corners;
            for (unsigned k = 0; k < face.mNumIndices; k++) {
                const aiVector3D &p = mesh->mVertices[face.mIndices[k]];
                corners.insert(corners.end(), {double(p.x), double(p.y), double(p.z)});
            }
            faces.push_back(corners);
        }
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        collect(scene, node->mChildren[i], faces);
    }
}

inline bool read_assimp(const std::string &path, Faces &faces)
{
    const aiScene *scene = aiImportFile(path.c_str(), 0);
    if (scene) {
        collect(scene, scene->mRootNode, faces);
        aiReleaseImport(scene);
    }
    return scene;
}

inline Faces faces_of(const OpenMeshMesh &mesh)
{
    Faces faces;
    for (auto face : mesh.faces()) {
        Face corners;
        for (auto vertex : face.vertices()) {
            const auto &p = mesh.point(vertex);
            corners.insert(corners.end(), {p[0], p[1], p[2]});
        }
        faces.push_back(corners);
    }
    return faces;
}

// Whether OpenMesh's half-edges can hold all faces of the mesh.
inline bool openmesh_holds(const mt_mesh *mesh)
{
    OpenMeshMesh theirs;
    std::vector<OpenMeshMesh::VertexHandle> vertices;
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        mt_vec3 p = mt_mesh_position(mesh, i);
        vertices.push_back(theirs.add_vertex({p.x, p.y, p.z}));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        std::vector<OpenMeshMesh::VertexHandle> corners;
        for (mt_index corner = mt_mesh_face_begin(mesh, face); corner < mt_mesh_face_end(mesh, face); corner++) {
            corners.push_back(vertices[mesh->corner_vertices[corner]]);
        }
        std::vector<OpenMeshMesh::VertexHandle> sorted = corners;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() || !theirs.add_face(corners).is_valid()) {
            return false;
        }
    }
    return true;
}

inline bool read_openmesh(const std::string &path, OpenMeshMesh &mesh)
{
    OpenMesh::IO::Options options;
    return OpenMesh::IO::read_mesh(mesh, path, options);
}

inline bool read_admesh(const std::string &path, Faces &faces)
{
    stl_file stl{};
    stl_open(&stl, const_cast<char *>(path.c_str()));
    if (stl_get_error(&stl)) {
        return false;
    }
    for (int i = 0; i < stl.stats.number_of_facets; i++) {
        Face corners;
        for (const stl_vertex &p : stl.facet_start[i].vertex) {
            corners.insert(corners.end(), {double(p.x), double(p.y), double(p.z)});
        }
        faces.push_back(corners);
    }
    stl_close(&stl);
    return true;
}

#endif
