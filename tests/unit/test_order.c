/* Orders of faces and vertices: the same mesh, whatever it carries, in another order. */
#include "tests/support/random_mesh.h"
#include "tests/support/soup.h"
#include "tests/support/unit.h"

#include <meshtool/order.h>

#include <stdlib.h>
#include <string.h>

/* Elements carry their old numbers as attributes. */
static const mt_index *marks_of(const mt_mesh *mesh, mt_domain domain)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (strcmp(mesh->attributes[i].name, "old number") == 0 && mesh->attributes[i].domain == domain) {
            return mesh->attributes[i].values;
        }
    }
    fail_msg("an attribute was lost");
    return NULL;
}

static void add_marks(mt_context *context, mt_mesh *mesh, mt_domain domain)
{
    mt_index count = mt_mesh_domain_count(mesh, domain);
    mt_attribute_layout layout = {.name = "old number",
                                  .semantic = MT_SEMANTIC_GENERIC,
                                  .domain = domain,
                                  .type = MT_U32,
                                  .component_count = 1,
                                  .value_count = count};
    mt_attribute *attribute = NULL;
    assert_int_equal(mt_mesh_add_attribute(context, mesh, &layout, &attribute), MT_OK);
    for (mt_index i = 0; i < count; i++) {
        ((mt_index *)attribute->values)[i] = i;
    }
}

/* Every old element comes once. */
static void expect_permutation(const mt_index *marks, mt_index count)
{
    unsigned char *seen = calloc(count + (size_t)1, 1);
    assert_non_null(seen);
    for (mt_index i = 0; i < count; i++) {
        assert_true(marks[i] < count && !seen[marks[i]]);
        seen[marks[i]] = 1;
    }
    free(seen);
}

static void expect_same_faces(const mt_mesh *old, const mt_mesh *new)
{
    const mt_index *faces = marks_of(new, MT_DOMAIN_FACE), *vertices = marks_of(new, MT_DOMAIN_VERTEX);
    const mt_index *corners = marks_of(new, MT_DOMAIN_CORNER);
    assert_int_equal(new->face_count, old->face_count);
    assert_int_equal(new->vertex_count, old->vertex_count);
    expect_permutation(faces, old->face_count);
    expect_permutation(vertices, old->vertex_count);
    expect_permutation(corners, old->corner_count);
    for (mt_index face = 0; face < new->face_count; face++) {
        mt_index from = mt_mesh_face_begin(old, faces[face]), at = mt_mesh_face_begin(new, face);
        assert_int_equal(mt_mesh_face_sides(new, face), mt_mesh_face_sides(old, faces[face]));
        for (mt_index i = 0; i < mt_mesh_face_sides(new, face); i++) {
            assert_int_equal(corners[at + i], from + i);
            assert_int_equal(vertices[new->corner_vertices[at + i]], old->corner_vertices[from + i]);
        }
    }
    for (mt_index v = 0; v < new->vertex_count; v++) {
        mt_vec3 p = mt_mesh_position(new, v), q = mt_mesh_position(old, vertices[v]);
        assert_memory_equal(&p, &q, sizeof p);
    }
}

static void expect_orders(mt_context *context, mt_mesh *mesh)
{
    add_marks(context, mesh, MT_DOMAIN_VERTEX);
    add_marks(context, mesh, MT_DOMAIN_FACE);
    add_marks(context, mesh, MT_DOMAIN_CORNER);
    mt_mesh *ordered = NULL;
    assert_int_equal(mt_mesh_order_faces(context, mesh, &ordered), MT_OK);
    expect_same_faces(mesh, ordered);
    mt_mesh_destroy(context, ordered);
    assert_int_equal(mt_mesh_order_vertices(context, mesh, &ordered), MT_OK);
    expect_same_faces(mesh, ordered);
    mt_index used = 0; /* vertices come in the order of their first use */
    for (mt_index c = 0; c < ordered->corner_count; c++) {
        assert_true(ordered->corner_vertices[c] <= used);
        used += ordered->corner_vertices[c] == used;
    }
    mt_mesh_destroy(context, ordered);
}

static bool has_orders(mt_context *context)
{
    double point[3] = {0};
    mt_mesh *mesh = test_mesh(context, 1, point, 0, NULL), *ordered = NULL;
    bool has = mt_mesh_order_faces(context, mesh, &ordered) == MT_OK;
    mt_mesh_destroy(context, mesh);
    mt_mesh_destroy(context, ordered);
    if (!has) {
        assert_int_equal(mt_context_error(context)->status, MT_ERROR_UNSUPPORTED);
        print_message("skipped: built without libmeshoptimizer\n");
        mt_context_clear_error(context);
    }
    return has;
}

static void orders_are_permutations(void **state)
{
    (void)state;
    mt_context *context = test_context();
    test_random random = {99};
    for (int i = 0; i < 300 && has_orders(context); i++) {
        mt_mesh *mesh = i % 3 == 0   ? test_soup(context, &random)
                        : i % 3 == 1 ? test_patch(context, &random)
                                     : test_random_mesh(context, &random);
        expect_orders(context, mesh);
        mt_mesh_destroy(context, mesh);
    }
    test_context_end(context);
}

/* Vertex transformations of separate triangles, drawn through a queue of 16. */
static double misses(const mt_mesh *mesh)
{
    mt_index queue[16], next = 0, count = 0;
    memset(queue, 0xff, sizeof queue);
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        bool hit = false;
        for (int k = 0; k < 16; k++) {
            hit = hit || queue[k] == mesh->corner_vertices[c];
        }
        if (!hit) {
            queue[next] = mesh->corner_vertices[c];
            next = (next + 1) % 16;
            count++;
        }
    }
    return (double)count / mesh->face_count;
}

static void faces_are_ordered_for_the_cache(void **state)
{
    (void)state;
    mt_context *context = test_context();
    mt_mesh *mesh = test_torus(context, 100, 60, true), *ordered = NULL;
    if (has_orders(context)) {
        assert_int_equal(mt_mesh_order_faces(context, mesh, &ordered), MT_OK);
        assert_true(misses(mesh) > 2.5);
        assert_true(misses(ordered) < 0.8);
        mt_mesh_destroy(context, ordered);
    }
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
}

static void every_failed_allocation_is_clean(void **state)
{
    (void)state;
    mt_context *maker = test_context();
    mt_mesh *mesh = test_fan(maker, 50, true);
    for (int way = 0; way < 2 && has_orders(maker); way++) {
        mt_status status = MT_ERROR_OUT_OF_MEMORY;
        for (uint64_t nth = 1; status != MT_OK; nth++) {
            mt_context_options limits = {.failing_allocation = nth};
            mt_context *context = mt_context_create(&limits);
            mt_mesh *ordered = NULL;
            status = (way ? mt_mesh_order_vertices : mt_mesh_order_faces)(context, mesh, &ordered);
            assert_true(status == MT_OK || (status == MT_ERROR_OUT_OF_MEMORY && !ordered));
            mt_mesh_destroy(context, ordered);
            test_context_end(context);
            assert_true(nth < 100);
        }
    }
    mt_mesh_destroy(maker, mesh);
    test_context_end(maker);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orders_are_permutations),
        cmocka_unit_test(faces_are_ordered_for_the_cache),
        cmocka_unit_test(every_failed_allocation_is_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
