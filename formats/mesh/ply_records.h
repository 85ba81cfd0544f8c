/* Binary PLY elements whose records differ in size, read one after the other. */
#ifndef MESHTOOL_PLY_RECORDS_H
#define MESHTOOL_PLY_RECORDS_H

#include "formats/mesh/ply_plan.h"

/* Reads (or skips, when nothing of it is used) all records of an element from *offset on, and moves *offset past them.
 */
mt_status mt_ply_read_records(mt_context *context, const mt_input *input, ply_plan *plan, uint32_t element, bool swap,
                              uint64_t *offset);

#endif
