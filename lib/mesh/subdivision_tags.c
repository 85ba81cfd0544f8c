#include <meshtool/subdivision_tags.h>

#include <string.h>

static const struct {
    const char *name;
    unsigned limit;
    const char *words[2]; /* NULL: numbers */
} tags[MT_TAG_COUNT] = {
    [MT_TAG_BOUNDARY] = {"interpolateboundary", 3, {NULL, NULL}},
    [MT_TAG_FACE_VARYING] = {"facevaryinginterpolateboundary", 6, {NULL, NULL}},
    [MT_TAG_CREASE_METHOD] = {"creasemethod", 2, {"normal", "chaikin"}},
    [MT_TAG_SMOOTH_TRIANGLES] = {"smoothtriangles", 2, {"catmark", "smooth"}},
};

const char *mt_subdivision_tag_name(mt_subdivision_tag tag)
{
    return tags[tag].name;
}

unsigned mt_subdivision_tag_limit(mt_subdivision_tag tag)
{
    return tags[tag].limit;
}

const char *mt_subdivision_tag_word(mt_subdivision_tag tag, unsigned value)
{
    return value < 2 ? tags[tag].words[value] : NULL;
}

static bool is_named(const mt_attribute *attribute, const char *name, mt_domain domain)
{
    return attribute->semantic == MT_SEMANTIC_GENERIC && attribute->domain == domain && !attribute->indices &&
           attribute->type == MT_U8 && attribute->component_count == 1 && strcmp(attribute->name, name) == 0;
}

bool mt_attribute_is_subdivision_tag(const mt_attribute *attribute)
{
    bool found = false;
    for (int tag = 0; tag < MT_TAG_COUNT; tag++) {
        found = found || is_named(attribute, tags[tag].name, MT_DOMAIN_MESH);
    }
    return found;
}

static mt_attribute *find(const mt_mesh *mesh, const char *name, mt_domain domain)
{
    for (mt_index i = 0; i < mesh->attribute_count; i++) {
        if (is_named(&mesh->attributes[i], name, domain)) {
            return &mesh->attributes[i];
        }
    }
    return NULL;
}

static mt_status add(mt_context *context, mt_mesh *mesh, const char *name, mt_domain domain, mt_attribute **out)
{
    mt_attribute_layout layout = {.name = name,
                                  .semantic = MT_SEMANTIC_GENERIC,
                                  .domain = domain,
                                  .type = MT_U8,
                                  .component_count = 1,
                                  .value_count = mt_mesh_domain_count(mesh, domain)};
    return mt_mesh_add_attribute(context, mesh, &layout, out);
}

bool mt_subdivision_tag_get(const mt_mesh *mesh, mt_subdivision_tag tag, unsigned *value)
{
    const mt_attribute *attribute = find(mesh, tags[tag].name, MT_DOMAIN_MESH);
    if (!attribute || attribute->value_count != 1) {
        return false;
    }
    *value = *(const uint8_t *)attribute->values;
    return *value < tags[tag].limit;
}

mt_status mt_subdivision_tag_set(mt_context *context, mt_mesh *mesh, mt_subdivision_tag tag, unsigned value)
{
    mt_attribute *attribute = find(mesh, tags[tag].name, MT_DOMAIN_MESH);
    if (!attribute) {
        mt_status status = add(context, mesh, tags[tag].name, MT_DOMAIN_MESH, &attribute);
        if (status != MT_OK) {
            return status;
        }
    }
    *(uint8_t *)attribute->values = (uint8_t)value;
    return MT_OK;
}

mt_attribute *mt_mesh_find_holes(const mt_mesh *mesh)
{
    return find(mesh, MT_HOLE_NAME, MT_DOMAIN_FACE);
}

mt_status mt_mesh_add_holes(mt_context *context, mt_mesh *mesh, mt_attribute **out)
{
    *out = mt_mesh_find_holes(mesh);
    if (*out) {
        return MT_OK;
    }
    mt_status status = add(context, mesh, MT_HOLE_NAME, MT_DOMAIN_FACE, out);
    if (status == MT_OK && mesh->face_count) {
        memset((*out)->values, 0, mesh->face_count);
    }
    return status;
}
