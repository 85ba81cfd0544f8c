/* check-manifold --paint: the mesh, or a picture of it, with each kind of defect in its colour. */
#include "check.h"
#include "check_words.h"
#include "line.h"
#include "message.h"
#include "progress.h"
#include "quantity.h"

#include <meshtool/components.h>
#include <meshtool/preview.h>

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

/* Colours of faces and vertices, and the edges to mark. */
typedef struct defect_paint {
    mt_edge_pairs *pairs;
    mt_components *components; /* when one of them is a defect, else NULL */
    unsigned char *faces, *vertices, *marked_vertices;
    mt_index *edges;
    unsigned char *edge_colors;
    size_t edge_count;
} defect_paint;

static void release(mt_context *context, defect_paint *paint)
{
    mt_free(context, paint->faces);
    mt_free(context, paint->vertices);
    mt_free(context, paint->marked_vertices);
    mt_free(context, paint->edges);
    mt_free(context, paint->edge_colors);
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
static bool find_components(mt_context *context, const cli_check *check, defect_paint *out)
{
    return check->report->defect_counts[MT_DEFECT_INSIDE_OUT_COMPONENT] == 0 ||
           (mt_edge_pairs_create(context, check->mesh, &out->pairs) == MT_OK &&
            mt_components_create(context, check->mesh, out->pairs, true, &out->components) == MT_OK);
}

static bool allocate(mt_context *context, const cli_check *check, defect_paint *out)
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
    release(context, out);
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

static void paint_vertices_of(const mt_mesh *mesh, mt_index face, const unsigned char *color, defect_paint *paint)
{
    for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
        memcpy(paint->vertices + 3 * (size_t)mesh->corner_vertices[c], color, 3);
    }
}

static void paint_defect(const mt_mesh *mesh, const mt_defect *defect, bool for_picture, defect_paint *paint)
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
static mt_status paint_components(mt_context *context, const cli_check *check, mt_defect_kind kind, defect_paint *paint)
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
static mt_status paint_all(mt_context *context, const cli_check *check, bool for_picture, defect_paint *paint)
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

static void say_legend(const cli_job *job, const cli_check *check, const char *path)
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

static mt_status add_colors(mt_context *context, mt_mesh *mesh, mt_domain domain, const unsigned char *bytes)
{
    mt_attribute_layout layout = {
        .name = "color",
        .semantic = MT_SEMANTIC_COLOR,
        .domain = domain,
        .type = MT_U8,
        .component_count = 3,
        .value_count = mt_mesh_domain_count(mesh, domain),
    };
    mt_attribute *attribute = NULL;
    mt_status status = mt_mesh_add_attribute(context, mesh, &layout, &attribute);
    if (status == MT_OK) {
        memcpy(attribute->values, bytes, 3 * (size_t)layout.value_count);
    }
    return status;
}

static void remove_colors(mt_mesh *mesh, mt_context *context)
{
    for (mt_index i = mesh->attribute_count; i-- > 0;) {
        if (mesh->attributes[i].semantic == MT_SEMANTIC_COLOR) {
            mt_mesh_remove_attribute(context, mesh, i);
        }
    }
}

static cli_exit write_painted(const cli_job *job, const cli_check *check, const defect_paint *paint, const char *path)
{
    mt_context *context = job->context;
    mt_mesh *mesh = NULL;
    mt_status status = mt_mesh_copy(context, check->mesh, &mesh);
    if (status == MT_OK) {
        remove_colors(mesh, context);
        status = add_colors(context, mesh, MT_DOMAIN_VERTEX, paint->vertices);
    }
    if (status == MT_OK) {
        status = add_colors(context, mesh, MT_DOMAIN_FACE, paint->faces);
    }
    cli_exit code = status == MT_OK ? cli_write_mesh(job, mesh, path, NULL) : cli_report_failure(job, check->file);
    mt_mesh_destroy(context, mesh);
    return code;
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

static cli_exit write_picture(const cli_job *job, const cli_check *check, const defect_paint *paint, const char *path)
{
    mt_preview_options how = {
        .face_colors = paint->faces,
        .vertex_marks = paint->marked_vertices,
        .edge_marks = paint->edges,
        .edge_mark_count = paint->edge_count,
        .edge_mark_colors = paint->edge_colors,
        .vertex_mark_colors = paint->vertices,
    };
    mt_mesh shown = *check->mesh;
    mt_index isolated_count = check->report->defect_counts[MT_DEFECT_ISOLATED_VERTEX];
    mt_index *points = mt_allocate_array(job->context, (uint64_t)isolated_count + 1, sizeof *points);
    mt_image *image = NULL;
    if (points && shown.point_count == 0 && shown.face_count) {
        shown.point_vertices = points;
        shown.point_count = list_points(check, points);
    }
    mt_status status = points ? mt_preview(job->context, &shown, &how, &image) : MT_ERROR_OUT_OF_MEMORY;
    mt_free(job->context, points);
    if (status != MT_OK) {
        return cli_report_failure(job, check->file);
    }
    cli_exit code = cli_write_image(job, image, path);
    mt_image_destroy(job->context, image);
    return code;
}

/* Whether the output is to be a picture, by --to or else by its extension. */
static bool is_picture(const cli_job *job, const char *path)
{
    const char *dot = strrchr(path, '.');
    const char *extension = job->common->to ? cli_extension(job->common->to) : dot ? dot + 1 : "";
    return mt_image_format_by_extension(extension) != NULL;
}

cli_exit cli_check_paint_output(const cli_job *job, const char *path)
{
    if (is_picture(job, path)) {
        const mt_image_format *picture = NULL;
        return cli_check_image_output(job, path, &picture);
    }
    const mt_mesh_format *format = NULL;
    cli_exit code = cli_check_mesh_output(job, path, &format);
    if (code == CLI_EXIT_DONE && !(format->abilities & MT_HOLDS_FACE_COLORS)) {
        return cli_wrong_usage(job->command, "--paint: %s files hold no colours of faces; write a ply or a png",
                               format->name);
    }
    return code;
}

cli_exit cli_check_paint(const cli_job *job, const cli_check *check, const char *path)
{
    defect_paint paint;
    if (!allocate(job->context, check, &paint)) {
        return cli_report_failure(job, check->file);
    }
    bool for_picture = is_picture(job, path);
    cli_exit code = CLI_EXIT_DONE;
    if (paint_all(job->context, check, for_picture, &paint) != MT_OK) {
        code = cli_report_failure(job, check->file);
    } else {
        code = for_picture ? write_picture(job, check, &paint, path) : write_painted(job, check, &paint, path);
    }
    if (code == CLI_EXIT_DONE) {
        say_legend(job, check, path);
    }
    release(job->context, &paint);
    return code;
}
