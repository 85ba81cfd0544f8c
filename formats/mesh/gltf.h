/* What the files of the glTF 2.0 reader share (Khronos, glTF 2.0 Specification). One file is opened, its buffers are
 * loaded as they are needed, its scene is walked, its meshes become shapes, and the shapes one mesh. */
#ifndef MESHTOOL_MESH_GLTF_H
#define MESHTOOL_MESH_GLTF_H

#include "formats/stream/input.h"
#include "formats/stream/json.h"

#include <meshtool/mesh_format.h>
#include <meshtool/transform.h>

typedef struct mt_gltf_span {
    const uint8_t *bytes; /* NULL: not loaded */
    uint64_t size;
} mt_gltf_span;

/* The arrays of the root that the reader looks into. */
typedef enum mt_gltf_list {
    MT_GLTF_BUFFERS,
    MT_GLTF_VIEWS,
    MT_GLTF_ACCESSORS,
    MT_GLTF_MESHES,
    MT_GLTF_MATERIALS,
    MT_GLTF_NODES,
    MT_GLTF_SCENES,
    MT_GLTF_LIST_COUNT
} mt_gltf_list;

#define MT_GLTF_DROPPED 16 /* names that are said; further ones go unsaid */

typedef struct mt_gltf_file {
    mt_context *context;
    mt_input *input;
    mt_json json;
    mt_json_node root;
    mt_json_node lists[MT_GLTF_LIST_COUNT];
    size_t counts[MT_GLTF_LIST_COUNT];
    uint64_t bytes_read;   /* of this file and those beside it: what everything else is measured against */
    uint8_t *content;      /* the whole file */
    mt_gltf_span binary;   /* the BIN chunk of a GLB */
    mt_gltf_span *buffers; /* per buffer, loaded at the first use */
    mt_gltf_span *views;   /* per view, only of those that were decompressed */
    void **blocks;         /* memory that lives as long as the file */
    size_t block_count, block_capacity;
    uint64_t decoded;                     /* indices of primitives so far */
    const char *dropped[MT_GLTF_DROPPED]; /* names of attributes that are not kept, once each */
    size_t dropped_count;
    uint64_t unplaced;           /* primitives without positions */
    bool has_targets, has_skins; /* met on the way */
    bool has_both;               /* a node with a matrix and a part of one */
} mt_gltf_file;

/* Reads the whole input, parses it, and checks version and extensions. Close it in any case. */
mt_status mt_gltf_open(mt_context *context, mt_input *input, mt_gltf_file *out);
void mt_gltf_close(mt_gltf_file *file);

/* Uninitialised memory that lives as long as the file; NULL with the error recorded. */
void *mt_gltf_allocate(mt_gltf_file *file, uint64_t count, size_t size);

/* Whether so many vertices and indices can come of the bytes read; MT_ERROR_TOO_LARGE when not. */
mt_status mt_gltf_justify(mt_gltf_file *file, uint64_t elements);

/* The element of a list with the number that the member `key` of `parent` gives. An optional one that is missing gives
 * a node without a value. *index may be NULL. */
mt_status mt_gltf_refer(mt_gltf_file *file, const mt_json_node *parent, const char *key, mt_json_need need,
                        mt_gltf_list list, mt_json_node *out, size_t *index);

/* The bytes of a buffer, at least byteLength of them: the BIN chunk, a data URI, or a file beside. */
mt_status mt_gltf_buffer(mt_gltf_file *file, size_t index, mt_gltf_span *out);
/* Bytes that a view spans, decompressed where it is compressed by meshopt; *stride receives its byteStride, 0: none. */
mt_status mt_gltf_view(mt_gltf_file *file, size_t index, mt_gltf_span *out, uint64_t *stride);

/* The extension object of that name on a node; false: there is none. */
bool mt_gltf_extension(const mt_json_node *node, const char *name, mt_json_node *extensions, mt_json_node *out);

/* Decodes base64 (RFC 4648, padding may be missing) of `size` characters. *out has room for size / 4 * 3 + 3 bytes;
 * returns the number of bytes, SIZE_MAX when it is wrong. */
size_t mt_base64_decode(const char *text, size_t size, uint8_t *out);
/* Encodes `size` bytes into 4 characters for each 3 begun, padded; returns the number of characters. */
size_t mt_base64_encode(const uint8_t *bytes, size_t size, char *out);
/* Makes a URI a relative path: percent-decoded, without a scheme, not absolute, without "..". NULL when it is right,
 * else what is wrong. `path` has room for the URI and its end. */
const char *mt_gltf_uri_path(const char *uri, char *path);

/* Values of an accessor, wherever they lie. */
typedef struct mt_gltf_values {
    const uint8_t *bytes;
    uint64_t stride;
    uint64_t count;
    mt_type type;
    unsigned component_count;
    bool normalized;
} mt_gltf_values;
/* Resolves an accessor: its bounds are checked, sparse values are put in place. */
mt_status mt_gltf_accessor(mt_gltf_file *file, const mt_json_node *accessor, mt_gltf_values *out);
/* One component as stored, or as a share of its type's maximum when it is normalised (section 3.11). */
double mt_gltf_get(const mt_gltf_values *values, uint64_t element, unsigned component);
/* One value of an index accessor (U8, U16, U32). */
uint32_t mt_gltf_get_index(const mt_gltf_values *values, uint64_t element);

/* A node of the scene that shows a mesh, in the order of a walk from the roots. */
typedef struct mt_gltf_instance {
    size_t node, mesh;
    mt_transform transform;
} mt_gltf_instance;
/* Walks the scene; *out lives as long as the file. */
mt_status mt_gltf_walk(mt_gltf_file *file, mt_gltf_instance **out, size_t *count);
/* A node's own transform from its matrix, or its translation, rotation and scale. */
mt_status mt_gltf_node_transform(mt_gltf_file *file, const mt_json_node *node, mt_transform *out);

#define MT_GLTF_SETS 8 /* of texture coordinates, and of colours; further ones are dropped, and said */

/* What a set of vertices may carry besides positions. */
typedef enum mt_gltf_slot {
    MT_GLTF_NORMAL,
    MT_GLTF_UV,
    MT_GLTF_COLOR = MT_GLTF_UV + MT_GLTF_SETS,
    MT_GLTF_SLOT_COUNT = MT_GLTF_COLOR + MT_GLTF_SETS
} mt_gltf_slot;

/* Vertices that primitives of one mesh share because they name the same accessors. */
typedef struct mt_gltf_vertices {
    json_t *attributes; /* of the first primitive that names them */
    mt_gltf_values positions;
    mt_gltf_values slots[MT_GLTF_SLOT_COUNT]; /* count 0: not there */
    uint64_t begin;                           /* the first vertex in the shape */
} mt_gltf_vertices;

/* One primitive, its strips, fans and loops taken apart. Vertices are counted from the shape's first. */
typedef struct mt_gltf_elements {
    mt_index material;     /* MT_NONE: none */
    unsigned corner_count; /* 3: triangles, 2: lines, 1: points; 0: polylines, of which there is one */
    uint64_t count;        /* of vertices in `vertices` */
    mt_index *vertices;
} mt_gltf_elements;

/* One mesh of the file, decoded once however often it is shown. */
typedef struct mt_gltf_shape {
    mt_gltf_vertices *sets;
    size_t set_count;
    mt_gltf_elements *elements; /* one for each primitive */
    size_t element_count;
    uint64_t vertex_count, triangle_count, wire_count, wire_vertex_count, point_count;
} mt_gltf_shape;
mt_status mt_gltf_shape_read(mt_gltf_file *file, size_t mesh, mt_gltf_shape *out);

/* The values of a slot in a set; MT_GLTF_SLOT_COUNT: the positions. */
mt_gltf_values *mt_gltf_slot_values(mt_gltf_vertices *set, unsigned slot);
/* Whether the values fit the slot; `place` is the attribute. */
mt_status mt_gltf_check_attribute(mt_gltf_file *file, const mt_json_node *place, unsigned slot,
                                  const mt_gltf_values *values);
/* Remembers an attribute that is not kept. */
void mt_gltf_drop(mt_gltf_file *file, const char *name);

/* What an attribute's name means: a slot, MT_GLTF_SLOT_COUNT for POSITION, or MT_GLTF_SLOT_COUNT + 1 for those that are
 * dropped. */
unsigned mt_gltf_slot_of(const char *name);

/* Decodes a primitive compressed by KHR_draco_mesh_compression: values into the set, and the triangles. */
mt_status mt_gltf_draco(mt_gltf_file *file, const mt_json_node *primitive, const mt_json_node *extension,
                        mt_gltf_vertices *set, mt_gltf_elements *elements);

/* Takes triangles, lines and points out of a primitive's indices (count 0: its vertices in order). mode is glTF's; set
 * begins at vertex `begin` of the shape. */
mt_status mt_gltf_take_apart(mt_gltf_file *file, const mt_json_node *primitive, unsigned mode,
                             const mt_gltf_values *indices, const mt_gltf_vertices *set, mt_gltf_elements *out);

/* The shapes at their instances, as one mesh. shapes[i] is that of instances[i]. */
mt_status mt_gltf_build(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                        size_t count, mt_mesh **out);
/* Fills the attributes of a mesh whose positions are there. */
mt_status mt_gltf_build_attributes(mt_gltf_file *file, const mt_gltf_instance *instances, mt_gltf_shape *const *shapes,
                                   size_t count, mt_mesh *mesh);

/* The reader of both records, and their writers. */
mt_status mt_gltf_read(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out);

#endif
