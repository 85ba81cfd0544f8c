#include "tests/support/unit.h"

#include "tests/support/zoo.h"

#include "tests/support/fixture.h"
#include "tests/support/soup.h"

#include <meshtool/generate.h>

#include <math.h>
#include <string.h>

static mt_attribute *add(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout)
{
    mt_attribute *attribute;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, layout, &attribute), MT_OK);
    return attribute;
}

/* Values that exercise every digit, within 0 to 1. */
static void fill(mt_attribute *attribute, uint64_t seed)
{
    test_random random = {seed};
    double scale = attribute->semantic == MT_SEMANTIC_COLOR ? mt_color_maximum(attribute->type) : 1.0;
    for (mt_index i = 0; i < attribute->value_count; i++) {
        for (uint32_t k = 0; k < attribute->component_count; k++) {
            mt_attribute_set(attribute, i, k, scale * test_random_unit(&random));
        }
    }
}

static void add_vertex_attributes(mt_context *context, mt_mesh *mesh, mt_type type, mt_type color_type)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_NORMAL,
                                  .domain = MT_DOMAIN_VERTEX,
                                  .type = type,
                                  .component_count = 3,
                                  .value_count = mesh->vertex_count};
    fill(add(context, mesh, &layout), 1);
    layout.semantic = MT_SEMANTIC_UV;
    layout.component_count = 2;
    fill(add(context, mesh, &layout), 2);
    layout.semantic = MT_SEMANTIC_COLOR;
    layout.type = color_type;
    layout.component_count = 3;
    fill(add(context, mesh, &layout), 3);
}

/* Corner UVs and normals with their own indices; a seam, and corners that have none. */
static void add_corner_attributes(mt_context *context, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_UV,
                                  .domain = MT_DOMAIN_CORNER,
                                  .type = MT_F64,
                                  .component_count = 2,
                                  .value_count = mesh->corner_count / 2 + 1,
                                  .indexed = true};
    for (int i = 0; i < 2; i++) {
        mt_attribute *attribute = add(context, mesh, &layout);
        fill(attribute, 4);
        for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
            attribute->indices[corner] = i && corner % 5 == 4 ? MT_NONE : corner / 2;
        }
        layout.semantic = MT_SEMANTIC_NORMAL;
        layout.component_count = 3;
    }
}

static void add_face_attributes(mt_context *context, mt_mesh *mesh)
{
    mt_attribute_layout layout = {.semantic = MT_SEMANTIC_COLOR,
                                  .domain = MT_DOMAIN_FACE,
                                  .type = MT_U8,
                                  .component_count = 4,
                                  .value_count = mesh->face_count};
    fill(add(context, mesh, &layout), 5);
    layout.name = "quality";
    layout.semantic = MT_SEMANTIC_GENERIC;
    layout.type = MT_F32;
    layout.component_count = 1;
    fill(add(context, mesh, &layout), 6);
}

static void add_labels(mt_context *context, mt_mesh *mesh)
{
    static const mt_label_kind kinds[] = {MT_LABEL_GROUP, MT_LABEL_OBJECT, MT_LABEL_MATERIAL, MT_LABEL_SMOOTHING,
                                          MT_LABEL_SOLID};
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        mt_labels *labels;
        mt_index first, second;
        assert_int_equal(mt_mesh_add_labels(context, mesh, kinds[i], &labels), MT_OK);
        assert_int_equal(mt_labels_add_name(context, labels, "first one", &first), MT_OK);
        assert_int_equal(mt_labels_add_name(context, labels, "2", &second), MT_OK);
        for (mt_index face = 0; face < mesh->face_count; face++) {
            labels->face_labels[face] = 2 * face < mesh->face_count ? first : second;
        }
    }
}

static void add_elements(mt_context *context, mt_mesh *mesh)
{
    mesh->wire_offsets = mt_allocate_array(context, 3, sizeof(mt_index));
    mesh->wire_vertices = mt_allocate_array(context, 5, sizeof(mt_index));
    mesh->point_vertices = mt_allocate_array(context, 2, sizeof(mt_index));
    mesh->creases = mt_allocate_array(context, 1, sizeof(mt_edge_value));
    mesh->sharp_vertices = mt_allocate_array(context, 1, sizeof(mt_vertex_value));
    static const mt_index offsets[] = {0, 2, 5}, vertices[] = {0, 1, 2, 3, 0}, points[] = {3, 1};
    memcpy(mesh->wire_offsets, offsets, sizeof offsets);
    memcpy(mesh->wire_vertices, vertices, sizeof vertices);
    memcpy(mesh->point_vertices, points, sizeof points);
    mesh->creases[0] = (mt_edge_value){.a = 0, .b = 1, .value = 2.25};
    mesh->sharp_vertices[0] = (mt_vertex_value){.vertex = 2, .value = 10.0};
    mesh->wire_count = 2;
    mesh->point_count = 2;
    mesh->crease_count = mesh->sharp_vertex_count = 1;
}

static mt_mesh *generate(mt_context *context, const char *name, mt_index resolution, mt_type type)
{
    mt_generate_options options = {.resolution = resolution, .position_type = type};
    mt_mesh *mesh;
    if (mt_generate(context, name, &options, &mesh) != MT_OK) {
        fail_msg("%s", mt_context_error(context)->message);
    }
    return mesh;
}

/* Coordinates that are hard to print and to read. */
static mt_mesh *extreme_numbers(mt_context *context)
{
    static const double positions[] = {0.1,      -0.0,        1e-300,    1.7976931348623157e308,
                                       4.9e-324, 123456789.0, 1.0 / 3.0, 1e22,
                                       -1e-7,    2.5,         1e5,       0.30000000000000004};
    static const mt_index faces[] = {3, 0, 1, 2, 3, 2, 1, 3};
    return test_mesh(context, 4, positions, 2, faces);
}

size_t test_zoo(mt_context *context, test_animal *animals)
{
    static const struct {
        const char *name;
        mt_index resolution;
        mt_type type;
    } primitives[] = {{"tetrahedron", 0, MT_F64}, {"cube", 0, MT_F32},   {"prism", 7, MT_F64}, {"grid", 2, MT_F64},
                      {"cone", 5, MT_F32},        {"bowtie", 0, MT_F64}, {"book", 3, MT_F32},  {"moebius", 6, MT_F64}};
    size_t count = 0;
    for (size_t i = 0; i < sizeof primitives / sizeof primitives[0]; i++) {
        animals[count++] = (test_animal){
            primitives[i].name, generate(context, primitives[i].name, primitives[i].resolution, primitives[i].type)};
    }
    animals[count++] = (test_animal){"empty", test_mesh(context, 0, (const double[]){0}, 0, (const mt_index[]){0})};
    animals[count++] =
        (test_animal){"one vertex", test_mesh(context, 1, (const double[]){1, 2, 3}, 0, (const mt_index[]){0})};
    animals[count++] = (test_animal){"extreme numbers", extreme_numbers(context)};
    animals[count] = (test_animal){"vertex attributes", generate(context, "tetrahedron", 0, MT_F64)};
    add_vertex_attributes(context, animals[count++].mesh, MT_F64, MT_U8);
    animals[count] = (test_animal){"float attributes", generate(context, "cube", 0, MT_F32)};
    add_vertex_attributes(context, animals[count++].mesh, MT_F32, MT_F32);
    animals[count] = (test_animal){"corner attributes", generate(context, "cube", 0, MT_F64)};
    add_corner_attributes(context, animals[count++].mesh);
    animals[count] = (test_animal){"face attributes", generate(context, "tetrahedron", 0, MT_F64)};
    add_face_attributes(context, animals[count++].mesh);
    animals[count] = (test_animal){"labels and elements", generate(context, "cone", 4, MT_F64)};
    add_labels(context, animals[count].mesh);
    add_elements(context, animals[count++].mesh);
    test_random random = {77};
    for (int i = 0; i < 3; i++) {
        animals[count++] = (test_animal){"soup", test_soup(context, &random)};
    }
    assert_true(count <= TEST_ZOO_ROOM);
    return count;
}

bool test_animal_is_refused(const test_animal *animal, const mt_mesh_format *format)
{
    const mt_mesh *mesh = animal->mesh;
    bool finite = true;
    for (mt_index i = 0; i < mesh->vertex_count; i++) {
        mt_vec3 p = mt_mesh_position(mesh, i);
        finite = finite && isfinite((float)p.x) && isfinite((float)p.y) && isfinite((float)p.z);
    }
    return !finite && (format->abilities & MT_NEEDS_FINITE);
}

void test_zoo_end(mt_context *context, test_animal *animals, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        mt_mesh_destroy(context, animals[i].mesh);
    }
}
