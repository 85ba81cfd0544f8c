/* What the files of the glTF writer share. A mesh becomes a plan: its vertices, split where the values of their corners
 * differ; its faces, gathered by part and material; and from these chunks, each with vertices of its own. */
#ifndef MESHTOOL_MESH_GLTF_WRITE_H
#define MESHTOOL_MESH_GLTF_WRITE_H

#include "formats/codec/draco_job.h"
#include "formats/stream/output.h"

#include <meshtool/mesh_format.h>
#include <meshtool/triangulate.h>

#define MT_GLTF_COLUMNS 17 /* one for normals, 8 sets of texture coordinates, 8 of colours */

/* glTF's number for triangles, lines, ... */
typedef enum mt_gltf_mode {
    MT_GLTF_POINTS = 0,
    MT_GLTF_LINES = 1,
    MT_GLTF_LINE_STRIP = 3,
    MT_GLTF_TRIANGLES = 4,
    MT_GLTF_TRIANGLE_STRIP = 5,
    MT_GLTF_TRIANGLE_FAN = 6
} mt_gltf_mode;

/* An attribute as it is written: tightly packed but for the padding of small values to 4 bytes. */
typedef struct mt_gltf_column {
    const mt_attribute *attribute;
    unsigned set;
    mt_type type; /* MT_F32; integers are normalised: U8 or U16, normals I8 or I16 */
    unsigned component_count;
    unsigned stride;
    bool is_quantised; /* it would be floats */
} mt_gltf_column;

/* Bytes from one value to the next. */
unsigned mt_gltf_stride(unsigned component_count, mt_type type);
/* The attributes that are written, in their order: normals, texture coordinates, colours. */
size_t mt_gltf_list_columns(const mt_mesh *mesh, mt_gltf_column columns[MT_GLTF_COLUMNS]);
/* Whether the attribute is among them. */
bool mt_gltf_holds_attribute(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding);
/* The labels by which faces become parts: parts, else objects, else solids, else groups; NULL: none. */
const mt_labels *mt_gltf_part_labels(const mt_mesh *mesh);

/* Vertices after splitting: those of the mesh keep their numbers, those split off come behind them. */
typedef struct mt_gltf_split {
    mt_index vertex_count;
    mt_index *sources; /* of those behind: vertex_count - mesh->vertex_count vertices of the mesh */
    mt_index *corners; /* per vertex one of its corners, MT_NONE: it has none; NULL: no attribute lies on corners */
    mt_index *corner_vertices; /* per corner its vertex; NULL: as in the mesh */
} mt_gltf_split;
/* Corners of one vertex with the same values, to the bit as they are written, stay one vertex. Linear time. */
mt_status mt_gltf_split_make(mt_context *context, const mt_mesh *mesh, const mt_gltf_column *columns, size_t count,
                             mt_gltf_split *out);
void mt_gltf_split_release(mt_context *context, mt_gltf_split *split);

/* What is drawn: a mode and a run of the plan's indices, which count from the chunk's first vertex. */
typedef struct mt_gltf_primitive {
    mt_gltf_mode mode;
    mt_index material;     /* MT_NONE: none */
    uint64_t begin, count; /* count 0: every vertex of the chunk, in order */
} mt_gltf_primitive;

typedef struct mt_gltf_chunk {
    mt_index part; /* a name of the part labels, MT_NONE: none; chunks of one part follow each other */
    size_t primitive_begin, primitive_count;
    mt_index vertex_count;
    const mt_index *vertices; /* of the split; NULL: all of them, in order */
    mt_draco_bytes packed;    /* bytes NULL: not compressed; else there is one primitive, of triangles */
} mt_gltf_chunk;

/* Where quantised positions stand: whole steps from the origin. One grid for the whole mesh, so that its parts still
 * meet. */
typedef struct mt_gltf_grid {
    unsigned bits; /* 1 to 16, of 8 in bytes; 0: positions are floats */
    mt_vec3 origin;
    double step;
} mt_gltf_grid;

typedef struct mt_gltf_plan {
    mt_context *context;
    const mt_mesh *mesh;
    const mt_labels *parts, *materials; /* NULL: none */
    mt_gltf_column columns[MT_GLTF_COLUMNS];
    size_t column_count;
    mt_gltf_grid grid;
    mt_gltf_split split;
    mt_triangulation triangulation;
    mt_gltf_chunk *chunks;
    size_t chunk_count, chunk_capacity;
    mt_gltf_primitive *primitives;
    size_t primitive_count, primitive_capacity;
    mt_index *own_indices; /* NULL: indices are the mesh's corners */
    const mt_index *indices;
    uint64_t index_count;
    mt_index *own_vertices;
    bool reordered; /* faces are in another order than the mesh's */
} mt_gltf_plan;

/* With the options (NULL: none) columns are quantised, or each material gets a chunk of its own, and what is no
 * triangle another, as compression needs it. */
mt_status mt_gltf_plan_make(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                            mt_gltf_plan *out);
void mt_gltf_plan_release(mt_gltf_plan *plan);
mt_gltf_chunk *mt_gltf_add_chunk(mt_gltf_plan *plan);
mt_gltf_primitive *mt_gltf_add_primitive(mt_gltf_plan *plan);

/* The mesh's vertex that a vertex of the chunk is. */
mt_index mt_gltf_source_of(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex);
/* Vertex `vertex` of a chunk as it is written: its position (mt_gltf_position_stride bytes; 3 floats when the plan has
 * no grid), or a value of a column (column->stride bytes). */
void mt_gltf_put_position(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex, void *to);
/* The numbers of the position as it is stored, widened. */
void mt_gltf_get_position(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, mt_index vertex, double out[3]);
void mt_gltf_put_value(const mt_gltf_plan *plan, const mt_gltf_column *column, const mt_gltf_chunk *chunk,
                       mt_index vertex, void *to);
/* A value of a column as it is written; MT_NONE: what stands where there is none. */
void mt_gltf_make_value(const mt_gltf_column *column, mt_index value, void *to);

/* Sets the grid and the columns' types when the options quantise. Error: bits that do not fit, a number that is not
 * finite, an extent that single precision does not hold. */
mt_status mt_gltf_quantise(mt_gltf_plan *plan, const mt_mesh_write_options *options);
/* MT_F32, MT_U8 or MT_U16, not normalised; and the bytes from one position to the next. */
mt_type mt_gltf_position_type(const mt_gltf_plan *plan);
unsigned mt_gltf_position_stride(const mt_gltf_plan *plan);
/* The nearest point of the grid, in steps from its origin. */
void mt_gltf_grid_steps(const mt_gltf_grid *grid, mt_vec3 position, unsigned steps[3]);
/* Says what the plan quantises. */
void mt_gltf_add_quantised(const mt_gltf_plan *plan, mt_loss *loss);

/* Compresses the chunks that hold triangles. */
mt_status mt_gltf_pack(mt_gltf_plan *plan, const mt_draco_options *options, bool strict_loss);

/* Says what writing changes besides what the abilities tell. */
mt_status mt_gltf_changes(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                          mt_loss *loss);

/* The description of a plan, as JSON. When it embeds the data, their base64 stands between head and tail. */
typedef struct mt_gltf_text {
    void *head; /* freed with mt_free */
    size_t head_size;
    const char *tail;
    uint64_t data_size; /* bytes of the buffer */
} mt_gltf_text;
mt_status mt_gltf_describe(const mt_gltf_plan *plan, bool embeds, mt_gltf_text *out);

/* Bytes that the data of a chunk take, each view padded to 4 bytes. */
uint64_t mt_gltf_view_size(uint64_t count, unsigned stride);
/* 2 or 4: bytes of an index of the chunk. */
unsigned mt_gltf_index_size(const mt_gltf_chunk *chunk);
/* Indices of all its primitives. */
uint64_t mt_gltf_chunk_indices(const mt_gltf_plan *plan, const mt_gltf_chunk *chunk, uint64_t *begin);

/* glTF holds finite numbers alone: MT_ERROR_UNSUPPORTED with the first that is not. */
mt_status mt_gltf_check_finite(mt_context *context, const mt_mesh *mesh);
/* Writes a plan, as GLB or as text with its data inside. */
mt_status mt_gltf_write_plan(const mt_gltf_plan *plan, mt_output *output, bool binary);

mt_status mt_glb_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);
mt_status mt_gltf_write(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                        mt_output *output);

#endif
