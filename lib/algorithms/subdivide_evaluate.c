/* A level beside its limit. Cost: two subdivisions. */
#include <meshtool/subdivide.h>

static void measure(const mt_mesh *level, const mt_mesh *limit, mt_limit_distance *out)
{
    *out = (mt_limit_distance){.vertex = MT_NONE};
    for (mt_index vertex = 0; vertex < level->vertex_count; vertex++) {
        mt_vec3 move = mt_vec3_subtract(mt_mesh_position(limit, vertex), mt_mesh_position(level, vertex));
        double scale = mt_power_of_two_scale(mt_vec3_max_abs(move));
        double distance = mt_vec3_length(mt_vec3_scale(move, scale)) / scale;
        if (out->vertex == MT_NONE || distance > out->max) {
            out->max = distance;
            out->vertex = vertex;
        }
    }
    double sum = 0;
    for (mt_index vertex = 0; out->max > 0 && vertex < level->vertex_count; vertex++) {
        mt_vec3 move = mt_vec3_subtract(mt_mesh_position(limit, vertex), mt_mesh_position(level, vertex));
        mt_vec3 part = mt_vec3_make(move.x / out->max, move.y / out->max, move.z / out->max);
        sum += mt_vec3_dot(part, part);
    }
    out->root_mean_square = level->vertex_count ? out->max * sqrt(sum / level->vertex_count) : 0;
}

/* A view of the mesh with no values but what steers subdivision: marks on faces and on the mesh. */
static mt_status bare_view(mt_context *context, const mt_mesh *mesh, mt_mesh *view)
{
    *view = *mesh;
    view->attribute_count = 0;
    view->attributes = mt_allocate_array(context, mesh->attribute_count, sizeof *view->attributes);
    if (!view->attributes) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        const mt_attribute *attribute = &mesh->attributes[i];
        if (attribute->semantic == MT_SEMANTIC_GENERIC &&
            (attribute->domain == MT_DOMAIN_MESH || attribute->domain == MT_DOMAIN_FACE)) {
            view->attributes[view->attribute_count++] = *attribute;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_evaluate(mt_context *context, const mt_mesh *mesh, const mt_subdivide_options *options,
                                mt_limit_distance *out)
{
    mt_subdivide_options settings = options ? *options : (mt_subdivide_options){0};
    mt_mesh *level = NULL, *limit = NULL;
    *out = (mt_limit_distance){.vertex = MT_NONE};
    settings.limit = false;
    mt_mesh view;
    mt_status status = bare_view(context, mesh, &view);
    if (status == MT_OK) {
        status = mt_subdivide(context, &view, &settings, &level);
    }
    if (status == MT_OK) {
        settings.limit = true;
        status = mt_subdivide(context, &view, &settings, &limit);
    }
    if (status == MT_OK) {
        measure(level, limit, out);
    }
    mt_free(context, view.attributes);
    mt_mesh_destroy(context, level);
    mt_mesh_destroy(context, limit);
    return status;
}
