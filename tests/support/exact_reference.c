/* The parts of the manifold reference that need exact arithmetic, in 128-bit integers. */
#include "tests/support/manifold_reference.h"
#include "tests/support/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

__extension__ typedef __int128 wide;

typedef struct whole_point {
    int64_t x, y, z;
} whole_point;

static int64_t whole(double x, int exponent)
{
    double scaled = ldexp(x, -exponent);
    assert_true(fabs(scaled) <= 0x1p62 && (double)(int64_t)scaled == scaled);
    return (int64_t)scaled;
}

/* The exponent of the lowest bit of the coordinate, or `exponent` if that is lower. */
static int lower(double x, int exponent)
{
    int own;
    double fraction = frexp(x, &own);
    while (fraction != floor(fraction)) {
        fraction *= 2;
        own--;
    }
    return x != 0 && own < exponent ? own : exponent;
}

static int lowest(mt_vec3 p, int exponent)
{
    return lower(p.x, lower(p.y, lower(p.z, exponent)));
}

static whole_point difference(mt_vec3 p, mt_vec3 origin, int exponent)
{
    whole_point d = {whole(p.x, exponent) - whole(origin.x, exponent), whole(p.y, exponent) - whole(origin.y, exponent),
                     whole(p.z, exponent) - whole(origin.z, exponent)};
    return d;
}

bool test_points_are_collinear(mt_vec3 a, mt_vec3 b, mt_vec3 c)
{
    int exponent = lowest(a, lowest(b, lowest(c, 1024)));
    whole_point d = difference(b, a, exponent), e = difference(c, a, exponent);
    return (wide)d.x * e.y == (wide)d.y * e.x && (wide)d.y * e.z == (wide)d.z * e.y &&
           (wide)d.z * e.x == (wide)d.x * e.z;
}

static bool are_beside(const mt_mesh *mesh, mt_index f, mt_index g)
{
    for (mt_index i = mt_mesh_face_begin(mesh, f), next; i < mt_mesh_face_end(mesh, f); i++) {
        next = i + 1 < mt_mesh_face_end(mesh, f) ? i + 1 : mt_mesh_face_begin(mesh, f);
        mt_index a = mesh->corner_vertices[i], b = mesh->corner_vertices[next];
        for (mt_index j = mt_mesh_face_begin(mesh, g), after; j < mt_mesh_face_end(mesh, g); j++) {
            after = j + 1 < mt_mesh_face_end(mesh, g) ? j + 1 : mt_mesh_face_begin(mesh, g);
            mt_index c = mesh->corner_vertices[j], d = mesh->corner_vertices[after];
            if (a != b && ((a == c && b == d) || (a == d && b == c))) {
                return true;
            }
        }
    }
    return false;
}

/* 1 for the faces of the component. */
static uint8_t *mark_component(const mt_mesh *mesh, mt_index face)
{
    uint8_t *marks = calloc(mesh->face_count, 1);
    assert_non_null(marks);
    marks[face] = 1;
    for (bool changed = true; changed;) {
        changed = false;
        for (mt_index f = 0; f < mesh->face_count; f++) {
            for (mt_index g = 0; g < mesh->face_count && !marks[f]; g++) {
                changed = changed || (marks[g] && are_beside(mesh, f, g));
                marks[f] = marks[g] && are_beside(mesh, f, g);
            }
        }
    }
    return marks;
}

/* Every side has exactly one other on its edge, in the other direction. */
static bool face_is_enclosed(const mt_mesh *mesh, mt_index face)
{
    mt_index begin = mt_mesh_face_begin(mesh, face), end = mt_mesh_face_end(mesh, face);
    for (mt_index c = begin; c < end; c++) {
        mt_index a = mesh->corner_vertices[c], b = mesh->corner_vertices[c + 1 < end ? c + 1 : begin];
        bool regular = a != b && !test_edge_is_defect(mesh, MT_DEFECT_BOUNDARY_EDGE, a, b) &&
                       !test_edge_is_defect(mesh, MT_DEFECT_NON_MANIFOLD_EDGE, a, b) &&
                       !test_edge_is_defect(mesh, MT_DEFECT_MISORIENTED_EDGE, a, b);
        if (!regular) {
            return false;
        }
    }
    return true;
}

/* Products of three such numbers, and sums of some hundred of them, fit 128 bits. */
static bool is_small(whole_point d)
{
    const int64_t most = INT64_C(1) << 38;
    return llabs(d.x) < most && llabs(d.y) < most && llabs(d.z) < most;
}

static wide face_volume(const mt_mesh *mesh, mt_index face, mt_vec3 origin, int exponent)
{
    const mt_index *vertices = mesh->corner_vertices + mt_mesh_face_begin(mesh, face);
    whole_point a = difference(mt_mesh_position(mesh, vertices[0]), origin, exponent);
    wide volume = 0;
    for (mt_index i = 1; i + 1 < mt_mesh_face_sides(mesh, face); i++) {
        whole_point b = difference(mt_mesh_position(mesh, vertices[i]), origin, exponent);
        whole_point c = difference(mt_mesh_position(mesh, vertices[i + 1]), origin, exponent);
        volume += a.x * ((wide)b.y * c.z - (wide)b.z * c.y) + a.y * ((wide)b.z * c.x - (wide)b.x * c.z) +
                  a.z * ((wide)b.x * c.y - (wide)b.y * c.x);
    }
    return volume;
}

static bool encloses_negative(const mt_mesh *mesh, const uint8_t *marks, mt_index first)
{
    mt_vec3 origin = mt_mesh_position(mesh, mesh->corner_vertices[mt_mesh_face_begin(mesh, first)]);
    int exponent = 1024;
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        if (marks[mt_mesh_corner_face(mesh, c)]) {
            mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]);
            if (!mt_vec3_is_finite(p)) {
                return false;
            }
            exponent = lowest(p, exponent);
        }
    }
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        if (marks[mt_mesh_corner_face(mesh, c)] &&
            !is_small(difference(mt_mesh_position(mesh, mesh->corner_vertices[c]), origin, exponent))) {
            return false;
        }
    }
    wide volume = 0;
    for (mt_index face = first; face < mesh->face_count; face++) {
        volume += marks[face] ? face_volume(mesh, face, origin, exponent) : 0;
    }
    return volume < 0;
}

bool test_component_is_inside_out(const mt_mesh *mesh, mt_index face)
{
    if (!face_is_enclosed(mesh, face)) {
        return false;
    }
    uint8_t *marks = mark_component(mesh, face);
    bool answer = !memchr(marks, 1, face);
    for (mt_index f = 0; f < mesh->face_count; f++) {
        answer = answer && (!marks[f] || face_is_enclosed(mesh, f));
    }
    answer = answer && encloses_negative(mesh, marks, face);
    free(marks);
    return answer;
}
