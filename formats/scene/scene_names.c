#include "formats/scene/scene_file.h"

#include <meshtool/checked.h>

#include <stdlib.h>
#include <string.h>

static int by_name(const void *a, const void *b)
{
    return strcmp(((const scene_name *)a)->name, ((const scene_name *)b)->name);
}

mt_status scene_names_init(mt_context *context, const mt_json_node *object, scene_names *out)
{
    size_t count = json_object_size(object->value);
    out->count = 0;
    if (!mt_count_fits(count)) {
        return mt_json_fail(context, object, MT_ERROR_TOO_LARGE, "there are too many names");
    }
    out->names = (scene_name *)mt_allocate_array(context, count, sizeof *out->names);
    if (!out->names) {
        return mt_context_error(context)->status;
    }
    void *at = json_object_iter(object->value);
    for (; at; at = json_object_iter_next(object->value, at)) {
        out->names[out->count] = (scene_name){json_object_iter_key(at), (mt_index)out->count};
        out->count++;
    }
    qsort(out->names, out->count, sizeof *out->names, by_name);
    return MT_OK;
}

void scene_names_release(mt_context *context, scene_names *names)
{
    mt_free(context, names->names);
    names->names = NULL;
    names->count = 0;
}

mt_status scene_find_name(const scene_reading *reading, const mt_json_node *object, const scene_names *among,
                          const char *key, const char *name, mt_index *out)
{
    const scene_name wanted = {name, 0};
    const scene_name *found =
        among->count > 0 ? (const scene_name *)bsearch(&wanted, among->names, among->count, sizeof wanted, by_name)
                         : NULL;
    if (found) {
        *out = found->number;
        return MT_OK;
    }
    mt_json_node member = mt_json_member(object, key);
    return mt_json_fail(reading->context, &member, MT_ERROR_SYNTAX, "the scene has no %s \"%.80s\"", key, name);
}
