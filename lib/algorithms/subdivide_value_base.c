/* The values of a corner attribute at level 0: numbered by vertex, and sorted into those that follow their vertex, a
 * crease along a seam, or nothing. Cost: O(corners). */
#include "lib/algorithms/subdivide_value_rules.h"

/* A walk over the corners around a vertex, counter-clockwise: the side of each is shared with the one before. */
typedef struct ring {
    const mt_subdivide_topology *topology;
    mt_index start, corner;
    bool ended;
} ring;

static ring begin_ring(const mt_subdivide_topology *topology, mt_index vertex)
{
    mt_index start = mt_subdivide_vertex_corner(topology, vertex);
    return (ring){topology, start, start, start == MT_NONE};
}

static void step_ring(ring *walk)
{
    mt_index previous = mt_subdivide_previous(walk->topology, walk->corner, walk->topology->face_size);
    mt_index next = walk->topology->twins[previous];
    walk->corner = next;
    walk->ended = next == previous || next == walk->start;
}

static void number_ring(const mt_subdivide_topology *base, const mt_attribute *attribute, mt_index vertex,
                        mt_index *stamps, mt_index *numbers, mt_index *sources, mt_index *count)
{
    mt_index missing = attribute->value_count; /* the stamp of corners that have none */
    for (ring walk = begin_ring(base, vertex); !walk.ended; step_ring(&walk)) {
        mt_index value = mt_attribute_value_index(attribute, walk.corner);
        mt_index *stamp = &stamps[value == MT_NONE ? missing : value];
        bool known = *stamp != MT_NONE && base->corner_vertices[*stamp] == vertex;
        numbers[walk.corner] = known ? numbers[*stamp] : *count;
        if (!known) {
            *stamp = walk.corner;
            sources[(*count)++] = value;
        }
    }
}

mt_status mt_subdivide_number_values(mt_context *context, const mt_subdivide_topology *base,
                                     const mt_attribute *attribute, mt_index **numbers, mt_index **sources,
                                     mt_index *count)
{
    uint64_t stamp_count = (uint64_t)attribute->value_count + 1;
    mt_index *stamps = mt_allocate_array(context, stamp_count, sizeof *stamps);
    *numbers = mt_allocate_array(context, base->corner_count, sizeof **numbers);
    *sources = mt_allocate_array(context, base->corner_count, sizeof **sources);
    *count = 0;
    bool complete = stamps && *numbers && *sources;
    for (uint64_t i = 0; complete && i < stamp_count; i++) {
        stamps[i] = MT_NONE;
    }
    for (mt_index vertex = 0; complete && vertex < base->vertex_count; vertex++) {
        number_ring(base, attribute, vertex, stamps, *numbers, *sources, count);
    }
    mt_free(context, stamps);
    if (!complete) {
        mt_free(context, *numbers);
        mt_free(context, *sources);
        *numbers = *sources = NULL;
    }
    return complete ? MT_OK : mt_context_error(context)->status;
}

/* The faces of a vertex that share a value. */
typedef struct value_span {
    mt_index corner; /* the first of them */
    mt_index size, fan_count;
    mt_index infinite_count, semi_sharp_count; /* sharp edges between two of them */
} value_span;

typedef struct classifier {
    const mt_subdivide_topology *base, *topology;
    const mt_subdivide_sharp *sharp;
    mt_subdivide_face_varying option;
    bool corners_are_smooth; /* of the surface */
    value_span *spans;       /* of the vertex at hand, from number first_value on */
    mt_index first_value, span_count;
    bool seam, boundary;
    mt_value_rules *rules;
} classifier;

static void gather_spans(classifier *c, mt_index vertex)
{
    const mt_subdivide_topology *topology = c->topology, *base = c->base;
    ring walk = begin_ring(base, vertex);
    c->span_count = 0;
    c->seam = false;
    c->boundary = base->twins[walk.start] == walk.start;
    c->first_value = topology->corner_vertices[walk.start];
    for (; !walk.ended; step_ring(&walk)) {
        mt_index number = topology->corner_vertices[walk.corner] - c->first_value;
        value_span *span = &c->spans[number];
        if (number == c->span_count) {
            *span = (value_span){.corner = walk.corner};
            c->span_count++;
        }
        bool cut = topology->twins[walk.corner] == walk.corner;
        span->size++;
        span->fan_count += cut;
        c->seam = c->seam || (cut && base->twins[walk.corner] != walk.corner);
    }
}

/* Sharp edges within spans. */
static void gather_sharpness(classifier *c, mt_index sharp_vertex)
{
    const mt_subdivide_sharp *sharp = c->sharp;
    const mt_sharp_vertex *vertex = &sharp->vertices[sharp_vertex];
    for (mt_index i = vertex->first_spoke; i < vertex[1].first_spoke; i++) {
        const mt_sharp_edge *edge = &sharp->edges[sharp->spokes[i] >> 1];
        mt_index next = mt_subdivide_next(c->topology, edge->side, c->topology->face_size);
        mt_index corner = sharp->spokes[i] & 1 ? next : edge->side;
        value_span *span = &c->spans[c->topology->corner_vertices[corner] - c->first_value];
        if (c->topology->twins[edge->side] != edge->side) {
            span->infinite_count += edge->sharpness >= MT_SHARPNESS_INFINITE;
            span->semi_sharp_count += edge->sharpness < MT_SHARPNESS_INFINITE;
        }
    }
}

/* Whether the values do not follow their vertex. */
static bool is_apart(const classifier *c)
{
    if (c->seam) {
        return true;
    }
    if (!c->boundary) {
        return false;
    }
    bool lone_face = c->spans[0].size == 1;
    return c->rules->still_boundary ||
           (lone_face && c->corners_are_smooth && c->option != MT_SUBDIVIDE_FACE_VARYING_NONE);
}

/* Whether every value of the vertex stays for ever. */
static bool all_stay(const classifier *c, float vertex_sharpness)
{
    const value_span *a = &c->spans[0], *b = &c->spans[1];
    bool plus2 = c->option == MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS2;
    if (vertex_sharpness >= MT_SHARPNESS_INFINITE || (plus2 && c->span_count == 1 && !c->boundary)) {
        return true;
    }
    if (!c->rules->in_pairs || c->span_count < 2) {
        return false;
    }
    return c->span_count > 2 || a->infinite_count || b->infinite_count || a->fan_count > 1 || b->fan_count > 1 ||
           (plus2 && (a->size == 1 || b->size == 1));
}

static void list_values(classifier *c, mt_index sharp_vertex, float vertex_sharpness)
{
    mt_value_rules *rules = c->rules;
    bool all = all_stay(c, vertex_sharpness), pair = c->span_count == 2;
    bool depend = rules->in_pairs && pair && (c->spans[0].semi_sharp_count > 0) != (c->spans[1].semi_sharp_count > 0);
    for (mt_index i = 0; i < c->span_count; i++) {
        const value_span *span = &c->spans[i];
        bool corner = span->size == 1 && c->option != MT_SUBDIVIDE_FACE_VARYING_NONE;
        bool own = span->semi_sharp_count > 0 || vertex_sharpness > 0;
        if (all || corner || span->fan_count > 1 || span->infinite_count > 0) {
            rules->fixed[rules->fixed_count++] = span->corner;
        } else if (own || depend) {
            mt_index other = pair ? c->spans[1 - i].corner : MT_NONE;
            rules->fading[rules->fading_count++] = (mt_fading_value){span->corner, sharp_vertex, other, !own};
        }
    }
}

static void classify_vertex(classifier *c, mt_index vertex, mt_index *sharp_vertex)
{
    mt_index corner = mt_subdivide_vertex_corner(c->base, vertex);
    if (corner == MT_NONE) {
        return;
    }
    gather_spans(c, vertex);
    mt_index number = *sharp_vertex;
    bool sharp = number < c->sharp->vertex_count && c->sharp->vertices[number].corner == corner;
    bool apart = is_apart(c);
    if (sharp) {
        c->rules->apart[number] = apart;
        ++*sharp_vertex;
    }
    if (!apart || c->rules->still_boundary) {
        return;
    }
    if (sharp) {
        gather_sharpness(c, number);
    }
    list_values(c, number, sharp ? c->sharp->vertices[number].sharpness : 0);
}

mt_status mt_value_rules_create(mt_context *context, const mt_subdivide_topology *base,
                                const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                                const mt_subdivide_options *settings, mt_value_rules *rules)
{
    mt_subdivide_face_varying option = settings->face_varying;
    *rules = (mt_value_rules){.smooth = true};
    rules->still_boundary = option == MT_SUBDIVIDE_FACE_VARYING_BOUNDARIES;
    rules->in_pairs =
        option == MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS1 || option == MT_SUBDIVIDE_FACE_VARYING_CORNERS_PLUS2;
    classifier c = {.base = base, .topology = topology, .sharp = sharp, .option = option, .rules = rules};
    c.corners_are_smooth = settings->boundary != MT_SUBDIVIDE_BOUNDARY_CORNERS;
    c.spans = mt_allocate_array(context, topology->vertex_count, sizeof *c.spans);
    rules->apart = mt_allocate_array_zeroed(context, sharp->vertex_count, sizeof *rules->apart);
    rules->fixed = mt_allocate_array(context, topology->vertex_count, sizeof *rules->fixed);
    rules->fading = mt_allocate_array(context, topology->vertex_count, sizeof *rules->fading);
    bool complete = c.spans && rules->apart && rules->fixed && rules->fading;
    mt_index sharp_vertex = 0;
    for (mt_index vertex = 0; complete && vertex < base->vertex_count; vertex++) {
        classify_vertex(&c, vertex, &sharp_vertex);
    }
    mt_free(context, c.spans);
    if (!complete) {
        mt_value_rules_release(context, rules);
    }
    return complete ? MT_OK : mt_context_error(context)->status;
}
