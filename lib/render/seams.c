/* Meshes are often cut along seams, where the texture or the patch ends: two vertices at one place, each with half
 * of the faces. Shaded apart they show a line that the surface does not have. Only vertices whose faces do not close
 * around them are compared, so a closed mesh costs nothing.
 *
 * Cost: linear in the open vertices, by hashing their positions. */
#include "lib/render/corner_normals.h"

#include <meshtool/checked.h>

#include <string.h>

static uint64_t bits_of(double x)
{
    uint64_t bits;
    x += 0.0; /* -0 becomes +0 */
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static uint64_t hash_of(mt_vec3 p)
{
    const uint64_t odd = 0x9E3779B97F4A7C15u;
    uint64_t h = bits_of(p.x) * odd;
    h = ((h ^ (h >> 32)) + bits_of(p.y)) * odd;
    h = ((h ^ (h >> 32)) + bits_of(p.z)) * odd;
    return h ^ (h >> 29);
}

static bool same_place(mt_vec3 a, mt_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The first vertex met at the place of this one: itself when there was none. */
static mt_index first_at(const mt_mesh *mesh, mt_index *table, uint64_t mask, mt_index vertex)
{
    mt_vec3 p = mt_mesh_position(mesh, vertex);
    uint64_t slot = hash_of(p) & mask;
    while (table[slot] != MT_NONE && !same_place(mt_mesh_position(mesh, table[slot]), p)) {
        slot = (slot + 1) & mask;
    }
    if (table[slot] == MT_NONE) {
        table[slot] = vertex;
    }
    return table[slot];
}

/* Pairs of vertices at one place, handed to `join` when it is not NULL. Returns how many there are. */
static mt_index find_pairs(const mt_mesh *mesh, const uint32_t *open, mt_index *table, uint64_t mask, mt_index *joined)
{
    mt_index pairs = 0;
    memset(table, 0xff, (mask + 1) * sizeof *table);
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        if (open[vertex] == 0) {
            continue;
        }
        mt_index first = first_at(mesh, table, mask, vertex);
        pairs += first != vertex;
        if (joined) {
            joined[vertex] = first;
        }
    }
    return pairs;
}

static mt_status allocate_joined(mt_context *context, mt_corner_normals *normals)
{
    mt_index vertex_count = normals->model->mesh->vertex_count;
    normals->joined = (mt_index *)mt_allocate_array(context, vertex_count, sizeof(mt_index));
    if (!normals->joined) {
        return mt_context_error(context)->status;
    }
    for (mt_index vertex = 0; vertex < vertex_count; vertex++) {
        normals->joined[vertex] = vertex;
    }
    return MT_OK;
}

mt_status mt_join_seams(mt_context *context, mt_corner_normals *normals, const uint32_t *open)
{
    const mt_mesh *mesh = normals->model->mesh;
    uint64_t open_count = 0, size = 2;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        open_count += open[vertex] != 0;
    }
    if (open_count == 0) {
        return MT_OK;
    }
    while (size < 2 * open_count) {
        size *= 2;
    }
    mt_index *table = (mt_index *)mt_allocate_array(context, size, sizeof *table);
    if (!table) {
        return mt_context_error(context)->status;
    }
    mt_status status = MT_OK;
    if (find_pairs(mesh, open, table, size - 1, NULL) > 0) {
        status = allocate_joined(context, normals);
        if (status == MT_OK) {
            find_pairs(mesh, open, table, size - 1, normals->joined);
        }
    }
    mt_free(context, table);
    return status;
}
