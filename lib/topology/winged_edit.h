/* What the operations on winged edges share. */
#ifndef MT_TOPOLOGY_WINGED_EDIT_H
#define MT_TOPOLOGY_WINGED_EDIT_H

#include "lib/topology/surgery_view.h"
#include "lib/topology/winged_side.h"

#include <meshtool/winged_edge_surgery.h>

/* What the predicates read; it holds until the surgery grows. */
mt_surgery_view mt_winged_view(const mt_winged_surgery *surgery);

/* The side that runs from the vertex `tail` along the edge; when there is none a number that is out of range. */
mt_index mt_winged_side_from(const mt_winged_surgery *surgery, mt_index edge, mt_index tail);

/* Makes room for new elements. */
mt_status mt_winged_reserve(mt_context *context, mt_winged_surgery *surgery, mt_index vertices, mt_index edges,
                            mt_index faces);

/* New elements, in room that was made. The edge has neither faces nor wings yet; its first side, which is returned,
 * runs from tail to head. */
mt_index mt_winged_new_vertex(mt_winged_surgery *surgery);
mt_index mt_winged_new_edge(mt_winged_surgery *surgery, mt_index tail, mt_index head);
mt_index mt_winged_new_face(mt_winged_surgery *surgery);
void mt_winged_delete_edge(mt_winged_surgery *surgery, mt_index edge);

/* Links three sides to a face that begins with the first. */
void mt_winged_set_triangle(mt_winged_edge_mesh *own, mt_index face, mt_index a, mt_index b, mt_index c);

/* Gives the vertex to which the side points the edge where its ring begins, this one when it has no boundary. */
void mt_winged_anchor(mt_winged_edge_mesh *own, mt_index side);

#endif
