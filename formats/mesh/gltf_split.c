/* Vertices are split where the values of their corners differ: glTF holds one value of each kind at a vertex. The first
 * corner of a vertex keeps its number; further values are found by hashing them with the vertex. */
#include "formats/mesh/gltf_write.h"

#include <meshtool/checked.h>

#include <string.h>

#define FREE_SLOT MT_NONE
#define FIRST_CAPACITY 1024u

typedef struct splitter {
    mt_context *context;
    const mt_mesh *mesh;
    const mt_gltf_column *columns[MT_GLTF_COLUMNS]; /* those on corners */
    size_t column_count;
    mt_gltf_split *split;
    mt_index extra_capacity; /* room in split->sources and behind the mesh's vertices in split->corners */
    mt_index *slots;         /* vertices split off, open addressing */
    uint64_t slot_capacity;  /* a power of two; 0: none yet */
} splitter;

static mt_index value_of(const mt_gltf_column *column, mt_index corner)
{
    return mt_attribute_value_index(column->attribute, corner);
}

static bool same_values(const splitter *s, mt_index a, mt_index b)
{
    for (size_t i = 0; i < s->column_count; i++) {
        mt_index x = value_of(s->columns[i], a), y = value_of(s->columns[i], b);
        if (x != y) {
            uint32_t p[4], q[4]; /* a value takes 16 bytes at most */
            mt_gltf_make_value(s->columns[i], x, p);
            mt_gltf_make_value(s->columns[i], y, q);
            if ((x == MT_NONE) != (y == MT_NONE) || memcmp(p, q, s->columns[i]->stride) != 0) {
                return false;
            }
        }
    }
    return true;
}

/* Equal values hash alike, whatever their numbers. */
static uint64_t hash_corner(const splitter *s, mt_index corner)
{
    uint64_t hash = 0x9E3779B97F4A7C15u * (s->mesh->corner_vertices[corner] + 1u);
    for (size_t i = 0; i < s->column_count; i++) {
        uint32_t words[4] = {0};
        mt_gltf_make_value(s->columns[i], value_of(s->columns[i], corner), words);
        for (unsigned k = 0; k < s->columns[i]->stride / 4; k++) {
            hash = (hash ^ words[k]) * 0xBF58476D1CE4E5B9u;
            hash ^= hash >> 29;
        }
    }
    return hash ^ hash >> 32;
}

static mt_index *find_slot(const splitter *s, mt_index corner)
{
    uint64_t mask = s->slot_capacity - 1, at = hash_corner(s, corner) & mask;
    mt_index vertex = s->mesh->corner_vertices[corner];
    while (s->slots[at] != FREE_SLOT) {
        mt_index known = s->slots[at], other = s->split->corners[known];
        if (s->mesh->corner_vertices[other] == vertex && same_values(s, other, corner)) {
            break;
        }
        at = (at + 1) & mask;
    }
    return &s->slots[at];
}

static mt_status grow_slots(splitter *s)
{
    mt_index *old = s->slots, extra = s->split->vertex_count - s->mesh->vertex_count;
    uint64_t capacity = s->slot_capacity ? 2 * s->slot_capacity : FIRST_CAPACITY;
    mt_index *slots = mt_allocate_array(s->context, capacity, sizeof *slots);
    if (!slots) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    memset(slots, 0xFF, capacity * sizeof *slots);
    s->slots = slots;
    s->slot_capacity = capacity;
    for (mt_index i = 0; i < extra; i++) {
        mt_index vertex = s->mesh->vertex_count + i;
        *find_slot(s, s->split->corners[vertex]) = vertex;
    }
    mt_free(s->context, old);
    return MT_OK;
}

static mt_status grow_extra(splitter *s)
{
    uint64_t capacity = 2 * (uint64_t)s->extra_capacity + FIRST_CAPACITY;
    if (!mt_count_fits((uint64_t)s->mesh->vertex_count + capacity)) {
        return mt_fail(s->context, MT_ERROR_TOO_LARGE, "splitting vertices makes more of them than can be held");
    }
    mt_index *sources = mt_reallocate(s->context, s->split->sources, capacity * sizeof *sources);
    if (!sources) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->split->sources = sources;
    mt_index *corners =
        mt_reallocate(s->context, s->split->corners, (s->mesh->vertex_count + capacity) * sizeof *corners);
    if (!corners) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    s->split->corners = corners;
    s->extra_capacity = (mt_index)capacity;
    return MT_OK;
}

/* Another value at a vertex: one that was split off before, or a new one. */
static mt_status take_other(splitter *s, mt_index corner, mt_index *out)
{
    mt_index extra = s->split->vertex_count - s->mesh->vertex_count;
    mt_status status = 2 * ((uint64_t)extra + 1) > s->slot_capacity ? grow_slots(s) : MT_OK;
    if (status == MT_OK && extra == s->extra_capacity) {
        status = grow_extra(s);
    }
    if (status != MT_OK) {
        return status;
    }
    mt_index *slot = find_slot(s, corner);
    if (*slot == FREE_SLOT) {
        *slot = s->split->vertex_count++;
        s->split->sources[extra] = s->mesh->corner_vertices[corner];
        s->split->corners[*slot] = corner;
    }
    *out = *slot;
    return MT_OK;
}

static mt_status split_corners(splitter *s)
{
    const mt_mesh *mesh = s->mesh;
    mt_gltf_split *split = s->split;
    mt_status status = MT_OK;
    for (mt_index corner = 0; corner < mesh->corner_count && status == MT_OK; corner++) {
        mt_index vertex = mesh->corner_vertices[corner];
        if (split->corners[vertex] == MT_NONE) {
            split->corners[vertex] = corner;
        }
        if (same_values(s, split->corners[vertex], corner)) {
            split->corner_vertices[corner] = vertex;
        } else {
            status = take_other(s, corner, &split->corner_vertices[corner]);
        }
    }
    return status;
}

mt_status mt_gltf_split_make(mt_context *context, const mt_mesh *mesh, const mt_gltf_column *columns, size_t count,
                             mt_gltf_split *out)
{
    splitter s = {.context = context, .mesh = mesh, .split = out};
    *out = (mt_gltf_split){.vertex_count = mesh->vertex_count};
    for (size_t i = 0; i < count; i++) {
        if (columns[i].attribute->domain == MT_DOMAIN_CORNER) {
            s.columns[s.column_count++] = &columns[i];
        }
    }
    if (s.column_count == 0) {
        return MT_OK;
    }
    out->corners = mt_allocate_array(context, mesh->vertex_count, sizeof *out->corners);
    out->corner_vertices = mt_allocate_array(context, mesh->corner_count, sizeof *out->corner_vertices);
    mt_status status = out->corners && out->corner_vertices ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        memset(out->corners, 0xFF, mesh->vertex_count * sizeof *out->corners);
        status = split_corners(&s);
    }
    mt_free(context, s.slots);
    if (status != MT_OK) {
        mt_gltf_split_release(context, out);
    }
    return status;
}

void mt_gltf_split_release(mt_context *context, mt_gltf_split *split)
{
    mt_free(context, split->sources);
    mt_free(context, split->corners);
    mt_free(context, split->corner_vertices);
    *split = (mt_gltf_split){0};
}
