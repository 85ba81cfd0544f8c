/* Where a value stands in its text. jansson keeps no places, so the text, known to be valid, is walked again; failures
 * are rare enough. */
#include "formats/stream/json.h"

#include <string.h>

/* Steps of a path that are looked for; a deeper value is placed at its ancestor. */
#define DEEPEST_PATH 32

typedef struct scan {
    const char *at, *end;
} scan;

static void skip_space(scan *s)
{
    while (s->at < s->end && strchr(" \t\r\n", *s->at)) {
        s->at++;
    }
}

static void skip_string(scan *s)
{
    for (s->at++; s->at < s->end && *s->at != '"'; s->at++) {
        s->at += *s->at == '\\' && s->at + 1 < s->end;
    }
    s->at += s->at < s->end;
}

static void skip_value(scan *s)
{
    size_t depth = 0;
    do {
        if (s->at < s->end && *s->at == '"') {
            skip_string(s);
            continue;
        }
        depth += s->at < s->end && strchr("{[", *s->at);
        depth -= depth > 0 && strchr("}]", *s->at);
        s->at += s->at < s->end;
    } while (s->at < s->end && (depth > 0 || !strchr(",]} \t\r\n", *s->at)));
}

/* Past a comma; false at the closing bracket. */
static bool next(scan *s)
{
    skip_space(s);
    bool more = s->at < s->end && *s->at == ',';
    s->at += more;
    skip_space(s);
    return more;
}

/* From the opening bracket to the value of the member or element. False: it is not there. */
static bool step(scan *s, const mt_json_node *node)
{
    size_t index = 0, length = node->key ? strlen(node->key) : 0;
    s->at++;
    skip_space(s);
    for (;; index++) {
        const char *key = s->at;
        if (node->key) {
            skip_string(s);
            skip_space(s);
            bool is_it = (size_t)(s->end - key) > length + 1 && memcmp(key + 1, node->key, length) == 0 &&
                         key[1 + length] == '"';
            s->at += s->at < s->end; /* the colon */
            skip_space(s);
            if (is_it) {
                return true;
            }
        } else if (index == node->index) {
            return true;
        }
        if (s->at >= s->end) {
            return false;
        }
        skip_value(s);
        if (!next(s)) {
            return false;
        }
    }
}

size_t mt_json_offset(const char *text, size_t size, const mt_json_node *node)
{
    const mt_json_node *path[DEEPEST_PATH];
    size_t count = 0;
    for (const mt_json_node *n = node; n->parent; n = n->parent) {
        count += count < DEEPEST_PATH;
        memmove(path + 1, path, (count - 1) * sizeof *path);
        path[0] = n;
    }
    scan s = {text, text + size};
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
        s.at += 3;
    }
    skip_space(&s);
    for (size_t i = 0; i < count; i++) {
        scan before = s;
        bool opens = s.at < s.end && strchr("{[", *s.at);
        if (!opens || !path[i]->parent->value || !step(&s, path[i])) {
            s = before;
            break;
        }
    }
    return (size_t)(s.at - text);
}
