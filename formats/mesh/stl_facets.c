#include "formats/mesh/stl_facets.h"

#include <meshtool/weld.h>

#include <string.h>

bool mt_stl_normal_contradicts(const double normal[3], const double corners[9])
{
    mt_vec3 n = mt_vec3_make(normal[0], normal[1], normal[2]);
    mt_vec3 a = mt_vec3_make(corners[0], corners[1], corners[2]);
    mt_vec3 u = mt_vec3_subtract(mt_vec3_make(corners[3], corners[4], corners[5]), a);
    mt_vec3 v = mt_vec3_subtract(mt_vec3_make(corners[6], corners[7], corners[8]), a);
    mt_vec3 w = mt_vec3_subtract(v, u), g = mt_vec3_cross(u, v);
    double uu = mt_vec3_dot(u, u), vv = mt_vec3_dot(v, v), ww = mt_vec3_dot(w, w), gg = mt_vec3_dot(g, g);
    double longest = uu > vv ? uu : vv, agreement = mt_vec3_dot(n, g), length = mt_vec3_dot(n, n);
    longest = longest > ww ? longest : ww;
    bool thin = !(gg > STL_THIN_FACET * STL_THIN_FACET * longest * longest);
    bool agrees = agreement > 0 && agreement * agreement >= STL_NORMAL_COSINE * STL_NORMAL_COSINE * length * gg;
    return !thin && !agrees && length > 0 && isfinite(length) && isfinite(gg);
}

mt_status mt_stl_create(mt_context *context, uint64_t facet_count, mt_type position_type, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = facet_count > MT_INDEX_MAX ? facet_count : 3 * facet_count,
                             .face_count = facet_count,
                             .face_size = 3,
                             .position_type = position_type};
    return mt_mesh_create(context, &layout, out);
}

mt_status mt_stl_weld(mt_context *context, mt_mesh *mesh)
{
    mt_index count;
    int part = mt_part_begin(context, "welded corners", "STL has no shared vertices");
    mt_status status = mt_weld_exact(context, mesh->positions, mesh->position_type, mesh->vertex_count, mesh->positions,
                                     mesh->corner_vertices, &count);
    if (status == MT_OK) {
        void *positions =
            mt_reallocate(context, mesh->positions, 3 * (uint64_t)count * mt_type_size(mesh->position_type));
        status = positions ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
        mesh->positions = positions ? positions : mesh->positions;
        mesh->vertex_count = count;
        mesh->welded = true;
        mesh->up = MT_UP_Z;
    }
    mt_part_end(context, part);
    return status;
}

mt_status mt_stl_add_normals(mt_context *context, const mt_input *input, mt_mesh *mesh, uint64_t contradicting,
                             mt_attribute **out)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = MT_DOMAIN_FACE,
                                  .type = MT_F32,
                                  .component_count = 3,
                                  .value_count = mesh->face_count};
    mt_warn(context, "%s: %llu facets have a normal that contradicts the order of their corners; the normals are kept",
            mt_input_name(input), (unsigned long long)contradicting);
    return mt_mesh_add_attribute(context, mesh, &layout, out);
}

const mt_attribute *mt_stl_normals(const mt_mesh *mesh)
{
    const mt_attribute *normals = mt_mesh_find_attribute(mesh, MT_SEMANTIC_NORMAL, MT_DOMAIN_FACE);
    return normals && normals->component_count == 3 ? normals : NULL;
}

const mt_attribute *mt_stl_attributes(const mt_mesh *mesh)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        const mt_attribute *a = &mesh->attributes[i];
        if (a->domain == MT_DOMAIN_FACE && a->semantic == MT_SEMANTIC_GENERIC && a->type == MT_U16 &&
            a->component_count == 1 && strcmp(a->name, STL_ATTRIBUTE) == 0) {
            return a;
        }
    }
    return NULL;
}
