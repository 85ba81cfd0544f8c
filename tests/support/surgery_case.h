/* A case of surgery with what lies on the mesh; everything is asserted to succeed. */
#ifndef TESTS_SUPPORT_SURGERY_CASE_H
#define TESTS_SUPPORT_SURGERY_CASE_H

#include "tests/support/surgery.h"

void *test_surgery_begin(mt_context *context, const test_surgeon *surgeon, const mt_mesh *mesh);
void test_surgery_operate(mt_context *context, const test_surgeon *surgeon, void *surgery, test_operation operation);
/* What is left, as a mesh; destroys the surgery. */
mt_mesh *test_surgery_finish(mt_context *context, const test_surgeon *surgeon, void *surgery, const mt_mesh *source);

mt_attribute *test_surgery_attribute(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout);
/* The attribute of that name. */
const mt_attribute *test_surgery_find(const mt_mesh *mesh, const char *name);
mt_index test_surgery_corner(const mt_mesh *mesh, mt_index face, mt_index vertex);

#endif
