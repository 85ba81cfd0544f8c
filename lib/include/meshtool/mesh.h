/* The hub: an indexed face set with attributes, the only type that is read, written and passed
 * between operations. It holds what a file holds, broken meshes too: polygons, non-manifold
 * edges, duplicate faces, isolated vertices, faces that name a vertex twice.
 *
 * The fields may be read freely. Invariants (mt_mesh_validate): offsets ascend from 0 to
 * corner_count; every face has at least 3 corners; every index is below its count. */
#ifndef MESHTOOL_MESH_H
#define MESHTOOL_MESH_H

#include <meshtool/attribute.h>
#include <meshtool/context.h>
#include <meshtool/vector.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Names that group faces. A mesh has at most one set of each kind. */
typedef enum mt_label_kind {
    MT_LABEL_GROUP,     /* OBJ g */
    MT_LABEL_OBJECT,    /* OBJ o */
    MT_LABEL_MATERIAL,  /* OBJ usemtl */
    MT_LABEL_SMOOTHING, /* OBJ s */
    MT_LABEL_SOLID,     /* ASCII STL solid */
    MT_LABEL_PART       /* scene node */
} mt_label_kind;

typedef struct mt_labels {
    mt_label_kind kind;
    mt_index name_count;
    char **names;          /* may be empty strings, never NULL */
    mt_index *face_labels; /* per face a name's number, MT_NONE: none */
} mt_labels;

/* A value on an edge, named by its vertices; kept even where no face has that edge. */
typedef struct mt_edge_value {
    mt_index a, b;
    double value;
} mt_edge_value;

typedef struct mt_vertex_value {
    mt_index vertex;
    double value;
} mt_vertex_value;

/* Which axis the file's format takes as up; a preview stands the mesh on it. */
typedef enum mt_up_axis { MT_UP_Y, MT_UP_Z } mt_up_axis;

typedef struct mt_mesh {
    mt_index vertex_count;
    mt_type position_type; /* MT_F32 or MT_F64 */
    void *positions;       /* 3 * vertex_count, x y z */

    mt_index face_count;
    mt_index corner_count;
    mt_index face_size;        /* sides of every face when face_offsets is NULL, else 0 */
    mt_index *face_offsets;    /* face_count + 1 first corners; NULL when all faces have face_size sides */
    mt_index *corner_vertices; /* corner_count */

    mt_index wire_count;    /* polylines */
    mt_index *wire_offsets; /* wire_count + 1, NULL when there are none */
    mt_index *wire_vertices;
    mt_index point_count; /* point elements, apart from isolated vertices */
    mt_index *point_vertices;

    mt_index attribute_count;
    mt_attribute *attributes;
    mt_index label_set_count;
    mt_labels *label_sets;

    mt_index crease_count; /* sharpness on edges, as Catmull-Clark reads it: 0 smooth, 10 and more infinite */
    mt_edge_value *creases;
    mt_index sharp_vertex_count; /* sharpness on vertices */
    mt_vertex_value *sharp_vertices;

    mt_index material_library_count; /* names that an OBJ gave with mtllib; nothing is opened */
    char **material_libraries;

    mt_up_axis up;
    bool welded; /* the format has no indices (STL): corners were joined where bit-equal */
} mt_mesh;

/* What to make room for. All zeros is an empty mesh of doubles... position_type 0 is not valid. */
typedef struct mt_mesh_layout {
    uint64_t vertex_count;
    uint64_t face_count;
    uint64_t corner_count; /* ignored when face_size is not 0 */
    mt_index face_size;    /* not 0: every face has so many sides and face_offsets is NULL */
    mt_type position_type; /* MT_F32 or MT_F64 */
} mt_mesh_layout;

/* Makes a mesh with uninitialised positions, offsets (the first is 0) and corners, without attributes.
 * MT_ERROR_TOO_LARGE when a count does not fit, MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_mesh_create(mt_context *context, const mt_mesh_layout *layout, mt_mesh **out);

/* Frees a mesh and all it owns. NULL is allowed. */
void mt_mesh_destroy(mt_context *context, mt_mesh *mesh);

/* A deep copy. */
mt_status mt_mesh_copy(mt_context *context, const mt_mesh *mesh, mt_mesh **out);

/* Checks every invariant; MT_ERROR_INTERNAL with the first violation named. O(size). */
mt_status mt_mesh_validate(mt_context *context, const mt_mesh *mesh);

/* Drops face_offsets when all faces have the same number of sides. Values do not change. */
void mt_mesh_compact_faces(mt_context *context, mt_mesh *mesh);

/* Gives the mesh face_offsets if it has none, so that faces of other sizes can be held. */
mt_status mt_mesh_expand_faces(mt_context *context, mt_mesh *mesh);

/* Changes the stored precision; to f32 rounds to nearest (past the range: infinite, counted in *overflowed,
 * which may be NULL). */
mt_status mt_mesh_set_position_type(mt_context *context, mt_mesh *mesh, mt_type type, mt_index *overflowed);

/* Adds an attribute with uninitialised values. For an unindexed one value_count must be the domain's
 * count. indexed: also an uninitialised index array. *out points into the mesh and is valid until the
 * next one is added. */
typedef struct mt_attribute_layout {
    const char *name; /* NULL: "" */
    mt_semantic semantic;
    mt_domain domain;
    mt_type type;
    uint32_t component_count;
    uint64_t value_count;
    bool indexed;
} mt_attribute_layout;
mt_status mt_mesh_add_attribute(mt_context *context, mt_mesh *mesh, const mt_attribute_layout *layout,
                                mt_attribute **out);

/* Removes attribute number `which`; later ones move down. */
void mt_mesh_remove_attribute(mt_context *context, mt_mesh *mesh, mt_index which);

/* The first attribute of that meaning on that domain, or NULL. */
mt_attribute *mt_mesh_find_attribute(const mt_mesh *mesh, mt_semantic semantic, mt_domain domain);

/* Elements of a domain: 1, vertex_count, corner_count or face_count. */
mt_index mt_mesh_domain_count(const mt_mesh *mesh, mt_domain domain);

/* Adds a label set; face_labels is filled with MT_NONE, names (copied) may be added later with
 * mt_labels_add_name. *out points into the mesh, valid until the next one is added. */
mt_status mt_mesh_add_labels(mt_context *context, mt_mesh *mesh, mt_label_kind kind, mt_labels **out);
mt_labels *mt_mesh_find_labels(const mt_mesh *mesh, mt_label_kind kind);
/* Appends a name (no search for an equal one) and stores its number. */
mt_status mt_labels_add_name(mt_context *context, mt_labels *labels, const char *name, mt_index *out);

/* The kind's word: "group", "object", "material", "smoothing", "solid", "part". */
const char *mt_label_kind_name(mt_label_kind kind);

/* First corner of a face, and one past its last. */
static inline mt_index mt_mesh_face_begin(const mt_mesh *mesh, mt_index face)
{
    return mesh->face_offsets ? mesh->face_offsets[face] : face * mesh->face_size;
}

static inline mt_index mt_mesh_face_end(const mt_mesh *mesh, mt_index face)
{
    return mesh->face_offsets ? mesh->face_offsets[face + 1] : (face + 1) * mesh->face_size;
}

static inline mt_index mt_mesh_face_sides(const mt_mesh *mesh, mt_index face)
{
    return mt_mesh_face_end(mesh, face) - mt_mesh_face_begin(mesh, face);
}

/* The face of a corner: O(1) when all faces have the same size, O(log faces) otherwise. */
mt_index mt_mesh_corner_face(const mt_mesh *mesh, mt_index corner);

/* A vertex's position, widened to doubles. */
static inline mt_vec3 mt_mesh_position(const mt_mesh *mesh, mt_index vertex)
{
    size_t at = 3 * (size_t)vertex;
    if (mesh->position_type == MT_F64) {
        const double *p = (const double *)mesh->positions + at;
        return mt_vec3_make(p[0], p[1], p[2]);
    }
    const float *p = (const float *)mesh->positions + at;
    return mt_vec3_make((double)p[0], (double)p[1], (double)p[2]);
}

/* Stores a position, rounded to the mesh's precision. */
static inline void mt_mesh_set_position(mt_mesh *mesh, mt_index vertex, mt_vec3 p)
{
    size_t at = 3 * (size_t)vertex;
    if (mesh->position_type == MT_F64) {
        double *q = (double *)mesh->positions + at;
        q[0] = p.x, q[1] = p.y, q[2] = p.z;
    } else {
        float *q = (float *)mesh->positions + at;
        q[0] = (float)p.x, q[1] = (float)p.y, q[2] = (float)p.z;
    }
}

/* Axis-aligned bounds of the vertices with finite coordinates. minimum > maximum when there is none. */
typedef struct mt_bounds {
    mt_vec3 minimum, maximum;
    mt_index finite_count;     /* vertices that took part */
    mt_index non_finite_count; /* vertices with a NaN or infinite coordinate */
} mt_bounds;
mt_bounds mt_mesh_bounds(const mt_mesh *mesh);

#ifdef __cplusplus
}
#endif
#endif
