#include "formats/mesh/ply_plan.h"

#include "formats/mesh/ply_names.h"

#include <meshtool/checked.h>

#include <stdlib.h>
#include <string.h>

typedef struct planner {
    mt_context *context;
    const mt_input *input;
    uint64_t body_size;
    ply_plan *plan;
} planner;

static mt_status fail_element(const planner *p, const ply_element *element, mt_status status, const char *sentence)
{
    return mt_fail_at(p->context, status, mt_input_place_line(p->input, element->line), "element \"%.80s\" %s",
                      element->name, sentence);
}

static uint32_t find_element(const ply_header *header, const char *name)
{
    for (uint32_t i = 0; i < header->element_count; i++) {
        if (strcmp(header->elements[i].name, name) == 0) {
            return i;
        }
    }
    return UINT32_MAX;
}

/* Refuses counts that the bytes after the header cannot hold. */
static mt_status check_counts(const planner *p)
{
    const ply_header *header = &p->plan->header;
    uint64_t slack = header->encoding == PLY_ASCII; /* the last line may lack its end */
    uint64_t left = p->body_size + slack;
    for (uint32_t i = 0; i < header->element_count; i++) {
        const ply_element *element = &header->elements[i];
        uint64_t each = mt_ply_smallest_record(element, header->encoding), size;
        if (!mt_checked_multiply(element->count, each, &size) || size > left) {
            return mt_fail_at(p->context, MT_ERROR_SYNTAX, mt_input_place_line(p->input, element->line),
                              "element \"%.80s\" declares %llu records of at least %llu bytes, but only %llu bytes are "
                              "left for them",
                              element->name, (unsigned long long)element->count, (unsigned long long)each,
                              (unsigned long long)(left > slack ? left - slack : 0));
        }
        left -= size;
    }
    return MT_OK;
}

static void set_target(ply_target *target, mt_type type, void *values, size_t first, size_t stride)
{
    size_t size = mt_type_size(type);
    *target = (ply_target){PLY_SCALAR, type, (char *)values + first * size, stride * size};
}

static mt_status find_positions(const planner *p, uint32_t properties[3], mt_type *type)
{
    static const char *const names[] = {"x", "y", "z"};
    const ply_element *vertices = &p->plan->header.elements[p->plan->vertices];
    *type = MT_F32;
    for (int i = 0; i < 3; i++) {
        properties[i] = mt_ply_find_property(vertices, names[i]);
        bool missing = properties[i] == UINT32_MAX || vertices->properties[properties[i]].is_list;
        if (missing && vertices->count > 0) {
            return fail_element(p, vertices, MT_ERROR_SYNTAX, "has no numbers x, y and z");
        }
        properties[i] = missing ? UINT32_MAX : properties[i];
        *type = !missing && vertices->properties[properties[i]].type != MT_F32 ? MT_F64 : *type;
    }
    return MT_OK;
}

static mt_status make_mesh(planner *p)
{
    ply_plan *plan = p->plan;
    const ply_header *header = &plan->header;
    uint32_t properties[3];
    mt_mesh_layout layout = {.vertex_count = header->elements[plan->vertices].count};
    mt_status status = find_positions(p, properties, &layout.position_type);
    if (status != MT_OK) {
        return status;
    }
    layout.face_count = plan->faces == UINT32_MAX ? 0 : header->elements[plan->faces].count;
    status = mt_mesh_create(p->context, &layout, &plan->mesh);
    for (size_t i = 0; status == MT_OK && i < 3; i++) {
        if (properties[i] != UINT32_MAX) {
            ply_target *target = &plan->targets[plan->vertices][properties[i]];
            set_target(target, layout.position_type, plan->mesh->positions, i, 3);
        }
    }
    return status;
}

/* Adds an attribute that `count` properties fill. */
static mt_status add_attribute(planner *p, uint32_t element, mt_semantic semantic, const char *name, mt_type type,
                               const uint32_t *properties, uint32_t count)
{
    mt_mesh *mesh = p->plan->mesh;
    mt_attribute *attribute;
    mt_domain domain = element == p->plan->vertices ? MT_DOMAIN_VERTEX : MT_DOMAIN_FACE;
    mt_attribute_layout layout = {.name = name,
                                  .semantic = semantic,
                                  .domain = domain,
                                  .type = type,
                                  .component_count = count,
                                  .value_count = mt_mesh_domain_count(mesh, domain)};
    mt_status status = mt_mesh_add_attribute(p->context, mesh, &layout, &attribute);
    for (uint32_t i = 0; status == MT_OK && i < count; i++) {
        set_target(&p->plan->targets[element][properties[i]], type, attribute->values, i, count);
    }
    return status;
}

static bool is_free_scalar(const planner *p, uint32_t element, uint32_t property)
{
    return property != UINT32_MAX && !p->plan->header.elements[element].properties[property].is_list &&
           p->plan->targets[element][property].use == PLY_SKIP;
}

static bool group_holds(const ply_group *group, mt_type type)
{
    return type >= MT_F32 || (group->integers && (type == MT_U8 || type == MT_U16));
}

/* How many of the group's properties the element has, all of one fitting type, from the first on. */
static uint32_t match_group(const planner *p, uint32_t element, const ply_group *group, uint32_t *properties)
{
    const ply_element *e = &p->plan->header.elements[element];
    uint32_t count = 0;
    for (; count < group->most; count++) {
        uint32_t property = mt_ply_find_property(e, group->names[count]);
        if (!is_free_scalar(p, element, property)) {
            break;
        }
        mt_type type = e->properties[property].type;
        if (!group_holds(group, type) || (count && type != e->properties[properties[0]].type)) {
            break;
        }
        properties[count] = property;
    }
    return count < group->fewest ? 0 : count;
}

static mt_status add_groups(planner *p, uint32_t element)
{
    uint32_t group_count;
    const ply_group *groups = mt_ply_groups(&group_count);
    const ply_element *e = &p->plan->header.elements[element];
    mt_domain domain = element == p->plan->vertices ? MT_DOMAIN_VERTEX : MT_DOMAIN_FACE;
    mt_status status = MT_OK;
    for (uint32_t i = 0; status == MT_OK && i < group_count; i++) {
        uint32_t properties[PLY_GROUP_MAX];
        uint32_t count = match_group(p, element, &groups[i], properties);
        if (count && !mt_mesh_find_attribute(p->plan->mesh, groups[i].semantic, domain)) {
            status =
                add_attribute(p, element, groups[i].semantic, "", e->properties[properties[0]].type, properties, count);
        }
    }
    return status;
}

/* The length of NAME in "NAME_7" when the number there is the one asked for, else 0. */
static size_t numbered_stem(const char *name, uint32_t number)
{
    const char *bar = strrchr(name, '_');
    if (!bar || bar == name || !bar[1] || (bar[1] == '0' && bar[2])) {
        return 0;
    }
    char *end;
    unsigned long value = strspn(bar + 1, "0123456789") <= 4 ? strtoul(bar + 1, &end, 10) : UINT32_MAX;
    return value == number && !*end ? (size_t)(bar - name) : 0;
}

/* How many properties from `first` on are called NAME_0, NAME_1 and so on, of one type; at least 1. */
static uint32_t numbered_count(const planner *p, uint32_t element, uint32_t first)
{
    const ply_element *e = &p->plan->header.elements[element];
    const ply_property *properties = e->properties + first;
    size_t stem = numbered_stem(properties->name, 0);
    uint32_t count = 1;
    while (stem && first + count < e->property_count && is_free_scalar(p, element, first + count) &&
           properties[count].type == properties->type && numbered_stem(properties[count].name, count) == stem &&
           memcmp(properties[count].name, properties->name, stem) == 0) {
        count++;
    }
    return count;
}

/* Scalars that no group took are kept by name; NAME_0, NAME_1, ... become one attribute NAME. */
static mt_status add_generic(planner *p, uint32_t element)
{
    const ply_element *e = &p->plan->header.elements[element];
    mt_status status = MT_OK;
    for (uint32_t i = 0; status == MT_OK && i < e->property_count;) {
        if (!is_free_scalar(p, element, i)) {
            i++;
            continue;
        }
        uint32_t properties[PLY_MAX_PROPERTIES], count = numbered_count(p, element, i);
        for (uint32_t j = 0; j < count; j++) {
            properties[j] = i + j;
        }
        char *name = mt_duplicate_string(p->context, e->properties[i].name);
        if (!name) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
        if (count > 1) {
            name[numbered_stem(name, 0)] = 0;
        }
        status = add_attribute(p, element, MT_SEMANTIC_GENERIC, name, e->properties[i].type, properties, count);
        mt_free(p->context, name);
        i += count;
    }
    return status;
}

static mt_status plan_face_lists(planner *p)
{
    static const char *const names[] = {"vertex_indices", "vertex_index"};
    const ply_element *faces = &p->plan->header.elements[p->plan->faces];
    uint32_t vertices = UINT32_MAX, uvs = mt_ply_find_property(faces, "texcoord");
    for (int i = 0; i < 2 && vertices == UINT32_MAX; i++) {
        vertices = mt_ply_find_property(faces, names[i]);
    }
    if (faces->count == 0) {
        return MT_OK;
    }
    if (vertices == UINT32_MAX || !faces->properties[vertices].is_list) {
        return fail_element(p, faces, MT_ERROR_SYNTAX, "has no list vertex_indices");
    }
    if (faces->properties[vertices].type >= MT_F32) {
        return fail_element(p, faces, MT_ERROR_SYNTAX, "lists its vertices as float or double; expected whole numbers");
    }
    ply_target *targets = p->plan->targets[p->plan->faces];
    targets[vertices] = (ply_target){.use = PLY_FACE_VERTICES, .type = MT_U32};
    if (uvs != UINT32_MAX && faces->properties[uvs].is_list && faces->properties[uvs].type >= MT_F32) {
        targets[uvs] = (ply_target){.use = PLY_FACE_UVS, .type = faces->properties[uvs].type};
        p->plan->has_corner_uvs = true;
        p->plan->corner_uv_type = faces->properties[uvs].type;
    }
    return MT_OK;
}

/* Edges become wires of two vertices. */
static mt_status plan_edges(planner *p)
{
    static const char *const names[] = {"vertex1", "vertex2"};
    mt_mesh *mesh = p->plan->mesh;
    const ply_element *edges = &p->plan->header.elements[p->plan->edges];
    uint64_t count = edges->count;
    if (count == 0) {
        return MT_OK;
    }
    if (!mt_count_fits(2 * count)) {
        return fail_element(p, edges, MT_ERROR_TOO_LARGE, "has more records than a mesh can hold");
    }
    mesh->wire_vertices = mt_allocate_array(p->context, 2 * count, sizeof(mt_index));
    mesh->wire_offsets = mt_allocate_array(p->context, count + 1, sizeof(mt_index));
    if (!mesh->wire_vertices || !mesh->wire_offsets) {
        return mt_context_error(p->context)->status;
    }
    for (uint64_t i = 0; i <= count; i++) {
        mesh->wire_offsets[i] = (mt_index)(2 * i);
    }
    mesh->wire_count = (mt_index)count;
    for (size_t i = 0; i < 2; i++) {
        uint32_t property = mt_ply_find_property(edges, names[i]);
        if (property == UINT32_MAX || edges->properties[property].is_list ||
            edges->properties[property].type >= MT_F32) {
            return fail_element(p, edges, MT_ERROR_SYNTAX, "has no whole numbers vertex1 and vertex2");
        }
        set_target(&p->plan->targets[p->plan->edges][property], MT_U32, mesh->wire_vertices, i, 2);
    }
    return MT_OK;
}

static mt_status plan_elements(planner *p)
{
    ply_plan *plan = p->plan;
    plan->vertices = find_element(&plan->header, "vertex");
    plan->faces = find_element(&plan->header, "face");
    plan->edges = find_element(&plan->header, "edge");
    if (plan->vertices == UINT32_MAX) {
        return mt_fail_at(p->context, MT_ERROR_SYNTAX, mt_input_place_line(p->input, plan->header.body_line - 1),
                          "the header declares no element \"vertex\"");
    }
    uint32_t strips = find_element(&plan->header, "tristrips");
    if (strips != UINT32_MAX) {
        return fail_element(p, &plan->header.elements[strips], MT_ERROR_UNSUPPORTED,
                            "holds triangle strips, which are not read from PLY; write the mesh with faces instead");
    }
    mt_status status = make_mesh(p);
    if (status == MT_OK && plan->faces != UINT32_MAX) {
        status = plan_face_lists(p);
    }
    if (status == MT_OK && plan->edges != UINT32_MAX) {
        status = plan_edges(p);
    }
    const uint32_t kept[] = {plan->vertices, plan->faces};
    for (int i = 0; status == MT_OK && i < 2; i++) {
        if (kept[i] != UINT32_MAX) {
            status = add_groups(p, kept[i]);
            status = status == MT_OK ? add_generic(p, kept[i]) : status;
        }
    }
    return status;
}

static void warn_of_skipped(const planner *p)
{
    const ply_header *header = &p->plan->header;
    for (uint32_t i = 0; i < header->element_count; i++) {
        const ply_element *element = &header->elements[i];
        if (element->count == 0) {
            continue;
        }
        if (!mt_ply_plan_uses(p->plan, i)) {
            mt_warn(p->context, "%s: element \"%.80s\" (%llu records) is skipped: a mesh has no place for it",
                    mt_input_name(p->input), element->name, (unsigned long long)element->count);
            continue;
        }
        for (uint32_t j = 0; j < element->property_count; j++) {
            if (p->plan->targets[i][j].use == PLY_SKIP) {
                mt_warn(p->context,
                        "%s: property \"%.80s\" of element \"%.80s\" is skipped: a mesh has no place for it",
                        mt_input_name(p->input), element->properties[j].name, element->name);
            }
        }
    }
}

static mt_status allocate_targets(planner *p)
{
    ply_plan *plan = p->plan;
    uint32_t count = plan->header.element_count;
    plan->targets = mt_allocate_array_zeroed(p->context, count, sizeof *plan->targets);
    for (uint32_t i = 0; plan->targets && i < count; i++) {
        uint32_t property_count = plan->header.elements[i].property_count;
        plan->targets[i] = mt_allocate_array_zeroed(p->context, property_count, sizeof **plan->targets);
        if (!plan->targets[i]) {
            return MT_ERROR_OUT_OF_MEMORY;
        }
    }
    return plan->targets ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

mt_status mt_ply_plan_make(mt_context *context, const mt_input *input, ply_header *header, uint64_t body_size,
                           ply_plan *out)
{
    *out = (ply_plan){.header = *header};
    *header = (ply_header){0};
    planner p = {context, input, body_size, out};
    mt_status status = check_counts(&p);
    if (status == MT_OK) {
        status = allocate_targets(&p);
    }
    if (status == MT_OK) {
        status = plan_elements(&p);
    }
    if (status != MT_OK) {
        mt_ply_plan_release(context, out);
        return status;
    }
    warn_of_skipped(&p);
    return MT_OK;
}

void mt_ply_plan_release(mt_context *context, ply_plan *plan)
{
    for (uint32_t i = 0; plan->targets && i < plan->header.element_count; i++) {
        mt_free(context, plan->targets[i]);
    }
    mt_free(context, plan->targets);
    mt_mesh_destroy(context, plan->mesh);
    mt_ply_header_release(context, &plan->header);
    *plan = (ply_plan){0};
}

bool mt_ply_plan_uses(const ply_plan *plan, uint32_t element)
{
    return element == plan->vertices || element == plan->faces || element == plan->edges;
}
