/* Looking into parsed JSON: paths for messages, and getters. */
#include "formats/stream/json.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

mt_json_node mt_json_root(const char *name, const mt_json *json)
{
    return (mt_json_node){.key = name, .value = json->root};
}

mt_json_node mt_json_root_of_text(const char *name, const mt_json *json, const void *bytes, size_t size)
{
    return (mt_json_node){.key = name, .value = json->root, .text = (const char *)bytes, .size = size};
}

mt_json_node mt_json_member(const mt_json_node *parent, const char *key)
{
    return (mt_json_node){.parent = parent, .key = key, .value = json_object_get(parent->value, key)};
}

mt_json_node mt_json_element(const mt_json_node *parent, size_t index)
{
    return (mt_json_node){.parent = parent, .index = index, .value = json_array_get(parent->value, index)};
}

static const mt_json_node *root_of(const mt_json_node *node)
{
    while (node->parent) {
        node = node->parent;
    }
    return node;
}

/* A key as it may stand in a message: printable, not long, and cut between characters. */
static void print_key(const char *key, char *text, size_t room)
{
    size_t length = strlen(key);
    if (length >= room) {
        length = room - 1;
        while (length > 0 && ((unsigned char)key[length] & 0xC0) == 0x80) {
            length--;
        }
    }
    memcpy(text, key, length);
    text[length] = '\0';
    for (char *c = text; *c; c++) {
        *c = (unsigned char)*c >= ' ' && *c != 0x7F ? *c : '?';
    }
}

void mt_json_path(const mt_json_node *node, char text[MT_JSON_PATH])
{
    size_t begin = MT_JSON_PATH - 1;
    text[begin] = '\0';
    for (; node->parent; node = node->parent) {
        char step[80], key[64];
        if (node->key) {
            print_key(node->key, key, sizeof key);
            snprintf(step, sizeof step, "%s%s", node->parent->parent ? "." : "", key);
        } else {
            snprintf(step, sizeof step, "[%zu]", node->index);
        }
        size_t length = strlen(step);
        if (length + 3 > begin) {
            begin -= 3;
            memcpy(text + begin, "...", 3);
            break;
        }
        begin -= length;
        memcpy(text + begin, step, length);
    }
    memmove(text, text + begin, MT_JSON_PATH - begin);
    if (!text[0]) {
        snprintf(text, MT_JSON_PATH, "the root");
    }
}

mt_status mt_json_fail(mt_context *context, const mt_json_node *node, mt_status status, const char *format, ...)
{
    char path[MT_JSON_PATH], sentence[512];
    const mt_json_node *root = root_of(node);
    mt_place place = {.file = root->key};
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(sentence, sizeof sentence, format, arguments);
    va_end(arguments);
    mt_json_path(node, path);
    if (root->text) {
        place = mt_json_place(root->key, root->text, root->size, mt_json_offset(root->text, root->size, node));
    }
    return mt_fail_at(context, status, place, "%s: %s", path, sentence);
}

/* What stands there, in a few words. */
static void describe(const json_t *value, char *text, size_t room)
{
    static const char *const names[] = {[JSON_OBJECT] = "an object",
                                        [JSON_TRUE] = "true",
                                        [JSON_FALSE] = "false",
                                        [JSON_NULL] = "null",
                                        [JSON_STRING] = "a string"};
    char word[64];
    if (json_is_integer(value)) {
        snprintf(text, room, "%lld", (long long)json_integer_value(value));
    } else if (json_is_real(value)) {
        snprintf(text, room, "%.17g", json_real_value(value));
    } else if (json_is_string(value)) {
        print_key(json_string_value(value), word, sizeof word - 24);
        snprintf(text, room, "\"%s\"", word);
    } else if (json_is_array(value)) {
        snprintf(text, room, "an array of %zu", json_array_size(value));
    } else {
        snprintf(text, room, "%s", names[json_typeof(value)]);
    }
}

mt_status mt_json_fail_expected(mt_context *context, const mt_json_node *node, const char *what)
{
    char got[80];
    if (!node->value) {
        return mt_json_fail(context, node, MT_ERROR_SYNTAX, "is missing, expected %s", what);
    }
    describe(node->value, got, sizeof got);
    return mt_json_fail(context, node, MT_ERROR_SYNTAX, "expected %s, got %s", what, got);
}

/* Finds the member; *absent says that there is nothing to read and that this is fine. */
static mt_status find_member(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                             mt_json_node *out, bool *absent)
{
    *out = mt_json_member(parent, key);
    *absent = !out->value && need == MT_JSON_OPTIONAL;
    return json_is_object(parent->value) ? MT_OK : mt_json_fail_expected(context, parent, "an object");
}

mt_status mt_json_node_whole(mt_context *context, const mt_json_node *node, uint64_t minimum, uint64_t maximum,
                             uint64_t *out)
{
    bool right = false;
    if (json_is_integer(node->value)) {
        json_int_t number = json_integer_value(node->value);
        right = number >= 0 && (uint64_t)number >= minimum && (uint64_t)number <= maximum;
        *out = right ? (uint64_t)number : *out;
    } else if (json_is_real(node->value)) {
        double number = json_real_value(node->value);
        right = number >= 0.0 && number < 0x1p53 && floor(number) == number && (uint64_t)number >= minimum &&
                (uint64_t)number <= maximum;
        *out = right ? (uint64_t)number : *out;
    }
    char what[96];
    if (right) {
        return MT_OK;
    }
    if (maximum >= INT64_MAX) {
        snprintf(what, sizeof what, "a whole number from %llu on", (unsigned long long)minimum);
    } else {
        snprintf(what, sizeof what, "a whole number from %llu to %llu", (unsigned long long)minimum,
                 (unsigned long long)maximum);
    }
    return mt_json_fail_expected(context, node, what);
}

mt_status mt_json_node_number(mt_context *context, const mt_json_node *node, double *out)
{
    if (!json_is_number(node->value)) {
        return mt_json_fail_expected(context, node, "a number");
    }
    *out = json_number_value(node->value);
    return MT_OK;
}

mt_status mt_json_node_string(mt_context *context, const mt_json_node *node, const char **out)
{
    if (!json_is_string(node->value)) {
        return mt_json_fail_expected(context, node, "a string");
    }
    *out = json_string_value(node->value);
    return MT_OK;
}

mt_status mt_json_whole(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                        uint64_t minimum, uint64_t maximum, uint64_t *out)
{
    mt_json_node node;
    bool absent;
    mt_status status = find_member(context, parent, key, need, &node, &absent);
    return status != MT_OK || absent ? status : mt_json_node_whole(context, &node, minimum, maximum, out);
}

mt_status mt_json_number(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         double *out)
{
    mt_json_node node;
    bool absent;
    mt_status status = find_member(context, parent, key, need, &node, &absent);
    return status != MT_OK || absent ? status : mt_json_node_number(context, &node, out);
}

mt_status mt_json_numbers(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                          size_t count, double *out)
{
    mt_json_node node;
    bool absent;
    mt_status status = find_member(context, parent, key, need, &node, &absent);
    if (status != MT_OK || absent) {
        return status;
    }
    if (!json_is_array(node.value) || json_array_size(node.value) != count) {
        char what[48];
        snprintf(what, sizeof what, "an array of %zu numbers", count);
        return mt_json_fail_expected(context, &node, what);
    }
    for (size_t i = 0; i < count && status == MT_OK; i++) {
        mt_json_node element = mt_json_element(&node, i);
        status = mt_json_node_number(context, &element, &out[i]);
    }
    return status;
}

mt_status mt_json_boolean(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                          bool *out)
{
    mt_json_node node;
    bool absent;
    mt_status status = find_member(context, parent, key, need, &node, &absent);
    if (status != MT_OK || absent) {
        return status;
    }
    if (!json_is_boolean(node.value)) {
        return mt_json_fail_expected(context, &node, "true or false");
    }
    *out = json_is_true(node.value);
    return MT_OK;
}

mt_status mt_json_string(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         const char **out)
{
    mt_json_node node;
    bool absent;
    mt_status status = find_member(context, parent, key, need, &node, &absent);
    return status != MT_OK || absent ? status : mt_json_node_string(context, &node, out);
}

mt_status mt_json_object(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         mt_json_node *out)
{
    bool absent;
    mt_status status = find_member(context, parent, key, need, out, &absent);
    bool right = absent || json_is_object(out->value);
    return status != MT_OK || right ? status : mt_json_fail_expected(context, out, "an object");
}

mt_status mt_json_array(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                        mt_json_node *out, size_t *count)
{
    bool absent;
    mt_status status = find_member(context, parent, key, need, out, &absent);
    bool right = absent || json_is_array(out->value);
    *count = json_array_size(out->value);
    return status != MT_OK || right ? status : mt_json_fail_expected(context, out, "an array");
}
