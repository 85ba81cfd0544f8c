/* The records of the formats for meshes and strips, one at the end of each format's file. mesh_formats.c and
 * strip_formats.c list them. */
#ifndef MESHTOOL_MESH_RECORDS_H
#define MESHTOOL_MESH_RECORDS_H

#include <meshtool/mesh_format.h>
#include <meshtool/strip_format.h>

extern const mt_mesh_format mt_drc_format;
extern const mt_mesh_format mt_glb_format;
extern const mt_mesh_format mt_gltf_format;
extern const mt_mesh_format mt_obj_format;
extern const mt_mesh_format mt_off_format;
extern const mt_mesh_format mt_ply_format;
extern const mt_mesh_format mt_stl_format;

extern const mt_strip_format mt_strips_text_format;
extern const mt_strip_format mt_strips_glb_format;
extern const mt_strip_format mt_strips_gltf_format;

#endif
