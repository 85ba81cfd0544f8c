#include "tests/support/unit.h"

#include "tests/support/same.h"

#include <meshtool/triangulate.h>

#include <math.h>
#include <string.h>

static bool same_number(double a, double b, bool single)
{
    if (isnan(a) || isnan(b)) {
        return isnan(a) && isnan(b);
    }
    if (single) {
        a = (double)(float)a;
        b = (double)(float)b;
    }
    return memcmp(&a, &b, sizeof a) == 0;
}

/* A format without indices makes -0 and +0 one vertex. */
static bool same_position(const mt_mesh *a, mt_index i, const mt_mesh *b, mt_index k, unsigned abilities)
{
    bool single = a->position_type == MT_F32 || b->position_type == MT_F32 || !(abilities & MT_HOLDS_F64);
    mt_vec3 p = mt_mesh_position(a, i), q = mt_mesh_position(b, k);
    double zero = abilities & MT_HOLDS_INDICES ? -0.0 : 0.0;
    return same_number(p.x + zero, q.x + zero, single) && same_number(p.y + zero, q.y + zero, single) &&
           same_number(p.z + zero, q.z + zero, single);
}

static const char *compare_indexed(const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    if (a->vertex_count != b->vertex_count || a->face_count != b->face_count || a->corner_count != b->corner_count) {
        return "counts";
    }
    for (mt_index i = 0; i < a->vertex_count; i++) {
        if (!same_position(a, i, b, i, abilities)) {
            return "a position";
        }
    }
    for (mt_index face = 0; face < a->face_count; face++) {
        if (mt_mesh_face_end(a, face) != mt_mesh_face_end(b, face)) {
            return "the sides of a face";
        }
    }
    for (mt_index corner = 0; corner < a->corner_count; corner++) {
        if (a->corner_vertices[corner] != b->corner_vertices[corner]) {
            return "the vertex of a corner";
        }
    }
    return NULL;
}

static const char *compare_triangles(mt_context *context, const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    mt_triangulation ta, tb;
    const char *difference = NULL;
    assert_int_equal(mt_triangulation_init(context, a, &ta), MT_OK);
    assert_int_equal(mt_triangulation_init(context, b, &tb), MT_OK);
    if (ta.triangle_count != tb.triangle_count) {
        difference = "the number of triangles";
    }
    for (mt_index i = 0; !difference && i < 3 * ta.triangle_count; i++) {
        mt_index va = a->corner_vertices[mt_triangulation_corner(&ta, i / 3, i % 3)];
        mt_index vb = b->corner_vertices[mt_triangulation_corner(&tb, i / 3, i % 3)];
        difference = same_position(a, va, b, vb, abilities) ? NULL : "the position of a corner";
    }
    mt_triangulation_release(context, &ta);
    mt_triangulation_release(context, &tb);
    return difference;
}

/* The attribute of a meaning on a domain; of the vertices, spread, when it is asked for on corners. */
static const mt_attribute *find(const mt_mesh *mesh, mt_semantic semantic, mt_domain domain)
{
    const mt_attribute *attribute = mt_mesh_find_attribute(mesh, semantic, domain);
    bool spread = !attribute && domain == MT_DOMAIN_CORNER;
    return spread ? mt_mesh_find_attribute(mesh, semantic, MT_DOMAIN_VERTEX) : attribute;
}

static mt_index value_of(const mt_mesh *mesh, const mt_attribute *attribute, mt_domain domain, mt_index element)
{
    bool spread = domain == MT_DOMAIN_CORNER && attribute->domain == MT_DOMAIN_VERTEX;
    return mt_attribute_value_index(attribute, spread ? mesh->corner_vertices[element] : element);
}

/* A component that is not stored: alpha 1, grey spread, else 0. */
static double component_of(const mt_attribute *attribute, mt_index value, uint32_t component)
{
    uint32_t count = attribute->component_count;
    if (attribute->semantic != MT_SEMANTIC_COLOR) {
        return component < count ? mt_attribute_get(attribute, value, component) : 0.0;
    }
    uint32_t from = component == 3 ? count - 1 : count <= 2 ? 0 : component;
    return component == 3 && count % 2 == 1
               ? 1.0
               : mt_attribute_get(attribute, value, from) / mt_color_maximum(attribute->type);
}

static const char *compare_attribute(const mt_mesh *a, const mt_mesh *b, mt_semantic semantic, mt_domain domain,
                                     uint32_t components)
{
    const mt_attribute *x = find(a, semantic, domain), *y = find(b, semantic, domain);
    if (!x && !y) {
        return NULL;
    }
    if (!x || !y) {
        return "the presence of an attribute";
    }
    bool single = x->type == MT_F32 || y->type == MT_F32;
    for (mt_index element = 0; element < mt_mesh_domain_count(a, domain); element++) {
        mt_index i = value_of(a, x, domain, element), k = value_of(b, y, domain, element);
        if ((i == MT_NONE) != (k == MT_NONE)) {
            return "which elements have an attribute";
        }
        for (uint32_t c = 0; i != MT_NONE && c < components; c++) {
            if (!same_number(component_of(x, i, c), component_of(y, k, c), single)) {
                return "a value of an attribute";
            }
        }
    }
    return NULL;
}

static const char *compare_attributes(const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    const struct {
        unsigned ability;
        mt_semantic semantic;
        mt_domain domain;
        uint32_t components;
    } kinds[] = {{MT_HOLDS_VERTEX_NORMALS, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX, 3},
                 {MT_HOLDS_CORNER_NORMALS, MT_SEMANTIC_NORMAL, MT_DOMAIN_CORNER, 3},
                 {MT_HOLDS_FACE_NORMALS, MT_SEMANTIC_NORMAL, MT_DOMAIN_FACE, 3},
                 {MT_HOLDS_VERTEX_UVS, MT_SEMANTIC_UV, MT_DOMAIN_VERTEX, abilities & MT_HOLDS_UV_DEPTH ? 3 : 2},
                 {MT_HOLDS_CORNER_UVS, MT_SEMANTIC_UV, MT_DOMAIN_CORNER, abilities & MT_HOLDS_UV_DEPTH ? 3 : 2},
                 {MT_HOLDS_VERTEX_COLORS, MT_SEMANTIC_COLOR, MT_DOMAIN_VERTEX, abilities & MT_HOLDS_ALPHA ? 4 : 3},
                 {MT_HOLDS_FACE_COLORS, MT_SEMANTIC_COLOR, MT_DOMAIN_FACE, abilities & MT_HOLDS_ALPHA ? 4 : 3},
                 {MT_HOLDS_GENERIC, MT_SEMANTIC_GENERIC, MT_DOMAIN_VERTEX, 1},
                 {MT_HOLDS_GENERIC, MT_SEMANTIC_GENERIC, MT_DOMAIN_FACE, 1}};
    const char *difference = NULL;
    for (size_t i = 0; !difference && i < sizeof kinds / sizeof kinds[0]; i++) {
        if (abilities & kinds[i].ability) {
            difference = compare_attribute(a, b, kinds[i].semantic, kinds[i].domain, kinds[i].components);
        }
    }
    return difference;
}

static const char *name_of(const mt_labels *labels, mt_index face)
{
    return labels && labels->face_labels[face] != MT_NONE ? labels->names[labels->face_labels[face]] : "";
}

static const char *compare_labels(const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    for (int kind = MT_LABEL_GROUP; kind <= MT_LABEL_SOLID; kind++) {
        const mt_labels *x = mt_mesh_find_labels(a, (mt_label_kind)kind);
        const mt_labels *y = mt_mesh_find_labels(b, (mt_label_kind)kind);
        unsigned ability = kind == MT_LABEL_SOLID ? MT_HOLDS_SOLIDS : MT_HOLDS_GROUPS;
        for (mt_index face = 0; (abilities & ability) && face < a->face_count && face < b->face_count; face++) {
            if (strcmp(name_of(x, face), name_of(y, face)) != 0) {
                return mt_label_kind_name((mt_label_kind)kind);
            }
        }
    }
    return NULL;
}

static bool same_indices(const mt_index *a, const mt_index *b, uint64_t count)
{
    return count == 0 || memcmp(a, b, count * sizeof *a) == 0;
}

/* Wires as the segments that they are made of: some formats hold edges alone. */
static mt_index next_segment(const mt_mesh *mesh, mt_index at, mt_index *wire)
{
    while (*wire < mesh->wire_count && at + 1 >= mesh->wire_offsets[*wire + 1]) {
        ++*wire;
        at = *wire < mesh->wire_count ? mesh->wire_offsets[*wire] : at;
    }
    return at;
}

static bool same_wires(const mt_mesh *a, const mt_mesh *b)
{
    mt_index i = 0, k = 0, wire_a = 0, wire_b = 0;
    for (;; i++, k++) {
        i = next_segment(a, i, &wire_a);
        k = next_segment(b, k, &wire_b);
        if (wire_a == a->wire_count || wire_b == b->wire_count) {
            return wire_a == a->wire_count && wire_b == b->wire_count;
        }
        if (memcmp(a->wire_vertices + i, b->wire_vertices + k, 2 * sizeof(mt_index)) != 0) {
            return false;
        }
    }
}

static const char *compare_elements(const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    if (abilities & MT_HOLDS_WIRES && !same_wires(a, b)) {
        return "the wires";
    }
    if (abilities & MT_HOLDS_POINTS &&
        (a->point_count != b->point_count || !same_indices(a->point_vertices, b->point_vertices, a->point_count))) {
        return "the points";
    }
    if (!(abilities & MT_HOLDS_CREASES)) {
        return NULL;
    }
    if (a->crease_count != b->crease_count || a->sharp_vertex_count != b->sharp_vertex_count) {
        return "the number of creases";
    }
    for (mt_index i = 0; i < a->crease_count; i++) {
        if (a->creases[i].a != b->creases[i].a || a->creases[i].b != b->creases[i].b ||
            a->creases[i].value != b->creases[i].value) {
            return "a crease";
        }
    }
    for (mt_index i = 0; i < a->sharp_vertex_count; i++) {
        if (a->sharp_vertices[i].vertex != b->sharp_vertices[i].vertex ||
            a->sharp_vertices[i].value != b->sharp_vertices[i].value) {
            return "a sharp vertex";
        }
    }
    return NULL;
}

const char *test_difference(mt_context *context, const mt_mesh *a, const mt_mesh *b, unsigned abilities)
{
    bool indexed = (abilities & MT_HOLDS_POLYGONS) && (abilities & MT_HOLDS_INDICES);
    const char *difference = indexed ? compare_indexed(a, b, abilities) : compare_triangles(context, a, b, abilities);
    if (!difference && indexed) {
        difference = compare_attributes(a, b, abilities);
    }
    if (!difference && (abilities & MT_HOLDS_POLYGONS)) {
        difference = compare_labels(a, b, abilities);
    }
    return difference || !indexed ? difference : compare_elements(a, b, abilities);
}
