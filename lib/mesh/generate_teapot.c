/* The Utah teapot: M. Newell's control points (thesis, University of Utah, 1975) in the proportions of F. Crow, "The
 * origins of the teapot", IEEE Computer Graphics and Applications 7 (1987): 32 bicubic Bezier patches with the
 * bottom. The control points have two mirror planes, so a quarter of body and lid and a half of handle and
 * spout say everything, and each control polygon around is given by two numbers.
 *
 * The mesh is four pieces, each welded by construction: body with bottom (one rim), lid (one rim), handle and spout
 * (two rims each, inside the body). Where patches shrink to a point, the lid ends in triangles, and the bottom in one
 * flat polygon in place of the last ring: no face is degenerate. y is up. */
#include "lib/mesh/generate.h"

/* Four control points around a quarter: (radius, 0), (radius, inner), (inner, radius), (0, radius). */
typedef struct turned_row {
    double radius, inner, height;
} turned_row;

/* Four around a half: (x0, 0, z0), (x0, width, z0), (x1, width, z1), (x1, 0, z1). */
typedef struct tube_row {
    double x0, z0, x1, z1, width;
} tube_row;

static const turned_row body_rows[] = {{1.4, 0.784, 2.4}, {1.3375, 0.749, 2.53125}, {1.4375, 0.805, 2.53125},
                                       {1.5, 0.84, 2.4},  {1.75, 0.98, 1.875},      {2, 1.12, 1.35},
                                       {2, 1.12, 0.9},    {2, 1.12, 0.45},          {1.5, 0.84, 0.225},
                                       {1.5, 0.84, 0.15}, {1.5, 0.84, 0.075},       {1.425, 0.798, 0},
                                       {0, 0, 0}};
static const turned_row lid_rows[] = {{0, 0, 3.15},       {0.8, 0.45, 3.15},  {0, 0, 2.85},     {0.2, 0.112, 2.7},
                                      {0.4, 0.224, 2.55}, {1.3, 0.728, 2.55}, {1.3, 0.728, 2.4}};
static const tube_row handle_rows[] = {{-1.6, 2.025, -1.5, 2.25, 0.3}, {-2.3, 2.025, -2.5, 2.25, 0.3},
                                       {-2.7, 2.025, -3, 2.25, 0.3},   {-2.7, 1.8, -3, 1.8, 0.3},
                                       {-2.7, 1.575, -3, 1.35, 0.3},   {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                       {-2, 0.9, -1.9, 0.6, 0.3}};
static const tube_row spout_rows[] = {{1.7, 1.425, 1.7, 0.6, 0.66},       {2.6, 1.425, 3.1, 0.825, 0.66},
                                      {2.3, 2.1, 2.4, 2.025, 0.25},       {2.7, 2.4, 3.3, 2.4, 0.25},
                                      {2.8, 2.475, 3.525, 2.49375, 0.25}, {2.9, 2.475, 3.45, 2.5125, 0.15},
                                      {2.8, 2.4, 3.2, 2.4, 0.15}};

/* One piece: rings of vertices from its first row of control points to its last. */
typedef struct teapot_piece {
    const turned_row *turned; /* or */
    const tube_row *tube;
    mt_index patches; /* from the first row to the last */
} teapot_piece;

static const teapot_piece body = {body_rows, NULL, 4}, lid = {lid_rows, NULL, 2};
static const teapot_piece handle = {NULL, handle_rows, 2}, spout = {NULL, spout_rows, 2};

typedef struct teapot_builder {
    mt_mesh *mesh;
    mt_index segments; /* of a patch */
    mt_index vertex, face;
} teapot_builder;

/* ---- evaluation: Newell's frame, z up ---- */

static void weigh(mt_index step, mt_index segments, double weights[4])
{
    double t = (double)step / segments, s = (double)(segments - step) / segments;
    weights[0] = s * s * s;
    weights[1] = 3 * t * s * s;
    weights[2] = 3 * t * t * s;
    weights[3] = t * t * t;
}

static mt_vec3 control_point(const teapot_piece *piece, mt_index row, int column)
{
    if (piece->turned) {
        const turned_row *r = &piece->turned[row];
        const double x[4] = {r->radius, r->radius, r->inner, 0}, y[4] = {0, r->inner, r->radius, r->radius};
        return mt_vec3_make(x[column], y[column], r->height);
    }
    const tube_row *r = &piece->tube[row];
    bool first = column < 2;
    return mt_vec3_make(first ? r->x0 : r->x1, column == 1 || column == 2 ? r->width : 0, first ? r->z0 : r->z1);
}

/* A point of the given quarter or half: `around` and `along` count segments from its beginning. */
static mt_vec3 evaluate(const teapot_piece *piece, mt_index segments, mt_index along, mt_index around)
{
    mt_index patch = along == piece->patches * segments ? piece->patches - 1 : along / segments;
    double u[4], v[4];
    weigh(along - patch * segments, segments, u);
    weigh(around, segments, v);
    mt_vec3 sum = mt_vec3_make(0, 0, 0);
    for (mt_index row = 0; row < 4; row++) {
        mt_vec3 across = mt_vec3_make(0, 0, 0);
        for (int column = 0; column < 4; column++) {
            across = mt_vec3_add(across, mt_vec3_scale(control_point(piece, 3 * patch + row, column), v[column]));
        }
        sum = mt_vec3_add(sum, mt_vec3_scale(across, u[row]));
    }
    return sum;
}

static mt_index ring_size(const teapot_piece *piece, mt_index segments)
{
    return (piece->turned ? 4 : 2) * segments;
}

/* Vertex i of a ring, mirrored out of the part that is given; seen with y up. */
static mt_vec3 ring_position(const teapot_piece *piece, mt_index segments, mt_index along, mt_index i)
{
    mt_index part = i / segments, step = i % segments;
    mt_vec3 p = evaluate(piece, segments, along, part % 2 ? segments - step : step);
    bool mirrors_x = piece->turned && (part == 1 || part == 2);
    bool mirrors_y = piece->turned ? part >= 2 : part == 1;
    return mt_vec3_make(mirrors_x ? -p.x : p.x, p.z, mirrors_y ? p.y : -p.y);
}

/* ---- assembly ---- */

/* Rings first to last (counted in segments along) and the quads between them; returns the first one's first vertex. */
static mt_index add_rings(teapot_builder *builder, const teapot_piece *piece, mt_index first, mt_index last)
{
    mt_index size = ring_size(piece, builder->segments), begin = builder->vertex;
    for (mt_index along = first; along <= last; along++) {
        for (mt_index i = 0; i < size; i++) {
            mt_mesh_set_position(builder->mesh, builder->vertex++, ring_position(piece, builder->segments, along, i));
        }
    }
    for (mt_index ring = begin; ring + size < builder->vertex; ring += size) {
        for (mt_index i = 0; i < size; i++) {
            mt_index j = i + 1 < size ? i + 1 : 0;
            const mt_index quad[4] = {ring + i, ring + size + i, ring + size + j, ring + j};
            mt_generate_face(builder->mesh, builder->face++, quad, 4);
        }
    }
    return begin;
}

static void add_body(teapot_builder *builder)
{
    mt_index size = ring_size(&body, builder->segments);
    add_rings(builder, &body, 0, body.patches * builder->segments - 1);
    mt_mesh *mesh = builder->mesh;
    mt_index begin = mesh->face_offsets[builder->face];
    for (mt_index i = 0; i < size; i++) {
        mesh->corner_vertices[begin + i] = builder->vertex - 1 - i;
    }
    mesh->face_offsets[++builder->face] = begin + size;
}

static void add_lid(teapot_builder *builder)
{
    mt_index size = ring_size(&lid, builder->segments), tip = builder->vertex++;
    mt_mesh_set_position(builder->mesh, tip, ring_position(&lid, builder->segments, 0, 0));
    mt_index ring = add_rings(builder, &lid, 1, lid.patches * builder->segments);
    for (mt_index i = 0; i < size; i++) {
        const mt_index triangle[3] = {tip, ring + i, ring + (i + 1 < size ? i + 1 : 0)};
        mt_generate_face(builder->mesh, builder->face++, triangle, 3);
    }
}

mt_status mt_generate_teapot(mt_context *context, mt_index resolution, mt_mesh **out)
{
    uint64_t n = resolution, ring = 4 * n;
    uint64_t quads = ring * (ring - 1) + ring * (2 * n - 1) + 2 * (2 * n) * (2 * n);
    mt_mesh_layout layout = {.vertex_count = ring * ring + 1 + ring * 2 * n + 2 * (2 * n) * (2 * n + 1),
                             .face_count = quads + 1 + ring,
                             .corner_count = 4 * quads + ring + 3 * ring,
                             .position_type = MT_F64};
    mt_status status = mt_mesh_create(context, &layout, out);
    if (status != MT_OK) {
        return status;
    }
    teapot_builder builder = {.mesh = *out, .segments = resolution};
    add_body(&builder);
    add_lid(&builder);
    add_rings(&builder, &handle, 0, handle.patches * resolution);
    add_rings(&builder, &spout, 0, spout.patches * resolution);
    return MT_OK;
}
