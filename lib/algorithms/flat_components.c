#include "lib/algorithms/flat_components.h"

#include <meshtool/predicates.h>

/* The plane of a component, found as its vertices come: two that differ, then one that is not on their line. */
typedef struct plane_search {
    mt_vec3 base[3];
    int count;
} plane_search;

static bool are_equal(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Whether the point leaves all so far in one plane. */
static bool extend(plane_search *search, mt_vec3 p)
{
    if (!mt_vec3_is_finite(p)) {
        return false;
    }
    if (search->count == 3) {
        return mt_orient3d(search->base[0], search->base[1], search->base[2], p) == 0;
    }
    bool repeats = (search->count == 1 && are_equal(search->base[0], p)) ||
                   (search->count == 2 && mt_collinear(search->base[0], search->base[1], p));
    if (!repeats) {
        search->base[search->count++] = p;
    }
    return true;
}

mt_status mt_find_flat_components(mt_context *context, const mt_mesh *mesh, const mt_components *components,
                                  uint8_t *flat)
{
    plane_search *searches = mt_allocate_array_zeroed(context, components->component_count, sizeof *searches);
    if (!searches) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index i = 0; i < components->component_count; i++) {
        flat[i] = 1;
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index component = components->face_component[face];
        for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face) && flat[component]; c++) {
            flat[component] = extend(&searches[component], mt_mesh_position(mesh, mesh->corner_vertices[c]));
        }
    }
    mt_free(context, searches);
    return MT_OK;
}
