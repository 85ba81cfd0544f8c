/* What a file says of how it is to be subdivided (OBJ's `t` statements, as RenderMan and OpenSubdiv have them), beside
 * the sharpness of edges and vertices: attributes of generic meaning, one byte each, known by these names. */
#ifndef MESHTOOL_SUBDIVISION_TAGS_H
#define MESHTOOL_SUBDIVISION_TAGS_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Of the mesh. */
typedef enum mt_subdivision_tag {
    MT_TAG_BOUNDARY,         /* "interpolateboundary": 0 none, 1 edges and corners, 2 edges */
    MT_TAG_FACE_VARYING,     /* "facevaryinginterpolateboundary": 0 none, 1 corners only, 2 corners plus 1, 3 corners
                                plus 2, 4 boundaries, 5 all */
    MT_TAG_CREASE_METHOD,    /* "creasemethod": 0 normal, 1 chaikin */
    MT_TAG_SMOOTH_TRIANGLES, /* "smoothtriangles": 0 catmark, 1 smooth */
    MT_TAG_COUNT
} mt_subdivision_tag;

/* Of faces: 1 is a hole, which takes part and is left out of the result. */
#define MT_HOLE_NAME "hole"

/* The name, and how many values there are from 0 on. */
const char *mt_subdivision_tag_name(mt_subdivision_tag tag);
unsigned mt_subdivision_tag_limit(mt_subdivision_tag tag);
/* The word for a value, "chaikin", where the tag has words and not numbers; NULL where it has numbers. */
const char *mt_subdivision_tag_word(mt_subdivision_tag tag, unsigned value);

/* Whether an attribute is one of the above. */
bool mt_attribute_is_subdivision_tag(const mt_attribute *attribute);

/* The value of a tag; false when the mesh has none, or one that is out of range. */
bool mt_subdivision_tag_get(const mt_mesh *mesh, mt_subdivision_tag tag, unsigned *value);
/* Adds the tag, or changes it. */
mt_status mt_subdivision_tag_set(mt_context *context, mt_mesh *mesh, mt_subdivision_tag tag, unsigned value);

/* The attribute that marks holes, or NULL; mt_face_is_hole asks it (NULL: no face is one). */
mt_attribute *mt_mesh_find_holes(const mt_mesh *mesh);
/* The same, added with no hole where there is none. */
mt_status mt_mesh_add_holes(mt_context *context, mt_mesh *mesh, mt_attribute **out);

static inline bool mt_face_is_hole(const mt_attribute *holes, mt_index face)
{
    return holes && ((const uint8_t *)holes->values)[face] != 0;
}

#ifdef __cplusplus
}
#endif
#endif
