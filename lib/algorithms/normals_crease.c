/* Corners around a vertex hang together across the neighbours that they share: sorted by neighbour, those of one edge
 * stand side by side and are joined. Then each corner sums the terms of those in its fan whose unit normals lie within
 * the crease angle of its own; where all do, once for all.
 *
 * Cost: n log n to find the fans, n^2 comparisons for n corners up to MT_CREASE_PAIRS_MAXIMUM, beyond it those of
 * mt_crease_sum_many. */
#include "lib/algorithms/normals_crease.h"

#include <string.h>

bool mt_crease_star_init(mt_context *context, mt_index most, mt_crease_star *star)
{
    *star = (mt_crease_star){0};
    star->corners = mt_try_allocate(context, (uint64_t)most * sizeof *star->corners);
    star->entries = mt_try_allocate(context, 2 * (uint64_t)most * sizeof *star->entries);
    star->spare = mt_try_allocate(context, 2 * (uint64_t)most * sizeof *star->spare);
    if (most > MT_CREASE_PAIRS_MAXIMUM) {
        star->nodes = mt_try_allocate(context, (uint64_t)most * sizeof *star->nodes);
    }
    return star->corners && star->entries && star->spare && (star->nodes || most <= MT_CREASE_PAIRS_MAXIMUM);
}

void mt_crease_star_release(mt_context *context, mt_crease_star *star)
{
    mt_free(context, star->corners);
    mt_free(context, star->entries);
    mt_free(context, star->spare);
    mt_free(context, star->nodes);
}

/* Insertion for runs, then runs are merged pair by pair. */
#define RUN 16

static void sort_run(mt_sort_entry *entries, mt_index count)
{
    for (mt_index i = 1; i < count; i++) {
        mt_sort_entry entry = entries[i];
        mt_index at = i;
        for (; at > 0 && entries[at - 1].key > entry.key; at--) {
            entries[at] = entries[at - 1];
        }
        entries[at] = entry;
    }
}

static void merge(const mt_sort_entry *from, mt_index middle, mt_index count, mt_sort_entry *to)
{
    mt_index left = 0, right = middle;
    for (mt_index i = 0; i < count; i++) {
        bool take_left = left < middle && (right == count || from[left].key <= from[right].key);
        to[i] = take_left ? from[left++] : from[right++];
    }
}

void mt_sort_entries(mt_sort_entry *entries, mt_sort_entry *spare, mt_index count)
{
    for (uint64_t begin = 0; begin < count; begin += RUN) {
        sort_run(entries + begin, count - begin < RUN ? (mt_index)(count - begin) : RUN);
    }
    for (uint64_t width = RUN; width < count; width *= 2) {
        for (uint64_t begin = 0; begin < count; begin += 2 * width) {
            uint64_t rest = count - begin;
            mt_index whole = (mt_index)(rest < 2 * width ? rest : 2 * width);
            mt_index middle = (mt_index)(rest < width ? rest : width);
            merge(entries + begin, middle, whole, spare + begin);
        }
        memcpy(entries, spare, count * sizeof *entries);
    }
}

/* Union-find over one of the two kinds of sets. */
typedef mt_index *(*set_member)(mt_crease_corner *corner);

static mt_index *fan_of(mt_crease_corner *corner)
{
    return &corner->fan;
}

static mt_index *patch_of(mt_crease_corner *corner)
{
    return &corner->patch;
}

static mt_index find_root(mt_crease_star *star, set_member set, mt_index i)
{
    for (;;) {
        mt_index *parent = set(&star->corners[i]);
        if (*parent == i) {
            return i;
        }
        *parent = *set(&star->corners[*parent]);
        i = *parent;
    }
}

static void join(mt_crease_star *star, set_member set, mt_index a, mt_index b)
{
    mt_index low = find_root(star, set, a), high = find_root(star, set, b);
    *set(&star->corners[low < high ? high : low]) = low < high ? low : high;
}

static bool is_smooth(const mt_crease_star *star, mt_index a, mt_index b)
{
    return mt_symmetric_dot(star->corners[a].unit, star->corners[b].unit) > star->limit;
}

/* Each corner with its two neighbours; a side from the vertex to itself is none. */
static mt_index list_neighbors(mt_crease_star *star, const mt_normal_rings *rings, mt_index vertex)
{
    mt_index count = 0;
    for (mt_index i = 0; i < star->count; i++) {
        const mt_crease_corner *own = &star->corners[i];
        const mt_index sides[2] = {mt_ring_next(rings, own->corner, own->face),
                                   mt_ring_previous(rings, own->corner, own->face)};
        for (int side = 0; side < 2; side++) {
            mt_index neighbor = rings->mesh->corner_vertices[sides[side]];
            if (neighbor != vertex) {
                star->entries[count++] = (mt_sort_entry){neighbor, i};
            }
        }
    }
    return count;
}

static void join_neighbors(mt_crease_star *star, mt_index entry_count)
{
    mt_sort_entries(star->entries, star->spare, entry_count);
    const mt_sort_entry *entries = star->entries;
    for (mt_index i = 1; i < entry_count; i++) {
        if (entries[i].key != entries[i - 1].key) {
            continue;
        }
        mt_index a = entries[i - 1].index, b = entries[i].index;
        join(star, fan_of, a, b);
        bool third_before = i >= 2 && entries[i - 2].key == entries[i].key;
        bool third_after = i + 1 < entry_count && entries[i + 1].key == entries[i].key;
        if (star->reachable_only && !third_before && !third_after && is_smooth(star, a, b)) {
            join(star, patch_of, a, b);
        }
    }
}

/* A face that names the vertex several times holds its corners there together. */
static void join_faces(mt_crease_star *star)
{
    for (mt_index i = 1; i < star->count; i++) {
        if (star->corners[i].face == star->corners[i - 1].face) {
            join(star, fan_of, i, i - 1);
            join(star, patch_of, i, i - 1);
        }
    }
}

static void gather(mt_crease_star *star, const mt_normal_rings *rings, mt_index vertex)
{
    mt_index begin = rings->begins[vertex];
    star->count = rings->begins[vertex + 1] - begin;
    for (mt_index i = 0; i < star->count; i++) {
        mt_index corner = rings->corners[begin + i], face = mt_ring_face(rings, corner);
        star->corners[i] = (mt_crease_corner){.term = mt_corner_term(rings, corner),
                                              .unit = rings->units[face],
                                              .corner = corner,
                                              .face = face,
                                              .fan = i,
                                              .patch = i};
    }
}

static void find_sets(mt_crease_star *star, const mt_normal_rings *rings, mt_index vertex)
{
    join_neighbors(star, list_neighbors(star, rings, vertex));
    join_faces(star);
    for (mt_index i = 0; i < star->count; i++) {
        star->corners[i].fan = find_root(star, fan_of, i);
        star->corners[i].patch = star->reachable_only ? find_root(star, patch_of, i) : star->corners[i].fan;
    }
}

static bool is_all_smooth(const mt_crease_star *star)
{
    for (mt_index i = 0; i < star->count; i++) {
        if (star->corners[i].patch != 0 || mt_vector_is_zero(star->corners[i].unit)) {
            return false;
        }
        for (mt_index j = 0; j < i; j++) {
            if (!is_smooth(star, i, j)) {
                return false;
            }
        }
    }
    return true;
}

static void sum_fans(mt_crease_star *star)
{
    for (mt_index i = 0; i < star->count; i++) {
        mt_add_term(&star->corners[star->corners[i].fan].fan_sum, star->corners[i].term);
    }
}

static mt_vec3 sum_smooth(const mt_crease_star *star, mt_index i)
{
    mt_scaled_vector sum = {{0, 0, 0}, 0};
    for (mt_index j = 0; j < star->count; j++) {
        if (j == i || (star->corners[j].patch == star->corners[i].patch && is_smooth(star, i, j))) {
            mt_add_term(&sum, star->corners[j].term);
        }
    }
    return mt_unit_vector(sum.vector);
}

static mt_vec3 fan_normal(const mt_crease_star *star, mt_index i)
{
    return mt_unit_vector(star->corners[star->corners[i].fan].fan_sum.vector);
}

/* Corners whose face has no direction to compare take their fan's sum. */
static void fill_undirected(mt_crease_star *star)
{
    bool summed = false;
    for (mt_index i = 0; i < star->count; i++) {
        if (!mt_vector_is_zero(star->corners[i].unit)) {
            continue;
        }
        if (!summed) {
            sum_fans(star);
            summed = true;
        }
        star->corners[i].normal = fan_normal(star, i);
    }
}

static void solve_pairs(mt_crease_star *star)
{
    if (star->count > 0 && is_all_smooth(star)) {
        sum_fans(star);
        mt_vec3 normal = fan_normal(star, 0);
        for (mt_index i = 0; i < star->count; i++) {
            star->corners[i].normal = normal;
        }
        return;
    }
    for (mt_index i = 0; i < star->count; i++) {
        star->corners[i].normal = sum_smooth(star, i);
    }
    fill_undirected(star);
}

/* Patch by patch, without the corners that have no direction. */
static void solve_many(mt_crease_star *star)
{
    mt_index count = 0;
    for (mt_index i = 0; i < star->count; i++) {
        if (!mt_vector_is_zero(star->corners[i].unit)) {
            star->entries[count++] = (mt_sort_entry){star->corners[i].patch, i};
        }
    }
    mt_sort_entries(star->entries, star->spare, count);
    for (mt_index begin = 0, end = 0; begin < count; begin = end) {
        mt_index patch = star->corners[star->entries[begin].index].patch;
        while (end < count && star->corners[star->entries[end].index].patch == patch) {
            end++;
        }
        mt_crease_sum_many(star, star->entries + begin, end - begin);
    }
    fill_undirected(star);
}

void mt_crease_star_solve(mt_crease_star *star, const mt_normal_rings *rings, mt_index vertex)
{
    gather(star, rings, vertex);
    find_sets(star, rings, vertex);
    if (star->count <= MT_CREASE_PAIRS_MAXIMUM) {
        solve_pairs(star);
    } else {
        solve_many(star);
    }
}
