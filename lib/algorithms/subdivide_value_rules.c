/* Cost: O(values that stay and their vertices' sharp edges) a level. */
#include "lib/algorithms/subdivide_value_rules.h"

#include <string.h>

void mt_value_rules_release(mt_context *context, mt_value_rules *rules)
{
    mt_free(context, rules->apart);
    mt_free(context, rules->fixed);
    mt_free(context, rules->fading);
    memset(rules, 0, sizeof *rules);
}

static bool is_semi_sharp(float sharpness)
{
    return sharpness > 0 && sharpness < MT_SHARPNESS_INFINITE;
}

/* Whether the edge of a spoke lies within the faces that share a corner's value around the spoke's vertex. */
static bool lies_within(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, mt_index spoke,
                        mt_index corner)
{
    mt_index side = sharp->edges[spoke >> 1].side;
    mt_index own = spoke & 1 ? mt_subdivide_next(topology, side, topology->face_size) : side;
    return topology->twins[side] != side && topology->corner_vertices[own] == topology->corner_vertices[corner];
}

/* How much of a staying value remains when it stays no longer. */
static float own_weight(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, const float *halves,
                        mt_index vertex, mt_index corner)
{
    const mt_sharp_vertex *around = &sharp->vertices[vertex];
    mt_sharpness_sum decay = {0, 0};
    mt_sharpness_decay_add(&decay, around->sharpness, mt_sharpness_next(around->sharpness), true);
    for (mt_index i = around->first_spoke; i < around[1].first_spoke; i++) {
        mt_index spoke = sharp->spokes[i];
        if (lies_within(topology, sharp, spoke, corner)) {
            mt_sharpness_decay_add(&decay, sharp->edges[spoke >> 1].sharpness, halves[spoke], sharp->chaikin);
        }
    }
    return mt_sharpness_decay_weight(&decay);
}

typedef enum fading_state { FADING_STAYS, FADING_ENDS, FADING_OWN } fading_state;

/* Semi-sharp edges of a vertex at this level (halves NULL) or the next; of those within a value's faces if a corner is
 * given. */
static bool has_semi_sharp(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, const float *halves,
                           mt_index vertex, mt_index corner)
{
    const mt_sharp_vertex *around = &sharp->vertices[vertex];
    for (mt_index i = around->first_spoke; i < around[1].first_spoke; i++) {
        mt_index spoke = sharp->spokes[i];
        float sharpness = halves ? halves[spoke] : sharp->edges[spoke >> 1].sharpness;
        if (is_semi_sharp(sharpness) && (corner == MT_NONE || lies_within(topology, sharp, spoke, corner))) {
            return true;
        }
    }
    return false;
}

/* Whether a value that stayed does so at the next level, too. One that depended on the other, which does not stay any
 * more, stays once more on its own: so Far has it. */
static fading_state next_state(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                               const float *halves, const mt_fading_value *value, bool in_pairs)
{
    float sharpness = sharp->vertices[value->vertex].sharpness;
    bool was_semi_sharp = is_semi_sharp(sharpness) || has_semi_sharp(topology, sharp, NULL, value->vertex, MT_NONE);
    if (!was_semi_sharp || mt_sharpness_next(sharpness) > 0) {
        return FADING_STAYS;
    }
    if (!has_semi_sharp(topology, sharp, halves, value->vertex, MT_NONE)) {
        return FADING_ENDS;
    }
    if (value->dependent) {
        bool other_stays = has_semi_sharp(topology, sharp, halves, value->vertex, value->other);
        return in_pairs && !other_stays ? FADING_OWN : FADING_STAYS;
    }
    return has_semi_sharp(topology, sharp, halves, value->vertex, value->corner) ? FADING_STAYS : FADING_ENDS;
}

mt_status mt_value_rules_plan(mt_context *context, const mt_subdivide_topology *topology,
                              const mt_subdivide_sharp *sharp, const float *halves, const mt_value_rules *rules,
                              mt_vertex_patch **patches)
{
    uint64_t count = (uint64_t)rules->fixed_count + rules->fading_count;
    mt_vertex_patch *patch = *patches = mt_allocate_array(context, count, sizeof *patch);
    if (!patch) {
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < rules->fixed_count; i++) {
        mt_index corner = rules->fixed[i];
        *patch++ = (mt_vertex_patch){corner, {corner, corner}, 1, MT_VERTEX_CORNER, MT_VERTEX_CORNER};
    }
    for (mt_index i = 0; i < rules->fading_count; i++) {
        const mt_fading_value *value = &rules->fading[i];
        mt_index corner = value->corner;
        *patch = (mt_vertex_patch){corner, {corner, corner}, 1, MT_VERTEX_CORNER, MT_VERTEX_SMOOTH};
        if (next_state(topology, sharp, halves, value, rules->in_pairs) == FADING_ENDS) {
            mt_index decaying = value->dependent ? value->other : corner;
            patch->weight = own_weight(topology, sharp, halves, value->vertex, decaying);
        }
        patch++;
    }
    return MT_OK;
}

static void refine_fading(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp, const float *halves,
                          const mt_value_rules *rules, const mt_index *vertex_images, mt_value_rules *next)
{
    for (mt_index i = 0; i < rules->fading_count; i++) {
        mt_fading_value value = rules->fading[i];
        fading_state state = next_state(topology, sharp, halves, &value, rules->in_pairs);
        if (state != FADING_ENDS && vertex_images[value.vertex] != MT_NONE) {
            value.dependent = value.dependent && state == FADING_STAYS;
            value.corner *= 4;
            value.other = value.other == MT_NONE ? MT_NONE : 4 * value.other;
            value.vertex = vertex_images[value.vertex];
            next->fading[next->fading_count++] = value;
        }
    }
}

/* New sharp vertices are edge points, each at the corner after 4c of a side c. */
static void refine_apart(const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                         const mt_value_rules *rules, const mt_subdivide_sharp *next_sharp,
                         const mt_index *vertex_images, mt_value_rules *next)
{
    mt_index kept = 0;
    for (mt_index vertex = 0; vertex < sharp->vertex_count; vertex++) {
        if (vertex_images[vertex] != MT_NONE) {
            next->apart[kept++] = rules->apart[vertex];
        }
    }
    for (mt_index vertex = kept; vertex < next_sharp->vertex_count; vertex++) {
        mt_index half = mt_subdivide_child_previous(topology, next_sharp->vertices[vertex].corner), side = half >> 2;
        next->apart[vertex] = topology->twins[side] == side;
    }
}

mt_status mt_value_rules_refine(mt_context *context, const mt_subdivide_topology *topology,
                                const mt_subdivide_sharp *sharp, const float *halves, const mt_value_rules *rules,
                                const mt_subdivide_sharp *next_sharp, const mt_index *vertex_images,
                                mt_value_rules *next)
{
    *next =
        (mt_value_rules){.smooth = rules->smooth, .still_boundary = rules->still_boundary, .in_pairs = rules->in_pairs};
    next->apart = mt_allocate_array(context, next_sharp->vertex_count, sizeof *next->apart);
    next->fixed = mt_allocate_array(context, rules->fixed_count, sizeof *next->fixed);
    next->fading = mt_allocate_array(context, rules->fading_count, sizeof *next->fading);
    if (!next->apart || !next->fixed || !next->fading) {
        mt_value_rules_release(context, next);
        return mt_context_error(context)->status;
    }
    for (mt_index i = 0; i < rules->fixed_count; i++) {
        next->fixed[next->fixed_count++] = 4 * rules->fixed[i];
    }
    refine_fading(topology, sharp, halves, rules, vertex_images, next);
    refine_apart(topology, sharp, rules, next_sharp, vertex_images, next);
    return MT_OK;
}
