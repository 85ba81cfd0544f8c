#include "formats/mesh/obj_block.h"

size_t mt_obj_item_size(mt_obj_series series)
{
    static const uint8_t sizes[MT_OBJ_SERIES_COUNT] = {
        [MT_OBJ_POSITIONS] = 3 * sizeof(double),
        [MT_OBJ_COLORS] = 3 * sizeof(double),
        [MT_OBJ_UVS] = 2 * sizeof(double),
        [MT_OBJ_DEPTHS] = sizeof(double),
        [MT_OBJ_NORMALS] = 3 * sizeof(double),
        [MT_OBJ_SIDES] = sizeof(mt_index),
        [MT_OBJ_CORNERS] = sizeof(mt_index),
        [MT_OBJ_CORNER_UVS] = sizeof(mt_index),
        [MT_OBJ_CORNER_NORMALS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_CORNERS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_UVS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_NORMALS] = sizeof(mt_index),
        [MT_OBJ_WIRE_SIDES] = sizeof(mt_index),
        [MT_OBJ_WIRE_VERTICES] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_WIRES] = sizeof(mt_index),
        [MT_OBJ_POINTS] = sizeof(mt_index),
        [MT_OBJ_RELATIVE_POINTS] = sizeof(mt_index),
        [MT_OBJ_EVENTS] = sizeof(mt_obj_event),
        [MT_OBJ_NAMES] = 1,
        [MT_OBJ_CREASES] = sizeof(mt_edge_value),
        [MT_OBJ_SHARP_VERTICES] = sizeof(mt_vertex_value),
        [MT_OBJ_HOLES] = sizeof(mt_obj_hole),
        [MT_OBJ_SETTINGS] = sizeof(mt_obj_setting),
    };
    return sizes[series];
}
