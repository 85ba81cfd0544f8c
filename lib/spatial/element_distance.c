#include "lib/spatial/element_distance.h"

/* Compiled twice by itself too, for those who measure one element. */
MT_CLONES static void measure(const mt_surface_tree *tree, mt_index number, const mt_vec3 *scaled,
                              mt_element_distance *out)
{
    *out = mt_element_distance_inline(tree, number, *scaled);
}

mt_element_distance mt_element_distance_to(const mt_surface_tree *tree, mt_index number, mt_vec3 scaled)
{
    mt_element_distance distance;
    measure(tree, number, &scaled, &distance);
    return distance;
}
