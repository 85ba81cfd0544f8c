/* Source: the smooth-triangle rule of OpenSubdiv's Sdc: at an inner edge of a triangle a face point weighs 0.47 and not
 * 1/4, the mean of its faces' weights; it takes away most of the ripples that Catmull-Clark makes of triangles. */
#include "lib/algorithms/subdivide_masks.h"
#include "lib/algorithms/subdivide_values.h"

#define TRIANGLE_WEIGHT 0.47

static mt_index side_count(const mt_subdivide_topology *topology, mt_index face, unsigned sides)
{
    return mt_subdivide_face_begin(topology, face + 1, sides) - mt_subdivide_face_begin(topology, face, sides);
}

static void smooth_edge(const mt_subdivide_loop *loop, mt_index corner, mt_index face, bool wide, unsigned sides)
{
    const mt_subdivide_topology *topology = loop->topology;
    mt_index twin = topology->twins[corner], other = mt_subdivide_face(topology, twin, sides);
    bool here = side_count(topology, face, sides) == 3, there = side_count(topology, other, sides) == 3;
    if (twin == corner || !(here || there)) {
        return;
    }
    double face_weight = 0.5 * ((here ? TRIANGLE_WEIGHT : 0.25) + (there ? TRIANGLE_WEIGHT : 0.25));
    mt_index base = topology->vertex_count, a = topology->corner_vertices[corner];
    mt_index b = topology->corner_vertices[mt_subdivide_next(topology, corner, sides)];
    mt_index target = base + topology->face_count + mt_subdivide_edge(topology, corner, sides);
    for (unsigned k = 0; k < loop->stride; k++) {
        double ends = load(loop, loop->source, a, k, wide) + load(loop, loop->source, b, k, wide);
        double faces = load(loop, loop->target, base + face, k, wide) + load(loop, loop->target, base + other, k, wide);
        double middle = ends * 0.5;
        store(loop, target, k, middle + face_weight * (faces - 2 * middle), wide);
    }
}

static void smooth_edges(const mt_subdivide_loop *loop, uint64_t begin, uint64_t end, bool wide)
{
    const mt_subdivide_topology *topology = loop->topology;
    unsigned sides = topology->face_size;
    for (mt_index face = (mt_index)begin; face < end; face++) {
        mt_index last = mt_subdivide_face_begin(topology, face + 1, sides);
        for (mt_index corner = mt_subdivide_face_begin(topology, face, sides); corner < last; corner++) {
            if (mt_subdivide_is_first(topology, corner)) {
                smooth_edge(loop, corner, face, wide, sides);
            }
        }
    }
}

static void smooth_edges_f32(void *user, uint64_t begin, uint64_t end)
{
    smooth_edges(user, begin, end, false);
}

static void smooth_edges_f64(void *user, uint64_t begin, uint64_t end)
{
    smooth_edges(user, begin, end, true);
}

void mt_subdivide_triangles_plan(const mt_subdivide_topology *topology, mt_type type, uint32_t component_count,
                                 const void *source, void *target, mt_subdivide_pass *second)
{
    mt_subdivide_loop loop = {.topology = topology, .source = source, .target = target, .stride = component_count};
    mt_subdivide_pass_add(second, &loop, type == MT_F64 ? smooth_edges_f64 : smooth_edges_f32, topology->face_count);
}
