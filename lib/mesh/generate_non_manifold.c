/* Meshes with the two defects that no half-edge structure can hold: an edge of three faces, and a vertex whose faces
 * meet nowhere else. */
#include "lib/mesh/generate.h"

/* The spine is vertices 0 and 1; page i has vertices 2 + 2i and 3 + 2i. */
mt_status mt_generate_book(mt_context *context, mt_index resolution, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = 2 + 2 * (uint64_t)resolution,
                             .face_count = resolution,
                             .face_size = 4,
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    mt_mesh *mesh = *out;
    mt_mesh_set_position(mesh, 0, mt_vec3_make(0, 0, 0));
    mt_mesh_set_position(mesh, 1, mt_vec3_make(0, 1, 0));
    for (mt_index page = 0; page < resolution; page++) {
        mt_circle_point edge = mt_circle(page, resolution);
        mt_index outer = 2 + 2 * page;
        const mt_index corners[4] = {0, outer, outer + 1, 1};
        mt_mesh_set_position(mesh, outer, mt_vec3_make(edge.x, 0, -edge.y));
        mt_mesh_set_position(mesh, outer + 1, mt_vec3_make(edge.x, 1, -edge.y));
        for (int k = 0; k < 4; k++) {
            mesh->corner_vertices[4 * (size_t)page + (size_t)k] = corners[k];
        }
    }
    return MT_OK;
}

mt_status mt_generate_bowtie(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {0, 0, 0, 1, -0.5, 0, 1, 0.5, 0, -1, 0.5, 0, -1, -0.5, 0};
    static const uint8_t faces[] = {3, 0, 1, 2, 3, 0, 3, 4};
    mt_literal literal = {5, 2, positions, faces};
    return mt_generate_literal(context, &literal, out);
}

/* Pages of one unit by one; the triangle hangs on the outer corner of the first. */
mt_status mt_generate_book_bowtie(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {0,    0, 0,     0,    1, 0,    1,    0, 0,    1, 1, 0, -0.5, 0,   -0.75,
                                       -0.5, 1, -0.75, -0.5, 0, 0.75, -0.5, 1, 0.75, 2, 1, 0, 2,    1.5, 0};
    static const uint8_t faces[] = {4, 0, 2, 3, 1, 4, 0, 4, 5, 1, 4, 0, 6, 7, 1, 3, 3, 8, 9};
    mt_literal literal = {10, 4, positions, faces};
    return mt_generate_literal(context, &literal, out);
}
