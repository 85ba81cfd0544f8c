/* The keys of one kind of object, as a table that reading, error texts and the help follow. */
#ifndef MESHTOOL_SCENE_FIELDS_H
#define MESHTOOL_SCENE_FIELDS_H

#include "formats/stream/json.h"

#include <meshtool/vector.h>

typedef enum scene_kind {
    SCENE_NUMBER,    /* double, minimum to maximum, of which the minimum may be excluded */
    SCENE_WHOLE,     /* uint32_t, minimum to maximum */
    SCENE_BOOLEAN,   /* bool */
    SCENE_TEXT,      /* const char *, not empty, as long as the JSON lives */
    SCENE_POINT,     /* mt_vec3 */
    SCENE_DIRECTION, /* mt_vec3, not zero */
    SCENE_COLOR,     /* mt_vec3, linear, minimum to maximum: a number, three numbers, or "#rrggbb" in sRGB */
    SCENE_CHOICE,    /* int, place in choices */
    SCENE_OTHER      /* read by a function of its own; mt_json_node: the value, NULL when absent */
} scene_kind;

typedef struct scene_field {
    const char *key; /* NULL: the end of the table */
    scene_kind kind;
    size_t offset; /* of the value in the object's record */
    bool is_required, excludes_minimum;
    double minimum, maximum;
    const char *const *choices; /* NULL-terminated */
    const char *expects;        /* NULL: follows from the kind */
    const char *means;
} scene_field;

/* Reads an object by its table into a record that holds the defaults. Refuses keys that are not in the table. */
mt_status scene_read_fields(mt_context *context, const mt_json_node *node, const scene_field *fields, void *record);

/* Refuses keys that are in none of the table. */
mt_status scene_check_keys(mt_context *context, const mt_json_node *node, const scene_field *fields);

/* What a field's value is, in words. */
#define SCENE_EXPECTS_ROOM 200
void scene_expects(const scene_field *field, char text[SCENE_EXPECTS_ROOM]);

/* `count` numbers, all finite. */
mt_status scene_read_numbers(mt_context *context, const mt_json_node *node, size_t count, const char *expects,
                             double *out);

#endif
