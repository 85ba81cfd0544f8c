#include "formats/scene/scene_fields.h"

#include <meshtool/image.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const plain_words[] = {
    [SCENE_BOOLEAN] = "true or false",
    [SCENE_TEXT] = "a string that is not empty",
    [SCENE_POINT] = "three numbers",
    [SCENE_DIRECTION] = "three numbers that are not all 0",
};

static void describe_range(const scene_field *field, const char *noun, char text[SCENE_EXPECTS_ROOM])
{
    const char *from = field->excludes_minimum ? "greater than" : "of at least";
    if (isinf(field->minimum)) {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s", noun);
    } else if (isinf(field->maximum)) {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s %s %.10g", noun, from, field->minimum);
    } else if (field->excludes_minimum) {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s greater than %.10g, up to %.10g", noun, field->minimum, field->maximum);
    } else {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s from %.10g to %.10g", noun, field->minimum, field->maximum);
    }
}

static void describe_choices(const scene_field *field, char text[SCENE_EXPECTS_ROOM])
{
    size_t length = 0;
    text[0] = '\0';
    for (size_t i = 0; field->choices[i] && length < SCENE_EXPECTS_ROOM; i++) {
        const char *between = i == 0 ? "" : field->choices[i + 1] ? ", " : " or ";
        int more = snprintf(text + length, SCENE_EXPECTS_ROOM - length, "%s\"%s\"", between, field->choices[i]);
        length += more > 0 ? (size_t)more : 0;
    }
}

static void describe_color(const scene_field *field, char text[SCENE_EXPECTS_ROOM])
{
    const char *limit = isinf(field->maximum) ? "not negative" : "from 0 to 1";
    snprintf(text, SCENE_EXPECTS_ROOM, "a colour: a number or three, %s, linear, or \"#rrggbb\"", limit);
}

void scene_expects(const scene_field *field, char text[SCENE_EXPECTS_ROOM])
{
    if (field->expects) {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s", field->expects);
    } else if (field->kind == SCENE_NUMBER) {
        describe_range(field, "a number", text);
    } else if (field->kind == SCENE_WHOLE) {
        describe_range(field, "a whole number", text);
    } else if (field->kind == SCENE_CHOICE) {
        describe_choices(field, text);
    } else if (field->kind == SCENE_COLOR) {
        describe_color(field, text);
    } else {
        snprintf(text, SCENE_EXPECTS_ROOM, "%s", plain_words[field->kind]);
    }
}

static mt_status fail(mt_context *context, const mt_json_node *node, const scene_field *field)
{
    char expects[SCENE_EXPECTS_ROOM];
    scene_expects(field, expects);
    return mt_json_fail_expected(context, node, expects);
}

static bool is_within(const scene_field *field, double x)
{
    bool above = field->excludes_minimum ? x > field->minimum : x >= field->minimum;
    return isfinite(x) && above && x <= field->maximum;
}

/* Whether a value is `count` finite numbers. */
static bool take_numbers(const json_t *value, size_t count, double *out)
{
    bool right = json_is_array(value) && json_array_size(value) == count;
    for (size_t i = 0; right && i < count; i++) {
        const json_t *element = json_array_get(value, i);
        out[i] = json_number_value(element);
        right = json_is_number(element) && isfinite(out[i]);
    }
    return right;
}

mt_status scene_read_numbers(mt_context *context, const mt_json_node *node, size_t count, const char *expects,
                             double *out)
{
    return take_numbers(node->value, count, out) ? MT_OK : mt_json_fail_expected(context, node, expects);
}

static int hexadecimal(char c)
{
    static const char digits[] = "0123456789abcdef";
    const char *at = c ? strchr(digits, c >= 'A' && c <= 'F' ? c + ('a' - 'A') : c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* "#rrggbb" */
static bool take_code(const char *text, double out[3])
{
    bool right = text && strlen(text) == 7 && text[0] == '#';
    for (int i = 0; right && i < 3; i++) {
        int high = hexadecimal(text[1 + 2 * i]), low = hexadecimal(text[2 + 2 * i]);
        right = high >= 0 && low >= 0;
        out[i] = mt_srgb_decode((16 * high + low) / 255.0);
    }
    return right;
}

static bool take_color(const scene_field *field, const json_t *value, mt_vec3 *out)
{
    double c[3];
    bool right = take_numbers(value, 3, c) || take_code(json_string_value(value), c);
    if (json_is_number(value)) {
        c[0] = c[1] = c[2] = json_number_value(value);
        right = true;
    }
    right = right && is_within(field, c[0]) && is_within(field, c[1]) && is_within(field, c[2]);
    if (right) {
        *out = mt_vec3_make(c[0], c[1], c[2]);
    }
    return right;
}

static bool take_vector(const scene_field *field, const json_t *value, mt_vec3 *out)
{
    double v[3];
    if (!take_numbers(value, 3, v)) {
        return false;
    }
    *out = mt_vec3_make(v[0], v[1], v[2]);
    return field->kind == SCENE_POINT || mt_vec3_max_abs(*out) > 0;
}

static bool take_choice(const scene_field *field, const json_t *value, int *out)
{
    const char *text = json_string_value(value);
    for (int i = 0; text && field->choices[i]; i++) {
        if (strcmp(text, field->choices[i]) == 0) {
            *out = i;
            return true;
        }
    }
    return false;
}

static bool take_number(const scene_field *field, const json_t *value, void *out)
{
    double x = json_number_value(value);
    if (!json_is_number(value) || !is_within(field, x)) {
        return false;
    }
    if (field->kind == SCENE_NUMBER) {
        *(double *)out = x;
        return true;
    }
    *(uint32_t *)out = (uint32_t)x;
    return (double)*(uint32_t *)out == x;
}

static bool take_text(const json_t *value, const char **out)
{
    *out = json_string_value(value);
    return *out && **out && strlen(*out) == json_string_length(value);
}

static bool take(const scene_field *field, const mt_json_node *node, void *out)
{
    const json_t *value = node->value;
    switch (field->kind) {
    case SCENE_NUMBER:
    case SCENE_WHOLE:
        return take_number(field, value, out);
    case SCENE_BOOLEAN:
        *(bool *)out = json_is_true(value);
        return json_is_boolean(value);
    case SCENE_TEXT:
        return take_text(value, (const char **)out);
    case SCENE_POINT:
    case SCENE_DIRECTION:
        return take_vector(field, value, (mt_vec3 *)out);
    case SCENE_COLOR:
        return take_color(field, value, (mt_vec3 *)out);
    case SCENE_CHOICE:
        return take_choice(field, value, (int *)out);
    default:
        *(mt_json_node *)out = *node;
        return true;
    }
}

static const scene_field *find(const scene_field *fields, const char *key)
{
    for (; fields->key; fields++) {
        if (strcmp(fields->key, key) == 0) {
            return fields;
        }
    }
    return NULL;
}

static mt_status refuse_key(mt_context *context, const mt_json_node *node, const char *key, const scene_field *fields)
{
    char known[400] = "";
    size_t length = 0;
    for (const scene_field *field = fields; field->key && length < sizeof known; field++) {
        const char *between = field == fields ? "" : (field + 1)->key ? ", " : " and ";
        int more = snprintf(known + length, sizeof known - length, "%s%s", between, field->key);
        length += more > 0 ? (size_t)more : 0;
    }
    mt_json_node unknown = mt_json_member(node, key);
    return mt_json_fail(context, &unknown, MT_ERROR_SYNTAX, "this key is unknown here; known are %s", known);
}

mt_status scene_check_keys(mt_context *context, const mt_json_node *node, const scene_field *fields)
{
    if (!json_is_object(node->value)) {
        return mt_json_fail_expected(context, node, "an object");
    }
    for (void *at = json_object_iter(node->value); at; at = json_object_iter_next(node->value, at)) {
        if (!find(fields, json_object_iter_key(at))) {
            return refuse_key(context, node, json_object_iter_key(at), fields);
        }
    }
    return MT_OK;
}

mt_status scene_read_fields(mt_context *context, const mt_json_node *node, const scene_field *fields, void *record)
{
    mt_status status = scene_check_keys(context, node, fields);
    for (const scene_field *field = fields; status == MT_OK && field->key; field++) {
        mt_json_node member = mt_json_member(node, field->key);
        if (!member.value && !field->is_required) {
            continue;
        }
        if (!member.value || !take(field, &member, (char *)record + field->offset)) {
            status = fail(context, &member, field);
        }
    }
    return status;
}
