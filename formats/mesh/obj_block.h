/* What one block of an OBJ file holds: arrays in a store, which grow while the block is parsed. Faces are numbered
 * within the block, vertices, UVs and normals as the file does; references relative to a running count that is not
 * known yet are listed, to be settled when the blocks before are counted. */
#ifndef MESHTOOL_OBJ_BLOCK_H
#define MESHTOOL_OBJ_BLOCK_H

#include <meshtool/subdivision_tags.h>

/* What a reference refers to. */
typedef enum mt_obj_element { MT_OBJ_VERTEX, MT_OBJ_UV, MT_OBJ_NORMAL, MT_OBJ_ELEMENT_COUNT } mt_obj_element;

/* The arrays. Those with "later" are empty until an element needs them, and then filled for the earlier ones. */
typedef enum mt_obj_series {
    MT_OBJ_POSITIONS, /* 3 doubles a vertex */
    MT_OBJ_COLORS,    /* later: 3 doubles a vertex */
    MT_OBJ_UVS,       /* 2 doubles */
    MT_OBJ_DEPTHS,    /* later: the third number of a UV */
    MT_OBJ_NORMALS,   /* 3 doubles */
    MT_OBJ_SIDES,     /* later: per face its sides, when they are not all face_size */
    MT_OBJ_CORNERS,   /* per corner its vertex, UV (later), normal (later) */
    MT_OBJ_CORNER_UVS,
    MT_OBJ_CORNER_NORMALS,
    MT_OBJ_RELATIVE_CORNERS, /* numbers of corners whose vertex, UV, normal is relative */
    MT_OBJ_RELATIVE_UVS,
    MT_OBJ_RELATIVE_NORMALS,
    MT_OBJ_WIRE_SIDES, /* vertices of each wire */
    MT_OBJ_WIRE_VERTICES,
    MT_OBJ_RELATIVE_WIRES,
    MT_OBJ_POINTS,
    MT_OBJ_RELATIVE_POINTS,
    MT_OBJ_EVENTS,         /* mt_obj_event */
    MT_OBJ_NAMES,          /* characters of the events' names */
    MT_OBJ_CREASES,        /* mt_edge_value */
    MT_OBJ_SHARP_VERTICES, /* mt_vertex_value */
    MT_OBJ_HOLES,          /* mt_obj_hole */
    MT_OBJ_SETTINGS,       /* mt_obj_setting */
    MT_OBJ_SERIES_COUNT
} mt_obj_series;

#define MT_OBJ_UNKNOWN_ROOM 16 /* unknown keywords and tags that are told apart; later ones go unnamed */

/* What happens between faces. The kinds of labels come first, by their number. */
typedef enum mt_obj_event_kind {
    MT_OBJ_LABEL = 0, /* + mt_label_kind: faces from here on have the name; an empty one: none */
    MT_OBJ_LIBRARY = 100,
    MT_OBJ_UNKNOWN_KEYWORD,
    MT_OBJ_UNKNOWN_TAG
} mt_obj_event_kind;

typedef struct mt_obj_event {
    int kind;
    mt_index face;   /* of the block: the first that comes after */
    uint64_t name;   /* in MT_OBJ_NAMES, with a zero byte at its end */
    uint64_t offset; /* in the file */
} mt_obj_event;

typedef struct mt_obj_hole {
    uint64_t face;   /* from 0; may be past the last */
    uint64_t offset; /* in the file */
} mt_obj_hole;

typedef struct mt_obj_setting {
    mt_subdivision_tag tag;
    uint8_t value;
} mt_obj_setting;

typedef struct mt_obj_block {
    struct mt_obj_store *store; /* that the items lie in */
    void *items[MT_OBJ_SERIES_COUNT];
    size_t counts[MT_OBJ_SERIES_COUNT], capacities[MT_OBJ_SERIES_COUNT];
    mt_index face_count;
    mt_index face_size;       /* sides of every face while MT_OBJ_SIDES is empty; 0 before the first face */
    uint64_t statement_count; /* of known keywords */
    uint64_t uncolored_count;
    uint64_t weight_count;  /* vertices with a w that is not 1 */
    uint64_t wire_uv_count; /* texture vertices of wires */
    size_t unknown_count;
    size_t unknown_events[MT_OBJ_UNKNOWN_ROOM];
} mt_obj_block;

/* Bytes of one item. */
size_t mt_obj_item_size(mt_obj_series series);

#endif
