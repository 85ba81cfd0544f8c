#include "tests/support/random_mesh.h"

#include "tests/support/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void test_random_values(test_random *random, mt_type type, void *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        double number = ldexp(test_random_unit(random) - 0.5, (int)test_random_below(random, 60) - 30);
        uint64_t bits = test_random_next(random);
        if (type == MT_F64) {
            ((double *)values)[i] = number;
        } else if (type == MT_F32) {
            ((float *)values)[i] = (float)number;
        } else {
            memcpy((char *)values + i * mt_type_size(type), &bits, mt_type_size(type));
        }
    }
}

static void add_attribute(mt_context *context, test_random *random, mt_mesh *mesh, mt_semantic semantic,
                          mt_domain domain, const char *name, mt_type type, uint32_t components)
{
    mt_attribute *attribute;
    mt_attribute_layout layout = {name, semantic, domain, type, components, mt_mesh_domain_count(mesh, domain), false};
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    test_random_values(random, type, attribute->values, layout.value_count * components);
}

static bool toss(test_random *random)
{
    return test_random_below(random, 2);
}

static mt_type any_float(test_random *random)
{
    return toss(random) ? MT_F32 : MT_F64;
}

static mt_type any_color(test_random *random)
{
    static const mt_type types[] = {MT_U8, MT_U16, MT_F32, MT_F64};
    return types[test_random_below(random, 4)];
}

/* In the order in which PLY files list them. */
static void add_attributes(mt_context *context, test_random *random, mt_mesh *mesh, mt_domain domain)
{
    if (toss(random)) {
        add_attribute(context, random, mesh, MT_SEMANTIC_NORMAL, domain, "", any_float(random), 3);
    }
    if (toss(random)) {
        uint32_t components = 3 + (uint32_t)test_random_below(random, 2);
        add_attribute(context, random, mesh, MT_SEMANTIC_COLOR, domain, "", any_color(random), components);
    }
    if (domain == MT_DOMAIN_VERTEX && toss(random)) {
        uint32_t components = 2 + (uint32_t)test_random_below(random, 2);
        add_attribute(context, random, mesh, MT_SEMANTIC_UV, domain, "", any_float(random), components);
    }
    for (uint64_t i = test_random_below(random, 3); i > 0; i--) {
        char name[32];
        snprintf(name, sizeof name, "value%u", (unsigned)i);
        add_attribute(context, random, mesh, MT_SEMANTIC_GENERIC, domain, name, (mt_type)test_random_below(random, 8),
                      1 + (uint32_t)test_random_below(random, 4));
    }
}

static void add_wires(mt_context *context, test_random *random, mt_mesh *mesh)
{
    mesh->wire_count = 1 + (mt_index)test_random_below(random, 5);
    mesh->wire_offsets = mt_allocate_array(context, mesh->wire_count + 1, sizeof(mt_index));
    mesh->wire_vertices = mt_allocate_array(context, 2 * mesh->wire_count, sizeof(mt_index));
    for (mt_index i = 0; i <= mesh->wire_count; i++) {
        mesh->wire_offsets[i] = 2 * i;
    }
    for (mt_index i = 0; i < 2 * mesh->wire_count; i++) {
        mesh->wire_vertices[i] = (mt_index)test_random_below(random, mesh->vertex_count);
    }
}

/* Texture coordinates of the corners; when `some` only of the first half of the faces. */
static void add_corner_uvs(mt_context *context, test_random *random, mt_mesh *mesh, bool some)
{
    mt_index half = mt_mesh_face_begin(mesh, mesh->face_count / 2);
    mt_attribute *uvs;
    mt_attribute_layout layout = {"",   MT_SEMANTIC_UV, MT_DOMAIN_CORNER, any_float(random), 2, mesh->corner_count,
                                  false};
    if (some && half > 0) {
        layout.value_count = half;
        layout.indexed = true;
    }
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &uvs), MT_OK);
    test_random_values(random, layout.type, uvs->values, 2 * layout.value_count);
    for (mt_index corner = 0; layout.indexed && corner < mesh->corner_count; corner++) {
        uvs->indices[corner] = corner < half ? corner : MT_NONE;
    }
}

static mt_mesh *make_faces(mt_context *context, test_random *random, const mt_mesh_layout *wanted)
{
    mt_mesh_layout layout = *wanted;
    mt_index sides[64];
    mt_index most = test_random_below(random, 8) == 0 ? 300 : 5;
    for (mt_index face = 0; !layout.face_size && face < layout.face_count; face++) {
        sides[face] = 3 + (mt_index)test_random_below(random, most);
        layout.corner_count += sides[face];
    }
    mt_mesh *mesh;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index face = 0; mesh->face_offsets && face < mesh->face_count; face++) {
        mesh->face_offsets[face + 1] = mesh->face_offsets[face] + sides[face];
    }
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mesh->corner_vertices[corner] = (mt_index)test_random_below(random, mesh->vertex_count);
    }
    mt_mesh_compact_faces(context, mesh);
    return mesh;
}

mt_mesh *test_random_mesh(mt_context *context, test_random *random)
{
    mt_mesh_layout layout = {.position_type = any_float(random), .vertex_count = test_random_below(random, 400)};
    layout.face_count = layout.vertex_count ? test_random_below(random, 64) : 0;
    layout.face_size = layout.face_count && toss(random) ? 3 + (mt_index)test_random_below(random, 2) : 0;
    mt_mesh *mesh = make_faces(context, random, &layout);
    test_random_values(random, mesh->position_type, mesh->positions, 3 * (size_t)mesh->vertex_count);
    if (mesh->vertex_count && toss(random)) {
        add_wires(context, random, mesh);
    }
    if (mesh->vertex_count) {
        add_attributes(context, random, mesh, MT_DOMAIN_VERTEX);
    }
    if (mesh->face_count) {
        add_attributes(context, random, mesh, MT_DOMAIN_FACE);
        if (toss(random)) {
            add_corner_uvs(context, random, mesh, toss(random));
        }
    }
    return mesh;
}
