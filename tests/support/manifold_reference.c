#include "tests/support/manifold_reference.h"
#include "tests/support/unit.h"

#include <meshtool/predicates.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static mt_index sides_of(const mt_mesh *mesh, mt_index face)
{
    return mt_mesh_face_sides(mesh, face);
}

/* The vertex of a face's corner i, counted around. */
static mt_index vertex_of(const mt_mesh *mesh, mt_index face, mt_index i)
{
    return mesh->corner_vertices[mt_mesh_face_begin(mesh, face) + i % sides_of(mesh, face)];
}

static bool names(const mt_mesh *mesh, mt_index face, mt_index vertex)
{
    for (mt_index i = 0; i < sides_of(mesh, face); i++) {
        if (vertex_of(mesh, face, i) == vertex) {
            return true;
        }
    }
    return false;
}

/* How many sides of the face run from a to b. */
static mt_index sides_from_to(const mt_mesh *mesh, mt_index face, mt_index a, mt_index b)
{
    mt_index count = 0;
    for (mt_index i = 0; a != b && i < sides_of(mesh, face); i++) {
        count += vertex_of(mesh, face, i) == a && vertex_of(mesh, face, i + 1) == b;
    }
    return count;
}

static bool has_edge(const mt_mesh *mesh, mt_index face, mt_index a, mt_index b)
{
    return sides_from_to(mesh, face, a, b) || sides_from_to(mesh, face, b, a);
}

static void count_sides(const mt_mesh *mesh, mt_index a, mt_index b, mt_index *forward, mt_index *backward)
{
    *forward = *backward = 0;
    for (mt_index face = 0; face < mesh->face_count; face++) {
        *forward += sides_from_to(mesh, face, a, b);
        *backward += sides_from_to(mesh, face, b, a);
    }
}

bool test_edge_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index a, mt_index b)
{
    mt_index forward, backward;
    count_sides(mesh, a, b, &forward, &backward);
    switch (kind) {
    case MT_DEFECT_BOUNDARY_EDGE:
        return forward + backward == 1;
    case MT_DEFECT_NON_MANIFOLD_EDGE:
        return forward + backward >= 3;
    case MT_DEFECT_MISORIENTED_EDGE:
        return forward + backward == 2 && forward != backward;
    default:
        return false;
    }
}

/* A set of faces for each face, joined until nothing changes. */
typedef struct face_sets {
    mt_index *set; /* MT_NONE: takes no part */
    mt_index count;
} face_sets;

static void merge(face_sets *sets, mt_index face_count, mt_index f, mt_index g)
{
    mt_index from = sets->set[f], to = sets->set[g];
    if (from == to) {
        return;
    }
    for (mt_index face = 0; face < face_count; face++) {
        sets->set[face] = sets->set[face] == from ? to : sets->set[face];
    }
    sets->count--;
}

/* Whether side i of face f touches the vertex, or any vertex, and is an edge of face g too. */
static bool shares_side(const mt_mesh *mesh, mt_index f, mt_index i, mt_index g, mt_index vertex)
{
    mt_index a = vertex_of(mesh, f, i), b = vertex_of(mesh, f, i + 1);
    return (vertex == MT_NONE || a == vertex || b == vertex) && has_edge(mesh, g, a, b);
}

/* Whether two faces share an edge at a vertex; MT_NONE: at any. */
static bool share_edge_at(const mt_mesh *mesh, mt_index f, mt_index g, mt_index vertex)
{
    for (mt_index i = 0; i < sides_of(mesh, f); i++) {
        if (shares_side(mesh, f, i, g, vertex)) {
            return true;
        }
    }
    return false;
}

static mt_index count_fans(const mt_mesh *mesh, mt_index vertex)
{
    face_sets sets = {malloc((mesh->face_count + (size_t)1) * sizeof(mt_index)), 0};
    for (mt_index face = 0; face < mesh->face_count; face++) {
        bool incident = names(mesh, face, vertex);
        sets.set[face] = incident ? face : MT_NONE;
        sets.count += incident;
    }
    for (mt_index f = 0; f < mesh->face_count; f++) {
        for (mt_index g = 0; g < f; g++) {
            if (sets.set[f] != MT_NONE && sets.set[g] != MT_NONE && share_edge_at(mesh, f, g, vertex)) {
                merge(&sets, mesh->face_count, f, g);
            }
        }
    }
    free(sets.set);
    return sets.count;
}

static mt_index count_boundary_ends(const mt_mesh *mesh, mt_index vertex)
{
    mt_index count = 0;
    for (mt_index other = 0; other < mesh->vertex_count; other++) {
        count += test_edge_is_defect(mesh, MT_DEFECT_BOUNDARY_EDGE, vertex, other);
    }
    return count;
}

bool test_vertex_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index vertex)
{
    switch (kind) {
    case MT_DEFECT_NON_FINITE_VERTEX:
        return !mt_vec3_is_finite(mt_mesh_position(mesh, vertex));
    case MT_DEFECT_NON_MANIFOLD_VERTEX:
        return count_fans(mesh, vertex) > 1;
    case MT_DEFECT_ISOLATED_VERTEX:
        return count_fans(mesh, vertex) == 0;
    case MT_DEFECT_BOUNDARY_PINCH:
        return count_boundary_ends(mesh, vertex) > 2;
    default:
        return false;
    }
}

static bool is_degenerate(const mt_mesh *mesh, mt_index face)
{
    for (mt_index i = 0; i < sides_of(mesh, face); i++) {
        for (mt_index j = 0; j < i; j++) {
            if (vertex_of(mesh, face, i) == vertex_of(mesh, face, j)) {
                return true;
            }
        }
    }
    return false;
}

static bool is_zero_area(const mt_mesh *mesh, mt_index face)
{
    mt_index sides = sides_of(mesh, face);
    for (mt_index i = 0; i < sides; i++) {
        if (!mt_vec3_is_finite(mt_mesh_position(mesh, vertex_of(mesh, face, i)))) {
            return false;
        }
    }
    for (mt_index i = 0; i < sides; i++) {
        for (mt_index j = 0; j < i; j++) {
            for (mt_index k = 0; k < j; k++) {
                if (!test_points_are_collinear(mt_mesh_position(mesh, vertex_of(mesh, face, i)),
                                               mt_mesh_position(mesh, vertex_of(mesh, face, j)),
                                               mt_mesh_position(mesh, vertex_of(mesh, face, k)))) {
                    return false;
                }
            }
        }
    }
    return !is_degenerate(mesh, face);
}

static bool same_cycle(const mt_mesh *mesh, mt_index f, mt_index g)
{
    mt_index sides = sides_of(mesh, f);
    if (sides_of(mesh, g) != sides) {
        return false;
    }
    for (mt_index turn = 0; turn < sides; turn++) {
        bool forward = true, backward = true;
        for (mt_index i = 0; i < sides; i++) {
            forward = forward && vertex_of(mesh, f, i) == vertex_of(mesh, g, i + turn);
            backward = backward && vertex_of(mesh, f, i) == vertex_of(mesh, g, turn + sides - i);
        }
        if (forward || backward) {
            return true;
        }
    }
    return false;
}

static bool is_duplicate(const mt_mesh *mesh, mt_index face)
{
    for (mt_index earlier = 0; earlier < face; earlier++) {
        if (same_cycle(mesh, face, earlier)) {
            return true;
        }
    }
    return false;
}

bool test_face_is_defect(const mt_mesh *mesh, mt_defect_kind kind, mt_index face)
{
    switch (kind) {
    case MT_DEFECT_DEGENERATE_FACE:
        return is_degenerate(mesh, face);
    case MT_DEFECT_DUPLICATE_FACE:
        return is_duplicate(mesh, face);
    case MT_DEFECT_ZERO_AREA_FACE:
        return is_zero_area(mesh, face);
    case MT_DEFECT_INSIDE_OUT_COMPONENT:
        return test_component_is_inside_out(mesh, face);
    default:
        return false;
    }
}

static mt_index count_components(const mt_mesh *mesh)
{
    face_sets sets = {malloc((mesh->face_count + (size_t)1) * sizeof(mt_index)), mesh->face_count};
    for (mt_index face = 0; face < mesh->face_count; face++) {
        sets.set[face] = face;
    }
    for (mt_index f = 0; f < mesh->face_count; f++) {
        for (mt_index g = 0; g < f; g++) {
            if (share_edge_at(mesh, f, g, MT_NONE)) {
                merge(&sets, mesh->face_count, f, g);
            }
        }
    }
    free(sets.set);
    return sets.count;
}

/* What the colour of face g must be for side i of face f, 0 when it is free. */
static int wanted_color(const mt_mesh *mesh, mt_index f, mt_index i, mt_index g, int color)
{
    mt_index a = vertex_of(mesh, f, i), b = vertex_of(mesh, f, i + 1);
    if (sides_from_to(mesh, g, a, b)) {
        return -color;
    }
    return sides_from_to(mesh, g, b, a) ? color : 0;
}

/* Spreads colours to the faces beside coloured ones. False when one would need two. */
static bool spread_colors(const mt_mesh *mesh, int *color, bool *changed)
{
    for (mt_index f = 0; f < mesh->face_count; f++) {
        for (mt_index i = 0; color[f] && i < sides_of(mesh, f); i++) {
            for (mt_index g = 0; g < mesh->face_count; g++) {
                int wanted = f == g ? 0 : wanted_color(mesh, f, i, g, color[f]);
                if (wanted && color[g] && color[g] != wanted) {
                    return false;
                }
                *changed = *changed || (wanted && !color[g]);
                color[g] = wanted ? wanted : color[g];
            }
        }
    }
    return true;
}

/* Whether turning some faces, those of colour -1, leaves no edge along which two run in the same direction. */
static bool is_orientable(const mt_mesh *mesh)
{
    int *color = calloc(mesh->face_count + (size_t)1, sizeof *color);
    bool right = true;
    for (mt_index seed = 0; seed < mesh->face_count && right; seed++) {
        color[seed] = color[seed] ? color[seed] : 1;
        bool changed = true;
        while (changed && right) {
            changed = false;
            right = spread_colors(mesh, color, &changed);
        }
    }
    free(color);
    return right;
}

static bool folds_on_itself(const mt_mesh *mesh, mt_index face)
{
    for (mt_index i = 0; i < sides_of(mesh, face); i++) {
        mt_index a = vertex_of(mesh, face, i), b = vertex_of(mesh, face, i + 1);
        if (sides_from_to(mesh, face, a, b) > 1) {
            return true;
        }
    }
    return false;
}

/* Walks along boundary edges, at a mesh whose boundary vertices have two each. */
static mt_index count_loops(const mt_mesh *mesh)
{
    mt_index vertex_count = mesh->vertex_count;
    bool *walked = calloc((size_t)vertex_count * vertex_count + 1, sizeof *walked);
    mt_index loops = 0;
    for (mt_index start = 0; start < vertex_count; start++) {
        mt_index at = start;
        bool walks = false;
        for (mt_index next = 0; next < vertex_count; next++) {
            if (!walked[at * vertex_count + next] && test_edge_is_defect(mesh, MT_DEFECT_BOUNDARY_EDGE, at, next)) {
                walked[at * vertex_count + next] = walked[next * vertex_count + at] = true;
                walks = true;
                at = next;
                next = MT_NONE; /* from the first again */
            }
        }
        loops += walks;
        if (walks) {
            assert_int_equal(at, start);
        }
    }
    free(walked);
    return loops;
}

static void count_all_edges(const mt_mesh *mesh, mt_manifold_report *report)
{
    static const mt_defect_kind kinds[] = {MT_DEFECT_BOUNDARY_EDGE, MT_DEFECT_NON_MANIFOLD_EDGE,
                                           MT_DEFECT_MISORIENTED_EDGE};
    for (mt_index a = 0; a < mesh->vertex_count; a++) {
        for (mt_index b = 0; b < a; b++) {
            mt_index forward, backward;
            count_sides(mesh, a, b, &forward, &backward);
            report->edge_count += forward + backward > 0;
            for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
                report->defect_counts[kinds[i]] += test_edge_is_defect(mesh, kinds[i], a, b);
            }
        }
    }
}

static void measure(const mt_mesh *mesh, mt_manifold_report *report)
{
    for (mt_index face = 0; face < mesh->face_count; face++) {
        for (mt_index i = 1; i + 1 < sides_of(mesh, face); i++) {
            mt_vec3 a = mt_mesh_position(mesh, vertex_of(mesh, face, 0));
            mt_vec3 b = mt_mesh_position(mesh, vertex_of(mesh, face, i));
            mt_vec3 c = mt_mesh_position(mesh, vertex_of(mesh, face, i + 1));
            if (mt_vec3_is_finite(a) && mt_vec3_is_finite(b) && mt_vec3_is_finite(c)) {
                mt_vec3 cross = mt_vec3_cross(mt_vec3_subtract(b, a), mt_vec3_subtract(c, a));
                report->area += mt_vec3_length(cross) / 2;
                report->volume += mt_vec3_dot(a, mt_vec3_cross(b, c)) / 6;
            }
        }
    }
}

static void classify(const mt_mesh *mesh, mt_manifold_report *report)
{
    const mt_index *counts = report->defect_counts;
    bool non_manifold_edge = counts[MT_DEFECT_NON_MANIFOLD_EDGE] > 0;
    bool broken = non_manifold_edge || counts[MT_DEFECT_NON_MANIFOLD_VERTEX] || counts[MT_DEFECT_DEGENERATE_FACE];
    bool closed = mesh->face_count && !counts[MT_DEFECT_BOUNDARY_EDGE];
    report->manifold_class = broken ? MT_NON_MANIFOLD : closed ? MT_MANIFOLD : MT_MANIFOLD_WITH_BOUNDARY;
    report->boundary_loop_count = broken ? MT_NONE : count_loops(mesh);
    report->oriented = non_manifold_edge ? MT_UNDEFINED : counts[MT_DEFECT_MISORIENTED_EDGE] ? MT_NO : MT_YES;
    bool orientable = !non_manifold_edge && is_orientable(mesh);
    for (mt_index face = 0; face < mesh->face_count; face++) {
        orientable = orientable && !folds_on_itself(mesh, face);
    }
    report->orientable = non_manifold_edge ? MT_UNDEFINED : orientable ? MT_YES : MT_NO;
    report->euler_characteristic = (int64_t)mesh->vertex_count - counts[MT_DEFECT_ISOLATED_VERTEX] -
                                   (int64_t)report->edge_count + (int64_t)mesh->face_count;
    report->has_genus = !broken && orientable;
    if (report->has_genus) {
        report->genus =
            (int64_t)report->component_count - (report->euler_characteristic + report->boundary_loop_count) / 2;
    }
    report->has_volume = report->manifold_class == MT_MANIFOLD && report->oriented == MT_YES;
}

void test_manifold_reference(const mt_mesh *mesh, mt_manifold_report *report)
{
    *report = (mt_manifold_report){
        .vertex_count = mesh->vertex_count, .face_count = mesh->face_count, .corner_count = mesh->corner_count};
    for (mt_index face = 0; face < mesh->face_count; face++) {
        report->triangle_count += sides_of(mesh, face) - 2;
    }
    count_all_edges(mesh, report);
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            report->defect_counts[kind] += test_vertex_is_defect(mesh, kind, vertex);
        }
        for (mt_index face = 0; face < mesh->face_count; face++) {
            report->defect_counts[kind] += test_face_is_defect(mesh, kind, face);
        }
    }
    report->component_count = count_components(mesh);
    measure(mesh, report);
    classify(mesh, report);
}

bool test_is_same_element(const mt_defect *a, const mt_defect *b)
{
    if (a->vertex_count != b->vertex_count || a->face_count != b->face_count) {
        return false;
    }
    return memcmp(a->vertices, b->vertices, a->vertex_count * sizeof(mt_index)) == 0 &&
           memcmp(a->faces, b->faces, a->face_count * sizeof(mt_index)) == 0;
}
