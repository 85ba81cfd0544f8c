#include "tests/support/surgery_case.h"
#include "tests/support/unit.h"

#include <string.h>

void *test_surgery_begin(mt_context *context, const test_surgeon *surgeon, const mt_mesh *mesh)
{
    void *surgery = NULL;
    assert_int_equal(surgeon->create(context, mesh, &surgery), MT_OK);
    return surgery;
}

void test_surgery_operate(mt_context *context, const test_surgeon *surgeon, void *surgery, test_operation operation)
{
    mt_status status = surgeon->operate(context, surgery, &operation);
    if (status != MT_OK) {
        print_message("%s: %s\n", surgeon->name, mt_context_error(context)->message);
    }
    assert_int_equal(status, MT_OK);
}

mt_mesh *test_surgery_finish(mt_context *context, const test_surgeon *surgeon, void *surgery, const mt_mesh *source)
{
    mt_mesh *mesh = NULL;
    assert_int_equal(surgeon->to_mesh(context, surgery, source, &mesh), MT_OK);
    assert_int_equal(mt_mesh_validate(context, mesh), MT_OK);
    surgeon->destroy(context, surgery);
    return mesh;
}

mt_attribute *test_surgery_attribute(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout)
{
    mt_attribute *attribute = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, layout, &attribute), MT_OK);
    return attribute;
}

const mt_attribute *test_surgery_find(const mt_mesh *mesh, const char *name)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (strcmp(mesh->attributes[i].name, name) == 0) {
            return &mesh->attributes[i];
        }
    }
    fail();
    return NULL;
}

mt_index test_surgery_corner(const mt_mesh *mesh, mt_index face, mt_index vertex)
{
    for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
        if (mesh->corner_vertices[c] == vertex) {
            return c;
        }
    }
    fail();
    return MT_NONE;
}
