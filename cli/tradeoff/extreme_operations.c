/* The operations that extremes are swept over. Each is judged by 113-bit arithmetic, brute force or itself reversed;
 * what is asked is whether the result is right for the numbers that are stored, however badly they stand for a shape.
 */
#include "tradeoff/extremes.h"
#include "tradeoff/quad_triangle.h"
#include "tradeoff/random.h"
#include "tradeoff/reference_surface.h"
#include "tradeoff/statistics.h"

#include <meshtool/closest_point.h>
#include <meshtool/manifold.h>
#include <meshtool/mesh_format.h>
#include <meshtool/normals.h>
#include <meshtool/predicates.h>
#include <meshtool/preview.h>
#include <meshtool/subdivide.h>

#include <math.h>
#include <string.h>

/* Triangles that brute force looks at for one mesh. */
#define WORK 1000000U
#define QUERY_MAXIMUM 200U

static double largest_coordinate(const mt_mesh *mesh)
{
    double largest = 0;
    for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
        largest = fmax(largest, mt_vec3_max_abs(mt_mesh_position(mesh, vertex)));
    }
    return largest;
}

static void corners_of(const mt_mesh *mesh, const mt_triangulation *triangulation, mt_index triangle, mt_vec3 p[3])
{
    for (mt_index side = 0; side < 3; side++) {
        p[side] = mt_mesh_position(mesh, mesh->corner_vertices[mt_triangulation_corner(triangulation, triangle, side)]);
    }
}

/* ---- text: written and read back ---- */

static mt_status text_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    mt_mesh_write_options write = {.format = "obj"};
    mt_mesh_read_options read = {.precision = mesh->position_type == MT_F32 ? MT_PRECISION_F32 : MT_PRECISION_F64};
    mt_mesh *back = NULL;
    void *bytes = NULL;
    size_t size = 0, number_size = mesh->position_type == MT_F32 ? sizeof(float) : sizeof(double);
    mt_status status = mt_mesh_write_memory(context, mesh, &write, &bytes, &size);
    if (status == MT_OK) {
        status = mt_mesh_read_memory(context, "extreme.obj", bytes, size, &read, &back, NULL);
    }
    if (status == MT_OK) {
        bool is_same = back->vertex_count == mesh->vertex_count &&
                       memcmp(back->positions, mesh->positions, 3 * mesh->vertex_count * number_size) == 0;
        *out = is_same ? 0 : 1;
    }
    mt_mesh_destroy(context, back);
    mt_free(context, bytes);
    return status;
}

/* ---- check: area and volume ---- */

static double relative(quad exact, double found, quad scale)
{
    if ((double)exact == found) {
        return 0;
    }
    quad error = quad_absolute(exact - (quad)found);
    return scale > 0 ? (double)(error / scale) : (double)INFINITY;
}

/* Volume about the first vertex, so that far from the origin little is lost; it is compared with the area times the
 * extent, which is what a thin or open solid leaves to compare with. */
static void measure_in_quad(const mt_mesh *mesh, const mt_triangulation *triangulation, quad *area, quad *volume,
                            quad *extent)
{
    quad3 about = quad3_from(mt_mesh_position(mesh, 0));
    *area = *volume = *extent = 0;
    for (mt_index triangle = 0; triangle < triangulation->triangle_count; triangle++) {
        mt_vec3 p[3];
        corners_of(mesh, triangulation, triangle, p);
        quad3 a = quad3_subtract(quad3_from(p[0]), about), b = quad3_subtract(quad3_from(p[1]), about);
        quad3 c = quad3_subtract(quad3_from(p[2]), about);
        quad3 n = quad3_cross(quad3_subtract(b, a), quad3_subtract(c, a));
        quad reach = quad_sqrt(quad3_dot(a, a));
        *area += quad_sqrt(quad3_dot(n, n)) / 2;
        *volume += quad3_dot(a, quad3_cross(b, c)) / 6;
        *extent = reach > *extent ? reach : *extent;
    }
}

static mt_status check_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    mt_manifold_report report;
    mt_triangulation triangulation;
    mt_status status = mt_triangulation_init(context, mesh, &triangulation);
    if (status != MT_OK) {
        return status;
    }
    status = mt_check_manifold(context, mesh, NULL, &report);
    if (status == MT_OK) {
        quad area, volume, extent;
        measure_in_quad(mesh, &triangulation, &area, &volume, &extent);
        *out = relative(area, report.area, area);
        *out = report.has_volume ? fmax(*out, relative(volume, report.volume, area * extent)) : *out;
        mt_manifold_report_release(context, &report);
    }
    mt_triangulation_release(context, &triangulation);
    return status;
}

/* ---- subdivide: one level ---- */

static mt_status subdivide_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    reference_surface cage = {0}, finer = {0};
    mt_mesh *bare = NULL, *refined = NULL;
    mt_status status = tradeoff_bare_mesh(context, mesh, mesh->position_type, &bare);
    status = status == MT_OK ? mt_subdivide(context, bare, NULL, &refined) : status;
    status = status == MT_OK ? reference_surface_make(context, mesh, &cage) : status;
    status = status == MT_OK ? reference_surface_refine(context, &cage, &finer) : status;
    /* What rounding to the stored precision may take of the largest coordinate is not ours. */
    double step = mesh->position_type == MT_F32 ? 0x1p-24 : 0x1p-53, worst = 0, largest = largest_coordinate(mesh);
    double smallest = mesh->position_type == MT_F32 ? 0x1p-149 : 0x1p-1074;
    for (mt_index vertex = 0; status == MT_OK && vertex < refined->vertex_count; vertex++) {
        quad3 d = quad3_subtract(quad3_from(mt_mesh_position(refined, vertex)), finer.positions[vertex]);
        quad x = quad_absolute(d.x), y = quad_absolute(d.y), z = quad_absolute(d.z), m = x > y ? x : y;
        m = m > z ? m : z;
        worst = fmax(worst, (double)(m / ((quad)step * largest + (quad)smallest / 2)));
    }
    *out = worst;
    reference_surface_release(context, &cage);
    reference_surface_release(context, &finer);
    mt_mesh_destroy(context, bare);
    mt_mesh_destroy(context, refined);
    return status;
}

/* ---- normals: by area, per vertex ---- */

static mt_status normals_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    mt_mesh *bare = NULL;
    mt_normal_options options = {.type = MT_F64};
    quad3 *sums = mt_allocate_array_zeroed(context, mesh->vertex_count, sizeof *sums);
    mt_status status = sums ? tradeoff_bare_mesh(context, mesh, mesh->position_type, &bare) : MT_ERROR_OUT_OF_MEMORY;
    status = status == MT_OK ? mt_mesh_add_normals(context, bare, &options, NULL) : status;
    double worst = 0;
    if (status == MT_OK) {
        const mt_attribute *normals = mt_mesh_find_attribute(bare, MT_SEMANTIC_NORMAL, MT_DOMAIN_VERTEX);
        quad_vertex_normals(mesh, 1, sums);
        for (mt_index vertex = 0; vertex < mesh->vertex_count; vertex++) {
            mt_index value = mt_attribute_value_index(normals, vertex);
            mt_vec3 n = mt_vec3_make(mt_attribute_get(normals, value, 0), mt_attribute_get(normals, value, 1),
                                     mt_attribute_get(normals, value, 2));
            double degrees = tradeoff_degrees_between(n, quad3_round(sums[vertex]));
            worst = fmax(worst, isnan(degrees) ? 0 : degrees);
        }
    }
    *out = worst;
    mt_mesh_destroy(context, bare);
    mt_free(context, sums);
    return status;
}

/* ---- nearest points and rays: beside brute force ---- */

typedef struct search {
    const mt_mesh *mesh;
    mt_triangulation triangulation;
    mt_surface_tree *tree;
    mt_bounds bounds;
    mt_vec3 size;
    mt_index query_count;
} search;

static mt_status search_begin(mt_context *context, const mt_mesh *mesh, search *s)
{
    memset(s, 0, sizeof *s);
    s->mesh = mesh;
    s->bounds = mt_mesh_bounds(mesh);
    s->size = mt_vec3_subtract(s->bounds.maximum, s->bounds.minimum);
    mt_status status = mt_triangulation_init(context, mesh, &s->triangulation);
    if (status == MT_OK) {
        status = mt_surface_tree_create(context, mesh, &s->triangulation, NULL, &s->tree);
    }
    mt_index count = WORK / (s->triangulation.triangle_count + 1) + 1;
    s->query_count = count < QUERY_MAXIMUM ? count : QUERY_MAXIMUM;
    return status;
}

static void search_end(mt_context *context, search *s)
{
    mt_surface_tree_destroy(context, s->tree);
    mt_triangulation_release(context, &s->triangulation);
}

/* A point in or near the box. */
static mt_vec3 some_point(const search *s, tradeoff_random *random)
{
    mt_vec3 at = s->bounds.minimum;
    at.x += s->size.x * (1.5 * tradeoff_random_unit(random) - 0.25);
    at.y += s->size.y * (1.5 * tradeoff_random_unit(random) - 0.25);
    at.z += s->size.z * (1.5 * tradeoff_random_unit(random) - 0.25);
    return at;
}

/* Brute force; what its box in doubles shows to be farther than some corner is left out. */
static double distance_in_quad(const search *s, mt_vec3 point)
{
    double corner = INFINITY, exact = INFINITY;
    for (mt_index triangle = 0; triangle < s->triangulation.triangle_count; triangle++) {
        mt_vec3 p[3];
        corners_of(s->mesh, &s->triangulation, triangle, p);
        corner = fmin(corner, 1.75 * mt_vec3_max_abs(mt_vec3_subtract(p[0], point)));
    }
    for (mt_index triangle = 0; triangle < s->triangulation.triangle_count; triangle++) {
        mt_vec3 p[3];
        corners_of(s->mesh, &s->triangulation, triangle, p);
        if (quad_may_be_nearer(p, point, fmin(corner, exact))) {
            exact = fmin(exact, quad_distance_to_triangle(p, point));
        }
    }
    return exact;
}

static mt_status closest_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    search s;
    mt_status status = search_begin(context, mesh, &s);
    tradeoff_random random = {7};
    double worst = 0, extent = mt_vec3_max_abs(s.size);
    for (mt_index i = 0; status == MT_OK && i < s.query_count; i++) {
        mt_vec3 point = some_point(&s, &random);
        mt_closest found;
        double exact = distance_in_quad(&s, point);
        bool is_found = mt_surface_tree_closest(s.tree, point, NULL, &found);
        worst =
            fmax(worst, is_found ? relative(exact, found.distance, (quad)exact + (quad)0x1p-50 * extent) : INFINITY);
    }
    *out = worst;
    search_end(context, &s);
    return status;
}

/* A triangle with an area, if one is found soon: what is none may be missed. */
static void pick_triangle(const search *s, tradeoff_random *random, mt_vec3 p[3])
{
    for (int tries = 0; tries < 64; tries++) {
        mt_index target = (mt_index)(tradeoff_random_bits(random) % s->triangulation.triangle_count);
        corners_of(s->mesh, &s->triangulation, target, p);
        if (!mt_collinear(p[0], p[1], p[2])) {
            return;
        }
    }
}

/* Rays at places of the surface from all sides; where they hit is compared along the ray, in shares of the extent over
 * the cosine with which they hit. */
static mt_status rays_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    search s;
    mt_status status = search_begin(context, mesh, &s);
    tradeoff_random random = {8};
    double worst = 0, extent = mt_vec3_max_abs(s.size);
    for (mt_index i = 0; status == MT_OK && i < s.query_count; i++) {
        mt_vec3 p[3], direction = tradeoff_random_direction(&random);
        pick_triangle(&s, &random, p);
        mt_vec3 middle =
            mt_vec3_add(mt_vec3_scale(p[0], 0.4), mt_vec3_add(mt_vec3_scale(p[1], 0.35), mt_vec3_scale(p[2], 0.25)));
        mt_vec3 origin = mt_vec3_subtract(middle, mt_vec3_scale(direction, 2 * extent));
        mt_ray ray = mt_ray_make(origin, mt_vec3_subtract(middle, origin));
        mt_ray_hit hit;
        double exact = INFINITY;
        for (mt_index triangle = 0; triangle < s.triangulation.triangle_count; triangle++) {
            corners_of(mesh, &s.triangulation, triangle, p);
            exact = fmin(exact, quad_meet_triangle(p, &ray, 1e-9 * extent));
        }
        bool is_found = mt_surface_tree_nearest_hit(s.tree, &ray, MT_RAY_EXACT, &hit);
        double found = is_found ? hit.t : INFINITY;
        worst = found == exact ? worst : fmax(worst, fabs(found - exact) / exact);
    }
    *out = isnan(worst) ? INFINITY : worst;
    search_end(context, &s);
    return status;
}

/* ---- picture: both orders draw the same, and something ---- */

static mt_status picture_error(mt_context *context, const mt_mesh *mesh, double *out)
{
    enum { SIZE = 64 };
    static const mt_visibility_method methods[2] = {MT_METHOD_RASTER, MT_METHOD_RAY};
    mt_image *images[2] = {NULL, NULL};
    mt_status status = MT_OK;
    for (int i = 0; status == MT_OK && i < 2; i++) {
        mt_preview_options options = {.width = SIZE, .height = SIZE, .samples = 1, .method = methods[i]};
        options.background = MT_BACKGROUND_TRANSPARENT;
        status = mt_preview(context, mesh, &options, &images[i]);
    }
    double differing = 0, covered = 0;
    for (size_t i = 0; status == MT_OK && i < (size_t)SIZE * SIZE; i++) {
        const float *a = images[0]->pixels + 4 * i, *b = images[1]->pixels + 4 * i;
        differing += a[0] != b[0] || a[1] != b[1] || a[2] != b[2] || a[3] != b[3];
        covered += images[0]->pixels[4 * i + 3] > 0;
    }
    *out = covered > 0 ? differing : INFINITY;
    mt_image_destroy(context, images[0]);
    mt_image_destroy(context, images[1]);
    return status;
}

static const extreme_operation text = {"text", "itself, bit for bit", false, false, 0, text_error};
static const extreme_operation check = {"check", "area and volume in 113 bits", false, true, 1e-12, check_error};
static const extreme_operation subdivide = {"subdivide", "the rules in 113 bits", true, true, 16, subdivide_error};
static const extreme_operation normals = {"normals", "area vectors in 113 bits", false, true, 1e-9, normals_error};
static const extreme_operation closest = {"closest", "brute force in 113 bits", false, true, 1e-10, closest_error};
static const extreme_operation rays = {"rays", "brute force in 113 bits", false, true, 1e-9, rays_error};
static const extreme_operation picture = {"picture", "the other order of drawing", false, true, 0, picture_error};

const extreme_operation *const extreme_operations[] = {&text,    &check, &normals, &subdivide,
                                                       &closest, &rays,  &picture, NULL};
