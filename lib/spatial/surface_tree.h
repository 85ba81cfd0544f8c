/* The tree's own records, and the steps of making them. */
#ifndef MT_SPATIAL_SURFACE_TREE_H
#define MT_SPATIAL_SURFACE_TREE_H

#include <meshtool/surface_tree.h>

#include <string.h>

#define MT_WIDTH 8

/* Elements of a leaf at most: one vector operation tests them all. */
#define MT_SURFACE_LEAF_SIZE 8

/* Words that a leaf keeps of each element: nine coordinates and the number. */
#define MT_SURFACE_WORDS 10

/* Levels of wide nodes at most; from MT_SURFACE_HALVING_DEPTH on ranges are halved, and 2^28 elements need ten. */
#define MT_SURFACE_DEPTH 64
#define MT_SURFACE_HALVING_DEPTH 48

/* What waits while a tree is walked or built, at most: seven brothers a level, and eight children. */
#define MT_SURFACE_STACK (7 * MT_SURFACE_DEPTH + 8)

/* A child: a node's number, or a leaf with its element count - 1 and the place of its first element. */
#define MT_SURFACE_LEAF 0x80000000u
#define MT_SURFACE_FIRST_BITS 28

/* A child that is not there: no leaf begins so late. */
#define MT_SURFACE_UNUSED UINT32_MAX

static inline uint32_t mt_surface_leaf(mt_index first, mt_index count)
{
    return MT_SURFACE_LEAF | (count - 1) << MT_SURFACE_FIRST_BITS | first;
}

static inline mt_index mt_surface_leaf_first(uint32_t child)
{
    return child & ((1u << MT_SURFACE_FIRST_BITS) - 1);
}

static inline mt_index mt_surface_leaf_count(uint32_t child)
{
    return ((child & ~MT_SURFACE_LEAF) >> MT_SURFACE_FIRST_BITS) + 1;
}

/* planes: lower x, upper x, lower y, ... of the eight children; unused ones begin at infinity and end at minus it. */
typedef struct mt_surface_node {
    float planes[6][MT_WIDTH];
    uint32_t children[MT_WIDTH];
} mt_surface_node;

/* Where each kind's numbers begin. */
typedef struct mt_surface_numbering {
    uint64_t wires, points, vertices, end;
} mt_surface_numbering;
mt_surface_numbering mt_surface_number(const mt_mesh *mesh, const mt_triangulation *triangulation);

/* What an element consists of: three vertices for a triangle, two and the last again for a segment, one thrice. */
typedef struct mt_surface_element {
    mt_index vertices[3];
} mt_surface_element;
mt_surface_element mt_surface_small_element(const mt_mesh *mesh, const mt_surface_numbering *numbering,
                                            uint64_t number);

static inline mt_surface_element mt_surface_element_of(const mt_mesh *mesh, const mt_triangulation *triangulation,
                                                       const mt_surface_numbering *numbering, uint64_t number)
{
    if (number >= numbering->wires) {
        return mt_surface_small_element(mesh, numbering, number);
    }
    mt_surface_element element;
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(triangulation, (mt_index)number, side);
        element.vertices[side] = mesh->corner_vertices[corner];
    }
    return element;
}

/* The next float below or above; zero steps to the smallest subnormal on either side. Quicker than nextafterf. */
static inline float mt_float_step(float f, bool up)
{
    int32_t bits;
    if (f == 0) {
        return up ? 0x1p-149f : -0x1p-149f;
    }
    memcpy(&bits, &f, sizeof bits);
    bits += (bits < 0) == up ? -1 : 1;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static inline float mt_round_down(double x)
{
    float f = (float)x;
    return (double)f > x ? mt_float_step(f, false) : f;
}

static inline float mt_round_up(double x)
{
    float f = (float)x;
    return (double)f < x ? mt_float_step(f, true) : f;
}

struct mt_surface_tree {
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    mt_ray_space space;
    unsigned elements;
    mt_build_quality quality;
    mt_surface_numbering numbering;
    mt_index count, left_out;
    mt_index node_count; /* 0 when there are no elements; else node 0 is the root */
    mt_surface_node *nodes;
    /* Leaf by leaf, each with count n: x of the first corners (n floats), y, z, x of the second ..., n numbers.
     * Followed by room for one more vector, so that whole vectors can be loaded everywhere. */
    uint32_t *words;
};

/* Box of an element, in space. */
typedef struct mt_surface_box {
    float lower[3];
    mt_index number;
    float upper[3];
    mt_index unused;
} mt_surface_box;

/* Boxes of all finite elements, in the order of their numbers; sets the tree's counts. Freed by the caller. */
mt_status mt_surface_boxes_create(mt_context *context, mt_surface_tree *tree, mt_surface_box **out);

/* Makes the nodes and words of a tree from its boxes, which come out in another order. */
mt_status mt_surface_build(mt_context *context, mt_surface_tree *tree, mt_surface_box *boxes);

#endif
