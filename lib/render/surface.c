#include "lib/render/surface.h"

#include <meshtool/image.h>

#include <string.h>

static const mt_attribute *find_colors(const mt_mesh *mesh)
{
    static const mt_domain domains[] = {MT_DOMAIN_CORNER, MT_DOMAIN_VERTEX, MT_DOMAIN_FACE};
    for (size_t i = 0; i < sizeof domains / sizeof *domains; i++) {
        const mt_attribute *found = mt_mesh_find_attribute(mesh, MT_SEMANTIC_COLOR, domains[i]);
        if (found && found->component_count >= 1 && found->component_count <= 4) {
            return found;
        }
    }
    return NULL;
}

void mt_surface_init(const mt_mesh *mesh, const mt_mesh *colored, const unsigned char *face_colors, mt_surface *surface)
{
    memset(surface, 0, sizeof *surface);
    surface->face_colors = face_colors;
    surface->colors = face_colors || !colored ? NULL : find_colors(colored);
    surface->corner_vertices = mesh->corner_vertices;
    surface->per_maximum = surface->colors ? 1.0 / mt_color_maximum(surface->colors->type) : 1.0;
    for (int i = 0; i <= MT_DECODE_STEPS; i++) {
        surface->decoded[i] = mt_srgb_decode((double)i / MT_DECODE_STEPS);
    }
}

static double decode(const mt_surface *surface, double value)
{
    double at = (value > 0 ? (value < 1 ? value : 1.0) : 0.0) * MT_DECODE_STEPS;
    int cell = (int)at;
    double low = surface->decoded[cell], high = surface->decoded[cell < MT_DECODE_STEPS ? cell + 1 : cell];
    return low + (at - cell) * (high - low);
}

mt_vec3 mt_linear_color(const mt_surface *surface, double red, double green, double blue)
{
    return mt_vec3_make(decode(surface, red), decode(surface, green), decode(surface, blue));
}

static mt_index element_of(const mt_surface *surface, mt_index face, mt_index corner, mt_index vertex)
{
    switch (surface->colors->domain) {
    case MT_DOMAIN_CORNER:
        return corner;
    case MT_DOMAIN_VERTEX:
        return vertex;
    default:
        return face;
    }
}

bool mt_surface_color(const mt_surface *surface, mt_index face, mt_index corner, mt_index vertex, mt_vec3 *color)
{
    if (surface->face_colors && face != MT_NONE) {
        const unsigned char *c = surface->face_colors + 3 * (size_t)face;
        *color = mt_linear_color(surface, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
        return true;
    }
    if (!surface->colors) {
        return false;
    }
    mt_index element = element_of(surface, face, corner, vertex);
    mt_index value = element == MT_NONE ? MT_NONE : mt_attribute_value_index(surface->colors, element);
    if (value == MT_NONE) {
        return false;
    }
    double rgb[3];
    bool grey = surface->colors->component_count < 3;
    for (uint32_t i = 0; i < 3; i++) {
        rgb[i] = mt_attribute_get(surface->colors, value, grey ? 0 : i) * surface->per_maximum;
        if (!isfinite(rgb[i])) {
            return false;
        }
    }
    *color = mt_linear_color(surface, rgb[0], rgb[1], rgb[2]);
    return true;
}
