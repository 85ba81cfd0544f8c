// Our half-edge surgery as its list of faces, and the meshes that it begins with.
#ifndef TESTS_ORACLE_SURGERY_OURS_HPP
#define TESTS_ORACLE_SURGERY_OURS_HPP

#include "tests/oracle/mesh_files.hpp"

#include <random>

using Polygon = std::vector<std::size_t>;

// Each face from its lowest vertex on, in order.
inline Polygons canonical(Polygons faces)
{
    for (Polygon &face : faces) {
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

// A whole number below the limit, from one fixed sequence.
inline std::size_t below(std::size_t limit)
{
    static std::mt19937_64 generator(3);
    return limit ? std::size_t(generator() % limit) : 0;
}

struct Surgery {
    mt_context *context;
    mt_halfedge_surgery *ours = nullptr;

    Surgery(mt_context *with, std::size_t vertex_count, const Polygons &polygons) : context(with)
    {
        std::size_t corner_count = 0;
        for (const Polygon &face : polygons) {
            corner_count += face.size();
        }
        mt_mesh_layout layout = {vertex_count, polygons.size(), corner_count, 0, MT_F64};
        mt_mesh *mesh = nullptr;
        mt_halfedge_mesh *structure = nullptr;
        mt_mesh_create(context, &layout, &mesh);
        std::fill_n(static_cast<double *>(mesh->positions), 3 * vertex_count, 0.0);
        mt_index corner = 0, face = 0;
        for (const Polygon &polygon : polygons) {
            for (std::size_t v : polygon) {
                mesh->corner_vertices[corner++] = mt_index(v);
            }
            mesh->face_offsets[++face] = corner;
        }
        mt_halfedge_create(context, mesh, &structure);
        mt_halfedge_surgery_create(context, structure, &ours);
        mt_halfedge_destroy(context, structure);
        mt_mesh_destroy(context, mesh);
    }

    ~Surgery()
    {
        mt_halfedge_surgery_destroy(context, ours);
    }

    const mt_halfedge_mesh &structure() const
    {
        return ours->structure;
    }

    Polygon face(mt_index which) const
    {
        Polygon polygon;
        mt_index h = structure().face_halfedge[which];
        do {
            polygon.push_back(mt_halfedge_tail(&structure(), h));
            h = mt_halfedge_next(&structure(), h);
        } while (h != structure().face_halfedge[which]);
        return polygon;
    }

    Polygons faces() const
    {
        Polygons polygons;
        for (mt_index f = 0; f < structure().face_count; f++) {
            if (structure().face_halfedge[f] != MT_NONE) {
                polygons.push_back(face(f));
            }
        }
        return canonical(polygons);
    }

    // A living half-edge, or MT_NONE.
    mt_index random_halfedge() const
    {
        for (int i = 0; i < 200; i++) {
            mt_index h = mt_index(below(structure().halfedge_count));
            if (structure().halfedge_count && structure().halfedges[h].head != MT_NONE) {
                return h;
            }
        }
        return MT_NONE;
    }
};

// A grid of quads or of their halves, rolled to a torus when closed.
inline Polygons grid(std::size_t columns, std::size_t rows, bool closed, bool triangles)
{
    Polygons faces;
    std::size_t width = closed ? columns : columns + 1, height = closed ? rows : rows + 1;
    for (std::size_t r = 0; r < rows; r++) {
        for (std::size_t c = 0; c < columns; c++) {
            std::size_t right = (c + 1) % width, up = (r + 1) % height;
            std::size_t quad[] = {r * width + c, r * width + right, up * width + right, up * width + c};
            if (triangles) {
                faces.push_back({quad[0], quad[1], quad[2]});
                faces.push_back({quad[0], quad[2], quad[3]});
            } else {
                faces.push_back({quad[0], quad[1], quad[2], quad[3]});
            }
        }
    }
    return faces;
}

#endif
