/* check-manifold's JSON: the keys of the contract, in its order, then what we found worth adding. */
#include "check.h"

static json_t *index_json(mt_index number)
{
    return number == MT_NONE ? json_null() : cli_json_integer(number);
}

static json_t *answer_json(mt_answer answer)
{
    return answer == MT_UNDEFINED ? json_null() : json_boolean(answer == MT_YES);
}

static const char *class_name(mt_manifold_class manifold_class)
{
    static const char *const names[] = {
        [MT_MANIFOLD] = "manifold",
        [MT_MANIFOLD_WITH_BOUNDARY] = "manifold-with-boundary",
        [MT_NON_MANIFOLD] = "non-manifold",
    };
    return names[manifold_class];
}

static void set_count_of(json_t *object, const mt_manifold_report *report, mt_defect_kind kind)
{
    cli_json_set(object, mt_defect_key(kind), cli_json_integer(report->defect_counts[kind]));
}

static void set_counts(json_t *object, const mt_manifold_report *report)
{
    static const mt_defect_kind order[] = {
        MT_DEFECT_BOUNDARY_EDGE,       MT_DEFECT_NON_MANIFOLD_EDGE, MT_DEFECT_MISORIENTED_EDGE,
        MT_DEFECT_NON_MANIFOLD_VERTEX, MT_DEFECT_ISOLATED_VERTEX,   MT_DEFECT_DEGENERATE_FACE,
        MT_DEFECT_ZERO_AREA_FACE,      MT_DEFECT_DUPLICATE_FACE,    MT_DEFECT_NON_FINITE_VERTEX,
    };
    cli_json_set(object, "vertices", cli_json_integer(report->vertex_count));
    cli_json_set(object, "faces", cli_json_integer(report->face_count));
    cli_json_set(object, "triangles", cli_json_integer((int64_t)report->triangle_count));
    cli_json_set(object, "corners", cli_json_integer(report->corner_count));
    cli_json_set(object, "edges", cli_json_integer(report->edge_count));
    for (size_t i = 0; i < sizeof order / sizeof order[0]; i++) {
        set_count_of(object, report, order[i]);
    }
}

static json_t *welded_json(const mt_manifold_report *report)
{
    if (!report->has_as_welded) {
        return json_null();
    }
    const mt_manifold_welded *welded = &report->as_welded;
    json_t *object = cli_json_object();
    cli_json_set(object, "class", cli_json_text(class_name(welded->manifold_class)));
    cli_json_set(object, "vertices", cli_json_integer(welded->vertex_count));
    cli_json_set(object, "boundary_edges", cli_json_integer(welded->boundary_edge_count));
    cli_json_set(object, "non_manifold_edges", cli_json_integer(welded->non_manifold_edge_count));
    cli_json_set(object, "non_manifold_vertices", cli_json_integer(welded->non_manifold_vertex_count));
    return object;
}

static void set_shape(json_t *object, const mt_manifold_report *report)
{
    cli_json_set(object, "components", cli_json_integer(report->component_count));
    cli_json_set(object, "boundary_loops", index_json(report->boundary_loop_count));
    cli_json_set(object, "euler_characteristic", cli_json_integer(report->euler_characteristic));
    cli_json_set(object, "class", cli_json_text(class_name(report->manifold_class)));
    cli_json_set(object, "oriented", answer_json(report->oriented));
    cli_json_set(object, "orientable", answer_json(report->orientable));
    cli_json_set(object, "genus", report->has_genus ? cli_json_integer(report->genus) : json_null());
    cli_json_set(object, "area", cli_json_real(report->area));
    cli_json_set(object, "volume", report->has_volume ? cli_json_real(report->volume) : json_null());
    cli_json_set(object, "self_intersections",
                 report->has_self_intersections ? cli_json_integer(report->defect_counts[MT_DEFECT_SELF_INTERSECTION])
                                                : json_null());
    cli_json_set(object, "as_welded", welded_json(report));
    set_count_of(object, report, MT_DEFECT_BOUNDARY_PINCH);
    set_count_of(object, report, MT_DEFECT_INSIDE_OUT_COMPONENT);
}

static json_t *indices_json(const mt_index *indices, mt_index count)
{
    json_t *array = cli_json_array();
    for (mt_index i = 0; i < count; i++) {
        cli_json_append(array, cli_json_integer(indices[i]));
    }
    return array;
}

/* One by one, as --all-defects may list millions. */
static void print_defects(const mt_manifold_report *report, uint64_t listed_per_kind)
{
    uint64_t listed[MT_DEFECT_KIND_COUNT] = {0};
    const char *separator = "";
    fputs(", \"defects\": [", stdout);
    for (size_t i = 0; i < report->defect_list_count; i++) {
        const mt_defect *defect = &report->defects[i];
        if (listed[defect->kind]++ >= listed_per_kind) {
            continue;
        }
        json_t *object = cli_json_object();
        cli_json_set(object, "kind", cli_json_text(mt_defect_key(defect->kind)));
        cli_json_set(object, "vertices", indices_json(defect->vertices, defect->vertex_count));
        cli_json_set(object, "faces", indices_json(defect->faces, defect->face_count));
        fputs(separator, stdout);
        separator = ", ";
        cli_json_print(stdout, object);
        json_decref(object);
    }
    fputc(']', stdout);
}

void cli_check_print_json(const cli_check *check)
{
    json_t *object = cli_json_object();
    cli_json_set(object, "file", cli_json_text(check->file));
    cli_json_set(object, "format", cli_json_text(check->format->name));
    cli_json_set(object, "welded", json_boolean(check->mesh->welded));
    set_counts(object, check->report);
    set_shape(object, check->report);
    cli_json_print_open(stdout, object);
    print_defects(check->report, check->listed_per_kind);
    fputs("}\n", stdout);
    json_decref(object);
}
