#include "formats/mesh/values.h"

static char *put_rounded_position(char *at, const mt_mesh *mesh, mt_index vertex, unsigned digits)
{
    mt_vec3 p = mt_mesh_position(mesh, vertex);
    const double numbers[3] = {p.x, p.y, p.z};
    for (int i = 0; i < 3; i++) {
        *at++ = ' ';
        at += mt_number_print_digits(numbers[i], digits, at);
    }
    return at;
}

char *mt_put_position(char *at, const mt_mesh *mesh, mt_index vertex, unsigned digits)
{
    if (digits > 0) {
        return put_rounded_position(at, mesh, vertex, digits);
    }
    for (size_t i = 3 * (size_t)vertex; i < 3 * (size_t)vertex + 3; i++) {
        *at++ = ' ';
        at = mesh->position_type == MT_F64 ? mt_put_number(at, ((const double *)mesh->positions)[i])
                                           : mt_put_float(at, ((const float *)mesh->positions)[i]);
    }
    return at;
}

char *mt_put_component(char *at, const mt_attribute *attribute, mt_index value, uint32_t component)
{
    if (attribute->type == MT_F32) {
        return mt_put_float(at,
                            ((const float *)attribute->values)[(size_t)value * attribute->component_count + component]);
    }
    return mt_put_number(at, mt_attribute_get(attribute, value, component));
}

/* Where a component of a colour is stored; -1: nowhere, and it is 1. */
static int stored_component(uint32_t stored_count, uint32_t component)
{
    if (component == 3) {
        return stored_count % 2 == 0 ? (int)stored_count - 1 : -1;
    }
    return stored_count <= 2 ? 0 : (int)component;
}

char *mt_put_color(char *at, const mt_attribute *attribute, mt_index element, uint32_t count, bool as_fraction)
{
    mt_index value = mt_attribute_value_index(attribute, element);
    double maximum = mt_color_maximum(attribute->type);
    for (uint32_t i = 0; i < count; i++) {
        int component = value == MT_NONE ? -1 : stored_component(attribute->component_count, i);
        *at++ = ' ';
        if (component < 0) {
            at = mt_put_number(at, as_fraction ? 1.0 : maximum);
        } else if (attribute->type == MT_F32 || attribute->type == MT_F64 || !as_fraction) {
            at = mt_put_component(at, attribute, value, (uint32_t)component);
        } else {
            at = mt_put_number(at, mt_attribute_get(attribute, value, (uint32_t)component) / maximum);
        }
    }
    return at;
}
