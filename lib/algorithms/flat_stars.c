/* Which vertices have a star that covers a disc once.
 *
 * Seen along a coordinate axis, let all triangles of a star turn the same way, each certainly by an area. Then each
 * covers a sector of less than half a turn. If besides every edge that leaves the vertex begins as many sectors as it
 * ends, all directions are covered by the same number of sectors, and one ray tells that number. Where it is 1, the
 * sectors have nothing in common but edges that are shared (a sector that begins on the ray of another edge than the
 * one that ends there would be covered twice), so their triangles meet in what they share and nowhere else.
 *
 * Stars of more than STAR_CAPACITY triangles, open ones and those that bend too much are not flat: nothing follows. */
#include "lib/algorithms/flat_stars.h"

#include <meshtool/context.h>

#include <string.h>

#define STAR_CAPACITY 16

/* What a triangle is to its vertex: it goes from the edge to `begin` to the edge to `end`. */
typedef struct sector {
    mt_index begin, end;
} sector;

typedef struct star_search {
    const mt_mesh *mesh;
    const mt_triangulation *triangulation;
    const mt_vec3 *points;
    const uint8_t *facings;
    uint8_t *flat;       /* until it is judged: what all triangles of the star agree on */
    mt_index *star_ends; /* per vertex; a star begins where the one before it ends */
    sector *sectors;     /* star by star */
} star_search;

static void load_corners(const star_search *search, mt_index triangle, mt_index vertices[3])
{
    for (mt_index side = 0; side < 3; side++) {
        mt_index corner = mt_triangulation_corner(search->triangulation, triangle, side);
        vertices[side] = search->mesh->corner_vertices[corner];
    }
}

static void count_sectors(star_search *search)
{
    memset(search->flat, 0xff, search->mesh->vertex_count);
    for (mt_index triangle = 0; triangle < search->triangulation->triangle_count; triangle++) {
        mt_index vertices[3];
        load_corners(search, triangle, vertices);
        for (int side = 0; side < 3; side++) {
            search->star_ends[vertices[side]]++;
            search->flat[vertices[side]] &= search->facings[triangle];
        }
    }
}

/* Counts become the stars' beginnings, which move to their ends as they are filled. */
static void fill_stars(star_search *search)
{
    mt_index at = 0;
    for (mt_index vertex = 0; vertex < search->mesh->vertex_count; vertex++) {
        mt_index count = search->star_ends[vertex];
        search->star_ends[vertex] = at;
        at += count;
    }
    for (mt_index triangle = 0; triangle < search->triangulation->triangle_count; triangle++) {
        mt_index v[3];
        load_corners(search, triangle, v);
        search->sectors[search->star_ends[v[0]]++] = (sector){v[1], v[2]};
        search->sectors[search->star_ends[v[1]]++] = (sector){v[2], v[0]};
        search->sectors[search->star_ends[v[2]]++] = (sector){v[0], v[1]};
    }
}

/* Whether the edges that begin sectors are, one to one, those that end them. */
static bool is_closed(const sector *sectors, mt_index count)
{
    mt_index matches = 0;
    bool all_met = true;
    for (mt_index i = 0; i < count; i++) {
        mt_index begin_matches = 0, end_matches = 0;
        for (mt_index j = 0; j < count; j++) {
            begin_matches += sectors[i].begin == sectors[j].end;
            end_matches += sectors[i].end == sectors[j].begin;
        }
        all_met &= begin_matches && end_matches;
        matches += begin_matches;
    }
    return all_met && matches == count;
}

static double coordinate(mt_vec3 p, unsigned axis)
{
    const double all[3] = {p.x, p.y, p.z};
    return all[axis];
}

/* How many sectors hold one ray from the vertex, seen along an axis that all of them face: those that come up to it
 * from below. Comparisons of coordinates alone, thus exact. */
static mt_index count_at_ray(const star_search *search, mt_index vertex, const sector *sectors, mt_index count)
{
    static const unsigned upward[3] = {2, 0, 1};
    unsigned facing = search->flat[vertex], clockwise = !(facing & 7), seen = clockwise ? facing >> 3 : facing;
    unsigned up = upward[seen & 1 ? 0 : seen & 2 ? 1 : 2];
    double level = coordinate(search->points[vertex], up);
    mt_index rising = 0, falling = 0;
    for (mt_index i = 0; i < count; i++) {
        bool begins_below = coordinate(search->points[sectors[i].begin], up) < level;
        bool ends_below = coordinate(search->points[sectors[i].end], up) < level;
        rising += begins_below & !ends_below;
        falling += ends_below & !begins_below;
    }
    return clockwise ? falling : rising;
}

static void judge_stars(void *user, uint64_t begin, uint64_t end)
{
    const star_search *search = user;
    for (uint64_t vertex = begin; vertex < end; vertex++) {
        mt_index first = vertex ? search->star_ends[vertex - 1] : 0, count = search->star_ends[vertex] - first;
        const sector *sectors = &search->sectors[first];
        search->flat[vertex] = search->flat[vertex] && count && count <= STAR_CAPACITY &&
                               count_at_ray(search, (mt_index)vertex, sectors, count) == 1 && is_closed(sectors, count);
    }
}

mt_status mt_find_flat_stars(mt_context *context, const mt_mesh *mesh, const mt_triangulation *triangulation,
                             const mt_vec3 *points, const uint8_t *facings, uint8_t *flat)
{
    star_search search = {
        .mesh = mesh, .triangulation = triangulation, .points = points, .facings = facings, .flat = flat};
    uint64_t corner_count = 3 * (uint64_t)triangulation->triangle_count;
    if (corner_count > MT_NONE) { /* no numbers for so many */
        memset(flat, 0, mesh->vertex_count);
        return MT_OK;
    }
    search.star_ends = mt_allocate_array_zeroed(context, mesh->vertex_count, sizeof *search.star_ends);
    search.sectors = mt_allocate_array(context, corner_count, sizeof *search.sectors);
    mt_status status = search.star_ends && search.sectors ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
    if (status == MT_OK) {
        count_sectors(&search);
        fill_stars(&search);
        mt_parallel_for(context, mesh->vertex_count, 16384, judge_stars, &search);
    }
    mt_free(context, search.sectors);
    mt_free(context, search.star_ends);
    return status;
}
