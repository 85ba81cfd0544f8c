/* What binary and ASCII STL have in common: facets of three corners and a normal, whose corners are welded. */
#ifndef MESHTOOL_STL_FACETS_H
#define MESHTOOL_STL_FACETS_H

#include "formats/stream/input.h"
#include "formats/stream/output.h"

#define STL_HEADER_SIZE 80u
#define STL_PREFIX_SIZE 84u /* the header and the count of facets */
#define STL_FACET_SIZE 50u

/* Name of the face attribute that keeps the two attribute bytes of binary facets. */
#define STL_ATTRIBUTE "attribute"

/* A facet's normal says again what the order of its corners says; readers keep normals only where one says
 * otherwise: where it leaves the normal of the corners by more than 8 degrees. Facets whose height is less than a
 * thousandth of their longest edge are not asked: rounding to single precision turns them. A smaller angle would keep
 * the normals of ordinary files, a larger one lose smooth normals that an exporter put there on purpose. */
#define STL_NORMAL_COSINE 0.99
#define STL_THIN_FACET 1e-3

/* Whether the normal contradicts the corners. One that is zero or not finite was left out, and contradicts nothing. */
bool mt_stl_normal_contradicts(const double normal[3], const double corners[9]);

/* A mesh of so many facets whose corners are all apart; positions are to be filled. */
mt_status mt_stl_create(mt_context *context, uint64_t facet_count, mt_type position_type, mt_mesh **out);

/* Joins the corners that are at the same place. */
mt_status mt_stl_weld(mt_context *context, mt_mesh *mesh);

/* The attribute for the normals of the facets. */
mt_status mt_stl_add_normals(mt_context *context, const mt_input *input, mt_mesh *mesh, uint64_t contradicting,
                             mt_attribute **out);

/* The attributes of a mesh that STL has a place for: normals of the faces, and what binary facets hold in their two
 * bytes; NULL: none. */
const mt_attribute *mt_stl_normals(const mt_mesh *mesh);
const mt_attribute *mt_stl_attributes(const mt_mesh *mesh);

/* Whether the first bytes of a file of `total` bytes (UINT64_MAX when unknown) are binary STL and not ASCII. */
bool mt_stl_is_binary(const uint8_t *bytes, size_t size, uint64_t total);

mt_status mt_stl_read_binary(mt_context *context, mt_input *input, mt_mesh **out);
mt_status mt_stl_read_ascii(mt_context *context, mt_input *input, mt_mesh **out);
mt_status mt_stl_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);

#endif
