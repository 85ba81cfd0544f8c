/* Components that are flat sheets. */
#ifndef MT_ALGORITHMS_FLAT_COMPONENTS_H
#define MT_ALGORITHMS_FLAT_COMPONENTS_H

#include <meshtool/components.h>

/* flat[component_count] receives 1 for components all of whose vertices lie exactly in one plane, else 0. O(corners)
 * time. */
mt_status mt_find_flat_components(mt_context *context, const mt_mesh *mesh, const mt_components *components,
                                  uint8_t *flat);

#endif
