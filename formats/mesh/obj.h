/* What the files of the OBJ format give to its record. */
#ifndef MESHTOOL_OBJ_H
#define MESHTOOL_OBJ_H

#include <meshtool/mesh_format.h>

mt_status mt_obj_read(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out);
mt_status mt_obj_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);

/* The attribute of a meaning that is written; one of each is. */
const mt_attribute *mt_obj_written_attribute(const mt_mesh *mesh, mt_semantic semantic);

/* The labels that are written as this kind, one of OBJ's four: where the mesh has no objects, parts or else solids
 * stand as such. */
const mt_labels *mt_obj_written_labels(const mt_mesh *mesh, mt_label_kind kind);

#endif
