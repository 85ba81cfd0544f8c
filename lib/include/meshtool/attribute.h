/* Attributes: named arrays of values on the vertices, corners or faces of a mesh, or on the mesh
 * itself. A corner attribute may be indexed, so that a UV seam splits no vertex. */
#ifndef MESHTOOL_ATTRIBUTE_H
#define MESHTOOL_ATTRIBUTE_H

#include <meshtool/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What an attribute means. mt_semantic_interpolation says how each is carried by operations. */
typedef enum mt_semantic {
    MT_SEMANTIC_GENERIC, /* known by its name alone */
    MT_SEMANTIC_NORMAL,  /* 3 components, unit length by convention, not enforced */
    MT_SEMANTIC_UV,      /* 2 or 3 components, (0,0) at the bottom left */
    MT_SEMANTIC_COLOR    /* 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA); integers stand for value/maximum,
                            floats for themselves; sRGB as files hold it */
} mt_semantic;

typedef enum mt_domain { MT_DOMAIN_MESH, MT_DOMAIN_VERTEX, MT_DOMAIN_CORNER, MT_DOMAIN_FACE } mt_domain;

/* How values between given ones are made. */
typedef enum mt_interpolation {
    MT_INTERPOLATE_LINEAR, /* weighted sum */
    MT_INTERPOLATE_UNIT,   /* weighted sum, then unit length */
    MT_INTERPOLATE_NONE    /* copied from the parent element; integers of generic meaning */
} mt_interpolation;

typedef struct mt_attribute {
    char *name; /* never NULL; "" where the format has no name for it */
    mt_semantic semantic;
    mt_domain domain;
    mt_type type;
    uint32_t component_count;
    mt_index value_count;
    void *values;      /* value_count * component_count numbers of `type`, tightly packed */
    mt_index *indices; /* per element of the domain its value, MT_NONE: it has none; NULL: element i has value i */
} mt_attribute;

/* The table's answer for a semantic and type. */
mt_interpolation mt_semantic_interpolation(mt_semantic semantic, mt_type type);

/* The value number of an element, MT_NONE when it has none. */
static inline mt_index mt_attribute_value_index(const mt_attribute *attribute, mt_index element)
{
    return attribute->indices ? attribute->indices[element] : element;
}

/* One component as a double, as stored (integers are not divided by their maximum). */
double mt_attribute_get(const mt_attribute *attribute, mt_index value, uint32_t component);

/* Stores one component; integers are rounded to nearest even and clamped to their range, NaN to 0. */
void mt_attribute_set(mt_attribute *attribute, mt_index value, uint32_t component, double number);

/* What 1.0 of a colour is stored as: the type's maximum for integers, 1 for floats. */
double mt_color_maximum(mt_type type);

#ifdef __cplusplus
}
#endif
#endif
