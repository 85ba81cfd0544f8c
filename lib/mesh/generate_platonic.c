/* The five regular solids, centred on the origin, counter-clockwise seen from outside. */
#include "lib/mesh/generate.h"

#define GOLDEN 1.6180339887498948482
#define GOLDEN_INVERSE 0.6180339887498948482

mt_status mt_generate_tetrahedron(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1};
    static const uint8_t faces[] = {3, 0, 1, 2, 3, 0, 3, 1, 3, 0, 2, 3, 3, 1, 3, 2};
    mt_literal literal = {4, 4, positions, faces};
    return mt_generate_literal(context, &literal, out);
}

mt_status mt_generate_cube(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
    static const uint8_t faces[] = {4, 0, 3, 2, 1, 4, 4, 5, 6, 7, 4, 0, 1, 5, 4,
                                    4, 1, 2, 6, 5, 4, 2, 3, 7, 6, 4, 3, 0, 4, 7};
    mt_literal literal = {8, 6, positions, faces};
    return mt_generate_literal(context, &literal, out);
}

mt_status mt_generate_octahedron(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1};
    static const uint8_t faces[] = {3, 0, 1, 2, 3, 1, 3, 2, 3, 3, 4, 2, 3, 4, 0, 2,
                                    3, 1, 0, 5, 3, 3, 1, 5, 3, 4, 3, 5, 3, 0, 4, 5};
    mt_literal literal = {6, 8, positions, faces};
    return mt_generate_literal(context, &literal, out);
}

mt_status mt_generate_icosahedron(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    static const double positions[] = {-1, GOLDEN, 0, 1, GOLDEN,  0, -1, -GOLDEN, 0, 1, -GOLDEN, 0,      0,
                                       -1, GOLDEN, 0, 1, GOLDEN,  0, -1, -GOLDEN, 0, 1, -GOLDEN, GOLDEN, 0,
                                       -1, GOLDEN, 0, 1, -GOLDEN, 0, -1, -GOLDEN, 0, 1};
    static const uint8_t faces[] = {3, 0, 11, 5, 3, 0, 5,  1,  3, 0,  1,  7,  3, 0,  7, 10, 3, 0, 10, 11,
                                    3, 1, 5,  9, 3, 5, 11, 4,  3, 11, 10, 2,  3, 10, 7, 6,  3, 7, 1,  8,
                                    3, 3, 9,  4, 3, 3, 4,  2,  3, 3,  2,  6,  3, 3,  6, 8,  3, 3, 8,  9,
                                    3, 4, 9,  5, 3, 2, 4,  11, 3, 6,  2,  10, 3, 8,  6, 7,  3, 9, 8,  1};
    mt_literal literal = {12, 20, positions, faces};
    return mt_generate_literal(context, &literal, out);
}

/* Vertices 0 to 7 are a cube's; two more lie over each of its faces, and each pentagon stands on one of its edges. */
mt_status mt_generate_dodecahedron(mt_context *context, mt_index resolution, mt_mesh **out)
{
    (void)resolution;
    enum { A = 8, B = 12, C = 16 };
    static const double g = GOLDEN, h = GOLDEN_INVERSE;
    const double positions[] = {-1, -1, -1, 1, -1, -1, 1,  1, -1, -1, 1,  -1, -1, -1, 1, 1, -1, 1,  1, 1,
                                1,  -1, 1,  1, 0,  -h, -g, 0, h,  -g, 0,  -h, g,  0,  h, g, -h, -g, 0, h,
                                -g, 0,  -h, g, 0,  h,  g,  0, -g, 0,  -h, -g, 0,  h,  g, 0, -h, g,  0, h};
    static const uint8_t faces[] = {
        5, A, A + 1, 2, C + 2, 1, 5, A + 1, A, 0, C, 3, 5, A + 3, A + 2, 5, C + 3, 6, 5, A + 2, A + 3, 7, C + 1, 4,
        5, B, B + 1, 5, A + 2, 4, 5, B + 1, B, 0, A, 1, 5, B + 3, B + 2, 7, A + 3, 6, 5, B + 2, B + 3, 2, A + 1, 3,
        5, C, C + 1, 7, B + 2, 3, 5, C + 1, C, 0, B, 4, 5, C + 3, C + 2, 2, B + 3, 6, 5, C + 2, C + 3, 5, B + 1, 1};
    mt_literal literal = {20, 12, positions, faces};
    return mt_generate_literal(context, &literal, out);
}
