#include "defect_paint.h"

#include "check_words.h"
#include "line.h"
#include "progress.h"
#include "quantity.h"

#include <string.h>

typedef struct defect_color {
    const char *name;
    unsigned char rgb[3];
} defect_color;

static const defect_color colors[MT_DEFECT_KIND_COUNT] = {
    [MT_DEFECT_NON_FINITE_VERTEX] = {"black", {0, 0, 0}},
    [MT_DEFECT_DEGENERATE_FACE] = {"magenta", {230, 0, 200}},
    [MT_DEFECT_DUPLICATE_FACE] = {"orange", {255, 140, 0}},
    [MT_DEFECT_NON_MANIFOLD_EDGE] = {"red", {220, 20, 20}},
    [MT_DEFECT_NON_MANIFOLD_VERTEX] = {"blue", {30, 70, 230}},
    [MT_DEFECT_MISORIENTED_EDGE] = {"yellow", {240, 210, 0}},
    [MT_DEFECT_ZERO_AREA_FACE] = {"purple", {120, 40, 160}},
    [MT_DEFECT_ISOLATED_VERTEX] = {"cyan", {0, 190, 210}},
    [MT_DEFECT_BOUNDARY_PINCH] = {"pink", {255, 120, 190}},
    [MT_DEFECT_INSIDE_OUT_COMPONENT] = {"olive", {125, 125, 0}},
    [MT_DEFECT_SELF_INTERSECTION] = {"brown", {130, 75, 25}},
    [MT_DEFECT_BOUNDARY_EDGE] = {"green", {20, 150, 60}},
};

static const unsigned char neutral[3] = {205, 205, 205};

void cli_defect_paint_release(mt_context *context, cli_defect_paint *paint)
{
    mt_free(context, paint->faces);
    mt_free(context, paint->vertices);
    mt_free(context, paint->marked_vertices);
    mt_free(context, paint->edges);
    mt_free(context, paint->edge_colors);
    mt_free(context, paint->points);
    mt_components_destroy(context, paint->components);
    mt_edge_pairs_destroy(context, paint->pairs);
}

static unsigned char *allocate_neutral(mt_context *context, mt_index count)
{
    unsigned char *bytes = mt_allocate_array(context, count, 3);
    for (size_t i = 0; bytes && i < count; i++) {
        memcpy(bytes + 3 * i, neutral, 3);
    }
    return bytes;
}

/* Listed are only the first faces of components. */
static bool find_components(mt_context *context, const cli_check *check, cli_defect_paint *out)
{
    return check->report->defect_counts[MT_DEFECT_INSIDE_OUT_COMPONENT] == 0 ||
           (mt_edge_pairs_create(context, check->mesh, &out->pairs) == MT_OK &&
            mt_components_create(context, check->mesh, out->pairs, true, &out->components) == MT_OK);
}

static bool allocate(mt_context *context, const cli_check *check, cli_defect_paint *out)
{
    memset(out, 0, sizeof *out);
    out->faces = allocate_neutral(context, check->mesh->face_count);
    out->vertices = allocate_neutral(context, check->mesh->vertex_count);
    out->marked_vertices = mt_allocate_zeroed(context, check->mesh->vertex_count);
    out->edges = mt_allocate_array(context, check->report->defect_list_count, 2 * sizeof *out->edges);
    out->edge_colors = mt_allocate_array(context, check->report->defect_list_count, 3);
    if (out->faces && out->vertices && out->marked_vertices && out->edges && out->edge_colors &&
        find_components(context, check, out)) {
        return true;
    }
    cli_defect_paint_release(context, out);
    return false;
}

static bool marks_edge(mt_defect_kind kind)
{
    return kind == MT_DEFECT_NON_MANIFOLD_EDGE || kind == MT_DEFECT_MISORIENTED_EDGE || kind == MT_DEFECT_BOUNDARY_EDGE;
}

static bool marks_vertex(mt_defect_kind kind)
{
    return kind == MT_DEFECT_NON_MANIFOLD_VERTEX || kind == MT_DEFECT_BOUNDARY_PINCH ||
           kind == MT_DEFECT_ISOLATED_VERTEX;
}

/* Faces that cover no pixel: their vertices are marked instead. */
static bool marks_corners(mt_defect_kind kind)
{
    return kind == MT_DEFECT_ZERO_AREA_FACE || kind == MT_DEFECT_DEGENERATE_FACE;
}

/* A hole's rim is no fault of the faces beside it. A picture shows by its lines where the orientation changes, and by
 * its light on which side it does; a mesh has its faces' colors alone. */
static bool paints_faces(mt_defect_kind kind, bool for_picture)
{
    return kind != MT_DEFECT_BOUNDARY_EDGE && !(for_picture && kind == MT_DEFECT_MISORIENTED_EDGE);
}

static void paint_vertices_of(const mt_mesh *mesh, mt_index face, const unsigned char *color, cli_defect_paint *paint)
{
    for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
        memcpy(paint->vertices + 3 * (size_t)mesh->corner_vertices[c], color, 3);
    }
}

static void paint_defect(const mt_mesh *mesh, const mt_defect *defect, bool for_picture, cli_defect_paint *paint)
{
    const unsigned char *color = colors[defect->kind].rgb;
    mt_index face_count = paints_faces(defect->kind, for_picture) ? defect->face_count : 0;
    for (mt_index i = 0; i < face_count; i++) {
        memcpy(paint->faces + 3 * (size_t)defect->faces[i], color, 3);
        if (defect->kind == MT_DEFECT_SELF_INTERSECTION) {
            paint_vertices_of(mesh, defect->faces[i], color, paint);
        }
    }
    for (mt_index i = 0; i < defect->vertex_count; i++) {
        memcpy(paint->vertices + 3 * (size_t)defect->vertices[i], color, 3);
    }
    if (marks_edge(defect->kind)) {
        memcpy(paint->edge_colors + 3 * paint->edge_count, color, 3);
        memcpy(paint->edges + 2 * paint->edge_count++, defect->vertices, 2 * sizeof *paint->edges);
    }
    mt_index mark_count = marks_vertex(defect->kind) ? 1 : marks_corners(defect->kind) ? defect->vertex_count : 0;
    for (mt_index i = 0; i < mark_count; i++) {
        paint->marked_vertices[defect->vertices[i]] = 1;
    }
}

/* All faces of the components whose first faces are listed, by one look at all faces. */
static mt_status paint_components(mt_context *context, const cli_check *check, mt_defect_kind kind,
                                  cli_defect_paint *paint)
{
    const mt_manifold_report *report = check->report;
    uint8_t *listed = mt_allocate_zeroed(context, paint->components->component_count);
    if (!listed) {
        return MT_ERROR_OUT_OF_MEMORY;
    }
    for (size_t i = 0; i < report->defect_list_count; i++) {
        if (report->defects[i].kind == kind) {
            listed[paint->components->face_component[report->defects[i].faces[0]]] = 1;
        }
    }
    for (mt_index face = 0; face < check->mesh->face_count; face++) {
        if (listed[paint->components->face_component[face]]) {
            memcpy(paint->faces + 3 * (size_t)face, colors[kind].rgb, 3);
            paint_vertices_of(check->mesh, face, colors[kind].rgb, paint);
        }
    }
    mt_free(context, listed);
    return MT_OK;
}

/* The last to mend first, so that what is to be mended first is not painted over. */
static mt_status paint_all(mt_context *context, const cli_check *check, bool for_picture, cli_defect_paint *paint)
{
    mt_status status = MT_OK;
    const mt_defect *defects = check->report->defects;
    for (size_t i = check->report->defect_list_count; i-- > 0 && status == MT_OK;) {
        if (!cli_defect_is_of_components(defects[i].kind)) {
            paint_defect(check->mesh, &defects[i], for_picture, paint);
        } else if (i == 0 || defects[i - 1].kind != defects[i].kind) {
            status = paint_components(context, check, defects[i].kind, paint);
        }
    }
    return status;
}

/* How much larger than the rest isolated vertices may make a picture; those farther out stay outside. */
#define LARGEST_FRAME 10.0

/* The isolated vertices as points of the mesh, so that the picture's frame takes them in. Returns how many. */
static mt_index list_points(const cli_check *check, mt_index *points)
{
    const mt_mesh *mesh = check->mesh;
    mt_vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (mt_index c = 0; c < mesh->corner_count; c++) {
        mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]);
        low = mt_vec3_make(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = mt_vec3_make(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    mt_vec3 middle = mt_vec3_add(mt_vec3_scale(low, 0.5), mt_vec3_scale(high, 0.5));
    double reach = LARGEST_FRAME / 2 * mt_vec3_max_abs(mt_vec3_subtract(high, low));
    mt_index count = 0;
    for (size_t i = 0; i < check->report->defect_list_count; i++) {
        const mt_defect *defect = &check->report->defects[i];
        if (defect->kind == MT_DEFECT_ISOLATED_VERTEX) {
            mt_vec3 offset = mt_vec3_subtract(mt_mesh_position(mesh, defect->vertices[0]), middle);
            points[count] = defect->vertices[0];
            count += mt_vec3_max_abs(offset) <= reach;
        }
    }
    return count;
}

static mt_status frame_points(mt_context *context, const cli_check *check, cli_defect_paint *out)
{
    uint64_t isolated_count = check->report->defect_counts[MT_DEFECT_ISOLATED_VERTEX];
    out->points = mt_allocate_array(context, isolated_count + 1, sizeof *out->points);
    if (out->points && out->shown.point_count == 0 && out->shown.face_count) {
        out->shown.point_vertices = out->points;
        out->shown.point_count = list_points(check, out->points);
    }
    return out->points ? MT_OK : mt_context_error(context)->status;
}

mt_status cli_defect_paint_init(mt_context *context, const cli_check *check, bool for_picture, cli_defect_paint *out)
{
    if (!allocate(context, check, out)) {
        return mt_context_error(context)->status;
    }
    out->shown = *check->mesh;
    mt_status status = paint_all(context, check, for_picture, out);
    if (status == MT_OK && for_picture) {
        status = frame_points(context, check, out);
    }
    if (status != MT_OK) {
        cli_defect_paint_release(context, out);
    }
    return status;
}

void cli_defect_paint_apply(const cli_defect_paint *paint, mt_preview_options *how)
{
    how->face_colors = paint->faces;
    how->vertex_marks = paint->marked_vertices;
    how->edge_marks = paint->edges;
    how->edge_mark_count = paint->edge_count;
    how->edge_mark_colors = paint->edge_colors;
    how->vertex_mark_colors = paint->vertices;
}

void cli_defect_legend(const cli_job *job, const cli_check *check, const char *path)
{
    cli_line line = {0};
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_KIND_COUNT; kind++) {
        mt_index count = check->report->defect_counts[kind];
        if (count) {
            cli_line_add(&line, "%s%s %s", line.length ? ", " : "", colors[kind].name,
                         cli_counted(count, mt_defect_words(kind)).text);
        }
    }
    if (!job->common->quiet) {
        cli_progress_clear();
        fprintf(stderr, "meshtool: %s: %s\n", path, line.length ? line.text : "nothing to colour");
    }
}
