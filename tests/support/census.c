#include "tests/support/census.h"

#include "tests/support/unit.h"

#include <stdlib.h>
#include <string.h>

typedef struct face_side {
    mt_index low, high, face, corner; /* the edge, and the corner where its side begins */
    bool reversed;
} face_side;

static int compare_sides(const void *a, const void *b)
{
    const face_side *p = a, *q = b;
    if (p->low != q->low) {
        return p->low < q->low ? -1 : 1;
    }
    return (p->high > q->high) - (p->high < q->high);
}

static face_side *sorted_sides(const mt_mesh *mesh, size_t *count)
{
    face_side *sides = malloc((mesh->corner_count + 1) * sizeof *sides);
    assert_non_null(sides);
    *count = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index a = mesh->corner_vertices[corner];
            mt_index b = mesh->corner_vertices[corner + 1 < end ? corner + 1 : begin];
            if (a != b) {
                sides[(*count)++] = (face_side){a < b ? a : b, a < b ? b : a, face, corner, a > b};
            }
        }
    }
    qsort(sides, *count, sizeof *sides, compare_sides);
    return sides;
}

/* Sets that are joined, each known by its lowest member. */
static mt_index *make_sets(size_t count)
{
    mt_index *sets = malloc((count + 1) * sizeof *sets);
    assert_non_null(sets);
    for (size_t i = 0; i < count; i++) {
        sets[i] = (mt_index)i;
    }
    return sets;
}

static mt_index set_of(mt_index *sets, mt_index i)
{
    while (sets[i] != i) {
        sets[i] = sets[sets[i]];
        i = sets[i];
    }
    return i;
}

static void join(mt_index *sets, mt_index a, mt_index b)
{
    a = set_of(sets, a);
    b = set_of(sets, b);
    sets[a > b ? a : b] = a > b ? b : a;
}

static mt_index other_corner(const mt_mesh *mesh, const face_side *side)
{
    mt_index begin = mt_mesh_face_begin(mesh, side->face), end = mt_mesh_face_end(mesh, side->face);
    return side->corner + 1 < end ? side->corner + 1 : begin;
}

/* Joins the corners at both ends of an edge, and the faces, across it. */
static void join_across(const mt_mesh *mesh, const face_side *a, const face_side *b, mt_index *corners, mt_index *faces)
{
    mt_index a_low = a->reversed ? other_corner(mesh, a) : a->corner;
    mt_index a_high = a->reversed ? a->corner : other_corner(mesh, a);
    join(corners, a_low, b->reversed ? other_corner(mesh, b) : b->corner);
    join(corners, a_high, b->reversed ? b->corner : other_corner(mesh, b));
    join(faces, a->face, b->face);
}

static void count_edges(const mt_mesh *mesh, test_census *census, mt_index *corners, mt_index *faces, mt_index *rims,
                        bool *on_rim)
{
    size_t count;
    face_side *sides = sorted_sides(mesh, &count);
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && compare_sides(&sides[i], &sides[end]) == 0; end++) {
            join_across(mesh, &sides[i], &sides[end], corners, faces);
        }
        census->edges++;
        census->non_manifold_edges += end - i > 2;
        census->misoriented_edges += end - i == 2 && sides[i].reversed == sides[i + 1].reversed;
        if (end - i == 1) {
            census->boundary_edges++;
            join(rims, sides[i].low, sides[i].high);
            on_rim[sides[i].low] = on_rim[sides[i].high] = true;
        }
    }
    free(sides);
}

static bool is_degenerate(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    if (end - begin > 16) { /* large polygons are looked at by their neighbours only */
        for (mt_index i = begin + 1; i < end; i++) {
            if (mesh->corner_vertices[i] == mesh->corner_vertices[i - 1]) {
                return true;
            }
        }
        return false;
    }
    for (mt_index i = begin; i < end; i++) {
        for (mt_index j = i + 1; j < end; j++) {
            if (mesh->corner_vertices[i] == mesh->corner_vertices[j]) {
                return true;
            }
        }
    }
    return false;
}

/* A face that names a vertex more than once is one face at that vertex all the same. */
static void join_within_faces(const mt_mesh *mesh, mt_index *corners)
{
    mt_index *last = malloc((mesh->vertex_count + 1) * sizeof *last);
    assert_non_null(last);
    memset(last, 0xff, mesh->vertex_count * sizeof *last);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        for (mt_index corner = begin; corner < end; corner++) {
            mt_index *before = &last[mesh->corner_vertices[corner]];
            if (*before != MT_NONE && *before >= begin) {
                join(corners, *before, corner);
            }
            *before = corner;
        }
    }
    free(last);
}

/* Vertices whose corners form more than one set, and those that have none. */
static void count_vertices(const mt_mesh *mesh, test_census *census, mt_index *corners)
{
    mt_index *first = malloc((mesh->vertex_count + 1) * sizeof *first);
    bool *split = calloc(mesh->vertex_count + 1, sizeof *split);
    assert_true(first && split);
    memset(first, 0xff, mesh->vertex_count * sizeof *first);
    for (mt_index corner = 0; corner < mesh->corner_count; corner++) {
        mt_index vertex = mesh->corner_vertices[corner], set = set_of(corners, corner);
        split[vertex] = split[vertex] || (first[vertex] != MT_NONE && first[vertex] != set);
        first[vertex] = first[vertex] == MT_NONE ? set : first[vertex];
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        census->isolated_vertices += first[vertex] == MT_NONE;
        census->non_manifold_vertices += split[vertex];
    }
    free(first);
    free(split);
}

static double volume_of(const mt_mesh *mesh)
{
    double volume = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
        mt_vec3 a = mt_mesh_position(mesh, mesh->corner_vertices[begin]);
        for (mt_index corner = begin + 1; corner + 1 < end; corner++) {
            mt_vec3 b = mt_mesh_position(mesh, mesh->corner_vertices[corner]);
            mt_vec3 c = mt_mesh_position(mesh, mesh->corner_vertices[corner + 1]);
            volume += mt_vec3_dot(a, mt_vec3_cross(b, c)) / 6;
        }
    }
    return volume;
}

test_census test_census_of(const mt_mesh *mesh)
{
    test_census census = {.vertices = mesh->vertex_count, .faces = mesh->face_count};
    mt_index *corners = make_sets(mesh->corner_count), *faces = make_sets(mesh->face_count);
    mt_index *rims = make_sets(mesh->vertex_count);
    bool *on_rim = calloc(mesh->vertex_count + 1, sizeof *on_rim);
    assert_non_null(on_rim);
    count_edges(mesh, &census, corners, faces, rims, on_rim);
    join_within_faces(mesh, corners);
    count_vertices(mesh, &census, corners);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        census.components += set_of(faces, face) == face;
        census.degenerate_faces += is_degenerate(mesh, face);
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        census.boundary_loops += on_rim[vertex] && set_of(rims, vertex) == vertex;
    }
    census.euler_characteristic =
        (int64_t)census.vertices - (int64_t)census.isolated_vertices - (int64_t)census.edges + (int64_t)census.faces;
    census.volume = volume_of(mesh);
    free(corners);
    free(faces);
    free(rims);
    free(on_rim);
    return census;
}
