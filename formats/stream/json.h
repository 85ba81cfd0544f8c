/* JSON to read: parsed strictly by jansson, and looked into by small getters that name the path of what is wrong.
 *
 * Refused are duplicate keys, bad UTF-8, NUL, numbers past a double or 64 bits, more than MT_JSON_DEPTH nested
 * brackets, and anything after the value. A UTF-8 mark at the beginning is skipped; UTF-16 is named. */
#ifndef MESHTOOL_STREAM_JSON_H
#define MESHTOOL_STREAM_JSON_H

#include <meshtool/context.h>

#include <jansson.h>

#define MT_JSON_DEPTH 500 /* jansson's parser calls itself for each: so many fit a small stack */

/* A parsed text, an object or an array; its values live until mt_json_release. */
typedef struct mt_json {
    json_t *root;
    uint64_t held; /* bytes counted against the context's limit */
} mt_json;

/* Parses bytes; `name` stands in messages ("NAME:LINE:COLUMN: ..."). Memory: jansson takes no allocator of ours, so
 * that the most it can hold is counted by one look at the bytes (mt_json_bound) and held against the context's limit
 * before it begins. *out is all zeros on failure: MT_ERROR_SYNTAX, MT_ERROR_UNSUPPORTED (UTF-16),
 * MT_ERROR_OUT_OF_MEMORY. */
mt_status mt_json_parse(mt_context *context, const char *name, const void *bytes, size_t size, mt_json *out);

/* Frees the values. All zeros are allowed. */
void mt_json_release(mt_context *context, mt_json *json);

/* Bytes that parsing this text may hold at once: by structure, not by size alone, as "{}," takes 80 bytes for each of
 * its own and a long string 4. */
uint64_t mt_json_bound(const void *bytes, size_t size);

/* A value and the way to it, kept on the stack: a node outlives those made from it. */
typedef struct mt_json_node {
    const struct mt_json_node *parent; /* NULL: the root */
    const char *key;                   /* the root's: the file's name; NULL: element number `index` of an array */
    size_t index;
    json_t *value;    /* NULL: there is none */
    const char *text; /* of the root, when failures are to name line and column; else NULL */
    size_t size;
} mt_json_node;

/* The root; name as in mt_json_parse. */
mt_json_node mt_json_root(const char *name, const mt_json *json);
/* The same, and failures name line and column too: those of the value, or of what it is missing from. The text is the
 * one that was parsed, and outlives the node. */
mt_json_node mt_json_root_of_text(const char *name, const mt_json *json, const void *bytes, size_t size);
/* The byte of the text at which a value begins; what it is missing from, when it is not there. */
size_t mt_json_offset(const char *text, size_t size, const mt_json_node *node);
/* Line and column of a byte. */
mt_place mt_json_place(const char *name, const char *text, size_t size, size_t at);
/* The member with that key; its value is NULL when there is none, or the parent is no object. */
mt_json_node mt_json_member(const mt_json_node *parent, const char *key);
/* Element number `index`; its value is NULL past the end. */
mt_json_node mt_json_element(const mt_json_node *parent, size_t index);

/* Fails with "NAME: accessors[3].count: " and the sentence; "NAME:LINE:COLUMN: ..." where the root knows its text. */
mt_status mt_json_fail(mt_context *context, const mt_json_node *node, mt_status status, const char *format, ...)
    MT_PRINTF(4, 5);
/* Fails with "expected `what`, got" and what stands there, or "is missing, expected `what`". MT_ERROR_SYNTAX. */
mt_status mt_json_fail_expected(mt_context *context, const mt_json_node *node, const char *what);
/* "accessors[3].count" into `text`, cut at its front when it is too long; "the root" for the root. */
#define MT_JSON_PATH 256
void mt_json_path(const mt_json_node *node, char text[MT_JSON_PATH]);

/* What a getter does when there is no such member: fail, or succeed and leave *out as it is. */
typedef enum mt_json_need { MT_JSON_REQUIRED, MT_JSON_OPTIONAL } mt_json_need;

/* Each gives the member `key` of an object (parent itself must be one), or MT_ERROR_SYNTAX. A whole number may be
 * written as 3.0. Strings and nodes live as long as the text; a node's parent is the given one. */
mt_status mt_json_whole(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                        uint64_t minimum, uint64_t maximum, uint64_t *out);
mt_status mt_json_number(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         double *out);
/* Exactly `count` numbers. */
mt_status mt_json_numbers(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                          size_t count, double *out);
mt_status mt_json_boolean(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                          bool *out);
mt_status mt_json_string(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         const char **out);
mt_status mt_json_object(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                         mt_json_node *out);
/* *count receives the number of elements; 0 when an optional one is missing, whose node's value is then NULL. */
mt_status mt_json_array(mt_context *context, const mt_json_node *parent, const char *key, mt_json_need need,
                        mt_json_node *out, size_t *count);

/* The same for a node at hand, such as an element of an array. */
mt_status mt_json_node_whole(mt_context *context, const mt_json_node *node, uint64_t minimum, uint64_t maximum,
                             uint64_t *out);
mt_status mt_json_node_number(mt_context *context, const mt_json_node *node, double *out);
mt_status mt_json_node_string(mt_context *context, const mt_json_node *node, const char **out);

#endif
