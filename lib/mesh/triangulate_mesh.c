/* A mesh of the triangles alone: what lies on vertices stays, what lies on corners and faces is gathered. */
#include <meshtool/derive.h>
#include <meshtool/triangulate.h>

static mt_status derive_triangles(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                                  mt_mesh **out)
{
    mt_derivation derivation = {.vertex_count = mesh->vertex_count,
                                .face_count = triangulation->triangle_count,
                                .face_size = 3,
                                .face_sources = triangulation->faces,
                                .corner_count = 3 * (uint64_t)triangulation->triangle_count,
                                .corner_sources = triangulation->corners};
    return mt_mesh_derive(context, mesh, &derivation, out);
}

mt_status mt_mesh_triangulate(mt_context *context, const mt_mesh *mesh, mt_mesh **out)
{
    *out = NULL;
    mt_triangulation triangulation;
    mt_status status = mt_triangulation_init(context, mesh, &triangulation);
    if (status == MT_OK) {
        status = derive_triangles(context, mesh, &triangulation, out);
        mt_triangulation_release(context, &triangulation);
    }
    return status;
}
