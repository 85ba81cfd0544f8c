/* What is sharp at level 0: creases are named by their vertices, and found on the mesh.
 * Cost: for each crease the smaller valence of its two ends, then O(vertices + edges); nothing when nothing is sharp.
 */
#include "lib/algorithms/subdivide_sharp.h"

/* A walk around a vertex for the side that joins it to another. */
typedef struct ring_walk {
    mt_index start, corner, target;
    bool ended;
} ring_walk;

static ring_walk begin_walk(const mt_subdivide_topology *topology, mt_index vertex, mt_index target)
{
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    ring_walk walk = {start, start, target, start == MT_NONE};
    return walk;
}

/* Looks at one face; returns the side when it was found, else MT_NONE. */
static mt_index step_walk(const mt_subdivide_topology *topology, ring_walk *walk, unsigned sides)
{
    mt_index previous = mt_subdivide_previous(topology, walk->corner, sides);
    if (topology->corner_vertices[mt_subdivide_next(topology, walk->corner, sides)] == walk->target) {
        return walk->corner;
    }
    if (topology->corner_vertices[previous] == walk->target) {
        return previous;
    }
    walk->corner = topology->twins[previous];
    walk->ended = walk->corner == previous || walk->corner == walk->start;
    return MT_NONE;
}

/* A side of the edge a-b, MT_NONE when no face has it. Both ends are tried in step, so that a hub of many spokes
 * costs no more than their rims. */
static mt_index find_side(const mt_subdivide_topology *topology, mt_index a, mt_index b)
{
    unsigned sides = topology->face_size;
    ring_walk walks[2] = {begin_walk(topology, a, b), begin_walk(topology, b, a)};
    for (unsigned i = 0; !walks[0].ended && !walks[1].ended; i ^= 1) {
        mt_index side = step_walk(topology, &walks[i], sides);
        if (side != MT_NONE) {
            return side;
        }
    }
    return MT_NONE;
}

/* Tables over all of the mesh, while its few sharp parts are listed. */
typedef struct sharp_tables {
    mt_index *edge_slots;    /* per edge its place in the list, MT_NONE: none */
    mt_index *spoke_counts;  /* per vertex */
    float *vertex_sharpness; /* per vertex */
} sharp_tables;

static void release_tables(mt_context *context, sharp_tables *tables)
{
    mt_free(context, tables->edge_slots);
    mt_free(context, tables->spoke_counts);
    mt_free(context, tables->vertex_sharpness);
}

static mt_status create_tables(mt_context *context, const mt_subdivide_topology *topology, sharp_tables *tables)
{
    tables->edge_slots = mt_allocate_array(context, topology->edge_count, sizeof *tables->edge_slots);
    tables->spoke_counts = mt_allocate_array_zeroed(context, topology->vertex_count, sizeof *tables->spoke_counts);
    tables->vertex_sharpness = mt_allocate_array_zeroed(context, topology->vertex_count, sizeof(float));
    if (!tables->edge_slots || !tables->spoke_counts || !tables->vertex_sharpness) {
        return mt_context_error(context)->status;
    }
    for (mt_index edge = 0; edge < topology->edge_count; edge++) {
        tables->edge_slots[edge] = MT_NONE;
    }
    return MT_OK;
}

/* Lists the creases of faces, each once with its last sharpness; a zero stays in the list as yet. */
static void list_edges(const mt_subdivide_topology *topology, const mt_sharp_input *input, sharp_tables *tables,
                       mt_subdivide_sharp *sharp)
{
    for (mt_index i = 0; i < input->crease_count; i++) {
        const mt_edge_value *crease = &input->creases[i];
        mt_index side = find_side(topology, crease->a, crease->b);
        if (side == MT_NONE) {
            sharp->missing[sharp->missing_count++] = *crease;
            continue;
        }
        mt_index *slot = &tables->edge_slots[mt_subdivide_edge(topology, side, topology->face_size)];
        *slot = *slot == MT_NONE ? sharp->edge_count++ : *slot;
        float sharpness = crease->value > 0 ? (float)crease->value : 0;
        bool implied = i >= input->asked_crease_count;
        sharp->edges[*slot] = (mt_sharp_edge){side, sharpness, topology->twins[side] == side, implied};
    }
    mt_index count = 0;
    for (mt_index edge = 0; edge < sharp->edge_count; edge++) {
        if (sharp->edges[edge].sharpness > 0) {
            sharp->edges[count++] = sharp->edges[edge];
        }
    }
    sharp->edge_count = count;
}

static mt_index spoke_vertex(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, mt_index spoke)
{
    return topology->corner_vertices[mt_subdivide_spoke_end(topology, sharp, spoke ^ 1)];
}

static bool has_one_face(const mt_subdivide_topology *topology, mt_index corner)
{
    mt_index previous = mt_subdivide_previous(topology, corner, topology->face_size);
    return topology->twins[corner] == corner && topology->twins[previous] == previous;
}

static void note_vertices(const mt_subdivide_topology *topology, const mt_sharp_input *input,
                          const mt_subdivide_sharp *sharp, sharp_tables *tables)
{
    for (mt_index i = 0; i < input->vertex_count; i++) {
        double value = input->vertices[i].value;
        tables->vertex_sharpness[input->vertices[i].vertex] = value > 0 ? (float)value : 0;
    }
    for (mt_index vertex = 0; input->corners && vertex < topology->vertex_count; vertex++) {
        mt_index corner = mt_subdivide_vertex_corner(topology, vertex);
        if (corner != MT_NONE && has_one_face(topology, corner)) {
            tables->vertex_sharpness[vertex] = MT_SHARPNESS_INFINITE;
        }
    }
    for (mt_index spoke = 0; spoke < 2 * sharp->edge_count; spoke++) {
        if (!sharp->edges[spoke >> 1].boundary) {
            tables->spoke_counts[spoke_vertex(topology, sharp, spoke)]++;
        }
    }
}

static bool is_sharp(const mt_subdivide_topology *topology, const sharp_tables *tables, mt_index vertex)
{
    bool marked = tables->spoke_counts[vertex] > 0 || tables->vertex_sharpness[vertex] > 0;
    return marked && topology->vertex_corners[vertex] != MT_NONE;
}

/* Vertices in their order; then spoke_counts becomes where each one's next spoke goes. */
static mt_status list_vertices(mt_context *context, const mt_subdivide_topology *topology, sharp_tables *tables,
                               mt_subdivide_sharp *sharp)
{
    mt_index count = 0, spoke = 0;
    for (mt_index vertex = 0; vertex < topology->vertex_count; vertex++) {
        count += is_sharp(topology, tables, vertex);
    }
    sharp->vertices = mt_allocate_array(context, (uint64_t)count + 1, sizeof *sharp->vertices);
    sharp->spokes = mt_allocate_array(context, 2 * (uint64_t)sharp->edge_count, sizeof *sharp->spokes);
    if (!sharp->vertices || !sharp->spokes) {
        return mt_context_error(context)->status;
    }
    for (mt_index vertex = 0; vertex < topology->vertex_count; vertex++) {
        if (is_sharp(topology, tables, vertex)) {
            mt_index corner = mt_subdivide_vertex_corner(topology, vertex);
            mt_sharp_vertex listed = {corner, spoke, tables->vertex_sharpness[vertex],
                                      topology->twins[corner] == corner};
            sharp->vertices[sharp->vertex_count++] = listed;
            mt_index spokes = tables->spoke_counts[vertex];
            tables->spoke_counts[vertex] = spoke;
            spoke += spokes;
        }
    }
    sharp->vertices[count] = (mt_sharp_vertex){.first_spoke = spoke};
    for (spoke = 0; spoke < 2 * sharp->edge_count; spoke++) {
        if (!sharp->edges[spoke >> 1].boundary) {
            sharp->spokes[tables->spoke_counts[spoke_vertex(topology, sharp, spoke)]++] = spoke;
        }
    }
    return MT_OK;
}

mt_status mt_subdivide_sharp_create(mt_context *context, const mt_subdivide_topology *topology,
                                    const mt_sharp_input *input, mt_subdivide_sharp *sharp)
{
    *sharp = (mt_subdivide_sharp){.chaikin = input->chaikin};
    if (input->crease_count == 0 && input->vertex_count == 0 && !input->corners) {
        return MT_OK;
    }
    sharp_tables tables = {0};
    sharp->edges = mt_allocate_array(context, input->crease_count, sizeof *sharp->edges);
    sharp->missing = mt_allocate_array(context, input->crease_count, sizeof *sharp->missing);
    mt_status status = create_tables(context, topology, &tables);
    if (status == MT_OK && !(sharp->edges && sharp->missing)) {
        status = mt_context_error(context)->status;
    }
    if (status == MT_OK) {
        list_edges(topology, input, &tables, sharp);
        note_vertices(topology, input, sharp, &tables);
        status = list_vertices(context, topology, &tables, sharp);
    }
    release_tables(context, &tables);
    if (status != MT_OK) {
        mt_subdivide_sharp_release(context, sharp);
    }
    return status;
}
