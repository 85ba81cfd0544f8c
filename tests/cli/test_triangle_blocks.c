/* What the oracles pass by: nothing that their test of a box lets through, whatever the triangles, and as many
 * questions are asked on any number of threads. */
#include "tests/support/fixture.h"
#include "tests/support/unit.h"

#include "cli/tradeoff/triangle_blocks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double number(test_random *random, double low, double high)
{
    return low + (high - low) * test_random_unit(random);
}

/* Separate triangles of many sizes; some flat, some alike, some with a vertex that is not finite. */
static mt_mesh *make_triangles(mt_context *context, test_random *random, mt_index count, double scale)
{
    mt_mesh_layout layout = {
        .vertex_count = 3 * count, .face_count = count, .corner_count = 3 * count, .position_type = MT_F64};
    mt_mesh *mesh = NULL;
    assert_int_equal(mt_mesh_create(context, &layout, &mesh), MT_OK);
    for (mt_index face = 0; face < count; face++) {
        double size = scale * pow(10, number(random, -4, 0)), flat = face % 7 == 0 ? 0 : size;
        mt_vec3 at = {number(random, 0, scale), number(random, 0, scale), face % 5 == 0 ? 0 : number(random, 0, scale)};
        for (mt_index side = 0; side < 3; side++) {
            mt_vec3 p = {at.x + number(random, 0, size), at.y + number(random, 0, size),
                         at.z + number(random, 0, flat)};
            p.y = face % 31 == 30 && side == 1 ? (double)NAN : face % 37 == 36 ? (double)INFINITY : p.y;
            mt_mesh_set_position(mesh, 3 * face + side, p);
            mesh->corner_vertices[3 * face + side] = 3 * face + side;
        }
        mesh->face_offsets[face] = 3 * face;
    }
    mesh->face_offsets[count] = 3 * count;
    mt_mesh_compact_faces(context, mesh);
    return mesh;
}

typedef struct question {
    triangle_box box;
    mt_ray ray;
    bool by_ray, any;
    unsigned char *seen; /* how often */
} question;

static bool passes(const void *user, const triangle_box *box)
{
    const question *q = user;
    bool overlaps = true;
    for (int axis = 0; axis < 3; axis++) {
        overlaps = overlaps && q->box.low[axis] <= box->high[axis] && box->low[axis] <= q->box.high[axis];
    }
    return q->any || (q->by_ray ? triangle_box_may_meet(box, &q->ray, 1e-9) : overlaps);
}

static void see(void *user, mt_index triangle)
{
    ((question *)user)->seen[triangle]++;
}

static const triangle_query query = {passes, see};

/* Every finite triangle whose own box passes is seen, none twice, none that is not finite. */
static void expect_all(const mt_mesh *mesh, triangle_blocks *blocks, question *q)
{
    memset(q->seen, 0, mesh->face_count);
    triangle_blocks_visit(blocks, &query, q);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_vec3 p[3] = {mt_mesh_position(mesh, 3 * face), mt_mesh_position(mesh, 3 * face + 1),
                              mt_mesh_position(mesh, 3 * face + 2)};
        bool is_finite = mt_vec3_is_finite(p[0]) && mt_vec3_is_finite(p[1]) && mt_vec3_is_finite(p[2]);
        triangle_box box = triangle_box_around(p);
        assert_true(q->seen[face] <= is_finite);
        assert_true(q->seen[face] || !is_finite || !passes(q, &box));
    }
}

static void ask_questions(mt_context *context, test_random *random, const mt_mesh *mesh, double scale)
{
    mt_triangulation triangulation;
    triangle_blocks blocks = {0};
    question q = {.any = true, .seen = calloc(mesh->face_count + 1, 1)};
    assert_non_null(q.seen);
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(triangle_blocks_make(context, mesh, &triangulation, &blocks), MT_OK);
    expect_all(mesh, &blocks, &q);
    q.any = false;
    for (int i = 0; i < 100; i++) {
        for (int axis = 0; axis < 3; axis++) {
            q.box.low[axis] = number(random, 0, scale);
            q.box.high[axis] = q.box.low[axis] + number(random, 0, i % 3 ? 0.01 : 0.2) * scale;
        }
        mt_vec3 from = {number(random, -1, 2) * scale, number(random, -1, 2) * scale, number(random, -1, 2) * scale};
        mt_vec3 along = {number(random, -1, 1), i % 3 ? number(random, -1, 1) : 0, i % 2 ? number(random, -1, 1) : 0};
        q.ray = mt_ray_make(from, along);
        q.by_ray = i % 2 == 0;
        expect_all(mesh, &blocks, &q);
    }
    triangle_blocks_release(context, &blocks);
    mt_triangulation_release(context, &triangulation);
    free(q.seen);
}

static void test_nothing_that_passes_is_left_out(void **state)
{
    (void)state;
    static const mt_index counts[] = {0, 1, 15, 16, 17, 255, 256, 257, 5000};
    static const double scales[] = {1, 1e300, 1e-300};
    test_random random = {1};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        for (size_t j = 0; j < sizeof scales / sizeof *scales; j++) {
            mt_context *context = test_context();
            mt_mesh *mesh = make_triangles(context, &random, counts[i], scales[j]);
            ask_questions(context, &random, mesh, scales[j]);
            mt_mesh_destroy(context, mesh);
            test_context_end(context);
        }
    }
}

typedef struct asking {
    triangle_blocks blocks;
    unsigned char *asked;
} asking;

static bool always(const void *user, const triangle_box *box)
{
    (void)user;
    (void)box;
    return true;
}

static void ignore(void *user, mt_index triangle)
{
    (void)user;
    (void)triangle;
}

static void ask(void *user, uint64_t begin, uint64_t end)
{
    static const triangle_query everything = {always, ignore};
    asking *a = user;
    for (uint64_t i = begin; i < end; i++) {
        triangle_blocks_visit(&a->blocks, &everything, NULL);
        a->asked[i]++;
    }
}

static size_t count_asked(unsigned thread_count, size_t count, uint64_t work)
{
    mt_context *context = test_context_with_threads(thread_count);
    test_random random = {2};
    mt_mesh *mesh = make_triangles(context, &random, 1000, 1);
    mt_triangulation triangulation;
    asking a = {.asked = calloc(count, 1)};
    assert_non_null(a.asked);
    assert_int_equal(mt_triangulation_init(context, mesh, &triangulation), MT_OK);
    assert_int_equal(triangle_blocks_make(context, mesh, &triangulation, &a.blocks), MT_OK);
    size_t asked = triangle_blocks_ask(context, &a.blocks, count, work, ask, &a);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(a.asked[i], i < asked);
    }
    triangle_blocks_release(context, &a.blocks);
    mt_triangulation_release(context, &triangulation);
    mt_mesh_destroy(context, mesh);
    test_context_end(context);
    free(a.asked);
    return asked;
}

static void test_work_ends_the_questions_alike_for_any_threads(void **state)
{
    (void)state;
    assert_int_equal(count_asked(2, 700, UINT64_MAX), 700);
    assert_int_equal(count_asked(2, 700, 1), 1);
    size_t asked = count_asked(1, 700, 100000);
    assert_in_range(asked, 90, 300);
    assert_int_equal(count_asked(2, 700, 100000), asked);
    assert_int_equal(count_asked(7, 700, 100000), asked);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing_that_passes_is_left_out),
        cmocka_unit_test(test_work_ends_the_questions_alike_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
