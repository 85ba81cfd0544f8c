/* Welding a mesh: vertices at the same place become one, and nothing that they carried is lost: where the values of a
 * vertex attribute differ at one place, the attribute moves to the corners, indexed. O(size) time. */
#include <meshtool/weld.h>

#include <string.h>

#define BLOCK 65536

/* The vertices' new numbers, and for each new one the first old one. */
typedef struct weld_map {
    const mt_index *numbers;
    const mt_index *firsts;
    mt_index old_count, new_count;
} weld_map;

static bool same_value(const mt_attribute *attribute, mt_index a, mt_index b)
{
    mt_index i = mt_attribute_value_index(attribute, a), j = mt_attribute_value_index(attribute, b);
    if (i == j || i == MT_NONE || j == MT_NONE) {
        return i == j;
    }
    size_t size = attribute->component_count * mt_type_size(attribute->type);
    const unsigned char *values = attribute->values;
    return memcmp(values + i * size, values + j * size, size) == 0;
}

static bool agrees(const mt_attribute *attribute, const weld_map *map)
{
    for (mt_index v = 0; v < map->old_count; v++) {
        if (!same_value(attribute, v, map->firsts[map->numbers[v]])) {
            return false;
        }
    }
    return true;
}

/* Keeps each place's first value. */
static void shrink(mt_attribute *attribute, const weld_map *map)
{
    size_t size = attribute->component_count * mt_type_size(attribute->type);
    unsigned char *values = attribute->values;
    for (mt_index v = 0; v < map->new_count; v++) {
        if (attribute->indices) {
            attribute->indices[v] = attribute->indices[map->firsts[v]];
        } else {
            memmove(values + v * size, values + map->firsts[v] * size, size);
        }
    }
    if (!attribute->indices) {
        attribute->value_count = map->new_count;
    }
}

static mt_status move_to_corners(mt_context *context, const mt_mesh *mesh, mt_attribute *attribute)
{
    mt_index *indices = mt_allocate_array(context, mesh->corner_count, sizeof *indices);
    if (!indices) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        indices[c] = mt_attribute_value_index(attribute, mesh->corner_vertices[c]);
    }
    mt_free(context, attribute->indices);
    attribute->indices = indices;
    attribute->domain = MT_DOMAIN_CORNER;
    return MT_OK;
}

/* First those that need memory, so that a failure leaves a mesh that is whole. */
static mt_status weld_attributes(mt_context *context, mt_mesh *mesh, const weld_map *map)
{
    mt_status status = MT_OK;
    for (mt_index i = 0; i < mesh->attribute_count && status == MT_OK; i++) {
        mt_attribute *attribute = &mesh->attributes[i];
        if (attribute->domain == MT_DOMAIN_VERTEX && !agrees(attribute, map)) {
            status = move_to_corners(context, mesh, attribute);
        }
    }
    for (mt_index i = 0; i < mesh->attribute_count && status == MT_OK; i++) {
        if (mesh->attributes[i].domain == MT_DOMAIN_VERTEX) {
            shrink(&mesh->attributes[i], map);
        }
    }
    return status;
}

typedef struct renumber_work {
    const mt_index *numbers;
    mt_index *vertices;
} renumber_work;

static void renumber_block(void *user, uint64_t begin, uint64_t end)
{
    const renumber_work *work = user;
    for (uint64_t i = begin; i < end; i++) {
        work->vertices[i] = work->numbers[work->vertices[i]];
    }
}

static void renumber(mt_context *context, const mt_index *numbers, mt_index *vertices, mt_index count)
{
    renumber_work work = {numbers, vertices};
    mt_parallel_for(context, count, BLOCK, renumber_block, &work);
}

static void renumber_mesh(mt_context *context, mt_mesh *mesh, const mt_index *numbers)
{
    renumber(context, numbers, mesh->corner_vertices, mesh->corner_count);
    renumber(context, numbers, mesh->wire_vertices, mesh->wire_count ? mesh->wire_offsets[mesh->wire_count] : 0);
    renumber(context, numbers, mesh->point_vertices, mesh->point_count);
    for (mt_index i = 0; i < mesh->crease_count; i++) {
        mesh->creases[i].a = numbers[mesh->creases[i].a];
        mesh->creases[i].b = numbers[mesh->creases[i].b];
    }
    for (mt_index i = 0; i < mesh->sharp_vertex_count; i++) {
        mesh->sharp_vertices[i].vertex = numbers[mesh->sharp_vertices[i].vertex];
    }
}

/* firsts[n] is the lowest vertex with the number n: numbers were given in the order of these. */
static void find_firsts(const mt_index *numbers, mt_index count, mt_index *firsts)
{
    mt_index found = 0;
    for (mt_index v = 0; v < count; v++) {
        if (numbers[v] == found) {
            firsts[found++] = v;
        }
    }
}

static void join_positions(mt_mesh *mesh, const weld_map *map)
{
    size_t size = 3 * mt_type_size(mesh->position_type);
    unsigned char *positions = mesh->positions;
    for (mt_index v = 0; v < map->new_count; v++) {
        memmove(positions + v * size, positions + map->firsts[v] * size, size);
    }
}

mt_status mt_mesh_join_vertices(mt_context *context, mt_mesh *mesh, const mt_index *numbers, mt_index distinct_count)
{
    mt_index *firsts = mt_allocate_array(context, mesh->vertex_count, sizeof *firsts);
    if (!firsts) {
        return mt_context_error(context)->status;
    }
    find_firsts(numbers, mesh->vertex_count, firsts);
    weld_map map = {numbers, firsts, mesh->vertex_count, distinct_count};
    mt_status status = weld_attributes(context, mesh, &map);
    if (status == MT_OK) {
        renumber_mesh(context, mesh, numbers);
        join_positions(mesh, &map);
        mesh->vertex_count = distinct_count;
    }
    mt_free(context, firsts);
    return status;
}

mt_status mt_mesh_weld(mt_context *context, mt_mesh *mesh, mt_index *removed)
{
    mt_index old_count = mesh->vertex_count, new_count = 0;
    mt_index *numbers = mt_allocate_array(context, old_count, sizeof *numbers);
    void *distinct = numbers ? mt_allocate_array(context, old_count, 3 * mt_type_size(mesh->position_type)) : NULL;
    mt_status status = MT_ERROR_OUT_OF_MEMORY;
    if (distinct) {
        status = mt_weld_exact(context, mesh->positions, mesh->position_type, old_count, distinct, numbers, &new_count);
        mt_free(context, distinct);
    }
    if (status == MT_OK) {
        status = mt_mesh_join_vertices(context, mesh, numbers, new_count);
    }
    mt_free(context, numbers);
    if (removed) {
        *removed = old_count - mesh->vertex_count;
    }
    return status;
}
