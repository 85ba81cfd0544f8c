/* check-manifold for people: the verdict, what is wrong and where, the figures, what to do next. */
#include "check.h"
#include "check_words.h"
#include "line.h"
#include "quantity.h"

#include <string.h>

#define EXAMPLE_COUNT 3 /* of each kind; the rest is for JSON and --paint */
#define LISTED_COUNT 6  /* faces or vertices named in one example */

/* The mean of the first vertices: where to look. */
static cli_quantity place_of(const mt_mesh *mesh, const mt_defect *defect)
{
    mt_vec3 mean = {0, 0, 0};
    for (mt_index i = 0; i < defect->vertex_count && i < LISTED_COUNT; i++) {
        mt_vec3 offset = mt_vec3_subtract(mt_mesh_position(mesh, defect->vertices[i]), mean);
        mean = mt_vec3_add(mean, mt_vec3_scale(offset, 1.0 / (double)(i + 1)));
    }
    return cli_point(mean);
}

typedef struct extent {
    mt_vec3 low, high;
} extent;

static extent extent_of(const mt_mesh *mesh, mt_index face)
{
    extent all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (mt_index c = mt_mesh_face_begin(mesh, face); c < mt_mesh_face_end(mesh, face); c++) {
        mt_vec3 p = mt_mesh_position(mesh, mesh->corner_vertices[c]);
        all.low = mt_vec3_make(fmin(all.low.x, p.x), fmin(all.low.y, p.y), fmin(all.low.z, p.z));
        all.high = mt_vec3_make(fmax(all.high.x, p.x), fmax(all.high.y, p.y), fmax(all.high.z, p.z));
    }
    return all;
}

/* The middle of what the boxes of two faces share, in which all their common points lie. */
static cli_quantity meeting_place(const mt_mesh *mesh, const mt_defect *defect)
{
    extent a = extent_of(mesh, defect->faces[0]), b = extent_of(mesh, defect->faces[1]);
    return cli_point(mt_vec3_make(fmax(a.low.x, b.low.x) / 2 + fmin(a.high.x, b.high.x) / 2,
                                  fmax(a.low.y, b.low.y) / 2 + fmin(a.high.y, b.high.y) / 2,
                                  fmax(a.low.z, b.low.z) / 2 + fmin(a.high.z, b.high.z) / 2));
}

static void add_list(cli_line *line, const char *noun, const mt_index *numbers, mt_index count)
{
    cli_line_add(line, "%s ", cli_plural(count, noun).text);
    for (mt_index i = 0; i < count && i < LISTED_COUNT; i++) {
        cli_line_add(line, "%s%u", i ? ", " : "", numbers[i]);
    }
    if (count > LISTED_COUNT) {
        cli_line_add(line, " and %s more", cli_count(count - LISTED_COUNT).text);
    }
}

/* "edge 12-57 at (0, 1, 2), in faces 4, 9, 13" */
static void print_example(const cli_check *check, const mt_defect *defect)
{
    cli_line line = {0};
    cli_quantity place = place_of(check->mesh, defect);
    if (cli_defect_is_of_pairs(defect->kind)) {
        cli_line_add(&line, "faces %u and %u, around %s", defect->faces[0], defect->faces[1],
                     meeting_place(check->mesh, defect).text);
        if (defect->vertex_count) {
            cli_line_add(&line, ", sharing ");
            add_list(&line, "vertex", defect->vertices, defect->vertex_count);
        }
    } else if (cli_defect_is_of_edges(defect->kind)) {
        mt_index a = defect->vertices[0], b = defect->vertices[1];
        cli_line_add(&line, "edge %u-%u at %s, in ", a < b ? a : b, a < b ? b : a, place.text);
        add_list(&line, "face", defect->faces, defect->face_count);
    } else if (cli_defect_is_of_components(defect->kind)) {
        cli_line_add(&line, "the component of face %u, which is at %s", defect->faces[0], place.text);
    } else if (defect->kind == MT_DEFECT_DUPLICATE_FACE && defect->face_count == 2) {
        cli_line_add(&line, "face %u repeats face %u, at %s", defect->faces[1], defect->faces[0], place.text);
    } else if (cli_defect_is_of_faces(defect->kind)) {
        add_list(&line, "face", defect->faces, defect->face_count);
        cli_line_add(&line, " at %s, with ", place.text);
        add_list(&line, "vertex", defect->vertices, defect->vertex_count);
    } else {
        cli_line_add(&line, "vertex %u at %s", defect->vertices[0], place.text);
        if (defect->face_count) {
            cli_line_add(&line, ", in ");
            add_list(&line, "face", defect->faces, defect->face_count);
        }
    }
    printf("      %s\n", line.text);
}

static void print_kind(const cli_check *check, mt_defect_kind kind)
{
    const mt_manifold_report *report = check->report;
    mt_index shown = 0;
    printf("  %s: %s\n", cli_defects_told(report, kind).text, cli_defect_cure(report, kind));
    for (size_t i = 0; i < report->defect_list_count && shown < EXAMPLE_COUNT; i++) {
        if (report->defects[i].kind == kind) {
            print_example(check, &report->defects[i]);
            shown++;
        }
    }
    if (report->defect_counts[kind] > shown) {
        printf("      and %s more\n", cli_count(report->defect_counts[kind] - shown).text);
    }
}

/* True when there was something to say. */
static bool print_defects(const cli_check *check)
{
    bool found = false;
    for (mt_defect_kind kind = 0; kind < MT_DEFECT_BOUNDARY_EDGE; kind++) {
        if (check->report->defect_counts[kind] && kind != MT_DEFECT_BOUNDARY_PINCH) {
            if (!found) {
                puts("\nWhat is wrong, in the order in which to mend it (numbers count from 0):");
            }
            found = true;
            print_kind(check, kind);
        }
    }
    return found;
}

static void print_boundary(mt_context *context, const cli_check *check)
{
    const mt_manifold_report *report = check->report;
    const char *cure = cli_defect_cure(report, MT_DEFECT_BOUNDARY_EDGE);
    mt_index edges = report->defect_counts[MT_DEFECT_BOUNDARY_EDGE];
    if (edges == 0) {
        return;
    }
    if (report->boundary_loop_count == MT_NONE) {
        printf("\nBoundary: %s; once the rest is mended, %s.\n", cli_defects_told(report, MT_DEFECT_BOUNDARY_EDGE).text,
               cure);
        if (report->defect_counts[MT_DEFECT_BOUNDARY_PINCH]) {
            print_kind(check, MT_DEFECT_BOUNDARY_PINCH);
        }
        return;
    }
    printf("\nBoundary: %s, %s; ", cli_counted(report->boundary_loop_count, "loop").text,
           cli_counted(edges, "edge").text);
    puts(report->boundary_loop_count == 1 ? "fill it, if the mesh should be closed."
                                          : "fill them, if the mesh should be closed.");
    cli_check_print_loops(context, check);
}

/* The file's name as a shell takes it, or a stand-in. */
static const char *shell_name(const char *file)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./+-";
    return *file != '-' && file[strspn(file, plain)] == '\0' ? file : "FILE";
}

static const char *class_told(mt_manifold_class manifold_class)
{
    static const char *const names[] = {
        [MT_MANIFOLD] = "manifold and closed",
        [MT_MANIFOLD_WITH_BOUNDARY] = "manifold with boundary",
        [MT_NON_MANIFOLD] = "not manifold",
    };
    return names[manifold_class];
}

/* Vertices at the same place that faces do not share: invisible, and the usual cause of seams. */
static void print_as_welded(const cli_check *check)
{
    const mt_manifold_report *report = check->report;
    const mt_manifold_welded *welded = &report->as_welded;
    mt_index excess = report->vertex_count - (report->has_as_welded ? welded->vertex_count : report->vertex_count);
    if (!excess) {
        return;
    }
    const char *still = welded->manifold_class == report->manifold_class ? "still " : "";
    printf("\n%s %s at the place of another. As welded it would %sbe %s, ", cli_counted(excess, "vertex").text,
           excess == 1 ? "is" : "are", still, class_told(welded->manifold_class));
    const struct {
        const char *noun;
        mt_index count;
    } left[] = {{"boundary edge", welded->boundary_edge_count},
                {"non-manifold edge", welded->non_manifold_edge_count},
                {"non-manifold vertex", welded->non_manifold_vertex_count}};
    size_t kinds = 1, index = 0;
    for (int i = 1; i < 3; i++) {
        kinds += left[i].count > 0;
    }
    cli_line line = {0};
    for (int i = 0; i < 3; i++) {
        if (i == 0 || left[i].count) {
            cli_line_add_item(&line, index++, kinds, cli_counted(left[i].count, left[i].noun).text);
        }
    }
    printf("with %s; `meshtool repair %s -o OUT --weld` joins them.\n", line.text, shell_name(check->file));
}

static void print_volume(const mt_manifold_report *report)
{
    if (report->has_volume) {
        printf(", volume %s%s\n", cli_real(report->volume).text,
               report->volume < 0 ? " (negative: the faces look inwards; turn them all over)" : "");
    } else if (report->manifold_class == MT_NON_MANIFOLD) {
        puts(", no volume as it is not manifold");
    } else {
        puts(report->manifold_class == MT_MANIFOLD ? ", no volume as it is not oriented"
                                                   : ", no volume as it is not closed");
    }
}

static void print_figures(const cli_check *check)
{
    const mt_manifold_report *report = check->report;
    printf("\n%s, %s, %s", cli_counted(report->vertex_count, "vertex").text,
           cli_counted(report->edge_count, "edge").text, cli_counted(report->face_count, "face").text);
    if (report->triangle_count != report->face_count) {
        printf(" (%s)", cli_counted(report->triangle_count, "triangle").text);
    }
    printf(" in %s", cli_counted(report->component_count, "component").text);
    puts(check->mesh->welded ? "; corners welded where equal, as STL has no indices" : "");
    printf("Euler characteristic %s", cli_count(report->euler_characteristic).text);
    if (report->has_genus) {
        printf(", genus %s", cli_count(report->genus).text);
    }
    printf("; area %s", cli_real(report->area).text);
    print_volume(report);
}

void cli_check_print_text(mt_context *context, const cli_check *check)
{
    cli_check_print_verdict(check);
    bool found = print_defects(check);
    print_boundary(context, check);
    print_as_welded(check);
    if (check->report->face_count || check->report->vertex_count) {
        print_figures(check);
    }
    if (found) {
        printf("\nTo see where: meshtool check-manifold %s --paint defects.png\n", shell_name(check->file));
    }
}
