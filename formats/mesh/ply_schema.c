#include "formats/mesh/ply_schema.h"

#include "formats/mesh/ply_header.h"
#include "formats/mesh/ply_names.h"

#include <stdio.h>
#include <string.h>

#define NAME_ROOM 256

typedef struct schemer {
    mt_context *context;
    const mt_mesh *mesh;
    ply_fields *fields;
} schemer;

static bool has_field(const ply_fields *fields, const char *name)
{
    for (uint32_t i = 0; i < fields->field_count; i++) {
        if (strcmp(fields->fields[i].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* A header cuts its lines at blanks and allows a name once; anything else may stand in a name. */
static void make_name(const schemer *s, const char *wanted, char name[NAME_ROOM])
{
    char stem[NAME_ROOM - 16];
    snprintf(stem, sizeof stem, "%s", wanted[0] ? wanted : "attribute");
    for (char *at = stem; *at; at++) {
        *at = (unsigned char)*at <= ' ' || *at == 0x7f ? '_' : *at;
    }
    snprintf(name, NAME_ROOM, "%s", stem);
    for (unsigned i = 2; has_field(s->fields, name); i++) {
        snprintf(name, NAME_ROOM, "%s_%u", stem, i);
    }
    if (wanted[0] && strcmp(wanted, name) != 0) {
        mt_warn(s->context, "the attribute \"%.80s\" is written to PLY as property \"%.80s\"", wanted, name);
    }
}

/* Appends a field; its name is copied. */
static mt_status add_field(schemer *s, const char *name, ply_field field)
{
    ply_fields *fields = s->fields;
    char unique[NAME_ROOM];
    make_name(s, name, unique);
    if (fields->field_count == PLY_MAX_PROPERTIES) {
        return mt_fail(s->context, MT_ERROR_UNSUPPORTED, "more than %u numbers for each %s cannot be written to PLY",
                       PLY_MAX_PROPERTIES, fields->element);
    }
    if (fields->field_count == fields->field_room) {
        uint32_t room = 2 * fields->field_room + 8;
        ply_field *grown = mt_reallocate(s->context, fields->fields, room * sizeof *grown);
        if (!grown) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        fields->fields = grown;
        fields->field_room = room;
    }
    field.name = mt_duplicate_string(s->context, unique);
    if (!field.name) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    fields->fields[fields->field_count++] = field;
    return MT_OK;
}

static mt_status add_numbers(schemer *s, const char *name, mt_type type, const void *values, size_t component,
                             size_t component_count, const mt_index *indices)
{
    size_t size = mt_type_size(type);
    return add_field(s, name,
                     (ply_field){.source = PLY_FROM_VALUES,
                                 .type = type,
                                 .values = (const char *)values + component * size,
                                 .stride = component_count * size,
                                 .indices = indices});
}

/* The names for an attribute of that meaning and number of components, NULL when there are none. */
static const char *const *standard_names(const mt_attribute *attribute, uint32_t components)
{
    uint32_t count;
    const ply_group *groups = mt_ply_groups(&count);
    for (uint32_t i = 0; i < count; i++) {
        if (groups[i].semantic == attribute->semantic && groups[i].fewest <= components &&
            components <= groups[i].most) {
            return groups[i].names;
        }
    }
    return NULL;
}

/* Grey has one name in no PLY file: it is written as equal red, green and blue. */
static mt_status add_standard(schemer *s, const mt_attribute *a, bool *added)
{
    bool grey = a->semantic == MT_SEMANTIC_COLOR && a->component_count <= 2;
    uint32_t count = grey ? a->component_count + 2 : a->component_count;
    const char *const *names = standard_names(a, count);
    mt_status status = MT_OK;
    *added = names && !has_field(s->fields, names[0]);
    for (uint32_t i = 0; *added && status == MT_OK && i < count; i++) {
        uint32_t component = grey ? i / 3 : i;
        status = add_numbers(s, names[i], a->type, a->values, component, a->component_count, a->indices);
    }
    return status;
}

static mt_status add_generic(schemer *s, const mt_attribute *a)
{
    static const char *const semantics[] = {"attribute", "normal", "uv", "color"};
    const char *stem = a->name[0] ? a->name : semantics[a->semantic];
    mt_status status = MT_OK;
    for (uint32_t i = 0; status == MT_OK && i < a->component_count; i++) {
        char name[NAME_ROOM];
        if (a->component_count == 1) {
            snprintf(name, sizeof name, "%s", stem);
        } else {
            snprintf(name, sizeof name, "%.200s_%u", stem, i);
        }
        status = add_numbers(s, name, a->type, a->values, i, a->component_count, a->indices);
    }
    return status;
}

static void warn_of_missing(const schemer *s, const mt_attribute *a)
{
    mt_index missing = 0, count = mt_mesh_domain_count(s->mesh, a->domain);
    for (mt_index i = 0; a->indices && i < count; i++) {
        missing += a->indices[i] == MT_NONE;
    }
    if (missing) {
        mt_warn(s->context, "%lu values that the attribute \"%.80s\" does not have are written to PLY as nan or 0",
                (unsigned long)missing, a->name);
    }
}

/* The attributes of a domain: those with a meaning first, so that their names are theirs. */
static mt_status add_attributes(schemer *s, mt_domain domain)
{
    mt_status status = MT_OK;
    for (int pass = 0; pass < 2; pass++) {
        for (mt_index i = 0; status == MT_OK && i < s->mesh->attribute_count; i++) {
            const mt_attribute *a = &s->mesh->attributes[i];
            bool standard =
                     a->semantic != MT_SEMANTIC_GENERIC && a == mt_mesh_find_attribute(s->mesh, a->semantic, domain),
                 added = false;
            if (a->domain != domain || standard != (pass == 0)) {
                continue;
            }
            warn_of_missing(s, a);
            if (standard) {
                status = add_standard(s, a, &added);
            }
            if (status == MT_OK && !added) {
                status = add_generic(s, a);
            }
        }
    }
    return status;
}

static mt_status make_vertices(schemer *s)
{
    static const char *const names[] = {"x", "y", "z"};
    const mt_mesh *mesh = s->mesh;
    mt_status status = MT_OK;
    for (size_t i = 0; status == MT_OK && i < 3; i++) {
        status = add_numbers(s, names[i], mesh->position_type, mesh->positions, i, 3, NULL);
    }
    for (size_t i = 0; status == MT_OK && i < 3; i++) {
        s->fields->fields[i].is_position = true;
    }
    return status == MT_OK ? add_attributes(s, MT_DOMAIN_VERTEX) : status;
}

static mt_index most_sides(const mt_mesh *mesh)
{
    mt_index most = mesh->face_offsets ? 0 : mesh->face_size;
    for (mt_index face = 0; mesh->face_offsets && face < mesh->face_count; face++) {
        mt_index sides = mt_mesh_face_sides(mesh, face);
        most = sides > most ? sides : most;
    }
    return most;
}

/* Most readers know signed indices only. */
static mt_type index_type(const mt_mesh *mesh)
{
    return mesh->vertex_count <= (mt_index)INT32_MAX ? MT_I32 : MT_U32;
}

static mt_type count_type(uint64_t largest)
{
    return largest <= UINT8_MAX ? MT_U8 : largest <= INT32_MAX ? MT_I32 : MT_U32;
}

static mt_status make_faces(schemer *s)
{
    mt_index most = most_sides(s->mesh);
    mt_status status =
        add_field(s, "vertex_indices",
                  (ply_field){.source = PLY_FROM_FACE, .type = index_type(s->mesh), .count_type = count_type(most)});
    const mt_attribute *uvs = mt_mesh_find_attribute(s->mesh, MT_SEMANTIC_UV, MT_DOMAIN_CORNER);
    if (status == MT_OK && uvs) {
        ply_field field = {.source = PLY_FROM_FACE_UVS,
                           .type = uvs->type == MT_F32 ? MT_F32 : MT_F64,
                           .count_type = count_type((uint64_t)most * uvs->component_count),
                           .attribute = uvs};
        status = add_field(s, "texcoord", field);
    }
    return status == MT_OK ? add_attributes(s, MT_DOMAIN_FACE) : status;
}

static mt_status make_edges(schemer *s)
{
    static const char *const names[] = {"vertex1", "vertex2"};
    const mt_mesh *mesh = s->mesh;
    mt_status status = MT_OK;
    for (size_t i = 0; status == MT_OK && i < 2; i++) {
        status = add_field(s, names[i],
                           (ply_field){.source = PLY_FROM_WIRE,
                                       .type = index_type(mesh),
                                       .values = (const char *)(mesh->wire_vertices + i),
                                       .stride = sizeof(mt_index)});
    }
    for (mt_index wire = 0; wire < mesh->wire_count; wire++) {
        s->fields->record_count += mesh->wire_offsets[wire + 1] - mesh->wire_offsets[wire] - 1;
    }
    return status;
}

mt_status mt_ply_schema_make(mt_context *context, const mt_mesh *mesh, ply_schema *out)
{
    *out = (ply_schema){.vertices = {.element = "vertex", .record_count = mesh->vertex_count},
                        .faces = {.element = "face", .record_count = mesh->face_count},
                        .edges = {.element = "edge"}};
    schemer s = {context, mesh, &out->vertices};
    mt_status status = make_vertices(&s);
    if (status == MT_OK) {
        s.fields = &out->faces;
        status = make_faces(&s);
    }
    if (status == MT_OK && mesh->wire_count) {
        s.fields = &out->edges;
        status = make_edges(&s);
    }
    if (status != MT_OK) {
        mt_ply_schema_release(context, out);
    }
    return status;
}

void mt_ply_schema_release(mt_context *context, ply_schema *schema)
{
    ply_fields *all[] = {&schema->vertices, &schema->faces, &schema->edges};
    for (size_t i = 0; i < 3; i++) {
        for (uint32_t j = 0; j < all[i]->field_count; j++) {
            mt_free(context, all[i]->fields[j].name);
        }
        mt_free(context, all[i]->fields);
    }
    *schema = (ply_schema){0};
}
