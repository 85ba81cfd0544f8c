/* Sources: Catmull and Clark 1978, with (F + 2R + (n-3)P)/n for vertices and cubic B-splines for boundaries; the limit
 * mask of Halstead, Kass and DeRose, "Efficient, Fair Interpolation using Catmull-Clark Surfaces", SIGGRAPH 93. */
#include "tradeoff/reference_surface.h"

#include <stdlib.h>
#include <string.h>

/* A side of a face; two of one edge are neighbours in the sorted list. */
typedef struct side {
    uint32_t low, high, corner;
} side;

typedef struct sums {
    quad3 faces, edges, boundary; /* of face points, midpoints, and neighbours along the boundary */
    uint32_t face_count, edge_count, boundary_count;
} sums;

typedef struct refinement {
    const reference_surface *from;
    reference_surface *to;
    side *sides;
    uint32_t *edge_of_corner;
    uint32_t edge_count;
    sums *around;
} refinement;

static mt_status allocate(mt_context *context, uint32_t vertices, uint32_t faces, uint32_t corners,
                          reference_surface *out)
{
    *out = (reference_surface){.vertex_count = vertices, .face_count = faces, .corner_count = corners};
    out->positions = mt_allocate_array(context, vertices, sizeof *out->positions);
    out->offsets = mt_allocate_array(context, (uint64_t)faces + 1, sizeof *out->offsets);
    out->corners = mt_allocate_array(context, corners, sizeof *out->corners);
    return out->positions && out->offsets && out->corners ? MT_OK : MT_ERROR_OUT_OF_MEMORY;
}

void reference_surface_release(mt_context *context, reference_surface *surface)
{
    mt_free(context, surface->positions);
    mt_free(context, surface->offsets);
    mt_free(context, surface->corners);
    memset(surface, 0, sizeof *surface);
}

mt_status reference_surface_make(mt_context *context, const mt_mesh *mesh, reference_surface *out)
{
    mt_status status = allocate(context, mesh->vertex_count, mesh->face_count, mesh->corner_count, out);
    if (status != MT_OK) {
        reference_surface_release(context, out);
        return status;
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        out->positions[vertex] = quad3_from(mt_mesh_position(mesh, vertex));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        out->offsets[face] = mt_mesh_face_begin(mesh, face);
    }
    out->offsets[mesh->face_count] = mesh->corner_count;
    memcpy(out->corners, mesh->corner_vertices, mesh->corner_count * sizeof *out->corners);
    return MT_OK;
}

static uint32_t next_corner(const reference_surface *s, uint32_t face, uint32_t corner)
{
    return corner + 1 < s->offsets[face + 1] ? corner + 1 : s->offsets[face];
}

static uint32_t previous_corner(const reference_surface *s, uint32_t face, uint32_t corner)
{
    return corner > s->offsets[face] ? corner - 1 : s->offsets[face + 1] - 1;
}

static int compare_sides(const void *left, const void *right)
{
    const side *a = left, *b = right;
    if (a->low != b->low) {
        return a->low < b->low ? -1 : 1;
    }
    if (a->high != b->high) {
        return a->high < b->high ? -1 : 1;
    }
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static void list_sides(refinement *r)
{
    const reference_surface *s = r->from;
    for (uint32_t face = 0; face < s->face_count; face++) {
        for (uint32_t corner = s->offsets[face]; corner < s->offsets[face + 1]; corner++) {
            uint32_t a = s->corners[corner], b = s->corners[next_corner(s, face, corner)];
            r->sides[corner] = (side){a < b ? a : b, a < b ? b : a, corner};
        }
    }
    qsort(r->sides, s->corner_count, sizeof *r->sides, compare_sides);
}

static bool is_same_edge(const refinement *r, uint32_t i, uint32_t j)
{
    return j < r->from->corner_count && r->sides[i].low == r->sides[j].low && r->sides[i].high == r->sides[j].high;
}

/* Edges are numbered by their first corners. */
static void number_edges(refinement *r)
{
    for (uint32_t i = 0; i < r->from->corner_count; i++) {
        r->edge_of_corner[r->sides[i].corner] = MT_NONE;
    }
    for (uint32_t i = 0, count = 0; i < r->from->corner_count; i += count) {
        count = is_same_edge(r, i, i + 1) ? 2 : 1;
        r->edge_of_corner[r->sides[i].corner] = 0;
    }
    r->edge_count = 0;
    for (uint32_t corner = 0; corner < r->from->corner_count; corner++) {
        if (r->edge_of_corner[corner] == 0) {
            r->edge_of_corner[corner] = r->edge_count++;
        }
    }
    for (uint32_t i = 0; i < r->from->corner_count; i++) {
        if (is_same_edge(r, i, i + 1)) {
            r->edge_of_corner[r->sides[i + 1].corner] = r->edge_of_corner[r->sides[i].corner];
        }
    }
}

static mt_status find_edges(mt_context *context, refinement *r)
{
    r->sides = mt_allocate_array(context, r->from->corner_count, sizeof *r->sides);
    r->edge_of_corner = mt_allocate_array(context, r->from->corner_count, sizeof *r->edge_of_corner);
    r->around = mt_allocate_array_zeroed(context, r->from->vertex_count, sizeof *r->around);
    if (!r->sides || !r->edge_of_corner || !r->around) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    list_sides(r);
    number_edges(r);
    return MT_OK;
}

static void release_edges(mt_context *context, refinement *r)
{
    mt_free(context, r->sides);
    mt_free(context, r->edge_of_corner);
    mt_free(context, r->around);
}

static void place_face_points(const refinement *r)
{
    const reference_surface *s = r->from;
    for (uint32_t face = 0; face < s->face_count; face++) {
        quad3 sum = {0, 0, 0};
        for (uint32_t corner = s->offsets[face]; corner < s->offsets[face + 1]; corner++) {
            sum = quad3_add(sum, s->positions[s->corners[corner]]);
        }
        quad3 point = quad3_scale(sum, (quad)1 / (s->offsets[face + 1] - s->offsets[face]));
        r->to->positions[s->vertex_count + face] = point;
        for (uint32_t corner = s->offsets[face]; corner < s->offsets[face + 1]; corner++) {
            sums *around = &r->around[s->corners[corner]];
            around->faces = quad3_add(around->faces, point);
            around->face_count++;
        }
    }
}

static uint32_t face_of(const reference_surface *s, uint32_t corner)
{
    uint32_t low = 0, high = s->face_count;
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if (s->offsets[middle] <= corner) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static void count_edge(sums *around, quad3 middle, quad3 neighbour, bool is_boundary)
{
    around->edges = quad3_add(around->edges, middle);
    around->edge_count++;
    if (is_boundary) {
        around->boundary = quad3_add(around->boundary, neighbour);
        around->boundary_count++;
    }
}

static void place_edge_points(const refinement *r)
{
    const reference_surface *s = r->from;
    for (uint32_t i = 0, count = 0; i < s->corner_count; i += count) {
        count = is_same_edge(r, i, i + 1) ? 2 : 1;
        quad3 a = s->positions[r->sides[i].low], b = s->positions[r->sides[i].high];
        quad3 sum = quad3_add(a, b), middle = quad3_scale(sum, (quad)0.5), point = middle;
        if (count == 2) {
            for (uint32_t k = 0; k < 2; k++) {
                sum = quad3_add(sum, r->to->positions[s->vertex_count + face_of(s, r->sides[i + k].corner)]);
            }
            point = quad3_scale(sum, (quad)0.25);
        }
        r->to->positions[s->vertex_count + s->face_count + r->edge_of_corner[r->sides[i].corner]] = point;
        count_edge(&r->around[r->sides[i].low], middle, b, count == 1);
        count_edge(&r->around[r->sides[i].high], middle, a, count == 1);
    }
}

static quad3 moved_vertex(const sums *around, quad3 p)
{
    if (around->face_count == 0) {
        return p;
    }
    if (around->boundary_count > 0) {
        return quad3_add(quad3_scale(p, (quad)0.75), quad3_scale(around->boundary, (quad)0.125));
    }
    quad n = around->face_count;
    quad3 faces = quad3_scale(around->faces, 1 / n), edges = quad3_scale(around->edges, 2 / (quad)around->edge_count);
    return quad3_scale(quad3_add(quad3_add(faces, edges), quad3_scale(p, n - 3)), 1 / n);
}

static void list_faces(const refinement *r)
{
    const reference_surface *s = r->from;
    for (uint32_t face = 0; face < s->face_count; face++) {
        for (uint32_t corner = s->offsets[face]; corner < s->offsets[face + 1]; corner++) {
            uint32_t *child = r->to->corners + 4 * (size_t)corner, edges = s->vertex_count + s->face_count;
            r->to->offsets[corner] = 4 * corner;
            child[0] = s->corners[corner];
            child[1] = edges + r->edge_of_corner[corner];
            child[2] = s->vertex_count + face;
            child[3] = edges + r->edge_of_corner[previous_corner(s, face, corner)];
        }
    }
    r->to->offsets[s->corner_count] = 4 * s->corner_count;
}

mt_status reference_surface_refine(mt_context *context, const reference_surface *surface, reference_surface *out)
{
    refinement r = {.from = surface, .to = out};
    memset(out, 0, sizeof *out);
    mt_status status = find_edges(context, &r);
    if (status == MT_OK) {
        status = allocate(context, surface->vertex_count + surface->face_count + r.edge_count, surface->corner_count,
                          4 * surface->corner_count, out);
    }
    if (status == MT_OK) {
        place_face_points(&r);
        place_edge_points(&r);
        for (uint32_t vertex = 0; vertex < surface->vertex_count; vertex++) {
            out->positions[vertex] = moved_vertex(&r.around[vertex], surface->positions[vertex]);
        }
        list_faces(&r);
    } else {
        reference_surface_release(context, out);
    }
    release_edges(context, &r);
    return status;
}

/* (n^2 v + 4 sum of neighbours + sum of the corners opposite) / (n (n + 5)); on boundaries (1, 4, 1) / 6. */
static quad3 limit_vertex(const sums *around, quad3 p)
{
    if (around->face_count == 0) {
        return p;
    }
    if (around->boundary_count > 0) {
        return quad3_scale(quad3_add(quad3_scale(p, 4), around->boundary), (quad)1 / 6);
    }
    quad n = around->face_count;
    /* Midpoints are half of p and the neighbour each. */
    quad3 neighbours = quad3_subtract(quad3_scale(around->edges, 2), quad3_scale(p, n));
    quad3 sum = quad3_add(quad3_scale(p, n * n), quad3_add(quad3_scale(neighbours, 4), around->faces));
    return quad3_scale(sum, 1 / (n * (n + 5)));
}

mt_status reference_surface_to_limit(mt_context *context, reference_surface *surface)
{
    refinement r = {.from = surface};
    mt_status status = find_edges(context, &r);
    for (uint32_t corner = 0; status == MT_OK && corner < surface->corner_count; corner++) {
        sums *around = &r.around[surface->corners[corner]]; /* `faces` sums the corners opposite */
        uint32_t opposite = surface->corners[corner / 4 * 4 + (corner + 2) % 4];
        around->faces = quad3_add(around->faces, surface->positions[opposite]);
        around->face_count++;
    }
    for (uint32_t i = 0, count = 0; status == MT_OK && i < surface->corner_count; i += count) {
        count = is_same_edge(&r, i, i + 1) ? 2 : 1;
        uint32_t low = r.sides[i].low, high = r.sides[i].high;
        quad3 a = surface->positions[low], b = surface->positions[high];
        quad3 middle = quad3_scale(quad3_add(a, b), (quad)0.5);
        count_edge(&r.around[low], middle, b, count == 1);
        count_edge(&r.around[high], middle, a, count == 1);
    }
    for (uint32_t vertex = 0; status == MT_OK && vertex < surface->vertex_count; vertex++) {
        surface->positions[vertex] = limit_vertex(&r.around[vertex], surface->positions[vertex]);
    }
    release_edges(context, &r);
    return status;
}

mt_status reference_surface_mesh(mt_context *context, const reference_surface *surface, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = surface->vertex_count,
                             .face_count = surface->face_count,
                             .corner_count = surface->corner_count,
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    for (uint32_t vertex = 0; vertex < surface->vertex_count; vertex++) {
        mt_mesh_set_position(*out, vertex, quad3_round(surface->positions[vertex]));
    }
    memcpy((*out)->face_offsets, surface->offsets, ((size_t)surface->face_count + 1) * sizeof *surface->offsets);
    memcpy((*out)->corner_vertices, surface->corners, surface->corner_count * sizeof *surface->corners);
    mt_mesh_compact_faces(context, *out);
    return MT_OK;
}

mt_status tradeoff_bare_mesh(mt_context *context, const mt_mesh *mesh, mt_type type, mt_mesh **out)
{
    mt_mesh_layout layout = {.vertex_count = mesh->vertex_count,
                             .face_count = mesh->face_count,
                             .corner_count = mesh->corner_count,
                             .position_type = type};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        mt_mesh_set_position(*out, vertex, mt_mesh_position(mesh, vertex));
    }
    for (mt_index face = 0; face < mesh->face_count; face++) {
        (*out)->face_offsets[face] = mt_mesh_face_begin(mesh, face);
    }
    (*out)->face_offsets[mesh->face_count] = mesh->corner_count;
    memcpy((*out)->corner_vertices, mesh->corner_vertices, mesh->corner_count * sizeof *mesh->corner_vertices);
    mt_mesh_compact_faces(context, *out);
    return MT_OK;
}
