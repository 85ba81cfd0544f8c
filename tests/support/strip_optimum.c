/* Breadth first over everything that a sequence of indices can have done: which triangles are drawn, the last two
 * vertices, and whether the next triangle is turned over. Each index, and each restart, is one step. */
#include "tests/support/strip_optimum.h"

#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

#define VERTICES 10
#define ENDS (VERTICES + 1) /* and none yet */
#define STATES ((1u << TEST_FEW) * ENDS * ENDS * 2)

typedef struct strip_state {
    unsigned drawn, before, last, odd;
} strip_state;

static unsigned number_of(strip_state s)
{
    return ((s.drawn * ENDS + s.before) * ENDS + s.last) * 2 + s.odd;
}

static strip_state state_of(unsigned number)
{
    strip_state s = {.odd = number % 2, .last = number / 2 % ENDS, .before = number / 2 / ENDS % ENDS};
    s.drawn = number / 2 / ENDS / ENDS;
    return s;
}

/* For each three vertices in turn the triangles that they are, a bit each. */
typedef struct triangle_bits {
    unsigned of[VERTICES][VERTICES][VERTICES];
} triangle_bits;

static void list_bits(const mt_mesh *mesh, triangle_bits *bits)
{
    memset(bits, 0, sizeof *bits);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        const mt_index *v = mesh->corner_vertices + 3 * (size_t)face;
        for (int turn = 0; turn < 3; turn++) {
            bits->of[v[turn]][v[(turn + 1) % 3]][v[(turn + 2) % 3]] |= 1u << face;
        }
    }
}

/* Appends a vertex; false when that draws what must not be drawn. */
static bool append(const triangle_bits *bits, strip_state *s, unsigned vertex)
{
    unsigned a = s->odd ? s->last : s->before, b = s->odd ? s->before : s->last, left = 0;
    bool draws = s->before < VERTICES && a != b && b != vertex && vertex != a;
    if (draws) {
        left = bits->of[a][b][vertex] & ~s->drawn;
        s->drawn |= left & -left;
    }
    if (s->before < VERTICES) {
        s->odd = 1 - s->odd;
    }
    s->before = s->last;
    s->last = vertex;
    return !draws || left;
}

/* Every state is reached first by the fewest steps. */
uint64_t test_strip_optimum(const mt_mesh *mesh)
{
    unsigned *queue = malloc(STATES * sizeof *queue), *steps = malloc(STATES * sizeof *steps);
    assert_true(queue && steps && mesh->face_count <= TEST_FEW && mesh->vertex_count <= VERTICES);
    triangle_bits bits;
    list_bits(mesh, &bits);
    memset(steps, 0xff, STATES * sizeof *steps);
    const strip_state start = {0, VERTICES, VERTICES, 0};
    size_t head = 0, tail = 0;
    queue[tail++] = number_of(start);
    steps[number_of(start)] = 0;
    uint64_t optimum = UINT64_MAX;
    while (head < tail && optimum == UINT64_MAX) {
        unsigned number = queue[head++];
        strip_state from = state_of(number);
        if (from.drawn == (1u << mesh->face_count) - 1) {
            optimum = steps[number];
        }
        for (unsigned vertex = 0; vertex <= mesh->vertex_count; vertex++) { /* the last one is the restart */
            strip_state to = from;
            bool allowed = true;
            if (vertex == mesh->vertex_count) {
                to = start;
                to.drawn = from.drawn;
            } else {
                allowed = append(&bits, &to, vertex);
            }
            if (allowed && steps[number_of(to)] == UINT32_MAX) {
                steps[number_of(to)] = steps[number] + 1;
                queue[tail++] = number_of(to);
            }
        }
    }
    free(queue);
    free(steps);
    return optimum;
}

/* How often a side runs from one vertex to another. */
typedef struct side_counts {
    unsigned from[VERTICES][VERTICES];
} side_counts;

static bool fits(const side_counts *sides, mt_index a, mt_index b, mt_index c, bool manifold)
{
    bool distinct = a != b && b != c && c != a;
    return distinct && (!manifold || (!sides->from[a][b] && !sides->from[b][c] && !sides->from[c][a]));
}

static void add(side_counts *sides, mt_index *face, mt_index a, mt_index b, mt_index c)
{
    const mt_index values[4] = {3, a, b, c};
    memcpy(face, values, sizeof values);
    sides->from[a][b]++;
    sides->from[b][c]++;
    sides->from[c][a]++;
}

/* A new triangle on a side of an old one, with a new vertex or one that is there. */
mt_mesh *test_few_triangles(mt_context *context, test_random *random, bool manifold)
{
    mt_index wanted = 1 + (mt_index)test_random_below(random, TEST_FEW), count = 1, vertex_count = 3;
    mt_index faces[4 * TEST_FEW];
    side_counts sides = {0};
    add(&sides, faces, 0, 1, 2);
    for (int tries = 0; tries < 1000 && count < wanted; tries++) {
        const mt_index *old = faces + 4 * test_random_below(random, count) + 1;
        size_t side = test_random_below(random, 3);
        bool is_new = vertex_count < VERTICES && test_random_below(random, 4) != 0;
        mt_index a = old[side], b = old[(side + 1) % 3];
        mt_index c = is_new ? vertex_count : (mt_index)test_random_below(random, vertex_count);
        bool turn = !manifold && test_random_below(random, 8) == 0;
        if (fits(&sides, b, a, c, manifold)) {
            add(&sides, faces + 4 * (size_t)count++, turn ? a : b, turn ? b : a, c);
            vertex_count += is_new;
        }
    }
    double positions[3 * VERTICES] = {0};
    return test_mesh(context, vertex_count, positions, count, faces);
}
