/* Mesh files: one table of formats, reading by content, writing with what is lost said. */
#ifndef MESHTOOL_MESH_FORMAT_H
#define MESHTOOL_MESH_FORMAT_H

#include <meshtool/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What a format can hold. What a mesh has beyond this is reported as lost when it is written. */
typedef enum mt_ability {
    MT_HOLDS_POLYGONS = 1u << 0, /* faces of more than 3 sides */
    MT_HOLDS_INDICES = 1u << 1,  /* shared vertices; without it isolated vertices are lost */
    MT_HOLDS_WIRES = 1u << 2,
    MT_HOLDS_POINTS = 1u << 3,
    MT_HOLDS_VERTEX_NORMALS = 1u << 4,
    MT_HOLDS_CORNER_NORMALS = 1u << 5,
    MT_HOLDS_FACE_NORMALS = 1u << 6,
    MT_HOLDS_VERTEX_UVS = 1u << 7,
    MT_HOLDS_CORNER_UVS = 1u << 8,
    MT_HOLDS_VERTEX_COLORS = 1u << 9,
    MT_HOLDS_FACE_COLORS = 1u << 10,
    MT_HOLDS_GENERIC = 1u << 11, /* attributes known by name on vertices and faces */
    MT_HOLDS_GROUPS = 1u << 12,  /* groups, objects, materials, smoothing */
    MT_HOLDS_SOLIDS = 1u << 13,
    MT_HOLDS_CREASES = 1u << 14,     /* sharpness on edges and vertices */
    MT_HOLDS_F64 = 1u << 15,         /* positions in double precision */
    MT_HOLDS_ALPHA = 1u << 16,       /* the fourth component of colours */
    MT_HOLDS_UV_DEPTH = 1u << 17,    /* the third component of UVs */
    MT_HOLDS_LIBRARIES = 1u << 18,   /* names of material libraries */
    MT_HOLDS_PARTS = 1u << 19,       /* parts and materials by name */
    MT_SPLITS_VERTICES = 1u << 20,   /* values on corners are held, by splitting vertices */
    MT_NEEDS_FINITE = 1u << 21,      /* a number that is not finite as a float is refused */
    MT_TAKES_DRACO = 1u << 22,       /* mt_draco_options mean something */
    MT_TAKES_QUANTIZATION = 1u << 23 /* so does quantize_bits */
} mt_ability;

typedef enum mt_encoding {
    MT_ENCODING_DEFAULT,
    MT_ENCODING_ASCII,
    MT_ENCODING_BINARY,
    MT_ENCODING_BINARY_BIG
} mt_encoding;

typedef enum mt_precision { MT_PRECISION_AUTO, MT_PRECISION_F32, MT_PRECISION_F64 } mt_precision;

/* All zeros means the defaults. */
typedef struct mt_mesh_read_options {
    const char *format;     /* an extension that overrides recognition by content; NULL: recognise */
    mt_precision precision; /* auto: what the file holds (text and doubles f64, floats f32) */
} mt_mesh_read_options;

/* How Draco compresses: .drc files always, glTF when `compress` is set. All zeros: edgebreaker at speed 5, positions
 * quantised to 14 bits of their extent, normals to 10, texture coordinates to 12, float colours to 10. */
typedef struct mt_draco_options {
    bool compress;          /* glTF: by KHR_draco_mesh_compression */
    bool lossless;          /* floats as they are */
    unsigned position_bits; /* 1 to 30; 0: 14 */
    bool has_speed;
    unsigned speed;  /* 0 (smallest) to 10 (fastest; sequential) */
    bool sequential; /* keeps every vertex, and the order */
} mt_draco_options;

typedef struct mt_mesh_write_options {
    const char *format;   /* an extension that overrides the path's; NULL: the path's, or "ply" for pipes */
    mt_encoding encoding; /* default: binary where the format has both */
    bool strict_loss;     /* refuse with MT_ERROR_LOSS instead of losing anything */
    bool no_clobber;      /* refuse with MT_ERROR_IO when the file exists */
    unsigned digits; /* significant digits of positions in text, up to 17; 0: the shortest that read back the same */
    mt_draco_options draco;
    /* glTF without Draco: 1 to 16, positions become whole steps of extent / (2^bits - 1) from the least corner of the
     * bounds, by KHR_mesh_quantization; the extent is the largest side, and a vertex moves by half a step on each axis
     * at most. The nodes have the step and the corner in double precision; what a reader that computes in single
     * precision gets is rounded by some 2^-24 of the coordinates besides. Positions take 4 bytes up to 8 bits, 8 beyond
     * (floats: 12); normals have 8 bits with the former and 16 with the latter, texture coordinates within 0 to 1 and
     * float colours 16. 0: floats. More, or together with draco.compress: MT_ERROR_ARGUMENT. */
    unsigned quantize_bits;
} mt_mesh_write_options;

/* What writing the mesh in a format would lose: short phrases ("corner normals", "2 wires"). */
typedef struct mt_loss {
    size_t count; /* past the room the last item says "more" */
    char items[16][64];
} mt_loss;

typedef struct mt_input mt_input;   /* bytes to read: file, standard input or memory (formats/stream) */
typedef struct mt_output mt_output; /* bytes to write, renamed into place at the end */

/* One format. Each file in formats/mesh ends in its record; formats/mesh/mesh_formats.c lists them. */
typedef struct mt_mesh_format {
    const char *name;              /* as JSON and messages call it: "obj" */
    const char *title;             /* for people: "Wavefront OBJ" */
    const char *const *extensions; /* lower case without the dot, NULL-terminated; the first is preferred */
    unsigned abilities;            /* of mt_ability */
    unsigned ascii_abilities;      /* those of them that binary encodings do not have */
    bool has_ascii, has_binary, has_binary_big;
    /* How sure the first bytes make it: 0 not this format, 100 certain. `size` bytes of a file of
     * `total` bytes (UINT64_MAX when unknown) are given. */
    int (*sniff)(const uint8_t *bytes, size_t size, uint64_t total);
    /* Whether this attribute of the mesh is held, where that is more or less than the abilities say; NULL: they say
     * it. The encoding is never the default. */
    bool (*holds_attribute)(const mt_mesh *mesh, const mt_attribute *attribute, mt_encoding encoding);
    /* The same for a set of labels. */
    bool (*holds_labels)(const mt_mesh *mesh, const mt_labels *labels);
    /* Adds what else writing would change, for formats that change more than their abilities tell; NULL: nothing. */
    mt_status (*changes)(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options, mt_loss *loss);
    /* Called with options that are never NULL. A reader may leave the precision asked for to the caller, and
     * need not count numbers that are not finite; a writer need not report loss. */
    mt_status (*read)(mt_context *context, mt_input *input, const mt_mesh_read_options *options, mt_mesh **out);
    mt_status (*write)(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                       mt_output *output);
} mt_mesh_format;

/* The table, NULL-terminated. */
const mt_mesh_format *const *mt_mesh_formats(void);

/* The format with that extension (any case), or NULL. */
const mt_mesh_format *mt_mesh_format_by_extension(const char *extension);

/* The format that a path's extension names for writing, options->format first; "-" and device or pipe
 * paths get "ply". NULL with MT_ERROR_ARGUMENT recorded, naming the known ones, when there is none. */
const mt_mesh_format *mt_mesh_format_for_output(mt_context *context, const char *path,
                                                const mt_mesh_write_options *options);

/* Reads a mesh. path "-" is standard input. *format (may be NULL) receives the format recognised. */
mt_status mt_mesh_read_file(mt_context *context, const char *path, const mt_mesh_read_options *options, mt_mesh **out,
                            const mt_mesh_format **format);

/* The same from memory; `name` stands in messages, and its extension may help recognition. */
mt_status mt_mesh_read_memory(mt_context *context, const char *name, const void *bytes, size_t size,
                              const mt_mesh_read_options *options, mt_mesh **out, const mt_mesh_format **format);

/* What writing the mesh in a format would lose. options may be NULL. O(size). */
mt_status mt_mesh_format_loss(mt_context *context, const mt_mesh *mesh, const mt_mesh_format *format,
                              const mt_mesh_write_options *options, mt_loss *out);

/* Writes a mesh beside its place and renames it there; a failed run leaves the old file and nothing new.
 * "-" is standard output; devices and pipes are written into. loss may be NULL. */
mt_status mt_mesh_write_file(mt_context *context, const mt_mesh *mesh, const char *path,
                             const mt_mesh_write_options *options, mt_loss *loss);

/* The same into memory: *bytes is the caller's, freed with mt_free. */
mt_status mt_mesh_write_memory(mt_context *context, const mt_mesh *mesh, const mt_mesh_write_options *options,
                               void **bytes, size_t *size);

#ifdef __cplusplus
}
#endif
#endif
