/* Which way closed components look. */
#ifndef MT_ALGORITHMS_COMPONENT_VOLUME_H
#define MT_ALGORITHMS_COMPONENT_VOLUME_H

#include <meshtool/components.h>
#include <meshtool/self_intersection.h>

/* signs[component_count] receives the sign of each component's volume, of use where it is closed and, after turning the
 * faces that components->face_turned tells, oriented. It is decided exactly unless `how` is MT_ARITHMETIC_FLOATING; 0
 * for a component with a coordinate that is not finite. Faces of more than three sides count as fans about their first
 * corner that do not depend on the direction in which the face runs: the shared triangulation may, and two volumes of
 * one bent component that are both negative would have it turned for ever.
 *
 * O(corners) time; components whose volume rounding could hide take microseconds a triangle. */
mt_status mt_component_volume_signs(mt_context *context, const mt_mesh *mesh, const mt_components *components,
                                    mt_arithmetic how, int8_t *signs);

#endif
