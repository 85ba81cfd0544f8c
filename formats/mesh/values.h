/* Positions and values of attributes as text, each with a space before it. */
#ifndef MESHTOOL_MESH_VALUES_H
#define MESHTOOL_MESH_VALUES_H

#include "formats/stream/lines.h"

#include <meshtool/mesh.h>

/* Three numbers of so many significant digits; 0: shortest for the stored precision. Room: 3 * (MT_NUMBER_ROOM + 1). */
char *mt_put_position(char *at, const mt_mesh *mesh, mt_index vertex, unsigned digits);

/* One component as stored, without a space before it. Room: MT_NUMBER_ROOM. */
char *mt_put_component(char *at, const mt_attribute *attribute, mt_index value, uint32_t component);

/* `count` (3 or 4) components of the colour of an element: a grey is spread to all three, alpha is 1 where there is
 * none, and an element without a colour is white. as_fraction: integers are divided by their maximum; else they are
 * put as they are. Room: 4 * (MT_NUMBER_ROOM + 1). */
char *mt_put_color(char *at, const mt_attribute *attribute, mt_index element, uint32_t count, bool as_fraction);

#endif
