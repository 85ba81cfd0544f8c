/* The boxes of a mesh's elements in the space of its rays, rounded outwards. */
#include "lib/spatial/surface_tree.h"

static mt_index wire_size(const mt_mesh *mesh)
{
    return mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0;
}

mt_surface_numbering mt_surface_number(const mt_mesh *mesh, const mt_triangulation *triangulation)
{
    mt_surface_numbering numbering;
    numbering.wires = triangulation->triangle_count;
    numbering.points = (uint64_t)numbering.wires + wire_size(mesh);
    numbering.vertices = numbering.points + mesh->point_count;
    numbering.end = numbering.vertices + mesh->vertex_count;
    return numbering;
}

mt_surface_element mt_surface_small_element(const mt_mesh *mesh, const mt_surface_numbering *numbering, uint64_t number)
{
    mt_index a, b;
    if (number < numbering->points) {
        uint64_t at = number - numbering->wires, next = number + 1 < numbering->points ? at + 1 : at;
        a = mesh->wire_vertices[at];
        b = mesh->wire_vertices[next];
    } else {
        a = number < numbering->vertices ? mesh->point_vertices[number - numbering->points]
                                         : (mt_index)(number - numbering->vertices);
        b = a;
    }
    return (mt_surface_element){{a, b, b}};
}

typedef struct boxing {
    const mt_surface_tree *tree;
    mt_surface_box *boxes; /* one an element; number MT_NONE: left out */
    uint64_t first;        /* element of boxes[0] */
} boxing;

static bool box_element(const mt_surface_tree *tree, mt_surface_element element, mt_surface_box *box)
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        mt_vec3 p = mt_ray_space_point(&tree->space, mt_mesh_position(tree->mesh, element.vertices[i]));
        const double x[3] = {p.x, p.y, p.z};
        for (int axis = 0; axis < 3; axis++) {
            float low = mt_round_down(x[axis]), high = mt_round_up(x[axis]);
            box->lower[axis] = i && box->lower[axis] < low ? box->lower[axis] : low;
            box->upper[axis] = i && box->upper[axis] > high ? box->upper[axis] : high;
        }
        sum += p.x + p.y + p.z; /* space keeps finite points within 2 */
    }
    return isfinite(sum);
}

static void box_elements(void *user, uint64_t begin, uint64_t end)
{
    const boxing *job = user;
    for (uint64_t i = begin; i < end; i++) {
        uint64_t number = job->first + i;
        mt_surface_element element =
            mt_surface_element_of(job->tree->mesh, job->tree->triangulation, &job->tree->numbering, number);
        job->boxes[i].unused = 0;
        bool is_kept = box_element(job->tree, element, &job->boxes[i]);
        job->boxes[i].number = is_kept ? (mt_index)number : MT_NONE;
    }
}

/* The last vertex of a wire begins no segment. Returns how many there are. */
static mt_index drop_wire_ends(const mt_surface_tree *tree, mt_surface_box *boxes)
{
    mt_index dropped = 0;
    for (mt_index wire = 0; wire < tree->mesh->wire_count; wire++) {
        mt_index begin = tree->mesh->wire_offsets[wire], end = tree->mesh->wire_offsets[wire + 1];
        if (end > begin) {
            boxes[end - 1].number = MT_NONE;
            dropped++;
        }
    }
    return dropped;
}

static mt_index drop_left_out(mt_surface_box *boxes, mt_index count)
{
    mt_index kept = 0;
    while (kept < count && boxes[kept].number != MT_NONE) {
        kept++;
    }
    for (mt_index i = kept; i < count; i++) {
        if (boxes[i].number != MT_NONE) {
            boxes[kept++] = boxes[i];
        }
    }
    return kept;
}

typedef struct element_range {
    mt_surface_elements kind;
    uint64_t begin, end;
} element_range;

mt_status mt_surface_boxes_create(mt_context *context, mt_surface_tree *tree, mt_surface_box **out)
{
    const mt_surface_numbering *numbering = &tree->numbering;
    const element_range ranges[] = {{MT_SURFACE_TRIANGLES, 0, numbering->wires},
                                    {MT_SURFACE_WIRES, numbering->wires, numbering->points},
                                    {MT_SURFACE_POINTS, numbering->points, numbering->vertices},
                                    {MT_SURFACE_VERTICES, numbering->vertices, numbering->end}};
    const size_t range_count = sizeof ranges / sizeof *ranges;
    uint64_t room = 0;
    for (size_t i = 0; i < range_count; i++) {
        room += tree->elements & ranges[i].kind ? ranges[i].end - ranges[i].begin : 0;
    }
    if (room >= (1u << MT_SURFACE_FIRST_BITS) || numbering->end > MT_INDEX_MAX) {
        return mt_fail(context, MT_ERROR_TOO_LARGE,
                       "the mesh has %llu elements, a tree of boxes holds at most %u; split the mesh",
                       (unsigned long long)room, 1u << MT_SURFACE_FIRST_BITS);
    }
    mt_surface_box *boxes = mt_allocate_array(context, room, sizeof *boxes);
    if (!boxes) {
        return mt_context_error(context)->status;
    }
    mt_index asked = 0;
    for (size_t i = 0; i < range_count; i++) {
        if (tree->elements & ranges[i].kind) {
            boxing job = {tree, boxes + tree->count, ranges[i].begin};
            mt_index count = (mt_index)(ranges[i].end - ranges[i].begin);
            mt_parallel_for(context, count, 16384, box_elements, &job);
            asked += count - (ranges[i].kind == MT_SURFACE_WIRES ? drop_wire_ends(tree, job.boxes) : 0);
            tree->count += drop_left_out(job.boxes, count);
        }
    }
    tree->left_out = asked - tree->count;
    *out = boxes;
    return MT_OK;
}
