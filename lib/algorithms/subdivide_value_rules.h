/* Face-varying rules: what the values of a corner attribute do at vertices that have several of them, or one with a
 * seam that ends there. Everywhere else they follow the vertex.
 *
 * In the topology of the values a seam is a boundary, so the rule for all already makes creases of seams; listed here
 * are the values that stay instead, for ever or until the sharpness around them has decayed. Source: the options of
 * OpenSubdiv 3.5 (Sdc::Options::FVarLinearInterpolation) and what its Far makes of them. */
#ifndef LIB_ALGORITHMS_SUBDIVIDE_VALUE_RULES_H
#define LIB_ALGORITHMS_SUBDIVIDE_VALUE_RULES_H

#include "lib/algorithms/subdivide_sharp.h"

#include <meshtool/subdivide.h>

/* A value that stays while the edges within its faces, or its vertex, are semi-sharp; or, dependent, while the other
 * value of its vertex does. */
typedef struct mt_fading_value {
    mt_index corner; /* one that has the value */
    mt_index vertex; /* of the sharp ones */
    mt_index other;  /* a corner with the other value where the vertex has two, else MT_NONE */
    bool dependent;
} mt_fading_value;

typedef struct mt_value_rules {
    bool smooth;         /* else linear everywhere, and nothing below is set */
    bool still_boundary; /* all values on boundaries and seams stay */
    bool in_pairs;       /* two values of a vertex depend on each other's sharpness */
    uint8_t *apart;      /* per sharp vertex 1: values do not follow it */
    mt_index fixed_count, fading_count;
    mt_index *fixed; /* corners with values that stay for ever */
    mt_fading_value *fading;
} mt_value_rules;

/* Corners numbered by value, each vertex having values of its own: the first corner around a vertex first. numbers
 * receives one per corner, sources per number the value of `attribute` (MT_NONE: the corner has none). The caller frees
 * both. */
mt_status mt_subdivide_number_values(mt_context *context, const mt_subdivide_topology *base,
                                     const mt_attribute *attribute, mt_index **numbers, mt_index **sources,
                                     mt_index *count);

/* Classifies the values of level 0. `base` is the topology of the vertices, `topology` that of the numbered values. */
mt_status mt_value_rules_create(mt_context *context, const mt_subdivide_topology *base,
                                const mt_subdivide_topology *topology, const mt_subdivide_sharp *sharp,
                                const mt_subdivide_options *settings, mt_value_rules *rules);
void mt_value_rules_release(mt_context *context, mt_value_rules *rules);

/* What stays at this level, fixed values first, then fading ones; fixed_count + fading_count patches, which the caller
 * frees. Then the rules of the next level, from how the sharp vertices were refined. */
mt_status mt_value_rules_plan(mt_context *context, const mt_subdivide_topology *topology,
                              const mt_subdivide_sharp *sharp, const float *halves, const mt_value_rules *rules,
                              mt_vertex_patch **patches);
mt_status mt_value_rules_refine(mt_context *context, const mt_subdivide_topology *topology,
                                const mt_subdivide_sharp *sharp, const float *halves, const mt_value_rules *rules,
                                const mt_subdivide_sharp *next_sharp, const mt_index *vertex_images,
                                mt_value_rules *next);

#endif
